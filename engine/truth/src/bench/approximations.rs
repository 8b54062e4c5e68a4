//! Each approximation against what it approximates, and the ways to an albedo.

use super::{Effort, Errors, Numbers, Row, opaque, time};
use brdf::{Ggx, Sampler, Term, albedo_ggx, term};

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
    pairs.chain([albedo(effort)]).collect()
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

/// The albedo by quadrature and by each sampler.
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
