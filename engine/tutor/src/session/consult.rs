//! Second opinions within a session: asking, waiting, and laying them beside the judge's own.

use super::Session;
use super::decide::Decided;
use super::dialogue::Reply;
use super::event::{Effect, Event, Quote};
use super::question::{Heard, Try};
use crate::judge::Verdict;
use crate::lesson::Explain;
use crate::opinion::{self, Finding};
use crate::rubric::Rubric;

/// Whether an opinion is worth waiting for: the judge is in doubt about what decides.
pub(super) fn is_in_doubt(rubric: &Rubric, unsure: &[String]) -> bool {
    let mut deciding = rubric.criteria().filter(|it| it.decides);
    deciding.any(|it| unsure.iter().any(|id| id == it.id))
}

/// What an opinion is about.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Consulted {
    pub(super) item: String,
    pub(super) attempt: u32,
    /// The reply, from 1; 0 for the answer itself.
    pub(super) reply: u32,
}

impl Session {
    /// An explanation is judged: where second opinions are wanted, one is asked for.
    pub(super) fn consulting(&self, explain: &Explain, explained: Event) -> Decided {
        let Event::Explained { text, unsure, .. } = &explained else {
            return Decided::event(explained);
        };
        let (text, unsure) = (text.clone(), unsure.clone());
        self.asking(explain, explained, 0, &unsure, text, Vec::new())
    }

    /// The same of a reply, with all that was said before it.
    pub(super) fn consulting_reply(
        &self,
        explain: &Explain,
        tried: &Try,
        replied: Event,
    ) -> Decided {
        let Event::Replied {
            asked,
            text,
            unsure,
            ..
        } = &replied
        else {
            return Decided::event(replied);
        };
        let before = tried
            .replies()
            .map(|it| (it.asked.clone(), it.text.clone()));
        let mut dialogue: Vec<(String, String)> = before.collect();
        dialogue.push((asked.clone(), text.clone()));
        let whole = whole(
            &tried.text,
            dialogue.iter().map(|(_, reply)| reply.as_str()),
        );
        let (reply, unsure) = (dialogue.len() as u32, unsure.clone());
        self.asking(explain, replied, reply, &unsure, whole, dialogue)
    }

    fn asking(
        &self,
        explain: &Explain,
        event: Event,
        reply: u32,
        unsure: &[String],
        text: String,
        dialogue: Vec<(String, String)>,
    ) -> Decided {
        let mut decided = Decided::event(event);
        let (Event::Explained { attempt, .. } | Event::Replied { attempt, .. }) =
            &decided.events[0]
        else {
            return decided;
        };
        if !self.consults {
            return decided;
        }
        let about = Consulted {
            item: explain.rubric.item.clone(),
            attempt: *attempt,
            reply,
        };
        if opinion::speaks_to_the_judge(&explain.rubric, &text) {
            decided.asks_nobody = Some(about);
            return decided;
        }
        decided.effects.push(Effect::Consult {
            item: about.item.clone(),
            attempt: about.attempt,
            reply,
            text,
            dialogue,
        });
        if is_in_doubt(&explain.rubric, unsure) {
            decided.waits = Some(about);
        }
        decided
    }

    /// Whether the learner waits for a second opinion on a try, or on a reply about it.
    pub(super) fn is_waiting(&self, item: &str, attempt: u32) -> bool {
        let waiting = self.waiting.as_ref();
        waiting.is_some_and(|it| it.item == item && it.attempt == attempt)
    }

    /// The learner goes on without it.
    pub(super) fn stop_waiting(&self) -> Decided {
        let Some(about) = self.waiting.clone() else {
            return Decided::default();
        };
        let problem = Err("the learner went on without it".to_owned());
        let mut decided = self.second_opinion_came(&about, String::new(), problem);
        decided.effects.push(Effect::StopConsulting);
        decided
    }

    /// What came back becomes an event; once for each answer and reply.
    pub(super) fn second_opinion_came(
        &self,
        about: &Consulted,
        by: String,
        said: Result<Vec<Finding>, String>,
    ) -> Decided {
        let index = (about.attempt as usize).checked_sub(1);
        let question = self.questions.get(&about.item);
        let tried = index.and_then(|index| question?.tries.get(index));
        let (Some(explain), Some(tried)) = (self.lesson.explain(&about.item), tried) else {
            return Decided::default();
        };
        let replies: Vec<&Reply> = tried.replies().take(about.reply as usize).collect();
        let (first, second) = match replies.last() {
            Some(last) => (&last.first, &last.second),
            None => (&tried.first, &tried.second),
        };
        if second.is_some() || replies.len() != about.reply as usize {
            return Decided::default();
        }
        let text = whole(&tried.text, replies.iter().map(|reply| reply.text.as_str()));
        Decided::event(event(&explain.rubric, about, first, &text, by, said))
    }
}

/// Answer and replies as one text, each of them on a line of its own.
fn whole<'a>(answer: &str, replies: impl Iterator<Item = &'a str>) -> String {
    let mut whole = answer.to_owned();
    for reply in replies {
        whole.push('\n');
        whole.push_str(reply);
    }
    whole
}

fn event(
    rubric: &Rubric,
    about: &Consulted,
    first: &Heard,
    text: &str,
    by: String,
    said: Result<Vec<Finding>, String>,
) -> Event {
    let checked = said.and_then(|findings| opinion::verify(rubric, text, &findings));
    let (result, problem, combined, checked) = match checked {
        Ok(checked) => {
            let combined = opinion::combine(
                rubric,
                &first.met,
                &first.misconceptions,
                &first.unsure,
                &checked,
            );
            let problem = checked.left_out.clone();
            (combined.result(), problem, Some(combined), Some(checked))
        }
        Err(problem) => ("unusable", Some(problem), None, None),
    };
    // What decides nothing is not worth changing what the learner has read already.
    let counts = is_in_doubt(rubric, &first.unsure);
    let heard = match combined.as_ref().filter(|_| counts) {
        Some(it) => Heard::new(
            rubric,
            it.met.clone(),
            it.misconceptions.clone(),
            it.unsure.clone(),
        ),
        None => first.clone(),
    };
    let checked = checked.unwrap_or_default();
    let (disputed, settled, own_verdict) = match combined {
        Some(it) => (it.disputed, it.settled, Some(it.own_verdict)),
        None => Default::default(),
    };
    Event::SecondOpinion {
        item: about.item.clone(),
        attempt: about.attempt,
        reply: about.reply,
        by,
        result: result.to_owned(),
        problem,
        own_verdict: own_verdict.map(Verdict::as_str).map(str::to_owned),
        says: checked
            .says
            .iter()
            .map(|(id, says)| (id.clone(), says.as_str().to_owned()))
            .collect(),
        why: checked.why.into_iter().map(Quote::from).collect(),
        disputed,
        settled: if counts { settled } else { Vec::new() },
        verdict: heard.verdict.as_str().to_owned(),
        met: heard.met,
        missed: heard.missed,
        misconceptions: heard.misconceptions,
        slips: heard.slips,
        unsure: heard.unsure,
    }
}
