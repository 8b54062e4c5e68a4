//! Numbers in an answer: the settings it speaks of, and the values it states.

use super::arithmetic::sum;
use super::symbols::{Found, found, is, number, squared};
use super::text::{Kind, Token};

/// `roughness = 0`, `alpha goes to zero`, `at 1`: which surface is spoken of, not what D is.
pub fn setting(tokens: &[Token], at: usize) -> Found {
    let surface = |value: f64| match value {
        v if v == 0.0 || (v - 0.05).abs() < 1e-9 => Some("#rough0"),
        v if v == 1.0 || (v - 0.95).abs() < 1e-9 => Some("#rough1"),
        _ => None,
    };
    let parameter = is(
        tokens,
        at,
        &["roughness", "alpha", "a2", "alpha2", "r", "a"],
    );
    if parameter || is(tokens, at, &["rough", "smooth"]) {
        let mut next = at + 1 + squared(tokens, at + 1).unwrap_or(0);
        let limit = next + 5;
        while next < limit
            && is(
                tokens,
                next,
                &[
                    "is",
                    "going",
                    "goes",
                    "to",
                    "tends",
                    "equals",
                    "equal",
                    "=",
                    "->",
                    "~",
                    "becomes",
                    "at",
                    "of",
                    "approaches",
                    "being",
                    "gets",
                    "value",
                    "now",
                ],
            )
        {
            next += 1;
        }
        let value = number(tokens, next)?;
        // `R -> 1` is a reflectance that rises.
        if is(tokens, at, &["r"]) && value == 1.0 && is(tokens, at + 1, &["->", "~", "goes"]) {
            return None;
        }
        let mut end = next + 1;
        // `0^+`: from above.
        if is(tokens, end, &["^"]) && is(tokens, end + 1, &["+", "("]) {
            end += 2;
            while is(tokens, end, &["+", ")"]) && end < next + 5 {
                end += 1;
            }
        }
        let arithmetic = is(tokens, end, &["*", "/", "^", "over", "-", "+", "%"]);
        let leads_on = is(tokens, end, &["->", ";", "=", "~", "--", ","]) || next == at + 1;
        if arithmetic || (!parameter && !leads_on) {
            return None;
        }
        return found(end - at, surface(value)?);
    }
    // "put zero in", "plugging in 1".
    if is(
        tokens,
        at,
        &[
            "put",
            "plug",
            "plugging",
            "set",
            "insert",
            "inserting",
            "substitute",
            "substituting",
            "enter",
            "feed",
        ],
    ) {
        let inner = at + 1 + usize::from(is(tokens, at + 1, &["in", "a", "it", "r", "to"]));
        let value = number(tokens, inner).filter(|&v| v == 0.0 || v == 1.0)?;
        if is(
            tokens,
            inner + 1,
            &["/", "*", "^", "over", "%", "-", "+", ".", "for"],
        ) && !is(tokens, inner + 1, &["."])
        {
            return None;
        }
        return found(inner + 1 - at, surface(value)?);
    }
    // "for 1 you are left with", "at zero:", but not "at 90 degrees" or "goes to 1".
    let shares = at > 0
        && is(
            tokens,
            at - 1,
            &["divided", "divide", "division", "dividing"],
        );
    // "It must sit at exactly 1": a value of D.
    let holds = at > 0
        && is(tokens, at, &["at"])
        && is(
            tokens,
            at - 1,
            &[
                "sit", "sits", "sitting", "stay", "stays", "stand", "stands", "land", "lands",
                "settle", "settles", "cap", "caps", "capped", "end", "ends", "up", "arrive",
                "arrives", "stop", "stops", "clamp", "clamped", "fixed", "remain", "remains",
                "out",
            ],
        );
    if is(tokens, at, &["for", "at", "with", "when"]) && !shares && !holds {
        let inner = at + 1 + usize::from(is(tokens, at + 1, &["exactly", "precisely", "just"]));
        let value = number(tokens, inner).filter(|&v| v == 0.0 || v == 1.0)?;
        if is(
            tokens,
            inner + 1,
            &[
                "/",
                "*",
                "^",
                "over",
                "%",
                "-",
                "+",
                "=",
                "->",
                "degrees",
                "incidence",
                "angle",
                "by",
                "divided",
            ],
        ) {
            return None;
        }
        return found(inner + 1 - at, surface(value)?);
    }
    let value = number(tokens, at)?;
    // "0 -> infinite; 1 -> 1/pi".
    let opens = at == 0 || matches!(tokens[at - 1].kind, Kind::Stop | Kind::Break | Kind::Comma);
    if opens && is(tokens, at + 1, &["->", ";", "gives"]) {
        return found(1, surface(value)?);
    }
    if value == 0.05 || value == 0.95 {
        return found(1, surface(value)?);
    }
    None
}

/// A number, written or computed, by the name under which the lexicon knows it.
pub fn value(tokens: &[Token], at: usize) -> Found {
    let token = &tokens[at];
    if token.is(">")
        && number(tokens, at + 1) == Some(1.0)
        && !is(tokens, at + 2, &["/", "*", "-", "+"])
    {
        return found(2, "#>1");
    }
    // A leading "×" or "/" multiplies what went before.
    let operand_before = at > 0
        && (matches!(tokens[at - 1].kind, Kind::Word | Kind::Value) || tokens[at - 1].is(")"));
    if token.is("/") && (token.spaced || !operand_before) && number(tokens, at + 1) == Some(4.0) {
        return found(2, "#1/4");
    }
    if token.is("*") && number(tokens, at + 1).is_some() && (!operand_before || token.spaced) {
        let (result, end) = sum(tokens, at + 1, 0)?;
        return found(end - at, name(result));
    }
    // `f(1)`: an argument.
    let call = token.is("(")
        && !token.spaced
        && at > 0
        && tokens[at - 1].kind == Kind::Word
        && !tokens[at - 1].is("pi");
    if call {
        return None;
    }
    let numeric = number(tokens, at).is_some()
        || ((token.is("(") || token.is("pi")) && starts_number(tokens, at));
    if !numeric {
        return None;
    }
    let (mut result, mut end) = sum(tokens, at, 0)?;
    if token.is("pi") && end == at + 1 {
        return None;
    }
    if is(tokens, end, &["%"]) {
        result /= 100.0;
        end += 1;
    }
    if is(tokens, end, &["degrees", "deg", "grad"]) {
        return found(
            end + 1 - at,
            if result == 90.0 {
                "#90deg"
            } else if result == 0.0 {
                "#0deg"
            } else {
                "#num"
            },
        );
    }
    if (result - std::f64::consts::FRAC_PI_2).abs() < 1e-3 {
        return found(end - at, "#90deg");
    }
    // "2·D" is a product, "2× the division" counts.
    let times = is(tokens, end, &["x"])
        || (is(tokens, end, &["*"])
            && !tokens.get(end + 1).is_some_and(|t| {
                t.kind == Kind::Value
                    || t.word.len() <= 2 && matches!(t.kind, Kind::Word | Kind::Op)
            }));
    if times && end < tokens.len() {
        let word = name(result).to_owned();
        return Some((
            end + 1 - at,
            vec![(word, Kind::Value), ("times".to_owned(), Kind::Word)],
        ));
    }
    // "0.9+": and more.
    let more = is(tokens, end, &["+"])
        && tokens
            .get(end + 1)
            .is_none_or(|t| !matches!(t.kind, Kind::Value | Kind::Word));
    let part = |i: usize| is(tokens, i, &["+", "-", "/", "*", "^"]) && !(more && i == end);
    // `D(1)`: an argument, not a value.
    let argument = at > 1
        && tokens[at - 1].is("(")
        && !tokens[at - 1].spaced
        && tokens[at - 2].kind == Kind::Word
        && is(tokens, end, &[")"]);
    if argument
        || part(end)
        || (operand_before && part(at.wrapping_sub(1)))
        || (at > 0 && part(at - 1))
    {
        return found(end - at, "#num");
    }
    // Four per cent that were computed were computed from the index.
    let computed = end - at > 3 && name(result) == "#0.04";
    found(end - at, if computed { "#f0formula" } else { name(result) })
}

/// Does a bracket or a pi open arithmetic on numbers alone?
fn starts_number(tokens: &[Token], at: usize) -> bool {
    is(tokens, at, &["pi"]) && is(tokens, at + 1, &["/", "^", "over", "("])
        || is(tokens, at, &["("])
            && (number(tokens, at + 1).is_some() || is(tokens, at + 1, &["pi", "("]))
}

fn name(value: f64) -> &'static str {
    let near = |target: f64, within: f64| (value - target).abs() <= within;
    if value.is_nan() {
        "#nan"
    } else if value.is_infinite() {
        "#inf"
    } else if value == 0.0 {
        "#0"
    } else if near(1.0, 1e-12) {
        "#1"
    } else if near(std::f64::consts::FRAC_1_PI, 2.5e-3) || near(0.3, 1e-12) {
        "#1/pi"
    } else if near(0.25, 1e-9) {
        "#1/4"
    } else if near(0.75, 1e-9) {
        "#3/4"
    } else if near(0.04, 1.1e-3) {
        "#0.04"
    } else if near(2.0, 1e-12) {
        "#2"
    } else if near(4.0, 1e-12) {
        "#4"
    } else if near(16.0, 1e-9) {
        "#16"
    } else if near(1.5, 0.051) {
        "#1.5"
    } else if (0.7..1.0).contains(&value) {
        "#0.9"
    } else {
        "#num"
    }
}
