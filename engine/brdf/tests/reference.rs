//! The core against values to 40 digits.

use brdf::term;
use serde_json::Value;
use std::collections::BTreeMap;

fn read(text: &str) -> Value {
    serde_json::from_str(text).expect("the reference is JSON")
}

fn number(value: &Value) -> f64 {
    let digits = value.as_str().expect("a number as text");
    digits.parse().expect("a number")
}

fn arguments(name: &str, args: &Value) -> Vec<f64> {
    let term = term(name).unwrap_or_else(|| panic!("no term {name}"));
    let args = args.as_object().expect("arguments by name");
    assert_eq!(args.len(), term.params.len(), "{name}");
    let value = |name: &str| args[name].as_f64().expect("an argument");
    term.params.iter().map(|param| value(param.name)).collect()
}

/// Error relative to the truth, 0 where both are below `tiny`.
fn relative(value: f64, truth: f64, tiny: f64) -> f64 {
    let error = (value - truth).abs();
    if error <= tiny {
        0.0
    } else {
        error / truth.abs()
    }
}

#[derive(Default)]
struct Worst(BTreeMap<String, (f64, String)>);

impl Worst {
    fn note(&mut self, name: &str, error: f64, at: String) {
        let entry = self
            .0
            .entry(name.to_owned())
            .or_insert((0.0, String::new()));
        if error > entry.0 || error.is_nan() {
            *entry = (error, at);
        }
    }

    #[track_caller]
    fn check(&self, bound: f64) {
        for (name, (error, at)) in &self.0 {
            println!("{name:26} {error:9.2e}  {at}");
        }
        let bad: Vec<_> = self
            .0
            .iter()
            .filter(|(_, (error, _))| *error > bound || error.is_nan())
            .collect();
        assert!(bad.is_empty(), "past {bound:e}: {bad:#?}");
    }
}

#[test]
fn terms_agree_in_double_precision() {
    let mut worst = Worst::default();
    for point in read(include_str!("reference/terms.json"))["points"]
        .as_array()
        .unwrap()
    {
        let name = point["fn"].as_str().unwrap();
        let args = arguments(name, &point["args"]);
        let value = (term(name).unwrap().f64)(&args);
        let truth = number(&point["value"]);
        worst.note(
            name,
            relative(value, truth, 1e-300),
            format!("{args:?}: {value:e}, not {truth:e}"),
        );
    }
    worst.check(1e-12);
}

#[test]
fn albedos_agree() {
    let columns = [
        ("albedo_ggx", "E_correlated"),
        ("albedo_ggx_separable", "E_separable"),
        ("albedo_ggx_divided_twice", "E_BUG_double_divide"),
    ];
    let (mut worst, mut single) = (Worst::default(), Worst::default());
    for row in read(include_str!("reference/albedo.json"))["rows"]
        .as_array()
        .unwrap()
    {
        for (name, column) in columns {
            let args = [
                row["n_dot_v"].as_f64().unwrap(),
                row["alpha"].as_f64().unwrap(),
            ];
            let term = term(name).unwrap();
            let truth = number(&row[column]);
            let note = |worst: &mut Worst, value: f64| {
                let at = format!("{args:?}: {value}, not {truth}");
                worst.note(name, relative(value, truth, 0.0), at);
            };
            note(&mut worst, (term.f64)(&args));
            // Of a mistake nobody asks 1e-5.
            if name != "albedo_ggx_divided_twice" {
                note(&mut single, f64::from((term.f32)(&args.map(|x| x as f32))));
            }
        }
    }
    worst.check(1e-9);
    single.check(1e-5);
}
