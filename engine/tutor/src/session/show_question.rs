//! An explain-back question on the screen: what was said, what was heard, what is missing.

use super::Session;
use super::consult::is_in_doubt;
use super::dialogue::Turn;
use super::event::Quote;
use super::question::{Heard, Question, Second, Try};
use super::show::{capital, paragraph, text, verdict};
use super::show_dialogue;
use crate::judge::Verdict;
use crate::lesson::{Explain, Lesson};
use crate::prose::{Block, Inline, Tone};
use crate::rubric::Rubric;
use formula::Values;

pub(super) fn page(session: &Session, item: &str, attempt: u32) -> (String, Vec<Block>) {
    let lesson = &session.lesson;
    let (Some(explain), Some(question)) = (lesson.explain(item), session.questions.get(item))
    else {
        return Default::default();
    };
    let mut blocks = Vec::new();
    if attempt == 2 {
        blocks.push(paragraph(
            "The same question again; answer it in new words.",
        ));
    }
    blocks.extend(lesson.prose(&explain.prompt, &Values::new()));
    if attempt == 2
        && let Some(first) = question.tries.first()
    {
        blocks.extend(remembered(lesson, explain, first));
    }
    blocks.extend(hints(lesson, explain, question, attempt));
    if let Some(tried) = question.tries.get((attempt as usize).saturating_sub(1)) {
        let waiting = session.is_waiting(item, attempt);
        blocks.extend(feedback(lesson, explain, question, tried, attempt, waiting));
    }
    let heading = match attempt {
        2 => format!("{} (second try)", explain.title.text),
        _ => explain.title.text.clone(),
    };
    (heading, blocks)
}

/// The first try, while writing the second.
fn remembered(lesson: &Lesson, explain: &Explain, first: &Try) -> Vec<Block> {
    let mut blocks = vec![paragraph("You wrote:"), quoted(explain, first)];
    blocks.extend(first.turns.iter().filter_map(|turn| match turn {
        Turn::Replied(reply) => Some(marked(
            &explain.rubric,
            &reply.text,
            &reply.why,
            &reply.first,
        )),
        Turn::Further { .. } | Turn::Left => None,
    }));
    blocks.extend(missing(lesson, explain, first, &[]));
    blocks
}

fn hints(lesson: &Lesson, explain: &Explain, question: &Question, attempt: u32) -> Vec<Block> {
    let shown = question.hints[(attempt as usize).clamp(1, 2) - 1];
    let nudges = question.nudges(explain, attempt);
    let mut blocks: Vec<Block> = nudges
        .iter()
        .take(shown as usize)
        .map(|nudge| verdict(Tone::Info, "A nudge", lesson.inline(nudge, &Values::new())))
        .collect();
    if shown == 3 {
        blocks.push(Block::Heading("A model answer".to_owned()));
        blocks.extend(lesson.prose(&explain.model_answer, &Values::new()));
        blocks.push(paragraph("Now say it in your own words, without looking."));
    }
    blocks
}

fn feedback(
    lesson: &Lesson,
    explain: &Explain,
    question: &Question,
    tried: &Try,
    attempt: u32,
    waiting: bool,
) -> Vec<Block> {
    let rubric = &explain.rubric;
    let mut blocks = vec![quoted(explain, tried)];
    if waiting && tried.turns.is_empty() {
        return blocks;
    }
    blocks.extend(second(rubric, &tried.first, tried.second.as_ref()));
    blocks.extend(show_dialogue::blocks(lesson, explain, tried, waiting));
    if waiting || tried.asked.is_some() {
        return blocks;
    }
    if tried.wants_marks(rubric) || tried.own.is_some() {
        blocks.push(verdict(
            Tone::Info,
            "I cannot tell",
            vec![text(
                "I am not sure that I read this right, and will not guess. Here is a model \
                 answer: mark your own against it. It is kept as your own marking. Or skip this: \
                 then it is left for a teacher to read.",
            )],
        ));
        blocks.extend(lesson.prose(&explain.model_answer, &Values::new()));
    }
    if tried.wants_marks(rubric) {
        return blocks;
    }
    if tried.own.is_some() {
        blocks.push(Block::Checklist {
            points: tried
                .points(rubric)
                .into_iter()
                .map(|(id, says)| (says, tried.marks.get(&id).copied()))
                .collect(),
        });
    }
    blocks.push(headline(explain, tried, attempt));
    blocks.extend(said(explain, tried));
    blocks.extend(corrections(lesson, explain, tried));
    if tried.result().passed() {
        if tried.own.is_none() {
            blocks.extend(model_answer(lesson, explain, "One way to put it"));
        }
        return blocks;
    }
    if attempt == 1 {
        let told = show_dialogue::told_ids(explain, tried);
        blocks.extend(missing(lesson, explain, tried, &told));
        let names = question.reteaches(lesson, explain);
        let names: Vec<&str> = names
            .iter()
            .filter_map(|name| lesson.reteach(name))
            .map(|reteach| reteach.name.text.as_str())
            .collect();
        blocks.push(paragraph(match names.as_slice() {
            [] => "Then once more in your own words.".to_owned(),
            names => format!("Next: {}. Then the same question again.", and(names)),
        }));
    } else if tried.own.is_none() {
        blocks.extend(model_answer(lesson, explain, "What I was listening for"));
    }
    blocks
}

/// What a second opinion settled, or why the learner waited in vain.
pub(super) fn second(rubric: &Rubric, first: &Heard, second: Option<&Second>) -> Option<Block> {
    let second = second?;
    let doubted = is_in_doubt(rubric, &first.unsure);
    let says = match (&second.settled, &second.problem) {
        (Some(_), _) => "I was not sure of all of this; who was asked beside me is.".to_owned(),
        (None, Some(problem)) if doubted => format!("Without one: {problem}."),
        (None, _) => return None,
    };
    Some(verdict(Tone::Info, "A second opinion", vec![text(says)]))
}

fn model_answer(lesson: &Lesson, explain: &Explain, title: &str) -> Vec<Block> {
    let mut blocks = vec![Block::Heading(title.to_owned())];
    blocks.extend(lesson.prose(&explain.model_answer, &Values::new()));
    blocks
}

/// The answer, the words marked that decided what was heard in it.
fn quoted(explain: &Explain, tried: &Try) -> Block {
    marked(&explain.rubric, &tried.text, &tried.why, &tried.first)
}

/// The learner's words, what decided them marked.
pub(super) fn marked(rubric: &Rubric, text: &str, why: &[Quote], heard: &Heard) -> Block {
    let among = |ids: &[String], id: &str| ids.iter().any(|other| other == id);
    let tone = |id: &str| {
        if among(&heard.unsure, id) {
            Some(Tone::Info)
        } else if among(&heard.met, id) {
            Some(Tone::Good)
        } else if among(&heard.misconceptions, id) {
            let known = rubric.misconception.iter().find(|m| m.id == id)?;
            Some(if known.blocking {
                Tone::Bad
            } else {
                Tone::Near
            })
        } else {
            None
        }
    };
    let mut marks: Vec<(usize, usize, Tone)> = why
        .iter()
        .filter(|why| text.get(why.start..why.end).is_some_and(|q| !q.is_empty()))
        .filter_map(|why| Some((why.start, why.end, tone(&why.id)?)))
        .collect();
    // One stretch, one colour: the first mark wins where two overlap.
    marks.sort_by_key(|(start, end, _)| (*start, *end));
    let mut until = 0;
    marks.retain(|(start, end, _)| {
        let free = *start >= until;
        if free {
            until = *end;
        }
        free
    });
    Block::Quoted {
        text: text.to_owned(),
        marks,
    }
}

/// What was heard, point by point, each with the words that say it.
fn said(explain: &Explain, tried: &Try) -> Vec<Block> {
    let result = tried.result();
    let met = explain
        .rubric
        .expectation
        .iter()
        .filter(|e| result.met.contains(&e.id));
    let items: Vec<Vec<Inline>> = met
        .filter_map(|e| {
            let words = show_dialogue::cut(tried.words_for(&e.id)?);
            Some(vec![
                text("“"),
                Inline::Strong(words),
                text(format!("”: {}", e.says)),
            ])
        })
        .collect();
    if items.is_empty() {
        return Vec::new();
    }
    vec![
        paragraph("What I heard:"),
        Block::List {
            ordered: false,
            items,
        },
    ]
}

fn headline(explain: &Explain, tried: &Try, attempt: u32) -> Block {
    let result = tried.result();
    let required = explain.rubric.expectation.iter().filter(|e| e.required);
    let of = required.clone().count();
    let met = required.filter(|e| result.met.contains(&e.id)).count();
    let own = tried.own.is_some();
    let (tone, title, says) = match result.verdict {
        Verdict::Pass if own => (
            Tone::Good,
            "By your own marking: yes",
            "Then it is all there.".to_owned(),
        ),
        Verdict::Pass if !tried.turns.is_empty() => (
            Tone::Good,
            "Now it is all there",
            "With what you added, that is the whole of it.".to_owned(),
        ),
        Verdict::Pass if attempt == 2 => (
            Tone::Good,
            "Now it is all there",
            "That is the whole of it, and you said it yourself.".to_owned(),
        ),
        Verdict::Pass => (
            Tone::Good,
            "That is it",
            match of {
                0 | 1 => "You said what matters.".to_owned(),
                2 => "Both points are there.".to_owned(),
                of => format!("All {of} points are there."),
            },
        ),
        Verdict::Unsure if attempt == 1 => (
            Tone::Near,
            "Not all of it yet",
            "Part of it I am not sure of, and part of it is missing.".to_owned(),
        ),
        _ if of > 0 && met == of => (
            Tone::Near,
            "Nearly",
            "The points are there, but something else you say stands against them.".to_owned(),
        ),
        Verdict::Partial => (
            Tone::Near,
            "Part of it",
            format!(
                "{} of {} points {} there.",
                capital(&count(met)),
                count(of),
                if met == 1 { "is" } else { "are" }
            ),
        ),
        Verdict::Fail | Verdict::Unsure => (
            Tone::Bad,
            "Not yet",
            "I did not hear the point of it yet.".to_owned(),
        ),
    };
    let says = match (tone, attempt) {
        (Tone::Bad, 2) => "I did not hear the point of it. Read the answer below at leisure; the \
                           question comes back another day."
            .to_owned(),
        _ => says,
    };
    verdict(tone, title, vec![text(says)])
}

/// What was said and does not hold.
fn corrections(lesson: &Lesson, explain: &Explain, tried: &Try) -> Vec<Block> {
    let result = tried.result();
    let heard = explain
        .rubric
        .misconception
        .iter()
        .filter(|m| result.misconceptions.contains(&m.id));
    heard
        .map(|m| {
            let mut says: Vec<Inline> = Vec::new();
            if let Some(words) = tried.words_for(&m.id) {
                says.push(text("You say “"));
                says.push(Inline::Emph(show_dialogue::cut(words)));
                says.push(text("”. "));
            }
            match (&m.says_back, m.blocking) {
                (Some(back), _) => says.extend(lesson.inline(back, &Values::new())),
                (None, true) => says.push(text("That does not hold. Think it through once more.")),
                (None, false) => says.push(text("That is not quite so.")),
            }
            if m.blocking {
                verdict(Tone::Bad, "Look at this again", says)
            } else {
                says.push(text(" It does not count here; it is noted for later."));
                verdict(Tone::Near, "A slip, by the way", says)
            }
        })
        .collect()
}

/// What is missing, named without giving it away.
fn missing(lesson: &Lesson, explain: &Explain, tried: &Try, told: &[String]) -> Vec<Block> {
    let result = tried.result();
    let missed = explain
        .rubric
        .expectation
        .iter()
        .filter(|e| e.required && !result.met.contains(&e.id) && !told.contains(&e.id));
    let (mut items, mut silent) = (Vec::new(), 0);
    for expectation in missed {
        match expectation.hint.as_ref().or(expectation.ask.as_ref()) {
            Some(nudge) => items.push(lesson.inline(nudge, &Values::new())),
            None => silent += 1,
        }
    }
    if silent > 0 {
        let more = if items.is_empty() { "" } else { " more" };
        let points = if silent == 1 { "point" } else { "points" };
        items.push(vec![text(format!(
            "{}{more} {points} that the question asks for.",
            capital(&count(silent))
        ))]);
    }
    if items.is_empty() {
        return Vec::new();
    }
    vec![
        verdict(Tone::Info, "Still missing", Vec::new()),
        Block::List {
            ordered: false,
            items,
        },
    ]
}

/// Small numbers as words.
pub(super) fn count(n: usize) -> String {
    const WORDS: [&str; 7] = ["none", "one", "two", "three", "four", "five", "six"];
    WORDS
        .get(n)
        .map_or_else(|| n.to_string(), |w| (*w).to_owned())
}

/// "a", "a and b", "a, b and c".
pub(super) fn and(names: &[&str]) -> String {
    match names {
        [] => String::new(),
        [one] => (*one).to_owned(),
        [most @ .., last] => format!("{} and {last}", most.join(", ")),
    }
}
