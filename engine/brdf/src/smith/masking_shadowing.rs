//! G₂: what two directions see of the facets turned to both.

use super::lambda::{lambda_beckmann, lambda_ggx};
use super::{above_horizon, g1_ggx};
use crate::real::{Real, lit};
use crate::term::{ALPHA, N_DOT_L, N_DOT_V, Term, entry};

/// G₂ of GGX, masking and shadowing, correlated through the height of the facet.
///
/// ```text
/// G₂ = 1 / (1 + Λ(l) + Λ(v))
///    = 2 N·L N·V / (N·L sqrt(α² + (1 − α²)(N·V)²) + N·V sqrt(α² + (1 − α²)(N·L)²))
/// ```
///
/// - *Source*: Heitz 2014, eq. 99; Ross, Dion and Potvin 2005.
/// - *Arguments*: `n_dot_l` N·L in [0, 1]; `n_dot_v` N·V in [0, 1]; `alpha` α = roughness² in [0,
///   1].
/// - *Value*: 0 to 1; 4 N·L N·V times [`v_ggx`](crate::v_ggx). Reciprocal.
/// - *Outside*: at or below the horizon 0; a cosine above 1 counts as 1; only α² counts, any α ≥
///   0.
/// - *Error*: 6.0 ulp in f32, 5.6 in f64.
///
/// ```
/// let (l, v, alpha) = (0.8, 0.6, 0.16);
/// let g2: f64 = brdf::g2_ggx(l, v, alpha);
/// assert!((g2 - 0.985378635485).abs() < 1e-12);
/// assert!((g2 - 4.0 * l * v * brdf::v_ggx(l, v, alpha)).abs() < 1e-15);
/// ```
#[inline(always)]
pub fn g2_ggx<R: Real>(n_dot_l: R, n_dot_v: R, alpha: R) -> R {
    lit::<R>(1.0) / (lit::<R>(1.0) + (lambda_ggx(n_dot_l, alpha) + lambda_ggx(n_dot_v, alpha)))
}

pub(super) const G2_GGX: Term = entry!(
    g2_ggx(n_dot_l: N_DOT_L, n_dot_v: N_DOT_V, alpha: ALPHA),
    symbol: "G₂", latex: r"G_2", cost: 30,
    doc: "Smith's height-correlated masking-shadowing of GGX, 0 to 1",
    source: "Heitz 2014, eq. 99",
    wgsl: Some("fn lobe_g2_ggx(n_dot_l: f32, n_dot_v: f32, alpha: f32) -> f32 {
    if (n_dot_l <= 0.0 || n_dot_v <= 0.0) { return 0.0; }
    let l = min(n_dot_l, 1.0);
    let v = min(n_dot_v, 1.0);
    let a2 = alpha * alpha;
    return 2.0 * l * v / (l * sqrt(v * v + a2 * (1.0 - v) * (1.0 + v)) + v * sqrt(l * l + a2 * (1.0 - l) * (1.0 + l)));
}")
);

/// G₂ of GGX as if masking and shadowing had nothing to do with one another.
///
/// ```text
/// G₂ = G₁(l) G₁(v)
/// ```
///
/// - *Source*: Heitz 2014, eq. 98; Walter et al. 2007.
/// - *Arguments*: `n_dot_l` N·L in [0, 1]; `n_dot_v` N·V in [0, 1]; `alpha` α = roughness² in [0,
///   1].
/// - *Value*: 0 to 1, never above [`g2_ggx`]; their ratio is 1 − (1 − G₁(l))(1 − G₁(v)).
///   Reciprocal.
/// - *Outside*: at or below the horizon 0; a cosine above 1 counts as 1; only α² counts, any α ≥
///   0.
/// - *Error*: 9.5 ulp in f32, 8.3 in f64.
/// - *Right and wrong*: a facet that l sees is likely to be high, and so to be seen by v: too
///   dark, most of all where the surface is rough and both graze. Right where one of the two looks
///   along the normal.
///
/// ```
/// // What it takes away too much: as if the hidden facets were hidden twice.
/// let (l, v, alpha) = (0.3f64, 0.2, 0.5);
/// let hidden = brdf::one_minus_g1_ggx(l, alpha) * brdf::one_minus_g1_ggx(v, alpha);
/// let ratio = brdf::g2_ggx_separable(l, v, alpha) / brdf::g2_ggx(l, v, alpha);
/// assert!((ratio - (1.0 - hidden)).abs() < 1e-15);
/// ```
#[inline(always)]
pub fn g2_ggx_separable<R: Real>(n_dot_l: R, n_dot_v: R, alpha: R) -> R {
    g1_ggx(n_dot_l, alpha) * g1_ggx(n_dot_v, alpha)
}

pub(super) const G2_GGX_SEPARABLE: Term = entry!(
    g2_ggx_separable(n_dot_l: N_DOT_L, n_dot_v: N_DOT_V, alpha: ALPHA),
    symbol: "G₂", latex: r"G_2", cost: 25,
    doc: "Smith's separable masking-shadowing of GGX, G1 times G1, 0 to 1",
    source: "Heitz 2014, eq. 98; Walter et al. 2007",
    wgsl: Some("fn lobe_g2_ggx_separable(n_dot_l: f32, n_dot_v: f32, alpha: f32) -> f32 {
    return lobe_g1_ggx(n_dot_l, alpha) * lobe_g1_ggx(n_dot_v, alpha);
}"),
    needs: ["g1_ggx"]
);

/// Hammon's approximation of G₂ of GGX, without a root.
///
/// ```text
/// G₂ ≈ 2 N·L N·V / lerp(2 N·L N·V, N·L + N·V, α)
/// ```
///
/// - *Source*: Hammon 2017 (GDC).
/// - *Arguments*: `n_dot_l` N·L in [0, 1]; `n_dot_v` N·V in [0, 1]; `alpha` α = roughness² in [0,
///   1].
/// - *Value*: 0 to 1. Reciprocal.
/// - *Outside*: at or below the horizon 0; a cosine above 1 counts as 1; α is brought into [0, 1].
/// - *Error*: 4.4 ulp of the approximation in f32, 4.1 in f64.
/// - *Right and wrong*: never above [`g2_ggx`], equal at α = 0 and 1 and where a cosine is 1; up
///   to 29 % (1 − 1/√2) below it for smooth surfaces at grazing angles.
#[inline(always)]
pub fn g2_ggx_hammon<R: Real>(n_dot_l: R, n_dot_v: R, alpha: R) -> R {
    above_horizon(n_dot_l, n_dot_v, |l, v| {
        let alpha = alpha.clamp_unit();
        if alpha == lit(0.0) {
            return lit(1.0);
        }
        // Divided through by 2 N·L N·V, which underflows first.
        let mean = lit::<R>(0.5) * (lit::<R>(1.0) / l + lit::<R>(1.0) / v);
        lit::<R>(1.0) / ((lit::<R>(1.0) - alpha) + alpha * mean)
    })
}

pub(super) const G2_GGX_HAMMON: Term = entry!(
    g2_ggx_hammon(n_dot_l: N_DOT_L, n_dot_v: N_DOT_V, alpha: ALPHA),
    symbol: "G₂", latex: r"G_2", cost: 9,
    doc: "Hammon's approximation of the height-correlated G2 of GGX, 0 to 1",
    source: "Hammon 2017",
    wgsl: Some("fn lobe_g2_ggx_hammon(n_dot_l: f32, n_dot_v: f32, alpha: f32) -> f32 {
    if (n_dot_l <= 0.0 || n_dot_v <= 0.0) { return 0.0; }
    let l = min(n_dot_l, 1.0);
    let v = min(n_dot_v, 1.0);
    return 2.0 * l * v / mix(2.0 * l * v, l + v, alpha);
}")
);

/// G₂ of Beckmann, masking and shadowing, correlated through the height of the facet.
///
/// ```text
/// G₂ = 1 / (1 + Λ(l) + Λ(v))
/// ```
///
/// - *Source*: Heitz 2014, eq. 99.
/// - *Arguments*: `n_dot_l` N·L in [0, 1]; `n_dot_v` N·V in [0, 1]; `alpha` α = roughness² in [0,
///   1].
/// - *Value*: 0 to 1. Reciprocal.
/// - *Outside*: at or below the horizon 0; a cosine above 1 counts as 1; only α² counts, any α ≥
///   0.
/// - *Error*: 11.0 ulp in f32, 10.8 in f64.
pub fn g2_beckmann<R: Real>(n_dot_l: R, n_dot_v: R, alpha: R) -> R {
    lit::<R>(1.0)
        / (lit::<R>(1.0) + (lambda_beckmann(n_dot_l, alpha) + lambda_beckmann(n_dot_v, alpha)))
}

pub(super) const G2_BECKMANN: Term = entry!(
    g2_beckmann(n_dot_l: N_DOT_L, n_dot_v: N_DOT_V, alpha: ALPHA),
    symbol: "G₂", latex: r"G_2", cost: 122,
    doc: "Smith's height-correlated masking-shadowing of the Beckmann distribution, 0 to 1",
    source: "Heitz 2014, eq. 99",
    wgsl: Some("fn lobe_g2_beckmann(n_dot_l: f32, n_dot_v: f32, alpha: f32) -> f32 {
    return 1.0 / (1.0 + lobe_lambda_beckmann(n_dot_l, alpha) + lobe_lambda_beckmann(n_dot_v, alpha));
}"),
    needs: ["lambda_beckmann"]
);
