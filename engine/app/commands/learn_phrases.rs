//! `lobe judge --learn`: phrases that marked answers propose, and what they are worth.

use std::path::Path;

use serde_json::json;
use tutor::judge::evaluate::{Evaluation, Marked};
use tutor::judge::learn::{Learned, Proposal, learn};
use tutor::lesson::Explain;

use super::evaluate::{figures, number, read};
use crate::cli::Judge;
use crate::exit::{Done, Failure};
use crate::lessons::Shelf;
use crate::{output, text};

pub fn run(shelf: &Shelf, path: &Path, args: &Judge) -> Result<Done, Failure> {
    let marks = read(shelf, path)?;
    let mut any = false;
    for file in &shelf.files {
        for explain in file.lesson.iter().flat_map(|lesson| &lesson.explain) {
            let item = &explain.rubric.item;
            if !marks.iter().any(|marked| marked.item == *item) {
                continue;
            }
            any = true;
            let learned = learn(&explain.rubric, &marks);
            match args.json {
                true => as_json(&learned)?,
                false => human(&learned, explain, &file.name, &marks)?,
            }
        }
    }
    if !any {
        return Err(Failure::unusable(format!(
            "{}: no marked answer to a question that a lesson here asks; one object a line with id, item, writer, text, met, misconceptions and verdict",
            path.display()
        )));
    }
    Ok(Done::Fine)
}

fn as_json(learned: &Learned) -> Result<(), Failure> {
    let proposals = |all: &[Proposal]| -> Vec<serde_json::Value> {
        all.iter()
            .map(|it| {
                json!({
                    "criterion": it.criterion,
                    "list": it.list.as_str(),
                    "phrase": it.words,
                    "from": it.from,
                    "gains": it.gains,
                    "costs": it.costs,
                })
            })
            .collect()
    };
    output::json(&json!({
        "item": learned.item,
        "answers": learned.answers,
        "writers": learned.writers,
        "proposals": proposals(&learned.proposals),
        "lonely": proposals(&learned.lonely),
        "before": figures(&learned.before),
        "held_out": learned.held_out.as_ref().map(figures),
    }))
}

fn human(
    learned: &Learned,
    explain: &Explain,
    file: &str,
    marks: &[Marked],
) -> Result<(), Failure> {
    output::line(&format!(
        "{}: {} marked answers by {} writers ({file})",
        learned.item, learned.answers, learned.writers
    ))?;
    let row = |name: &str, it: &Evaluation| {
        output::line(&format!(
            "  {name:<28} kappa {:<6} accuracy {:<6} coverage {:<6} false pass {}/{}",
            number(it.kappa),
            number(it.accuracy.value()),
            number(it.coverage.value()),
            it.false_pass.hits,
            it.false_pass.of
        ))
    };
    row("as it is", &learned.before)?;
    match &learned.held_out {
        Some(held_out) => row("on writers not learnt from", held_out)?,
        None => output::line("  one writer only: what others would say cannot be told")?,
    }
    if learned.proposals.is_empty() {
        output::line("  No phrase would help on other writers' answers.")?;
    }
    let criteria = explain.rubric.expectation.iter().map(|e| &e.id);
    for id in criteria.chain(explain.rubric.misconception.iter().map(|m| &m.id)) {
        let of = |all: &[Proposal]| -> Vec<Proposal> {
            let mine = all.iter().filter(|it| it.criterion == *id);
            mine.cloned().collect()
        };
        let (proposals, lonely) = (of(&learned.proposals), of(&learned.lonely));
        if proposals.is_empty() && lonely.is_empty() {
            continue;
        }
        output::line(&format!("\n  {id}"))?;
        for it in &proposals {
            wrapped(&format!(
                "+{} -{}  {}: \"{}\" (from {}; helps {}{})",
                it.gains.len(),
                it.costs.len(),
                it.list.as_str(),
                it.words,
                it.from,
                some(&it.gains),
                match it.costs.is_empty() {
                    true => String::new(),
                    false => format!("; harms {}", some(&it.costs)),
                }
            ))?;
        }
        for it in &lonely {
            wrapped(&format!(
                "?      {}: \"{}\" would settle {} alone, so it is hardly worth a phrase",
                it.list.as_str(),
                it.words,
                whose(&it.from, marks)
            ))?;
        }
    }
    output::line("")
}

fn wrapped(line: &str) -> Result<(), Failure> {
    for line in text::wrap_plain(line, 92, "    ", "           ") {
        output::line(&line)?;
    }
    Ok(())
}

fn some(ids: &[String]) -> String {
    match ids {
        [a, b, c, rest @ ..] if rest.len() > 1 => {
            format!("{a}, {b}, {c} and {} more", rest.len())
        }
        _ => ids.join(", "),
    }
}

fn whose(id: &str, marks: &[Marked]) -> String {
    let writer = marks.iter().find(|marked| marked.id == id);
    match writer.map(|marked| marked.writer.as_str()) {
        None | Some("") => id.to_owned(),
        Some(writer) => format!("{id} (by {writer})"),
    }
}
