//! Elementary functions without branches and calls, for loops that are to be vectorised.

use super::lanes::{self, Lanes};
use crate::real::{Single, lit};
use std::f64::consts::FRAC_PI_2;

/// sin and cos of 2π u for u in [0, 1], by polynomials on an eighth of a turn; within 1e-7.
#[inline(always)]
pub(crate) fn sin_cos_turn<S: Lanes>(u: S) -> (S, S) {
    let lit = lanes::lit::<S>;
    // Quarter turns, rounded by adding a large number, in whose last bits they are then.
    let magic = lit(12_582_912.0);
    let quarters = lit(4.0) * u;
    let rounded = quarters + magic;
    // The rest in [−½, ½] quarter turns; exact.
    let r = quarters - (rounded - magic);
    let r2 = r * r;
    // Minimax of sin(π r/2)/r and cos(π r/2) in r².
    let sin = r * lit(-4.601_657_4e-3)
        .mul_add(r2, lit(7.968_003_3e-2))
        .mul_add(r2, lit(-0.645_963_46))
        .mul_add(r2, lit(FRAC_PI_2));
    let cos = lit(-2.041_728_2e-2)
        .mul_add(r2, lit(0.253_603_21))
        .mul_add(r2, lit(-1.233_697_7))
        .mul_add(r2, lit(1.0));
    S::turned(rounded, sin, cos)
}

/// ln of a normal number.
#[inline(always)]
pub(crate) fn ln_unit<S: Single>(x: S) -> S {
    // x = m 2^k with m in [sqrt(½), sqrt(2)).
    let bits = x.store().to_bits();
    let shifted = bits.wrapping_sub(0x3f35_04f3);
    let k = S::load((shifted as i32 >> 23) as f32);
    let m = S::load(f32::from_bits((shifted & 0x007f_ffff) + 0x3f35_04f3));
    let r = m - lit(1.0);
    let r2 = r * r;
    // Minimax of (ln(1 + r) − r + r²/2)/r³ on that range.
    let coefficients = [
        7.037_683_6e-2,
        -0.115_146_1,
        0.116_769_99,
        -0.124_201_41,
        0.142_493_23,
        -0.166_680_58,
        0.200_007_15,
        -0.249_999_94,
        0.333_333_31,
    ];
    let mut p = lit::<S>(coefficients[0]);
    for &c in &coefficients[1..] {
        p = p.mul_add(r, lit(c));
    }
    let small = (r * r2).mul_add(p, lit::<S>(-0.5) * r2);
    // ln 2 in two parts, the first exact times k.
    k.mul_add(
        lit(0.693_359_375),
        r + k.mul_add(lit(-2.121_944_4e-4), small),
    )
}
