//! What is wrong with a lesson file, and where.

use serde::Serialize;

/// A stretch of a lesson file, in bytes; `start..end`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Place {
    /// First byte.
    pub start: usize,
    /// One past the last byte.
    pub end: usize,
}

/// Whether a finding makes `lobe check` fail.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Severity {
    /// The lesson says or does something wrong.
    Error,
    /// Worth a look.
    Warning,
}

/// One thing that is wrong with a lesson file.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Finding {
    /// The file as its reader named it.
    pub file: String,
    /// Line, from 1.
    pub line: usize,
    /// Column, from 1, in characters.
    pub column: usize,
    /// First byte in the file.
    pub start: usize,
    /// One past the last byte in the file.
    pub end: usize,
    /// Whether it makes a check fail.
    pub severity: Severity,
    /// A stable name for this kind of finding, such as `number-differs`.
    pub code: &'static str,
    /// What is wrong, as one sentence.
    pub message: String,
    /// What should stand there instead, where that can be said.
    pub expected: Option<String>,
    /// The next step, where there is one to name.
    pub help: Option<String>,
}

impl Finding {
    /// An error at a place of a file.
    pub fn new(
        file: &str,
        source: &str,
        place: Place,
        code: &'static str,
        message: impl Into<String>,
    ) -> Finding {
        let start = floor_char_boundary(source, place.start);
        let end = floor_char_boundary(source, place.end).max(start);
        let (line, column) = line_and_column(source, start);
        Finding {
            file: file.to_owned(),
            line,
            column,
            start,
            end,
            severity: Severity::Error,
            code,
            message: message.into(),
            expected: None,
            help: None,
        }
    }

    /// The same finding, saying what should stand there.
    #[must_use]
    pub fn expecting(mut self, expected: impl Into<String>) -> Finding {
        self.expected = Some(expected.into());
        self
    }

    /// The same finding with a next step.
    #[must_use]
    pub fn with_help(mut self, help: impl Into<String>) -> Finding {
        self.help = Some(help.into());
        self
    }

    /// The same finding, as a warning.
    #[must_use]
    pub fn warning(mut self) -> Finding {
        self.severity = Severity::Warning;
        self
    }
}

/// Line and column, from 1, columns in characters, of a byte offset.
pub fn line_and_column(source: &str, offset: usize) -> (usize, usize) {
    let before = &source[..floor_char_boundary(source, offset)];
    let line = before.bytes().filter(|&byte| byte == b'\n').count() + 1;
    let line_start = before.rfind('\n').map_or(0, |at| at + 1);
    (line, before[line_start..].chars().count() + 1)
}

fn floor_char_boundary(source: &str, offset: usize) -> usize {
    let mut offset = offset.min(source.len());
    while !source.is_char_boundary(offset) {
        offset -= 1;
    }
    offset
}
