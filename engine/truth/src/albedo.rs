//! Directional albedos: the textbook's integral over the facets, by a quadrature of its own.
//!
//! ```text
//! E(v) = ∫ D(h) G₂(l, v) F(v·h) (v·h)/N·V dh    over the facets that mirror v upwards
//! ```
//!
//! It is Walter et al. 2007, eq. 20, times N·L, over h instead of l (dl = 4 v·h dh), with their D (eq. 33)
//! and Heitz' Λ (2014, eq. 72) as printed. The facets are counted by tilt and azimuth, where `brdf` works
//! with slopes on a disc, and the rule is double-exponential, where `brdf` has Gauss' nodes. Written for
//! digits, not for speed: 2 ms each, 11 digits and more.

use crate::quadrature::integral;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

/// Value of a directional albedo of `brdf`, or of its average, by its name.
///
/// N·V is brought into [1e-9, 1] and |α| into [1e-6, 1e6], beyond which nothing changes that could be
/// seen. `None` where there is no albedo of that name, and of NaN.
pub fn value(name: &str, args: &[f64]) -> Option<f64> {
    let args: Vec<f64> = match args {
        [alpha] => vec![width(*alpha)],
        [mu, alpha] => vec![cosine(*mu), width(*alpha)],
        _ => return None,
    };
    let value = match (name, &args[..]) {
        ("albedo_ggx", &[mu, alpha]) => correlated(mu, alpha, |_| 1.0),
        ("albedo_ggx_separable", &[mu, alpha]) => directional(mu, alpha, |l| {
            1.0 / ((1.0 + lambda(l.n_dot_l, alpha)) * (1.0 + lambda(mu, alpha)))
        }),
        ("albedo_ggx_divided_twice", &[mu, alpha]) => directional(mu, alpha, |l| {
            g2(l.n_dot_l, mu, alpha) / (4.0 * l.n_dot_l * mu)
        }),
        // Grazing views are where E bends: μ = y².
        ("albedo_average_ggx", &[alpha]) => integral(0.0, 1.0, 1e-7, 0.0, |y| {
            4.0 * y * y * y * correlated(y * y, alpha, |_| 1.0)
        }),
        _ => f64::NAN,
    };
    value.is_finite().then_some(value)
}

/// Directional albedo with the height-correlated G₂ and a reflectance as a function of V·H.
///
/// Arguments as [`value`] takes them; NaN of NaN.
pub fn correlated(n_dot_v: f64, alpha: f64, reflectance: impl Fn(f64) -> f64) -> f64 {
    let (mu, alpha) = (cosine(n_dot_v), width(alpha));
    directional(mu, alpha, |l| {
        g2(l.n_dot_l, mu, alpha) * reflectance(l.v_dot_h)
    })
}

fn cosine(mu: f64) -> f64 {
    mu.clamp(1e-9, 1.0)
}

fn width(alpha: f64) -> f64 {
    alpha.abs().clamp(1e-6, 1e6)
}

/// A light that a facet mirrors into the view.
struct Mirrored {
    n_dot_l: f64,
    v_dot_h: f64,
}

/// D of GGX of a facet's tilt.
fn d(theta: f64, alpha: f64) -> f64 {
    let (a2, tan2, cos2) = (alpha * alpha, theta.tan().powi(2), theta.cos().powi(2));
    a2 / (PI * cos2 * cos2 * (a2 + tan2).powi(2))
}

fn lambda(cos: f64, alpha: f64) -> f64 {
    let tan2 = (1.0 - cos * cos) / (cos * cos);
    (-1.0 + (1.0 + alpha * alpha * tan2).sqrt()) / 2.0
}

fn g2(n_dot_l: f64, n_dot_v: f64, alpha: f64) -> f64 {
    1.0 / (1.0 + lambda(n_dot_l, alpha) + lambda(n_dot_v, alpha))
}

/// ∫ D `seen` (v·h)/N·V dh over the facets that mirror the view upwards; `seen` is what else the
/// integrand has.
fn directional(mu: f64, alpha: f64, seen: impl Fn(Mirrored) -> f64) -> f64 {
    if mu.is_nan() || alpha.is_nan() {
        return f64::NAN;
    }
    let view = mu.acos();
    let sin = view.sin();
    // The light of a facet tilted by θ, at azimuth φ from the view, has N·L = μ cos 2θ + sin θ_v sin 2θ cos φ.
    let ring = |theta: f64| {
        let (along, across) = (mu * (2.0 * theta).cos(), sin * (2.0 * theta).sin());
        // Up to the azimuth where it goes below the horizon.
        let end = if along >= across {
            PI
        } else if along <= -across {
            return 0.0;
        } else {
            (-along / across).acos()
        };
        let (upright, tilted) = (mu * theta.cos(), sin * theta.sin());
        let facet = |phi: f64| {
            let n_dot_l = along + across * phi.cos();
            if n_dot_l <= 0.0 {
                return 0.0;
            }
            let v_dot_h = upright + tilted * phi.cos();
            v_dot_h * seen(Mirrored { n_dot_l, v_dot_h })
        };
        let around = integral(0.0, end, 1e-8, 0.0, facet);
        // Both sides of the plane of view and normal.
        2.0 * around * d(theta, alpha) * theta.sin() / mu
    };
    // Facets tilted less than the first mirror the view upwards whichever way they face, those tilted more
    // than the second never.
    let (always, never) = (FRAC_PI_4 - 0.5 * view, FRAC_PI_4 + 0.5 * view);
    // Whatever is as narrow as α or as the view is grazing, is smooth between these tilts.
    let mut tilts = vec![0.0, always, never.min(FRAC_PI_2)];
    let mut tilt = 0.25 * alpha.min(mu);
    while tilt < never {
        tilts.push(tilt);
        tilt *= 5.0;
    }
    tilts.sort_by(f64::total_cmp);
    let mut sum = 0.0;
    for piece in tilts.windows(2) {
        if piece[1] > piece[0] && piece[1] <= never {
            sum += integral(piece[0], piece[1], 1e-8, sum, ring);
        }
    }
    sum
}
