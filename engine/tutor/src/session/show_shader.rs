//! A learner's shader on the screen: what he changed, and the ball that it draws.

use super::problem::{Problem, Turn};
use super::show::{paragraph, text};
use crate::exercise::shader;
use crate::lesson::{Exercise, Lesson};
use crate::prose::Block;

/// A text with more lines than this is not compared line by line.
const MOST_LINES: usize = 400;

/// What is new in an attempt, against the text before it.
pub(super) fn changed(
    exercise: &Exercise,
    problem: &Problem,
    turn: &Turn,
    text: &str,
) -> Vec<Block> {
    let source = shader::task(exercise).map_or("", |task| &task.source);
    let earlier = problem
        .turns
        .iter()
        .take_while(|it| !std::ptr::eq(*it, turn));
    let before = earlier.filter_map(|turn| match turn {
        Turn::Attempt { text, .. } => Some(text.as_str()),
        Turn::Hint { .. } | Turn::GoneOn { .. } => None,
    });
    let before = before.last();
    match differences(before.unwrap_or(source), text) {
        None => vec![
            paragraph("You ran this text:"),
            Block::CodeBlock(text.trim_end().to_owned()),
        ],
        Some(lines) if lines.is_empty() => vec![paragraph(match before {
            Some(_) => "You changed nothing since you ran it last.",
            None => "You ran it as it was.",
        })],
        Some(lines) => vec![
            paragraph("You changed:"),
            Block::CodeBlock(lines.join("\n")),
        ],
    }
}

/// Lines that went (`-`) and came (`+`), in order; `None` where there are too many to compare.
fn differences(before: &str, after: &str) -> Option<Vec<String>> {
    let (old, new): (Vec<&str>, Vec<&str>) = (
        before.trim_end().lines().map(str::trim_end).collect(),
        after.trim_end().lines().map(str::trim_end).collect(),
    );
    if old.len().max(new.len()) > MOST_LINES {
        return None;
    }
    // The longest common rest from every pair of lines on.
    let mut common = vec![vec![0_usize; new.len() + 1]; old.len() + 1];
    for at in (0..old.len()).rev() {
        for to in (0..new.len()).rev() {
            common[at][to] = if old[at] == new[to] {
                common[at + 1][to + 1] + 1
            } else {
                common[at + 1][to].max(common[at][to + 1])
            };
        }
    }
    let (mut at, mut to) = (0, 0);
    let mut lines = Vec::new();
    while at < old.len() || to < new.len() {
        if at < old.len() && to < new.len() && old[at] == new[to] {
            (at, to) = (at + 1, to + 1);
        } else if to == new.len() || (at < old.len() && common[at + 1][to] >= common[at][to + 1]) {
            lines.push(format!("- {}", old[at]).trim_end().to_owned());
            at += 1;
        } else {
            lines.push(format!("+ {}", new[to]).trim_end().to_owned());
            to += 1;
        }
    }
    Some(lines)
}

/// The ball that a text draws, beside the right one; only of what computed something.
pub(super) fn picture(
    lesson: &Lesson,
    exercise: &Exercise,
    result: &str,
    source: &str,
) -> Option<Block> {
    let task = shader::task(exercise)?;
    if task.scene.is_empty() || result == "invalid" {
        return None;
    }
    let caption = text("Right, yours, and yours divided by the right one.");
    Some(Block::Picture {
        lesson: lesson.id.text.clone(),
        id: exercise.id.text.clone(),
        title: "The ball that your function draws".to_owned(),
        caption: vec![caption],
        own: Some(source.to_owned()),
    })
}

#[cfg(test)]
mod tests {
    use super::differences;

    #[track_caller]
    fn check(before: &str, after: &str, lines: &[&str]) {
        let found = differences(before, after).expect("few lines");
        assert_eq!(found, lines);
    }

    #[test]
    fn only_what_changed_is_shown() {
        check("a\nb\nc\n", "a\nb\nc", &[]);
        check("a\nb\nc", "a\nx\nc", &["- b", "+ x"]);
        check("a\nc", "a\n  b\nc", &["+   b"]);
        check("a\nb\nc", "c", &["- a", "- b"]);
        check("", "a", &["+ a"]);
        check("a  \nb", "a\nb  ", &[]);
    }

    #[test]
    fn a_long_text_is_not_compared() {
        assert_eq!(differences(&"a\n".repeat(500), "a"), None);
    }
}
