//! The exact reflectance of a conductor in three colours.

use super::lanes::{At, Column, Kernel, Lanes, Out, leave, run};
use super::{Isa, Level, dispatch, dispatch_lanes};
use crate::fresnel::f_conductor;
use crate::real::{Real, Single};
use std::f64::consts::PI;

/// One colour of a conductor, prepared: its reflectance as one quotient.
///
/// For a given n and k the exact formula is a smooth function of the cosine alone. Its poles lie
/// at negative cosines, close to 0 beside what a polynomial could follow; a quotient of two
/// polynomials of degree 4 does, for every metal, to far less than single precision can hold.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Conductor {
    n: f32,
    k: f32,
    /// `None` where too few digits would do: mostly where k is below 1.
    quotient: Option<Quotient<f32>>,
}

/// Of both polynomials.
const DEGREE: usize = 4;

/// Values that the quotient is fitted to.
const NODES: usize = 48;

/// The unknown coefficients: the first of the divisor is 1.
const UNKNOWNS: usize = 2 * DEGREE + 1;

/// Most that the quotient, computed in single precision, may be wrong where it is tried.
const TOLERATED_ULPS: f64 = 11.0;

/// Dividend and divisor by powers of the cosine, lowest first; where it is used, the highest
/// power of the divisor has the factor 1, which saves a product.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Quotient<R> {
    dividend: [R; DEGREE + 1],
    divisor: [R; DEGREE + 1],
}

impl<R: Real> Quotient<R> {
    #[inline(always)]
    fn at(&self, c: R) -> R {
        let horner = |[c0, c1, c2, c3, c4]: [R; DEGREE + 1]| {
            c4.mul_add(c, c3)
                .mul_add(c, c2)
                .mul_add(c, c1)
                .mul_add(c, c0)
        };
        horner(self.dividend) / horner(self.divisor)
    }

    fn map<S>(&self, f: impl Fn(R) -> S) -> Quotient<S> {
        Quotient {
            dividend: self.dividend.map(&f),
            divisor: self.divisor.map(&f),
        }
    }
}

impl Conductor {
    /// Fits the quotient, and tries it at 4,097 cosines: half a millisecond or so.
    ///
    /// - *Arguments*: `n` and `k` the index of refraction n + ik.
    pub fn new(n: f32, k: f32) -> Conductor {
        let exact = |c: f64| f_conductor(f64::from(n), f64::from(k), c);
        let quotient = fit(exact).map(|fitted| {
            let highest = fitted.divisor[DEGREE];
            fitted.map(|c| (c / highest) as f32)
        });
        Conductor {
            n,
            k,
            quotient: quotient.filter(|quotient| {
                (0..=4096).all(|i| {
                    // Closer together towards grazing.
                    let c = (i as f32 / 4096.0) * (i as f32 / 4096.0);
                    let truth = exact(f64::from(c));
                    let ulp = (libm::log2(truth).floor() - 23.0).exp2();
                    (f64::from(quotient.at(c)) - truth).abs() <= TOLERATED_ULPS * ulp
                })
            }),
        }
    }
}

/// Fits to a function on [0, 1], with relative errors that are nearly even.
///
/// Linear least squares of f · divisor − dividend, again and again: divided by the last
/// divisor (Sanathanan and Koerner 1963), and with larger weights where the last error was
/// large (Lawson 1961). The best of all is kept.
fn fit(f: impl Fn(f64) -> f64) -> Option<Quotient<f64>> {
    let angle = |i: usize| PI * (i as f64 + 0.5) / NODES as f64;
    let nodes: [f64; NODES] = std::array::from_fn(|i| 0.5 + 0.5 * libm::cos(angle(i)));
    let values = nodes.map(f);
    let (mut divisor, mut weight) = ([1.0; NODES], [1.0; NODES]);
    let mut best: Option<(f64, Quotient<f64>)> = None;
    for _ in 0..6 {
        let mut rows: Vec<[f64; UNKNOWNS + 1]> = (0..NODES)
            .map(|i| {
                let scale = weight[i] / (divisor[i] * values[i]);
                let mut power = scale;
                let mut row = [0.0; UNKNOWNS + 1];
                for j in 0..=DEGREE {
                    row[j] = power;
                    if j > 0 {
                        row[DEGREE + j] = -values[i] * power;
                    }
                    power *= nodes[i];
                }
                row[UNKNOWNS] = values[i] * scale;
                row
            })
            .collect();
        let x = least_squares(&mut rows);
        let mut quotient = Quotient {
            dividend: [0.0; DEGREE + 1],
            divisor: [1.0; DEGREE + 1],
        };
        quotient.dividend.copy_from_slice(&x[..=DEGREE]);
        quotient.divisor[1..].copy_from_slice(&x[DEGREE + 1..]);
        let errors: [f64; NODES] =
            std::array::from_fn(|i| (quotient.at(nodes[i]) / values[i] - 1.0).abs());
        let worst = errors.into_iter().fold(0.0, f64::max);
        if !worst.is_finite() {
            break;
        }
        if best.is_none_or(|(least, _)| worst < least) {
            best = Some((worst, quotient));
        }
        for i in 0..NODES {
            let c = nodes[i];
            let value = quotient
                .divisor
                .iter()
                .rev()
                .fold(0.0, |sum, d| sum * c + d);
            divisor[i] = value.abs();
            weight[i] *= (errors[i] / worst.max(f64::MIN_POSITIVE) + 1e-3).sqrt();
        }
    }
    best.map(|(_, quotient)| quotient)
}

/// Solves rows [a | b] for the x that makes |a x − b| least, by Gram and Schmidt.
fn least_squares(rows: &mut [[f64; UNKNOWNS + 1]]) -> [f64; UNKNOWNS] {
    // The columns become orthogonal, b is left with the rest; what was taken away is the
    // triangle.
    let mut triangle = [[0.0; UNKNOWNS + 1]; UNKNOWNS];
    for j in 0..UNKNOWNS {
        let square: f64 = rows.iter().map(|row| row[j] * row[j]).sum();
        for k in j + 1..=UNKNOWNS {
            let share = rows.iter().map(|row| row[j] * row[k]).sum::<f64>() / square;
            triangle[j][k] = share;
            for row in rows.iter_mut() {
                row[k] -= share * row[j];
            }
        }
    }
    let mut x = [0.0; UNKNOWNS];
    for j in (0..UNKNOWNS).rev() {
        let known: f64 = (j + 1..UNKNOWNS).map(|k| triangle[j][k] * x[k]).sum();
        x[j] = triangle[j][UNKNOWNS] - known;
    }
    x
}

/// Exact reflectance of a conductor in three colours, see [`crate::f_conductor`].
///
/// - *Arguments*: `colors` red, green and blue, prepared once; `v_dot_h` the cosines V·H; `out`
///   red, green and blue.
/// - *Value*: 0 to 1.
/// - *Outside*: cosines are brought into [0, 1].
/// - *Error*: 10.8 ulp, by the quotient of [`Conductor`] where all three colours have one; else
///   the formula itself.
pub fn conductor_rgb(isa: Isa, colors: &[Conductor; 3], v_dot_h: &[f32], out: [&mut [f32]; 3]) {
    let n = out
        .iter()
        .map(|out| out.len())
        .fold(v_dot_h.len(), usize::min);
    let v_dot_h = &v_dot_h[..n];
    if let [Some(r), Some(g), Some(b)] = colors.map(|color| color.quotient) {
        let colors = &[r, g, b];
        dispatch_lanes!(isa, quotients(colors: &[Quotient<f32>; 3], v_dot_h: &[f32], out: [&mut [f32]; 3]))
    } else {
        let [red, green, blue] = out.map(|out| &mut out[..n]);
        dispatch!(isa, formula(colors: &[Conductor; 3], v_dot_h: &[f32], red: &mut [f32], green: &mut [f32], blue: &mut [f32]))
    }
}

#[inline(always)]
fn formula<S: Single>(
    colors: &[Conductor; 3],
    v_dot_h: &[f32],
    red: &mut [f32],
    green: &mut [f32],
    blue: &mut [f32],
) {
    for (i, &c) in v_dot_h.iter().enumerate() {
        let at =
            |color: &Conductor| f_conductor(S::load(color.n), S::load(color.k), S::load(c)).store();
        (red[i], green[i], blue[i]) = (at(&colors[0]), at(&colors[1]), at(&colors[2]));
    }
}

#[inline(always)]
fn quotients<V: Lanes, T: Lanes>(
    colors: &[Quotient<f32>; 3],
    v_dot_h: &[f32],
    out: [&mut [f32]; 3],
) {
    let n = v_dot_h.len();
    let kernel = Quotients {
        colors: *colors,
        v_dot_h: Column::new(v_dot_h, n),
        out: out.map(|out| Out::new(out, n)),
    };
    run::<V, T, _>(n, &kernel);
}

/// Dividend and divisor as far as the third highest power.
#[inline(always)]
fn begun<S: Lanes>(color: &Quotient<f32>, c: S) -> [S; 2] {
    let [[_, _, p2, p3, p4], [_, _, q2, q3, _]] = [&color.dividend, &color.divisor];
    let dividend = S::splat(*p4).mul_add(c, S::splat(*p3));
    let divisor = c + S::splat(*q3);
    [
        dividend.mul_add(c, S::splat(*p2)),
        divisor.mul_add(c, S::splat(*q2)),
    ]
}

/// The two lowest powers.
#[inline(always)]
fn done<S: Lanes>(color: &Quotient<f32>, c: S, dividend: S, divisor: S) -> [S; 2] {
    let [[p0, p1, ..], [q0, q1, ..]] = [&color.dividend, &color.divisor];
    let dividend = dividend.mul_add(c, S::splat(*p1));
    let divisor = divisor.mul_add(c, S::splat(*q1));
    [
        dividend.mul_add(c, S::splat(*p0)),
        divisor.mul_add(c, S::splat(*q0)),
    ]
}

struct Quotients<'a> {
    colors: [Quotient<f32>; 3],
    v_dot_h: Column<'a>,
    out: [Out<'a>; 3],
}

impl<S: Lanes> Kernel<S, 6> for Quotients<'_> {
    const STAGES: usize = 3;

    #[inline(always)]
    fn stage<const STAGE: usize>(&self, at: At, left: [S; 6]) -> [S; 6] {
        let [r, g, b] = &self.colors;
        match STAGE {
            0 => {
                let c = self.v_dot_h.at::<S>(at);
                let c = c.at_least(S::splat(0.0)).at_most(S::splat(1.0));
                let ([r0, r1], [g0, g1], [b0, b1]) = (begun(r, c), begun(g, c), begun(b, c));
                let (r, g, b) = (done(r, c, r0, r1), done(g, c, g0, g1), done(b, c, b0, b1));
                leave([r[0], r[1], g[0], g[1], b[0], b[1]])
            }
            1 => {
                let [r0, r1, g0, g1, b0, b1] = left;
                leave([r0 / r1, g0 / g1, b0 / b1])
            }
            _ => {
                let [r, g, b, ..] = left;
                self.out[0].put(at, r);
                self.out[1].put(at, g);
                self.out[2].put(at, b);
                left
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(n: f32, k: f32, fits: bool) {
        assert_eq!(Conductor::new(n, k).quotient.is_some(), fits, "{n} {k}");
    }

    #[test]
    fn a_quotient_fits_metals() {
        // Silver, gold, copper, aluminium, iron and chromium, red, green and blue.
        for (n, k) in [
            (0.155, 4.828),
            (0.117, 3.122),
            (0.138, 2.147),
            (0.143, 3.983),
            (0.375, 2.386),
            (1.442, 1.603),
            (0.2, 3.924),
            (0.924, 2.447),
            (1.102, 2.142),
            (1.346, 7.475),
            (0.965, 6.4),
            (0.617, 5.303),
            (2.911, 3.089),
            (2.95, 2.932),
            (2.584, 2.767),
            (3.18, 3.3),
        ] {
            check(n, k, true);
        }
        // Nearly a dielectric near its critical angle; and nothing that is a number.
        check(0.7, 0.01, false);
        check(f32::NAN, 1.0, false);
        check(1.0, f32::INFINITY, false);
        check(0.0, 0.0, false);
    }
}
