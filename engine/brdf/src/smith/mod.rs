//! Masking and shadowing by Smith's model: Λ, G₁, G₂ and the visibility V.
//!
//! | symbol | function | source |
//! |---|---|---|
//! | Λ | [`lambda_ggx`], [`lambda_beckmann`] | Heitz 2014, eq. 72; section 5 |
//! | G₁ | [`g1_ggx`], [`g1_beckmann`], [`g1_beckmann_rational`] | Heitz 2014, eq. 43; Walter et al. 2007, eq. 34, 26, 27 |
//! | 1 − G₁ | [`one_minus_g1_ggx`], [`one_minus_g1_beckmann`] | Heitz 2014, eq. 43 |
//! | G₂ | [`g2_ggx`], [`g2_beckmann`] | Heitz 2014, eq. 99 |
//! | G₂, separable | [`g2_ggx_separable`] | Heitz 2014, eq. 98 |
//! | G₂, approximated | [`g2_ggx_hammon`] | Hammon 2017 |
//! | V = G₂/(4 N·L N·V) | [`v_ggx`], [`v_ggx_separable`], [`v_ggx_hammon`] | Lagarde and de Rousiers 2014 |
//!
//! Smith's surface is a height field whose slopes do not depend on one another. All of it follows from
//! one function of the distribution, Λ (Heitz 2014, section 5):
//!
//! ```text
//! G₁(v)    = 1 / (1 + Λ(v))             of the facets turned to v, the share that v sees
//! G₂(l, v) = 1 / (1 + Λ(l) + Λ(v))      the share that both see; both grow with a facet's height
//! V        = G₂ / (4 N·L N·V)           what remains of the BRDF next to D and F
//! ```
//!
//! The trap is to divide by 4 N·L N·V twice: V already is. [`v_ggx`] may be any size, [`g2_ggx`] is in
//! [0, 1]; neither stands for the other.
//!
//! A cosine at or below 0 is a direction below the horizon: Λ is +∞, G is 0. V is 0 below the horizon and
//! takes its limit on it. Cosines above 1 count as 1. Only α² enters, but for Hammon's approximation,
//! which brings α into [0, 1].

mod lambda;
mod masking;
mod masking_shadowing;
mod visibility;

pub use lambda::*;
pub use masking::*;
pub use masking_shadowing::*;
pub use visibility::*;

use crate::real::{Real, lit, zero_unless_nan};
use crate::term::Term;

pub(crate) const TERMS: &[Term] = &[
    lambda::LAMBDA_GGX,
    lambda::LAMBDA_BECKMANN,
    masking::G1_GGX,
    masking::G1_BECKMANN,
    masking::G1_BECKMANN_RATIONAL,
    masking::ONE_MINUS_G1_GGX,
    masking::ONE_MINUS_G1_BECKMANN,
    masking_shadowing::G2_GGX,
    masking_shadowing::G2_GGX_SEPARABLE,
    masking_shadowing::G2_GGX_HAMMON,
    masking_shadowing::G2_BECKMANN,
    visibility::V_GGX,
    visibility::V_GGX_SEPARABLE,
    visibility::V_GGX_HAMMON,
];

/// `value` of the two cosines, at most 1; 0 where one of them is not above the horizon.
#[inline(always)]
pub(crate) fn above_horizon<R: Real>(n_dot_l: R, n_dot_v: R, value: impl FnOnce(R, R) -> R) -> R {
    // Computed in any case: a loop without branches works on several points at a time.
    let above = value(n_dot_l.at_most(lit(1.0)), n_dot_v.at_most(lit(1.0)));
    if n_dot_l > lit(0.0) && n_dot_v > lit(0.0) {
        above
    } else {
        zero_unless_nan([n_dot_l, n_dot_v])
    }
}

/// sin θ of a cosine in [0, 1].
#[inline(always)]
pub(crate) fn sine<R: Real>(c: R) -> R {
    ((lit::<R>(1.0) - c) * (lit::<R>(1.0) + c))
        .at_least(lit(0.0))
        .sqrt()
}

/// sqrt(c² + α² s²), which is c sqrt(1 + α² tan²θ): no quotient, and no α² − 1.
#[inline(always)]
pub(crate) fn projected<R: Real>(c: R, alpha: R) -> R {
    c.hypot(alpha.bounded() * sine(c))
}
