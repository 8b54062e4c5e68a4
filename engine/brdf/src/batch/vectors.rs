//! D V F cos θ from vectors in the tangent frame.

use super::lanes::{At, Column, Kernel, Lanes, Out, Triples, leave, lit, run};
use super::specular::{LEAST, facing_squared, schlick};
use super::{All, Input, Isa, Level, Source, dispatch_lanes, for_kinds};
use glam::Vec3;
use std::f64::consts::PI;

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
/// - *Error*: 21.2 ulp with FMA, 23.7 without (20.9 of a call). An f0 below 0.01, where the reflectance
///   is little but the fifth power of 1 − V·H, is computed more carefully, and takes up to 1.8
///   times as long.
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
    macro_rules! run_mirror {
        ($view:ident, $alpha:ident, $mirror:expr) => {
            run::<V, T, _>(
                n,
                &Directed {
                    light,
                    view: $view,
                    alpha: $alpha,
                    mirror: $mirror,
                    out,
                },
            )
        };
    }
    macro_rules! run_vectors {
        ($view:expr) => {{
            let view = $view;
            for_kinds!(n; input.alpha, alpha => match input.f0 {
                None => run_mirror!(view, alpha, Perfect),
                Some(Input::All(f0)) if f0 >= BRIGHT => run_mirror!(view, alpha, Bright(f0)),
                Some(Input::All(f0)) => run_mirror!(view, alpha, Dim(f0)),
                Some(Input::Each(f0)) => {
                    run_mirror!(view, alpha, Varying(Column::new(f0, n)))
                }
            })
        }};
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

/// What the facets reflect, and how carefully that has to be computed.
///
/// Schlick's reflectance wants m = 1 − V·H, of which directions of length 1 have two forms: 1 − |h|/2
/// with h = l + v, and |l − v|²/(2 (2 + |h|)). Where neither length nor difference is exact the
/// form for all angles is
///
/// ```text
/// m = |l − v|²/(|l − v|² + |h|² + 2|h|)
/// ```
///
/// which |h|² + |l − v|² = 4 turns into the others. What is wrong by the lengths of l and v, by
/// which both squares are too large, divides out; of what else is wrong with |l − v|² as much as
/// there is no half vector.
trait Reflectance: Copy {
    /// Squares along the surface and upwards of l + v, and that of l − v, which may be left out.
    fn squares<S: Lanes>(self, at: At, l: [S; 3], v: [S; 3]) -> Squares<S>;
    /// What [`Reflectance::divisor`] wants to know of |h|² and |l − v|².
    fn kept<S: Lanes>(self, sum2: S, difference2: S) -> S;
    /// |l − v|² + |h|² + 2|h|.
    fn divisor<S: Lanes>(self, at: At, sum: S, difference2: S, kept: S) -> S;
    /// `value` times the reflectance.
    fn times<S: Lanes>(self, at: At, value: S, m: S) -> S;
}

struct Squares<S> {
    /// h_x² + h_y².
    across: S,
    /// h_z².
    up: S,
    /// |l − v|².
    difference: Option<S>,
}

/// F = 1.
#[derive(Clone, Copy)]
struct Perfect;

impl Reflectance for Perfect {
    #[inline(always)]
    fn squares<S: Lanes>(self, _: At, l: [S; 3], v: [S; 3]) -> Squares<S> {
        Squares {
            difference: None,
            ..Squares::of(l, v)
        }
    }
    #[inline(always)]
    fn kept<S: Lanes>(self, _: S, _: S) -> S {
        S::splat(0.0)
    }
    #[inline(always)]
    fn divisor<S: Lanes>(self, _: At, _: S, _: S, _: S) -> S {
        S::splat(1.0)
    }
    #[inline(always)]
    fn times<S: Lanes>(self, _: At, value: S, _: S) -> S {
        value
    }
}

/// From which f0 on it is most of the reflectance wherever V·H is large: m is small there, a
/// difference of what is not, and its fifth power has five times what is wrong with it.
const BRIGHT: f32 = 0.01;

/// Schlick's reflectance from an f0 of [`BRIGHT`] or more.
#[derive(Clone, Copy)]
struct Bright(f32);

impl Reflectance for Bright {
    #[inline(always)]
    fn squares<S: Lanes>(self, _: At, l: [S; 3], v: [S; 3]) -> Squares<S> {
        Squares::of(l, v)
    }
    #[inline(always)]
    fn kept<S: Lanes>(self, _: S, _: S) -> S {
        S::splat(0.0)
    }
    #[inline(always)]
    fn divisor<S: Lanes>(self, _: At, sum: S, difference2: S, _: S) -> S {
        sum.mul_add(sum + S::splat(2.0), difference2)
    }
    #[inline(always)]
    fn times<S: Lanes>(self, _: At, value: S, m: S) -> S {
        value * schlick(S::splat(self.0), m)
    }
}

/// The same from a smaller one: where it is 0 the fifth power is all there is, at every angle.
#[derive(Clone, Copy)]
struct Dim(f32);

impl Reflectance for Dim {
    #[inline(always)]
    fn squares<S: Lanes>(self, _: At, l: [S; 3], v: [S; 3]) -> Squares<S> {
        Squares::carefully_of(l, v)
    }
    #[inline(always)]
    fn kept<S: Lanes>(self, sum2: S, difference2: S) -> S {
        sum2 + difference2
    }
    #[inline(always)]
    fn divisor<S: Lanes>(self, _: At, sum: S, _: S, kept: S) -> S {
        sum.mul_add(S::splat(2.0), kept)
    }
    #[inline(always)]
    fn times<S: Lanes>(self, _: At, value: S, m: S) -> S {
        value * schlick(S::splat(self.0), m)
    }
}

/// One or the other: most surfaces are bright, and a register of them is known by a jump.
#[derive(Clone, Copy)]
struct Varying<'a>(Column<'a>);

impl Reflectance for Varying<'_> {
    #[inline(always)]
    fn squares<S: Lanes>(self, at: At, l: [S; 3], v: [S; 3]) -> Squares<S> {
        let quick = Squares::of(l, v);
        let (f0, bright) = (self.0.at::<S>(at), S::splat(BRIGHT));
        if !f0.any_less(bright) {
            return quick;
        }
        let careful = Squares::carefully_of(l, v);
        Squares {
            across: f0.if_less(bright, careful.across, quick.across),
            up: f0.if_less(bright, careful.up, quick.up),
            difference: match (careful.difference, quick.difference) {
                (Some(careful), Some(quick)) => Some(f0.if_less(bright, careful, quick)),
                _ => None,
            },
        }
    }
    #[inline(always)]
    fn kept<S: Lanes>(self, sum2: S, difference2: S) -> S {
        sum2 + difference2
    }
    #[inline(always)]
    fn divisor<S: Lanes>(self, at: At, sum: S, difference2: S, kept: S) -> S {
        let (f0, bright) = (self.0.at::<S>(at), S::splat(BRIGHT));
        let quick = Bright(BRIGHT).divisor(at, sum, difference2, kept);
        if !f0.any_less(bright) {
            return quick;
        }
        f0.if_less(bright, Dim(0.0).divisor(at, sum, difference2, kept), quick)
    }
    #[inline(always)]
    fn times<S: Lanes>(self, at: At, value: S, m: S) -> S {
        value * schlick(self.0.at(at), m)
    }
}

impl<S: Lanes> Squares<S> {
    #[inline(always)]
    fn of(l: [S; 3], v: [S; 3]) -> Self {
        let [x, y, z] = [l[0] + v[0], l[1] + v[1], l[2] + v[2]];
        let [a, b, c] = [l[0] - v[0], l[1] - v[1], l[2] - v[2]];
        Squares {
            across: x.mul_add(x, y * y),
            up: z * z,
            difference: Some(a.mul_add(a, b.mul_add(b, c * c))),
        }
    }

    /// The components of h keep their rounding errors; those of l − v are in two parts, the first
    /// a multiple of 2⁻¹¹, of which squares and their sum are exact.
    #[inline(always)]
    fn carefully_of(l: [S; 3], v: [S; 3]) -> Self {
        let [x, y, z] = [
            two_sum(l[0], v[0]),
            two_sum(l[1], v[1]),
            two_sum(l[2], v[2]),
        ];
        let low = (x.0 + x.0).mul_add(x.1, (y.0 + y.0) * y.1);
        let [a, b, c] = [
            two_parts(l[0], v[0]),
            two_parts(l[1], v[1]),
            two_parts(l[2], v[2]),
        ];
        let high2 = (a.high).mul_add(a.high, b.high.mul_add(b.high, c.high * c.high));
        let rest = (a.low).mul_add(a.sum, b.low.mul_add(b.sum, c.low * c.sum));
        Squares {
            across: x.0.mul_add(x.0, y.0.mul_add(y.0, low)),
            up: z.0.mul_add(z.0, (z.0 + z.0) * z.1),
            difference: Some(high2 + rest),
        }
    }
}

/// The sum as an unevaluated sum (Knuth).
#[inline(always)]
fn two_sum<S: Lanes>(a: S, b: S) -> (S, S) {
    let sum = a + b;
    let of_b = sum - a;
    (sum, (a - (sum - of_b)) + (b - of_b))
}

/// A difference d of two components in two parts. Its square is high² + low · sum.
struct Parts<S> {
    /// A multiple of 2⁻¹¹.
    high: S,
    /// d − high.
    low: S,
    /// d + high.
    sum: S,
}

#[inline(always)]
fn two_parts<S: Lanes>(a: S, b: S) -> Parts<S> {
    // Next to it, what is no multiple of 2⁻¹¹ is rounded away.
    let large = S::splat(1.5 * 4096.0);
    let (a_high, b_high) = ((a + large) - large, (b + large) - large);
    let high = a_high - b_high;
    Parts {
        high,
        low: (a - a_high) - (b - b_high),
        sum: high + (a - b),
    }
}

/// D V F cos θ_l: two quotients of what [`crate::Ggx`] computes with.
struct Directed<'a, L, V, A, R> {
    light: L,
    view: V,
    alpha: A,
    mirror: R,
    out: Out<'a>,
}

/// The factor, 2⁵⁰, by which dividend and divisor are larger than they would be: almost opposite
/// directions have almost no half vector, and its fourth power would vanish.
const GROWN: f64 = (1u64 << 50) as f64;

/// The same of what is under the roots, and the 2π that D V is divided by.
const GROWN2: f64 = 4.0 * PI * PI * GROWN * GROWN;

impl<S: Lanes, L: Directions, V: Directions, A: Source, R: Reflectance> Kernel<S, 6>
    for Directed<'_, L, V, A, R>
{
    const STAGES: usize = 5;

    #[inline(always)]
    fn stage<const STAGE: usize>(&self, at: At, left: [S; 6]) -> [S; 6] {
        match STAGE {
            // What is under the roots, and what is not.
            0 => {
                let (l, v) = (self.light.at::<S>(at), self.view.at::<S>(at));
                let alpha = self.alpha.at::<S>(at);
                let a2 = alpha * alpha;
                let Squares {
                    across,
                    up,
                    difference,
                } = self.mirror.squares(at, l, v);
                if let Some(difference2) = difference {
                    // It waits where the result goes.
                    self.out.put(at, difference2);
                }
                // Of directions of length 1.
                let n_dot_l = l[2].at_least(S::splat(0.0));
                let grown = a2 * lit(GROWN2);
                let rest = lit::<S>(GROWN2) - grown;
                let [of_l, of_v] = facing_squared(n_dot_l, v[2], grown, rest);
                let t = a2.mul_add(up, across);
                leave([of_l, of_v, across + up, t, v[2].masks(n_dot_l)])
            }
            1 => {
                let [of_l, of_v, sum2, t, l, _] = left;
                let alpha = self.alpha.at::<S>(at);
                let dividend = sum2 * sum2 * (l * (alpha * alpha * lit(GROWN)));
                let kept = self.mirror.kept(sum2, self.out.get(at));
                [of_l.sqrt(), of_v.sqrt(), sum2.sqrt(), dividend, t, kept]
            }
            2 => {
                let [l, v, sum, dividend, t, kept] = left;
                let divisor = (t * (t * (l + v))).at_least(S::splat(LEAST));
                let difference2 = self.out.get::<S>(at);
                let below = self.mirror.divisor(at, sum, difference2, kept);
                leave([dividend, divisor, difference2, below])
            }
            3 => {
                let [dividend, divisor, difference2, below, ..] = left;
                leave([dividend / divisor, difference2 / below])
            }
            _ => {
                let [value, m, ..] = left;
                self.out.put(at, self.mirror.times(at, value, m));
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
    macro_rules! run_mirror {
        ($mirror:expr) => {
            run::<V, T, _>(
                n,
                &Directed {
                    light,
                    view,
                    alpha,
                    mirror: $mirror,
                    out,
                },
            )
        };
    }
    match f0 {
        None => run_mirror!(Perfect),
        Some(f0) if f0 >= BRIGHT => run_mirror!(Bright(f0)),
        Some(f0) => run_mirror!(Dim(f0)),
    }
}
