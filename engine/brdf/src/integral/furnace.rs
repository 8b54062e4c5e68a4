//! The weak white furnace.

use super::rule::Rule;
use crate::real::{Real, lit, zero_unless_nan};
use crate::smith::sine;
use crate::term::{ALPHA, N_DOT_V, Term, entry};
use std::f64::consts::PI;

/// The weak white furnace: visible facets over the surface they cover, by quadrature of D and G₁.
///
/// ```text
/// ∫ D G₁(v) max(v·m, 0) dm / N·V = 1
/// ```
///
/// - *Source*: Heitz 2014, the weak white furnace test.
/// - *Arguments*: `n_dot_v` N·V in [0, 1]; `alpha` α = roughness² in [0, 1].
/// - *Value*: 1 for every view: in any direction the visible facets cover exactly the
///   surface. This is what fixes G₁ once D is chosen, and what a wrong pairing of the two breaks.
/// - *Outside*: below N·V = 0.001 that view is taken.
/// - *Error*: for N·V and α from 0.1 up 5.1e-6 in f32, 1.9e-14 in f64.
///
/// Over the slopes (p, q) with p = r cos φ, where v·m > 0 is the half plane r cos φ tan θ > −1. D
/// is evaluated at a cosine, which below α = 1e-4 no longer carries it.
pub fn integral_g1_d_ggx<R: Real>(n_dot_v: R, alpha: R) -> R {
    if n_dot_v.is_nan() || alpha.is_nan() {
        return zero_unless_nan([n_dot_v, alpha]);
    }
    let (zero, one, two) = (lit::<R>(0.0), lit::<R>(1.0), lit::<R>(2.0));
    let mu = n_dot_v.at_least(lit(1e-3)).at_most(one);
    let alpha = alpha.abs().at_least(lit(1e-6)).at_most(lit(1e6));
    let rule = Rule::of::<R>();
    let sin = sine(mu);
    let mut sum = zero;
    for &cos_phi in &rule.cosines {
        let cos_phi = lit::<R>(cos_phi);
        // tan ψ up to the edge of the half plane, r = α tan ψ.
        let toward = alpha * sin * cos_phi;
        let t_max = if toward < zero {
            // The half-angle tangent of atan(μ/−toward).
            mu / (-toward + toward.hypot(mu))
        } else {
            one
        };
        for &(y, weight) in &rule.radial {
            let (y, weight) = (lit::<R>(y), lit::<R>(weight));
            let t = t_max * y;
            let sec = one / (one + t * t);
            let (sin_psi, cos_psi) = (two * t * sec, (one - t) * (one + t) * sec);
            let r = alpha * sin_psi / cos_psi;
            let cos_m = one / one.hypot(r);
            // dm = cos³ dp dq, and dp dq = r dr dφ with dr = α/cos²ψ dψ, dψ = 2 sec dt.
            let area = cos_m * cos_m * cos_m * (r * alpha / (cos_psi * cos_psi)) * two * sec;
            let v_dot_m = (mu + sin * r * cos_phi) * cos_m;
            sum = sum + weight * t_max * area * v_dot_m * crate::d::d_ggx(cos_m, alpha);
        }
    }
    let turn = lit(2.0 * PI / rule.cosines.len() as f64);
    crate::smith::g1_ggx(mu, alpha) / mu * sum * turn
}

pub(super) const INTEGRAL_G1_D_GGX: Term = entry!(
    integral_g1_d_ggx(n_dot_v: N_DOT_V, alpha: ALPHA),
    symbol: "∫D G₁ v·m", latex: r"\int D G_1 (v \cdot m)", cost: 1_000_000,
    doc: "visible facet area over the surface's own, by quadrature of D and G1 of GGX: 1 for every view",
    source: "Heitz 2014, the weak white furnace test",
    wgsl: None
);
