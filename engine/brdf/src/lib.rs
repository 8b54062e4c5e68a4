//! Microfacet BRDF terms: distributions, masking and shadowing, Fresnel, diffuse models,
//! their integrals and what is built from them.
//!
//! Every formula is written once, generic over its precision ([`Real`]), in the form that
//! stays accurate, next to its name, its arguments, its source and its WGSL twin. The
//! registry ([`terms()`], [`term()`]) hands all of that out as data.
//!
//! Conventions, without exception: `alpha = roughness²`; D is normalised so that the
//! integral of D cos θ over the hemisphere is 1; angles are radians unless a name says
//! `deg`; a BRDF is in 1/sr; `v_*` is the visibility G₂/(4 N·L N·V), `g2_*` the
//! masking-shadowing function in [0, 1].
//!
//! Nothing here touches a file, the environment, a clock, a thread or a random source.

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
