//! Places to be found in pictures: whether there are any.

use crate::exercise::look::{self, Sight};
use crate::finding::Finding;
use crate::lesson::{Lesson, Shows};

/// What is wrong with the exercises that ask for a place; `sight` says what is seen in a picture.
pub fn findings(lesson: &Lesson, sight: impl Fn(&str) -> Sight) -> Vec<Finding> {
    let mut findings = Vec::new();
    for exercise in &lesson.exercises {
        let Some(task) = look::task(exercise) else {
            continue;
        };
        let known = lesson.fingerprints.iter();
        if !known.into_iter().any(|it| it.id.text == task.picture.text) {
            continue;
        }
        if sight(&task.picture).best(task.shows).is_some() {
            continue;
        }
        let what = match task.shows {
            Shows::Brighter => "too bright",
            Shows::Darker => "too dark",
            Shows::Either => "wrong",
        };
        let message = format!(
            "The bug in the picture `{}` is {what} nowhere.",
            task.picture
        );
        let (file, source) = (&lesson.file, &lesson.source);
        let place = task.picture.place;
        findings.push(Finding::new(file, source, place, "nothing-to-see", message));
    }
    findings
}
