//! Integrals over the hemisphere, and figures that follow from them.

use crate::real::{Real, lit};
use crate::smith::{v_ggx, v_ggx_separable};
use crate::term::{ALPHA, N_DOT_V, Param, Term, entry};

pub(crate) const TERMS: &[Term] = &[
    INTEGRAL_D_GGX,
    INTEGRAL_D_COS_GGX,
    ALBEDO_GGX,
    ALBEDO_GGX_SEPARABLE,
    ALBEDO_GGX_DIVIDED_TWICE,
    SHARE_RATIO_ABOVE,
];

/// ∫ D dω of GGX, the area of all facets per macrosurface area:
/// 1 + α² atanh(s)/s, s = sqrt(1 − α²).
///
/// From 1 (α = 0) to 2 (α = 1), and on for α > 1 with atan in place of atanh. It is not 1:
/// only ∫ D cos is.
pub fn integral_d_ggx<R: Real>(alpha: R) -> R {
    let one = lit::<R>(1.0);
    let a = alpha.abs();
    if a == lit(0.0) {
        return one;
    }
    let s2 = (one - a) * (one + a);
    let s = s2.abs().sqrt();
    let ratio = if s2 > lit(0.75) {
        ((one + s) / a).ln() / s
    } else if s2 > lit(0.0) {
        lit::<R>(0.5) * (lit::<R>(2.0) * s / (one - s)).ln_1p() / s
    } else if s2 < lit(0.0) {
        s.atan() / s
    } else {
        one + s
    };
    one + a * a * ratio
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

/// ∫ D cos θ dω of GGX: 1 for every α, which is what normalises D.
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

/// Gauss-Legendre nodes and weights on [0, 1].
fn gauss_legendre(n: usize) -> Vec<(f64, f64)> {
    (0..n)
        .map(|i| {
            let mut x = libm::cos(std::f64::consts::PI * (i as f64 + 0.75) / (n as f64 + 0.5));
            let mut derivative = 1.0;
            for _ in 0..8 {
                let (mut p, mut q) = (1.0, 0.0);
                for k in 0..n {
                    let k = k as f64;
                    (p, q) = (((2.0 * k + 1.0) * x * p - k * q) / (k + 1.0), p);
                }
                derivative = n as f64 * (x * p - q) / (x * x - 1.0);
                x -= p / derivative;
            }
            (
                0.5 - 0.5 * x,
                1.0 / ((1.0 - x * x) * derivative * derivative),
            )
        })
        .collect()
}

/// ∫ D(h) w(N·L) N·L dω over the directions l above the horizon, F = 1.
///
/// In the slopes of h the region where l is above the horizon is the disc with centre tan θ
/// towards v and radius sec θ. Polar around the slope origin, r = α tan ψ.
fn directional(n_dot_v: f64, alpha: f64, weight: impl Fn(f64) -> f64) -> f64 {
    use std::f64::consts::PI;
    let mu = n_dot_v.min(1.0);
    if mu.is_nan() || alpha.is_nan() {
        return f64::NAN;
    }
    let mu = mu.max(1e-9);
    let alpha = alpha.abs().max(1e-9);
    let sin = ((1.0 - mu) * (1.0 + mu)).sqrt();
    let nodes = gauss_legendre(96);
    let steps = 192;
    let mut sum = 0.0;
    for step in 0..steps {
        let phi = PI * (f64::from(step) + 0.5) / f64::from(steps);
        let x = sin / mu * libm::cos(phi);
        let root = (1.0 + x * x).sqrt();
        let reach = if x < 0.0 { 1.0 / (root - x) } else { root + x };
        let psi_max = libm::atan(reach / alpha);
        for &(y, w) in &nodes {
            let psi = psi_max * y * (2.0 - y);
            let jacobian = psi_max * 2.0 * (1.0 - y) * w;
            let (s, c) = (libm::sin(psi), libm::cos(psi));
            let r = alpha * s / c;
            // h = (r cos φ, ·, 1)/sqrt(1 + r²) with v = (sin, 0, mu).
            let h2 = 1.0 / (1.0 + r * r);
            let vh_over_hz = mu + sin * r * libm::cos(phi);
            let nl = 2.0 * vh_over_hz * h2 - mu;
            if nl <= 0.0 || vh_over_hz <= 0.0 {
                continue;
            }
            // D cos θ_h dω_h is the slope density; dω_l = 4 V·H dω_h.
            let slope_density = s * c / PI;
            sum += jacobian * slope_density * 4.0 * vh_over_hz * weight(nl) * nl;
        }
    }
    sum * 2.0 * PI / f64::from(steps)
}

/// Directional albedo of GGX with F = 1, height-correlated: E(μ) = ∫ D V N·L dω.
///
/// By quadrature over the disc of slopes; at α = 1 it is 1 − μ ln(1 + 1/μ). 1 at `alpha = 0`
/// (a mirror); `n_dot_v` at or below 0 gives the limit at grazing.
pub fn albedo_ggx<R: Real>(n_dot_v: R, alpha: R) -> R {
    let (mu, a) = (n_dot_v.to_f64(), alpha.to_f64());
    lit(directional(mu, a, |nl| {
        v_ggx(nl, mu.max(1e-9), a.abs().max(1e-9))
    }))
}

const ALBEDO_GGX: Term = entry!(
    albedo_ggx(n_dot_v: N_DOT_V, alpha: ALPHA),
    symbol: "E_GGX", latex: r"E_{\mathrm{GGX}}", cost: 100_000,
    doc: "directional albedo of GGX with F = 1, height-correlated Smith, 0 to 1",
    source: "quadrature over the disc of slopes",
    wgsl: None
);

/// Directional albedo of GGX with F = 1 and separable G₂, never above [`albedo_ggx`].
pub fn albedo_ggx_separable<R: Real>(n_dot_v: R, alpha: R) -> R {
    let (mu, a) = (n_dot_v.to_f64(), alpha.to_f64());
    lit(directional(mu, a, |nl| {
        v_ggx_separable(nl, mu.max(1e-9), a.abs().max(1e-9))
    }))
}

const ALBEDO_GGX_SEPARABLE: Term = entry!(
    albedo_ggx_separable(n_dot_v: N_DOT_V, alpha: ALPHA),
    symbol: "E_separable", latex: r"E_{\mathrm{separable}}", cost: 100_000,
    doc: "directional albedo of GGX with F = 1, separable Smith, 0 to 1",
    source: "quadrature over the disc of slopes",
    wgsl: None
);

/// Directional albedo of the mistake that divides by 4 N·L N·V twice: ∫ D V/(4 N·L N·V) N·L dω.
///
/// Too dark when seen straight on, and far above 1 at grazing angles.
pub fn albedo_ggx_divided_twice<R: Real>(n_dot_v: R, alpha: R) -> R {
    let (mu, a) = (n_dot_v.to_f64(), alpha.to_f64());
    let mu = mu.max(1e-9);
    lit(directional(mu, a, |nl| {
        v_ggx(nl, mu, a.abs().max(1e-9)) / (4.0 * nl * mu)
    }))
}

const ALBEDO_GGX_DIVIDED_TWICE: Term = entry!(
    albedo_ggx_divided_twice(n_dot_v: N_DOT_V, alpha: ALPHA),
    symbol: "E_twice", latex: r"E_{\mathrm{twice}}", cost: 100_000,
    doc: "directional albedo of GGX when the visibility is divided by 4 N·L N·V a second time",
    source: "quadrature over the disc of slopes",
    wgsl: None
);

/// Share of the lit, visible disc of a sphere where 1/(4 N·L N·V) exceeds `ratio`:
/// min(1, 1/(4 ratio cos²(β/2))), β the angle between light and view in degrees.
///
/// On that part of the disc N·L N·V is distributed uniformly in image area between 0 and
/// cos²(β/2), for a distant light and an orthographic view. `ratio <= 0` gives 1.
pub fn share_ratio_above<R: Real>(ratio: R, light_deg: R) -> R {
    if ratio <= lit(0.0) {
        return lit(1.0);
    }
    let c = (light_deg * lit(std::f64::consts::PI / 360.0)).cos();
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
