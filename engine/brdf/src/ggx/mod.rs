//! GGX from vectors in the tangent frame; [`sampling`](crate::sampling) draws them.
//!
//! | symbol | item | source |
//! |---|---|---|
//! | D | [`Ggx::d`], [`Ggx::d_between`] | Walter et al. 2007, eq. 33; Burley 2012, eq. 13 |
//! | Λ, G₁ | [`Ggx::lambda`], [`Ggx::g1`] | Heitz 2014, eq. 86, 43 |
//! | V | [`Ggx::visibility`] | Heitz 2014, eq. 99 |
//! | D V | [`Ggx::eval`] | Walter et al. 2007, eq. 20 |
//! | V·H, 1 − V·H | [`v_dot_h_and_rest`] | Hammon 2017 |
//! | F | [`Fresnel`] | see [`fresnel`](crate::fresnel) |
//! | D V F cos θ | [`Specular`] | Walter et al. 2007, eq. 20; Heitz 2014, eq. 99 |
//!
//! Given vectors instead of cosines nothing cancels: sin²θ is x² + y², the half vector is used as l + v
//! without its length, and 1 − V·H is |l − v|²/(4 (1 + V·H)). Directions are expected to have length 1 and
//! to point away from the surface; z is along the normal. Where lengths or widths are such that a square
//! overflows or vanishes, the value is that of the directions.
//!
//! ```
//! use brdf::{Fresnel, Ggx, Specular, glam::Vec3};
//!
//! let gold = Fresnel::Conductor { n: [0.143f32, 0.375, 1.442], k: [3.983, 2.386, 1.603] };
//! let lobe = Specular { ggx: Ggx::new(0.16), fresnel: gold };
//! let (l, v) = (Vec3::new(0.6, 0.0, 0.8), Vec3::new(-0.6, 0.0, 0.8));
//! let [red, green, blue] = lobe.eval_cos(l, v); // D V F cos θ, in 1/sr
//! assert!(red > green && green > blue);
//! ```

// In the order in which the documentation shows what they add to the surface.
mod surface;

mod distribution;

mod visibility;

mod eval;

mod half_angle;
mod lobe;
mod mirror;

pub use half_angle::v_dot_h_and_rest;
pub use lobe::Specular;
pub use mirror::Fresnel;
pub use surface::Ggx;

use crate::real::{Real, lit};

/// The square of an unevaluated sum, without its last term.
#[inline(always)]
fn square<R: Real>((high, low): (R, R)) -> R {
    high * high + lit::<R>(2.0) * high * low
}
