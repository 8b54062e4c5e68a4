//! Whole BRDFs from cosines, put together from the terms: [`specular_ggx`]. From vectors, which carry a
//! smooth surface's digits, see [`Specular`](crate::Specular).

use crate::d::d_ggx;
use crate::real::{Real, lit, zero_unless_nan};
use crate::smith::visibility_denominator;
use crate::term::{N_DOT_H, N_DOT_L, N_DOT_V, ROUGHNESS, Term, entry};

pub(crate) const TERMS: &[Term] = &[SPECULAR_GGX];

/// Specular BRDF of GGX with F = 1, height-correlated, from cosines.
///
/// ```text
/// f = D V = D G₂/(4 N·L N·V),    α = roughness²
/// ```
///
/// - *Source*: Cook and Torrance 1982, in the form of Walter et al. 2007, eq. 20; Heitz
///   2014, eq. 99.
/// - *Arguments*: `n_dot_l` N·L in [0, 1]; `n_dot_v` N·V in [0, 1]; `n_dot_h` N·H in [0, 1];
///   `roughness` in [0, 1].
/// - *Value*: 1/sr, 0 to +∞. Reciprocal. Multiply by F, by N·L and by the light.
/// - *Outside*: below the horizon 0; a cosine above 1 counts as 1.
/// - *Error*: 13.3 ulp in f32, 12.1 in f64: a product, and roughness² is rounded before D takes
///   its fourth power.
///
/// ```
/// use brdf::{d_ggx, specular_ggx, v_ggx};
/// let f: f64 = specular_ggx(0.8, 0.6, 0.95, 0.4);
/// assert!((f - d_ggx(0.95, 0.16) * v_ggx(0.8, 0.6, 0.16)).abs() < 1e-13);
/// ```
#[inline(always)]
pub fn specular_ggx<R: Real>(n_dot_l: R, n_dot_v: R, n_dot_h: R, roughness: R) -> R {
    let alpha = roughness
        .at_most(lit(R::LARGE))
        .at_least(lit(-R::LARGE))
        .squared();
    let d = d_ggx(n_dot_h, alpha);
    if n_dot_l < lit(0.0) || n_dot_v < lit(0.0) || d == lit(0.0) {
        return zero_unless_nan([n_dot_l, n_dot_v, d]);
    }
    // V overflows on its horizon where D V does not.
    lit::<R>(0.5) * d / visibility_denominator(n_dot_l, n_dot_v, alpha)
}

const SPECULAR_GGX: Term = entry!(
    specular_ggx(n_dot_l: N_DOT_L, n_dot_v: N_DOT_V, n_dot_h: N_DOT_H, roughness: ROUGHNESS),
    symbol: "f_GGX", latex: r"f_{\mathrm{GGX}}", cost: 37,
    doc: "specular BRDF of GGX with F = 1: D times V, in 1/sr",
    source: "Walter et al. 2007, eq. 20; Heitz 2014, eq. 99",
    wgsl: Some("fn lobe_specular_ggx(n_dot_l: f32, n_dot_v: f32, n_dot_h: f32, roughness: f32) -> f32 {
    let alpha = roughness * roughness;
    return lobe_d_ggx(n_dot_h, alpha) * lobe_v_ggx(n_dot_l, n_dot_v, alpha);
}"),
    needs: ["d_ggx", "v_ggx"]
);
