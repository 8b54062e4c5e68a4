//! `lobe exercise`: every exercise, or one with its numbers drawn.

use formula::Values;
use serde::Serialize;
use tutor::Lesson;
use tutor::exercise::{Draw, Truth, draw};
use tutor::lesson::{Exercise, Task};

use crate::cli::{Exercise as Args, Folders};
use crate::exit::{Done, Failure};
use crate::{output, text};

#[derive(Serialize)]
struct Row<'a> {
    id: &'a str,
    lesson: &'a str,
    kind: &'a str,
}

#[derive(Serialize)]
struct Drawn<'a> {
    id: &'a str,
    seed: u64,
    given: &'a Values,
    prompt: &'a str,
    steps: Vec<Step<'a>>,
    truth: serde_json::Value,
    tolerance: Tolerance,
    mistakes: Vec<Mistake<'a>>,
    #[serde(skip_serializing_if = "<[String]>::is_empty")]
    options: &'a [String],
}

#[derive(Serialize)]
struct Step<'a> {
    name: &'a str,
    truth: f64,
}

#[derive(Serialize)]
struct Tolerance {
    rel: f64,
}

#[derive(Serialize)]
struct Mistake<'a> {
    id: &'a str,
    value: f64,
    named: bool,
    step: &'a str,
}

pub fn run(folders: &Folders, args: &Args) -> Result<Done, Failure> {
    let shelf = super::shelf(folders)?;
    let Some(id) = args.id.as_deref().filter(|_| !args.list) else {
        for lesson in shelf.lessons() {
            for exercise in super::exercises(lesson) {
                list_one(lesson, exercise, args.json)?;
            }
        }
        return Ok(Done::Fine);
    };
    let (lesson, exercise) = super::find_exercise(&shelf, id)?;
    let drawn = numbers(lesson, exercise, args.seed)?;
    if args.json {
        output::json(&json(exercise, &drawn))?;
    } else {
        human(exercise, &drawn)?;
    }
    Ok(Done::Fine)
}

/// The numbers of an exercise for a seed.
pub fn numbers(lesson: &Lesson, exercise: &Exercise, seed: u64) -> Result<Draw, Failure> {
    draw(lesson, exercise, seed).map_err(|none| {
        Failure::unusable(format!(
            "{}: {}; `lobe check {}` says more",
            exercise.id, none.message, lesson.file
        ))
    })
}

fn list_one(lesson: &Lesson, exercise: &Exercise, as_json: bool) -> Result<(), Failure> {
    let row = Row {
        id: &exercise.id,
        lesson: &lesson.id,
        kind: kind(&exercise.task),
    };
    if as_json {
        output::json(&row)
    } else {
        output::line(&format!("{:<40} {}", row.id, row.kind))
    }
}

fn kind(task: &Task) -> &'static str {
    match task {
        Task::Numeric { .. } => "numeric",
        Task::Choice { .. } => "choice",
        Task::Order { .. } => "order",
        Task::FindTheMistake { .. } => "find-the-mistake",
    }
}

fn json<'a>(exercise: &'a Exercise, drawn: &'a Draw) -> Drawn<'a> {
    Drawn {
        id: &exercise.id,
        seed: drawn.seed,
        given: &drawn.given,
        prompt: &drawn.prompt,
        steps: drawn
            .steps
            .iter()
            .map(|step| Step {
                name: &step.name,
                truth: step.truth,
            })
            .collect(),
        truth: match &drawn.truth {
            Truth::Number(number) => (*number).into(),
            Truth::Choice(place) => letter(*place).into(),
            Truth::Order(places) => order(places).into(),
        },
        tolerance: Tolerance {
            rel: exercise.tolerance.rel,
        },
        mistakes: drawn
            .mistakes
            .iter()
            .map(|mistake| Mistake {
                id: &mistake.id,
                value: mistake.value,
                named: mistake.named,
                step: &mistake.step,
            })
            .collect(),
        options: &drawn.shown,
    }
}

fn letter(place: usize) -> String {
    char::from(b'a' + (place as u8).min(25)).to_string()
}

fn order(places: &[usize]) -> String {
    let numbers: Vec<String> = places.iter().map(|place| (place + 1).to_string()).collect();
    numbers.join(" ")
}

fn human(exercise: &Exercise, drawn: &Draw) -> Result<(), Failure> {
    for paragraph in drawn.prompt.split('\n') {
        for line in text::wrap_plain(paragraph, 80, "", "") {
            output::line(&line)?;
        }
    }
    for (index, shown) in drawn.shown.iter().enumerate() {
        output::line(&format!("  {}. {shown}", index + 1))?;
    }
    output::line("")?;
    for step in &drawn.steps {
        output::line(&format!("{} = {}", step.ask, step.truth))?;
    }
    match &drawn.truth {
        Truth::Number(number) => output::line(&format!("answer: {number}"))?,
        Truth::Choice(place) => output::line(&format!("answer: {}", letter(*place)))?,
        Truth::Order(places) => output::line(&format!("answer: {}", order(places)))?,
    }
    output::line(&format!("tolerance: {} %", exercise.tolerance.rel * 100.0))?;
    for mistake in &drawn.mistakes {
        let named = if mistake.named { "" } else { " (unnamed)" };
        output::line(&format!(
            "mistake {} in {}: {}{named}",
            mistake.id, mistake.step, mistake.value
        ))?;
    }
    Ok(())
}
