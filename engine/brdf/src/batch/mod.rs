//! Many evaluations at once: structure of arrays in, slices out.
//!
//! | what | function | one at a time |
//! |---|---|---|
//! | D V F cos θ from cosines | [`specular`] | [`d_ggx`](crate::d_ggx), [`v_ggx`](crate::v_ggx), [`f_schlick`](crate::f_schlick) |
//! | D V F cos θ from vectors | [`specular_vectors`], [`specular_vec3`] | [`Specular::eval_cos`](crate::Specular::eval_cos) |
//! | F of a conductor, three colours | [`Conductor`], [`conductor_rgb`] | [`f_conductor`](crate::f_conductor) |
//! | lights drawn, density, weight | [`sample`] | [`Ggx::sample`](crate::Ggx::sample) |
//! | random walks between mirrors | [`walk::walk_mirrors`](crate::walk::walk_mirrors) | [`walk::walk`](crate::walk::walk) |
//! | any term | [`Term::f32_block`](crate::Term::f32_block), [`Term::f64_block`](crate::Term::f64_block) | its function |
//! | the machine's limit | [`divide`], [`square_root`], [`multiply`] | |
//!
//! Every loop is written once and compiled for the baseline, for AVX2 with FMA and for AVX-512;
//! [`Isa::best`] is what this machine can run. Nothing is left to the compiler's luck: the registers are
//! named, and square roots and quotients of the next numbers are under way while those of the last are
//! waited for. What is the same for all evaluations is given as [`Input::All`] and leaves the loop: the
//! variants are chosen once, outside.
//!
//! ```
//! use brdf::batch::{Cosines, Input, Isa, specular};
//!
//! let (l, h, u) = ([0.8, 0.5, -0.1], [0.95, 0.7, 0.6], [0.9, 0.8, 0.7]);
//! let input = Cosines {
//!     n_dot_l: &l,
//!     n_dot_v: Input::All(0.6),
//!     n_dot_h: &h,
//!     v_dot_h: &u,
//!     alpha: Input::All(0.16),
//!     f0: Some(Input::All(0.04)),
//! };
//! let mut out = [0.0; 3];
//! specular(Isa::best(), &input, &mut out);
//! let one = brdf::d_ggx(0.95, 0.16) * brdf::v_ggx(0.8, 0.6, 0.16) * brdf::f_schlick(0.04, 0.9) * 0.8;
//! assert!((out[0] - one).abs() < 1e-6 * one);
//! assert_eq!(out[2], 0.0); // the light is below the horizon
//! ```
//!
//! The formulas are the stable ones of the terms without their care for what is out of range. Inside it,
//! cosines and heights in [−1, 1], α in [1e-4, 1], f0 in [0, 1] and vectors of length 1, denormal cosines
//! and l = −v included, results are finite wherever single precision can hold them, and a cosine or height
//! (`n_dot_l`, `n_dot_v`, z) at or below 0 gives 0. Outside it (α = 0, infinite arguments, lengths far from 1)
//! a result may be anything, NaN included, but only its own: nothing panics, and no element depends on
//! another. Slices may differ in length; the shortest counts, and what is longer is left as it was.
//!
//! Blocks of a few thousand elements stay in the cache; beyond it, memory is the limit.

mod conductor;
mod functions;
mod lanes;
mod sample;
mod specular;
mod units;
mod vectors;
#[cfg(target_arch = "x86_64")]
mod x86;

pub use conductor::{Conductor, conductor_rgb};
pub(crate) use functions::{ln_unit, sin_cos_turn};
pub use sample::{Samples, sample};
pub use specular::{Cosines, specular};
pub use units::{
    BESIDE, PRODUCTS, divide, divide_beside, multiply, square_root, square_root_beside,
};
pub use vectors::{Vectors, specular_vec3, specular_vectors};

use lanes::{At, Column, Lanes};

/// A set of instructions that this machine has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Isa(pub(crate) Level);

/// What an [`Isa`] has; above the baseline one is made only where its features were detected.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Level {
    /// What every machine of this architecture has.
    Baseline,
    /// AVX2 and FMA.
    #[cfg(target_arch = "x86_64")]
    Avx2,
    /// AVX-512 F, VL, DQ and BW, besides AVX2 and FMA.
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

    /// Which instructions it stands for: this machine has them.
    pub fn level(self) -> Level {
        self.0
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
    /// The values for the evaluations of a register.
    fn at<S: Lanes>(self, at: At) -> S;
}

#[derive(Clone, Copy)]
struct All(f32);

impl Source for Column<'_> {
    #[inline(always)]
    fn at<S: Lanes>(self, at: At) -> S {
        Column::at(self, at)
    }
}

impl Source for All {
    #[inline(always)]
    fn at<S: Lanes>(self, _: At) -> S {
        S::splat(self.0)
    }
}

/// Evaluates an expression with the kind of an input known: one loop for each kind.
macro_rules! for_kinds {
    ($n:expr; $input:expr, $name:ident => $call:expr) => {
        match $input {
            Input::Each(values) => {
                let $name = Column::new(values, $n);
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
            $body::<crate::real::Fused>($($arg),*)
        }
        #[cfg(target_arch = "x86_64")]
        #[target_feature(enable = "avx2,fma,avx512f,avx512vl,avx512dq,avx512bw")]
        fn avx512($($arg: $type),*) {
            $body::<crate::real::Fused>($($arg),*)
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

/// Runs a body that is generic over its registers, and over one lane of them, with those of an
/// [`Isa`].
macro_rules! dispatch_lanes {
    ($isa:expr, $body:ident ( $($arg:ident : $type:ty),* )) => {{
        #[cfg(target_arch = "x86_64")]
        #[target_feature(enable = "avx2,fma")]
        fn avx2($($arg: $type),*) {
            $body::<crate::batch::x86::F32x8, crate::real::Fused>($($arg),*)
        }
        #[cfg(target_arch = "x86_64")]
        #[target_feature(enable = "avx2,fma,avx512f,avx512vl,avx512dq,avx512bw")]
        fn avx512($($arg: $type),*) {
            $body::<crate::batch::x86::F32x16, crate::real::Fused>($($arg),*)
        }
        match $isa.0 {
            #[cfg(target_arch = "x86_64")]
            Level::Baseline => $body::<crate::batch::x86::F32x4, f32>($($arg),*),
            #[cfg(not(target_arch = "x86_64"))]
            Level::Baseline => $body::<f32, f32>($($arg),*),
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
use {dispatch_lanes, for_kinds};
