//! Messages become events: here answers are marked and explanations judged, once.

use super::Session;
use super::consult::Consulted;
use super::dialogue::Asked;
use super::event::{Effect, Event, Msg, Quote};
use super::pointing::Pointing;
use super::problem::{Problem, WHOLE};
use super::question::{Heard, Question, Try};
use super::reply;
use super::run::Running;
use super::screen::Screen;
use crate::exercise::{self, Draw, Marking};
use crate::judge::{JUDGE_VERSION, Judgement};
use crate::lesson::{Exercise, Explain, Lesson, Task};
use crate::view::{Input, Saving};

/// What a message leads to.
#[derive(Default)]
pub(super) struct Decided {
    pub(super) events: Vec<Event>,
    /// One line for the learner.
    pub(super) note: Option<String>,
    pub(super) saving: Option<Saving>,
    pub(super) effects: Vec<Effect>,
    /// The try whose second opinion is waited for from here on.
    pub(super) waits: Option<Consulted>,
    /// The try on which nobody is asked for a second opinion, for it tells judges what to do.
    pub(super) asks_nobody: Option<Consulted>,
    /// A shader that runs from here on.
    pub(super) running: Option<Running>,
    /// A place that is looked at from here on.
    pub(super) pointing: Option<Pointing>,
    pub(super) quit: bool,
}

impl Decided {
    pub(super) fn event(event: Event) -> Decided {
        Decided {
            events: vec![event],
            ..Decided::default()
        }
    }

    pub(super) fn note(note: impl Into<String>) -> Decided {
        Decided {
            note: Some(note.into()),
            ..Decided::default()
        }
    }
}

/// What stands open on a screen.
pub(super) enum Open<'a> {
    /// Nothing: the screen is there to be read.
    Nothing,
    /// A line of the worked example to reveal.
    Line,
    /// A step of an exercise.
    Step(&'a Problem, &'a str),
    /// An explanation to write.
    Text(&'a Explain, &'a Question),
    /// A second opinion to wait for.
    Opinion,
    /// A question of the tutor's to reply to.
    Reply(&'a Explain, &'a Try, &'a Asked),
    /// A checklist to mark.
    Marks(&'a Explain, &'a Question),
}

impl Session {
    /// Decides what a message leads to, and applies it.
    pub(super) fn decide(&mut self, msg: Msg) -> Decided {
        let mut decided = match msg {
            Msg::Next => self.next(),
            Msg::Back => self.back(),
            Msg::Skip => self.skip(),
            Msg::Hint => self.hint(),
            Msg::Answer(text) => self.answer(text),
            Msg::Draft(text) => self.draft(text),
            Msg::Mark { point, said } => self.mark(point, said),
            Msg::ChecklistDone => self.checklist_done(),
            Msg::SecondOpinion {
                item,
                attempt,
                reply,
                by,
                said,
            } => self.second_opinion_came(
                &Consulted {
                    item,
                    attempt,
                    reply,
                },
                by,
                said,
            ),
            Msg::Ran(ran) => self.ran(&ran),
            Msg::Looked(sight) => self.looked(&sight),
            Msg::AskDue(items) => self.ask_due(items),
            Msg::SaveFailed(why) => Decided {
                saving: Some(Saving::Failed(why)),
                note: self.view.note.take(),
                ..Decided::default()
            },
            Msg::Saved => Decided {
                saving: Some(Saving::Saved),
                note: self.view.note.take(),
                ..Decided::default()
            },
            Msg::Quit => Decided {
                quit: true,
                ..Decided::default()
            },
        };
        for event in &decided.events {
            self.apply(event);
        }
        if let Some(about) = decided.asks_nobody.take() {
            let problem = Err("the answer speaks to the judge".to_owned());
            let noted = self.second_opinion_came(&about, String::new(), problem);
            noted.events.iter().for_each(|event| self.apply(event));
            decided.events.extend(noted.events);
        }
        if decided.waits.is_some() {
            self.waiting = decided.waits.take();
        }
        if let Some(running) = decided.running.take() {
            self.running = Some(running);
        }
        if let Some(pointing) = decided.pointing.take() {
            self.pointing = Some(pointing);
        }
        let ended = (*self.here() == Screen::Result).then(|| self.verdict());
        if let Some((grade, words)) = ended.filter(|ended| self.finished.as_ref() != Some(ended)) {
            let event = Event::Finished { grade, words };
            self.apply(&event);
            decided.events.push(event);
        }
        decided
    }

    /// What is due is asked by a session of its own: one that has begun goes on as it is.
    fn ask_due(&self, items: Vec<String>) -> Decided {
        let is_new = self.trail.len() == 1 && *self.here() == Screen::Why;
        match is_new && !self.asks_due {
            true => Decided::event(Event::DueAgain { items }),
            false => Decided::default(),
        }
    }

    /// What stands open on the screen shown.
    pub(super) fn open(&self) -> Open<'_> {
        match self.here() {
            Screen::Why | Screen::Step(_) | Screen::Reteach { .. } | Screen::Result => {
                Open::Nothing
            }
            Screen::Worked => {
                let lines = self.lesson.worked.as_ref().map_or(0, |w| w.lines.len());
                if self.revealed < lines {
                    Open::Line
                } else {
                    Open::Nothing
                }
            }
            screen @ (Screen::Faded(_) | Screen::Practice(_) | Screen::Retest(_)) => {
                let problem = self.problem(screen);
                problem
                    .and_then(|problem| Some(Open::Step(problem, problem.open()?.1)))
                    .unwrap_or(Open::Nothing)
            }
            Screen::Explain { item, attempt } => {
                let (Some(explain), Some(question)) =
                    (self.lesson.explain(item), self.questions.get(item))
                else {
                    return Open::Nothing;
                };
                let is_waiting = self.is_waiting(item, *attempt);
                let attempt = *attempt as usize;
                let rubric = &explain.rubric;
                match question.tries.get(attempt - 1) {
                    Some(_) if is_waiting => Open::Opinion,
                    Some(tried) => match &tried.asked {
                        Some(asked) => Open::Reply(explain, tried, asked),
                        None if tried.wants_marks(rubric) => Open::Marks(explain, question),
                        None => Open::Nothing,
                    },
                    // The second try opens when the first is settled.
                    None if question.tries.len() + 1 == attempt
                        && question.last().is_none_or(|first| !first.is_open(rubric)) =>
                    {
                        Open::Text(explain, question)
                    }
                    None => Open::Nothing,
                }
            }
        }
    }

    /// The learner looks back: what is open here need not be settled to go on.
    pub(super) fn is_reviewing(&self) -> bool {
        self.cursor + 1 < self.trail.len()
    }

    fn move_to(&self, screen: Option<Screen>) -> Decided {
        match screen {
            Some(screen) => Decided::event(Event::Next {
                stage: screen.stage(&self.lesson),
                screen: screen.to_string(),
            }),
            None => Decided::default(),
        }
    }

    fn next(&self) -> Decided {
        let on = || self.move_to(self.after(self.here()));
        match self.open() {
            Open::Nothing if *self.here() == Screen::Result => Decided {
                quit: true,
                ..Decided::default()
            },
            Open::Nothing => on(),
            Open::Line => Decided::event(Event::Revealed {
                lines: self.revealed + 1,
            }),
            Open::Step(problem, step) if problem.may_go_on(step) => self.go_on(step),
            Open::Step(..) | Open::Text(..) | Open::Reply(..) | Open::Marks(..)
                if self.is_reviewing() =>
            {
                on()
            }
            Open::Opinion => Decided::note("A moment: a second opinion is asked for."),
            Open::Reply(..) => {
                Decided::note("Write a few words, take a hint, or end the questions.")
            }
            Open::Step(..) => {
                Decided::note("Your answer first; a hint helps, and skipping is allowed.")
            }
            Open::Text(..) => {
                Decided::note("Say it in your own words first; a sentence or two will do.")
            }
            Open::Marks(..) => Decided::note("Mark each point first: does your answer say it?"),
        }
    }

    fn go_on(&self, step: &str) -> Decided {
        match self.problem_key(self.here()) {
            Some((item, round)) => Decided::event(Event::GoOn {
                item,
                round,
                step: step.to_owned(),
            }),
            None => Decided::default(),
        }
    }

    fn back(&self) -> Decided {
        let Some(before) = self.cursor.checked_sub(1).map(|at| &self.trail[at]) else {
            return Decided::note("This is the beginning.");
        };
        Decided::event(Event::Back {
            stage: before.stage(&self.lesson),
            screen: before.to_string(),
        })
    }

    fn skip(&self) -> Decided {
        let here = self.here();
        match (self.open(), here) {
            (Open::Opinion, _) => return self.stop_waiting(),
            (Open::Reply(explain, ..), Screen::Explain { attempt, .. }) => {
                return Decided::event(Event::LeftOpen {
                    item: explain.rubric.item.clone(),
                    attempt: *attempt,
                });
            }
            _ => {}
        }
        if *here == Screen::Result {
            return Decided::note("Nothing is left to skip.");
        }
        let mut decided = self.move_to(self.skip_target());
        if self.may_skip() {
            let left_out = Event::Skip {
                screen: here.to_string(),
            };
            decided.events.insert(0, left_out);
        }
        decided
    }

    /// The screen after what would be left out.
    fn skip_target(&self) -> Option<Screen> {
        match self.here() {
            here @ (Screen::Why | Screen::Step(_) | Screen::Worked) => self.after_stage(here),
            here @ Screen::Explain { .. } => self.after_item(here),
            here => self.after(here),
        }
    }

    /// Whether skipping is more than going on: something is open here, or more than this screen
    /// would be left out.
    pub(super) fn may_skip(&self) -> bool {
        match self.open() {
            Open::Nothing => self.skip_target() != self.after(self.here()),
            Open::Line
            | Open::Step(..)
            | Open::Text(..)
            | Open::Opinion
            | Open::Reply(..)
            | Open::Marks(..) => true,
        }
    }

    fn hint(&self) -> Decided {
        let Some(level) = self.next_hint() else {
            return Decided::note("There is no hint here.");
        };
        match (self.open(), self.here()) {
            (Open::Step(_, step), screen) => match self.problem_key(screen) {
                Some((item, round)) => Decided::event(Event::Hint {
                    item,
                    round,
                    step: step.to_owned(),
                    level,
                }),
                None => Decided::default(),
            },
            (Open::Text(..), Screen::Explain { item, attempt }) => Decided::event(Event::Hint {
                item: item.clone(),
                round: *attempt,
                step: WHOLE.to_owned(),
                level,
            }),
            (Open::Reply(_, _, asked), Screen::Explain { item, attempt }) => {
                Decided::event(Event::Hint {
                    item: item.clone(),
                    round: *attempt,
                    step: asked.about.clone(),
                    level,
                })
            }
            _ => Decided::default(),
        }
    }

    /// The level of the next hint, where there is one.
    pub(super) fn next_hint(&self) -> Option<u8> {
        match (self.open(), self.here()) {
            (Open::Step(problem, step), _) => {
                let shown = problem.hints(step);
                (shown < 3).then_some(shown + 1)
            }
            (Open::Text(explain, question), Screen::Explain { attempt, .. }) => {
                let shown = question.hints[(*attempt as usize).clamp(1, 2) - 1];
                let nudges = question.nudges(explain, *attempt).len() as u8;
                if shown < nudges {
                    Some(shown + 1)
                } else {
                    (shown < 3).then_some(3)
                }
            }
            (Open::Reply(_, _, asked), _) => Some(asked.rung.level()),
            _ => None,
        }
    }

    fn answer(&self, text: String) -> Decided {
        let empty = text.trim().is_empty();
        match (self.open(), self.here()) {
            (Open::Step(problem, _), screen) if self.shader(screen).is_some() => {
                self.hand_in_shader(screen, problem, text)
            }
            (Open::Step(..), screen) if !empty && self.look(screen).is_some() => {
                self.point_at(screen, text)
            }
            (Open::Step(problem, step), screen) if !empty => {
                self.answer_step(screen, problem, step, text)
            }
            (Open::Text(explain, _), Screen::Explain { attempt, .. }) if !empty => {
                let event = explained(explain, *attempt, text);
                self.consulting(explain, event)
            }
            (Open::Reply(explain, tried, asked), Screen::Explain { attempt, .. }) if !empty => {
                let event = replied(&self.lesson, explain, *attempt, tried, asked, text);
                self.consulting_reply(explain, tried, event)
            }
            (Open::Reply(..) | Open::Opinion, _) => self.next(),
            // An empty line goes on, where there is a way on.
            (Open::Step(..), _) => self.next(),
            (Open::Text(..), _) => Decided::note("Nothing was typed, so nothing counts."),
            (Open::Marks(..), _) => {
                Decided::note("Mark each point first: does your answer say it?")
            }
            (Open::Nothing | Open::Line, _) => Decided::note("Nothing is asked here; just go on."),
        }
    }

    fn answer_step(&self, screen: &Screen, problem: &Problem, step: &str, text: String) -> Decided {
        let Some((item, round)) = self.problem_key(screen) else {
            return Decided::default();
        };
        let (Some(exercise), Ok(draw)) = (self.lesson.exercise(&item), problem.draw()) else {
            return Decided::default();
        };
        let named = (step != WHOLE).then_some(step);
        let earlier = problem.earlier(step);
        let marking = exercise::mark(&self.lesson, exercise, draw, named, &text, &earlier);
        attempted(exercise, problem.seed, draw, &marking, round, step, text)
    }

    fn draft(&self, text: String) -> Decided {
        match (self.open(), self.here()) {
            (Open::Step(problem, _), screen) => match self.shader(screen) {
                Some((exercise, shader)) if problem.text(&shader.source) != text => {
                    Decided::event(Event::Draft {
                        item: exercise.id.text.clone(),
                        text,
                    })
                }
                None if problem.draft.as_deref().unwrap_or_default() != text
                    && matches!(self.view.input, Input::Number { .. }) =>
                {
                    let item = self.problem_key(screen).map(|key| key.0);
                    item.map_or_else(Decided::default, |item| {
                        Decided::event(Event::Draft { item, text })
                    })
                }
                _ => Decided::default(),
            },
            (Open::Text(..) | Open::Reply(..), Screen::Explain { item, .. })
                if self.questions.get(item).is_some_and(|it| it.draft != text) =>
            {
                Decided::event(Event::Draft {
                    item: item.clone(),
                    text,
                })
            }
            _ => Decided::default(),
        }
    }

    fn mark(&self, point: usize, said: bool) -> Decided {
        let (Open::Marks(explain, question), Some(tried)) = (self.open(), self.here_try()) else {
            return Decided::default();
        };
        match tried.points(&explain.rubric).into_iter().nth(point) {
            Some((point, _)) if tried.marks.get(&point) != Some(&said) => {
                Decided::event(Event::Marked {
                    item: explain.rubric.item.clone(),
                    attempt: question.tries.len() as u32,
                    point,
                    said,
                })
            }
            _ => Decided::default(),
        }
    }

    fn checklist_done(&self) -> Decided {
        let (Open::Marks(explain, question), Some(tried)) = (self.open(), self.here_try()) else {
            return Decided::default();
        };
        let points = tried.points(&explain.rubric);
        if points.iter().any(|(id, _)| !tried.marks.contains_key(id)) {
            return Decided::note("Mark each point first: does your answer say it?");
        }
        let heard = tried.settle(&explain.rubric);
        Decided::event(Event::SelfMarked {
            item: explain.rubric.item.clone(),
            attempt: question.tries.len() as u32,
            verdict: heard.verdict.as_str().to_owned(),
            met: heard.met,
            missed: heard.missed,
            misconceptions: heard.misconceptions,
            slips: heard.slips,
        })
    }

    /// The try that the screen shown is about.
    pub(super) fn here_try(&self) -> Option<&super::question::Try> {
        match self.here() {
            Screen::Explain { item, attempt } => {
                let index = (*attempt as usize).checked_sub(1)?;
                self.questions.get(item)?.tries.get(index)
            }
            _ => None,
        }
    }
}

/// An answer to an exercise, with what was said to it.
pub(super) fn attempted(
    exercise: &Exercise,
    seed: u64,
    draw: &Draw,
    marking: &Marking,
    round: u32,
    step: &str,
    text: String,
) -> Decided {
    let mistake = marking.mistake();
    // The mistakes of a choice are all the author's own.
    let choice = matches!(exercise.task, Task::Choice { .. });
    let by_author = |id: &str| choice || exercise.mistakes.iter().any(|m| m.id.text == id);
    let note = match marking {
        Marking::Invalid { .. } | Marking::Correct | Marking::Carried { .. } => None,
        Marking::Precision { .. }
        | Marking::Mistake { .. }
        | Marking::Ambiguous { .. }
        | Marking::Off { .. }
        | Marking::Wrong { .. } => Some("Try again, or go on with what you have.".to_owned()),
    };
    Decided {
        note,
        ..Decided::event(Event::Attempt {
            item: exercise.id.text.clone(),
            round,
            step: step.to_owned(),
            seed,
            given: draw.given.clone(),
            text,
            result: marking.result().to_owned(),
            named: mistake.is_some_and(by_author),
            mistake: mistake.map(str::to_owned),
            says: marking.says().to_owned(),
        })
    }
}

fn explained(explain: &Explain, attempt: u32, text: String) -> Event {
    let Judgement {
        verdict: _,
        met,
        misconceptions,
        unsure,
        why,
    } = explain.judge.judge(&text);
    let heard = Heard::new(&explain.rubric, met, misconceptions, unsure);
    Event::Explained {
        item: explain.rubric.item.clone(),
        attempt,
        verdict: heard.verdict.as_str().to_owned(),
        met: heard.met,
        missed: heard.missed,
        misconceptions: heard.misconceptions,
        slips: heard.slips,
        unsure: heard.unsure,
        judge: JUDGE_VERSION.to_owned(),
        why: why.into_iter().map(Quote::from).collect(),
        text,
    }
}

fn replied(
    lesson: &Lesson,
    explain: &Explain,
    attempt: u32,
    tried: &Try,
    asked: &Asked,
    text: String,
) -> Event {
    let reply = reply::hear(lesson, explain, tried, asked, &text);
    let heard = reply.first;
    Event::Replied {
        item: explain.rubric.item.clone(),
        attempt,
        asked: reply.asked,
        about: reply.about,
        rung: reply.rung,
        text,
        verdict: heard.verdict.as_str().to_owned(),
        met: heard.met,
        missed: heard.missed,
        misconceptions: heard.misconceptions,
        slips: heard.slips,
        unsure: heard.unsure,
        judge: JUDGE_VERSION.to_owned(),
        why: reply.why,
    }
}
