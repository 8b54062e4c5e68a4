//! What may be written and what it means.

mod common;

use common::{GIVEN, library, values};
use formula::parse;

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
