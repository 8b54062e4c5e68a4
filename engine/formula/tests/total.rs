//! No input makes anything here panic, hang or run out of stack.

mod common;

use brdf::batch::Isa;
use common::{library, module, valid, values};
use formula::{
    Column, Digits, Expr, Library, Program, Scratch, agrees_with_printed, format_number, parse,
    parse_answer, significant_digits,
};
use proptest::prelude::*;

const NAMES: &[&str] = &["n_dot_h", "n_dot_l", "n_dot_v", "roughness", "x"];

/// Everything that can be done with a tree.
fn use_up(library: &Library, expr: &Expr) {
    let rows: Vec<_> = NAMES.iter().map(|name| (*name, 0.5)).collect();
    let given = values(&rows);
    let checked = library.check_expr(expr, NAMES);
    let value = library.eval(expr, &given);
    assert!(checked.is_empty() || value.is_err(), "{expr}");
    if let Ok(value) = value {
        assert!(value.is_finite(), "{expr}");
        let board = library.substitution(expr, &given, Digits::Significant(4));
        let board = board.unwrap_or_else(|error| panic!("{expr}: {error}"));
        assert!(board.lines.len() <= 4, "{expr}");
        assert!(
            agrees_with_printed(value, &board.shown),
            "{expr}: {value} as {}",
            board.shown
        );
    }
    let _ = library.eval_f32(expr, &given);
    let _ = (
        library.unicode(expr),
        library.latex(expr),
        library.canonical(expr),
    );
    let _ = (library.needs(expr), library.uses(expr));
    if let Ok(wgsl) = library.wgsl(expr, NAMES) {
        valid(&module(&[(&wgsl, NAMES)]));
    }
    for mutant in library.mutants(expr).iter().take(3) {
        let _ = library.eval_mutant(expr, mutant, &given);
        let _ = library.ratio(expr, mutant.edited());
    }
    if let Ok(program) = library.compile(expr, NAMES) {
        let mut out = [0.0; 2];
        let inputs = [Column::Uniform(0.5); 5];
        program.eval_block_f64(&inputs, &mut out, &mut Scratch::new());
        if let Ok(value) = library.eval(expr, &given) {
            assert_eq!(out[0] + 0.0, value, "{expr}");
        }
        in_blocks(&program, expr);
    }
}

/// Every point of a block is what the program gives there alone, whatever lies on its way.
fn in_blocks(program: &Program, expr: &Expr) {
    let count = 150;
    let at = |input: usize, point: usize| match input {
        3 => 0.4,
        _ => 0.05 + 0.9 * ((0.7549 - 0.11 * input as f64) * (point + 1) as f64).fract(),
    };
    let columns: Vec<Vec<f64>> = (0..NAMES.len())
        .map(|input| (0..count).map(|point| at(input, point)).collect())
        .collect();
    let mut inputs: Vec<Column<f64>> = columns.iter().map(|it| Column::Varying(it)).collect();
    inputs[3] = Column::Uniform(0.4);
    let mut out = vec![0.0; count];
    for isa in Isa::available() {
        program.eval_block_f64(&inputs, &mut out, &mut Scratch::on(isa));
        for (point, out) in out.iter().enumerate().step_by(7) {
            let alone: Vec<f64> = (0..NAMES.len()).map(|input| at(input, point)).collect();
            let alone = program.eval(&alone);
            assert!(
                *out == alone || out.is_nan() && alone.is_nan(),
                "{expr} at {point} on {}: {out}, alone {alone}",
                isa.name()
            );
        }
    }
}

/// Printed and read again, a tree is the same.
fn round_trip(expr: &Expr) {
    let text = expr.to_string();
    let again = parse(&text).unwrap_or_else(|error| panic!("{text}: {error}"));
    assert!(again.same(expr), "{text} became {again}");
    assert_eq!(again.to_string(), text);
}

/// Texts that are formulas more often than not.
fn formula() -> impl Strategy<Value = String> {
    let leaf = prop_oneof![
        Just("0.5".to_string()),
        Just("2".to_string()),
        Just("1e-3".to_string()),
        Just("π".to_string()),
        Just("α".to_string()),
        Just("N·L".to_string()),
        (0..NAMES.len()).prop_map(|index| NAMES[index].to_string()),
        Just("d_ggx()".to_string()),
        Just("visibility()".to_string()),
        Just("unknown".to_string()),
    ];
    leaf.prop_recursive(6, 40, 3, |inner| {
        prop_oneof![
            (
                inner.clone(),
                inner.clone(),
                prop::sample::select(vec!["+", "-", "−", "*", "·", "/", "^", "<", "**"])
            )
                .prop_map(|(a, b, op)| format!("{a} {op} {b}")),
            inner.clone().prop_map(|a| format!("({a})")),
            inner.clone().prop_map(|a| format!("-{a}")),
            inner.clone().prop_map(|a| format!("({a})²")),
            inner.clone().prop_map(|a| format!("√({a})")),
            (
                inner.clone(),
                prop::sample::select(vec!["sqrt", "cos", "acos", "ln", "abs", "deg", "exp"])
            )
                .prop_map(|(a, name)| format!("{name}({a})")),
            (inner.clone(), inner.clone()).prop_map(|(a, b)| format!("max({a}, {b})")),
            inner.clone().prop_map(|a| format!("s(c = {a})")),
            inner.prop_map(|a| format!("d_ggx(n_dot_h = {a}, alpha = 0.3)")),
        ]
    })
}

/// Texts made of the language's own pieces, mostly nonsense.
fn nonsense() -> impl Strategy<Value = String> {
    let piece = prop::sample::select(vec![
        "(", ")", "+", "-", "*", "/", "^", "=", ",", "<", "²", "⁻", "√", "°", "π", "α", "N·H", "·",
        "1", "0.5", "1e", "e9", ".", "x", "sqrt", "d_ggx", "s", "c", " ", "∞", "%", "\u{202e}",
    ]);
    prop::collection::vec(piece, 0..40).prop_map(|pieces| pieces.concat())
}

fn total(text: &str) {
    let library = library();
    let _ = (significant_digits(text), agrees_with_printed(0.5, text));
    match parse(text) {
        Ok(expr) => {
            round_trip(&expr);
            use_up(&library, &expr);
        }
        Err(error) => {
            assert!(error.span.start <= error.span.end && error.span.end <= text.len());
            assert!(
                text.is_char_boundary(error.span.start) && text.is_char_boundary(error.span.end)
            );
            assert!(error.to_string().chars().count() < 300, "{error}");
        }
    }
    match parse_answer(text, NAMES) {
        Ok(expr) => {
            assert!(Library::new().check_expr(&expr, NAMES).is_empty(), "{text}");
        }
        Err(error) => {
            assert!(error.span.end <= text.len() && text.is_char_boundary(error.span.start));
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_text(text in "\\PC{0,60}") {
        total(&text);
    }

    #[test]
    fn any_pieces(text in nonsense()) {
        total(&text);
    }

    #[test]
    fn any_formula(text in formula()) {
        total(&text);
    }

    #[test]
    fn any_number(value in any::<f64>(), digits in 0_u32..25) {
        for digits in [Digits::Significant(digits), Digits::Decimals(digits)] {
            let text = format_number(value, digits);
            if value.is_finite() {
                prop_assert!(agrees_with_printed(value, &text), "{} as {}", value, text);
                prop_assert!(!text.starts_with("-"));
            }
        }
    }
}

#[test]
fn hard_texts() {
    let deep = |open: &str, close: &str, count: usize| {
        format!("{}x{}", open.repeat(count), close.repeat(count))
    };
    for text in [
        deep("(", ")", 40),
        deep("-", "", 40),
        deep("1/(1+", ")", 30),
        deep("max(1, ", ")", 45),
        deep("2^", "", 45),
        deep("√", "", 90),
        deep("s(c = ", ")", 40),
        "x*".repeat(90) + "x",
        "x".to_string() + &"²".repeat(90).replace("²²", "²^2"),
        "x".to_string() + "^1".repeat(45).as_str(),
        "1e308 * 10".to_string(),
        "x^0.5^1e300".to_string(),
        "1e-320 + x".to_string(),
        "x/0".to_string(),
        "0^-64 * x".to_string(),
        "x^64^2".to_string(),
        "\u{feff}x".to_string(),
    ] {
        total(&text);
    }
    total(&"9".repeat(1 << 20));
    total(&"(".repeat(1 << 20));
}
