//! The formulas of two lessons, for the tests.
#![allow(dead_code)]

use formula::{Error, Library, Values, Wgsl};

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

/// The givens of these tests.
pub const GIVEN: &[(&str, f64)] = &[
    ("roughness", 0.4),
    ("n_dot_h", 0.95),
    ("n_dot_l", 0.6),
    ("n_dot_v", 0.8),
    ("v_dot_h", 0.7),
    ("f0", 0.04),
    ("zero", 0.0),
];

/// The text under the span, and the whole of what is said.
#[track_caller]
pub fn told(text: &str, found: Result<impl std::fmt::Debug, Error>, under: &str, said: &str) {
    let Err(error) = found else {
        panic!("{text} is accepted: {found:?}");
    };
    let shown = text.get(error.span.start..error.span.end);
    assert_eq!(
        (shown, error.to_string().as_str()),
        (Some(under), said),
        "{text}"
    );
}

/// Reads and validates WGSL.
#[track_caller]
pub fn valid(source: &str) {
    let module = naga::front::wgsl::parse_str(source)
        .unwrap_or_else(|error| panic!("{}\n{source}", error.emit_to_string(source)));
    let flags = naga::valid::ValidationFlags::all();
    let capabilities = naga::valid::Capabilities::empty();
    let mut validator = naga::valid::Validator::new(flags, capabilities);
    if let Err(error) = validator.validate(&module) {
        panic!("{}\n{source}", error.emit_to_string(source));
    }
}

/// A module in which each formula is a function of its inputs.
pub fn module(formulas: &[(&Wgsl, &[&str])]) -> String {
    let all: Vec<&Wgsl> = formulas.iter().map(|(formula, _)| *formula).collect();
    let mut source = Wgsl::functions_of(&all);
    for (index, (formula, inputs)) in formulas.iter().enumerate() {
        let params: Vec<String> = inputs.iter().map(|name| format!("{name}: f32")).collect();
        let (params, expr) = (params.join(", "), &formula.expr);
        source.push_str(&format!(
            "fn whole{index}({params}) -> f32 {{\n    return {expr};\n}}\n"
        ));
    }
    source
}
