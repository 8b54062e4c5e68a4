//! Random walks against what is known about them.

mod numbers;

use brdf::batch::Isa;
use brdf::glam::Vec3;
use brdf::walk::{Exit, Facets, Walks, walk, walk_mirrors};
use brdf::{Ggx, Sampler, albedo_ggx};
use numbers::Numbers;

const COUNT: usize = 40_000;

fn view(cos: f64) -> [f64; 3] {
    [
        0.6 * (1.0 - cos * cos).sqrt(),
        0.8 * (1.0 - cos * cos).sqrt(),
        cos,
    ]
}

fn walks(alpha: f64, facets: Facets<f64>, cos: f64) -> Vec<Exit<f64>> {
    let mut numbers = Numbers(9);
    let one = |_| walk(Ggx::new(alpha), facets, view(cos), || numbers.unit()).expect("it ends");
    (0..COUNT).map(one).collect()
}

fn mean(values: impl Iterator<Item = f64>) -> f64 {
    values.sum::<f64>() / COUNT as f64
}

#[track_caller]
fn about(value: f64, truth: f64, error: f64) {
    assert!((value - truth).abs() < error, "{value}, not {truth}");
}

#[test]
fn mirrors_lose_nothing_and_start_with_the_albedo() {
    for alpha in [0.2, 0.5, 1.0] {
        for cos in [0.95, 0.5, 0.1] {
            let exits = walks(alpha, Facets::Mirror, cos);
            assert!(
                exits
                    .iter()
                    .all(|exit| exit.weight == 1.0 && exit.diffuse == 0 && exit.bounces > 0)
            );
            assert!(exits.iter().all(|exit| exit.l[2] > 0.0));
            let once = exits.iter().filter(|exit| exit.bounces == 1).count() as f64 / COUNT as f64;
            about(once, albedo_ggx(cos, alpha), 0.01);
        }
    }
}

#[test]
fn diffuse_facets_lose_what_was_measured() {
    // Single bounce of Lambertian facets at α = 1, height-correlated.
    for (degrees, lost) in [(0.0f64, 0.418), (60.0, 0.436), (75.0, 0.419)] {
        let exits = walks(
            1.0,
            Facets::Diffuse { albedo: 1.0 },
            degrees.to_radians().cos(),
        );
        let once = mean(
            exits
                .iter()
                .map(|exit| f64::from(u8::from(exit.bounces == 1))),
        );
        about(1.0 - once, lost, 0.01);
    }
    let exits = walks(
        0.5,
        Facets::Coated {
            f0: 0.04,
            albedo: 0.8,
        },
        0.7,
    );
    let energy = mean(exits.iter().map(|exit| exit.weight));
    assert!(energy > 0.72 && energy < 0.8, "{energy}");
    let specular = mean(
        exits
            .iter()
            .map(|exit| f64::from(u8::from(exit.diffuse == 0))),
    );
    assert!(specular > 0.03 && specular < 0.06, "{specular}");
}

#[test]
fn normals_at_a_hit_are_the_visible_ones() {
    // The mean of m·v over visible normals at α = 0.5.
    for (degrees, truth) in [(0.0f64, 0.826), (45.0, 0.715), (75.0, 0.589), (85.0, 0.562)] {
        let (mut numbers, v) = (Numbers(2), view(degrees.to_radians().cos()));
        let one = |_| {
            let l = Ggx::new(0.5)
                .sample(v, [numbers.unit(), numbers.unit()], Sampler::SphericalCap)
                .l;
            brdf::v_dot_h_and_rest(l, v).0
        };
        about(mean((0..COUNT).map(one)), truth, 0.005);
    }
}

#[test]
fn batches_walk_alike() {
    for isa in Isa::available() {
        for (alpha, cos) in [(0.5f32, 0.9f64), (1.0, 0.3), (0.1, 0.5)] {
            let [mut x, mut y, mut z] = [0; 3].map(|_| vec![0.0; COUNT]);
            let mut bounces = vec![0; COUNT];
            let v = Vec3::from_array(view(cos).map(|x| x as f32));
            walk_mirrors(
                isa,
                v,
                alpha,
                42,
                Walks {
                    l: [&mut x, &mut y, &mut z],
                    bounces: &mut bounces,
                },
            );
            let exits = walks(f64::from(alpha), Facets::Mirror, cos);
            about(
                mean(z.iter().map(|&z| f64::from(z))),
                mean(exits.iter().map(|exit| exit.l[2])),
                0.01,
            );
            about(
                mean(x.iter().map(|&x| f64::from(x))),
                mean(exits.iter().map(|exit| exit.l[0])),
                0.01,
            );
            let average = mean(bounces.iter().map(|&b| f64::from(b)));
            about(
                average,
                mean(exits.iter().map(|exit| f64::from(exit.bounces))),
                0.02,
            );
            let once = bounces.iter().filter(|&&b| b == 1).count() as f64 / COUNT as f64;
            about(once, albedo_ggx(cos, f64::from(alpha)), 0.01);
            for i in 0..COUNT {
                let length = x[i] * x[i] + y[i] * y[i] + z[i] * z[i];
                assert!((length - 1.0).abs() < 1e-4 && z[i] > 0.0, "{i}: {length}");
            }
        }
    }
}

/// No number in, and still an end.
#[test]
fn what_is_no_number_comes_to_an_end() {
    let facets = [
        Facets::Mirror,
        Facets::Diffuse { albedo: 0.5 },
        Facets::Coated {
            f0: f64::NAN,
            albedo: 0.5,
        },
        Facets::Coated {
            f0: 0.04,
            albedo: 0.5,
        },
    ];
    for facets in facets {
        for (alpha, v) in [
            (f64::NAN, [0.6, 0.0, 0.8]),
            (0.5, [f64::NAN, 0.0, 0.8]),
            (0.5, [0.6, 0.0, f64::NAN]),
            (0.5, [0.0; 3]),
        ] {
            let mut hits = 0u32;
            let next = || {
                hits += 1;
                assert!(hits < 1_000_000, "{facets:?} {alpha} {v:?}");
                0.37
            };
            let _ = walk(Ggx::new(alpha), facets, v, next);
        }
    }
}
