//! What can be searched: terms, formulas from vectors, samplers and coordinates.

use super::{Precision, others, walks};
use crate::{Big, at_precision, value};
use brdf::batch::Isa;
use brdf::{Ggx, Param, Rusinkiewicz, Sampler, Term};
use std::sync::LazyLock;

/// A function and what it is measured against.
#[derive(Debug)]
pub struct Subject {
    /// Name, that of the term where it is one.
    pub name: &'static str,
    /// Arguments in order.
    pub params: Vec<Param>,
    pub(super) single: Single,
    pub(super) double: Double,
    pub(super) against: Against,
}

pub(super) type Double = fn(&[f64]) -> f64;

#[derive(Debug, Clone, Copy)]
pub(super) enum Single {
    Value(fn(&[f32]) -> f32),
    /// Of a vector there is one number to look at, and taking it must not add an error.
    Exact(fn(&[f32]) -> f64),
}

/// What the truth is a function of, and what its errors are compared with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Against {
    /// The textbook form of the same name at the same arguments.
    Form,
    /// The same, but an error as large as what half a unit in the last place of each argument
    /// changes is none.
    Jitter,
    /// The textbook form of that name at what the subject drew: rounded, a direction is another
    /// direction, and its density and weight are that one's.
    Drawn(&'static str, Sampler),
    /// The textbook form of that name: of a batch, in single precision only.
    Batch(&'static str),
    /// The same at what [`brdf::batch::sample`] drew with that instruction set.
    DrawnBatch(&'static str, Isa),
    /// A table's entries and what is between them: the integral.
    Table,
    /// The quadrature of that integral which is written here, of another integrand by another rule: of
    /// an albedo there is no form.
    Albedo,
}

impl Subject {
    fn of(term: &Term) -> Subject {
        let world = term.params.iter().any(|param| param.name == "n_x");
        Subject {
            name: term.name,
            params: term.params.to_vec(),
            single: Single::Value(term.f32),
            double: term.f64,
            against: match term.name {
                _ if world => Against::Jitter,
                "albedo_ggx" | "albedo_ggx_separable" => Against::Albedo,
                _ => Against::Form,
            },
        }
    }

    /// That term with another function in its place.
    #[cfg(test)]
    pub(super) fn replaced(name: &str, single: fn(&[f32]) -> f32) -> Subject {
        let mut terms = brdf::terms().iter().chain(brdf::vector_terms());
        let term = terms.find(|term| term.name == name).expect("a term");
        Subject {
            single: Single::Value(single),
            ..Subject::of(term)
        }
    }

    /// Whether it can be looked at in that precision.
    pub fn has(&self, precision: Precision) -> bool {
        use Against::{Albedo, Batch, DrawnBatch, Table};
        precision == Precision::Single
            || !matches!(self.against, Batch(_) | DrawnBatch(..) | Albedo | Table)
    }

    /// Whether the rounding of its arguments is allowed for.
    pub(super) fn is_ill_conditioned(&self) -> bool {
        self.against == Against::Jitter
    }

    /// Whether it promises nothing outside the ranges of its arguments.
    pub(super) fn is_batch(&self) -> bool {
        matches!(self.against, Against::Batch(_) | Against::DrawnBatch(..)) || self.name == "walk"
    }

    /// How much of the effort it is worth: a quadrature is thousands of times a formula.
    pub(super) fn share(&self) -> f64 {
        match self.name {
            _ if matches!(self.against, Against::Albedo | Against::Table) => 0.003,
            // Three ways of a dozen hits, or forty.
            "walk" | "batch_walk" | "batch_walk_baseline" => 0.01,
            // A fit for each point.
            "batch_conductor" | "batch_conductor_baseline" => 0.02,
            _ => 1.0,
        }
    }

    /// What it computes.
    pub(super) fn evaluate(&self, precision: Precision, args: &[f64]) -> f64 {
        match precision {
            Precision::Single => {
                let args: Vec<f32> = args.iter().map(|&x| x as f32).collect();
                match self.single {
                    Single::Value(f) => f64::from(f(&args)),
                    Single::Exact(f) => f(&args),
                }
            }
            Precision::Double => (self.double)(args),
        }
    }

    /// What it should compute, to at least 36 digits; an albedo to 11.
    pub(super) fn truth(&self, precision: Precision, args: &[f64]) -> Option<Big> {
        match self.against {
            Against::Form | Against::Jitter => value(self.name, args),
            Against::Drawn(form, sampler) => value(form, &drawn(sampler, precision, args)),
            Against::Batch(form) => value(form, args),
            Against::DrawnBatch(form, isa) => value(form, &others::drawn(isa, args)),
            Against::Albedo => crate::albedo::value(self.name, args).map(|e| Big::new(e, 192)),
            Against::Table => walks::albedo(args).map(|e| Big::new(e, 192)),
        }
    }

    /// The same for double precision in fewer digits, enough to tell which of two points is
    /// worse.
    pub(super) fn quick_truth(&self, args: &[f64]) -> Option<Big> {
        const BITS: usize = 192;
        match self.against {
            Against::Drawn(form, sampler) => {
                at_precision(form, &drawn(sampler, Precision::Double, args), BITS)
            }
            Against::Albedo | Against::Table | Against::DrawnBatch(..) => None,
            Against::Batch(form) => at_precision(form, args, BITS),
            Against::Form | Against::Jitter => at_precision(self.name, args, BITS),
        }
    }

    /// The same for single precision in double precision.
    pub(super) fn double_truth(&self, args: &[f64]) -> f64 {
        match self.against {
            Against::Drawn(form, sampler) => {
                at_drawn(form, sampler, &drawn(sampler, Precision::Single, args))
            }
            Against::Table => walks::albedo(args).unwrap_or(f64::NAN),
            Against::DrawnBatch(form, isa) => {
                at_drawn(form, Sampler::BoundedCap, &others::drawn(isa, args))
            }
            _ => (self.double)(args),
        }
    }

    /// What half a unit in the last place of each argument can change: the sum over them.
    pub(super) fn jitter(&self, precision: Precision, args: &[f64]) -> f64 {
        // In double precision half a unit is too small a step for a difference.
        let widen = match precision {
            Precision::Single => 1.0,
            Precision::Double => (1u64 << 24) as f64,
        };
        let mut args = args.to_vec();
        let mut sum = 0.0;
        for i in 0..args.len() {
            let (x, step) = (args[i], 0.5 * precision.ulp(args[i]) * widen);
            args[i] = x + step;
            let more = (self.double)(&args);
            args[i] = x - step;
            let less = (self.double)(&args);
            args[i] = x;
            sum += 0.5 * (more - less).abs() / widen;
        }
        if sum.is_finite() { sum } else { 0.0 }
    }
}

/// Everything that can be searched: the terms with a closed form, the formulas from vectors,
/// the samplers, the coordinates.
pub fn subjects() -> &'static [Subject] {
    static ALL: LazyLock<Vec<Subject>> = LazyLock::new(|| {
        let inside = |p: &Param| 0.4 * p.range.0 + 0.6 * p.range.1;
        let measurable = |subject: &Subject| {
            let args: Vec<f64> = subject.params.iter().map(inside).collect();
            subject.against == Against::Albedo || value(subject.name, &args).is_some()
        };
        let terms = brdf::terms().iter().chain(brdf::vector_terms());
        let mut all: Vec<Subject> = terms.map(Subject::of).filter(measurable).collect();
        all.extend(others::functions());
        all.extend(samplers());
        all.extend(others::batches());
        all.extend(walks::subjects());
        all.push(coordinates());
        all
    });
    &ALL
}

/// A view, a width and two random numbers.
pub(super) fn sampler_params() -> Vec<Param> {
    let pdf = brdf::vector_terms()
        .iter()
        .find(|term| term.name == "vector_pdf");
    let [.., x, y, z, alpha] = pdf.map_or(&[][..], |term| term.params) else {
        return Vec::new();
    };
    let number = |name| Param {
        name,
        range: (0.0, 1.0 - 1.0 / 16_777_216.0),
        unit: "1",
        meaning: "random number",
    };
    vec![*x, *y, *z, *alpha, number("u_0"), number("u_1")]
}

/// The direction drawn for such arguments, and the arguments of its weight and density.
fn drawn(sampler: Sampler, precision: Precision, args: &[f64]) -> Vec<f64> {
    let [x, y, z, alpha, u0, u1] = *args else {
        return Vec::new();
    };
    let l = match precision {
        Precision::Single => {
            let [x, y, z, alpha, u0, u1] = [x, y, z, alpha, u0, u1].map(|x| x as f32);
            let sample = Ggx::new(alpha).sample([x, y, z], [u0, u1], sampler);
            sample.l.map(f64::from)
        }
        Precision::Double => Ggx::new(alpha).sample([x, y, z], [u0, u1], sampler).l,
    };
    vec![l[0], l[1], l[2], x, y, z, alpha]
}

/// Weight or density of a direction in double precision.
fn at_drawn(form: &str, sampler: Sampler, args: &[f64]) -> f64 {
    let [x, y, z, vx, vy, vz, alpha] = *args else {
        return f64::NAN;
    };
    let (ggx, l, v) = (Ggx::new(alpha), [x, y, z], [vx, vy, vz]);
    let pdf = ggx.pdf(l, v, sampler);
    if form.starts_with("vector_pdf") {
        pdf
    } else if z <= 0.0 {
        0.0
    } else {
        ggx.weight(l, v, sampler)
    }
}

macro_rules! sample {
    ($sampler:ident, $part:ident) => {
        (
            Single::Value(|args| match *args {
                [x, y, z, alpha, u0, u1] => {
                    let ggx = Ggx::new(alpha);
                    ggx.sample([x, y, z], [u0, u1], Sampler::$sampler).$part
                }
                _ => f32::NAN,
            }),
            (|args| match *args {
                [x, y, z, alpha, u0, u1] => {
                    let ggx = Ggx::new(alpha);
                    ggx.sample([x, y, z], [u0, u1], Sampler::$sampler).$part
                }
                _ => f64::NAN,
            }) as Double,
        )
    };
}

/// One number of a direction that depends on all three.
pub(crate) const ALONG: [f64; 3] = [0.5, 0.25, 0.75];

macro_rules! direction {
    ($sampler:ident) => {
        (
            Single::Exact(|args| match *args {
                [x, y, z, alpha, u0, u1] => along(
                    Ggx::new(alpha)
                        .sample([x, y, z], [u0, u1], Sampler::$sampler)
                        .l
                        .map(f64::from),
                ),
                _ => f64::NAN,
            }),
            (|args| match *args {
                [x, y, z, alpha, u0, u1] => along(
                    Ggx::new(alpha)
                        .sample([x, y, z], [u0, u1], Sampler::$sampler)
                        .l,
                ),
                _ => f64::NAN,
            }) as Double,
        )
    };
}

fn along(l: [f64; 3]) -> f64 {
    l[0] * ALONG[0] + l[1] * ALONG[1] + l[2] * ALONG[2]
}

/// Direction, density and weight of each sampler of visible normals.
fn samplers() -> Vec<Subject> {
    use Against::{Drawn, Jitter};
    use Sampler::{BoundedCap, Hemisphere, SphericalCap};
    let rows = [
        ("sample_hemisphere", direction!(Hemisphere), Jitter),
        (
            "sample_hemisphere_pdf",
            sample!(Hemisphere, pdf),
            Drawn("vector_pdf", Hemisphere),
        ),
        (
            "sample_hemisphere_weight",
            sample!(Hemisphere, weight),
            Drawn("vector_weight", Hemisphere),
        ),
        ("sample_cap", direction!(SphericalCap), Jitter),
        (
            "sample_cap_pdf",
            sample!(SphericalCap, pdf),
            Drawn("vector_pdf", SphericalCap),
        ),
        (
            "sample_cap_weight",
            sample!(SphericalCap, weight),
            Drawn("vector_weight", SphericalCap),
        ),
        ("sample_bounded", direction!(BoundedCap), Jitter),
        (
            "sample_bounded_pdf",
            sample!(BoundedCap, pdf),
            Drawn("vector_pdf_bounded", BoundedCap),
        ),
        (
            "sample_bounded_weight",
            sample!(BoundedCap, weight),
            Drawn("vector_weight_bounded", BoundedCap),
        ),
    ];
    let subject = |(name, (single, double), against): (_, (_, Double), _)| Subject {
        name,
        params: sampler_params(),
        single,
        double,
        against,
    };
    rows.into_iter().map(subject).collect()
}

/// Of the coordinates of a light and a view, and back: how far N·L, N·V or L·V is off.
fn coordinates() -> Subject {
    let specular = brdf::vector_terms()
        .iter()
        .find(|term| term.name == "vector_d_ggx");
    Subject {
        name: "rusinkiewicz_and_back",
        params: specular.map_or(Vec::new(), |term| term.params[..6].to_vec()),
        single: Single::Exact(|args| match *args {
            [x, y, z, vx, vy, vz] => {
                let (l, v) = Rusinkiewicz::new([x, y, z], [vx, vy, vz]).directions();
                let before = [x, y, z, vx, vy, vz].map(f64::from);
                off(before, l.map(f64::from), v.map(f64::from))
            }
            _ => f64::NAN,
        }),
        double: |args| match *args {
            [x, y, z, vx, vy, vz] => {
                let (l, v) = Rusinkiewicz::new([x, y, z], [vx, vy, vz]).directions();
                off([x, y, z, vx, vy, vz], l, v)
            }
            _ => f64::NAN,
        },
        against: Against::Form,
    }
}

/// The largest difference of N·L, N·V and L·V.
fn off([x, y, z, vx, vy, vz]: [f64; 6], l: [f64; 3], v: [f64; 3]) -> f64 {
    let before = x * vx + y * vy + z * vz;
    let after = l[0] * v[0] + l[1] * v[1] + l[2] * v[2];
    let differences = [l[2] - z, v[2] - vz, after - before].map(f64::abs);
    differences.into_iter().fold(0.0, f64::max)
}
