//! Where something is wrong, what is wrong, and what to do about it.

use std::fmt;

/// A range of bytes in the text that was parsed.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Span {
    /// First byte.
    pub start: usize,
    /// One past the last byte.
    pub end: usize,
}

impl Span {
    /// The smallest span that holds both.
    pub fn to(self, other: Span) -> Span {
        Span {
            start: self.start.min(other.start),
            end: self.end.max(other.end),
        }
    }

    /// The text under the span, empty where the span is not of this text.
    pub fn of(self, text: &str) -> &str {
        text.get(self.start..self.end).unwrap_or("")
    }
}

/// One clear sentence, where it applies, and the next step.
#[derive(Clone, Debug, PartialEq)]
pub struct Error {
    /// The offending part of the text parsed.
    pub span: Span,
    /// What is wrong.
    pub message: String,
    /// What to do, where that is known.
    pub help: Option<String>,
}

impl Error {
    pub(crate) fn new(span: Span, message: impl Into<String>) -> Error {
        Error {
            span,
            message: message.into(),
            help: None,
        }
    }

    pub(crate) fn help(mut self, help: impl Into<String>) -> Error {
        self.help = Some(help.into());
        self
    }

    /// Adds "did you mean X?" where a known name is near to what was written.
    pub(crate) fn nearest<'a>(
        self,
        written: &str,
        known: impl IntoIterator<Item = &'a str>,
    ) -> Error {
        match nearest(written, known) {
            Some(name) => self.help(format!("did you mean {name}?")),
            None => self,
        }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(&self.message)?;
        match &self.help {
            Some(help) => write!(out, "; {help}"),
            None => Ok(()),
        }
    }
}

impl std::error::Error for Error {}

/// The known name nearest to a misspelt one, if it is near enough to be meant.
pub(crate) fn nearest<'a>(
    written: &str,
    known: impl IntoIterator<Item = &'a str>,
) -> Option<&'a str> {
    // Long garbage has no near name, and the distance costs the product of both lengths.
    if written.len() > 64 {
        return None;
    }
    let flat = |name: &str| name.replace(['_', ' '], "").to_lowercase();
    let wanted = flat(written);
    known
        .into_iter()
        .map(|name| (strsim::damerau_levenshtein(&wanted, &flat(name)), name))
        .filter(|(distance, name)| {
            *distance <= 1 + name.len().min(wanted.len()) / 4 && *distance < wanted.len()
        })
        .min()
        .map(|(_, name)| name)
}

/// The start of a text, short enough to quote in a message.
pub(crate) fn excerpt(text: &str) -> String {
    const LONGEST: usize = 32;
    match text.char_indices().nth(LONGEST) {
        Some((cut, _)) => format!("{}…", &text[..cut]),
        None => text.to_string(),
    }
}
