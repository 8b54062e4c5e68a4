//! An exercise on the screen: the question, and everything said about it, in order.

use super::Session;
use super::problem::{Problem, Turn, WHOLE};
use super::screen::Screen;
use super::show::{capital, paragraph, text, verdict};
use super::show_question::count;
use super::show_shader;
use crate::exercise;
use crate::lesson::{Exercise, Lesson, Task};
use crate::prose::{Block, Inline, Tone};
use crate::view::Input;
use crate::worked::given_words;
use formula::{Digits, Values};

pub(super) fn page(session: &Session, screen: &Screen) -> (String, Vec<Block>) {
    let lesson = &session.lesson;
    let key = session.problem_key(screen);
    let Some((exercise, problem)) =
        key.and_then(|key| Some((lesson.exercise(&key.0)?, session.problems.get(&key)?)))
    else {
        return Default::default();
    };
    let heading = heading(screen, exercise, problem);
    if let Err(no_draw) = problem.draw() {
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
        blocks.push(starts_from(lesson, &given));
        blocks.extend(known_lines(lesson, problem, &given));
    }
    if let (Task::FindTheMistake { .. }, Ok(draw)) = (&exercise.task, problem.draw()) {
        blocks.push(Block::List {
            ordered: true,
            items: draw.shown.iter().map(|line| vec![text(line)]).collect(),
        });
    }
    if problem.is_stale() {
        blocks.push(verdict(
            Tone::Info,
            "Answered before the lesson changed",
            vec![text(
                "The numbers you had then are gone; your answers are kept.",
            )],
        ));
    }
    blocks.extend(talk(lesson, exercise, problem));
    if problem.is_done() && !problem.is_stale() {
        blocks.extend(closing(lesson, exercise, problem));
    }
    (heading, blocks)
}

/// What there is to do, in a few words; the header counts.
fn heading(screen: &Screen, exercise: &Exercise, problem: &Problem) -> String {
    if let Screen::Faded(_) = screen {
        return match problem.asked.len() {
            1 => "Your turn: the last line".to_owned(),
            lines => format!("Your turn: the last {} lines", count(lines)),
        };
    }
    let task = match &exercise.task {
        Task::Numeric { steps } if steps.len() > 1 => "Compute it, step by step",
        Task::Numeric { .. } => "Compute it",
        Task::Choice { .. } => "Choose one",
        Task::Order { .. } => "Put them in order",
        Task::FindTheMistake { .. } => "Find the mistake",
        Task::Look(_) => "Where would you look?",
        Task::Shader(_) => "Mend the shader",
    };
    let task = exercise.title.as_ref().map_or(task, |title| &title.text);
    match screen {
        Screen::Retest(_) => format!("{task}, with fresh numbers"),
        _ => task.to_owned(),
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

/// The numbers that a faded example starts from; the lines asked for may need any of them.
fn starts_from(lesson: &Lesson, given: &Values) -> Block {
    let names = lesson.worked.iter().flat_map(|worked| &worked.given);
    let numbers: Vec<String> = names
        .filter_map(|it| Some(given_words(&it.name.text, *given.get(&it.name.text)?)))
        .collect();
    Block::Paragraph(vec![text("Given: "), Inline::Math(numbers.join(", "))])
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
    let current = problem.open().map(|(_, step)| step);
    for (index, step) in problem.asked.iter().enumerate() {
        let mut turns = problem.turns_on(step).peekable();
        let reached = turns.peek().is_some() || current == Some(step);
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
            let title = match level {
                1 => "A nudge",
                2 => "A bigger hint",
                _ => "The answer",
            };
            let hint = match problem.draw() {
                Ok(draw) if !problem.is_stale() => {
                    exercise::hint(lesson, exercise, draw, named(step), *level)
                }
                _ => Vec::new(),
            };
            under(Tone::Info, title, hint)
        }
        Turn::Attempt {
            step,
            text: typed,
            result,
            mistake,
            named: by_author,
            says,
        } if exercise.kind() == "shader" => {
            let (tone, title) = title(result, mistake.is_some(), *by_author);
            let after = match problem.draw() {
                Ok(draw) if result == "correct" && !problem.is_stale() => {
                    exercise::after_right(lesson, exercise, draw, named(step))
                }
                _ if result == "correct" => Vec::new(),
                _ => words(says),
            };
            let mut blocks = show_shader::changed(exercise, problem, turn, typed);
            blocks.extend(under(tone, title, after));
            blocks.extend(show_shader::picture(lesson, exercise, result, typed));
            blocks
        }
        Turn::Attempt {
            step,
            text: typed,
            result,
            mistake,
            named: by_author,
            says,
        } => {
            let answer = vec![
                text("You: "),
                match meant(exercise, problem, typed) {
                    Some(meant) => text(meant),
                    None => Inline::Code(one_line(typed)),
                },
            ];
            let (tone, title) = title(result, mistake.is_some(), *by_author);
            let mut blocks = vec![Block::Paragraph(answer)];
            if result == "correct" {
                let after = match problem.draw() {
                    Ok(draw) if !problem.is_stale() => {
                        exercise::after_right(lesson, exercise, draw, named(step))
                    }
                    _ => Vec::new(),
                };
                let value = confirmed(exercise, problem, step);
                if value.is_empty() {
                    blocks.extend(under(tone, title, after));
                } else {
                    blocks.push(verdict(tone, title, value));
                    blocks.extend(after);
                }
                if let Task::Look(look) = &exercise.task {
                    blocks.extend(lesson.picture(&look.picture));
                }
                return blocks;
            }
            let says = untitled(says);
            blocks.extend(under(tone, title, lesson.prose(&says, &Values::new())));
            blocks
        }
        Turn::GoneOn { step } => {
            let last = problem.asked.last() == Some(step);
            let own = !last && problem.hints(step) < 3 && exercise.kind() == "numeric";
            let more = if own { "; on with your own value" } else { "" };
            vec![paragraph(format!("Left as it is{more}."))]
        }
    }
}

/// What was said without what the title says already.
fn untitled(says: &str) -> String {
    says.strip_prefix("Not yet").map_or_else(
        || says.to_owned(),
        |rest| capital(rest.trim_start_matches([':', '.', ' '])),
    )
}

/// What was said about a learner's own text: nothing in it is a template.
fn words(says: &str) -> Vec<Block> {
    crate::prose::markdown_alone(&untitled(says))
}

fn named(step: &str) -> Option<&str> {
    (step != WHOLE).then_some(step)
}

fn title(result: &str, mistake: bool, by_author: bool) -> (Tone, &'static str) {
    match result {
        "correct" => (Tone::Good, "Correct"),
        "carried" => (Tone::Near, "Right, given the earlier slip"),
        "precision" => (Tone::Near, "Nearly"),
        "mistake" if by_author => (Tone::Bad, "A known mistake"),
        "mistake" if mistake => (Tone::Bad, "A likely slip"),
        "invalid" => (Tone::Info, "Not counted"),
        _ => (Tone::Bad, "Not yet"),
    }
}

/// Blocks below a title; a paragraph that comes first stands beside it.
fn under(tone: Tone, title: &str, blocks: Vec<Block>) -> Vec<Block> {
    let mut rest = blocks.into_iter().peekable();
    let first = match rest.next_if(|block| matches!(block, Block::Paragraph(_))) {
        Some(Block::Paragraph(first)) => first,
        _ => Vec::new(),
    };
    std::iter::once(verdict(tone, title, first))
        .chain(rest)
        .collect()
}

/// What a right answer is told: the value itself, so that rounding is seen.
fn confirmed(exercise: &Exercise, problem: &Problem, step: &str) -> Vec<Inline> {
    match problem.truth(step) {
        Some(_) if problem.is_stale() => Vec::new(),
        // An exercise that asks for one thing only has no name for it.
        Some((_, shown)) if problem.asked == ["answer"] => vec![Inline::Math(shown)],
        Some((_, shown)) if is_line(exercise, step) => vec![text(format!("Line {shown}."))],
        Some((ask, shown)) if !ask.is_empty() => vec![Inline::Math(format!("{ask} = {shown}"))],
        Some(_) | None => Vec::new(),
    }
}

/// Whether the number of a line is asked for.
fn is_line(exercise: &Exercise, step: &str) -> bool {
    matches!(exercise.task, Task::FindTheMistake { .. }) && step == "line"
}

/// How a step is called when asked for.
fn ask(problem: &Problem, step: &str) -> String {
    problem
        .truth(step)
        .map(|(ask, _)| ask)
        .filter(|ask| !ask.is_empty())
        .unwrap_or_else(|| "your answer".to_owned())
}

/// After the last step: the whole way, where some of it is still to be seen.
fn closing(lesson: &Lesson, exercise: &Exercise, problem: &Problem) -> Vec<Block> {
    let unseen = |step: &&String| problem.hints(step) < 3 && !problem.is_correct(step);
    if !problem.asked.iter().any(|step| unseen(&step)) {
        return Vec::new();
    }
    let Ok(draw) = problem.draw() else {
        return Vec::new();
    };
    let mut blocks = vec![Block::Heading("The whole way".to_owned())];
    for step in &problem.asked {
        blocks.extend(exercise::hint(lesson, exercise, draw, named(step), 3));
    }
    blocks
}

/// What is asked for on the screen shown.
pub(super) fn input(session: &Session, problem: &Problem, step: &str) -> Input {
    let key = session.problem_key(session.here());
    let exercise = key.and_then(|(item, _)| session.lesson.exercise(&item));
    let (Some(exercise), Ok(draw)) = (exercise, problem.draw()) else {
        return Input::None;
    };
    match &exercise.task {
        Task::Choice { .. } => Input::Choice {
            options: draw.shown.clone(),
        },
        Task::Order { .. } => Input::Order {
            items: draw.shown.clone(),
        },
        Task::Look(look) => Input::Place {
            picture: look.picture.text.clone(),
            at: problem.place(),
        },
        Task::Shader(shader) => Input::Code {
            label: shader.function.text.clone(),
            note: exercise::tolerance_words(exercise),
            text: problem.text(&shader.source),
        },
        Task::FindTheMistake { .. } if step == "line" => Input::Number {
            label: ask(problem, step),
            note: format!("its number, 1 to {}", draw.shown.len()),
            draft: problem.draft.clone().unwrap_or_default(),
        },
        Task::Numeric { .. } | Task::FindTheMistake { .. } => Input::Number {
            label: ask(problem, step),
            note: exercise::tolerance_words(exercise),
            draft: problem.draft.clone().unwrap_or_default(),
        },
    }
}

/// What an exercise still asks for, for those who read without answering.
pub(super) fn still_asked(session: &Session, screen: &Screen) -> Vec<Block> {
    let key = session.problem_key(screen);
    let Some((exercise, problem)) = key.and_then(|key| {
        Some((
            session.lesson.exercise(&key.0)?,
            session.problems.get(&key)?,
        ))
    }) else {
        return Vec::new();
    };
    let Some((draw, current)) = problem.open() else {
        return Vec::new();
    };
    match &exercise.task {
        Task::Choice { .. } | Task::Order { .. } => vec![Block::List {
            ordered: matches!(exercise.task, Task::Order { .. }),
            items: draw
                .shown
                .iter()
                .map(|option| session.lesson.inline(option, &Values::new()))
                .collect(),
        }],
        Task::Look(_) => vec![paragraph(
            "Asked: the place on the ball where you would look.",
        )],
        Task::Shader(shader) => vec![
            Block::CodeBlock(shader.source.trim_end().to_owned()),
            paragraph(format!("Asked: {}.", exercise::tolerance_words(exercise))),
        ],
        Task::Numeric { .. } | Task::FindTheMistake { .. } => {
            let open = problem.asked.iter().skip_while(|step| *step != current);
            let asks: Vec<String> = open.map(|step| ask(problem, step)).collect();
            let within = exercise::tolerance_words(exercise);
            vec![paragraph(format!("Asked: {} ({within}).", asks.join("; ")))]
        }
    }
}

/// The options behind a letter or numbers.
fn meant(exercise: &Exercise, problem: &Problem, typed: &str) -> Option<String> {
    let shown = &problem.draw().ok().filter(|_| !problem.is_stale())?.shown;
    match &exercise.task {
        Task::Choice { .. } => {
            let typed = typed.trim();
            let place = match typed.parse::<usize>() {
                Ok(number) => number.checked_sub(1)?,
                Err(_) => {
                    let mut chars = typed.chars();
                    let letter = chars.next()?.to_ascii_lowercase();
                    if chars.any(|c| c.is_alphanumeric()) || !letter.is_ascii_lowercase() {
                        return None;
                    }
                    usize::from(letter as u8 - b'a')
                }
            };
            shown.get(place).cloned()
        }
        Task::Order { .. } => {
            let numbers = typed.split(|c: char| !c.is_ascii_digit());
            let places = numbers.filter(|number| !number.is_empty());
            let texts: Option<Vec<&str>> = places
                .map(|number| {
                    let place = number.parse::<usize>().ok()?.checked_sub(1)?;
                    shown.get(place).map(String::as_str)
                })
                .collect();
            texts
                .filter(|texts| texts.len() == shown.len())
                .map(|texts| texts.join(" → "))
        }
        Task::Look(_) => Some(super::pointing::words(typed)),
        Task::Numeric { .. } | Task::FindTheMistake { .. } | Task::Shader(_) => None,
    }
}

fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}
