//! Ids: well formed, given once, and there where something refers to them.

use std::collections::BTreeSet;

use super::Checker;
use crate::finding::{Finding, Severity};
use crate::lesson::{Curve, Exercise, Figures, Lesson, Task, Text};
use crate::load::nearest;

/// Letters, digits and single hyphens, a letter first.
fn is_slug(id: &str) -> bool {
    id.starts_with(|c: char| c.is_ascii_lowercase())
        && !id.ends_with('-')
        && !id.contains("--")
        && id
            .chars()
            .all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-')
}

pub fn check(checker: &mut Checker<'_>) {
    let lesson = checker.lesson;
    slug(checker, &lesson.id);
    given_once(checker, lesson.tables.iter().map(|it| &it.id), "table");
    // Plots and maps are files side by side: one may not take the other's name.
    let drawn = lesson.plots.iter().map(|it| &it.id);
    let drawn = drawn.chain(lesson.maps.iter().map(|it| &it.id));
    given_once(checker, drawn, "plot");
    given_once(
        checker,
        lesson.fingerprints.iter().map(|it| &it.id),
        "fingerprint",
    );
    given_once(checker, lesson.reteach.iter().map(|it| &it.id), "reteach");
    given_once(
        checker,
        lesson.sources.iter().filter_map(|it| it.id.as_ref()),
        "source_says",
    );
    items(checker);
    for step in &lesson.steps {
        figures(checker, &step.figures);
    }
    for reteach in &lesson.reteach {
        figures(checker, &reteach.figures);
    }
    for plot in &lesson.plots {
        for series in &plot.series {
            means(checker, &series.is);
        }
    }
    unseen(checker);
    for exercise in &lesson.exercises {
        exercise_names(checker, exercise);
    }
    for explain in &lesson.explain {
        rubric_names(checker, explain);
    }
}

fn slug(checker: &mut Checker<'_>, id: &Text) {
    if !is_slug(id) {
        checker
            .error_in(id, "bad-id", format!("`{id}` is not an id."))
            .expected = Some("small letters, digits and single hyphens, a letter first".to_owned());
    }
}

fn given_once<'a>(checker: &mut Checker<'_>, ids: impl Iterator<Item = &'a Text>, what: &str) {
    let mut seen = BTreeSet::new();
    for id in ids {
        slug(checker, id);
        if !seen.insert(&id.text) {
            let message = format!("Another `[[{what}]]` is already called `{id}`.");
            checker.error_in(id, "id-given-twice", message);
        }
    }
}

/// Exercises and questions share one space of ids: `<lesson>/<slug>`.
fn items(checker: &mut Checker<'_>) {
    let lesson = checker.lesson;
    let mut seen = BTreeSet::from([format!("{}/worked", lesson.id)]);
    let ids = lesson
        .exercises
        .iter()
        .map(|it| &it.id)
        .chain(lesson.explain.iter().map(|it| &it.id));
    for id in ids {
        match id.split_once('/') {
            Some((own, slug)) if own == lesson.id.text && is_slug(slug) => {}
            _ => {
                let message = format!("`{id}` is not an id of this lesson.");
                checker.error_in(id, "bad-id", message).expected =
                    Some(format!("{}/a-name", lesson.id));
            }
        }
        if !seen.insert(id.text.clone()) {
            let message = format!("Another exercise or question is already called `{id}`.");
            checker.error_in(id, "id-given-twice", message);
        }
    }
}

fn figures(checker: &mut Checker<'_>, figures: &Figures) {
    let lesson = checker.lesson;
    let tables: Vec<&str> = lesson.tables.iter().map(|it| it.id.text.as_str()).collect();
    let plots: Vec<&str> = lesson.plots.iter().map(|it| it.id.text.as_str()).collect();
    let maps: Vec<&str> = lesson.maps.iter().map(|it| it.id.text.as_str()).collect();
    let prints = lesson.fingerprints.iter().map(|it| it.id.text.as_str());
    let prints: Vec<&str> = prints.collect();
    for (ids, known, what) in [
        (&figures.table, tables, "table"),
        (&figures.plot, plots, "plot"),
        (&figures.map, maps, "map"),
        (&figures.picture, prints, "fingerprint"),
    ] {
        for id in ids {
            refers(checker, id, &known, what);
        }
    }
}

/// A curve of means: the fingerprint, and that it has some.
fn means(checker: &mut Checker<'_>, curve: &Curve) {
    let Curve::Means { picture, .. } = curve else {
        return;
    };
    let prints = &checker.lesson.fingerprints;
    let known: Vec<&str> = prints.iter().map(|it| it.id.text.as_str()).collect();
    let found = prints.iter().find(|it| it.id.text == picture.text);
    if found.is_some_and(|print| print.means.is_none()) {
        let message = format!("The fingerprint `{picture}` has no `means`.");
        checker.error_in(picture, "unknown-id", message).help =
            Some("Say of which sizes: means = { size = [64, 512] }".to_owned());
    } else {
        refers(checker, picture, &known, "fingerprint");
    }
}

/// What is drawn and stands on no screen.
fn unseen(checker: &mut Checker<'_>) {
    let lesson = checker.lesson;
    let steps = lesson.steps.iter().map(|it| &it.figures);
    let shown: Vec<&Figures> = steps
        .chain(lesson.reteach.iter().map(|it| &it.figures))
        .collect();
    let is_shown = |id: &Text, of: fn(&Figures) -> &Vec<Text>| {
        shown
            .iter()
            .any(|it| of(it).iter().any(|it| it.text == id.text))
    };
    let plots = lesson.plots.iter().map(|it| &it.id);
    let plots = plots
        .filter(|id| !is_shown(id, |it| &it.plot))
        .map(|id| (id, "plot"));
    let maps = lesson.maps.iter().map(|it| &it.id);
    let maps = maps
        .filter(|id| !is_shown(id, |it| &it.map))
        .map(|id| (id, "map"));
    for (id, key) in plots.chain(maps) {
        let message = format!("No step and no re-teach shows `{id}`.");
        let finding = checker.error_in(id, "not-shown", message);
        finding.severity = Severity::Warning;
        finding.help = Some(format!("Show it below a text: {key} = \"{id}\"."));
    }
}

fn refers(checker: &mut Checker<'_>, id: &Text, known: &[&str], what: &str) {
    if known.contains(&id.text.as_str()) {
        return;
    }
    let near = nearest(id, known.iter().copied()).map(str::to_owned);
    let finding = checker.error_in(
        id,
        "unknown-id",
        format!("No `[[{what}]]` is called `{id}`."),
    );
    finding.expected = near.or_else(|| (!known.is_empty()).then(|| known.join(", ")));
}

fn exercise_names(checker: &mut Checker<'_>, exercise: &Exercise) {
    let mut seen = BTreeSet::new();
    for mistake in &exercise.mistakes {
        slug(checker, &mistake.id);
        if !seen.insert(&mistake.id.text) {
            let message = format!("Another mistake here is already called `{}`.", mistake.id);
            checker.error_in(&mistake.id, "id-given-twice", message);
        }
    }
    if let Task::Look(look) = &exercise.task {
        let known = checker.lesson.fingerprints.iter();
        let known: Vec<&str> = known.map(|it| it.id.text.as_str()).collect();
        refers(checker, &look.picture, &known, "fingerprint");
    }
    if let Task::FindTheMistake {
        source: Some(id), ..
    } = &exercise.task
    {
        let lesson = checker.lesson;
        let known = lesson.sources.iter().filter_map(|it| it.id.as_deref());
        let known: Vec<&str> = known.collect();
        refers(checker, id, &known, "source_says");
    }
    let steps = crate::exercise::plan::steps_of(exercise);
    let mut seen: BTreeSet<&str> = exercise
        .draw
        .iter()
        .map(|it| it.name.text.as_str())
        .collect();
    for step in &steps {
        if !seen.insert(&step.name.text) {
            let message = format!("`{}` is already the name of a number here.", step.name);
            checker.error_in(&step.name, "id-given-twice", message);
        }
    }
    let names: Vec<&str> = steps.iter().map(|it| it.name.text.as_str()).collect();
    for mistake in &exercise.mistakes {
        if let Some(step) = &mistake.step
            && !names.contains(&step.text.as_str())
        {
            let near = nearest(step, names.iter().copied()).map(str::to_owned);
            checker
                .error_in(step, "unknown-id", format!("No step is called `{step}`."))
                .expected = near.or_else(|| Some(names.join(", ")));
        }
    }
}

fn rubric_names(checker: &mut Checker<'_>, explain: &crate::lesson::Explain) {
    let lesson = checker.lesson;
    let known: Vec<&str> = lesson
        .reteach
        .iter()
        .map(|it| it.id.text.as_str())
        .collect();
    let expectations = explain
        .rubric
        .expectation
        .iter()
        .map(|it| (&it.id, &it.reteach));
    let expectations = expectations.zip(&explain.expectation_places);
    let misconceptions = explain
        .rubric
        .misconception
        .iter()
        .map(|it| (&it.id, &it.reteach));
    let misconceptions = misconceptions.zip(&explain.misconception_places);
    let mut seen = BTreeSet::new();
    for ((id, reteach), places) in expectations.chain(misconceptions) {
        let place = places.of("id");
        if !is_slug(id) {
            let finding = checker.error(place, "bad-id", format!("`{id}` is not an id."));
            finding.expected = Some("small letters, digits and single hyphens".to_owned());
        }
        if !seen.insert(id) {
            let message = format!("`{id}` stands twice in this question.");
            checker.error(place, "id-given-twice", message);
        }
        if let Some(reteach) = reteach
            && !known.contains(&reteach.as_str())
        {
            let near = nearest(reteach, known.iter().copied()).map(str::to_owned);
            let message = format!("`{id}` is taken up by `{reteach}`, but no `[[reteach]]` is.");
            checker
                .error(places.of("reteach"), "unknown-id", message)
                .expected = near;
        }
    }
    criteria_named(checker, explain);
}

/// Criteria that examples and misconceptions refer to.
fn criteria_named(checker: &mut Checker<'_>, explain: &crate::lesson::Explain) {
    let rubric = &explain.rubric;
    let expectations: Vec<&str> = rubric.expectation.iter().map(|it| it.id.as_str()).collect();
    let misconceptions: Vec<&str> = rubric
        .misconception
        .iter()
        .map(|it| it.id.as_str())
        .collect();
    let mut refer = |ids: &[String], known: &[&str], what: &str, place| {
        for id in ids.iter().filter(|id| !known.contains(&id.as_str())) {
            let near = nearest(id, known.iter().copied()).map(str::to_owned);
            let message = format!("No {what} of this question is called `{id}`.");
            checker.error(place, "unknown-id", message).expected =
                near.or_else(|| (!known.is_empty()).then(|| known.join(", ")));
        }
    };
    for (misconception, places) in rubric
        .misconception
        .iter()
        .zip(&explain.misconception_places)
    {
        let unless = &misconception.unless;
        let all: Vec<&str> = expectations
            .iter()
            .chain(&misconceptions)
            .copied()
            .collect();
        refer(unless, &all, "criterion", places.of("unless"));
    }
    for (example, places) in rubric.example.iter().zip(&explain.example_places) {
        if let Some(met) = &example.met {
            refer(met, &expectations, "expectation", places.of("met"));
        }
        if let Some(held) = &example.misconceptions {
            let place = places.of("misconceptions");
            refer(held, &misconceptions, "misconception", place);
        }
    }
}

/// What only shows where lessons stand together.
pub fn together(lessons: &[&Lesson]) -> Vec<Finding> {
    let mut findings = Vec::new();
    let mut report =
        |lesson: &Lesson, at: &Text, code, message: String, expected: Option<String>| {
            let mut finding = Finding::new(&lesson.file, &lesson.source, at.place, code, message);
            finding.expected = expected;
            findings.push(finding);
        };
    let mut seen = BTreeSet::new();
    for lesson in lessons {
        if !seen.insert(&lesson.id.text) {
            let message = format!("Another lesson is already called `{}`.", lesson.id);
            report(lesson, &lesson.id, "id-given-twice", message, None);
        }
    }
    if lessons.len() < 2 {
        return findings;
    }
    for lesson in lessons {
        for need in &lesson.needs {
            let known = lessons.iter().map(|it| it.id.text.as_str());
            if !seen.contains(&need.text) {
                let near = nearest(need, known).map(str::to_owned);
                let message = format!("No lesson is called `{need}`.");
                report(lesson, need, "unknown-id", message, near);
            } else if leads_to(lessons, need, &lesson.id) {
                let message = format!("`{need}` needs this lesson itself.");
                report(lesson, need, "needs-itself", message, None);
            }
        }
        for entry in &lesson.takes_up {
            let known: Vec<&str> = lessons.iter().flat_map(|it| slips(it)).collect();
            if !known.contains(&entry.slip.text.as_str()) {
                let near = nearest(&entry.slip, known.iter().copied()).map(str::to_owned);
                let message = format!("No lesson notes a slip called `{}`.", entry.slip);
                report(lesson, &entry.slip, "unknown-id", message, near);
            }
        }
    }
    findings
}

/// Everything that may be noted about a learner of a lesson.
fn slips(lesson: &Lesson) -> Vec<&str> {
    let misconceptions = lesson
        .explain
        .iter()
        .flat_map(|it| it.rubric.misconception.iter().map(|m| m.id.as_str()));
    let mistakes = lesson
        .exercises
        .iter()
        .flat_map(|it| it.mistakes.iter().map(|m| m.id.text.as_str()));
    misconceptions.chain(mistakes).collect()
}

fn leads_to(lessons: &[&Lesson], from: &str, to: &str) -> bool {
    let mut open = vec![from];
    let mut seen = BTreeSet::new();
    while let Some(id) = open.pop() {
        if id == to {
            return true;
        }
        if seen.insert(id) {
            let lesson = lessons.iter().find(|it| it.id.text == id);
            open.extend(
                lesson
                    .iter()
                    .flat_map(|it| it.needs.iter().map(|n| n.text.as_str())),
            );
        }
    }
    false
}
