//! Integrals by the double-exponential rule.
//!
//! Nothing is known of it to the quadratures of `brdf`, which have Gauss' nodes: the points crowd at both
//! ends of an interval, so that roots and poles there cost nothing, and their number is doubled until the
//! sum no longer changes.

use std::f64::consts::PI;
use std::sync::LazyLock;

/// A point of the rule: its distance from the nearer end and its weight, both over the length of the
/// interval. Each stands for two, one at each end, but for the one in the middle.
struct Node {
    at: f64,
    weight: f64,
}

/// From a step of 1/4 to one of 1/128.
const LEVELS: usize = 6;

/// x = (1 + tanh(π/2 sinh t))/2: what each level has in addition to the one before.
static NODES: LazyLock<[Vec<Node>; LEVELS]> = LazyLock::new(|| {
    let node = |t: f64| {
        // e^(−2u) of u = π/2 sinh t: 1 − tanh u without the difference.
        let q = (-PI * t.sinh()).exp();
        Node {
            at: q / (1.0 + q),
            weight: PI * t.cosh() * q / ((1.0 + q) * (1.0 + q)),
        }
    };
    std::array::from_fn(|level| {
        let step = 0.25 / f64::from(1u32 << level);
        let ticks = (3.25 / step) as u32;
        let new = (0..=ticks).filter(|tick| level == 0 || tick % 2 == 1);
        new.map(|tick| node(f64::from(tick) * step)).collect()
    })
});

/// ∫ f over [a, b], until halving the step changes it by less than `tolerance` of `of` or of itself.
///
/// Once it converges, each level doubles the digits: what is left is the square of the last change.
pub(crate) fn integral(a: f64, b: f64, tolerance: f64, of: f64, f: impl Fn(f64) -> f64) -> f64 {
    let length = b - a;
    let pair = |node: &Node| {
        let both = if node.at == 0.5 {
            f(a + 0.5 * length)
        } else {
            f(a + node.at * length) + f(b - node.at * length)
        };
        node.weight * both
    };
    let mut sum = 0.0;
    let mut last = f64::INFINITY;
    for (level, nodes) in NODES.iter().enumerate() {
        sum += nodes.iter().map(pair).sum::<f64>();
        let value = sum * length * 0.25 / f64::from(1u32 << level);
        if (value - last).abs() <= tolerance * value.abs().max(of) {
            return value;
        }
        last = value;
    }
    last
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(a: f64, b: f64, f: impl Fn(f64) -> f64, expected: f64) {
        let value = integral(a, b, 1e-9, 0.0, f);
        assert!(
            (value - expected).abs() < 1e-13 * expected.abs(),
            "{value}, not {expected}"
        );
    }

    #[test]
    fn known_integrals() {
        check(0.0, PI, f64::sin, 2.0);
        check(1.0, 3.0, |x| 1.0 / x, 3.0f64.ln());
        check(0.0, 1.0, f64::sqrt, 2.0 / 3.0);
        check(0.0, 1.0, |x| (1.0 - x * x).sqrt(), PI / 4.0);
        check(0.0, 1.0, |x| -x.ln(), 1.0);
    }
}
