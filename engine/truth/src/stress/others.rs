//! What can be searched outside the registry: functions without a name there, and the batches.

use super::subject::{Against, Double, Single, Subject, sampler_params};
use brdf::batch::{self, Conductor, Cosines, Input, Isa, Samples, Vectors};
use brdf::glam::Vec3;
use brdf::{Param, term, vector_terms};
use std::sync::LazyLock;

/// Functions that lessons do not call.
pub(super) fn functions() -> Vec<Subject> {
    macro_rules! row {
        ($name:ident($($arg:ident),+), $params:expr) => {{
            let single: fn(&[f32]) -> f32 = |args| match *args {
                [$($arg),+] => brdf::$name($($arg),+),
                _ => f32::NAN,
            };
            let double: Double = |args| match *args {
                [$($arg),+] => brdf::$name($($arg),+),
                _ => f64::NAN,
            };
            Subject {
                name: stringify!($name),
                params: $params,
                single: Single::Value(single),
                double,
                against: Against::Form,
            }
        }};
    }
    let metallic = Subject {
        name: "f0_from_metallic",
        params: vec![share("base"), share("metallic")],
        single: Single::Value(|args| match *args {
            [base, metallic] => brdf::f0_from_metallic([base; 3], metallic)[0],
            _ => f32::NAN,
        }),
        double: |args| match *args {
            [base, metallic] => brdf::f0_from_metallic([base; 3], metallic)[0],
            _ => f64::NAN,
        },
        against: Against::Form,
    };
    vec![
        row!(f0_from_ior(n), vec![index()]),
        metallic,
        row!(f_schlick_average(f0), vec![share("f0")]),
        row!(
            multi_scattering_tint(f, e),
            vec![share("f_average"), share("albedo_average")]
        ),
    ]
}

/// A number from 0 to 1.
fn share(name: &'static str) -> Param {
    Param {
        name,
        range: (0.0, 1.0),
        unit: "1",
        meaning: "a share",
    }
}

fn index() -> Param {
    let found = term("f_schlick_ior").map(|term| term.params[0]);
    found.unwrap_or_else(|| share("ior"))
}

/// The instruction sets whose arithmetic differs.
static BEST: LazyLock<Isa> = LazyLock::new(Isa::best);

/// The batches, one number at a time: the last numbers of a batch, and those that fill a register,
/// are computed in the same way.
pub(super) fn batches() -> Vec<Subject> {
    let params = |name: &str| {
        let mut terms = brdf::terms().iter().chain(vector_terms());
        let found = terms.find(|term| term.name == name);
        found.map_or(Vec::new(), |term| term.params.to_vec())
    };
    let mut cosines = params("specular_ggx");
    cosines.truncate(3);
    cosines.extend(params("f_schlick").into_iter().rev());
    cosines.extend(params("d_ggx").pop());
    let mut all = Vec::new();
    macro_rules! both {
        ($best:literal, $baseline:literal, $params:expr, $against:expr, $f:ident, $double:expr) => {
            for (name, single) in [
                ($best, (|args| $f(*BEST, args)) as fn(&[f32]) -> f32),
                ($baseline, |args| $f(Isa::BASELINE, args)),
            ] {
                all.push(Subject {
                    name,
                    params: $params.to_vec(),
                    single: Single::Value(single),
                    double: $double,
                    against: $against,
                });
            }
        };
    }
    both!(
        "batch_specular",
        "batch_specular_baseline",
        cosines,
        Against::Batch("cosines_specular"),
        specular,
        specular_of
    );
    both!(
        "batch_hoisted",
        "batch_hoisted_baseline",
        cosines,
        Against::Batch("cosines_specular"),
        hoisted,
        specular_of
    );
    both!(
        "batch_vectors",
        "batch_vectors_baseline",
        params("vector_specular"),
        Against::Batch("vector_specular"),
        vectors,
        |args| vector_terms()
            .iter()
            .find(|term| term.name == "vector_specular")
            .map_or(f64::NAN, |term| (term.f64)(args))
    );
    both!(
        "batch_conductor",
        "batch_conductor_baseline",
        params("f_conductor"),
        Against::Batch("f_conductor"),
        conductor,
        |args| match *args {
            [n, k, c] => brdf::f_conductor(n, k, c),
            _ => f64::NAN,
        }
    );
    all.extend(samples());
    all
}

/// Density and weight of what [`batch::sample`] draws.
fn samples() -> Vec<Subject> {
    const PDF: &str = "vector_pdf_bounded";
    const WEIGHT: &str = "vector_weight_bounded";
    type Single32 = fn(&[f32]) -> f32;
    let rows: [(&str, Single32, &str, Isa); 4] = [
        (
            "batch_sample_pdf",
            |args| sample(*BEST, args)[3],
            PDF,
            *BEST,
        ),
        (
            "batch_sample_weight",
            |args| sample(*BEST, args)[4],
            WEIGHT,
            *BEST,
        ),
        (
            "batch_sample_pdf_baseline",
            |args| sample(Isa::BASELINE, args)[3],
            PDF,
            Isa::BASELINE,
        ),
        (
            "batch_sample_weight_baseline",
            |args| sample(Isa::BASELINE, args)[4],
            WEIGHT,
            Isa::BASELINE,
        ),
    ];
    let subject = |(name, single, form, isa)| Subject {
        name,
        params: sampler_params(),
        single: Single::Value(single),
        // In double precision there is no batch.
        double: |_| f64::NAN,
        against: Against::DrawnBatch(form, isa),
    };
    rows.into_iter().map(subject).collect()
}

/// What [`batch::sample`] draws for a view, a width and two numbers: direction, density, weight.
fn sample(isa: Isa, args: &[f32]) -> [f32; 5] {
    let [x, y, z, alpha, u0, u1] = *args else {
        return [f32::NAN; 5];
    };
    let [mut l_x, mut l_y, mut l_z, mut pdf, mut weight] = [[f32::NAN]; 5];
    let out = Samples {
        l: [&mut l_x, &mut l_y, &mut l_z],
        pdf: &mut pdf,
        weight: &mut weight,
    };
    batch::sample(isa, Vec3::new(x, y, z), alpha, [&[u0], &[u1]], out);
    [l_x, l_y, l_z, pdf, weight].map(|[value]| value)
}

/// The direction drawn, and the arguments of its weight and density.
pub(super) fn drawn(isa: Isa, args: &[f64]) -> Vec<f64> {
    let single: Vec<f32> = args.iter().map(|&x| x as f32).collect();
    let drawn = sample(isa, &single);
    let l = drawn[..3].iter().map(|&x| f64::from(x));
    l.chain(args.iter().take(4).copied()).collect()
}

fn specular(isa: Isa, args: &[f32]) -> f32 {
    let [l, v, h, u, f0, alpha] = args else {
        return f32::NAN;
    };
    fn one(x: &f32) -> &[f32] {
        std::slice::from_ref(x)
    }
    let input = Cosines {
        n_dot_l: one(l),
        n_dot_v: Input::Each(one(v)),
        n_dot_h: one(h),
        v_dot_h: one(u),
        alpha: Input::Each(one(alpha)),
        f0: Some(Input::Each(one(f0))),
    };
    let mut out = [0.0];
    batch::specular(isa, &input, &mut out);
    out[0]
}

fn hoisted(isa: Isa, args: &[f32]) -> f32 {
    let [l, v, h, u, f0, alpha] = *args else {
        return f32::NAN;
    };
    let input = Cosines {
        n_dot_l: &[l],
        n_dot_v: Input::All(v),
        n_dot_h: &[h],
        v_dot_h: &[u],
        alpha: Input::All(alpha),
        f0: Some(Input::All(f0)),
    };
    let mut out = [0.0];
    batch::specular(isa, &input, &mut out);
    out[0]
}

fn vectors(isa: Isa, args: &[f32]) -> f32 {
    let [x, y, z, vx, vy, vz, alpha, f0] = *args else {
        return f32::NAN;
    };
    let input = Vectors {
        l: [&[x], &[y], &[z]],
        v: [Input::Each(&[vx]), Input::Each(&[vy]), Input::Each(&[vz])],
        alpha: Input::Each(&[alpha]),
        f0: Some(Input::Each(&[f0])),
    };
    let mut out = [0.0];
    batch::specular_vectors(isa, &input, &mut out);
    out[0]
}

fn conductor(isa: Isa, args: &[f32]) -> f32 {
    let [n, k, c] = *args else {
        return f32::NAN;
    };
    let [mut r, mut g, mut b] = [[0.0f32]; 3];
    let color = Conductor::new(n, k);
    batch::conductor_rgb(isa, &[color; 3], &[c], [&mut r, &mut g, &mut b]);
    r[0]
}

/// D V F cos θ of cosines, as [`Cosines`] has them.
fn specular_of(args: &[f64]) -> f64 {
    match *args {
        [l, v, h, u, f0, alpha] => {
            brdf::d_ggx(h, alpha) * brdf::v_ggx(l, v, alpha) * brdf::f_schlick(f0, u) * l
        }
        _ => f64::NAN,
    }
}
