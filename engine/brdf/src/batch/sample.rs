//! Drawing lights for one view.

use super::specular::above;
use super::{Isa, Level, dispatch, sin_cos_turn};
use crate::real::{Fused, Single, lit};
use glam::Vec3;
use std::f64::consts::FRAC_1_PI;

/// What [`sample`] returns, as slices to fill: the light's components, its density in 1/sr, and
/// the weight BRDF · N·L / density with F = 1.
#[derive(Debug)]
pub struct Samples<'a> {
    /// Light along the tangent, the bitangent and the normal.
    pub l: [&'a mut [f32]; 3],
    /// Density.
    pub pdf: &'a mut [f32],
    /// Weight; 0 below the horizon.
    pub weight: &'a mut [f32],
}

/// Draws lights for one view by bounded caps (Eto and Tokuyoshi 2023), from numbers in [0, 1).
///
/// See [`crate::Ggx::sample`]. The view is expected above the horizon, of length 1.
pub fn sample(isa: Isa, v: Vec3, alpha: f32, u: [&[f32]; 2], out: Samples) {
    dispatch!(isa, sample_body(v: Vec3, alpha: f32, u: [&[f32]; 2], out: Samples))
}

#[inline(always)]
fn sample_body<S: Single>(v: Vec3, alpha: f32, u: [&[f32]; 2], out: Samples) {
    let [x, y, z] = out.l;
    let (pdf, weight) = (out.pdf, out.weight);
    let n = [
        u[0].len(),
        u[1].len(),
        x.len(),
        y.len(),
        z.len(),
        pdf.len(),
        weight.len(),
    ];
    let n = n.into_iter().fold(usize::MAX, usize::min);
    let [u0, u1] = u.map(|u| &u[..n]);
    let [x, y, z, pdf, weight] = [x, y, z, pdf, weight].map(|out| &mut out[..n]);
    let one = lit::<S>(1.0);
    let cap = Cap::new(v, alpha);
    let known = cap.map(lit::<S>);
    let v = v.to_array().map(S::load);
    for i in 0..n {
        // How far below the pole of the cap, and how far above its rim, without differences.
        let (below, rise) = (S::load(u1[i]), one - S::load(u1[i]));
        let sin2 = (known.depth * below) * rise.mul_add(known.depth, known.rim);
        let sin = sin2.sqrt();
        let (sin_phi, cos_phi) = sin_cos_turn(S::load(u0[i]));
        // The half vector where the surface is stretched to α = 1, without its length: the sum
        // of two directions.
        let [x_view, y_view] = known.view;
        let h = [
            sin.mul_add(cos_phi, x_view),
            sin.mul_add(sin_phi, y_view),
            rise.mul_add(known.depth, known.lowest),
        ];
        let (across, up) = (h[0].mul_add(h[0], h[1] * h[1]), h[2] * h[2]);
        // |h|², which is 2 V·M over the stretched view's length, and the square of its length on
        // the surface: their quotient is in the mirror and in D.
        let (stretched, squeezed) = (across + up, known.a2.mul_add(across, up));
        let mirror = stretched / squeezed;
        let (aside, upward) = (known.aside * mirror, known.upward * mirror);
        let l = [
            aside.mul_add(h[0], -v[0]),
            aside.mul_add(h[1], -v[1]),
            upward.mul_add(h[2], -v[2]),
        ];
        let density = squeezed / stretched;
        x[i] = l[0].store();
        y[i] = l[1].store();
        z[i] = l[2].store();
        pdf[i] = (density * density * known.density).store();
    }
    for i in 0..n {
        let l = S::load(z[i]);
        let l_length = (l * l).mul_add(known.rest, known.a2).sqrt();
        let w = l.mul_add(known.length, known.z * l_length);
        weight[i] = above(l, l / w).store();
    }
}

/// What depends on the view and the width alone.
#[derive(Clone, Copy)]
struct Cap<R> {
    /// From the cap's pole to its rim.
    depth: R,
    /// Height of the rim over the sphere's lowest point.
    rim: R,
    /// Height of the lowest half vector.
    lowest: R,
    /// The stretched view, of length 1, along the tangent and the bitangent.
    view: [R; 2],
    /// α² and 1 − α².
    a2: R,
    rest: R,
    /// The stretched view's length times α, and as it is.
    aside: R,
    upward: R,
    /// Density over the square of the quotient of lengths.
    density: R,
    /// The factors of the weight's divisor: infinite for a view below the horizon.
    length: R,
    z: R,
}

impl Cap<f64> {
    #[inline(always)]
    fn new(v: Vec3, alpha: f32) -> Cap<f64> {
        let ([x, y, z], a) = (v.to_array().map(f64::from), f64::from(alpha));
        let (a2, rest) = (a * a, (1.0 - a) * (1.0 + a));
        let across = x * x + y * y;
        let length = (z * z + a2 * across).sqrt();
        let s = 1.0 + across.sqrt();
        let bound = if alpha < 1.0 {
            rest * (s * s) / (a2 * (z * z) + s * s)
        } else {
            0.0
        };
        let low = bound * (z / length);
        // Density over D.
        let share = 0.5 / (bound * z + length);
        let lit = if z > 0.0 { 2.0 * share } else { f64::INFINITY };
        Cap {
            depth: 1.0 + low,
            rim: 1.0 - low,
            lowest: (1.0 - bound) * (z / length),
            view: [a * x / length, a * y / length],
            a2,
            rest,
            aside: length * a,
            upward: length,
            density: share * FRAC_1_PI / a2,
            length: length * lit,
            z: z * lit,
        }
    }

    #[inline(always)]
    fn map<R>(self, f: impl Fn(f64) -> R) -> Cap<R> {
        Cap {
            depth: f(self.depth),
            rim: f(self.rim),
            lowest: f(self.lowest),
            view: self.view.map(&f),
            a2: f(self.a2),
            rest: f(self.rest),
            aside: f(self.aside),
            upward: f(self.upward),
            density: f(self.density),
            length: f(self.length),
            z: f(self.z),
        }
    }
}
