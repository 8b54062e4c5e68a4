//! Shaders to be mended: what can be said without running them, and what is to be run.

use super::Checker;
use crate::exercise::shader::{self, CodePlace, Job, Ran};
use crate::finding::Finding;
use crate::lesson::{Exercise, Lesson, ShaderTask, Text};
use crate::load::literal;

/// The least relative tolerance: what f32 can promise.
const TOLERANCE: f64 = 1e-4;

/// One text of a lesson that has to be run to be checked.
#[derive(Clone, Debug)]
pub struct ShaderRun<'l> {
    /// What to run.
    pub job: Job,
    lesson: &'l Lesson,
    exercise: &'l Exercise,
    /// The text, and whether it should be right.
    text: &'l Text,
    right: bool,
}

/// The seed of the points at which a lesson's own texts are tried.
const SEED: u64 = 1;

/// Everything that a lesson wants run.
pub fn runs(lesson: &Lesson) -> Vec<ShaderRun<'_>> {
    let mut runs = Vec::new();
    for exercise in &lesson.exercises {
        let Some(task) = shader::task(exercise) else {
            continue;
        };
        for (text, right) in [(&task.source, false), (&task.solution, true)] {
            if let Some(job) = shader::job(lesson, exercise, SEED, text) {
                runs.push(ShaderRun {
                    job,
                    lesson,
                    exercise,
                    text,
                    right,
                });
            }
        }
    }
    runs
}

impl ShaderRun<'_> {
    /// What is wrong with the text, by what came of running it.
    pub fn finding(&self, ran: &Ran) -> Option<Finding> {
        let id = &self.exercise.id;
        let which = match self.right {
            true => "solution",
            false => "source",
        };
        let whole = literal::place_in(
            &self.lesson.source,
            self.text.place,
            self.text,
            0,
            self.text.len(),
        );
        let finding = |place, code, message: String| {
            Finding::new(&self.lesson.file, &self.lesson.source, place, code, message)
        };
        match ran {
            Ran::Values(_) => {}
            Ran::Unable(why) => {
                let message = format!("The {which} of `{id}` could not be run: {why}.");
                return Some(finding(whole, "shader-not-run", message));
            }
            Ran::Stopped { says, .. } => {
                let message = format!("The {which} of `{id}` does not return. {says}");
                return Some(finding(whole, "shader-stopped", message));
            }
            Ran::Refused { says, help, place } => {
                let at = place.as_ref().map_or(whole, |place| self.place(place));
                let message = format!("The {which} of `{id}` is refused: {says}");
                let mut finding = finding(at, "shader-refused", message);
                finding.help.clone_from(help);
                return Some(finding);
            }
        }
        let marking = shader::mark(self.lesson, self.exercise, SEED, ran);
        let message = match (self.right, marking.result(), marking.mistake()) {
            (true, "correct", _) => return None,
            (true, ..) => format!("The solution of `{id}` is not right: {}", marking.says()),
            (false, "correct", _) => format!("The source of `{id}` has no bug: it is right."),
            (false, _, Some(mistake))
                if self
                    .exercise
                    .mistakes
                    .iter()
                    .any(|it| it.id.text == mistake) =>
            {
                return None;
            }
            (false, ..) => {
                let message = format!("The bug in the source of `{id}` is no mistake with a name.");
                let expected = "a [[exercise.mistake]] that computes what the source does";
                return Some(finding(whole, "shader-unnamed", message).expecting(expected));
            }
        };
        Some(finding(whole, "shader-differs", message))
    }

    /// A place of the text in the file.
    fn place(&self, place: &CodePlace) -> crate::finding::Place {
        let line = self.text.split_inclusive('\n').take(place.line - 1);
        let start: usize = line.map(str::len).sum();
        let rest = &self.text[start..];
        let bytes = |chars: usize| {
            let end = rest.char_indices().nth(chars);
            start + end.map_or(rest.len(), |(at, _)| at)
        };
        let (from, to) = (place.column - 1, place.column - 1 + place.width);
        literal::place_in(
            &self.lesson.source,
            self.text.place,
            self.text,
            bytes(from),
            bytes(to),
        )
    }
}

/// What can be said of a shader without running it.
pub(super) fn check(checker: &mut Checker<'_>, exercise: &Exercise, task: &ShaderTask) {
    if exercise.tolerance.rel < TOLERANCE {
        let message = "f32 cannot promise this tolerance.";
        checker
            .error(exercise.tolerance.place, "tolerance-too-small", message)
            .expected = Some(format!("at least {TOLERANCE}"));
    }
    if exercise.mistakes.is_empty() {
        let message = format!(
            "`{}` names no mistake: the bug in its source is one.",
            exercise.id
        );
        checker
            .error_in(&exercise.id, "too-few-mistakes", message)
            .expected = Some("at least 1".to_owned());
    }
    let names = exercise.draw.iter().map(|it| &it.name);
    for name in names.chain([&task.function]) {
        if !is_identifier(name) {
            let message = format!("`{name}` cannot be a name in WGSL.");
            checker.error_in(name, "not-a-name", message).expected =
                Some("letters, digits and `_`, beginning with a letter".to_owned());
        }
    }
    let lesson = checker.lesson;
    for name in &task.offers {
        let params = shader::params_of(&lesson.library, name);
        if params.is_empty() {
            let near = lesson.library.nearest_callable(name);
            let message = format!("There is no formula `{name}` to offer.");
            checker.error_in(name, "unknown-name", message).expected = near;
            continue;
        }
        let names: Vec<&str> = params.iter().map(String::as_str).collect();
        let call = formula::parse(&format!("{name}()"));
        if let Err(error) = call.and_then(|expr| lesson.library.wgsl(&expr, &names)) {
            let message = format!("`{name}` cannot be offered: {}.", error.message);
            checker.error_in(name, "formula", message);
        }
        if **name == *task.function {
            let message = format!("`{name}` is what is to be written.");
            checker.error_in(name, "id-given-twice", message);
        }
    }
    if !task.scene.is_empty() {
        let given = |name: &str| {
            let of_scene = task.scene.iter().any(|it| it.name.text == name);
            of_scene || super::formulas::OFFERED.contains(&name)
        };
        for variable in exercise.draw.iter().filter(|it| !given(&it.name)) {
            let message = format!(
                "The scene of `{}` gives no `{}`.",
                exercise.id, variable.name
            );
            checker
                .error(task.scene[0].place, "missing-given", message)
                .expected = Some(format!("scene = {{ …, {} = … }}", variable.name));
        }
    }
}

fn is_identifier(name: &str) -> bool {
    let mut letters = name.chars();
    letters
        .next()
        .is_some_and(|first| first.is_ascii_alphabetic())
        && letters.all(|letter| letter.is_ascii_alphanumeric() || letter == '_')
}
