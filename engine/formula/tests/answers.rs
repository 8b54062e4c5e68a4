//! What a learner may type.

mod common;

use common::{told, values};
use formula::parse_answer;

#[track_caller]
fn answer(text: &str, expected: f64) {
    let names = ["n_dot_l", "n_dot_v", "alpha"];
    let given = [("n_dot_l", 0.6), ("n_dot_v", 0.8), ("alpha", 0.16)];
    let expr = parse_answer(text, &names).unwrap_or_else(|error| panic!("{text}: {error}"));
    let value = formula::Library::new().eval(&expr, &values(&given));
    assert_eq!(value, Ok(expected), "{text}");
}

#[test]
fn a_learner_may_type_arithmetic() {
    let rows = [
        ("0.56", 0.56),
        ("0,56", 0.56),
        (" 0,56 ", 0.56),
        ("−0,56", -0.56),
        ("-,5", -0.5),
        ("5,6e-1", 0.56),
        ("1,234", 1.234),
        ("= 0.56", 0.56),
        ("≈0,5", 0.5),
        ("5.6e-1", 0.56),
        ("0.4^4", 0.4_f64.powi(4)),
        ("1/pi", 1.0 / std::f64::consts::PI),
        ("1/π", 1.0 / std::f64::consts::PI),
        ("1/(4*n_dot_l*n_dot_v)", 1.0 / (4.0 * 0.6 * 0.8)),
        ("NdotL", 0.6),
        ("N·L × 2", 1.2),
        ("Alpha", 0.16),
        ("α²", 0.16 * 0.16),
        ("max(0, 5)", 5.0),
        ("sqrt(0.25)", 0.5),
        ("√0.25", 0.5),
    ];
    for (text, expected) in rows {
        answer(text, expected);
    }
}

#[test]
fn a_learner_is_told_what_to_do_instead() {
    let rows = [
        (
            "v_ggx()",
            "v_ggx()",
            "v_ggx(…) would give the answer away; put numbers in and work it out",
        ),
        (
            "1 + d_ggx",
            "d_ggx",
            "d_ggx would give the answer away; put numbers in and work it out",
        ),
        (
            "n_dot_x",
            "n_dot_x",
            "unknown name \"n_dot_x\"; did you mean n_dot_l?",
        ),
        (
            "foo",
            "foo",
            "unknown name \"foo\"; known here: n_dot_l, alpha",
        ),
        ("foo(1)", "foo(1)", "unknown function \"foo\""),
        (
            "alpha(2)",
            "alpha(2)",
            "alpha is a number, not a function; write the product with *",
        ),
        (
            "2 n_dot_l",
            "2 n_dot_l",
            "\"2 n_dot_l\": write the product with *",
        ),
        (
            "0,4^4",
            ",",
            "expected an operator or the end, found \",\"; write decimals with a point in arithmetic, as in 0.4^4",
        ),
        (
            "1 < 2",
            "1 < 2",
            "an answer is one number, not a comparison",
        ),
        (
            "47.9 %",
            "%",
            "'%' has no meaning in a formula; write a share as a number, 0.479 or 47.9/100",
        ),
        (
            "  = 2 +",
            "",
            "expected a number, a name or \"(\", found the end",
        ),
        (
            "sqrt(a = 2)",
            "2",
            "sqrt takes its arguments without names; write sqrt(x)",
        ),
    ];
    for (text, under, said) in rows {
        told(text, parse_answer(text, &["n_dot_l", "alpha"]), under, said);
    }
}

#[test]
fn a_name_may_be_typed_as_it_is_printed() {
    let given = [("light_deg", 60.0), ("ior", 1.5), ("f0", 0.04)];
    let names = ["light_deg", "ior", "f0"];
    for (text, expected) in [("β / 2", 30.0), ("n - 1", 0.5), ("1 - F0", 0.96)] {
        let expr = parse_answer(text, &names).unwrap_or_else(|error| panic!("{text}: {error}"));
        let value = formula::Library::new().eval(&expr, &values(&given));
        assert_eq!(value, Ok(expected), "{text}");
    }
    // A name that is given means itself.
    let own = parse_answer("n", &["ior", "n"]).expect("a name");
    let value = formula::Library::new().eval(&own, &values(&[("ior", 1.5), ("n", 7.0)]));
    assert_eq!(value, Ok(7.0));
    let error = parse_answer("zzz", &names).expect_err("no such name");
    assert_eq!(
        error.to_string(),
        "unknown name \"zzz\"; known here: light_deg (β), ior (n), f0"
    );
}
