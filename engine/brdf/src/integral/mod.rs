//! Integrals over the hemisphere, and figures that follow from them.
//!
//! | symbol | function | how |
//! |---|---|---|
//! | ∫ D dω | [`integral_d_ggx`] | closed form, 1 to 2 |
//! | ∫ D cos θ dω | [`integral_d_cos_ggx`] | 1 |
//! | ∫ D G₁ v·m dm / N·V | [`integral_g1_d_ggx`] | quadrature; the weak furnace: 1 |
//! | E(μ) | [`albedo_ggx`], [`albedo_ggx_separable`], [`albedo_ggx_divided_twice`] | quadrature |
//! | share of a disc | [`share_ratio_above`] | closed form |
//!
//! E(μ) is the directional albedo with F = 1: what of the light from one direction leaves again after a
//! single mirror. What is missing from 1 was mirrored down and lost; [`energy`](crate::energy) puts it back.

mod albedo;
mod furnace;
mod rule;

pub use albedo::*;
pub use furnace::integral_g1_d_ggx;
pub(crate) use rule::average_nodes;

use crate::real::{Real, lit};
use crate::term::{ALPHA, Param, Term, entry};
use std::f64::consts::PI;

pub(crate) const TERMS: &[Term] = &[
    INTEGRAL_D_GGX,
    INTEGRAL_D_COS_GGX,
    furnace::INTEGRAL_G1_D_GGX,
    albedo::ALBEDO_GGX,
    albedo::ALBEDO_GGX_SEPARABLE,
    albedo::ALBEDO_GGX_DIVIDED_TWICE,
    SHARE_RATIO_ABOVE,
];

/// ∫ D dω of GGX: the area of all facets over that of the surface.
///
/// ```text
/// ∫ D dω = 1 + α² atanh(s)/s,    s = sqrt(1 − α²)
/// ```
///
/// - *Source*: closed form, from Walter et al. 2007, eq. 33.
/// - *Arguments*: `alpha` α = roughness² in [0, 1].
/// - *Value*: 1 (α = 0) to 2 (α = 1), and on for α > 1 with atan in place of atanh. It is not 1:
///   only ∫ D cos θ is.
/// - *Outside*: the sign of α is ignored.
/// - *Error*: 2.3 ulp in f32, 2.1 in f64.
///
/// ```
/// assert_eq!(brdf::integral_d_ggx(1.0), 2.0); // the roughest surface has twice the area
/// assert!((brdf::integral_d_ggx(0.16f64) - 1.06533492660).abs() < 1e-11);
/// ```
pub fn integral_d_ggx<R: Real>(alpha: R) -> R {
    let one = lit::<R>(1.0);
    let a = alpha.abs().bounded();
    if a == lit(0.0) {
        return one;
    }
    let s2 = (one - a) * (one + a);
    let s = (one - a).abs().sqrt() * (one + a).sqrt();
    let ratio = if s2 > lit(0.75) {
        ((one + s) / a).ln() / s
    } else if s2 > lit(0.0) {
        lit::<R>(0.5) * (lit::<R>(2.0) * s / (one - s)).ln_1p() / s
    } else if s2 < lit(0.0) {
        s.atan() / s
    } else {
        one + s
    };
    one + a * (a * ratio)
}

const INTEGRAL_D_GGX: Term = entry!(
    integral_d_ggx(alpha: ALPHA),
    symbol: "∫D", latex: r"\int D", cost: 40,
    doc: "integral of the GGX distribution over the hemisphere: facet area per surface area, 1 to 2",
    source: "closed form, from Walter et al. 2007, eq. 33",
    wgsl: Some("fn lobe_integral_d_ggx(alpha: f32) -> f32 {
    let s2 = (1.0 - alpha) * (1.0 + alpha);
    if (alpha <= 0.0) { return 1.0; }
    if (s2 < 0.001) { return 1.0 + alpha * alpha * (1.0 + s2 / 3.0); }
    let s = sqrt(s2);
    return 1.0 + alpha * alpha * log((1.0 + s) / alpha) / s;
}")
);

/// ∫ D cos θ dω of GGX: what normalises D.
///
/// ```text
/// ∫ D cos θ dω = 1
/// ```
///
/// - *Source*: Walter et al. 2007, eq. 33.
/// - *Arguments*: `alpha` α = roughness² in [0, 1].
/// - *Value*: 1 for every α.
/// - *Outside*: 1, too.
/// - *Error*: none.
pub fn integral_d_cos_ggx<R: Real>(alpha: R) -> R {
    if alpha.is_nan() { alpha } else { lit(1.0) }
}

const INTEGRAL_D_COS_GGX: Term = entry!(
    integral_d_cos_ggx(alpha: ALPHA),
    symbol: "∫D cos θ", latex: r"\int D \cos\theta", cost: 1,
    doc: "integral of the GGX distribution times the cosine: 1, which is its normalisation",
    source: "Walter et al. 2007, eq. 33",
    wgsl: Some("fn lobe_integral_d_cos_ggx(alpha: f32) -> f32 {
    return 1.0;
}")
);

/// Share of the lit, visible disc of a sphere where a second division by 4 N·L N·V changes the
/// value by more than `ratio`.
///
/// ```text
/// share = min(1, 1/(4 ratio cos²(β/2)))
/// ```
///
/// - *Source*: closed form: on that part of the disc N·L N·V is distributed uniformly in image
///   area between 0 and cos²(β/2).
/// - *Arguments*: `ratio` > 0; `light_deg` β in degrees, 0 to 180.
/// - *Value*: 0 to 1, for a distant light and an orthographic view.
/// - *Outside*: `ratio` ≤ 0 gives 1.
/// - *Error*: 5.9 ulp in f32, 5.3 in f64.
///
/// ```
/// // With the light behind the eye a quarter of the ball is too bright, and the rest too dark.
/// assert_eq!(brdf::share_ratio_above(1.0, 0.0), 0.25);
/// // With the light at the side half of what is lit.
/// assert!((brdf::share_ratio_above(1.0f64, 90.0) - 0.5).abs() < 1e-15);
/// ```
pub fn share_ratio_above<R: Real>(ratio: R, light_deg: R) -> R {
    if ratio <= lit(0.0) {
        return lit(1.0);
    }
    // The cosine of half the angle; close to 180° the sine of what is missing keeps its digits.
    let half = lit::<R>(PI / 360.0);
    let light_deg = light_deg.bounded();
    let c = if light_deg > lit(90.0) {
        ((lit::<R>(180.0) - light_deg) * half).sin()
    } else {
        (light_deg * half).cos()
    };
    (lit::<R>(0.25) / (ratio * (c * c))).at_most(lit(1.0))
}

const RATIO: Param = Param {
    name: "ratio",
    range: (0.25, 10.0),
    unit: "1",
    meaning: "factor by which a second division changes the value",
};
const LIGHT_DEG: Param = Param {
    name: "light_deg",
    range: (0.0, 150.0),
    unit: "deg",
    meaning: "angle between the light and the view",
};

const SHARE_RATIO_ABOVE: Term = entry!(
    share_ratio_above(ratio: RATIO, light_deg: LIGHT_DEG),
    symbol: "share", latex: r"\mathrm{share}", cost: 20,
    doc: "share of the lit, visible disc of a sphere where 1/(4 N·L N·V) exceeds a ratio",
    source: "closed form: N·L N·V is uniform in image area on (0, cos²(light/2))",
    wgsl: Some("fn lobe_share_ratio_above(ratio: f32, light_deg: f32) -> f32 {
    if (ratio <= 0.0) { return 1.0; }
    let c = cos(light_deg * 0.0087266462599716479);
    return min(0.25 / (ratio * c * c), 1.0);
}")
);
