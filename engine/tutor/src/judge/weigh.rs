//! Learns how much each thing said speaks for each criterion, from marked answers.
//!
//! Logistic regression with a ridge, by coordinate descent: the same marks give the same weights,
//! to the last digit that is kept.

use std::collections::BTreeMap;
use std::fmt::Write;

use super::Judge;
use super::evaluate::Marked;
use super::evidence::{Key, name};
use super::lexicon::lexicon;
use crate::rubric::{Blank, Rubric};

/// How little the ridge holds the weights back.
const FREEDOM: f64 = 2.0;
/// Weights below this are not kept.
const LEAST: f64 = 0.1;
/// Rounds over all weights; they have settled long before.
const ROUNDS: usize = 60;
/// A sentence left open counts as so many answers.
const OPEN: usize = 3;
/// Marked answers that a criterion needs, of either kind.
const FEWEST: usize = 4;

/// The weights for a question, as a text that [`Judge::with_evidence`] reads: for each criterion
/// `= ITEM ID BIAS`, its sentence, and what speaks for it and against.
pub fn weigh(rubric: &Rubric, marks: &[Marked]) -> String {
    let judge = Judge::with_evidence(rubric, "");
    let mine: Vec<&Marked> = marks.iter().filter(|it| it.item == rubric.item).collect();
    let said: Vec<Vec<(Key, f64)>> = mine
        .iter()
        .map(|it| judge.features(&it.text).iter().collect())
        .collect();
    let words: BTreeMap<Key, String> = mine.iter().flat_map(|it| judge.words(&it.text)).collect();
    let mut out = String::new();
    for criterion in rubric.criteria() {
        let mut rows: Vec<(&[(Key, f64)], bool)> = mine
            .iter()
            .zip(&said)
            .filter_map(|(mark, said)| Some((said.as_slice(), mark.says(rubric, criterion.id)?)))
            .collect();
        // A sentence that the tutor leaves open says nothing before somebody fills it.
        let open = criterion.prompt.and_then(Blank::of).map(|it| it.filled(""));
        let open: Vec<(Key, f64)> = open
            .map(|text| judge.features(&text).iter().collect())
            .unwrap_or_default();
        rows.extend([(open.as_slice(), false); OPEN]);
        let met = rows.iter().filter(|(_, met)| *met).count();
        if met < FEWEST || rows.len() - met < FEWEST {
            continue;
        }
        let (bias, weights) = fit(&rows);
        // Writing to a string cannot fail.
        let _ = writeln!(out, "= {} {} {bias:.2}", rubric.item, criterion.id);
        let _ = writeln!(out, "{}", criterion.says);
        let mut line = String::new();
        for (key, weight) in weights {
            let entry = format!("{}:{weight:.2}", name(lexicon(), key, &words));
            if !line.is_empty() && line.len() + 1 + entry.len() > 100 {
                let _ = writeln!(out, "{line}");
                line.clear();
            }
            if !line.is_empty() {
                line.push(' ');
            }
            line.push_str(&entry);
        }
        if !line.is_empty() {
            let _ = writeln!(out, "{line}");
        }
    }
    out
}

/// Bias and weights.
fn fit(rows: &[(&[(Key, f64)], bool)]) -> (f64, Vec<(Key, f64)>) {
    let mut columns: BTreeMap<Key, Vec<(usize, f64)>> = BTreeMap::new();
    for (row, (said, _)) in rows.iter().enumerate() {
        for &(key, value) in *said {
            columns.entry(key).or_default().push((row, value));
        }
    }
    let everywhere: Vec<(usize, f64)> = (0..rows.len()).map(|row| (row, 1.0)).collect();
    let mut odds = vec![0.0; rows.len()];
    let mut bias = 0.0;
    let mut weights: Vec<(Key, f64)> = columns.keys().map(|&key| (key, 0.0)).collect();
    for _ in 0..ROUNDS {
        step(rows, &everywhere, &mut bias, &mut odds, 0.0);
        for (column, (_, weight)) in columns.values().zip(&mut weights) {
            step(rows, column, weight, &mut odds, 1.0);
        }
    }
    weights.retain(|(_, weight)| weight.abs() >= LEAST);
    (bias, weights)
}

/// One step of Newton's method on one weight, all others held.
fn step(
    rows: &[(&[(Key, f64)], bool)],
    column: &[(usize, f64)],
    weight: &mut f64,
    odds: &mut [f64],
    ridge: f64,
) {
    let (mut slope, mut bend) = (ridge * *weight, ridge + 1e-6);
    for &(row, value) in column {
        let likely: f64 = 1.0 / (1.0 + f64::exp(-odds[row]));
        let truth = f64::from(u8::from(rows[row].1));
        slope += FREEDOM * value * (likely - truth);
        bend += FREEDOM * value * value * likely * (1.0 - likely);
    }
    // Far from the least, Newton's step overshoots.
    let change = (-slope / bend).clamp(-0.5, 0.5);
    *weight += change;
    for &(row, value) in column {
        odds[row] += change * value;
    }
}
