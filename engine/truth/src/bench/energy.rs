//! Whether light is lost, made or changed on the way back: furnaces, reciprocity, and how fast
//! random walks come close to what is known about them.

use super::approximations::hemisphere;
use super::{Effort, Numbers, Row, opaque, time};
use crate::albedo::correlated;
use brdf::batch::Isa;
use brdf::glam::Vec3;
use brdf::walk::{Facets, Walks, walk, walk_mirrors};
use brdf::{
    Fresnel, Ggx, Real, Specular, Term, albedo_average_ggx, albedo_ggx, compensation_turquin,
    f_multi_kulla_conty, integral_g1_d_ggx, term,
};

pub(super) fn groups(effort: Effort) -> Vec<Vec<Row>> {
    vec![
        weak_furnace(effort),
        furnace(effort),
        diffuse_furnace(effort),
        reciprocity(effort),
    ]
    .into_iter()
    .chain(walks(effort))
    .collect()
}

const VIEWS: [f64; 4] = [0.1, 0.3, 0.6, 0.95];
const ALPHAS: [f64; 3] = [0.1, 0.4, 1.0];

fn points() -> Vec<(f64, f64)> {
    VIEWS
        .into_iter()
        .flat_map(|mu| ALPHAS.map(|alpha| (mu, alpha)))
        .collect()
}

/// A row whose values should all be 1.
fn unity(
    effort: Effort,
    group: &str,
    variant: &str,
    points: &[(f64, f64)],
    value: impl Fn(f64, f64) -> f64,
) -> Row {
    let ns = time(effort, points.len(), || {
        for &(mu, alpha) in points {
            opaque(value(opaque(mu), opaque(alpha)));
        }
    });
    let errors = points
        .iter()
        .map(|&(mu, alpha)| (value(mu, alpha) - 1.0).abs())
        .collect();
    Row::new(group, variant, ns).with_errors("relative", errors)
}

/// ∫ D G₁ (v·m) dm = N·V.
fn weak_furnace(effort: Effort) -> Vec<Row> {
    const GROUP: &str = "weak_furnace";
    let points = points();
    vec![
        unity(effort, GROUP, "integral_g1_d_ggx", &points, |mu, alpha| {
            integral_g1_d_ggx(mu, alpha)
        })
        .in_precision("f64"),
        unity(effort, GROUP, "integral_g1_d_ggx", &points, |mu, alpha| {
            f64::from(integral_g1_d_ggx(mu as f32, alpha as f32))
        }),
    ]
}

/// What a white metal returns of what it receives from all around: 1, or energy is lost.
fn furnace(effort: Effort) -> Vec<Row> {
    const GROUP: &str = "furnace";
    let points = points();
    // The average of a view's whole albedo needs E of every light: nodes in the cosine.
    fn kulla_conty<R: Real>(mu: R, alpha: R, average: R) -> R {
        const PANELS: u32 = 12;
        let e = albedo_ggx(mu, alpha);
        let mut multi = R::of(0.0);
        // Gauss-Legendre of three nodes a panel in y, μ = y³: grazing lights are where E bends.
        let nodes = [
            (0.5 - 0.15f64.sqrt(), 5.0),
            (0.5, 8.0),
            (0.5 + 0.15f64.sqrt(), 5.0),
        ];
        for panel in 0..PANELS {
            for (at, weight) in nodes {
                let y = (f64::from(panel) + at) / f64::from(PANELS);
                let weight = 6.0 * std::f64::consts::PI * y.powi(5) * weight / 18.0;
                let light = albedo_ggx(R::of(y * y * y), alpha);
                let lobe = f_multi_kulla_conty(light, e, average);
                multi = multi + R::of(weight / f64::from(PANELS)) * lobe;
            }
        }
        e + multi
    }
    let averages = ALPHAS.map(|alpha| (alpha, albedo_average_ggx(alpha)));
    let average = |alpha: f64| {
        let found = averages.iter().find(|(of, _)| *of == alpha);
        found.map_or(f64::NAN, |(_, average)| *average)
    };
    vec![
        unity(effort, GROUP, "single scattering", &points, |mu, alpha| {
            f64::from(albedo_ggx(mu as f32, alpha as f32))
        }),
        unity(
            effort,
            GROUP,
            "compensation_turquin",
            &points,
            |mu, alpha| {
                let e = albedo_ggx(mu as f32, alpha as f32);
                f64::from(e * compensation_turquin(1.0, e))
            },
        ),
        unity(
            effort,
            GROUP,
            "f_multi_kulla_conty",
            &points,
            |mu, alpha| {
                let average = average(alpha) as f32;
                f64::from(kulla_conty(mu as f32, alpha as f32, average))
            },
        ),
    ]
}

/// The same of the diffuse models with a white base.
fn diffuse_furnace(effort: Effort) -> Vec<Row> {
    const ROUGHNESS: f64 = 0.7;
    let models = brdf::terms()
        .iter()
        .filter(|term| term.name.starts_with("diffuse_"));
    let row = |term: &'static Term| {
        let view = |mu: f64| [((1.0 - mu) * (1.0 + mu)).sqrt(), 0.0, mu];
        let error = |mu: f64| {
            let back = hemisphere(|l| (term.f64)(&arguments(term, l, view(mu), ROUGHNESS)));
            (back - 1.0).abs()
        };
        // The time is that of one value, not of the integral.
        let args = arguments(term, [0.48, 0.64, 0.6], [0.6, 0.0, 0.8], ROUGHNESS);
        let ns = time(effort, 1, || {
            opaque((term.f64)(opaque(&args)));
        });
        Row::new("furnace_diffuse", term.name, ns)
            .in_precision("f64")
            .with_errors("relative", VIEWS.map(error).into())
    };
    models.map(row).collect()
}

/// The arguments of a term for a light, a view and a roughness; everything else is 1.
fn arguments(term: &Term, l: [f64; 3], v: [f64; 3], roughness: f64) -> Vec<f64> {
    let l_dot_v = l[0] * v[0] + l[1] * v[1] + l[2] * v[2];
    let across = |a: [f64; 3]| a[0].hypot(a[1]);
    let argument = |name: &str| match name {
        "n_dot_l" => l[2],
        "n_dot_v" => v[2],
        "l_dot_v" => l_dot_v,
        "v_dot_h" => (0.5 + 0.5 * l_dot_v).sqrt(),
        "n_dot_h" => (l[2] + v[2]) / (2.0 + 2.0 * l_dot_v).sqrt(),
        "cos_phi" => {
            ((l[0] * v[0] + l[1] * v[1]) / (across(l) * across(v)).max(1e-12)).clamp(-1.0, 1.0)
        }
        "alpha" => roughness * roughness,
        "roughness" | "sigma" => roughness,
        _ => 1.0,
    };
    term.params
        .iter()
        .map(|param| argument(param.name))
        .collect()
}

/// f(l, v) = f(v, l), or not: the largest difference over the larger of the two.
fn reciprocity(effort: Effort) -> Vec<Row> {
    const GROUP: &str = "reciprocity";
    let mut numbers = Numbers(11);
    let mut direction = || {
        let (z, phi) = (
            numbers.between((0.05, 1.0)),
            numbers.between((0.0, std::f64::consts::TAU)),
        );
        let sin = ((1.0 - z) * (1.0 + z)).sqrt();
        [sin * phi.cos(), sin * phi.sin(), z]
    };
    let pairs: Vec<[[f64; 3]; 2]> = (0..effort.points)
        .map(|_| [direction(), direction()])
        .collect();
    let difference = |there: f64, back: f64| {
        (there - back).abs() / there.abs().max(back.abs()).max(f64::MIN_POSITIVE)
    };
    let names = [
        "specular_ggx",
        "diffuse_disney",
        "diffuse_oren_nayar",
        "diffuse_oren_nayar_full",
        "diffuse_hammon",
        "diffuse_eon",
        "gsf_cook_torrance",
        "gsf_kelemen",
        "gsf_walter",
        "gsf_modified_kelemen",
    ];
    let mut rows: Vec<Row> = names
        .into_iter()
        .filter_map(term)
        .map(|term| {
            let value = |l, v| {
                let args: Vec<f32> = arguments(term, l, v, 0.5)
                    .iter()
                    .map(|&x| x as f32)
                    .collect();
                f64::from((term.f32)(&args))
            };
            let args: Vec<f32> = arguments(term, pairs[0][0], pairs[0][1], 0.5)
                .iter()
                .map(|&x| x as f32)
                .collect();
            let ns = time(effort, 1, || {
                opaque((term.f32)(opaque(&args)));
            });
            let errors = pairs
                .iter()
                .map(|&[l, v]| difference(value(l, v), value(v, l)))
                .collect();
            Row::new(GROUP, term.name, ns).with_errors("relative", errors)
        })
        .collect();
    let lobe = Specular {
        ggx: Ggx::new(0.25f32),
        fresnel: Fresnel::Schlick { f0: [0.04; 3] },
    };
    let value = |l: [f64; 3], v: [f64; 3]| {
        let (l, v) = (l.map(|x| x as f32), v.map(|x| x as f32));
        f64::from(lobe.eval_cos(l, v)[0]) / f64::from(l[2])
    };
    let [l, v] = pairs[0];
    let ns = time(effort, 1, || {
        opaque(value(opaque(l), opaque(v)));
    });
    let errors = pairs
        .iter()
        .map(|&[l, v]| difference(value(l, v), value(v, l)))
        .collect();
    rows.push(Row::new(GROUP, "specular, from vectors", ns).with_errors("relative", errors));
    rows
}

/// The share of walks between mirrors that leave after one bounce is the albedo of single
/// scattering: its error falls with the square root of their number. And all of them leave.
fn walks(effort: Effort) -> [Vec<Row>; 2] {
    const GROUP: &str = "walk_albedo";
    let points = points();
    let view = |mu: f64| [((1.0 - mu) * (1.0 + mu)).sqrt(), 0.0, mu];
    let error = |share: f64, (mu, alpha): (f64, f64)| {
        let truth = correlated(mu, alpha, |_| 1.0);
        (share - truth).abs() / truth
    };
    let mut rows = Vec::new();
    for count in [100usize, 1_000, 10_000, 100_000] {
        let [mut x, mut y, mut z] = [0; 3].map(|_| vec![0.0; count]);
        let mut bounces = vec![0; count];
        let isa = Isa::best();
        let mut once = |(mu, alpha): (f64, f64), seed: u64| {
            let out = Walks {
                l: [&mut x, &mut y, &mut z],
                bounces: &mut bounces,
            };
            let v = Vec3::from_array(view(mu).map(|x| x as f32));
            walk_mirrors(isa, v, alpha as f32, seed, out);
            bounces.iter().filter(|&&bounces| bounces == 1).count() as f64 / count as f64
        };
        let ns = time(effort, 1, || {
            opaque(once(opaque((0.6, 0.5)), 1));
        });
        // Four runs of each point, so that the worst is less a matter of luck.
        let runs = (0..4).flat_map(|run| points.iter().zip(100 * run..));
        let errors = runs
            .map(|(&point, seed)| error(once(point, seed), point))
            .collect();
        let row = Row::new(GROUP, format!("{count} walks"), ns).on(isa.name());
        rows.push(row.with_errors("relative", errors));
    }
    // One at a time, in double precision, and whether all of the light comes back.
    const COUNT: u32 = 1_000;
    let walked = |(mu, alpha): (f64, f64), seed: u64| {
        let mut numbers = Numbers(seed);
        let mut next = || numbers.unit().max(1e-12);
        let ggx = Ggx::new(alpha);
        let exits = (0..COUNT).filter_map(|_| walk(ggx, Facets::Mirror, view(mu), &mut next));
        let (mut once, mut energy) = (0.0, 0.0);
        for exit in exits {
            once += f64::from(u8::from(exit.bounces == 1)) / f64::from(COUNT);
            energy += exit.weight / f64::from(COUNT);
        }
        (once, energy)
    };
    let ns = time(effort, 1, || {
        opaque(walked(opaque((0.6, 0.5)), 1));
    });
    let [once, energy] = [0, 1].map(|which| {
        let error = |(&point, seed): (&(f64, f64), u64)| match (which, walked(point, seed)) {
            (0, (once, _)) => error(once, point),
            (_, (_, energy)) => (energy - 1.0).abs(),
        };
        points.iter().zip(1..).map(error).collect::<Vec<f64>>()
    });
    rows.push(
        Row::new(GROUP, format!("{COUNT} walks, each"), ns)
            .in_precision("f64")
            .with_errors("relative", once),
    );
    let energy = Row::new("walk_energy", "walk", ns)
        .in_precision("f64")
        .with_errors("relative", energy);
    [rows, vec![energy]]
}
