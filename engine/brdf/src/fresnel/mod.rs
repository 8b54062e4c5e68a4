//! F: how much a mirror reflects.
//!
//! | symbol | function | source |
//! |---|---|---|
//! | F, Schlick | [`f_schlick`], [`f_schlick_ior`] | Schlick 1994 |
//! | F, spherical Gaussian | [`f_spherical_gaussian`] | Karis 2013 |
//! | F, Lazányi | [`f_lazanyi`] | Lazányi and Szirmay-Kalos 2005 |
//! | F, dielectric | [`f_dielectric`]; 1 − F: [`t_dielectric`] | Cook and Torrance 1982 |
//! | F, conductor | [`f_conductor`], [`conductor_rgb`]; 1 − F: [`t_conductor`] | Born and Wolf, optics of metals |
//! | f0 | [`f0_from_ior`], [`f0_from_metallic`] | Burley 2012 |
//! | F_avg | [`f_schlick_average`] | closed form |
//!
//! `v_dot_h` is the cosine between the direction and the facet it is mirrored in, the same for light and
//! view; N·V only where the surface itself is the mirror. It counts as 0 below 0 and as 1 above 1.
//!
//! With one distant light V·H, and F with it, is the same all over a sphere: a Fresnel rim is a matter of
//! the light's direction, not of the silhouette.

mod conductor;
mod dielectric;
mod schlick;

pub use conductor::*;
pub use dielectric::*;
pub use schlick::*;

use crate::real::{Real, lit};
use crate::term::Term;

pub(crate) const TERMS: &[Term] = &[
    schlick::F_SCHLICK,
    schlick::F_SPHERICAL_GAUSSIAN,
    schlick::F_SCHLICK_IOR,
    dielectric::F_DIELECTRIC,
    dielectric::T_DIELECTRIC,
    conductor::T_CONDUCTOR,
    conductor::F_CONDUCTOR,
    schlick::F_LAZANYI,
];

/// a² + c² − 1 as an unevaluated sum: near the critical angle (a = η), and near Brewster's
/// (a = η c), everything depends on its last digits.
#[inline(always)]
fn squares_above_one<R: Real>(a: (R, R), c: R) -> (R, R) {
    let ((p, p_low), (q, q_low)) = (a.0.two_prod(a.0), c.two_prod(c));
    let p_low = p_low + lit::<R>(2.0) * a.0 * a.1;
    let (sum, sum_low) = p.two_sum(q);
    let (high, low) = sum.two_sum(lit(-1.0));
    high.two_sum(low + (sum_low + (p_low + q_low)))
}
