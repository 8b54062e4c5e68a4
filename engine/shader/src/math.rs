//! WGSL's functions, rounded to f32. Elementary ones are computed in f64 first, so that they are
//! the same on every machine and better than most graphics processors'.

use naga::MathFunction as Fun;

use crate::arithmetic::{both, dot, each};
use crate::halt::Halt;
use crate::value::{Scalar, Value, Vector};

/// Whether this machine knows a function.
pub fn knows(fun: Fun) -> bool {
    !matches!(
        fun,
        Fun::Dot4I8Packed
            | Fun::Dot4U8Packed
            | Fun::QuantizeToF16
            | Fun::Pack4x8snorm
            | Fun::Pack4x8unorm
            | Fun::Pack2x16snorm
            | Fun::Pack2x16unorm
            | Fun::Pack2x16float
            | Fun::Pack4xI8
            | Fun::Pack4xU8
            | Fun::Pack4xI8Clamp
            | Fun::Pack4xU8Clamp
            | Fun::Unpack4x8snorm
            | Fun::Unpack4x8unorm
            | Fun::Unpack2x16snorm
            | Fun::Unpack2x16unorm
            | Fun::Unpack2x16float
            | Fun::Unpack4xI8
            | Fun::Unpack4xU8
    )
}

/// Applies a function to its arguments.
pub fn call(fun: Fun, args: &[Value]) -> Result<Value, Halt> {
    let arg = |at: usize| args.get(at).ok_or(Halt::Unexpected("an argument"));
    let x = arg(0)?;
    match fun {
        Fun::Abs | Fun::Sign => each(x, |lane| magnitude(fun, lane)),
        Fun::Min | Fun::Max => both(x, arg(1)?, |a, b| extreme(fun, a, b)),
        Fun::Clamp => {
            let low = both(x, arg(1)?, |a, b| extreme(Fun::Max, a, b))?;
            both(&low, arg(2)?, |a, b| extreme(Fun::Min, a, b))
        }
        Fun::Atan2 => floats2(x, arg(1)?, |y, x| f64::from(y).atan2(f64::from(x)) as f32),
        Fun::Pow => floats2(x, arg(1)?, power),
        Fun::Step => floats2(x, arg(1)?, |edge, x| f32::from(edge <= x)),
        Fun::Fma => {
            let product = floats2(x, arg(1)?, |a, b| a * b)?;
            floats2(&product, arg(2)?, |a, b| a + b)
        }
        Fun::Mix => {
            // x (1 − t) + y t, as the standard writes it.
            let from = floats2(x, arg(2)?, |x, t| x * (1.0 - t))?;
            let to = floats2(arg(1)?, arg(2)?, |y, t| y * t)?;
            floats2(&from, &to, |a, b| a + b)
        }
        Fun::SmoothStep => {
            let along = floats2(arg(2)?, x, |x, low| x - low)?;
            let whole = floats2(arg(1)?, x, |high, low| high - low)?;
            floats2(&along, &whole, |a, b| {
                let t = clamp01(a / b);
                t * t * (3.0 - 2.0 * t)
            })
        }
        Fun::Dot => dot(x, arg(1)?).map(Value::Scalar),
        Fun::Length => length(x).map(Value::f32),
        Fun::Distance => length(&floats2(x, arg(1)?, |a, b| a - b)?).map(Value::f32),
        Fun::Normalize => {
            let length = length(x)?;
            floats1(x, |lane| lane / length)
        }
        Fun::Cross => cross(x, arg(1)?),
        Fun::FaceForward => {
            let away = float(dot(arg(1)?, arg(2)?)?)? < 0.0;
            floats1(x, |lane| if away { lane } else { -lane })
        }
        Fun::Reflect => {
            let twice = 2.0 * float(dot(arg(1)?, x)?)?;
            floats2(x, arg(1)?, |i, n| i - twice * n)
        }
        Fun::Refract => refract(x, arg(1)?, float(arg(2)?.scalar()?)?),
        Fun::Outer => {
            let columns = arg(1)?.floats()?.into_iter();
            let columns = columns.map(|weight| floats1(x, |lane| lane * weight));
            Ok(Value::composite(columns.collect::<Result<_, _>>()?))
        }
        Fun::Transpose => transposed(&columns(x)?),
        Fun::Determinant => Ok(Value::f32(determinant(&columns(x)?))),
        Fun::Inverse => Err(Halt::Unexpected("a function that WGSL has")),
        Fun::Modf => parts(x, |value| {
            let whole = value.trunc();
            (Scalar::F32(value - whole), Scalar::F32(whole))
        }),
        Fun::Frexp => parts(x, |value| {
            let (fraction, exponent) = mantissa(value);
            (Scalar::F32(fraction), Scalar::I32(exponent))
        }),
        Fun::Ldexp => both(x, arg(1)?, |value, power| match (value, power) {
            (Scalar::F32(value), Scalar::I32(power)) => {
                let scaled = f64::from(value) * 2_f64.powi(power.clamp(-400, 400));
                Ok(Scalar::F32(scaled as f32))
            }
            _ => Err(Halt::Unexpected("an f32 and an i32")),
        }),
        Fun::ExtractBits | Fun::InsertBits => fields(fun, args),
        Fun::CountTrailingZeros
        | Fun::CountLeadingZeros
        | Fun::CountOneBits
        | Fun::ReverseBits
        | Fun::FirstTrailingBit
        | Fun::FirstLeadingBit => each(x, |lane| bits(fun, lane)),
        other => floats1(x, |lane| elementary(other, lane)),
    }
}

fn elementary(fun: Fun, x: f32) -> f32 {
    let exact = |of: fn(f64) -> f64| of(f64::from(x)) as f32;
    match fun {
        Fun::Saturate => clamp01(x),
        Fun::Cos => exact(f64::cos),
        Fun::Cosh => exact(f64::cosh),
        Fun::Sin => exact(f64::sin),
        Fun::Sinh => exact(f64::sinh),
        Fun::Tan => exact(f64::tan),
        Fun::Tanh => exact(f64::tanh),
        Fun::Acos => exact(f64::acos),
        Fun::Asin => exact(f64::asin),
        Fun::Atan => exact(f64::atan),
        Fun::Asinh => exact(f64::asinh),
        Fun::Acosh => exact(f64::acosh),
        Fun::Atanh => exact(f64::atanh),
        Fun::Radians => exact(f64::to_radians),
        Fun::Degrees => exact(f64::to_degrees),
        Fun::Ceil => x.ceil(),
        Fun::Floor => x.floor(),
        Fun::Round => x.round_ties_even(),
        Fun::Fract => x - x.floor(),
        Fun::Trunc => x.trunc(),
        Fun::Exp => exact(f64::exp),
        Fun::Exp2 => exact(f64::exp2),
        Fun::Log => exact(f64::ln),
        Fun::Log2 => exact(f64::log2),
        Fun::Sqrt => x.sqrt(),
        Fun::InverseSqrt => exact(|x| 1.0 / x.sqrt()),
        // What is not here was refused before it ran.
        _ => f32::NAN,
    }
}

/// A power as shaders have it: of a negative number it is NaN, whatever the exponent.
fn power(base: f32, exponent: f32) -> f32 {
    if base < 0.0 {
        f32::NAN
    } else {
        f64::from(base).powf(f64::from(exponent)) as f32
    }
}

/// Within 0 and 1; a NaN becomes 0.
fn clamp01(x: f32) -> f32 {
    if x > 0.0 { x.min(1.0) } else { 0.0 }
}

fn float(scalar: Scalar) -> Result<f32, Halt> {
    match scalar {
        Scalar::F32(value) => Ok(value),
        _ => Err(Halt::Unexpected("an f32")),
    }
}

fn floats1(value: &Value, of: impl Fn(f32) -> f32) -> Result<Value, Halt> {
    each(value, |lane| Ok(Scalar::F32(of(float(lane)?))))
}

fn floats2(left: &Value, right: &Value, of: impl Fn(f32, f32) -> f32) -> Result<Value, Halt> {
    both(left, right, |a, b| {
        Ok(Scalar::F32(of(float(a)?, float(b)?)))
    })
}

fn magnitude(fun: Fun, lane: Scalar) -> Result<Scalar, Halt> {
    let sign = fun == Fun::Sign;
    Ok(match lane {
        Scalar::F32(value) if sign && (value == 0.0 || value.is_nan()) => Scalar::F32(value),
        Scalar::F32(value) if sign => Scalar::F32(value.signum()),
        Scalar::F32(value) => Scalar::F32(value.abs()),
        Scalar::I32(value) if sign => Scalar::I32(value.signum()),
        Scalar::I32(value) => Scalar::I32(value.wrapping_abs()),
        Scalar::U32(value) => Scalar::U32(if sign { value.min(1) } else { value }),
        Scalar::Bool(_) => return Err(Halt::Unexpected("a number")),
    })
}

/// The smaller or the greater; where one is NaN, the other.
fn extreme(fun: Fun, a: Scalar, b: Scalar) -> Result<Scalar, Halt> {
    let least = fun == Fun::Min;
    Ok(match (a, b) {
        (Scalar::F32(a), Scalar::F32(b)) => Scalar::F32(if least { a.min(b) } else { a.max(b) }),
        (Scalar::I32(a), Scalar::I32(b)) => Scalar::I32(if least { a.min(b) } else { a.max(b) }),
        (Scalar::U32(a), Scalar::U32(b)) => Scalar::U32(if least { a.min(b) } else { a.max(b) }),
        _ => return Err(Halt::Unexpected("two of a kind")),
    })
}

fn length(value: &Value) -> Result<f32, Halt> {
    match value {
        Value::Scalar(scalar) => float(*scalar).map(f32::abs),
        _ => float(dot(value, value)?).map(f32::sqrt),
    }
}

fn cross(left: &Value, right: &Value) -> Result<Value, Halt> {
    let (a, b) = (left.floats()?, right.floats()?);
    let ([ax, ay, az], [bx, by, bz]) = (&a[..], &b[..]) else {
        return Err(Halt::Unexpected("two vectors of three"));
    };
    let lanes = [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx];
    Ok(Value::Vector(Vector::new(&lanes.map(Scalar::F32))))
}

fn refract(i: &Value, n: &Value, ratio: f32) -> Result<Value, Halt> {
    let cosine = float(dot(n, i)?)?;
    let k = 1.0 - ratio * ratio * (1.0 - cosine * cosine);
    if k < 0.0 {
        return floats1(i, |_| 0.0);
    }
    floats2(i, n, |i, n| ratio * i - (ratio * cosine + k.sqrt()) * n)
}

fn columns(matrix: &Value) -> Result<Vec<Vec<f32>>, Halt> {
    match matrix {
        Value::Composite(columns) => columns.iter().map(Value::floats).collect(),
        _ => Err(Halt::Unexpected("a matrix")),
    }
}

fn transposed(columns: &[Vec<f32>]) -> Result<Value, Halt> {
    let rows = columns.first().map_or(0, Vec::len);
    let row = |at: usize| {
        let lanes = columns.iter().filter_map(|column| column.get(at).copied());
        Value::Vector(Vector::new(&lanes.map(Scalar::F32).collect::<Vec<_>>()))
    };
    Ok(Value::composite((0..rows).map(row).collect()))
}

/// Along the first column.
fn determinant(columns: &[Vec<f32>]) -> f32 {
    let [first, rest @ ..] = columns else {
        return 1.0;
    };
    let minor = |row: usize| {
        let without = rest.iter().map(|column| {
            let others = column.iter().enumerate().filter(|(at, _)| *at != row);
            others.map(|(_, value)| *value).collect()
        });
        determinant(&without.collect::<Vec<Vec<f32>>>())
    };
    let terms = first.iter().enumerate().map(|(row, value)| {
        let sign = if row % 2 == 0 { 1.0 } else { -1.0 };
        sign * value * minor(row)
    });
    terms.sum()
}

/// The two members of what `modf` and `frexp` return.
fn parts(value: &Value, of: impl Fn(f32) -> (Scalar, Scalar)) -> Result<Value, Halt> {
    let first = each(value, |lane| Ok(of(float(lane)?).0))?;
    let second = each(value, |lane| Ok(of(float(lane)?).1))?;
    Ok(Value::composite(vec![first, second]))
}

/// A fraction from 0.5 to 1 and the power of two it is times.
fn mantissa(value: f32) -> (f32, i32) {
    if value == 0.0 || !value.is_finite() {
        return (value, 0);
    }
    let wide = f64::from(value);
    // No f32 is subnormal as an f64, so the exponent can be read off.
    let exponent = ((wide.to_bits() >> 52) & 0x7ff) as i32 - 1022;
    ((wide * 2_f64.powi(-exponent)) as f32, exponent)
}

fn bits(fun: Fun, lane: Scalar) -> Result<Scalar, Halt> {
    let (pattern, signed) = match lane {
        Scalar::U32(value) => (value, false),
        Scalar::I32(value) => (value as u32, true),
        _ => return Err(Halt::Unexpected("a whole number")),
    };
    let none_or = |found: bool, at: u32| if found { at } else { u32::MAX };
    let result = match fun {
        Fun::CountTrailingZeros => pattern.trailing_zeros(),
        Fun::CountLeadingZeros => pattern.leading_zeros(),
        Fun::CountOneBits => pattern.count_ones(),
        Fun::ReverseBits => pattern.reverse_bits(),
        Fun::FirstTrailingBit => none_or(pattern != 0, pattern.trailing_zeros()),
        _ => {
            // Of a negative number the first bit that is not the sign's.
            let seen = if signed && (pattern as i32) < 0 {
                !pattern
            } else {
                pattern
            };
            none_or(seen != 0, 31_u32.wrapping_sub(seen.leading_zeros()))
        }
    };
    Ok(if signed {
        Scalar::I32(result as i32)
    } else {
        Scalar::U32(result)
    })
}

/// `extractBits` and `insertBits`, cut to the 32 bits there are.
fn fields(fun: Fun, args: &[Value]) -> Result<Value, Halt> {
    let number = |at: usize| {
        let value = args.get(at).ok_or(Halt::Unexpected("an argument"))?;
        value.index()
    };
    let first = if fun == Fun::InsertBits { 2 } else { 1 };
    let offset = number(first)?.min(32);
    let count = number(first + 1)?.min(32 - offset);
    let mask = u32::MAX.checked_shr(32 - count).unwrap_or(0);
    let x = args.first().ok_or(Halt::Unexpected("an argument"))?;
    if fun == Fun::InsertBits {
        let inserted = args.get(1).ok_or(Halt::Unexpected("an argument"))?;
        let mask = mask.checked_shl(offset).unwrap_or(0);
        return both(x, inserted, |x, new| {
            let put = |x: u32, new: u32| x & !mask | new.checked_shl(offset).unwrap_or(0) & mask;
            Ok(match (x, new) {
                (Scalar::U32(x), Scalar::U32(new)) => Scalar::U32(put(x, new)),
                (Scalar::I32(x), Scalar::I32(new)) => Scalar::I32(put(x as u32, new as u32) as i32),
                _ => return Err(Halt::Unexpected("two whole numbers")),
            })
        });
    }
    each(x, |lane| {
        Ok(match lane {
            _ if count == 0 => match lane {
                Scalar::I32(_) => Scalar::I32(0),
                _ => Scalar::U32(0),
            },
            Scalar::U32(value) => Scalar::U32(value >> offset & mask),
            // The sign is spread over what is above.
            Scalar::I32(value) => Scalar::I32(value << (32 - offset - count) >> (32 - count)),
            _ => return Err(Halt::Unexpected("a whole number")),
        })
    })
}
