//! Each approximation against what it approximates, and what that costs.

use super::{Effort, Numbers, Row, opaque, time};
use crate::stress::{Precision, possible};
use brdf::walk::Split;
use brdf::{Ggx, Term, diffuse_hammon, diffuse_lambert, f_conductor, f_schlick, term};

/// An approximation, what it stands for, and arguments for both.
struct Pair {
    approximation: &'static str,
    exact: &'static str,
    draw: fn(&Term, &mut Numbers) -> [Vec<f64>; 2],
}

/// Where both take the same arguments.
const fn same(approximation: &'static str, exact: &'static str) -> Pair {
    Pair {
        approximation,
        exact,
        draw: |term, numbers| {
            let args = drawn(term, numbers);
            [args.clone(), args]
        },
    }
}

/// Where the last argument of the approximation is a roughness and that of the exact α.
const fn squared(approximation: &'static str, exact: &'static str) -> Pair {
    Pair {
        approximation,
        exact,
        draw: |term, numbers| {
            let args = drawn(term, numbers);
            let mut alpha = args.clone();
            if let Some(last) = alpha.last_mut() {
                *last *= *last;
            }
            [args, alpha]
        },
    }
}

/// A dielectric's index for its reflectance at normal incidence.
fn eta(f0: f64) -> f64 {
    (1.0 + f0.sqrt()) / (1.0 - f0.sqrt())
}

/// n and k of gold, silver, copper and aluminium for red, green and blue, and of chromium.
const METALS: &[(f64, f64)] = &[
    (0.143, 3.983),
    (0.375, 2.386),
    (1.442, 1.603),
    (0.155, 4.828),
    (0.117, 3.122),
    (0.138, 2.147),
    (0.200, 3.912),
    (0.924, 2.452),
    (1.102, 2.142),
    (1.657, 9.224),
    (0.880, 6.270),
    (0.521, 4.837),
    (3.180, 3.310),
];

/// A metal's n and k and a cosine.
fn metal(numbers: &mut Numbers) -> (f64, f64, f64) {
    let (n, k) = METALS[(numbers.unit() * METALS.len() as f64) as usize % METALS.len()];
    (n, k, numbers.between((0.01, 1.0)))
}

/// Lazányi's a so that the exact reflectance is met at cos θ = 1/7, where a u (1 − u)⁶ is largest.
fn depth(n: f64, k: f64) -> f64 {
    let (u, f0) = (1.0 / 7.0, f_conductor(n, k, 1.0));
    (f_schlick(f0, u) - f_conductor(n, k, u)) / (u * (1.0f64 - u).powi(6))
}

const PAIRS: &[Pair] = &[
    same("v_ggx_hammon", "v_ggx"),
    same("v_ggx_separable", "v_ggx"),
    same("g2_ggx_hammon", "g2_ggx"),
    same("g2_ggx_separable", "g2_ggx"),
    same("g1_beckmann_rational", "g1_beckmann"),
    same("gsf_schlick_ggx", "g2_ggx_separable"),
    squared("gsf_schlick_beckmann", "g2_beckmann"),
    squared("gsf_smith_beckmann", "g2_beckmann"),
    same("f_spherical_gaussian", "f_schlick"),
    Pair {
        approximation: "f_schlick_ior",
        exact: "f_dielectric",
        draw: |_, numbers| {
            // Water to diamond.
            let args = vec![numbers.between((1.33, 2.42)), numbers.between((0.01, 1.0))];
            [args.clone(), args]
        },
    },
    Pair {
        approximation: "f_schlick",
        exact: "f_dielectric",
        draw: |_, numbers| {
            // The same.
            let (f0, c) = (numbers.between((0.02, 0.17)), numbers.between((0.01, 1.0)));
            [vec![f0, c], vec![eta(f0), c]]
        },
    },
    Pair {
        approximation: "f_spherical_gaussian",
        exact: "f_dielectric",
        draw: |_, numbers| {
            let (f0, c) = (numbers.between((0.02, 0.17)), numbers.between((0.01, 1.0)));
            [vec![f0, c], vec![eta(f0), c]]
        },
    },
    Pair {
        approximation: "f_schlick",
        exact: "f_conductor",
        draw: |_, numbers| {
            let (n, k, c) = metal(numbers);
            [vec![f_conductor(n, k, 1.0), c], vec![n, k, c]]
        },
    },
    Pair {
        approximation: "f_lazanyi",
        exact: "f_conductor",
        draw: |_, numbers| {
            let (n, k, c) = metal(numbers);
            [vec![f_conductor(n, k, 1.0), depth(n, k), c], vec![n, k, c]]
        },
    },
    same("diffuse_oren_nayar", "diffuse_oren_nayar_full"),
    Pair {
        approximation: "diffuse_eon",
        exact: "diffuse_oren_nayar_full",
        draw: |term, numbers| {
            // The roughness of EON is that standard deviation of the facets' angle.
            let args = drawn(term, numbers);
            let [l, v, l_dot_v, roughness, albedo] = args[..] else {
                return [args.clone(), args];
            };
            let sines = ((1.0 - l) * (1.0 + l) * (1.0 - v) * (1.0 + v)).sqrt();
            let cos_phi = ((l_dot_v - l * v) / sines).clamp(-1.0, 1.0);
            [args, vec![l, v, cos_phi, roughness, albedo]]
        },
    },
];

pub(super) fn groups(effort: Effort) -> Vec<Vec<Row>> {
    let mut groups: Vec<Vec<Row>> = Vec::new();
    for pair in PAIRS {
        let Some((approximate, exact)) = term(pair.approximation).zip(term(pair.exact)) else {
            continue;
        };
        let rows = rows(effort, pair, approximate, exact);
        // What several approximations stand for is measured with each, in one group.
        match groups
            .iter_mut()
            .find(|group| group[0].group == pair.exact_group())
        {
            Some(group) => group.extend(rows.into_iter().take(1)),
            None => groups.push(rows),
        }
    }
    groups.push(diffuse(effort));
    groups
}

impl Pair {
    fn exact_group(&self) -> String {
        format!("{} approximated", self.exact)
    }
}

/// Possible arguments in the sensible ranges.
fn drawn(term: &Term, numbers: &mut Numbers) -> Vec<f64> {
    loop {
        let argument = |p: &brdf::Param| f64::from(numbers.between(p.range) as f32);
        let args: Vec<f64> = term.params.iter().map(argument).collect();
        if possible(term.params, Precision::Single, &args) {
            return args;
        }
    }
}

/// The approximation and, in single precision, what it stands for.
fn rows(effort: Effort, pair: &Pair, term: &Term, exact: &Term) -> Vec<Row> {
    const CALLS: usize = 256;
    const POINTS: usize = 4096;
    let mut numbers = Numbers(1);
    let points: Vec<[Vec<f64>; 2]> = (0..effort.points.max(POINTS))
        .map(|_| (pair.draw)(term, &mut numbers))
        .collect();
    let narrow = |args: &[f64]| args.iter().map(|&x| x as f32).collect::<Vec<f32>>();
    let row = |of: &Term, which: usize| {
        let single: Vec<Vec<f32>> = points[..CALLS]
            .iter()
            .map(|args| narrow(&args[which]))
            .collect();
        let ns = time(effort, CALLS, || {
            for args in &single {
                opaque((of.f32)(opaque(args)));
            }
        });
        let error = |args: &[Vec<f64>; 2]| {
            let truth = (exact.f64)(&args[1]);
            // The full Oren-Nayar crosses 0.
            let value = f64::from((of.f32)(&narrow(&args[which])));
            (value - truth).abs() / truth.abs().max(1e-3)
        };
        let errors = points.iter().map(error).collect();
        Row::new(pair.exact_group(), of.name, ns).with_errors("relative", errors)
    };
    vec![row(term, 0), row(exact, 1)]
}

/// Diffuse models against random walks between coated facets (Hammon's simulation): how much
/// of the light leaves again without being only mirrored, by view and alpha.
fn diffuse(effort: Effort) -> Vec<Row> {
    const GROUP: &str = "walk approximated";
    const ALBEDO: f64 = 0.8;
    const F0: f64 = 0.02;
    const WALKS: u32 = 20_000;
    let points: Vec<(f64, f64)> = [0.2, 0.5, 0.9]
        .into_iter()
        .flat_map(|mu| [0.1, 0.4, 0.8].map(|alpha| (mu, alpha)))
        .collect();
    let view = |mu: f64| [((1.0 - mu) * (1.0 + mu)).sqrt(), 0.0, mu];
    let leaves = |&(mu, alpha): &(f64, f64), walks: u32, seed: u64| {
        let mut numbers = Numbers(seed);
        // The ends of the interval are no random numbers here.
        let next = || numbers.unit().max(1e-12);
        Split::new(Ggx::new(alpha), F0, view(mu), walks, next).diffuse(ALBEDO)
    };
    let truth: Vec<f64> = points
        .iter()
        .map(|point| leaves(point, 2 * WALKS, 1))
        .collect();
    let errors = |estimate: &dyn Fn(&(f64, f64)) -> f64| -> Vec<f64> {
        let error = |(point, truth): (_, &f64)| (estimate(point) - truth).abs() / truth;
        points.iter().zip(&truth).map(error).collect()
    };
    let model = |name: &str, f: &dyn Fn([f64; 3], f64, f64) -> f64| {
        let (l, calls) = (view(0.6), points.len());
        let ns = time(effort, calls, || {
            for &(mu, alpha) in &points {
                opaque(f(opaque(l), opaque(mu), opaque(alpha)));
            }
        });
        let estimate = |&(mu, alpha): &(f64, f64)| hemisphere(|l| f(l, mu, alpha));
        Row::new(GROUP, name, ns).with_errors("relative", errors(&estimate))
    };
    let hammon = |l: [f64; 3], mu: f64, alpha: f64| {
        let v = view(mu);
        let l_dot_v = l[0] * v[0] + l[2] * v[2];
        diffuse_hammon(l[2], mu, l_dot_v, alpha, ALBEDO)
    };
    let one = time(effort, points.len(), || {
        for point in &points {
            opaque(leaves(opaque(point), 16, 3));
        }
    }) / 16.0;
    let mut rows = vec![
        model("diffuse_lambert", &|_, _, _| diffuse_lambert(ALBEDO)),
        model("diffuse_hammon", &hammon),
    ];
    for walks in [100, 1_000, 10_000] {
        let estimate = |point: &_| leaves(point, walks, 2);
        rows.push(
            Row::new(GROUP, format!("{walks} walks"), one * f64::from(walks))
                .with_errors("relative", errors(&estimate)),
        );
    }
    rows.into_iter()
        .map(|row| row.in_precision("f64"))
        .collect()
}

/// ∫ f cos over the hemisphere, by midpoints in the squared cosine and the azimuth.
pub(super) fn hemisphere(f: impl Fn([f64; 3]) -> f64) -> f64 {
    const COUNT: u32 = 160;
    let mut sum = 0.0;
    for i in 0..COUNT {
        let z2 = (f64::from(i) + 0.5) / f64::from(COUNT);
        for j in 0..COUNT {
            let phi = std::f64::consts::TAU * (f64::from(j) + 0.5) / f64::from(COUNT);
            let sine = (1.0 - z2).sqrt();
            sum += f([sine * phi.cos(), sine * phi.sin(), z2.sqrt()]);
        }
    }
    sum * std::f64::consts::PI / f64::from(COUNT * COUNT)
}
