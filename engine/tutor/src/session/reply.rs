//! What a reply to a question adds to the answer, and what it takes back.
//!
//! A reply is heard three ways: by itself, as a continuation of all that was said before, and,
//! where it is short, within the sentence whose blank it fills. It may settle what was still
//! open, and it may deny what was said; all else in the answer stays as it was judged.

use super::dialogue::{Asked, Reply, Step, Turn, script};
use super::event::Quote;
use super::question::{Heard, Try};
use super::show_dialogue;
use crate::judge::{Judge, Judgement};
use crate::lesson::{Explain, Lesson};
use crate::prose::plain;
use crate::rubric::{Blank, Rubric};
use formula::Values;

/// A longer reply is a sentence of its own, and fills no blank.
const MOST_WORDS: usize = 8;

/// One way to read a reply.
struct Reading {
    /// The reply by itself.
    alone: Judgement,
    /// Behind everything said before.
    whole: Judgement,
    /// Criteria whose contrary it says.
    denied: Vec<String>,
    /// Where the reply begins in the whole; `None` where it stands in another sentence.
    offset: Option<usize>,
}

impl Reading {
    fn new(judge: &Judge, before: &str, said: &str, is_raw: bool) -> Reading {
        let whole = format!("{before}{said}");
        Reading {
            alone: judge.judge(said),
            whole: judge.judge(&whole),
            denied: judge.denied(said),
            offset: is_raw.then_some(before.len()),
        }
    }

    fn meets(&self, id: &String) -> bool {
        !self.denied.contains(id) && (self.alone.met.contains(id) || self.whole.met.contains(id))
    }

    fn takes_back(&self, id: &String) -> bool {
        self.denied.contains(id) && !self.whole.met.contains(id)
    }

    /// A mistake counts where the reply makes it by itself and what came before does not excuse
    /// it.
    fn errs(&self, id: &String) -> bool {
        self.alone.misconceptions.contains(id)
            && (self.whole.misconceptions.contains(id) || self.whole.unsure.contains(id))
    }

    fn clears(&self, id: &String) -> bool {
        let still = |ids: &[String]| ids.contains(id);
        self.denied.contains(id)
            || !(still(&self.whole.unsure) || still(&self.whole.misconceptions))
    }
}

/// Hears a reply to a question about a try.
pub(super) fn hear(
    lesson: &Lesson,
    explain: &Explain,
    tried: &Try,
    asked: &Asked,
    text: &str,
) -> Reply {
    let rubric = &explain.rubric;
    let before = said_before(tried);
    let mut readings = vec![Reading::new(&explain.judge, &before, text, true)];
    if let Some(sentence) = filled(lesson, rubric, &asked.about, text) {
        readings.push(Reading::new(&explain.judge, &before, &sentence, false));
    }
    let told = told(rubric, tried);
    let heard = match evades(text) {
        true => tried.heard().clone(),
        false => combine(rubric, tried.heard(), &told, &readings),
    };
    let decided = |id: &String| {
        let before = tried.heard();
        heard.met.contains(id) != before.met.contains(id)
            || heard.misconceptions.contains(id) != before.misconceptions.contains(id)
            || heard.unsure.contains(id) != before.unsure.contains(id)
    };
    let why = rubric
        .criteria()
        .map(|criterion| criterion.id.to_owned())
        .filter(decided)
        .filter_map(|id| quote(&readings, &id, text))
        .collect();
    Reply {
        about: asked.about.clone(),
        rung: asked.rung,
        asked: plain(&show_dialogue::question(
            lesson,
            explain,
            tried,
            asked,
            tried.turns.is_empty(),
        )),
        text: text.to_owned(),
        why,
        first: heard,
        second: None,
    }
}

/// Whether a reply is made of words that commit to nothing, "well, it depends": in the context of
/// what was said before they could be heard as more than they are.
fn evades(text: &str) -> bool {
    const EMPTY: [&str; 48] = [
        "a", "am", "an", "answer", "can", "cannot", "cant", "clue", "could", "depends", "do",
        "does", "dont", "either", "er", "guess", "help", "hint", "hm", "hmm", "how", "i", "idea",
        "im", "is", "it", "know", "maybe", "me", "mean", "no", "not", "of", "ok", "perhaps",
        "please", "really", "say", "sorry", "sure", "that", "the", "think", "uh", "um", "well",
        "yes", "you",
    ];
    let words = text.split(|c: char| c.is_whitespace() || ",.;:!?-".contains(c));
    let mut words = words
        .map(|word| word.replace(['\'', '’'], "").to_lowercase())
        .filter(|word| !word.is_empty());
    words.all(|word| word == "what" || EMPTY.contains(&word.as_str()))
}

fn combine(rubric: &Rubric, before: &Heard, told: &[String], readings: &[Reading]) -> Heard {
    let any = |holds: &dyn Fn(&Reading) -> bool| readings.iter().any(holds);
    let (mut met, mut misconceptions, mut unsure) = (Vec::new(), Vec::new(), Vec::new());
    for expectation in &rubric.expectation {
        let id = &expectation.id;
        let taken_back = any(&|it| it.takes_back(id));
        let gained = !told.contains(id) && any(&|it| it.meets(id));
        // Within the author's sentence any words would sound like the right subject.
        let doubts = |it: &Reading| it.offset.is_some() && it.alone.unsure.contains(id);
        let doubted = before.unsure.contains(id) || any(&doubts);
        if (before.met.contains(id) && !taken_back) || gained {
            met.push(id.clone());
        } else if doubted && !taken_back && !told.contains(id) {
            unsure.push(id.clone());
        }
    }
    for misconception in &rubric.misconception {
        let id = &misconception.id;
        let instead = |other: &String| met.contains(other) || any(&|it| it.errs(other));
        if misconception.unless.iter().any(instead) {
            continue;
        }
        let said = before.misconceptions.contains(id) && !any(&|it| it.denied.contains(id));
        if said || any(&|it| it.errs(id)) {
            misconceptions.push(id.clone());
        } else if before.unsure.contains(id) && !any(&|it| it.clears(id)) {
            unsure.push(id.clone());
        }
    }
    Heard::new(rubric, met, misconceptions, unsure)
}

/// Answer and replies as one text, ended so that what follows is a sentence of its own.
fn said_before(tried: &Try) -> String {
    let replies = tried.turns.iter().filter_map(|turn| match turn {
        Turn::Replied(reply) => Some(reply.text.as_str()),
        Turn::Further { .. } | Turn::Left => None,
    });
    let mut out = String::new();
    for text in [tried.text.as_str()].into_iter().chain(replies) {
        let text = text.trim_end();
        out.push_str(text);
        if !text.ends_with(['.', '!', '?']) {
            out.push('.');
        }
        out.push('\n');
    }
    out
}

/// Criteria whose answer was given.
fn told(rubric: &Rubric, tried: &Try) -> Vec<String> {
    let (steps, _) = script(rubric, tried);
    steps
        .into_iter()
        .filter_map(|step| match step {
            Step::Told(id) => Some(id),
            Step::Asked(_) | Step::Replied(_) | Step::Left => None,
        })
        .collect()
}

/// A short reply within the author's sentence.
fn filled(lesson: &Lesson, rubric: &Rubric, about: &str, text: &str) -> Option<String> {
    if text.split_whitespace().count() > MOST_WORDS {
        return None;
    }
    let prompt = plain(&lesson.inline(rubric.criterion(about)?.prompt?, &Values::new()));
    Some(Blank::of(&prompt)?.filled(text))
}

/// The words of a reply that decided a criterion: those that the judge names, else all of it.
fn quote(readings: &[Reading], id: &str, text: &str) -> Option<Quote> {
    let all = || {
        let start = text.len() - text.trim_start().len();
        (start, text.trim_end().len().max(start))
    };
    let raw = readings.iter().find_map(|reading| {
        let offset = reading.offset?;
        let alone = reading.alone.why.iter().find(|why| why.id == id);
        if let Some(why) = alone {
            return Some((why.start, why.end));
        }
        let whole = reading.whole.why.iter().find(|why| why.id == id)?;
        let start = whole.start.checked_sub(offset)?;
        Some((start, whole.end - offset))
    });
    let (start, end) = raw.unwrap_or_else(all);
    let quote = text.get(start..end).filter(|quote| !quote.is_empty())?;
    Some(Quote {
        id: id.to_owned(),
        quote: quote.to_owned(),
        start,
        end,
    })
}

#[cfg(test)]
mod tests {
    use super::evades;

    #[track_caller]
    fn check(text: &str, expected: bool) {
        assert_eq!(evades(text), expected, "{text}");
    }

    #[test]
    fn words_that_commit_to_nothing() {
        check("well, it depends", true);
        check("Hm ... I don’t know.", true);
        check("no", true);
        check("what do you mean?", true);
        check("?", true);
        check("it depends on the roughness", false);
        check("no, the rim is brighter", false);
        check("1/π", false);
        check("0", false);
        check("H", false);
        check("up", false);
    }
}
