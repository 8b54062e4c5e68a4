//! Each approximation against what it approximates, and the ways to an albedo.

use super::{Effort, Errors, Numbers, Row, opaque, time};
use brdf::walk::{Facets, walk};
use brdf::{AlbedoTable, Ggx, Sampler, Term, albedo_ggx, diffuse_hammon, diffuse_lambert, term};

/// How the arguments of the exact term follow from those of its approximation.
type Convert = fn(&[f64]) -> Vec<f64>;

/// What stands for what: the approximation and the exact term.
const PAIRS: &[(&str, &str, Convert)] = &[
    ("v_ggx_hammon", "v_ggx", <[f64]>::to_vec),
    ("v_ggx_separable", "v_ggx", <[f64]>::to_vec),
    ("g2_ggx_hammon", "g2_ggx", <[f64]>::to_vec),
    ("g1_beckmann_rational", "g1_beckmann", <[f64]>::to_vec),
    ("gsf_schlick_ggx", "g2_ggx_separable", <[f64]>::to_vec),
    ("gsf_schlick_beckmann", "g2_beckmann", |x| {
        vec![x[0], x[1], x[2] * x[2]]
    }),
    ("gsf_smith_beckmann", "g2_beckmann", |x| {
        vec![x[0], x[1], x[2] * x[2]]
    }),
    ("f_spherical_gaussian", "f_schlick", <[f64]>::to_vec),
    ("f_schlick_ior", "f_dielectric", <[f64]>::to_vec),
    (
        "diffuse_oren_nayar",
        "diffuse_oren_nayar_full",
        <[f64]>::to_vec,
    ),
];

pub(super) fn groups(effort: Effort) -> Vec<Vec<Row>> {
    let pairs = PAIRS.iter().filter_map(|&(name, exact, convert)| {
        Some(pair(effort, term(name)?, term(exact)?, convert))
    });
    pairs
        .chain([diffuse(effort), albedo(effort), table(effort)])
        .collect()
}

fn row(group: &str, variant: &str, ns: f64, errors: Errors) -> Row {
    Row {
        group: group.into(),
        variant: variant.into(),
        precision: "f32",
        isa: "baseline",
        ns,
        limit_ratio: None,
        needs: None,
        max_ulp: errors.max,
        p999_ulp: errors.p999,
        median_ulp: errors.median,
        error_unit: "relative",
        pareto: false,
    }
}

fn pair(effort: Effort, term: &Term, exact: &Term, convert: Convert) -> Vec<Row> {
    let mut numbers = Numbers(1);
    let mut draw = || -> Vec<f64> {
        term.params
            .iter()
            .map(|p| f64::from(numbers.between(p.range) as f32))
            .collect()
    };
    let points: Vec<Vec<f64>> = (0..effort.points.max(256)).map(|_| draw()).collect();
    let narrow = |args: &[f64]| args.iter().map(|&x| x as f32).collect::<Vec<f32>>();
    let measure = |f: fn(&[f32]) -> f32, single: &[Vec<f32>]| {
        time(effort, single.len(), || {
            for args in single {
                opaque(f(opaque(args)));
            }
        })
    };
    let error = |f: fn(&[f32]) -> f32, args: &[f64], given: &[f64]| {
        let truth = (exact.f64)(&convert(args));
        let value = f64::from(f(&narrow(given)));
        (value - truth).abs() / truth.abs().max(1e-3)
    };
    let own: Vec<Vec<f32>> = points[..256].iter().map(|args| narrow(args)).collect();
    let converted: Vec<Vec<f32>> = points[..256]
        .iter()
        .map(|args| narrow(&convert(args)))
        .collect();
    let approximate = points
        .iter()
        .map(|args| error(term.f32, args, args))
        .collect();
    let direct = points
        .iter()
        .map(|args| error(exact.f32, args, &convert(args)))
        .collect();
    let group = format!("{} for {}", term.name, exact.name);
    vec![
        row(
            &group,
            term.name,
            measure(term.f32, &own),
            Errors::of(approximate),
        ),
        row(
            &group,
            exact.name,
            measure(exact.f32, &converted),
            Errors::of(direct),
        ),
    ]
}

/// Walks from each point: their mean is good to about half a percent.
const WALKS: u32 = 20_000;

/// Diffuse models against random walks between coated diffuse facets: how much of the light
/// leaves again without being only mirrored, by view and alpha.
fn diffuse(effort: Effort) -> Vec<Row> {
    const ALBEDO: f64 = 0.8;
    const GROUP: &str = "diffuse_hammon for walk";
    let points: Vec<(f64, f64)> = [0.2, 0.5, 0.9]
        .into_iter()
        .flat_map(|mu| [0.1, 0.4, 0.8].map(|alpha| (mu, alpha)))
        .collect();
    let view = |mu: f64| [((1.0 - mu) * (1.0 + mu)).sqrt(), 0.0, mu];
    let facets = Facets::Coated {
        f0: 0.04,
        albedo: ALBEDO,
    };
    let leaves = |&(mu, alpha): &(f64, f64), count: u32, seed: u64| {
        let mut numbers = Numbers(seed);
        // The ends of the interval are no random numbers here.
        let mut next = || numbers.unit().max(1e-12);
        let walks = (0..count).filter_map(|_| walk(Ggx::new(alpha), facets, view(mu), &mut next));
        let diffuse = walks
            .filter(|exit| exit.diffuse > 0)
            .map(|exit| exit.weight);
        diffuse.sum::<f64>() / f64::from(count)
    };
    let truth: Vec<f64> = points.iter().map(|point| leaves(point, WALKS, 1)).collect();
    let errors = |estimate: &dyn Fn(&(f64, f64)) -> f64| {
        let error = |(point, truth): (_, &f64)| (estimate(point) - truth).abs() / truth;
        Errors::of(points.iter().zip(&truth).map(error).collect())
    };
    let model = |name: &str, f: &dyn Fn([f64; 3], f64, f64) -> f64| {
        let (l, calls) = (view(0.6), points.len());
        let ns = time(effort, calls, || {
            for &(mu, alpha) in &points {
                opaque(f(opaque(l), opaque(mu), opaque(alpha)));
            }
        });
        let estimate = |&(mu, alpha): &(f64, f64)| hemisphere(|l| f(l, mu, alpha));
        row(GROUP, name, ns, errors(&estimate))
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
    });
    let mut rows = vec![
        model("diffuse_lambert", &|_, _, _| diffuse_lambert(ALBEDO)),
        model("diffuse_hammon", &hammon),
        row(
            GROUP,
            "20,000 walks",
            one / 16.0 * f64::from(WALKS),
            errors(&|point| leaves(point, WALKS, 2)),
        ),
    ];
    for row in &mut rows {
        row.precision = "f64";
    }
    rows
}

/// ∫ f cos over the hemisphere, by midpoints in the squared cosine and the azimuth.
fn hemisphere(f: impl Fn([f64; 3]) -> f64) -> f64 {
    const COUNT: u32 = 48;
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

/// What a table costs to make, which is paid once.
fn table(effort: Effort) -> Vec<Row> {
    let once = Effort {
        time: effort.time / 10,
        ..effort
    };
    let ns = time(once, 1, || {
        opaque(AlbedoTable::new(opaque(64)));
    });
    let mut row = row("albedo_table", "64 x 64, made", ns, Errors::default());
    row.error_unit = "none";
    vec![row]
}

/// The albedo by quadrature, from a table, and by each sampler.
fn albedo(effort: Effort) -> Vec<Row> {
    let points: Vec<(f64, f64)> = [0.1, 0.3, 0.6, 0.95]
        .into_iter()
        .flat_map(|mu| [0.05, 0.2, 0.5, 1.0].map(|alpha| (mu, alpha)))
        .collect();
    let truth: Vec<f64> = points
        .iter()
        .map(|&(mu, alpha)| albedo_ggx(mu, alpha))
        .collect();
    let errors = |values: Vec<f64>| {
        Errors::of(
            values
                .iter()
                .zip(&truth)
                .map(|(value, truth)| (value - truth).abs() / truth)
                .collect(),
        )
    };
    let quadrature = || {
        points
            .iter()
            .map(|&(mu, alpha)| f64::from(albedo_ggx(mu as f32, alpha as f32)))
    };
    let ns = time(effort, points.len(), || {
        opaque(quadrature().sum::<f64>());
    });
    let mut rows = vec![row(
        "albedo",
        "quadrature",
        ns,
        errors(quadrature().collect()),
    )];
    let table = AlbedoTable::new(64);
    let look = |&(mu, alpha): &(f64, f64)| {
        f64::from(table.get(opaque(mu as f32), opaque(alpha.sqrt() as f32)))
    };
    let ns = time(effort, points.len(), || {
        opaque(points.iter().map(look).sum::<f64>());
    });
    rows.push(row(
        "albedo",
        "table 64 x 64",
        ns,
        errors(points.iter().map(look).collect()),
    ));
    let samplers = [
        ("hemisphere", Sampler::Hemisphere),
        ("spherical cap", Sampler::SphericalCap),
        ("bounded cap", Sampler::BoundedCap),
        ("cosine", Sampler::Cosine),
    ];
    for (name, sampler) in samplers {
        for count in [64u32, 1024] {
            let estimate = |&(mu, alpha): &(f64, f64)| {
                let (ggx, mu) = (Ggx::new(alpha as f32), mu as f32);
                let v = [((1.0 - mu) * (1.0 + mu)).sqrt(), 0.0, mu];
                let mut numbers = Numbers(1);
                let mut draw = || {
                    ggx.sample(v, [0; 2].map(|_| numbers.unit() as f32), sampler)
                        .weight
                };
                f64::from((0..count).map(|_| draw()).sum::<f32>()) / f64::from(count)
            };
            let ns = time(effort, points.len(), || {
                opaque(points.iter().map(estimate).sum::<f64>());
            });
            let variant = format!("{name}, {count} samples");
            rows.push(row(
                "albedo",
                &variant,
                ns,
                errors(points.iter().map(estimate).collect()),
            ));
        }
    }
    rows
}
