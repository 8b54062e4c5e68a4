//! How a command ends: the three exit codes, and one clear line for what went wrong.

use std::io;
use std::path::Path;
use std::process::ExitCode;

/// A command that ran to its end.
#[must_use]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Done {
    /// Exit 0.
    Fine,
    /// Exit 1: it ran, and found something wrong, and has said what.
    FoundWrong,
}

impl Done {
    /// `FoundWrong` where `wrong` holds.
    pub fn found(wrong: bool) -> Self {
        if wrong { Self::FoundWrong } else { Self::Fine }
    }
}

/// A command that could not run.
#[derive(Debug)]
pub enum Failure {
    /// Exit 2: bad usage or unreadable input. The line names the file and what to do.
    Unusable(String),
    /// Whoever read our output has gone (`lobe list | head -1`): not an error, nothing to say.
    ReaderGone,
}

impl Failure {
    /// A line for the user.
    pub fn unusable(line: impl Into<String>) -> Self {
        Self::Unusable(line.into())
    }

    /// What clap says of a command line, on one line: what is wrong, and what to type.
    pub fn usage(error: &clap::Error) -> Self {
        let text = error.render().to_string();
        let said = text.split("\n\nUsage:").next().unwrap_or_default();
        let words: Vec<&str> = said.split_whitespace().collect();
        let said = words.join(" ");
        let said = said
            .strip_prefix("error: ")
            .unwrap_or(&said)
            .replace(" For more information, try '--help'.", "")
            .replace(" tip: ", "; ");
        Self::Unusable(format!("{said}; `lobe help` shows what there is"))
    }

    /// A file that could not be read.
    pub fn unreadable(path: &Path, error: &io::Error) -> Self {
        Self::Unusable(format!(
            "cannot read {}: {}",
            path.display(),
            plain_reason(error)
        ))
    }

    /// Something that could not be written.
    pub fn unwritable(path: &Path, error: &io::Error) -> Self {
        Self::Unusable(format!(
            "cannot write {}: {}",
            path.display(),
            plain_reason(error)
        ))
    }
}

/// The operating system's words without its number: "No space left on device".
pub fn plain_reason(error: &io::Error) -> String {
    let text = error.to_string();
    match text.find(" (os error") {
        Some(end) => text[..end].to_owned(),
        None => text,
    }
}

/// The exit code, after saying on standard error what went wrong.
pub fn code_of(result: Result<Done, Failure>) -> ExitCode {
    match result {
        Ok(Done::Fine) | Err(Failure::ReaderGone) => ExitCode::SUCCESS,
        Ok(Done::FoundWrong) => ExitCode::from(1),
        Err(Failure::Unusable(line)) => {
            crate::output::complain(&line);
            ExitCode::from(2)
        }
    }
}
