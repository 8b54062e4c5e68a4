//! F: how much a mirror reflects.
//!
//! | symbol | function | source |
//! |---|---|---|
//! | F, Schlick | [`f_schlick`], [`f_schlick_ior`] | Schlick 1994 |
//! | F, spherical Gaussian | [`f_spherical_gaussian`] | Karis 2013 |
//! | F, Lazányi | [`f_lazanyi`] | Lazányi and Szirmay-Kalos 2005 |
//! | F, dielectric | [`f_dielectric`]; 1 − F: [`t_dielectric`] | Cook and Torrance 1982 |
//! | F, conductor | [`f_conductor`], [`conductor_rgb`]; 1 − F: [`t_conductor`] | Born and Wolf, optics of metals |
//! | f0 | [`f0_from_ior`], [`f0_from_metallic`] | Burley 2012 |
//! | F_avg | [`f_schlick_average`] | closed form |
//!
//! `v_dot_h` is the cosine between the direction and the facet it is mirrored in, the same for light and
//! view; N·V only where the surface itself is the mirror. It counts as 0 below 0 and as 1 above 1.
//!
//! With one distant light V·H, and F with it, is the same all over a sphere: a Fresnel rim is a matter of
//! the light's direction, not of the silhouette.

use crate::real::{Real, lit, one_minus_square, split, zero_unless_nan};
use crate::term::{F0, Param, Term, V_DOT_H, entry};

pub(crate) const TERMS: &[Term] = &[
    F_SCHLICK,
    F_SPHERICAL_GAUSSIAN,
    F_SCHLICK_IOR,
    F_DIELECTRIC,
    T_DIELECTRIC,
    T_CONDUCTOR,
    F_CONDUCTOR,
    F_LAZANYI,
];

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
/// - *Error*: 8.0 ulp in f32, 7.6 in f64, of a V·H given; from vectors [`crate::Fresnel::eval`]
///   has 1 − V·H without cancellation: 20.3.
/// - *Right and wrong*: against [`f_dielectric`] of water to diamond off by up to 0.24 of the value, most
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

const F_SCHLICK: Term = entry!(
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

const F_SPHERICAL_GAUSSIAN: Term = entry!(
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

const F_SCHLICK_IOR: Term = entry!(
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

/// a² + c² − 1 as an unevaluated sum: near the critical angle (a = η), and near Brewster's
/// (a = η c), everything depends on its last digits.
#[inline(always)]
fn squares_above_one<R: Real>(a: (R, R), c: R) -> (R, R) {
    let ((p, p_low), (q, q_low)) = (a.0.two_prod(a.0), c.two_prod(c));
    let p_low = p_low + lit::<R>(2.0) * a.0 * a.1;
    let (sum, sum_low) = p.two_sum(q);
    let (high, low) = sum.two_sum(lit(-1.0));
    high.two_sum(low + (sum_low + (p_low + q_low)))
}

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

const F_DIELECTRIC: Term = entry!(
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

const T_DIELECTRIC: Term = entry!(
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

/// Exact Fresnel reflectance of a conductor with complex index n + ik, unpolarised.
///
/// ```text
/// F   = (R_s + R_p)/2
/// R_s = ((a − c)² + b²)/((a + c)² + b²)
/// R_p = R_s ((a c − s²)² + b² c²)/((a c + s²)² + b² c²)
/// with a² − b² = n² − k² − s², a b = n k, c = V·H, s² = 1 − c²
/// ```
///
/// - *Source*: Born and Wolf, optics of metals; Lagarde 2013.
/// - *Arguments*: `n` the real part of the index, ≥ 0; `k` its imaginary part, ≥ 0; `v_dot_h` V·H
///   = L·H in [0, 1].
/// - *Value*: ((n − 1)² + k²)/((n + 1)² + k²) at normal incidence to 1 at grazing. `k = 0` is the
///   dielectric of index n.
/// - *Outside*: cosines are brought into [0, 1]; signs of n and k are ignored.
/// - *Error*: 9.7 ulp in f32, 8.7 in f64.
///
/// The smaller of a² and b² is n²k² over the larger, and a − c and a c − s² are quotients of
/// differences of squares.
///
/// ```
/// // Gold, for red light.
/// let f: f64 = brdf::f_conductor(0.143, 3.983, 1.0);
/// assert!((f - (0.857f64.powi(2) + 3.983f64.powi(2)) / (1.143f64.powi(2) + 3.983f64.powi(2))).abs() < 1e-15);
/// ```
#[inline(always)]
pub fn f_conductor<R: Real>(n: R, k: R, v_dot_h: R) -> R {
    let (reflected, transmitted) = conductor(n, k, v_dot_h);
    if transmitted < lit(0.5) {
        lit::<R>(1.0) - transmitted
    } else {
        reflected
    }
}

/// Share of the light that a conductor absorbs, 1 − F of [`f_conductor`], accurate where it is
/// small.
///
/// ```text
/// 1 − R_s = 4 a c/((a + c)² + b²)
/// 1 − R_p = (1 − R_s) + R_s · 4 a c s²/((a c + s²)² + b² c²)
/// ```
///
/// - *Source*: Born and Wolf, optics of metals; Lagarde 2013.
/// - *Arguments*: `n` the real part of the index, ≥ 0; `k` its imaginary part, ≥ 0; `v_dot_h` V·H
///   = L·H in [0, 1].
/// - *Value*: 0 at grazing to 1.
/// - *Outside*: cosines are brought into [0, 1]; signs of n and k are ignored.
/// - *Error*: 7.8 ulp in f32, 6.6 in f64.
#[inline(always)]
pub fn t_conductor<R: Real>(n: R, k: R, v_dot_h: R) -> R {
    let (reflected, transmitted) = conductor(n, k, v_dot_h);
    if transmitted < lit(0.5) {
        transmitted
    } else {
        lit::<R>(1.0) - reflected
    }
}

/// Reflectance and its complement.
#[inline(always)]
fn conductor<R: Real>(n: R, k: R, v_dot_h: R) -> (R, R) {
    let [zero, half, one, two] = [lit::<R>(0.0), lit(0.5), lit(1.0), lit(2.0)];
    let c = v_dot_h.clamp_unit();
    let (n, k) = (
        n.abs().at_most(lit(R::LARGE)),
        k.abs().at_most(lit(R::LARGE)),
    );
    // n² − k² − s² to its last digit, for the critical angle of n < 1.
    let ((nn, nn_low), (kk, kk_low)) = (n.two_prod(n), k.two_prod(k));
    let (cc, cc_low) = c.two_prod(c);
    let (x, x_low) = nn.two_sum(cc);
    let (y, y_low) = x.two_sum(-kk);
    let (z, z_low) = y.two_sum(-one);
    let t0 = z + (z_low + (y_low + (x_low + (nn_low + (cc_low - kk_low)))));
    let nk = n * k;
    let large = half * (t0.hypot(two * nk) + t0.abs());
    let small = if large > zero {
        nk * (nk / large)
    } else {
        large
    };
    // Their difference is |t0|, which is known to its last digit.
    let large = t0.abs() + small;
    let (a2, b2) = if t0 < zero {
        (small, large)
    } else {
        (large, small)
    };
    let a = a2.sqrt();
    let (back, back_low) = a.two_prod(a);
    let a_low = ((a2 - back) - back_low) / (two * a).at_least(lit(R::TINY));
    // a − c as (a² − c²)/(a + c), and a c − s² likewise, where they cancel and b is small. The
    // sums keep their rounding errors, since each counts four times.
    let b2_k2 = b2 - k * k;
    let n2_1 = (nn - one) + nn_low;
    let cancels = |difference: R, sum: R| t0 > zero && difference.abs() < half * sum;
    let without = |x: R, share: R| x - x * share;
    let (plus, plus_low) = a.two_sum(c);
    let plus_low = plus_low + a_low;
    let minus = (a - c) + a_low;
    let minus = if cancels(minus, plus) {
        without(n2_1 + b2_k2, plus_low / plus) / plus
    } else {
        minus
    };
    let den_s = plus * plus + (b2 + two * plus * plus_low);
    if den_s == zero {
        // Grazing, and no interface.
        return (zero, one);
    }
    let ((ac, ac_low), (s2, s2_low)) = (a.two_prod(c), one_minus_square(c));
    let (sum, sum_low) = ac.two_sum(s2);
    let sum_low = sum_low + (ac_low + s2_low + a_low * c);
    let difference = (ac - s2) + (ac_low - s2_low + a_low * c);
    let difference = if cancels(difference, sum) {
        let above = squares_above_one(c.two_prod(n), c).0 + c * c * b2_k2;
        without(above, sum_low / sum) / sum
    } else {
        difference
    };
    let bc2 = b2 * (c * c);
    let den_p = sum * sum + (bc2 + two * sum * sum_low);
    let r_s = (minus * minus + b2) / den_s;
    let t_s = lit::<R>(4.0) * (a * c) / den_s;
    // R_p/R_s and its complement.
    let (p, one_minus_p) = if den_p > zero {
        (
            (difference * difference + bc2) / den_p,
            lit::<R>(4.0) * (a * c) * s2 / den_p,
        )
    } else {
        (one, zero)
    };
    (half * r_s * (one + p), t_s + half * r_s * one_minus_p)
}

/// [`f_conductor`] in three colours.
///
/// - *Arguments*: `n` and `k` red, green and blue; `v_dot_h` V·H in [0, 1].
/// - *Error*: that of [`f_conductor`]. Many at once: [`crate::batch::conductor_rgb`].
#[inline(always)]
pub fn conductor_rgb<R: Real>(n: [R; 3], k: [R; 3], v_dot_h: R) -> [R; 3] {
    [0, 1, 2].map(|i| f_conductor(n[i], k[i], v_dot_h))
}

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

const N: Param = Param {
    name: "n",
    range: (0.05, 4.0),
    unit: "1",
    meaning: "real part of the index of refraction",
};
const K: Param = Param {
    name: "k",
    range: (0.0, 8.0),
    unit: "1",
    meaning: "imaginary part of the index of refraction",
};

const F_CONDUCTOR: Term = entry!(
    f_conductor(n: N, k: K, v_dot_h: V_DOT_H),
    symbol: "F_conductor", latex: r"F_{\mathrm{conductor}}", cost: 90,
    doc: "exact Fresnel reflectance of a conductor with index n + ik, unpolarised, 0 to 1",
    source: "Born and Wolf, optics of metals; Lagarde 2013",
    wgsl: Some("fn lobe_f_conductor(n: f32, k: f32, v_dot_h: f32) -> f32 {
    let c = clamp(v_dot_h, 0.0, 1.0);
    let s2 = (1.0 - c) * (1.0 + c);
    let t0 = n * n - k * k - s2;
    let nk = n * k;
    let large = 0.5 * (sqrt(t0 * t0 + 4.0 * nk * nk) + abs(t0));
    var small = 0.0;
    if (large > 0.0) { small = nk * (nk / large); }
    let a2 = select(large, small, t0 < 0.0);
    let b2 = select(small, large, t0 < 0.0);
    let a = sqrt(a2);
    let r_s = ((a - c) * (a - c) + b2) / ((a + c) * (a + c) + b2);
    let bc2 = b2 * c * c;
    let r_p = ((a * c - s2) * (a * c - s2) + bc2) / ((a * c + s2) * (a * c + s2) + bc2);
    return 0.5 * r_s * (1.0 + r_p);
}")
);

const T_CONDUCTOR: Term = entry!(
    t_conductor(n: N, k: K, v_dot_h: V_DOT_H),
    symbol: "T_conductor", latex: r"T_{\mathrm{conductor}}", cost: 90,
    doc: "share of the light that a conductor with index n + ik absorbs, unpolarised, 0 to 1",
    source: "Born and Wolf, optics of metals; Lagarde 2013",
    wgsl: Some("fn lobe_t_conductor(n: f32, k: f32, v_dot_h: f32) -> f32 {
    let c = clamp(v_dot_h, 0.0, 1.0);
    let s2 = (1.0 - c) * (1.0 + c);
    let t0 = n * n - k * k - s2;
    let nk = n * k;
    let large = 0.5 * (sqrt(t0 * t0 + 4.0 * nk * nk) + abs(t0));
    var small = 0.0;
    if (large > 0.0) { small = nk * (nk / large); }
    let a = sqrt(select(large, small, t0 < 0.0));
    let b2 = select(small, large, t0 < 0.0);
    let d_s = (a + c) * (a + c) + b2;
    if (d_s == 0.0) { return 1.0; }
    let ac = a * c;
    let t_s = 4.0 * ac / d_s;
    let r_s = ((a - c) * (a - c) + b2) / d_s;
    let p = ac + s2;
    return t_s + 0.5 * r_s * (4.0 * ac * s2 / (p * p + b2 * c * c));
}")
);

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

const F_LAZANYI: Term = entry!(
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
