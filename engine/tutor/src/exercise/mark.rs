//! Marking an answer: invalid, right, too few digits, right after a slip, a known mistake, off by
//! a common factor, wrong, in this order.

use std::collections::BTreeMap;

use formula::Values;

use super::chain::{nearly_equal, round_to};
use super::plan::{Plan, Point, steps_of};
use super::{Draw, Mistake, digits_kept, percent};
use crate::lesson::{Exercise, Lesson, Task};

/// A factor that answers are often off by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OffBy {
    /// The sign.
    Sign,
    /// A power of ten.
    PowerOfTen,
    /// A factor pi.
    Pi,
    /// A factor 4.
    Four,
}

/// What an answer is.
#[must_use]
#[derive(Clone, Debug, PartialEq)]
pub enum Marking {
    /// Not an answer; costs nothing.
    Invalid {
        /// What to type instead.
        says: String,
    },
    /// Right.
    Correct,
    /// The right value with too few digits.
    Precision {
        /// What is missing.
        says: String,
    },
    /// Right, given an earlier slip.
    Carried {
        /// Where the slip was.
        says: String,
        /// The value that follows from the slip.
        value: f64,
    },
    /// A mistake that is known.
    Mistake {
        /// Its id.
        id: String,
        /// What it is (Markdown).
        says: String,
    },
    /// Several unnamed mistakes give this number: the tutor asks, it does not accuse.
    Ambiguous {
        /// Their ids.
        ids: Vec<String>,
        /// The question asked.
        asks: String,
    },
    /// Off by a common factor.
    Off {
        /// Which one.
        by: OffBy,
        /// The same in words.
        says: String,
    },
    /// Wrong.
    Wrong {
        /// What to try.
        says: String,
    },
}

impl Marking {
    /// `correct`, `carried`, `precision`, `mistake`, `wrong` or `invalid`.
    pub fn result(&self) -> &'static str {
        match self {
            Marking::Invalid { .. } => "invalid",
            Marking::Correct => "correct",
            Marking::Precision { .. } => "precision",
            Marking::Carried { .. } => "carried",
            Marking::Mistake { .. } | Marking::Ambiguous { .. } => "mistake",
            Marking::Off { .. } | Marking::Wrong { .. } => "wrong",
        }
    }

    /// The mistake's id, where exactly one is known.
    pub fn mistake(&self) -> Option<&str> {
        match self {
            Marking::Mistake { id, .. } => Some(id),
            _ => None,
        }
    }

    /// What the tutor says (Markdown).
    pub fn says(&self) -> &str {
        match self {
            Marking::Correct => "Correct.",
            Marking::Ambiguous { asks, .. } => asks,
            Marking::Invalid { says }
            | Marking::Precision { says }
            | Marking::Carried { says, .. }
            | Marking::Mistake { says, .. }
            | Marking::Off { says, .. }
            | Marking::Wrong { says } => says,
        }
    }

    /// Whether the learner may go on.
    pub fn is_right(&self) -> bool {
        matches!(self, Marking::Correct | Marking::Carried { .. })
    }

    fn invalid(says: impl Into<String>) -> Marking {
        Marking::Invalid { says: says.into() }
    }
}

/// Marks an answer to a step, the last one where `step` is none. `earlier` holds the learner's
/// answers to earlier steps as typed, for what follows from a slip.
pub fn mark(
    lesson: &Lesson,
    exercise: &Exercise,
    draw: &Draw,
    step: Option<&str>,
    answer: &str,
    earlier: &BTreeMap<String, String>,
) -> Marking {
    match (&exercise.task, step) {
        (Task::Choice { .. }, _) => super::words::mark_choice(lesson, exercise, draw, answer),
        (Task::Order { .. }, _) => super::words::mark_order(draw, answer),
        (Task::FindTheMistake { lines, .. }, Some("line")) => {
            super::words::mark_line(lesson, lines, answer)
        }
        // Nothing is run here: `mark_shader` takes what came of it.
        (Task::Look(_), _) => Marking::invalid("A place is marked by what is seen there."),
        (Task::Shader(_), _) => Marking::invalid("A shader is marked by what it computes."),
        _ => mark_number(lesson, exercise, draw, step, answer, earlier),
    }
}

fn mark_number(
    lesson: &Lesson,
    exercise: &Exercise,
    draw: &Draw,
    step: Option<&str>,
    answer: &str,
    earlier: &BTreeMap<String, String>,
) -> Marking {
    let steps = steps_of(exercise);
    let plan = match Plan::without_mistakes(lesson, exercise, &steps) {
        Ok(plan) => plan,
        Err(message) => return Marking::invalid(message),
    };
    let asked = match step {
        None => draw.steps.last(),
        Some(name) => draw.steps.iter().find(|it| it.name == name),
    };
    let Some(asked) = asked else {
        let names: Vec<&str> = draw.steps.iter().map(|it| it.name.as_str()).collect();
        return Marking::invalid(format!(
            "No step is called `{}`; there are {}.",
            step.unwrap_or_default(),
            names.join(", ")
        ));
    };
    // In a calculation with a mistake the answer is the last of the right lines.
    let index = steps
        .iter()
        .position(|it| it.name.text == asked.name)
        .unwrap_or(steps.len().saturating_sub(1));
    let marker = Marker {
        lesson,
        exercise,
        draw,
        plan: &plan,
        point: plan.point(&in_order(exercise, &draw.given)),
        index,
        truth: asked.truth,
        step: &asked.name,
    };
    marker.mark(answer, earlier)
}

fn in_order(exercise: &Exercise, given: &Values) -> Vec<f64> {
    exercise
        .draw
        .iter()
        .map(|variable| given.get(&variable.name.text).copied().unwrap_or(f64::NAN))
        .collect()
}

/// Whether an answer is near enough, the boundary included. The last factor takes up the
/// rounding of the boundary itself.
fn near(answer: f64, truth: f64, rel: f64) -> bool {
    (answer - truth).abs() <= rel * truth.abs() * (1.0 + 1e-12)
}

struct Marker<'a> {
    lesson: &'a Lesson,
    exercise: &'a Exercise,
    draw: &'a Draw,
    plan: &'a Plan<'a>,
    point: Point,
    /// The step asked for.
    index: usize,
    truth: f64,
    step: &'a str,
}

impl Marker<'_> {
    fn near(&self, answer: f64, truth: f64) -> bool {
        near(answer, truth, self.exercise.tolerance.rel)
    }

    fn mark(&self, answer: &str, earlier: &BTreeMap<String, String>) -> Marking {
        let typed = self.earlier_values(earlier);
        let value = match self.read(answer, &typed) {
            Ok(value) => value,
            Err(says) => return Marking::invalid(says),
        };
        if self.near(value, self.truth) {
            return Marking::Correct;
        }
        let followed = self.followed(&typed);
        if let Some((carried, None)) = followed
            && self.near(value, carried)
        {
            // Every earlier answer was accepted: what follows from them is right.
            return Marking::Correct;
        }
        self.too_few_digits(answer, value)
            .or_else(|| self.carried(value, followed))
            .or_else(|| self.known_mistake(value, followed))
            .or_else(|| self.off_by_a_factor(value))
            .unwrap_or_else(|| self.wrong(value))
    }

    /// The learner's numbers for the steps before, where they can be read.
    fn earlier_values(&self, earlier: &BTreeMap<String, String>) -> Vec<Option<f64>> {
        let mut typed: Vec<Option<f64>> = Vec::new();
        for step in &self.plan.steps[..self.index] {
            let value = earlier
                .get(step.name)
                .and_then(|text| self.read(text, &typed).ok());
            typed.push(value);
        }
        typed
    }

    /// Arithmetic over the given numbers and the steps before: the learner's own numbers, and
    /// what follows from them where he had none to find.
    fn read(&self, text: &str, typed: &[Option<f64>]) -> Result<f64, String> {
        let mut known = self.draw.given.clone();
        for (step, value) in self.plan.steps.iter().zip(self.values(typed)) {
            known.entry(step.name.to_owned()).or_insert(value);
        }
        if text.trim().is_empty() {
            return Err("Type a number, or arithmetic such as `0.4^4`.".to_owned());
        }
        let names: Vec<&str> = known.keys().map(String::as_str).collect();
        let value = formula::parse_answer(text, &names)
            .and_then(|expr| self.lesson.library.eval(&expr, &known));
        match value {
            Ok(value) if value.is_finite() => Ok(value),
            Ok(_) => Err("This has no finite value.".to_owned()),
            Err(error) => Err(sentence(&error.to_string())),
        }
    }

    /// The steps before, each as typed, or as it follows from those before it.
    fn values(&self, typed: &[Option<f64>]) -> Vec<f64> {
        let mut values: Vec<f64> = Vec::new();
        for (index, typed) in typed.iter().enumerate() {
            let following = || self.plan.following(index, &self.point.variables, &values);
            let value = typed.unwrap_or_else(following);
            values.push(value);
        }
        values
    }

    /// What follows from the learner's earlier numbers, and the first step among them that was
    /// not right. None where there are no earlier numbers.
    fn followed(&self, typed: &[Option<f64>]) -> Option<(f64, Option<usize>)> {
        let values = self.values(typed);
        let slip = typed
            .iter()
            .zip(&self.point.steps)
            .position(|(typed, truth)| typed.is_some_and(|value| !self.near(value, *truth)));
        typed.iter().any(Option::is_some).then(|| {
            let value = self
                .plan
                .following(self.index, &self.point.variables, &values);
            (value, slip)
        })
    }

    fn too_few_digits(&self, answer: &str, value: f64) -> Option<Marking> {
        let digits = formula::significant_digits(answer)?;
        let same = |other: f64| nearly_equal(value, other);
        let cut = || {
            let scale = 10_f64.powi(digits as i32 - 1 - self.truth.abs().log10().floor() as i32);
            (self.truth * scale).trunc() / scale
        };
        if value == 0.0 || !(same(round_to(self.truth, digits)) || (digits > 1 && same(cut()))) {
            return None;
        }
        let wanted = digits_kept(self.exercise).max(digits + 1);
        Some(Marking::Precision {
            says: format!(
                "The value is right, but {} too few: give at least {wanted}.",
                match digits {
                    1 => "one digit is".to_owned(),
                    n => format!("{n} digits are"),
                }
            ),
        })
    }

    fn carried(&self, value: f64, followed: Option<(f64, Option<usize>)>) -> Option<Marking> {
        let (carried, slip) = followed?;
        let slip = self.draw.steps.get(slip?)?;
        if !carried.is_finite() || !self.near(value, carried) {
            return None;
        }
        Some(Marking::Carried {
            says: format!(
                "This follows correctly from your {}, so it counts. The slip is there: with the \
                 right {} it would be {}.",
                slip.ask,
                slip.ask,
                formula::format_number(self.truth, formula::Digits::Significant(4)),
            ),
            value: carried,
        })
    }

    fn known_mistake(&self, value: f64, followed: Option<(f64, Option<usize>)>) -> Option<Marking> {
        let distance = |it: &Mistake| (value - it.value).abs() / it.value.abs();
        // Whoever had the earlier steps right is not asked about slips in them.
        let right_so_far = matches!(followed, Some((_, None)));
        let mut met: Vec<&Mistake> = self
            .draw
            .mistakes
            .iter()
            .filter(|it| it.step == self.step && self.near(value, it.value))
            .filter(|it| it.named || !(it.made_before && right_so_far))
            .collect();
        met.sort_by(|a, b| {
            (!a.named, distance(a))
                .partial_cmp(&(!b.named, distance(b)))
                .unwrap_or(std::cmp::Ordering::Equal)
        });
        let first = met.first()?;
        if first.named || met.len() == 1 {
            return Some(Marking::Mistake {
                id: first.id.clone(),
                says: first.says.clone(),
            });
        }
        let guesses: Vec<String> = met
            .iter()
            .take(3)
            .map(|it| format!("- {}", it.says))
            .collect();
        Some(Marking::Ambiguous {
            ids: met.iter().map(|it| it.id.clone()).collect(),
            asks: format!(
                "Not yet. More than one slip leads to this number. Could it be one of these?\n\n{}",
                guesses.join("\n")
            ),
        })
    }

    fn off_by_a_factor(&self, value: f64) -> Option<Marking> {
        let pi = std::f64::consts::PI;
        let ten = (value / self.truth).abs().log10().round();
        let power = 10_f64.powf(ten);
        let off = |by, says: &str| {
            Some(Marking::Off {
                by,
                says: says.to_owned(),
            })
        };
        if self.near(-value, self.truth) {
            return off(OffBy::Sign, "The size is right, the sign is not.");
        }
        if ten != 0.0 && ten.abs() <= 12.0 && self.near(value / power, self.truth) {
            let says =
                "The digits are right; it is off by a power of ten. Look at the decimal point.";
            return off(OffBy::PowerOfTen, says);
        }
        if self.near(value * pi, self.truth) || self.near(value / pi, self.truth) {
            return off(OffBy::Pi, "It is off by a factor π. Where does π belong?");
        }
        if self.near(value * 4.0, self.truth) || self.near(value / 4.0, self.truth) {
            return off(
                OffBy::Four,
                "It is off by a factor 4. Where does the 4 belong?",
            );
        }
        None
    }

    fn wrong(&self, value: f64) -> Marking {
        let side = if value > self.truth { "large" } else { "small" };
        Marking::Wrong {
            says: format!(
                "Not yet: this is too {side}. An answer within {} % counts.",
                percent(self.exercise.tolerance.rel)
            ),
        }
    }
}

/// A sentence: a capital letter first, unless it begins with a name of the formula language,
/// and a full stop or question mark last.
pub(crate) fn sentence(text: &str) -> String {
    let first: String = text
        .chars()
        .take_while(|c| c.is_alphanumeric() || *c == '_')
        .collect();
    let names_code =
        first == "pi" || first.contains('_') || formula::builtin_names().any(|name| name == first);
    let text = match names_code {
        true => text.trim().trim_end_matches('.').to_owned(),
        false => crate::load::capitalised(text),
    };
    let end = if text.ends_with('?') { "" } else { "." };
    format!("{text}{end}")
}
