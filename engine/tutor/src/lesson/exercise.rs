//! Exercises as a lesson file gives them.

use super::{Formula, LookTask, ShaderTask, Text};
use crate::finding::Place;

/// How near an answer must be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// Relative; |x - t| <= rel |t| is near enough.
    pub rel: f64,
    /// Where the number stands.
    pub place: Place,
}

/// A variable that is drawn, and the values it may take.
#[derive(Clone, Debug, PartialEq)]
pub struct Variable {
    /// Its name.
    pub name: Text,
    /// The values, ascending where given as a range; one value is a fixed number.
    pub values: Vec<f64>,
    /// Where the range stands.
    pub place: Place,
}

/// `[[exercise]]`.
#[derive(Clone, Debug)]
pub struct Exercise {
    /// `<lesson>/<slug>`.
    pub id: Text,
    /// Heading; what there is to do where left out.
    pub title: Option<Text>,
    /// The question (prose), with the drawn numbers in `{{ }}`.
    pub ask: Text,
    /// What is drawn.
    pub draw: Vec<Variable>,
    /// What a draw must fulfil.
    pub where_: Option<Formula>,
    /// How near is near enough; shown beforehand.
    pub tolerance: Tolerance,
    /// "Keep N digits in between", told to the learner.
    pub keep: Option<u32>,
    /// The first two levels of hint (prose).
    pub hints: Vec<Text>,
    /// What is worth a remark once the last step is right (prose).
    pub after: Option<Text>,
    /// Asked again with fresh numbers in the re-test.
    pub retest: bool,
    /// Mistakes worth a sentence.
    pub mistakes: Vec<NamedMistake>,
    /// What is asked for.
    pub task: Task,
}

impl Exercise {
    /// `numeric`, `choice`, `order`, `find-the-mistake`, `look` or `shader`.
    pub fn kind(&self) -> &'static str {
        match self.task {
            Task::Numeric { .. } => "numeric",
            Task::Choice { .. } => "choice",
            Task::Order { .. } => "order",
            Task::FindTheMistake { .. } => "find-the-mistake",
            Task::Look(_) => "look",
            Task::Shader(_) => "shader",
        }
    }
}

/// What an exercise asks for.
#[derive(Clone, Debug)]
pub enum Task {
    /// One number, or several one after the other.
    Numeric {
        /// At least one; the last one is the exercise's truth.
        steps: Vec<ExerciseStep>,
    },
    /// One of several texts.
    Choice {
        /// The options; exactly one is right.
        options: Vec<ChoiceOption>,
    },
    /// Texts to be put in order.
    Order {
        /// The texts in the right order.
        items: Vec<Text>,
    },
    /// A calculation with one wrong line: name the line, then give the right result.
    FindTheMistake {
        /// The lines; exactly one is wrong.
        lines: Vec<SuspectLine>,
        /// Id of the source's number that the calculation comes from.
        source: Option<Text>,
    },
    /// A WGSL function with a bug: mend it.
    Shader(Box<ShaderTask>),
    /// A place in a picture where the bug shows.
    Look(LookTask),
}

/// One number asked for.
#[derive(Clone, Debug)]
pub struct ExerciseStep {
    /// The name that later steps use; `answer` where an exercise asks for one number only.
    pub name: Text,
    /// How it is called when asked for.
    pub ask: Option<Text>,
    /// What it is.
    pub is: Formula,
}

/// A mistake that the author names.
#[derive(Clone, Debug)]
pub struct NamedMistake {
    /// Name within the exercise, kebab-case.
    pub id: Text,
    /// What the mistaken learner computes for `step`.
    pub is: Formula,
    /// The step it is made in; the last one where left out. Later steps follow from it.
    pub step: Option<Text>,
    /// What the tutor says (prose).
    pub says: Text,
}

/// An option of a choice.
#[derive(Clone, Debug)]
pub struct ChoiceOption {
    /// The text (prose).
    pub text: Text,
    /// It is the right one.
    pub right: bool,
    /// What the tutor says when it is chosen (prose).
    pub says: Option<Text>,
    /// Id of the mistake that leads to it.
    pub mistake: Option<Text>,
}

/// One line of a calculation in which a mistake is to be found.
#[derive(Clone, Debug)]
pub struct SuspectLine {
    /// The name that later lines use.
    pub name: Text,
    /// What the line computes.
    pub is: Formula,
    /// What it should compute; given on the wrong line only.
    pub right: Option<Formula>,
    /// What is wrong with it (prose).
    pub says: Option<Text>,
}
