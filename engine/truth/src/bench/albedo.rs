//! The ways to a directional albedo: quadrature, a table, published fits, and each sampler.

use super::{Effort, Numbers, Row, opaque, time};
use crate::albedo::correlated;
use brdf::{
    AlbedoTable, Ggx, Sampler, albedo_ggx, albedo_ggx_karis, albedo_ggx_materialx, f_schlick,
    v_dot_h_and_rest,
};

pub(super) fn groups(effort: Effort) -> Vec<Vec<Row>> {
    vec![
        metal(effort),
        dielectric(effort),
        anchor(effort),
        table(effort),
    ]
}

/// N·V and α.
type Point = (f64, f64);

fn points() -> Vec<Point> {
    [0.05, 0.1, 0.3, 0.6, 0.95]
        .into_iter()
        .flat_map(|mu| [0.05, 0.2, 0.5, 1.0].map(|alpha| (mu, alpha)))
        .collect()
}

/// One way to values at all points.
struct Way<'a> {
    group: &'static str,
    effort: Effort,
    points: &'a [Point],
    truth: &'a [f64],
}

impl Way<'_> {
    fn row(&self, variant: impl Into<String>, value: impl Fn(&Point) -> f64) -> Row {
        let ns = time(self.effort, self.points.len(), || {
            for point in self.points {
                opaque(value(opaque(point)));
            }
        });
        let error = |(point, truth): (&Point, &f64)| (value(point) - truth).abs() / truth;
        let errors = self.points.iter().zip(self.truth).map(error).collect();
        Row::new(self.group, variant, ns).with_errors("relative", errors)
    }
}

fn view(mu: f64) -> [f64; 3] {
    [((1.0 - mu) * (1.0 + mu)).sqrt(), 0.0, mu]
}

/// F = 1.
fn metal(effort: Effort) -> Vec<Row> {
    let points = points();
    let truth: Vec<f64> = points
        .iter()
        .map(|&(mu, alpha)| correlated(mu, alpha, |_| 1.0))
        .collect();
    let way = Way {
        group: "albedo",
        effort,
        points: &points,
        truth: &truth,
    };
    let table = AlbedoTable::new(64);
    let single = |x: f64| x as f32;
    let mut rows = vec![
        way.row("quadrature", |&(mu, alpha)| albedo_ggx(mu, alpha))
            .in_precision("f64"),
        way.row("quadrature", |&(mu, alpha)| {
            f64::from(albedo_ggx(single(mu), single(alpha)))
        }),
        way.row("table 64 x 64", |&(mu, alpha)| {
            f64::from(table.get(single(mu), single(alpha).sqrt()))
        }),
        way.row("fit, MaterialX", |&(mu, alpha)| {
            f64::from(albedo_ggx_materialx(1.0, single(mu), single(alpha)))
        }),
        way.row("fit, Karis", |&(mu, alpha)| {
            f64::from(albedo_ggx_karis(1.0, single(mu), single(alpha).sqrt()))
        }),
    ];
    let samplers = [
        ("hemisphere", Sampler::Hemisphere),
        ("spherical cap", Sampler::SphericalCap),
        ("bounded cap", Sampler::BoundedCap),
        ("cosine", Sampler::Cosine),
    ];
    for (name, sampler) in samplers {
        for count in [16u32, 256, 4096] {
            let estimate = |&(mu, alpha): &Point| {
                let (ggx, v) = (Ggx::new(single(alpha)), view(mu).map(single));
                let mut numbers = Numbers((1e6 * mu + 1e3 * alpha) as u64);
                let mut draw = || {
                    let u = [0; 2].map(|_| single(numbers.unit()));
                    ggx.sample(v, u, sampler).weight
                };
                f64::from((0..count).map(|_| draw()).sum::<f32>()) / f64::from(count)
            };
            rows.push(way.row(format!("{name}, {count} samples"), estimate));
        }
    }
    rows
}

/// Schlick's Fresnel of glass: what the fits were made for.
fn dielectric(effort: Effort) -> Vec<Row> {
    const F0: f64 = 0.04;
    let points = points();
    // Visible normals at the midpoints of a grid.
    let by_grid = |&(mu, alpha): &Point, side: u32| {
        let (ggx, v) = (Ggx::new(alpha), view(mu));
        let mut sum = 0.0;
        for i in 0..side {
            for j in 0..side {
                let u = [i, j].map(|i| (f64::from(i) + 0.5) / f64::from(side));
                let sample = ggx.sample(v, u, Sampler::BoundedCap);
                if sample.weight > 0.0 {
                    sum += sample.weight * f_schlick(F0, v_dot_h_and_rest(sample.l, v).0);
                }
            }
        }
        sum / f64::from(side * side)
    };
    let schlick = |v_dot_h: f64| F0 + (1.0 - F0) * (1.0 - v_dot_h).powi(5);
    let truth: Vec<f64> = points
        .iter()
        .map(|&(mu, alpha)| correlated(mu, alpha, schlick))
        .collect();
    let way = Way {
        group: "albedo_schlick",
        effort,
        points: &points,
        truth: &truth,
    };
    vec![
        way.row("bounded cap, 16 x 16", |point| by_grid(point, 16))
            .in_precision("f64"),
        way.row("fit, MaterialX", |&(mu, alpha)| {
            f64::from(albedo_ggx_materialx(F0 as f32, mu as f32, alpha as f32))
        }),
        way.row("fit, Karis", |&(mu, alpha)| {
            let roughness = (alpha as f32).sqrt();
            f64::from(albedo_ggx_karis(F0 as f32, mu as f32, roughness))
        }),
    ]
}

/// The quadrature where its result is known: E(μ) = 1 − μ ln(1 + 1/μ) at α = 1.
fn anchor(effort: Effort) -> Vec<Row> {
    let points: Vec<Point> = (1..=40).map(|i| (f64::from(i) / 40.0, 1.0)).collect();
    let truth: Vec<f64> = points
        .iter()
        .map(|&(mu, _)| 1.0 - mu * (1.0 / mu).ln_1p())
        .collect();
    let way = Way {
        group: "albedo_at_alpha_1",
        effort,
        points: &points,
        truth: &truth,
    };
    vec![
        way.row("quadrature", |&(mu, alpha)| albedo_ggx(mu, alpha))
            .in_precision("f64"),
        way.row("quadrature", |&(mu, alpha)| {
            f64::from(albedo_ggx(mu as f32, alpha as f32))
        }),
    ]
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
    vec![Row::new("albedo_table", "64 x 64, made", ns)]
}
