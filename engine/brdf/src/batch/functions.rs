//! Elementary functions without branches and calls, for loops that are to be vectorised.

use super::lanes::{self, Lanes};
use crate::real::{Single, lit};
use std::f64::consts::FRAC_PI_2;

/// sin and cos of 2π u for u in [0, 1], by polynomials on an eighth of a turn; within 1e-7.
#[inline(always)]
pub(crate) fn sin_cos_turn<S: Lanes>(u: S) -> (S, S) {
    let turn = Turn::of(u);
    let (sin, cos) = Turn::polynomials(turn.rest);
    S::turned(turn.quarters, sin, cos)
}

/// An angle on its way to sine and cosine, which [`Lanes::turned`] completes.
pub(super) struct Turn<S> {
    /// Turns rounded to quarters by adding a large number: how many they are is in the last bits.
    pub quarters: S,
    /// The rest in turns, from −⅛ to ⅛; exact.
    pub rest: S,
}

impl<S: Lanes> Turn<S> {
    /// Of 2π u.
    #[inline(always)]
    pub fn of(u: S) -> Turn<S> {
        let magic = lanes::lit::<S>(3_145_728.0);
        let quarters = u + magic;
        let rest = u - (quarters - magic);
        Turn { quarters, rest }
    }

    /// Sine and cosine of the rest.
    #[inline(always)]
    pub fn polynomials(r: S) -> (S, S) {
        let r2 = r * r;
        // Minimax of sin(2π r)/r and cos(2π r) in r².
        let [s3, s2, s1, s0] = SIN.map(|c| c as f32);
        let sin = S::splat(s3)
            .mul_add(r2, S::splat(s2))
            .mul_add(r2, S::splat(s1))
            .mul_add(r2, S::splat(s0));
        let [c3, c2, c1] = COS.map(|c| c as f32);
        let cos = S::splat(c3)
            .mul_add(r2, S::splat(c2))
            .mul_add(r2, S::splat(c1))
            .mul_add(r2, S::splat(1.0));
        (r * sin, cos)
    }
}

/// Highest power first; fitted in quarters of a turn.
const SIN: [f64; 4] = [
    -4.601_657_4e-3 * 16_384.0,
    7.968_003_3e-2 * 1_024.0,
    -0.645_963_46 * 64.0,
    FRAC_PI_2 * 4.0,
];
const COS: [f64; 3] = [
    -2.041_728_2e-2 * 4_096.0,
    0.253_603_21 * 256.0,
    -1.233_697_7 * 16.0,
];

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
