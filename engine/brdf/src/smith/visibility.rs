//! V = G₂/(4 N·L N·V): what remains of the BRDF next to D and F.

use super::projected;
use crate::real::{Real, lit, zero_unless_nan};
use crate::term::{ALPHA, N_DOT_L, N_DOT_V, Term, entry};

/// Visibility V of GGX: G₂ of [`g2_ggx`](crate::g2_ggx), already divided by 4 N·L N·V.
///
/// ```text
/// V = G₂ / (4 N·L N·V)
///   = 0.5 / (N·L sqrt(α² + (1 − α²)(N·V)²) + N·V sqrt(α² + (1 − α²)(N·L)²))
/// ```
///
/// - *Source*: Heitz 2014, eq. 99; in this form Lagarde and de Rousiers 2014.
/// - *Arguments*: `n_dot_l` N·L in [0, 1]; `n_dot_v` N·V in [0, 1]; `alpha` α = roughness² in [0,
///   1].
/// - *Value*: 1/4 at normal incidence; 1/(2 α N·L) where N·V = 0; +∞ where both are 0. Reciprocal.
///   The BRDF is D V F: do not divide again.
/// - *Outside*: 0 below the horizon; on it the limit; a cosine above 1 counts as 1; only α²
///   counts, any α ≥ 0.
/// - *Error*: 6.3 ulp in f32, 5.9 in f64.
///
/// sqrt(α² + (1 − α²) c²) is computed as sqrt(c² + α² (1 − c)(1 + c)), without underflow.
///
/// ```
/// let v: f64 = brdf::v_ggx(0.8, 0.6, 0.16); // N·L, N·V, α
/// assert!((v - 0.513218039315).abs() < 1e-12);
/// ```
#[inline(always)]
pub fn v_ggx<R: Real>(n_dot_l: R, n_dot_v: R, alpha: R) -> R {
    if n_dot_l < lit(0.0) || n_dot_v < lit(0.0) {
        return zero_unless_nan([n_dot_l, n_dot_v, alpha]);
    }
    lit::<R>(0.5) / visibility_denominator(n_dot_l, n_dot_v, alpha)
}

/// 0.5/V, for cosines that are not negative.
#[inline(always)]
pub(crate) fn visibility_denominator<R: Real>(n_dot_l: R, n_dot_v: R, alpha: R) -> R {
    let (l, v) = (n_dot_l.at_most(lit(1.0)), n_dot_v.at_most(lit(1.0)));
    // Without the sign of −0, 1 over which would be −∞.
    (l * projected(v, alpha) + v * projected(l, alpha)).abs()
}

pub(super) const V_GGX: Term = entry!(
    v_ggx(n_dot_l: N_DOT_L, n_dot_v: N_DOT_V, alpha: ALPHA),
    symbol: "V_GGX", latex: r"V_{\mathrm{GGX}}", cost: 24,
    doc: "visibility of GGX: height-correlated G2 over 4 N·L N·V, 0 to infinity",
    source: "Heitz 2014, eq. 99; Lagarde and de Rousiers 2014",
    wgsl: Some("fn lobe_v_ggx(n_dot_l: f32, n_dot_v: f32, alpha: f32) -> f32 {
    if (n_dot_l < 0.0 || n_dot_v < 0.0) { return 0.0; }
    let l = min(n_dot_l, 1.0);
    let v = min(n_dot_v, 1.0);
    let a2 = alpha * alpha;
    return 0.5 / (l * sqrt(v * v + a2 * (1.0 - v) * (1.0 + v)) + v * sqrt(l * l + a2 * (1.0 - l) * (1.0 + l)));
}")
);

/// Visibility of GGX with the separable G₂ of [`g2_ggx_separable`](crate::g2_ggx_separable).
///
/// ```text
/// V = G₁(l) G₁(v) / (4 N·L N·V) = 1 / ((N·L + sqrt(…)) (N·V + sqrt(…)))
/// ```
///
/// - *Source*: Walter et al. 2007, eq. 34.
/// - *Arguments*: `n_dot_l` N·L in [0, 1]; `n_dot_v` N·V in [0, 1]; `alpha` α = roughness² in [0,
///   1].
/// - *Value*: 0 to +∞, never above [`v_ggx`]. Reciprocal.
/// - *Outside*: 0 below the horizon; on it the limit; a cosine above 1 counts as 1; only α²
///   counts, any α ≥ 0.
/// - *Error*: 9.5 ulp in f32, 8.6 in f64.
#[inline(always)]
pub fn v_ggx_separable<R: Real>(n_dot_l: R, n_dot_v: R, alpha: R) -> R {
    if n_dot_l < lit(0.0) || n_dot_v < lit(0.0) {
        return zero_unless_nan([n_dot_l, n_dot_v, alpha]);
    }
    let (l, v) = (n_dot_l.at_most(lit(1.0)), n_dot_v.at_most(lit(1.0)));
    // The second factor is at most 1, so that what overflows is the result.
    let half = lit::<R>(0.5);
    half / (l + projected(l, alpha)) / (half * (v + projected(v, alpha)))
}

pub(super) const V_GGX_SEPARABLE: Term = entry!(
    v_ggx_separable(n_dot_l: N_DOT_L, n_dot_v: N_DOT_V, alpha: ALPHA),
    symbol: "V_GGX", latex: r"V_{\mathrm{GGX}}", cost: 24,
    doc: "separable visibility of GGX: G1 times G1 over 4 N·L N·V, 0 to infinity",
    source: "Walter et al. 2007, eq. 34",
    wgsl: Some("fn lobe_v_ggx_separable(n_dot_l: f32, n_dot_v: f32, alpha: f32) -> f32 {
    if (n_dot_l < 0.0 || n_dot_v < 0.0) { return 0.0; }
    let l = min(n_dot_l, 1.0);
    let v = min(n_dot_v, 1.0);
    let a2 = alpha * alpha;
    return 1.0 / ((l + sqrt(l * l + a2 * (1.0 - l) * (1.0 + l))) * (v + sqrt(v * v + a2 * (1.0 - v) * (1.0 + v))));
}")
);

/// Hammon's approximation of the visibility of GGX.
///
/// ```text
/// V ≈ 0.5 / lerp(2 N·L N·V, N·L + N·V, α)
/// ```
///
/// - *Source*: Hammon 2017 (GDC).
/// - *Arguments*: `n_dot_l` N·L in [0, 1]; `n_dot_v` N·V in [0, 1]; `alpha` α = roughness² in [0,
///   1].
/// - *Value*: 0 to +∞; [`g2_ggx_hammon`](crate::g2_ggx_hammon) over 4 N·L N·V. Reciprocal.
/// - *Outside*: 0 below the horizon; on it the limit; a cosine above 1 counts as 1; α is brought
///   into [0, 1].
/// - *Error*: 3.7 ulp of the approximation in f32, 3.5 in f64; it is up to 29 % too dark.
#[inline(always)]
pub fn v_ggx_hammon<R: Real>(n_dot_l: R, n_dot_v: R, alpha: R) -> R {
    if n_dot_l < lit(0.0) || n_dot_v < lit(0.0) {
        return zero_unless_nan([n_dot_l, n_dot_v, alpha]);
    }
    let (l, v) = (n_dot_l.at_most(lit(1.0)), n_dot_v.at_most(lit(1.0)));
    let alpha = alpha.clamp_unit();
    let product = lit::<R>(2.0) * (l * v);
    lit::<R>(0.5) / (product * (lit::<R>(1.0) - alpha) + alpha * (l + v)).abs()
}

pub(super) const V_GGX_HAMMON: Term = entry!(
    v_ggx_hammon(n_dot_l: N_DOT_L, n_dot_v: N_DOT_V, alpha: ALPHA),
    symbol: "V_GGX", latex: r"V_{\mathrm{GGX}}", cost: 8,
    doc: "Hammon's approximation of the visibility of GGX, 0 to infinity",
    source: "Hammon 2017",
    wgsl: Some("fn lobe_v_ggx_hammon(n_dot_l: f32, n_dot_v: f32, alpha: f32) -> f32 {
    if (n_dot_l < 0.0 || n_dot_v < 0.0) { return 0.0; }
    let l = min(n_dot_l, 1.0);
    let v = min(n_dot_v, 1.0);
    return 0.5 / mix(2.0 * l * v, l + v, alpha);
}")
);
