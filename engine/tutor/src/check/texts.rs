//! Prose: every template can be filled, and no number is typed that can be computed.

use formula::Values;

use super::Checker;
use super::numbers::source_values;
use crate::exercise::plan::{Plan, steps_of};
use crate::exercise::random::Random;
use crate::lesson::{Exercise, Task, Text, values};
use crate::prose::template;

pub fn check(checker: &mut Checker<'_>) {
    let lesson = checker.lesson;
    let none = Values::new();
    for text in [&lesson.title, &lesson.summary, &lesson.why, &lesson.model] {
        prose(checker, text, &none);
    }
    for entry in &lesson.takes_up {
        prose(checker, &entry.says, &none);
    }
    for entry in &lesson.formulas {
        optional(checker, entry.says.as_ref(), &none);
    }
    for step in &lesson.steps {
        prose(checker, &step.title, &none);
        prose(checker, &step.text, &none);
    }
    for reteach in &lesson.reteach {
        for text in [&reteach.name, &reteach.title, &reteach.text] {
            prose(checker, text, &none);
        }
    }
    for explain in &lesson.explain {
        for text in [&explain.title, &explain.prompt, &explain.model_answer] {
            prose(checker, text, &none);
        }
    }
    for print in &lesson.fingerprints {
        let scene = print.known();
        prose(checker, &print.title, &scene);
        prose(checker, &print.shows, &scene);
        optional(checker, print.hides.as_ref(), &scene);
    }
    for source in &lesson.sources {
        let known = source_values(checker, source);
        prose(checker, &source.says, &known);
    }
    worked(checker);
    tables_and_plots(checker);
    for exercise in &lesson.exercises {
        optional(checker, exercise.title.as_ref(), &Values::new());
        exercise_texts(checker, exercise);
    }
    if let Some(faded) = lesson.worked.as_ref().and_then(|it| it.faded.as_ref()) {
        exercise_texts(checker, &faded.exercise);
    }
}

/// Prose: templates, and typed decimals.
pub(super) fn prose(checker: &mut Checker<'_>, text: &Text, values: &Values) {
    label(checker, text, values);
    for span in template::typed_numbers(text) {
        let number = text[span.clone()].to_owned();
        let place = checker.place_in(text, span.start, span.end);
        let message = format!("{number} is typed here, so nothing checks it.");
        checker.error(place, "typed-number", message).help = Some(format!(
            "Write {{{{ … }}}}: a formula that gives it, or {{{{ {number} }}}}."
        ));
    }
}

/// A label: templates only. It names parameters, which are typed beside it.
fn label(checker: &mut Checker<'_>, text: &Text, values: &Values) {
    for error in template::fill(checker.lesson, text, values).errors {
        let place = checker.place_in(text, error.span.start, error.span.end);
        let finding = checker.error(place, "template", super::sentence(&error.message));
        finding.expected = error.expected;
        finding.help = error.help;
    }
}

fn optional(checker: &mut Checker<'_>, text: Option<&Text>, values: &Values) {
    if let Some(text) = text {
        prose(checker, text, values);
    }
}

fn worked(checker: &mut Checker<'_>) {
    let lesson = checker.lesson;
    let Some(worked) = &lesson.worked else { return };
    prose(checker, &worked.title, &Values::new());
    prose(checker, &worked.intro, &values(&worked.given));
    for (index, line) in worked.lines.iter().enumerate() {
        let known = lesson.worked_values(index + 1);
        optional(checker, line.says.as_ref(), &known);
        optional(checker, line.ask.as_ref(), &known);
    }
    optional(
        checker,
        worked.after.as_ref(),
        &lesson.worked_values(usize::MAX),
    );
}

fn tables_and_plots(checker: &mut Checker<'_>) {
    let lesson = checker.lesson;
    for table in &lesson.tables {
        let known = values(&table.with);
        prose(checker, &table.title, &known);
        optional(checker, table.note.as_ref(), &known);
        let labels = table.row_labels.iter().enumerate();
        for (row, text) in labels {
            label(checker, text, &crate::table::row_values(table, row));
        }
        for column in &table.columns {
            label(checker, &column.title, &known);
        }
        for cell in table.limit.iter().flat_map(|it| &it.cells) {
            label(checker, cell, &known);
        }
    }
    for plot in &lesson.plots {
        let known = values(&plot.with);
        prose(checker, &plot.title, &known);
        for text in [&plot.x.label, &plot.y.label] {
            label(checker, text, &known);
        }
        let series = plot.series.iter().map(|it| (&it.label, &it.with));
        let marks = plot.marks.iter().map(|it| (&it.label, &it.with));
        for (text, own) in series.chain(marks) {
            label(checker, text, &crate::plot::known_at(plot, own));
        }
    }
    for map in &lesson.maps {
        let known = values(&map.with);
        prose(checker, &map.title, &known);
        optional(checker, map.says.as_ref(), &known);
        for text in [&map.x.label, &map.y.label, &map.value_label] {
            label(checker, text, &known);
        }
    }
}

/// Some numbers that the exercise may draw, and its steps' values with them.
fn sample(checker: &Checker<'_>, exercise: &Exercise) -> (Values, Values) {
    let mut given: Values = exercise
        .draw
        .iter()
        .filter_map(|it| Some((it.name.text.clone(), *it.values.get(it.values.len() / 2)?)))
        .collect();
    let steps = steps_of(exercise);
    if let Ok(plan) = Plan::without_mistakes(checker.lesson, exercise, &steps) {
        let mut random = Random::new(2, &exercise.id);
        let mut points = (0..200).map(|_| plan.point(&plan.variables(&mut random)));
        if let Some(point) = points.find(|point| plan.allowed(point)) {
            given = plan.given(&point);
        }
    }
    let mut known = given.clone();
    for step in &steps {
        if let Ok(value) = checker.eval(&step.is.expr, &known) {
            known.insert(step.name.text.clone(), value);
        }
    }
    (given, known)
}

fn exercise_texts(checker: &mut Checker<'_>, exercise: &Exercise) {
    let (given, known) = sample(checker, exercise);
    prose(checker, &exercise.ask, &given);
    for hint in &exercise.hints {
        prose(checker, hint, &given);
    }
    for mistake in &exercise.mistakes {
        prose(checker, &mistake.says, &known);
    }
    optional(checker, exercise.after.as_ref(), &known);
    match &exercise.task {
        Task::Numeric { steps } => {
            for step in steps {
                optional(checker, step.ask.as_ref(), &given);
            }
        }
        Task::Choice { options } => {
            for option in options {
                prose(checker, &option.text, &given);
                optional(checker, option.says.as_ref(), &given);
            }
        }
        Task::Order { items } => {
            for item in items {
                prose(checker, item, &given);
            }
        }
        Task::FindTheMistake { lines, .. } => {
            for line in lines {
                optional(checker, line.says.as_ref(), &given);
            }
        }
        // Its texts are WGSL, where numbers are typed.
        Task::Look(_) | Task::Shader(_) => {}
    }
}
