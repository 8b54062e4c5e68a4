//! Shaders to be mended: where they are run, and what is said about what they computed.
//!
//! Nothing is run here. A [`Job`] says what to run; whoever can, answers with a [`Ran`].

use formula::{Digits, Library, format_number};
use serde::{Deserialize, Serialize};

use super::cosines::Cosines;
use super::plan::{Plan, PlanMistake, Point, steps_of};
use super::random::Random;
use super::{Marking, OffBy};
use crate::lesson::{Exercise, Lesson, ShaderTask, Task};

/// So many points are tried at random, besides the corners.
const RANDOM_POINTS: usize = 96;
/// Corners of the range, at most.
const MOST_CORNERS: usize = 64;
/// Draws for each of them, at most: ranges may leave few directions.
const MOST_TRIES: usize = 20;
/// Numbers nearer to zero than this are zero: f32 keeps no relative precision in differences.
const ZERO: f64 = 1e-7;

/// What is to be run: a function of a text, at points.
#[derive(Serialize, Deserialize, Clone, Debug, Default, PartialEq)]
pub struct Job {
    /// The learner's text.
    pub source: String,
    /// Functions that it may call, in WGSL.
    pub offered: String,
    /// The function.
    pub function: String,
    /// Names of its parameters.
    pub params: Vec<String>,
    /// The arguments of every call.
    pub points: Vec<Vec<f32>>,
}

/// What came of running a text.
#[derive(Serialize, Deserialize, Clone, Debug, PartialEq)]
pub enum Ran {
    /// What the function returned at each point.
    Values(Vec<f32>),
    /// The text is not WGSL, or not this function.
    Refused {
        /// One sentence.
        says: String,
        /// What to do about it.
        help: Option<String>,
        /// Where.
        place: Option<CodePlace>,
    },
    /// The function came to no end, or ended the process that ran it.
    Stopped {
        /// The point at which it did, where that is known.
        point: Option<usize>,
        /// One sentence.
        says: String,
    },
    /// It could not be run, which is not the text's fault.
    Unable(String),
}

/// A place in a text.
#[derive(Serialize, Deserialize, Clone, Debug, PartialEq, Eq)]
pub struct CodePlace {
    /// From 1.
    pub line: usize,
    /// In characters, from 1.
    pub column: usize,
    /// In characters.
    pub width: usize,
    /// The line, or the part of it around the place.
    pub text: String,
    /// Where it is in `text`, in characters from 1.
    pub mark: usize,
}

/// The shader of an exercise, where it is one.
pub fn task(exercise: &Exercise) -> Option<&ShaderTask> {
    match &exercise.task {
        Task::Shader(shader) => Some(shader),
        _ => None,
    }
}

/// What is to be run for an answer; `None` where the exercise is no shader or its formulas do not
/// compile, which `lobe check` finds first.
pub fn job(lesson: &Lesson, exercise: &Exercise, seed: u64, source: &str) -> Option<Job> {
    let trial = Trial::new(lesson, exercise, seed)?;
    Some(Job {
        points: trial.points.iter().map(arguments).collect(),
        ..call(lesson, exercise, source)?
    })
}

/// The same without points, for whoever brings his own.
pub fn call(lesson: &Lesson, exercise: &Exercise, source: &str) -> Option<Job> {
    let shader = task(exercise)?;
    let names = exercise.draw.iter().map(|it| it.name.text.clone());
    Some(Job {
        source: source.to_owned(),
        offered: offered(lesson, shader, source),
        function: shader.function.text.clone(),
        params: names.collect(),
        points: Vec::new(),
    })
}

/// The functions offered, by the names that lessons call them by. One that the learner writes
/// himself is left to him.
fn offered(lesson: &Lesson, shader: &ShaderTask, source: &str) -> String {
    let mut parts: Vec<String> = Vec::new();
    let mut formulas = Vec::new();
    for name in &shader.offers {
        let params = params_of(&lesson.library, name);
        if defines(source, name) || params.is_empty() {
            continue;
        }
        let names: Vec<&str> = params.iter().map(String::as_str).collect();
        let call = formula::parse(&format!("{name}()"));
        let Some(wgsl) = call
            .ok()
            .and_then(|expr| lesson.library.wgsl(&expr, &names).ok())
        else {
            continue;
        };
        let list: Vec<String> = params.iter().map(|name| format!("{name}: f32")).collect();
        parts.push(format!(
            "fn {name}({}) -> f32 {{\n    return {};\n}}\n",
            list.join(", "),
            wgsl.expr
        ));
        formulas.push(wgsl);
    }
    let inner = formula::Wgsl::functions_of(&formulas.iter().collect::<Vec<_>>());
    format!("{inner}{}", parts.concat())
}

/// The parameters of a function of the core or of the lesson; none where there is no such one.
pub(crate) fn params_of(library: &Library, name: &str) -> Vec<String> {
    match library.definition(name) {
        Some(definition) => definition.params.clone(),
        None => brdf::term(name).map_or_else(Vec::new, |term| {
            let params = term.params.iter();
            params.map(|param| param.name.to_owned()).collect()
        }),
    }
}

/// Whether a text defines a function of that name.
fn defines(source: &str, name: &str) -> bool {
    source.match_indices("fn").any(|(at, _)| {
        let before = source[..at].chars().next_back();
        let rest = &source[at + 2..];
        let found = rest.trim_start().strip_prefix(name);
        let apart = before.is_none_or(|letter| !letter.is_alphanumeric() && letter != '_');
        let ends = found.is_some_and(|rest| rest.trim_start().starts_with('('));
        apart && rest.starts_with(char::is_whitespace) && ends
    })
}

fn arguments(point: &Point) -> Vec<f32> {
    point.variables.iter().map(|value| *value as f32).collect()
}

/// The points at which a function is tried, with what is right there.
struct Trial<'l> {
    lesson: &'l Lesson,
    exercise: &'l Exercise,
    /// Where the right formula has a value.
    points: Vec<Point>,
    mistakes: Vec<PlanMistake>,
}

impl<'l> Trial<'l> {
    fn new(lesson: &'l Lesson, exercise: &'l Exercise, seed: u64) -> Option<Trial<'l>> {
        let shader = task(exercise)?;
        let steps = steps_of(exercise);
        let plan = Plan::new(lesson, exercise, &steps).ok()?;
        let mut random = Random::new(seed, &shader.function);
        let points = candidates(exercise, &mut random).into_iter();
        let points = points.map(|variables| plan.point(&variables));
        let points: Vec<Point> = points.filter(|point| plan.tries(point)).collect();
        let mistakes = plan.mistakes;
        (!points.is_empty()).then_some(Trial {
            lesson,
            exercise,
            points,
            mistakes,
        })
    }

    fn truth(point: &Point) -> f64 {
        point.steps.first().copied().unwrap_or(f64::NAN)
    }

    fn near(&self, value: f64, truth: f64) -> bool {
        let rel = self.exercise.tolerance.rel;
        (value - truth).abs() <= rel * truth.abs() + ZERO
    }

    /// Whether these are the values of a mistake: where it has none, neither have they.
    fn is(&self, mistake: &PlanMistake, values: &[f64]) -> bool {
        self.points.iter().zip(values).all(|(point, &value)| {
            let expected = mistake.value(point, 0);
            if expected.is_finite() {
                self.near(value, expected)
            } else {
                !value.is_finite()
            }
        })
    }

    /// `n_dot_l = 0.05, n_dot_v = 1, roughness = 0.4`, by the names in the text.
    fn spelled(&self, point: &Point) -> String {
        let variables = self.exercise.draw.iter().zip(&point.variables);
        let parts: Vec<String> = variables
            .map(|(variable, value)| {
                let value = crate::prose::shortest(f64::from(*value as f32 * 1e6).round() / 1e6);
                format!("{} = {value}", variable.name)
            })
            .collect();
        format!("`{}`", parts.join(", "))
    }

    fn mark(&self, values: &[f64]) -> Marking {
        let right: Vec<bool> = self
            .points
            .iter()
            .zip(values)
            .map(|(point, value)| self.near(*value, Self::truth(point)))
            .collect();
        if right.iter().all(|right| *right) {
            return Marking::Correct;
        }
        let evidence = self.evidence(values, &right);
        self.known(values, &evidence)
            .or_else(|| self.scaled(values, &evidence))
            .unwrap_or(Marking::Wrong {
                says: format!("Not yet: it {evidence}"),
            })
    }

    fn known(&self, values: &[f64], evidence: &str) -> Option<Marking> {
        let met = self.mistakes.iter().filter(|it| self.is(it, values));
        let met: Vec<&PlanMistake> = met.collect();
        let first = met.iter().find(|it| it.named).or(met.first())?;
        let all: formula::Values = Default::default();
        if first.named || met.len() == 1 {
            let says = match first.named {
                true => self.lesson.filled(&first.says, &all),
                false => first.says.clone(),
            };
            return Some(Marking::Mistake {
                id: first.id.clone(),
                says: format!("{}\n\nIt {evidence}", says.trim_end()),
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
                "Not yet. More than one slip computes this. Could it be one of these?\n\n{}",
                guesses.join("\n")
            ),
        })
    }

    /// Everywhere the same number of times too large.
    fn scaled(&self, values: &[f64], evidence: &str) -> Option<Marking> {
        let ratios = self.points.iter().zip(values).filter_map(|(point, value)| {
            let truth = Self::truth(point);
            (truth.abs() > 1e3 * ZERO).then_some(value / truth)
        });
        let ratios: Vec<f64> = ratios.collect();
        let factor = *ratios.get(ratios.len() / 2)?;
        let rel = self.exercise.tolerance.rel;
        let same = |ratio: &f64| (ratio - factor).abs() <= rel * factor.abs();
        if factor == 0.0 || !factor.is_finite() || !ratios.iter().all(same) {
            return None;
        }
        let is = |other: f64| (factor - other).abs() <= rel * other.abs();
        let off = |by, says: &str| {
            Some(Marking::Off {
                by,
                says: format!("{says} It {evidence}"),
            })
        };
        let pi = std::f64::consts::PI;
        if is(-1.0) {
            return off(
                OffBy::Sign,
                "The size is right everywhere, the sign is not.",
            );
        }
        if is(pi) || is(1.0 / pi) {
            return off(
                OffBy::Pi,
                "It is off by a factor π everywhere. Where does π belong?",
            );
        }
        if is(4.0) || is(0.25) {
            return off(
                OffBy::Four,
                "It is off by a factor 4 everywhere. Where does the 4 belong?",
            );
        }
        let factor = format_number(factor, Digits::Significant(4));
        Some(Marking::Wrong {
            says: format!(
                "Not yet: it gives {factor} times what is right, everywhere; so it is a constant \
                 that is wrong, not the shape. It {evidence}"
            ),
        })
    }

    /// At how many points it is right, and the one where it is worst; begins in the middle of a
    /// sentence.
    fn evidence(&self, values: &[f64], right: &[bool]) -> String {
        let count = right.iter().filter(|right| **right).count();
        let total = right.len();
        let how_far = |&index: &usize| {
            let (truth, value) = (Self::truth(&self.points[index]), values[index]);
            let ratio = (value / truth).abs().ln().abs();
            // What is no number is worse than any.
            match (value.is_finite(), ratio.is_nan()) {
                (false, _) => f64::INFINITY,
                (true, true) => 0.0,
                (true, false) => ratio.min(1e9),
            }
        };
        let wrong = (0..total).filter(|&index| !right[index]);
        let worst = wrong.max_by(|a, b| how_far(a).total_cmp(&how_far(b)));
        let Some(worst) = worst else {
            return format!("is right at all {total} points.");
        };
        let (point, value) = (&self.points[worst], values[worst]);
        let digits = Digits::Significant(4);
        let truth = Self::truth(point);
        let gives = if value.is_nan() {
            "is not a number (NaN: 0/0, or a root or power of a negative number)".to_owned()
        } else if value.is_infinite() {
            "is infinite (a division by zero?)".to_owned()
        } else {
            let times = match value / truth {
                ratio if ratio.is_finite() && ratio > 0.0 => {
                    format!(
                        ", {} times as much",
                        format_number(ratio, Digits::Significant(3))
                    )
                }
                _ => String::new(),
            };
            format!("gives {}{times}", format_number(value, digits))
        };
        let count = match count {
            0 => "none".to_owned(),
            count => count.to_string(),
        };
        format!(
            "is right at {count} of {total} points. At {} it should give {}, and {gives}.",
            self.spelled(point),
            format_number(truth, digits),
        )
    }
}

/// Points worth trying: the corners of the range, then random ones; a third of those crowd at
/// the low ends, where divisions show. Cosines that belong together stay together.
fn candidates(exercise: &Exercise, random: &mut Random) -> Vec<Vec<f64>> {
    let variables = &exercise.draw;
    let pick = |at: usize, index: usize| {
        let values = &variables[at].values;
        // What f32 makes of it is what the function sees.
        values
            .get(index.min(values.len().saturating_sub(1)))
            .map_or(f64::NAN, |value| f64::from(*value as f32))
    };
    let all_corners = 1_usize
        .checked_shl(variables.len() as u32)
        .unwrap_or(usize::MAX);
    let cosines = Cosines::among(variables.iter().map(|variable| &*variable.name.text));
    let ranges: Vec<(f64, f64)> = variables
        .iter()
        .map(|variable| {
            let values = variable.values.iter();
            values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
                (low.min(*value), high.max(*value))
            })
        })
        .collect();
    let settle = |mut point: Vec<f64>| match &cosines {
        Some(cosines) => cosines.settle(&mut point, &ranges).then_some(point),
        None => Some(point),
    };
    let mut points: Vec<Vec<f64>> = Vec::new();
    for corner in 0..all_corners.min(MOST_CORNERS) {
        let bits = match all_corners <= MOST_CORNERS {
            true => corner,
            false => random.below(usize::MAX),
        };
        let ends = (0..variables.len()).map(|at| match bits >> (at % 64) & 1 {
            0 => pick(at, 0),
            _ => pick(at, usize::MAX),
        });
        // Corners may come to lie on each other.
        let corner = settle(ends.collect()).filter(|corner| !points.contains(corner));
        points.extend(corner);
    }
    let enough = points.len() + RANDOM_POINTS;
    for number in 0..RANDOM_POINTS * MOST_TRIES {
        if points.len() == enough {
            break;
        }
        let point = (0..variables.len()).map(|at| {
            let count = variables[at].values.len();
            let mut index = random.below(count);
            if number % 3 == 0 {
                index = random.below(index + 1);
            }
            pick(at, index)
        });
        points.extend(settle(point.collect()));
    }
    points
}

impl Plan<'_> {
    /// Whether a function can be tried at a point: the right formula has a value there, and the
    /// author's condition holds.
    fn tries(&self, point: &Point) -> bool {
        point.steps.iter().all(|value| value.is_finite()) && self.holds(point)
    }
}

/// Marks a text by what came of running it at the points of [`job`].
pub fn mark(lesson: &Lesson, exercise: &Exercise, seed: u64, ran: &Ran) -> Marking {
    let Some(trial) = Trial::new(lesson, exercise, seed) else {
        return Marking::Invalid {
            says: "This exercise has nothing to compare a shader with.".to_owned(),
        };
    };
    match ran {
        Ran::Values(values) if values.len() == trial.points.len() => {
            let values: Vec<f64> = values.iter().map(|value| f64::from(*value)).collect();
            trial.mark(&values)
        }
        Ran::Values(_) => Marking::Invalid {
            says: "It could not be run at every point. Nothing is counted.".to_owned(),
        },
        Ran::Refused { says, help, place } => Marking::Invalid {
            says: complaint(says, help.as_deref(), place.as_ref()),
        },
        Ran::Stopped { point, says } => {
            let at = point.and_then(|index| trial.points.get(index));
            let at = at.map_or_else(String::new, |point| {
                format!(" It was run at {}.", trial.spelled(point))
            });
            Marking::Wrong {
                says: format!("Not yet. {says}{at}"),
            }
        }
        Ran::Unable(why) => Marking::Invalid {
            says: format!("Your function could not be run: {why}. Nothing is counted."),
        },
    }
}

/// A complaint as Markdown: where, what, what to do, and the line with a mark below.
fn complaint(says: &str, help: Option<&str>, place: Option<&CodePlace>) -> String {
    let help = help.map_or_else(String::new, |help| format!(" {help}"));
    let Some(place) = place else {
        return format!("{says}{help}");
    };
    let CodePlace {
        line,
        column,
        width,
        text,
        mark,
    } = place;
    let number = line.to_string();
    let before = " ".repeat(number.len() + 3 + mark - 1);
    let room = text.chars().count().saturating_sub(mark - 1).max(1);
    let below = "^".repeat((*width).clamp(1, room));
    // No line of code ends this fence, however it begins.
    format!(
        "Line {line}, column {column}: {says}{help}\n\n~~~~~~~~~~\n{number} | {text}\n{before}{below}\n~~~~~~~~~~"
    )
}
