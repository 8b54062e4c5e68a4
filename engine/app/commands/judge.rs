//! `lobe judge`: what the judge hears in an explanation.

use std::collections::BTreeMap;
use std::io::{self, Read as _};
use std::path::Path;

use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use tutor::judge::{Judgement, Verdict};
use tutor::lesson::Explain;
use tutor::opinion;

use crate::cli::{Folders, Judge};
use crate::config::{self, SecondJudge};
use crate::exit::{Done, Failure};
use crate::lessons::{Shelf, unknown};
use crate::output;
use crate::second::Asking;

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
    #[serde(skip_serializing_if = "Option::is_none")]
    second: Option<&'a Second>,
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
    let judge = match args.second_opinion {
        true => Some(second_judge()?),
        false => None,
    };
    match (&args.item, &args.batch) {
        (_, Some(path)) => batch(&shelf, path, judge.as_ref()),
        (Some(item), None) => one(&shelf, item, judge.as_ref(), args.json),
        (None, None) => Err(Failure::unusable(
            "name a question, such as smith-g2/explain-3",
        )),
    }
}

fn second_judge() -> Result<SecondJudge, Failure> {
    config::read()?.judge.ok_or_else(|| {
        let place = config::path().map_or_else(String::new, |it| it.display().to_string());
        Failure::unusable(format!(
            "nobody is named for second opinions: write [judge] command = [\"program\"] into {place}"
        ))
    })
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

fn one(
    shelf: &Shelf,
    item: &str,
    judge: Option<&SecondJudge>,
    as_json: bool,
) -> Result<Done, Failure> {
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
    let (judgement, second) = judged(explain, &text, judge);
    if as_json {
        output::json(&json(None, item, &judgement, second.as_ref()))?;
    } else {
        human(explain, &judgement)?;
        if let Some(second) = &second {
            second.say()?;
        }
    }
    Ok(Done::Fine)
}

/// What is heard, by the built-in judge or by both together.
fn judged(
    explain: &Explain,
    text: &str,
    judge: Option<&SecondJudge>,
) -> (Judgement, Option<Second>) {
    let own = explain.judge.judge(text);
    let Some(judge) = judge else {
        return (own, None);
    };
    let rubric = &explain.rubric;
    let said = match opinion::speaks_to_the_judge(rubric, text) {
        true => Err("the answer speaks to the judge".to_owned()),
        false => Asking::start(judge, rubric, text, &[]).wait(),
    };
    let checked = said.and_then(|findings| opinion::verify(rubric, text, &findings));
    let by = judge.name();
    let checked = match checked {
        Ok(checked) => checked,
        Err(problem) => {
            let second = Second {
                by,
                result: "unusable",
                problem: Some(problem),
                ..Second::default()
            };
            return (own, Some(second));
        }
    };
    let both = opinion::combine(rubric, &own.met, &own.misconceptions, &own.unsure, &checked);
    let second = Second {
        by,
        result: both.result(),
        problem: checked.left_out,
        own_verdict: Some(both.own_verdict.as_str()),
        says: checked
            .says
            .into_iter()
            .map(|(id, says)| (id, says.as_str()))
            .collect(),
        disputed: both.disputed,
        settled: both.settled,
    };
    let mut why = own.why;
    for more in checked.why {
        if second.settled.contains(&more.id) {
            why.retain(|it| it.id != more.id);
            why.push(more);
        }
    }
    let both = Judgement {
        verdict: both.verdict,
        met: both.met,
        misconceptions: both.misconceptions,
        unsure: both.unsure,
        why,
    };
    (both, Some(second))
}

/// A second opinion, and what it came to.
#[derive(Default, Serialize)]
struct Second {
    by: String,
    /// `agrees`, `settles`, `disputes` or `unusable`.
    result: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    problem: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    own_verdict: Option<&'static str>,
    says: BTreeMap<String, &'static str>,
    disputed: Vec<String>,
    settled: Vec<String>,
}

impl Second {
    fn say(&self) -> Result<(), Failure> {
        output::line(&format!("second opinion by {}: {}", self.by, self.result))?;
        if let Some(problem) = &self.problem {
            output::line(&format!("  ! {problem}"))?;
        }
        for (what, ids) in [("settled", &self.settled), ("disputed", &self.disputed)] {
            if !ids.is_empty() {
                output::line(&format!("  {what}: {}", ids.join(", ")))?;
            }
        }
        Ok(())
    }
}

/// Judges every line; one that cannot be read is named, and the others are judged all the same.
fn batch(shelf: &Shelf, path: &Path, judge: Option<&SecondJudge>) -> Result<Done, Failure> {
    /// Lines judged before any of them is printed.
    const AT_ONCE: usize = 256;
    let (mut good, mut bad) = (0, 0);
    let lines = super::lines_of(path)?;
    let lines: Vec<(usize, &String)> = (1..).zip(&lines).collect();
    for some in lines.chunks(AT_ONCE) {
        let one = |(number, line): &(usize, &String)| {
            let judged = || judged_line(shelf, line, judge);
            (!line.trim().is_empty()).then(|| (*number, judged()))
        };
        let judged: Vec<_> = match judge {
            None => some.par_iter().filter_map(one).collect(),
            // A user's program is asked one thing at a time.
            Some(_) => some.iter().filter_map(one).collect(),
        };
        for (number, judged) in judged {
            match judged {
                Ok(line) => {
                    good += 1;
                    output::line(&line)?;
                }
                Err(Failure::Unusable(why)) => {
                    bad += 1;
                    output::complain(&format!("{}:{number}: {why}", path.display()));
                }
                Err(other) => return Err(other),
            }
        }
    }
    match bad {
        0 => Ok(Done::Fine),
        _ => Err(Failure::unusable(format!(
            "{bad} of {} lines of {} could not be judged: mend or remove them",
            good + bad,
            path.display()
        ))),
    }
}

fn judged_line(shelf: &Shelf, line: &str, judge: Option<&SecondJudge>) -> Result<String, Failure> {
    let answer: Answer = serde_json::from_str(line).map_err(|error| {
        Failure::unusable(format!(
            "not an answer ({error}): one object a line with id, item and text"
        ))
    })?;
    let explain = find(shelf, &answer.item)?;
    let (judgement, second) = judged(explain, &answer.text, judge);
    let judged = json(Some(&answer.id), &answer.item, &judgement, second.as_ref());
    Ok(serde_json::to_string(&judged).unwrap_or_default())
}

fn json<'a>(
    id: Option<&'a serde_json::Value>,
    item: &'a str,
    judgement: &'a Judgement,
    second: Option<&'a Second>,
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
        second,
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
