//! Drawing lights for one view.

use super::functions::Turn;
use super::lanes::{At, Column, Kernel, Lanes, Out, leave, run};
use super::{Isa, Level, dispatch_lanes};
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

/// Draws lights for one view by bounded caps.
///
/// - *Source*: Eto and Tokuyoshi 2023; see [`crate::Ggx::sample`].
/// - *Arguments*: `v` the view, of length 1 and above the horizon; `alpha` α in [1e-4, 1]; `u`
///   numbers in [0, 1); `out` what to fill.
/// - *Value*: see [`Samples`]. Each instruction set draws the density of [`crate::Ggx::pdf`] (χ²
///   tests at α from 0.01 and N·V from 0.02), and its density is that of the direction returned:
///   both strategies of a multiple importance sampler may mix them.
/// - *Outside*: a view that is not above the horizon gives weight 0; see [`crate::batch`].
/// - *Error*: of density and weight, both of the direction as rounded, 13.6 and 12.4 ulp (10.3 and 6.3
///   of a call), at the cap's rim, near the horizon and for α of 1e-4, too.
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
    run::<V, T, _>(n, &drawing);
}

struct Drawing<'a> {
    cap: Cap,
    v: [f32; 3],
    u: [Column<'a>; 2],
    l: [Out<'a>; 3],
    pdf: Out<'a>,
    weight: Out<'a>,
}

/// What a stage needs that is not the next waits where the results go: there are not as many
/// registers as there are numbers under way.
impl<S: Lanes> Kernel<S, 3> for Drawing<'_> {
    const STAGES: usize = 9;

    #[inline(always)]
    fn stage<const STAGE: usize>(&self, at: At, left: [S; 3]) -> [S; 3] {
        let ([out_x, out_y, out_z], cap) = (&self.l, &self.cap);
        match STAGE {
            // The angle around the cap's pole; how far up the half vector reaches, and the squared
            // sine of the angle from the pole.
            0 => {
                let (u0, u1) = (self.u[0].at::<S>(at), self.u[1].at::<S>(at));
                let Turn { quarters, rest } = Turn::of(u0);
                self.pdf.put(at, quarters);
                // How far below the pole of the cap, and how far above the lowest point of its
                // rim, without differences.
                let up = (S::splat(1.0) - u1).mul_add(S::splat(cap.depth), S::splat(cap.lowest));
                out_z.put(at, up);
                let down = S::splat(cap.squeezed_depth) * u1;
                leave([rest, down * (up + S::splat(cap.under))])
            }
            1 => {
                let [rest, sin2, _] = left;
                let (sin_phi, cos_phi) = Turn::polynomials(rest);
                [sin_phi, cos_phi, sin2.sqrt()]
            }
            // The half vector, without its length: where the surface is stretched to α = 1 it is
            // the sum of two directions.
            2 => {
                let [sin_phi, cos_phi, sin] = left;
                let (sin_phi, cos_phi) = S::turned(self.pdf.get(at), sin_phi, cos_phi);
                let x = sin.mul_add(cos_phi, S::splat(cap.view[0]));
                let y = sin.mul_add(sin_phi, S::splat(cap.view[1]));
                out_x.put(at, x);
                out_y.put(at, y);
                let up = out_z.get::<S>(at);
                let (across, up2) = (across_squared(x, y), up * up);
                // The square of its length where the surface is stretched, which is 2 V·M over the
                // stretched view's length, and of that on the surface: their quotient is in the
                // mirror.
                leave([across.mul_add(S::splat(cap.over_a2), up2), across + up2])
            }
            3 => leave([left[0] / left[1]]),
            // The light, what is under the root of the weight, and what D is the quotient of: of the
            // light as rounded, which on a smooth surface is another one.
            4 => {
                let mirror = S::splat(cap.upward) * left[0];
                let [x, y, up] = [out_x, out_y, out_z].map(|out| out.get::<S>(at));
                let v = self.v.map(S::splat);
                let x = mirror.mul_add(x, S::splat(-self.v[0]));
                let y = mirror.mul_add(y, S::splat(-self.v[1]));
                let z = mirror.mul_add(up, S::splat(-self.v[2]));
                out_x.put(at, x);
                out_y.put(at, y);
                out_z.put(at, z);
                let square = (z * z).mul_add(S::splat(cap.square_slope), S::splat(cap.square));
                let [x, y, up] = [x + v[0], y + v[1], z + v[2]];
                let (across, up2) = (across_squared(x, y), up * up);
                [square, across + up2, up2.mul_add(S::splat(cap.a2), across)]
            }
            5 => leave([left[0].sqrt(), left[1] / left[2]]),
            6 => {
                let [root, quotient, _] = left;
                self.pdf
                    .put(at, S::splat(cap.density) * quotient * quotient);
                leave([out_z.get::<S>(at).mul_add(S::splat(cap.length), root)])
            }
            7 => leave([out_z.get::<S>(at) / left[0]]),
            _ => {
                self.weight.put(at, out_z.get::<S>(at).masks(left[0]));
                left
            }
        }
    }
}

/// x² + y², and so little more that it matters only where there is no half vector at all: of a
/// view from straight below.
#[inline(always)]
fn across_squared<S: Lanes>(x: S, y: S) -> S {
    x.mul_add(x, y.mul_add(y, S::splat(1e-30)))
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
    /// `depth` times α².
    squeezed_depth: f32,
    /// The stretched view, of length 1, along the tangent and the bitangent, times α.
    view: [f32; 2],
    /// α², and 1/α².
    a2: f32,
    over_a2: f32,
    /// The stretched view's length.
    upward: f32,
    /// Density over the square of the quotient that D is made of.
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
            squeezed_depth: ((1.0 + low) * a2) as f32,
            view: [x, y].map(|across| (a2 * across / length) as f32),
            a2: a2 as f32,
            over_a2: (1.0 / a2) as f32,
            upward: length as f32,
            density: (share * FRAC_1_PI * a2) as f32,
            length: side as f32,
            square: (up * up * a2) as f32,
            square_slope: (up * up * rest) as f32,
        }
    }
}
