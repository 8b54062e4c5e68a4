//! Three components in the tangent frame, z along the normal.

use crate::real::{Real, lit};

/// A vector in the tangent frame: along the tangent, the bitangent and the normal.
///
/// `glam::Vec3` turns into it by itself wherever `impl Into<Vector<R>>` is asked for.
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
