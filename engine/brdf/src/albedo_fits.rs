//! What shaders take for the directional albedo where a quadrature or a table is too much: published fits,
//! as printed.
//!
//! | function | source | within |
//! |---|---|---|
//! | [`albedo_ggx_karis`] | Karis 2014 | 0.47 of the value, at grazing |
//! | [`albedo_ggx_materialx`] | MaterialX 1.38 | 0.043 of the value |

use crate::real::{Real, lit};
use crate::term::{ALPHA, F0, N_DOT_V, ROUGHNESS, Term, entry};

pub(crate) const TERMS: &[Term] = &[ALBEDO_GGX_KARIS, ALBEDO_GGX_MATERIALX];

/// Directional albedo of GGX with Schlick's Fresnel, Karis' fit for mobile shaders.
///
/// ```text
/// E ≈ f0 (1.04 − 0.572 r − 1.04 a) + 1.04 a + 0.022 r − 0.04
/// a = min((1 − r)², 2^(−9.28 N·V)) (1 − r) + 0.0425 − 0.0275 r,    r = roughness
/// ```
///
/// - *Source*: Karis 2014, "Physically Based Shading on Mobile", after Lazarov 2013.
/// - *Arguments*: `f0` the reflectance at normal incidence in [0, 1]; `n_dot_v` N·V in [0, 1];
///   `roughness` in [0, 1].
/// - *Value*: 0 to 1, left by up to 0.02.
/// - *Outside*: arguments are brought into [0, 1].
/// - *Error*: 3.1 ulp of the fit, on the scale of 1; the fit is off by up to 0.47 of the value.
/// - *Right and wrong*: fitted to a separable G₂ (Schlick's, k = α/2), so that grazing views are
///   too dark. With f0 = 1 it is 1 − 0.55 r from every view.
#[inline(always)]
pub fn albedo_ggx_karis<R: Real>(f0: R, n_dot_v: R, roughness: R) -> R {
    let (f0, mu, r) = (
        f0.clamp_unit(),
        n_dot_v.clamp_unit(),
        roughness.clamp_unit(),
    );
    let smooth = lit::<R>(1.0) - r;
    let grazing = (lit::<R>(-9.28) * mu).exp2().at_most(smooth * smooth);
    let a = grazing * smooth + (lit::<R>(0.0425) - lit::<R>(0.0275) * r);
    let scale = lit::<R>(1.04) - lit::<R>(0.572) * r - lit::<R>(1.04) * a;
    let bias = lit::<R>(1.04) * a + (lit::<R>(0.022) * r - lit(0.04));
    f0 * scale + bias
}

const ALBEDO_GGX_KARIS: Term = entry!(
    albedo_ggx_karis(f0: F0, n_dot_v: N_DOT_V, roughness: ROUGHNESS),
    symbol: "E_Karis", latex: r"E_{\mathrm{Karis}}", cost: 40,
    doc: "Karis' fit of the directional albedo of GGX with Schlick's Fresnel",
    source: "Karis 2014, Physically Based Shading on Mobile; Lazarov 2013",
    wgsl: Some("fn lobe_albedo_ggx_karis(f0: f32, n_dot_v: f32, roughness: f32) -> f32 {
    let smooth_ = 1.0 - roughness;
    let a = min(smooth_ * smooth_, exp2(-9.28 * n_dot_v)) * smooth_ + 0.0425 - 0.0275 * roughness;
    return f0 * (1.04 - 0.572 * roughness - 1.04 * a) + 1.04 * a + 0.022 * roughness - 0.04;
}")
);

/// Directional albedo of GGX with Schlick's Fresnel, MaterialX' rational fit.
///
/// ```text
/// E ≈ f0 clamp(P₁/Q₁) + clamp(P₂/Q₂),    quotients of polynomials of degree 2 in N·V and in α
/// ```
///
/// - *Source*: MaterialX 1.38, `mx_ggx_dir_albedo_analytic`.
/// - *Arguments*: `f0` the reflectance at normal incidence in [0, 1]; `n_dot_v` N·V in [0, 1];
///   `alpha` α = roughness² in [0, 1].
/// - *Value*: 0 to 1.
/// - *Outside*: arguments are brought into [0, 1], and so are the two quotients.
/// - *Error*: 20.6 ulp of the fit in f32 on the scale of 1, 14.1 in f64; the fit, made to Monte
///   Carlo data, is within 0.043 of the value at f0 = 1.
#[inline(always)]
pub fn albedo_ggx_materialx<R: Real>(f0: R, n_dot_v: R, alpha: R) -> R {
    let (f0, x, y) = (f0.clamp_unit(), n_dot_v.clamp_unit(), alpha.clamp_unit());
    let (x2, y2) = (x * x, y * y);
    let monomials = [x, y, x * y, x2, y2, x2 * y, x * y2, x2 * y2];
    let sum = |one: f64, c: [f64; 8]| {
        let terms = monomials.iter().zip(c);
        terms.fold(lit::<R>(one), |sum, (&m, c)| sum + lit::<R>(c) * m)
    };
    let scale = sum(
        0.1003,
        [-0.6303, 9.748, -2.038, 29.34, -8.245, -26.44, 19.99, -5.448],
    ) / sum(
        1.0,
        [-1.765, 8.263, 11.53, 28.96, -7.507, -36.11, 15.86, 33.37],
    );
    let bias = sum(
        0.9345,
        [-2.323, 2.229, -3.748, 1.424, -0.7684, 1.436, 0.2913, 0.6286],
    ) / sum(
        1.0,
        [0.2281, 15.94, -55.83, 13.08, 41.26, 54.9, 300.2, -285.1],
    );
    f0 * scale.clamp_unit() + bias.clamp_unit()
}

const ALBEDO_GGX_MATERIALX: Term = entry!(
    albedo_ggx_materialx(f0: F0, n_dot_v: N_DOT_V, alpha: ALPHA),
    symbol: "E_MaterialX", latex: r"E_{\mathrm{MaterialX}}", cost: 60,
    doc: "MaterialX' rational fit of the directional albedo of GGX with Schlick's Fresnel",
    source: "MaterialX 1.38, mx_ggx_dir_albedo_analytic",
    wgsl: Some("fn lobe_albedo_ggx_materialx(f0: f32, n_dot_v: f32, alpha: f32) -> f32 {
    let x = n_dot_v;
    let y = alpha;
    let x2 = x * x;
    let y2 = y * y;
    let r = vec4<f32>(0.1003, 0.9345, 1.0, 1.0)
        + vec4<f32>(-0.6303, -2.323, -1.765, 0.2281) * x
        + vec4<f32>(9.748, 2.229, 8.263, 15.94) * y
        + vec4<f32>(-2.038, -3.748, 11.53, -55.83) * x * y
        + vec4<f32>(29.34, 1.424, 28.96, 13.08) * x2
        + vec4<f32>(-8.245, -0.7684, -7.507, 41.26) * y2
        + vec4<f32>(-26.44, 1.436, -36.11, 54.9) * x2 * y
        + vec4<f32>(19.99, 0.2913, 15.86, 300.2) * x * y2
        + vec4<f32>(-5.448, 0.6286, 33.37, -285.1) * x2 * y2;
    return f0 * clamp(r.x / r.z, 0.0, 1.0) + clamp(r.y / r.w, 0.0, 1.0);
}")
);
