//! Three components: what is a direction here.
//!
//! In the tangent frame x is along the tangent, y along the bitangent and z along the normal, so that N·L
//! is the third component of l. Functions with `world` in their name take any frame, and the normal with
//! it.
//!
//! ```
//! use brdf::{Ggx, glam};
//! let ggx = Ggx::new(0.25f32);
//! // An array, or glam's vector.
//! let single = ggx.g1([0.6, 0.0, 0.8]);
//! assert_eq!(single, ggx.g1(glam::Vec3::new(0.6, 0.0, 0.8)));
//! let double = Ggx::new(0.25f64).g1([0.6, 0.0, 0.8]);
//! assert!((double - f64::from(single)).abs() < 1e-6);
//! ```

use crate::real::{Real, lit};

/// A vector in the tangent frame: along the tangent, the bitangent and the normal.
///
/// `glam::Vec3` turns into it by itself wherever `impl Into<Vector<f32>>` is asked for, `Vec3::from` turns
/// it back, and `glam::DVec3` does the same for `f64`, where glam is built with it.
///
/// A direction points away from the surface and has length 1; rounding may make it a little longer or
/// shorter. What a function does with another length is said there; where nothing is said, the value
/// is that of the direction wherever the squares of the components would overflow or vanish, and
/// otherwise whatever the formula gives. A direction without length counts as the normal there. A
/// component that is NaN gives NaN, or 0 where another component alone decides.
pub type Vector<R> = [R; 3];

#[inline(always)]
pub(crate) fn dot<R: Real>(a: Vector<R>, b: Vector<R>) -> R {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
pub(crate) fn add<R: Real>(a: Vector<R>, b: Vector<R>) -> Vector<R> {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

#[inline(always)]
pub(crate) fn sub<R: Real>(a: Vector<R>, b: Vector<R>) -> Vector<R> {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

#[inline(always)]
pub(crate) fn scale<R: Real>(a: Vector<R>, s: R) -> Vector<R> {
    [a[0] * s, a[1] * s, a[2] * s]
}

/// Of length 1; up, if it has no length.
#[inline(always)]
pub(crate) fn normalize<R: Real>(a: Vector<R>) -> Vector<R> {
    let length2 = dot(a, a);
    if length2 > lit(0.0) {
        scale(a, lit::<R>(1.0) / length2.sqrt())
    } else {
        [lit(0.0), lit(0.0), lit(1.0)]
    }
}

/// `v` mirrored in a facet with normal `m` of length 1.
#[inline(always)]
pub(crate) fn reflect<R: Real>(v: Vector<R>, m: Vector<R>) -> Vector<R> {
    sub(scale(m, lit::<R>(2.0) * dot(v, m)), v)
}

/// Of length 1, however long or short it was; up, if it has no length.
pub(crate) fn tamed<R: Real>(a: Vector<R>) -> Vector<R> {
    let largest = a[0].abs().at_least(a[1].abs()).at_least(a[2].abs());
    if largest > lit(0.0) && largest.is_finite() {
        normalize(a.map(|x| x / largest))
    } else {
        [lit(0.0), lit(0.0), lit(1.0)]
    }
}

/// `value`, or what `again` gives where that is a NaN that no vector contains: for lengths and
/// widths whose squares overflow or vanish. 0 if that is none either.
///
/// `again` gets the directions of `a` and `b`, and `with` as it is.
#[inline(always)]
pub(crate) fn rescued<R: Real, W: Copy>(
    value: R,
    (a, b): (Vector<R>, Vector<R>),
    with: W,
    again: impl FnOnce(W, Vector<R>, Vector<R>) -> R,
) -> R {
    if value.is_nan() {
        rescue(value, a[0], a[1], a[2], b[0], b[1], b[2], with, again)
    } else {
        value
    }
}

/// Out of the way, so that what usually happens stays small. It takes numbers: vectors would be
/// passed in memory, and be kept there all the way before, for the case that this is called.
#[cold]
#[inline(never)]
#[allow(clippy::too_many_arguments)]
fn rescue<R: Real, W>(
    nan: R,
    a_x: R,
    a_y: R,
    a_z: R,
    b_x: R,
    b_y: R,
    b_z: R,
    with: W,
    again: impl FnOnce(W, Vector<R>, Vector<R>) -> R,
) -> R {
    let (a, b) = ([a_x, a_y, a_z], [b_x, b_y, b_z]);
    if a.into_iter().chain(b).any(R::is_nan) {
        return nan;
    }
    let value = again(with, tamed(a), tamed(b));
    if value.is_nan() { lit(0.0) } else { value }
}
