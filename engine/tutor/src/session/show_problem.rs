//! An exercise on the screen: the question, and everything said about it, in order.

use super::Session;
use super::problem::{Problem, Turn, WHOLE};
use super::screen::Screen;
use super::show::{paragraph, text, verdict};
use crate::exercise;
use crate::lesson::{Exercise, Lesson, Task};
use crate::prose::{Block, Inline, Tone};
use crate::view::Input;
use formula::{Digits, Values};

pub(super) fn page(session: &Session, screen: &Screen) -> (String, Vec<Block>) {
    let lesson = &session.lesson;
    let key = session.problem_key(screen);
    let Some((exercise, problem)) =
        key.and_then(|key| Some((lesson.exercise(&key.0)?, session.problems.get(&key)?)))
    else {
        return Default::default();
    };
    let heading = heading(session, screen);
    if let Err(no_draw) = &problem.draw {
        let says = format!("{} Go on without it.", no_draw.message);
        return (
            heading,
            vec![verdict(
                Tone::Info,
                "No numbers to be had",
                vec![text(says)],
            )],
        );
    }
    let given = problem.given();
    let mut blocks = Vec::new();
    blocks.extend(opening(screen));
    blocks.extend(lesson.prose(&exercise.ask, &given));
    if let Screen::Faded(_) = screen {
        blocks.extend(known_lines(lesson, problem, &given));
    }
    if let (Task::FindTheMistake { .. }, Ok(draw)) = (&exercise.task, &problem.draw) {
        blocks.push(Block::List {
            ordered: true,
            items: draw.shown.iter().map(|line| vec![text(line)]).collect(),
        });
    }
    if problem.stale {
        blocks.push(verdict(
            Tone::Info,
            "Answered before the lesson changed",
            vec![text(
                "The numbers you had then are gone; your answers are kept.",
            )],
        ));
    }
    blocks.extend(talk(lesson, exercise, problem));
    if problem.is_done() && !problem.stale {
        blocks.extend(closing(lesson, exercise, problem));
    }
    (heading, blocks)
}

fn heading(session: &Session, screen: &Screen) -> String {
    let number = |stage: fn(&Screen) -> bool| {
        let mut all = session.path.iter().filter(|other| stage(other));
        let of = session.path.iter().filter(|other| stage(other)).count();
        let at = all.position(|other| other == screen).map_or(1, |at| at + 1);
        format!("{at} of {of}")
    };
    match screen {
        Screen::Faded(_) => {
            let title = session
                .lesson
                .worked
                .as_ref()
                .map(|w| w.title.text.as_str());
            let which = number(|s| matches!(s, Screen::Faded(_)));
            format!("{}: your turn, {which}", title.unwrap_or("Worked example"))
        }
        Screen::Retest(_) => {
            let which = number(|s| matches!(s, Screen::Retest(_)));
            format!("Again with fresh numbers, {which}")
        }
        _ => format!("Exercise {}", number(|s| matches!(s, Screen::Practice(_)))),
    }
}

fn opening(screen: &Screen) -> Option<Block> {
    match screen {
        Screen::Faded(1) => Some(paragraph(
            "The same example with other numbers. The first lines are done; you fill in the rest.",
        )),
        Screen::Faded(_) => Some(paragraph(
            "Once more with other numbers, and more of the lines are yours.",
        )),
        _ => None,
    }
}

/// The lines of a faded example that are not asked for.
fn known_lines(lesson: &Lesson, problem: &Problem, given: &Values) -> Vec<Block> {
    let mut values = given.clone();
    let lines = lesson.worked.iter().flat_map(|worked| &worked.lines);
    lines
        .take_while(|line| !problem.asked.contains(&line.name.text))
        .map(|line| {
            let name = line.ask.as_ref();
            let name = name.map_or_else(|| lesson.spelled(&line.name), |ask| ask.text.clone());
            let digits = Digits::Significant(4);
            let block = lesson.derivation(&name, &line.is, &values, digits, Vec::new());
            if let Ok(value) = lesson.library.eval(&line.is.expr, &values) {
                values.insert(line.name.text.clone(), value);
            }
            block
        })
        .collect()
}

/// Step by step, what was asked, answered, hinted and said.
fn talk(lesson: &Lesson, exercise: &Exercise, problem: &Problem) -> Vec<Block> {
    let mut blocks = Vec::new();
    let several = problem.asked.len() > 1;
    let current = problem.current();
    for (index, step) in problem.asked.iter().enumerate() {
        let mut turns = problem.turns_on(step).peekable();
        let reached = turns.peek().is_some() || current == Some(step.as_str());
        if !reached {
            continue;
        }
        if several {
            let ask = ask(problem, step);
            blocks.push(Block::Heading(format!(
                "{} of {}: {ask}",
                index + 1,
                problem.asked.len()
            )));
        }
        for turn in turns {
            blocks.extend(said(lesson, exercise, problem, turn));
        }
    }
    blocks
}

fn said(lesson: &Lesson, exercise: &Exercise, problem: &Problem, turn: &Turn) -> Vec<Block> {
    match turn {
        Turn::Hint { step, level } => {
            let Ok(draw) = &problem.draw else {
                return Vec::new();
            };
            let title = match level {
                1 => "A nudge",
                2 => "A bigger hint",
                _ => "The answer",
            };
            let named = (step != WHOLE).then_some(step.as_str());
            let mut blocks = vec![verdict(Tone::Info, title, Vec::new())];
            blocks.extend(exercise::hint(lesson, exercise, draw, named, *level));
            blocks
        }
        Turn::Attempt {
            step,
            text: typed,
            result,
            mistake,
            says,
            ..
        } => {
            let answer = vec![text("You: "), Inline::Code(one_line(typed))];
            let (tone, title) = title(result, mistake.as_deref());
            let says = match result.as_str() {
                "correct" => confirmed(problem, step),
                _ => lesson.inline(says, &Values::new()),
            };
            vec![Block::Paragraph(answer), verdict(tone, title, says)]
        }
        Turn::GoneOn { .. } => vec![paragraph("Left as it is; on with your own value.")],
    }
}

fn title(result: &str, mistake: Option<&str>) -> (Tone, &'static str) {
    match (result, mistake) {
        ("correct", _) => (Tone::Good, "Correct"),
        ("carried", _) => (Tone::Near, "Right, given the earlier slip"),
        ("precision", _) => (Tone::Near, "The right value, too few digits"),
        ("mistake", Some(_)) => (Tone::Bad, "A mistake with a name"),
        ("mistake", None) => (Tone::Bad, "Not this"),
        ("invalid", _) => (Tone::Info, "Not counted"),
        _ => (Tone::Bad, "Not yet"),
    }
}

/// What a right answer is told: the value itself, so that rounding is seen.
fn confirmed(problem: &Problem, step: &str) -> Vec<Inline> {
    match problem.truth(step) {
        Some((ask, shown)) if !ask.is_empty() && !problem.stale => {
            vec![Inline::Math(format!("{ask} = {shown}"))]
        }
        _ => Vec::new(),
    }
}

/// How a step is called when asked for.
fn ask(problem: &Problem, step: &str) -> String {
    problem
        .truth(step)
        .map(|(ask, _)| ask)
        .filter(|ask| !ask.is_empty())
        .unwrap_or_else(|| "your answer".to_owned())
}

/// After the last step: the whole way, where it was not gone without help.
fn closing(lesson: &Lesson, exercise: &Exercise, problem: &Problem) -> Vec<Block> {
    if problem.is_clean() {
        return Vec::new();
    }
    let Ok(draw) = &problem.draw else {
        return Vec::new();
    };
    if problem.is_solved() && problem.asked.len() == 1 {
        return Vec::new();
    }
    let mut blocks = vec![Block::Heading("The whole way".to_owned())];
    for step in &problem.asked {
        let named = (step != WHOLE).then_some(step.as_str());
        blocks.extend(exercise::hint(lesson, exercise, draw, named, 3));
    }
    blocks
}

pub(super) fn input(session: &Session, problem: &Problem, step: &str) -> Input {
    let Some((item, _)) = session.problem_key(session.here()) else {
        return Input::None;
    };
    let (Some(exercise), Ok(draw)) = (session.lesson.exercise(&item), &problem.draw) else {
        return Input::None;
    };
    match &exercise.task {
        Task::Choice { .. } => Input::Choice {
            options: draw.shown.clone(),
        },
        Task::Order { .. } => Input::Order {
            items: draw.shown.clone(),
        },
        Task::FindTheMistake { .. } if step == "line" => Input::Choice {
            options: draw.shown.clone(),
        },
        Task::Numeric { .. } | Task::FindTheMistake { .. } => Input::Number {
            label: ask(problem, step),
            note: exercise::tolerance_words(exercise),
        },
    }
}

fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}
