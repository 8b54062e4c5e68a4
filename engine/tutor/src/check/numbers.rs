//! Every number that a lesson prints, against the core, at the precision in which it is printed.

use formula::Values;

use super::Checker;
use crate::finding::Place;
use crate::lesson::{Curve, Formula, SourceSays, Table, Test, Text, values};
use crate::plot::{compile_curve, known_at};
use crate::table::{row_count, row_values};
use crate::worked::digits_of;

pub fn check(checker: &mut Checker<'_>) {
    worked(checker);
    let lesson = checker.lesson;
    for source in &lesson.sources {
        source_says(checker, source);
    }
    for table in &lesson.tables {
        check_table(checker, table);
    }
    for plot in &lesson.plots {
        check_plot(checker, plot);
    }
    for map in &lesson.maps {
        check_map(checker, map);
    }
    for claim in &lesson.claims {
        check_claim(checker, claim);
    }
}

/// Compares a printed number with the core's.
fn shown(checker: &mut Checker<'_>, what: &str, shown: &Text, value: f64) {
    if formula::agrees_with_printed(value, shown) {
        return;
    }
    let computed = formula::format_number(value, digits_of(shown));
    let message = format!("{what} is printed as {shown}; the core computes {computed}.");
    checker.error_in(shown, "number-differs", message).expected = Some(computed);
}

fn worked(checker: &mut Checker<'_>) {
    let Some(worked) = &checker.lesson.worked else {
        return;
    };
    let mut known = values(&worked.given);
    for line in &worked.lines {
        if known.contains_key(&line.name.text) {
            let message = format!("`{}` is already the name of a number here.", line.name);
            checker.error_in(&line.name, "id-given-twice", message);
        }
        if let Some(value) = checker.value(&line.is, &known) {
            if let Some(printed) = &line.shown {
                shown(checker, &format!("`{}`", line.name), printed, value);
            }
            known.insert(line.name.text.clone(), value);
        } else {
            // Later lines would only repeat that this name is missing.
            return;
        }
    }
}

/// The numbers that a source's number is computed from.
pub fn source_values(checker: &Checker<'_>, source: &SourceSays) -> Values {
    match &checker.lesson.worked {
        Some(worked) if source.with.is_empty() => values(&worked.given),
        _ => values(&source.with),
    }
}

fn source_says(checker: &mut Checker<'_>, source: &SourceSays) {
    let known = source_values(checker, source);
    if let Some(value) = checker.value(&source.is, &known)
        && !formula::agrees_with_printed(value, &source.shown)
    {
        let computed = formula::format_number(value, digits_of(&source.shown));
        let message = format!(
            "The source's number is given as {}, but what it is said to compute is {computed}.",
            source.shown
        );
        checker
            .error_in(&source.shown, "number-differs", message)
            .expected = Some(computed);
    }
    let Some(truth) = &source.truth else { return };
    if let Some(value) = checker.value(truth, &known)
        && formula::agrees_with_printed(value, &source.shown)
    {
        let message = format!(
            "The source's {} is right: the truth rounds to it as well.",
            source.shown
        );
        checker
            .error_in(&source.shown, "source-is-right", message)
            .help = Some("Quote a number that is wrong, or leave `truth` out.".to_owned());
    }
}

fn check_table(checker: &mut Checker<'_>, table: &Table) {
    let rows = row_count(table);
    let count = |checker: &mut Checker<'_>, at: Place, what: &str, found: usize, wanted: usize| {
        if found != 0 && found != wanted {
            let message = format!("{what}: {found} entries for {wanted} rows or columns.");
            checker.error(at, "count-differs", message).expected =
                Some(format!("{wanted} entries"));
        }
    };
    let first_place = |texts: &[Text]| texts.first().map_or(table.id.place, |text| text.place);
    let labels = first_place(&table.row_labels);
    count(
        checker,
        labels,
        "`row_labels`",
        table.row_labels.len(),
        rows,
    );
    let mut names: Vec<&str> = table.with.iter().map(|it| it.name.text.as_str()).collect();
    names.extend(table.rows.iter().map(|(name, _)| name.text.as_str()));
    for column in &table.columns {
        count(
            checker,
            first_place(&column.shown),
            "`shown`",
            column.shown.len(),
            rows,
        );
        if !checker.expression(&column.is, &names) {
            continue;
        }
        for row in 0..rows {
            let value = match checker.eval(&column.is.expr, &row_values(table, row)) {
                Ok(value) => value,
                Err(error) => {
                    checker.formula_error(&column.is.text, &error);
                    break;
                }
            };
            let Some(printed) = column.shown.get(row) else {
                continue;
            };
            let computed = formula::format_number(value, column.digits);
            if !formula::agrees_with_printed(value, printed) {
                let what = format!("Row {} of \"{}\"", row + 1, column.title);
                shown(checker, &what, printed, value);
            } else if digits_of(printed) != digits_of(&computed) {
                let message = format!("The table prints {computed} here, not {printed}.");
                checker
                    .error_in(printed, "number-differs", message)
                    .expected = Some(computed);
            }
        }
    }
    limit(checker, table);
}

fn limit(checker: &mut Checker<'_>, table: &Table) {
    let Some(limit) = &table.limit else { return };
    // The label stands in the first column: in that of the first input, where no words do.
    let first = usize::from(table.row_labels.is_empty());
    let all = table.columns.len() + table.rows.len().saturating_sub(first);
    if ![table.columns.len(), all].contains(&limit.cells.len()) {
        let message = format!(
            "The last row has {} cells for {} columns.",
            limit.cells.len(),
            table.columns.len()
        );
        checker.error_in(&limit.label, "count-differs", message);
        return;
    }
    if limit.at.is_empty() {
        return;
    }
    let mut known = values(&table.with);
    known.extend(values(&limit.at));
    let computed = &limit.cells[limit.cells.len() - table.columns.len()..];
    for (column, cell) in table.columns.iter().zip(computed) {
        let Some(value) = checker.value(&column.is, &known) else {
            continue;
        };
        let words = cell.trim().trim_start_matches('→').trim();
        let number = |text: &str| text.trim().parse::<f64>().ok();
        let holds = match words {
            "0" => Some(value.abs() < 1e-2),
            "∞" => Some(value > 1e2),
            "−∞" | "-∞" => Some(value < -1e2),
            _ => match words.strip_prefix('>') {
                Some(bound) => number(bound).map(|bound| value > bound),
                None => match words.strip_prefix('<') {
                    Some(bound) => number(bound).map(|bound| value < bound),
                    None => number(words).map(|limit| (value - limit).abs() <= 0.02 * limit.abs()),
                },
            },
        };
        if holds == Some(false) {
            let value = formula::format_number(value, formula::Digits::Significant(3));
            let message =
                format!("\"{cell}\" is said to be the limit, but near it stands {value}.");
            checker.error_in(cell, "number-differs", message);
        }
    }
}

fn check_plot(checker: &mut Checker<'_>, plot: &crate::lesson::Plot) {
    for series in &plot.series {
        // Whether there are means is a matter of names.
        let Curve::Formula(formula) = &series.is else {
            continue;
        };
        let known = known_at(plot, &series.with);
        let mut names: Vec<&str> = known.keys().map(String::as_str).collect();
        names.push(&plot.x.name.text);
        if !checker.expression(formula, &names) {
            continue;
        }
        let Ok((program, mut inputs)) =
            compile_curve(checker.lesson, plot, &formula.expr, &series.with)
        else {
            continue;
        };
        let mut drawn = 0;
        for step in 1..16 {
            let x = plot.x.from + (plot.x.to - plot.x.from) * f64::from(step) / 16.0;
            if let Some(last) = inputs.last_mut() {
                *last = x;
            }
            let y = program.eval(&inputs);
            drawn += usize::from(y.is_finite() && (!plot.y.log || y > 0.0));
        }
        if drawn < 2 {
            let message = format!("\"{}\" has no points to draw on this axis.", series.label);
            checker.error_in(&formula.text, "nothing-to-draw", message);
        }
    }
    for mark in &plot.marks {
        let mut known = known_at(plot, &mark.with);
        let Some(x) = checker.value(&mark.x, &known) else {
            continue;
        };
        if x < plot.x.from || x > plot.x.to {
            let message = format!(
                "The mark stands at {}, outside of the axis.",
                crate::prose::shortest(x)
            );
            checker
                .error_in(&mark.x.text, "nothing-to-draw", message)
                .expected = Some(format!(
                "{} to {}",
                crate::prose::shortest(plot.x.from),
                crate::prose::shortest(plot.x.to)
            ));
        }
        known.insert(plot.x.name.text.clone(), x);
        let _ = checker.value(&mark.is, &known);
    }
}

fn check_map(checker: &mut Checker<'_>, map: &crate::lesson::Map) {
    let known = values(&map.with);
    let mut names: Vec<&str> = known.keys().map(String::as_str).collect();
    names.extend([map.x.name.text.as_str(), map.y.name.text.as_str()]);
    if !checker.expression(&map.is, &names) {
        return;
    }
    // A coarse look is enough: a map of quadratures takes a while.
    let cells = checker.lesson.cells(map, &known, 5);
    if cells.iter().filter(|value| value.is_finite()).count() < 2 {
        let message = "The map has no values to draw on these axes.".to_owned();
        checker.error_in(&map.is.text, "nothing-to-draw", message);
    }
}

fn check_claim(checker: &mut Checker<'_>, claim: &crate::lesson::Claim) {
    let known = values(&claim.with);
    match &claim.test {
        Test::Holds(holds) => {
            if checker.value(holds, &known) == Some(0.0) {
                let message = format!("This does not hold: {}.", claim.says.trim_end_matches('.'));
                checker.error_in(&holds.text, "claim-fails", message);
            }
        }
        Test::Equals { is, equals, rel } => {
            let (left, right) = (checker.value(is, &known), checker.value(equals, &known));
            let (Some(left), Some(right)) = (left, right) else {
                return;
            };
            if (left - right).abs() > rel * right.abs() {
                equals_fails(checker, equals, left, right);
            }
        }
    }
}

fn equals_fails(checker: &mut Checker<'_>, equals: &Formula, left: f64, right: f64) {
    let number = crate::prose::shortest;
    let message = format!(
        "The claim says {}; the core computes {}.",
        number(right),
        number(left)
    );
    checker
        .error_in(&equals.text, "claim-fails", message)
        .expected = Some(number(left));
}
