//! One explain-back question: what was answered, what the judge heard, what was marked.

use super::event::Quote;
use crate::judge::Verdict;
use crate::lesson::{Explain, Lesson};
use crate::rubric::Rubric;
use std::collections::BTreeMap;

/// A question begun.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Question {
    /// First and second try.
    pub(super) tries: Vec<Try>,
    /// Typed, not handed in.
    pub(super) draft: String,
    /// Hints shown before the first and the second try.
    pub(super) hints: [u8; 2],
}

/// One try.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Try {
    pub(super) text: String,
    pub(super) heard: Heard,
    pub(super) unsure: Vec<String>,
    pub(super) why: Vec<Quote>,
    /// What the learner says of the points that the judge left open.
    pub(super) marks: BTreeMap<String, bool>,
    /// The learner's own marking, once done.
    pub(super) own: Option<Heard>,
}

/// What an answer says, and what that is worth.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Heard {
    pub(super) verdict: Verdict,
    pub(super) met: Vec<String>,
    pub(super) missed: Vec<String>,
    pub(super) misconceptions: Vec<String>,
    pub(super) slips: Vec<String>,
}

impl Heard {
    /// Sorts what was heard by the rubric.
    pub(super) fn new(
        rubric: &Rubric,
        verdict: Verdict,
        met: Vec<String>,
        misconceptions: Vec<String>,
    ) -> Heard {
        let missed = rubric
            .expectation
            .iter()
            .filter(|e| e.required && !met.contains(&e.id))
            .map(|e| e.id.clone())
            .collect();
        let blocks = |id: &String| {
            let known = rubric.misconception.iter().find(|m| m.id == *id);
            known.is_some_and(|m| m.blocking)
        };
        let slips = misconceptions
            .iter()
            .filter(|id| !blocks(id))
            .cloned()
            .collect();
        Heard {
            verdict,
            met,
            missed,
            misconceptions,
            slips,
        }
    }

    pub(super) fn passed(&self) -> bool {
        self.verdict == Verdict::Pass
    }
}

impl Try {
    /// What counts: the learner's own marking where there is one.
    pub(super) fn result(&self) -> &Heard {
        self.own.as_ref().unwrap_or(&self.heard)
    }

    /// The judge could not tell, and the learner has not yet.
    pub(super) fn is_open(&self) -> bool {
        self.heard.verdict == Verdict::Unsure && self.own.is_none()
    }

    /// What the learner is asked to mark: id and text, in the rubric's order.
    pub(super) fn points(&self, rubric: &Rubric) -> Vec<(String, String)> {
        let expectations = rubric.expectation.iter().map(|e| (&e.id, e.says.clone()));
        let misconceptions = rubric
            .misconception
            .iter()
            .map(|m| (&m.id, format!("(a mistake, if you say it) {}", m.says)));
        expectations
            .chain(misconceptions)
            .filter(|(id, _)| self.unsure.contains(id))
            .map(|(id, says)| (id.clone(), says))
            .collect()
    }

    /// The verdict that follows once the learner's marks settle what the judge left open.
    pub(super) fn settle(&self, rubric: &Rubric) -> Heard {
        let said = |id: &String| self.marks.get(id) == Some(&true);
        let with = |known: &[String], all: &mut dyn Iterator<Item = &String>| -> Vec<String> {
            all.filter(|id| known.contains(id) || (self.unsure.contains(id) && said(id)))
                .cloned()
                .collect()
        };
        let met = with(
            &self.heard.met,
            &mut rubric.expectation.iter().map(|e| &e.id),
        );
        let misconceptions = with(
            &self.heard.misconceptions,
            &mut rubric.misconception.iter().map(|m| &m.id),
        );
        let verdict = crate::judge::verdict(rubric, &met, &misconceptions, &[]);
        Heard::new(rubric, verdict, met, misconceptions)
    }
}

impl Question {
    /// The try that counts.
    pub(super) fn last(&self) -> Option<&Try> {
        self.tries.last()
    }

    /// The first try is settled and did not pass.
    pub(super) fn wants_second_try(&self) -> bool {
        self.tries
            .first()
            .is_some_and(|first| !first.is_open() && !first.result().passed())
    }

    /// The re-teaches that follow the first try, in order, each once: for what was missed, and
    /// for what was wrong.
    pub(super) fn reteaches(&self, lesson: &Lesson, explain: &Explain) -> Vec<String> {
        let Some(first) = self.tries.first() else {
            return Vec::new();
        };
        let result = first.result();
        let rubric = &explain.rubric;
        let missed = rubric
            .expectation
            .iter()
            .filter(|e| result.missed.contains(&e.id))
            .filter_map(|e| e.reteach.as_ref());
        let wrong = rubric
            .misconception
            .iter()
            .filter(|m| m.blocking && result.misconceptions.contains(&m.id))
            .filter_map(|m| m.reteach.as_ref());
        let mut names: Vec<String> = Vec::new();
        for name in missed.chain(wrong) {
            if !names.contains(name) && lesson.reteach(name).is_some() {
                names.push(name.clone());
            }
        }
        names
    }

    /// Nudges for a try: those of what is still missing, at most two; the third level is the
    /// model answer.
    pub(super) fn nudges<'a>(&self, explain: &'a Explain, attempt: u32) -> Vec<&'a str> {
        let first = self.tries.first().filter(|_| attempt > 1);
        let wanted = |id: &String| first.is_none_or(|first| first.result().missed.contains(id));
        let nudges = explain
            .rubric
            .expectation
            .iter()
            .filter(|e| e.required && wanted(&e.id))
            .filter_map(|e| e.hint.as_deref().or(e.ask.as_deref()));
        nudges.take(2).collect()
    }
}
