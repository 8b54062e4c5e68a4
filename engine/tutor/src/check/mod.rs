//! Everything `lobe check` says about lessons beyond reading them: every number against the
//! core, every reference, every exercise drawn, every example judged.

mod dialogue;
mod draws;
mod formulas;
pub mod looks;
mod names;
mod numbers;
mod scenes;
pub mod shaders;
mod texts;

use formula::{Expr, Values};

use crate::exercise::sentence;
use crate::finding::{Finding, Place};
use crate::lesson::{Formula, Lesson, Text};
use crate::load::literal;

pub use draws::DrawCount;

/// What a check of one lesson found.
#[derive(Clone, Debug, Default)]
pub struct Report {
    /// What is wrong, in the file's order.
    pub findings: Vec<Finding>,
    /// How many draws of each numeric exercise are accepted.
    pub draws: Vec<DrawCount>,
}

/// What is wrong with one lesson.
pub fn check(lesson: &Lesson) -> Vec<Finding> {
    report(lesson).findings
}

/// What is wrong with lessons, each alone and all together.
pub fn check_all(lessons: &[Lesson]) -> Vec<Finding> {
    let mut findings: Vec<Finding> = lessons.iter().flat_map(check).collect();
    findings.extend(together(&lessons.iter().collect::<Vec<_>>()));
    findings
}

/// What is wrong between lessons: what one needs, and another has. Meant for all of a folder
/// together: a file checked alone cannot know the others.
pub fn together(lessons: &[&Lesson]) -> Vec<Finding> {
    names::together(lessons)
}

/// What is wrong with one lesson, and how its exercises draw.
pub fn report(lesson: &Lesson) -> Report {
    let mut checker = Checker {
        lesson,
        findings: Vec::new(),
    };
    names::check(&mut checker);
    formulas::check(&mut checker);
    numbers::check(&mut checker);
    scenes::check(&mut checker);
    texts::check(&mut checker);
    dialogue::check(&mut checker);
    let draws = draws::check(&mut checker);
    for explain in &lesson.explain {
        for finding in crate::judge::check_examples(&explain.rubric) {
            let place = explain
                .example_places
                .get(finding.example)
                .map_or(explain.id.place, |places| places.of("verdict"));
            checker.error(place, "example-judged-otherwise", finding.message);
        }
    }
    let mut findings = checker.findings;
    findings.sort_by(|a, b| (a.start, a.end, a.code).cmp(&(b.start, b.end, b.code)));
    findings.dedup();
    Report { findings, draws }
}

/// Collects findings about one lesson.
struct Checker<'l> {
    lesson: &'l Lesson,
    findings: Vec<Finding>,
}

impl<'l> Checker<'l> {
    fn error(
        &mut self,
        place: Place,
        code: &'static str,
        message: impl Into<String>,
    ) -> &mut Finding {
        let finding = Finding::new(&self.lesson.file, &self.lesson.source, place, code, message);
        self.findings.push(finding);
        let last = self.findings.len() - 1;
        &mut self.findings[last]
    }

    /// An error about a string: its place is what stands between the quotes.
    fn error_in(
        &mut self,
        text: &Text,
        code: &'static str,
        message: impl Into<String>,
    ) -> &mut Finding {
        let place = self.place_in(text, 0, text.text.len());
        self.error(place, code, message)
    }

    fn place_in(&self, text: &Text, start: usize, end: usize) -> Place {
        literal::place_in(&self.lesson.source, text.place, &text.text, start, end)
    }

    fn formula_error(&mut self, text: &Text, error: &formula::Error) {
        let place = self.place_in(text, error.span.start, error.span.end);
        let help = error.help.clone();
        self.error(place, "formula", sentence(&error.message)).help = help;
    }

    /// All errors of an expression over these names; whether there are none.
    fn expression(&mut self, formula: &Formula, names: &[&str]) -> bool {
        let errors = self.lesson.library.check_expr(&formula.expr, names);
        for error in &errors {
            self.formula_error(&formula.text, error);
        }
        errors.is_empty()
    }

    /// The value of an expression; an error becomes a finding.
    fn value(&mut self, formula: &Formula, values: &Values) -> Option<f64> {
        let names: Vec<&str> = values.keys().map(String::as_str).collect();
        if !self.expression(formula, &names) {
            return None;
        }
        match self.eval(&formula.expr, values) {
            Ok(value) => Some(value),
            Err(error) => {
                self.formula_error(&formula.text, &error);
                None
            }
        }
    }

    fn eval(&self, expr: &Expr, values: &Values) -> Result<f64, formula::Error> {
        self.lesson.library.eval(expr, values)
    }
}
