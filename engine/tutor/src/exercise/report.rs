//! What `lobe exercise` and `lobe mark` print, ready to become JSON.

use std::collections::BTreeMap;

use serde::Serialize;

use super::{Draw, Marking, Truth};
use crate::lesson::{Exercise, Lesson, Task};

/// One line of `lobe exercise --list --json`.
#[derive(Clone, Debug, Serialize)]
pub struct ListLine<'a> {
    /// The exercise's id.
    pub id: &'a str,
    /// The lesson's id.
    pub lesson: &'a str,
    /// The kind.
    pub kind: &'static str,
}

/// The lines of `lobe exercise --list --json` for one lesson.
pub fn list(lesson: &Lesson) -> Vec<ListLine<'_>> {
    lesson
        .exercises
        .iter()
        .map(|exercise| ListLine {
            id: &exercise.id,
            lesson: &lesson.id,
            kind: exercise.kind(),
        })
        .collect()
}

/// `lobe exercise ID --seed N --json`.
#[derive(Clone, Debug, Serialize)]
pub struct ExerciseReport<'a> {
    id: &'a str,
    seed: u64,
    given: &'a BTreeMap<String, f64>,
    prompt: &'a str,
    steps: Vec<StepReport<'a>>,
    truth: TruthReport,
    tolerance: ToleranceReport,
    /// Those that the last step recognises.
    mistakes: Vec<MistakeReport<'a>>,
    /// Options, items or lines as shown.
    #[serde(skip_serializing_if = "<[String]>::is_empty")]
    shown: &'a [String],
    kind: &'static str,
    tries: u32,
    #[serde(skip_serializing_if = "Option::is_none")]
    shader: Option<ShaderReport<'a>>,
}

/// The function that a learner gets to mend.
#[derive(Clone, Debug, Serialize)]
struct ShaderReport<'a> {
    function: &'a str,
    params: Vec<ParamReport<'a>>,
    offers: Vec<&'a str>,
    source: &'a str,
    /// What it should compute, as written in the lesson.
    is: &'a str,
}

#[derive(Clone, Debug, Serialize)]
struct ParamReport<'a> {
    name: &'a str,
    from: f64,
    to: f64,
}

impl<'a> ShaderReport<'a> {
    fn new(exercise: &'a Exercise) -> Option<ShaderReport<'a>> {
        let Task::Shader(shader) = &exercise.task else {
            return None;
        };
        let ends = |values: &[f64]| {
            let least = values.iter().copied().fold(f64::INFINITY, f64::min);
            let most = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            (least, most)
        };
        let params = exercise.draw.iter().map(|variable| {
            let (from, to) = ends(&variable.values);
            let name = &variable.name;
            ParamReport { name, from, to }
        });
        Some(ShaderReport {
            function: &shader.function,
            params: params.collect(),
            offers: shader.offers.iter().map(|name| &**name).collect(),
            source: &shader.source,
            is: &shader.is.text,
        })
    }
}

#[derive(Clone, Debug, Serialize)]
struct StepReport<'a> {
    name: &'a str,
    truth: f64,
    ask: &'a str,
    mistakes: Vec<MistakeReport<'a>>,
}

/// A number; of a choice the option's number; of an order the numbers in order.
#[derive(Clone, Debug, Serialize)]
#[serde(untagged)]
enum TruthReport {
    Number(f64),
    Place(usize),
    Places(Vec<usize>),
}

#[derive(Clone, Copy, Debug, Serialize)]
struct ToleranceReport {
    rel: f64,
}

#[derive(Clone, Debug, Serialize)]
struct MistakeReport<'a> {
    id: &'a str,
    value: f64,
    named: bool,
}

impl<'a> ExerciseReport<'a> {
    /// The report of one draw.
    pub fn new(exercise: &'a Exercise, draw: &'a Draw) -> ExerciseReport<'a> {
        let mistakes_of = |step: &str| {
            draw.mistakes
                .iter()
                .filter(|mistake| mistake.step == step)
                .map(|mistake| MistakeReport {
                    id: &mistake.id,
                    value: mistake.value,
                    named: mistake.named,
                })
                .collect::<Vec<_>>()
        };
        ExerciseReport {
            id: &exercise.id,
            seed: draw.seed,
            given: &draw.given,
            prompt: &draw.prompt,
            steps: draw
                .steps
                .iter()
                .map(|step| StepReport {
                    name: &step.name,
                    truth: step.truth,
                    ask: &step.ask,
                    mistakes: mistakes_of(&step.name),
                })
                .collect(),
            truth: match &draw.truth {
                Truth::Number(value) => TruthReport::Number(*value),
                Truth::Choice(place) => TruthReport::Place(place + 1),
                Truth::Order(places) => {
                    TruthReport::Places(places.iter().map(|place| place + 1).collect())
                }
            },
            tolerance: ToleranceReport {
                rel: exercise.tolerance.rel,
            },
            mistakes: draw
                .steps
                .last()
                .map_or_else(Vec::new, |last| mistakes_of(&last.name)),
            shown: &draw.shown,
            kind: exercise.kind(),
            tries: draw.tries,
            shader: ShaderReport::new(exercise),
        }
    }
}

/// `lobe mark … --json`.
#[derive(Clone, Debug, Serialize)]
pub struct MarkReport<'a> {
    result: &'static str,
    mistake: Option<&'a str>,
    says: &'a str,
}

impl<'a> MarkReport<'a> {
    /// The report of one marking.
    pub fn new(marking: &'a Marking) -> MarkReport<'a> {
        MarkReport {
            result: marking.result(),
            mistake: marking.mistake(),
            says: marking.says(),
        }
    }
}
