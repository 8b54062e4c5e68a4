//! The numbers the formulas are generic over: [`Real`], which is `f32` or `f64`.
//!
//! A formula is written once and evaluated in either precision. Errors of 1e-7 and 1e-16 are then of
//! one and the same text:
//!
//! ```
//! use brdf::{Real, d_ggx};
//! /// Where D has fallen to half of its peak: tan²θ = α² (√2 − 1).
//! fn half_width<R: Real>(alpha: R) -> R {
//!     (alpha * R::of(std::f64::consts::SQRT_2 - 1.0).sqrt()).atan()
//! }
//! let (single, double) = (half_width(0.16f32), half_width(0.16f64)); // in radians
//! assert!((f64::from(single) - double).abs() < 1e-7);
//! # // tan²θ is of the slopes; D itself has cos⁻⁴θ besides, little of it here.
//! assert!((d_ggx(double.cos(), 0.16) / d_ggx(1.0, 0.16) - 0.5).abs() < 0.02);
//! ```
//!
//! What more a formula needs than `+ − × ÷` are elementary functions, and ways to keep what rounding
//! takes away: a product or a sum as *unevaluated sum* is its rounded value and, beside it, the rounding
//! error, exactly.

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

/// 0, or NaN where one of the arguments is: what a function returns outside its domain.
#[inline(always)]
pub(crate) fn zero_unless_nan<R: Real, const N: usize>(args: [R; N]) -> R {
    let mut zero = lit(0.0);
    for arg in args {
        if arg.is_nan() {
            zero = arg;
        }
    }
    zero
}

/// 1 − c² as an unevaluated sum. The rounding error of c² alone is large next to it near c = 1.
#[inline(always)]
pub(crate) fn one_minus_square<R: Real>(c: R) -> (R, R) {
    let (c2, c2_low) = c.two_prod(c);
    let (high, low) = lit::<R>(1.0).two_sum(-c2);
    high.two_sum(low - c2_low)
}

/// The quotient of two unevaluated sums as an unevaluated sum.
///
/// The low part is dropped where it is lost to overflow or underflow.
#[inline(always)]
pub(crate) fn quotient<R: Real>(n: (R, R), d: (R, R)) -> (R, R) {
    let q = n.0 / d.0;
    let (back, back_low) = q.two_prod(d.0);
    let low = ((n.0 - back) - back_low + n.1 - q * d.1) / d.0;
    (q, if low.is_finite() { low } else { lit(0.0) })
}

/// The sum of two unevaluated sums as one.
#[inline(always)]
pub(crate) fn plus<R: Real>(a: (R, R), b: (R, R)) -> (R, R) {
    let (high, low) = a.0.two_sum(b.0);
    (high, low + (a.1 + b.1))
}

/// The product of two unevaluated sums as one.
#[inline(always)]
pub(crate) fn times<R: Real>(a: (R, R), b: (R, R)) -> (R, R) {
    let (high, low) = a.0.two_prod(b.0);
    (high, low + (a.0 * b.1 + a.1 * b.0))
}

/// The square of an unevaluated sum as one.
#[inline(always)]
pub(crate) fn squared<R: Real>(a: (R, R)) -> (R, R) {
    let (high, low) = a.0.two_square();
    (high, low + lit::<R>(2.0) * a.0 * a.1)
}

/// A constant as an unevaluated sum.
#[inline(always)]
pub(crate) fn split<R: Real>(x: f64) -> (R, R) {
    let high = lit::<R>(x);
    (high, lit(x - high.to_f64()))
}

/// A constant in the precision of the formula around it.
#[inline(always)]
pub(crate) fn lit<R: Real>(x: f64) -> R {
    R::of(x)
}

impl Real for f64 {
    const EPSILON: f64 = f64::EPSILON;
    const LARGE: f64 = 1e150;
    const TINY: f64 = f64::MIN_POSITIVE;
    const SPLITTER: f64 = 134_217_729.0;
    const ERFC_TERMS: usize = 27;

    #[inline(always)]
    fn of(x: f64) -> f64 {
        x
    }
    #[inline(always)]
    fn to_f64(self) -> f64 {
        self
    }
    #[inline(always)]
    fn sqrt(self) -> f64 {
        f64::sqrt(self)
    }
    #[inline(always)]
    fn abs(self) -> f64 {
        f64::abs(self)
    }
    fn exp(self) -> f64 {
        libm::exp(self)
    }
    fn exp2(self) -> f64 {
        libm::exp2(self)
    }
    fn ln(self) -> f64 {
        libm::log(self)
    }
    fn ln_1p(self) -> f64 {
        libm::log1p(self)
    }
    fn powf(self, y: f64) -> f64 {
        libm::pow(self, y)
    }
    fn sin(self) -> f64 {
        libm::sin(self)
    }
    fn cos(self) -> f64 {
        libm::cos(self)
    }
    fn asin(self) -> f64 {
        libm::asin(self)
    }
    fn acos(self) -> f64 {
        libm::acos(self)
    }
    fn atan(self) -> f64 {
        libm::atan(self)
    }
    fn atan2(self, x: f64) -> f64 {
        libm::atan2(self, x)
    }
    #[inline(always)]
    fn is_nan(self) -> bool {
        f64::is_nan(self)
    }
    #[inline(always)]
    fn is_finite(self) -> bool {
        f64::is_finite(self)
    }
}

impl Real for f32 {
    const EPSILON: f64 = f32::EPSILON as f64;
    const LARGE: f64 = 1e15;
    const TINY: f64 = f32::MIN_POSITIVE as f64;
    const SPLITTER: f64 = 4097.0;
    const ERFC_TERMS: usize = 14;

    #[inline(always)]
    fn of(x: f64) -> f32 {
        x as f32
    }
    #[inline(always)]
    fn to_f64(self) -> f64 {
        f64::from(self)
    }
    #[inline(always)]
    fn sqrt(self) -> f32 {
        f32::sqrt(self)
    }
    #[inline(always)]
    fn abs(self) -> f32 {
        f32::abs(self)
    }
    fn exp(self) -> f32 {
        libm::expf(self)
    }
    fn exp2(self) -> f32 {
        libm::exp2f(self)
    }
    fn ln(self) -> f32 {
        libm::logf(self)
    }
    fn ln_1p(self) -> f32 {
        libm::log1pf(self)
    }
    fn powf(self, y: f32) -> f32 {
        libm::powf(self, y)
    }
    fn sin(self) -> f32 {
        libm::sinf(self)
    }
    fn cos(self) -> f32 {
        libm::cosf(self)
    }
    fn asin(self) -> f32 {
        libm::asinf(self)
    }
    fn acos(self) -> f32 {
        libm::acosf(self)
    }
    fn atan(self) -> f32 {
        libm::atanf(self)
    }
    fn atan2(self, x: f32) -> f32 {
        libm::atan2f(self, x)
    }
    #[inline(always)]
    fn is_nan(self) -> bool {
        f32::is_nan(self)
    }
    #[inline(always)]
    fn is_finite(self) -> bool {
        f32::is_finite(self)
    }
}

/// Single precision in a batch: loaded from and stored to slices of `f32`.
pub(crate) trait Single: Real {
    /// From memory.
    fn load(x: f32) -> Self;
    /// To memory.
    fn store(self) -> f32;

    /// 1 − x², without cancellation near 1: one instruction where products are fused.
    #[inline(always)]
    fn one_minus_square(self) -> Self {
        (lit::<Self>(1.0) - self) * (lit::<Self>(1.0) + self)
    }

    /// sin and cos of 2π times this, see [`batch::sin_cos_turn`](crate::batch::sin_cos_turn).
    fn sin_cos_turn(self) -> (Self, Self);
}

impl Single for f32 {
    #[inline(always)]
    fn load(x: f32) -> f32 {
        x
    }
    #[inline(always)]
    fn store(self) -> f32 {
        self
    }
    #[inline(always)]
    fn sin_cos_turn(self) -> (f32, f32) {
        crate::batch::sin_cos_turn(self)
    }
}

/// Single precision where the machine multiplies and adds in one instruction.
///
/// Only for functions compiled with that feature: elsewhere each `mul_add` is a library call.
#[cfg_attr(not(target_arch = "x86_64"), allow(dead_code))]
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd)]
pub(crate) struct Fused(pub(crate) f32);

impl Single for Fused {
    #[inline(always)]
    fn load(x: f32) -> Fused {
        Fused(x)
    }
    #[inline(always)]
    fn store(self) -> f32 {
        self.0
    }
    #[inline(always)]
    fn one_minus_square(self) -> Fused {
        (-self).mul_add(self, lit(1.0))
    }
    #[inline(always)]
    fn sin_cos_turn(self) -> (Fused, Fused) {
        crate::batch::sin_cos_turn(self)
    }
}

macro_rules! fused_operators {
    ($($trait:ident $method:ident),*) => { $(
        impl $trait for Fused {
            type Output = Fused;
            #[inline(always)]
            fn $method(self, other: Fused) -> Fused {
                Fused($trait::$method(self.0, other.0))
            }
        }
    )* };
}
fused_operators!(Add add, Sub sub, Mul mul, Div div);

impl Neg for Fused {
    type Output = Fused;
    #[inline(always)]
    fn neg(self) -> Fused {
        Fused(-self.0)
    }
}

macro_rules! fused_functions {
    ($($name:ident),*) => { $(
        #[inline(always)]
        fn $name(self) -> Fused {
            Fused(Real::$name(self.0))
        }
    )* };
}

impl Real for Fused {
    const EPSILON: f64 = <f32 as Real>::EPSILON;
    const LARGE: f64 = f32::LARGE;
    const TINY: f64 = f32::TINY;
    const SPLITTER: f64 = f32::SPLITTER;
    const ERFC_TERMS: usize = f32::ERFC_TERMS;

    fused_functions!(sqrt, abs, exp, exp2, ln, ln_1p, sin, cos, asin, acos, atan);

    #[inline(always)]
    fn of(x: f64) -> Fused {
        Fused(x as f32)
    }
    #[inline(always)]
    fn to_f64(self) -> f64 {
        f64::from(self.0)
    }
    fn powf(self, y: Fused) -> Fused {
        Fused(Real::powf(self.0, y.0))
    }
    fn atan2(self, x: Fused) -> Fused {
        Fused(Real::atan2(self.0, x.0))
    }
    #[inline(always)]
    fn is_nan(self) -> bool {
        self.0.is_nan()
    }
    #[inline(always)]
    fn is_finite(self) -> bool {
        self.0.is_finite()
    }
    #[inline(always)]
    fn mul_add(self, y: Fused, z: Fused) -> Fused {
        Fused(self.0.mul_add(y.0, z.0))
    }
    #[inline(always)]
    fn two_prod(self, y: Fused) -> (Fused, Fused) {
        let p = self * y;
        (p, self.mul_add(y, -p))
    }
    #[inline(always)]
    fn two_square(self) -> (Fused, Fused) {
        self.two_prod(self)
    }
}
