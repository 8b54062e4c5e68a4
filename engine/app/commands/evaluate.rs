//! `lobe judge --evaluate`: how well the judge agrees with a teacher.

use std::path::Path;

use serde_json::{Value, json};
use tutor::judge::evaluate::{Evaluation, Marked, Row, Share, by_writer, evaluate};

use crate::cli::Judge;
use crate::exit::{Done, Failure};
use crate::lessons::Shelf;
use crate::output;

pub fn run(shelf: &Shelf, path: &Path, args: &Judge) -> Result<Done, Failure> {
    let marks = read(shelf, path)?;
    let rows: Vec<Row> = marks
        .iter()
        .filter_map(|marked| {
            let explain = shelf
                .lessons()
                .find_map(|lesson| lesson.explain(&marked.item))?;
            let judged = explain.judge.judge(&marked.text);
            Some(Row {
                rubric: &explain.rubric,
                marked,
                judged,
            })
        })
        .collect();
    let writers = if args.by_writer {
        by_writer(&rows)
    } else {
        Vec::new()
    };
    let all = evaluate(&rows);
    if args.json {
        let mut object = figures(&all);
        if args.by_writer {
            let each = writers
                .iter()
                .map(|(name, each)| (name.clone(), figures(each)));
            object["by_writer"] = Value::Object(each.collect());
        }
        output::json(&object)?;
    } else {
        human(&all)?;
        for (name, each) in &writers {
            output::line(&format!(
                "{name:<8} kappa {}  coverage {}  false pass {}",
                number(each.kappa),
                each.coverage,
                each.false_pass
            ))?;
        }
    }
    Ok(Done::Fine)
}

/// The marks of questions that a lesson asks; says on standard error how many others there
/// were.
pub fn read(shelf: &Shelf, path: &Path) -> Result<Vec<Marked>, Failure> {
    let (mut marks, mut left_out) = (Vec::new(), 0);
    for (index, line) in super::lines_of(path)?.iter().enumerate() {
        if line.trim().is_empty() {
            continue;
        }
        let marked: Marked = serde_json::from_str(line).map_err(|error| {
            Failure::unusable(format!(
                "{}:{}: not a marked answer ({error}): one object a line with id, item, text and verdict",
                path.display(),
                index + 1
            ))
        })?;
        if shelf
            .lessons()
            .any(|lesson| lesson.explain(&marked.item).is_some())
        {
            marks.push(marked);
        } else {
            left_out += 1;
        }
    }
    if left_out > 0 {
        output::complain(&format!(
            "{left_out} answers are left out: no lesson here asks their questions"
        ));
    }
    Ok(marks)
}

fn share(share: Share) -> Value {
    json!({
        "hits": share.hits,
        "of": share.of,
        "value": share.value(),
        "interval": share.interval(),
    })
}

pub fn figures(all: &Evaluation) -> Value {
    let criteria: Vec<Value> = all
        .criteria
        .iter()
        .map(|criterion| {
            json!({
                "item": criterion.item,
                "id": criterion.id,
                "precision": share(criterion.precision),
                "recall": share(criterion.recall),
                "f1": criterion.f1(),
                "unsure": criterion.unsure,
            })
        })
        .collect();
    let baselines: Vec<Value> = all
        .baselines
        .iter()
        .map(|it| json!({"name": it.name, "accuracy": share(it.accuracy), "kappa": it.kappa}))
        .collect();
    json!({
        "kappa": all.kappa,
        "accuracy": share(all.accuracy),
        "coverage": share(all.coverage),
        "false_pass": share(all.false_pass),
        "false_fail": share(all.false_fail),
        "misled": share(all.misled),
        "mean_f1": all.mean_f1,
        "confusion": all.confusion,
        "criteria": criteria,
        "baselines": baselines,
    })
}

pub fn number(value: Option<f64>) -> String {
    value.map_or_else(|| "none".to_owned(), |value| format!("{value:.3}"))
}

fn human(all: &Evaluation) -> Result<(), Failure> {
    let line = |name: &str, value: String| output::line(&format!("{name:<12} {value}"));
    line("kappa", number(all.kappa))?;
    line("accuracy", all.accuracy.to_string())?;
    line("coverage", all.coverage.to_string())?;
    line("false pass", all.false_pass.to_string())?;
    line("false fail", all.false_fail.to_string())?;
    line("misled", all.misled.to_string())?;
    line("mean F1", number(all.mean_f1))?;
    for baseline in &all.baselines {
        let kappa = number(baseline.kappa);
        line(
            "baseline",
            format!(
                "{}: kappa {kappa}, accuracy {}",
                baseline.name, baseline.accuracy
            ),
        )?;
    }
    output::line("\nteacher \\ judge    pass  partial  fail  unsure")?;
    for (name, counts) in ["pass", "partial", "fail"].iter().zip(all.confusion) {
        let [pass, partial, fail, unsure] = counts;
        output::line(&format!(
            "{name:<16} {pass:>6} {partial:>8} {fail:>5} {unsure:>7}"
        ))?;
    }
    output::line("\ncriterion: F1, precision, recall, left open")?;
    for criterion in &all.criteria {
        let name = format!("{} {}", criterion.item, criterion.id);
        let f1 = number(criterion.f1());
        let (precision, recall) = (criterion.precision, criterion.recall);
        output::line(&format!(
            "{name:<44} {f1:<6} {precision}  {recall}  {}",
            criterion.unsure
        ))?;
    }
    output::line("")
}
