//! Formulas in an answer: values, dot products, settings and the few shapes a judge knows.
//!
//! Runs of tokens become one token whose word begins with `#`: `1 over pi`, `.3183` and
//! `\pi^{-1}` are all `#1/pi`. What is not recognised stays as it is.

use super::text::{Kind, Token};
use super::values::{setting, value};

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
pub type Found = Option<(usize, Vec<(String, Kind)>)>;

/// One token of that word.
pub fn found(taken: usize, word: &str) -> Found {
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

/// Whether one of these words stands here.
pub fn is(tokens: &[Token], at: usize, words: &[&str]) -> bool {
    tokens
        .get(at)
        .is_some_and(|token| words.contains(&token.word.as_str()))
}

/// The number that stands here.
pub fn number(tokens: &[Token], at: usize) -> Option<f64> {
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
        let opens = at == 0
            || matches!(
                tokens[at - 1].kind,
                Kind::Stop | Kind::Break | Kind::Comma | Kind::Question
            );
        let number = match tokens[at].word.as_str() {
            "zero" | "nought" | "naught" | "nil" | "null" => "0",
            "unity" => "1",
            "one" if is(&tokens, at + 1, &["over", "divided"]) => "1",
            // "Zero: ... One: ...", "for one, ...".
            "one"
                if is(&tokens, at + 1, &[";", "->", "=", ","])
                    && (opens || previous == "for" && at > 0) =>
            {
                "1"
            }
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
            "hundred" if is(&tokens, at + 1, &["percent", "pct", "%", "per"]) => "100",
            "per" if is(&tokens, at + 1, &["cent"]) => "%",
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
            | "you"
            | "what"
            | "the"
            | "we"
            | "i"
            | "d"
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
            | "its"
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
    if matches!(word.as_str(), "nlnv" | "nvnl" | "ndotlndotv") {
        let pair = ["#n.l", "#n.v"].map(|name| (name.to_owned(), Kind::Value));
        return Some((1, pair.to_vec()));
    }
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
    // `D·F·G / (4 …)` is the whole term, not the visibility.
    if at > 0 && is(tokens, at - 1, &["*"]) && is(tokens, next, &["g2", "g"]) {
        return None;
    }
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
            (at + 3..at + 12).find(|&i| is(tokens, i, &["+"]) && index(i - 1) && index(i + 1))?;
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
pub fn squared(tokens: &[Token], at: usize) -> Option<usize> {
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
