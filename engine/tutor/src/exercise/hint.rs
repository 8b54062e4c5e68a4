//! Hints in three levels, what is said before an answer, and what is said after a right one.

use formula::{Digits, Values};

use super::plan::steps_of;
use super::{Draw, Truth, digits_kept, percent};
use crate::lesson::{Exercise, Lesson, Shows, Task};
use crate::prose::{Block, Inline};

/// A hint, from a nudge (1) to the answer with its lines (3); other levels give the nearest.
/// Without a step the last level shows all steps.
pub fn hint(
    lesson: &Lesson,
    exercise: &Exercise,
    draw: &Draw,
    step: Option<&str>,
    level: u8,
) -> Vec<Block> {
    let level = level.clamp(1, 3);
    if level < 3 {
        if let Some(text) = exercise.hints.get(usize::from(level) - 1) {
            return lesson.prose(text, &draw.given);
        }
        return nudge(lesson, exercise, step, level);
    }
    match &exercise.task {
        Task::Numeric { .. } => answer(lesson, exercise, draw, step),
        Task::FindTheMistake { .. } if step == Some("line") => wrong_line(lesson, exercise, draw),
        Task::FindTheMistake { .. } => answer(lesson, exercise, draw, None),
        Task::Choice { .. } | Task::Order { .. } => {
            let mut blocks = right_words(draw);
            blocks.extend(after_right(lesson, exercise, draw, step));
            blocks
        }
        Task::Look(look) => {
            let words = match look.shows {
                Shows::Brighter => {
                    "Where the third ball is orange, the bug is too bright: the darker the orange, the more."
                }
                Shows::Darker => {
                    "Where the third ball is blue, the bug is too dark: the darker the blue, the more."
                }
                Shows::Either => {
                    "The stronger the colour of the third ball, the more the bug shows there."
                }
            };
            let mut blocks = vec![Block::Paragraph(vec![Inline::Text(words.to_owned())])];
            blocks.extend(lesson.picture(&look.picture));
            blocks
        }
        Task::Shader(shader) => vec![
            Block::Paragraph(vec![
                Inline::Text("It should compute ".to_owned()),
                Inline::Math(lesson.library.unicode(&shader.is.expr)),
                Inline::Text(". One way to write it:".to_owned()),
            ]),
            Block::CodeBlock(shader.solution.trim_end().to_owned()),
        ],
    }
}

/// What is right, of a choice or an order.
fn right_words(draw: &Draw) -> Vec<Block> {
    let paragraph = |words: String| vec![Block::Paragraph(vec![Inline::Text(words)])];
    let text = |place: &usize| draw.shown.get(*place).map_or("", String::as_str);
    match &draw.truth {
        Truth::Choice(place) => paragraph(format!("It is {}: {}", place + 1, text(place))),
        Truth::Order(places) => {
            let item = |place| vec![Inline::Text(str::to_owned(text(place)))];
            let mut blocks = paragraph("The right order:".to_owned());
            blocks.push(Block::List {
                ordered: true,
                items: places.iter().map(item).collect(),
            });
            blocks
        }
        Truth::Number(value) => paragraph(format!("It is {}.", crate::prose::shortest(*value))),
    }
}

/// What an author who wrote no hint would say: look at the formula; put the numbers in.
fn nudge(lesson: &Lesson, exercise: &Exercise, step: Option<&str>, level: u8) -> Vec<Block> {
    let steps = steps_of(exercise);
    let asked = step
        .and_then(|name| steps.iter().find(|it| it.name.text == name))
        .or(steps.last());
    let words = |text: &str| Inline::Text(text.to_owned());
    let inlines = match asked {
        Some(asked) if level == 2 => vec![
            words("Put the numbers into "),
            Inline::Math(lesson.library.unicode(&asked.is.expr)),
            words("."),
        ],
        _ => vec![words(
            "Go back to the worked example: which of its lines is this?",
        )],
    };
    vec![Block::Paragraph(inlines)]
}

/// The answer with its lines.
fn answer(lesson: &Lesson, exercise: &Exercise, draw: &Draw, step: Option<&str>) -> Vec<Block> {
    let digits = Digits::Significant(digits_kept(exercise).max(4));
    let mut known: Values = draw.given.clone();
    let mut blocks = Vec::new();
    for it in steps_of(exercise) {
        if step.is_none_or(|name| name == it.name.text) {
            let name = match &it.ask {
                Some(ask) => crate::prose::plain(&lesson.inline(ask, &draw.given)),
                None => lesson.spelled(&it.name),
            };
            blocks.push(lesson.derivation(&name, &it.is, &known, digits, Vec::new()));
        }
        if let Ok(value) = lesson.library.eval(&it.is.expr, &known) {
            known.insert(it.name.text.clone(), value);
        }
    }
    blocks
}

fn wrong_line(lesson: &Lesson, exercise: &Exercise, draw: &Draw) -> Vec<Block> {
    let Some(line) = draw.steps.first() else {
        return Vec::new();
    };
    let text = format!("It is line {}.", line.shown);
    let mut blocks = vec![Block::Paragraph(vec![Inline::Text(text)])];
    blocks.extend(after_right(lesson, exercise, draw, Some("line")));
    blocks
}

/// What is said after a right answer: why an option is right, what is wrong with a line, and
/// after the last step what the author adds. Often nothing.
pub fn after_right(
    lesson: &Lesson,
    exercise: &Exercise,
    draw: &Draw,
    step: Option<&str>,
) -> Vec<Block> {
    let says = match &exercise.task {
        Task::Choice { options } => options
            .iter()
            .find(|option| option.right)
            .and_then(|option| option.says.as_ref()),
        Task::FindTheMistake { lines, .. } if step == Some("line") => lines
            .iter()
            .find(|line| line.right.is_some())
            .and_then(|line| line.says.as_ref()),
        _ => None,
    };
    let mut blocks = says.map_or_else(Vec::new, |says| lesson.prose(says, &draw.given));
    let last = draw.steps.last().map(|last| last.name.as_str());
    if let Some(after) = exercise
        .after
        .as_ref()
        .filter(|_| step.is_none() || step == last)
    {
        let mut known = draw.given.clone();
        known.extend(draw.steps.iter().map(|it| (it.name.clone(), it.truth)));
        blocks.extend(lesson.prose(after, &known));
    }
    blocks
}

/// What a learner is told beforehand: "within 1 %; keep 4 digits in between".
pub fn tolerance_words(exercise: &Exercise) -> String {
    match &exercise.task {
        Task::Choice { .. } => "the number of an option".to_owned(),
        Task::Order { .. } => "all numbers, in order".to_owned(),
        Task::Look(look) => format!(
            "a place with at least {} % of the best one's stops",
            percent(look.near)
        ),
        Task::Shader(shader) => format!(
            "`{}` within {} % at every point",
            shader.function,
            percent(exercise.tolerance.rel)
        ),
        Task::Numeric { .. } | Task::FindTheMistake { .. } => {
            let within = format!("within {} %", percent(exercise.tolerance.rel));
            format!("{within}; keep {} digits in between", digits_kept(exercise))
        }
    }
}
