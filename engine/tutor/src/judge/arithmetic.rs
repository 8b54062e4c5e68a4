//! Arithmetic on numbers alone, as learners write it: `1/(PI*1.*1.)`, `zero over zero`.

use super::symbols::{is, number};
use super::text::Token;

/// Nesting beyond this is no arithmetic that a learner writes.
const DEPTH: usize = 24;

/// The value of the longest sum that starts here, and where it ends. 0/0 is NaN.
pub fn sum(tokens: &[Token], at: usize, depth: usize) -> Option<(f64, usize)> {
    let (mut total, mut next) = term(tokens, at, depth)?;
    while is(tokens, next, &["+", "-"]) {
        let Some((value, end)) = term(tokens, next + 1, depth) else {
            break;
        };
        total = if tokens[next].is("+") {
            total + value
        } else {
            total - value
        };
        next = end;
    }
    Some((total, next))
}

fn term(tokens: &[Token], at: usize, depth: usize) -> Option<(f64, usize)> {
    let (mut total, mut next) = power(tokens, at, depth)?;
    loop {
        let divide = is(tokens, next, &["/", "over"])
            || (is(tokens, next, &["by", "on"]) && number(tokens, next.wrapping_sub(1)).is_some());
        let through = ["by", "through", "for", "with", "over", "on"];
        let divided_by = is(tokens, next, &["divided"]) && is(tokens, next + 1, &through);
        // "zero is divided by zero".
        let is_divided = is(tokens, next, &["is", "gets", "being", "was"])
            && is(tokens, next + 1, &["divided"])
            && is(tokens, next + 2, &through);
        let divided = is(tokens, next, &["divided"]) && number(tokens, next + 1).is_some();
        let times = is(tokens, next, &["*"]);
        let implicit = is(tokens, next, &["(", "pi"]) && !tokens[next].spaced && next > at;
        let skip = match () {
            () if is_divided => 3,
            () if divided_by => 2,
            () if divide || divided || times => 1,
            () if implicit => 0,
            () => break,
        };
        let Some((value, end)) = power(tokens, next + skip, depth) else {
            break;
        };
        total = if divide || divided || divided_by || is_divided {
            total / value
        } else {
            total * value
        };
        next = end;
    }
    Some((total, next))
}

fn power(tokens: &[Token], at: usize, depth: usize) -> Option<(f64, usize)> {
    let (base, next) = atom(tokens, at, depth)?;
    if is(tokens, next, &["^"]) {
        let negative = is(tokens, next + 1, &["-"]);
        if let Some((exponent, end)) = atom(tokens, next + 1 + usize::from(negative), depth) {
            return Some((base.powf(if negative { -exponent } else { exponent }), end));
        }
    }
    Some((base, next))
}

fn atom(tokens: &[Token], at: usize, depth: usize) -> Option<(f64, usize)> {
    if depth > DEPTH {
        return None;
    }
    if let Some(value) = number(tokens, at) {
        return Some((value, at + 1));
    }
    match tokens.get(at)?.word.as_str() {
        "pi" => Some((std::f64::consts::PI, at + 1)),
        "-" => atom(tokens, at + 1, depth + 1).map(|(value, next)| (-value, next)),
        "(" => {
            let (value, next) = sum(tokens, at + 1, depth + 1)?;
            is(tokens, next, &[")"]).then_some((value, next + 1))
        }
        _ => None,
    }
}
