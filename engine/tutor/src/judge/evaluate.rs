//! How well the judge agrees with a teacher: figures over marked answers, nothing else.
//!
//! Pure functions over rows; reading a file of marks and printing are the program's.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use serde::{Deserialize, Serialize};

use super::{Judgement, Verdict};
use crate::rubric::Rubric;

/// An answer as a teacher marked it: one line of a file of marks.
#[derive(Deserialize, Serialize, Clone, Debug, PartialEq)]
pub struct Marked {
    /// Name of the answer.
    pub id: String,
    /// The question's id.
    pub item: String,
    /// Who wrote it.
    #[serde(default)]
    pub writer: String,
    /// The answer.
    pub text: String,
    /// Expectations that it meets, where the teacher said which.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub met: Option<Vec<String>>,
    /// Misconceptions that it shows, where the teacher said which.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub misconceptions: Option<Vec<String>>,
    /// `pass`, `partial` or `fail`.
    pub verdict: String,
    /// Criteria on which two markers disagreed.
    #[serde(default)]
    pub disputed: Vec<String>,
    /// Whether it was written to mislead a judge.
    #[serde(default)]
    pub adversarial: bool,
}

impl Marked {
    /// Whether the teacher found that criterion in the answer; where he gave a verdict alone,
    /// what follows from it, and `None` where nothing does.
    pub fn says(&self, rubric: &Rubric, id: &str) -> Option<bool> {
        let listed = |list: &Option<Vec<String>>| {
            let list = list.as_ref()?;
            Some(list.iter().any(|said| said == id))
        };
        let verdict = Verdict::parse(&self.verdict);
        if let Some(expectation) = rubric.expectation.iter().find(|e| e.id == id) {
            return listed(&self.met).or(match verdict {
                Some(Verdict::Pass) if expectation.required => Some(true),
                Some(Verdict::Fail) if expectation.required => Some(false),
                _ => None,
            });
        }
        let misconception = rubric.misconception.iter().find(|m| m.id == id)?;
        listed(&self.misconceptions).or(match verdict {
            Some(Verdict::Pass) if misconception.blocking => Some(false),
            _ => None,
        })
    }
}

/// A marked answer beside what the judge made of it.
#[derive(Clone, Debug)]
pub struct Row<'a> {
    /// The rubric of its question.
    pub rubric: &'a Rubric,
    /// The teacher's marks.
    pub marked: &'a Marked,
    /// The judge's.
    pub judged: Judgement,
}

/// So many of so many.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Share {
    /// How many.
    pub hits: usize,
    /// Of how many.
    pub of: usize,
}

impl Share {
    /// The share, in 0 to 1; `None` of nothing.
    pub fn value(self) -> Option<f64> {
        (self.of > 0).then(|| self.hits as f64 / self.of as f64)
    }

    /// The 95 % interval of the share after Wilson (1927); 0 to 1 of nothing.
    pub fn interval(self) -> (f64, f64) {
        let Some(share) = self.value() else {
            return (0.0, 1.0);
        };
        let (n, z) = (self.of as f64, 1.959_963_985);
        let middle = share + z * z / (2.0 * n);
        let reach = z * (share * (1.0 - share) / n + z * z / (4.0 * n * n)).sqrt();
        let scale = 1.0 + z * z / n;
        (
            ((middle - reach) / scale).max(0.0),
            ((middle + reach) / scale).min(1.0),
        )
    }

    fn count(&mut self, hit: bool) {
        self.hits += usize::from(hit);
        self.of += 1;
    }
}

impl fmt::Display for Share {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (low, high) = self.interval();
        match self.value() {
            Some(value) => write!(
                out,
                "{value:.3} [{low:.3}, {high:.3}] ({}/{})",
                self.hits, self.of
            ),
            None => write!(out, "none"),
        }
    }
}

/// How one criterion was heard.
#[derive(Clone, Debug, PartialEq)]
pub struct CriterionFigures {
    /// The question's id.
    pub item: String,
    /// The criterion's id.
    pub id: String,
    /// Of what the judge heard, how much is there.
    pub precision: Share,
    /// Of what is there, how much the judge heard.
    pub recall: Share,
    /// How often the judge left it open.
    pub unsure: usize,
}

impl CriterionFigures {
    /// The harmonic mean of precision and recall; `None` where there was nothing to hear and
    /// nothing was heard.
    pub fn f1(&self) -> Option<f64> {
        let all = self.precision.of + self.recall.of;
        (all > 0).then(|| 2.0 * self.precision.hits as f64 / all as f64)
    }
}

/// What a judge without ears would reach.
#[derive(Clone, Debug, PartialEq)]
pub struct Baseline {
    /// What it goes by.
    pub name: &'static str,
    /// How often it is right.
    pub accuracy: Share,
    /// Its agreement beyond chance.
    pub kappa: Option<f64>,
}

/// Figures over marked answers.
#[derive(Clone, Debug, PartialEq)]
pub struct Evaluation {
    /// Answers whose verdict is not unsure, of all.
    pub coverage: Share,
    /// Right verdicts, of those.
    pub accuracy: Share,
    /// Cohen's kappa of those; `None` where one side only ever gives one verdict.
    pub kappa: Option<f64>,
    /// A partial or a fail called a pass, of all.
    pub false_pass: Share,
    /// A pass called partial or fail, of all.
    pub false_fail: Share,
    /// Answers written to mislead that are no pass and were called one, of all such.
    pub misled: Share,
    /// Teacher's verdict (pass, partial, fail) by judge's (those, and unsure).
    pub confusion: [[usize; 4]; 3],
    /// Each criterion that marked answers carry.
    pub criteria: Vec<CriterionFigures>,
    /// The mean of the criteria's F1.
    pub mean_f1: Option<f64>,
    /// What going by the majority, and by length alone, would reach; each writer is judged by
    /// what the other writers' answers taught.
    pub baselines: Vec<Baseline>,
}

const SETTLED: [Verdict; 3] = [Verdict::Pass, Verdict::Partial, Verdict::Fail];

fn place(verdict: Verdict) -> usize {
    SETTLED
        .iter()
        .position(|&known| known == verdict)
        .unwrap_or(3)
}

/// Cohen's kappa: agreement beyond what chance would give. `None` of nothing, or where chance
/// alone agrees always.
pub fn kappa(pairs: &[(Verdict, Verdict)]) -> Option<f64> {
    let n = pairs.len() as f64;
    let count = |side: fn(&(Verdict, Verdict)) -> Verdict, verdict| {
        pairs.iter().filter(|pair| side(pair) == verdict).count() as f64
    };
    let agreed = pairs.iter().filter(|(a, b)| a == b).count() as f64 / n;
    let chance: f64 = SETTLED
        .iter()
        .map(|&verdict| count(|pair| pair.0, verdict) * count(|pair| pair.1, verdict))
        .sum::<f64>()
        / (n * n);
    (!pairs.is_empty() && chance < 1.0).then(|| (agreed - chance) / (1.0 - chance))
}

/// The figures of judged answers. Rows whose mark is no verdict are left out; so are criteria
/// that the rubric declares unmarked.
pub fn evaluate(rows: &[Row<'_>]) -> Evaluation {
    let verdicts: Vec<(&Row<'_>, Verdict)> = rows
        .iter()
        .filter_map(|row| {
            Verdict::parse(&row.marked.verdict)
                .filter(|v| *v != Verdict::Unsure)
                .map(|v| (row, v))
        })
        .collect();
    let (mut coverage, mut accuracy) = (Share::default(), Share::default());
    let (mut false_pass, mut false_fail, mut misled) =
        (Share::default(), Share::default(), Share::default());
    let mut confusion = [[0; 4]; 3];
    let mut settled = Vec::new();
    for &(row, truth) in &verdicts {
        let judged = row.judged.verdict;
        confusion[place(truth)][place(judged)] += 1;
        coverage.count(judged != Verdict::Unsure);
        false_pass.count(judged == Verdict::Pass && truth != Verdict::Pass);
        false_fail
            .count(truth == Verdict::Pass && matches!(judged, Verdict::Partial | Verdict::Fail));
        if row.marked.adversarial && truth != Verdict::Pass {
            misled.count(judged == Verdict::Pass);
        }
        if judged != Verdict::Unsure {
            accuracy.count(judged == truth);
            settled.push((truth, judged));
        }
    }
    let criteria = criteria(rows);
    let f1: Vec<f64> = criteria.iter().filter_map(CriterionFigures::f1).collect();
    Evaluation {
        coverage,
        accuracy,
        kappa: kappa(&settled),
        false_pass,
        false_fail,
        misled,
        confusion,
        mean_f1: (!f1.is_empty()).then(|| f1.iter().sum::<f64>() / f1.len() as f64),
        criteria,
        baselines: vec![
            baseline("the majority", &verdicts, majority),
            baseline("length alone", &verdicts, by_length),
        ],
    }
}

/// The figures of each writer's answers, in the order of their names.
pub fn by_writer(rows: &[Row<'_>]) -> Vec<(String, Evaluation)> {
    let mut writers: BTreeMap<&str, Vec<Row<'_>>> = BTreeMap::new();
    for row in rows {
        writers
            .entry(&row.marked.writer)
            .or_default()
            .push(row.clone());
    }
    writers
        .into_iter()
        .map(|(writer, rows)| (writer.to_owned(), evaluate(&rows)))
        .collect()
}

fn criteria(rows: &[Row<'_>]) -> Vec<CriterionFigures> {
    let mut items: Vec<&Rubric> = Vec::new();
    for row in rows {
        if !items.iter().any(|rubric| rubric.item == row.rubric.item) {
            items.push(row.rubric);
        }
    }
    let mut out = Vec::new();
    for rubric in items {
        let expectations = rubric.expectation.iter().map(|e| (&e.id, false));
        let misconceptions = rubric
            .misconception
            .iter()
            .filter(|m| m.marked)
            .map(|m| (&m.id, true));
        for (id, is_misconception) in expectations.chain(misconceptions) {
            let mut figures = CriterionFigures {
                item: rubric.item.clone(),
                id: id.clone(),
                precision: Share::default(),
                recall: Share::default(),
                unsure: 0,
            };
            for row in rows.iter().filter(|row| row.rubric.item == rubric.item) {
                let Some(truth) = row.marked.says(rubric, id) else {
                    continue;
                };
                let heard = match is_misconception {
                    true => row.judged.misconceptions.contains(id),
                    false => row.judged.met.contains(id),
                };
                if heard {
                    figures.precision.count(truth);
                }
                if truth {
                    figures.recall.count(heard);
                }
                figures.unsure += usize::from(row.judged.unsure.contains(id));
            }
            out.push(figures);
        }
    }
    out
}

type Taught<'a> = [(&'a Row<'a>, Verdict)];

fn baseline(
    name: &'static str,
    rows: &[(&Row<'_>, Verdict)],
    guess: fn(&[(usize, Verdict)], usize) -> Verdict,
) -> Baseline {
    let writers: BTreeSet<&str> = rows
        .iter()
        .map(|(row, _)| row.marked.writer.as_str())
        .collect();
    let mut accuracy = Share::default();
    let mut pairs = Vec::new();
    for (row, truth) in rows {
        let taught = lengths(rows, row, writers.len() > 1);
        let guessed = guess(&taught, length(row));
        accuracy.count(guessed == *truth);
        pairs.push((*truth, guessed));
    }
    Baseline {
        name,
        accuracy,
        kappa: kappa(&pairs),
    }
}

/// Length and verdict of the other writers' answers to the same question.
fn lengths(rows: &Taught<'_>, row: &Row<'_>, leave_out: bool) -> Vec<(usize, Verdict)> {
    rows.iter()
        .filter(|(other, _)| {
            other.marked.item == row.marked.item
                && !(leave_out && other.marked.writer == row.marked.writer)
        })
        .map(|(other, verdict)| (length(other), *verdict))
        .collect()
}

fn length(row: &Row<'_>) -> usize {
    row.marked.text.chars().count()
}

fn majority(taught: &[(usize, Verdict)], _length: usize) -> Verdict {
    let votes = |verdict: Verdict| taught.iter().filter(|(_, v)| *v == verdict).count();
    // The first of equals, so that the figure does not depend on anything but the marks.
    SETTLED
        .into_iter()
        .rev()
        .max_by_key(|&verdict| votes(verdict))
        .unwrap_or(Verdict::Fail)
}

/// Two cuts: short answers fail, long ones pass. The cuts that fit best are taken.
fn by_length(taught: &[(usize, Verdict)], length: usize) -> Verdict {
    let cut = |low: usize, high: usize, length: usize| match length {
        _ if length < low => Verdict::Fail,
        _ if length < high => Verdict::Partial,
        _ => Verdict::Pass,
    };
    let cuts: BTreeSet<usize> = taught
        .iter()
        .map(|(length, _)| *length)
        .chain([0, usize::MAX])
        .collect();
    let mut best = (0, 0, 0);
    for &low in &cuts {
        for &high in cuts.range(low..) {
            let right = taught
                .iter()
                .filter(|(length, verdict)| cut(low, high, *length) == *verdict)
                .count();
            if right > best.0 {
                best = (right, low, high);
            }
        }
    }
    cut(best.1, best.2, length)
}

impl fmt::Display for Evaluation {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let figure = |value: Option<f64>| value.map_or("none".to_owned(), |v| format!("{v:.3}"));
        writeln!(out, "kappa where settled   {}", figure(self.kappa))?;
        writeln!(out, "accuracy              {}", self.accuracy)?;
        writeln!(out, "coverage              {}", self.coverage)?;
        writeln!(out, "false pass            {}", self.false_pass)?;
        writeln!(out, "false fail            {}", self.false_fail)?;
        writeln!(out, "misled                {}", self.misled)?;
        writeln!(out, "mean F1 of criteria   {}", figure(self.mean_f1))?;
        for baseline in &self.baselines {
            writeln!(
                out,
                "by {:<18} kappa {}, accuracy {}",
                baseline.name,
                figure(baseline.kappa),
                baseline.accuracy
            )?;
        }
        writeln!(out, "teacher \\ judge      pass  partial  fail  unsure")?;
        for (truth, row) in SETTLED.iter().zip(self.confusion) {
            writeln!(
                out,
                "{:<18} {:>6} {:>8} {:>5} {:>7}",
                truth.as_str(),
                row[0],
                row[1],
                row[2],
                row[3]
            )?;
        }
        for criterion in &self.criteria {
            writeln!(
                out,
                "{:<24} {:<24} F1 {}  precision {}  recall {}  unsure {}",
                criterion.item,
                criterion.id,
                figure(criterion.f1()),
                criterion.precision,
                criterion.recall,
                criterion.unsure
            )?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kappa_of_known_tables() {
        use Verdict::{Fail, Pass};
        // Cohen's own shape: 20 and 15 agreed, 5 and 10 not, of 50: 0.4.
        let table = [
            ((Pass, Pass), 20),
            ((Pass, Fail), 5),
            ((Fail, Pass), 10),
            ((Fail, Fail), 15),
        ];
        let pairs: Vec<_> = table
            .iter()
            .flat_map(|&(pair, times)| std::iter::repeat_n(pair, times))
            .collect();
        assert!((kappa(&pairs).expect("two verdicts on each side") - 0.4).abs() < 1e-12);
        assert_eq!(kappa(&[]), None);
        assert_eq!(kappa(&[(Pass, Pass)]), None);
    }

    #[test]
    fn wilson_interval() {
        let (low, high) = Share { hits: 8, of: 10 }.interval();
        assert!(
            (low - 0.4902).abs() < 1e-4 && (high - 0.9433).abs() < 1e-4,
            "{low} {high}"
        );
        assert_eq!(Share { hits: 0, of: 0 }.interval(), (0.0, 1.0));
        assert_eq!(Share { hits: 0, of: 5 }.interval().0, 0.0);
    }
}
