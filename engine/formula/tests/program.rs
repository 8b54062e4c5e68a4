//! Compiled programs give what the tree gives, and quotients lose their common factors.

mod common;

use brdf::batch::Isa;
use common::{library, values};
use formula::{Column, Scratch, parse};

const NAMES: &[&str] = &[
    "n_dot_h",
    "n_dot_l",
    "n_dot_v",
    "v_dot_h",
    "roughness",
    "f0",
];

/// A point of the unit cube that is never on its border.
fn point(index: usize) -> Vec<f64> {
    let steps = [0.7549, 0.5698, 0.4302, 0.8191, 0.6711, 0.2345];
    steps
        .iter()
        .map(|step| 0.05 + 0.9 * (step * (index + 1) as f64).fract())
        .collect()
}

#[track_caller]
fn check(text: &str) {
    let library = library();
    let expr = parse(text).unwrap_or_else(|error| panic!("{text}: {error}"));
    let program = library
        .compile(&expr, NAMES)
        .unwrap_or_else(|error| panic!("{text}: {error}"));
    let count = 1500;
    let points: Vec<Vec<f64>> = (0..count).map(point).collect();
    let columns: Vec<Vec<f64>> = (0..NAMES.len())
        .map(|name| points.iter().map(|point| point[name]).collect())
        .collect();
    let mut out = vec![0.0; count];
    // Roughness once as a column and once as one number, on every set of instructions.
    let ways = Isa::available()
        .into_iter()
        .flat_map(|isa| [(isa, false), (isa, true)]);
    for (isa, uniform) in ways {
        let mut scratch = Scratch::on(isa);
        let mut inputs: Vec<Column<f64>> = columns.iter().map(|c| Column::Varying(c)).collect();
        if uniform {
            inputs[4] = Column::Uniform(0.4);
        }
        program.eval_block_f64(&inputs, &mut out, &mut scratch);
        for (index, point) in points.iter().enumerate().step_by(97) {
            let mut point = point.clone();
            if uniform {
                point[4] = 0.4;
            }
            assert_eq!(out[index], program.eval(&point), "{text} at {point:?}");
            let rows: Vec<_> = NAMES.iter().copied().zip(point.iter().copied()).collect();
            let value = library.eval(&expr, &values(&rows));
            assert_eq!(Ok(out[index] + 0.0), value, "{text} at {point:?}");
        }
    }
    let narrow: Vec<Vec<f32>> = columns
        .iter()
        .map(|column| column.iter().map(|value| *value as f32).collect())
        .collect();
    let inputs: Vec<Column<f32>> = narrow.iter().map(|c| Column::Varying(c)).collect();
    let mut out = vec![0.0; count];
    program.eval_block_f32(&inputs, &mut out, &mut Scratch::new());
    for (index, point) in points.iter().enumerate().step_by(97) {
        let rows: Vec<_> = NAMES.iter().copied().zip(point.iter().copied()).collect();
        let value = library.eval_f32(&expr, &values(&rows));
        assert_eq!(
            Ok(f64::from(out[index]) + 0.0),
            value,
            "{text} in f32 at {point:?}"
        );
    }
}

#[test]
fn blocks_are_points() {
    for text in [
        "0.5",
        "roughness",
        "-n_dot_l + 2 * roughness - roughness^2",
        "visibility()",
        "d()",
        "d_ggx() * visibility() * f_schlick() * n_dot_l",
        "d_ggx() * divided_twice() * f_schlick() * n_dot_l",
        "min(n_dot_l, n_dot_v, 0.3) / max(n_dot_l, n_dot_v)",
        "(n_dot_l < n_dot_v) * n_dot_h^5 + (n_dot_l >= n_dot_v) * n_dot_h^3",
        "sqrt(abs(sin(n_dot_h) * cos(n_dot_l) - tan(n_dot_v) * exp(f0)))",
        "acos(n_dot_h) + asin(n_dot_l) * atan(n_dot_v) - ln(f0) / log2(1 + f0)",
        "n_dot_h^7 - n_dot_h^-3 + n_dot_h^n_dot_l + n_dot_h^4",
        "specular_ggx() + specular_ggx(roughness = 0.5)",
        // Products that are done together with what reads them, on either side.
        "n_dot_h * n_dot_l + f0 * roughness",
        "f0 - n_dot_h * n_dot_l - (n_dot_v^2 - roughness^2)",
        "f0 / (n_dot_h * roughness) + n_dot_h * roughness / f0",
        "n_dot_h * n_dot_l * n_dot_v * (n_dot_h * n_dot_l)",
        "(n_dot_h * n_dot_l) * (n_dot_v * f0) * (roughness * roughness + 2 * roughness)",
        "n_dot_h * n_dot_l - n_dot_h * n_dot_l * roughness^2",
        // One value on both sides.
        "(n_dot_h * n_dot_l + f0) + (n_dot_h * n_dot_l + f0)",
        "sqrt(f0) - sqrt(f0) + min(n_dot_h^3, n_dot_h^3) * (n_dot_l^3 <= n_dot_l^3)",
        "(n_dot_h^3 / n_dot_h^3) * (n_dot_l^3 * n_dot_l^3)",
        // More chains at once than the machine holds, and operands that wait on either side.
        "((f0 + 1)^3 - (n_dot_h + 1)^3) / ((n_dot_l + 1)^3 - (n_dot_v + 2)^3)",
        "(((f0 + 1)^3 - (n_dot_h + 1)^3) / ((n_dot_l + 1)^3 - (n_dot_v + 2)^3) \
            - ((f0 + 2)^3 - (n_dot_h + 2)^3) / ((n_dot_l + 3)^3 - (n_dot_v + 4)^3)) \
            / (((f0 + 3)^3 + (n_dot_h + 5)^3) * ((n_dot_l + 6)^3 - (n_dot_v + 9)^3))",
        "sqrt(f0 + 1) - cos(n_dot_h^3) / sqrt(n_dot_l + 2) + d_ggx(n_dot_h = sqrt(n_dot_v)) * 2",
        "max(sqrt(n_dot_l), sqrt(n_dot_v)) - min(n_dot_h^3 + 1, f0^3 + 1) * -abs(f0 - 2)",
        "(sqrt(n_dot_l) < sqrt(n_dot_v)) + (n_dot_h^3 > f0^3) * 2 + roughness / (2 * n_dot_h)",
    ] {
        check(text);
    }
}

/// Several formulas in one program: each gives what it gives alone, whatever they share.
#[test]
fn formulas_share_a_program() {
    let library = library();
    let texts = [
        "d_ggx() * visibility() * n_dot_l",
        "n_dot_v",
        "d_ggx() * visibility() * n_dot_l / (4 * n_dot_l * n_dot_v)",
        "roughness / 2",
        "d_ggx() * visibility() * n_dot_l",
        "visibility()",
    ];
    let exprs = texts.map(|text| parse(text).expect("a formula"));
    let all: Vec<&formula::Expr> = exprs.iter().collect();
    let together = library.compile_all(&all, NAMES).expect("a program");
    let count = 700;
    let points: Vec<Vec<f64>> = (0..count).map(point).collect();
    let columns: Vec<Vec<f64>> = (0..NAMES.len())
        .map(|name| points.iter().map(|point| point[name]).collect())
        .collect();
    let mut inputs: Vec<Column<f64>> = columns.iter().map(|c| Column::Varying(c)).collect();
    inputs[4] = Column::Uniform(0.4);
    let mut values = vec![vec![0.0; count]; texts.len()];
    let mut outs: Vec<&mut [f64]> = values.iter_mut().map(|out| &mut out[..]).collect();
    let mut scratch = Scratch::new();
    together.eval_blocks_f64(&inputs, &mut outs, &mut scratch);
    for (expr, values) in exprs.iter().zip(&values) {
        let alone = library.compile(expr, NAMES).expect("a program");
        let mut out = vec![0.0; count];
        alone.eval_block_f64(&inputs, &mut out, &mut scratch);
        assert_eq!(values, &out, "{expr}");
    }
}

#[test]
fn shared_parts_are_computed_once() {
    let program = library().compile(&parse("d() + d()^2").expect("a formula"), NAMES);
    let program = program.expect("a program");
    let once = library().compile(&parse("d()").expect("a formula"), NAMES);
    let once = once.expect("a program");
    assert_eq!(program.ops(), once.ops() + 2);
}

#[test]
fn missing_columns_are_not_a_number_rather_than_a_panic() {
    let program = library().compile(&parse("n_dot_h * n_dot_l").expect("a formula"), NAMES);
    let program = program.expect("a program");
    let mut out = [0.0; 3];
    program.eval_block_f64(&[Column::Varying(&[1.0])], &mut out, &mut Scratch::new());
    assert!(out.iter().all(|value| value.is_nan()));
    assert!(program.eval(&[]).is_nan());
}

#[track_caller]
fn ratio(right: &str, wrong: &str, expected: Option<&str>) {
    let library = library();
    let (right, wrong) = (
        parse(right).expect("a formula"),
        parse(wrong).expect("a formula"),
    );
    let quotient = library
        .ratio(&right, &wrong)
        .map(|quotient| quotient.to_string());
    assert_eq!(quotient.as_deref(), expected);
}

#[test]
fn common_factors_cancel() {
    let double = Some("1 / (4 * n_dot_l * n_dot_v)");
    ratio("visibility()", "divided_twice()", double);
    ratio(
        "d_ggx() * visibility() * f_schlick() * n_dot_l",
        "d_ggx() * divided_twice() * f_schlick() * n_dot_l",
        double,
    );
    ratio("d() / pi", "d()", Some("pi"));
    ratio("n_dot_l * f0", "n_dot_l * f0", Some("1"));
    ratio("n_dot_l^2 * f0", "-n_dot_l * f0", Some("-(1 / n_dot_l)"));
    ratio("n_dot_l / n_dot_v", "1 / n_dot_v", Some("1 / n_dot_l"));
    ratio("d_ggx()", "d_ggx(alpha = roughness)", None);
    ratio("2 * n_dot_l", "2 * n_dot_v", None);
    ratio("n_dot_l", "unknown()", None);
}

#[test]
fn a_ratio_is_worth_what_it_stands_for() {
    let library = library();
    let right = parse("d_ggx() * visibility() * n_dot_l").expect("a formula");
    let given = values(&[
        ("roughness", 0.4),
        ("n_dot_h", 0.9),
        ("n_dot_l", 0.6),
        ("n_dot_v", 0.8),
    ]);
    let names: Vec<&str> = given.keys().map(String::as_str).collect();
    for mutant in library.mutants(&right) {
        let (wrong_library, wrong) = library.apply(&right, &mutant);
        // A ratio lives in one library: mutants of definitions have another one.
        if mutant.target().is_some() {
            continue;
        }
        let Some(quotient) = library.ratio_of(&right, &wrong, &names) else {
            continue;
        };
        let expected = wrong_library.eval(&wrong, &given).and_then(|wrong| {
            let right = library.eval(&right, &given)?;
            Ok(wrong / right)
        });
        let found = library.eval(&quotient, &given);
        if let (Ok(expected), Ok(found)) = (&expected, &found) {
            assert!(
                (expected - found).abs() <= 1e-14 * expected.abs(),
                "{}",
                mutant.id
            );
        }
        assert_eq!(expected.is_ok(), found.is_ok(), "{}: {quotient}", mutant.id);
    }
}

#[test]
fn the_canonical_form_does_not_know_spelling() {
    let library = library();
    let canonical = |text: &str| library.canonical(&parse(text).expect("a formula"));
    assert_eq!(canonical("0.50 * ( n_dot_l )"), canonical(".5*n_dot_l"));
    assert_eq!(
        canonical("visibility()/(4·n_dot_l*n_dot_v)"),
        canonical("divided_twice()")
    );
    assert_eq!(canonical("α²"), canonical("pow(alpha, 2)"));
    assert_ne!(canonical("n_dot_l"), canonical("n_dot_v"));
    assert_ne!(
        canonical("n_dot_l - n_dot_v"),
        canonical("n_dot_v - n_dot_l")
    );
}

#[test]
fn a_formula_without_inputs_is_the_same_at_every_point() {
    let expr = parse("1 + 2").expect("a formula");
    let program = library().compile(&expr, &[]).expect("a program");
    let (mut out, mut narrow) = (vec![0.0; 100], vec![0.0; 100]);
    program.eval_block_f64(&[], &mut out, &mut Scratch::new());
    program.eval_block_f32(&[], &mut narrow, &mut Scratch::new());
    assert_eq!((out, narrow), (vec![3.0; 100], vec![3.0; 100]));
}
