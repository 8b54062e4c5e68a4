//! `lobe exercise`: every exercise, or one with its numbers drawn.

use tutor::Lesson;
use tutor::exercise::report::{ExerciseReport, list};
use tutor::exercise::{Draw, Truth, draw};
use tutor::lesson::Exercise;

use crate::cli::{Exercise as Args, Folders};
use crate::exit::{Done, Failure};
use crate::{output, text};

pub fn run(folders: &Folders, args: &Args) -> Result<Done, Failure> {
    let shelf = super::shelf(folders)?;
    let Some(id) = args.id.as_deref().filter(|_| !args.list) else {
        for row in shelf.lessons().flat_map(|lesson| list(lesson)) {
            if args.json {
                output::json(&row)?;
            } else {
                output::line(&format!("{:<32} {}", row.id, row.kind))?;
            }
        }
        return Ok(Done::Fine);
    };
    let (lesson, exercise) = super::find_exercise(&shelf, id)?;
    let drawn = numbers(lesson, exercise, args.seed)?;
    if args.json {
        output::json(&ExerciseReport::new(exercise, &drawn))?;
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

fn human(exercise: &Exercise, drawn: &Draw) -> Result<(), Failure> {
    for paragraph in drawn.prompt.split('\n') {
        for line in text::wrap_plain(paragraph, 80, "", "") {
            output::line(&line)?;
        }
    }
    for (index, shown) in drawn.shown.iter().enumerate() {
        output::line(&format!("  {}. {shown}", index + 1))?;
    }
    if let Some(task) = tutor::exercise::shader::task(exercise) {
        output::line("")?;
        output::line(task.source.trim_end())?;
    }
    output::line("")?;
    for step in &drawn.steps {
        output::line(&format!("{} = {}", step.ask, step.truth))?;
    }
    match &drawn.truth {
        Truth::Number(number) => output::line(&format!("answer: {number}"))?,
        Truth::Choice(place) => output::line(&format!("answer: {}", place + 1))?,
        Truth::Order(places) => {
            let numbers: Vec<String> = places.iter().map(|place| (place + 1).to_string()).collect();
            output::line(&format!("answer: {}", numbers.join(" ")))?;
        }
    }
    output::line(&format!("tolerance: {} %", exercise.tolerance.rel * 100.0))?;
    for mistake in &drawn.mistakes {
        let named = if mistake.named { "" } else { " (unnamed)" };
        let (id, step, value) = (&mistake.id, &mistake.step, mistake.value);
        output::line(&format!("mistake {id} in {step}: {value}{named}"))?;
    }
    Ok(())
}
