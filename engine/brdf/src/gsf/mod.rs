//! The classic geometric shadowing functions, each exactly as its source prints it.
//!
//! | function | range | reciprocal | what is wrong |
//! |---|---|---|---|
//! | [`gsf_implicit`] | 0 to 1 | yes | far too dark at grazing angles |
//! | [`gsf_ashikhmin_shirley`] | 0 to 1 | yes | belongs to another D: N·H is missing |
//! | [`gsf_ashikhmin_premoze`] | 0 to 1 | yes | belongs to another D |
//! | [`gsf_duer`] | 1/4 to ∞ | yes | is no shadowing function at all |
//! | [`gsf_neumann`] | 0 to 1 | yes | knows no roughness |
//! | [`gsf_kelemen`] | 0 to 1 | yes | knows no roughness |
//! | [`gsf_modified_kelemen`] | 0 to 1 | **no** | wrong for smooth surfaces, gains energy |
//! | [`gsf_cook_torrance`] | 0 to 1 | yes | knows no roughness |
//! | [`gsf_ward`] | 0 to 1 | yes | belongs to another D; gains energy with others |
//! | [`gsf_kurt`] | 0 to ∞ | yes | its exponent is no roughness; gains energy |
//! | [`gsf_walter`], [`gsf_ggx`] | 0 to 1 | yes | nothing: they are G₁ G₁ of GGX, α := roughness |
//! | [`gsf_smith_beckmann`] | 0 to 1.00013 | yes | a fit, within 0.32 % for each direction |
//! | [`gsf_schlick`] | 0 to 1 | yes | fits nobody's Smith function |
//! | [`gsf_schlick_beckmann`] | 0 to 1 | yes | a poor fit of Beckmann |
//! | [`gsf_schlick_ggx`] | 0 to 1 | yes | right if roughness means α |
//!
//! They are kept for comparison; what to use is [`g2_ggx`](crate::g2_ggx). All are meant to be divided by 4 N·L N·V.
//! Their `roughness` is used as printed, squared by some and not by others, so that one slider cannot
//! drive them all: with α = roughness² elsewhere, [`gsf_walter`], [`gsf_ggx`] and [`gsf_schlick_ggx`] take
//! roughness itself for α.
//!
//! The albedos quoted are with D of GGX at roughness 0.7 (α = 0.49), F = 1, seen at N·V = 1, 0.3 and 0.05;
//! the height-correlated Smith function has 0.698, 0.749, 0.914, and no shadowing at all 0.806,
//! 1.262, 5.293. Above 1 the surface gives more light than it gets.
//!
//! `n_dot_l` or `n_dot_v` at or below 0 gives 0, where a formula is meant for the lit side; other cosines
//! and roughness are brought into their range. Division by `v_dot_h` = 0 gives +∞.

mod cosines;
mod fitted;
mod smith;

pub use cosines::*;
pub use fitted::*;
pub use smith::*;

use crate::term::Term;

pub(crate) const TERMS: &[Term] = &[
    cosines::GSF_IMPLICIT,
    cosines::GSF_ASHIKHMIN_SHIRLEY,
    cosines::GSF_ASHIKHMIN_PREMOZE,
    cosines::GSF_DUER,
    cosines::GSF_NEUMANN,
    cosines::GSF_KELEMEN,
    fitted::GSF_MODIFIED_KELEMEN,
    cosines::GSF_COOK_TORRANCE,
    cosines::GSF_WARD,
    fitted::GSF_KURT,
    smith::GSF_WALTER,
    smith::GSF_SMITH_BECKMANN,
    smith::GSF_GGX,
    smith::GSF_SCHLICK,
    smith::GSF_SCHLICK_BECKMANN,
    smith::GSF_SCHLICK_GGX,
];

/// sqrt(2/π) as the sources print it.
const SQRT_2_OVER_PI: f64 = 0.797_884_560_802_865;
