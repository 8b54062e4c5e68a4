//! Exercises: enough of them, enough mistakes in each, and numbers that tell them apart.

use serde::Serialize;

use super::Checker;
use crate::exercise::MOST_TRIES;
use crate::exercise::plan::{Plan, apart, steps_of};
use crate::exercise::random::Random;
use crate::lesson::{Exercise, Task};

/// Numeric exercises that a lesson has at least.
const NUMERIC: usize = 4;
/// Named mistakes that a numeric exercise has at least.
const NAMED: usize = 2;
/// Mutants that a numeric exercise has at least.
const MUTANTS: usize = 5;
/// The least relative tolerance.
const TOLERANCE: f64 = 0.005;
/// Tries that are enough to know a high rate of acceptance.
const FEW_TRIES: u32 = 100;
/// The share of a variable's values that accepted draws must reach.
const COVERAGE: f64 = 0.5;

/// How the numbers of one exercise are drawn.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DrawCount {
    /// The exercise's id.
    pub exercise: String,
    /// Tries made.
    pub tries: u32,
    /// Tries accepted.
    pub accepted: u32,
    /// Share of each variable's values that accepted tries reached.
    pub coverage: Vec<(String, f64)>,
    /// Mistakes with a name.
    pub named: usize,
    /// Mistakes without.
    pub mutants: usize,
}

pub fn check(checker: &mut Checker<'_>) -> Vec<DrawCount> {
    let lesson = checker.lesson;
    let numeric = lesson.exercises.iter().filter(|it| it.kind() == "numeric");
    let numeric = numeric.count();
    if numeric < NUMERIC {
        let message = match numeric {
            1 => "The lesson has one numeric exercise.".to_owned(),
            n => format!("The lesson has {n} numeric exercises."),
        };
        checker
            .error_in(&lesson.id, "too-few-exercises", message)
            .expected = Some(format!("at least {NUMERIC}"));
    }
    let mut counts = Vec::new();
    let faded = lesson.worked.as_ref().and_then(|it| it.faded.as_ref());
    let faded = faded.map(|faded| &faded.exercise);
    for exercise in lesson.exercises.iter().chain(faded) {
        let own = faded.is_none_or(|faded| !std::ptr::eq(faded, exercise));
        if expressions(checker, exercise) {
            counts.extend(check_exercise(checker, exercise, own));
        }
    }
    counts
}

/// All expressions of an exercise over the names they may use; whether all are sound.
fn expressions(checker: &mut Checker<'_>, exercise: &Exercise) -> bool {
    let mut names: Vec<&str> = exercise
        .draw
        .iter()
        .map(|it| it.name.text.as_str())
        .collect();
    let steps = steps_of(exercise);
    let mut sound = true;
    let mut names_at = Vec::new();
    for step in &steps {
        sound &= checker.expression(&step.is, &names);
        names_at.push(names.clone());
        names.push(&step.name.text);
    }
    if let Task::FindTheMistake { lines, .. } = &exercise.task {
        for (line, names) in lines.iter().zip(&names_at) {
            sound &= line.right.is_none() || checker.expression(&line.is, names);
        }
    }
    if let Some(where_) = &exercise.where_ {
        sound &= checker.expression(where_, &names);
    }
    for mistake in &exercise.mistakes {
        let at = match &mistake.step {
            None => steps.len().checked_sub(1),
            Some(step) => steps.iter().position(|it| it.name.text == step.text),
        };
        match at.and_then(|at| names_at.get(at)) {
            Some(names) => sound &= checker.expression(&mistake.is, names),
            None => sound = false,
        }
    }
    sound
}

fn check_exercise(checker: &mut Checker<'_>, exercise: &Exercise, own: bool) -> Option<DrawCount> {
    let lesson = checker.lesson;
    let steps = steps_of(exercise);
    let plan = match Plan::new(lesson, exercise, &steps) {
        Ok(plan) => plan,
        Err(message) => {
            checker.error_in(&exercise.id, "cannot-draw", super::sentence(&message));
            return None;
        }
    };
    let is_numeric = matches!(exercise.task, Task::Numeric { .. });
    let named = plan.mistakes.iter().filter(|it| it.named).count();
    let mutants = plan.mistakes.len() - named;
    if is_numeric || matches!(exercise.task, Task::FindTheMistake { .. }) {
        tolerance(checker, exercise);
    }
    if let Task::Shader(shader) = &exercise.task {
        super::shaders::check(checker, exercise, shader);
    }
    if is_numeric && own {
        for (what, found, least) in [
            ("named mistakes", named, NAMED),
            ("mutants", mutants, MUTANTS),
        ] {
            if found < least {
                let number = if found == 1 {
                    &what[..what.len() - 1]
                } else {
                    what
                };
                let message = format!("`{}` has {found} {number}.", exercise.id);
                let finding = checker.error_in(&exercise.id, "too-few-mistakes", message);
                finding.expected = Some(format!("at least {least}"));
                if what == "mutants" {
                    let help = "They are found in the formula: a square, a root, a quotient, a \
                                factor of pi or 4, a dot product. What has a name counts as \
                                named. Ask for more of the calculation at once.";
                    finding.help = Some(help.to_owned());
                }
            }
        }
    }
    if exercise.retest && exercise.draw.iter().all(|it| it.values.len() < 2) && is_numeric {
        let message = format!(
            "`{}` is asked again, but draws no fresh numbers.",
            exercise.id
        );
        checker.error_in(&exercise.id, "nothing-drawn", message);
    }
    if exercise.hints.len() > 2 {
        let message = "There are two levels of hint; the third is always the answer.";
        checker.error_in(&exercise.hints[2], "too-many-hints", message);
    }
    if is_numeric {
        return Some(count(checker, &plan, named, mutants));
    }
    if let Err(none) = plan.draw(1, &steps) {
        checker.error_in(&exercise.id, "cannot-draw", none.message);
    }
    None
}

fn tolerance(checker: &mut Checker<'_>, exercise: &Exercise) {
    let tolerance = &exercise.tolerance;
    if tolerance.rel < TOLERANCE {
        let message = "Learners who round in between would miss this tolerance.";
        checker
            .error(tolerance.place, "tolerance-too-small", message)
            .expected = Some(format!("at least {TOLERANCE}"));
    }
}

/// Tries draws until enough is known: the rate, and whether every variable keeps its range.
fn count(checker: &mut Checker<'_>, plan: &Plan<'_>, named: usize, mutants: usize) -> DrawCount {
    let exercise = plan.exercise;
    let mut random = Random::new(3, &exercise.id);
    let mut reached: Vec<std::collections::BTreeSet<u64>> =
        vec![Default::default(); exercise.draw.len()];
    let share = |reached: &[std::collections::BTreeSet<u64>]| -> Vec<f64> {
        exercise
            .draw
            .iter()
            .zip(reached)
            .map(|(variable, reached)| reached.len() as f64 / variable.values.len() as f64)
            .collect()
    };
    let (mut tries, mut accepted) = (0, 0);
    while tries < MOST_TRIES {
        let variables = plan.variables(&mut random);
        tries += 1;
        if plan.accepts(&plan.point(&variables)) {
            accepted += 1;
            for (reached, value) in reached.iter_mut().zip(&variables) {
                reached.insert(value.to_bits());
            }
        }
        if tries % FEW_TRIES == 0
            && share(&reached).iter().all(|share| *share >= COVERAGE)
            && accepted > 0
        {
            break;
        }
    }
    let coverage: Vec<f64> = share(&reached);
    if accepted == 0 {
        let message = format!(
            "{tries} tries give no numbers for `{}` that tell its mistakes apart.",
            exercise.id
        );
        let help = culprit(plan);
        checker.error_in(&exercise.id, "cannot-draw", message).help = Some(help);
    } else {
        for (variable, share) in exercise.draw.iter().zip(&coverage) {
            if *share < COVERAGE {
                let message = format!(
                    "Only {:.0} % of the values of `{}` are ever accepted ({accepted} of {tries} \
                     tries).",
                    share * 100.0,
                    variable.name
                );
                let help = culprit(plan);
                checker
                    .error(variable.place, "range-not-covered", message)
                    .help = Some(help);
            }
        }
    }
    DrawCount {
        exercise: exercise.id.text.clone(),
        tries,
        accepted,
        coverage: exercise
            .draw
            .iter()
            .map(|variable| variable.name.text.clone())
            .zip(coverage)
            .collect(),
        named,
        mutants,
    }
}

/// Which mistake rejects most draws, as advice.
fn culprit(plan: &Plan<'_>) -> String {
    let rel = plan.exercise.tolerance.rel;
    let mut random = Random::new(4, &plan.exercise.id);
    let points: Vec<_> = (0..1000)
        .map(|_| plan.point(&plan.variables(&mut random)))
        .filter(|point| plan.allowed(point))
        .collect();
    if points.is_empty() {
        return "Its condition and its formulas allow no numbers at all.".to_owned();
    }
    let percent = |count: usize| count * 100 / points.len();
    let mut worst: Vec<(usize, String)> = plan
        .mistakes
        .iter()
        .map(|mistake| {
            let met = points.iter().filter(|point| {
                let value = mistake.value(point, mistake.made_in);
                value.is_finite() && !apart(value, point.steps[mistake.made_in], rel)
            });
            let step = plan.steps[mistake.made_in].name;
            let met = percent(met.count());
            (
                met,
                format!("`{}` meets the truth of `{step}` in {met} %", mistake.id),
            )
        })
        .collect();
    for (index, a) in plan.mistakes.iter().enumerate().filter(|(_, it)| it.named) {
        for b in plan.mistakes[..index]
            .iter()
            .filter(|it| it.named && it.made_in == a.made_in)
        {
            let met = points.iter().filter(|point| {
                let (a, b) = (a.value(point, a.made_in), b.value(point, b.made_in));
                a.is_finite() && b.is_finite() && !apart(a, b, rel)
            });
            let met = percent(met.count());
            worst.push((met, format!("`{}` meets `{}` in {met} %", a.id, b.id)));
        }
    }
    let rounding = points.iter().filter(|point| !plan.kind_to_rounding(point));
    let rounding = percent(rounding.count());
    worst.push((
        rounding,
        format!("rounding in between misses the tolerance in {rounding} %"),
    ));
    worst.sort_by_key(|entry| std::cmp::Reverse(entry.0));
    let words: Vec<String> = worst
        .into_iter()
        .take(3)
        .filter(|it| it.0 > 0)
        .map(|it| it.1)
        .collect();
    format!(
        "Of the numbers tried, {}. Ask the steps one by one, or draw from a better range.",
        words.join("; ")
    )
}
