//! The half vector without the half vector: cosines from cosines; Rusinkiewicz' coordinates; α filtered.
//!
//! | symbol | item | source |
//! |---|---|---|
//! | N·H | [`n_dot_h_from`] | Hammon 2017 |
//! | V·H | [`v_dot_h_from`] | Hammon 2017 |
//! | θ_h, θ_d, φ_d | [`Rusinkiewicz`] | Rusinkiewicz 1998 |
//! | α′ | [`alpha_filtered`] | Tokuyoshi and Kaplanyan 2019, eq. 5 |
//!
//! The identities are exact in algebra, need the cosine of *light and view* under the root (not N·L, a
//! mistake in circulation), and are hazardous near the highlight: see [`n_dot_h_from`].

use crate::real::{Real, lit, zero_unless_nan};
use crate::term::{ALPHA, L_DOT_V, N_DOT_L, N_DOT_V, Param, Term, entry};
use crate::vector::{Vector, add, normalize, reflect};

pub(crate) const TERMS: &[Term] = &[N_DOT_H_FROM, V_DOT_H_FROM, ALPHA_FILTERED];

/// N·H from the three other cosines.
///
/// ```text
/// N·H = (N·L + N·V)/|L + V|,    |L + V| = sqrt(2 + 2 L·V)
/// ```
///
/// - *Source*: Hammon 2017 (GDC).
/// - *Arguments*: `n_dot_l` N·L in [0, 1]; `n_dot_v` N·V in [0, 1]; `l_dot_v` L·V in [−1, 1].
/// - *Value*: 0 to 1.
/// - *Outside*: above 1 it counts as 1; where L = −V, or neither direction is above the horizon,
///   it is 0; L·V is brought into [−1, 1].
/// - *Error*: 2.9 ulp in f32, 2.5 in f64 — of N·H, which is not what matters.
/// - *Right and wrong*: exact in algebra and hazardous in arithmetic: near the highlight N·H is
///   almost 1, and D of a smooth surface depends on 1 − N·H, of which this keeps few digits. In f32
///   it is wrong by factors at small α. From vectors: [`Ggx::d_between`](crate::Ggx::d_between).
///
/// ```
/// let n_dot_h: f64 = brdf::n_dot_h_from(0.8, 0.6, 0.96);
/// assert!((n_dot_h - 1.4 / 3.92f64.sqrt()).abs() < 1e-15);
/// ```
#[inline(always)]
pub fn n_dot_h_from<R: Real>(n_dot_l: R, n_dot_v: R, l_dot_v: R) -> R {
    let sum = n_dot_l.bounded() + n_dot_v.bounded();
    if sum <= lit(0.0) {
        return zero_unless_nan([n_dot_l, n_dot_v, l_dot_v]);
    }
    let length2 = lit::<R>(2.0) + lit::<R>(2.0) * l_dot_v.at_least(lit(-1.0)).at_most(lit(1.0));
    (sum / length2.sqrt()).at_most(lit(1.0))
}

const N_DOT_H_FROM: Term = entry!(
    n_dot_h_from(n_dot_l: N_DOT_L, n_dot_v: N_DOT_V, l_dot_v: L_DOT_V),
    symbol: "N·H", latex: r"N \cdot H", cost: 9,
    doc: "cosine between normal and half vector, from the three other cosines",
    source: "Hammon 2017",
    wgsl: Some("fn lobe_n_dot_h_from(n_dot_l: f32, n_dot_v: f32, l_dot_v: f32) -> f32 {
    let s = n_dot_l + n_dot_v;
    if (s <= 0.0) { return 0.0; }
    return min(s / sqrt(max(2.0 + 2.0 * l_dot_v, 1.0e-30)), 1.0);
}")
);

/// V·H = L·H from L·V: the cosine of half the angle.
///
/// ```text
/// V·H = |L + V|/2 = sqrt((1 + L·V)/2)
/// ```
///
/// - *Source*: Hammon 2017 (GDC).
/// - *Arguments*: `n_dot_l` N·L in [0, 1]; `n_dot_v` N·V in [0, 1]; `l_dot_v` L·V in [−1, 1].
/// - *Value*: 0 to 1.
/// - *Outside*: L·V is brought into [−1, 1]. The cosines to the normal do not enter; they are
///   arguments so that it is called like [`n_dot_h_from`].
/// - *Error*: 0.9 ulp.
#[inline(always)]
pub fn v_dot_h_from<R: Real>(n_dot_l: R, n_dot_v: R, l_dot_v: R) -> R {
    let unused = zero_unless_nan([n_dot_l, n_dot_v]);
    unused + (lit::<R>(0.5) + lit::<R>(0.5) * l_dot_v.at_least(lit(-1.0)).at_most(lit(1.0))).sqrt()
}

const V_DOT_H_FROM: Term = entry!(
    v_dot_h_from(n_dot_l: N_DOT_L, n_dot_v: N_DOT_V, l_dot_v: L_DOT_V),
    symbol: "V·H", latex: r"V \cdot H", cost: 5,
    doc: "cosine between view and half vector, from the cosine between light and view",
    source: "Hammon 2017",
    wgsl: Some("fn lobe_v_dot_h_from(n_dot_l: f32, n_dot_v: f32, l_dot_v: f32) -> f32 {
    return sqrt(0.5 + 0.5 * clamp(l_dot_v, -1.0, 1.0));
}")
);

/// α widened by the variance of the normal within a pixel: specular anti-aliasing.
///
/// ```text
/// α′² = min(1, α² + min(2 σ², 0.18))
/// ```
///
/// - *Source*: Tokuyoshi and Kaplanyan 2019, eq. 5; Real-Time Rendering, 4th edition, eq.
///   9.76.
/// - *Arguments*: `alpha` α = roughness² in [0, 1]; `variance` σ² of the slopes within a pixel, ≥
///   0.
/// - *Value*: α to 1.
/// - *Outside*: a variance below 0 counts as 0; α is brought into [0, 1].
/// - *Error*: 1.1 ulp.
///
/// σ² is the variance of the slopes under the pixel's filter; 0.18 keeps a pixel that holds an
/// edge from turning everything rough.
///
/// ```
/// // A bumpy mirror far away looks like a rough one.
/// assert_eq!(brdf::alpha_filtered(0.0f64, 0.02), 0.2);
/// assert_eq!(brdf::alpha_filtered(0.5f64, 0.0), 0.5);
/// ```
#[inline(always)]
pub fn alpha_filtered<R: Real>(alpha: R, variance: R) -> R {
    let kernel = (lit::<R>(2.0) * variance.at_least(lit(0.0))).at_most(lit(0.18));
    (alpha.clamp_unit().squared() + kernel)
        .at_most(lit(1.0))
        .sqrt()
}

const VARIANCE: Param = Param {
    name: "variance",
    range: (0.0, 0.2),
    unit: "1",
    meaning: "variance of the normal's slopes within a pixel",
};

const ALPHA_FILTERED: Term = entry!(
    alpha_filtered(alpha: ALPHA, variance: VARIANCE),
    symbol: "α′", latex: r"\alpha'", cost: 9,
    doc: "alpha widened by the variance of the normal within a pixel (specular anti-aliasing)",
    source: "Tokuyoshi and Kaplanyan 2019, eq. 5; Real-Time Rendering 4, eq. 9.76",
    wgsl: Some("fn lobe_alpha_filtered(alpha: f32, variance: f32) -> f32 {
    return sqrt(min(alpha * alpha + min(2.0 * max(variance, 0.0), 0.18), 1.0));
}")
);

/// Rusinkiewicz coordinates of an isotropic BRDF, in radians: the half vector's tilt, and where the light
/// is around it.
///
/// In them a highlight is a function of θ_h, and the Fresnel effect one of θ_d: slices and measured
/// tables of BRDFs are laid out by them.
///
/// ```
/// use brdf::Rusinkiewicz;
/// let (l, v) = ([0.6f64, 0.0, 0.8], [0.0, 0.6, 0.8]);
/// let slice = Rusinkiewicz::new(l, v);
/// // cos θ_h is N·H, and cos θ_d is V·H.
/// let l_dot_v = 0.64;
/// assert!((slice.theta_h.cos() - brdf::n_dot_h_from(0.8, 0.8, l_dot_v)).abs() < 1e-15);
/// assert!((slice.theta_d.cos() - brdf::v_dot_h_from(0.8, 0.8, l_dot_v)).abs() < 1e-15);
/// // And back: the same pair, turned around the normal.
/// let (l, v) = slice.directions();
/// assert!((l[2] - 0.8).abs() < 1e-15 && (v[2] - 0.8).abs() < 1e-15);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rusinkiewicz<R> {
    /// Angle between the normal and the half vector, 0 to π/2 for directions above the horizon.
    pub theta_h: R,
    /// Angle between the half vector and the light (or the view), 0 to π/2.
    pub theta_d: R,
    /// Azimuth of the light around the half vector, −π to π, 0 where the light leans away from the normal
    /// in the plane of normal and half vector. A reciprocal BRDF has the same value at φ_d ± π.
    pub phi_d: R,
}

impl<R: Real> Rusinkiewicz<R> {
    /// Coordinates of a light and a view.
    ///
    /// - *Source*: Rusinkiewicz 1998.
    /// - *Arguments*: `l` and `v` the directions to light and viewer in the tangent frame, of length 1.
    /// - *Value*: three angles in radians. Small ones are small differences of vectors, not of cosines.
    /// - *Outside*: where l = −v there is no half vector, and the normal stands in for it; where l = v
    ///   φ_d means nothing.
    pub fn new(l: impl Into<Vector<R>>, v: impl Into<Vector<R>>) -> Rusinkiewicz<R> {
        let l = l.into();
        let h = normalize(add(l, v.into()));
        let across = h[0].hypot(h[1]);
        let (cos, sin) = if across > lit(0.0) {
            (h[0] / across, h[1] / across)
        } else {
            (lit(1.0), lit(0.0))
        };
        // Turned so that h lies in the xz plane, then so that it is the pole.
        let x = cos * l[0] + sin * l[1];
        let y = cos * l[1] - sin * l[0];
        let d = [x * h[2] - l[2] * across, y, x * across + l[2] * h[2]];
        Rusinkiewicz {
            theta_h: across.atan2(h[2]),
            theta_d: d[0].hypot(d[1]).atan2(d[2]),
            phi_d: d[1].atan2(d[0]),
        }
    }

    /// A light and a view with these coordinates, the half vector in the xz plane.
    ///
    /// - *Source*: Rusinkiewicz 1998, the other way.
    /// - *Value*: light and view of length 1 in the tangent frame; either may lie below the horizon.
    pub fn directions(self) -> (Vector<R>, Vector<R>) {
        let (sin_h, cos_h) = (self.theta_h.sin(), self.theta_h.cos());
        let sin_d = self.theta_d.sin();
        let d = [
            sin_d * self.phi_d.cos(),
            sin_d * self.phi_d.sin(),
            self.theta_d.cos(),
        ];
        let l = [
            d[0] * cos_h + d[2] * sin_h,
            d[1],
            d[2] * cos_h - d[0] * sin_h,
        ];
        (l, reflect(l, [sin_h, lit(0.0), cos_h]))
    }
}
