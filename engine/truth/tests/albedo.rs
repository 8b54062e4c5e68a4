//! The quadrature of albedos against what is known of them, and `brdf`'s against it.

use serde_json::Value;
use std::f64::consts::{FRAC_PI_2, PI};
use truth::albedo;

#[track_caller]
fn close(name: &str, args: &[f64], expected: f64, relative: f64) {
    let value = albedo::value(name, args).expect("a value");
    let error = (value - expected).abs() / expected;
    assert!(
        error < relative,
        "{name} {args:?}: {value}, not {expected}: {error:e}"
    );
}

#[test]
fn the_roughest_surface() {
    for mu in [1e-6, 1e-3, 0.05, 0.3, 0.8, 1.0f64] {
        close(
            "albedo_ggx",
            &[mu, 1.0],
            1.0 - mu * (1.0 / mu).ln_1p(),
            1e-12,
        );
    }
    let average = 4.0 * (1.0 - 2.0f64.ln()) / 3.0;
    close("albedo_average_ggx", &[1.0], average, 1e-10);
}

#[test]
fn values_computed_elsewhere() {
    let text = include_str!("../../brdf/tests/reference/albedo.json");
    let reference: Value = serde_json::from_str(text).expect("JSON");
    let columns = [
        ("albedo_ggx", "E_correlated"),
        ("albedo_ggx_separable", "E_separable"),
        ("albedo_ggx_divided_twice", "E_BUG_double_divide"),
    ];
    for row in reference["rows"].as_array().expect("rows") {
        let args = ["n_dot_v", "alpha"].map(|name| row[name].as_f64().expect("an argument"));
        for (name, column) in columns {
            let digits = row[column].as_str().expect("a number as text");
            close(name, &args, digits.parse().expect("a number"), 1e-9);
        }
    }
}

#[test]
fn outside_it_is_the_nearest_inside() {
    let nearest = |name, args: [f64; 2]| albedo::value(name, &args);
    for (args, inside) in [
        ([-1.0, 0.5], [1e-9, 0.5]),
        ([1.5, -0.5], [1.0, 0.5]),
        ([f64::INFINITY, 0.5], [1.0, 0.5]),
        ([0.5, 0.0], [0.5, 1e-6]),
        ([0.5, f64::INFINITY], [0.5, 1e6]),
    ] {
        let value = nearest("albedo_ggx", args);
        assert!(
            value.is_some_and(|e| (0.0..=1.0 + 1e-12).contains(&e)),
            "{args:?}: {value:?}"
        );
        assert_eq!(value, nearest("albedo_ggx", inside), "{args:?}");
    }
    for (name, args) in [
        ("albedo_ggx", [0.5, f64::NAN]),
        ("albedo_ggx", [f64::NAN, 0.5]),
        ("d_ggx", [0.5, 0.5]),
    ] {
        assert_eq!(nearest(name, args), None, "{name} {args:?}");
    }
}

/// The BRDF times N·L over the lights themselves, on a grid: no half vector is integrated over.
#[test]
fn over_lights_it_is_the_same() {
    let lambda =
        |c: f64, alpha: f64| 0.5 * ((1.0 + alpha * alpha * (1.0 - c * c) / (c * c)).sqrt() - 1.0);
    const STEPS: u32 = 1_000;
    for (mu, alpha) in [(1.0f64, 0.5f64), (0.7, 0.4), (0.3, 0.7), (0.1, 1.0)] {
        let v = [(1.0 - mu * mu).sqrt(), mu];
        let mut sum = 0.0;
        for i in 0..STEPS {
            let theta = FRAC_PI_2 * (f64::from(i) + 0.5) / f64::from(STEPS);
            for j in 0..STEPS {
                let phi = PI * (f64::from(j) + 0.5) / f64::from(STEPS);
                let (sin, z) = (theta.sin(), theta.cos());
                let h = [sin * phi.cos() + v[0], sin * phi.sin(), z + v[1]];
                let n_dot_h2 = h[2] * h[2] / h.map(|x| x * x).iter().sum::<f64>();
                let t = n_dot_h2 * (alpha * alpha - 1.0) + 1.0;
                let d = alpha * alpha / (PI * t * t);
                let g2 = 1.0 / (1.0 + lambda(z, alpha) + lambda(mu, alpha));
                sum += d * g2 / (4.0 * mu) * sin;
            }
        }
        let cell = FRAC_PI_2 * 2.0 * PI / f64::from(STEPS * STEPS);
        close("albedo_ggx", &[mu, alpha], sum * cell, 1e-5);
    }
}

/// `brdf`'s own quadratures, of another integrand by another rule: from the smoothest surface to the
/// roughest, from straight above to the horizon.
#[test]
fn the_core_agrees() {
    let alphas = [1e-4, 1e-3, 0.01, 0.03, 0.06, 0.1, 0.2, 0.4, 0.7, 1.0];
    let views = [
        1e-6, 1e-4, 1e-3, 0.003, 0.01, 0.03, 0.06, 0.099, 0.101, 0.15, 0.3, 0.5, 0.7, 0.9, 1.0,
    ];
    for name in ["albedo_ggx", "albedo_ggx_separable"] {
        let term = brdf::term(name).expect("a term");
        let mut worst = [(0.0, [0.0; 2]); 2];
        let grid = views.iter().flat_map(|&mu| alphas.map(|alpha| [mu, alpha]));
        // Where one rule of theirs takes over from the other.
        let seam = |ratio: f64| alphas.map(|alpha| [f64::min(ratio * alpha, 1.0), alpha]);
        for args in grid.chain(seam(1.41)).chain(seam(4.31)) {
            let single = args.map(|x| x as f32);
            let at_single = albedo::value(name, &single.map(f64::from)).expect("a value");
            let truth = albedo::value(name, &args).expect("a value");
            let errors = [
                (f64::from((term.f32)(&single)) - at_single).abs() / at_single,
                ((term.f64)(&args) - truth).abs() / truth,
            ];
            for (worst, error) in worst.iter_mut().zip(errors) {
                if !(error <= worst.0 || worst.0.is_nan()) {
                    *worst = (error, args);
                }
            }
        }
        println!("{name}: f32 {:?}, f64 {:?}", worst[0], worst[1]);
        assert!(worst[0].0 < 1e-5 && worst[1].0 < 1e-8, "{name}: {worst:?}");
    }
}
