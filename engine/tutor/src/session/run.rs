//! A shader handed in: it runs elsewhere, and what came of it comes back as a message.

use super::Session;
use super::decide::{Decided, attempted};
use super::event::{Effect, Event};
use super::problem::{Problem, WHOLE};
use super::screen::Screen;
use crate::exercise::shader::{self, Ran};
use crate::lesson::{Exercise, ShaderTask};

/// What runs. Nothing of it is kept in the log: should the program end meanwhile, the text is
/// there as a draft.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Running {
    pub(super) item: String,
    text: String,
}

impl Session {
    /// The shader exercise of a screen.
    pub(super) fn shader(&self, screen: &Screen) -> Option<(&Exercise, &ShaderTask)> {
        let (item, _) = self.problem_key(screen)?;
        let exercise = self.lesson.exercise(&item)?;
        Some((exercise, shader::task(exercise)?))
    }

    /// A text is handed in: it is kept, and run.
    pub(super) fn hand_in_shader(
        &self,
        screen: &Screen,
        problem: &Problem,
        text: String,
    ) -> Decided {
        let Some((exercise, task)) = self.shader(screen) else {
            return Decided::default();
        };
        if self.running.is_some() {
            return Decided::note("A function is still running.");
        }
        if text.trim().is_empty() {
            return Decided::note("There is no function to run.");
        }
        let Some(job) = shader::job(&self.lesson, exercise, problem.seed, &text) else {
            return Decided::note("This exercise has nothing to compare a shader with.");
        };
        let draft = (problem.text(&task.source) != text).then(|| Event::Draft {
            item: exercise.id.text.clone(),
            text: text.clone(),
        });
        Decided {
            events: draft.into_iter().collect(),
            note: Some("Your function runs …".to_owned()),
            running: Some(Running {
                item: exercise.id.text.clone(),
                text,
            }),
            effects: vec![Effect::Run(Box::new(job))],
            ..Decided::default()
        }
    }

    /// What came of it. The learner may have moved on meanwhile.
    pub(super) fn ran(&mut self, ran: &Ran) -> Decided {
        let Some(Running { item, text }) = self.running.take() else {
            return Decided::default();
        };
        let Some(problem) = self.problems.get(&(item.clone(), 0)) else {
            return Decided::default();
        };
        let (Some(exercise), Ok(draw)) = (self.lesson.exercise(&item), problem.draw()) else {
            return Decided::default();
        };
        let marking = shader::mark(&self.lesson, exercise, problem.seed, ran);
        attempted(exercise, problem.seed, draw, &marking, 0, WHOLE, text)
    }
}
