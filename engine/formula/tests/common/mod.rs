//! The formulas of two lessons, for the tests.
#![allow(dead_code)]

use formula::{Library, Values};

pub fn library() -> Library {
    let mut library = Library::new();
    let rows: [(&str, &[&str], &str); 6] = [
        ("s", &["c", "alpha"], "sqrt(alpha^2 + (1 - alpha^2) * c^2)"),
        (
            "visibility",
            &["n_dot_l", "n_dot_v", "alpha"],
            "0.5 / (n_dot_l * s(c = n_dot_v) + n_dot_v * s(c = n_dot_l))",
        ),
        (
            "divided_twice",
            &["n_dot_l", "n_dot_v", "alpha"],
            "visibility() / (4 * n_dot_l * n_dot_v)",
        ),
        (
            "d",
            &["n_dot_h", "alpha"],
            "alpha^2 / (pi * (n_dot_h^2 * (alpha^2 - 1) + 1)^2)",
        ),
        (
            "crossing",
            &["alpha_a", "alpha_b"],
            "atan(sqrt(alpha_a * alpha_b)) * 180 / pi",
        ),
        (
            "slip",
            &["n_dot_l", "n_dot_v", "alpha"],
            "visibility(alpha = sqrt(alpha))",
        ),
    ];
    for (name, params, text) in rows {
        library
            .define(name, params, text)
            .unwrap_or_else(|error| panic!("{name}: {error}"));
    }
    assert_eq!(library.check(), []);
    library
}

pub fn values(rows: &[(&str, f64)]) -> Values {
    rows.iter()
        .map(|(name, value)| (name.to_string(), *value))
        .collect()
}
