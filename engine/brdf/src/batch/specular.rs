//! D V F cos θ from cosines and from vectors.

use super::lanes::{At, Column, Kernel, Lanes, Out, Triples, leave, lit, run};
use super::{All, Input, Isa, Level, Source, dispatch_lanes, for_kinds};
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

/// D V F cos θ of GGX with Schlick's reflectance, from cosines.
///
/// ```text
/// out = D V F N·L
/// ```
///
/// - *Source*: [`crate::d_ggx`], [`crate::v_ggx`], [`crate::f_schlick`].
/// - *Arguments*: see [`Cosines`]; `out` as long as they are, or shorter.
/// - *Value*: 1/sr.
/// - *Outside*: 0 where N·L or N·V is not above 0; see [`crate::batch`].
/// - *Error*: 18.2 ulp; 16.2 with view, width and f0 the same for all.
pub fn specular(isa: Isa, input: &Cosines, out: &mut [f32]) {
    dispatch_lanes!(isa, specular_body(input: &Cosines, out: &mut [f32]))
}

#[inline(always)]
fn specular_body<V: Lanes, T: Lanes>(input: &Cosines, out: &mut [f32]) {
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
    let (light, half) = (Column::new(input.n_dot_l, n), Column::new(input.n_dot_h, n));
    let (u, out) = (Column::new(input.v_dot_h, n), Out::new(out, n));
    if let (Input::All(view), Input::All(alpha)) = (input.n_dot_v, input.alpha)
        && let Some(known) = Known::new(view, alpha)
    {
        macro_rules! run_known {
            ($mirror:expr) => {
                run::<V, T, _>(
                    n,
                    &KnownCosines {
                        light,
                        half,
                        known,
                        mirror: $mirror,
                        out,
                    },
                )
            };
        }
        return match input.f0 {
            None => run_known!(Perfect),
            Some(f0) => for_kinds!(n; f0, f0 => run_known!(Schlick { u, f0 })),
        };
    }
    macro_rules! run_any {
        ($view:ident, $alpha:ident, $mirror:expr) => {
            run::<V, T, _>(
                n,
                &AnyCosines {
                    light,
                    view: $view,
                    half,
                    alpha: $alpha,
                    mirror: $mirror,
                    out,
                },
            )
        };
    }
    for_kinds!(n; input.n_dot_v, view => for_kinds!(n; input.alpha, alpha => match input.f0 {
        None => run_any!(view, alpha, Perfect),
        Some(f0) => for_kinds!(n; f0, f0 => run_any!(view, alpha, Schlick { u, f0 })),
    }))
}

/// What the facets reflect.
trait Mirror: Copy {
    /// `value` times the reflectance.
    fn times<S: Lanes>(self, at: At, value: S) -> S;
}

#[derive(Clone, Copy)]
struct Perfect;

impl Mirror for Perfect {
    #[inline(always)]
    fn times<S: Lanes>(self, _: At, value: S) -> S {
        value
    }
}

#[derive(Clone, Copy)]
struct Schlick<'a, F> {
    u: Column<'a>,
    f0: F,
}

impl<F: Source> Mirror for Schlick<'_, F> {
    #[inline(always)]
    fn times<S: Lanes>(self, at: At, value: S) -> S {
        value * schlick(self.f0.at(at), S::splat(1.0) - self.u.at::<S>(at), 1.0)
    }
}

/// f0 + (1 − f0) scale m⁵, where m is 1 − V·H but for a factor.
#[inline(always)]
fn schlick<S: Lanes>(f0: S, m: S, scale: f32) -> S {
    let m2 = m * m;
    (m2 * m2 * m).mul_add((S::splat(1.0) - f0) * S::splat(scale), f0)
}

/// D V cos θ_l with a single quotient: α²/(2π) l / (t² (l sqrt(…) + v sqrt(…))), with
/// t = α² + (1 − α²) sin²θ_h.
struct AnyCosines<'a, V, A, M> {
    light: Column<'a>,
    view: V,
    half: Column<'a>,
    alpha: A,
    mirror: M,
    out: Out<'a>,
}

impl<S: Lanes, V: Source, A: Source, M: Mirror> Kernel<S, 4> for AnyCosines<'_, V, A, M> {
    const STAGES: usize = 5;

    #[inline(always)]
    fn stage<const STAGE: usize>(&self, at: At, left: [S; 4]) -> [S; 4] {
        match STAGE {
            // What is under the roots, and what is not.
            0 => {
                let (alpha, v) = (self.alpha.at::<S>(at), self.view.at::<S>(at));
                let a2 = alpha * alpha;
                let rest = S::splat(1.0) - a2;
                // Below the horizon the dividend is 0.
                let l = self.light.at::<S>(at).at_least(S::splat(0.0));
                let h = self.half.at::<S>(at);
                let t = h.one_minus_square().mul_add(rest, a2);
                let [of_l, of_v] = facing_squared(l, v, a2, rest);
                let dividend = a2 * lit(0.5 * FRAC_1_PI) * v.masks(l);
                [of_l, of_v, dividend, t * t]
            }
            1 => {
                let [of_l, of_v, dividend, t2] = left;
                [of_l.sqrt(), of_v.sqrt(), dividend, t2]
            }
            2 => {
                let [l, v, dividend, t2] = left;
                leave([dividend, (t2 * (l + v)).at_least(S::splat(LEAST))])
            }
            3 => leave([left[0] / left[1]]),
            _ => {
                self.out.put(at, self.mirror.times(at, left[0]));
                left
            }
        }
    }
}

/// A divisor is at least this: where both cosines are denormal, 0 over 0 would be left.
const LEAST: f32 = f32::MIN_POSITIVE;

/// The squares of the two terms that V divides by, l sqrt(α² + (1 − α²) v²) and the same with the
/// other cosine: the cosines under the roots, nothing but a sum is left to be done after them.
#[inline(always)]
fn facing_squared<S: Lanes>(l: S, v: S, a2: S, rest: S) -> [S; 2] {
    let (l2, v2) = (l * l, v * v);
    let both = l2 * rest * v2;
    [l2.mul_add(a2, both), v2.mul_add(a2, both)]
}

/// What is known of an evaluation whose view and width are.
#[derive(Clone, Copy)]
struct Known {
    /// t of the distribution over sqrt(α²/2π) is `t + t_slope` sin²θ_h.
    t: f32,
    t_slope: f32,
    /// sqrt(α² + (1 − α²) v²).
    root: f32,
    /// v² (α² + (1 − α²) l²) is `square + square_slope` l².
    square: f32,
    square_slope: f32,
}

impl Known {
    /// `None` where the factors would leave the range of single precision.
    #[inline(always)]
    fn new(view: f32, alpha: f32) -> Option<Known> {
        let (v, a) = (f64::from(view), f64::from(alpha));
        if !(v > 1e-12 && a > 1e-5 && v < 1e5 && a < 1e5) {
            return None;
        }
        let (a2, rest) = (a * a, (1.0 - a) * (1.0 + a));
        let scale = (2.0 * PI).sqrt() / a;
        Some(Known {
            t: (a2 * scale) as f32,
            t_slope: (rest * scale) as f32,
            root: (a2 + rest * v * v).sqrt() as f32,
            square: (v * v * a2) as f32,
            square_slope: (v * v * rest) as f32,
        })
    }
}

/// D V cos θ_l as l / (t² (l sqrt(…) + sqrt(…))).
struct KnownCosines<'a, M> {
    light: Column<'a>,
    half: Column<'a>,
    known: Known,
    mirror: M,
    out: Out<'a>,
}

impl<S: Lanes, M: Mirror> Kernel<S, 2> for KnownCosines<'_, M> {
    const STAGES: usize = 5;

    #[inline(always)]
    fn stage<const STAGE: usize>(&self, at: At, left: [S; 2]) -> [S; 2] {
        let known = &self.known;
        match STAGE {
            // N·L from 0 up, and what is under the root.
            0 => {
                let l = self.light.at::<S>(at).at_least(S::splat(0.0));
                let (slope, square) = (S::splat(known.square_slope), S::splat(known.square));
                [l, (l * l).mul_add(slope, square)]
            }
            1 => [left[0], left[1].sqrt()],
            // Dividend and divisor.
            2 => {
                let ([l, root], h) = (left, self.half.at::<S>(at));
                let (slope, t) = (S::splat(known.t_slope), S::splat(known.t));
                let t = h.one_minus_square().mul_add(slope, t);
                [l, t * t * l.mul_add(S::splat(known.root), root)]
            }
            3 => leave([left[0] / left[1]]),
            _ => {
                self.out.put(at, self.mirror.times(at, left[0]));
                left
            }
        }
    }
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

/// D V F cos θ of GGX with Schlick's reflectance, from vectors: accurate for smooth surfaces.
///
/// ```text
/// out = D V F N·L
/// ```
///
/// - *Source*: [`crate::Specular::eval_cos`].
/// - *Arguments*: see [`Vectors`]; `out` as long as they are, or shorter.
/// - *Value*: 1/sr.
/// - *Outside*: 0 where the light or the view is not above the horizon; see [`crate::batch`].
/// - *Error*: 29 ulp with FMA, 33 without (20.9 of a call): for speed its sums do not keep their
///   rounding errors, which the fifth power counts five times where l is near −v. Of random pairs
///   one in a thousand is off by more than 11.
pub fn specular_vectors(isa: Isa, input: &Vectors, out: &mut [f32]) {
    dispatch_lanes!(isa, vectors_body(input: &Vectors, out: &mut [f32]))
}

#[inline(always)]
fn vectors_body<V: Lanes, T: Lanes>(input: &Vectors, out: &mut [f32]) {
    let n = (input.l.iter().map(|l| l.len()))
        .chain(input.v.iter().map(Input::len))
        .chain([
            input.alpha.len(),
            input.f0.map_or(usize::MAX, |f0| f0.len()),
        ])
        .fold(out.len(), usize::min);
    let light = input.l.map(|l| Column::new(l, n));
    let out = Out::new(out, n);
    macro_rules! run_vectors {
        ($view:expr) => {
            for_kinds!(n; input.alpha, alpha => match input.f0 {
                None => run::<V, T, _>(n, &Directed { light, view: $view, alpha, f0: None::<All>, out }),
                Some(f0) => for_kinds!(n; f0, f0 => {
                    run::<V, T, _>(n, &Directed { light, view: $view, alpha, f0: Some(f0), out })
                }),
            })
        };
    }
    match input.v {
        [Input::All(x), Input::All(y), Input::All(z)] => run_vectors!([x, y, z].map(All)),
        [Input::Each(x), Input::Each(y), Input::Each(z)] => {
            run_vectors!([x, y, z].map(|view| Column::new(view, n)))
        }
        view => run_vectors!(view.map(|view| Mixed::new(view, n))),
    }
}

/// An [`Input`] whose kind is found out in the loop: a jump that always goes the same way.
#[derive(Clone, Copy)]
enum Mixed<'a> {
    Each(Column<'a>),
    All(f32),
}

impl<'a> Mixed<'a> {
    #[inline(always)]
    fn new(input: Input<'a>, n: usize) -> Self {
        match input {
            Input::Each(values) => Mixed::Each(Column::new(values, n)),
            Input::All(value) => Mixed::All(value),
        }
    }
}

impl Source for Mixed<'_> {
    #[inline(always)]
    fn at<S: Lanes>(self, at: At) -> S {
        match self {
            Mixed::Each(column) => column.at(at),
            Mixed::All(value) => S::splat(value),
        }
    }
}

/// Vectors to read.
trait Directions: Copy {
    fn at<S: Lanes>(self, at: At) -> [S; 3];
}

impl<X: Source> Directions for [X; 3] {
    #[inline(always)]
    fn at<S: Lanes>(self, at: At) -> [S; 3] {
        let [x, y, z] = self;
        [x.at(at), y.at(at), z.at(at)]
    }
}

impl Directions for Triples<'_> {
    #[inline(always)]
    fn at<S: Lanes>(self, at: At) -> [S; 3] {
        Triples::at(self, at)
    }
}

/// D V F cos θ_l: two quotients of what [`crate::Ggx`] computes with.
struct Directed<'a, L, V, A, F> {
    light: L,
    view: V,
    alpha: A,
    f0: Option<F>,
    out: Out<'a>,
}

/// The factor, 2⁵⁰, by which dividend and divisor are larger than they would be: almost opposite
/// directions have almost no half vector, and its fourth power would vanish.
const GROWN: f64 = (1u64 << 50) as f64;

impl<S: Lanes, L: Directions, V: Directions, A: Source, F: Source> Kernel<S, 5>
    for Directed<'_, L, V, A, F>
{
    const STAGES: usize = 5;

    #[inline(always)]
    fn stage<const STAGE: usize>(&self, at: At, left: [S; 5]) -> [S; 5] {
        match STAGE {
            // What is under the roots, and what is not.
            0 => {
                let (l, v) = (self.light.at::<S>(at), self.view.at::<S>(at));
                let alpha = self.alpha.at::<S>(at);
                let a2 = alpha * alpha;
                let h = [l[0] + v[0], l[1] + v[1], l[2] + v[2]];
                let (s, c) = (h[0].mul_add(h[0], h[1] * h[1]), h[2] * h[2]);
                let d = [l[0] - v[0], l[1] - v[1], l[2] - v[2]];
                let difference2 = d[0].mul_add(d[0], d[1].mul_add(d[1], d[2] * d[2]));
                // It waits where the result goes.
                self.out.put(at, difference2);
                // Of directions of length 1.
                let up = l[2].at_least(S::splat(0.0));
                let grown = a2 * lit(GROWN * GROWN);
                let rest = lit::<S>(GROWN * GROWN) - grown;
                let [of_l, of_v] = facing_squared(up, v[2], grown, rest);
                [of_l, of_v, s + c, a2.mul_add(c, s), v[2].masks(up)]
            }
            1 => {
                let [of_l, of_v, m, t, l] = left;
                let alpha = self.alpha.at::<S>(at);
                let scale = alpha * alpha * lit(0.5 * FRAC_1_PI * GROWN);
                let dividend = m * m * (l * scale);
                [of_l.sqrt(), of_v.sqrt(), m.sqrt(), dividend, t]
            }
            2 => {
                let [l, v, sum, dividend, t] = left;
                let divisor = (t * (t * (l + v))).at_least(S::splat(LEAST));
                leave([dividend, divisor, sum + S::splat(2.0)])
            }
            // The second is twice |l − v|²/(4 (1 + V·H)) with V·H = |l + v|/2.
            3 => {
                let [dividend, divisor, below, ..] = left;
                let difference2 = self.out.get::<S>(at);
                leave([dividend / divisor, difference2 / below])
            }
            _ => {
                let [value, twice_rest, ..] = left;
                let value = match self.f0 {
                    None => value,
                    Some(f0) => value * schlick(f0.at(at), twice_rest, 1.0 / 32.0),
                };
                self.out.put(at, value);
                left
            }
        }
    }
}

/// [`specular_vectors`] for arrays of structures: the same α and f0 for all.
///
/// - *Arguments*: `l`, `v` directions of length 1 in the tangent frame; `alpha` α in [1e-4, 1];
///   `f0` the reflectance at normal incidence, `None` for F = 1.
/// - *Error*: that of [`specular_vectors`], to the last bit.
pub fn specular_vec3(
    isa: Isa,
    l: &[Vec3],
    v: &[Vec3],
    alpha: f32,
    f0: Option<f32>,
    out: &mut [f32],
) {
    dispatch_lanes!(isa, vec3_body(l: &[Vec3], v: &[Vec3], alpha: f32, f0: Option<f32>, out: &mut [f32]))
}

#[inline(always)]
fn vec3_body<V: Lanes, T: Lanes>(
    l: &[Vec3],
    v: &[Vec3],
    alpha: f32,
    f0: Option<f32>,
    out: &mut [f32],
) {
    let n = out.len().min(l.len()).min(v.len());
    let (light, view) = (Triples::new(l, n), Triples::new(v, n));
    let (alpha, out) = (All(alpha), Out::new(out, n));
    match f0.map(All) {
        None => run::<V, T, _>(
            n,
            &Directed {
                light,
                view,
                alpha,
                f0: None::<All>,
                out,
            },
        ),
        f0 => run::<V, T, _>(
            n,
            &Directed {
                light,
                view,
                alpha,
                f0,
                out,
            },
        ),
    }
}
