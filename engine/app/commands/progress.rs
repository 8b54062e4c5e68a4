//! `lobe progress`: the learner's record.

use serde::Serialize;
use tutor::record::Record;
use tutor::session::{Event, progress};

use crate::cli::{Folders, Json};
use crate::exit::{Done, Failure};
use crate::store::Log;
use crate::{output, text};

#[derive(Serialize)]
struct Session<'a> {
    file: String,
    lesson: &'a str,
    started: &'a str,
    finished: Option<&'a str>,
    seed: u64,
    state: String,
    answers: Vec<Answer<'a>>,
    slips: Vec<&'a str>,
}

#[derive(Serialize)]
struct Answer<'a> {
    at: &'a str,
    item: &'a str,
    step: Option<&'a str>,
    text: &'a str,
    result: &'a str,
    mistake: Option<&'a str>,
    took_ms: u64,
}

pub fn run(folders: &Folders, args: Json) -> Result<Done, Failure> {
    let store = super::store(folders)?;
    let logs = store.logs()?;
    for unreadable in &logs.unreadable {
        output::complain(&format!(
            "{}: {}; the file is left as it is",
            unreadable.path.display(),
            unreadable.why
        ));
    }
    for log in &logs.readable {
        if args.json {
            output::json(&session(log))?;
        } else {
            human(&session(log))?;
        }
    }
    if logs.readable.is_empty() && !args.json {
        output::line("Nothing yet: `lobe learn 1` begins the first lesson.")?;
    }
    Ok(Done::found(!logs.unreadable.is_empty()))
}

fn session(log: &Log) -> Session<'_> {
    let Record { header, entries } = &log.record;
    let answers = entries
        .iter()
        .filter_map(|entry| match &entry.event {
            Event::Attempt {
                item,
                step,
                text,
                result,
                mistake,
                ..
            } => Some(Answer {
                at: &entry.at,
                item,
                step: Some(step.as_str()).filter(|step| !step.is_empty()),
                text,
                result,
                mistake: mistake.as_deref(),
                took_ms: entry.took_ms,
            }),
            Event::Explained {
                item,
                text,
                verdict,
                ..
            } => Some(Answer {
                at: &entry.at,
                item,
                step: None,
                text,
                result: verdict,
                mistake: None,
                took_ms: entry.took_ms,
            }),
            _ => None,
        })
        .collect();
    let mut slips: Vec<&str> = entries
        .iter()
        .filter_map(|entry| match &entry.event {
            Event::Explained { slips, .. } | Event::SelfMarked { slips, .. } => Some(slips),
            _ => None,
        })
        .flatten()
        .map(String::as_str)
        .collect();
    slips.sort_unstable();
    slips.dedup();
    Session {
        file: log.path.display().to_string(),
        lesson: &header.lesson,
        started: &header.started,
        finished: header.finished.as_deref(),
        seed: header.seed,
        state: progress::state(&log.record).words(),
        answers,
        slips,
    }
}

fn human(session: &Session) -> Result<(), Failure> {
    output::line(&format!(
        "{}  {}  {}",
        when(session.started),
        session.lesson,
        session.state
    ))?;
    for answer in &session.answers {
        let sign = match answer.result {
            "correct" | "carried" | "pass" => "✓",
            "precision" | "partial" => "≈",
            "invalid" | "unsure" => "!",
            _ => "✗",
        };
        let step = answer
            .step
            .map_or_else(String::new, |step| format!(" {step}"));
        let mistake = answer
            .mistake
            .map_or_else(String::new, |id| format!(" ({id})"));
        let first = answer.text.lines().next().unwrap_or_default();
        let line = format!(
            "{}{step}: {first} · {}{mistake}",
            answer.item, answer.result
        );
        for line in text::wrap_plain(&line, 80, &format!("  {sign} "), "      ") {
            output::line(&line)?;
        }
    }
    if !session.slips.is_empty() {
        output::line(&format!("  noted for later: {}", session.slips.join(", ")))?;
    }
    output::line("")
}

/// A logged time in the learner's own time zone.
fn when(logged: &str) -> String {
    match logged.parse::<jiff::Timestamp>() {
        Ok(time) => time
            .to_zoned(jiff::tz::TimeZone::system())
            .strftime("%Y-%m-%d %H:%M")
            .to_string(),
        Err(_) => logged.to_owned(),
    }
}
