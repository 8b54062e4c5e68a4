//! `lobe mark`: what the tutor says to an answer.

use std::collections::BTreeMap;

use tutor::exercise::report::MarkReport;
use tutor::exercise::{Marking, mark};

use crate::cli::{Folders, Mark};
use crate::exit::{Done, Failure};
use crate::lessons::unknown;
use crate::{output, text};

pub fn run(folders: &Folders, args: &Mark) -> Result<Done, Failure> {
    let shelf = super::shelf(folders)?;
    let (lesson, exercise) = super::find_exercise(&shelf, &args.id)?;
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
    if args.json {
        output::json(&MarkReport::new(&marking))?;
    } else {
        let named = marking
            .mistake()
            .map_or_else(String::new, |id| format!(" ({id})"));
        output::line(&format!("{}{named}", marking.result()))?;
        for line in text::wrap_plain(marking.says(), 80, "", "") {
            output::line(&line)?;
        }
    }
    Ok(Done::Fine)
}
