//! Text becomes tokens. Greek letters, `²`, `·`, `−` and their kin mean what they mean on a
//! blackboard; `N·H` is one name.

use crate::error::{Error, Span, excerpt};
use crate::expr::CompareOp;

#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Token {
    Number {
        value: f64,
        text: String,
    },
    Name(String),
    Plus,
    Minus,
    Times,
    Over,
    Caret,
    /// `²`, `⁻¹`: the exponent.
    Superscript(String),
    /// `°`
    Degree,
    /// `√`
    Root,
    Open,
    Close,
    Comma,
    Assign,
    Compare(CompareOp),
    End,
}

#[derive(Clone, Debug)]
pub(crate) struct Lexed {
    pub token: Token,
    pub span: Span,
}

/// Every token of the text, the last one [`Token::End`].
pub(crate) fn lex(text: &str) -> Result<Vec<Lexed>, Error> {
    let mut tokens = Vec::new();
    let mut at = 0;
    while let Some(first) = text[at..].chars().next() {
        if first.is_whitespace() || first == '\u{200b}' || first == '\u{feff}' {
            at += first.len_utf8();
            continue;
        }
        let rest = &text[at..];
        let (token, length) = if first.is_ascii_digit()
            || (first == '.' && rest[1..].starts_with(|c: char| c.is_ascii_digit()))
        {
            number(rest, at)?
        } else if let Some(found) = dot_product(rest) {
            found
        } else if first.is_ascii_alphabetic() || first == '_' {
            let length = rest
                .find(|c: char| !c.is_ascii_alphanumeric() && c != '_')
                .unwrap_or(rest.len());
            (Token::Name(rest[..length].to_string()), length)
        } else if let Some(name) = greek(first) {
            // `α_1` is the name alpha_1.
            let tail = &rest[first.len_utf8()..];
            let more = tail
                .find(|c: char| !c.is_ascii_alphanumeric() && c != '_')
                .unwrap_or(tail.len());
            (
                Token::Name(format!("{name}{}", &tail[..more])),
                first.len_utf8() + more,
            )
        } else if superscript(first).is_some() {
            let digits: String = rest.chars().map_while(superscript).collect();
            let length = rest.chars().take(digits.len()).map(char::len_utf8).sum();
            (Token::Superscript(digits), length)
        } else {
            symbol(rest, at)?
        };
        let span = Span {
            start: at,
            end: at + length,
        };
        tokens.push(Lexed { token, span });
        at += length;
    }
    let end = Span {
        start: text.len(),
        end: text.len(),
    };
    tokens.push(Lexed {
        token: Token::End,
        span: end,
    });
    Ok(tokens)
}

fn number(rest: &str, at: usize) -> Result<(Token, usize), Error> {
    let bytes = rest.as_bytes();
    let digits = |from: usize| {
        bytes[from..]
            .iter()
            .take_while(|byte| byte.is_ascii_digit())
            .count()
    };
    let mut length = digits(0);
    if bytes.get(length) == Some(&b'.') {
        length += 1 + digits(length + 1);
    }
    // An exponent counts only where digits follow, so that `2e` is a forgotten product.
    if matches!(bytes.get(length), Some(b'e' | b'E')) {
        let sign = usize::from(matches!(bytes.get(length + 1), Some(b'+' | b'-')));
        let exponent = bytes
            .get(length + 1 + sign..)
            .map_or(0, |_| digits(length + 1 + sign));
        if exponent > 0 {
            length += 1 + sign + exponent;
        }
    }
    let text = &rest[..length];
    let span = Span {
        start: at,
        end: at + length,
    };
    if bytes.get(length) == Some(&b'.') {
        return Err(Error::new(span, "a number has one decimal point"));
    }
    match text.parse::<f64>() {
        Ok(value) if value.is_finite() => {
            let text = text.to_string();
            Ok((Token::Number { value, text }, length))
        }
        _ => Err(Error::new(
            span,
            format!("{} is too large for a number", excerpt(text)),
        )),
    }
}

/// `N·H`, `L⋅V`, `n · h`: the cosine of two directions, by its name in the language.
fn dot_product(rest: &str) -> Option<(Token, usize)> {
    let mut chars = rest.chars();
    let left = chars.next().filter(|c| "NLVH".contains(*c))?;
    let dot = chars.next().filter(|c| "·⋅".contains(*c))?;
    let right = chars.next().filter(|c| "NLVHX".contains(*c))?;
    if chars
        .next()
        .is_some_and(|c| c.is_ascii_alphanumeric() || c == '_')
    {
        return None;
    }
    let (left, right) = (left.to_ascii_lowercase(), right.to_ascii_lowercase());
    // V·H and H·V are one cosine: the language has one name for it.
    let rank = |c: char| "nlvhx".find(c);
    let flip = rank(left) > rank(right);
    let name = match (left, right) {
        ('l', 'h') | ('h', 'l') => "v_dot_h".to_string(),
        _ if flip => format!("{right}_dot_{left}"),
        _ => format!("{left}_dot_{right}"),
    };
    Some((Token::Name(name), 2 + dot.len_utf8()))
}

fn greek(letter: char) -> Option<&'static str> {
    Some(match letter {
        'α' => "alpha",
        'β' => "beta",
        'γ' => "gamma",
        'η' => "eta",
        'θ' => "theta",
        'λ' => "lambda",
        'μ' | 'µ' => "mu",
        'π' => "pi",
        'ρ' => "rho",
        'σ' => "sigma",
        'φ' | 'ϕ' => "phi",
        'ω' => "omega",
        _ => return None,
    })
}

fn superscript(letter: char) -> Option<char> {
    Some(match letter {
        '⁰' => '0',
        '¹' => '1',
        '²' => '2',
        '³' => '3',
        '⁴' => '4',
        '⁵' => '5',
        '⁶' => '6',
        '⁷' => '7',
        '⁸' => '8',
        '⁹' => '9',
        '⁻' => '-',
        _ => return None,
    })
}

fn symbol(rest: &str, at: usize) -> Result<(Token, usize), Error> {
    let two = [
        ("**", Token::Caret),
        ("<=", Token::Compare(CompareOp::LessEqual)),
        (">=", Token::Compare(CompareOp::GreaterEqual)),
        ("==", Token::Compare(CompareOp::Equal)),
        ("!=", Token::Compare(CompareOp::NotEqual)),
    ];
    for (spelling, token) in two {
        if rest.starts_with(spelling) {
            return Ok((token, 2));
        }
    }
    let first = rest.chars().next().unwrap_or(' ');
    let token = match first {
        '+' => Token::Plus,
        '-' | '−' | '–' => Token::Minus,
        '*' | '·' | '⋅' | '×' | '∗' => Token::Times,
        '/' | '÷' | '∕' => Token::Over,
        '^' => Token::Caret,
        '√' => Token::Root,
        '°' => Token::Degree,
        '(' => Token::Open,
        ')' => Token::Close,
        ',' => Token::Comma,
        '=' => Token::Assign,
        '<' => Token::Compare(CompareOp::Less),
        '>' => Token::Compare(CompareOp::Greater),
        '≤' => Token::Compare(CompareOp::LessEqual),
        '≥' => Token::Compare(CompareOp::GreaterEqual),
        '≠' => Token::Compare(CompareOp::NotEqual),
        _ => {
            let span = Span {
                start: at,
                end: at + first.len_utf8(),
            };
            let error = Error::new(span, format!("{first:?} has no meaning in a formula"));
            return Err(match first {
                '[' | '{' | ']' | '}' => error.help("group with ( and )"),
                '%' => error.help("write a share as a number, 0.479 or 47.9/100"),
                ';' => error.help("separate arguments with ,"),
                '∞' => error.help("infinity is not a number here"),
                _ => error,
            });
        }
    };
    Ok((token, first.len_utf8()))
}
