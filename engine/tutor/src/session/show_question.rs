//! An explain-back question on the screen: what was said, what was heard, what is missing.

use super::Session;
use super::question::{Question, Try};
use super::show::{capital, paragraph, text, verdict};
use crate::judge::Verdict;
use crate::lesson::{Explain, Lesson};
use crate::prose::{Block, Inline, Tone};
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
        blocks.extend(feedback(lesson, explain, question, tried, attempt));
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
    blocks.extend(missing(lesson, explain, first));
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
) -> Vec<Block> {
    let mut blocks = vec![quoted(explain, tried)];
    if tried.heard.verdict == Verdict::Unsure {
        blocks.push(verdict(
            Tone::Info,
            "I cannot tell",
            vec![text(
                "I am not sure that I read this right, and will not guess. Here is a model \
                 answer: mark your own against it. It is kept as your own marking.",
            )],
        ));
        blocks.extend(lesson.prose(&explain.model_answer, &Values::new()));
    }
    if tried.is_open() {
        return blocks;
    }
    if tried.own.is_some() {
        blocks.push(Block::Checklist {
            points: tried
                .points(&explain.rubric)
                .into_iter()
                .map(|(id, says)| (says, tried.marks.get(&id).copied()))
                .collect(),
        });
    }
    blocks.push(headline(explain, tried, attempt));
    blocks.extend(corrections(lesson, explain, tried));
    if tried.result().passed() {
        if tried.own.is_none() {
            blocks.extend(model_answer(lesson, explain, "One way to put it"));
        }
        return blocks;
    }
    if attempt == 1 {
        blocks.extend(missing(lesson, explain, tried));
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

fn model_answer(lesson: &Lesson, explain: &Explain, title: &str) -> Vec<Block> {
    let mut blocks = vec![Block::Heading(title.to_owned())];
    blocks.extend(lesson.prose(&explain.model_answer, &Values::new()));
    blocks
}

/// The learner's words, what decided them marked.
fn quoted(explain: &Explain, tried: &Try) -> Block {
    let rubric = &explain.rubric;
    let tone = |id: &str| {
        if tried.unsure.iter().any(|other| other == id) {
            Some(Tone::Info)
        } else if tried.heard.met.iter().any(|other| other == id) {
            Some(Tone::Good)
        } else {
            let known = rubric.misconception.iter().find(|m| m.id == id)?;
            Some(if known.blocking {
                Tone::Bad
            } else {
                Tone::Near
            })
        }
    };
    let mut marks: Vec<(usize, usize, Tone)> = tried
        .why
        .iter()
        .filter(|why| {
            tried
                .text
                .get(why.start..why.end)
                .is_some_and(|q| !q.is_empty())
        })
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
        text: tried.text.clone(),
        marks,
    }
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
            let quote = tried.why.iter().find(|why| why.id == m.id);
            let mut says: Vec<Inline> = Vec::new();
            if let Some(quote) = quote {
                says.push(text("You say “"));
                says.push(Inline::Emph(quote.quote.trim().to_owned()));
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
fn missing(lesson: &Lesson, explain: &Explain, tried: &Try) -> Vec<Block> {
    let result = tried.result();
    let missed = explain
        .rubric
        .expectation
        .iter()
        .filter(|e| e.required && !result.met.contains(&e.id));
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
