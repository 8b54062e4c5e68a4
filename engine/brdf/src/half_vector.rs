//! The half vector without the half vector: cosines from cosines.

use crate::real::{Real, lit, zero_unless_nan};
use crate::term::{L_DOT_V, N_DOT_L, N_DOT_V, Term, entry};

pub(crate) const TERMS: &[Term] = &[N_DOT_H_FROM, V_DOT_H_FROM];

/// N·H = (N·L + N·V)/|L + V|, |L + V| = sqrt(2 + 2 L·V).
///
/// Hammon 2017. Exact in algebra and hazardous in arithmetic: near the highlight N·H is
/// almost 1, and D of a smooth surface depends on 1 − N·H, of which this keeps few digits.
/// Above 1 it counts as 1; where L = −V, or neither direction is above the horizon, it is 0.
#[inline(always)]
pub fn n_dot_h_from<R: Real>(n_dot_l: R, n_dot_v: R, l_dot_v: R) -> R {
    let sum = n_dot_l + n_dot_v;
    if sum <= lit(0.0) {
        return zero_unless_nan([n_dot_l, n_dot_v, l_dot_v]);
    }
    let length2 = lit::<R>(2.0) + lit::<R>(2.0) * l_dot_v.at_least(lit(-1.0)).at_most(lit(1.0));
    (sum / length2.sqrt()).at_most(lit(1.0))
}

const N_DOT_H_FROM: Term = entry!(
    n_dot_h_from(n_dot_l: N_DOT_L, n_dot_v: N_DOT_V, l_dot_v: L_DOT_V),
    symbol: "N·H", latex: r"N \cdot H", cost: 9,
    doc: "cosine between normal and half vector, from the three other cosines",
    source: "Hammon 2017",
    wgsl: Some("fn lobe_n_dot_h_from(n_dot_l: f32, n_dot_v: f32, l_dot_v: f32) -> f32 {
    let s = n_dot_l + n_dot_v;
    if (s <= 0.0) { return 0.0; }
    return min(s / sqrt(max(2.0 + 2.0 * l_dot_v, 1.0e-30)), 1.0);
}")
);

/// V·H = L·H = |L + V|/2 = sqrt((1 + L·V)/2).
///
/// Hammon 2017. The cosines to the normal do not enter; they are arguments so that it is
/// called like [`n_dot_h_from`]. L·V is cut off to [−1, 1].
#[inline(always)]
pub fn v_dot_h_from<R: Real>(n_dot_l: R, n_dot_v: R, l_dot_v: R) -> R {
    let unused = zero_unless_nan([n_dot_l, n_dot_v]);
    unused + (lit::<R>(0.5) + lit::<R>(0.5) * l_dot_v.at_least(lit(-1.0)).at_most(lit(1.0))).sqrt()
}

const V_DOT_H_FROM: Term = entry!(
    v_dot_h_from(n_dot_l: N_DOT_L, n_dot_v: N_DOT_V, l_dot_v: L_DOT_V),
    symbol: "V·H", latex: r"V \cdot H", cost: 5,
    doc: "cosine between view and half vector, from the cosine between light and view",
    source: "Hammon 2017",
    wgsl: Some("fn lobe_v_dot_h_from(n_dot_l: f32, n_dot_v: f32, l_dot_v: f32) -> f32 {
    return sqrt(0.5 + 0.5 * clamp(l_dot_v, -1.0, 1.0));
}")
);
