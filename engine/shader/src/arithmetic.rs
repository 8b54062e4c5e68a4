//! Operators: componentwise on vectors, by WGSL's rules for integers that overflow or divide by
//! zero, in plain f32 for the rest.

use naga::{BinaryOperator as Op, ScalarKind, UnaryOperator};

use crate::halt::Halt;
use crate::value::{Scalar, Value, Vector};

/// Applies `of` to every lane.
pub fn each(value: &Value, of: impl Fn(Scalar) -> Result<Scalar, Halt>) -> Result<Value, Halt> {
    each_lane(value, &of)
}

fn each_lane<F>(value: &Value, of: &F) -> Result<Value, Halt>
where
    F: Fn(Scalar) -> Result<Scalar, Halt>,
{
    match value {
        Value::Scalar(scalar) => of(*scalar).map(Value::Scalar),
        Value::Vector(vector) => {
            let mut vector = *vector;
            for lane in vector.lanes_mut() {
                *lane = of(*lane)?;
            }
            Ok(Value::Vector(vector))
        }
        Value::Composite(columns) => {
            let columns = columns.iter().map(|column| each_lane(column, of));
            Ok(Value::composite(columns.collect::<Result<_, _>>()?))
        }
        Value::Nothing | Value::Pointer(_) => Err(Halt::Unexpected("a number or a vector")),
    }
}

/// Applies `of` to lanes side by side; a scalar stands beside every lane.
pub fn both(
    left: &Value,
    right: &Value,
    of: impl Fn(Scalar, Scalar) -> Result<Scalar, Halt>,
) -> Result<Value, Halt> {
    both_lanes(left, right, &of)
}

fn both_lanes<F>(left: &Value, right: &Value, of: &F) -> Result<Value, Halt>
where
    F: Fn(Scalar, Scalar) -> Result<Scalar, Halt>,
{
    match (left, right) {
        (Value::Scalar(a), Value::Scalar(b)) => of(*a, *b).map(Value::Scalar),
        (Value::Scalar(a), right) => each(right, |b| of(*a, b)),
        (left, Value::Scalar(b)) => each(left, |a| of(a, *b)),
        (Value::Vector(a), Value::Vector(b)) => {
            let mut out = *a;
            for (lane, b) in out.lanes_mut().iter_mut().zip(b.lanes()) {
                *lane = of(*lane, *b)?;
            }
            Ok(Value::Vector(out))
        }
        (Value::Composite(a), Value::Composite(b)) => {
            let columns = a.iter().zip(b.iter()).map(|(a, b)| both_lanes(a, b, of));
            Ok(Value::composite(columns.collect::<Result<_, _>>()?))
        }
        _ => Err(Halt::Unexpected("two of a kind")),
    }
}

pub fn unary(op: UnaryOperator, value: &Value) -> Result<Value, Halt> {
    each(value, |lane| {
        Ok(match (op, lane) {
            (UnaryOperator::Negate, Scalar::F32(value)) => Scalar::F32(-value),
            (UnaryOperator::Negate, Scalar::I32(value)) => Scalar::I32(value.wrapping_neg()),
            (UnaryOperator::LogicalNot, Scalar::Bool(value)) => Scalar::Bool(!value),
            (UnaryOperator::BitwiseNot, Scalar::I32(value)) => Scalar::I32(!value),
            (UnaryOperator::BitwiseNot, Scalar::U32(value)) => Scalar::U32(!value),
            _ => return Err(Halt::Unexpected("an operand that fits")),
        })
    })
}

pub fn binary(op: Op, left: &Value, right: &Value) -> Result<Value, Halt> {
    match (op, left, right) {
        (Op::Multiply, Value::Composite(columns), Value::Vector(_)) => times(columns, right),
        (Op::Multiply, Value::Composite(columns), Value::Composite(others)) => {
            let product = others.iter().map(|other| times(columns, other));
            Ok(Value::composite(product.collect::<Result<_, _>>()?))
        }
        (Op::Multiply, Value::Vector(_), Value::Composite(columns)) => {
            let dots = columns.iter().map(|column| dot(left, column));
            let dots: Vec<Scalar> = dots.collect::<Result<_, _>>()?;
            Ok(Value::Vector(Vector::new(&dots)))
        }
        _ => both(left, right, |a, b| scalars(op, a, b)),
    }
}

/// The sum of products, from the first lane on.
pub fn dot(left: &Value, right: &Value) -> Result<Scalar, Halt> {
    let products = both(left, right, |a, b| scalars(Op::Multiply, a, b))?;
    let mut lanes = products.lanes()?.iter();
    let first = *lanes.next().ok_or(Halt::Unexpected("a vector"))?;
    lanes.try_fold(first, |sum, lane| scalars(Op::Add, sum, *lane))
}

/// A matrix times a vector: the columns, weighed and added.
fn times(columns: &[Value], vector: &Value) -> Result<Value, Halt> {
    let mut weighed = columns.iter().zip(vector.lanes()?).map(|(column, weight)| {
        both(column, &Value::Scalar(*weight), |a, b| {
            scalars(Op::Multiply, a, b)
        })
    });
    let first = weighed.next().ok_or(Halt::Unexpected("a matrix"))??;
    weighed.try_fold(first, |sum, column| {
        both(&sum, &column?, |a, b| scalars(Op::Add, a, b))
    })
}

fn scalars(op: Op, a: Scalar, b: Scalar) -> Result<Scalar, Halt> {
    use Scalar::{Bool, F32, I32, U32};
    Ok(match (op, a, b) {
        (Op::Add, F32(a), F32(b)) => F32(a + b),
        (Op::Subtract, F32(a), F32(b)) => F32(a - b),
        (Op::Multiply, F32(a), F32(b)) => F32(a * b),
        (Op::Divide, F32(a), F32(b)) => F32(a / b),
        (Op::Modulo, F32(a), F32(b)) => F32(a % b),

        (Op::Add, I32(a), I32(b)) => I32(a.wrapping_add(b)),
        (Op::Subtract, I32(a), I32(b)) => I32(a.wrapping_sub(b)),
        (Op::Multiply, I32(a), I32(b)) => I32(a.wrapping_mul(b)),
        // x / 0 is x, and x % 0 is 0.
        (Op::Divide, I32(a), I32(0)) => I32(a),
        (Op::Modulo, I32(_), I32(0)) | (Op::Modulo, U32(_), U32(0)) => match a {
            I32(_) => I32(0),
            _ => U32(0),
        },
        (Op::Divide, I32(a), I32(b)) => I32(a.wrapping_div(b)),
        (Op::Modulo, I32(a), I32(b)) => I32(a.wrapping_rem(b)),

        (Op::Add, U32(a), U32(b)) => U32(a.wrapping_add(b)),
        (Op::Subtract, U32(a), U32(b)) => U32(a.wrapping_sub(b)),
        (Op::Multiply, U32(a), U32(b)) => U32(a.wrapping_mul(b)),
        (Op::Divide, U32(a), U32(b)) => U32(a.checked_div(b).unwrap_or(a)),
        (Op::Modulo, U32(a), U32(b)) => U32(a % b),

        (Op::And, I32(a), I32(b)) => I32(a & b),
        (Op::And, U32(a), U32(b)) => U32(a & b),
        (Op::And | Op::LogicalAnd, Bool(a), Bool(b)) => Bool(a & b),
        (Op::InclusiveOr, I32(a), I32(b)) => I32(a | b),
        (Op::InclusiveOr, U32(a), U32(b)) => U32(a | b),
        (Op::InclusiveOr | Op::LogicalOr, Bool(a), Bool(b)) => Bool(a | b),
        (Op::ExclusiveOr, I32(a), I32(b)) => I32(a ^ b),
        (Op::ExclusiveOr, U32(a), U32(b)) => U32(a ^ b),
        (Op::ExclusiveOr, Bool(a), Bool(b)) => Bool(a ^ b),
        // Only the last five bits of the shift count.
        (Op::ShiftLeft, I32(a), U32(b)) => I32(a.wrapping_shl(b)),
        (Op::ShiftLeft, U32(a), U32(b)) => U32(a.wrapping_shl(b)),
        (Op::ShiftRight, I32(a), U32(b)) => I32(a.wrapping_shr(b)),
        (Op::ShiftRight, U32(a), U32(b)) => U32(a.wrapping_shr(b)),

        _ => Bool(compare(op, a, b)?),
    })
}

fn compare(op: Op, a: Scalar, b: Scalar) -> Result<bool, Halt> {
    use Scalar::{Bool, F32, I32, U32};
    let order = match (a, b) {
        (F32(a), F32(b)) => a.partial_cmp(&b),
        (I32(a), I32(b)) => Some(a.cmp(&b)),
        (U32(a), U32(b)) => Some(a.cmp(&b)),
        (Bool(a), Bool(b)) => Some(a.cmp(&b)),
        _ => return Err(Halt::Unexpected("two of a kind")),
    };
    Ok(match op {
        // A NaN is unequal to everything, itself included.
        Op::Equal => order.is_some_and(|order| order.is_eq()),
        Op::NotEqual => order.is_none_or(|order| order.is_ne()),
        Op::Less => order.is_some_and(|order| order.is_lt()),
        Op::LessEqual => order.is_some_and(|order| order.is_le()),
        Op::Greater => order.is_some_and(|order| order.is_gt()),
        Op::GreaterEqual => order.is_some_and(|order| order.is_ge()),
        _ => return Err(Halt::Unexpected("operands that fit")),
    })
}

/// A conversion such as `f32(i)`, or with the bits kept.
pub fn convert(value: &Value, kind: ScalarKind, keep_bits: bool) -> Result<Value, Halt> {
    each(value, |lane| {
        if keep_bits {
            bits_as(lane, kind)
        } else {
            number_as(lane, kind)
        }
    })
}

fn number_as(lane: Scalar, kind: ScalarKind) -> Result<Scalar, Halt> {
    use Scalar::{Bool, F32, I32, U32};
    Ok(match (kind, lane) {
        (ScalarKind::Float, F32(value)) => F32(value),
        (ScalarKind::Float, I32(value)) => F32(value as f32),
        (ScalarKind::Float, U32(value)) => F32(value as f32),
        (ScalarKind::Float, Bool(value)) => F32(f32::from(value)),
        // Out of range gives the nearest end.
        (ScalarKind::Sint, F32(value)) => I32(value as i32),
        (ScalarKind::Sint, I32(value)) => I32(value),
        (ScalarKind::Sint, U32(value)) => I32(value as i32),
        (ScalarKind::Sint, Bool(value)) => I32(i32::from(value)),
        (ScalarKind::Uint, F32(value)) => U32(value as u32),
        (ScalarKind::Uint, I32(value)) => U32(value as u32),
        (ScalarKind::Uint, U32(value)) => U32(value),
        (ScalarKind::Uint, Bool(value)) => U32(u32::from(value)),
        (ScalarKind::Bool, F32(value)) => Bool(value != 0.0),
        (ScalarKind::Bool, I32(value)) => Bool(value != 0),
        (ScalarKind::Bool, U32(value)) => Bool(value != 0),
        (ScalarKind::Bool, Bool(value)) => Bool(value),
        _ => return Err(Halt::Unexpected("a number of 32 bits")),
    })
}

fn bits_as(lane: Scalar, kind: ScalarKind) -> Result<Scalar, Halt> {
    let bits = match lane {
        Scalar::F32(value) => value.to_bits(),
        Scalar::I32(value) => value as u32,
        Scalar::U32(value) => value,
        Scalar::Bool(_) => return Err(Halt::Unexpected("a number of 32 bits")),
    };
    Ok(match kind {
        ScalarKind::Float => Scalar::F32(f32::from_bits(bits)),
        ScalarKind::Sint => Scalar::I32(bits as i32),
        ScalarKind::Uint => Scalar::U32(bits),
        _ => return Err(Halt::Unexpected("a number of 32 bits")),
    })
}
