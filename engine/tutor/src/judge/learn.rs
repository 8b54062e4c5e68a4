//! From marked answers to phrases: which words of the learners would help the judge, what each
//! gains and costs on answers by other writers, and what all of them together are worth on
//! writers who had no part in choosing them.

use std::collections::{BTreeMap, BTreeSet};

use super::evaluate::{Evaluation, Marked, Row, evaluate};
use super::lexicon::lexicon;
use super::parse::Reading;
use super::phrase::{self, Hit, Phrase};
use super::{Criterion, Finding, Judge, Judgement};
use crate::rubric::Rubric;

/// Words taken from one answer are tried as phrases; the shortest say the most.
const PER_ANSWER: usize = 12;
/// A phrase that hears something where it is not costs more than one that misses something.
const COST: usize = 2;
/// More phrases than this for one criterion and nobody reads them.
const MOST: usize = 8;
/// The writers are parted into so many groups; each is judged by what the others taught.
const FOLDS: usize = 5;

/// Where a proposed phrase goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum List {
    /// [`crate::rubric::Expectation::phrases`]: ways to say it.
    Phrases,
    /// [`crate::rubric::Expectation::against`]: ways to say the contrary.
    Against,
}

impl List {
    /// The name of the list in a lesson file.
    pub fn as_str(self) -> &'static str {
        match self {
            List::Phrases => "phrases",
            List::Against => "against",
        }
    }
}

/// A phrase that would help, and what it does to answers by others than its writer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Proposal {
    /// Id of the expectation or misconception.
    pub criterion: String,
    /// The list of the criterion that it goes into.
    pub list: List,
    /// The phrase, in the words of an answer.
    pub words: String,
    /// Id of that answer.
    pub from: String,
    /// Answers by other writers on which the criterion is then heard as marked, or at least
    /// left open where it was heard wrongly.
    pub gains: Vec<String>,
    /// Answers by other writers on which it is then heard less well.
    pub costs: Vec<String>,
}

/// What the marked answers to one question teach.
#[derive(Clone, Debug, PartialEq)]
pub struct Learned {
    /// The question's id.
    pub item: String,
    /// How many marked answers there were.
    pub answers: usize,
    /// By how many writers.
    pub writers: usize,
    /// Phrases worth having, the best first, each weighed with those before it in place.
    pub proposals: Vec<Proposal>,
    /// Words that would settle only the answer that they come from, best left alone.
    pub lonely: Vec<Proposal>,
    /// The judge as it is.
    pub before: Evaluation,
    /// The judge with phrases proposed from other writers' answers alone, each writer judged
    /// without having been learnt from. `None` of fewer than two writers.
    pub held_out: Option<Evaluation>,
}

/// What the marked answers to a rubric's question teach. Marks of other questions count for
/// nothing here.
pub fn learn(rubric: &Rubric, marks: &[Marked]) -> Learned {
    let marks: Vec<&Marked> = marks.iter().filter(|m| m.item == rubric.item).collect();
    let judge = Judge::new(rubric);
    let desk = Desk::new(rubric, &judge, &marks);
    let all: Vec<usize> = (0..marks.len()).collect();
    let (proposals, lonely) = desk.propose(&all);
    let writers: BTreeSet<&str> = marks.iter().map(|m| writer(m)).collect();
    Learned {
        item: rubric.item.clone(),
        answers: marks.len(),
        writers: writers.len(),
        proposals: proposals.iter().map(|p| desk.shown(p)).collect(),
        lonely: lonely.iter().map(|p| desk.shown(p)).collect(),
        before: desk.evaluate(&all, &[]),
        held_out: (writers.len() > 1).then(|| desk.hold_out(&writers)),
    }
}

/// One criterion on one answer: the best of its phrases, and the best of those against it.
#[derive(Clone, Debug, Default)]
struct Heard {
    hit: Hit,
    against: f64,
}

/// Words tried on one criterion, and how well every answer says them.
struct Candidate {
    criterion: usize,
    list: List,
    words: String,
    from: usize,
    said: Vec<Hit>,
}

/// A candidate with what it does, by position.
struct Weighed {
    candidate: usize,
    gains: Vec<usize>,
    costs: Vec<usize>,
}

/// Everything about the answers that does not change while phrases are tried.
struct Desk<'a> {
    rubric: &'a Rubric,
    judge: &'a Judge,
    marks: &'a [&'a Marked],
    readings: Vec<Reading>,
    /// By criterion, then by answer.
    heard: Vec<Vec<Heard>>,
    /// By criterion, then by answer: another criterion that is met makes this one harmless.
    excused: Vec<Vec<bool>>,
    candidates: Vec<Candidate>,
}

impl<'a> Desk<'a> {
    fn new(rubric: &'a Rubric, judge: &'a Judge, marks: &'a [&'a Marked]) -> Desk<'a> {
        let readings: Vec<Reading> = marks.iter().map(|m| judge.read(&m.text)).collect();
        let heard = judge
            .criteria
            .iter()
            .map(|criterion| {
                let ears = criterion.ears(judge.understood);
                let one = |reading| {
                    let hits = criterion
                        .phrases
                        .iter()
                        .map(|phrase| criterion.hear(phrase, reading, ears));
                    Heard {
                        hit: hits.fold(Hit::default(), better),
                        against: criterion
                            .against
                            .iter()
                            .map(|phrase| phrase.said(lexicon(), reading, ears).score)
                            .fold(0.0, f64::max),
                    }
                };
                readings.iter().map(one).collect()
            })
            .collect();
        let mut desk = Desk {
            rubric,
            judge,
            marks,
            readings,
            heard,
            excused: Vec::new(),
            candidates: Vec::new(),
        };
        desk.excused = desk.excused();
        desk.candidates = desk.candidates();
        desk
    }

    fn excused(&self) -> Vec<Vec<bool>> {
        let met = |id: &String, answer: usize| {
            let place = self.judge.criteria.iter().position(|c| c.id == *id);
            place.is_some_and(|c| {
                matches!(
                    self.find(c, answer, &self.heard[c][answer]),
                    Finding::Stated(_)
                )
            })
        };
        let one = |criterion: &Criterion| {
            let answers = 0..self.marks.len();
            answers
                .map(|answer| criterion.unless.iter().any(|id| met(id, answer)))
                .collect()
        };
        self.judge.criteria.iter().map(one).collect()
    }

    /// Words of every answer on which a criterion is not heard as marked.
    fn candidates(&self) -> Vec<Candidate> {
        let mut out: Vec<Candidate> = Vec::new();
        let unmarked = |id: &str| {
            let mut all = self.rubric.misconception.iter();
            all.any(|m| m.id == id && !m.marked)
        };
        for (c, criterion) in self.judge.criteria.iter().enumerate() {
            if unmarked(&criterion.id) {
                continue;
            }
            let mut tried: BTreeSet<(List, String)> = BTreeSet::new();
            for (from, mark) in self.marks.iter().enumerate() {
                if self.worth(c, from, &self.heard[c][from]) == Worth::Right {
                    continue;
                }
                let list = match mark.says(self.rubric, &criterion.id) {
                    Some(true) => List::Phrases,
                    _ => List::Against,
                };
                let mut clauses = phrase::clauses_of(lexicon(), &mark.text);
                clauses.sort_by_key(String::len);
                // One word alone is a topic, not a statement.
                clauses.retain(|words| words.split_whitespace().nth(1).is_some());
                for words in clauses.into_iter().take(PER_ANSWER) {
                    if tried.insert((list, words.to_lowercase())) {
                        out.push(self.candidate(c, list, words, from));
                    }
                }
            }
        }
        out
    }

    fn candidate(&self, c: usize, list: List, words: String, from: usize) -> Candidate {
        let criterion = &self.judge.criteria[c];
        let ears = criterion.ears(self.judge.understood);
        let phrase = Phrase::new(lexicon(), &words, &self.judge.setting);
        let hear = |reading| match list {
            List::Phrases => criterion.hear(&phrase, reading, ears),
            List::Against => phrase.said(lexicon(), reading, ears),
        };
        Candidate {
            criterion: c,
            list,
            words,
            from,
            said: self.readings.iter().map(hear).collect(),
        }
    }

    fn worth(&self, c: usize, answer: usize, heard: &Heard) -> Worth {
        let id = &self.judge.criteria[c].id;
        let Some(truth) = self.marks[answer].says(self.rubric, id) else {
            return Worth::Right;
        };
        let finding = match self.excused[c][answer] {
            true => Finding::Absent,
            false => self.find(c, answer, heard),
        };
        match finding {
            Finding::Perhaps(_) => Worth::Open,
            Finding::Stated(_) if truth => Worth::Right,
            Finding::Absent if !truth => Worth::Right,
            _ => Worth::Wrong,
        }
    }

    fn find(&self, c: usize, answer: usize, heard: &Heard) -> Finding {
        let (hit, reading) = (heard.hit.clone(), &self.readings[answer]);
        self.judge.criteria[c].settle(hit, heard.against, reading)
    }

    fn with(&self, candidate: &Candidate, answer: usize, heard: &Heard) -> Heard {
        let said = &candidate.said[answer];
        match candidate.list {
            List::Phrases => Heard {
                hit: better(heard.hit.clone(), said.clone()),
                against: heard.against,
            },
            List::Against => Heard {
                hit: heard.hit.clone(),
                against: heard.against.max(said.score),
            },
        }
    }

    /// What a candidate does to the answers of others than its writer.
    fn weigh(&self, candidate: usize, answers: &[usize], heard: &[Heard]) -> Weighed {
        let it = &self.candidates[candidate];
        let (mut gains, mut costs) = (Vec::new(), Vec::new());
        for &answer in answers {
            if writer(self.marks[answer]) == writer(self.marks[it.from]) {
                continue;
            }
            let before = self.worth(it.criterion, answer, &heard[answer]);
            let after = self.with(it, answer, &heard[answer]);
            let after = self.worth(it.criterion, answer, &after);
            match after.cmp(&before) {
                std::cmp::Ordering::Greater => gains.push(answer),
                std::cmp::Ordering::Less => costs.push(answer),
                std::cmp::Ordering::Equal => {}
            }
        }
        Weighed {
            candidate,
            gains,
            costs,
        }
    }

    /// The phrases that these answers propose, one after the other, each with those before it
    /// in place; and those that would settle only the answer they come from.
    fn propose(&self, answers: &[usize]) -> (Vec<Weighed>, Vec<Weighed>) {
        let (mut chosen, mut lonely) = (Vec::new(), Vec::new());
        for c in 0..self.judge.criteria.len() {
            let mut heard = self.heard[c].clone();
            let mut left: Vec<usize> = (0..self.candidates.len())
                .filter(|&k| self.candidates[k].criterion == c)
                .filter(|&k| answers.contains(&self.candidates[k].from))
                .collect();
            for _ in 0..MOST {
                let best = left
                    .iter()
                    .map(|&k| self.weigh(k, answers, &heard))
                    .filter(|w| w.gains.len() > COST * w.costs.len())
                    // Of equals the shorter, and of these the first: the same every time.
                    .max_by_key(|w| {
                        let worth = w.gains.len() - COST * w.costs.len();
                        let length = self.candidates[w.candidate].words.len();
                        (worth, std::cmp::Reverse((length, w.candidate)))
                    });
                let Some(best) = best else { break };
                self.take(best.candidate, &mut heard);
                left.retain(|&k| k != best.candidate);
                chosen.push(best);
            }
            lonely.extend(self.lonely(c, &left, answers, &mut heard));
        }
        chosen.sort_by_key(|w| std::cmp::Reverse(w.gains.len() - COST * w.costs.len()));
        (chosen, lonely)
    }

    /// Puts a candidate in its place.
    fn take(&self, candidate: usize, heard: &mut [Heard]) {
        for (answer, heard) in heard.iter_mut().enumerate() {
            *heard = self.with(&self.candidates[candidate], answer, heard);
        }
    }

    /// Of every answer that is still misheard, the shortest words that would settle it and do
    /// nothing to the others.
    fn lonely(
        &self,
        c: usize,
        left: &[usize],
        answers: &[usize],
        heard: &mut [Heard],
    ) -> Vec<Weighed> {
        let mut out = Vec::new();
        for &answer in answers {
            if self.worth(c, answer, &heard[answer]) == Worth::Right {
                continue;
            }
            let found = left.iter().copied().find(|&k| {
                let it = &self.candidates[k];
                let then = self.with(it, answer, &heard[answer]);
                it.from == answer
                    && self.worth(c, answer, &then) == Worth::Right
                    && self.weigh(k, answers, heard).costs.is_empty()
            });
            if let Some(candidate) = found {
                let weighed = self.weigh(candidate, answers, heard);
                self.take(candidate, heard);
                out.push(weighed);
            }
        }
        out
    }

    /// The judgement of an answer with these candidates in place.
    fn judge_with(&self, answer: usize, chosen: &[Weighed]) -> Judgement {
        let findings = (0..self.judge.criteria.len()).map(|c| {
            let mut heard = self.heard[c][answer].clone();
            for weighed in chosen {
                let candidate = &self.candidates[weighed.candidate];
                if candidate.criterion == c {
                    heard = self.with(candidate, answer, &heard);
                }
            }
            self.find(c, answer, &heard)
        });
        self.judge
            .decide(&self.marks[answer].text, &self.readings[answer], findings)
    }

    fn rows(&self, answers: &[usize], chosen: &[Weighed]) -> Vec<Row<'a>> {
        answers
            .iter()
            .map(|&answer| Row {
                rubric: self.rubric,
                marked: self.marks[answer],
                judged: self.judge_with(answer, chosen),
            })
            .collect()
    }

    fn evaluate(&self, answers: &[usize], chosen: &[Weighed]) -> Evaluation {
        evaluate(&self.rows(answers, chosen))
    }

    /// Every writer judged with phrases from the writers of other groups alone.
    fn hold_out(&self, writers: &BTreeSet<&str>) -> Evaluation {
        let group: BTreeMap<&str, usize> = writers
            .iter()
            .enumerate()
            .map(|(place, &writer)| (writer, place % FOLDS.min(writers.len())))
            .collect();
        let mut rows = Vec::new();
        for fold in 0..FOLDS.min(writers.len()) {
            let (held, taught): (Vec<usize>, Vec<usize>) = (0..self.marks.len())
                .partition(|&answer| group[writer(self.marks[answer])] == fold);
            rows.extend(self.rows(&held, &self.propose(&taught).0));
        }
        evaluate(&rows)
    }

    fn shown(&self, weighed: &Weighed) -> Proposal {
        let candidate = &self.candidates[weighed.candidate];
        let ids = |answers: &[usize]| answers.iter().map(|&a| self.marks[a].id.clone()).collect();
        Proposal {
            criterion: self.judge.criteria[candidate.criterion].id.clone(),
            list: candidate.list,
            words: candidate.words.clone(),
            from: self.marks[candidate.from].id.clone(),
            gains: ids(&weighed.gains),
            costs: ids(&weighed.costs),
        }
    }
}

/// How well a criterion is heard on one answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Worth {
    Wrong,
    Open,
    Right,
}

/// Who wrote an answer; where that is not said, somebody who wrote nothing else.
fn writer(mark: &Marked) -> &str {
    match mark.writer.as_str() {
        "" => &mark.id,
        writer => writer,
    }
}

fn better(a: Hit, b: Hit) -> Hit {
    if b.score > a.score { b } else { a }
}
