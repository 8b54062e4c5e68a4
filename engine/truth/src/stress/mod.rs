//! Looks for the points where a term is worst, in single and in double precision.
//!
//! Random points rarely hit the worst: the draw prefers the ends of each range, where
//! differences cancel and squares underflow, and then climbs from the worst points drawn,
//! by ever smaller steps of each argument down to single units in the last place. After
//! that, arguments that nobody should pass: see [`Oddity`].

mod draw;
mod hostile;
mod others;
mod precision;
mod subject;
mod walks;

pub(crate) use draw::possible;
pub use hostile::{Fault, Oddity};
pub use precision::Precision;
pub(crate) use subject::ALONG;
pub use subject::{Subject, subjects};

use crate::{Big, value};
use brdf::Term;
use draw::{Numbers, draw, moved};

/// How long to look.
#[derive(Debug, Clone, Copy)]
pub struct Effort {
    /// Points drawn for each subject.
    pub points: u32,
    /// Points to climb from.
    pub climbs: usize,
    /// Steps tried in each climb.
    pub steps: u32,
    /// Combinations of odd arguments.
    pub odd: usize,
}

impl Effort {
    /// Seconds for everything.
    pub const QUICK: Effort = Effort {
        points: 400,
        climbs: 2,
        steps: 40,
        odd: 500,
    };

    /// A minute or two for everything: double precision has to be measured with many digits,
    /// single precision with double.
    pub fn thorough(precision: Precision) -> Effort {
        match precision {
            Precision::Single => Effort {
                points: 200_000,
                climbs: 60,
                steps: 3_000,
                odd: 60_000,
            },
            Precision::Double => Effort {
                points: 10_000,
                climbs: 12,
                steps: 600,
                odd: 20_000,
            },
        }
    }
}

/// The worst that was found of a subject.
#[derive(Debug, Clone)]
pub struct Finding {
    /// Name of the subject.
    pub name: &'static str,
    /// In which arithmetic.
    pub precision: Precision,
    /// Error in units of the last place of the true value; where the arguments' own rounding costs
    /// more than the bound, that counts as the bound.
    pub worst_ulp: f64,
    /// The largest error over what half a unit in the last place of each argument changes, of the
    /// points where that change exceeds the bound. None where a function has to be close everywhere.
    pub of_jitter: Option<f64>,
    /// Where, argument by argument.
    pub at: Vec<(&'static str, f64)>,
    /// What the error should not exceed.
    pub bound: f64,
    /// How often the result was not finite where the true value is, and can be held.
    pub nonfinite: u32,
    /// The first of the odd arguments for which it gave what it must not.
    pub odd: Option<Oddity>,
}

impl Finding {
    /// Whether the subject is as good as it should be.
    pub fn ok(&self) -> bool {
        self.worst_ulp <= self.bound && self.nonfinite == 0 && self.odd.is_none()
    }
}

/// What the error of a subject should not exceed, in units of the last place.
///
/// Of what depends on world-space vectors, and of a drawn direction, half a unit in the last
/// place of each argument may change more than that. There the error may be as large as that
/// change, and no larger: the two are not added.
pub fn bound(name: &str) -> f64 {
    match name {
        // The fifth power of 1 − V·H, and the product of three functions.
        "vector_f_schlick" | "vector_specular" | "vector_eval_ggx_aniso" | "specular_ggx_world" => {
            25.0
        }
        "batch_specular" | "batch_specular_baseline" => 25.0,
        "batch_hoisted" | "batch_hoisted_baseline" => 25.0,
        "batch_vectors" | "batch_vectors_baseline" => 25.0,
        // D of a half vector whose sums do not keep their rounding errors, for speed.
        "batch_sample_pdf" | "batch_sample_pdf_baseline" => 16.0,
        "batch_sample_weight" | "batch_sample_weight_baseline" => 16.0,
        // Fits that are themselves within a hundredth.
        "albedo_ggx_karis" | "albedo_ggx_materialx" => 84.0,
        // D V with roughness² rounded, on which D depends by the fourth power of it.
        "specular_ggx" => 16.0,
        // Measured on the scale of a term, of which several that are as large cancel.
        "diffuse_oren_nayar_full" => 20.0,
        // 0.13: smooth surfaces turn from dark to bright between two entries near the horizon.
        "albedo_table" => 1.1e6,
        // 1e-5, see [`scale`].
        "albedo_ggx" | "albedo_ggx_separable" => 84.0,
        _ => 12.0,
    }
}

/// The size below which a term's error counts as if its value were of that size: terms that
/// cross 0 have no relative accuracy there.
///
/// The full Oren-Nayar is the difference of terms that reach a sixth of the albedo, and goes
/// through 0 with them; Lazányi's correction subtracts from f0 or more. A direction's
/// components are those of a vector of length 1.
fn scale(name: &str, args: &[f64]) -> f64 {
    match (name, args) {
        ("diffuse_oren_nayar_full", [.., albedo]) => albedo / 6.0,
        ("f_lazanyi", [f0, ..]) => 0.5 * f0,
        ("sample_hemisphere" | "sample_cap" | "sample_bounded", _) => 1.0,
        // A share of 1; fits of it cancel where it is small and go through 0.
        ("albedo_ggx" | "albedo_ggx_separable", _) => 1.0,
        ("albedo_ggx_karis" | "albedo_ggx_materialx" | "albedo_table", _) => 1.0,
        ("walk" | "batch_walk" | "batch_walk_baseline", _) => 1.0,
        // The half vector is known as well as the directions, over its length.
        ("rusinkiewicz_and_back", &[x, y, z, vx, vy, vz]) => {
            let sum = [x + vx, y + vy, z + vz];
            2.0 / sum.iter().map(|x| x * x).sum::<f64>().sqrt()
        }
        _ => 0.0,
    }
}

/// Looks for the worst point of a subject. The same seed finds the same.
pub fn search(subject: &Subject, precision: Precision, effort: Effort, seed: u64) -> Finding {
    let mut numbers = Numbers(seed);
    let mut nonfinite = 0;
    let mut points: Vec<(f64, Vec<f64>)> = Vec::new();
    let keep = effort.climbs.max(1);
    let share = |count: u32| ((f64::from(count) * subject.share()) as u32).max(20);
    let (count, steps) = (share(effort.points), share(effort.steps));
    let mut of_jitter = subject.is_ill_conditioned().then_some(0.0f64);
    let mut measure = |args: &[f64]| {
        let measured = quick_error(subject, precision, args);
        if let (Some(worst), Some(ratio)) = (&mut of_jitter, measured.of_jitter) {
            *worst = worst.max(ratio);
        }
        measured.ulp
    };
    for _ in 0..count {
        let args = draw(&subject.params, precision, &mut numbers);
        let error = measure(&args);
        if error.is_infinite() {
            nonfinite += 1;
        }
        points.push((error, args));
        if points.len() >= 2 * keep + 256 {
            worst_first(&mut points, keep);
        }
    }
    worst_first(&mut points, keep);
    for point in &mut points {
        for step in 0..steps {
            // From a hundredth of the value down to its last place.
            let share = 1e-2 * 1e-6f64.powf(f64::from(step) / f64::from(steps));
            let next = moved(&subject.params, precision, &mut numbers, share, &point.1);
            let Some(args) = next else { continue };
            let error = measure(&args);
            if error > point.0 {
                *point = (error, args);
            }
        }
    }
    // What the search measured quickly is measured again against the truth.
    worst_first(&mut points, keep.min(4));
    let worst = points
        .into_iter()
        .map(|(_, args)| (exact_error(subject, precision, &args), args))
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .unwrap_or_default();
    let (odd, without_value) = hostile::sweep(
        subject,
        precision,
        effort.odd.min(count as usize),
        &mut numbers,
    );
    let names = subject.params.iter().map(|param| param.name);
    Finding {
        name: subject.name,
        precision,
        worst_ulp: worst.0,
        of_jitter,
        at: names.zip(worst.1).collect(),
        bound: bound(subject.name),
        nonfinite: nonfinite + without_value,
        odd,
    }
}

fn worst_first(points: &mut Vec<(f64, Vec<f64>)>, keep: usize) {
    points.sort_by(|a, b| b.0.total_cmp(&a.0));
    points.truncate(keep);
}

/// Error of a term at a point, in units of the last place; 0 where there is no truth, and ∞
/// where the truth is finite and the result is not.
pub fn error(term: &Term, precision: Precision, args: &[f64]) -> f64 {
    let Some(truth) = value(term.name, args) else {
        return 0.0;
    };
    let result = match precision {
        Precision::Single => {
            let args: Vec<f32> = args.iter().map(|&x| x as f32).collect();
            f64::from((term.f32)(&args))
        }
        Precision::Double => (term.f64)(args),
    };
    error_against(&truth, term, precision, args, result)
}

/// The same of a result that is there already, against a truth that is.
pub(crate) fn error_against(
    truth: &Big,
    term: &Term,
    precision: Precision,
    args: &[f64],
    result: f64,
) -> f64 {
    distance(truth, result, scale(term.name, args), precision)
}

/// An error, and what it is compared with.
struct Measured {
    /// In units of the last place, or in as many parts of the jitter as the bound has units.
    ulp: f64,
    /// Over the jitter, where that exceeds the bound.
    of_jitter: Option<f64>,
}

impl Measured {
    const NONE: Measured = Measured {
        ulp: 0.0,
        of_jitter: None,
    };

    /// Of an error in units of the last place at a truth of some size.
    fn new(subject: &Subject, precision: Precision, args: &[f64], ulp: f64, size: f64) -> Measured {
        let of_jitter = None;
        if !subject.is_ill_conditioned() || !ulp.is_finite() {
            return Measured { ulp, of_jitter };
        }
        let unit = precision.ulp(size.abs().max(scale(subject.name, args)));
        let bound = bound(subject.name);
        let jitter = subject.jitter(precision, args) / unit;
        if jitter <= bound {
            return Measured { ulp, of_jitter };
        }
        Measured {
            ulp: ulp / jitter * bound,
            of_jitter: Some(ulp / jitter),
        }
    }
}

fn exact_error(subject: &Subject, precision: Precision, args: &[f64]) -> f64 {
    let Some(truth) = subject.truth(precision, args) else {
        return 0.0;
    };
    relate(subject, precision, args, &truth).ulp
}

/// The same with less of a truth: for single precision, what is computed in double precision
/// is good to 1e-8 of a unit as long as double precision is what it should be.
fn quick_error(subject: &Subject, precision: Precision, args: &[f64]) -> Measured {
    if precision == Precision::Double {
        return match subject.quick_truth(args) {
            Some(truth) => relate(subject, precision, args, &truth),
            None => Measured::NONE,
        };
    }
    let truth = subject.double_truth(args);
    let result = subject.evaluate(precision, args);
    if !truth.is_finite() || truth.abs() > precision.largest() {
        return Measured::NONE;
    }
    let ulp = if result.is_finite() {
        let unit = precision.ulp(truth.abs().max(scale(subject.name, args)));
        (result - truth).abs() / unit
    } else {
        f64::INFINITY
    };
    Measured::new(subject, precision, args, ulp, truth)
}

fn relate(subject: &Subject, precision: Precision, args: &[f64], truth: &Big) -> Measured {
    let result = subject.evaluate(precision, args);
    let ulp = distance(truth, result, scale(subject.name, args), precision);
    Measured::new(subject, precision, args, ulp, truth.to_f64())
}

/// Distance of a result from a truth in units of the last place of a number of that size.
fn distance(truth: &Big, result: f64, scale: f64, precision: Precision) -> f64 {
    if truth.abs().to_f64() > precision.largest() {
        return if result.is_infinite() {
            0.0
        } else {
            f64::INFINITY
        };
    }
    if !result.is_finite() {
        return f64::INFINITY;
    }
    let (digits, smallest) = precision.format();
    let smallest = if scale > 0.0 {
        smallest.max(scale.log2().floor() as isize)
    } else {
        smallest
    };
    truth.ulps(result, digits, smallest)
}

/// Distance of a value from a truth in units of the last place of `precision`.
pub fn ulps(truth: &Big, result: f64, precision: Precision) -> f64 {
    distance(truth, result, 0.0, precision)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn find(name: &str, single: fn(&[f32]) -> f32) -> Finding {
        let subject = Subject::replaced(name, single);
        let effort = Effort {
            odd: 5_000,
            ..Effort::QUICK
        };
        let finding = search(&subject, Precision::Single, effort, 1);
        assert!(!finding.ok(), "{finding:?}");
        finding
    }

    #[test]
    fn inaccurate_forms_are_found() {
        for (name, at_least) in [("d_ggx", 1e4), ("lambda_ggx", 1e4), ("f_dielectric", 100.0)] {
            let form = crate::naive::form(name).expect("a naive form");
            let found = find(name, form).worst_ulp;
            assert!(found > at_least, "{name}: {found}");
        }
    }

    /// N·H from a half vector of length 1, as shaders take it, is worse than its arguments.
    #[test]
    fn rounding_of_arguments_does_not_excuse_everything() {
        let found = find("d_ggx_world", |args| {
            let [n, l, v] = [0, 3, 6].map(|i| brdf::glam::Vec3::from_slice(&args[i..i + 3]));
            brdf::d_ggx(n.dot((l + v).normalize()), args[9])
        });
        assert!(
            found.of_jitter.is_some_and(|ratio| ratio > 1.5),
            "{found:?}"
        );
        let own = |args: &[f32]| {
            let [n, l, v] = [0, 3, 6].map(|i| brdf::glam::Vec3::from_slice(&args[i..i + 3]));
            brdf::d_ggx_world(n, l, v, args[9])
        };
        let subject = Subject::replaced("d_ggx_world", own);
        let found = search(&subject, Precision::Single, Effort::QUICK, 1);
        assert!(found.ok(), "{found:?}");
    }

    #[test]
    fn bad_answers_to_odd_arguments_are_found() {
        assert!(
            find("d_ggx", |args| brdf::d_ggx(args[0], args[1]) / args[1]
                * args[1])
            .odd
            .is_some()
        );
        let negative = find("d_ggx", |args| {
            brdf::d_ggx(args[0], args[1]) * args[1].signum()
        });
        assert_eq!(negative.odd.map(|odd| odd.fault), Some(Fault::Negative));
        let infinite = find("gsf_implicit", |args| {
            args[0] * args[1] / (args[1] - 0.3).min(0.0)
        });
        assert!(infinite.nonfinite > 0);
        let subject = Subject::replaced("d_ggx", |args| brdf::d_ggx(args[0], args[1]));
        assert!(search(&subject, Precision::Single, Effort::QUICK, 1).ok());
    }

    #[test]
    fn the_same_seed_finds_the_same() {
        let subject = &subjects()[0];
        let worst = |seed| search(subject, Precision::Single, Effort::QUICK, seed).at;
        assert_eq!(worst(3), worst(3));
        assert_ne!(worst(3), worst(4));
    }
}
