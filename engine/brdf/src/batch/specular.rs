//! D V F cos θ from cosines and from vectors.

use super::{All, Each, Input, Isa, Source, dispatch, for_kinds};
use crate::batch::Level;
use crate::real::{Fused, Single, lit};
use glam::Vec3;
use std::f64::consts::{FRAC_1_PI, PI};

/// Arguments of [`specular`]: cosines, widths and colours.
#[derive(Debug, Clone, Copy)]
pub struct Cosines<'a> {
    /// Between normal and light.
    pub n_dot_l: &'a [f32],
    /// Between normal and view.
    pub n_dot_v: Input<'a>,
    /// Between normal and half vector; a smooth surface wants [`specular_vectors`].
    pub n_dot_h: &'a [f32],
    /// Between view and half vector.
    pub v_dot_h: &'a [f32],
    /// Width of the distribution.
    pub alpha: Input<'a>,
    /// Reflectance at normal incidence; `None` for F = 1.
    pub f0: Option<Input<'a>>,
}

/// D V F cos θ_l of GGX with Schlick's reflectance, see [`crate::d_ggx`], [`crate::v_ggx`] and
/// [`crate::f_schlick`].
pub fn specular(isa: Isa, input: &Cosines, out: &mut [f32]) {
    dispatch!(isa, specular_body(input: &Cosines, out: &mut [f32]))
}

#[inline(always)]
fn specular_body<S: Single>(input: &Cosines, out: &mut [f32]) {
    let n = [
        input.n_dot_l.len(),
        input.n_dot_v.len(),
        input.n_dot_h.len(),
        input.v_dot_h.len(),
        input.alpha.len(),
        input.f0.map_or(usize::MAX, |f0| f0.len()),
    ]
    .into_iter()
    .fold(out.len(), usize::min);
    let out = &mut out[..n];
    if let (Input::All(view), Input::All(alpha)) = (input.n_dot_v, input.alpha)
        && let Some(known) = Known::<S>::new(view, alpha)
    {
        return match input.f0 {
            None => known_perfect_loop(input, known, out),
            Some(f0) => for_kinds!(n; f0, f0 => known_loop(input, known, f0, out)),
        };
    }
    for_kinds!(n; input.n_dot_v, view => for_kinds!(n; input.alpha, alpha => match input.f0 {
        None => specular_perfect_loop::<S>(input, view, alpha, out),
        Some(f0) => for_kinds!(n; f0, f0 => specular_loop::<S>(input, view, alpha, f0, out)),
    }))
}

#[inline(always)]
fn specular_loop<S: Single>(
    input: &Cosines,
    view: impl Source,
    alpha: impl Source,
    f0: impl Source,
    out: &mut [f32],
) {
    let n = out.len();
    let (light, h, u) = (
        &input.n_dot_l[..n],
        &input.n_dot_h[..n],
        &input.v_dot_h[..n],
    );
    for i in 0..n {
        let value = specular_cos(
            S::load(light[i]),
            view.at::<S>(i),
            S::load(h[i]),
            alpha.at::<S>(i),
        );
        out[i] = (value * schlick(f0.at::<S>(i), lit::<S>(1.0) - S::load(u[i]))).store();
    }
}

#[inline(always)]
fn specular_perfect_loop<S: Single>(
    input: &Cosines,
    view: impl Source,
    alpha: impl Source,
    out: &mut [f32],
) {
    let n = out.len();
    let (light, h) = (&input.n_dot_l[..n], &input.n_dot_h[..n]);
    let (view, alpha) = (view.cut(n), alpha.cut(n));
    for i in 0..n {
        out[i] = specular_cos(
            S::load(light[i]),
            view.at::<S>(i),
            S::load(h[i]),
            alpha.at::<S>(i),
        )
        .store();
    }
}

/// D V cos θ_l with a single quotient: α²/(2π) l / (t² (l sqrt(…) + v sqrt(…))), with
/// t = α² + (1 − α²) sin²θ_h.
#[inline(always)]
fn specular_cos<S: Single>(l: S, v: S, h: S, alpha: S) -> S {
    let a2 = alpha * alpha;
    let rest = lit::<S>(1.0) - a2;
    let t = h.one_minus_square().mul_add(rest, a2);
    // Below the horizon the numerator is 0.
    let l = l.at_least(lit(0.0));
    let root = |x: S| (x * x).mul_add(rest, a2).sqrt();
    let w = l.mul_add(root(v), v * root(l));
    above(v, a2 * lit(0.5 * FRAC_1_PI) * l / (t * t * w))
}

/// What is known of an evaluation whose view and width are.
#[derive(Clone, Copy)]
struct Known<S> {
    /// t of the distribution over sqrt(α²/2π) is `t + t_slope` sin²θ_h.
    t: S,
    t_slope: S,
    /// sqrt(α² + (1 − α²) v²).
    root: S,
    /// v² (α² + (1 − α²) l²) is `square + square_slope` l².
    square: S,
    square_slope: S,
}

impl<S: Single> Known<S> {
    /// `None` where the factors would leave the range of single precision.
    #[inline(always)]
    fn new(view: f32, alpha: f32) -> Option<Known<S>> {
        let (v, a) = (f64::from(view), f64::from(alpha));
        if !(v > 1e-12 && a > 1e-5 && v < 1e5 && a < 1e5) {
            return None;
        }
        let (a2, rest) = (a * a, (1.0 - a) * (1.0 + a));
        let scale = (2.0 * PI).sqrt() / a;
        Some(Known {
            t: lit(a2 * scale),
            t_slope: lit(rest * scale),
            root: lit((a2 + rest * v * v).sqrt()),
            square: lit(v * v * a2),
            square_slope: lit(v * v * rest),
        })
    }

    /// D V cos θ_l as l / (t² (l sqrt(…) + sqrt(…))).
    #[inline(always)]
    fn cos(&self, l: S, h: S) -> S {
        let t = h.one_minus_square().mul_add(self.t_slope, self.t);
        let l = l.at_least(lit(0.0));
        let w = l.mul_add(
            self.root,
            (l * l).mul_add(self.square_slope, self.square).sqrt(),
        );
        l / (t * t * w)
    }
}

#[inline(always)]
fn known_loop<S: Single>(input: &Cosines, known: Known<S>, f0: impl Source, out: &mut [f32]) {
    let n = out.len();
    let (light, h, u) = (
        &input.n_dot_l[..n],
        &input.n_dot_h[..n],
        &input.v_dot_h[..n],
    );
    let f0 = f0.cut(n);
    for i in 0..n {
        let value = known.cos(S::load(light[i]), S::load(h[i]));
        out[i] = (value * schlick(f0.at::<S>(i), lit::<S>(1.0) - S::load(u[i]))).store();
    }
}

#[inline(always)]
fn known_perfect_loop<S: Single>(input: &Cosines, known: Known<S>, out: &mut [f32]) {
    let n = out.len();
    let (light, h) = (&input.n_dot_l[..n], &input.n_dot_h[..n]);
    for i in 0..n {
        out[i] = known.cos(S::load(light[i]), S::load(h[i])).store();
    }
}

/// `value`, but 0 where a cosine is not above the horizon.
#[inline(always)]
pub(super) fn above<S: Single>(cosine: S, value: S) -> S {
    if cosine <= lit(0.0) { lit(0.0) } else { value }
}

/// `value`, but 0 where a direction is not above the horizon.
#[inline(always)]
fn on_lit_side<S: Single>(l: S, v: S, value: S) -> S {
    let lower = if l < v { l } else { v };
    if lower <= lit(0.0) { lit(0.0) } else { value }
}

/// f0 + (1 − f0) m⁵ of m = 1 − V·H.
#[inline(always)]
fn schlick<S: Single>(f0: S, m: S) -> S {
    let m2 = m * m;
    (m2 * m2 * m).mul_add(lit::<S>(1.0) - f0, f0)
}

/// Arguments of [`specular_vectors`]: components of light and view in the tangent frame, each of
/// length 1.
#[derive(Debug, Clone, Copy)]
pub struct Vectors<'a> {
    /// Light along the tangent, the bitangent and the normal.
    pub l: [&'a [f32]; 3],
    /// View along the tangent, the bitangent and the normal.
    pub v: [Input<'a>; 3],
    /// Width of the distribution.
    pub alpha: Input<'a>,
    /// Reflectance at normal incidence; `None` for F = 1.
    pub f0: Option<Input<'a>>,
}

/// D V F cos θ_l of GGX with Schlick's reflectance from vectors, accurate for smooth surfaces.
///
/// See [`crate::Specular::eval_cos`].
pub fn specular_vectors(isa: Isa, input: &Vectors, out: &mut [f32]) {
    dispatch!(isa, vectors_body(input: &Vectors, out: &mut [f32]))
}

#[inline(always)]
fn vectors_body<S: Single>(input: &Vectors, out: &mut [f32]) {
    let n = (input.l.iter().map(|l| l.len()))
        .chain(input.v.iter().map(Input::len))
        .chain([
            input.alpha.len(),
            input.f0.map_or(usize::MAX, |f0| f0.len()),
        ])
        .fold(out.len(), usize::min);
    let out = &mut out[..n];
    match input.v {
        [Input::All(x), Input::All(y), Input::All(z)] => {
            vectors_view::<S, _, _, _>(input, (All(x), All(y), All(z)), out)
        }
        [Input::Each(x), Input::Each(y), Input::Each(z)] => {
            vectors_view::<S, _, _, _>(input, (Each(&x[..n]), Each(&y[..n]), Each(&z[..n])), out)
        }
        // One component that varies makes a view that varies.
        [x, y, z] => {
            for (i, out) in out.iter_mut().enumerate() {
                let at = |input: Input| match input {
                    Input::Each(values) => values[i],
                    Input::All(value) => value,
                };
                let l = input.l.map(|l| S::load(l[i]));
                let v = [at(x), at(y), at(z)].map(S::load);
                let value = vectors_cos(l, v, S::load(at(input.alpha)));
                *out = match input.f0 {
                    None => value.0.store(),
                    Some(f0) => (value.0 * schlick(S::load(at(f0)), rest(l, v, value.1))).store(),
                };
            }
        }
    }
}

#[inline(always)]
fn vectors_view<S: Single, X: Source, Y: Source, Z: Source>(
    input: &Vectors,
    view: (X, Y, Z),
    out: &mut [f32],
) {
    let n = out.len();
    for_kinds!(n; input.alpha, alpha => match input.f0 {
        None => vectors_perfect_loop::<S>(input.l, view, alpha, out),
        Some(f0) => for_kinds!(n; f0, f0 => vectors_loop::<S>(input.l, view, alpha, f0, out)),
    })
}

#[inline(always)]
fn vectors_perfect_loop<S: Single>(
    [x, y, z]: [&[f32]; 3],
    view: (impl Source, impl Source, impl Source),
    alpha: impl Source,
    out: &mut [f32],
) {
    let n = out.len();
    let (x, y, z, alpha) = (&x[..n], &y[..n], &z[..n], alpha.cut(n));
    let view = (view.0.cut(n), view.1.cut(n), view.2.cut(n));
    for i in 0..n {
        let l = [S::load(x[i]), S::load(y[i]), S::load(z[i])];
        let v = [view.0.at::<S>(i), view.1.at::<S>(i), view.2.at::<S>(i)];
        out[i] = vectors_cos(l, v, alpha.at::<S>(i)).0.store();
    }
}

#[inline(always)]
fn vectors_loop<S: Single>(
    [x, y, z]: [&[f32]; 3],
    view: (impl Source, impl Source, impl Source),
    alpha: impl Source,
    f0: impl Source,
    out: &mut [f32],
) {
    let n = out.len();
    let (x, y, z, alpha, f0) = (&x[..n], &y[..n], &z[..n], alpha.cut(n), f0.cut(n));
    let view = (view.0.cut(n), view.1.cut(n), view.2.cut(n));
    for i in 0..n {
        let l = [S::load(x[i]), S::load(y[i]), S::load(z[i])];
        let v = [view.0.at::<S>(i), view.1.at::<S>(i), view.2.at::<S>(i)];
        let (value, m) = vectors_cos(l, v, alpha.at::<S>(i));
        out[i] = (value * schlick(f0.at::<S>(i), rest(l, v, m))).store();
    }
}

/// x² + y².
#[inline(always)]
fn across<S: Single>(v: [S; 3]) -> S {
    v[0].mul_add(v[0], v[1] * v[1])
}

/// sqrt(z² + α² (x² + y²)).
#[inline(always)]
fn projected<S: Single>(v: [S; 3], a2: S) -> S {
    v[2].mul_add(v[2], a2 * across(v)).sqrt()
}

/// D V cos θ_l, and |l + v|².
#[inline(always)]
fn vectors_cos<S: Single>(l: [S; 3], v: [S; 3], alpha: S) -> (S, S) {
    let a2 = alpha * alpha;
    let h = [l[0] + v[0], l[1] + v[1], l[2] + v[2]];
    let (s, c) = (across(h), h[2] * h[2]);
    let (m, t) = (s + c, a2.mul_add(c, s));
    let w = l[2].mul_add(projected(v, a2), v[2] * projected(l, a2));
    // (m/t)² as one quotient with the rest; no α that is allowed makes t² underflow.
    let value = a2 * lit(0.5 * FRAC_1_PI) * (m * m) * l[2] / (t * t * w);
    (on_lit_side(l[2], v[2], value), m)
}

/// 1 − V·H of two directions with |l + v|² = m.
#[inline(always)]
fn rest<S: Single>(l: [S; 3], v: [S; 3], m: S) -> S {
    let d = [l[0] - v[0], l[1] - v[1], l[2] - v[2]];
    let d2 = d[0].mul_add(d[0], d[1].mul_add(d[1], d[2] * d[2]));
    // |l − v|²/(4 (1 + V·H)) with V·H = sqrt(m)/2.
    d2 / lit::<S>(2.0).mul_add(m.sqrt(), lit(4.0))
}

/// [`specular_vectors`] for arrays of structures: the same α and f0 for all.
///
/// Transposed in blocks that stay in the nearest cache.
pub fn specular_vec3(
    isa: Isa,
    l: &[Vec3],
    v: &[Vec3],
    alpha: f32,
    f0: Option<f32>,
    out: &mut [f32],
) {
    dispatch!(isa, vec3_body(l: &[Vec3], v: &[Vec3], alpha: f32, f0: Option<f32>, out: &mut [f32]))
}

const BLOCK: usize = 256;

#[inline(always)]
fn vec3_body<S: Single>(l: &[Vec3], v: &[Vec3], alpha: f32, f0: Option<f32>, out: &mut [f32]) {
    let n = out.len().min(l.len()).min(v.len());
    let (mut light, mut view) = ([[0.0f32; BLOCK]; 3], [[0.0f32; BLOCK]; 3]);
    let blocks = l[..n]
        .chunks(BLOCK)
        .zip(v[..n].chunks(BLOCK))
        .zip(out[..n].chunks_mut(BLOCK));
    for ((l, v), out) in blocks {
        transpose(l, &mut light);
        transpose(v, &mut view);
        let n = out.len();
        let view = (
            Each(&view[0][..n]),
            Each(&view[1][..n]),
            Each(&view[2][..n]),
        );
        let light = [&light[0][..n], &light[1][..n], &light[2][..n]];
        match f0 {
            None => vectors_perfect_loop::<S>(light, view, All(alpha), out),
            Some(f0) => vectors_loop::<S>(light, view, All(alpha), All(f0), out),
        }
    }
}

#[inline(always)]
fn transpose(vectors: &[Vec3], [x, y, z]: &mut [[f32; BLOCK]; 3]) {
    let n = vectors.len().min(BLOCK);
    let (vectors, x, y, z) = (&vectors[..n], &mut x[..n], &mut y[..n], &mut z[..n]);
    for i in 0..n {
        x[i] = vectors[i].x;
        y[i] = vectors[i].y;
        z[i] = vectors[i].z;
    }
}
