//! Fresnel's equations for a transparent material.

use super::squares_above_one;
use crate::real::{Real, lit, zero_unless_nan};
use crate::term::{Param, Term, V_DOT_H, entry};

/// Exact Fresnel reflectance of a dielectric, unpolarised.
///
/// ```text
/// F = ½ ((g − c)/(g + c))² (1 + ((c (g + c) − 1)/(c (g − c) + 1))²),    c = V·H, g² = η² − 1 + c²
/// F = 1 where g² < 0: total internal reflection
/// ```
///
/// - *Source*: Fresnel's equations; in this form Cook and Torrance 1982.
/// - *Arguments*: `eta` η = n_t/n_i > 0; `v_dot_h` V·H = L·H in [0, 1].
/// - *Value*: ((η − 1)/(η + 1))² at normal incidence to 1 at grazing.
/// - *Outside*: cosines are brought into [0, 1]; the sign of η is ignored; η = 1 gives 0: there is
///   no interface.
/// - *Error*: 7.2 ulp in f32, 6.3 in f64, of a V·H given. Near the critical angle of η < 1 it is
///   steeper than any power of V·H: what is lost there was lost before.
///
/// The differences in the numerators are multiplied out, so that η near 1 keeps its digits: r_s =
/// (η² − 1)/(c + g)², r_p = (η² − 1)(c² η² − s²)/(η² c + g)², F = (r_s² + r_p²)/2. Where more than
/// half is reflected it is 1 − [`t_dielectric`].
///
/// ```
/// let glass: f64 = brdf::f_dielectric(1.5, 1.0);
/// assert!((glass - 0.04).abs() < 1e-15);
/// // From inside, beyond the critical angle, all is reflected.
/// assert_eq!(brdf::f_dielectric(1.0 / 1.5, 0.7), 1.0);
/// ```
#[inline(always)]
pub fn f_dielectric<R: Real>(eta: R, v_dot_h: R) -> R {
    let refraction = Refraction::new(eta, v_dot_h);
    let transmitted = refraction.transmitted();
    if transmitted < lit(0.5) {
        lit::<R>(1.0) - transmitted
    } else {
        refraction.reflected()
    }
}

/// Exact Fresnel transmittance of a dielectric, 1 − F of [`f_dielectric`], accurate where little
/// is transmitted.
///
/// ```text
/// 1 − F = 2 c g (1/(c + g)² + η²/(η² c + g)²),    c = V·H, g² = η² − 1 + c²
/// ```
///
/// - *Source*: Fresnel's equations; Cook and Torrance 1982.
/// - *Arguments*: `eta` η = n_t/n_i > 0; `v_dot_h` V·H = L·H in [0, 1].
/// - *Value*: 0 under total internal reflection and at grazing, to 1.
/// - *Outside*: cosines are brought into [0, 1]; the sign of η is ignored; η = 1 gives 1.
/// - *Error*: 5.7 ulp in f32, 3.9 in f64.
///
/// ```
/// // Into glass and out of it again at the other side of the same ray: as much each time.
/// let (eta, c) = (1.5f64, 0.6);
/// let inside = (1.0 - (1.0 - c * c) / (eta * eta)).sqrt();
/// let (in_, out) = (brdf::t_dielectric(eta, c), brdf::t_dielectric(1.0 / eta, inside));
/// assert!((in_ - out).abs() < 1e-15);
/// ```
#[inline(always)]
pub fn t_dielectric<R: Real>(eta: R, v_dot_h: R) -> R {
    let refraction = Refraction::new(eta, v_dot_h);
    let transmitted = refraction.transmitted();
    if transmitted < lit(0.5) {
        transmitted
    } else {
        lit::<R>(1.0) - refraction.reflected()
    }
}

/// The quantities of a ray that enters a dielectric.
struct Refraction<R> {
    eta: R,
    c: R,
    /// η cos θ_t as an unevaluated sum, or `None` under total internal reflection.
    g: Option<(R, R)>,
}

impl<R: Real> Refraction<R> {
    #[inline(always)]
    fn new(eta: R, v_dot_h: R) -> Refraction<R> {
        let zero = lit::<R>(0.0);
        let c = v_dot_h.clamp_unit();
        let eta = eta
            .abs()
            .at_least(lit(1.0 / R::LARGE))
            .at_most(lit(R::LARGE));
        let (g2, g2_low) = squares_above_one((eta, zero), c);
        let g = if g2 < zero {
            None
        } else {
            let g = g2.sqrt();
            let (back, back_low) = g.two_prod(g);
            let low = ((g2 - back) - back_low + g2_low) / (lit::<R>(2.0) * g);
            Some((g, if low.is_finite() { low } else { zero }))
        };
        Refraction { eta, c, g }
    }

    #[inline(always)]
    fn reflected(&self) -> R {
        let (one, two, eta, c) = (lit::<R>(1.0), lit::<R>(2.0), self.eta, self.c);
        let Some((g, g_low)) = self.g else { return one };
        let (eta2, eta2_low) = eta.two_prod(eta);
        let d = (eta2 - one) + eta2_low;
        if d == lit(0.0) {
            return zero_unless_nan([c]);
        }
        let (s, s_low) = c.two_sum(g);
        let (x, x_low) = eta2.two_prod(c);
        let (p, p_low) = x.two_sum(g);
        let brewster = squares_above_one(c.two_prod(eta), c).0;
        // 1/(s + s_low)² is 1/s² (1 − 2 s_low/s).
        let r_s = d / s / s * (one - two * ((s_low + g_low) / s));
        let r_p = (d / p) * (brewster / p);
        let p_low = p_low + (x_low + eta2_low * c + g_low);
        let r_p = r_p * (one - two * (p_low / p));
        lit::<R>(0.5) * (r_s * r_s + r_p * r_p)
    }

    #[inline(always)]
    fn transmitted(&self) -> R {
        let (one, eta, c) = (lit::<R>(1.0), self.eta, self.c);
        let Some((g, _)) = self.g else {
            return lit(0.0);
        };
        if eta == one {
            return one + zero_unless_nan([c]);
        }
        let (sum_s, sum_p) = (c + g, eta * eta * c + g);
        lit::<R>(2.0) * ((c / sum_s) * (g / sum_s) + (eta * c / sum_p) * (eta * g / sum_p))
    }
}

const ETA: Param = Param {
    name: "eta",
    range: (0.3, 4.0),
    unit: "1",
    meaning: "index of refraction, transmitted over incident",
};

pub(super) const F_DIELECTRIC: Term = entry!(
    f_dielectric(eta: ETA, v_dot_h: V_DOT_H),
    symbol: "F_dielectric", latex: r"F_{\mathrm{dielectric}}", cost: 40,
    doc: "exact Fresnel reflectance of a dielectric, unpolarised, 0 to 1",
    source: "Fresnel's equations; Cook and Torrance 1982",
    wgsl: Some("fn lobe_f_dielectric(eta: f32, v_dot_h: f32) -> f32 {
    let c = clamp(v_dot_h, 0.0, 1.0);
    let g2 = (eta - 1.0) * (eta + 1.0) + c * c;
    if (g2 < 0.0) { return 1.0; }
    let g = sqrt(g2);
    if (c + g == 0.0) { return 0.0; }
    let d = (eta - 1.0) * (eta + 1.0);
    let e2 = eta * eta;
    let s = c + g;
    let p = e2 * c + g;
    let r_s = d / (s * s);
    let r_p = d / p * ((c * c * (e2 + 1.0) - 1.0) / p);
    return 0.5 * (r_s * r_s + r_p * r_p);
}")
);

pub(super) const T_DIELECTRIC: Term = entry!(
    t_dielectric(eta: ETA, v_dot_h: V_DOT_H),
    symbol: "T_dielectric", latex: r"T_{\mathrm{dielectric}}", cost: 40,
    doc: "exact Fresnel transmittance of a dielectric, unpolarised, 0 to 1",
    source: "Fresnel's equations; Cook and Torrance 1982",
    wgsl: Some("fn lobe_t_dielectric(eta: f32, v_dot_h: f32) -> f32 {
    let c = clamp(v_dot_h, 0.0, 1.0);
    let g2 = (eta - 1.0) * (eta + 1.0) + c * c;
    if (g2 < 0.0) { return 0.0; }
    if (eta == 1.0) { return 1.0; }
    let g = sqrt(g2);
    let s = c + g;
    let p = eta * eta * c + g;
    return 2.0 * c * g * (1.0 / (s * s) + eta * eta / (p * p));
}")
);
