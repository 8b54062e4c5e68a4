//! The numbers the formulas are generic over: [`Real`], which is `f32` or `f64`.
//!
//! A formula is written once and evaluated in either precision. Errors of 1e-7 and 1e-16 are then of
//! one and the same text:
//!
//! ```
//! use brdf::{Real, d_ggx};
//! /// The tilt at which D of GGX is half of its peak: tan²θ = α² (√2 − 1)/(1 − √2 α²).
//! fn half_width<R: Real>(alpha: R) -> R {
//!     let (one, root) = (R::of(1.0), R::of(2.0).sqrt());
//!     (alpha * ((root - one) / (one - root * alpha * alpha)).sqrt()).atan()
//! }
//! let (single, double) = (half_width(0.16f32), half_width(0.16f64)); // in radians: 5.99°
//! assert!((f64::from(single) - double).abs() < 1e-7);
//! assert!((d_ggx(double.cos(), 0.16) / d_ggx(1.0, 0.16) - 0.5).abs() < 1e-13);
//! ```
//!
//! What more a formula needs than `+ − × ÷` are elementary functions, and ways to keep what rounding
//! takes away: a product or a sum as *unevaluated sum* is its rounded value and, beside it, the rounding
//! error, exactly.

mod fused;
mod sums;

pub(crate) use fused::{Fused, Single};
pub(crate) use sums::{one_minus_square, plus, quotient, split, squared, times, zero_unless_nan};

use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// Floating point that a formula can be evaluated in: `f32` and `f64`.
///
/// The elementary functions come from `libm`, so that results do not depend on the platform's C library:
/// within 1 ulp, or little more, and the same everywhere. Outside their domain they give what IEEE 754
/// says, as those of `std` do: NaN or an infinity, never a panic. A NaN stays one, whichever argument it is.
///
/// To implement it for another type is possible, and needs [`Real::to_f64`] to be exact and the
/// arithmetic to round correctly: the unevaluated sums rest on it.
pub trait Real:
    Copy
    + PartialOrd
    + Debug
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// Distance from 1 to the next larger number: 2⁻²³ and 2⁻⁵².
    const EPSILON: f64;
    /// A number whose square, and four times that, is still finite, 1e15 and 1e150: arguments beyond it
    /// are cut off where only their limit matters.
    const LARGE: f64;
    /// The smallest positive number with full precision: about 1.2e-38 and 2.2e-308.
    const TINY: f64;
    /// 2^k + 1 with k half the bits of the significand, for Dekker's splitting.
    const SPLITTER: f64;
    /// How many terms of the series of [`lambda_beckmann`](crate::lambda_beckmann) this precision can use.
    const ERFC_TERMS: usize;

    /// The nearest number to `x`; ±∞ where `x` is too large.
    fn of(x: f64) -> Self;
    /// As an `f64`, exactly.
    fn to_f64(self) -> f64;
    /// Square root, correctly rounded; NaN below 0.
    fn sqrt(self) -> Self;
    /// Absolute value.
    fn abs(self) -> Self;
    /// e^x; +∞ and 0 where it leaves the range.
    fn exp(self) -> Self;
    /// 2^x, likewise.
    fn exp2(self) -> Self;
    /// Natural logarithm; −∞ of 0, NaN below.
    fn ln(self) -> Self;
    /// ln(1 + x), accurate near 0; −∞ at −1, NaN below.
    fn ln_1p(self) -> Self;
    /// `self` to the power `y`; 1 where y is 0, NaN below 0 unless y is whole.
    fn powf(self, y: Self) -> Self;
    /// Sine of an angle in radians, of any size; NaN of an infinity.
    fn sin(self) -> Self;
    /// Cosine of an angle in radians, likewise.
    fn cos(self) -> Self;
    /// Arc sine in radians, −π/2 to π/2; NaN outside [−1, 1].
    fn asin(self) -> Self;
    /// Arc cosine in radians, 0 to π; NaN outside [−1, 1].
    fn acos(self) -> Self;
    /// Arc tangent in radians, −π/2 to π/2.
    fn atan(self) -> Self;
    /// Angle of the point (x, self) to the x axis in radians, −π to π; 0 or ±π at the origin, by the
    /// signs of its zeros.
    fn atan2(self, x: Self) -> Self;
    /// Whether this is a NaN.
    fn is_nan(self) -> bool;
    /// Whether this is neither infinite nor a NaN.
    fn is_finite(self) -> bool;

    /// The larger of the two, and `self` where `self` is a NaN.
    #[inline(always)]
    fn at_least(self, low: Self) -> Self {
        if low > self { low } else { self }
    }

    /// The smaller of the two, and `self` where `self` is a NaN.
    #[inline(always)]
    fn at_most(self, high: Self) -> Self {
        if high < self { high } else { self }
    }

    /// Brought into [0, 1]; a 0 loses its sign, so that no quotient by it is −∞.
    #[inline(always)]
    fn clamp_unit(self) -> Self {
        let zero = Self::of(0.0);
        if self <= zero {
            zero
        } else {
            self.at_most(Self::of(1.0))
        }
    }

    /// Brought into ±[`Real::LARGE`]: an infinite argument counts as a very large one, so that
    /// its product with 0 is 0.
    #[inline(always)]
    fn bounded(self) -> Self {
        self.at_most(Self::of(Self::LARGE))
            .at_least(Self::of(-Self::LARGE))
    }

    /// self · y + z: fused where that is an instruction, else a product and a sum.
    ///
    /// Never the library call that `f32::mul_add` is without FMA.
    #[inline(always)]
    fn mul_add(self, y: Self, z: Self) -> Self {
        self * y + z
    }

    /// x².
    #[inline(always)]
    fn squared(self) -> Self {
        self * self
    }

    /// x⁵, as three products.
    #[inline(always)]
    fn pow5(self) -> Self {
        let x2 = self * self;
        x2 * x2 * self
    }

    /// sqrt(x² + y²) without overflow or underflow on the way; NaN where both are infinite.
    #[inline(always)]
    fn hypot(self, y: Self) -> Self {
        let (a, b) = (self.abs(), y.abs());
        let (large, small) = if b > a { (b, a) } else { (a, b) };
        let ratio = small / large;
        let length = large * (Self::of(1.0) + ratio * ratio).sqrt();
        // Chosen afterwards: a loop without branches works on several points at a time.
        if large == Self::of(0.0) {
            large
        } else {
            length
        }
    }

    /// The product as an unevaluated sum: rounded product and its rounding error (Dekker 1971).
    ///
    /// Exact unless a factor is beyond the largest number over [`Real::SPLITTER`], where the second is NaN,
    /// or the error underflows.
    ///
    /// ```
    /// use brdf::Real;
    /// let (product, error) = 1.1f64.two_prod(1.1);
    /// assert_eq!(product, 1.1 * 1.1);
    /// assert!(error != 0.0 && error.abs() < 2e-16);
    /// ```
    #[inline(always)]
    fn two_prod(self, y: Self) -> (Self, Self) {
        let split = |x: Self| {
            let t = x * Self::of(Self::SPLITTER);
            let high = t - (t - x);
            (high, x - high)
        };
        let p = self * y;
        let ((ah, al), (bh, bl)) = (split(self), split(y));
        (p, ((ah * bh - p) + ah * bl + al * bh) + al * bl)
    }

    /// The square as an unevaluated sum, with one splitting; like [`Real::two_prod`].
    #[inline(always)]
    fn two_square(self) -> (Self, Self) {
        let t = self * Self::of(Self::SPLITTER);
        let high = t - (t - self);
        let low = self - high;
        let p = self * self;
        (p, ((high * high - p) + (high + high) * low) + low * low)
    }

    /// The sum as an unevaluated sum: rounded sum and its rounding error (Knuth, The Art of Computer
    /// Programming, volume 2), exact unless it overflows.
    #[inline(always)]
    fn two_sum(self, y: Self) -> (Self, Self) {
        let s = self + y;
        let b = s - self;
        (s, (self - (s - b)) + (y - b))
    }
}

/// A constant in the precision of the formula around it.
#[inline(always)]
pub(crate) fn lit<R: Real>(x: f64) -> R {
    R::of(x)
}

/// What both precisions have from the language, and their elementary functions from `libm`.
macro_rules! real {
    (
        $real:ident, large: $large:literal, splitter: $splitter:literal, erfc_terms: $terms:literal,
        $($name:ident($($arg:ident),*): $function:ident),*
    ) => {
        impl Real for $real {
            const EPSILON: f64 = $real::EPSILON as f64;
            const LARGE: f64 = $large;
            const TINY: f64 = $real::MIN_POSITIVE as f64;
            const SPLITTER: f64 = $splitter;
            const ERFC_TERMS: usize = $terms;

            #[inline(always)]
            fn of(x: f64) -> $real {
                x as $real
            }
            #[inline(always)]
            fn to_f64(self) -> f64 {
                f64::from(self)
            }
            #[inline(always)]
            fn sqrt(self) -> $real {
                $real::sqrt(self)
            }
            #[inline(always)]
            fn abs(self) -> $real {
                $real::abs(self)
            }
            #[inline(always)]
            fn is_nan(self) -> bool {
                $real::is_nan(self)
            }
            #[inline(always)]
            fn is_finite(self) -> bool {
                $real::is_finite(self)
            }
            $(fn $name(self $(, $arg: $real)*) -> $real {
                libm::$function(self $(, $arg)*)
            })*
        }
    };
}

real!(
    f64, large: 1e150, splitter: 134_217_729.0, erfc_terms: 27,
    exp(): exp, exp2(): exp2, ln(): log, ln_1p(): log1p, powf(y): pow,
    sin(): sin, cos(): cos, asin(): asin, acos(): acos, atan(): atan, atan2(x): atan2
);

real!(
    f32, large: 1e15, splitter: 4097.0, erfc_terms: 14,
    exp(): expf, exp2(): exp2f, ln(): logf, ln_1p(): log1pf, powf(y): powf,
    sin(): sinf, cos(): cosf, asin(): asinf, acos(): acosf, atan(): atanf, atan2(x): atan2f
);
