//! Second opinions within a session: asking, waiting, and laying them beside the judge's own.

use super::Session;
use super::decide::Decided;
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

impl Session {
    /// An explanation is judged: where second opinions are wanted, one is asked for.
    pub(super) fn consulting(&self, explain: &Explain, explained: Event) -> Decided {
        let (item, attempt, text, unsure) = match &explained {
            Event::Explained {
                item,
                attempt,
                text,
                unsure,
                ..
            } if self.consults => (item.clone(), *attempt, text.clone(), unsure.clone()),
            _ => return Decided::event(explained),
        };
        let mut decided = Decided::event(explained);
        if opinion::speaks_to_the_judge(&explain.rubric, &text) {
            decided.asks_nobody = Some((item, attempt));
            return decided;
        }
        if is_in_doubt(&explain.rubric, &unsure) {
            decided.waits = Some((item.clone(), attempt));
        }
        decided.effects.push(Effect::Consult {
            item,
            attempt,
            text,
        });
        decided
    }

    /// Whether the learner waits for a second opinion on a try.
    pub(super) fn is_waiting(&self, item: &str, attempt: u32) -> bool {
        let waiting = self.waiting.as_ref();
        waiting.is_some_and(|(it, at)| it == item && *at == attempt)
    }

    /// The learner goes on without it.
    pub(super) fn stop_waiting(&self) -> Decided {
        let Some((item, attempt)) = self.waiting.clone() else {
            return Decided::default();
        };
        let problem = Err("the learner went on without it".to_owned());
        let mut decided = self.second_opinion_came(&item, attempt, String::new(), problem);
        decided.effects.push(Effect::StopConsulting);
        decided
    }

    /// What came back becomes an event; once for each try.
    pub(super) fn second_opinion_came(
        &self,
        item: &str,
        attempt: u32,
        by: String,
        said: Result<Vec<Finding>, String>,
    ) -> Decided {
        let index = (attempt as usize).checked_sub(1);
        let tried = index.and_then(|index| self.questions.get(item)?.tries.get(index));
        match (self.lesson.explain(item), tried) {
            (Some(explain), Some(tried)) if tried.second.is_none() => {
                Decided::event(event(&explain.rubric, tried, attempt, by, said))
            }
            _ => Decided::default(),
        }
    }
}

fn event(
    rubric: &Rubric,
    tried: &Try,
    attempt: u32,
    by: String,
    said: Result<Vec<Finding>, String>,
) -> Event {
    let first = &tried.first;
    let checked = said.and_then(|findings| opinion::verify(rubric, &tried.text, &findings));
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
        item: rubric.item.clone(),
        attempt,
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
