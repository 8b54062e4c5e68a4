//! Drawing lights for one view.

use super::lanes::{At, Column, Kernel, Lanes, Out, run};
use super::{Isa, Level, dispatch_lanes, sin_cos_turn};
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
    dispatch_lanes!(isa, sample_body(v: Vec3, alpha: f32, u: [&[f32]; 2], out: Samples))
}

#[inline(always)]
fn sample_body<V: Lanes, T: Lanes>(v: Vec3, alpha: f32, u: [&[f32]; 2], out: Samples) {
    let [x, y, z] = out.l;
    let out = [x, y, z, out.pdf, out.weight];
    let n = out.iter().map(|out| out.len());
    let n = n.chain(u.map(<[f32]>::len)).fold(usize::MAX, usize::min);
    let [x, y, z, pdf, weight] = out.map(|out| Out::new(out, n));
    let drawing = Drawing {
        cap: Cap::new(v, alpha),
        v: v.to_array(),
        u: u.map(|u| Column::new(u, n)),
        l: [x, y, z],
        pdf,
        weight,
    };
    run::<V, T>(n, &drawing);
}

struct Drawing<'a> {
    cap: Cap,
    v: [f32; 3],
    u: [Column<'a>; 2],
    l: [Out<'a>; 3],
    pdf: Out<'a>,
    weight: Out<'a>,
}

impl<S: Lanes> Kernel<S> for Drawing<'_> {
    /// Sine of the angle from the cap's pole, sine and cosine of that around it, and how far up
    /// the half vector reaches.
    type First = [S; 4];
    /// The half vector, and how long it is where the surface is stretched over how long it is on
    /// the surface, squared.
    type Second = [S; 4];
    /// The light's height, the root of the weight, and the density.
    type Third = [S; 3];

    #[inline(always)]
    fn first(&self, at: At) -> [S; 4] {
        let cap = &self.cap;
        let (u0, u1) = (self.u[0].at::<S>(at), self.u[1].at::<S>(at));
        // How far below the pole of the cap, and how far above the lowest point of its rim,
        // without differences.
        let depth = S::splat(cap.depth);
        let up = (S::splat(1.0) - u1).mul_add(depth, S::splat(cap.lowest));
        let sin2 = (depth * u1) * (up + S::splat(cap.under));
        let (sin_phi, cos_phi) = sin_cos_turn(u0);
        [sin2.sqrt(), sin_phi, cos_phi, up]
    }

    #[inline(always)]
    fn second(&self, _: At, [sin, sin_phi, cos_phi, up]: [S; 4]) -> [S; 4] {
        let cap = &self.cap;
        // The half vector where the surface is stretched to α = 1, without its length: the sum
        // of two directions.
        let x = sin.mul_add(cos_phi, S::splat(cap.view[0]));
        let y = sin.mul_add(sin_phi, S::splat(cap.view[1]));
        let (across, up2) = (x.mul_add(x, y * y), up * up);
        // |h|², which is 2 V·M over the stretched view's length, and the square of its length on
        // the surface: their quotient is in the mirror and in D.
        let squeezed = S::splat(cap.a2).mul_add(across, up2);
        [x, y, up, (across + up2) / squeezed]
    }

    #[inline(always)]
    fn third(&self, at: At, [x, y, up, mirror]: [S; 4]) -> [S; 3] {
        let cap = &self.cap;
        let aside = S::splat(cap.aside) * mirror;
        let upward = S::splat(cap.upward) * mirror;
        self.l[0].put(at, aside.mul_add(x, S::splat(-self.v[0])));
        self.l[1].put(at, aside.mul_add(y, S::splat(-self.v[1])));
        let l = upward.mul_add(up, S::splat(-self.v[2]));
        self.l[2].put(at, l);
        let square = (l * l).mul_add(S::splat(cap.square_slope), S::splat(cap.square));
        [l, square.sqrt(), S::splat(cap.density) / (mirror * mirror)]
    }

    #[inline(always)]
    fn fourth(&self, at: At, [l, root, density]: [S; 3]) {
        let w = l.mul_add(S::splat(self.cap.length), root);
        self.pdf.put(at, density);
        self.weight.put(at, l.masks(l / w));
    }
}

/// What depends on the view and the width alone.
#[derive(Clone, Copy)]
struct Cap {
    /// From the cap's pole to its rim.
    depth: f32,
    /// How far up the half vector of the rim reaches, and how much less than the rim itself over
    /// the sphere's lowest point.
    lowest: f32,
    under: f32,
    /// The stretched view, of length 1, along the tangent and the bitangent.
    view: [f32; 2],
    /// α².
    a2: f32,
    /// The stretched view's length times α, and as it is.
    aside: f32,
    upward: f32,
    /// Density times the square of the quotient of lengths.
    density: f32,
    /// The weight is l / (`length` l + sqrt(`square` + `square_slope` l²)); `length` is infinite
    /// for a view below the horizon.
    length: f32,
    square: f32,
    square_slope: f32,
}

impl Cap {
    #[inline(always)]
    fn new(v: Vec3, alpha: f32) -> Cap {
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
        let (side, up) = if z > 0.0 {
            (2.0 * share * length, 2.0 * share * z)
        } else {
            (f64::INFINITY, 0.0)
        };
        Cap {
            depth: (1.0 + low) as f32,
            lowest: ((1.0 - bound) * (z / length)) as f32,
            under: (1.0 - z / length) as f32,
            view: [x, y].map(|across| (a * across / length) as f32),
            a2: a2 as f32,
            aside: (length * a) as f32,
            upward: length as f32,
            density: (share * FRAC_1_PI / a2) as f32,
            length: side as f32,
            square: (up * up * a2) as f32,
            square_slope: (up * up * rest) as f32,
        }
    }
}
