//! What may be written, what it means, and what is said about what may not.

mod common;

use common::{library, values};
use formula::{Error, parse, parse_answer};

const GIVEN: &[(&str, f64)] = &[
    ("roughness", 0.4),
    ("n_dot_h", 0.95),
    ("n_dot_l", 0.6),
    ("n_dot_v", 0.8),
    ("v_dot_h", 0.7),
    ("f0", 0.04),
    ("zero", 0.0),
];

fn names() -> Vec<&'static str> {
    GIVEN.iter().map(|(name, _)| *name).collect()
}

#[track_caller]
fn is(text: &str, expected: f64) {
    let expr = parse(text).unwrap_or_else(|error| panic!("{text}: {error}"));
    let value = library()
        .eval(&expr, &values(GIVEN))
        .unwrap_or_else(|error| panic!("{text}: {error}"));
    assert!(
        (value - expected).abs() <= 1e-14 * expected.abs(),
        "{text} = {value}, not {expected}"
    );
}

#[test]
fn values_are_what_a_reader_expects() {
    let rows = [
        // Powers go to the right and above the minus.
        ("2^3^2", 512.0),
        ("-2^2", -4.0),
        ("(-2)^2", 4.0),
        ("2^-1", 0.5),
        ("2^-2^2", 1.0 / 16.0),
        ("-3²", -9.0),
        ("2^3²", 512.0),
        ("8 - 4 - 2", 2.0),
        ("8 / 4 / 2", 1.0),
        ("2 * -3", -6.0),
        ("2 - -3", 5.0),
        ("+3", 3.0),
        // Signs of a blackboard.
        ("3 × 2 · 2 ⋅ 1", 12.0),
        ("5 − 2", 3.0),
        ("1 ÷ 4", 0.25),
        ("2⁻²", 0.25),
        ("√4 + √(9)", 5.0),
        ("cos(60°)", 0.5),
        ("2 ** 3", 8.0),
        ("N·H + n_dot_l", 1.55),
        ("V·N", 0.8),
        ("π", std::f64::consts::PI),
        // Numbers.
        ("5.6e-1", 0.56),
        (".5", 0.5),
        ("5.", 5.0),
        // Comparison is 0 or 1.
        ("(1 < 2) + (2 <= 2) + (3 ≥ 4)", 2.0),
        ("1 == 1", 1.0),
        ("1 != 1", 0.0),
        ("1 + 1 > 1", 1.0),
        // Elementary functions.
        ("pow(2, 10)", 1024.0),
        ("min(3, 1, 2) + max(1, 2)", 3.0),
        ("deg(180)", std::f64::consts::PI),
        ("exp(ln(2)) + log2(8)", 5.0),
        ("abs(-2)", 2.0),
        ("0^0", 1.0),
        // Scope: explicit beats implicit, alpha and roughness stand for each other.
        ("alpha", 0.4 * 0.4),
        ("s(c = n_dot_v)", 0.649_216_f64.sqrt()),
        (
            "visibility()",
            0.5 / (0.6 * 0.649_216_f64.sqrt() + 0.8 * 0.376_384_f64.sqrt()),
        ),
        (
            "visibility(roughness = 0.4) - visibility(alpha = 0.4 * 0.4)",
            0.0,
        ),
        (
            "visibility(n_dot_l = n_dot_v, n_dot_v = n_dot_l) - visibility()",
            0.0,
        ),
        ("specular_ggx() - specular_ggx(alpha = 0.4 * 0.4)", 0.0),
        ("abs(d_ggx() - d()) < 1e-15", 1.0),
    ];
    for (text, expected) in rows {
        is(text, expected);
    }
}

/// The text under the span, and the whole of what is said.
#[track_caller]
fn told(text: &str, found: Result<impl std::fmt::Debug, Error>, under: &str, said: &str) {
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
            "-8^0.5: a negative number has only whole powers",
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
fn single_precision_is_computed_in_single_precision() {
    let eval = |text: &str| {
        let expr = parse(text).expect("a formula");
        library().eval_f32(&expr, &values(GIVEN)).expect("a value")
    };
    assert_eq!(eval("0.1 + 0.2"), f64::from(0.1_f32 + 0.2_f32));
    assert_eq!(eval("1 / 3"), f64::from(1.0_f32 / 3.0));
    assert_eq!(eval("16777216 + 1"), 16_777_216.0);
    let term = brdf::term("d_ggx").expect("a term");
    assert_eq!(
        eval("d_ggx(alpha = 0.2)"),
        f64::from((term.f32)(&[0.95, 0.2]))
    );
}

#[test]
fn needs_are_the_givens() {
    let rows = [
        ("visibility()", "alpha n_dot_l n_dot_v"),
        ("visibility(roughness = 0.3, n_dot_l = 1)", "n_dot_v"),
        ("d_ggx() + roughness", "n_dot_h roughness"),
        ("d_ggx() + alpha", "alpha n_dot_h"),
        (
            "specular_ggx() / d_ggx()",
            "n_dot_h n_dot_l n_dot_v roughness",
        ),
        ("pi * 2", ""),
    ];
    for (text, expected) in rows {
        let needs: Vec<String> = library()
            .needs(&parse(text).expect(text))
            .into_iter()
            .collect();
        assert_eq!(needs.join(" "), expected, "{text}");
    }
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
        "ping 4..10 in pong: ping is defined by itself: ping → pong → ping",
        "pong 0..6 in ping: pong is defined by itself: pong → ping → pong",
        "self_made 0..11 self_made is defined by itself: self_made → self_made",
    ];
    assert_eq!(found, expected);
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
fn pretty_forms() {
    let rows = [
        (
            "alpha^2 / (pi * (n_dot_h^2 * (alpha^2 - 1) + 1)^2)",
            "α² / (π·((N·H)²·(α² − 1) + 1)²)",
            r"\frac{\alpha^{2}}{\pi \, \left(\left(\mathbf{N}\!\cdot\!\mathbf{H}\right)^{2} \, \left(\alpha^{2} - 1\right) + 1\right)^{2}}",
        ),
        (
            "1/(4*n_dot_l*n_dot_v)",
            "1 / (4·(N·L)·(N·V))",
            r"\frac{1}{4 \, \left(\mathbf{N}\!\cdot\!\mathbf{L}\right) \, \left(\mathbf{N}\!\cdot\!\mathbf{V}\right)}",
        ),
        (
            "1 - v_dot_h",
            "1 − V·H",
            r"1 - \mathbf{V}\!\cdot\!\mathbf{H}",
        ),
        (
            "-(a - b) * -c",
            "−(a − b)·(−c)",
            r"-\left(a - b\right) \, \left(-c\right)",
        ),
        ("a - (b - c)", "a − (b − c)", r"a - \left(b - c\right)"),
        (
            "a / (b / c) / d",
            "a / (b / c) / d",
            r"\frac{\frac{a}{\frac{b}{c}}}{d}",
        ),
        ("2^x^y + x^-1", "2^(x^y) + x⁻¹", r"2^{x^{y}} + x^{-1}"),
        (
            "sqrt(alpha) * sqrt(1 + x)^2",
            "√α·(√(1 + x))²",
            r"\sqrt{\alpha} \, \sqrt{1 + x}^{2}",
        ),
        ("cos(deg(60))", "cos(60°)", r"\cos\left(60^{\circ}\right)"),
        (
            "d_ggx() * s(c = n_dot_v)",
            "D_GGX·s(N·V)",
            r"D_{\mathrm{GGX}} \, s\left(\mathbf{N}\!\cdot\!\mathbf{V}\right)",
        ),
        (
            "d_ggx(n_dot_h = 1)",
            "D_GGX(N·H = 1)",
            r"D_{\mathrm{GGX}}\left(\mathbf{N}\!\cdot\!\mathbf{H} = 1\right)",
        ),
        (
            "alpha1 * alpha2 + a2",
            "α₁·α₂ + a2",
            r"\alpha_{1} \, \alpha_{2} + a_{2}",
        ),
        (
            "5.6e-1 * abs(x)",
            "5.6·10⁻¹·|x|",
            r"5.6 \cdot 10^{-1} \, \left|x\right|",
        ),
        ("a <= b", "a ≤ b", r"a \le b"),
    ];
    for (text, unicode, latex) in rows {
        let expr = parse(text).unwrap_or_else(|error| panic!("{text}: {error}"));
        assert_eq!(library().unicode(&expr), unicode, "{text}");
        assert_eq!(library().latex(&expr), latex, "{text}");
    }
}
