//! A rubric's own examples: what the judge marks otherwise, and which phrase would help.

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
        if let Some(words) = phrase_that_helps(rubric, example, &id, is_misconception) {
            return Some(format!("the phrase \"{words}\" for {id} would settle it"));
        }
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
        Some(format!(
            "its words \"{}\" are heard as the phrase \"{phrase}\" of {id}",
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

/// The shortest run of the example's own words that, as a phrase, brings the author's verdict
/// and takes it from no other example.
fn phrase_that_helps(
    rubric: &Rubric,
    example: &Example,
    id: &str,
    is_misconception: bool,
) -> Option<String> {
    let agreed = |rubric: &Rubric| {
        let judge = Judge::new(rubric);
        rubric
            .example
            .iter()
            .filter(|e| differs(e, &judge.judge(&e.text)).is_none())
            .count()
    };
    let before = agreed(rubric);
    let mut candidates = phrase::clauses_of(lexicon(), &example.text);
    candidates.sort_by_key(String::len);
    candidates.into_iter().take(12).find(|words| {
        let mut changed = rubric.clone();
        let list = if is_misconception {
            changed
                .misconception
                .iter_mut()
                .find(|m| m.id == id)
                .map(|m| &mut m.phrases)
        } else {
            changed
                .expectation
                .iter_mut()
                .find(|e| e.id == id)
                .map(|e| &mut e.phrases)
        };
        let Some(list) = list else { return false };
        list.push(words.clone());
        let now = Judge::new(&changed).judge(&example.text);
        differs(example, &now).is_none() && agreed(&changed) > before
    })
}
