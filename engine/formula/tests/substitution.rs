//! What stands on the board between a formula and its value.

mod common;

use common::{library, values};
use formula::{Digits, parse};

#[track_caller]
fn check(text: &str, given: &[(&str, f64)], digits: u32, expected: &[&str]) {
    let expr = parse(text).unwrap_or_else(|error| panic!("{text}: {error}"));
    let board = library()
        .substitution(&expr, &values(given), Digits::Significant(digits))
        .unwrap_or_else(|error| panic!("{text}: {error}"));
    let mut lines = board.lines;
    lines.push(format!("= {}", board.shown));
    if expected.is_empty() {
        eprintln!("{text}: {lines:#?}");
    } else {
        assert_eq!(lines, expected, "{text}");
    }
}

const SMITH: &[(&str, f64)] = &[("roughness", 0.4), ("n_dot_v", 0.8), ("n_dot_l", 0.6)];

#[test]
fn lines_read_like_a_board() {
    check("roughness^2", SMITH, 2, &["0.4²", "= 0.16"]);
    check(
        "alpha2 / (pi * d^2)",
        &[("alpha2", 0.0256), ("d", 0.120604)],
        3,
        &[
            "0.0256 / (π · 0.1206²)",
            "0.0256 / (π · 0.01455)",
            "0.0256 / 0.0457",
            "= 0.560",
        ],
    );
    check(
        "s(c = n_dot_v)",
        SMITH,
        4,
        &[
            "√(α² + (1 − α²)·c²)  with c = N·V, α = r²",
            "√(0.16² + (1 − 0.16²) · 0.8²)",
            "√(0.0256 + 0.9744 · 0.64)",
            "√0.64922",
            "= 0.8057",
        ],
    );
    check(
        "visibility()",
        SMITH,
        4,
        &[
            "0.5 / ((N·L)·s(N·V) + (N·V)·s(N·L))  with α = r²",
            "0.5 / (0.6 · 0.80574 + 0.8 · 0.6135)",
            "0.5 / (0.48344 + 0.4908)",
            "0.5 / 0.97424",
            "= 0.5132",
        ],
    );
    check("d(n_dot_h = 0.95)", SMITH, 3, &[]);
    check("d_ggx(n_dot_h = 0.95)", SMITH, 3, &[]);
    check("crossing(alpha_a = 0.4^2, alpha_b = 0.7^2)", SMITH, 3, &[]);
    check("slip()", SMITH, 4, &[]);
    check("100 * (1 - divided_twice() / visibility())", SMITH, 3, &[]);
    check("4 * n_dot_l * n_dot_v * 0.51321", SMITH, 3, &[]);
    check("cos(deg(60)) - 2", SMITH, 3, &[]);
    check("-roughness * (n_dot_l - 1)", SMITH, 3, &[]);
    check("0.5", SMITH, 3, &[]);
}
