//! What may not be written, and what is said about it.

mod common;

use common::{GIVEN, library, told, values};
use formula::{Error, parse};

fn names() -> Vec<&'static str> {
    GIVEN.iter().map(|(name, _)| *name).collect()
}

#[test]
fn what_cannot_be_read_is_pointed_at() {
    let rows = [
        ("", "", "expected a formula, found nothing"),
        (
            "1 +",
            "",
            "expected a number, a name or \"(\", found the end",
        ),
        (
            "(1 + 2",
            "",
            "expected \")\", found the end; it closes the \"(\" at column 1",
        ),
        (
            "1 + 2)",
            ")",
            "expected an operator or the end, found \")\"",
        ),
        (
            "2 n_dot_l",
            "2 n_dot_l",
            "\"2 n_dot_l\": write the product with *",
        ),
        ("(1)(2)", "(1)(", "\"(1) (…)\": write the product with *"),
        (
            "2 * sqrt 3",
            "sqrt 3",
            "sqrt needs its argument in parentheses; write sqrt(…)",
        ),
        (
            "n_dot_l 2",
            "n_dot_l 2",
            "\"n_dot_l 2\": write the product with *",
        ),
        (
            "2 * / 3",
            "/",
            "expected a number or a name before it, found \"/\"",
        ),
        (
            "x = 2",
            "=",
            "expected an operator or the end, found \"=\"; = names an argument, == compares",
        ),
        (
            "1 < 2 < 3",
            "<",
            "a comparison cannot be chained; multiply two comparisons to ask for both",
        ),
        ("a # b", "#", "'#' has no meaning in a formula"),
        (
            "[1]",
            "[",
            "'[' has no meaning in a formula; group with ( and )",
        ),
        ("1.2.3", "1.2", "a number has one decimal point"),
        ("1e999", "1e999", "1e999 is too large for a number"),
        ("s(c = 1, c = 2)", "c", "argument c is given twice"),
        (
            "s(c = 1",
            "",
            "expected \")\", found the end; it closes the \"(\" at column 2",
        ),
        (
            "cos²(1)",
            "cos²",
            "write the power behind the call: cos(…)^2",
        ),
    ];
    for (text, under, said) in rows {
        told(text, parse(text), under, said);
    }
}

#[test]
fn what_is_not_known_is_pointed_at_with_a_guess() {
    let rows = [
        (
            "n_dot_hh",
            "n_dot_hh",
            "unknown name \"n_dot_hh\"; did you mean n_dot_h?",
        ),
        (
            "1 + NdotH",
            "NdotH",
            "unknown name \"NdotH\"; did you mean n_dot_h?",
        ),
        (
            "visibility",
            "visibility",
            "visibility is a formula, not a number; write visibility()",
        ),
        (
            "d_ggx",
            "d_ggx",
            "d_ggx is a function, not a number; write d_ggx()",
        ),
        (
            "sqrt",
            "sqrt",
            "sqrt needs its argument in parentheses; write sqrt(…)",
        ),
        (
            "2 * visiblity()",
            "visiblity()",
            "unknown function \"visiblity\"; did you mean visibility?",
        ),
        (
            "n_dot_l(1 - f0)",
            "n_dot_l(1 - f0)",
            "n_dot_l is a number, not a function; write the product with *",
        ),
        (
            "d_ggx(0.9, 0.2)",
            "0.9",
            "d_ggx takes its arguments by name; write d_ggx(n_dot_h = …, alpha = …)",
        ),
        (
            "integral_d_ggx(0.16)",
            "0.16",
            "integral_d_ggx takes its arguments by name; write integral_d_ggx(alpha = …)",
        ),
        (
            "d_ggx(n_dot_x = 0.9)",
            "0.9",
            "d_ggx has no argument n_dot_x; did you mean n_dot_h?",
        ),
        (
            "d_ggx(alpha = 0.1, roughness = 0.2)",
            "d_ggx(alpha = 0.1, roughness = 0.2)",
            "both roughness and alpha are given; give one of them: alpha = roughness^2",
        ),
        (
            "sqrt(x = 2)",
            "2",
            "sqrt takes its arguments without names; write sqrt(x)",
        ),
        (
            "sqrt(1, 2)",
            "sqrt(1, 2)",
            "sqrt takes one, found 2 arguments; write sqrt(x)",
        ),
        (
            "gsf_duer()",
            "gsf_duer()",
            "gsf_duer needs l_dot_v, which is not given here; write gsf_duer(l_dot_v = …)",
        ),
    ];
    for (text, under, said) in rows {
        let expr = parse(text).unwrap_or_else(|error| panic!("{text}: {error}"));
        let errors = library().check_expr(&expr, &names());
        assert_eq!(errors.len(), 1, "{text}: {errors:?}");
        told(
            text,
            errors.into_iter().next().map_or(Ok(()), Err),
            under,
            said,
        );
        told(text, library().eval(&expr, &values(GIVEN)), under, said);
    }
}

#[test]
fn a_value_outside_a_domain_is_pointed_at() {
    let rows = [
        ("1 + 1 / zero", "zero", "division by zero"),
        (
            "d_ggx(n_dot_h = 3 / 2)",
            "3 / 2",
            "n_dot_h = 1.5 is no cosine",
        ),
        ("d_ggx(alpha = -0.1)", "-0.1", "alpha = -0.1 is negative"),
        (
            "2 * ln(-1)",
            "ln(-1)",
            "ln(-1): a logarithm needs more than 0",
        ),
        (
            "sqrt(n_dot_l - 1)",
            "sqrt(n_dot_l - 1)",
            "sqrt(-0.4): the root of a negative number",
        ),
        ("acos(2)", "acos(2)", "acos(2): needs a number from -1 to 1"),
        (
            "(-8)^0.5",
            "(-8)^0.5",
            "(-8)^0.5: a negative number has only whole powers",
        ),
        ("zero^-1", "zero^-1", "0 to a negative power"),
        (
            "1e200 * 1e200",
            "1e200 * 1e200",
            "the value is too large for f64",
        ),
        (
            "d_ggx(n_dot_h = 1, alpha = 0)",
            "d_ggx(n_dot_h = 1, alpha = 0)",
            "d_ggx(n_dot_h = 1, alpha = 0) has no finite value",
        ),
        (
            "3 * divided_twice(n_dot_l = 0)",
            "divided_twice(n_dot_l = 0)",
            "in divided_twice: division by zero; it comes from visibility() / (4 * n_dot_l * n_…",
        ),
    ];
    for (text, under, said) in rows {
        let expr = parse(text).unwrap_or_else(|error| panic!("{text}: {error}"));
        told(text, library().eval(&expr, &values(GIVEN)), under, said);
    }
    let large = parse("1e30 * 1e30").expect("a formula");
    told(
        "1e30 * 1e30",
        library().eval_f32(&large, &values(GIVEN)),
        "1e30 * 1e30",
        "the value is too large for f32",
    );
}

#[test]
fn libraries_are_checked() {
    let mut library = library();
    let at = |error: Error| (error.span.start, error.to_string());
    let refused = [
        (
            "d_ggx",
            "d_ggx is a function of the core; choose another name; `core` says which one a formula must equal",
        ),
        ("sqrt", "sqrt is part of the language; choose another name"),
        ("s", "s is defined twice"),
        (
            "2x",
            "\"2x\" is not a name: letters, digits and single _, a letter first",
        ),
    ];
    for (name, said) in refused {
        let error = library.define(name, &["c"], "c").expect_err(name);
        assert_eq!(at(error).1, said);
    }
    let rows: [(&str, &[&str], &str); 6] = [
        ("bad", &["c"], "c + roghness"),
        ("ping", &["c"], "2 * pong()"),
        ("pong", &["c"], "ping() + 1"),
        ("self_made", &[], "self_made()"),
        ("given", &["c"], "c * d_ggx()"),
        ("lost", &["c"], "c * nothing(x = 1)"),
    ];
    for (name, params, text) in rows {
        library.define(name, params, text).expect(name);
    }
    let found: Vec<String> = library
        .check()
        .into_iter()
        .map(|(name, error)| format!("{name} {}..{} {error}", error.span.start, error.span.end))
        .collect();
    let expected = [
        "bad 4..12 unknown name \"roghness\"; a formula sees only its own arguments: add it to them",
        "lost 4..18 unknown function \"nothing\"",
        "ping 4..10 ping is defined by itself: ping → pong → ping",
        "self_made 0..11 self_made is defined by itself: self_made → self_made",
    ];
    assert_eq!(found, expected);
}

#[test]
fn depth_and_length_are_limited() {
    let rows = [
        "(".repeat(4000),
        "-".repeat(4000),
        "√".repeat(1200),
        format!("{}1{}", "(".repeat(500), ")".repeat(500)),
        "1+".repeat(1500) + "1",
        "2^".repeat(1500) + "2",
        "x²".to_string() + &"²".repeat(1000),
        "s(c=".repeat(900),
        "1".repeat(5000),
        "°".repeat(1000),
        "1".to_string() + &"°".repeat(1000),
    ];
    for text in rows {
        assert!(
            parse(&text).is_err(),
            "{}…",
            text.chars().take(20).collect::<String>()
        );
    }
}

#[test]
fn a_formula_that_doubles_itself_is_refused_at_once() {
    let mut library = formula::Library::new();
    library.define("f0x", &["x"], "x + 1").expect("f0x");
    for level in 1..40 {
        let text = format!("f{0}x(x = 2 * x) + f{0}x(x = 3 * x)", level - 1);
        library
            .define(&format!("f{level}x"), &["x"], &text)
            .expect("a definition");
    }
    let expr = parse("f39x(x = 1)").expect("a call");
    let error = library.eval(&expr, &values(&[])).expect_err("too large");
    assert!(error.message.contains("more than"), "{error}");
    assert!(!library.check().is_empty());
    // Sharing keeps this one small: every level calls the same thing twice.
    let mut library = formula::Library::new();
    library.define("g0x", &["x"], "x / 2").expect("g0x");
    for level in 1..40 {
        let text = format!("g{0}x() + g{0}x()", level - 1);
        library
            .define(&format!("g{level}x"), &["x"], &text)
            .expect("a definition");
    }
    let expr = parse("g39x(x = 2)").expect("a call");
    assert_eq!(library.eval(&expr, &values(&[])), Ok(2_f64.powi(39)));
}
