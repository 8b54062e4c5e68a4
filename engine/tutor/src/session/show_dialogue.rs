//! The dialogue about an answer on the screen: question, reply, and what became of it.

use super::dialogue::{Asked, Reply, Rung, Step, incomplete, script};
use super::question::Try;
use super::show::{text, verdict};
use super::show_question::{marked, second};
use crate::lesson::{Explain, Lesson};
use crate::prose::{Block, Inline, Tone};
use crate::rubric::{Blank, Criterion};
use formula::Values;

/// More of the learner's words than that are cut where they are quoted in a sentence.
const LONGEST_QUOTE: usize = 90;

/// Everything that was asked, replied and told, and the question that stands open.
pub(super) fn blocks(lesson: &Lesson, explain: &Explain, tried: &Try, waiting: bool) -> Vec<Block> {
    let (mut steps, open) = script(&explain.rubric, tried);
    if waiting {
        // What follows from the last reply is still to be seen.
        let last = steps
            .iter()
            .rposition(|step| matches!(step, Step::Replied(_)));
        steps.truncate(last.map_or(0, |last| last + 1));
    }
    let mut blocks = Vec::new();
    let mut asked = 0;
    for (at, step) in steps.iter().enumerate() {
        match step {
            Step::Asked(question) => {
                let replied = matches!(steps.get(at.wrapping_sub(1)), Some(Step::Replied(_)));
                blocks.push(question_block(
                    lesson, explain, tried, question, asked, replied,
                ));
                asked += 1;
            }
            Step::Replied(reply) => {
                blocks.push(marked(
                    &explain.rubric,
                    &reply.text,
                    &reply.why,
                    &reply.first,
                ));
                if waiting && at + 1 == steps.len() {
                    break;
                }
                blocks.extend(second(&explain.rubric, &reply.first, reply.second.as_ref()));
                blocks.extend(heard(reply));
            }
            Step::Told(about) => blocks.extend(told(lesson, explain, about)),
            Step::Left => blocks.push(verdict(
                Tone::Info,
                "As you like",
                vec![text("Then we leave it at that.")],
            )),
        }
    }
    debug_assert!(waiting || open.is_none() || matches!(steps.last(), Some(Step::Asked(_))));
    blocks
}

/// How many of the criteria were told, so that they need no naming again.
pub(super) fn told_ids(explain: &Explain, tried: &Try) -> Vec<String> {
    let (steps, _) = script(&explain.rubric, tried);
    let told = steps.into_iter().filter_map(|step| match step {
        Step::Told(id) => Some(id),
        Step::Asked(_) | Step::Replied(_) | Step::Left => None,
    });
    told.collect()
}

/// What the field is called.
pub(super) fn label(rung: Rung) -> &'static str {
    match rung {
        Rung::Ask | Rung::Hint => "Your reply",
        Rung::Prompt => "What belongs in the blank",
    }
}

/// The question as the learner reads it.
pub(super) fn question(
    lesson: &Lesson,
    explain: &Explain,
    tried: &Try,
    asked: &Asked,
    is_first: bool,
) -> Vec<Inline> {
    let Some(criterion) = explain.rubric.criterion(&asked.about) else {
        return Vec::new();
    };
    let inline = |words: &str| lesson.inline(words, &Values::new());
    match asked.rung {
        Rung::Ask => {
            let (mut says, fits) = lead(explain, tried, &criterion, is_first);
            match criterion.ask {
                Some(ask) => says.extend(inline(ask)),
                None if fits => says.push(text(
                    "I am not sure that I read that right. Say it once more, in other words.",
                )),
                None => says.push(text(
                    "One thing is missing that the question asks for. What else belongs here?",
                )),
            }
            says
        }
        Rung::Hint => criterion.hint.map(inline).unwrap_or_default(),
        Rung::Prompt => criterion
            .prompt
            .map(|prompt| blank(lesson, prompt))
            .unwrap_or_default(),
    }
}

/// The author's sentence with a blank in it.
fn blank(lesson: &Lesson, prompt: &str) -> Vec<Inline> {
    let shown = Blank::of(prompt).map_or_else(|| prompt.to_owned(), |blank| blank.open());
    lesson.inline(&shown, &Values::new())
}

/// The learner's own words that the question starts from, and whether they are about it.
fn lead(
    explain: &Explain,
    tried: &Try,
    criterion: &Criterion<'_>,
    is_first: bool,
) -> (Vec<Inline>, bool) {
    let opened = tried.opened();
    let said = |id: &str| {
        tried
            .why
            .iter()
            .find(|why| why.id == id)
            .map(|why| why.quote.trim())
    };
    let doubted = opened.unsure.iter().any(|id| id == criterion.id);
    let half_said = incomplete(&explain.rubric, opened).map(String::as_str);
    let about = doubted.then(|| said(criterion.id)).flatten();
    if let Some(words) = about.or_else(|| said(half_said?)) {
        return (you_say(words, ". "), true);
    }
    // What is right so far is worth a word, where the first question is asked.
    let required = explain.rubric.expectation.iter().filter(|e| e.required);
    let mut met = required
        .filter(|e| opened.met.contains(&e.id))
        .filter_map(|e| said(&e.id));
    match met.next_back() {
        Some(words) if is_first => (you_say(words, ", and that is right. "), false),
        _ => (Vec::new(), false),
    }
}

fn you_say(words: &str, then: &str) -> Vec<Inline> {
    vec![
        text("You say “"),
        Inline::Emph(cut(words)),
        text(format!("”{then}")),
    ]
}

/// Words that fit into a sentence.
pub(super) fn cut(words: &str) -> String {
    let flat: Vec<&str> = words.split_whitespace().collect();
    let flat = flat.join(" ");
    let flat = flat.trim_end_matches(['.', ',', ';', ':']);
    if flat.chars().count() <= LONGEST_QUOTE {
        return flat.to_owned();
    }
    let head: String = flat.chars().take(LONGEST_QUOTE).collect();
    let end = head.rfind(' ').unwrap_or(head.len());
    format!("{} …", &head[..end])
}

fn question_block(
    lesson: &Lesson,
    explain: &Explain,
    tried: &Try,
    asked: &Asked,
    before: usize,
    replied: bool,
) -> Block {
    let title = match (asked.rung, before) {
        (Rung::Ask, 0) => "One question",
        (Rung::Ask, _) => "Another question",
        (Rung::Hint, _) => "A hint",
        (Rung::Prompt, _) => "Fill in the blank",
    };
    let mut says = Vec::new();
    if replied && asked.rung != Rung::Ask {
        says.push(text("I do not hear it yet. "));
    }
    says.extend(question(lesson, explain, tried, asked, before == 0));
    verdict(Tone::Info, title, says)
}

/// What a reply brought, where it brought what was asked for.
fn heard(reply: &Reply) -> Option<Block> {
    let met = reply.heard().met.contains(&reply.about);
    met.then(|| verdict(Tone::Good, "Yes", vec![text("That was the point.")]))
}

/// The answer, once nothing else helped.
fn told(lesson: &Lesson, explain: &Explain, about: &str) -> Option<Block> {
    let criterion = explain.rubric.criterion(about)?;
    let sentence = criterion
        .prompt
        .and_then(Blank::of)
        .map(|blank| blank.filled(blank.fill));
    let says = match sentence {
        Some(sentence) => lesson.inline(&sentence, &Values::new()),
        None if criterion.is_misconception => {
            let misconceptions = &explain.rubric.misconception;
            let back = misconceptions
                .iter()
                .find(|m| m.id == about)?
                .says_back
                .as_deref();
            lesson.inline(back?, &Values::new())
        }
        None => vec![text(criterion.says)],
    };
    Some(verdict(Tone::Info, "The answer", says))
}
