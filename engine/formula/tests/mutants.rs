//! The plausible mistakes of a formula: which there are, what they say, what they give.

mod common;

use common::{library, values};
use formula::{Mutant, parse};

const GIVEN: &[(&str, f64)] = &[
    ("roughness", 0.4),
    ("n_dot_h", 0.95),
    ("n_dot_l", 0.6),
    ("n_dot_v", 0.8),
    ("v_dot_h", 0.7),
    ("f0", 0.04),
    ("inner", 0.1206),
    ("a2", 0.0256),
    ("theta", 30.0),
];

fn distinct(text: &str) -> Vec<Mutant> {
    let expr = parse(text).unwrap_or_else(|error| panic!("{text}: {error}"));
    let ranges: Vec<_> = GIVEN.iter().map(|(name, _)| (*name, 0.1, 0.9)).collect();
    library().distinct_mutants(&expr, &ranges)
}

/// One mutant of a formula: its sentence and its value at the givens.
#[track_caller]
fn check(text: &str, id: &str, says: &str, wrong: &str) {
    let expr = parse(text).unwrap_or_else(|error| panic!("{text}: {error}"));
    let mutants = distinct(text);
    let Some(mutant) = mutants.iter().find(|mutant| mutant.id == id) else {
        let ids: Vec<_> = mutants.iter().map(|mutant| mutant.id.as_str()).collect();
        panic!("{text} has no {id} among {ids:#?}");
    };
    assert_eq!(mutant.says, says, "{text}");
    let given = values(GIVEN);
    let value = library()
        .eval_mutant(&expr, mutant, &given)
        .unwrap_or(f64::NAN);
    let wrong = parse(wrong).unwrap_or_else(|error| panic!("{wrong}: {error}"));
    let expected = library()
        .eval(&wrong, &given)
        .unwrap_or_else(|error| panic!("{error}"));
    assert!(
        (value - expected).abs() <= 1e-12 * expected.abs(),
        "{text}: {id} gives {value}, not {expected}"
    );
}

#[test]
fn each_kind_of_slip_is_found_and_told() {
    let rows = [
        (
            "roughness^2",
            "roughness-for-alpha:roughness",
            "Roughness was used where α = roughness² belongs.",
            "0.4",
        ),
        (
            "roughness^2",
            "doubled-not-squared:roughness",
            "The double of r was used instead of its square.",
            "0.8",
        ),
        (
            "d_ggx()",
            "roughness-for-alpha",
            "Roughness was used where α = roughness² belongs.",
            "d_ggx(alpha = 0.4)",
        ),
        (
            "d_ggx()",
            "square-doubled",
            "α = roughness² was squared once more before it was used.",
            "d_ggx(alpha = 0.4^4)",
        ),
        (
            "d()",
            "square-dropped@d:n_dot_h",
            "In d, the square on N·H was dropped.",
            "0.0256 / (pi * (0.95 * (0.0256 - 1) + 1)^2)",
        ),
        (
            "d()",
            "pi-lost@d:pi",
            "In d, the factor π was lost.",
            "d() * pi",
        ),
        (
            "a2 / (pi * inner^2)",
            "square-doubled:inner",
            "The square of inner was squared again.",
            "a2 / (pi * inner^4)",
        ),
        (
            "a2 / (pi * inner^2)",
            "bracket-lost:pi-inner2",
            "It was divided by π only: the brackets around π·inner² were lost.",
            "a2 / pi * inner^2",
        ),
        (
            "visibility()",
            "divided-twice:4-n_dot_l-n_dot_v",
            "It was divided by 4·N·L·N·V a second time.",
            "divided_twice()",
        ),
        (
            "visibility()",
            "factor-0.5-lost@visibility:0.5",
            "In visibility, the factor 0.5 was lost.",
            "2 * visibility()",
        ),
        (
            "visibility()",
            "arguments-swapped@visibility:s-c-n_dot_v-s-c-n_dot_l",
            "In visibility, s(N·V) and s(N·L) changed places.",
            "0.5 / (0.6 * s(c = 0.6) + 0.8 * s(c = 0.8))",
        ),
        (
            "visibility()",
            "sqrt-lost@s:alpha2-1-alpha2-c2",
            "In s, the square root of α² + (1 − α²)·c² was not taken.",
            "0.5 / (0.6 * s(c = 0.8)^2 + 0.8 * s(c = 0.6)^2)",
        ),
        (
            "visibility()",
            "sign-flipped@s:alpha2",
            "In s, plus stands before α² where minus belongs.",
            "0.5 / (0.6 * sqrt(0.0256 + 1.0256 * 0.64) + 0.8 * sqrt(0.0256 + 1.0256 * 0.36))",
        ),
        (
            "s(c = n_dot_v)",
            "other-dot-product:n_dot_l-for-n_dot_v",
            "N·L was used where N·V belongs.",
            "s(c = n_dot_l)",
        ),
        (
            "f_schlick()",
            "other-dot-product:f_schlick-n_dot_v-for-v_dot_h",
            "In F_Schlick, N·V was used where V·H belongs.",
            "f_schlick(v_dot_h = n_dot_v)",
        ),
        (
            "1 / (4 * n_dot_l * n_dot_v)",
            "factor-4-lost:4",
            "The factor 4 was lost.",
            "1 / (0.6 * 0.8)",
        ),
        (
            "1 / (4 * n_dot_l * n_dot_v)",
            "factor-2-lost:4-n_dot_l",
            "2 was used where 4 belongs.",
            "1 / (2 * 0.6 * 0.8)",
        ),
        (
            "v_ggx()",
            "other-function:g2_ggx-for-v_ggx",
            "G2 was used where V belongs.",
            "g2_ggx()",
        ),
        (
            "cos(deg(theta))",
            "degrees-for-radians:theta",
            "Degrees were used where radians belong: type `60°`, or set the calculator to degrees.",
            "cos(30)",
        ),
        (
            "f0 + (1 - f0) * (1 - v_dot_h)^5",
            "power-off:1-v_dot_h",
            "The power 4 was used where 5 belongs.",
            "0.04 + 0.96 * 0.3^4",
        ),
        (
            "f0 + (1 - f0) * (1 - v_dot_h)^5",
            "complement-lost:v_dot_h",
            "The \"1 −\" was lost: V·H stands where 1 − V·H belongs.",
            "0.04 + 0.96 * 0.7^5",
        ),
        (
            "d_ggx() * n_dot_l",
            "cosine-lost:n_dot_l",
            "The factor N·L was forgotten.",
            "d_ggx()",
        ),
    ];
    for (text, id, says, wrong) in rows {
        check(text, id, says, wrong);
    }
}

#[test]
fn distinct_mutants_differ_from_the_truth_and_from_each_other() {
    for text in [
        "visibility()",
        "d()",
        "d_ggx() * v_ggx() * f_schlick() * n_dot_l",
        "a2 / (pi * inner^2)",
    ] {
        let expr = parse(text).unwrap_or_else(|error| panic!("{error}"));
        let library = library();
        let given = values(GIVEN);
        let mutants = distinct(text);
        assert!(mutants.len() >= 5, "{text} has only {}", mutants.len());
        let mut found: Vec<f64> = mutants
            .iter()
            .filter_map(|mutant| library.eval_mutant(&expr, mutant, &given).ok())
            .chain(library.eval(&expr, &given))
            .collect();
        found.sort_by(f64::total_cmp);
        for pair in found.windows(2) {
            assert!(pair[1] - pair[0] > 1e-9 * pair[1].abs(), "{text}: {pair:?}");
        }
        let mut ids: Vec<_> = mutants.iter().map(|mutant| &mutant.id).collect();
        ids.sort();
        ids.dedup();
        assert_eq!(ids.len(), mutants.len(), "{text}");
    }
}

#[test]
fn a_symmetric_function_has_no_swapped_arguments() {
    let swapped = |text| {
        distinct(text)
            .iter()
            .any(|m| m.id.starts_with("arguments-swapped:"))
    };
    assert!(!swapped("v_ggx()"));
    assert!(swapped("gsf_modified_kelemen()"));
}
