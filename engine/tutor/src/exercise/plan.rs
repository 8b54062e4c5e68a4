//! An exercise compiled: its steps and every mistake as programs over the drawn numbers.

use formula::{Expr, Library, Program};

use super::chain::follow;
use super::random::Random;
use crate::lesson::{Exercise, ExerciseStep, Lesson, Task, Text};

/// Points at which two formulas that agree count as the same.
const POINTS: usize = 64;

/// Whether two numbers can be told apart with a relative tolerance.
pub fn apart(a: f64, b: f64, rel: f64) -> bool {
    (a - b).abs() > rel * (a.abs() + b.abs())
}

/// Steps and mistakes, ready to be evaluated for any numbers drawn.
pub struct Plan<'l> {
    pub lesson: &'l Lesson,
    pub exercise: &'l Exercise,
    pub steps: Vec<PlanStep<'l>>,
    /// Named mistakes first, then mutants.
    pub mistakes: Vec<PlanMistake>,
    where_: Option<Program>,
}

pub struct PlanStep<'l> {
    pub name: &'l str,
    pub is: &'l Expr,
    program: Program,
    /// The same formula, written so that it follows from the numbers of the steps before.
    pub followed: Expr,
    following: Program,
}

/// A mistake that is made in one step.
pub struct PlanMistake {
    pub id: String,
    pub named: bool,
    /// The sentence of a mutant; the author's prose of a named mistake.
    pub says: String,
    /// The step it is made in.
    pub made_in: usize,
    /// The step, then every later one: what comes out when it is made there.
    programs: Vec<Program>,
}

/// Numbers of one try: the variables, then the steps.
pub struct Point {
    pub variables: Vec<f64>,
    pub steps: Vec<f64>,
}

/// The steps of an exercise that asks for numbers; a calculation with a mistake in it is asked
/// as its right lines. Empty for other kinds.
pub fn steps_of(exercise: &Exercise) -> Vec<ExerciseStep> {
    match &exercise.task {
        Task::Numeric { steps } => steps.clone(),
        Task::FindTheMistake { lines, .. } => lines
            .iter()
            .map(|line| ExerciseStep {
                name: line.name.clone(),
                ask: None,
                is: line.right.clone().unwrap_or_else(|| line.is.clone()),
            })
            .collect(),
        // What the function computes.
        Task::Shader(shader) => vec![ExerciseStep {
            name: Text {
                text: "answer".to_owned(),
                place: shader.is.text.place,
            },
            ask: None,
            is: shader.is.clone(),
        }],
        Task::Choice { .. } | Task::Order { .. } | Task::Look(_) => Vec::new(),
    }
}

impl<'l> Plan<'l> {
    /// Compiles an exercise whose `steps` come from [`steps_of`], and its mistakes.
    ///
    /// # Errors
    ///
    /// The first formula that cannot be compiled, as a sentence.
    pub fn new(
        lesson: &'l Lesson,
        exercise: &'l Exercise,
        steps: &'l [ExerciseStep],
    ) -> Result<Plan<'l>, String> {
        let mut plan = Plan::without_mistakes(lesson, exercise, steps)?;
        plan.add_named(steps)?;
        if matches!(exercise.task, Task::Numeric { .. } | Task::Shader(_)) {
            plan.add_mutants(steps);
        }
        plan.drop_alike();
        Ok(plan)
    }

    /// Compiles the steps alone.
    ///
    /// # Errors
    ///
    /// As [`Plan::new`].
    pub fn without_mistakes(
        lesson: &'l Lesson,
        exercise: &'l Exercise,
        steps: &'l [ExerciseStep],
    ) -> Result<Plan<'l>, String> {
        let names = Names::new(exercise, steps);
        let library = &lesson.library;
        let compile = |expr: &Expr, step: usize| compiled(library, expr, names.before(step));
        let mut plan = Plan {
            lesson,
            exercise,
            steps: Vec::new(),
            mistakes: Vec::new(),
            where_: None,
        };
        if let Some(where_) = &exercise.where_ {
            // A condition may speak of the steps too.
            plan.where_ = Some(compile(&where_.expr, steps.len())?);
        }
        for (index, step) in steps.iter().enumerate() {
            let earlier: Vec<(&str, &Expr)> = steps[..index]
                .iter()
                .map(|step| (step.name.text.as_str(), &step.is.expr))
                .collect();
            let program = compile(&step.is.expr, index)?;
            let followed = follow(lesson, &step.is.expr, &earlier);
            let following = compile(&followed, index).unwrap_or_else(|_| program.clone());
            plan.steps.push(PlanStep {
                name: &step.name.text,
                is: &step.is.expr,
                program,
                followed,
                following,
            });
        }
        plan.check_following();
        Ok(plan)
    }

    fn add_named(&mut self, steps: &[ExerciseStep]) -> Result<(), String> {
        let names = Names::new(self.exercise, steps);
        let last = steps.len().saturating_sub(1);
        for mistake in &self.exercise.mistakes {
            let made_in = match &mistake.step {
                None => last,
                Some(name) => steps
                    .iter()
                    .position(|step| step.name.text == name.text)
                    .ok_or_else(|| format!("No step is called `{name}`."))?,
            };
            let library = &self.lesson.library;
            let mut programs = vec![compiled(library, &mistake.is.expr, names.before(made_in))?];
            let later = self.steps.iter().skip(made_in + 1);
            programs.extend(later.map(|step| step.following.clone()));
            self.mistakes.push(PlanMistake {
                id: mistake.id.text.clone(),
                named: true,
                says: mistake.says.text.clone(),
                made_in,
                programs,
            });
        }
        Ok(())
    }

    fn add_mutants(&mut self, steps: &[ExerciseStep]) {
        let names = Names::new(self.exercise, steps);
        let library = &self.lesson.library;
        let uses: Vec<_> = steps.iter().map(|s| library.uses(&s.is.expr)).collect();
        for (made_in, step) in steps.iter().enumerate() {
            for mutant in library.mutants_given(&step.is.expr, names.before(made_in)) {
                let (edited_library, edited) = library.apply(&step.is.expr, &mutant);
                let Ok(first) = edited_library.compile(&edited, names.before(made_in)) else {
                    continue;
                };
                let mut programs = vec![first];
                for later in made_in + 1..steps.len() {
                    let touched = mutant
                        .target()
                        .is_some_and(|target| uses[later].contains(target));
                    let expr = &steps[later].is.expr;
                    let program = touched
                        .then(|| edited_library.compile(expr, names.before(later)).ok())
                        .flatten();
                    programs.push(program.unwrap_or_else(|| self.steps[later].following.clone()));
                }
                let id = match mutant.target() {
                    None if steps.len() > 1 => format!("{}/{}", step.name, mutant.id),
                    _ => mutant.id.clone(),
                };
                self.mistakes.push(PlanMistake {
                    id,
                    named: false,
                    says: mutant.says,
                    made_in,
                    programs,
                });
            }
        }
    }

    /// The formulas that follow from earlier steps must equal the right ones at every point.
    fn check_following(&mut self) {
        let points = self.points();
        for index in 0..self.steps.len() {
            let step = &self.steps[index];
            let same = points.iter().all(|point| {
                let inputs = point.inputs(index);
                let (right, followed) = (step.program.eval(&inputs), step.following.eval(&inputs));
                (right - followed).abs() <= 1e-9 * right.abs()
            });
            if !same {
                self.steps[index].following = self.steps[index].program.clone();
                self.steps[index].followed = self.steps[index].is.clone();
            }
        }
    }

    /// Some points of the exercise's range, those that it may draw where there are such.
    fn points(&self) -> Vec<Point> {
        let mut random = Random::new(0, "points");
        let mut points = Vec::new();
        for attempt in 0..POINTS * 20 {
            let point = self.point(&self.variables(&mut random));
            if self.allowed(&point) {
                points.push(point);
            }
            if points.len() == POINTS || (points.is_empty() && attempt > POINTS * 10) {
                break;
            }
        }
        points
    }

    /// Drops the mutants that nobody could tell from the right formula, from a named mistake
    /// or from an earlier mutant.
    fn drop_alike(&mut self) {
        let points = self.points();
        let rel = self.exercise.tolerance.rel;
        let mut columns: Vec<Vec<f64>> = Vec::new();
        let mut kept: Vec<PlanMistake> = Vec::new();
        for mistake in std::mem::take(&mut self.mistakes) {
            let column: Vec<f64> = points
                .iter()
                .map(|point| mistake.value(point, mistake.made_in))
                .collect();
            let truth = points.iter().map(|point| point.steps[mistake.made_in]);
            let alike = |other: &[f64], rel: f64| {
                column
                    .iter()
                    .zip(other)
                    .all(|(a, b)| !a.is_finite() || !apart(*a, *b, rel))
            };
            let redundant = || {
                kept.iter().zip(&columns).any(|(other, values)| {
                    let rel = if other.named { rel } else { 1e-12 };
                    other.made_in == mistake.made_in && alike(values, rel)
                })
            };
            if !mistake.named && (alike(&truth.collect::<Vec<_>>(), rel) || redundant()) {
                continue;
            }
            columns.push(column);
            kept.push(mistake);
        }
        // The same slip in the same definition, met again in a later step, is one mistake with
        // two places; ids stay unique within a step.
        let mut seen = std::collections::BTreeSet::new();
        for mistake in &mut kept {
            let stem = mistake.id.clone();
            let mut number = 2;
            while !seen.insert((mistake.made_in, mistake.id.clone())) {
                mistake.id = format!("{stem}-{number}");
                number += 1;
            }
        }
        self.mistakes = kept;
    }

    /// Variables drawn at random.
    pub fn variables(&self, random: &mut Random) -> Vec<f64> {
        self.exercise
            .draw
            .iter()
            .map(|variable| {
                let index = random.below(variable.values.len());
                variable.values.get(index).copied().unwrap_or(f64::NAN)
            })
            .collect()
    }

    /// The true values of all steps.
    pub fn point(&self, variables: &[f64]) -> Point {
        let mut inputs = variables.to_vec();
        for step in &self.steps {
            let value = step.program.eval(&inputs);
            inputs.push(value);
        }
        Point {
            variables: variables.to_vec(),
            steps: inputs.split_off(variables.len()),
        }
    }

    /// What a step's right formula gives from these numbers of the steps before it.
    pub fn following(&self, step: usize, variables: &[f64], earlier: &[f64]) -> f64 {
        let inputs = [variables, &earlier[..step]].concat();
        self.steps[step].following.eval(&inputs)
    }

    /// Whether all steps have a value that a relative tolerance makes sense for, and the
    /// author's condition holds.
    pub fn allowed(&self, point: &Point) -> bool {
        let finite = |value: &f64| value.is_finite() && value.abs() > 1e-12;
        point.steps.iter().all(finite) && self.holds(point)
    }

    /// Whether the author's condition holds.
    pub fn holds(&self, point: &Point) -> bool {
        self.where_.as_ref().is_none_or(|where_| {
            let value = where_.eval(&point.inputs(self.steps.len()));
            value.is_finite() && value != 0.0
        })
    }
}

impl Point {
    fn inputs(&self, steps: usize) -> Vec<f64> {
        let mut inputs = self.variables.clone();
        inputs.extend(&self.steps[..steps]);
        inputs
    }
}

impl PlanMistake {
    /// The number that the mistake gives in a step, made in its own step and followed from
    /// there; NaN before its own step.
    pub fn value(&self, point: &Point, step: usize) -> f64 {
        if step < self.made_in {
            return f64::NAN;
        }
        let mut inputs = point.inputs(self.made_in);
        let mut value = f64::NAN;
        for program in &self.programs[..=step - self.made_in] {
            value = program.eval(&inputs);
            inputs.push(value);
        }
        value
    }
}

fn compiled(library: &Library, expr: &Expr, names: &[&str]) -> Result<Program, String> {
    library
        .compile(expr, names)
        .map_err(|error| error.to_string())
}

/// The names that a step may use: the variables, then the steps before it.
struct Names<'l> {
    names: Vec<&'l str>,
    variables: usize,
}

impl<'l> Names<'l> {
    fn new(exercise: &'l Exercise, steps: &'l [ExerciseStep]) -> Names<'l> {
        let variables = exercise.draw.iter().map(|v| v.name.text.as_str());
        let steps = steps.iter().map(|s| s.name.text.as_str());
        Names {
            names: variables.chain(steps).collect(),
            variables: exercise.draw.len(),
        }
    }

    fn before(&self, step: usize) -> &[&'l str] {
        &self.names[..self.variables + step]
    }
}
