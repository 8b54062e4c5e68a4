//! Microfacet BRDF terms: distributions, masking and shadowing, Fresnel, diffuse models, their integrals
//! and what is built from them, each with its source and equation, accurate to a few units in the last
//! place.
//!
//! ```text
//! L_o(v)  = ∫ f(l, v) L_i(l) N·L dl                           what the eye sees
//! f(l, v) = D(h) F(V·H) G₂(l, v) / (4 N·L N·V) = D F V        the specular part, in 1/sr
//! ```
//!
//! A surface is made of facets too small to be seen. D says how many are turned to h, the one direction
//! that mirrors l into v; F how much of the light these reflect; G₂ how many of them both directions see.
//!
//! # The formula sheet
//!
//! n, l, v are the directions of the normal, to the light and to the viewer, of length 1, and N·L, N·V,
//! L·V the cosines between them. θ is the angle between the normal and the direction a formula is about.
//!
//! | | the half vector | from cosines | from vectors |
//! |---|---|---|---|
//! | h | (l + v)/‖l + v‖ | | |
//! | N·H | (N·L + N·V)/sqrt(2 + 2 L·V) | [`n_dot_h_from`] | |
//! | V·H = L·H | sqrt((1 + L·V)/2) | [`v_dot_h_from`] | [`v_dot_h_and_rest`] |
//! | θ_h, θ_d, φ_d | acos N·H, acos V·H, and l around h | | [`Rusinkiewicz`] |
//!
//! | | D: normals, 1/sr | from cosines | from vectors |
//! |---|---|---|---|
//! | GGX | α²/(π ((N·H)² (α² − 1) + 1)²) | [`d_ggx`] | [`Ggx::d_between`], [`d_ggx_world`] |
//! | stretched | 1/(π α_x α_y ((h_x/α_x)² + (h_y/α_y)² + h_z²)²) | [`d_ggx_aniso`] | [`Ggx::d_between`] |
//! | Beckmann | exp(−tan²θ/α²)/(π α² cos⁴θ) | [`d_beckmann`] | |
//! | Blinn-Phong | cosⁿθ/(π α²), n = 2/α² − 2 | [`d_blinn_phong`] | |
//! | α | roughness²; widened by the normal's variance: sqrt(α² + 2 σ²) | [`alpha_filtered`] | |
//! | ∫ D dω | 1 + α² atanh(s)/s, s = sqrt(1 − α²); ∫ D cos θ dω = 1 | [`integral_d_ggx`] | |
//!
//! | | G: what is seen | from cosines | from vectors |
//! |---|---|---|---|
//! | Λ, GGX | (sqrt(1 + α² tan²θ) − 1)/2 | [`lambda_ggx`] | [`Ggx::lambda`] |
//! | Λ, Beckmann | (erf a − 1)/2 + exp(−a²)/(2 a sqrt π), a = 1/(α tan θ) | [`lambda_beckmann`] | |
//! | G₁ | 1/(1 + Λ) | [`g1_ggx`], [`g1_beckmann`], [`g1_beckmann_rational`] | [`Ggx::g1`] |
//! | 1 − G₁ | Λ/(1 + Λ) | [`one_minus_g1_ggx`], [`one_minus_g1_beckmann`] | |
//! | G₂ | 1/(1 + Λ(l) + Λ(v)) | [`g2_ggx`], [`g2_beckmann`] | |
//! | G₂, separable | G₁(l) G₁(v) | [`g2_ggx_separable`] | |
//! | V | G₂/(4 N·L N·V) | [`v_ggx`], [`v_ggx_separable`] | [`Ggx::visibility`] |
//! | without roots | 0.5/lerp(2 N·L N·V, N·L + N·V, α) | [`v_ggx_hammon`], [`g2_ggx_hammon`] | |
//! | sixteen older ones | as printed, with what is wrong | [`gsf`] | |
//!
//! | | F: reflectance | from cosines | from vectors |
//! |---|---|---|---|
//! | Schlick | f0 + (1 − f0)(1 − V·H)⁵ | [`f_schlick`], [`f_schlick_ior`], [`f_spherical_gaussian`] | [`Fresnel::Schlick`] |
//! | with a dip | Schlick − a V·H (1 − V·H)⁶ | [`f_lazanyi`] | |
//! | dielectric | ½ ((g − c)/(g + c))² (1 + ((c (g + c) − 1)/(c (g − c) + 1))²), c = V·H, g² = η² − 1 + c² | [`f_dielectric`], [`t_dielectric`] | [`Fresnel::Dielectric`] |
//! | conductor | the same of a complex index n + ik | [`f_conductor`], [`t_conductor`] | [`Fresnel::Conductor`] |
//! | f0 | ((n − 1)/(n + 1))²; lerp(0.04, colour, metallic) | [`f0_from_ior`], [`f0_from_metallic`] | |
//!
//! | | f: the whole, 1/sr | from cosines | from vectors |
//! |---|---|---|---|
//! | D V | F = 1 | [`specular_ggx`] | [`Ggx::eval`] |
//! | D V F N·L | in three colours | | [`Specular::eval_cos`], [`specular_ggx_world`] |
//! | Lambert | ρ/π | [`diffuse_lambert`] | |
//! | rough diffuse | ρ/π times what roughness does to it | [`diffuse_oren_nayar`], [`diffuse_oren_nayar_full`], [`diffuse_eon`] | |
//! | under a coat | what is let in, and out again | [`diffuse_disney`], [`diffuse_hammon`] | |
//!
//! | | lights drawn for a view | from vectors |
//! |---|---|---|
//! | p | G₁(v) D/(4 N·V), 1/sr | [`Ggx::sample`], [`Ggx::pdf`] |
//! | w | f N·L/p = G₂/G₁(v) | [`Ggx::weight`], [`Specular::sample`] |
//! | walks | from facet to facet until out again | [`walk::walk`], [`walk::walk_mirrors`] |
//!
//! | | integrals over the hemisphere | from cosines |
//! |---|---|---|
//! | E(v) | ∫ D V N·L dl | [`albedo_ggx`], [`AlbedoTable`], [`albedo_fits`] |
//! | E_avg, F_avg | 2 ∫ E μ dμ; (1 + 20 f0)/21 | [`albedo_average_ggx`], [`f_schlick_average`] |
//! | f_ms | (1 − E(l))(1 − E(v))/(π (1 − E_avg)), 1/sr | [`f_multi_kulla_conty`], [`multi_scattering_tint`] |
//! | c | 1 + f0 (1 − E(v))/E(v) | [`compensation_turquin`] |
//! | 1 | ∫ D G₁(v) max(v·m, 0) dm/N·V | [`integral_g1_d_ggx`] |
//!
//! Many at once, in loops for AVX2 and AVX-512: [`batch`]. By name, with arguments, ranges, source and WGSL
//! twin as data: [`terms()`], [`term()`]. The papers: [`sources`].
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
//! # How to read a page
//!
//! Each function's page has one line on what it is, the formula as the field writes it, and a list:
//!
//! - *Source*: the paper, and the number of the equation where it could be confirmed; [`sources`] has titles.
//! - *Arguments*: their symbols and domains. Cosines and shares are pure numbers.
//! - *Value*: its unit and range, limits and symmetries. *Reciprocal*: the same when l and v change places.
//! - *Outside*: what arguments outside the domain give. Nothing panics, and NaN comes only from NaN (for
//!   the batches inside their domain).
//! - *Error*: the worst that a search has found, over α from 1e-4 to 1 and cosines down to 1e-6, against
//!   the textbook form in 36 digits and more, in units of the last place of the value (ulp) in the
//!   precision named. Arguments count as exact.
//! - *Right and wrong*: where a model fails, and by how much.
//!
//! Below it stands why it is not computed as printed, where it is not.
//!
//! # Precision and instruction sets
//!
//! Every formula is written once, generic over [`Real`]: `f32` and `f64`, with elementary functions from
//! `libm`, so that results do not depend on the platform. The [`batch`]es are compiled for three instruction
//! sets and choose at run time, without flags and without nightly: the baseline of the architecture (SSE2 on
//! x86-64), AVX2 with FMA, and AVX-512. Elsewhere (aarch64, WebAssembly) the baseline is all there is.
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
pub mod sources;
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
