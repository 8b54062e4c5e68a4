//! The learner's own editor, for a text that is long.

use std::env;
use std::fs;
use std::io::Write as _;
use std::process::Command;

use crate::exit::plain_reason;

/// Opens a text in `$VISUAL` or `$EDITOR` and waits until it is closed; the text as it was saved,
/// or why there is none, in one sentence.
pub fn edit(text: &str) -> Result<String, String> {
    let command = ["VISUAL", "EDITOR"]
        .into_iter()
        .filter_map(|name| env::var(name).ok())
        .find(|command| !command.trim().is_empty())
        .ok_or("No editor is set: set EDITOR to one, or change the text here.")?;
    let failed =
        |error: std::io::Error| format!("The editor could not be used: {}.", plain_reason(&error));
    let mut file = tempfile::Builder::new()
        .prefix("lobe-")
        .suffix(".wgsl")
        .tempfile()
        .map_err(failed)?;
    file.write_all(text.as_bytes())
        .and_then(|()| file.flush())
        .map_err(failed)?;
    let mut words = command.split_whitespace();
    let program = words.next().unwrap_or_default();
    let status = Command::new(program)
        .args(words)
        .arg(file.path())
        .status()
        .map_err(|error| format!("{program} could not be started: {}.", plain_reason(&error)))?;
    if !status.success() {
        return Err(format!(
            "{program} ended with an error; the text is as it was."
        ));
    }
    // By its name: some editors put another file in its place.
    let size = fs::metadata(file.path()).map_err(failed)?.len();
    if size > shader::MOST_BYTES as u64 {
        return Err("What was saved is too long for a shader; the text is as it was.".to_owned());
    }
    let bytes = fs::read(file.path()).map_err(failed)?;
    String::from_utf8(bytes)
        .map_err(|_| "What was saved is no text (not UTF-8); the text is as it was.".to_owned())
}
