//! Drawing the numbers: rejected unless they tell the mistakes apart.

use formula::Values;

use super::chain::{nearly_equal, round_to, rounded};
use super::plan::{Plan, Point, apart, steps_of};
use super::random::Random;
use super::{Draw, Mistake, NoDraw, StepTruth, Truth, digits_kept};
use crate::lesson::{ChoiceOption, Exercise, ExerciseStep, Lesson, SuspectLine, Task, Text};
use crate::prose::{plain, plain_blocks};

/// After so many tries there are no numbers that would do.
pub const MOST_TRIES: u32 = 10_000;

/// Draws an exercise's numbers from a seed.
///
/// # Errors
///
/// When 10,000 tries give no numbers that tell the mistakes apart, or a formula of the exercise
/// cannot be evaluated at all.
pub fn draw(lesson: &Lesson, exercise: &Exercise, seed: u64) -> Result<Draw, NoDraw> {
    let steps = steps_of(exercise);
    let plan = Plan::new(lesson, exercise, &steps).map_err(|message| NoDraw { message })?;
    plan.draw(seed, &steps)
}

impl Plan<'_> {
    /// Draws numbers from a seed.
    ///
    /// # Errors
    ///
    /// When 10,000 tries give none.
    pub fn draw(&self, seed: u64, steps: &[ExerciseStep]) -> Result<Draw, NoDraw> {
        let mut random = Random::new(seed, &self.exercise.id);
        for tries in 1..=MOST_TRIES {
            let variables = self.variables(&mut random);
            let point = self.point(&variables);
            if self.accepts(&point) {
                let drawn = match &self.exercise.task {
                    Task::Numeric { .. } | Task::Shader(_) => Some(self.numeric(&point, steps)),
                    Task::Choice { options } => self.choice(&point, options, &mut random),
                    Task::Order { items } => Some(self.order(&point, items, &mut random)),
                    Task::FindTheMistake { lines, .. } => self.suspects(&point, lines),
                    // Nothing is drawn but the picture.
                    Task::Look(_) => Some(self.blank(&point, Truth::Order(Vec::new()))),
                };
                if let Some(drawn) = drawn {
                    return Ok(Draw {
                        seed,
                        tries,
                        ..drawn
                    });
                }
            }
            if self.exercise.draw.iter().all(|it| it.values.len() == 1) {
                break;
            }
        }
        Err(NoDraw {
            message: format!(
                "No numbers of {} tell all of its mistakes apart.",
                self.exercise.id
            ),
        })
    }

    /// Whether numbers tell every mistake apart from the truth in the step it is made in, and
    /// the named ones from each other, and are kind to learners who round.
    pub fn accepts(&self, point: &Point) -> bool {
        let rel = self.exercise.tolerance.rel;
        if !self.allowed(point) {
            return false;
        }
        let mut named: Vec<(usize, f64)> = Vec::new();
        for mistake in &self.mistakes {
            let value = mistake.value(point, mistake.made_in);
            if !value.is_finite() {
                continue;
            }
            let truth = point.steps[mistake.made_in];
            // A mistake of 0.5 would pass for a truth of 0.51 with too few digits.
            let short =
                mistake.named && (1..=3).any(|digits| nearly_equal(value, round_to(truth, digits)));
            if short || !apart(value, truth, rel) {
                return false;
            }
            if mistake.named {
                let mut others = named.iter().filter(|(step, _)| *step == mistake.made_in);
                if others.any(|(_, other)| !apart(value, *other, rel)) {
                    return false;
                }
                named.push((mistake.made_in, value));
            }
        }
        // Nobody rounds in a shader.
        matches!(self.exercise.task, Task::Shader(_)) || self.kind_to_rounding(point)
    }

    /// Whether somebody who keeps the digits that he is told to keep stays within the tolerance,
    /// the last rounding included.
    pub fn kind_to_rounding(&self, point: &Point) -> bool {
        let rel = self.exercise.tolerance.rel;
        self.kept(point)
            .iter()
            .zip(&point.steps)
            .all(|(kept, truth)| (kept - truth).abs() <= rel * truth.abs())
    }

    /// The steps' values for somebody who keeps so many digits all along.
    pub fn kept(&self, point: &Point) -> Vec<f64> {
        let digits = digits_kept(self.exercise);
        let mut known = self.given(point);
        self.steps
            .iter()
            .map(|step| {
                let value = rounded(&self.lesson.library, &step.followed, &known, digits);
                known.insert(step.name.to_owned(), value);
                value
            })
            .collect()
    }

    /// The variables by name.
    pub fn given(&self, point: &Point) -> Values {
        self.exercise
            .draw
            .iter()
            .zip(&point.variables)
            .map(|(variable, value)| (variable.name.text.clone(), *value))
            .collect()
    }

    /// The variables and the true steps by name.
    fn known(&self, point: &Point) -> Values {
        let mut known = self.given(point);
        let steps = self.steps.iter().zip(&point.steps);
        known.extend(steps.map(|(step, value)| (step.name.to_owned(), *value)));
        known
    }

    /// The mistakes that are recognised in each step: those made in it, and those made before it
    /// where they can be told from everything else there.
    fn recognised(&self, point: &Point) -> Vec<Mistake> {
        let rel = self.exercise.tolerance.rel;
        let known = self.known(point);
        let mut found: Vec<Mistake> = Vec::new();
        for (index, step) in self.steps.iter().enumerate() {
            let last = index + 1 == self.steps.len();
            let here = self.mistakes.iter().filter(|m| m.made_in == index);
            let before = self.mistakes.iter().filter(|m| last && m.made_in < index);
            let named = |it: &&super::plan::PlanMistake| it.named;
            let order = here
                .clone()
                .filter(named)
                .chain(before.clone().filter(named))
                .chain(here.filter(|it| !it.named))
                .chain(before.filter(|it| !it.named));
            let first = found.len();
            for mistake in order {
                let value = mistake.value(point, index);
                let same_id = found[first..].iter().any(|it| it.id == mistake.id);
                // A mistake that meets a named one goes by that name.
                let taken = found[first..]
                    .iter()
                    .any(|it| it.named && !apart(it.value, value, rel));
                if !value.is_finite() || taken || same_id || !apart(value, point.steps[index], rel)
                {
                    continue;
                }
                let says = if mistake.named {
                    self.lesson.filled(&mistake.says, &known)
                } else {
                    mistake.says.clone()
                };
                found.push(Mistake {
                    id: mistake.id.clone(),
                    step: step.name.to_owned(),
                    value,
                    named: mistake.named,
                    made_before: mistake.made_in < index,
                    says,
                });
            }
        }
        found
    }

    fn blank(&self, point: &Point, truth: Truth) -> Draw {
        let given = self.given(point);
        let ask = self.lesson.prose(&self.exercise.ask, &given);
        Draw {
            seed: 0,
            prompt: plain_blocks(&ask),
            given,
            steps: Vec::new(),
            truth,
            shown: Vec::new(),
            mistakes: Vec::new(),
            tries: 0,
        }
    }

    fn numeric(&self, point: &Point, steps: &[ExerciseStep]) -> Draw {
        let digits = formula::Digits::Significant(digits_kept(self.exercise).max(4));
        let truths = steps.iter().zip(&point.steps).map(|(step, &truth)| {
            let ask = match &step.ask {
                Some(ask) => plain(&self.lesson.inline(ask, &self.given(point))),
                None => self.lesson.spelled(&step.name),
            };
            StepTruth {
                name: step.name.text.clone(),
                ask,
                truth,
                shown: formula::format_number(truth, digits),
            }
        });
        let truth = point.steps.last().copied().unwrap_or(f64::NAN);
        Draw {
            steps: truths.collect(),
            mistakes: self.recognised(point),
            ..self.blank(point, Truth::Number(truth))
        }
    }

    fn choice(&self, point: &Point, options: &[ChoiceOption], random: &mut Random) -> Option<Draw> {
        let given = self.given(point);
        let texts: Vec<String> = options
            .iter()
            .map(|option| plain(&self.lesson.inline(&option.text, &given)))
            .collect();
        // Two options that read the same cannot be told apart.
        let distinct: std::collections::BTreeSet<&String> = texts.iter().collect();
        if distinct.len() < texts.len() {
            return None;
        }
        let order = random.order(options.len());
        let right = order.iter().position(|&index| options[index].right)?;
        Some(Draw {
            shown: order.iter().map(|&index| texts[index].clone()).collect(),
            ..self.blank(point, Truth::Choice(right))
        })
    }

    fn order(&self, point: &Point, items: &[Text], random: &mut Random) -> Draw {
        let given = self.given(point);
        let mut order = random.order(items.len());
        if order.iter().enumerate().all(|(at, &item)| at == item) {
            order.rotate_left(1);
        }
        let shown = order
            .iter()
            .map(|&item| plain(&self.lesson.inline(&items[item], &given)))
            .collect();
        let right = (0..items.len())
            .filter_map(|item| order.iter().position(|&other| other == item))
            .collect();
        Draw {
            shown,
            ..self.blank(point, Truth::Order(right))
        }
    }

    /// A calculation with its wrong line, and everything after it faithfully wrong.
    fn suspects(&self, point: &Point, lines: &[SuspectLine]) -> Option<Draw> {
        let rel = self.exercise.tolerance.rel;
        let mut known = self.given(point);
        let mut shown = Vec::new();
        for line in lines {
            let value = self.lesson.library.eval(&line.is.expr, &known).ok()?;
            known.insert(line.name.text.clone(), value);
            shown.push(format!(
                "{} = {} = {}",
                self.lesson.spelled(&line.name),
                self.lesson.library.unicode(&line.is.expr),
                formula::format_number(value, formula::Digits::Significant(4)),
            ));
        }
        let as_shown = *known.get(&lines.last()?.name.text)?;
        let wrong = lines.iter().position(|line| line.right.is_some())?;
        let truth = *point.steps.last()?;
        if !apart(as_shown, truth, rel) {
            return None;
        }
        let last = self.steps.last()?.name;
        let mut mistakes = vec![Mistake {
            id: "as-shown".to_owned(),
            step: "answer".to_owned(),
            value: as_shown,
            named: true,
            made_before: false,
            says: "That is the number as it stands there, with the wrong line still in it."
                .to_owned(),
        }];
        for mistake in self.recognised(point) {
            if mistake.step == last && apart(mistake.value, as_shown, rel) {
                mistakes.push(Mistake {
                    step: "answer".to_owned(),
                    ..mistake
                });
            }
        }
        let steps = vec![
            StepTruth {
                name: "line".to_owned(),
                ask: "number of the wrong line".to_owned(),
                truth: (wrong + 1) as f64,
                shown: (wrong + 1).to_string(),
            },
            StepTruth {
                name: "answer".to_owned(),
                ask: format!("right {}", self.lesson.spelled(last)),
                truth,
                shown: formula::format_number(truth, formula::Digits::Significant(4)),
            },
        ];
        Some(Draw {
            steps,
            shown,
            mistakes,
            ..self.blank(point, Truth::Number(truth))
        })
    }
}
