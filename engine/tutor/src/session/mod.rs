//! The session: a pure state machine that takes a learner through one lesson.
//!
//! [`Session::update`] decides what happened (an [`Event`], its outcome inside), applies it and
//! asks to have it saved. [`Session::resume`] applies saved events again and judges nothing
//! anew, so it comes back to the very screen that was left. A session is a function of the
//! lesson, the [`Start`] and the events; nothing here knows the time, a disk or a terminal.

mod apply;
mod consult;
mod decide;
mod dialogue;
mod event;
mod outcome;
mod pointing;
mod problem;
pub mod progress;
mod question;
mod reply;
mod run;
mod screen;
mod show;
mod show_dialogue;
mod show_problem;
mod show_question;
mod show_shader;
pub mod transcript;

pub use event::{Effect, Event, Grade, Msg, NotedSlip, Quote, Rung};
pub use outcome::{ItemOutcome, Outcome, Standing};

use crate::lesson::Lesson;
use crate::view::{Saving, Stage, View};
use problem::Problem;
use question::Question;
use screen::Screen;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// What a session begins with.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Start {
    /// Every number of the session is drawn from it.
    pub seed: u64,
    /// Slips noted in earlier lessons.
    pub slips: Vec<NotedSlip>,
}

/// One learner in one lesson.
#[derive(Clone, Debug)]
pub struct Session {
    lesson: Arc<Lesson>,
    start: Start,
    /// The screens of a lesson in which nothing is missed.
    path: Vec<Screen>,
    /// Nothing is asked but what is due again.
    asks_due: bool,
    /// The screens seen, never empty.
    trail: Vec<Screen>,
    /// The one shown, an index of `trail`.
    cursor: usize,
    /// The stage that the last event named, which a changed lesson may no longer know.
    stage: Stage,
    /// Lines of the worked example shown.
    revealed: usize,
    /// Exercises begun, by id and round.
    problems: BTreeMap<(String, u32), Problem>,
    /// Questions begun, by id.
    questions: BTreeMap<String, Question>,
    /// Screens left out, by key.
    skipped: BTreeSet<String>,
    /// A replayed event did not fit the lesson or the program.
    diverged: bool,
    finished: Option<(Grade, String)>,
    /// The shader that runs elsewhere.
    running: Option<run::Running>,
    /// The place that is being looked at.
    pointing: Option<pointing::Pointing>,
    /// Decided on resuming, and saved with the next message.
    pending: Vec<Event>,
    /// Second opinions are to be had.
    consults: bool,
    /// The try whose second opinion the learner waits for.
    waiting: Option<consult::Consulted>,
    view: View,
}

impl Session {
    /// A lesson from its beginning.
    pub fn new(lesson: Arc<Lesson>, start: Start) -> Session {
        let mut session = Session {
            path: screen::path(&lesson),
            asks_due: false,
            trail: vec![Screen::Why],
            cursor: 0,
            stage: Stage::Why,
            revealed: 0,
            problems: BTreeMap::new(),
            questions: BTreeMap::new(),
            skipped: BTreeSet::new(),
            diverged: false,
            finished: None,
            running: None,
            pointing: None,
            pending: Vec::new(),
            consults: false,
            waiting: None,
            view: show::blank(&lesson),
            lesson,
            start,
        };
        session.refresh();
        session
    }

    /// A lesson where it was left. Should the lesson file or the program have changed so that
    /// the events no longer fit, the stage starts again and the sentence says so.
    pub fn resume(
        lesson: Arc<Lesson>,
        start: Start,
        lesson_hash_then: &str,
        events: &[Event],
    ) -> (Session, Option<String>) {
        let mut session = Session::new(lesson, start);
        let mut hash = lesson_hash_then;
        for event in events {
            if let Event::LessonChanged { hash: since, .. } = event {
                hash = since;
            }
            session.apply(event);
        }
        let changed = hash != session.lesson.hash;
        let notice = (changed || session.has_diverged()).then(|| {
            let event = Event::LessonChanged {
                hash: session.lesson.hash.clone(),
                stage: session.stage,
            };
            session.apply(&event);
            session.pending.push(event);
            let what = if changed { "lesson file" } else { "program" };
            format!(
                "The {what} changed since you left, so you begin {} again. What you did before it is kept.",
                session.stage.phrase()
            )
        });
        session.refresh();
        if !events.is_empty() && session.pending.is_empty() {
            session.view.saving = Saving::Saved;
        }
        (session, notice)
    }

    /// From here on every explanation gets a second opinion: the app carries out
    /// [`Effect::Consult`].
    #[must_use]
    pub fn with_second_opinions(mut self) -> Session {
        self.consults = true;
        self
    }

    /// Takes a message, and returns what the app has to do.
    pub fn update(&mut self, msg: Msg) -> Vec<Effect> {
        let key = self.view.key.clone();
        let mut effects: Vec<Effect> = self.pending.drain(..).map(Effect::Save).collect();
        let decided = self.decide(msg);
        effects.extend(decided.events.into_iter().map(Effect::Save));
        // Only events, and waiting, change what there is to see.
        if !effects.is_empty() {
            self.view.saving = Saving::Waiting;
        }
        if !effects.is_empty() || !decided.effects.is_empty() {
            self.refresh();
        }
        effects.extend(decided.effects);
        if let Some(saving) = decided.saving {
            self.view.saving = saving;
        }
        self.view.note = decided.note;
        if self.view.key != key {
            effects.extend(self.pictures());
        }
        if decided.quit {
            effects.push(Effect::Quit);
        }
        effects
    }

    /// What is on the screen.
    pub fn view(&self) -> View {
        self.view.clone()
    }

    /// The same without a copy.
    pub fn screen(&self) -> &View {
        &self.view
    }

    /// The lesson taught.
    pub fn lesson(&self) -> &Arc<Lesson> {
        &self.lesson
    }

    /// Whether nothing is asked but items that were due again.
    pub fn asks_due(&self) -> bool {
        self.asks_due
    }

    fn here(&self) -> &Screen {
        &self.trail[self.cursor]
    }
}

#[cfg(test)]
pub(crate) mod tests;
