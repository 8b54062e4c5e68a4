//! The lobe from vectors: agreement with the terms, samplers against the albedo. Whether they draw
//! their densities is for `chi_square.rs`.

mod numbers;

use brdf::*;
use numbers::Numbers;
use std::f64::consts::PI;

fn pair(numbers: &mut Numbers) -> [f64; 2] {
    [numbers.unit(), numbers.unit()]
}

fn direction(cos: f64, phi: f64) -> [f64; 3] {
    let sin = ((1.0 - cos) * (1.0 + cos)).sqrt();
    [sin * phi.cos(), sin * phi.sin(), cos]
}

#[track_caller]
fn close(a: f64, b: f64, relative: f64) {
    assert!(
        (a - b).abs() <= relative * (a.abs() + b.abs()),
        "{a} is not {b}"
    );
}

#[test]
fn vectors_and_cosines_agree() {
    let mut numbers = Numbers(1);
    for _ in 0..2000 {
        let (l, v) = (
            direction(numbers.unit(), 6.3 * numbers.unit()),
            direction(numbers.unit(), 1.0),
        );
        let alpha = 0.05 + 0.95 * numbers.unit();
        let h = [l[0] + v[0], l[1] + v[1], l[2] + v[2]];
        let length = (h[0] * h[0] + h[1] * h[1] + h[2] * h[2]).sqrt();
        let ggx = Ggx::new(alpha);
        close(ggx.d(h), d_ggx(h[2] / length, alpha), 1e-11);
        close(
            ggx.d(h),
            d_ggx_aniso(h[0] / length, h[1] / length, h[2] / length, alpha, alpha),
            1e-12,
        );
        close(ggx.visibility(l, v), v_ggx(l[2], v[2], alpha), 1e-12);
        close(ggx.lambda(v), lambda_ggx(v[2], alpha), 1e-10);
        close(ggx.g1(v), g1_ggx(v[2], alpha), 1e-12);
        close(
            ggx.eval(l, v),
            specular_ggx(l[2], v[2], h[2] / length, alpha.sqrt()),
            1e-11,
        );
        close(ggx.eval(l, v), ggx.eval(v, l), 1e-13);
        close(d_ggx_world([0.0, 0.0, 1.0], l, v, alpha), ggx.d(h), 1e-12);
        let (c, rest) = v_dot_h_and_rest(l, v);
        close(c, length / 2.0, 1e-14);
        close(c + rest, 1.0, 1e-14);
        let single = |x: [f64; 3]| glam::Vec3::from_array(x.map(|x| x as f32));
        let (value, truth) = (
            Ggx::new(alpha as f32).eval(single(l), single(v)),
            ggx.eval(l, v),
        );
        close(f64::from(value), truth, 1e-3);
    }
}

#[test]
fn samplers_find_the_albedo() {
    for alpha in [0.1, 0.5, 1.0] {
        for cos in [0.9, 0.3] {
            for sampler in [
                Sampler::Hemisphere,
                Sampler::SphericalCap,
                Sampler::BoundedCap,
            ] {
                let (ggx, v) = (Ggx::new(alpha), direction(cos, 1.0));
                let (mut numbers, count) = (Numbers(3), 40_000);
                let sum: f64 = (0..count)
                    .map(|_| ggx.sample(v, pair(&mut numbers), sampler).weight)
                    .sum();
                let (mean, truth) = (sum / count as f64, albedo_ggx(cos, alpha));
                assert!(
                    (mean - truth).abs() < 0.006,
                    "{alpha} {cos} {sampler:?}: {mean}, not {truth}"
                );
            }
        }
    }
}

#[test]
fn colours_of_a_mirror() {
    let (l, v) = (direction(0.8, 0.0), direction(0.6, 2.0));
    let (c, _) = v_dot_h_and_rest(l, v);
    let gold = ([0.143, 0.375, 1.442], [3.983, 2.386, 1.603]);
    let rgb = Fresnel::Conductor {
        n: gold.0,
        k: gold.1,
    }
    .eval(l, v);
    for ((value, n), k) in rgb.into_iter().zip(gold.0).zip(gold.1) {
        close(value, f_conductor(n, k, c), 1e-15);
    }
    close(
        Fresnel::Schlick { f0: [0.04; 3] }.eval(l, v)[0],
        f_schlick(0.04, c),
        1e-13,
    );
    close(
        Fresnel::Dielectric { eta: 1.5 }.eval(l, v)[1],
        f_dielectric(1.5, c),
        1e-15,
    );
    let lobe = Specular {
        ggx: Ggx::new(0.2),
        fresnel: Fresnel::Perfect,
    };
    close(lobe.eval_cos(l, v)[2], lobe.ggx.eval(l, v) * l[2], 1e-15);
    assert_eq!(f0_from_metallic([0.9, 0.5, 0.1], 0.0), [0.04; 3]);
    assert_eq!(f0_from_metallic([0.9, 0.5, 0.1], 1.0), [0.9, 0.5, 0.1]);
}

#[test]
fn compensation_keeps_all_light() {
    // 2 ∫ (1 − μ ln(1 + 1/μ)) μ dμ = (4 − 4 ln 2)/3 at α = 1.
    close(albedo_average_ggx(1.0), (4.0 - 4.0 * 2f64.ln()) / 3.0, 1e-9);
    for alpha in [0.1, 0.4, 1.0] {
        let average = albedo_average_ggx(alpha);
        let view = albedo_ggx(0.3, alpha);
        // ∫ f_ms μ dω over the lights.
        let steps = 64;
        let mut added = 0.0;
        for i in 0..steps {
            let y = (i as f64 + 0.5) / steps as f64;
            let mu = y * y;
            let f = f_multi_kulla_conty(albedo_ggx(mu, alpha), view, average);
            added += f * mu * 2.0 * PI * 2.0 * y / steps as f64;
        }
        close(view + added, 1.0, 1e-3);
        close(view * compensation_turquin(1.0, view), 1.0, 1e-15);
    }
    let table = AlbedoTable::new(16);
    assert!((table.get(0.5, 0.5) - albedo_ggx(0.5f32, 0.25)).abs() < 2e-3);
}

#[test]
fn rusinkiewicz_and_back() {
    let mut numbers = Numbers(5);
    for _ in 0..500 {
        let (l, v) = (
            direction(numbers.unit(), 6.3 * numbers.unit()),
            direction(numbers.unit(), 6.3 * numbers.unit()),
        );
        let there = Rusinkiewicz::<f64>::new(l, v);
        let (l1, v1) = there.directions();
        close(l1[2], l[2], 1e-9);
        close(v1[2], v[2], 1e-9);
        let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        assert!((dot(l1, v1) - dot(l, v)).abs() < 1e-12);
        assert!((there.theta_d.cos() - v_dot_h_from(l[2], v[2], dot(l, v))).abs() < 1e-12);
        assert!((there.theta_h.cos() - n_dot_h_from(l[2], v[2], dot(l, v))).abs() < 1e-9);
        // cos φ_d = (N·V − N·L)/sqrt((2 − 2 L·V)(1 − (N·H)²)) (Hammon 2017).
        let sines = ((2.0 - 2.0 * dot(l, v)) * there.theta_h.sin().powi(2)).sqrt();
        assert!((there.phi_d.cos() - (v[2] - l[2]) / sines).abs() < 1e-6 / sines);
    }
    close(alpha_filtered(0.3, 0.02), (0.09f64 + 0.04).sqrt(), 1e-15);
    close(alpha_filtered(0.3, 5.0), (0.09f64 + 0.18).sqrt(), 1e-15);
}
