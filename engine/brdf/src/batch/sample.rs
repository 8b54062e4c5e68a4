//! Drawing lights for one view.

use super::specular::on_lit_side;
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
    let v = v.to_array().map(S::load);
    let alpha = S::load(alpha);
    let a2 = alpha * alpha;
    // Of the view alone: its stretched length, the bound of the cap, density over D.
    let across = v[0].mul_add(v[0], v[1] * v[1]);
    let length = v[2].mul_add(v[2], a2 * across).sqrt();
    let s = one + across.sqrt();
    let s2 = s * s;
    let bound = if alpha < one {
        (one - a2) * s2 / a2.mul_add(v[2] * v[2], s2)
    } else {
        lit(0.0)
    };
    let share = lit::<S>(0.5) / bound.mul_add(v[2], length);
    let std = [alpha * v[0] / length, alpha * v[1] / length, v[2] / length];
    let low = bound * std[2];
    for i in 0..n {
        let cap = (one - S::load(u1[i])).mul_add(one + low, -low);
        let sin = ((one - cap) * (one + cap)).at_least(lit(0.0)).sqrt();
        let (sin_phi, cos_phi) = sin_cos_turn(S::load(u0[i]));
        let m = [
            alpha * sin.mul_add(cos_phi, std[0]),
            alpha * sin.mul_add(sin_phi, std[1]),
            std[2] + cap,
        ];
        // Mirrored in m without its length.
        let m_across = m[0].mul_add(m[0], m[1] * m[1]);
        let m_up = m[2] * m[2];
        let m2 = m_across + m_up;
        let vm = v[0].mul_add(m[0], v[1].mul_add(m[1], v[2] * m[2]));
        let factor = lit::<S>(2.0) * vm / m2;
        let l = [
            factor.mul_add(m[0], -v[0]),
            factor.mul_add(m[1], -v[1]),
            factor.mul_add(m[2], -v[2]),
        ];
        let q = m2 / a2.mul_add(m_up, m_across);
        let d = a2 * lit(FRAC_1_PI) * (q * q);
        let l_across = l[0].mul_add(l[0], l[1] * l[1]);
        let l_length = l[2].mul_add(l[2], a2 * l_across).sqrt();
        let w = l[2].mul_add(length, v[2] * l_length);
        x[i] = l[0].store();
        y[i] = l[1].store();
        z[i] = l[2].store();
        pdf[i] = (d * share).store();
        weight[i] = on_lit_side(l[2], v[2], lit::<S>(0.5) * l[2] / (w * share)).store();
    }
}
