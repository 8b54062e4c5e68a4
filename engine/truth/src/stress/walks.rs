//! What no formula gives: random walks, of which only what must hold is known, and a table of
//! albedos.

use super::draw::Numbers;
use super::subject::{Against, Single, Subject, sampler_params};
use brdf::batch::Isa;
use brdf::glam::Vec3;
use brdf::walk::{Exit, Facets, Walks, walk, walk_mirrors};
use brdf::{AlbedoTable, Ggx, Param, Real, term};
use std::sync::LazyLock;

/// Entries a side.
const SIZE: usize = 64;

static TABLE: LazyLock<AlbedoTable> = LazyLock::new(|| AlbedoTable::new(SIZE));

pub(super) fn subjects() -> Vec<Subject> {
    let [x, y, z, alpha, u, _] = sampler_params()[..] else {
        return Vec::new();
    };
    let share = |name| Param { name, ..u };
    let one = vec![x, y, z, alpha, share("f0"), share("albedo"), u];
    let many = vec![x, y, z, alpha, u];
    let params = |name| term(name).map_or(Vec::new(), |term| term.params.to_vec());
    let [mut table, roughness] = [params("albedo_ggx"), params("specular_ggx")];
    table.truncate(1);
    table.extend(roughness.last());

    let nothing = |_: &[f64]| 0.0;
    let walks = [
        (
            "walk",
            one,
            Single::Exact(|args| off_one(args, unit_single)),
            (|args| off_one(args, unit_double)) as fn(&[f64]) -> f64,
            Against::Form,
        ),
        (
            "batch_walk",
            many.clone(),
            Single::Exact(|args| off_many(Isa::best(), args)),
            nothing,
            Against::Batch("batch_walk"),
        ),
        (
            "batch_walk_baseline",
            many,
            Single::Exact(|args| off_many(Isa::BASELINE, args)),
            nothing,
            Against::Batch("batch_walk"),
        ),
        (
            "albedo_table",
            table,
            Single::Value(|args| match *args {
                [n_dot_v, roughness] => TABLE.get(n_dot_v, roughness),
                _ => f32::NAN,
            }),
            nothing,
            Against::Table,
        ),
    ];
    let subject = |(name, params, single, double, against)| Subject {
        name,
        params,
        single,
        double,
        against,
    };
    walks.into_iter().map(subject).collect()
}

/// The directional albedo for N·V and roughness.
pub(super) fn albedo(args: &[f64]) -> Option<f64> {
    match *args {
        [n_dot_v, roughness] => {
            crate::albedo::value("albedo_ggx", &[n_dot_v, roughness * roughness])
        }
        _ => None,
    }
}

/// In (0, 1), as walks want their numbers.
fn unit_single(numbers: &mut Numbers) -> f32 {
    ((numbers.unit() * f64::from(1u32 << 23)).floor() as f32 + 0.5) / (1u32 << 23) as f32
}

fn unit_double(numbers: &mut Numbers) -> f64 {
    numbers.unit() + 0.5f64.powi(54)
}

/// The worst that is wrong with a walk between facets of each kind: what must be 0.
fn off_one<R: Real>(args: &[R], unit: fn(&mut Numbers) -> R) -> f64 {
    let [x, y, z, alpha, f0, albedo, u] = *args else {
        return f64::NAN;
    };
    // From elsewhere a ray may find no way out: it is given up after ten thousand hits.
    let length2 = (x * x + y * y + z * z).to_f64();
    let described = (1e-4..=1.0).contains(&alpha.to_f64()) && (length2 - 1.0).abs() < 1e-5;
    if !described {
        return 0.0;
    }
    let mut numbers = Numbers(u.to_f64().to_bits());
    let coated = Facets::Coated { f0, albedo };
    let mut worst = 0.0;
    for facets in [Facets::Mirror, Facets::Diffuse { albedo }, coated] {
        // None ends in more hits than it gives up after.
        let off = walk(Ggx::new(alpha), facets, [x, y, z], || unit(&mut numbers))
            .map_or(f64::INFINITY, |exit| off_exit(&exit, facets, z));
        worst = more(worst, off);
    }
    worst
}

/// Its direction is a direction and points up, its weight is the albedo as often as it was inside.
fn off_exit<R: Real>(exit: &Exit<R>, facets: Facets<R>, height: R) -> f64 {
    let (mirrors, albedo) = match facets {
        Facets::Mirror => (true, 1.0),
        Facets::Diffuse { albedo } | Facets::Coated { albedo, .. } => (false, albedo.to_f64()),
    };
    let kept = albedo.powi(exit.diffuse as i32);
    let counted = (exit.bounces > 0 || height.to_f64() <= 0.0) && !(mirrors && exit.diffuse > 0);
    let off = more(
        off_direction(exit.l.map(R::to_f64)),
        (exit.weight.to_f64() - kept).abs(),
    );
    more(off, if counted { 0.0 } else { 1.0 })
}

/// How far a vector is from a direction above the horizon.
fn off_direction([x, y, z]: [f64; 3]) -> f64 {
    more(((x * x + y * y + z * z).sqrt() - 1.0).abs(), -z)
}

/// The larger, or what is no number.
fn more(a: f64, b: f64) -> f64 {
    if a.is_nan() || a > b { a } else { b }
}

/// The same of many walks between mirrors, all of which have met at least one.
fn off_many(isa: Isa, args: &[f32]) -> f64 {
    const WALKS: usize = 40;
    let [x, y, z, alpha, u] = *args else {
        return f64::NAN;
    };
    let [mut l_x, mut l_y, mut l_z] = [[f32::NAN; WALKS]; 3];
    let mut bounces = [0; WALKS];
    let out = Walks {
        l: [&mut l_x, &mut l_y, &mut l_z],
        bounces: &mut bounces,
    };
    walk_mirrors(isa, Vec3::new(x, y, z), alpha, u64::from(u.to_bits()), out);
    let mut worst = 0.0;
    for i in 0..WALKS {
        let off = off_direction([l_x[i], l_y[i], l_z[i]].map(f64::from));
        worst = more(
            worst,
            more(off, if bounces[i] > 0 || z <= 0.0 { 0.0 } else { 1.0 }),
        );
    }
    worst
}
