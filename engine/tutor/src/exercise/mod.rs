//! Exercises: drawn from a seed so that mistakes can be told apart, marked, hinted.
//!
//! Everything here is pure: the same lesson and seed give the same draw on every machine.

mod chain;
mod cosines;
mod draw;
mod hint;
pub mod look;
mod mark;
pub(crate) mod plan;
pub(crate) mod random;
pub mod report;
pub mod shader;
mod words;

use formula::Values;

pub use draw::{MOST_TRIES, draw};
pub use hint::{after_right, hint, tolerance_words};
pub(crate) use mark::sentence;
pub use mark::{Marking, OffBy, mark};

use crate::lesson::Exercise;

/// An exercise with its numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Draw {
    /// The seed it was drawn from.
    pub seed: u64,
    /// The numbers drawn.
    pub given: Values,
    /// The question as plain text.
    pub prompt: String,
    /// What is asked for, one after the other. A `find-the-mistake` has the steps `line` and
    /// `answer`; `choice` and `order` have none.
    pub steps: Vec<StepTruth>,
    /// The exercise's truth.
    pub truth: Truth,
    /// What `choice` and `order` show, in the order shown; the lines of a `find-the-mistake`.
    pub shown: Vec<String>,
    /// Every mistake that would be recognised, with the number it gives.
    pub mistakes: Vec<Mistake>,
    /// How many draws were tried, this one included.
    pub tries: u32,
}

/// One number asked for.
#[derive(Clone, Debug, PartialEq)]
pub struct StepTruth {
    /// The step's name.
    pub name: String,
    /// How it is called when asked for, in the field's spelling.
    pub ask: String,
    /// Its true value; of the step `line`, the line's number from 1.
    pub truth: f64,
    /// The value as shown when given away.
    pub shown: String,
}

/// What is right.
#[derive(Clone, Debug, PartialEq)]
pub enum Truth {
    /// A number.
    Number(f64),
    /// An option, by its place in `Draw::shown`, from 0.
    Choice(usize),
    /// The places in `Draw::shown`, from 0, in the right order.
    Order(Vec<usize>),
}

/// A mistake and the number it gives with a draw's numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Mistake {
    /// The author's id, or the mutant's.
    pub id: String,
    /// The step whose answer it is recognised in.
    pub step: String,
    /// The number.
    pub value: f64,
    /// Whether the author named it.
    pub named: bool,
    /// Whether it was made before that step, and only shows in it.
    pub made_before: bool,
    /// What the tutor says (Markdown, templates filled).
    pub says: String,
}

/// Why an exercise has no numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct NoDraw {
    /// One sentence.
    pub message: String,
}

/// How many significant digits a learner is told to keep: the author's number, else what the
/// tolerance asks for (2 % where three will do, 1 % where four are needed).
pub(crate) fn digits_kept(exercise: &Exercise) -> u32 {
    exercise
        .keep
        .unwrap_or(if exercise.tolerance.rel >= 0.02 { 3 } else { 4 })
}

/// A relative tolerance in percent: 0.01 as `1`.
pub(crate) fn percent(rel: f64) -> String {
    crate::prose::shortest(rel * 100.0)
}
