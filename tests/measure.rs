//! What `stress` and `bench` print. Nothing here asserts a time.

mod common;

use common::{run, stderr, stdout};
use serde_json::Value;

#[test]
fn stress_prints_a_line_for_each_function_and_precision() {
    let output = run(&["stress", "--quick", "--json", "d_ggx", "f_schlick"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let text = stdout(&output);
    let mut seen = Vec::new();
    for line in text.lines() {
        let order = [
            "fn",
            "precision",
            "worst_ulp",
            "at",
            "bound",
            "nonfinite",
            "ok",
        ];
        let places: Vec<usize> = order
            .iter()
            .filter_map(|name| line.find(&format!("\"{name}\":")))
            .collect();
        assert!(places.len() == 7 && places.is_sorted(), "{line}");
        let found: Value = serde_json::from_str(line).expect("JSON");
        assert_eq!(found.as_object().map(|object| object.len()), Some(7));
        assert_eq!(
            (&found["ok"], &found["nonfinite"]),
            (&true.into(), &0.into())
        );
        let worst = found["worst_ulp"].as_f64().expect("a number");
        assert!(0.0 < worst && worst <= found["bound"].as_f64().expect("a number"));
        seen.push(format!("{} {}", found["precision"], found["fn"]).replace('"', ""));
        check_point(&found);
    }
    assert_eq!(
        seen,
        ["f32 d_ggx", "f32 f_schlick", "f64 d_ggx", "f64 f_schlick"]
    );
}

/// In single precision the printed point gives the printed error: double precision is truth
/// enough for it.
#[track_caller]
fn check_point(found: &Value) {
    if found["precision"] != "f32" {
        return;
    }
    let at: Vec<String> = found["at"]
        .as_object()
        .expect("an object")
        .iter()
        .map(|(name, value)| format!("{name} = {value}"))
        .collect();
    let call = format!(
        "{}({})",
        found["fn"].as_str().expect("a name"),
        at.join(", ")
    );
    let value = |precision: &str| {
        let printed = stdout(&run(&[
            "eval",
            "--json",
            "--precision",
            precision,
            "--",
            &call,
        ]));
        let object: Value = serde_json::from_str(&printed).expect("JSON");
        object["value"].as_f64().expect("a number")
    };
    let (single, double) = (value("f32"), value("f64"));
    let ulp = (double.abs().log2().floor() - 23.0).exp2();
    let error = (single - double).abs() / ulp;
    let worst = found["worst_ulp"].as_f64().expect("a number");
    assert!((error - worst).abs() < 1e-3, "{call}: {error}, not {worst}");
}

#[test]
fn stress_for_people_fits_the_screen_and_names_the_point() {
    let output = run(&["stress", "--quick", "g1_beckmann"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let text = stdout(&output);
    assert!(
        text.contains("g1_beckmann") && text.contains("n_dot_x="),
        "{text}"
    );
    assert!(
        text.lines().all(|line| line.chars().count() <= 120),
        "{text}"
    );
    assert_eq!(stderr(&output), "");
}

#[test]
fn stress_names_the_nearest_function() {
    let output = run(&["stress", "d_gxx"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("d_ggx"), "{}", stderr(&output));
    assert_eq!(stdout(&output), "");
}

#[test]
fn bench_says_at_once_where_it_cannot_write() {
    let output = run(&["bench", "--quick", "--out", "Cargo.toml"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(
        stderr(&output).contains("Cargo.toml"),
        "{}",
        stderr(&output)
    );
}
