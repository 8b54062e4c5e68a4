//! G₁, what one direction sees of the facets turned to it, and 1 − G₁.

use super::lambda::{cot_over_alpha, lambda_beckmann};
use super::{projected, sine};
use crate::real::{Real, lit};
use crate::term::{ALPHA, N_DOT_X, Term, entry};

/// Smith's masking G₁ of GGX.
///
/// ```text
/// G₁ = 2 / (1 + sqrt(1 + α² tan²θ)) = 2 c / (c + sqrt(c² + α² s²)),    c = cos θ = N·X, s = sin θ
/// ```
///
/// - *Source*: Walter et al. 2007, eq. 34; Heitz 2014, eq. 43 with 72.
/// - *Arguments*: `n_dot_x` the cosine N·X of the direction in [0, 1]; `alpha` α = roughness² in
///   [0, 1].
/// - *Value*: 0 at grazing to 1 at normal incidence.
/// - *Outside*: at or below the horizon 0; a cosine above 1 counts as 1; only α² counts, any α ≥
///   0.
/// - *Error*: 5.3 ulp in f32, 4.3 in f64; of 1 − G₁ see [`one_minus_g1_ggx`].
///
/// ```
/// // Half of the facets that are turned to a view are seen where tan θ = sqrt(8)/α.
/// let alpha = 0.5f64;
/// let tan = 8f64.sqrt() / alpha;
/// assert!((brdf::g1_ggx(1.0 / (1.0 + tan * tan).sqrt(), alpha) - 0.5).abs() < 1e-15);
/// ```
#[inline(always)]
pub fn g1_ggx<R: Real>(n_dot_x: R, alpha: R) -> R {
    if n_dot_x <= lit(0.0) {
        return lit(0.0);
    }
    let c = n_dot_x.at_most(lit(1.0));
    lit::<R>(2.0) * (c / (c + projected(c, alpha)))
}

pub(super) const G1_GGX: Term = entry!(
    g1_ggx(n_dot_x: N_DOT_X, alpha: ALPHA),
    symbol: "G₁", latex: r"G_1", cost: 12,
    doc: "Smith's masking of GGX, 0 to 1",
    source: "Walter et al. 2007, eq. 34; Heitz 2014, eq. 43",
    wgsl: Some("fn lobe_g1_ggx(n_dot_x: f32, alpha: f32) -> f32 {
    if (n_dot_x <= 0.0) { return 0.0; }
    let c = min(n_dot_x, 1.0);
    return 2.0 * c / (c + sqrt(c * c + alpha * alpha * (1.0 - c) * (1.0 + c)));
}")
);

/// Smith's masking G₁ of Beckmann.
///
/// ```text
/// G₁ = 1/(1 + Λ) = 2 / (1 + erf(a) + exp(−a²)/(a sqrt(π))),    a = 1/(α tan θ)
/// ```
///
/// - *Source*: Walter et al. 2007, eq. 26; Heitz 2014, eq. 43.
/// - *Arguments*: `n_dot_x` the cosine N·X of the direction in [0, 1]; `alpha` α = roughness² in
///   [0, 1].
/// - *Value*: 0 at grazing to 1 at normal incidence.
/// - *Outside*: at or below the horizon 0; a cosine above 1 counts as 1; only α² counts, any α ≥
///   0.
/// - *Error*: 11.2 ulp in f32, 10.0 in f64.
pub fn g1_beckmann<R: Real>(n_dot_x: R, alpha: R) -> R {
    lit::<R>(1.0) / (lit::<R>(1.0) + lambda_beckmann(n_dot_x, alpha))
}

pub(super) const G1_BECKMANN: Term = entry!(
    g1_beckmann(n_dot_x: N_DOT_X, alpha: ALPHA),
    symbol: "G₁", latex: r"G_1", cost: 62,
    doc: "Smith's masking of the Beckmann distribution, 0 to 1",
    source: "Walter et al. 2007, eq. 26; Heitz 2014, eq. 43",
    wgsl: Some("fn lobe_g1_beckmann(n_dot_x: f32, alpha: f32) -> f32 {
    return 1.0 / (1.0 + lobe_lambda_beckmann(n_dot_x, alpha));
}"),
    needs: ["lambda_beckmann"]
);

/// Walter's rational fit of G₁ of Beckmann.
///
/// ```text
/// G₁ ≈ (3.535 a + 2.181 a²) / (1 + 2.276 a + 2.577 a²)    where a < 1.6
///      1                                                  elsewhere,    a = 1/(α tan θ)
/// ```
///
/// - *Source*: Walter et al. 2007, eq. 27.
/// - *Arguments*: `n_dot_x` the cosine N·X of the direction in [0, 1]; `alpha` α = roughness² in
///   [0, 1].
/// - *Value*: 0 to 1.00006.
/// - *Outside*: at or below the horizon 0; a cosine above 1 counts as 1; only α² counts, any α ≥
///   0.
/// - *Error*: 5.0 ulp of the fit in f32, 4.0 in f64; the fit is within 0.32 % of [`g1_beckmann`].
/// - *Right and wrong*: it exceeds 1 (by 6e-5) for a between 1.5481 and 1.6, and jumps at 1.6,
///   where the exact one is 0.9982.
///
/// ```
/// // Just below the end of the fit it is no share.
/// let cosine = |a: f64, alpha: f64| a * alpha / (1.0 + (a * alpha).powi(2)).sqrt();
/// assert!(brdf::g1_beckmann_rational(cosine(1.59, 0.3), 0.3) > 1.00005);
/// assert!(brdf::g1_beckmann(cosine(1.59, 0.3), 0.3) < 0.9985);
/// ```
#[inline(always)]
pub fn g1_beckmann_rational<R: Real>(n_dot_x: R, alpha: R) -> R {
    if n_dot_x <= lit(0.0) {
        return lit(0.0);
    }
    let c = n_dot_x.at_most(lit(1.0));
    let alpha = alpha.bounded().abs();
    let t = alpha * sine(c);
    if t == lit(0.0) || c / t >= lit(1.6) {
        return lit(1.0);
    }
    let a = cot_over_alpha(c, alpha).0;
    a * (lit::<R>(3.535) + lit::<R>(2.181) * a)
        / (lit::<R>(1.0) + a * (lit::<R>(2.276) + lit::<R>(2.577) * a))
}

pub(super) const G1_BECKMANN_RATIONAL: Term = entry!(
    g1_beckmann_rational(n_dot_x: N_DOT_X, alpha: ALPHA),
    symbol: "G₁", latex: r"G_1", cost: 16,
    doc: "Walter's rational fit of Smith's masking for Beckmann (slightly above 1 just below a = 1.6)",
    source: "Walter et al. 2007, eq. 27",
    wgsl: Some("fn lobe_g1_beckmann_rational(n_dot_x: f32, alpha: f32) -> f32 {
    if (n_dot_x <= 0.0) { return 0.0; }
    let c = min(n_dot_x, 1.0);
    let t = alpha * sqrt(max((1.0 - c) * (1.0 + c), 0.0));
    if (c >= 1.6 * t) { return 1.0; }
    let a = c / t;
    return a * (3.535 + 2.181 * a) / (1.0 + a * (2.276 + 2.577 * a));
}")
);

/// 1 − G₁ of GGX: of the facets turned to a direction, the share hidden from it.
///
/// ```text
/// 1 − G₁ = Λ / (1 + Λ) = (α s / (c + sqrt(c² + α² s²)))²,    c = N·X, s² = 1 − c²
/// ```
///
/// - *Source*: Heitz 2014, eq. 43 with 72.
/// - *Arguments*: `n_dot_x` the cosine N·X of the direction in [0, 1]; `alpha` α = roughness² in
///   [0, 1].
/// - *Value*: 0 at normal incidence to 1 at grazing.
/// - *Outside*: at or below the horizon 1; a cosine above 1 counts as 1; only α² counts.
/// - *Error*: 8.1 ulp in f32, 7.3 in f64, also where G₁ is almost 1 and a difference from 1 has no
///   digits left.
///
/// ```
/// // Of so little a difference from 1 has no digits left in single precision.
/// let (n_dot_x, alpha) = (0.99f32, 0.001);
/// assert_eq!(1.0 - brdf::g1_ggx(n_dot_x, alpha), 0.0);
/// let hidden = brdf::one_minus_g1_ggx(n_dot_x, alpha);
/// assert!((hidden / 5.0760e-9 - 1.0).abs() < 1e-4);
/// ```
#[inline(always)]
pub fn one_minus_g1_ggx<R: Real>(n_dot_x: R, alpha: R) -> R {
    if n_dot_x <= lit(0.0) {
        return lit(1.0);
    }
    let c = n_dot_x.at_most(lit(1.0));
    let across = alpha.bounded() * sine(c);
    (across / (c + c.hypot(across))).squared()
}

pub(super) const ONE_MINUS_G1_GGX: Term = entry!(
    one_minus_g1_ggx(n_dot_x: N_DOT_X, alpha: ALPHA),
    symbol: "1 − G₁", latex: r"1 - G_1", cost: 13,
    doc: "share of the facets of GGX turned to a direction that is hidden from it, 0 to 1",
    source: "Heitz 2014, eq. 43 and 72",
    wgsl: Some("fn lobe_one_minus_g1_ggx(n_dot_x: f32, alpha: f32) -> f32 {
    if (n_dot_x <= 0.0) { return 1.0; }
    let c = min(n_dot_x, 1.0);
    let a2 = alpha * alpha * (1.0 - c) * (1.0 + c);
    let s = c + sqrt(c * c + a2);
    return a2 / (s * s);
}")
);

/// 1 − G₁ of Beckmann: of the facets turned to a direction, the share hidden from it.
///
/// ```text
/// 1 − G₁ = Λ / (1 + Λ)
/// ```
///
/// - *Source*: Heitz 2014, eq. 43.
/// - *Arguments*: `n_dot_x` the cosine N·X of the direction in [0, 1]; `alpha` α = roughness² in
///   [0, 1].
/// - *Value*: 0 at normal incidence to 1 at grazing.
/// - *Outside*: at or below the horizon 1; a cosine above 1 counts as 1; only α² counts.
/// - *Error*: 10.5 ulp in f32, 9.1 in f64.
pub fn one_minus_g1_beckmann<R: Real>(n_dot_x: R, alpha: R) -> R {
    let lambda = lambda_beckmann(n_dot_x, alpha);
    if lambda > lit(R::LARGE) {
        return lit(1.0);
    }
    lambda / (lit::<R>(1.0) + lambda)
}

pub(super) const ONE_MINUS_G1_BECKMANN: Term = entry!(
    one_minus_g1_beckmann(n_dot_x: N_DOT_X, alpha: ALPHA),
    symbol: "1 − G₁", latex: r"1 - G_1", cost: 62,
    doc: "share of the facets of Beckmann's surface turned to a direction that is hidden from it, 0 to 1",
    source: "Heitz 2014, eq. 43",
    wgsl: Some("fn lobe_one_minus_g1_beckmann(n_dot_x: f32, alpha: f32) -> f32 {
    let lambda = min(lobe_lambda_beckmann(n_dot_x, alpha), 1.0e15);
    return lambda / (1.0 + lambda);
}"),
    needs: ["lambda_beckmann"]
);
