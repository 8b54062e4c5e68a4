//! Events become state. Total: an event that does not fit is passed over and remembered as such.

use super::Session;
use super::consult::Consulted;
use super::dialogue::{self, Asked, Reply, Turn};
use super::event::{Event, Quote};
use super::problem::{self, Problem, mix};
use super::question::{Heard, Question, Second, Try};
use super::screen::{Screen, due_path, faded_lines};
use crate::view::Stage;
use std::collections::BTreeMap;
use std::sync::Arc;

impl Session {
    /// Applies one event.
    pub(super) fn apply(&mut self, event: &Event) {
        match event {
            Event::Next { stage, screen } | Event::Back { stage, screen } => {
                // A re-teach belongs to the stage of its question, which came before it.
                if *stage != Stage::Reteach {
                    self.stage = *stage;
                }
                match Screen::find(&self.lesson, screen) {
                    Some(screen) => self.go_to(screen),
                    None => self.diverged = true,
                }
            }
            Event::Revealed { lines } => self.revealed = *lines,
            Event::Skip { screen } => {
                self.skipped.insert(screen.clone());
            }
            Event::GoOn { item, round, step } => {
                let step = step.clone();
                self.turn(item, *round, problem::Turn::GoneOn { step });
                if let Some(problem) = self.problems.get_mut(&(item.clone(), *round)) {
                    problem.draft = None;
                }
            }
            Event::Hint {
                item,
                round,
                step,
                level,
            } => {
                let level = (*level).clamp(1, 3);
                if self.lesson.explain(item).is_some() && !step.is_empty() {
                    let about = step.clone();
                    self.further(item, *round, about);
                } else if self.lesson.explain(item).is_some() {
                    let index = round.clamp(&1, &2) - 1;
                    self.question(item).hints[index as usize] = level;
                } else {
                    let step = step.clone();
                    self.turn(item, *round, problem::Turn::Hint { step, level });
                }
            }
            Event::Draft { item, text } if self.lesson.exercise(item).is_some() => {
                // It was typed on the screen shown, whatever round that is.
                let shown = self.problem_key(self.here()).filter(|key| key.0 == *item);
                let key = shown.unwrap_or_else(|| (item.clone(), 0));
                self.begin(item, key.1);
                if let Some(problem) = self.problems.get_mut(&key) {
                    problem.draft = Some(text.clone());
                }
            }
            Event::Draft { item, text } => self.question(item).draft.clone_from(text),
            Event::Attempt {
                item,
                round,
                step,
                seed: _,
                given,
                text,
                result,
                mistake,
                named,
                says,
            } => {
                self.turn(
                    item,
                    *round,
                    problem::Turn::Attempt {
                        step: step.clone(),
                        text: text.clone(),
                        result: result.clone(),
                        mistake: mistake.clone(),
                        named: *named,
                        says: says.clone(),
                    },
                );
                if let Some(problem) = self.problems.get_mut(&(item.clone(), *round)) {
                    problem.answered_to = Some(given.clone());
                    problem.draft = None;
                }
            }
            Event::Explained { .. } => self.explained(event),
            Event::Replied { .. } => self.replied(event),
            Event::LeftOpen { item, attempt } => {
                let is_asked = self.asked(item, *attempt).is_some();
                self.take_turn(item, *attempt, is_asked, Turn::Left);
            }
            Event::SecondOpinion { .. } => self.second_opinion(event),
            Event::Marked {
                item,
                attempt,
                point,
                said,
            } => {
                if let Some(tried) = self.tried(item, *attempt) {
                    tried.marks.insert(point.clone(), *said);
                }
            }
            Event::SelfMarked { item, attempt, .. } => {
                if let Some(tried) = self.tried(item, *attempt) {
                    tried.own = Heard::of(event);
                }
            }
            Event::Finished { grade, words } => self.finished = Some((*grade, words.clone())),
            Event::DueAgain { items } => {
                self.path = due_path(&self.lesson, items);
                self.asks_due = true;
                self.restart(Stage::Why);
            }
            Event::LessonChanged { stage, .. } => self.restart(*stage),
        }
    }

    /// Shows a screen; one not seen before comes after the one shown now.
    fn go_to(&mut self, screen: Screen) {
        self.cursor = match self.trail.iter().position(|seen| *seen == screen) {
            Some(seen) => seen,
            None => {
                self.trail.insert(self.cursor + 1, screen.clone());
                self.cursor + 1
            }
        };
        match screen {
            Screen::Worked => self.revealed = self.revealed.max(1),
            Screen::Faded(round) => {
                if let Some(item) = self.faded_item() {
                    self.begin(&item, round);
                }
            }
            Screen::Practice(item) => self.begin(&item, 0),
            Screen::Retest(item) => self.begin(&item, 1),
            Screen::Explain { item, .. } => {
                self.question(&item);
            }
            Screen::Why | Screen::Step(_) | Screen::Reteach { .. } | Screen::Result => {}
        }
    }

    /// Whether what was replayed does not fit this lesson and this program. Answers in stages
    /// that are behind may be of other numbers; only the stage shown has to fit.
    pub(super) fn has_diverged(&self) -> bool {
        let stage = self.here().base_stage(&self.lesson);
        let of_stage = |screen: &&Screen| screen.base_stage(&self.lesson) == stage;
        self.diverged
            || self
                .path
                .iter()
                .filter(of_stage)
                .filter_map(|screen| self.problem(screen))
                .any(Problem::is_stale)
    }

    /// Begins an exercise, once.
    fn begin(&mut self, item: &str, round: u32) {
        let key = (item.to_owned(), round);
        if self.problems.contains_key(&key) {
            return;
        }
        let Some(exercise) = self.lesson.exercise(item) else {
            self.diverged = true;
            return;
        };
        let last = (self.faded_item().as_deref() == Some(item))
            .then(|| faded_lines(&self.lesson, round))
            .flatten();
        let seed = mix(self.start.seed, item, round);
        let problem = Problem::new(&self.lesson, exercise, seed, last);
        self.problems.insert(key, problem);
    }

    fn turn(&mut self, item: &str, round: u32, turn: problem::Turn) {
        self.begin(item, round);
        let Some(problem) = self.problems.get_mut(&(item.to_owned(), round)) else {
            return;
        };
        if !problem.asked.iter().any(|asked| asked == turn.step()) {
            self.diverged = true;
        }
        problem.turns.push(turn);
    }

    fn question(&mut self, item: &str) -> &mut Question {
        self.questions.entry(item.to_owned()).or_default()
    }

    fn tried(&mut self, item: &str, attempt: u32) -> Option<&mut Try> {
        let index = (attempt as usize).checked_sub(1)?;
        let tried = self.questions.get_mut(item)?.tries.get_mut(index);
        self.diverged |= tried.is_none();
        tried
    }

    fn explained(&mut self, event: &Event) {
        let Event::Explained {
            item,
            attempt,
            text,
            why,
            ..
        } = event
        else {
            return;
        };
        let Some(first) = Heard::of(event) else {
            return;
        };
        let question = self.question(item);
        if question.tries.len() + 1 != *attempt as usize {
            self.diverged = true;
            return;
        }
        question.draft.clear();
        question.tries.push(Try {
            text: text.clone(),
            first,
            why: why.clone(),
            second: None,
            turns: Vec::new(),
            asked: None,
            marks: BTreeMap::new(),
            own: None,
        });
        self.ask_on(item, *attempt);
    }

    /// The question that stands open about a try.
    fn asked(&self, item: &str, attempt: u32) -> Option<&Asked> {
        let index = (attempt as usize).checked_sub(1)?;
        self.questions.get(item)?.tries.get(index)?.asked.as_ref()
    }

    /// Finds the question that follows from what was said.
    fn ask_on(&mut self, item: &str, attempt: u32) {
        let lesson = Arc::clone(&self.lesson);
        if let (Some(explain), Some(tried)) = (lesson.explain(item), self.tried(item, attempt)) {
            tried.asked = dialogue::script(&explain.rubric, tried).1;
        }
    }

    fn take_turn(&mut self, item: &str, attempt: u32, fits: bool, turn: Turn) {
        if !fits {
            self.diverged = true;
            return;
        }
        // What was begun in reply goes on in reply to the next help.
        if !matches!(turn, Turn::Further { .. }) {
            self.question(item).draft.clear();
        }
        if let Some(tried) = self.tried(item, attempt) {
            tried.turns.push(turn);
        }
        self.ask_on(item, attempt);
    }

    fn further(&mut self, item: &str, attempt: u32, about: String) {
        let asked = self.asked(item, attempt).cloned();
        match asked.filter(|asked| asked.about == about) {
            Some(Asked { rung, .. }) => {
                let turn = Turn::Further { about, rung };
                self.take_turn(item, attempt, true, turn);
            }
            None => self.diverged = true,
        }
    }

    fn replied(&mut self, event: &Event) {
        let Event::Replied {
            item,
            attempt,
            about,
            rung,
            asked,
            text,
            why,
            ..
        } = event
        else {
            return;
        };
        let Some(first) = Heard::of(event) else {
            return;
        };
        let question = Asked {
            about: about.clone(),
            rung: *rung,
        };
        let fits = self.asked(item, *attempt) == Some(&question);
        let reply = Reply {
            about: about.clone(),
            rung: *rung,
            asked: asked.clone(),
            text: text.clone(),
            why: why.clone(),
            first,
            second: None,
        };
        self.take_turn(item, *attempt, fits, Turn::Replied(Box::new(reply)));
    }

    fn second_opinion(&mut self, event: &Event) {
        let Event::SecondOpinion {
            item,
            attempt,
            reply,
            settled,
            why,
            result,
            problem,
            ..
        } = event
        else {
            return;
        };
        let Some(heard) = Heard::of(event) else {
            return;
        };
        let about = Consulted {
            item: item.clone(),
            attempt: *attempt,
            reply: *reply,
        };
        if self.waiting.as_ref() == Some(&about) {
            self.waiting = None;
        }
        let Some(tried) = self.tried(item, *attempt) else {
            return;
        };
        let is_settled = tried.own.is_some() || !tried.marks.is_empty();
        let Some((second, since)) = tried.second_of(*reply) else {
            self.diverged = true;
            return;
        };
        // What was asked or marked meanwhile is not undone by an opinion that comes late.
        let in_time = since == 0 && !is_settled;
        let decided = |why: &&Quote| settled.contains(&why.id);
        *second = Some(Second {
            settled: (in_time && !settled.is_empty()).then_some(heard),
            why: why.iter().filter(decided).cloned().collect(),
            problem: problem.clone().filter(|_| in_time && result == "unusable"),
        });
        self.ask_on(item, *attempt);
    }

    /// Back to the start of a stage: what was done in it is forgotten, what came before stays.
    fn restart(&mut self, stage: Stage) {
        let lesson = &self.lesson;
        // A stage that the lesson no longer has gives way to the next one it has.
        let start = self
            .path
            .iter()
            .position(|screen| screen.base_stage(lesson) >= stage)
            .unwrap_or(self.path.len() - 1);
        let again: Vec<Screen> = self.path[start..].to_vec();
        self.trail = self.path[..=start].to_vec();
        self.cursor = start;
        self.stage = self.path[start].base_stage(lesson);
        for screen in &again {
            match screen {
                Screen::Worked => self.revealed = 0,
                Screen::Faded(round) => {
                    if let Some(item) = self.faded_item() {
                        self.problems.remove(&(item, *round));
                    }
                }
                Screen::Practice(item) => {
                    self.problems.remove(&(item.clone(), 0));
                }
                Screen::Retest(item) => {
                    self.problems.remove(&(item.clone(), 1));
                }
                Screen::Explain { item, .. } => {
                    // Half an answer is still one; half a reply belongs to what is forgotten.
                    let half = self
                        .questions
                        .remove(item)
                        .filter(Question::is_being_answered);
                    if let Some(Question { draft, .. }) = half {
                        self.question(item).draft = draft;
                    }
                }
                Screen::Why | Screen::Step(_) | Screen::Reteach { .. } | Screen::Result => {}
            }
            self.skipped.remove(&screen.to_string());
        }
        self.diverged = false;
        self.finished = None;
        let screen = self.path[start].clone();
        self.go_to(screen);
        let seen = self.trail[..start].to_vec();
        for screen in &seen {
            self.visit(screen);
        }
    }

    /// Makes a screen ready to be looked back at.
    fn visit(&mut self, screen: &Screen) {
        match screen {
            Screen::Faded(round) => {
                if let Some(item) = self.faded_item() {
                    self.begin(&item, *round);
                }
            }
            Screen::Practice(item) => self.begin(item, 0),
            Screen::Retest(item) => self.begin(item, 1),
            _ => {}
        }
    }

    /// Id of the faded worked example.
    pub(super) fn faded_item(&self) -> Option<String> {
        let faded = self.lesson.worked.as_ref()?.faded.as_ref()?;
        Some(faded.exercise.id.text.clone())
    }

    /// The exercise of a screen and its round.
    pub(super) fn problem_key(&self, screen: &Screen) -> Option<(String, u32)> {
        match screen {
            Screen::Faded(round) => Some((self.faded_item()?, *round)),
            Screen::Practice(item) => Some((item.clone(), 0)),
            Screen::Retest(item) => Some((item.clone(), 1)),
            Screen::Why
            | Screen::Step(_)
            | Screen::Worked
            | Screen::Explain { .. }
            | Screen::Reteach { .. }
            | Screen::Result => None,
        }
    }

    /// The exercise of a screen.
    pub(super) fn problem(&self, screen: &Screen) -> Option<&Problem> {
        self.problems.get(&self.problem_key(screen)?)
    }

    /// The screen after one, by what has happened on it.
    pub(super) fn after(&self, at: &Screen) -> Option<Screen> {
        let (Screen::Explain { item, .. } | Screen::Reteach { item, .. }) = at else {
            return self.after_item(at);
        };
        let again = || Screen::Explain {
            item: item.clone(),
            attempt: 2,
        };
        let (Some(question), Some(explain)) = (self.questions.get(item), self.lesson.explain(item))
        else {
            return self.after_item(at);
        };
        let reteach = |index: usize| {
            let names = question.reteaches(&self.lesson, explain);
            Some(Screen::Reteach {
                item: item.clone(),
                name: names.get(index)?.clone(),
            })
        };
        match at {
            Screen::Explain { attempt: 1, .. } if question.wants_second_try(&explain.rubric) => {
                Some(reteach(0).unwrap_or_else(again))
            }
            Screen::Reteach { name, .. } => {
                let names = question.reteaches(&self.lesson, explain);
                let here = names.iter().position(|other| other == name);
                let next = here.and_then(|here| reteach(here + 1));
                Some(next.unwrap_or_else(again))
            }
            _ => self.after_item(at),
        }
    }

    /// The screen after one and all that may follow from it.
    pub(super) fn after_item(&self, at: &Screen) -> Option<Screen> {
        let at = match at {
            Screen::Explain { item, .. } | Screen::Reteach { item, .. } => &Screen::Explain {
                item: item.clone(),
                attempt: 1,
            },
            other => other,
        };
        let index = self.path.iter().position(|screen| screen == at)?;
        self.path.get(index + 1).cloned()
    }

    /// The first screen of the next stage on the path.
    pub(super) fn after_stage(&self, at: &Screen) -> Option<Screen> {
        let stage = at.base_stage(&self.lesson);
        self.path
            .iter()
            .find(|screen| screen.base_stage(&self.lesson) > stage)
            .cloned()
    }
}
