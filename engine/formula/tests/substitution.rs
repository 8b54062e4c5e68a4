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
    assert_eq!(lines, expected, "{text}");
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
    check(
        "d(n_dot_h = 0.95)",
        SMITH,
        3,
        &[
            "α² / (π·((N·H)²·(α² − 1) + 1)²)  with N·H = 0.95, α = r²",
            "0.16² / (π · (0.95² · (0.16² − 1) + 1)²)",
            "0.0256 / (π · (−0.8794 + 1)²)",
            "0.0256 / 0.0457",
            "= 0.560",
        ],
    );
    check(
        "d_ggx(n_dot_h = 0.95)",
        SMITH,
        3,
        &["D_GGX(N·H = 0.95, α = 0.16)", "= 0.560"],
    );
    check(
        "crossing(alpha_a = 0.4^2, alpha_b = 0.7^2)",
        SMITH,
        3,
        &[
            "atan(√(α_a·α_b))·180 / π  with α_a = 0.4², α_b = 0.7²",
            "atan(√(0.16 · 0.49)) · 180 / π",
            "atan(0.28) · 180 / π",
            "49.14 / π",
            "= 15.6",
        ],
    );
    // Alpha was put where alpha² belongs: the number says so, the letter would not.
    check(
        "slip()",
        SMITH,
        4,
        &[
            "0.5 / ((N·L)·s(N·V) + (N·V)·s(N·L))  with α = 0.4",
            "0.5 / (0.6 · 0.83522 + 0.8 · 0.68)",
            "0.5 / (0.50113 + 0.544)",
            "0.5 / 1.0451",
            "= 0.4784",
        ],
    );
    check(
        "100 * (1 - divided_twice() / visibility())",
        SMITH,
        3,
        &[
            "100 · (1 − 0.2673 / 0.5132)",
            "100 · (1 − 0.5208)",
            "100 · 0.4792",
            "= 47.9",
        ],
    );
    // What an author wrote is not rounded.
    check(
        "4 * n_dot_l * n_dot_v * 0.51321",
        SMITH,
        2,
        &["4 · 0.6 · 0.8 · 0.51321", "= 0.99"],
    );
    check(
        "cos(deg(60)) - 2",
        SMITH,
        3,
        &["cos(60°) − 2", "0.5 − 2", "= −1.50"],
    );
    check(
        "-roughness * (n_dot_l - 1)",
        SMITH,
        3,
        &["−0.4 · (0.6 − 1)", "−0.4 · (−0.4)", "= 0.160"],
    );
    check(
        "4 * cos(deg(20 - 60))",
        SMITH,
        3,
        &[
            "4 · cos((20 − 60)°)",
            "4 · cos(−40°)",
            "4 · 0.766",
            "= 3.06",
        ],
    );
    check("0.5", SMITH, 3, &["= 0.500"]);
    check("alpha", SMITH, 3, &["= 0.160"]);
    check("1e-9 * roughness", SMITH, 2, &["10⁻⁹ · 0.4", "= 4.0e-10"]);
}

#[test]
fn close_differences_get_the_digits_they_need() {
    check(
        "a - b",
        &[("a", 1.000_012_34), ("b", 1.0)],
        3,
        &["1.0000123 − 1", "= 0.0000123"],
    );
    check(
        "1 / (a - b)",
        &[("a", 1.234_567_8), ("b", 1.2344)],
        3,
        &["1 / (1.2345678 − 1.2344)", "1 / 0.0001678", "= 5959"],
    );
}
