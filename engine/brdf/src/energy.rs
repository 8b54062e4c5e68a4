//! Energy that single scattering loses, and how it is put back.
//!
//! | symbol | item | source |
//! |---|---|---|
//! | E_avg | [`albedo_average_ggx`] | Kulla and Conty 2017 |
//! | f_ms | [`f_multi_kulla_conty`] | Kulla and Conty 2017 |
//! | F_ms | [`multi_scattering_tint`] | Kulla and Conty 2017; Jakob et al. 2014 |
//! | 1 + f0 (1 − E)/E | [`compensation_turquin`] | Turquin 2019, eq. 16 |
//! | E as a table | [`AlbedoTable`] | |
//!
//! A microfacet BRDF with F = 1 returns E(μ) < 1: what meets the surface a second time is lost, seen
//! straight on 30 % at α = 0.49 and 69 % at α = 1. Both remedies need E, by quadrature ([`albedo_ggx`]) or from a table of it.
//! Kulla and Conty's lobe is reciprocal and exact; Turquin's factor is cheap, exact for f0 = 1, and not
//! reciprocal.

use crate::integral::albedo_ggx;
use crate::real::{Real, lit, zero_unless_nan};
use crate::term::{ALPHA, N_DOT_L, N_DOT_V, Param, Term, entry};
use std::f64::consts::FRAC_1_PI;

pub(crate) const TERMS: &[Term] = &[
    ALBEDO_AVERAGE_GGX,
    F_MULTI_KULLA_CONTY,
    COMPENSATION_TURQUIN,
];

/// Average albedo of GGX with F = 1, height-correlated.
///
/// ```text
/// E_avg = 2 ∫ E(μ) μ dμ,    (4 − 4 ln 2)/3 at α = 1
/// ```
///
/// - *Source*: Kulla and Conty 2017; by quadrature of [`albedo_ggx`] in μ = y³, which spreads the
///   grazing views.
/// - *Arguments*: `alpha` α = roughness² in [0, 1].
/// - *Value*: 0.409 (α = 1) to 1 (a mirror).
/// - *Outside*: the sign of α is ignored.
/// - *Error*: that of [`albedo_ggx`], averaged.
///
/// ```
/// let exact = 4.0 * (1.0 - 2f64.ln()) / 3.0; // at α = 1
/// assert!((brdf::albedo_average_ggx(1.0f64) - exact).abs() < 1e-9);
/// ```
pub fn albedo_average_ggx<R: Real>(alpha: R) -> R {
    if alpha.is_nan() {
        return alpha;
    }
    let mut sum = lit::<R>(0.0);
    for &(y, weight) in crate::integral::average_nodes() {
        let y = lit::<R>(y);
        let mu = y * y * y;
        sum = sum + lit::<R>(6.0 * weight) * (y * y * mu) * albedo_ggx(mu, alpha);
    }
    sum
}

const ALBEDO_AVERAGE_GGX: Term = entry!(
    albedo_average_ggx(alpha: ALPHA),
    symbol: "E_avg", latex: r"E_{\mathrm{avg}}", cost: 4_000_000,
    doc: "cosine-weighted average of the directional albedo of GGX with F = 1, 0 to 1",
    source: "Kulla and Conty 2017; quadrature",
    wgsl: None
);

/// The multiple-scattering lobe of Kulla and Conty.
///
/// ```text
/// f_ms = (1 − E(l))(1 − E(v))/(π (1 − E_avg))
/// ```
///
/// - *Source*: Kulla and Conty 2017.
/// - *Arguments*: `albedo_l` E(l); `albedo_v` E(v); `albedo_average` E_avg, all in [0, 1].
/// - *Value*: 1/sr. Added to the BRDF with F = 1 it restores what is lost, exactly. Reciprocal.
/// - *Outside*: albedos are brought into [0, 1]; where nothing is lost (E_avg = 1) it is 0.
/// - *Error*: 4.7 ulp in f32, 4.6 in f64.
///
/// ```
/// use brdf::{albedo_average_ggx, albedo_ggx, f_multi_kulla_conty};
/// let alpha = 0.5f64;
/// let (l, v) = (albedo_ggx(0.8, alpha), albedo_ggx(0.6, alpha));
/// let added = f_multi_kulla_conty(l, v, albedo_average_ggx(alpha)); // in 1/sr
/// let average = albedo_average_ggx(alpha);
/// assert!((added * std::f64::consts::PI * (1.0 - average) - (1.0 - l) * (1.0 - v)).abs() < 1e-15);
/// ```
pub fn f_multi_kulla_conty<R: Real>(albedo_l: R, albedo_v: R, albedo_average: R) -> R {
    let one = lit::<R>(1.0);
    let lost = |e: R| one - e.clamp_unit();
    let average = lost(albedo_average);
    if average == lit(0.0) {
        return zero_unless_nan([albedo_l, albedo_v]);
    }
    lost(albedo_l) * lost(albedo_v) / average * lit(FRAC_1_PI)
}

const ALBEDO_L: Param = Param {
    name: "albedo_l",
    range: (0.0, 1.0),
    meaning: "directional albedo of the light's direction",
    ..N_DOT_L
};
const ALBEDO_V: Param = Param {
    name: "albedo_v",
    range: (0.05, 1.0),
    meaning: "directional albedo of the view",
    ..N_DOT_V
};
const ALBEDO_AVERAGE: Param = Param {
    name: "albedo_average",
    range: (0.0, 0.99),
    meaning: "average albedo",
    ..N_DOT_V
};

const F_MULTI_KULLA_CONTY: Term = entry!(
    f_multi_kulla_conty(albedo_l: ALBEDO_L, albedo_v: ALBEDO_V, albedo_average: ALBEDO_AVERAGE),
    symbol: "f_ms", latex: r"f_{\mathrm{ms}}", cost: 8,
    doc: "multiple-scattering lobe of Kulla and Conty, in 1/sr",
    source: "Kulla and Conty 2017",
    wgsl: Some("fn lobe_f_multi_kulla_conty(albedo_l: f32, albedo_v: f32, albedo_average: f32) -> f32 {
    return (1.0 - albedo_l) * (1.0 - albedo_v) / max(1.0 - albedo_average, 1.0e-6) * 0.31830988618379067;
}")
);

/// The colour of Kulla and Conty's lobe: light that leaves after two and more bounces.
///
/// ```text
/// F_ms = F_avg² E_avg/(1 − F_avg (1 − E_avg))
/// ```
///
/// - *Source*: Kulla and Conty 2017, with the power of F_avg as Hill corrected it (Jakob et al.
///   2014).
/// - *Arguments*: `f_average` F_avg in [0, 1]; `albedo_average` E_avg, all in [0, 1].
/// - *Value*: 0 to 1; multiply [`f_multi_kulla_conty`] by it, with F_avg of
///   [`f_schlick_average`](crate::f_schlick_average).
/// - *Outside*: both are brought into [0, 1].
/// - *Error*: 3.5 ulp in f32, 3.2 in f64.
///
/// ```
/// // What bounces more often takes on more of the colour.
/// let gold = [1.0f64, 0.77, 0.34].map(|f0| brdf::f_schlick_average(f0));
/// let [red, _, blue] = gold.map(|f| brdf::multi_scattering_tint(f, 0.6));
/// assert!(blue / red < gold[2] / gold[0]);
/// ```
pub fn multi_scattering_tint<R: Real>(f_average: R, albedo_average: R) -> R {
    let one = lit::<R>(1.0);
    let (f, e) = (f_average.clamp_unit(), albedo_average.clamp_unit());
    if f == one {
        return one;
    }
    // The divisor as a sum: 1 − F_avg (1 − E_avg) cancels where little is absorbed.
    f * f * e / ((one - f) + f * e)
}

/// Turquin's factor on the whole single-scattering lobe.
///
/// ```text
/// c = 1 + f0 (1 − E(v))/E(v)
/// ```
///
/// - *Source*: Turquin 2019, eq. 16.
/// - *Arguments*: `f0` the reflectance at normal incidence in [0, 1]; `albedo_v` E(v).
/// - *Value*: 1 to 1/E. With f0 = 1 the albedo becomes exactly 1.
/// - *Outside*: f0 is brought into [0, 1]; E(v) is expected to be more than 0.
/// - *Error*: 1.6 ulp.
/// - *Right and wrong*: cheap and not reciprocal: only the view enters.
///
/// ```
/// // What a white metal loses is put back, all of it.
/// let e = brdf::albedo_ggx(0.6f64, 0.8);
/// assert!((e * brdf::compensation_turquin(1.0, e) - 1.0).abs() < 1e-15);
/// ```
pub fn compensation_turquin<R: Real>(f0: R, albedo_v: R) -> R {
    let one = lit::<R>(1.0);
    let e = albedo_v.at_least(lit(R::TINY)).at_most(one);
    one + f0.clamp_unit() * (one - e) / e
}

const COMPENSATION_TURQUIN: Term = entry!(
    compensation_turquin(f0: crate::term::F0, albedo_v: ALBEDO_V),
    symbol: "c_Turquin", latex: r"c_{\mathrm{Turquin}}", cost: 4,
    doc: "Turquin's energy compensation: factor on the single-scattering lobe",
    source: "Turquin 2019, eq. 16",
    wgsl: Some("fn lobe_compensation_turquin(f0: f32, albedo_v: f32) -> f32 {
    return 1.0 + f0 * (1.0 - albedo_v) / albedo_v;
}")
);

/// A table of E over N·V and roughness, for callers that cannot wait for a quadrature.
///
/// E of GGX with F = 1 and the height-correlated G₂, [`albedo_ggx`], at the centres of a square grid.
///
/// ```
/// let table = brdf::AlbedoTable::new(16);
/// assert_eq!(table.values().len(), 16 * 16);
/// let (n_dot_v, roughness) = (0.7f32, 0.6f32);
/// let exact = brdf::albedo_ggx(n_dot_v, roughness * roughness);
/// assert!((table.get(n_dot_v, roughness) - exact).abs() < 1e-3);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct AlbedoTable {
    size: usize,
    /// Row by row of constant roughness; entries at (i + ½)/size.
    values: Vec<f32>,
}

impl AlbedoTable {
    /// Computes `size`² entries, about 10 µs each.
    ///
    /// - *Arguments*: `size` entries a side; 0 counts as 1.
    pub fn new(size: usize) -> AlbedoTable {
        let size = size.max(1);
        let at = |i: usize| (i as f32 + 0.5) / size as f32;
        let entry = |i: usize| albedo_ggx(at(i % size), at(i / size) * at(i / size));
        AlbedoTable {
            size,
            values: (0..size * size).map(entry).collect(),
        }
    }

    /// All entries, as a texture is laid out: row by row of constant roughness, N·V along the row, both at
    /// (i + ½)/size.
    pub fn values(&self) -> &[f32] {
        &self.values
    }

    /// E between the entries, bilinear.
    ///
    /// - *Arguments*: `n_dot_v` N·V in [0, 1]; `roughness` in [0, 1], the square root of α.
    /// - *Value*: 0 to 1.
    /// - *Outside*: beyond the outermost entries the nearest, also for arguments outside [0, 1].
    /// - *Error*: of 64 by 64 entries up to 2.5 % of the value at N·V = 0.05, and 7e-5 in the median of
    ///   the points that are tried; up to 0.11 below the first entry, at N·V of 1e-4 and roughness of 0.01.
    pub fn get(&self, n_dot_v: f32, roughness: f32) -> f32 {
        let last = self.size - 1;
        let place = |x: f32| {
            let x = (x * self.size as f32 - 0.5).clamp(0.0, last as f32);
            let low = (x as usize).min(last);
            (low, (low + 1).min(last), x - low as f32)
        };
        let ((i, i1, s), (j, j1, t)) = (place(n_dot_v), place(roughness));
        let row = |j: usize| {
            let at = |i: usize| self.values[j * self.size + i];
            at(i) * (1.0 - s) + at(i1) * s
        };
        row(j) * (1.0 - t) + row(j1) * t
    }
}
