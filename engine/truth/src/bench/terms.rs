//! Every term by itself: f64, f32 as printed, f32 stable, and in lanes.

use super::{Effort, Numbers, Row, opaque, time};
use crate::stress::{Precision, error_against, possible, ulps};
use crate::{Big, albedo, naive, value};
use brdf::Term;
use brdf::batch::Isa;

/// Arguments that the time of a call is averaged over.
const CALLS: usize = 256;
/// The same of a batch, so that what begins and ends a loop weighs little.
const LANES: usize = 1024;
/// Points at which single precision is measured: enough for one in a thousand to mean something.
const POINTS: usize = 4096;
/// Terms that cost more are quadratures.
const QUADRATURE: u32 = 10_000;

pub(super) fn rows(term: &'static Term, effort: Effort) -> Vec<Row> {
    let mut numbers = Numbers(1);
    let mut draw = || -> Vec<f64> {
        loop {
            // Rounded, so that all variants get the same arguments.
            let argument = |param: &brdf::Param| f64::from(numbers.between(param.range) as f32);
            let args: Vec<f64> = term.params.iter().map(argument).collect();
            if possible(term.params, Precision::Single, &args) {
                return args;
            }
        }
    };
    if term.cost > QUADRATURE {
        return quadrature(term, effort, &[0; 4].map(|_| draw()));
    }
    let samples: Vec<Vec<f64>> = (0..effort.points.max(POINTS)).map(|_| draw()).collect();
    let points = &samples[..CALLS];
    let single: Vec<Vec<f32>> = points.iter().map(|args| narrow(args)).collect();
    let truths: Vec<(usize, Big)> = (0..effort.points)
        .filter_map(|i| Some((i, value(term.name, &samples[i])?)))
        .collect();
    let errors = |truths: &[(usize, Big)], precision, result: &dyn Fn(usize) -> f64| {
        let error = |(i, truth): &(usize, Big)| {
            error_against(truth, term, precision, &samples[*i], result(*i))
        };
        truths.iter().map(error).collect::<Vec<f64>>()
    };
    let exact = truths.clone();
    let in_double = |result: &dyn Fn(usize) -> f64| errors(&exact, Precision::Double, result);
    let double = in_double(&|i| (term.f64)(&samples[i]));
    // Double precision, just measured, is truth enough for single at the rest of the points.
    let rest = (effort.points..samples.len()).filter_map(|i| {
        let value = (term.f64)(&samples[i]);
        value.is_finite().then(|| (i, Big::new(value, 64)))
    });
    let truths: Vec<(usize, Big)> = truths.into_iter().chain(rest).collect();
    let errors = |result: &dyn Fn(usize) -> f64| errors(&truths, Precision::Single, result);

    let ns = time(effort, CALLS, || {
        for args in points {
            opaque((term.f64)(opaque(args)));
        }
    });
    let call = |f: fn(&[f32]) -> f32| {
        time(effort, CALLS, || {
            for args in &single {
                opaque(f(opaque(args)));
            }
        })
    };
    let mut rows = vec![
        Row::new(term.name, "f64", ns)
            .in_precision("f64")
            .with_errors("ulp of f64", double),
    ];
    if let Some(form) = naive::form(term.name) {
        let error = |(i, truth): &(usize, Big)| {
            let result = f64::from(form(&narrow(&samples[*i])));
            ulps(truth, result, Precision::Single)
        };
        let errors = truths.iter().map(error).collect();
        rows.push(Row::new(term.name, "naive", call(form)).with_errors("ulp", errors));
    }
    let stable = errors(&|i| f64::from((term.f32)(&narrow(&samples[i]))));
    rows.push(Row::new(term.name, "stable", call(term.f32)).with_errors("ulp", stable));
    let columns: Vec<Vec<f64>> = (0..term.params.len())
        .map(|i| samples.iter().map(|args| args[i]).collect())
        .collect();
    let doubles: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
    let narrowed: Vec<Vec<f32>> = columns.iter().map(|column| narrow(column)).collect();
    let singles: Vec<&[f32]> = narrowed.iter().map(Vec::as_slice).collect();
    let (mut out, mut out_double) = (vec![0.0; samples.len()], vec![0.0; samples.len()]);
    for isa in Isa::available() {
        (term.f64_block)(isa, &doubles, &mut out_double);
        let errors_double = in_double(&|i| out_double[i]);
        let ns = time(effort, LANES, || {
            (term.f64_block)(isa, opaque(&doubles), opaque(&mut out_double[..LANES]));
        });
        let row = Row::new(term.name, "batch", ns)
            .in_precision("f64")
            .on(isa.name());
        rows.push(row.with_errors("ulp of f64", errors_double));
        (term.f32_block)(isa, &singles, &mut out);
        let errors = errors(&|i| f64::from(out[i]));
        let ns = time(effort, LANES, || {
            (term.f32_block)(isa, opaque(&singles), opaque(&mut out[..LANES]));
        });
        let row = Row::new(term.name, "batch", ns).on(isa.name());
        rows.push(row.with_errors("ulp", errors));
    }
    rows
}

/// What has no closed form is measured against another quadrature, or what it should come to.
fn quadrature(term: &'static Term, effort: Effort, points: &[Vec<f64>]) -> Vec<Row> {
    let single: Vec<Vec<f32>> = points.iter().map(|args| narrow(args)).collect();
    let double = time(effort, points.len(), || {
        for args in points {
            opaque((term.f64)(opaque(args)));
        }
    });
    let ns = time(effort, points.len(), || {
        for args in &single {
            opaque((term.f32)(opaque(args)));
        }
    });
    let truth = |args: &Vec<f64>| match term.name {
        "integral_g1_d_ggx" => Some(1.0),
        name => albedo::value(name, args),
    };
    let truths: Vec<Option<f64>> = points.iter().map(truth).collect();
    let errors = |result: &dyn Fn(usize) -> f64| {
        let relative = |(i, truth): (usize, &Option<f64>)| {
            truth.map(|truth| (result(i) - truth).abs() / truth)
        };
        truths.iter().enumerate().filter_map(relative).collect()
    };
    let in_double = errors(&|i| (term.f64)(&points[i]));
    let in_single = errors(&|i| f64::from((term.f32)(&single[i])));
    vec![
        Row::new(term.name, "quadrature", double)
            .in_precision("f64")
            .with_errors("relative", in_double),
        Row::new(term.name, "quadrature", ns).with_errors("relative", in_single),
    ]
}

fn narrow(args: &[f64]) -> Vec<f32> {
    args.iter().map(|&x| x as f32).collect()
}
