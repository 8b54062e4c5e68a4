//! Looks for the points where a term is worst, in single and in double precision.
//!
//! Random points rarely hit the worst: the draw prefers the ends of each range, where
//! differences cancel and squares underflow, and then climbs from the worst points drawn,
//! by ever smaller steps of each argument down to single units in the last place.

use crate::{Big, value};
use brdf::{Param, Term};

/// The arithmetic a term is computed in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Precision {
    /// `f32`.
    Single,
    /// `f64`.
    Double,
}

impl Precision {
    /// As commands write it, `f32` or `f64`.
    pub fn name(self) -> &'static str {
        match self {
            Precision::Single => "f32",
            Precision::Double => "f64",
        }
    }

    /// Bits after the leading one, and the exponent of the smallest normal number.
    fn format(self) -> (isize, isize) {
        match self {
            Precision::Single => (23, -126),
            Precision::Double => (52, -1022),
        }
    }

    fn largest(self) -> f64 {
        match self {
            Precision::Single => f64::from(f32::MAX),
            Precision::Double => f64::MAX,
        }
    }

    /// The argument as this precision can hold it.
    fn round(self, x: f64) -> f64 {
        match self {
            Precision::Single => f64::from(x as f32),
            Precision::Double => x,
        }
    }

    /// `steps` representable numbers up or down.
    fn step(self, x: f64, steps: i32) -> f64 {
        let up = steps > 0;
        (0..steps.unsigned_abs()).fold(x, |x, _| match (self, up) {
            (Precision::Single, true) => f64::from((x as f32).next_up()),
            (Precision::Single, false) => f64::from((x as f32).next_down()),
            (Precision::Double, true) => x.next_up(),
            (Precision::Double, false) => x.next_down(),
        })
    }

    fn evaluate(self, term: &Term, args: &[f64]) -> f64 {
        match self {
            Precision::Single => {
                let args: Vec<f32> = args.iter().map(|&x| x as f32).collect();
                f64::from((term.f32)(&args))
            }
            Precision::Double => (term.f64)(args),
        }
    }
}

/// How long to look.
#[derive(Debug, Clone, Copy)]
pub struct Effort {
    /// Points drawn for each term.
    pub points: u32,
    /// Points to climb from.
    pub climbs: usize,
    /// Steps tried in each climb.
    pub steps: u32,
}

impl Effort {
    /// A second or two for all terms.
    pub const QUICK: Effort = Effort {
        points: 400,
        climbs: 2,
        steps: 40,
    };
    /// Minutes.
    pub const THOROUGH: Effort = Effort {
        points: 20_000,
        climbs: 12,
        steps: 600,
    };
}

/// The worst that was found of a term.
#[derive(Debug, Clone)]
pub struct Finding {
    /// Name of the term.
    pub name: &'static str,
    /// In which arithmetic.
    pub precision: Precision,
    /// Error in units of the last place of the true value.
    pub worst_ulp: f64,
    /// Where, argument by argument.
    pub at: Vec<(&'static str, f64)>,
    /// What the error should not exceed.
    pub bound: f64,
    /// How often the result was not finite where the true value is, and can be held.
    pub nonfinite: u32,
}

impl Finding {
    /// Whether the term is as good as it should be.
    pub fn ok(&self) -> bool {
        self.worst_ulp <= self.bound && self.nonfinite == 0
    }
}

/// What the error of a term should not exceed, in units of the last place.
pub fn bound(name: &str) -> f64 {
    match name {
        "f_schlick" | "f_schlick_ior" | "f_lazanyi" => 25.0,
        "vector_f_schlick" | "vector_specular" | "specular_ggx" => 25.0,
        "diffuse_oren_nayar_full" | "diffuse_eon" => 25.0,
        // A whole density, and a form as printed with differences nobody asked to keep.
        "vector_pdf" | "gsf_modified_kelemen" => 16.0,
        _ => 12.0,
    }
}

/// The size below which a term's error counts as if its value were of that size: terms that
/// cross 0 have no relative accuracy there.
fn scale(name: &str, args: &[f64]) -> f64 {
    match (name, args) {
        ("diffuse_oren_nayar_full", [.., albedo]) => albedo / 6.0,
        ("f_lazanyi", [f0, ..]) => 0.5 * f0,
        _ => 0.0,
    }
}

/// What this can measure: the terms with a closed form, and the formulas from vectors.
pub fn subjects() -> impl Iterator<Item = &'static Term> {
    brdf::terms()
        .iter()
        .chain(brdf::vector_terms())
        .filter(|term| {
            let inside = |p: &Param| 0.4 * p.range.0 + 0.6 * p.range.1;
            let args: Vec<f64> = term.params.iter().map(inside).collect();
            value(term.name, &args).is_some()
        })
}

/// Looks for the worst point of a term. The same seed finds the same.
pub fn search(term: &'static Term, precision: Precision, effort: Effort, seed: u64) -> Finding {
    let mut numbers = Numbers(seed);
    let mut nonfinite = 0;
    let mut points: Vec<(f64, Vec<f64>)> = Vec::new();
    for _ in 0..effort.points {
        let args = draw(term, precision, &mut numbers);
        let error = quick_error(term, precision, &args);
        if error.is_infinite() {
            nonfinite += 1;
        }
        points.push((error, args));
    }
    points.sort_by(|a, b| b.0.total_cmp(&a.0));
    points.truncate(effort.climbs.max(1));
    for point in &mut points {
        climb(term, precision, effort.steps, &mut numbers, point);
    }
    // What the search measured quickly is measured again against the truth.
    let worst = points
        .into_iter()
        .map(|(_, args)| (error(term, precision, &args), args))
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .unwrap_or_default();
    let names = term.params.iter().map(|param| param.name);
    Finding {
        name: term.name,
        precision,
        worst_ulp: worst.0,
        at: names.zip(worst.1).collect(),
        bound: bound(term.name),
        nonfinite,
    }
}

/// Error of a term at a point, in units of the last place; 0 where there is no truth, and ∞
/// where the truth is finite and the result is not.
pub fn error(term: &Term, precision: Precision, args: &[f64]) -> f64 {
    match value(term.name, args) {
        Some(truth) => error_against(
            &truth,
            term,
            precision,
            args,
            precision.evaluate(term, args),
        ),
        None => 0.0,
    }
}

/// The same of a result that is there already, against a truth that is.
pub(crate) fn error_against(
    truth: &Big,
    term: &Term,
    precision: Precision,
    args: &[f64],
    result: f64,
) -> f64 {
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
    let floor = scale(term.name, args);
    let smallest = if floor > 0.0 {
        smallest.max(floor.log2().floor() as isize)
    } else {
        smallest
    };
    truth.ulps(result, digits, smallest)
}

/// The same, with double precision for the truth of single precision: good to 1e-8 of a unit
/// as long as double precision is what it should be.
fn quick_error(term: &Term, precision: Precision, args: &[f64]) -> f64 {
    if precision == Precision::Double {
        return error(term, precision, args);
    }
    let truth = (term.f64)(args);
    let result = precision.evaluate(term, args);
    if !truth.is_finite() || truth.abs() > precision.largest() {
        return 0.0;
    }
    if !result.is_finite() {
        return f64::INFINITY;
    }
    let (digits, smallest) = precision.format();
    let size = truth
        .abs()
        .max(scale(term.name, args))
        .max((smallest as f64).exp2());
    (result - truth).abs() / (size.log2().floor() - digits as f64).exp2()
}

fn climb(
    term: &Term,
    precision: Precision,
    steps: u32,
    numbers: &mut Numbers,
    point: &mut (f64, Vec<f64>),
) {
    for step in 0..steps {
        let mut args = point.1.clone();
        let index = (numbers.unit() * args.len() as f64) as usize;
        let (low, high) = range(&term.params[index]);
        // From a hundredth of the value down to its last place.
        let share = 1e-2 * 1e-6f64.powf(f64::from(step) / f64::from(steps));
        let moved = if numbers.unit() < 0.5 {
            precision.step(args[index], (numbers.unit() * 17.0) as i32 - 8)
        } else {
            precision.round(args[index] * (1.0 + share * (2.0 * numbers.unit() - 1.0)))
        };
        args[index] = precision.round(moved.clamp(low, high));
        if !possible(term, precision, &args) {
            continue;
        }
        let error = quick_error(term, precision, &args);
        if error > point.0 {
            *point = (error, args);
        }
    }
}

/// A point of which every argument is likely to be near an end of its range.
fn draw(term: &Term, precision: Precision, numbers: &mut Numbers) -> Vec<f64> {
    loop {
        let drawn = term
            .params
            .iter()
            .map(|param| numbers.hard(param, precision));
        let mut args: Vec<f64> = drawn.collect();
        draw_directions(term, precision, numbers, &mut args);
        if possible(term, precision, &args) {
            return args;
        }
    }
}

/// Replaces components of vectors by those of directions: at random, close to the horizon,
/// close to the normal, and close to mirrored or equal to the other direction.
fn draw_directions(term: &Term, precision: Precision, numbers: &mut Numbers, args: &mut [f64]) {
    let mut last: Option<[f64; 3]> = None;
    for i in 0..args.len().saturating_sub(2) {
        if !matches!(term.params[i].name, "l_x" | "v_x") {
            continue;
        }
        let small = 1e-7f64.powf(numbers.unit());
        let z = match (numbers.unit() * 3.0) as u32 {
            0 => numbers.unit(),
            1 => small,
            _ => 1.0 - small,
        };
        let (sin, phi) = (
            ((1.0 - z) * (1.0 + z)).sqrt(),
            std::f64::consts::TAU * numbers.unit(),
        );
        let mut v = [sin * phi.cos(), sin * phi.sin(), z.max(1e-6)];
        if let Some(l) = last.filter(|_| numbers.unit() < 0.6) {
            let sign = if numbers.unit() < 0.5 { -1.0 } else { 1.0 };
            let mut near = |x: f64| x + 1e-8f64.powf(numbers.unit()) * (numbers.unit() - 0.5);
            v = [
                near(sign * l[0]),
                near(sign * l[1]),
                near(l[2]).abs().max(1e-6),
            ];
        }
        let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
        let v = v.map(|x| precision.round(x / length));
        args[i..i + 3].copy_from_slice(&v);
        last = Some(v);
    }
}

/// Whether three cosines among the arguments can belong to two directions and a normal, and
/// whether vectors are of length 1.
pub(crate) fn possible(term: &Term, precision: Precision, args: &[f64]) -> bool {
    let get = |name| {
        term.params
            .iter()
            .position(|param| param.name == name)
            .map(|i| args[i])
    };
    // What rounding each component leaves.
    let length_error = 1.75 * (-precision.format().0 as f64 - 1.0).exp2();
    let unit = |x, y, z| match (get(x), get(y), get(z)) {
        (Some(x), Some(y), Some(z)) => (x * x + y * y + z * z - 1.0).abs() < length_error,
        _ => true,
    };
    let cosines = match (get("n_dot_l"), get("n_dot_v"), get("l_dot_v")) {
        (Some(l), Some(v), Some(lv)) => {
            let sines = ((1.0 - l) * (1.0 + l) * (1.0 - v) * (1.0 + v)).sqrt();
            (lv - l * v).abs() <= sines
        }
        _ => true,
    };
    cosines && unit("l_x", "l_y", "l_z") && unit("v_x", "v_y", "v_z")
}

/// The range to look in: wider than the sensible one, to where the promises end.
fn range(param: &Param) -> (f64, f64) {
    match param.name {
        "alpha" | "alpha_x" | "alpha_y" => (1e-4, 1.0),
        "roughness" => (1e-2, 1.0),
        name if name.contains("_dot_") && param.range.0 >= 0.0 => (1e-6, 1.0),
        "l_dot_v" => (-1.0, 1.0),
        _ => param.range,
    }
}

/// Numbers that follow from a seed (SplitMix64).
struct Numbers(u64);

impl Numbers {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    fn hard(&mut self, param: &Param, precision: Precision) -> f64 {
        let (low, high) = range(param);
        let span = high - low;
        let x = match (self.unit() * 4.0) as u32 {
            0 => low + span * self.unit(),
            1 => low + span * 1e-7f64.powf(self.unit()),
            2 => high - span * 1e-8f64.powf(self.unit()),
            _ if low > 0.0 => low * (high / low).powf(self.unit()),
            _ => 0.5 * (low + high) + span * (self.unit() - 0.5) * 1e-8f64.powf(self.unit()),
        };
        // Rounded to single precision a bound may fall outside itself.
        let inside = precision.round(x).clamp(low, high);
        precision.round(inside)
    }
}

/// Distance of a value from a truth in units of the last place of `precision`.
pub fn ulps(truth: &Big, result: f64, precision: Precision) -> f64 {
    let (digits, smallest) = precision.format();
    truth.ulps(result, digits, smallest)
}
