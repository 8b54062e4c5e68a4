//! `lobe judge`: what the judge hears in an explanation.

use std::io::{self, Read as _};
use std::path::Path;

use serde::{Deserialize, Serialize};
use tutor::judge::{Judgement, Verdict};
use tutor::lesson::Explain;

use crate::cli::{Folders, Judge};
use crate::exit::{Done, Failure};
use crate::lessons::{Shelf, unknown};
use crate::output;

#[derive(Serialize)]
struct Judged<'a> {
    #[serde(skip_serializing_if = "Option::is_none")]
    id: Option<&'a serde_json::Value>,
    item: &'a str,
    verdict: &'a str,
    met: &'a [String],
    misconceptions: &'a [String],
    unsure: &'a [String],
    why: Vec<Why<'a>>,
}

#[derive(Serialize)]
struct Why<'a> {
    id: &'a str,
    quote: &'a str,
}

#[derive(Deserialize)]
struct Answer {
    id: serde_json::Value,
    item: String,
    text: String,
}

pub fn run(folders: &Folders, args: &Judge) -> Result<Done, Failure> {
    let shelf = super::shelf(folders)?;
    if let Some(path) = &args.evaluate {
        return super::evaluate::run(&shelf, path, args);
    }
    if let Some(path) = &args.learn {
        return super::learn_phrases::run(&shelf, path, args);
    }
    match (&args.item, &args.batch) {
        (_, Some(path)) => batch(&shelf, path),
        (Some(item), None) => one(&shelf, item, args.json),
        (None, None) => Err(Failure::unusable(
            "name a question, such as smith-g2/explain-3",
        )),
    }
}

fn find<'a>(shelf: &'a Shelf, item: &str) -> Result<&'a Explain, Failure> {
    shelf
        .lessons()
        .find_map(|lesson| lesson.explain(item))
        .ok_or_else(|| {
            let known = shelf
                .lessons()
                .flat_map(|lesson| &lesson.explain)
                .map(|explain| explain.rubric.item.as_str());
            unknown(
                "question",
                item,
                known,
                "`lobe transcript LESSON` shows them",
            )
        })
}

fn one(shelf: &Shelf, item: &str, as_json: bool) -> Result<Done, Failure> {
    let explain = find(shelf, item)?;
    let mut bytes = Vec::new();
    io::stdin()
        .lock()
        .read_to_end(&mut bytes)
        .map_err(|error| {
            Failure::unusable(format!(
                "cannot read the answer from standard input: {error}"
            ))
        })?;
    let text = String::from_utf8_lossy(&bytes);
    let judgement = explain.judge.judge(&text);
    if as_json {
        output::json(&json(None, item, &judgement))?;
    } else {
        human(explain, &judgement)?;
    }
    Ok(Done::Fine)
}

fn batch(shelf: &Shelf, path: &Path) -> Result<Done, Failure> {
    let mut out = String::new();
    for (index, line) in super::lines_of(path)?.iter().enumerate() {
        if line.trim().is_empty() {
            continue;
        }
        let answer: Answer = serde_json::from_str(line).map_err(|error| {
            Failure::unusable(format!(
                "{}:{}: not an answer ({error}): one object a line with id, item and text",
                path.display(),
                index + 1
            ))
        })?;
        let explain = find(shelf, &answer.item).map_err(|failure| match failure {
            Failure::Unusable(why) => {
                Failure::unusable(format!("{}:{}: {why}", path.display(), index + 1))
            }
            other => other,
        })?;
        let judgement = explain.judge.judge(&answer.text);
        let judged = json(Some(&answer.id), &answer.item, &judgement);
        out.push_str(&serde_json::to_string(&judged).unwrap_or_default());
        out.push('\n');
    }
    output::text(&out)?;
    Ok(Done::Fine)
}

fn json<'a>(
    id: Option<&'a serde_json::Value>,
    item: &'a str,
    judgement: &'a Judgement,
) -> Judged<'a> {
    Judged {
        id,
        item,
        verdict: judgement.verdict.as_str(),
        met: &judgement.met,
        misconceptions: &judgement.misconceptions,
        unsure: &judgement.unsure,
        why: judgement
            .why
            .iter()
            .map(|why| Why {
                id: &why.id,
                quote: &why.quote,
            })
            .collect(),
    }
}

fn human(explain: &Explain, judgement: &Judgement) -> Result<(), Failure> {
    output::line(match judgement.verdict {
        Verdict::Pass => "✓ pass",
        Verdict::Partial => "≈ partial",
        Verdict::Fail => "✗ fail",
        Verdict::Unsure => "! unsure",
    })?;
    let quotes = |id: &str| -> String {
        let quotes: Vec<String> = judgement
            .why
            .iter()
            .filter(|why| why.id == id)
            .map(|why| format!("“{}”", why.quote))
            .collect();
        if quotes.is_empty() {
            String::new()
        } else {
            format!(": {}", quotes.join(", "))
        }
    };
    for expectation in &explain.rubric.expectation {
        let id = expectation.id.as_str();
        let sign = if judgement.met.iter().any(|met| met == id) {
            "✓"
        } else if judgement.unsure.iter().any(|unsure| unsure == id) {
            "?"
        } else {
            "·"
        };
        output::line(&format!("  {sign} {id}{}", quotes(id)))?;
    }
    for misconception in &explain.rubric.misconception {
        let id = misconception.id.as_str();
        if judgement.misconceptions.iter().any(|shown| shown == id) {
            output::line(&format!("  ✗ {id}{}", quotes(id)))?;
        }
    }
    Ok(())
}
