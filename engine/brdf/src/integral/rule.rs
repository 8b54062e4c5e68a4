//! The nodes that the quadratures share.

use crate::real::Real;
use std::f64::consts::PI;
use std::sync::LazyLock;

/// Gauss-Legendre nodes and weights on [0, 1].
fn gauss_legendre(n: usize) -> Vec<(f64, f64)> {
    let node = |i: usize| {
        let mut x = libm::cos(PI * (i as f64 + 0.75) / (n as f64 + 0.5));
        let mut derivative = 1.0;
        // Newton's method on the Legendre polynomial; five steps from here are enough.
        for _ in 0..8 {
            let (mut p, mut q) = (1.0, 0.0);
            for k in 0..n {
                let k = k as f64;
                (p, q) = (((2.0 * k + 1.0) * x * p - k * q) / (k + 1.0), p);
            }
            derivative = n as f64 * (x * p - q) / (x * x - 1.0);
            x -= p / derivative;
        }
        (
            0.5 - 0.5 * x,
            1.0 / ((1.0 - x * x) * derivative * derivative),
        )
    };
    (0..n).map(node).collect()
}

/// The nodes of a quadrature over the slopes.
pub(super) struct Rule {
    /// Nodes and weights on [0, 1].
    pub(super) radial: Vec<(f64, f64)>,
    /// cos φ of the midpoints of half a turn.
    pub(super) cosines: Vec<f64>,
    /// The N·V over α from where on polar coordinates are better than cartesian ones of grazing views: with
    /// more nodes the latter stay good for longer.
    pub(super) seam: f64,
}

impl Rule {
    /// As many nodes as a precision can use.
    pub(super) fn of<R: Real>() -> &'static Rule {
        if R::EPSILON < 1e-10 { &FINE } else { &COARSE }
    }

    fn new(n: usize, seam: f64) -> Rule {
        let cosines = (0..n)
            .map(|i| libm::cos(PI * (i as f64 + 0.5) / n as f64))
            .collect();
        Rule {
            radial: gauss_legendre(n),
            cosines,
            seam,
        }
    }
}

static COARSE: LazyLock<Rule> = LazyLock::new(|| Rule::new(32, 1.4));
static FINE: LazyLock<Rule> = LazyLock::new(|| Rule::new(128, 4.3));

static AVERAGE: LazyLock<Vec<(f64, f64)>> = LazyLock::new(|| gauss_legendre(24));

/// Nodes and weights of an average over the views.
pub(crate) fn average_nodes() -> &'static [(f64, f64)] {
    &AVERAGE
}
