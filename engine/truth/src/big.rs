//! Numbers with many digits that can also have no value.

use dashu_float::FBig;
use dashu_float::round::mode::HalfEven;
use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};

type Float = FBig<HalfEven, 2>;

/// A number with a chosen precision, or none: where a division by 0, the root of a negative
/// number and the like would be. Having none spreads like a NaN.
#[derive(Debug, Clone)]
pub struct Big(Option<Float>);

impl Big {
    /// Exactly `x`, to be computed with in `bits` bits. None for NaN and infinities.
    ///
    /// The precision is set first: a number without it would compute in the few digits that
    /// it happens to have.
    pub fn new(x: f64, bits: usize) -> Big {
        let exact = Float::try_from(x).ok().filter(|_| x.is_finite());
        Big(exact.map(|value| value.with_precision(bits).value()))
    }

    /// The same number, to be computed with in more bits.
    pub(crate) fn widened(&self, bits: usize) -> Big {
        self.map(|x| Some(x.clone().with_precision(bits).value()))
    }

    /// π.
    pub(crate) fn pi(bits: usize) -> Big {
        Big(Some(Float::pi(bits)))
    }

    /// A number that has no value.
    pub(crate) fn none() -> Big {
        Big(None)
    }

    /// Itself if it has a value.
    pub(crate) fn finite(self) -> Option<Big> {
        self.0.is_some().then_some(self)
    }

    fn map(&self, f: impl FnOnce(&Float) -> Option<Float>) -> Big {
        Big(self.0.as_ref().and_then(f))
    }

    fn sign(&self) -> Option<Ordering> {
        self.0.as_ref().map(|x| x.cmp(&Float::ZERO))
    }

    /// Whether it is below 0.
    pub fn is_negative(&self) -> bool {
        self.sign() == Some(Ordering::Less)
    }

    /// Whether it is above 0.
    pub fn is_positive(&self) -> bool {
        self.sign() == Some(Ordering::Greater)
    }

    /// Whether it is 0.
    pub fn is_zero(&self) -> bool {
        self.sign() == Some(Ordering::Equal)
    }

    /// Absolute value.
    pub fn abs(&self) -> Big {
        if self.is_negative() {
            -self
        } else {
            self.clone()
        }
    }

    pub(crate) fn sqrt(&self) -> Big {
        if self.is_negative() {
            Big::none()
        } else {
            self.map(|x| Some(x.sqrt()))
        }
    }

    /// e^x; 0 and no value beyond any exponent of interest.
    pub(crate) fn exp(&self) -> Big {
        match self.to_f64() {
            x if x < -1e6 => self.map(|x| Some(Float::ZERO.with_precision(x.precision()).value())),
            x if x > 1e6 => Big::none(),
            _ => self.map(|x| Some(x.exp())),
        }
    }

    pub(crate) fn ln(&self) -> Big {
        if self.is_positive() {
            self.map(|x| Some(x.ln()))
        } else {
            Big::none()
        }
    }

    /// x^y for x ≥ 0.
    pub(crate) fn pow(&self, y: &Big) -> Big {
        match self.sign() {
            Some(Ordering::Greater) => (self.ln() * y).exp(),
            Some(Ordering::Equal) if y.is_zero() => self + 1.0,
            Some(Ordering::Equal) if !y.is_negative() => self.clone(),
            _ => Big::none(),
        }
    }

    pub(crate) fn cos(&self) -> Big {
        self.map(|x| Some(x.cos()))
    }

    pub(crate) fn sin(&self) -> Big {
        self.map(|x| Some(x.sin()))
    }

    /// The angle of a cosine in [−1, 1].
    pub(crate) fn acos(&self) -> Big {
        let inside = self.to_f64().abs() <= 1.0 && !(1.0 - self.abs()).is_negative();
        if inside {
            self.map(|x| Some(x.acos()))
        } else {
            Big::none()
        }
    }

    pub(crate) fn atan(&self) -> Big {
        self.map(|x| Some(x.atan()))
    }

    pub(crate) fn max(&self, other: &Big) -> Big {
        if (self - other).is_negative() {
            other.clone()
        } else {
            self.clone()
        }
    }

    pub(crate) fn min(&self, other: &Big) -> Big {
        if (self - other).is_negative() {
            self.clone()
        } else {
            other.clone()
        }
    }

    /// The nearest `f64`, NaN if there is no value.
    pub fn to_f64(&self) -> f64 {
        self.0.as_ref().map_or(f64::NAN, |x| x.to_f64().value())
    }

    /// Binary exponent: the number is in [2^e, 2^(e+1)). `None` for 0 and no value.
    fn exponent(&self) -> Option<isize> {
        let float = self.0.as_ref().filter(|_| !self.is_zero())?;
        Some(float.repr().exponent() + float.repr().digits() as isize - 1)
    }

    /// Whether the two agree in their first `bits` bits.
    pub(crate) fn agrees(&self, other: &Big, bits: isize) -> bool {
        match ((self - other).exponent(), self.exponent()) {
            (None, _) => true,
            (Some(_), None) => false,
            (Some(difference), Some(own)) => difference < own - bits,
        }
    }

    /// Error of a value in units of the last place of the truth, `digits` bits after the
    /// leading one (23 for `f32`, 52 for `f64`); below the normal range in units of its end.
    pub(crate) fn ulps(&self, value: f64, digits: isize, smallest_exponent: isize) -> f64 {
        let Some(truth) = &self.0 else {
            return f64::NAN;
        };
        let exponent = self
            .exponent()
            .unwrap_or(smallest_exponent)
            .max(smallest_exponent);
        let error = (Big::new(value, truth.precision().max(192)) - self).abs();
        match error.exponent() {
            None if error.0.is_some() => 0.0,
            None => f64::INFINITY,
            Some(_) => error
                .map(|x| Some(x.clone() >> (exponent - digits)))
                .to_f64(),
        }
    }
}

macro_rules! operator {
    ($trait:ident, $method:ident, $apply:expr) => {
        impl $trait<&Big> for &Big {
            type Output = Big;
            fn $method(self, other: &Big) -> Big {
                let apply: fn(&Float, &Float) -> Option<Float> = $apply;
                match (&self.0, &other.0) {
                    (Some(a), Some(b)) => Big(apply(a, b)),
                    _ => Big(None),
                }
            }
        }
        impl $trait<Big> for Big {
            type Output = Big;
            fn $method(self, other: Big) -> Big {
                (&self).$method(&other)
            }
        }
        impl $trait<&Big> for Big {
            type Output = Big;
            fn $method(self, other: &Big) -> Big {
                (&self).$method(other)
            }
        }
        impl $trait<Big> for &Big {
            type Output = Big;
            fn $method(self, other: Big) -> Big {
                self.$method(&other)
            }
        }
        impl $trait<f64> for &Big {
            type Output = Big;
            fn $method(self, other: f64) -> Big {
                self.$method(&Big::new(other, 64))
            }
        }
        impl $trait<f64> for Big {
            type Output = Big;
            fn $method(self, other: f64) -> Big {
                (&self).$method(other)
            }
        }
        impl $trait<&Big> for f64 {
            type Output = Big;
            fn $method(self, other: &Big) -> Big {
                Big::new(self, 64).$method(other)
            }
        }
        impl $trait<Big> for f64 {
            type Output = Big;
            fn $method(self, other: Big) -> Big {
                self.$method(&other)
            }
        }
    };
}

operator!(Add, add, |a, b| Some(a + b));
operator!(Sub, sub, |a, b| Some(a - b));
operator!(Mul, mul, |a, b| Some(a * b));
operator!(Div, div, |a, b| if *b == Float::ZERO {
    None
} else {
    Some(a / b)
});

impl Neg for &Big {
    type Output = Big;
    fn neg(self) -> Big {
        self.map(|x| Some(-x.clone()))
    }
}

impl Neg for Big {
    type Output = Big;
    fn neg(self) -> Big {
        -&self
    }
}
