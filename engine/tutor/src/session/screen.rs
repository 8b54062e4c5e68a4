//! The screens of a lesson and the way through them.

use crate::lesson::{ExplainStage, Lesson};
use crate::view::Stage;
use std::fmt;

/// One screen. Its `Display` is the key that views and logs carry.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Screen {
    Why,
    /// A step of the walkthrough, from 0.
    Step(usize),
    Worked,
    /// A round of the faded example, from 1.
    Faded(u32),
    /// An exercise, the first time.
    Practice(String),
    /// An exercise with fresh numbers.
    Retest(String),
    /// A question, first or second try.
    Explain {
        item: String,
        attempt: u32,
    },
    Reteach {
        item: String,
        name: String,
    },
    Result,
}

impl fmt::Display for Screen {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Screen::Why => write!(f, "why"),
            Screen::Step(index) => write!(f, "step:{}", index + 1),
            Screen::Worked => write!(f, "worked"),
            Screen::Faded(round) => write!(f, "faded:{round}"),
            Screen::Practice(item) => write!(f, "practice:{item}"),
            Screen::Retest(item) => write!(f, "retest:{item}"),
            Screen::Explain { item, attempt } => write!(f, "explain:{item}:{attempt}"),
            Screen::Reteach { item, name } => write!(f, "reteach:{item}:{name}"),
            Screen::Result => write!(f, "result"),
        }
    }
}

impl Screen {
    /// The screen of that key, where the lesson has it.
    pub(crate) fn find(lesson: &Lesson, key: &str) -> Option<Screen> {
        let screen = match key.split_once(':') {
            None => match key {
                "why" => Screen::Why,
                "worked" => Screen::Worked,
                "result" => Screen::Result,
                _ => return None,
            },
            Some(("step", number)) => Screen::Step(number.parse::<usize>().ok()?.checked_sub(1)?),
            Some(("faded", number)) => Screen::Faded(number.parse().ok()?),
            Some(("practice", item)) => Screen::Practice(item.to_owned()),
            Some(("retest", item)) => Screen::Retest(item.to_owned()),
            Some(("explain", rest)) => {
                let (item, attempt) = rest.rsplit_once(':')?;
                Screen::Explain {
                    item: item.to_owned(),
                    attempt: attempt.parse().ok()?,
                }
            }
            Some(("reteach", rest)) => {
                let (item, name) = rest.rsplit_once(':')?;
                Screen::Reteach {
                    item: item.to_owned(),
                    name: name.to_owned(),
                }
            }
            Some(_) => return None,
        };
        screen.exists(lesson).then_some(screen)
    }

    fn exists(&self, lesson: &Lesson) -> bool {
        match self {
            Screen::Why | Screen::Result => true,
            Screen::Step(index) => *index < lesson.steps.len(),
            Screen::Worked => lesson.worked.is_some(),
            Screen::Faded(round) => faded_lines(lesson, *round).is_some(),
            Screen::Practice(item) => lesson.exercises.iter().any(|e| e.id.text == *item),
            Screen::Retest(item) => lesson
                .exercises
                .iter()
                .any(|e| e.retest && e.id.text == *item),
            Screen::Explain { item, attempt } => {
                lesson.explain(item).is_some() && (1..=2).contains(attempt)
            }
            Screen::Reteach { item, name } => {
                lesson.explain(item).is_some() && lesson.reteach(name).is_some()
            }
        }
    }

    /// The stage it belongs to.
    pub(crate) fn stage(&self, lesson: &Lesson) -> Stage {
        match self {
            Screen::Reteach { .. } => Stage::Reteach,
            _ => self.base_stage(lesson),
        }
    }

    /// The stage that starts again when the lesson changed: a re-teach belongs to the question
    /// that it follows.
    pub(crate) fn base_stage(&self, lesson: &Lesson) -> Stage {
        match self {
            Screen::Why => Stage::Why,
            Screen::Step(_) => Stage::Walkthrough,
            Screen::Worked | Screen::Faded(_) => Stage::Worked,
            Screen::Practice(_) => Stage::Practice,
            Screen::Retest(_) => Stage::Retest,
            Screen::Explain { item, .. } | Screen::Reteach { item, .. } => {
                match lesson.explain(item).map(|explain| explain.stage) {
                    Some(ExplainStage::Retest) => Stage::Retest,
                    Some(ExplainStage::Explain) | None => Stage::Explain,
                }
            }
            Screen::Result => Stage::Result,
        }
    }
}

/// How many of the last lines the learner fills in a round of the faded example, from 1.
pub(crate) fn faded_lines(lesson: &Lesson, round: u32) -> Option<usize> {
    let worked = lesson.worked.as_ref()?;
    let rounds = &worked.faded.as_ref()?.rounds;
    let lines = *rounds.get((round as usize).checked_sub(1)?)?;
    Some(lines.clamp(1, worked.lines.len().max(1)))
}

/// Every screen of a lesson in which nothing is missed, in order.
pub(crate) fn path(lesson: &Lesson) -> Vec<Screen> {
    let questions = |stage: ExplainStage| {
        lesson
            .explain
            .iter()
            .filter(move |explain| explain.stage == stage)
            .map(|explain| Screen::Explain {
                item: explain.rubric.item.clone(),
                attempt: 1,
            })
    };
    let rounds = lesson
        .worked
        .as_ref()
        .and_then(|worked| worked.faded.as_ref())
        .map_or(0, |faded| faded.rounds.len() as u32);
    let mut path = vec![Screen::Why];
    path.extend((0..lesson.steps.len()).map(Screen::Step));
    path.extend(lesson.worked.iter().map(|_| Screen::Worked));
    path.extend((1..=rounds).map(Screen::Faded));
    path.extend(
        lesson
            .exercises
            .iter()
            .map(|exercise| Screen::Practice(exercise.id.text.clone())),
    );
    path.extend(questions(ExplainStage::Explain));
    path.extend(
        lesson
            .exercises
            .iter()
            .filter(|exercise| exercise.retest)
            .map(|exercise| Screen::Retest(exercise.id.text.clone())),
    );
    path.extend(questions(ExplainStage::Retest));
    path.push(Screen::Result);
    path
}

/// The screens that ask items again, those that a lesson has, in its order.
pub(crate) fn due_path(lesson: &Lesson, items: &[String]) -> Vec<Screen> {
    let is_due = |screen: &Screen| match screen {
        Screen::Practice(item) | Screen::Explain { item, .. } => items.contains(item),
        // Its last round asks for everything that the others ask for.
        Screen::Faded(round) => {
            let worked = lesson.worked.as_ref();
            let faded = worked.and_then(|worked| worked.faded.as_ref());
            faded.is_some_and(|faded| {
                faded.rounds.len() as u32 == *round && items.contains(&faded.exercise.id.text)
            })
        }
        Screen::Result => true,
        Screen::Why
        | Screen::Step(_)
        | Screen::Worked
        | Screen::Retest(_)
        | Screen::Reteach { .. } => false,
    };
    path(lesson).into_iter().filter(is_due).collect()
}
