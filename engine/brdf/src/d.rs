//! D: how the microfacet normals are distributed.
//!
//! | symbol | function | source |
//! |---|---|---|
//! | D, GGX | [`d_ggx`] | Walter et al. 2007, eq. 33 |
//! | D, GGX stretched | [`d_ggx_aniso`] | Burley 2012, eq. 13 |
//! | D, Beckmann | [`d_beckmann`] | Walter et al. 2007, eq. 25 |
//! | D, Blinn-Phong | [`d_blinn_phong`] | Walter et al. 2007 |
//!
//! D(h) is the area of the facets that face h, over the area of the surface below them and over the
//! solid angle: its unit is 1/sr, and it is no density of directions. What integrates to 1 is D times
//! the cosine, the area that those facets cover:
//!
//! ```text
//! ∫ D(h) (n·h) dh = 1        over the hemisphere
//! ∫ D(h) dh      ≥ 1        the area of all facets, see integral_d_ggx
//! ```
//!
//! So D may be any size: at the peak of GGX it is 1/(π α²), 51,000 at roughness 0.05. Draw h with
//! the density D (n·h) and not with D.
//!
//! A cosine close to 1 no longer carries what D of a smooth surface depends on, which is 1 − N·H. Where
//! vectors are at hand, [`Ggx::d_between`](crate::Ggx::d_between) takes them.

use crate::real::{Real, lit, one_minus_square, quotient, zero_unless_nan};
use crate::term::{ALPHA, N_DOT_H, Param, Term, entry};
use std::f64::consts::FRAC_1_PI;

pub(crate) const TERMS: &[Term] = &[D_GGX, D_GGX_ANISO, D_BECKMANN, D_BLINN_PHONG];

/// D of GGX, also known as Trowbridge-Reitz.
///
/// ```text
/// D = α² / (π ((N·H)² (α² − 1) + 1)²)
/// ```
///
/// - *Source*: Walter et al. 2007, eq. 33; Trowbridge and Reitz 1975.
/// - *Arguments*: `n_dot_h` N·H in [0, 1]; `alpha` α = roughness² in [0, 1].
/// - *Value*: 1/sr, from α²/π at N·H = 0 to 1/(π α²) at N·H = 1. ∫ D cos θ = 1.
/// - *Outside*: `n_dot_h` < 0 gives 0 and > 1 counts as 1; α = 0 gives the limit, +∞ at N·H = 1
///   and 0 elsewhere; only α² counts.
/// - *Error*: 8.4 ulp in f32, 6.7 in f64.
///
/// Computed as (α / (α² c² + s²))² / π with s² = (1 − c)(1 + c): the printed denominator cancels
/// near the peak, and in f32 at α = 0.0004 has already lost a fifth of the value.
///
/// Its tails fall as 1/tan⁴ θ in the slopes, where those of [`d_beckmann`] fall as a Gaussian:
/// that is the long glow around a GGX highlight.
///
/// ```
/// let d = brdf::d_ggx(0.95, 0.4f64 * 0.4); // N·H, and α of roughness 0.4
/// assert!((d - 0.560230396322).abs() < 1e-12);
/// assert_eq!(brdf::d_ggx(1.0, 1.0), std::f64::consts::FRAC_1_PI); // flat at α = 1
/// ```
#[inline(always)]
pub fn d_ggx<R: Real>(n_dot_h: R, alpha: R) -> R {
    let c = n_dot_h.at_most(lit(1.0));
    let alpha = alpha.bounded();
    let sin2 = (lit::<R>(1.0) - c) * (lit::<R>(1.0) + c);
    let ac = alpha * c;
    // At the peak itself α/α² would be 0/0 for an α whose square underflows. One quotient, of what
    // is chosen before: a loop over points takes no quotient behind a branch for several at once.
    let (above, below) = if sin2 == lit(0.0) {
        (lit(1.0), alpha)
    } else {
        (alpha, ac * ac + sin2)
    };
    let t = above / below;
    let value = t * t * lit(FRAC_1_PI);
    if n_dot_h < lit(0.0) { lit(0.0) } else { value }
}

const D_GGX: Term = entry!(
    d_ggx(n_dot_h: N_DOT_H, alpha: ALPHA),
    symbol: "D_GGX", latex: r"D_{\mathrm{GGX}}", cost: 11,
    doc: "GGX (Trowbridge-Reitz) distribution of microfacet normals, in 1/sr",
    source: "Walter et al. 2007, eq. 33; Trowbridge and Reitz 1975",
    wgsl: Some("fn lobe_d_ggx(n_dot_h: f32, alpha: f32) -> f32 {
    if (n_dot_h < 0.0) { return 0.0; }
    let c = min(n_dot_h, 1.0);
    let ac = alpha * c;
    let t = alpha / (ac * ac + (1.0 - c) * (1.0 + c));
    return t * t * 0.31830988618379067;
}")
);

/// D of GGX on a stretched surface: two widths.
///
/// ```text
/// D = 1 / (π α_x α_y ((h_x/α_x)² + (h_y/α_y)² + h_z²)²)
/// ```
///
/// - *Source*: Burley 2012, eq. 13; Heitz 2018, eq. 1.
/// - *Arguments*: `h_x`, `h_y`, `h_z` the half vector in the tangent frame, of length 1; `alpha_x`
///   the width along the tangent; `alpha_y` the width along the bitangent, both in (0, 1].
/// - *Value*: 1/sr, up to 1/(π α_x α_y) at the normal. With α_x = α_y it is [`d_ggx`].
/// - *Outside*: `h_z` < 0 gives 0; a half vector of length t gives the value over t⁴; without
///   width along an axis no facet leans along it: 0, or +∞ where none needs to.
/// - *Error*: 9.8 ulp in f32, 8.7 in f64.
///
/// ```
/// // One width along both axes is the surface without a grain.
/// let (h_x, h_y, h_z) = (0.1f64, 0.2, 0.95f64.sqrt());
/// let d = brdf::d_ggx_aniso(h_x, h_y, h_z, 0.3, 0.3);
/// assert!((d - brdf::d_ggx(h_z, 0.3)).abs() < 1e-14);
/// ```
#[inline(always)]
pub fn d_ggx_aniso<R: Real>(h_x: R, h_y: R, h_z: R, alpha_x: R, alpha_y: R) -> R {
    if h_z < lit(0.0) {
        return lit(0.0);
    }
    let width = |alpha: R| alpha.abs().at_most(lit(R::LARGE));
    let (alpha_x, alpha_y) = (width(alpha_x), width(alpha_y));
    // Without width along an axis no facet leans along it: 0, or ∞ where none needs to.
    let over_squared = |h: R, alpha: R| {
        if h == lit(0.0) {
            return h;
        }
        // With the rounding error of the quotient: t counts twice.
        let (q, q_low) = quotient((h, lit(0.0)), (alpha, lit(0.0)));
        let square = q * q;
        if square.is_finite() {
            square + lit::<R>(2.0) * q * q_low
        } else {
            square
        }
    };
    let (x2, y2) = (over_squared(h_x, alpha_x), over_squared(h_y, alpha_y));
    let t = x2 + y2 + h_z * h_z;
    if t > lit(0.0) && !t.is_finite() {
        return lit(0.0);
    }
    if alpha_x == lit(0.0) || alpha_y == lit(0.0) {
        return t + lit::<R>(1.0) / lit(0.0);
    }
    // Divided one by one: α_x α_y t² overflows where the quotient does not.
    lit::<R>(FRAC_1_PI) / (alpha_x * t) / (alpha_y * t)
}

const H_X: Param = Param {
    name: "h_x",
    range: (-1.0, 1.0),
    unit: "1",
    meaning: "half vector along the tangent",
};
const H_Y: Param = Param {
    name: "h_y",
    range: (-1.0, 1.0),
    unit: "1",
    meaning: "half vector along the bitangent",
};
const H_Z: Param = Param {
    name: "h_z",
    range: (0.0, 1.0),
    unit: "1",
    meaning: "half vector along the normal",
};
pub(crate) const ALPHA_X: Param = Param {
    meaning: "width of the distribution along the tangent",
    ..ALPHA
};
pub(crate) const ALPHA_Y: Param = Param {
    meaning: "width of the distribution along the bitangent",
    ..ALPHA
};

const D_GGX_ANISO: Term = entry!(
    d_ggx_aniso(h_x: H_X, h_y: H_Y, h_z: H_Z, alpha_x: ALPHA_X, alpha_y: ALPHA_Y),
    symbol: "D_GGX", latex: r"D_{\mathrm{GGX}}", cost: 14,
    doc: "anisotropic GGX distribution of microfacet normals, half vector in the tangent frame, in 1/sr",
    source: "Burley 2012, eq. 13; Heitz 2018, eq. 1",
    wgsl: Some("fn lobe_d_ggx_aniso(h_x: f32, h_y: f32, h_z: f32, alpha_x: f32, alpha_y: f32) -> f32 {
    if (h_z < 0.0) { return 0.0; }
    let x = h_x / alpha_x;
    let y = h_y / alpha_y;
    let t = x * x + y * y + h_z * h_z;
    return 0.31830988618379067 / (alpha_x * t) / (alpha_y * t);
}")
);

/// D of Beckmann: a Gaussian in the slopes.
///
/// ```text
/// D = exp(−tan²θ / α²) / (π α² cos⁴θ),    cos θ = N·H
/// ```
///
/// - *Source*: Walter et al. 2007, eq. 25; Beckmann and Spizzichino 1963.
/// - *Arguments*: `n_dot_h` N·H in [0, 1]; `alpha` α = roughness² in [0, 1].
/// - *Value*: 1/sr, 1/(π α²) at N·H = 1, 0 at N·H = 0. ∫ D cos θ = 1. α is sqrt(2) times the rms
///   slope along an axis.
/// - *Outside*: `n_dot_h` < 0 gives 0 and > 1 counts as 1; α = 0 gives the limit, +∞ at N·H = 1
///   and 0 elsewhere; only α² counts.
/// - *Error*: 8.9 ulp in f32, 6.9 in f64.
///
/// The exponent is an unevaluated sum of two numbers: one rounding of it at 80 would cost 80 ulps.
///
/// ```
/// // The same peak as GGX, and at a slope of 4 α next to nothing of its tail.
/// let alpha = 0.2f64;
/// assert!((brdf::d_beckmann(1.0, alpha) - brdf::d_ggx(1.0, alpha)).abs() < 1e-14);
/// let n_dot_h = 1.0 / (1.0 + (4.0 * alpha).powi(2)).sqrt();
/// assert!(brdf::d_beckmann(n_dot_h, alpha) < 4e-5 * brdf::d_ggx(n_dot_h, alpha));
/// ```
#[inline(always)]
pub fn d_beckmann<R: Real>(n_dot_h: R, alpha: R) -> R {
    if n_dot_h < lit(0.0) {
        return lit(0.0);
    }
    let c = n_dot_h.at_most(lit(1.0));
    let t = lit::<R>(1.0) / (alpha * c * c);
    if c == lit(1.0) {
        return t * t * lit(FRAC_1_PI);
    }
    // tan²θ/α² as an unevaluated sum: in an exponent, one rounding at 80 costs 80 ulps.
    let (ac, ac_low) = alpha.two_prod(c);
    let (d, d_low) = ac.two_prod(ac);
    let alpha2_cos2 = (d, d_low + lit::<R>(2.0) * ac * ac_low);
    let (x, x_low) = quotient(one_minus_square(c), alpha2_cos2);
    // Also where x is not finite: far below the smallest number either way.
    if x < lit(760.0) {
        // Squared last, so that exp does not underflow before it meets 1/α.
        let root = (lit::<R>(-0.5) * x).exp() * t;
        root * root * (lit::<R>(1.0) - x_low) * lit(FRAC_1_PI)
    } else {
        zero_unless_nan([n_dot_h, alpha])
    }
}

const D_BECKMANN: Term = entry!(
    d_beckmann(n_dot_h: N_DOT_H, alpha: ALPHA),
    symbol: "D_Beckmann", latex: r"D_{\mathrm{Beckmann}}", cost: 30,
    doc: "Beckmann distribution of microfacet normals (Gaussian slopes), in 1/sr",
    source: "Walter et al. 2007, eq. 25; Beckmann and Spizzichino 1963",
    wgsl: Some("fn lobe_d_beckmann(n_dot_h: f32, alpha: f32) -> f32 {
    if (n_dot_h <= 0.0) { return 0.0; }
    let c = min(n_dot_h, 1.0);
    let ac = alpha * c;
    let t = 1.0 / (ac * c);
    let x = (1.0 - c) * (1.0 + c) / (ac * ac);
    if (x > 100.0) { return 0.0; }
    return exp(-x) * t * t * 0.31830988618379067;
}")
);

/// D of Blinn-Phong, normalised, with the exponent that matches α.
///
/// ```text
/// D = (n + 2)/(2π) cosⁿθ = cosⁿθ / (π α²),    n = 2/α² − 2,    cos θ = N·H
/// ```
///
/// - *Source*: Blinn 1977; Walter et al. 2007.
/// - *Arguments*: `n_dot_h` N·H in [0, 1]; `alpha` α = roughness² in [0, 1].
/// - *Value*: 1/sr, 1/(π α²) at N·H = 1. ∫ D cos θ = 1. For small α it is [`d_beckmann`] with the
///   same α.
/// - *Outside*: `n_dot_h` < 0 gives 0 and > 1 counts as 1; α = 0 gives the limit; α > 1 makes the
///   exponent negative and the distribution grow towards grazing.
/// - *Error*: 7.6 ulp in f32, 6.2 in f64.
///
/// ```
/// // Blinn and Phong's exponent of a smooth surface, and that it looks like Beckmann's.
/// let (alpha, n_dot_h) = (0.1f64, 0.99);
/// let n = 2.0 / (alpha * alpha) - 2.0; // 198
/// let d = brdf::d_blinn_phong(n_dot_h, alpha);
/// assert!((d - (n + 2.0) / std::f64::consts::TAU * n_dot_h.powf(n)).abs() < 1e-12);
/// assert!((d / brdf::d_beckmann(n_dot_h, alpha) - 1.0).abs() < 0.02);
/// ```
#[inline(always)]
pub fn d_blinn_phong<R: Real>(n_dot_h: R, alpha: R) -> R {
    if n_dot_h < lit(0.0) {
        return lit(0.0);
    }
    let c = n_dot_h.clamp_unit();
    let t = lit::<R>(1.0) / alpha;
    if c == lit(1.0) {
        return t * t * lit(FRAC_1_PI);
    }
    // n/2 = 1/α² − 1 as an unevaluated sum: its rounding error is multiplied by ln c.
    let (q, q_low) = quotient((lit(1.0), lit(0.0)), alpha.two_prod(alpha));
    let (n_2, n_2_low) = q.two_sum(lit(-1.0));
    // Squared last, so that the power does not underflow before it meets 1/α.
    let power = c.powf(n_2);
    // At its limits, 0 and ∞ (and NaN), the power decides alone.
    if power == lit(0.0) || !power.is_finite() {
        return power;
    }
    let root = power * t;
    let correction = lit::<R>(2.0) * (n_2_low + q_low) * c.ln();
    let correction = if correction.is_finite() {
        correction
    } else {
        lit(0.0)
    };
    root * root * (lit::<R>(1.0) + correction) * lit(FRAC_1_PI)
}

const D_BLINN_PHONG: Term = entry!(
    d_blinn_phong(n_dot_h: N_DOT_H, alpha: ALPHA),
    symbol: "D_Blinn", latex: r"D_{\mathrm{Blinn}}", cost: 60,
    doc: "normalised Blinn-Phong distribution with exponent 2/alpha² - 2, in 1/sr",
    source: "Blinn 1977; Walter et al. 2007",
    // The exponent multiplies what the logarithm has lost, and near 1 a driver's has lost most
    // of it: ln m = −2 artanh((1 − m)/(1 + m)) by its series, m in [1/2, 1].
    wgsl: Some("fn lobe_d_blinn_phong(n_dot_h: f32, alpha: f32) -> f32 {
    if (n_dot_h < 0.0) { return 0.0; }
    let c = min(n_dot_h, 1.0);
    let t = 1.0 / alpha;
    let half_exponent = t * t - 1.0;
    if (c < 1e-30) { return select(0.0, 0.31830988618379067 * t * t, half_exponent <= 0.0); }
    let bits = bitcast<u32>(c);
    let powers = select(i32(bits >> 23u) - 126, 0, c >= 0.5);
    let m = select(bitcast<f32>((bits & 0x007fffffu) | 0x3f000000u), c, c >= 0.5);
    let u = (1.0 - m) / (1.0 + m);
    let u2 = u * u;
    let series = 1.0 + u2 * (0.33333333 + u2 * (0.2 + u2 * (0.14285714 + u2 * (0.11111111 + u2 * (0.09090909 + u2 * (0.07692308 + u2 * 0.06666667))))));
    let ln_c = f32(powers) * 0.69314718 - 2.0 * u * series;
    let root = exp(half_exponent * ln_c) * t;
    return root * root * 0.31830988618379067;
}")
);
