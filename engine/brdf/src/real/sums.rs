//! Arithmetic of unevaluated sums: a rounded number and, beside it, what rounding took away.

use super::{Real, lit};

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
