//! The judge of explain-backs: reads an answer against a rubric and quotes what decided.
//!
//! Deterministic, offline, linear in the length of the answer. It hears propositions (who,
//! what, in which direction), not keywords; where it cannot tell it says so, per criterion.

mod arithmetic;
mod attach;
mod claim;
mod criterion;
mod denial;
mod ellipsis;
pub mod evaluate;
mod evidence;
mod examples;
mod grammar;
#[cfg(test)]
mod growth;
mod hearsay;
pub mod learn;
mod lexicon;
mod matching;
mod pairs;
mod parse;
mod phrase;
mod refer;
mod signs;
mod spelling;
#[cfg(test)]
mod steps;
mod subject;
mod symbols;
mod text;
mod values;
pub mod weigh;

use std::collections::BTreeSet;

use crate::rubric::Rubric;
use evidence::{Features, Heard, Weights};
pub use examples::{ExampleFinding, check_examples};
use lexicon::{MATERIAL, QUANTITY, lexicon};
use parse::{Reading, Setting};
use phrase::{Hit, Phrase, STATED};
use text::Token;

/// Changes whenever the same answer may get another verdict; kept in every log.
pub const JUDGE_VERSION: &str = "9";

/// What an answer is worth.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Verdict {
    /// Every required expectation met, no blocking misconception.
    Pass,
    /// Not a pass, and at least one required expectation met.
    Partial,
    /// No required expectation met.
    Fail,
    /// Settling what is unsure could change the verdict.
    Unsure,
}

impl Verdict {
    /// The word that rubrics, logs and JSON use.
    pub fn as_str(self) -> &'static str {
        match self {
            Verdict::Pass => "pass",
            Verdict::Partial => "partial",
            Verdict::Fail => "fail",
            Verdict::Unsure => "unsure",
        }
    }

    /// The verdict of that word; `None` for any other word.
    pub fn parse(word: &str) -> Option<Verdict> {
        [
            Verdict::Pass,
            Verdict::Partial,
            Verdict::Fail,
            Verdict::Unsure,
        ]
        .into_iter()
        .find(|verdict| verdict.as_str() == word)
    }
}

/// The learner's words that decided one criterion.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Why {
    /// Id of the expectation or misconception.
    pub id: String,
    /// Exactly `answer[start..end]`.
    pub quote: String,
    /// First byte of the quote in the answer.
    pub start: usize,
    /// One past its last byte.
    pub end: usize,
}

/// What the judge heard in an answer. Ids come in the rubric's order.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Judgement {
    /// The verdict that follows from the criteria.
    pub verdict: Verdict,
    /// Expectations met.
    pub met: Vec<String>,
    /// Misconceptions shown, blocking ones and slips.
    pub misconceptions: Vec<String>,
    /// Criteria that the judge cannot settle.
    pub unsure: Vec<String>,
    /// The words behind each met, shown or unsure criterion.
    pub why: Vec<Why>,
}

/// A criterion, its phrases read.
#[derive(Clone, Debug)]
struct Criterion {
    id: String,
    is_misconception: bool,
    phrases: Vec<Phrase>,
    against: Vec<Phrase>,
    unless: Vec<String>,
    /// Places, surfaces and materials that it is about.
    topics: Vec<u16>,
    /// Whether a pass needs it.
    required: bool,
    /// Whether it keeps from passing.
    blocking: bool,
    /// What all that is said speaks for it, where that was learnt.
    weights: Option<Weights>,
}

/// A rubric made ready for judging.
#[derive(Clone, Debug)]
pub struct Judge {
    rubric: Rubric,
    criteria: Vec<Criterion>,
    setting: Setting,
    /// Quantities that the question asks about.
    understood: u128,
    /// Words of the question, five at a time.
    echo: BTreeSet<Vec<String>>,
}

/// So many words of the question in a row are an echo of it.
const ECHO: usize = 5;

/// It is a pass only where it is at least so likely that all that it needs is as found.
const SURE_OF_A_PASS: f64 = 0.6;

/// What was found on one criterion.
#[derive(Clone, Debug, PartialEq)]
enum Finding {
    Stated(Hit),
    Perhaps(Hit),
    Absent,
}

impl Judge {
    /// Prepares a rubric; do it once, it costs more than judging.
    pub fn new(rubric: &Rubric) -> Judge {
        Judge::with_evidence(rubric, evidence::LEARNT)
    }

    /// The same with other weights than those that come with the program: what
    /// [`weigh::weigh`] made of marked answers. An empty text leaves the phrases alone to judge.
    pub fn with_evidence(rubric: &Rubric, learnt: &str) -> Judge {
        let lexicon = lexicon();
        let prompt = phrase::prepare(&rubric.prompt);
        let setting = setting(parse::read(
            lexicon,
            prompt.clone(),
            &Setting::default(),
            &[],
        ));
        let words: Vec<String> = prompt.iter().map(|token| token.word.clone()).collect();
        let echo = words.windows(ECHO).map(<[String]>::to_vec).collect();
        let read = |phrases: &[String]| {
            phrases
                .iter()
                .map(|text| Phrase::new(lexicon, text, &setting))
                .collect::<Vec<_>>()
        };
        let generic = |id: u16| matches!(lexicon.concept(id).name.as_str(), "whole" | "highlight");
        let criterion = |id: &str, says: &str, phrases: &[String], against: &[String]| {
            let phrases = read(phrases);
            let topics: BTreeSet<u16> = phrases
                .iter()
                .flat_map(Phrase::topics)
                .filter(|&id| !generic(id))
                .collect();
            Criterion {
                id: id.to_owned(),
                is_misconception: false,
                topics: topics.into_iter().collect(),
                phrases,
                against: read(against),
                unless: Vec::new(),
                required: false,
                blocking: false,
                weights: Weights::read(lexicon, learnt, &rubric.item, id, says),
            }
        };
        let expectations = rubric.expectation.iter().map(|e| Criterion {
            required: e.required,
            ..criterion(&e.id, &e.says, &e.phrases, &e.against)
        });
        let misconceptions = rubric.misconception.iter().map(|m| Criterion {
            is_misconception: true,
            unless: m.unless.clone(),
            blocking: m.blocking,
            ..criterion(&m.id, &m.says, &m.phrases, &m.against)
        });
        let understood = setting.order[QUANTITY]
            .iter()
            .chain(setting.order[MATERIAL].first())
            .filter(|&&id| id < 128)
            .fold(0, |bits, &id| bits | 1 << id);
        Judge {
            rubric: rubric.clone(),
            criteria: expectations.chain(misconceptions).collect(),
            setting: setting.clone(),
            understood,
            echo,
        }
    }

    /// Judges one answer, any text of any length.
    pub fn judge(&self, answer: &str) -> Judgement {
        let reading = self.read(answer);
        let findings = self
            .criteria
            .iter()
            .map(|criterion| criterion.find(&reading, self.understood, &[]));
        self.decide(answer, &reading, findings)
    }

    /// What follows from what was found on each criterion, in their order.
    fn decide(
        &self,
        answer: &str,
        reading: &Reading,
        findings: impl Iterator<Item = Finding>,
    ) -> Judgement {
        let mut findings: Vec<Finding> = findings.collect();
        self.count_words_once(reading, &mut findings);
        let judgement = self.sum_up(answer, &findings);
        if judgement.verdict != Verdict::Pass {
            return judgement;
        }
        match self.weakest(reading, &findings) {
            Some((at, doubt)) => {
                findings[at] = doubt;
                self.sum_up(answer, &findings)
            }
            None => judgement,
        }
    }

    /// Where an answer would pass and it is not likely enough that all of what a pass needs is
    /// as found: the least likely of these, and the doubt about it.
    fn weakest(&self, reading: &Reading, findings: &[Finding]) -> Option<(usize, Finding)> {
        let mut sure = 1.0;
        let mut least: Option<(usize, f64)> = None;
        for (at, (criterion, finding)) in self.criteria.iter().zip(findings).enumerate() {
            let Some(weights) = criterion.weights.as_ref() else {
                continue;
            };
            let likely = match finding {
                Finding::Stated(hit) if criterion.required => hit.score,
                Finding::Absent if criterion.blocking && criterion.unless.is_empty() => {
                    let log_odds = weights.log_odds(&reading.features);
                    1.0 - evidence::likelihood(true, Heard::Not, log_odds)
                }
                _ => continue,
            };
            sure *= likely;
            if least.is_none_or(|(_, so_far)| likely < so_far) {
                least = Some((at, likely));
            }
        }
        let (at, _) = least.filter(|_| sure < SURE_OF_A_PASS)?;
        let hit = match &findings[at] {
            Finding::Stated(hit) => hit.clone(),
            _ => self.criteria[at].strongest(reading)?.0,
        };
        Some((at, Finding::Perhaps(hit)))
    }

    /// The judgement that follows from findings.
    fn sum_up(&self, answer: &str, findings: &[Finding]) -> Judgement {
        let mut judgement = Judgement {
            verdict: Verdict::Unsure,
            met: Vec::new(),
            misconceptions: Vec::new(),
            unsure: Vec::new(),
            why: Vec::new(),
        };
        let stated = |id: &String| {
            let mut all = self.criteria.iter().zip(findings);
            all.any(|(c, found)| c.id == *id && matches!(found, Finding::Stated(_)))
        };
        for (criterion, finding) in self.criteria.iter().zip(findings) {
            if criterion.unless.iter().any(stated) {
                continue;
            }
            let (list, hit) = match finding {
                Finding::Stated(hit) if criterion.is_misconception => {
                    (&mut judgement.misconceptions, hit)
                }
                Finding::Stated(hit) => (&mut judgement.met, hit),
                Finding::Perhaps(hit) => (&mut judgement.unsure, hit),
                Finding::Absent => continue,
            };
            list.push(criterion.id.clone());
            if let Some(quote) = answer.get(hit.range.0..hit.range.1) {
                judgement.why.push(Why {
                    id: criterion.id.clone(),
                    quote: quote.to_owned(),
                    start: hit.range.0,
                    end: hit.range.1,
                });
            }
        }
        judgement.verdict = verdict(
            &self.rubric,
            &judgement.met,
            &judgement.misconceptions,
            &judgement.unsure,
        );
        judgement
    }

    /// Criteria whose contrary a text says: what it takes back, where it follows another.
    pub fn denied(&self, text: &str) -> Vec<String> {
        let (lexicon, reading) = (lexicon(), self.read(text));
        let says = |criterion: &&Criterion| {
            let ears = criterion.ears(self.understood);
            let against = criterion.against.iter();
            criterion
                .phrases
                .iter()
                .any(|it| it.gainsaid(lexicon, &reading))
                || against
                    .map(|it| it.said(lexicon, &reading, ears).score)
                    .any(|it| it >= STATED)
        };
        let denied = self.criteria.iter().filter(says);
        denied.map(|criterion| criterion.id.clone()).collect()
    }

    /// The same words are one slip, not two: where they say one that does not block, they are
    /// not held against the learner under the name of one that does. Other words are.
    fn count_words_once(&self, reading: &Reading, findings: &mut [Finding]) {
        let harmless: Vec<(usize, usize)> = self
            .criteria
            .iter()
            .zip(findings.iter())
            .filter(|(c, _)| c.is_misconception && !c.blocking)
            .filter_map(|(_, finding)| match finding {
                Finding::Stated(hit) => Some(hit.range),
                _ => None,
            })
            .collect();
        if harmless.is_empty() {
            return;
        }
        for (criterion, finding) in self.criteria.iter().zip(findings) {
            let counted = match finding {
                Finding::Stated(hit) | Finding::Perhaps(hit) => harmless.contains(&hit.range),
                Finding::Absent => false,
            };
            if counted && criterion.blocking {
                *finding = match criterion.find(reading, self.understood, &harmless) {
                    Finding::Stated(hit) | Finding::Perhaps(hit)
                        if harmless.contains(&hit.range) =>
                    {
                        Finding::Absent
                    }
                    other => other,
                };
            }
        }
    }

    fn read(&self, answer: &str) -> Reading {
        let tokens = phrase::prepare(answer);
        let mute = self.mute(answer, &tokens);
        let mut reading = parse::read(lexicon(), tokens, &self.setting, &mute);
        if self.criteria.iter().any(|it| it.weights.is_some()) {
            reading.features = evidence::features(lexicon(), &reading);
        }
        reading
    }

    /// What an answer says, as it is weighed.
    fn features(&self, answer: &str) -> Features {
        evidence::features(lexicon(), &self.read(answer))
    }

    /// The words of an answer, as they are weighed.
    fn words(&self, answer: &str) -> Vec<(evidence::Key, String)> {
        let reading = self.read(answer);
        evidence::words(&reading)
            .map(|(stem, _)| (evidence::word_key(stem), stem.to_owned()))
            .collect()
    }

    /// Tokens that are the question's own words, or ids of the rubric: nobody's statement.
    fn mute(&self, answer: &str, tokens: &[Token]) -> Vec<bool> {
        let mut mute = vec![false; tokens.len()];
        let words: Vec<String> = tokens.iter().map(|token| token.word.clone()).collect();
        for (at, window) in words.windows(ECHO).enumerate() {
            if self.echo.contains(window) {
                mute[at..at + ECHO].fill(true);
            }
        }
        let ids: Vec<&str> = self
            .criteria
            .iter()
            .map(|c| c.id.as_str())
            .filter(|id| id.contains('-'))
            .collect();
        for (at, token) in tokens.iter().enumerate() {
            for id in &ids {
                let named = answer
                    .as_bytes()
                    .get(token.start..token.start + id.len())
                    .is_some_and(|bytes| bytes.eq_ignore_ascii_case(id.as_bytes()));
                if named {
                    let end = token.start + id.len();
                    tokens[at..]
                        .iter()
                        .zip(&mut mute[at..])
                        .take_while(|(t, _)| t.start < end)
                        .for_each(|(_, flag)| *flag = true);
                }
            }
        }
        mute
    }

    /// The phrase of a criterion that an answer says best.
    fn phrase_heard(&self, id: &str, answer: &str) -> Option<&str> {
        let reading = self.read(answer);
        let criterion = self.criteria.iter().find(|c| c.id == id)?;
        let ears = criterion.ears(self.understood);
        let score = |phrase: &&Phrase| phrase.said(lexicon(), &reading, ears).score;
        let best = criterion
            .phrases
            .iter()
            .max_by(|a, b| score(a).total_cmp(&score(b)))?;
        Some(&best.text)
    }

    /// How each phrase of the rubric was understood.
    pub fn phrases(&self) -> Vec<(String, String, String)> {
        let all = |criterion: &Criterion| {
            let id = criterion.id.clone();
            criterion
                .phrases
                .iter()
                .map(move |phrase| (id.clone(), phrase.text.clone(), phrase.explain(lexicon())))
                .collect::<Vec<_>>()
        };
        self.criteria.iter().flat_map(all).collect()
    }

    /// How an answer was understood, and which phrases it says: for authors.
    pub fn explain(&self, answer: &str) -> String {
        let lexicon = lexicon();
        let reading = self.read(answer);
        let mut out = String::new();
        for s in &reading.statements {
            let name = |ids: &[u16]| {
                ids.iter()
                    .map(|&id| lexicon.concept(id).name.clone())
                    .collect::<Vec<_>>()
                    .join("|")
            };
            let words = answer
                .get(reading.tokens[s.tokens.0].start..reading.tokens[s.tokens.1 - 1].end)
                .unwrap_or_default();
            out.push_str(&format!(
                "  [{}{}{}] \"{words}\"",
                if s.void { "void " } else { "" },
                if s.denied { "not " } else { "" },
                name(&s.concepts)
            ));
            for about in s.about.iter().flatten() {
                out.push_str(&format!(" of {} ({:?})", name(&about.concepts), about.held));
            }
            out.push('\n');
        }
        for criterion in &self.criteria {
            let ears = criterion.ears(self.understood);
            for phrase in &criterion.phrases {
                let hit = phrase.said(lexicon, &reading, ears);
                if hit.score > 0.0 {
                    let gainsaid = if phrase.gainsaid(lexicon, &reading) {
                        " GAINSAID"
                    } else {
                        ""
                    };
                    out.push_str(&format!(
                        "  {}: {:.2}{gainsaid} \"{}\" = {}\n",
                        criterion.id,
                        hit.score,
                        phrase.text,
                        phrase.explain(lexicon)
                    ));
                }
            }
        }
        out
    }
}

/// The order in which a question names the things that its answers may call "the first".
fn setting(prompt: Reading) -> Setting {
    let mut setting = Setting::default();
    for statement in &prompt.statements {
        for (class, about) in statement.about.iter().enumerate() {
            for &id in about.iter().flat_map(|about| &about.concepts) {
                if !setting.order[class].contains(&id) {
                    setting.order[class].push(id);
                }
            }
        }
    }
    setting
}

/// The verdict that follows from the criteria. It is unsure only where settling the unsure
/// criteria, one way or the other, could change it. Unknown ids count for nothing.
pub fn verdict(
    rubric: &Rubric,
    met: &[String],
    misconceptions: &[String],
    unsure: &[String],
) -> Verdict {
    let settle = |favourably: bool| {
        let required = || {
            rubric
                .expectation
                .iter()
                .filter(|expectation| expectation.required)
        };
        let is_met = |id: &String| met.contains(id) || (favourably && unsure.contains(id));
        let blocked = rubric.misconception.iter().any(|m| {
            m.blocking
                && (misconceptions.contains(&m.id) || (!favourably && unsure.contains(&m.id)))
        });
        if required().all(|e| is_met(&e.id)) && !blocked {
            Verdict::Pass
        } else if required().any(|e| is_met(&e.id)) {
            Verdict::Partial
        } else {
            Verdict::Fail
        }
    };
    // The verdict is monotone in each criterion, so the two extremes bound it.
    let (best, worst) = (settle(true), settle(false));
    if best == worst { best } else { Verdict::Unsure }
}
