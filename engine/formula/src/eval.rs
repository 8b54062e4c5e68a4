//! Values, in f64 or with every operation in f32, and the errors of domains.

use crate::builtin::Builtin;
use crate::dag::{Dag, Id, Op};
use crate::error::{Error, excerpt};
use crate::expr::{CompareOp, Expr, plain};
use crate::library::{Library, Values};

/// The arithmetic that a formula needs, in one precision.
pub(crate) trait Real: Copy + PartialOrd + 'static {
    const ZERO: Self;
    const ONE: Self;
    fn of(value: f64) -> Self;
    fn to_f64(self) -> f64;
    fn finite(self) -> bool;
    fn neg(self) -> Self;
    fn add(self, other: Self) -> Self;
    fn sub(self, other: Self) -> Self;
    fn mul(self, other: Self) -> Self;
    fn div(self, other: Self) -> Self;
    fn pow(self, other: Self) -> Self;
    fn least(self, other: Self) -> Self;
    fn most(self, other: Self) -> Self;
    fn unary(self, function: Builtin) -> Self;
    fn term(term: &brdf::Term, args: &[Self]) -> Self;

    /// Products by squaring, so that every backend multiplies in the same order.
    fn power(self, exponent: i32) -> Self {
        let mut result = Self::ONE;
        let mut square = self;
        let mut left = exponent.unsigned_abs();
        let mut first = true;
        while left > 0 {
            if left & 1 == 1 {
                result = if first { square } else { result.mul(square) };
                first = false;
            }
            left >>= 1;
            if left > 0 {
                square = square.mul(square);
            }
        }
        if exponent < 0 {
            Self::ONE.div(result)
        } else {
            result
        }
    }

    fn compare(self, op: CompareOp, other: Self) -> Self {
        let holds = match op {
            CompareOp::Less => self < other,
            CompareOp::LessEqual => self <= other,
            CompareOp::Greater => self > other,
            CompareOp::GreaterEqual => self >= other,
            CompareOp::Equal => self == other,
            CompareOp::NotEqual => self != other,
        };
        if holds { Self::ONE } else { Self::ZERO }
    }
}

macro_rules! real {
    ($real:ident) => {
        impl Real for $real {
            const ZERO: $real = 0.0;
            const ONE: $real = 1.0;
            fn of(value: f64) -> $real {
                value as $real
            }
            fn to_f64(self) -> f64 {
                f64::from(self)
            }
            fn finite(self) -> bool {
                self.is_finite()
            }
            fn neg(self) -> $real {
                -self
            }
            fn add(self, other: $real) -> $real {
                self + other
            }
            fn sub(self, other: $real) -> $real {
                self - other
            }
            fn mul(self, other: $real) -> $real {
                self * other
            }
            fn div(self, other: $real) -> $real {
                self / other
            }
            fn pow(self, other: $real) -> $real {
                self.powf(other)
            }
            fn least(self, other: $real) -> $real {
                self.min(other)
            }
            fn most(self, other: $real) -> $real {
                self.max(other)
            }
            fn unary(self, function: Builtin) -> $real {
                match function {
                    Builtin::Sqrt => self.sqrt(),
                    Builtin::Exp => self.exp(),
                    Builtin::Ln => self.ln(),
                    Builtin::Log2 => self.log2(),
                    Builtin::Abs => self.abs(),
                    Builtin::Sin => self.sin(),
                    Builtin::Cos => self.cos(),
                    Builtin::Tan => self.tan(),
                    Builtin::Asin => self.asin(),
                    Builtin::Acos => self.acos(),
                    Builtin::Atan => self.atan(),
                    Builtin::Deg => self.to_radians(),
                    // These have two arguments and operations of their own.
                    Builtin::Min | Builtin::Max | Builtin::Pow => self,
                }
            }
            fn term(term: &brdf::Term, args: &[$real]) -> $real {
                (term.$real)(args)
            }
        }
    };
}
real!(f32);
real!(f64);

/// One operation, its operands taken from `value`.
pub(crate) fn apply<R: Real>(op: &Op, inputs: &[R], value: impl Fn(Id) -> R) -> R {
    match op {
        Op::Number(bits) => R::of(f64::from_bits(*bits)),
        Op::Pi => R::of(std::f64::consts::PI),
        Op::Input(index) => inputs.get(*index).copied().unwrap_or(R::of(f64::NAN)),
        Op::Neg(a) => value(*a).neg(),
        Op::Add(a, b) => value(*a).add(value(*b)),
        Op::Sub(a, b) => value(*a).sub(value(*b)),
        Op::Mul(a, b) => value(*a).mul(value(*b)),
        Op::Div(a, b) => value(*a).div(value(*b)),
        Op::PowInt(a, exponent) => value(*a).power(*exponent),
        Op::Pow(a, b) => value(*a).pow(value(*b)),
        Op::Compare(op, a, b) => value(*a).compare(*op, value(*b)),
        Op::Min(a, b) => value(*a).least(value(*b)),
        Op::Max(a, b) => value(*a).most(value(*b)),
        Op::Unary(function, a) => value(*a).unary(*function),
        Op::Term(term, args) => {
            let mut values = [R::ZERO; 16];
            match values.get_mut(..args.len()) {
                Some(slots) => {
                    for (slot, arg) in slots.iter_mut().zip(args) {
                        *slot = value(*arg);
                    }
                    R::term(term.0, slots)
                }
                None => R::of(f64::NAN),
            }
        }
    }
}

impl Dag {
    /// Every operation in order; the first one without a finite value is an error.
    pub(crate) fn run<R: Real>(&self, library: &Library, inputs: &[R]) -> Result<R, Error> {
        let needed = self.needed();
        let mut values: Vec<R> = Vec::with_capacity(self.ops.len());
        for (id, op) in self.ops.iter().enumerate() {
            if !needed[id] {
                values.push(R::ZERO);
                continue;
            }
            let value = apply(op, inputs, |id| values[id]);
            if !value.finite() {
                return Err(self.fault(library, id, |id| values[id].to_f64(), inputs));
            }
            if let Op::Term(term, args) = op {
                for (param, arg) in term.0.params.iter().zip(args) {
                    let given = values[*arg].to_f64();
                    if let Some(message) = impossible(param.name, given) {
                        return Err(self.told(library, id, *arg, message));
                    }
                }
            }
            values.push(value);
        }
        Ok(values.get(self.root).copied().unwrap_or(R::ZERO))
    }

    /// Why an operation whose operands are finite has no finite value.
    fn fault<R: Real>(
        &self,
        library: &Library,
        id: Id,
        value: impl Fn(Id) -> f64,
        inputs: &[R],
    ) -> Error {
        let narrow = size_of::<R>() == 4;
        let too_large = || {
            let what = if narrow { "f32" } else { "f64" };
            format!("the value is too large for {what}")
        };
        // A divisor is the better place to point at than the whole quotient.
        let mut blame = id;
        let message = match &self.ops[id] {
            Op::Number(bits) => format!(
                "{what} cannot hold {}",
                plain(f64::from_bits(*bits)),
                what = if narrow { "f32" } else { "f64" }
            ),
            Op::Input(index) => {
                let name = self.inputs.get(*index).map_or("", String::as_str);
                let given = inputs.get(*index).map_or(f64::NAN, |value| value.to_f64());
                format!("{} is given as {given}, not a finite number", excerpt(name))
            }
            Op::Div(_, divisor) if value(*divisor) == 0.0 => {
                blame = *divisor;
                "division by zero".to_string()
            }
            Op::PowInt(base, _) if value(*base) == 0.0 => "0 to a negative power".to_string(),
            Op::Pow(base, exponent) if value(*base) == 0.0 && value(*exponent) < 0.0 => {
                "0 to a negative power".to_string()
            }
            Op::Pow(base, exponent) if value(*base) < 0.0 => format!(
                "({})^{}: a negative number has only whole powers",
                plain(value(*base)),
                plain(value(*exponent))
            ),
            Op::Unary(function, operand) => {
                let shown = plain(value(*operand));
                match function {
                    Builtin::Sqrt => format!("sqrt({shown}): the root of a negative number"),
                    Builtin::Ln | Builtin::Log2 => {
                        format!(
                            "{}({shown}): a logarithm needs more than 0",
                            function.name()
                        )
                    }
                    Builtin::Asin | Builtin::Acos => {
                        format!("{}({shown}): needs a number from -1 to 1", function.name())
                    }
                    _ => too_large(),
                }
            }
            Op::Term(term, args) => {
                let shown: Vec<String> = term
                    .0
                    .params
                    .iter()
                    .zip(args)
                    .map(|(param, arg)| format!("{} = {}", param.name, plain(value(*arg))))
                    .collect();
                format!("{}({}) has no finite value", term.0.name, shown.join(", "))
            }
            _ => too_large(),
        };
        self.told(library, id, blame, message)
    }

    /// An error about an operation, pointing at another one where that stands in the text.
    fn told(&self, library: &Library, id: Id, blame: Id, message: String) -> Error {
        let origin = self.origins[id];
        let pointed = self.origins[blame];
        match origin.within {
            None => Error::new(
                if pointed.within.is_none() {
                    pointed.span
                } else {
                    origin.span
                },
                message,
            ),
            Some((index, span)) => {
                let name = self.definitions.get(index).map_or("", String::as_str);
                let text = library.definition(name).map_or("", |d| span.of(&d.text));
                let error = Error::new(origin.span, format!("in {name}: {message}"));
                if text.is_empty() {
                    error
                } else {
                    error.help(format!("it comes from {}", excerpt(text)))
                }
            }
        }
    }
}

/// Why a function of the core has no business with a value, although it takes it: what is
/// called a cosine must be one.
fn impossible(param: &str, value: f64) -> Option<String> {
    // Room for the rounding of a cosine that was computed in f32.
    const SLACK: f64 = 1e-5;
    let cosine = param.contains("_dot_") || param.starts_with("cos_");
    if cosine && value.abs() > 1.0 + SLACK {
        return Some(format!("{param} = {} is no cosine", plain(value)));
    }
    let width = param == "alpha" || param == "roughness";
    (width && value < 0.0).then(|| format!("{param} = {} is negative", plain(value)))
}

impl Library {
    fn value<R: Real>(&self, expr: &Expr, values: &Values) -> Result<f64, Error> {
        let names: Vec<&str> = values.keys().map(String::as_str).collect();
        let dag = self.lower(expr, Some(&names))?;
        let inputs: Vec<R> = values.values().map(|value| R::of(*value)).collect();
        // -0 is 0 to everybody who reads it.
        dag.run(self, &inputs).map(|value| value.to_f64() + 0.0)
    }

    /// The value in f64.
    ///
    /// # Errors
    /// Unknown names and arguments, and every value outside of a domain (1/0, `ln(-1)`),
    /// with the span in the expression; a fault inside a definition points at its call.
    pub fn eval(&self, expr: &Expr, values: &Values) -> Result<f64, Error> {
        self.value::<f64>(expr, values)
    }

    /// The value with every constant, operation and core call in f32.
    ///
    /// # Errors
    /// As [`Library::eval`], with the range of f32.
    pub fn eval_f32(&self, expr: &Expr, values: &Values) -> Result<f64, Error> {
        self.value::<f32>(expr, values)
    }
}
