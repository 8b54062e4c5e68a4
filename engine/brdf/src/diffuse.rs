//! Diffuse models, in 1/sr: multiply by N·L and the light.
//!
//! | function | source | energy |
//! |---|---|---|
//! | [`diffuse_lambert`] | Lambert 1760 | keeps all of it |
//! | [`diffuse_disney`] | Burley 2012, eq. 4 | gains some on rough surfaces |
//! | [`diffuse_oren_nayar`] | Oren and Nayar 1994, the qualitative model | loses some |
//! | [`diffuse_oren_nayar_full`] | Oren and Nayar 1994, the functional approximation | loses less; below 0 at a few grazing points |
//! | [`diffuse_hammon`] | Hammon 2017 | a fit; gains up to 18 % seen from some directions |
//! | [`diffuse_eon`] | Portsmouth, Kutz and Hill 2025 | keeps all of it, exactly |
//!
//! `n_dot_l` or `n_dot_v` at or below 0 gives 0, but for Lambert, which has no cosines. Other arguments are
//! brought into their range; an albedo above 1 is taken as it is, except by EON. All are reciprocal.
//!
//! Which roughness: Disney takes the perceptual roughness, Hammon α = roughness², Oren-Nayar σ, the standard
//! deviation of the facets' *angle* in radians, and EON a number of its own from 0 to 1.

use crate::real::{Real, lit};
use crate::smith::{above_horizon, sine};
use crate::term::{
    ALBEDO, ALPHA, COS_PHI, L_DOT_V, N_DOT_L, N_DOT_V, Param, ROUGHNESS, SIGMA, Term, V_DOT_H,
    entry,
};
use std::f64::consts::{FRAC_1_PI, FRAC_2_PI, FRAC_PI_2, PI};

pub(crate) const TERMS: &[Term] = &[
    DIFFUSE_LAMBERT,
    DIFFUSE_DISNEY,
    DIFFUSE_OREN_NAYAR,
    DIFFUSE_OREN_NAYAR_FULL,
    DIFFUSE_HAMMON,
    DIFFUSE_EON,
];

/// Lambert: the same in every direction.
///
/// ```text
/// f = ρ/π
/// ```
///
/// - *Source*: Lambert 1760.
/// - *Arguments*: `albedo` ρ in [0, 1].
/// - *Value*: 1/sr, 0 to 1/π.
/// - *Outside*: an albedo below 0 counts as 0, one above 1 is taken as it is.
/// - *Error*: 1.2 ulp.
#[inline(always)]
pub fn diffuse_lambert<R: Real>(albedo: R) -> R {
    albedo.at_least(lit(0.0)).bounded() * lit(FRAC_1_PI)
}

const DIFFUSE_LAMBERT: Term = entry!(
    diffuse_lambert(albedo: ALBEDO),
    symbol: "f_Lambert", latex: r"f_{\mathrm{Lambert}}", cost: 1,
    doc: "Lambert's diffuse reflection, albedo/pi, in 1/sr",
    source: "Lambert 1760",
    wgsl: Some("fn lobe_diffuse_lambert(albedo: f32) -> f32 {
    return albedo * 0.31830988618379067;
}")
);

/// 1 − (1 − c)⁵ = c (1 + x + x² + x³ + x⁴), x = 1 − c: no difference left.
#[inline(always)]
fn one_minus_pow5<R: Real>(c: R) -> R {
    let one = lit::<R>(1.0);
    let x = one - c;
    let x2 = x * x;
    c * (one + (x + x2) + (x + x2) * x2)
}

/// Disney's diffuse reflection, with retro-reflection at grazing angles.
///
/// ```text
/// f = (ρ/π) (1 + (fd90 − 1)(1 − N·L)⁵)(1 + (fd90 − 1)(1 − N·V)⁵),    fd90 = 0.5 + 2 roughness (V·H)²
/// ```
///
/// - *Source*: Burley 2012, eq. 4.
/// - *Arguments*: `n_dot_l` N·L in [0, 1]; `n_dot_v` N·V in [0, 1]; `v_dot_h` V·H = L·H in [0, 1];
///   `roughness` in [0, 1]; `albedo` ρ in [0, 1].
/// - *Value*: 1/sr, a quarter of Lambert to 6.25 times it.
/// - *Outside*: at or below the horizon 0; other arguments are brought into their range, an albedo
///   above 1 is taken as it is.
/// - *Error*: 7.8 ulp in f32, 6.0 in f64.
/// - *Right and wrong*: reciprocal; gains energy on rough surfaces. It takes roughness, not α.
///
/// ```
/// // Where light and view graze together a rough surface is brighter than Lambert, a smooth one darker.
/// let lambert: f64 = brdf::diffuse_lambert(0.5);
/// assert!(brdf::diffuse_disney(0.1, 0.1, 1.0, 1.0, 0.5) > 2.0 * lambert);
/// assert!(brdf::diffuse_disney(0.1, 0.1, 1.0, 0.0, 0.5) < 0.5 * lambert);
/// ```
#[inline(always)]
pub fn diffuse_disney<R: Real>(n_dot_l: R, n_dot_v: R, v_dot_h: R, roughness: R, albedo: R) -> R {
    above_horizon(n_dot_l, n_dot_v, |l, v| {
        let one = lit::<R>(1.0);
        let retro =
            lit::<R>(2.0) * roughness.clamp_unit() * v_dot_h.clamp_unit().squared() - lit(0.5);
        let factor = |c: R| {
            if c < lit(0.2) {
                // Without the fifth power of a rounded 1 − c, which is close to 1.
                (one + retro) - retro * one_minus_pow5(c)
            } else {
                one + retro * (one - c).pow5()
            }
        };
        diffuse_lambert(albedo) * factor(l) * factor(v)
    })
}

const DIFFUSE_DISNEY: Term = entry!(
    diffuse_disney(n_dot_l: N_DOT_L, n_dot_v: N_DOT_V, v_dot_h: V_DOT_H, roughness: ROUGHNESS, albedo: ALBEDO),
    symbol: "f_Disney", latex: r"f_{\mathrm{Disney}}", cost: 19,
    doc: "Disney's diffuse reflection with retro-reflection at grazing angles, in 1/sr",
    source: "Burley 2012, eq. 4",
    wgsl: Some("fn lobe_diffuse_disney(n_dot_l: f32, n_dot_v: f32, v_dot_h: f32, roughness: f32, albedo: f32) -> f32 {
    if (n_dot_l <= 0.0 || n_dot_v <= 0.0) { return 0.0; }
    let retro = 2.0 * roughness * v_dot_h * v_dot_h - 0.5;
    let l = 1.0 - min(n_dot_l, 1.0);
    let v = 1.0 - min(n_dot_v, 1.0);
    let l2 = l * l;
    let v2 = v * v;
    return albedo * 0.31830988618379067 * (1.0 + retro * (l2 * l2 * l)) * (1.0 + retro * (v2 * v2 * v));
}")
);

/// The smaller and the larger of two cosines.
#[inline(always)]
fn ordered<R: Real>(l: R, v: R) -> (R, R) {
    if l < v { (l, v) } else { (v, l) }
}

/// Oren-Nayar, the qualitative model.
///
/// ```text
/// f = (ρ/π) (A + B max(0, cos φ) sin α tan β),    α, β the larger and the smaller angle to the normal
/// A = 1 − 0.5 σ²/(σ² + 0.33),    B = 0.45 σ²/(σ² + 0.09)
/// ```
///
/// - *Source*: Oren and Nayar 1994, the qualitative model.
/// - *Arguments*: `n_dot_l` N·L in [0, 1]; `n_dot_v` N·V in [0, 1]; `cos_phi` the cosine of the
///   azimuth between light and view in [−1, 1]; `sigma` σ in radians, 0 to about 1; `albedo` ρ in
///   [0, 1].
/// - *Value*: 1/sr.
/// - *Outside*: at or below the horizon 0; other arguments are brought into their range, an albedo
///   above 1 is taken as it is.
/// - *Error*: 8.4 ulp in f32, 7.7 in f64.
/// - *Right and wrong*: grooves in the shape of a V without interreflection: reciprocal, and
///   darker the rougher. It has a crease where the two angles are equal.
///
/// ```
/// // A full moon: seen from where the light comes, a rough ball is almost as bright at its rim.
/// let rim = |sigma: f64| brdf::diffuse_oren_nayar(0.3, 0.3, 1.0, sigma, 1.0) * 0.3;
/// let middle = |sigma: f64| brdf::diffuse_oren_nayar(1.0, 1.0, 1.0, sigma, 1.0);
/// assert!((rim(0.0) / middle(0.0) - 0.3).abs() < 1e-15); // Lambert
/// assert!(rim(0.8) / middle(0.8) > 0.6);
/// ```
#[inline(always)]
pub fn diffuse_oren_nayar<R: Real>(n_dot_l: R, n_dot_v: R, cos_phi: R, sigma: R, albedo: R) -> R {
    above_horizon(n_dot_l, n_dot_v, |l, v| {
        let (low, high) = ordered(l, v);
        let sin_tan = (sine(low) * sine(high) / high).at_most(lit(R::LARGE));
        let s2 = sigma.abs().at_most(lit(R::LARGE)).squared();
        let b = lit::<R>(0.45) * (s2 / (s2 + lit(0.09)));
        diffuse_lambert(albedo) * (oren_nayar_a(s2) + b * cos_phi.clamp_unit() * sin_tan)
    })
}

/// 1 − 0.5 σ²/(σ² + 0.33) of σ², without the difference.
#[inline(always)]
fn oren_nayar_a<R: Real>(s2: R) -> R {
    (lit::<R>(0.5) * s2 + lit(0.33)) / (s2 + lit(0.33))
}

const DIFFUSE_OREN_NAYAR: Term = entry!(
    diffuse_oren_nayar(n_dot_l: N_DOT_L, n_dot_v: N_DOT_V, cos_phi: COS_PHI, sigma: SIGMA, albedo: ALBEDO),
    symbol: "f_ON", latex: r"f_{\mathrm{ON}}", cost: 28,
    doc: "Oren-Nayar diffuse reflection, qualitative model, in 1/sr",
    source: "Oren and Nayar 1994, the qualitative model",
    wgsl: Some("fn lobe_diffuse_oren_nayar(n_dot_l: f32, n_dot_v: f32, cos_phi: f32, sigma: f32, albedo: f32) -> f32 {
    if (n_dot_l <= 0.0 || n_dot_v <= 0.0) { return 0.0; }
    let l = min(n_dot_l, 1.0);
    let v = min(n_dot_v, 1.0);
    let sin_tan = sqrt((1.0 - l) * (1.0 + l)) * sqrt((1.0 - v) * (1.0 + v)) / max(l, v);
    let s2 = sigma * sigma;
    let a = (0.5 * s2 + 0.33) / (s2 + 0.33);
    let b = 0.45 * s2 / (s2 + 0.09);
    return albedo * 0.31830988618379067 * (a + b * max(cos_phi, 0.0) * sin_tan);
}")
);

/// WGSL of the arc sine on [0, 1]: that of software drivers is good to 1e-4 only. The classic
/// single-precision approximation of Moshier's Cephes library, within 2e-7.
macro_rules! wgsl_asin {
    ($name:literal) => {
        concat!(
            "fn ",
            $name,
            "(x: f32) -> f32 {
    let outer = x > 0.5;
    let z = select(x * x, 0.5 * (1.0 - x), outer);
    let s = select(x, sqrt(z), outer);
    let p = (((0.042163199 * z + 0.024181311) * z + 0.045470026) * z + 0.074953003) * z + 0.16666752;
    let inner = p * z * s + s;
    return select(inner, 1.5707964 - 2.0 * inner, outer);
}

"
        )
    };
}

/// Oren-Nayar, the full model with C₁, C₂, C₃ and one interreflection.
///
/// ```text
/// f  = (ρ/π) (C₁ + cos φ C₂ tan β + (1 − |cos φ|) C₃ tan((α + β)/2))
///      + 0.17 (ρ²/π) σ²/(σ² + 0.13) (1 − cos φ (2β/π)²)
/// C₁ = 1 − 0.5 σ²/(σ² + 0.33)
/// C₂ = 0.45 σ²/(σ² + 0.09) (sin α − (2β/π)³ where cos φ < 0)
/// C₃ = 0.125 σ²/(σ² + 0.09) (4αβ/π²)²
/// ```
///
/// - *Source*: Oren and Nayar 1994, the functional approximation.
/// - *Arguments*: `n_dot_l` N·L in [0, 1]; `n_dot_v` N·V in [0, 1]; `cos_phi` the cosine of the
///   azimuth between light and view in [−1, 1]; `sigma` σ in radians, 0 to about 1; `albedo` ρ in
///   [0, 1].
/// - *Value*: 1/sr; slightly negative at a few grazing points with cos φ < 0: that is the model.
/// - *Outside*: at or below the horizon 0; other arguments are brought into their range, an albedo
///   above 1 is taken as it is.
/// - *Error*: 17.3 ulp in f32, 14.3 in f64, on the scale of ρ/6: it is a difference of terms of
///   that size, and crosses 0.
///
/// sin α − (2β/π)³ cancels when both directions graze: with u = 2 asin(cos β)/π it is u (3 − 3u +
/// u²) − c²/(1 + s), c = cos α, s = sin α.
#[inline(always)]
pub fn diffuse_oren_nayar_full<R: Real>(
    n_dot_l: R,
    n_dot_v: R,
    cos_phi: R,
    sigma: R,
    albedo: R,
) -> R {
    above_horizon(n_dot_l, n_dot_v, |l, v| {
        let one = lit::<R>(1.0);
        let (low, high) = ordered(l, v);
        let cos_phi = cos_phi.at_least(-one).at_most(one);
        let albedo = albedo.at_least(lit(0.0)).bounded();
        let (sin_alpha, sin_beta) = (sine(low), sine(high));
        let tan_beta = (sin_beta / high).at_most(lit(R::LARGE));
        let tan_half = ((sin_alpha + sin_beta) / (low + high)).at_most(lit(R::LARGE));
        // The angles as shares of a right angle, and the complement of β.
        let alpha = low.acos() * lit(FRAC_2_PI);
        let beta = high.acos() * lit(FRAC_2_PI);
        let u = high.asin() * lit(FRAC_2_PI);
        let s2 = sigma.abs().at_most(lit(R::LARGE)).squared();
        let k = s2 / (s2 + lit(0.09));
        let bracket = if cos_phi >= lit(0.0) {
            sin_alpha
        } else {
            u * (lit::<R>(3.0) - lit::<R>(3.0) * u + u * u) - low * low / (one + sin_alpha)
        };
        let c1 = oren_nayar_a(s2);
        let c2 = lit::<R>(0.45) * k * bracket;
        let c3 = lit::<R>(0.125) * k * (alpha * beta).squared();
        let direct = c1 + cos_phi * c2 * tan_beta + (one - cos_phi.abs()) * c3 * tan_half;
        let indirect = lit::<R>(0.17) * (s2 / (s2 + lit(0.13))) * (one - cos_phi * beta * beta);
        albedo * lit(FRAC_1_PI) * (direct + albedo * indirect)
    })
}

const DIFFUSE_OREN_NAYAR_FULL: Term = entry!(
    diffuse_oren_nayar_full(n_dot_l: N_DOT_L, n_dot_v: N_DOT_V, cos_phi: COS_PHI, sigma: SIGMA, albedo: ALBEDO),
    symbol: "f_ON", latex: r"f_{\mathrm{ON}}", cost: 95,
    doc: "Oren-Nayar diffuse reflection, full model with interreflection, in 1/sr",
    source: "Oren and Nayar 1994, the functional approximation",
    wgsl: Some(concat!(wgsl_asin!("lobe_diffuse_oren_nayar_full_asin"), "fn lobe_diffuse_oren_nayar_full(n_dot_l: f32, n_dot_v: f32, cos_phi: f32, sigma: f32, albedo: f32) -> f32 {
    if (n_dot_l <= 0.0 || n_dot_v <= 0.0) { return 0.0; }
    let low = min(min(n_dot_l, n_dot_v), 1.0);
    let high = min(max(n_dot_l, n_dot_v), 1.0);
    let sin_a = sqrt((1.0 - low) * (1.0 + low));
    let sin_b = sqrt((1.0 - high) * (1.0 + high));
    let u = 0.63661977236758134 * lobe_diffuse_oren_nayar_full_asin(high);
    let a = 1.0 - 0.63661977236758134 * lobe_diffuse_oren_nayar_full_asin(low);
    let b = 1.0 - u;
    let s2 = sigma * sigma;
    let k = s2 / (s2 + 0.09);
    var c2 = sin_a;
    if (cos_phi < 0.0) { c2 = u * (3.0 - 3.0 * u + u * u) - low * low / (1.0 + sin_a); }
    let direct = (0.5 * s2 + 0.33) / (s2 + 0.33)
        + cos_phi * 0.45 * k * c2 * sin_b / high
        + (1.0 - abs(cos_phi)) * 0.125 * k * (a * b) * (a * b) * (sin_a + sin_b) / (low + high);
    let indirect = 0.17 * s2 / (s2 + 0.13) * (1.0 - cos_phi * b * b);
    return albedo * 0.31830988618379067 * (direct + albedo * indirect);
}"))
);

/// Hammon's diffuse reflection for GGX: a fit to a random walk on coated facets.
///
/// ```text
/// f      = ρ (single + ρ multi)
/// single = lerp(smooth, rough, α)/π,    multi = 0.1159 α
/// smooth = 1.05 (1 − (1 − N·L)⁵)(1 − (1 − N·V)⁵)
/// rough  = facing (0.9 − 0.4 facing)(0.5 + N·H)/N·H,    facing = 0.5 + 0.5 L·V
/// ```
///
/// - *Source*: Hammon 2017 (GDC).
/// - *Arguments*: `n_dot_l` N·L in [0, 1]; `n_dot_v` N·V in [0, 1]; `l_dot_v` L·V in [−1, 1];
///   `alpha` α = roughness² in [0, 1]; `albedo` ρ in [0, 1].
/// - *Value*: 1/sr.
/// - *Outside*: at or below the horizon 0; other arguments are brought into their range, an albedo
///   above 1 is taken as it is.
/// - *Error*: 10.3 ulp in f32, 8.2 in f64.
/// - *Right and wrong*: at albedo 1 the average over the hemisphere exceeds 1 above α ≈ 0.4; at α
///   = 1 up to 18 % more leaves than arrived. The (1 − f0) that the derivation has is not in it.
///
/// Repeated ([`walk::Split`](crate::walk::Split)), that walk gives less of *single* on rough surfaces: 0.591 of
/// the light at α = 1, where the fit has 0.708. Drawing the facets from D alone, as his slides
/// print it, gives 0.685, and direction by direction half the distance from the fit: the fit seems
/// to follow that walk, which is not reciprocal and does not agree with ∫ D G₂.
///
/// N·H is taken from the identity (N·L + N·V)/|L + V|, and never divided by alone.
///
/// ```
/// // Smooth, it is what two passages of a coat leave of Lambert.
/// let passed = |c: f64| 1.0 - (1.0 - c).powi(5);
/// let f = brdf::diffuse_hammon(0.3, 0.8, 0.5, 0.0, 0.5);
/// assert!((f - 1.05 * 0.5 * passed(0.3) * passed(0.8) / std::f64::consts::PI).abs() < 1e-15);
/// ```
#[inline(always)]
pub fn diffuse_hammon<R: Real>(n_dot_l: R, n_dot_v: R, l_dot_v: R, alpha: R, albedo: R) -> R {
    above_horizon(n_dot_l, n_dot_v, |l, v| {
        let one = lit::<R>(1.0);
        let (alpha, albedo) = (alpha.clamp_unit(), albedo.at_least(lit(0.0)).bounded());
        let two_facing = one + l_dot_v.at_least(-one).at_most(one);
        let facing = lit::<R>(0.5) * two_facing;
        // |L + V|/(N·L + N·V), which is 1/N·H.
        let secant = ((lit::<R>(2.0) * two_facing).sqrt() / (l + v)).at_most(lit(R::LARGE));
        let rough =
            facing * (lit::<R>(0.9) - lit::<R>(0.4) * facing) * (one + lit::<R>(0.5) * secant);
        let smooth = lit::<R>(1.05) * one_minus_pow5(l) * one_minus_pow5(v);
        let single = (smooth * (one - alpha) + rough * alpha) * lit(FRAC_1_PI);
        albedo * (single + albedo * (lit::<R>(0.1159) * alpha))
    })
}

const DIFFUSE_HAMMON: Term = entry!(
    diffuse_hammon(n_dot_l: N_DOT_L, n_dot_v: N_DOT_V, l_dot_v: L_DOT_V, alpha: ALPHA, albedo: ALBEDO),
    symbol: "f_Hammon", latex: r"f_{\mathrm{Hammon}}", cost: 42,
    doc: "Hammon's diffuse reflection for GGX surfaces, in 1/sr",
    source: "Hammon 2017",
    wgsl: Some("fn lobe_diffuse_hammon(n_dot_l: f32, n_dot_v: f32, l_dot_v: f32, alpha: f32, albedo: f32) -> f32 {
    if (n_dot_l <= 0.0 || n_dot_v <= 0.0) { return 0.0; }
    let l = min(n_dot_l, 1.0);
    let v = min(n_dot_v, 1.0);
    let f2 = max(1.0 + l_dot_v, 0.0);
    let facing = 0.5 * f2;
    let rough = facing * (0.9 - 0.4 * facing) * (1.0 + 0.5 * sqrt(2.0 * f2) / (l + v));
    let x = 1.0 - l;
    let y = 1.0 - v;
    let smooth_l = l * (1.0 + (x + x * x) * (1.0 + x * x));
    let smooth_v = v * (1.0 + (y + y * y) * (1.0 + y * y));
    let single = mix(1.05 * smooth_l * smooth_v, rough, alpha) * 0.31830988618379067;
    return albedo * (single + albedo * (0.1159 * alpha));
}")
);

/// 1/2 − 2/(3π): what the facets of the FON model lose.
const FON_1: f64 = 0.5 - FRAC_2_PI / 3.0;
/// 2/3 − 28/(15π).
const FON_2: f64 = 2.0 / 3.0 - 28.0 / (15.0 * PI);

/// (1 − E)/(A_F r) of the FON model, which is c₁ − G(μ)/π, exact.
#[inline(always)]
fn fon_loss<R: Real>(mu: R) -> R {
    let one = lit::<R>(1.0);
    let s = sine(mu);
    let mu2_over = mu * mu / (one + s);
    let thirds = lit::<R>(2.0 / 3.0);
    let sum = lit::<R>(FRAC_PI_2 - 2.0 / 3.0) * mu2_over + s * mu.asin() + s * s * mu
        - thirds * s * (mu * (one + s + s * s) / (one + s));
    sum * lit(FRAC_1_PI)
}

/// EON: energy-preserving Oren-Nayar, with its exact albedo.
///
/// ```text
/// f = (ρ/π) A (1 + r s/t) + (ρ_ms/π) (1 − E(l))(1 − E(v))/(1 − E_avg)
/// s = L·V − N·L N·V,    t = max(N·L, N·V) where s > 0, else 1
/// A = 1/(1 + (1/2 − 2/(3π)) r),    ρ_ms = ρ² E_avg/(1 − ρ (1 − E_avg))
/// E(v) = A (1 + (r/π) (s_v (θ_v − s_v c_v) + (2/3)((s_v/c_v)(1 − s_v³) − s_v))),    c_v = cos θ_v = N·V, s_v = sin θ_v
/// E_avg = A (1 + (2/3 − 28/(15π)) r)
/// ```
///
/// - *Source*: Portsmouth, Kutz and Hill 2025 (JCGT 14-1): Fujii's Oren-Nayar plus
///   what it loses.
/// - *Arguments*: `n_dot_l`, `n_dot_v` and `l_dot_v` the three cosines; `roughness` r the model's
///   own, 0 (Lambert) to 1; `albedo` ρ in [0, 1].
/// - *Value*: 1/sr. ρ = 1 passes the white furnace from every view.
/// - *Outside*: at or below the horizon 0; other arguments are brought into their range, the
///   albedo too.
/// - *Error*: 6.0 ulp in f32, 5.4 in f64.
///
/// 1 − E is computed as a sum without the 1, and its factor A r cancels against that of the
/// average: no clamp is needed at roughness 0.
///
/// ```
/// let lambert: f64 = brdf::diffuse_eon(0.8, 0.6, 0.9, 0.0, 0.5);
/// assert!((lambert - brdf::diffuse_lambert(0.5)).abs() < 1e-16);
/// ```
#[inline(always)]
pub fn diffuse_eon<R: Real>(n_dot_l: R, n_dot_v: R, l_dot_v: R, roughness: R, albedo: R) -> R {
    above_horizon(n_dot_l, n_dot_v, |l, v| {
        let one = lit::<R>(1.0);
        let (low, high) = ordered(l, v);
        let (r, rho) = (roughness.clamp_unit(), albedo.clamp_unit());
        // L·V − N·L N·V and, where it is near −1, 1 + r s keep the digits they cancel.
        let (product, product_low) = low.two_prod(high);
        let (s, s_low) = l_dot_v.at_least(-one).at_most(one).two_sum(-product);
        let s_low = s_low - product_low;
        let facing = if s > lit(0.0) {
            one + r * (s / high).at_most(lit(R::LARGE))
        } else {
            let (rs, rs_low) = r.two_prod(s);
            let (sum, sum_low) = one.two_sum(rs);
            (sum + (sum_low + rs_low + r * s_low)).at_least(lit(0.0))
        };
        let a = one / (one + lit::<R>(FON_1) * r);
        let single = rho * a * facing;
        let average = a * (one + lit::<R>(FON_2) * r);
        let average_loss = a * r * lit(FON_1 - FON_2);
        let multi = rho * rho * average / (one - rho * average_loss)
            * (a * r * fon_loss(low) * fon_loss(high) / lit(FON_1 - FON_2));
        (single + multi) * lit(FRAC_1_PI)
    })
}

const EON_ROUGHNESS: Param = Param {
    range: (0.0, 1.0),
    meaning: "roughness of the diffuse model, 0 is Lambert",
    ..ROUGHNESS
};

const DIFFUSE_EON: Term = entry!(
    diffuse_eon(n_dot_l: N_DOT_L, n_dot_v: N_DOT_V, l_dot_v: L_DOT_V, roughness: EON_ROUGHNESS, albedo: ALBEDO),
    symbol: "f_EON", latex: r"f_{\mathrm{EON}}", cost: 75,
    doc: "EON, the energy-preserving Oren-Nayar diffuse reflection, exact albedo, in 1/sr",
    source: "Portsmouth, Kutz and Hill 2025 (JCGT 14-1)",
    wgsl: Some(concat!(wgsl_asin!("lobe_diffuse_eon_asin"), "fn lobe_diffuse_eon(n_dot_l: f32, n_dot_v: f32, l_dot_v: f32, roughness: f32, albedo: f32) -> f32 {
    if (n_dot_l <= 0.0 || n_dot_v <= 0.0) { return 0.0; }
    let low = min(min(n_dot_l, n_dot_v), 1.0);
    let high = min(max(n_dot_l, n_dot_v), 1.0);
    let s = l_dot_v - low * high;
    let s_over_t = select(s, s / high, s > 0.0);
    let a = 1.0 / (1.0 + 0.28779341040929137 * roughness);
    let x = sqrt((1.0 - low) * (1.0 + low));
    let y = sqrt((1.0 - high) * (1.0 + high));
    let loss_x = 0.90412966012823 * low * low / (1.0 + x) + x * lobe_diffuse_eon_asin(low) + x * x * low - 0.66666666666666667 * x * low * (1.0 + x + x * x) / (1.0 + x);
    let loss_y = 0.90412966012823 * high * high / (1.0 + y) + y * lobe_diffuse_eon_asin(high) + y * y * high - 0.66666666666666667 * y * high * (1.0 + y + y * y) / (1.0 + y);
    let average = a * (1.0 + 0.07248820996 * roughness);
    let lost = a * roughness * 0.21530520045;
    let multi = albedo * albedo * average / (1.0 - albedo * lost) * a * roughness * loss_x * loss_y * 0.10132118364 / 0.21530520045;
    return (albedo * a * max(1.0 + roughness * s_over_t, 0.0) + multi) * 0.31830988618379067;
}"))
);
