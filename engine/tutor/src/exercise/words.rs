//! Marking what is no number: an option, an order, a line.

use super::{Draw, Marking, Truth};
use crate::lesson::{ChoiceOption, Exercise, Lesson, SuspectLine, Task};
use crate::prose::plain;

/// An option: its number, its letter.
pub fn mark_choice(lesson: &Lesson, exercise: &Exercise, draw: &Draw, answer: &str) -> Marking {
    let count = draw.shown.len();
    let chosen = answer.trim().trim_end_matches([')', '.']);
    let letter = match chosen.as_bytes() {
        [letter] if letter.is_ascii_alphabetic() => {
            Some(usize::from(letter.to_ascii_lowercase() - b'a') + 1)
        }
        _ => None,
    };
    let number = letter
        .or_else(|| chosen.parse().ok())
        .filter(|number| (1..=count).contains(number));
    let Some(number) = number else {
        return Marking::Invalid {
            says: format!("Type the number of an option, 1 to {count}."),
        };
    };
    if draw.truth == Truth::Choice(number - 1) {
        return Marking::Correct;
    }
    let option = option_shown(lesson, exercise, draw, number - 1);
    let says = option.and_then(|option| option.says.as_ref()).map_or_else(
        || "Not that one.".to_owned(),
        |says| lesson.filled(says, &draw.given),
    );
    match option.and_then(|option| option.mistake.as_ref()) {
        Some(id) => Marking::Mistake {
            id: id.text.clone(),
            says,
        },
        None => Marking::Wrong { says },
    }
}

/// The option that is shown at a place.
pub fn option_shown<'l>(
    lesson: &Lesson,
    exercise: &'l Exercise,
    draw: &Draw,
    place: usize,
) -> Option<&'l ChoiceOption> {
    let Task::Choice { options } = &exercise.task else {
        return None;
    };
    let shown = draw.shown.get(place)?;
    options
        .iter()
        .find(|option| plain(&lesson.inline(&option.text, &draw.given)) == *shown)
}

/// An order: the items' numbers, such as `2 1 3`.
pub fn mark_order(draw: &Draw, answer: &str) -> Marking {
    let count = draw.shown.len();
    let digits: Vec<usize> = answer
        .chars()
        .filter_map(|c| c.to_digit(10))
        .map(|digit| digit as usize)
        .collect();
    let mut sorted = digits.clone();
    sorted.sort_unstable();
    let separators = |c: char| c.is_ascii_digit() || c.is_whitespace() || ",;.->→<".contains(c);
    if sorted != (1..=count).collect::<Vec<_>>() || !answer.chars().all(separators) {
        let example: Vec<String> = (1..=count).rev().map(|n| n.to_string()).collect();
        return Marking::Invalid {
            says: format!(
                "Type every number once, in order, such as {}.",
                example.join(" ")
            ),
        };
    }
    let Truth::Order(right) = &draw.truth else {
        return Marking::Correct;
    };
    let wrong = digits
        .iter()
        .zip(right)
        .position(|(typed, right)| *typed != right + 1);
    match wrong {
        None => Marking::Correct,
        Some(0) => Marking::Wrong {
            says: "Not yet: it starts with another one.".to_owned(),
        },
        Some(place) => Marking::Wrong {
            says: format!(
                "Not yet: right up to place {place}, \"{}\"; something else comes next.",
                draw.shown[right[place - 1]]
            ),
        },
    }
}

/// The number or the name of the wrong line.
pub fn mark_line(lesson: &Lesson, lines: &[SuspectLine], answer: &str) -> Marking {
    let typed = answer.trim();
    let bare = typed
        .to_lowercase()
        .trim_start_matches("line")
        .trim()
        .trim_end_matches([')', '.'])
        .to_owned();
    let named = lines
        .iter()
        .position(|line| line.name.text == typed || lesson.spelled(&line.name) == typed);
    let number = named
        .map(|index| index + 1)
        .or_else(|| bare.parse().ok())
        .filter(|number| (1..=lines.len()).contains(number));
    let Some(number) = number else {
        return Marking::Invalid {
            says: format!("Type the number of a line, 1 to {}.", lines.len()),
        };
    };
    let wrong = lines.iter().position(|line| line.right.is_some());
    if wrong == Some(number - 1) {
        return Marking::Correct;
    }
    let says = if wrong.is_some_and(|wrong| number - 1 > wrong) {
        format!("Line {number} follows faithfully from the lines before it; the slip is earlier.")
    } else {
        format!("Line {number} is right as it stands; the slip comes later.")
    };
    Marking::Wrong { says }
}
