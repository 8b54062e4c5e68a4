//! Fresnel's equations for a metal.

use super::squares_above_one;
use crate::real::{Real, lit, one_minus_square};
use crate::term::{Param, Term, V_DOT_H, entry};

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
/// - *Source*: as [`f_conductor`].
/// - *Arguments*: `n` and `k` red, green and blue, each at least 0; `v_dot_h` V·H in [0, 1].
/// - *Value*: red, green and blue, each 0 to 1.
/// - *Outside*: as [`f_conductor`].
/// - *Error*: that of [`f_conductor`]. Many at once: [`batch::conductor_rgb`](crate::batch::conductor_rgb).
#[inline(always)]
pub fn conductor_rgb<R: Real>(n: [R; 3], k: [R; 3], v_dot_h: R) -> [R; 3] {
    [0, 1, 2].map(|i| f_conductor(n[i], k[i], v_dot_h))
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

pub(super) const F_CONDUCTOR: Term = entry!(
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

pub(super) const T_CONDUCTOR: Term = entry!(
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
