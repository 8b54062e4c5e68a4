//! Every WGSL twin of the core, run on an adapter, against the textbook form in high precision.
//! Quadratures have no twin.
//! Without an adapter the test says that it was skipped; with LOBE_REQUIRE_GPU=1 it fails
//! instead.

use brdf::{Param, Term};
use formula::{Expr, Library};
use renders::GpuFormulas;

/// Largest relative error of a twin, and what is enough of it to be typical: half of all points.
const RELATIVE: f64 = 5e-5;
const TYPICAL: f64 = 5e-6;

/// Places where formulas are hard, for an argument of that name; of the rest, its range decides.
fn hard(param: &Param) -> Vec<f64> {
    let (low, high) = param.range;
    let cosine = [1e-3, 0.01, 0.1, 0.5, 0.9, 0.99, 0.9999, 0.999_999, 1.0];
    let places = match param.name {
        "alpha" | "alpha_x" | "alpha_y" => vec![0.01, 0.0256, 0.16, 0.5, 0.99, 1.0],
        "roughness" => vec![0.1, 0.16, 0.4, 0.7, 0.99, 1.0],
        "f0" => vec![0.0, 0.02, 0.04, 0.5, 0.9, 1.0],
        name if name.starts_with("n_dot") || name == "v_dot_h" => cosine.to_vec(),
        _ => [0.0, 0.01, 0.25, 0.5, 0.75, 0.99, 1.0]
            .map(|t| low + t * (high - low))
            .to_vec(),
    };
    places.into_iter().map(|x| f64::from(x as f32)).collect()
}

/// All pairs of hard places, the other arguments somewhere, and points spread over the range.
fn points(term: &Term) -> Vec<Vec<f64>> {
    let spread = |index: usize, place: usize| {
        // An additive sequence with another irrational step for each argument.
        let steps = [
            0.754_877_67,
            0.569_840_29,
            0.430_159_71,
            0.324_717_96,
            0.245_122_33,
        ];
        let t = (0.5 + steps[place % steps.len()] * index as f64).fract();
        let param = &term.params[place];
        let low = if param.name == "alpha" {
            0.01
        } else {
            param.range.0
        };
        f64::from((low + t * (param.range.1 - low)) as f32)
    };
    let anywhere = |index: usize| -> Vec<f64> {
        (0..term.params.len())
            .map(|place| spread(index, place))
            .collect()
    };
    let mut points: Vec<Vec<f64>> = (0..200).map(anywhere).collect();
    for first in 0..term.params.len() {
        for second in first..term.params.len() {
            for x in hard(&term.params[first]) {
                for y in hard(&term.params[second]) {
                    let mut point = anywhere(points.len());
                    point[first] = x;
                    point[second] = y;
                    points.push(point);
                }
            }
        }
    }
    points
        .iter_mut()
        .for_each(|point| make_possible(term, point));
    points
}

/// The directions to light and eye stand at most as far apart as the normal allows.
fn make_possible(term: &Term, point: &mut [f64]) {
    let place = |name: &str| term.params.iter().position(|param| param.name == name);
    if let (Some(l), Some(v), Some(l_dot_v)) =
        (place("n_dot_l"), place("n_dot_v"), place("l_dot_v"))
    {
        let sine = |c: f64| (1.0 - c * c).max(0.0).sqrt();
        let (product, sines) = (point[l] * point[v], sine(point[l]) * sine(point[v]));
        let within = point[l_dot_v].clamp(product - sines, product + sines);
        point[l_dot_v] = f64::from(within as f32);
    }
}

/// The worst and the median relative error of a twin, and where the worst is.
fn measure(gpu: &GpuFormulas, term: &Term) -> (f64, f64, Vec<f64>) {
    let names: Vec<&str> = term.params.iter().map(|param| param.name).collect();
    let expr: Expr = formula::parse(&format!("{}()", term.name)).expect("a call");
    let points = points(term);
    let narrow: Vec<Vec<f32>> = points
        .iter()
        .map(|point| point.iter().map(|x| *x as f32).collect())
        .collect();
    let values = gpu
        .values(&Library::new(), &expr, &names, &narrow)
        .unwrap_or_else(|error| panic!("{}: {error}", term.name));
    let mut errors: Vec<(f64, &Vec<f64>)> = Vec::new();
    for (point, value) in points.iter().zip(values) {
        // Where the truth is not finite there is no error to speak of.
        let Some(truth) = truth::value(term.name, point) else {
            continue;
        };
        let truth = truth.to_f64();
        errors.push((error(term, f64::from(value), truth), point));
    }
    errors.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (worst, at) = errors
        .last()
        .map_or((0.0, Vec::new()), |(e, at)| (*e, (*at).clone()));
    (worst, errors[errors.len() / 2].0, at)
}

/// Relative where the truth is not tiny: towards N·L = 0 values vanish, and nobody sees them.
fn error(term: &Term, value: f64, truth: f64) -> f64 {
    let floor = match term.name {
        // A fit that leaves a difference of numbers near 1 where f0 is 0.
        "albedo_ggx_karis" => 0.05,
        _ => 1e-6,
    };
    (value - truth).abs() / truth.abs().max(floor)
}

/// An adapter, or the words that there is none.
fn adapter() -> Option<GpuFormulas> {
    match GpuFormulas::open() {
        Ok(gpu) => Some(gpu),
        Err(error) => {
            let required = std::env::var("LOBE_REQUIRE_GPU").is_ok_and(|value| value == "1");
            assert!(!required, "LOBE_REQUIRE_GPU=1, but {error}");
            println!("skipped: no Vulkan adapter ({error})");
            None
        }
    }
}

/// A function of `x` on a range, relative to its own value or to `floor` where it is less.
#[track_caller]
fn check_elementary(gpu: &GpuFormulas, text: &str, (low, high): (f64, f64), floor: f64) {
    let expr = formula::parse(text).unwrap_or_else(|error| panic!("{text}: {error}"));
    let library = Library::new();
    let at = |i: u32| (low + (high - low) * f64::from(i) / 999.0) as f32;
    let points: Vec<Vec<f32>> = (0..1000).map(|i| vec![at(i)]).collect();
    let values = gpu.values(&library, &expr, &["x"], &points);
    let values = values.unwrap_or_else(|error| panic!("{text}: {error}"));
    for (point, value) in points.iter().zip(values) {
        let given = [("x".to_owned(), f64::from(point[0]))].into();
        let truth = library.eval(&expr, &given);
        let truth = truth.unwrap_or_else(|error| panic!("{text} at {point:?}: {error}"));
        let error = (f64::from(value) - truth).abs() / truth.abs().max(floor);
        assert!(
            error <= RELATIVE,
            "{text} at {point:?}: {value} for {truth}"
        );
    }
}

#[test]
fn elementary_functions_are_what_they_are_elsewhere() {
    let Some(gpu) = adapter() else {
        return;
    };
    for (text, range, floor) in [
        ("sqrt(x)", (0.0, 4.0), 1e-30),
        ("abs(x)", (-1.0, 1.0), 1e-30),
        ("exp(x)", (-60.0, 60.0), 0.0),
        ("ln(x)", (1e-3, 20.0), 0.1),
        ("log2(x)", (1e-3, 20.0), 0.1),
        ("sin(x)", (-3.2, 3.2), 0.05),
        ("cos(x)", (-3.2, 3.2), 0.05),
        ("tan(x)", (-1.4, 1.4), 0.05),
        ("asin(x)", (-1.0, 1.0), 1e-30),
        ("acos(x)", (-1.0, 1.0), 1e-3),
        ("atan(x)", (-20.0, 20.0), 1e-30),
        ("cos(deg(90 * x))", (0.0, 1.0), 0.05),
        ("x^5 - (1 - x)^7", (0.0, 1.0), 0.1),
        ("x^2.2", (1e-3, 1.0), 0.0),
        (
            "(x < 0.5) + 2 * (x >= 0.25) + min(x, 0.3) + max(x, 0.6)",
            (0.0, 1.0),
            0.0,
        ),
    ] {
        check_elementary(&gpu, text, range, floor);
    }
}

#[test]
fn twins_are_what_the_core_computes() {
    let Some(gpu) = adapter() else {
        return;
    };
    for term in brdf::terms().iter().filter(|term| term.wgsl.is_some()) {
        let (worst, typical, at) = measure(&gpu, term);
        println!("{:28} {worst:.1e} {typical:.1e}", term.name);
        assert!(
            worst <= RELATIVE && typical <= TYPICAL,
            "{}: {worst:e} at {at:?}, {typical:e} typically",
            term.name
        );
    }
}
