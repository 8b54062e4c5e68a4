//! Every term by itself: f64, f32 as printed, f32 stable.

use super::{Effort, Errors, Numbers, Row, opaque, time};
use crate::stress::{Precision, error, possible, ulps};
use crate::{naive, value};
use brdf::Term;

/// Arguments that the time of a call is averaged over.
const CALLS: usize = 256;

pub(super) fn rows(term: &'static Term, effort: Effort) -> Vec<Row> {
    let mut numbers = Numbers(1);
    let quadrature = term.cost > 10_000;
    let calls = if quadrature { 4 } else { CALLS };
    let mut draw = || -> Vec<f64> {
        loop {
            // Rounded, so that all variants get the same arguments.
            let argument = |param: &brdf::Param| f64::from(numbers.between(param.range) as f32);
            let args: Vec<f64> = term.params.iter().map(argument).collect();
            if possible(term, Precision::Single, &args) {
                return args;
            }
        }
    };
    let points: Vec<Vec<f64>> = (0..calls).map(|_| draw()).collect();
    let single: Vec<Vec<f32>> = points.iter().map(|args| narrow(args)).collect();
    let closed = value(term.name, &points[0]).is_some();
    let samples: Vec<Vec<f64>> = if closed {
        (0..effort.points).map(|_| draw()).collect()
    } else {
        points.clone()
    };

    let row = |variant: &str, precision: Precision, ns: f64, errors: Errors, error_unit| Row {
        group: term.name.into(),
        variant: variant.into(),
        precision: precision.name(),
        isa: "baseline",
        ns,
        limit_ratio: None,
        needs: None,
        max_ulp: errors.max,
        p999_ulp: errors.p999,
        median_ulp: errors.median,
        error_unit,
        pareto: false,
    };
    let double = time(effort, calls, || {
        for args in &points {
            opaque((term.f64)(opaque(args)));
        }
    });
    let time_single = |f: fn(&[f32]) -> f32| {
        time(effort, calls, || {
            for args in &single {
                opaque(f(opaque(args)));
            }
        })
    };
    if !closed {
        // Without a closed form single precision is measured against double.
        let relative = |args: &Vec<f64>| {
            let truth = (term.f64)(args);
            (f64::from((term.f32)(&narrow(args))) - truth).abs() / truth.abs()
        };
        let errors = Errors::of(samples.iter().map(relative).collect());
        return vec![
            row(
                "quadrature",
                Precision::Double,
                double,
                Errors::default(),
                "none",
            ),
            row(
                "quadrature",
                Precision::Single,
                time_single(term.f32),
                errors,
                "relative",
            ),
        ];
    }
    let of = |precision| {
        Errors::of(
            samples
                .iter()
                .map(|args| error(term, precision, args))
                .collect(),
        )
    };
    let mut rows = vec![
        row(
            "f64",
            Precision::Double,
            double,
            of(Precision::Double),
            "ulp of f64",
        ),
        row(
            "stable",
            Precision::Single,
            time_single(term.f32),
            of(Precision::Single),
            "ulp",
        ),
    ];
    if let Some(form) = naive::form(term.name) {
        let error = |args: &Vec<f64>| {
            let truth = value(term.name, args)?;
            Some(ulps(
                &truth,
                f64::from(form(&narrow(args))),
                Precision::Single,
            ))
        };
        let errors = Errors::of(samples.iter().filter_map(error).collect());
        rows.push(row(
            "naive",
            Precision::Single,
            time_single(form),
            errors,
            "ulp",
        ));
    }
    rows
}

fn narrow(args: &[f64]) -> Vec<f32> {
    args.iter().map(|&x| x as f32).collect()
}
