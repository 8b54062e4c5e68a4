//! The WGSL of formulas: every module is read and validated by naga, without a GPU.

mod common;

use common::{library, module, valid};
use formula::{Library, parse};

/// Every name a formula of these tests may use.
const INPUTS: &[&str] = &[
    "n_dot_h",
    "n_dot_l",
    "n_dot_v",
    "v_dot_h",
    "roughness",
    "f0",
    "x",
];

#[track_caller]
fn check(library: &Library, text: &str, expected: &str) {
    let expr = parse(text).unwrap_or_else(|error| panic!("{text}: {error}"));
    let wgsl = library
        .wgsl(&expr, INPUTS)
        .unwrap_or_else(|error| panic!("{text}: {error}"));
    valid(&module(&[(&wgsl, INPUTS)]));
    assert_eq!(wgsl.expr, expected, "{text}");
}

#[track_caller]
fn refused(text: &str, expected: &str) {
    let expr = parse(text).unwrap_or_else(|error| panic!("{text}: {error}"));
    match library().wgsl(&expr, INPUTS) {
        Ok(wgsl) => panic!("{text} became {}", wgsl.expr),
        Err(error) => assert_eq!(error.message, expected, "{text}"),
    }
}

#[test]
fn expressions_become_wgsl() {
    let library = library();
    let rows = [
        ("1", "1.0"),
        ("2 * x", "2.0 * x"),
        ("-x", "(-x)"),
        ("x - -2", "x - (-2.0)"),
        ("1e-7 * x", "1e-7 * x"),
        ("x^2", "x * x"),
        ("x^5", "formula_pow5(x)"),
        ("(1 - x)^2", "formula_pow2(1.0 - x)"),
        ("x^-2 * 3", "1.0 / (x * x) * 3.0"),
        ("x / x^2", "x / (x * x)"),
        ("x^0.5", "sqrt(x)"),
        ("x^1.5", "pow(x, 1.5)"),
        ("x / pi", "x / 3.1415927"),
        ("2 / pi * x", "0.63661975 * x"),
        ("x < 0.5", "select(0.0, 1.0, x < 0.5)"),
        ("(x < 0.5) * 2", "select(0.0, 1.0, x < 0.5) * 2.0"),
        ("max(x, 0, 0.5)", "max(max(x, 0.0), 0.5)"),
        ("ln(x) + log2(x)", "log(x) + log2(x)"),
        ("cos(deg(x))", "cos(x * 0.017453292)"),
        (
            "acos(x) + asin(x) + atan(x)",
            "formula_acos(x) + formula_asin(x) + formula_atan(x)",
        ),
        ("x - (x - 1)", "x - (x - 1.0)"),
        ("x / (x / 2)", "x / (x / 2.0)"),
        ("d_ggx()", "lobe_d_ggx(n_dot_h, roughness * roughness)"),
        ("d_ggx(alpha = 0.5)", "lobe_d_ggx(n_dot_h, 0.5)"),
        ("s(c = n_dot_v)", "lesson_s(n_dot_v, roughness * roughness)"),
        (
            "visibility() * n_dot_l",
            "lesson_visibility(n_dot_l, n_dot_v, roughness * roughness) * n_dot_l",
        ),
    ];
    for (text, expected) in rows {
        check(&library, text, expected);
    }
}

#[test]
fn a_definition_is_passed_the_givens_it_uses() {
    let mut library = library();
    // Its own alpha hides none of what the inner call takes from the givens.
    library
        .define("lit", &["alpha"], "alpha * shade(c = 0.5)")
        .unwrap_or_else(|error| panic!("{error}"));
    library
        .define("shade", &["c"], "c * d_ggx() + c * f_schlick()")
        .unwrap_or_else(|error| panic!("{error}"));
    check(
        &library,
        "lit(alpha = 0.25)",
        "lesson_lit(0.25, f0, n_dot_h, roughness, v_dot_h)",
    );
}

#[test]
fn what_a_shader_cannot_do_is_refused() {
    refused("1e39 * x", "f32 cannot hold 1e39");
    refused("1e-39 * x", "f32 cannot hold 1e-39");
    refused("1e30 * 1e30 * x", "f32 cannot hold 1e60");
    refused("x + 1 / 0", "division by zero");
    refused(
        "albedo_ggx()",
        "albedo_ggx has no WGSL form: it is an integral",
    );
    refused("y", "unknown name \"y\"");
    let deep = format!("{}x{}", "sqrt(".repeat(60), ")".repeat(60));
    refused(&deep, "this is nested too deep for a shader");
}

#[test]
fn every_twin_of_the_core_is_valid() {
    for term in brdf::terms() {
        let names: Vec<&str> = term.params.iter().map(|param| param.name).collect();
        let expr = parse(&format!("{}()", term.name)).unwrap_or_else(|error| panic!("{error}"));
        match Library::new().wgsl(&expr, &names) {
            Ok(wgsl) => valid(&module(&[(&wgsl, &names)])),
            Err(error) => assert!(term.wgsl.is_none(), "{}: {error}", term.name),
        }
    }
}

#[test]
fn right_and_wrong_share_a_module() {
    let library = library();
    let right = parse("d_ggx() * visibility() * f_schlick() * n_dot_l");
    let right = right.unwrap_or_else(|error| panic!("{error}"));
    let first = library
        .wgsl(&right, INPUTS)
        .unwrap_or_else(|error| panic!("{error}"));
    for mutant in library.mutants(&right) {
        let (wrong, edited) = library.apply(&right, &mutant);
        let second = wrong
            .wgsl_prefixed(&edited, INPUTS, "wrong_")
            .unwrap_or_else(|error| panic!("{}: {error}", mutant.id));
        valid(&module(&[(&first, INPUTS), (&second, INPUTS)]));
    }
}
