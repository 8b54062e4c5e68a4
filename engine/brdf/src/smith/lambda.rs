//! Λ: of the facets turned to a direction, what is hidden over what is seen.

use super::sine;
use crate::real::{Real, lit, one_minus_square, quotient};
use crate::term::{ALPHA, N_DOT_X, Term, entry};

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

pub(super) const LAMBDA_GGX: Term = entry!(
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
pub(super) fn cot_over_alpha<R: Real>(c: R, alpha: R) -> (R, R) {
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
///
/// ```
/// // Where less than 1e-10 is hidden, all digits are there.
/// let (n_dot_x, alpha) = (0.9f64, 0.4);
/// let lambda = brdf::lambda_beckmann(n_dot_x, alpha);
/// assert!(lambda > 0.0 && lambda < 1e-10);
/// assert_eq!(brdf::one_minus_g1_beckmann(n_dot_x, alpha), lambda / (1.0 + lambda));
/// ```
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

pub(super) const LAMBDA_BECKMANN: Term = entry!(
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
