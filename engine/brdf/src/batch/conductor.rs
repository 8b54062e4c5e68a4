//! The exact reflectance of a conductor in three colours.

use super::{Isa, Level, dispatch};
use crate::fresnel::f_conductor;
use crate::real::{Fused, Single, lit};
use std::f64::consts::PI;

/// One colour of a conductor, prepared: a of `f_conductor` as a polynomial in sin²θ.
///
/// Of the exact formula two roots and a quotient depend on sin²θ alone, and smoothly so for a
/// metal, whose singularities (n ± ik)² are far from [0, 1].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Conductor {
    n: f32,
    k: f32,
    /// Coefficients of a/polynomial in 2 sin²θ − 1, or `None` where too few digits would do.
    smooth: Option<[f32; COEFFICIENTS]>,
}

/// Of a polynomial of degree 5, which is enough for every metal.
const COEFFICIENTS: usize = 6;

impl Conductor {
    /// Fits the polynomial; its error is checked.
    pub fn new(n: f32, k: f32) -> Conductor {
        let (nn, kk) = (f64::from(n), f64::from(k));
        // a² = (sqrt(t² + 4 n² k²) + t)/2 with t = n² − k² − sin²θ, without cancellation.
        let a = |s2: f64| {
            let t = nn * nn - kk * kk - s2;
            let root = t.hypot(2.0 * nn * kk);
            let large = 0.5 * (root + t.abs());
            let a2 = if t < 0.0 {
                (nn * kk) * (nn * kk) / large
            } else {
                large
            };
            a2.sqrt()
        };
        let powers = interpolate(|x| a(0.5 + 0.5 * x));
        let polynomial = |x: f64| powers.iter().rev().fold(0.0, |sum, c| sum * x + c);
        // Where little is reflected, a − c would cancel what the polynomial rounds.
        let fits = k >= n
            && (0..=64).all(|i| {
                let s2 = f64::from(i) / 64.0;
                (polynomial(2.0 * s2 - 1.0) - a(s2)).abs() <= 3e-8 * a(s2)
            });
        Conductor {
            n,
            k,
            smooth: fits.then(|| powers.map(|c| c as f32)),
        }
    }
}

/// Powers of the polynomial through a function on [−1, 1] at Chebyshev's nodes.
fn interpolate(f: impl Fn(f64) -> f64) -> [f64; COEFFICIENTS] {
    let count = COEFFICIENTS as f64;
    let angle = |j: usize| PI * (j as f64 + 0.5) / count;
    let values: [f64; COEFFICIENTS] = std::array::from_fn(|j| f(libm::cos(angle(j))));
    let mut powers = [0.0; COEFFICIENTS];
    // T_0 = 1, T_1 = x, T_{i+1} = 2 x T_i − T_{i−1}.
    let (mut before, mut now) = ([0.0; COEFFICIENTS], [0.0; COEFFICIENTS]);
    now[0] = 1.0;
    for i in 0..COEFFICIENTS {
        let factor = if i == 0 { 1.0 } else { 2.0 };
        let sum: f64 = (0..COEFFICIENTS)
            .map(|j| values[j] * libm::cos(i as f64 * angle(j)))
            .sum();
        let mut next = before.map(|x: f64| -x);
        for j in 0..COEFFICIENTS {
            powers[j] += factor * sum / count * now[j];
            if j > 0 {
                next[j] += factor * now[j - 1];
            }
        }
        (before, now) = (now, next);
    }
    powers
}

/// Exact reflectance of a conductor in three colours, see [`crate::f_conductor`].
///
/// Within 12 ulps, from a polynomial where k ≥ n and one fits; else the formula itself.
pub fn conductor_rgb(isa: Isa, colors: &[Conductor; 3], v_dot_h: &[f32], out: [&mut [f32]; 3]) {
    let [red, green, blue] = out;
    dispatch!(isa, conductor_body(colors: &[Conductor; 3], v_dot_h: &[f32], red: &mut [f32], green: &mut [f32], blue: &mut [f32]))
}

#[inline(always)]
fn conductor_body<S: Single>(
    colors: &[Conductor; 3],
    v_dot_h: &[f32],
    red: &mut [f32],
    green: &mut [f32],
    blue: &mut [f32],
) {
    let n = v_dot_h
        .len()
        .min(red.len())
        .min(green.len())
        .min(blue.len());
    let (v_dot_h, red, green, blue) = (
        &v_dot_h[..n],
        &mut red[..n],
        &mut green[..n],
        &mut blue[..n],
    );
    let metals = colors.map(|color| Metal::<S>::new(&color));
    let [Some(metal_r), Some(metal_g), Some(metal_b)] = metals else {
        for i in 0..n {
            let at = |color: &Conductor| {
                f_conductor(S::load(color.n), S::load(color.k), S::load(v_dot_h[i])).store()
            };
            (red[i], green[i], blue[i]) = (at(&colors[0]), at(&colors[1]), at(&colors[2]));
        }
        return;
    };
    for i in 0..n {
        let c = S::load(v_dot_h[i]).at_least(lit(0.0)).at_most(lit(1.0));
        red[i] = metal_r.reflectance(c).store();
        green[i] = metal_g.reflectance(c).store();
        blue[i] = metal_b.reflectance(c).store();
    }
}

/// A conductor whose polynomial fits.
#[derive(Clone, Copy)]
struct Metal<S> {
    /// Of a in 2 sin²θ − 1.
    a: [S; COEFFICIENTS],
    /// k² − n².
    difference: S,
}

impl<S: Single> Metal<S> {
    #[inline(always)]
    fn new(color: &Conductor) -> Option<Metal<S>> {
        let (n, k) = (f64::from(color.n), f64::from(color.k));
        color.smooth.map(|smooth| Metal {
            a: smooth.map(S::load),
            difference: lit(k * k - n * n),
        })
    }

    /// F = (R_s + R_s R_p/R_s)/2 as one quotient.
    #[inline(always)]
    fn reflectance(&self, c: S) -> S {
        let one = lit::<S>(1.0);
        let (c2, s2) = (c * c, (one - c) * (one + c));
        let x = lit::<S>(2.0).mul_add(s2, -one);
        let [c0, c1, c2_, c3, c4, c5] = self.a;
        let a = c5
            .mul_add(x, c4)
            .mul_add(x, c3)
            .mul_add(x, c2_)
            .mul_add(x, c1)
            .mul_add(x, c0);
        let b2 = a.mul_add(a, self.difference + s2);
        let (minus, plus) = (a - c, a + c);
        let (n_s, d_s) = (minus.mul_add(minus, b2), plus.mul_add(plus, b2));
        let (ac, bc2) = (a * c, b2 * c2);
        let (minus, plus) = (ac - s2, ac + s2);
        let (n_p, d_p) = (minus.mul_add(minus, bc2), plus.mul_add(plus, bc2));
        lit::<S>(0.5) * n_s * (d_p + n_p) / (d_s * d_p)
    }
}
