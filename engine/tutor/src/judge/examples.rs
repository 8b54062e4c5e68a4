//! A rubric's own examples: what the judge marks otherwise, and which phrase would help.

use std::cmp::Reverse;
use std::collections::BTreeSet;

use super::lexicon::lexicon;
use super::{Judge, Judgement, Verdict, phrase};
use crate::rubric::{Example, Rubric};

/// One of a rubric's own examples that the judge marks otherwise than its author.
#[derive(Clone, Debug, PartialEq)]
pub struct ExampleFinding {
    /// Position of the example in the rubric, from 0.
    pub example: usize,
    /// What the author says.
    pub expected: String,
    /// What the judge says.
    pub found: Judgement,
    /// What differs, and which phrase would help, as a sentence.
    pub message: String,
}

/// Judges the rubric's own examples; what fails, and which phrase would help.
pub fn check_examples(rubric: &Rubric) -> Vec<ExampleFinding> {
    let judge = Judge::new(rubric);
    let mut findings = Vec::new();
    for (position, example) in rubric.example.iter().enumerate() {
        let found = judge.judge(&example.text);
        let Some(problem) = differs(example, &found) else {
            continue;
        };
        let message = match remedy(rubric, &judge, example, &found) {
            Some(advice) => format!("{problem}; {advice}"),
            None => problem,
        };
        findings.push(ExampleFinding {
            example: position,
            expected: example.verdict.clone(),
            found,
            message,
        });
    }
    findings
}

/// What differs, as a sentence; `None` where the judge agrees with the author.
fn differs(example: &Example, found: &Judgement) -> Option<String> {
    if Verdict::parse(&example.verdict).is_none() {
        return Some(format!(
            "\"{}\" is no verdict: pass, partial, fail or unsure",
            example.verdict
        ));
    }
    let mut parts = Vec::new();
    if found.verdict.as_str() != example.verdict {
        parts.push(format!(
            "judged {}, its author says {}",
            found.verdict.as_str(),
            example.verdict
        ));
    }
    for (wanted, heard) in [
        (&example.met, &found.met),
        (&example.misconceptions, &found.misconceptions),
    ] {
        let Some(wanted) = wanted else { continue };
        parts.extend(
            wanted
                .iter()
                .filter(|id| !heard.contains(id))
                .map(|id| format!("{id} is not heard")),
        );
        parts.extend(
            heard
                .iter()
                .filter(|id| !wanted.contains(id))
                .map(|id| format!("{id} is heard where it should not be")),
        );
    }
    (!parts.is_empty()).then(|| parts.join(", "))
}

/// Advice: the words of the example that would do as a phrase, or the phrase that hears too
/// much.
fn remedy(rubric: &Rubric, judge: &Judge, example: &Example, found: &Judgement) -> Option<String> {
    for (id, is_misconception) in wanting(rubric, example, found) {
        if let Some(words) = phrase_that_helps(rubric, example, found, &id, is_misconception) {
            return Some(format!("the phrase \"{words}\" for {id} would settle it"));
        }
    }
    if let Some(advice) = phrases_that_help(rubric, example, found) {
        return Some(advice);
    }
    let surplus = |wanted: &Option<Vec<String>>, heard: &[String]| -> Vec<String> {
        heard
            .iter()
            .filter(|id| !wanted.as_ref().is_some_and(|wanted| wanted.contains(id)))
            .cloned()
            .collect()
    };
    let mut heard = surplus(&example.met, &found.met);
    heard.extend(surplus(&example.misconceptions, &found.misconceptions));
    heard.extend(found.unsure.iter().cloned());
    heard.into_iter().find_map(|id| {
        let why = found.why.iter().find(|why| why.id == id)?;
        let phrase = judge.phrase_heard(&id, &example.text)?;
        let heard = match found.unsure.contains(&id) {
            true => "are half heard",
            false => "are heard",
        };
        Some(format!(
            "its words \"{}\" {heard} as the phrase \"{phrase}\" of {id}",
            why.quote
        ))
    })
}

/// Criteria that the author would hear in the example and the judge does not.
fn wanting(rubric: &Rubric, example: &Example, found: &Judgement) -> Vec<(String, bool)> {
    let expectations = rubric.expectation.iter().filter(|e| match &example.met {
        Some(met) => met.contains(&e.id) && !found.met.contains(&e.id),
        None => e.required && example.verdict != "fail" && !found.met.contains(&e.id),
    });
    let misconceptions = rubric
        .misconception
        .iter()
        .filter(|m| match &example.misconceptions {
            Some(shown) => shown.contains(&m.id) && !found.misconceptions.contains(&m.id),
            None => {
                m.blocking && example.verdict != "pass" && !found.misconceptions.contains(&m.id)
            }
        });
    expectations
        .map(|e| (e.id.clone(), false))
        .chain(misconceptions.map(|m| (m.id.clone(), true)))
        .collect()
}

/// The run of the example's own words that, as a phrase, brings the author's verdict and takes
/// it from no other example.
fn phrase_that_helps(
    rubric: &Rubric,
    example: &Example,
    found: &Judgement,
    id: &str,
    is_misconception: bool,
) -> Option<String> {
    let before = agreed(rubric);
    candidates(rubric, example, found, id)
        .into_iter()
        .find(|words| {
            let changed = with_phrase(rubric, id, is_misconception, words);
            let now = Judge::new(&changed).judge(&example.text);
            differs(example, &now).is_none() && agreed(&changed) > before
        })
}

/// The same where one phrase is not enough: one for each expectation that the author hears.
fn phrases_that_help(rubric: &Rubric, example: &Example, found: &Judgement) -> Option<String> {
    // Of a partial answer nobody said which part it is.
    if example.verdict != "pass" && example.met.is_none() {
        return None;
    }
    let mut changed = rubric.clone();
    let mut parts: Vec<(String, String)> = Vec::new();
    for (id, is_misconception) in wanting(rubric, example, found) {
        let is_free = |words: &String| parts.iter().all(|(_, taken)| taken != words);
        let words = candidates(rubric, example, found, &id)
            .into_iter()
            .filter(is_free)
            .find(|words| {
                let changed = with_phrase(&changed, &id, is_misconception, words);
                let now = Judge::new(&changed).judge(&example.text);
                now.met.contains(&id) || now.misconceptions.contains(&id)
            })?;
        changed = with_phrase(&changed, &id, is_misconception, &words);
        parts.push((id, words));
    }
    let now = Judge::new(&changed).judge(&example.text);
    if differs(example, &now).is_some() || agreed(&changed) <= agreed(rubric) {
        return None;
    }
    let parts: Vec<String> = parts
        .iter()
        .map(|(id, words)| format!("\"{words}\" for {id}"))
        .collect();
    Some(format!(
        "the phrases {} would settle it",
        parts.join(" and ")
    ))
}

/// How many examples are judged as their author says.
fn agreed(rubric: &Rubric) -> usize {
    let judge = Judge::new(rubric);
    let agrees = |e: &&Example| differs(e, &judge.judge(&e.text)).is_none();
    rubric.example.iter().filter(agrees).count()
}

fn with_phrase(rubric: &Rubric, id: &str, is_misconception: bool, words: &str) -> Rubric {
    let mut changed = rubric.clone();
    let phrases = match is_misconception {
        true => changed
            .misconception
            .iter_mut()
            .find(|it| it.id == id)
            .map(|it| &mut it.phrases),
        false => changed
            .expectation
            .iter_mut()
            .find(|it| it.id == id)
            .map(|it| &mut it.phrases),
    };
    if let Some(phrases) = phrases {
        phrases.push(words.to_owned());
    }
    changed
}

/// Stretches of an example that may say a criterion, likeliest first: those that share most words
/// with it, and none that is heard as another.
fn candidates(rubric: &Rubric, example: &Example, found: &Judgement, id: &str) -> Vec<String> {
    let (mut own, mut other) = (BTreeSet::new(), BTreeSet::new());
    for criterion in rubric.criteria() {
        let words = stems(criterion.says);
        match criterion.id == id {
            true => own.extend(words),
            false => other.extend(words),
        }
    }
    let own: BTreeSet<String> = own.difference(&other).cloned().collect();
    let is_others = |words: &String| {
        let mut why = found.why.iter();
        why.any(|it| it.id != id && words.contains(it.quote.trim()))
    };
    let likeness = |words: &String| {
        let words = stems(words);
        let shared = words.intersection(&own).count();
        // Per mille, so that it can be sorted by; long stretches share something with anything.
        1000 * shared / (words.len() + 3)
    };
    let mut candidates = phrase::clauses_of(lexicon(), &example.text);
    candidates.retain(|words| !is_others(words));
    candidates.sort_by_key(|words| (Reverse(likeness(words)), words.len()));
    candidates.truncate(12);
    candidates
}

/// Words as a rough ear hears them: without their endings, short ones left out.
fn stems(text: &str) -> BTreeSet<String> {
    text.split(|c: char| !c.is_alphanumeric())
        .filter(|word| word.chars().count() > 2)
        .map(|word| word.to_lowercase().chars().take(5).collect())
        .collect()
}
