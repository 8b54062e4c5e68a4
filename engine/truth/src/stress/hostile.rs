//! Arguments that nobody should pass, and what must not come out.

use super::draw::Numbers;
use super::{Precision, Subject};
use brdf::Param;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// What a result must not be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fault {
    /// Not finite, though the truth is, and the precision can hold it.
    NotFinite,
    /// NaN, though no argument is.
    NotANumber,
    /// Below 0, though the model is not.
    Negative,
    /// No result at all.
    Panicked,
}

impl Fault {
    /// In a few words.
    pub fn says(self) -> &'static str {
        match self {
            Fault::NotFinite => "not finite",
            Fault::NotANumber => "NaN from numbers",
            Fault::Negative => "negative",
            Fault::Panicked => "panicked",
        }
    }
}

/// Odd arguments with what they gave.
#[derive(Debug, Clone)]
pub struct Oddity {
    /// Argument by argument.
    pub at: Vec<(&'static str, f64)>,
    /// What is wrong.
    pub fault: Fault,
}

const ODD: [f64; 26] = [
    f64::NEG_INFINITY,
    -3e38,
    -1e10,
    -1.0,
    -0.3,
    -1e-30,
    -1e-45,
    -0.0,
    0.0,
    1e-45,
    1e-39,
    1.2e-38,
    1e-30,
    1e-20,
    1e-12,
    1e-4,
    0.3,
    0.999_999_94,
    1.0,
    1.0000001,
    2.0,
    1e10,
    1e19,
    3.4e38,
    f64::INFINITY,
    f64::NAN,
];

/// Directions and what is taken for them.
const VECTORS: [[f64; 3]; 16] = [
    [0.0, 0.0, 1.0],
    [1.0, 0.0, 0.0],
    [0.0, -1.0, 0.0],
    [0.6, 0.0, 0.8],
    [-0.6, 0.0, 0.8],
    [0.6, 0.0, -0.8],
    [1.0, 0.0, 1e-30],
    [-1.0, 0.0, 1e-45],
    [1.0, 1e-20, -1e-30],
    [1e-30, 1e-45, 1.0],
    [3.0, 4.0, 12.0],
    [1e-25, 2e-25, 1e-25],
    [1e30, 2e30, 1e30],
    [0.0, 0.0, 0.0],
    [f64::INFINITY, 0.0, 1.0],
    [0.6, f64::NAN, 0.8],
];

/// Tries `count` combinations: the first of them that gives what it must not, and how many
/// gave no finite number where there is one and it can be held.
pub(super) fn sweep(
    subject: &Subject,
    precision: Precision,
    count: usize,
    numbers: &mut Numbers,
) -> (Option<Oddity>, u32) {
    let (mut first, mut nonfinite) = (None, 0);
    for _ in 0..count {
        let args = combination(&subject.params, precision, numbers);
        let result = catch_unwind(AssertUnwindSafe(|| subject.evaluate(precision, &args)));
        let fault = match result {
            Err(_) => Some(Fault::Panicked),
            Ok(result) => {
                let missing = !result.is_finite() && exists(subject, precision, &args);
                nonfinite += u32::from(missing);
                fault(subject, &args, result).or(missing.then_some(Fault::NotFinite))
            }
        };
        if let Some(fault) = fault.filter(|_| first.is_none()) {
            let names = subject.params.iter().map(|param| param.name);
            first = Some(Oddity {
                at: names.zip(args).collect(),
                fault,
            });
        }
    }
    (first, nonfinite)
}

fn fault(subject: &Subject, args: &[f64], result: f64) -> Option<Fault> {
    if args.iter().any(|arg| arg.is_nan()) || subject.is_batch() && !promised(subject, args) {
        None
    } else if result.is_nan() {
        Some(Fault::NotANumber)
    } else if result < 0.0 && is_positive(subject.name) && sensible(&subject.params, args) {
        Some(Fault::Negative)
    } else {
        None
    }
}

/// Whether a batch says what it gives for these arguments: α from 1e-4, everything else in its
/// range but cosines and heights below 0, and vectors of length 1.
fn promised(subject: &Subject, args: &[f64]) -> bool {
    let inside = |(param, &arg): (&Param, &f64)| match param.name {
        "alpha" => (1e-4..=1.0).contains(&arg),
        name if name.contains("_dot_") => (-1.0..=1.0).contains(&arg),
        "u_0" | "u_1" => (0.0..1.0).contains(&arg),
        name if name.ends_with("_z") => true,
        _ => (param.range.0..=param.range.1).contains(&arg),
    };
    are_directions(&subject.params, args) && subject.params.iter().zip(args).all(inside)
}

/// Whether all vectors among the arguments are of length 1.
fn are_directions(params: &[Param], args: &[f64]) -> bool {
    let mut first = params.iter().enumerate();
    first.all(|(i, param)| {
        let length2 = |i: usize| args[i..i + 3].iter().map(|x| x * x).sum::<f64>();
        !matches!(param.name, "n_x" | "l_x" | "v_x") || (length2(i) - 1.0).abs() < 1e-6
    })
}

/// Whether the model is nowhere negative. The full Oren-Nayar is at a few grazing points,
/// Lazányi's correction where its `a` is too large, fits of an albedo are near 0, and a
/// component may point anywhere.
fn is_positive(name: &str) -> bool {
    !matches!(
        name,
        "diffuse_oren_nayar_full"
            | "albedo_ggx_karis"
            | "albedo_ggx_materialx"
            | "f_lazanyi"
            | "sample_hemisphere"
            | "sample_cap"
            | "sample_bounded"
    )
}

/// Whether all that describes a material is in its range; directions and widths need not be.
fn sensible(params: &[Param], args: &[f64]) -> bool {
    let geometric = |name: &str| {
        name.contains("_dot_") || name.len() == 3 && name.as_bytes()[1] == b'_' || name == "alpha"
    };
    let inside = |(param, &arg): (&Param, &f64)| {
        geometric(param.name) || (param.range.0..=param.range.1).contains(&arg)
    };
    params.iter().zip(args).all(inside)
}

/// Whether there is a finite truth that the precision can hold, for arguments in the domain.
/// Close to the largest number a factor of the result may be beyond it, and for a width of less
/// than 1e-18 D is.
fn exists(subject: &Subject, precision: Precision, args: &[f64]) -> bool {
    let inside = |(param, &arg): (&Param, &f64)| match param.name {
        // In the world nothing is exactly at the peak of a mirror.
        "alpha" if subject.is_batch() => (1e-4..=1.0).contains(&arg),
        "alpha" | "alpha_x" | "alpha_y" => {
            arg == 0.0 && !subject.is_ill_conditioned() || (1e-18..=1.0).contains(&arg)
        }
        "l_dot_v" => (-1.0..=1.0).contains(&arg),
        name if name.contains("_dot_") => (0.0..=1.0).contains(&arg),
        _ => (param.range.0..=param.range.1).contains(&arg),
    };
    are_directions(&subject.params, args)
        && subject.params.iter().zip(args).all(inside)
        && subject
            .truth(precision, args)
            .is_some_and(|truth| truth.abs().to_f64() <= 1e-3 * precision.largest())
}

/// Odd values for every argument; vectors often are some that have been seen, and the second
/// often is the first or its opposite.
fn combination(params: &[Param], precision: Precision, numbers: &mut Numbers) -> Vec<f64> {
    let odd = |numbers: &mut Numbers| ODD[numbers.below(ODD.len())];
    let mut args: Vec<f64> = params
        .iter()
        .map(|param| {
            if numbers.unit() < 0.3 {
                param.range.0 + (param.range.1 - param.range.0) * numbers.unit()
            } else {
                odd(numbers)
            }
        })
        .collect();
    let mut last: Option<[f64; 3]> = None;
    for i in 0..args.len().saturating_sub(2) {
        if !matches!(params[i].name, "n_x" | "l_x" | "v_x") {
            continue;
        }
        let vector = match (numbers.below(4), last) {
            (0, _) => None,
            (1, Some(last)) if params[i].name == "v_x" => {
                let sign = if numbers.unit() < 0.7 { -1.0 } else { 1.0 };
                Some(last.map(|x| sign * x))
            }
            _ => Some(VECTORS[numbers.below(VECTORS.len())]),
        };
        if let Some(vector) = vector {
            args[i..i + 3].copy_from_slice(&vector);
        }
        last = Some([args[i], args[i + 1], args[i + 2]]);
    }
    args.into_iter().map(|x| precision.round(x)).collect()
}
