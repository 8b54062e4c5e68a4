//! `lobe doctor`: what this machine offers.

use std::env;
use std::io::{self, IsTerminal as _};
use std::path::Path;

use serde::Serialize;

use crate::cli::{Folders, Json};
use crate::config::{self, Config};
use crate::exit::{Done, Failure};
use crate::lessons::Shelf;
use crate::output;
use crate::tui::draw::LEAST;
use crate::tui::probe;

#[derive(Serialize)]
struct Report {
    version: &'static str,
    terminal: Option<Terminal>,
    colours: bool,
    adapter: Option<String>,
    adapter_missing: Option<String>,
    lessons: Vec<String>,
    lessons_broken: Vec<String>,
    progress: String,
    progress_unwritable: Option<String>,
    settings: Option<String>,
    settings_broken: Option<String>,
    second_opinions: Option<Vec<String>>,
}

#[derive(Serialize)]
struct Terminal {
    columns: u16,
    rows: u16,
    pictures: &'static str,
}

pub fn run(folders: &Folders, args: Json) -> Result<Done, Failure> {
    let shelf = Shelf::open(folders.lessons.as_deref())?;
    let store = super::store(folders)?;
    let adapter = renders::gpu_adapter();
    let (settings, settings_broken) = match config::read() {
        Ok(settings) => (settings, None),
        Err(Failure::Unusable(why)) => (Config::default(), Some(why)),
        Err(other) => return Err(other),
    };
    let report = Report {
        version: env!("CARGO_PKG_VERSION"),
        terminal: terminal(),
        colours: env::var_os("NO_COLOR").is_none_or(|value| value.is_empty()),
        adapter_missing: adapter.as_ref().err().map(ToString::to_string),
        adapter: adapter.ok(),
        lessons: shelf
            .files
            .iter()
            .filter(|file| file.lesson.is_some())
            .map(|file| file.name.clone())
            .collect(),
        lessons_broken: shelf.broken().map(|file| file.why_broken()).collect(),
        progress: store.folder.display().to_string(),
        progress_unwritable: store.try_out().err(),
        settings: config::path().map(|path| path.display().to_string()),
        settings_broken,
        second_opinions: settings.judge.map(|judge| judge.command),
    };
    if args.json {
        output::json(&report)?
    } else {
        human(&report)?
    }
    Ok(Done::found(
        !report.lessons_broken.is_empty()
            || report.progress_unwritable.is_some()
            || report.settings_broken.is_some(),
    ))
}

/// What the terminal shows; `None` where this is no terminal.
fn terminal() -> Option<Terminal> {
    if !io::stdin().is_terminal() || !io::stdout().is_terminal() {
        return None;
    }
    let (columns, rows) = crossterm::terminal::size().ok()?;
    // The answers come as keys would: unseen, and without waiting for Enter.
    crossterm::terminal::enable_raw_mode().ok()?;
    // Nobody is asked anything here, so what was typed is for the shell, which cannot have it.
    let (picker, _typed) = probe::picker();
    crossterm::terminal::disable_raw_mode().ok()?;
    Some(Terminal {
        columns,
        rows,
        pictures: probe::name(picker.protocol_type()),
    })
}

fn human(report: &Report) -> Result<(), Failure> {
    let say = |good: bool, what: &str, is: &str| {
        let sign = if good { "✓" } else { "!" };
        output::line(&format!("{sign} {what:<10} {is}"))
    };
    say(true, "lobe", report.version)?;
    match &report.terminal {
        Some(terminal) => {
            let enough = terminal.columns >= LEAST.0 && terminal.rows >= LEAST.1;
            let hint = if enough {
                ""
            } else {
                " (too small: 80x24 is comfortable)"
            };
            say(
                enough,
                "terminal",
                &format!("{}x{}{hint}", terminal.columns, terminal.rows),
            )?;
            say(true, "pictures", terminal.pictures)?;
        }
        None => say(true, "terminal", "none: lessons run as plain text")?,
    }
    say(
        true,
        "colours",
        if report.colours {
            "on (NO_COLOR=1 turns them off)"
        } else {
            "off (NO_COLOR)"
        },
    )?;
    match (&report.adapter, &report.adapter_missing) {
        (Some(adapter), _) => say(true, "adapter", adapter)?,
        (None, Some(why)) => say(
            false,
            "adapter",
            &format!("{why}; pictures are drawn by the CPU"),
        )?,
        (None, None) => {}
    }
    say(
        !report.lessons.is_empty(),
        "lessons",
        &report.lessons.join(", "),
    )?;
    for broken in &report.lessons_broken {
        say(false, "lessons", broken)?;
    }
    match &report.progress_unwritable {
        None => say(true, "answers", &report.progress)?,
        Some(why) => say(
            false,
            "answers",
            &format!(
                "{}: {why}; name another folder with --progress",
                report.progress
            ),
        )?,
    }
    match (&report.settings_broken, &report.settings) {
        (Some(why), _) => say(false, "settings", why)?,
        (None, Some(path)) => {
            let there = if Path::new(path).exists() {
                ""
            } else {
                " (not there, and not needed)"
            };
            say(true, "settings", &format!("{path}{there}"))?;
        }
        (None, None) => {}
    }
    match &report.second_opinions {
        Some(command) => say(
            true,
            "second",
            &format!("opinions by {}", command.join(" ")),
        ),
        None => say(
            true,
            "second",
            "opinions: off ([judge] command turns them on)",
        ),
    }
}
