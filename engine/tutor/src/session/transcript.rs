//! A lesson as it was taught, as Markdown: what was shown, asked, answered and judged.

use super::{Event, Session, Start, show_problem};
use crate::lesson::Lesson;
use crate::prose::{Block, Inline, PlotView, TableView, Tone};
use crate::record::Record;
use crate::view::Stage;
use std::fmt::Write;
use std::sync::Arc;

/// The lesson as Markdown: as the record says it was taught, or all of it, unanswered.
pub fn transcript(lesson: &Arc<Lesson>, record: Option<&Record>) -> String {
    let mut out = String::new();
    line(&mut out, &format!("# {}", lesson.title.text));
    let session = match record {
        Some(record) => {
            let header = &record.header;
            let answers = record.entries.iter();
            let answers = answers
                .filter(|entry| {
                    matches!(entry.event, Event::Attempt { .. } | Event::Explained { .. })
                })
                .count();
            let ended = match &header.finished {
                Some(finished) => format!(", finished {finished}"),
                None => ", not finished".to_owned(),
            };
            line(
                &mut out,
                &format!(
                    "Lesson `{}`, begun {}{ended}, seed {}, {answers} answer{}.",
                    header.lesson,
                    header.started,
                    header.seed,
                    if answers == 1 { "" } else { "s" }
                ),
            );
            let events = record.events();
            let resumed =
                Session::resume(Arc::clone(lesson), record.start(), &header.hash, &events);
            if let Some(notice) = resumed.1 {
                line(&mut out, &format!("*{}*", escape(&notice)));
            }
            resumed.0
        }
        None => Session::all_shown(Arc::clone(lesson)),
    };
    let mut stage: Option<Stage> = None;
    for screen in &session.trail {
        let (heading, blocks) = session.page(screen);
        let here = screen.stage(lesson);
        if stage != Some(here) {
            line(&mut out, &format!("## {}", here.title()));
            stage = Some(here);
        }
        if !heading.is_empty() {
            let number = match session.place(screen) {
                (_, 1) => String::new(),
                (at, of) => format!("{at} of {of}: "),
            };
            line(&mut out, &format!("### {number}{}", escape(&heading)));
        }
        for block in &blocks {
            write_block(&mut out, block);
        }
        for block in show_problem::still_asked(&session, screen) {
            write_block(&mut out, &block);
        }
        if session.skipped.contains(&screen.to_string()) {
            line(&mut out, "*Left out.*");
        }
    }
    while out.ends_with("\n\n") {
        out.pop();
    }
    out
}

impl Session {
    /// Every screen of the lesson seen, nothing answered.
    fn all_shown(lesson: Arc<Lesson>) -> Session {
        let mut session = Session::new(lesson, Start::default());
        let path = session.path.clone();
        let lines = session.lesson.worked.as_ref().map_or(0, |w| w.lines.len());
        for screen in path.iter().take(path.len().saturating_sub(1)) {
            session.apply(&Event::Next {
                stage: screen.stage(&session.lesson),
                screen: screen.to_string(),
            });
        }
        session.apply(&Event::Revealed { lines });
        session
    }
}

fn line(out: &mut String, text: &str) {
    out.push_str(text);
    out.push_str("\n\n");
}

/// Text that Markdown would otherwise read as its own.
fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        if matches!(
            c,
            '\\' | '`' | '*' | '_' | '[' | ']' | '<' | '>' | '#' | '|'
        ) {
            out.push('\\');
        }
        out.push(c);
    }
    out
}

fn code(text: &str) -> String {
    let longest = text
        .split(|c| c != '`')
        .map(str::len)
        .max()
        .unwrap_or_default();
    let fence = "`".repeat(longest + 1);
    let space = if longest > 0 { " " } else { "" };
    format!("{fence}{space}{text}{space}{fence}")
}

fn inlines(inlines: &[Inline]) -> String {
    inlines
        .iter()
        .map(|inline| match inline {
            Inline::Text(text) => escape(text),
            Inline::Strong(text) => format!("**{}**", escape(text)),
            Inline::Emph(text) => format!("*{}*", escape(text)),
            Inline::Code(text) | Inline::Math(text) => code(text),
        })
        .collect()
}

fn fenced(out: &mut String, text: &str) {
    let ticks = text
        .lines()
        .map(|line| line.chars().take_while(|c| *c == '`').count())
        .max()
        .unwrap_or(0);
    let fence = "`".repeat(ticks.max(2) + 1);
    line(
        out,
        &format!("{fence}\n{}\n{fence}", text.trim_end_matches('\n')),
    );
}

fn write_block(out: &mut String, block: &Block) {
    match block {
        Block::Heading(heading) => line(out, &format!("#### {}", escape(heading))),
        Block::Paragraph(text) => line(out, &inlines(text)),
        Block::List { ordered, items } => {
            for (index, item) in items.iter().enumerate() {
                let bullet = if *ordered {
                    format!("{}.", index + 1)
                } else {
                    "-".to_owned()
                };
                let _ = writeln!(out, "{bullet} {}", inlines(item));
            }
            out.push('\n');
        }
        Block::CodeBlock(code) => fenced(out, code),
        Block::Quote(text) => line(out, &format!("> {}", inlines(text).replace('\n', "\n> "))),
        Block::Table(table) => write_table(out, table),
        Block::Plot(plot) => write_plot(out, plot),
        Block::Map(map) => {
            let words = format!(
                "**Map: {}** ({} over {} and {})",
                escape(&map.title),
                escape(&map.value_label),
                escape(&map.x_label),
                escape(&map.y_label)
            );
            line(out, &words);
            if !map.caption.is_empty() {
                line(out, &inlines(&map.caption));
            }
        }
        Block::Picture { title, caption, .. } => {
            line(out, &format!("**Picture: {}**", escape(title)));
            if !caption.is_empty() {
                line(out, &inlines(caption));
            }
        }
        Block::Derivation {
            name,
            lines,
            value,
            says,
        } => {
            let mut text = String::new();
            for (index, line) in lines.iter().enumerate() {
                let head = if index == 0 { name.as_str() } else { "" };
                let _ = writeln!(text, "{head:width$} = {line}", width = name.chars().count());
            }
            let width = if lines.is_empty() {
                0
            } else {
                name.chars().count()
            };
            let head = if lines.is_empty() { name.as_str() } else { "" };
            let _ = write!(text, "{head:width$} = {value}");
            fenced(out, &text);
            if !says.is_empty() {
                line(out, &inlines(says));
            }
        }
        Block::Verdict { tone, title, text } => {
            let sign = match tone {
                Tone::Good => "✓",
                Tone::Near => "≈",
                Tone::Bad => "✗",
                Tone::Info => "·",
            };
            let says = inlines(text);
            let stop = if says.is_empty() { "" } else { ". " };
            line(out, &format!("{sign} **{}**{stop}{says}", escape(title)));
        }
        Block::Checklist { points } => {
            for (point, said) in points {
                let mark = match said {
                    Some(true) => "[x]",
                    Some(false) | None => "[ ]",
                };
                let _ = writeln!(out, "- {mark} {}", escape(point));
            }
            out.push('\n');
        }
        Block::Quoted { text, marks } => {
            let mut said = String::new();
            let mut at = 0;
            for (start, end, _) in marks {
                let (Some(before), Some(marked)) = (text.get(at..*start), text.get(*start..*end))
                else {
                    continue;
                };
                let inner = marked.trim();
                said.push_str(&escape(before));
                // Emphasis that begins or ends with a space is none in Markdown.
                said.push_str(&escape(&marked[..marked.len() - marked.trim_start().len()]));
                if !inner.is_empty() {
                    let _ = write!(said, "**{}**", escape(inner));
                }
                said.push_str(&escape(
                    &marked[marked
                        .trim_end()
                        .len()
                        .max(marked.len() - marked.trim_start().len())..],
                ));
                at = *end;
            }
            said.push_str(&escape(text.get(at..).unwrap_or_default()));
            line(out, &format!("> {}", said.trim_end().replace('\n', "\n> ")));
        }
    }
}

fn row(out: &mut String, cells: impl Iterator<Item = String>) {
    let cells: Vec<String> = cells.map(|cell| cell.replace('\n', " ")).collect();
    let _ = writeln!(out, "| {} |", cells.join(" | "));
}

fn write_table(out: &mut String, table: &TableView) {
    line(out, &format!("**{}**", escape(&table.title)));
    row(out, table.header.iter().map(|cell| escape(cell)));
    row(out, table.header.iter().map(|_| "---".to_owned()));
    for cells in &table.rows {
        row(out, cells.iter().map(|cell| escape(cell)));
    }
    out.push('\n');
    if !table.note.is_empty() {
        line(out, &inlines(&table.note));
    }
}

/// A plot in words: a transcript has no picture, but it has the ends of every curve.
fn write_plot(out: &mut String, plot: &PlotView) {
    line(
        out,
        &format!(
            "**Plot: {}** ({} against {})",
            escape(&plot.title),
            escape(&plot.y_label),
            escape(&plot.x_label)
        ),
    );
    for (label, points) in &plot.series {
        if let (Some(first), Some(last)) = (points.first(), points.last()) {
            let _ = writeln!(
                out,
                "- {}: {} at {}, {} at {}",
                escape(label),
                short(first.1),
                short(first.0),
                short(last.1),
                short(last.0)
            );
        }
    }
    for (label, x, y) in &plot.marks {
        let _ = writeln!(out, "- {}: {} at {}", escape(label), short(*y), short(*x));
    }
    out.push('\n');
}

fn short(value: f64) -> String {
    formula::format_number(value, formula::Digits::Significant(3))
}
