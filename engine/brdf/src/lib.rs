//! Microfacet BRDF terms: distributions, masking and shadowing, Fresnel, diffuse models, their integrals
//! and what is built from them, each with its source and equation, accurate to a few units in the last
//! place.
//!
//! ```text
//! f(l, v) = D(h) F(v·h) G₂(l, v) / (4 N·L N·V) = D F V        specular, in 1/sr
//! L_o(v)  = ∫ f(l, v) L_i(l) N·L dl                           what the eye sees
//! ```
//!
//! # Which function for which symbol
//!
//! | symbol | meaning | from cosines | from vectors |
//! |---|---|---|---|
//! | α | width, roughness² | | [`alpha_filtered`] |
//! | h, N·H, V·H | half vector | [`n_dot_h_from`], [`v_dot_h_from`] | [`v_dot_h_and_rest`] |
//! | D | distribution, 1/sr | [`d_ggx`], [`d_beckmann`], [`d_blinn_phong`], [`d_ggx_aniso`] | [`Ggx::d_between`], [`d_ggx_world`] |
//! | Λ | hidden over seen | [`lambda_ggx`], [`lambda_beckmann`] | [`Ggx::lambda`] |
//! | G₁, 1 − G₁ | masking | [`g1_ggx`], [`g1_beckmann`], [`one_minus_g1_ggx`] | [`Ggx::g1`] |
//! | G₂ | masking and shadowing | [`g2_ggx`], [`g2_ggx_separable`], [`g2_ggx_hammon`], [`g2_beckmann`], [`gsf`] | |
//! | V | G₂/(4 N·L N·V) | [`v_ggx`], [`v_ggx_separable`], [`v_ggx_hammon`] | [`Ggx::visibility`] |
//! | F | reflectance | [`f_schlick`], [`f_dielectric`], [`f_conductor`], [`f_lazanyi`] | [`Fresnel`] |
//! | f | BRDF, 1/sr | [`specular_ggx`] | [`Ggx::eval`], [`Specular::eval_cos`], [`specular_ggx_world`] |
//! | f_d | diffuse, 1/sr | [`diffuse_lambert`], [`diffuse_disney`], [`diffuse_oren_nayar`], [`diffuse_hammon`], [`diffuse_eon`] | |
//! | p, w | density, weight of a drawn light | | [`Ggx::sample`], [`Ggx::pdf`], [`Ggx::weight`] |
//! | E, E_avg | directional albedo | [`albedo_ggx`], [`albedo_average_ggx`], [`AlbedoTable`], [`albedo_fits`] | |
//! | f_ms | energy put back | [`f_multi_kulla_conty`], [`compensation_turquin`] | |
//! | ∫ D | facet area | [`integral_d_ggx`] | |
//! | θ_h, θ_d, φ_d | coordinates | | [`Rusinkiewicz`] |
//! | | random walks on the microsurface | | [`walk::walk`], [`walk::walk_mirrors`] |
//! | | many at once, AVX-512 | [`batch::specular`], [`batch::conductor_rgb`] | [`batch::specular_vectors`], [`batch::sample`] |
//!
//! By name, with arguments, ranges, source and WGSL twin as data: [`terms()`], [`term()`].
//!
//! # A worked example
//!
//! Roughness 0.4 is α = 0.16; a light and a view at N·L = 0.8, N·V = 0.6, N·H = 0.95, V·H = 0.9:
//!
//! ```
//! use brdf::{d_ggx, f_schlick, v_ggx};
//! let alpha = 0.4f64 * 0.4;
//! let d = d_ggx(0.95, alpha); //      0.560 1/sr
//! let v = v_ggx(0.8, 0.6, alpha); //  0.513, already G₂/(4 N·L N·V)
//! let f = f_schlick(0.04, 0.9); //    0.040
//! let brdf = d * v * f; //            0.0115 1/sr
//! let reflected = brdf * 0.8; //      times N·L: 0.0092 for a light of 1
//! assert!((reflected - 0.00920).abs() < 1e-5);
//! ```
//!
//! The same from vectors, in f32 and in three colours, drawn and evaluated:
//!
//! ```
//! use brdf::{Fresnel, Ggx, Sampler, Specular, glam::Vec3};
//! let lobe = Specular {
//!     ggx: Ggx::new(0.16f32),
//!     fresnel: Fresnel::Schlick { f0: [0.9, 0.5, 0.2] },
//! };
//! let v = Vec3::new(0.0, 0.6, 0.8);
//! let (drawn, weight) = lobe.sample(v, [0.3, 0.7], Sampler::BoundedCap);
//! let value = lobe.eval_cos(drawn.l, v);
//! assert!((weight[0] - value[0] / drawn.pdf).abs() < 1e-5);
//! ```
//!
//! # Conventions
//!
//! Without exception: `alpha = roughness²`; D is normalised so that the integral of D cos θ over the
//! hemisphere is 1; angles are radians unless a name says `deg`; a BRDF is in 1/sr; `v_*` is the visibility
//! G₂/(4 N·L N·V), `g2_*` the masking-shadowing function in [0, 1]. Vectors point away from the surface and
//! have length 1; in the tangent frame z is along the normal.
//!
//! # Precision and instruction sets
//!
//! Every formula is written once, generic over [`Real`]: `f32` and `f64`, with elementary functions from
//! `libm`, so that results do not depend on the platform. The [`batch`]es are compiled for three instruction
//! sets and choose at run time, without flags and without nightly: the baseline of the architecture (SSE2 on
//! x86-64), AVX2 with FMA, and AVX-512. Elsewhere (aarch64, WebAssembly) the baseline is all there is.
//!
//! *Error* in these pages is the worst that a search has found, over α from 1e-4 to 1 and cosines down to
//! 1e-6, against the textbook form in 36 digits and more: in units of the last place of the value (ulp), of
//! the precision named. Arguments count as exact. What a function gives outside its domain is under
//! *Outside*; nothing panics, and NaN comes only from NaN (for the batches inside their domain).
//!
//! # Traps
//!
//! - **V or G₂?** [`v_ggx`] is divided by 4 N·L N·V already. Divided once more, a rough ball is dim in the
//!   middle and glows at its rim.
//! - **α or roughness?** Most take α; [`specular_ggx`], [`diffuse_disney`] and the classic functions of
//!   [`gsf`] take a roughness, and some of those mean α by it.
//! - **D is no density.** Its integral is 1 to 2 and its peak 1/(π α²). D cos θ is the density of normals, G₁ D
//!   v·m/N·V that of the visible ones.
//! - **N·H in f32.** Near the highlight of a smooth surface a cosine has lost what D depends on: from
//!   vectors D is good to 10 ulp, from N·H = 1 − 1e-7 it is whatever rounding left.
//! - **F at V·H, not at N·V**, unless the surface is a plain mirror.
//! - **Single scattering loses light**: 69 % at α = 1 seen straight on. See [`energy`].
//!
//! Nothing here touches a file, the environment, a clock, a thread or a random source.

#![warn(missing_docs)]

pub mod albedo_fits;
pub mod batch;
pub mod d;
pub mod diffuse;
pub mod energy;
pub mod fresnel;
pub mod ggx;
pub mod gsf;
pub mod half_vector;
pub mod integral;
pub mod real;
pub mod sampling;
pub mod smith;
pub mod term;
pub mod vector;
mod vector_terms;
pub mod walk;
pub mod whole;
pub mod world;

pub use albedo_fits::*;
pub use d::*;
pub use diffuse::*;
pub use energy::*;
pub use fresnel::*;
pub use ggx::*;
pub use gsf::*;
pub use half_vector::*;
pub use integral::*;
pub use real::Real;
pub use sampling::*;
pub use smith::*;
pub use term::{Param, Term, term, terms};
pub use vector::Vector;
pub use vector_terms::vector_terms;
pub use whole::*;
pub use world::*;

pub use glam;

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
