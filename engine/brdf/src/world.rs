//! GGX from vectors in world space, for callers without a tangent frame.
//!
//! | symbol | function | source |
//! |---|---|---|
//! | D | [`d_ggx_world`] | Walter et al. 2007, eq. 33 |
//! | D V F cos θ | [`specular_ggx_world`] | Walter et al. 2007, eq. 20; Heitz 2014, eq. 99 |
//!
//! World-space vectors are ill-conditioned: half a unit in the last place of n, l or v changes D of a smooth
//! surface by thousands of units. What is here is not worse than that: a search for the worst points
//! holds its error to the bound of the tangent frame or to what half a unit in each argument changes,
//! whichever is more, and finds 0.31 of that change for D and 0.71 for the whole. Where the frame is known, [`Ggx`](crate::Ggx) is
//! better, because its arguments are. All vectors are expected to have length 1.

use crate::ggx::Fresnel;
use crate::real::{Real, lit, plus, quotient, squared, times, zero_unless_nan};
use crate::smith::projected;
use crate::vector::{Vector, tamed};
use std::f64::consts::FRAC_1_PI;

/// D of GGX from a normal, a light and a view in world space.
///
/// ```text
/// D = (α m/t)²/π,    c = n·(l + v), s = |n × (l + v)|², m = s + c², t = s + α² c²
/// ```
///
/// - *Source*: Walter et al. 2007, eq. 33.
/// - *Arguments*: `n`, `l`, `v` of length 1; `alpha` α in [0, 1].
/// - *Value*: 1/sr.
/// - *Outside*: 0 below the horizon and where l = −v; for other lengths the value is that of the
///   directions wherever the squares would overflow or vanish.
/// - *Error*: 5.3 ulp in f32, 5.0 in f64; where the arguments are worse, 0.31 of what half a unit
///   in each of them changes.
///
/// Each component of the cross product is a difference of products kept exactly, and both sums of
/// the quotient keep their rounding errors.
///
/// ```
/// let (n, l, v) = ([0.0, 0.0, 1.0], [0.6, 0.0, 0.8], [-0.6, 0.0, 0.8]);
/// // The mirror direction: the peak.
/// let d: f64 = brdf::d_ggx_world(n, l, v, 0.16);
/// assert!((d - brdf::d_ggx(1.0, 0.16)).abs() < 1e-12);
/// ```
pub fn d_ggx_world<R: Real>(
    n: impl Into<Vector<R>>,
    l: impl Into<Vector<R>>,
    v: impl Into<Vector<R>>,
    alpha: R,
) -> R {
    let (n, l, v) = (n.into(), l.into(), v.into());
    rescued(d_of(n, l, v, alpha), [n, l, v], alpha, |n, l, v| {
        d_of(n, l, v, alpha.abs().at_least(lit(1e-9)).bounded())
    })
}

/// What `again` gives for the directions of the vectors, where `value` is NaN and no argument is.
#[inline(always)]
fn rescued<R: Real>(
    value: R,
    vectors: [Vector<R>; 3],
    alpha: R,
    again: impl FnOnce(Vector<R>, Vector<R>, Vector<R>) -> R,
) -> R {
    if !value.is_nan() || alpha.is_nan() || vectors.as_flattened().iter().any(|x| x.is_nan()) {
        return value;
    }
    let [n, l, v] = vectors.map(tamed);
    let value = again(n, l, v);
    if value.is_nan() { lit(0.0) } else { value }
}

fn d_of<R: Real>(n: Vector<R>, l: Vector<R>, v: Vector<R>, alpha: R) -> R {
    let h = [0, 1, 2].map(|i| l[i].two_sum(v[i]));
    let d = d_of_half(n, h, alpha);
    let size = |(high, _): (R, R)| high.abs();
    let largest = size(h[0]).at_least(size(h[1])).at_least(size(h[2]));
    if d.is_finite() || largest >= lit(1e-6) {
        return d;
    }
    if largest == lit(0.0) {
        // l = −v: there is no half vector.
        return lit(0.0);
    }
    d_of_half(
        n,
        h.map(|(high, low)| (high / largest, low / largest)),
        alpha,
    )
}

fn d_of_half<R: Real>(n: Vector<R>, h: [(R, R); 3], alpha: R) -> R {
    let c = dot_sum(n, h);
    if c.0 < lit(0.0) {
        return zero_unless_nan([c.0, alpha]);
    }
    let difference = |i: usize, j: usize| {
        let ((p, p_low), (q, q_low)) = (n[i].two_prod(h[j].0), n[j].two_prod(h[i].0));
        let (high, low) = p.two_sum(-q);
        high.two_sum(low + (p_low - q_low + (n[i] * h[j].1 - n[j] * h[i].1)))
    };
    let cross = [difference(1, 2), difference(2, 0), difference(0, 1)];
    // D depends on the square of m/t, so that each of the two is kept as a sum to its end.
    let [x, y, z] = cross.map(squared);
    let (s, c2) = (plus(plus(x, y), z), squared(c));
    let (m, t) = (plus(s, c2), plus(s, times(alpha.two_square(), c2)));
    if t.0 >= lit(R::TINY) || t.0.is_nan() {
        let (ratio, low) = quotient(m, t);
        let q = alpha * (ratio + low);
        return q * q * lit(FRAC_1_PI);
    }
    // The squares vanish before their ratio does.
    let across = cross[0].0.hypot(cross[1].0).hypot(cross[2].0);
    let along = across.hypot(alpha * c.0);
    if along == lit(0.0) {
        return lit::<R>(1.0) / along;
    }
    let q = (alpha * c.0 / along) * (c.0 / along);
    q * q * lit(FRAC_1_PI)
}

/// BRDF times N·L of a GGX surface of some material from vectors in world space.
///
/// ```text
/// f cos θ = D V F N·L
/// ```
///
/// - *Source*: Walter et al. 2007, eq. 20; Heitz 2014, eq. 99: [`d_ggx_world`], [`v_ggx`](crate::v_ggx)
///   and [`Fresnel::eval`].
/// - *Arguments*: `n`, `l`, `v` of length 1; `alpha` α in [0, 1]; `fresnel` what the facets are
///   made of.
/// - *Value*: 1/sr, red, green and blue.
/// - *Outside*: 0 where the light or the view is not above the horizon.
/// - *Error*: 19.0 ulp in f32, 18.6 in f64; where the arguments are worse, 0.71 of what half a
///   unit in each of them changes.
///
/// ```
/// use brdf::{Fresnel, Ggx, Specular};
/// // A floor, in a world where y is up, and the same in the tangent frame.
/// let fresnel = Fresnel::Schlick { f0: [0.9f64, 0.6, 0.3] };
/// let (n, l, v) = ([0.0, 1.0, 0.0], [0.6, 0.8, 0.0], [0.0, 0.6, 0.8]);
/// let rgb = brdf::specular_ggx_world(n, l, v, 0.16, &fresnel);
/// let lobe = Specular { ggx: Ggx::new(0.16), fresnel };
/// let same = lobe.eval_cos([0.6, 0.0, 0.8], [0.0, -0.8, 0.6]);
/// assert!(rgb.iter().zip(same).all(|(a, b)| (a - b).abs() < 1e-14));
/// ```
pub fn specular_ggx_world<R: Real>(
    n: impl Into<Vector<R>>,
    l: impl Into<Vector<R>>,
    v: impl Into<Vector<R>>,
    alpha: R,
    fresnel: &Fresnel<R>,
) -> [R; 3] {
    let (n, l, v) = (n.into(), l.into(), v.into());
    let value = eval_cos_of(n, l, v, alpha);
    let value = rescued(value, [n, l, v], alpha, |n, l, v| {
        eval_cos_of(n, l, v, alpha.abs().at_least(lit(1e-9)).bounded())
    });
    fresnel
        .eval(l, v)
        .map(|f| rescued(f * value, [n, l, v], alpha, |_, _, _| lit(0.0)))
}

fn eval_cos_of<R: Real>(n: Vector<R>, l: Vector<R>, v: Vector<R>, alpha: R) -> R {
    let exact = |v: Vector<R>| dot_sum(n, v.map(|x| (x, lit(0.0)))).0;
    let (n_dot_l, n_dot_v) = (exact(l), exact(v));
    if n_dot_l <= lit(0.0) || n_dot_v <= lit(0.0) {
        return zero_unless_nan([n_dot_l, n_dot_v, alpha]);
    }
    // V N·L; on the horizon V alone overflows, and its denominator vanishes.
    let cut = |c: R| c.at_most(lit(1.0));
    let (l_length, v_length) = (
        projected(cut(n_dot_l), alpha),
        projected(cut(n_dot_v), alpha),
    );
    let visible = if n_dot_v < n_dot_l {
        lit::<R>(0.5) / (v_length + n_dot_v / n_dot_l * l_length)
    } else {
        let ratio = n_dot_l / n_dot_v;
        lit::<R>(0.5) * ratio / (ratio * v_length + l_length)
    };
    d_of(n, l, v, alpha) * visible
}

/// n · h of a sum kept with its rounding errors: where it almost vanishes its digits are there.
#[inline(always)]
fn dot_sum<R: Real>(n: Vector<R>, h: [(R, R); 3]) -> (R, R) {
    let [x, y, z] = [0, 1, 2].map(|i| {
        let (p, p_low) = n[i].two_prod(h[i].0);
        (p, p_low + n[i] * h[i].1)
    });
    let (sum, low) = x.0.two_sum(y.0);
    let (sum, low2) = sum.two_sum(z.0);
    sum.two_sum((low + low2) + (x.1 + y.1 + z.1))
}
