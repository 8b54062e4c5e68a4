//! A second opinion on an explanation: what somebody else found, checked against the answer and
//! laid beside what the built-in judge found.
//!
//! Whoever is asked only ever fills in single findings. A finding of "yes" counts where its
//! quote stands in the answer; the verdict is computed here; what the built-in judge is sure of
//! stays, and a difference is noted for a teacher. Only what the built-in judge left open can be
//! settled, and only by words of the learner.

use crate::judge::{self, Verdict, Why};
use crate::rubric::Rubric;
use serde::Deserialize;
use std::collections::BTreeMap;

/// Whether an answer says a criterion.
#[derive(Deserialize, Clone, Copy, Debug, PartialEq, Eq)]
#[serde(rename_all = "lowercase")]
pub enum Says {
    /// It does.
    Yes,
    /// It does not.
    No,
    /// That cannot be told.
    Unsure,
}

impl Says {
    /// The word of protocol and log.
    pub fn as_str(self) -> &'static str {
        match self {
            Says::Yes => "yes",
            Says::No => "no",
            Says::Unsure => "unsure",
        }
    }
}

/// One line of a second opinion, unchecked.
#[derive(Deserialize, Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// Id of the criterion.
    pub id: String,
    /// Whether the answer says it.
    pub verdict: Says,
    /// The learner's words that decided.
    #[serde(default)]
    pub quote: Option<String>,
}

/// A second opinion, checked: only known criteria, only quotes that stand in the answer.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Opinion {
    /// What it says, by criterion.
    pub says: BTreeMap<String, Says>,
    /// Its quotes, where they stand.
    pub why: Vec<Why>,
    /// What was left out of it, as a sentence.
    pub left_out: Option<String>,
}

/// Checks findings against rubric and answer. Unknown ids are passed over; a "yes" whose quote
/// is not in the answer is a doubt; so is what is said of one criterion in two ways.
///
/// # Errors
///
/// A sentence where no known criterion is left.
pub fn verify(rubric: &Rubric, answer: &str, findings: &[Finding]) -> Result<Opinion, String> {
    let mut opinion = Opinion::default();
    let mut invented = Vec::new();
    for finding in findings {
        if rubric.criterion(&finding.id).is_none() {
            continue;
        }
        let quote = finding.quote.as_deref().filter(|it| !it.trim().is_empty());
        let place = quote.and_then(|quote| find(answer, quote));
        let mut says = finding.verdict;
        if (says == Says::Yes || quote.is_some()) && place.is_none() {
            invented.push(finding.id.clone());
            says = Says::Unsure;
        }
        let id = finding.id.clone();
        match opinion.says.get(&id) {
            Some(before) if *before != says => {
                opinion.says.insert(id.clone(), Says::Unsure);
                opinion.why.retain(|why| why.id != id);
            }
            Some(_) => {}
            None => {
                opinion.says.insert(id.clone(), says);
                opinion.why.extend(place.map(|(start, end)| Why {
                    id,
                    quote: answer[start..end].to_owned(),
                    start,
                    end,
                }));
            }
        }
    }
    if opinion.says.is_empty() {
        return Err("it says nothing about what this question asks for".to_owned());
    }
    if !invented.is_empty() {
        let ids = invented.join(", ");
        opinion.left_out = Some(format!("its words for {ids} are not in the answer"));
    }
    Ok(opinion)
}

/// Where a quote stands in an answer; white space counts as white space, however much of it.
fn find(answer: &str, quote: &str) -> Option<(usize, usize)> {
    let quote = quote.trim();
    if let Some(start) = answer.find(quote) {
        return Some((start, start + quote.len()));
    }
    let wanted: Vec<&str> = quote.split_whitespace().collect();
    let first = *wanted.first()?;
    let last = *wanted.last()?;
    answer.match_indices(first).find_map(|(start, _)| {
        let mut rest = &answer[start..];
        for (at, word) in wanted.iter().enumerate() {
            rest = if at == 0 { rest } else { rest.trim_start() }.strip_prefix(word)?;
            let ends = rest.is_empty() || rest.starts_with(char::is_whitespace);
            if !ends && *word != last {
                return None;
            }
        }
        Some((start, answer.len() - rest.len()))
    })
}

/// What two judges come to together.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Combined {
    /// Expectations met.
    pub met: Vec<String>,
    /// Misconceptions shown.
    pub misconceptions: Vec<String>,
    /// Criteria still open.
    pub unsure: Vec<String>,
    /// The verdict that follows.
    pub verdict: Verdict,
    /// Criteria of which both are sure, and not of the same; the built-in finding stands.
    pub disputed: Vec<String>,
    /// Criteria that the built-in judge left open and the second opinion settled.
    pub settled: Vec<String>,
    /// The verdict that would follow from the second opinion alone.
    pub own_verdict: Verdict,
}

impl Combined {
    /// `disputes`, `settles` or `agrees`: what is worth knowing first.
    pub fn result(&self) -> &'static str {
        if !self.disputed.is_empty() {
            "disputes"
        } else if !self.settled.is_empty() {
            "settles"
        } else {
            "agrees"
        }
    }
}

/// Lays a second opinion beside what the built-in judge heard.
pub fn combine(
    rubric: &Rubric,
    met: &[String],
    misconceptions: &[String],
    unsure: &[String],
    opinion: &Opinion,
) -> Combined {
    let contains = |ids: &[String], id: &str| ids.iter().any(|other| other == id);
    let quoted = |id: &str| opinion.why.iter().any(|why| why.id == id);
    let mut both = (Vec::new(), Vec::new(), Vec::new());
    let mut own = (Vec::new(), Vec::new(), Vec::new());
    let (mut disputed, mut settled) = (Vec::new(), Vec::new());
    for criterion in rubric.criteria() {
        let id = criterion.id;
        let (heard, list) = match criterion.is_misconception {
            true => (misconceptions, (&mut both.1, &mut own.1)),
            false => (met, (&mut both.0, &mut own.0)),
        };
        let said = opinion.says.get(id).copied().unwrap_or(Says::Unsure);
        match said {
            Says::Yes => list.1.push(id.to_owned()),
            Says::No => {}
            Says::Unsure => own.2.push(id.to_owned()),
        }
        let is_unsure = contains(unsure, id);
        let is_heard = contains(heard, id);
        let is_settled = is_unsure && said != Says::Unsure && quoted(id);
        if is_settled {
            settled.push(id.to_owned());
        } else if !is_unsure && said != Says::Unsure && is_heard != (said == Says::Yes) {
            disputed.push(id.to_owned());
        }
        if is_heard || (is_settled && said == Says::Yes) {
            list.0.push(id.to_owned());
        } else if is_unsure && !is_settled {
            both.2.push(id.to_owned());
        }
    }
    Combined {
        verdict: judge::verdict(rubric, &both.0, &both.1, &both.2),
        own_verdict: judge::verdict(rubric, &own.0, &own.1, &own.2),
        met: both.0,
        misconceptions: both.1,
        unsure: both.2,
        disputed,
        settled,
    }
}

/// Whether an answer speaks to whoever judges it, rather than about its subject: then nobody
/// who might do as he is told is asked.
pub fn speaks_to_the_judge(rubric: &Rubric, answer: &str) -> bool {
    const TELLS: [&str; 31] = [
        "ignore the rubric",
        "ignore all",
        "ignore any",
        "ignore previous",
        "ignore the previous",
        "ignore the above",
        "ignore your",
        "disregard all",
        "disregard previous",
        "disregard the above",
        "disregard the rubric",
        "disregard your",
        "forget your instructions",
        "forget all previous",
        "your instructions",
        "the rubric",
        "system prompt",
        "you are a judge",
        "you are the judge",
        "you are a grader",
        "you are the grader",
        "dear judge",
        "dear grader",
        "mark this as",
        "mark this answer",
        "grade this as",
        "judge this as",
        "verdict",
        "give full marks",
        "<|",
        "\"id\"",
    ];
    let words: Vec<String> = answer.split_whitespace().map(str::to_lowercase).collect();
    let text = words.join(" ");
    let mut ids = rubric
        .criteria()
        .map(|it| it.id)
        .filter(|id| id.contains('-'));
    TELLS.iter().any(|tell| text.contains(tell)) || ids.any(|id| text.contains(id))
}

#[cfg(test)]
mod tests;
