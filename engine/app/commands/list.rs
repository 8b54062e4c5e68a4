//! `lobe list`: the lessons, how far one is, what is due.

use serde::Serialize;

use crate::cli::{Folders, Json};
use crate::exit::{Done, Failure};
use crate::tui::picker::{Entry, entries};
use crate::{output, text};

#[derive(Serialize)]
struct Row<'a> {
    number: u32,
    id: &'a str,
    title: &'a str,
    minutes: u32,
    needs: Vec<&'a str>,
    state: String,
    sessions: usize,
    answers: usize,
    due: Vec<&'a str>,
}

pub fn run(folders: &Folders, args: Json) -> Result<Done, Failure> {
    let shelf = super::shelf(folders)?;
    let entries = entries(&shelf, &super::store(folders)?);
    for entry in &entries {
        if args.json {
            output::json(&row(entry))?;
        } else {
            human(entry)?;
        }
    }
    if !args.json {
        output::line("\n`lobe learn LESSON` takes a lesson by its id or number.")?;
    }
    Ok(Done::Fine)
}

fn row(entry: &Entry) -> Row<'_> {
    Row {
        number: entry.number,
        id: &entry.lesson.id,
        title: &entry.lesson.title,
        minutes: entry.lesson.minutes,
        needs: entry
            .lesson
            .needs
            .iter()
            .map(|id| id.text.as_str())
            .collect(),
        state: entry.summary.state.words(),
        sessions: entry.summary.sessions,
        answers: entry.summary.answers,
        due: entry
            .summary
            .due
            .iter()
            .map(|due| due.item.as_str())
            .collect(),
    }
}

fn human(entry: &Entry) -> Result<(), Failure> {
    let Entry {
        number,
        lesson,
        summary,
    } = entry;
    output::line(&format!(
        "{number:>2}  {:<18} {} ({} min)",
        lesson.id.text, lesson.title, lesson.minutes
    ))?;
    output::line(&format!("    {}", summary.state.words()))?;
    if !summary.due.is_empty() {
        let due: Vec<String> = summary
            .due
            .iter()
            .map(|due| match due.overdue {
                0 => due.item.clone(),
                1 => format!("{} (since yesterday)", due.item),
                days => format!("{} ({days} days ago)", due.item),
            })
            .collect();
        for line in text::wrap_plain(&due.join(", "), 80, "    due: ", "         ") {
            output::line(&line)?;
        }
    }
    Ok(())
}
