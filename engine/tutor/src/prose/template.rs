//! Templates: `{{ EXPR : FORMAT }}` in prose, so that no number is typed that can be computed.

use std::ops::Range;

use formula::{Digits, Values};

use super::shortest;
use crate::lesson::Lesson;

/// First of the private characters that stand for filled templates while Markdown is read, so
/// that nothing in a value is taken for Markdown.
const FIRST_STAND_IN: u32 = 0xF_0000;
/// How many there are.
const STAND_INS: u32 = 0xFFFD;

/// Prose with stand-ins for its templates.
#[derive(Debug, Default)]
pub struct Filled {
    /// The prose, one private character for each template.
    pub text: String,
    /// What each stand-in stands for.
    pub values: Vec<Value>,
    /// What could not be filled.
    pub errors: Vec<TemplateError>,
}

/// What a template became.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A number, or words.
    Text(String),
    /// A formula.
    Math(String),
}

impl Filled {
    /// The prose with its values put in.
    pub fn markdown(&self) -> String {
        let mut out = String::with_capacity(self.text.len());
        for character in self.text.chars() {
            match self.value(character) {
                Some(Value::Text(value) | Value::Math(value)) => out.push_str(value),
                None => out.push(character),
            }
        }
        out
    }

    /// What a character stands for, if it is a stand-in.
    pub fn value(&self, character: char) -> Option<&Value> {
        let index = u32::from(character).checked_sub(FIRST_STAND_IN)?;
        self.values.get(index as usize)
    }
}

/// A template that cannot be filled; the span counts in the prose.
#[derive(Clone, Debug, PartialEq)]
pub struct TemplateError {
    /// Where, in bytes of the prose.
    pub span: Range<usize>,
    /// What is wrong.
    pub message: String,
    /// What should stand there.
    pub expected: Option<String>,
    /// The next step.
    pub help: Option<String>,
}

impl TemplateError {
    fn new(span: Range<usize>, message: impl Into<String>) -> TemplateError {
        TemplateError {
            span,
            message: message.into(),
            expected: None,
            help: None,
        }
    }

    fn expecting(mut self, expected: &str) -> TemplateError {
        self.expected = Some(expected.to_owned());
        self
    }

    fn of_formula(offset: usize, error: formula::Error) -> TemplateError {
        TemplateError {
            span: offset + error.span.start..offset + error.span.end,
            message: error.message,
            expected: None,
            help: error.help,
        }
    }
}

/// A stretch of prose.
pub enum Piece {
    /// Outside of templates.
    Words(Range<usize>),
    /// A template, braces included, and what stands between them.
    Template(Range<usize>, Range<usize>),
    /// `{{` that is never closed.
    Open(Range<usize>),
}

/// Takes prose apart; the pieces cover it.
pub fn pieces(text: &str) -> Vec<Piece> {
    let mut pieces = Vec::new();
    let mut at = 0;
    while let Some(found) = text[at..].find("{{") {
        let open = at + found;
        if open > at {
            pieces.push(Piece::Words(at..open));
        }
        // Another one that opens before this one ends: its own end is missing.
        let inside = &text[open + 2..];
        let end = inside
            .find("}}")
            .filter(|end| !inside[..*end].contains("{{"));
        match end.map(|end| end + 2) {
            Some(length) => {
                let close = open + length;
                pieces.push(Piece::Template(open..close + 2, open + 2..close));
                at = close + 2;
            }
            None => {
                pieces.push(Piece::Open(open..open + 2));
                at = open + 2;
            }
        }
    }
    if at < text.len() {
        pieces.push(Piece::Words(at..text.len()));
    }
    pieces
}

/// Fills the templates of prose.
pub fn fill(lesson: &Lesson, text: &str, values: &Values) -> Filled {
    let mut filled = Filled::default();
    for piece in pieces(text) {
        match piece {
            Piece::Words(span) => filled.text.push_str(&text[span]),
            Piece::Open(span) => {
                filled.text.push_str(&text[span.clone()]);
                filled
                    .errors
                    .push(TemplateError::new(span, "This template is not closed.").expecting("}}"));
            }
            Piece::Template(whole, inner) => match value(lesson, text, inner, values) {
                Ok(value) if (filled.values.len() as u32) < STAND_INS => {
                    let index = FIRST_STAND_IN + filled.values.len() as u32;
                    filled.text.extend(char::from_u32(index));
                    filled.values.push(value);
                }
                Ok(Value::Text(value) | Value::Math(value)) => filled.text.push_str(&value),
                Err(error) => {
                    filled.text.push_str(&text[whole]);
                    filled.errors.push(error);
                }
            },
        }
    }
    filled
}

/// A template taken apart: what stands before the last colon, and the format after it.
fn parts(text: &str, inner: Range<usize>) -> (Range<usize>, Option<Range<usize>>) {
    let (body, format) = match text[inner.clone()].rfind(':') {
        Some(colon) => (
            inner.start..inner.start + colon,
            Some(trimmed(text, inner.start + colon + 1..inner.end)),
        ),
        None => (inner, None),
    };
    (trimmed(text, body), format)
}

fn trimmed(text: &str, span: Range<usize>) -> Range<usize> {
    let piece = &text[span.clone()];
    let start = span.start + (piece.len() - piece.trim_start().len());
    start..(span.start + piece.trim_end().len()).max(start)
}

/// `formula NAME` and `source ID`, with the offset of the name.
fn keyword(body: &str) -> Option<(&str, &str, usize)> {
    let (word, rest) = body.split_once(char::is_whitespace)?;
    let name = rest.trim();
    matches!(word, "formula" | "source").then(|| (word, name, body.len() - rest.trim_start().len()))
}

fn value(
    lesson: &Lesson,
    text: &str,
    inner: Range<usize>,
    values: &Values,
) -> Result<Value, TemplateError> {
    let (body, format) = parts(text, inner.clone());
    let words = &text[body.clone()];
    if words.is_empty() {
        let error = TemplateError::new(inner, "This template is empty.");
        return Err(error.expecting("an expression, such as {{ roughness^2 : .4 }}"));
    }
    if let Some((word, name, offset)) = keyword(words) {
        let span = body.start + offset..body.start + offset + name.len();
        return match word {
            "formula" => formula_named(lesson, name, span).map(Value::Math),
            _ => source_named(lesson, name, span).map(Value::Text),
        };
    }
    let print = match &format {
        Some(span) => printer(&text[span.clone()]).ok_or_else(|| {
            let error = TemplateError::new(span.clone(), "This is not a format of numbers.");
            error.expecting("`.3` (decimals), `4s` (significant digits), `%` or `.1 %`")
        })?,
        None => Print::Shortest,
    };
    let expr = formula::parse(words).map_err(|e| TemplateError::of_formula(body.start, e))?;
    let number = lesson
        .library
        .eval(&expr, values)
        .map_err(|e| TemplateError::of_formula(body.start, e))?;
    Ok(Value::Text(print.number(number)))
}

fn formula_named(lesson: &Lesson, name: &str, span: Range<usize>) -> Result<String, TemplateError> {
    let Some(definition) = lesson.library.definition(name) else {
        let mut error = TemplateError::new(span, format!("No formula is called `{name}`."));
        let known = lesson.formulas.iter().map(|entry| entry.name.text.as_str());
        error.expected = crate::load::nearest(name, known).map(str::to_owned);
        return Err(error);
    };
    let body = lesson.library.unicode(&definition.body);
    Ok(format!("{} = {body}", lesson.spelled(name)))
}

fn source_named(lesson: &Lesson, name: &str, span: Range<usize>) -> Result<String, TemplateError> {
    if let Some(source) = lesson.source_says(name) {
        return Ok(source.shown.text.clone());
    }
    let mut error = TemplateError::new(span, format!("No `[[source_says]]` has the id `{name}`."));
    let known = lesson
        .sources
        .iter()
        .filter_map(|entry| entry.id.as_deref());
    error.expected = crate::load::nearest(name, known).map(str::to_owned);
    Err(error)
}

/// How a number is printed.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Print {
    Shortest,
    Digits(Digits),
    Percent(u32),
}

impl Print {
    fn number(self, value: f64) -> String {
        match self {
            Print::Shortest => shortest(value),
            Print::Digits(digits) => formula::format_number(value, digits),
            Print::Percent(decimals) => {
                formula::format_number(value * 100.0, Digits::Decimals(decimals))
            }
        }
    }
}

fn printer(format: &str) -> Option<Print> {
    let count = |digits: &str| -> Option<u32> {
        let plain = !digits.is_empty() && digits.bytes().all(|b| b.is_ascii_digit());
        digits.parse().ok().filter(|&n| plain && n <= 17)
    };
    if let Some(percent) = format.strip_suffix('%') {
        let decimals = percent.trim();
        return match decimals.strip_prefix('.') {
            Some(digits) => count(digits).map(Print::Percent),
            None => decimals.is_empty().then_some(Print::Percent(0)),
        };
    }
    if let Some(digits) = format.strip_suffix('s') {
        let digits = count(digits).filter(|&n| n > 0)?;
        return Some(Print::Digits(Digits::Significant(digits)));
    }
    let digits = count(format.strip_prefix('.')?)?;
    Some(Print::Digits(Digits::Decimals(digits)))
}

/// Decimals typed outside of templates, such as `0.5`.
pub fn typed_numbers(text: &str) -> Vec<Range<usize>> {
    let mut found = Vec::new();
    for piece in pieces(text) {
        let Piece::Words(span) = piece else { continue };
        let bytes = text.as_bytes();
        let digit = |at: usize| at < span.end && bytes[at].is_ascii_digit();
        let mut at = span.start;
        while at < span.end {
            if !digit(at) {
                at += 1;
                continue;
            }
            let start = at;
            while digit(at) {
                at += 1;
            }
            if at < span.end && bytes[at] == b'.' && digit(at + 1) {
                at += 1;
                while digit(at) {
                    at += 1;
                }
                found.push(start..at);
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check_typed(text: &str, expected: &[&str]) {
        let found: Vec<&str> = typed_numbers(text).into_iter().map(|s| &text[s]).collect();
        assert_eq!(found, expected, "{text:?}");
    }

    #[test]
    fn typed_decimals_are_found_outside_of_templates() {
        check_typed("a 0.5 b", &["0.5"]);
        check_typed("in `0.25` and 1.0.", &["0.25", "1.0"]);
        check_typed("{{ 0.5 : .3 }} and 3. Then 4", &[]);
        check_typed("α 12.5{{ x }}6.5", &["12.5", "6.5"]);
        check_typed("{{ 0.5", &["0.5"]);
        check_typed("1.2.3", &["1.2"]);
    }

    #[track_caller]
    fn check_format(format: &str, expected: Option<&str>) {
        let found = printer(format).map(|print| print.number(0.5132180383));
        assert_eq!(found.as_deref(), expected, "{format:?}");
    }

    #[test]
    fn formats() {
        check_format(".3", Some("0.513"));
        check_format("4s", Some("0.5132"));
        check_format("%", Some("51"));
        check_format(".1 %", Some("51.3"));
        check_format(".1%", Some("51.3"));
        check_format("3", None);
        check_format(".", None);
        check_format("s", None);
        check_format("0s", None);
        check_format(".+3", None);
        check_format(".99", None);
    }
}
