//! Masking and shadowing by Smith's model: Λ, G₁, G₂ and the visibility V.
//!
//! | symbol | function | source |
//! |---|---|---|
//! | Λ | [`lambda_ggx`], [`lambda_beckmann`] | Heitz 2014, eq. 72; section 5 |
//! | G₁ | [`g1_ggx`], [`g1_beckmann`], [`g1_beckmann_rational`] | Heitz 2014, eq. 43; Walter et al. 2007, eq. 34, 26, 27 |
//! | 1 − G₁ | [`one_minus_g1_ggx`], [`one_minus_g1_beckmann`] | Heitz 2014, eq. 43 |
//! | G₂ | [`g2_ggx`], [`g2_beckmann`] | Heitz 2014, eq. 99 |
//! | G₂, separable | [`g2_ggx_separable`] | Heitz 2014, eq. 98 |
//! | G₂, approximated | [`g2_ggx_hammon`] | Hammon 2017 |
//! | V = G₂/(4 N·L N·V) | [`v_ggx`], [`v_ggx_separable`], [`v_ggx_hammon`] | Lagarde and de Rousiers 2014 |
//!
//! Smith's surface is a height field whose slopes do not depend on one another. All of it follows from
//! one function of the distribution, Λ (Heitz 2014, section 5):
//!
//! ```text
//! G₁(v)    = 1 / (1 + Λ(v))             of the facets turned to v, the share that v sees
//! G₂(l, v) = 1 / (1 + Λ(l) + Λ(v))      the share that both see; both grow with a facet's height
//! V        = G₂ / (4 N·L N·V)           what remains of the BRDF next to D and F
//! ```
//!
//! The trap is to divide by 4 N·L N·V twice: V already is. [`v_ggx`] may be any size, [`g2_ggx`] is in
//! [0, 1]; neither stands for the other.
//!
//! A cosine at or below 0 is a direction below the horizon: Λ is +∞, G is 0. V is 0 below the horizon and
//! takes its limit on it. Cosines above 1 count as 1. Only α² enters, but for Hammon's approximation,
//! which brings α into [0, 1].

use crate::real::{Real, lit, one_minus_square, quotient, zero_unless_nan};
use crate::term::{ALPHA, N_DOT_L, N_DOT_V, N_DOT_X, Term, entry};

pub(crate) const TERMS: &[Term] = &[
    LAMBDA_GGX,
    LAMBDA_BECKMANN,
    G1_GGX,
    G1_BECKMANN,
    G1_BECKMANN_RATIONAL,
    ONE_MINUS_G1_GGX,
    ONE_MINUS_G1_BECKMANN,
    G2_GGX,
    G2_GGX_SEPARABLE,
    G2_GGX_HAMMON,
    G2_BECKMANN,
    V_GGX,
    V_GGX_SEPARABLE,
    V_GGX_HAMMON,
];

/// `value` of the two cosines, at most 1; 0 where one of them is not above the horizon.
#[inline(always)]
pub(crate) fn above_horizon<R: Real>(n_dot_l: R, n_dot_v: R, value: impl FnOnce(R, R) -> R) -> R {
    // Computed in any case: a loop without branches works on several points at a time.
    let above = value(n_dot_l.at_most(lit(1.0)), n_dot_v.at_most(lit(1.0)));
    if n_dot_l > lit(0.0) && n_dot_v > lit(0.0) {
        above
    } else {
        zero_unless_nan([n_dot_l, n_dot_v])
    }
}

/// sin θ of a cosine in [0, 1].
#[inline(always)]
pub(crate) fn sine<R: Real>(c: R) -> R {
    ((lit::<R>(1.0) - c) * (lit::<R>(1.0) + c))
        .at_least(lit(0.0))
        .sqrt()
}

/// sqrt(c² + α² s²), which is c sqrt(1 + α² tan²θ): no quotient, and no α² − 1.
#[inline(always)]
pub(crate) fn projected<R: Real>(c: R, alpha: R) -> R {
    c.hypot(alpha.bounded() * sine(c))
}

/// Λ of GGX: for each facet that a direction sees, the area of those turned to it that it does
/// not.
///
/// ```text
/// Λ = (−1 + sqrt(1 + α² tan²θ)) / 2,    cos θ = N·X
/// ```
///
/// - *Source*: Heitz 2014, eq. 72.
/// - *Arguments*: `n_dot_x` the cosine N·X of the direction in [0, 1]; `alpha` α = roughness² in
///   [0, 1].
/// - *Value*: 0 at normal incidence, +∞ at grazing: about α/(2 N·X).
/// - *Outside*: at or below the horizon +∞; a cosine above 1 counts as 1; only α² counts.
/// - *Error*: 6.9 ulp in f32, 6.4 in f64.
///
/// The printed form cancels where α tan θ is small; multiplied out, with x = α² tan²θ, it is x/(2
/// (1 + sqrt(1 + x))), and for large x the same divided by the root.
///
/// ```
/// let lambda = brdf::lambda_ggx(0.6, 0.16f64);
/// let g1 = brdf::g1_ggx(0.6, 0.16);
/// assert!((g1 - 1.0 / (1.0 + lambda)).abs() < 1e-15);
/// ```
#[inline(always)]
pub fn lambda_ggx<R: Real>(n_dot_x: R, alpha: R) -> R {
    let (half, one) = (lit::<R>(0.5), lit::<R>(1.0));
    let c = n_dot_x.at_most(one);
    // Half of α tan θ: the whole could overflow where Λ does not.
    let t = half * (alpha.bounded() * sine(c)).abs() / c;
    // Both forms as one, and the choice last: a loop without branches works on several points
    // at a time.
    let steep = t > half;
    let r = if steep { half / t } else { t + t };
    let (above, below) = if steep { (t, r) } else { ((t + t) * t, one) };
    let lambda = above / (below + (one + r * r).sqrt());
    if n_dot_x <= lit(0.0) {
        one / lit(0.0)
    } else {
        lambda
    }
}

const LAMBDA_GGX: Term = entry!(
    lambda_ggx(n_dot_x: N_DOT_X, alpha: ALPHA),
    symbol: "Λ_GGX", latex: r"\Lambda_{\mathrm{GGX}}", cost: 14,
    doc: "Smith's Lambda of GGX, 0 to infinity",
    source: "Heitz 2014, eq. 72",
    wgsl: Some("fn lobe_lambda_ggx(n_dot_x: f32, alpha: f32) -> f32 {
    if (n_dot_x <= 0.0) { return 3.0e38; }
    let c = min(n_dot_x, 1.0);
    let x = alpha * alpha * (1.0 - c) * (1.0 + c) / (c * c);
    return 0.5 * x / (1.0 + sqrt(1.0 + x));
}")
);

/// Chebyshev coefficients in (a − 3)/(a + 3) of (1 + 2a²)(1 − a sqrt(π) erfcx(a)), a ≥ 0.
///
/// Fitted in 60 digits; truncated after 27 terms it is within 6e-17, after 14 within 2e-8.
const ERFC_SERIES: [f64; 27] = [
    0.8983020427745623,
    0.11262785225761364,
    0.03571305852948175,
    -0.08726578763158488,
    0.059453479214879104,
    -0.02438560091618397,
    0.006522770600882268,
    -0.001005650624929731,
    1.2794620962747412e-05,
    2.978488482221082e-05,
    -4.347826728577626e-06,
    -6.093356111432701e-07,
    2.10743212981155e-07,
    1.1652759571892747e-08,
    -9.038074775178108e-09,
    -3.030761419449976e-10,
    3.982604818145382e-10,
    1.7577574077580366e-11,
    -1.8236389678792617e-11,
    -1.5040092030317944e-12,
    8.316356698523844e-13,
    1.257471831810954e-13,
    -3.4581066655987995e-14,
    -9.476313500734698e-15,
    1.0395855246885538e-15,
    6.309879635822583e-16,
    8.575482470451138e-18,
];

/// 1 − a sqrt(π) exp(a²) erfc(a) for a ≥ 0, without the difference; 1/(2a²) for large a.
#[inline(always)]
fn erfc_remainder<R: Real>(a: R) -> R {
    let (one, two) = (lit::<R>(1.0), lit::<R>(2.0));
    let t = two * ((a - lit(3.0)) / (a + lit(3.0)));
    // Clenshaw's recurrence.
    let (mut b1, mut b2) = (lit::<R>(0.0), lit::<R>(0.0));
    for &coefficient in ERFC_SERIES[1..R::ERFC_TERMS].iter().rev() {
        (b1, b2) = (t * b1 - b2 + lit(coefficient), b1);
    }
    let sum = lit::<R>(0.5) * t * b1 - b2 + lit(ERFC_SERIES[0]);
    sum / (one + two * a * a)
}

/// 1/(α tan θ) as an unevaluated sum, 0 < c < 1, α more than 0.
#[inline(always)]
fn cot_over_alpha<R: Real>(c: R, alpha: R) -> (R, R) {
    let (sin2, sin2_low) = one_minus_square(c);
    let s = sin2.sqrt();
    let (back, back_low) = s.two_square();
    let s_low = ((sin2 - back) - back_low + sin2_low) / (lit::<R>(2.0) * s);
    let (t, t_low) = alpha.two_prod(s);
    quotient((c, lit(0.0)), (t, t_low + alpha * s_low))
}

/// Λ of Beckmann.
///
/// ```text
/// Λ = (erf(a) − 1)/2 + exp(−a²) / (2 a sqrt(π)),    a = 1/(α tan θ),    cos θ = N·X
/// ```
///
/// - *Source*: Heitz 2014, section 5.
/// - *Arguments*: `n_dot_x` the cosine N·X of the direction in [0, 1]; `alpha` α = roughness² in
///   [0, 1].
/// - *Value*: 0 to +∞; less than 1e-7 for a > 3.5.
/// - *Outside*: at or below the horizon +∞; a cosine above 1 counts as 1; only α² counts.
/// - *Error*: 10.5 ulp in f32, 9.8 in f64.
///
/// The two terms cancel: at a = 5 they agree in all but the last two digits. Multiplied out it is
/// exp(−a²) (1 − a sqrt(π) erfcx(a))/(2 a sqrt(π)), the bracket from a series of its own and the
/// exponent as an unevaluated sum.
pub fn lambda_beckmann<R: Real>(n_dot_x: R, alpha: R) -> R {
    if n_dot_x <= lit(0.0) {
        return lit::<R>(1.0) / lit(0.0);
    }
    let c = n_dot_x.at_most(lit(1.0));
    let alpha = alpha.bounded();
    let t = (alpha * sine(c)).abs();
    let a = if t == lit(0.0) { lit(30.0) } else { c / t };
    // exp(−a²) is below the smallest number.
    if a > lit(28.0) {
        return lit(0.0);
    }
    // Squared as a sum: in an exponent, one rounding at 80 costs 80 ulps.
    let (a, a_low) = cot_over_alpha(c, alpha.abs());
    let (x, x_low) = a.two_square();
    let x_low = x_low + lit::<R>(2.0) * a * a_low;
    let gauss = (-x).exp() * (lit::<R>(1.0) - x_low);
    const FRAC_1_2_SQRT_PI: f64 = 0.282_094_791_773_878_14;
    lit::<R>(FRAC_1_2_SQRT_PI) * gauss * erfc_remainder(a) / a
}

const LAMBDA_BECKMANN: Term = entry!(
    lambda_beckmann(n_dot_x: N_DOT_X, alpha: ALPHA),
    symbol: "Λ_Beckmann", latex: r"\Lambda_{\mathrm{Beckmann}}", cost: 60,
    doc: "Smith's Lambda of the Beckmann distribution, 0 to infinity",
    source: "Heitz 2014, section 5",
    wgsl: Some("fn lobe_lambda_beckmann(n_dot_x: f32, alpha: f32) -> f32 {
    if (n_dot_x <= 0.0) { return 3.0e38; }
    let c = min(n_dot_x, 1.0);
    let s = alpha * sqrt(max((1.0 - c) * (1.0 + c), 0.0));
    if (s * 12.0 <= c) { return 0.0; }
    let a = c / s;
    let t = 2.0 * (a - 3.0) / (a + 3.0);
    let b13 = 1.16527596e-8;
    let b12 = t * b13 + (2.10743213e-7);
    let b11 = t * b12 - b13 + (-6.09335611e-7);
    let b10 = t * b11 - b12 + (-4.34782673e-6);
    let b9 = t * b10 - b11 + (2.97848848e-5);
    let b8 = t * b9 - b10 + (1.2794621e-5);
    let b7 = t * b8 - b9 + (-0.00100565062);
    let b6 = t * b7 - b8 + (0.0065227706);
    let b5 = t * b6 - b7 + (-0.0243856009);
    let b4 = t * b5 - b6 + (0.0594534792);
    let b3 = t * b4 - b5 + (-0.0872657876);
    let b2 = t * b3 - b4 + (0.0357130585);
    let b1 = t * b2 - b3 + (0.112627852);
    let u = (0.5 * t * b1 - b2 + 0.898302043) / (1.0 + 2.0 * a * a);
    return 0.28209479177387814 * exp(-a * a) * u / a;
}")
);

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
#[inline(always)]
pub fn g1_ggx<R: Real>(n_dot_x: R, alpha: R) -> R {
    if n_dot_x <= lit(0.0) {
        return lit(0.0);
    }
    let c = n_dot_x.at_most(lit(1.0));
    lit::<R>(2.0) * (c / (c + projected(c, alpha)))
}

const G1_GGX: Term = entry!(
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

const G1_BECKMANN: Term = entry!(
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

const G1_BECKMANN_RATIONAL: Term = entry!(
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
#[inline(always)]
pub fn one_minus_g1_ggx<R: Real>(n_dot_x: R, alpha: R) -> R {
    if n_dot_x <= lit(0.0) {
        return lit(1.0);
    }
    let c = n_dot_x.at_most(lit(1.0));
    let across = alpha.bounded() * sine(c);
    (across / (c + c.hypot(across))).squared()
}

const ONE_MINUS_G1_GGX: Term = entry!(
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

const ONE_MINUS_G1_BECKMANN: Term = entry!(
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
/// - *Value*: 0 to 1; 4 N·L N·V times [`v_ggx`]. Reciprocal.
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

const G2_GGX: Term = entry!(
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
#[inline(always)]
pub fn g2_ggx_separable<R: Real>(n_dot_l: R, n_dot_v: R, alpha: R) -> R {
    g1_ggx(n_dot_l, alpha) * g1_ggx(n_dot_v, alpha)
}

const G2_GGX_SEPARABLE: Term = entry!(
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

const G2_GGX_HAMMON: Term = entry!(
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

const G2_BECKMANN: Term = entry!(
    g2_beckmann(n_dot_l: N_DOT_L, n_dot_v: N_DOT_V, alpha: ALPHA),
    symbol: "G₂", latex: r"G_2", cost: 122,
    doc: "Smith's height-correlated masking-shadowing of the Beckmann distribution, 0 to 1",
    source: "Heitz 2014, eq. 99",
    wgsl: Some("fn lobe_g2_beckmann(n_dot_l: f32, n_dot_v: f32, alpha: f32) -> f32 {
    return 1.0 / (1.0 + lobe_lambda_beckmann(n_dot_l, alpha) + lobe_lambda_beckmann(n_dot_v, alpha));
}"),
    needs: ["lambda_beckmann"]
);

/// Visibility V of GGX: G₂ of [`g2_ggx`], already divided by 4 N·L N·V.
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

const V_GGX: Term = entry!(
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

/// Visibility of GGX with the separable G₂ of [`g2_ggx_separable`].
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

const V_GGX_SEPARABLE: Term = entry!(
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
/// - *Value*: 0 to +∞; [`g2_ggx_hammon`] over 4 N·L N·V. Reciprocal.
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

const V_GGX_HAMMON: Term = entry!(
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
