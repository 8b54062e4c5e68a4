//! Powers of the cosines with a roughness in the place of a fitted parameter.

use super::SQRT_2_OVER_PI;
use crate::real::{Real, lit, split};
use crate::smith::above_horizon;
use crate::term::{N_DOT_L, N_DOT_V, ROUGHNESS, Term, V_DOT_H, entry};

/// Modified Kelemen, as printed.
///
/// ```text
/// G = N·L (N·V k + 1 − k)²,    k = roughness² sqrt(2/π)
/// ```
///
/// - *Source*: Stevens, part 3; of this form no other source was found.
/// - *Arguments*: `n_dot_l` N·L in [0, 1]; `n_dot_v` N·V in [0, 1]; `roughness` in [0, 1].
/// - *Value*: 0 to 1. **Not reciprocal**.
/// - *Outside*: below or on the horizon 0; other arguments are brought into their range.
/// - *Error*: 5.4 ulp in f32, 6.9 in f64.
/// - *Right and wrong*: wrong. Light and view may not change places (at roughness 0.5, cosines 0.9
///   and 0.3: 0.666, and 0.288 the other way round), tends to N·L instead of 1 for a smooth surface,
///   and reflects more than it receives (albedo 0.527, 0.373, 1.176).
#[inline(always)]
pub fn gsf_modified_kelemen<R: Real>(n_dot_l: R, n_dot_v: R, roughness: R) -> R {
    above_horizon(n_dot_l, n_dot_v, |l, v| {
        // 1 − k is down to 0.2, where each rounding error of k would count four times.
        let (r2, r2_low) = roughness.clamp_unit().two_square();
        let constant = split::<R>(SQRT_2_OVER_PI);
        let (k, k_low) = r2.two_prod(constant.0);
        let k_low = k_low + (r2_low * constant.0 + r2 * constant.1);
        let (rest, rest_low) = lit::<R>(1.0).two_sum(-k);
        (v * k + (rest + (rest_low - k_low))).squared() * l
    })
}

pub(super) const GSF_MODIFIED_KELEMEN: Term = entry!(
    gsf_modified_kelemen(n_dot_l: N_DOT_L, n_dot_v: N_DOT_V, roughness: ROUGHNESS),
    symbol: "G_mK", latex: r"G_{\mathrm{mK}}", cost: 7,
    doc: "modified Kelemen geometric shadowing as printed: wrong, not reciprocal and not energy conserving",
    source: "Stevens, part 3",
    wgsl: Some("fn lobe_gsf_modified_kelemen(n_dot_l: f32, n_dot_v: f32, roughness: f32) -> f32 {
    if (n_dot_l <= 0.0 || n_dot_v <= 0.0) { return 0.0; }
    let k = roughness * roughness * 0.797884560802865;
    let g = n_dot_v * k + (1.0 - k);
    return g * g * n_dot_l;
}")
);

/// Kurt, as printed.
///
/// ```text
/// G = N·L N·V / (V·H (N·L N·V)^roughness)
/// ```
///
/// - *Source*: Stevens, part 3; Kurt et al. 2010.
/// - *Arguments*: `n_dot_l` N·L in [0, 1]; `n_dot_v` N·V in [0, 1]; `v_dot_h` V·H = L·H in [0, 1];
///   `roughness` in [0, 1].
/// - *Value*: 0 to 1 up to roughness 0.5, above it to +∞. Reciprocal.
/// - *Outside*: at or below the horizon 0; `v_dot_h` = 0 gives +∞; other arguments are brought into
///   their range.
/// - *Error*: 2.9 ulp in f32, 2.6 in f64.
/// - *Right and wrong*: the paper's exponent is a parameter fitted to measurements, not a
///   roughness. With roughness in its place there is no upper bound above 0.5 (μ^(1 − 2 roughness) in
///   the mirror direction), and energy is gained: albedo 0.754, 1.312, 4.120, and 18.7 at roughness 1
///   and N·V = 0.05.
#[inline(always)]
pub fn gsf_kurt<R: Real>(n_dot_l: R, n_dot_v: R, v_dot_h: R, roughness: R) -> R {
    above_horizon(n_dot_l, n_dot_v, |l, v| {
        let product = (l * v).at_least(lit(R::TINY));
        product / product.powf(roughness.clamp_unit()) / v_dot_h.clamp_unit()
    })
}

pub(super) const GSF_KURT: Term = entry!(
    gsf_kurt(n_dot_l: N_DOT_L, n_dot_v: N_DOT_V, v_dot_h: V_DOT_H, roughness: ROUGHNESS),
    symbol: "G_Kurt", latex: r"G_{\mathrm{Kurt}}", cost: 24,
    doc: "Kurt geometric shadowing as printed: unbounded for roughness above 0.5, gains energy",
    source: "Stevens, part 3; Kurt et al. 2010",
    wgsl: Some("fn lobe_gsf_kurt(n_dot_l: f32, n_dot_v: f32, v_dot_h: f32, roughness: f32) -> f32 {
    if (n_dot_l <= 0.0 || n_dot_v <= 0.0) { return 0.0; }
    let p = n_dot_l * n_dot_v;
    return p / (v_dot_h * pow(p, roughness));
}")
);
