//! `lobe regrade`: old logs before today's judge.

use serde_json::json;
use tutor::class::{Change, regrade};
use tutor::judge::JUDGE_VERSION;

use crate::class::{Answered, Class};
use crate::cli::{Folders, Regrade};
use crate::exit::{Done, Failure};
use crate::{output, text};

pub fn run(folders: &Folders, args: &Regrade) -> Result<Done, Failure> {
    let class = Class::read(&args.folder)?;
    let shelf = super::shelf(folders)?;
    let (mut judged, mut changed, mut gone) = (0, 0, 0);
    for answered in &class.answers {
        let item = &answered.explanation.item;
        let Some(explain) = shelf.lessons().find_map(|lesson| lesson.explain(item)) else {
            gone += 1;
            continue;
        };
        judged += 1;
        let Some(change) = regrade(&explain.judge, &answered.explanation) else {
            continue;
        };
        changed += 1;
        match args.json {
            true => as_json(answered, &change)?,
            false => human(answered, &change)?,
        }
    }
    if gone > 0 {
        output::complain(&format!(
            "{gone} answers are left out: no lesson here asks their questions"
        ));
    }
    if !args.json {
        let logs = class.logs;
        output::line(&format!(
            "{judged} explanations in {logs} logs judged again (judge {JUDGE_VERSION}): {changed} verdicts changed"
        ))?;
    }
    Ok(Done::found(class.incomplete))
}

fn as_json(answered: &Answered, change: &Change) -> Result<(), Failure> {
    let it = &answered.explanation;
    let differs: Vec<String> = change
        .differs
        .iter()
        .map(|(sign, id)| format!("{sign}{id}"))
        .collect();
    output::json(&json!({
        "log": answered.log,
        "learner": answered.learner,
        "item": it.item,
        "try": it.attempt,
        "at": it.at,
        "was": change.was,
        "was_judge": it.judge,
        "now": change.now.verdict.as_str(),
        "judge": JUDGE_VERSION,
        "differs": differs,
        "unsure": change.now.unsure,
        "text": it.text,
    }))
}

fn human(answered: &Answered, change: &Change) -> Result<(), Failure> {
    let it = &answered.explanation;
    output::line(&format!(
        "{} → {}  {} try {}  {}",
        change.was,
        change.now.verdict.as_str(),
        it.item,
        it.attempt,
        answered.learner
    ))?;
    for line in text::wrap_plain(&it.text, 92, "    “", "     ") {
        output::line(&line)?;
    }
    let quote = |id: &str| {
        let why = change.now.why.iter().find(|why| why.id == id);
        why.map_or_else(String::new, |why| format!(": “{}”", why.quote))
    };
    for (sign, id) in &change.differs {
        let words = match sign {
            '+' => format!("{id} is heard now{}", quote(id)),
            _ => format!("{id} is heard no more"),
        };
        said(&words)?;
    }
    for id in &change.now.unsure {
        said(&format!("{id} is left open{}", quote(id)))?;
    }
    output::line(&format!(
        "    (judge {} then; {})\n",
        it.judge, answered.log
    ))
}

fn said(words: &str) -> Result<(), Failure> {
    for line in text::wrap_plain(words, 92, "    · ", "      ") {
        output::line(&line)?;
    }
    Ok(())
}
