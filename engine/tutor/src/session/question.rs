//! One explain-back question: what was answered, what the judge heard, what was marked.

use super::dialogue::{Asked, Reply, Turn};
use super::event::{Event, Quote};
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
    /// What the built-in judge heard in the text alone.
    pub(super) first: Heard,
    pub(super) why: Vec<Quote>,
    /// The second opinion, where one was asked for.
    pub(super) second: Option<Second>,
    /// What was said back and forth about it.
    pub(super) turns: Vec<Turn>,
    /// The question that stands open, by what was said.
    pub(super) asked: Option<Asked>,
    /// What the learner says of the points that are open after that.
    pub(super) marks: BTreeMap<String, bool>,
    /// The learner's own marking, once done.
    pub(super) own: Option<Heard>,
}

/// What a second opinion came to.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Second {
    /// What counts from then on, where it settled something.
    pub(super) settled: Option<Heard>,
    /// The words behind what it settled.
    pub(super) why: Vec<Quote>,
    /// Why there is none.
    pub(super) problem: Option<String>,
}

/// What an answer says, and what that is worth.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Heard {
    pub(super) verdict: Verdict,
    pub(super) met: Vec<String>,
    pub(super) missed: Vec<String>,
    pub(super) misconceptions: Vec<String>,
    pub(super) slips: Vec<String>,
    pub(super) unsure: Vec<String>,
}

impl Heard {
    /// What an event of a log says of an answer; none of one that says nothing of that kind.
    pub(super) fn of(event: &Event) -> Option<Heard> {
        let none = Vec::new();
        let (verdict, met, missed, misconceptions, slips, unsure) = match event {
            Event::Explained {
                verdict,
                met,
                missed,
                misconceptions,
                slips,
                unsure,
                ..
            }
            | Event::Replied {
                verdict,
                met,
                missed,
                misconceptions,
                slips,
                unsure,
                ..
            }
            | Event::SecondOpinion {
                verdict,
                met,
                missed,
                misconceptions,
                slips,
                unsure,
                ..
            } => (verdict, met, missed, misconceptions, slips, unsure),
            // A learner's own marking leaves nothing open.
            Event::SelfMarked {
                verdict,
                met,
                missed,
                misconceptions,
                slips,
                ..
            } => (verdict, met, missed, misconceptions, slips, &none),
            _ => return None,
        };
        Some(Heard {
            verdict: Verdict::parse(verdict).unwrap_or(Verdict::Fail),
            met: met.clone(),
            missed: missed.clone(),
            misconceptions: misconceptions.clone(),
            slips: slips.clone(),
            unsure: unsure.clone(),
        })
    }

    /// Sorts what was heard by the rubric.
    pub(super) fn new(
        rubric: &Rubric,
        met: Vec<String>,
        misconceptions: Vec<String>,
        unsure: Vec<String>,
    ) -> Heard {
        let verdict = crate::judge::verdict(rubric, &met, &misconceptions, &unsure);
        let missed = rubric
            .expectation
            .iter()
            .filter(|e| e.required && !met.contains(&e.id) && !unsure.contains(&e.id))
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
            unsure,
        }
    }

    pub(super) fn passed(&self) -> bool {
        self.verdict == Verdict::Pass
    }

    /// Whether it passes once everything unsure turns out well.
    pub(super) fn may_pass(&self, rubric: &Rubric) -> bool {
        let mut met = self.met.clone();
        met.extend(self.unsure.iter().cloned());
        crate::judge::verdict(rubric, &met, &self.misconceptions, &[]) == Verdict::Pass
    }
}

impl Try {
    /// What judges heard up to now, in answer and replies.
    pub(super) fn heard(&self) -> &Heard {
        let replied = self.turns.iter().rev().find_map(|turn| match turn {
            Turn::Replied(reply) => Some(reply.heard()),
            Turn::Further { .. } | Turn::Left => None,
        });
        replied.unwrap_or_else(|| self.opened())
    }

    /// The place of the second opinion on a reply, from 1, or on the answer, 0; and how many turns
    /// there were since.
    pub(super) fn second_of(&mut self, reply: u32) -> Option<(&mut Option<Second>, usize)> {
        if reply == 0 {
            return Some((&mut self.second, self.turns.len()));
        }
        let count = self.turns.len();
        let mut replies = self
            .turns
            .iter_mut()
            .enumerate()
            .filter_map(|(at, turn)| match turn {
                Turn::Replied(reply) => Some((at, reply.as_mut())),
                Turn::Further { .. } | Turn::Left => None,
            });
        let (at, reply) = replies.nth(reply as usize - 1)?;
        Some((&mut reply.second, count - at - 1))
    }

    /// The replies, oldest first.
    pub(super) fn replies(&self) -> impl DoubleEndedIterator<Item = &Reply> {
        self.turns.iter().filter_map(|turn| match turn {
            Turn::Replied(reply) => Some(reply.as_ref()),
            Turn::Further { .. } | Turn::Left => None,
        })
    }

    /// What was heard before anything was asked back.
    pub(super) fn opened(&self) -> &Heard {
        let settled = self.second.as_ref().and_then(|it| it.settled.as_ref());
        settled.unwrap_or(&self.first)
    }

    /// What counts: the learner's own marking where there is one.
    pub(super) fn result(&self) -> &Heard {
        self.own.as_ref().unwrap_or_else(|| self.heard())
    }

    /// Nothing is asked any more; it could pass if what is unsure were so; and the learner has
    /// not yet said whether it is.
    pub(super) fn wants_marks(&self, rubric: &Rubric) -> bool {
        let heard = self.heard();
        self.asked.is_none()
            && self.own.is_none()
            && heard.verdict == Verdict::Unsure
            && heard.may_pass(rubric)
    }

    /// Something is still to be said or marked.
    pub(super) fn is_open(&self, rubric: &Rubric) -> bool {
        self.asked.is_some() || self.wants_marks(rubric)
    }

    /// What the learner is asked to mark: id and text, in the rubric's order.
    pub(super) fn points(&self, rubric: &Rubric) -> Vec<(String, String)> {
        let unsure = &self.heard().unsure;
        rubric
            .criteria()
            .filter(|criterion| unsure.iter().any(|id| id == criterion.id))
            .map(|criterion| {
                let says = match criterion.is_misconception {
                    false => criterion.says.to_owned(),
                    true => format!("(a mistake, if you say it) {}", criterion.says),
                };
                (criterion.id.to_owned(), says)
            })
            .collect()
    }

    /// The verdict that follows once the learner's marks settle what the judge left open.
    pub(super) fn settle(&self, rubric: &Rubric) -> Heard {
        let heard = self.heard();
        let said = |id: &str| self.marks.get(id) == Some(&true);
        let with = |known: &[String], misconceptions: bool| -> Vec<String> {
            rubric
                .criteria()
                .filter(|criterion| criterion.is_misconception == misconceptions)
                .map(|criterion| criterion.id.to_owned())
                .filter(|id| known.contains(id) || (heard.unsure.contains(id) && said(id)))
                .collect()
        };
        let met = with(&heard.met, false);
        let misconceptions = with(&heard.misconceptions, true);
        Heard::new(rubric, met, misconceptions, Vec::new())
    }

    /// The words behind a criterion, wherever the learner said them last.
    pub(super) fn words_for(&self, id: &str) -> Option<&str> {
        let replies = self.replies().rev().flat_map(|reply| {
            let second = reply.second.iter().map(|second| &second.why);
            [&reply.why].into_iter().chain(second)
        });
        let second = self.second.iter().map(|second| &second.why);
        let mut all = replies.chain([&self.why]).chain(second).flatten();
        all.find(|why| why.id == id).map(|why| why.quote.trim())
    }
}

impl Question {
    /// The try that counts.
    pub(super) fn last(&self) -> Option<&Try> {
        self.tries.last()
    }

    /// What stands in the field is an answer, not a reply.
    pub(super) fn is_being_answered(&self) -> bool {
        self.last().is_none_or(|last| last.asked.is_none())
    }

    /// The first try is settled and did not pass.
    pub(super) fn wants_second_try(&self, rubric: &Rubric) -> bool {
        self.tries
            .first()
            .is_some_and(|first| !first.is_open(rubric) && !first.result().passed())
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
