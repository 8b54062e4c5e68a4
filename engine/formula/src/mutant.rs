//! Plausible mistakes: a formula with one edit, found without anybody writing it down.

use crate::error::Error;
use crate::expr::Expr;
use crate::library::{Library, Values};
use crate::mutate::Edit;
use std::collections::BTreeSet;

/// What kind of slip made a mutant, the most common slips first.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
#[non_exhaustive]
pub enum MutantKind {
    /// roughness where alpha = roughness² belongs.
    RoughnessForAlpha,
    /// x where x² belongs.
    SquareDropped,
    /// x⁴ where x² belongs, or alpha² where alpha belongs.
    SquareDoubled,
    /// 2·x where x² belongs.
    DoubledInsteadOfSquared,
    /// A division done a second time.
    DividedTwice,
    /// A division left out.
    DivisionLost,
    /// A factor π lost.
    PiLost,
    /// A constant factor lost (4.0: the 4 is missing).
    FactorLost(f64),
    /// A cosine missing from a product.
    CosineLost,
    /// One dot product for another.
    OtherDotProduct,
    /// Two arguments swapped.
    ArgumentsSwapped,
    /// The operands of a difference or a quotient swapped.
    OperandsSwapped,
    /// Plus for minus, or minus for plus.
    SignFlipped,
    /// x where 1 − x belongs.
    ComplementLost,
    /// A constant term of a sum left out.
    TermLost,
    /// A square root left out.
    SqrtLost,
    /// Brackets lost: a / b·c for a / (b·c).
    BracketLost,
    /// A related function: G2 for V, sin for cos.
    OtherFunction,
    /// Degrees where radians belong.
    DegreesForRadians,
    /// Radians where degrees belong.
    RadiansForDegrees,
    /// Another whole exponent than 2 off by one.
    PowerOff,
}

impl MutantKind {
    pub(crate) fn slug(self) -> String {
        match self {
            MutantKind::RoughnessForAlpha => "roughness-for-alpha",
            MutantKind::SquareDropped => "square-dropped",
            MutantKind::SquareDoubled => "square-doubled",
            MutantKind::DoubledInsteadOfSquared => "doubled-not-squared",
            MutantKind::DividedTwice => "divided-twice",
            MutantKind::DivisionLost => "division-lost",
            MutantKind::PiLost => "pi-lost",
            MutantKind::FactorLost(factor) => return format!("factor-{factor}-lost"),
            MutantKind::CosineLost => "cosine-lost",
            MutantKind::OtherDotProduct => "other-dot-product",
            MutantKind::ArgumentsSwapped => "arguments-swapped",
            MutantKind::OperandsSwapped => "operands-swapped",
            MutantKind::SignFlipped => "sign-flipped",
            MutantKind::ComplementLost => "complement-lost",
            MutantKind::TermLost => "term-lost",
            MutantKind::SqrtLost => "sqrt-lost",
            MutantKind::BracketLost => "bracket-lost",
            MutantKind::OtherFunction => "other-function",
            MutantKind::DegreesForRadians => "degrees-for-radians",
            MutantKind::RadiansForDegrees => "radians-for-degrees",
            MutantKind::PowerOff => "power-off",
        }
        .to_string()
    }
}

/// A plausible mistake: one edit, in the expression or in a definition it uses (and then
/// everywhere that definition is used).
#[derive(Clone, Debug, PartialEq)]
pub struct Mutant {
    /// A stable, readable name: `square-dropped@s:alpha`.
    pub id: String,
    /// What kind of slip it is.
    pub kind: MutantKind,
    /// One sentence for the learner, such as "The square on α was dropped."
    pub says: String,
    target: Option<String>,
    edited: Expr,
}

impl Mutant {
    /// The definition that was edited; none for the expression itself.
    pub fn target(&self) -> Option<&str> {
        self.target.as_deref()
    }

    /// The edited formula: the body of [`Mutant::target`], or the expression.
    pub fn edited(&self) -> &Expr {
        &self.edited
    }
}

/// Mutants of one formula at most; a formula with more places to slip is no exercise.
const MOST_MUTANTS: usize = 160;

/// Points at which two mutants must differ to be two.
const POINTS: usize = 64;

impl Library {
    /// One edit each, in the expression or in a definition it uses; the most common kinds
    /// of slip first. One dot product is taken for another only where the formula needs
    /// both; see [`Library::mutants_given`].
    pub fn mutants(&self, expr: &Expr) -> Vec<Mutant> {
        self.mutants_given(expr, &[])
    }

    /// The same where more is given than the formula needs: who computes `s(c = n_dot_v)`
    /// with N·L on the same sheet may take the wrong one.
    pub fn mutants_given(&self, expr: &Expr, given: &[&str]) -> Vec<Mutant> {
        let mut names = self.needs(expr);
        names.extend(given.iter().map(ToString::to_string));
        let names: Vec<String> = names.into_iter().collect();
        let mut found: Vec<(Option<String>, Edit)> = Vec::new();
        let own = self.edits(expr, &names, true, MOST_MUTANTS);
        found.extend(own.into_iter().map(|edit| (None, edit)));
        for name in self.uses(expr) {
            let Some(definition) = self.definition(&name) else {
                continue;
            };
            let room = MOST_MUTANTS.saturating_sub(found.len());
            let edits = self.edits(&definition.body, &definition.params, false, room);
            found.extend(edits.into_iter().map(|edit| (Some(name.clone()), edit)));
        }
        found.sort_by(|(_, a), (_, b)| {
            a.kind
                .partial_cmp(&b.kind)
                .unwrap_or(std::cmp::Ordering::Equal)
        });
        let mut ids = BTreeSet::new();
        let mutants = found.into_iter().map(|(target, edit)| {
            let place = target
                .as_ref()
                .map_or(String::new(), |name| format!("@{name}"));
            let base = format!("{}{place}{}", edit.kind.slug(), slug(&edit.subject));
            let mut id = base.clone();
            let mut count = 1;
            while !ids.insert(id.clone()) {
                count += 1;
                id = format!("{base}-{count}");
            }
            let says = match &target {
                Some(name) => format!("In {}, {}.", crate::unicode_name(name), edit.says),
                None => sentence(&edit.says),
            };
            Mutant {
                id,
                kind: edit.kind,
                says,
                target,
                edited: edit.root,
            }
        });
        mutants.collect()
    }

    /// The library and the expression with the edit made.
    pub fn apply(&self, expr: &Expr, mutant: &Mutant) -> (Library, Expr) {
        match &mutant.target {
            Some(name) => (self.with_body(name, &mutant.edited), expr.clone()),
            None => (self.clone(), mutant.edited.clone()),
        }
    }

    /// The value of the mistake.
    ///
    /// # Errors
    /// As [`Library::eval`]: a mistake may leave the domain where the right formula does
    /// not.
    pub fn eval_mutant(&self, expr: &Expr, mutant: &Mutant, values: &Values) -> Result<f64, Error> {
        match &mutant.target {
            Some(name) => self.with_body(name, &mutant.edited).eval(expr, values),
            None => self.eval(&mutant.edited, values),
        }
    }

    /// The mutants without those that equal the right formula, or an earlier one, at 64
    /// points of the ranges `(name, least, most)`; nor those that have no value at any.
    pub fn distinct_mutants(&self, expr: &Expr, ranges: &[(&str, f64, f64)]) -> Vec<Mutant> {
        let names: Vec<&str> = ranges.iter().map(|(name, ..)| *name).collect();
        let mutants = self.mutants_given(expr, &names);
        let points = spread(ranges);
        let values = |library: &Library, expr: &Expr| -> Option<Vec<f64>> {
            let program = library.compile(expr, &names).ok()?;
            Some(points.iter().map(|point| program.eval(point)).collect())
        };
        let Some(right) = values(self, expr) else {
            return mutants;
        };
        let mut seen = vec![right];
        mutants
            .into_iter()
            .filter(|mutant| {
                let (library, edited) = self.apply(expr, mutant);
                let Some(found) = values(&library, &edited) else {
                    return false;
                };
                let new = found.iter().any(|value| value.is_finite())
                    && !seen.iter().any(|known| agree(known, &found));
                if new {
                    seen.push(found);
                }
                new
            })
            .collect()
    }
}

fn agree(left: &[f64], right: &[f64]) -> bool {
    left.iter().zip(right).all(|(a, b)| {
        (!a.is_finite() && !b.is_finite()) || (a - b).abs() <= 1e-9 * (a.abs() + b.abs())
    })
}

/// Points that fill the ranges evenly: an additive recurrence with a step for each
/// dimension (Roberts 2018).
fn spread(ranges: &[(&str, f64, f64)]) -> Vec<Vec<f64>> {
    // The root of x^(d+1) = x + 1 spreads d dimensions best.
    let dimensions = ranges.len().max(1) as f64;
    let mut root: f64 = 1.5;
    for _ in 0..32 {
        root = (1.0 + root).powf(1.0 / (dimensions + 1.0));
    }
    (1..=POINTS)
        .map(|index| {
            let mut step = 1.0;
            ranges
                .iter()
                .map(|(_, least, most)| {
                    step /= root;
                    let share = (0.5 + step * index as f64).fract();
                    least + share * (most - least)
                })
                .collect()
        })
        .collect()
}

/// `:alpha` of α, `:n_dot_l-n_dot_v` of a product; nothing of nothing.
fn slug(subject: &str) -> String {
    let mut slug = String::new();
    for c in subject.chars() {
        if c.is_ascii_alphanumeric() || c == '_' || c == '.' {
            slug.push(c);
        } else if c != '^' && !slug.ends_with('-') && !slug.is_empty() {
            slug.push('-');
        }
        if slug.len() >= 32 {
            break;
        }
    }
    let slug = slug.trim_end_matches(['-', '_']);
    if slug.is_empty() {
        String::new()
    } else {
        format!(":{slug}")
    }
}

/// A capital in front, where it is a word and no symbol, and a full stop behind.
fn sentence(says: &str) -> String {
    let word = says.split(' ').next().unwrap_or("");
    let lower = word.len() > 1 && word.bytes().all(|byte| byte.is_ascii_lowercase());
    let mut chars = says.chars();
    match chars.next() {
        Some(first) if lower => format!("{}{}.", first.to_ascii_uppercase(), chars.as_str()),
        _ => format!("{says}."),
    }
}
