//! Formulas in an answer: values, dot products, settings and the few shapes a judge knows.
//!
//! Runs of tokens become one token whose word begins with `#`: `1 over pi`, `.3183` and
//! `\pi^{-1}` are all `#1/pi`. What is not recognised stays as it is.

use super::text::{Kind, Token};

/// Nesting beyond this is no arithmetic that a learner writes.
const DEPTH: usize = 24;

/// Recognises formulas.
pub fn fuse(tokens: Vec<Token>) -> Vec<Token> {
    let words = number_words(tokens);
    let dots = rewrite(&words, dot_product);
    let products = rewrite(&dots, product);
    let shapes = rewrite(&products, shape);
    let settings = rewrite(&shapes, setting);
    rewrite(&settings, value)
}

/// What a rule makes of the tokens from a position: how many it takes, and their new words.
type Found = Option<(usize, Vec<(String, Kind)>)>;

fn found(taken: usize, word: &str) -> Found {
    Some((taken, vec![(word.to_owned(), Kind::Value)]))
}

fn rewrite(tokens: &[Token], rule: fn(&[Token], usize) -> Found) -> Vec<Token> {
    let mut out = Vec::with_capacity(tokens.len());
    let mut at = 0;
    while at < tokens.len() {
        match rule(tokens, at) {
            Some((taken, words)) => {
                let last = &tokens[at + taken - 1];
                for (word, kind) in words {
                    out.push(Token {
                        word,
                        kind,
                        start: tokens[at].start,
                        end: last.end,
                        spaced: tokens[at].spaced,
                    });
                }
                at += taken;
            }
            None => {
                out.push(tokens[at].clone());
                at += 1;
            }
        }
    }
    out
}

fn is(tokens: &[Token], at: usize, words: &[&str]) -> bool {
    tokens
        .get(at)
        .is_some_and(|token| words.contains(&token.word.as_str()))
}

fn number(tokens: &[Token], at: usize) -> Option<f64> {
    tokens
        .get(at)
        .filter(|t| t.kind == Kind::Value)
        .and_then(|t| t.word.parse().ok())
}

/// `zero` is always a number; `one` only where a number can stand.
fn number_words(mut tokens: Vec<Token>) -> Vec<Token> {
    for at in 0..tokens.len() {
        let previous = at
            .checked_sub(1)
            .map(|i| tokens[i].word.clone())
            .unwrap_or_default();
        let number = match tokens[at].word.as_str() {
            "zero" | "nought" | "naught" | "nil" | "null" => "0",
            "unity" => "1",
            "one" if is(&tokens, at + 1, &["over", "divided"]) => "1",
            "one"
                if matches!(
                    previous.as_str(),
                    "=" | "->"
                        | "~"
                        | ">"
                        | "<"
                        | "/"
                        | "equals"
                        | "equal"
                        | "exactly"
                        | "alpha"
                        | "roughness"
                ) =>
            {
                "1"
            }
            "one"
                if matches!(
                    previous.as_str(),
                    "is" | "to"
                        | "be"
                        | "at"
                        | "than"
                        | "below"
                        | "above"
                        | "returns"
                        | "gives"
                        | "exceed"
                        | "exceeds"
                        | "becomes"
                        | "past"
                ) && !tokens
                    .get(at + 1)
                    .is_some_and(|t| t.kind == Kind::Word && !is_link(&t.word)) =>
            {
                "1"
            }
            "percent" | "pct" => "%",
            _ => continue,
        };
        if number == "%" {
            tokens[at].kind = Kind::Op;
        } else {
            tokens[at].kind = Kind::Value;
        }
        tokens[at].word = number.to_owned();
    }
    tokens
}

/// Words that may follow a number without counting or naming something with it.
fn is_link(word: &str) -> bool {
    matches!(
        word,
        "and"
            | "at"
            | "for"
            | "in"
            | "on"
            | "so"
            | "since"
            | "because"
            | "as"
            | "but"
            | "while"
            | "or"
            | "when"
            | "where"
            | "by"
            | "it"
            | "everywhere"
            | "all"
            | "there"
            | "here"
            | "then"
            | "which"
            | "if"
            | "cuz"
            | "bc"
            | "towards"
            | "toward"
            | "near"
            | "right"
            | "always"
            | "too"
            | "instead"
    )
}

fn vector(token: Option<&Token>) -> Option<char> {
    let word = &token?.word;
    let mut letters = word.chars();
    match (letters.next(), letters.next()) {
        (Some(c @ ('n' | 'l' | 'v' | 'h')), None) => Some(c),
        _ => None,
    }
}

fn dot_name(a: char, b: char) -> Option<&'static str> {
    Some(match (a.min(b), a.max(b)) {
        ('l', 'n') => "#n.l",
        ('n', 'v') => "#n.v",
        ('h', 'n') => "#n.h",
        ('h', 'v') => "#v.h",
        ('h', 'l') => "#l.h",
        ('l', 'v') => "#l.v",
        _ => return None,
    })
}

/// `NdotL`, `nl`, `n_dot_l`, `LdotN`: the pair that a word names.
fn dot_word(word: &str) -> Option<&'static str> {
    let letters: Vec<char> = word.chars().collect();
    let pair = match letters.as_slice() {
        [a, b] => (*a, *b),
        [a, 'd', 'o', 't', b] => (*a, *b),
        _ => return None,
    };
    dot_name(pair.0, pair.1)
}

fn dot_product(tokens: &[Token], at: usize) -> Found {
    let word = &tokens[at].word;
    if tokens[at].kind == Kind::Word
        && let Some(name) = dot_word(word)
    {
        return found(1, name);
    }
    if word == "dot"
        && is(tokens, at + 1, &["("])
        && is(tokens, at + 3, &[","])
        && is(tokens, at + 5, &[")"])
    {
        let name = dot_name(vector(tokens.get(at + 2))?, vector(tokens.get(at + 4))?)?;
        return found(6, name);
    }
    if word == "(" {
        let a = vector(tokens.get(at + 1))?;
        let middle = is(tokens, at + 2, &[",", "*", "dot"]);
        let b = vector(tokens.get(at + 2 + usize::from(middle)))?;
        if is(tokens, at + 3 + usize::from(middle), &[")"]) {
            return found(4 + usize::from(middle), dot_name(a, b)?);
        }
        return None;
    }
    let a = vector(tokens.get(at))?;
    if is(tokens, at + 1, &["*", "dot", "."])
        && !(is(tokens, at + 1, &["."]) && tokens.get(at + 2).is_some_and(|t| t.spaced))
    {
        return found(3, dot_name(a, vector(tokens.get(at + 2))?)?);
    }
    None
}

/// `4·NdotL·NdotV` and its cousins.
fn product(tokens: &[Token], at: usize) -> Found {
    let mut next = at;
    let four = number(tokens, next) == Some(4.0) || is(tokens, next, &["four"]);
    next += usize::from(four);
    next += usize::from(four && is(tokens, next, &["*"]));
    let open = is(tokens, next, &["("]);
    next += usize::from(open);
    let first = tokens
        .get(next)
        .filter(|t| t.is("#n.l") || t.is("#n.v"))?
        .word
        .clone();
    next += 1;
    next += usize::from(is(tokens, next, &["*"]));
    let other = if first == "#n.l" { "#n.v" } else { "#n.l" };
    if !is(tokens, next, &[other]) {
        return None;
    }
    next += 1;
    next += usize::from(open && is(tokens, next, &[")"]));
    found(next - at, if four { "#4nlnv" } else { "#nlnv" })
}

/// Shapes with letters: Schlick's `(1 - x)^5`, `((n-1)/(n+1))^2`, `G2/(4·N·L·N·V)`, `1/(π α²)`.
fn shape(tokens: &[Token], at: usize) -> Found {
    let mut next = at;
    if is(tokens, next, &["#4nlnv", "("]) {
        let open = is(tokens, next, &["("]);
        let inner = next + usize::from(open);
        let close = inner + 1;
        if is(tokens, inner, &["#4nlnv", "#nlnv"]) && (!open || is(tokens, close, &[")"])) {
            let after = close + usize::from(open);
            return match squared(tokens, after) {
                Some(taken) => Some((
                    after + taken - at,
                    vec![
                        ("#4nlnv".to_owned(), Kind::Value),
                        ("#twice".to_owned(), Kind::Value),
                    ],
                )),
                None if open => found(after - at, &tokens[inner].word),
                None => None,
            };
        }
    }
    let divided = is(tokens, next + 1, &["divided"]) && is(tokens, next + 2, &["by"]);
    if is(tokens, next, &["1", "g2", "g"]) && (divided || is(tokens, next + 1, &["/", "over"])) {
        let one = is(tokens, next, &["1"]);
        next += 2 + usize::from(divided);
        let open = is(tokens, next, &["("]);
        next += usize::from(open);
        if is(tokens, next, &["#4nlnv", "#nlnv"]) {
            next += 1 + usize::from(open && is(tokens, next + 1, &[")"]));
            let name = if one { "#1/4nlnv" } else { "#v=g/4nlnv" };
            return match squared(tokens, next) {
                Some(taken) => Some((
                    next + taken - at,
                    vec![
                        (name.to_owned(), Kind::Value),
                        ("#twice".to_owned(), Kind::Value),
                    ],
                )),
                None => found(next - at, name),
            };
        }
        // `G/(4..)`, `G2 / 4 ...`
        if !one && is(tokens, next, &["4"]) {
            return found(next + 1 - at, "#v=g/4nlnv");
        }
        if one && is(tokens, next, &["pi"]) {
            next += 1;
            next += usize::from(is(tokens, next, &["*"]));
            if is(
                tokens,
                next,
                &["alpha", "a", "a2", "alpha2", "a4", "roughness"],
            ) {
                next += 1;
                next += squared(tokens, next).unwrap_or(0);
                next += usize::from(is(tokens, next, &[")"]));
                return found(next - at, "#1/pialpha2");
            }
        }
        return None;
    }
    let index =
        |i: usize| is(tokens, i, &["n", "ior", "eta", "n1", "n2"]) || number(tokens, i).is_some();
    if index(at) && is(tokens, at + 1, &["-"]) && index(at + 2) {
        // The sum follows within a few tokens, behind a division: ") / ( n + 1".
        let sum =
            (at + 3..at + 9).find(|&i| is(tokens, i, &["+"]) && index(i - 1) && index(i + 1))?;
        if !(at + 3..sum).any(|i| is(tokens, i, &["/", "over"])) {
            return None;
        }
        let mut end = sum + 2;
        while is(tokens, end, &[")"]) && end < sum + 5 {
            end += 1;
        }
        end += squared(tokens, end).unwrap_or(0);
        return found(end - at, "#f0formula");
    }
    if is(tokens, at, &["^"]) && number(tokens, at + 1) == Some(5.0) {
        return found(2, "#schlick");
    }
    if is(tokens, at, &["("]) && number(tokens, at + 1).is_some() && is(tokens, at + 2, &[","]) {
        let triple = number(tokens, at + 3).is_some()
            && is(tokens, at + 4, &[","])
            && number(tokens, at + 5).is_some();
        if triple && is(tokens, at + 6, &[")"]) {
            return found(7, "#rgb");
        }
    }
    None
}

/// How many tokens say "to the power ±2" from here.
fn squared(tokens: &[Token], at: usize) -> Option<usize> {
    if !is(tokens, at, &["^"]) {
        return if is(tokens, at, &["squared"]) {
            Some(1)
        } else {
            None
        };
    }
    let mut next = at + 1;
    let open = is(tokens, next, &["("]);
    next += usize::from(open);
    next += usize::from(is(tokens, next, &["-"]));
    if number(tokens, next) != Some(2.0) {
        return None;
    }
    next += 1;
    next += usize::from(open && is(tokens, next, &[")"]));
    Some(next - at)
}

/// `roughness = 0`, `alpha goes to zero`, `at 1`: which surface is spoken of, not what D is.
fn setting(tokens: &[Token], at: usize) -> Found {
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
    // "for 1 you are left with", "at zero:", but not "at 90 degrees" or "goes to 1".
    if is(tokens, at, &["for", "at", "with", "when"]) {
        let value = number(tokens, at + 1).filter(|&v| v == 0.0 || v == 1.0)?;
        if is(
            tokens,
            at + 2,
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
        return found(2, surface(value)?);
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

fn value(tokens: &[Token], at: usize) -> Found {
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
    let times = is(tokens, end, &["x"])
        || (is(tokens, end, &["*"])
            && !tokens
                .get(end + 1)
                .is_some_and(|t| matches!(t.kind, Kind::Value)));
    if times && end < tokens.len() {
        let word = name(result).to_owned();
        return Some((
            end + 1 - at,
            vec![(word, Kind::Value), ("times".to_owned(), Kind::Word)],
        ));
    }
    let part = |i: usize| is(tokens, i, &["+", "-", "/", "*", "^"]);
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
    } else if near(std::f64::consts::FRAC_1_PI, 2.5e-3) {
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
    } else if near(1.5, 0.051) {
        "#1.5"
    } else if (0.7..1.0).contains(&value) {
        "#0.9"
    } else {
        "#num"
    }
}

fn sum(tokens: &[Token], at: usize, depth: usize) -> Option<(f64, usize)> {
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
        let divided_by = is(tokens, next, &["divided"]) && is(tokens, next + 1, &["by", "through"]);
        let times = is(tokens, next, &["*"]);
        let implicit = is(tokens, next, &["(", "pi"]) && !tokens[next].spaced && next > at;
        let skip = match () {
            () if divided_by => 2,
            () if divide || times => 1,
            () if implicit => 0,
            () => break,
        };
        let Some((value, end)) = power(tokens, next + skip, depth) else {
            break;
        };
        total = if divide || divided_by {
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
