//! Elementary functions without branches and calls, for loops that are to be vectorised.

use crate::real::{Single, lit};
use std::f64::consts::PI;

/// sin and cos of 2π u for u in [0, 1], by polynomials on an eighth of a turn.
#[inline(always)]
pub(crate) fn sin_cos_turn<S: Single>(u: S) -> (S, S) {
    let one = lit::<S>(1.0);
    // Quarter turns, rounded by adding and taking away a large number.
    let quarters = lit::<S>(4.0) * u;
    let magic = lit::<S>(12_582_912.0);
    let q = (quarters + magic) - magic;
    // The rest in [−½, ½] quarter turns; exact.
    let r = quarters - q;
    let x = r * lit(PI / 2.0);
    let x2 = x * x;
    let sin = (x * x2).mul_add(
        lit::<S>(-1.951_529_6e-4)
            .mul_add(x2, lit(8.332_161e-3))
            .mul_add(x2, lit(-0.166_666_55)),
        x,
    );
    let cos = (x2 * x2).mul_add(
        lit::<S>(2.443_315_7e-5)
            .mul_add(x2, lit(-1.388_731_6e-3))
            .mul_add(x2, lit(4.166_664_6e-2)),
        lit::<S>(-0.5).mul_add(x2, one),
    );
    // q is 0 to 4: swapped when odd; cos negative for 1 and 2, sin for 2 and 3.
    let odd = (q == one) || (q == lit(3.0));
    let (a, b) = if odd { (cos, sin) } else { (sin, cos) };
    let sin = if q == lit(2.0) || q == lit(3.0) {
        -a
    } else {
        a
    };
    let cos = if q == one || q == lit(2.0) { -b } else { b };
    (sin, cos)
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
