//! Smith's separable G₁ G₁ of some distribution, and Schlick's fits of it.

use super::SQRT_2_OVER_PI;
use crate::real::{Real, lit};
use crate::smith::{above_horizon, g1_beckmann_rational, sine};
use crate::term::{N_DOT_L, N_DOT_V, ROUGHNESS, Term, entry};

/// 2 / (1 + sqrt(1 + a² tan²θ)).
#[inline(always)]
fn walter_g1<R: Real>(c: R, a: R) -> R {
    lit::<R>(2.0) * (c / (c + c.hypot(a * sine(c))))
}

/// Walter: G₁ G₁ of GGX with α := roughness.
///
/// ```text
/// G = G₁(l) G₁(v),    G₁(x) = 2 / (1 + sqrt(1 + roughness² tan²θ))
/// ```
///
/// - *Source*: Stevens, part 3; Walter et al. 2007, eq. 34.
/// - *Arguments*: `n_dot_l` N·L in [0, 1]; `n_dot_v` N·V in [0, 1]; `roughness` in [0, 1].
/// - *Value*: 0 to 1, 1 for a smooth surface. Reciprocal.
/// - *Outside*: below or on the horizon 0; other arguments are brought into their range.
/// - *Error*: 9.6 ulp in f32, 9.1 in f64.
/// - *Right and wrong*: the right formula with the wrong description: it is the one of GGX, not
///   "for any distribution", and takes roughness for α (albedo 0.657, 0.549, 0.530 with D at α =
///   roughness²).
#[inline(always)]
pub fn gsf_walter<R: Real>(n_dot_l: R, n_dot_v: R, roughness: R) -> R {
    above_horizon(n_dot_l, n_dot_v, |l, v| {
        let a = roughness.clamp_unit();
        walter_g1(l, a) * walter_g1(v, a)
    })
}

pub(super) const GSF_WALTER: Term = entry!(
    gsf_walter(n_dot_l: N_DOT_L, n_dot_v: N_DOT_V, roughness: ROUGHNESS),
    symbol: "G_Walter", latex: r"G_{\mathrm{Walter}}", cost: 25,
    doc: "Walter geometric shadowing: separable Smith of GGX with alpha taken as roughness",
    source: "Stevens, part 3; Walter et al. 2007, eq. 34",
    wgsl: Some("fn lobe_gsf_walter(n_dot_l: f32, n_dot_v: f32, roughness: f32) -> f32 {
    if (n_dot_l <= 0.0 || n_dot_v <= 0.0) { return 0.0; }
    let l = min(n_dot_l, 1.0);
    let v = min(n_dot_v, 1.0);
    let a2 = roughness * roughness;
    let g_l = 2.0 / (1.0 + sqrt(1.0 + a2 * (1.0 - l) * (1.0 + l) / (l * l)));
    let g_v = 2.0 / (1.0 + sqrt(1.0 + a2 * (1.0 - v) * (1.0 + v) / (v * v)));
    return g_l * g_v;
}")
);

/// Smith-Beckmann: Walter's rational G₁ for both directions, α = roughness².
///
/// ```text
/// G = G₁(l) G₁(v),    G₁ as in g1_beckmann_rational
/// ```
///
/// - *Source*: Stevens, part 3; Walter et al. 2007, eq. 27.
/// - *Arguments*: `n_dot_l` N·L in [0, 1]; `n_dot_v` N·V in [0, 1]; `roughness` in [0, 1].
/// - *Value*: 0 to 1.00013. Reciprocal.
/// - *Outside*: below or on the horizon 0; other arguments are brought into their range.
/// - *Error*: 10.0 ulp in f32, 9.1 in f64.
/// - *Right and wrong*: right to 0.32 % for each direction; exceeds 1 (by up to 1.2e-4) near a =
///   1.6. Paired with D of GGX, which it does not belong to, it gains energy (albedo 0.759, 1.034,
///   1.475).
#[inline(always)]
pub fn gsf_smith_beckmann<R: Real>(n_dot_l: R, n_dot_v: R, roughness: R) -> R {
    let alpha = roughness.clamp_unit().squared();
    g1_beckmann_rational(n_dot_l, alpha) * g1_beckmann_rational(n_dot_v, alpha)
}

pub(super) const GSF_SMITH_BECKMANN: Term = entry!(
    gsf_smith_beckmann(n_dot_l: N_DOT_L, n_dot_v: N_DOT_V, roughness: ROUGHNESS),
    symbol: "G_Beckmann", latex: r"G_{\mathrm{Beckmann}}", cost: 33,
    doc: "Smith-Beckmann geometric shadowing by Walter's rational fit: right to 0.32 %, slightly above 1 near its joint",
    source: "Stevens, part 3; Walter et al. 2007, eq. 27",
    wgsl: Some("fn lobe_gsf_smith_beckmann(n_dot_l: f32, n_dot_v: f32, roughness: f32) -> f32 {
    let alpha = roughness * roughness;
    return lobe_g1_beckmann_rational(n_dot_l, alpha) * lobe_g1_beckmann_rational(n_dot_v, alpha);
}"),
    needs: ["g1_beckmann_rational"]
);

/// GGX, α := roughness.
///
/// ```text
/// G = G₁(l) G₁(v),    G₁(x) = 2 c / (c + sqrt(r² + (1 − r²) c²)),    c = N·X, r = roughness
/// ```
///
/// - *Source*: Stevens, part 3; Walter et al. 2007, eq. 34.
/// - *Arguments*: `n_dot_l` N·L in [0, 1]; `n_dot_v` N·V in [0, 1]; `roughness` in [0, 1].
/// - *Value*: 0 to 1, 1 for a smooth surface. Reciprocal.
/// - *Outside*: below or on the horizon 0; other arguments are brought into their range.
/// - *Error*: 9.6 ulp in f32, 9.1 in f64.
/// - *Right and wrong*: right, and identical to [`gsf_walter`] in exact arithmetic.
#[inline(always)]
pub fn gsf_ggx<R: Real>(n_dot_l: R, n_dot_v: R, roughness: R) -> R {
    gsf_walter(n_dot_l, n_dot_v, roughness)
}

pub(super) const GSF_GGX: Term = entry!(
    gsf_ggx(n_dot_l: N_DOT_L, n_dot_v: N_DOT_V, roughness: ROUGHNESS),
    symbol: "G_GGX", latex: r"G_{\mathrm{GGX}}", cost: 25,
    doc: "GGX geometric shadowing: separable Smith with alpha taken as roughness, the same function as Walter's",
    source: "Stevens, part 3; Walter et al. 2007, eq. 34",
    wgsl: Some("fn lobe_gsf_ggx(n_dot_l: f32, n_dot_v: f32, roughness: f32) -> f32 {
    if (n_dot_l <= 0.0 || n_dot_v <= 0.0) { return 0.0; }
    let l = min(n_dot_l, 1.0);
    let v = min(n_dot_v, 1.0);
    let r2 = roughness * roughness;
    let g_l = 2.0 * l / (l + sqrt(r2 + (1.0 - r2) * l * l));
    let g_v = 2.0 * v / (v + sqrt(r2 + (1.0 - r2) * v * v));
    return g_l * g_v;
}")
);

/// Schlick's G₁ G₁: c/(c (1 − k) + k) for both directions.
#[inline(always)]
fn schlick<R: Real>(n_dot_l: R, n_dot_v: R, k: R) -> R {
    let g1 = |c: R| c / (c * (lit::<R>(1.0) - k) + k);
    g1(n_dot_l) * g1(n_dot_v)
}

/// Schlick, k = roughness².
///
/// ```text
/// G = G₁(l) G₁(v),    G₁(x) = c / (c (1 − k) + k),    k = roughness²
/// ```
///
/// - *Source*: Stevens, part 3; Schlick 1994.
/// - *Arguments*: `n_dot_l` N·L in [0, 1]; `n_dot_v` N·V in [0, 1]; `roughness` in [0, 1].
/// - *Value*: 0 to 1. Reciprocal.
/// - *Outside*: below or on the horizon 0; other arguments are brought into their range.
/// - *Error*: 5.8 ulp in f32, 5.3 in f64.
/// - *Right and wrong*: a convention: this k fits nobody's Smith function (albedo 0.608, 0.398,
///   0.348).
#[inline(always)]
pub fn gsf_schlick<R: Real>(n_dot_l: R, n_dot_v: R, roughness: R) -> R {
    above_horizon(n_dot_l, n_dot_v, |l, v| {
        schlick(l, v, roughness.clamp_unit().squared())
    })
}

pub(super) const GSF_SCHLICK: Term = entry!(
    gsf_schlick(n_dot_l: N_DOT_L, n_dot_v: N_DOT_V, roughness: ROUGHNESS),
    symbol: "G_Schlick", latex: r"G_{\mathrm{Schlick}}", cost: 12,
    doc: "Schlick geometric shadowing with k = roughness²: a convention, fits no Smith function",
    source: "Stevens, part 3; Schlick 1994",
    wgsl: Some("fn lobe_gsf_schlick(n_dot_l: f32, n_dot_v: f32, roughness: f32) -> f32 {
    if (n_dot_l <= 0.0 || n_dot_v <= 0.0) { return 0.0; }
    let k = roughness * roughness;
    return n_dot_l / (n_dot_l * (1.0 - k) + k) * (n_dot_v / (n_dot_v * (1.0 - k) + k));
}")
);

/// Schlick-Beckmann, k = roughness² sqrt(2/π).
///
/// ```text
/// G = G₁(l) G₁(v),    G₁(x) = c / (c (1 − k) + k),    k = roughness² sqrt(2/π)
/// ```
///
/// - *Source*: Stevens, part 3; Schlick 1994.
/// - *Arguments*: `n_dot_l` N·L in [0, 1]; `n_dot_v` N·V in [0, 1]; `roughness` in [0, 1].
/// - *Value*: 0 to 1. Reciprocal.
/// - *Outside*: below or on the horizon 0; other arguments are brought into their range.
/// - *Error*: 7.4 ulp in f32, 6.0 in f64.
/// - *Right and wrong*: the constant is Schlick's, but his m is the rms slope α/sqrt(2): against
///   Walter's G₁ of Beckmann the error reaches 0.43 (albedo 0.630, 0.468, 0.447).
#[inline(always)]
pub fn gsf_schlick_beckmann<R: Real>(n_dot_l: R, n_dot_v: R, roughness: R) -> R {
    above_horizon(n_dot_l, n_dot_v, |l, v| {
        schlick(l, v, roughness.clamp_unit().squared() * lit(SQRT_2_OVER_PI))
    })
}

pub(super) const GSF_SCHLICK_BECKMANN: Term = entry!(
    gsf_schlick_beckmann(n_dot_l: N_DOT_L, n_dot_v: N_DOT_V, roughness: ROUGHNESS),
    symbol: "G_SB", latex: r"G_{\mathrm{SB}}", cost: 13,
    doc: "Schlick-Beckmann geometric shadowing: a poor fit of Beckmann's Smith function (error to 0.43)",
    source: "Stevens, part 3; Schlick 1994",
    wgsl: Some("fn lobe_gsf_schlick_beckmann(n_dot_l: f32, n_dot_v: f32, roughness: f32) -> f32 {
    if (n_dot_l <= 0.0 || n_dot_v <= 0.0) { return 0.0; }
    let k = roughness * roughness * 0.797884560802865;
    return n_dot_l / (n_dot_l * (1.0 - k) + k) * (n_dot_v / (n_dot_v * (1.0 - k) + k));
}")
);

/// Schlick-GGX, k = roughness/2.
///
/// ```text
/// G = G₁(l) G₁(v),    G₁(x) = c / (c (1 − k) + k),    k = roughness/2
/// ```
///
/// - *Source*: Stevens, part 3; Karis 2013.
/// - *Arguments*: `n_dot_l` N·L in [0, 1]; `n_dot_v` N·V in [0, 1]; `roughness` in [0, 1].
/// - *Value*: 0 to 1. Reciprocal.
/// - *Outside*: below or on the horizon 0; other arguments are brought into their range.
/// - *Error*: 5.1 ulp in f32, 4.3 in f64.
/// - *Right and wrong*: Karis' k = α/2 if roughness means α: exact at α = 1, G₁ off by up to 0.14
///   at α = 0.1. For direct light his engine used (roughness + 1)²/8 (albedo 0.641, 0.504, 0.504).
#[inline(always)]
pub fn gsf_schlick_ggx<R: Real>(n_dot_l: R, n_dot_v: R, roughness: R) -> R {
    above_horizon(n_dot_l, n_dot_v, |l, v| {
        schlick(l, v, roughness.clamp_unit() * lit(0.5))
    })
}

pub(super) const GSF_SCHLICK_GGX: Term = entry!(
    gsf_schlick_ggx(n_dot_l: N_DOT_L, n_dot_v: N_DOT_V, roughness: ROUGHNESS),
    symbol: "G_SG", latex: r"G_{\mathrm{SG}}", cost: 12,
    doc: "Schlick-GGX geometric shadowing with k = roughness/2: right if roughness means alpha",
    source: "Stevens, part 3; Karis 2013",
    wgsl: Some("fn lobe_gsf_schlick_ggx(n_dot_l: f32, n_dot_v: f32, roughness: f32) -> f32 {
    if (n_dot_l <= 0.0 || n_dot_v <= 0.0) { return 0.0; }
    let k = roughness * 0.5;
    return n_dot_l / (n_dot_l * (1.0 - k) + k) * (n_dot_v / (n_dot_v * (1.0 - k) + k));
}")
);
