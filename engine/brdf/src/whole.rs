//! Whole BRDFs, put together from the terms.

use crate::d::d_ggx;
use crate::real::{Real, lit, zero_unless_nan};
use crate::smith::visibility_denominator;
use crate::term::{N_DOT_H, N_DOT_L, N_DOT_V, ROUGHNESS, Term, entry};

pub(crate) const TERMS: &[Term] = &[SPECULAR_GGX];

/// Specular BRDF of GGX with F = 1: D V, height-correlated, α = roughness².
///
/// Cook and Torrance 1982, eq. 2, in the form of Walter et al. 2007, eq. 20. In 1/sr, 0 to
/// +∞; 0 below the horizon.
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
