//! What a tutor asks back about an answer: one pointed question, a hint, a sentence with a
//! blank, last the answer; about what the judge doubts and what a nearly good answer lacks.
//!
//! Which question stands open follows from the answer and from what was said since; nothing
//! about it is kept but the turns themselves.

use super::event::Quote;
use super::question::{Heard, Second, Try};
use crate::judge::Verdict;
use crate::rubric::{Criterion, Misconception, Rubric};
use serde::{Deserialize, Serialize};

/// So many criteria of one answer are asked about, at most.
const MOST_CRITERIA: usize = 2;
/// So many questions follow one answer, at most: whoever cannot say it then is better served by
/// another angle than by another question.
const MOST_QUESTIONS: usize = 5;

/// How much of the answer a question gives away.
#[derive(Serialize, Deserialize, Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[serde(rename_all = "kebab-case")]
pub enum Rung {
    /// A pointed question.
    Ask,
    /// A nudge after it.
    Hint,
    /// A sentence with a blank.
    Prompt,
}

impl Rung {
    /// From 1 to 3, as hints are counted.
    pub(super) fn level(self) -> u8 {
        match self {
            Rung::Ask => 1,
            Rung::Hint => 2,
            Rung::Prompt => 3,
        }
    }
}

/// A question to the learner.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Asked {
    /// Id of the criterion.
    pub(super) about: String,
    pub(super) rung: Rung,
}

/// What became of a question.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Turn {
    Replied(Box<Reply>),
    /// The learner asked for more help instead.
    Further {
        about: String,
        rung: Rung,
    },
    /// The learner wants to be asked no more.
    Left,
}

/// A reply, and what is heard now.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Reply {
    pub(super) about: String,
    pub(super) rung: Rung,
    /// The question as the learner read it.
    pub(super) asked: String,
    pub(super) text: String,
    /// The words in it that decided something.
    pub(super) why: Vec<Quote>,
    /// What answer and replies say together, as the built-in judge heard it.
    pub(super) first: Heard,
    /// The second opinion, where one was asked for.
    pub(super) second: Option<Second>,
}

impl Reply {
    /// What answer and replies say together.
    pub(super) fn heard(&self) -> &Heard {
        let settled = self.second.as_ref().and_then(|it| it.settled.as_ref());
        settled.unwrap_or(&self.first)
    }
}

/// The dialogue as it went.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Step<'a> {
    Asked(Asked),
    Replied(&'a Reply),
    /// The answer was given: nothing that is said of it afterwards counts.
    Told(String),
    Left,
}

/// The rungs that an author gives a criterion; without any there is one question that fits all.
fn rungs(criterion: &Criterion<'_>) -> Vec<Rung> {
    let given = [
        (Rung::Ask, criterion.ask.is_some()),
        (Rung::Hint, criterion.hint.is_some()),
        (Rung::Prompt, criterion.prompt.is_some()),
    ];
    let rungs: Vec<Rung> = given.into_iter().filter(|it| it.1).map(|it| it.0).collect();
    if rungs.is_empty() {
        vec![Rung::Ask]
    } else {
        rungs
    }
}

/// What the answer lacks or leaves in doubt, and is worth a question: nothing in a full answer,
/// in one that is mostly missing, and in one that says something wrong, which is taught again.
fn agenda<'r>(rubric: &'r Rubric, heard: &Heard) -> Vec<Criterion<'r>> {
    if heard.passed() || wrong(rubric, heard).is_some() {
        return Vec::new();
    }
    let contains = |ids: &[String], id: &str| ids.iter().any(|other| other == id);
    let open: Vec<Criterion<'_>> = rubric
        .criteria()
        .filter(|it| it.decides)
        .filter(|it| {
            contains(&heard.unsure, it.id)
                || (!it.is_misconception && contains(&heard.missed, it.id))
        })
        .collect();
    let something = rubric
        .expectation
        .iter()
        .any(|e| e.required && (heard.met.contains(&e.id) || heard.unsure.contains(&e.id)))
        || incomplete(rubric, heard).is_some();
    let all_in_doubt = heard.verdict == Verdict::Unsure && heard.may_pass(rubric);
    let nearly_good = something && open.len() <= MOST_CRITERIA;
    if all_in_doubt || nearly_good {
        open.into_iter().take(MOST_CRITERIA).collect()
    } else {
        Vec::new()
    }
}

/// A blocking misconception that was heard, and that no answer to a question could excuse.
fn wrong<'a>(rubric: &Rubric, heard: &'a Heard) -> Option<&'a String> {
    let blocks = |id: &&String| {
        let known = rubric.misconception.iter().find(|m| m.id == **id);
        known.is_some_and(|m| m.blocking && !is_excusable(rubric, m))
    };
    heard.misconceptions.iter().find(blocks)
}

/// A heard misconception that is one only as long as an expectation is not met.
pub(super) fn incomplete<'a>(rubric: &Rubric, heard: &'a Heard) -> Option<&'a String> {
    let excusable = |id: &&String| {
        let known = rubric.misconception.iter().find(|m| m.id == **id);
        known.is_some_and(|m| m.blocking && is_excusable(rubric, m))
    };
    heard.misconceptions.iter().find(excusable)
}

/// Whether more said could make the same words harmless.
fn is_excusable(rubric: &Rubric, misconception: &Misconception) -> bool {
    let mut expectations = rubric.expectation.iter();
    expectations.any(|e| misconception.unless.contains(&e.id))
}

fn is_settled(criterion: &Criterion<'_>, heard: &Heard) -> bool {
    let among = |ids: &[String]| ids.iter().any(|id| id == criterion.id);
    match criterion.is_misconception {
        true => !among(&heard.unsure),
        false => among(&heard.met),
    }
}

/// The dialogue about a try: what was asked, replied and told, and the question that stands
/// open.
pub(super) fn script<'a>(rubric: &Rubric, tried: &'a Try) -> (Vec<Step<'a>>, Option<Asked>) {
    let mut steps = Vec::new();
    let mut heard = tried.opened();
    let mut turns = tried.turns.iter();
    let mut questions = 0;
    for criterion in agenda(rubric, heard) {
        for rung in rungs(&criterion) {
            if is_settled(&criterion, heard) {
                break;
            }
            if questions == MOST_QUESTIONS {
                return (steps, None);
            }
            questions += 1;
            let asked = Asked {
                about: criterion.id.to_owned(),
                rung,
            };
            steps.push(Step::Asked(asked.clone()));
            match turns.next() {
                None => return (steps, Some(asked)),
                Some(Turn::Left) => {
                    steps.push(Step::Left);
                    return (steps, None);
                }
                Some(Turn::Further { .. }) => {}
                Some(Turn::Replied(reply)) => {
                    steps.push(Step::Replied(reply));
                    heard = reply.heard();
                    if wrong(rubric, heard).is_some() {
                        return (steps, None);
                    }
                }
            }
        }
        if !is_settled(&criterion, heard) {
            steps.push(Step::Told(criterion.id.to_owned()));
        }
    }
    (steps, None)
}
