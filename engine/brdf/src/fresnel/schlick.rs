//! Schlick's approximation, what it is made from, and what corrects it.

use crate::real::{Real, lit, split};
use crate::term::{F0, Param, Term, V_DOT_H, entry};

/// Schlick's approximation of the reflectance.
///
/// ```text
/// F = f0 + (1 − f0)(1 − V·H)⁵
/// ```
///
/// - *Source*: Schlick 1994.
/// - *Arguments*: `f0` the reflectance at normal incidence in [0, 1]; `v_dot_h` V·H = L·H in [0,
///   1].
/// - *Value*: f0 at normal incidence to 1 at grazing; for f0 in [0, 1] a share.
/// - *Outside*: cosines are brought into [0, 1]; f0 is taken as it is, cut off where its square
///   would overflow.
/// - *Error*: 8.0 ulp in f32, 7.6 in f64, of a V·H given; from vectors [`Fresnel::eval`](crate::Fresnel::eval)
///   has 1 − V·H without cancellation: 20.3.
/// - *Right and wrong*: against [`f_dielectric`](crate::f_dielectric) of water to diamond off by up to 0.24 of the value, most
///   where it is small; metals with a dip before grazing are missed, see [`f_lazanyi`].
///
/// ```
/// assert_eq!(brdf::f_schlick(0.04, 1.0), 0.04);
/// assert_eq!(brdf::f_schlick(0.04, 0.0), 1.0);
/// let f: f64 = brdf::f_schlick(0.04, 0.5);
/// assert!((f - 0.07).abs() < 1e-15);
/// ```
#[inline(always)]
pub fn f_schlick<R: Real>(f0: R, v_dot_h: R) -> R {
    let f0 = f0.bounded();
    f0 + (lit::<R>(1.0) - f0) * (lit::<R>(1.0) - v_dot_h.clamp_unit()).pow5()
}

pub(super) const F_SCHLICK: Term = entry!(
    f_schlick(f0: F0, v_dot_h: V_DOT_H),
    symbol: "F_Schlick", latex: r"F_{\mathrm{Schlick}}", cost: 8,
    doc: "Schlick's approximation of Fresnel reflectance, f0 to 1",
    source: "Schlick 1994",
    wgsl: Some("fn lobe_f_schlick(f0: f32, v_dot_h: f32) -> f32 {
    let m = 1.0 - clamp(v_dot_h, 0.0, 1.0);
    let m2 = m * m;
    return f0 + (1.0 - f0) * (m2 * m2 * m);
}")
);

/// Schlick's approximation with a spherical Gaussian for the power.
///
/// ```text
/// F = f0 + (1 − f0) 2^((−5.55473 V·H − 6.98316) V·H)
/// ```
///
/// - *Source*: Karis 2013, after Lagarde 2012.
/// - *Arguments*: `f0` the reflectance at normal incidence in [0, 1]; `v_dot_h` V·H = L·H in [0,
///   1].
/// - *Value*: f0 + 1.7e-4 (1 − f0) at normal incidence to 1 at grazing.
/// - *Outside*: cosines are brought into [0, 1].
/// - *Error*: 2.9 ulp of the approximation in f32, 3.1 in f64.
/// - *Right and wrong*: within 0.0038 of Schlick's power. Its exp2 takes four times as long as the three
///   products of that power.
#[inline(always)]
pub fn f_spherical_gaussian<R: Real>(f0: R, v_dot_h: R) -> R {
    let u = v_dot_h.clamp_unit();
    // The exponent reaches −12.5 and keeps its rounding errors, the constants' included.
    let (a, b) = (split::<R>(-5.55473), split::<R>(-6.98316));
    let (x, x_low) = a.0.two_prod(u);
    let (y, y_low) = x.two_sum(b.0);
    let (z, z_low) = y.two_prod(u);
    let low = z_low + (y_low + (x_low + a.1 * u + b.1)) * u;
    let power = z.exp2() * (lit::<R>(1.0) + low * lit(std::f64::consts::LN_2));
    let f0 = f0.bounded();
    f0 + (lit::<R>(1.0) - f0) * power
}

pub(super) const F_SPHERICAL_GAUSSIAN: Term = entry!(
    f_spherical_gaussian(f0: F0, v_dot_h: V_DOT_H),
    symbol: "F_SG", latex: r"F_{\mathrm{SG}}", cost: 18,
    doc: "Schlick's approximation with a spherical Gaussian for the power",
    source: "Karis 2013; Lagarde 2012",
    wgsl: Some("fn lobe_f_spherical_gaussian(f0: f32, v_dot_h: f32) -> f32 {
    let u = clamp(v_dot_h, 0.0, 1.0);
    return f0 + (1.0 - f0) * exp2((-5.55473 * u - 6.98316) * u);
}")
);

/// Schlick's approximation for an index of refraction.
///
/// ```text
/// F = f0 + (1 − f0)(1 − V·H)⁵,    f0 = ((n − 1)/(n + 1))²
/// ```
///
/// - *Source*: Schlick 1994.
/// - *Arguments*: `ior` n = n_t/n_i > 0; `v_dot_h` V·H = L·H in [0, 1].
/// - *Value*: f0 to 1.
/// - *Outside*: cosines are brought into [0, 1]; the sign of the index is ignored.
/// - *Error*: 7.8 ulp in f32, 7.5 in f64.
#[inline(always)]
pub fn f_schlick_ior<R: Real>(ior: R, v_dot_h: R) -> R {
    f_schlick(f0_from_ior(ior), v_dot_h)
}

/// Reflectance at normal incidence of an index of refraction.
///
/// ```text
/// f0 = ((n − 1)/(n + 1))²
/// ```
///
/// - *Source*: Fresnel's equations at normal incidence.
/// - *Arguments*: `ior` n = n_t/n_i > 0.
/// - *Value*: 0.04 for 1.5, 0.02 for 1.33.
/// - *Outside*: the sign of the index is ignored.
/// - *Error*: 3.8 ulp.
#[inline(always)]
pub fn f0_from_ior<R: Real>(ior: R) -> R {
    let n = ior.abs().at_most(lit(R::LARGE));
    ((n - lit(1.0)) / (n + lit(1.0))).squared()
}

const IOR: Param = Param {
    name: "ior",
    range: (1.0, 4.0),
    unit: "1",
    meaning: "index of refraction",
};

pub(super) const F_SCHLICK_IOR: Term = entry!(
    f_schlick_ior(ior: IOR, v_dot_h: V_DOT_H),
    symbol: "F_Schlick", latex: r"F_{\mathrm{Schlick}}", cost: 12,
    doc: "Schlick's approximation of Fresnel reflectance for an index of refraction",
    source: "Schlick 1994",
    wgsl: Some("fn lobe_f_schlick_ior(ior: f32, v_dot_h: f32) -> f32 {
    let r = (ior - 1.0) / (ior + 1.0);
    return lobe_f_schlick(r * r, v_dot_h);
}"),
    needs: ["f_schlick"]
);

/// Reflectance at normal incidence of a material given by base colour and metallic.
///
/// ```text
/// f0 = lerp(0.04, base_color, metallic)
/// ```
///
/// - *Source*: Burley 2012; Karis 2013.
/// - *Arguments*: `base_color` in [0, 1], linear; `metallic` in [0, 1].
/// - *Value*: 0.04, a dielectric of index 1.5, to the base colour.
/// - *Outside*: `metallic` is brought into [0, 1]; the colour is taken as it is.
/// - *Error*: 2.1 ulp.
///
/// ```
/// let gold = [1.0, 0.77, 0.34f64];
/// assert_eq!(brdf::f0_from_metallic(gold, 1.0), gold); // a metal has its colour from the mirror
/// assert_eq!(brdf::f0_from_metallic(gold, 0.0), [0.04; 3]); // a plastic from what lies below
/// ```
#[inline(always)]
pub fn f0_from_metallic<R: Real>(base_color: [R; 3], metallic: R) -> [R; 3] {
    let m = metallic.clamp_unit();
    base_color.map(|base| lit::<R>(0.04) * (lit::<R>(1.0) - m) + base.bounded() * m)
}

/// Schlick's reflectance averaged over the cosine-weighted hemisphere.
///
/// ```text
/// F_avg = 2 ∫ F(μ) μ dμ = (1 + 20 f0)/21
/// ```
///
/// - *Source*: closed form; Kulla and Conty 2017.
/// - *Arguments*: `f0` the reflectance at normal incidence in [0, 1].
/// - *Value*: 1/21 to 1.
/// - *Outside*: f0 is taken as it is.
/// - *Error*: 1.5 ulp.
#[inline(always)]
pub fn f_schlick_average<R: Real>(f0: R) -> R {
    (lit::<R>(1.0) + lit::<R>(20.0) * f0) / lit(21.0)
}

/// Lazányi's correction of Schlick's approximation for metals.
///
/// ```text
/// F = f0 + (1 − f0)(1 − V·H)⁵ − a V·H (1 − V·H)⁶
/// ```
///
/// - *Source*: Lazányi and Szirmay-Kalos 2005.
/// - *Arguments*: `f0` the reflectance at normal incidence in [0, 1]; `a` the depth of the dip,
///   fitted for each metal; `v_dot_h` V·H = L·H in [0, 1].
/// - *Value*: f0 to 1, with the dip that metals of a large extinction show before grazing.
/// - *Outside*: cosines are brought into [0, 1]. Not kept in [0, 1]: a large `a` makes it
///   negative.
/// - *Error*: 9.9 ulp in f32, 7.8 in f64, on the scale of f0/2 where the terms cancel.
///
/// ```
/// // Some metals reflect less before grazing than straight on; Schlick's curve only rises.
/// let (f0, v_dot_h) = (0.91f64, 0.15);
/// assert!(brdf::f_schlick(f0, v_dot_h) > f0);
/// assert!(brdf::f_lazanyi(f0, 1.5, v_dot_h) < f0);
/// ```
#[inline(always)]
pub fn f_lazanyi<R: Real>(f0: R, a: R, v_dot_h: R) -> R {
    let (f0, a) = (f0.bounded(), a.bounded());
    let u = v_dot_h.clamp_unit();
    let m = lit::<R>(1.0) - u;
    let m5 = m.pow5();
    f0 + m5 * ((lit::<R>(1.0) - f0) - a * u * m)
}

const A: Param = Param {
    name: "a",
    range: (0.0, 3.0),
    unit: "1",
    meaning: "depth of the dip before grazing",
};

pub(super) const F_LAZANYI: Term = entry!(
    f_lazanyi(f0: F0, a: A, v_dot_h: V_DOT_H),
    symbol: "F_Lazányi", latex: r"F_{\mathrm{Lazanyi}}", cost: 11,
    doc: "Schlick's approximation with Lazányi's correction for metals",
    source: "Lazányi and Szirmay-Kalos 2005",
    wgsl: Some("fn lobe_f_lazanyi(f0: f32, a: f32, v_dot_h: f32) -> f32 {
    let u = clamp(v_dot_h, 0.0, 1.0);
    let m = 1.0 - u;
    let m2 = m * m;
    return f0 + m2 * m2 * m * ((1.0 - f0) - a * u * m);
}")
);
