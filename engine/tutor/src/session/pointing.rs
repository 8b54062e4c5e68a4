//! A place of a picture is pointed at: what is seen there comes back as a message.

use super::Session;
use super::decide::{Decided, attempted};
use super::event::Effect;
use super::problem::WHOLE;
use super::screen::Screen;
use crate::exercise::Marking;
use crate::exercise::look::{self, Sight};
use crate::lesson::{Exercise, LookTask};

/// A place that is looked at; the log keeps the answer once it is marked.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Pointing {
    item: String,
    round: u32,
    text: String,
}

impl Session {
    /// The exercise of a screen, where it asks for a place.
    pub(super) fn look(&self, screen: &Screen) -> Option<(&Exercise, &LookTask)> {
        let (item, _) = self.problem_key(screen)?;
        let exercise = self.lesson.exercise(&item)?;
        Some((exercise, look::task(exercise)?))
    }

    /// A place is handed in.
    pub(super) fn point_at(&self, screen: &Screen, text: String) -> Decided {
        let (Some((exercise, task)), Some((item, round))) =
            (self.look(screen), self.problem_key(screen))
        else {
            return Decided::default();
        };
        let pointing = Pointing { item, round, text };
        match look::place(&pointing.text) {
            Ok((x, y)) => Decided {
                effects: vec![Effect::Look {
                    picture: task.picture.text.clone(),
                    x,
                    y,
                }],
                pointing: Some(pointing),
                ..Decided::default()
            },
            Err(says) => self.place_marked(exercise, &pointing, &Marking::Invalid { says }),
        }
    }

    /// What is seen there.
    pub(super) fn looked(&mut self, sight: &Sight) -> Decided {
        let Some(pointing) = self.pointing.take() else {
            return Decided::default();
        };
        let Some((exercise, task)) = self
            .lesson
            .exercise(&pointing.item)
            .and_then(|exercise| Some((exercise, look::task(exercise)?)))
        else {
            return Decided::default();
        };
        self.place_marked(exercise, &pointing, &look::mark(task, sight))
    }

    fn place_marked(&self, exercise: &Exercise, it: &Pointing, marking: &Marking) -> Decided {
        let problem = self.problems.get(&(it.item.clone(), it.round));
        let Some((problem, draw)) =
            problem.and_then(|problem| Some((problem, problem.draw().ok()?)))
        else {
            return Decided::default();
        };
        let text = it.text.clone();
        attempted(exercise, problem.seed, draw, marking, it.round, WHOLE, text)
    }
}

/// A place in words: "0.80 to the right, 0.20 down".
pub(super) fn words(typed: &str) -> String {
    let Ok((x, y)) = look::place(typed) else {
        return typed.split_whitespace().collect::<Vec<_>>().join(" ");
    };
    let side = |value: f64, plus: &str, minus: &str| match value {
        v if v.abs() < 0.005 => None,
        v if v > 0.0 => Some(format!("{v:.2} {plus}")),
        v => Some(format!("{:.2} {minus}", -v)),
    };
    let parts = [
        side(x, "to the right", "to the left"),
        side(y, "up", "down"),
    ];
    let parts: Vec<String> = parts.into_iter().flatten().collect();
    match parts.is_empty() {
        true => "the centre".to_owned(),
        false => parts.join(", "),
    }
}
