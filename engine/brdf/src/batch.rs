//! Many evaluations at once: structure of arrays in, slices out.
//!
//! Every loop is written once and compiled for the baseline, for AVX2 with FMA and for
//! AVX-512; [`Isa::best`] is what this machine can run. What is the same for all evaluations
//! is given as [`Input::All`] and leaves the loop: the variants are chosen once, outside.
//!
//! The formulas are the stable ones of the terms without their care for denormal numbers:
//! cosines are expected in [0, 1] and α in [1e-4, 1]. A cosine below 0 (`n_dot_l`,
//! `n_dot_v`) gives 0. Slices may differ in length; the shortest counts.
//!
//! Blocks of a few thousand elements stay in the cache; beyond it, memory is the limit.

// Loops over an index of slices of the same length are what the compiler vectorises best.
#![allow(clippy::needless_range_loop)]

use crate::fresnel::f_conductor;
use crate::real::{Fused, Single, lit};
use glam::Vec3;
use std::f64::consts::{FRAC_1_PI, PI};

/// A set of instructions that this machine has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Isa(pub(crate) Level);

/// An [`Isa`] above the baseline is made only where its features were detected.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Level {
    Baseline,
    #[cfg(target_arch = "x86_64")]
    Avx2,
    #[cfg(target_arch = "x86_64")]
    Avx512,
}

impl Isa {
    /// What every machine of this architecture has.
    pub const BASELINE: Isa = Isa(Level::Baseline);

    /// All that this machine has, slowest first.
    pub fn available() -> Vec<Isa> {
        #[allow(unused_mut)]
        let mut all = vec![Isa::BASELINE];
        #[cfg(target_arch = "x86_64")]
        {
            let fma = is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma");
            if fma {
                all.push(Isa(Level::Avx2));
            }
            if fma
                && is_x86_feature_detected!("avx512f")
                && is_x86_feature_detected!("avx512vl")
                && is_x86_feature_detected!("avx512dq")
                && is_x86_feature_detected!("avx512bw")
            {
                all.push(Isa(Level::Avx512));
            }
        }
        all
    }

    /// The fastest that this machine has.
    pub fn best() -> Isa {
        Isa::available().pop().unwrap_or(Isa::BASELINE)
    }

    /// `baseline`, `avx2` or `avx512`.
    pub fn name(self) -> &'static str {
        match self.0 {
            Level::Baseline => "baseline",
            #[cfg(target_arch = "x86_64")]
            Level::Avx2 => "avx2",
            #[cfg(target_arch = "x86_64")]
            Level::Avx512 => "avx512",
        }
    }
}

/// An argument that varies from one evaluation to the next, or does not.
#[derive(Debug, Clone, Copy)]
pub enum Input<'a> {
    /// One value each.
    Each(&'a [f32]),
    /// The same for all: what depends on it alone is computed once.
    All(f32),
}

impl Input<'_> {
    fn len(&self) -> usize {
        match self {
            Input::Each(values) => values.len(),
            Input::All(_) => usize::MAX,
        }
    }
}

/// An [`Input`] whose kind is known at compile time.
trait Source: Copy {
    /// Cut to a length, so that the loop needs no bounds checks.
    fn cut(self, n: usize) -> Self;
    /// The value for one evaluation.
    fn at<S: Single>(self, i: usize) -> S;
}

#[derive(Clone, Copy)]
struct Each<'a>(&'a [f32]);

#[derive(Clone, Copy)]
struct All(f32);

impl Source for Each<'_> {
    #[inline(always)]
    fn cut(self, n: usize) -> Self {
        Each(&self.0[..n])
    }
    #[inline(always)]
    fn at<S: Single>(self, i: usize) -> S {
        S::load(self.0[i])
    }
}

impl Source for All {
    #[inline(always)]
    fn cut(self, _: usize) -> All {
        self
    }
    #[inline(always)]
    fn at<S: Single>(self, _: usize) -> S {
        S::load(self.0)
    }
}

/// Evaluates an expression with the kind of an input known: one loop for each kind.
macro_rules! for_kinds {
    ($n:expr; $input:expr, $name:ident => $call:expr) => {
        match $input {
            Input::Each(values) => {
                let $name = Each(&values[..$n]);
                $call
            }
            Input::All(value) => {
                let $name = All(value);
                $call
            }
        }
    };
}

/// Runs a body that is generic over its arithmetic with the instructions of an [`Isa`].
macro_rules! dispatch {
    ($isa:expr, $body:ident ( $($arg:ident : $type:ty),* )) => {{
        #[cfg(target_arch = "x86_64")]
        #[target_feature(enable = "avx2,fma")]
        fn avx2($($arg: $type),*) {
            $body::<Fused>($($arg),*)
        }
        #[cfg(target_arch = "x86_64")]
        #[target_feature(enable = "avx2,fma,avx512f,avx512vl,avx512dq,avx512bw")]
        fn avx512($($arg: $type),*) {
            $body::<Fused>($($arg),*)
        }
        match $isa.0 {
            Level::Baseline => $body::<f32>($($arg),*),
            // SAFETY: an `Isa` above the baseline exists only where its features were detected.
            #[cfg(target_arch = "x86_64")]
            Level::Avx2 => unsafe { avx2($($arg),*) },
            // SAFETY: as above.
            #[cfg(target_arch = "x86_64")]
            Level::Avx512 => unsafe { avx512($($arg),*) },
        }
    }};
}

pub(crate) use dispatch;

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
    for_kinds!(n; input.n_dot_v, view => for_kinds!(n; input.alpha, alpha => match input.f0 {
        None => specular_perfect_loop::<S>(input, view, alpha, &mut out[..n]),
        Some(f0) => for_kinds!(n; f0, f0 => specular_loop::<S>(input, view, alpha, f0, &mut out[..n])),
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

/// D V cos θ_l with a single quotient: α²/(2π) l / (t² (l sqrt(…) + v sqrt(…))).
#[inline(always)]
fn specular_cos<S: Single>(l: S, v: S, h: S, alpha: S) -> S {
    let one = lit::<S>(1.0);
    let a2 = alpha * alpha;
    let ah = alpha * h;
    let t = ah.mul_add(ah, (one - h) * (one + h));
    let w = l.mul_add(
        (v * v).mul_add(one - a2, a2).sqrt(),
        v * (l * l).mul_add(one - a2, a2).sqrt(),
    );
    on_lit_side(l, v, a2 * lit(0.5 * FRAC_1_PI) * l / (t * t * w))
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

/// Quotients, to measure how fast the machine divides.
pub fn divide(isa: Isa, a: &[f32], b: &[f32], out: &mut [f32]) {
    dispatch!(isa, divide_body(a: &[f32], b: &[f32], out: &mut [f32]))
}

#[inline(always)]
fn divide_body<S: Single>(a: &[f32], b: &[f32], out: &mut [f32]) {
    let n = a.len().min(b.len()).min(out.len());
    let (a, b, out) = (&a[..n], &b[..n], &mut out[..n]);
    for i in 0..n {
        out[i] = (S::load(a[i]) / S::load(b[i])).store();
    }
}

/// Square roots, to measure how fast the machine takes them.
pub fn square_root(isa: Isa, a: &[f32], out: &mut [f32]) {
    dispatch!(isa, square_root_body(a: &[f32], out: &mut [f32]))
}

#[inline(always)]
fn square_root_body<S: Single>(a: &[f32], out: &mut [f32]) {
    let n = a.len().min(out.len());
    let (a, out) = (&a[..n], &mut out[..n]);
    for i in 0..n {
        out[i] = S::load(a[i]).sqrt().store();
    }
}

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

/// sin and cos of 2π u for u in [0, 1], by polynomials on an eighth of a turn.
#[inline(always)]
pub(crate) fn sin_cos_turn<S: Single>(u: S) -> (S, S) {
    let one = lit::<S>(1.0);
    // Quarter turns, rounded by adding and taking away a large number.
    let quarters = lit::<S>(4.0) * u;
    let magic = lit::<S>(12_582_912.0);
    let q = (quarters + magic) - magic;
    // The rest in [−½, ½] quarter turns; exact.
    let r = quarters - q;
    let x = r * lit(PI / 2.0);
    let x2 = x * x;
    let sin = (x * x2).mul_add(
        lit::<S>(-1.951_529_6e-4)
            .mul_add(x2, lit(8.332_161e-3))
            .mul_add(x2, lit(-0.166_666_55)),
        x,
    );
    let cos = (x2 * x2).mul_add(
        lit::<S>(2.443_315_7e-5)
            .mul_add(x2, lit(-1.388_731_6e-3))
            .mul_add(x2, lit(4.166_664_6e-2)),
        lit::<S>(-0.5).mul_add(x2, one),
    );
    // q is 0 to 4: swapped when odd; cos negative for 1 and 2, sin for 2 and 3.
    let odd = (q == one) || (q == lit(3.0));
    let (a, b) = if odd { (cos, sin) } else { (sin, cos) };
    let sin = if q == lit(2.0) || q == lit(3.0) {
        -a
    } else {
        a
    };
    let cos = if q == one || q == lit(2.0) { -b } else { b };
    (sin, cos)
}
