//! `lobe mark`: what the tutor says to an answer.

use std::collections::BTreeMap;
use std::fs;

use tutor::Lesson;
use tutor::exercise::look;
use tutor::exercise::report::MarkReport;
use tutor::exercise::shader::{self, Ran};
use tutor::exercise::{Marking, mark};
use tutor::lesson::Exercise;

use crate::cli::{Folders, Mark};
use crate::exit::{Done, Failure, plain_reason};
use crate::lessons::unknown;
use crate::{output, text};

pub fn run(folders: &Folders, args: &Mark) -> Result<Done, Failure> {
    let shelf = super::shelf(folders)?;
    let (lesson, exercise) = super::find_exercise(&shelf, &args.id)?;
    if shader::task(exercise).is_some() {
        let marking = mark_shader(lesson, exercise, args)?;
        return print(args, &marking);
    }
    if let Some(task) = look::task(exercise) {
        let marking = match look::place(&args.answer) {
            Ok((x, y)) => {
                let sight = crate::fingerprints::sight(lesson, &task.picture, x, y);
                look::mark(task, &sight)
            }
            Err(says) => Marking::Invalid { says },
        };
        return print(args, &marking);
    }
    let drawn = super::exercise::numbers(lesson, exercise, args.seed)?;
    let known = |name: &str| match drawn.steps.iter().any(|step| step.name == name) {
        true => Ok(()),
        false => {
            let names = drawn.steps.iter().map(|step| step.name.as_str());
            Err(unknown(
                "step",
                name,
                names,
                "`lobe exercise ID` shows the steps",
            ))
        }
    };
    args.step.as_deref().map_or(Ok(()), known)?;
    let mut earlier = BTreeMap::new();
    for given in &args.earlier {
        let Some((name, answer)) = given.split_once('=') else {
            return Err(Failure::unusable(format!(
                "--earlier {given}: write NAME=TEXT, such as alpha=0.16"
            )));
        };
        let (name, answer) = (name.trim(), answer.trim());
        known(name)?;
        let alone = mark(
            lesson,
            exercise,
            &drawn,
            Some(name),
            answer,
            &BTreeMap::new(),
        );
        if let Marking::Invalid { says } = alone {
            return Err(Failure::unusable(format!("--earlier {given}: {says}")));
        }
        earlier.insert(name.to_owned(), answer.to_owned());
    }
    let marking = mark(
        lesson,
        exercise,
        &drawn,
        args.step.as_deref(),
        &args.answer,
        &earlier,
    );
    print(args, &marking)
}

/// Runs the text, which is the answer itself or the file that it names, and marks it.
fn mark_shader(lesson: &Lesson, exercise: &Exercise, args: &Mark) -> Result<Marking, Failure> {
    if args.step.is_some() || !args.earlier.is_empty() {
        return Err(Failure::unusable(
            "a shader has no steps: leave --step and --earlier out",
        ));
    }
    let source = match args.answer.strip_prefix('@') {
        None => args.answer.clone(),
        Some(path) => {
            let bytes = fs::read(path)
                .map_err(|error| Failure::unusable(format!("{path}: {}", plain_reason(&error))))?;
            match String::from_utf8(bytes) {
                Ok(source) => source,
                Err(_) => {
                    return Ok(Marking::Invalid {
                        says: "This file is no text: it is not UTF-8.".to_owned(),
                    });
                }
            }
        }
    };
    let Some(job) = shader::job(lesson, exercise, args.seed, &source) else {
        return Err(Failure::unusable(format!(
            "{} has nothing to compare a shader with; `lobe check {}` says more",
            exercise.id, lesson.file
        )));
    };
    let ran = crate::shaders::run(job);
    if let Ran::Unable(why) = &ran {
        return Err(Failure::unusable(format!("the shader was not run: {why}")));
    }
    Ok(shader::mark(lesson, exercise, args.seed, &ran))
}

fn print(args: &Mark, marking: &Marking) -> Result<Done, Failure> {
    if args.json {
        output::json(&MarkReport::new(marking))?;
    } else {
        let named = marking
            .mistake()
            .map_or_else(String::new, |id| format!(" ({id})"));
        output::line(&format!("{}{named}", marking.result()))?;
        let mut code = false;
        for paragraph in marking.says().split('\n') {
            // Code keeps its spaces.
            let fence = paragraph.starts_with("~~~~~~~~~~");
            code ^= fence;
            match (fence, code) {
                (true, _) => {}
                (false, true) => output::line(paragraph)?,
                (false, false) => {
                    for line in text::wrap_plain(paragraph, 80, "", "") {
                        output::line(&line)?;
                    }
                }
            }
        }
    }
    Ok(Done::Fine)
}
