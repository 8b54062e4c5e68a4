//! A formula with its numbers put in, step by step, as a person writes it on a board.

use crate::digits::{Digits, format_number};
use crate::error::Error;
use crate::expr::Expr;
use crate::library::{Library, Values};

/// The lines between a formula and its value.
#[derive(Clone, Debug, PartialEq)]
pub struct Substitution {
    /// At most four lines in Unicode, the result not among them.
    pub lines: Vec<String>,
    /// The value at full precision.
    pub value: f64,
    /// The value with the digits asked for.
    pub shown: String,
}

impl Library {
    /// Puts numbers into a formula.
    ///
    /// # Errors
    /// As [`Library::eval`].
    pub fn substitution(
        &self,
        expr: &Expr,
        values: &Values,
        digits: Digits,
    ) -> Result<Substitution, Error> {
        let value = self.eval(expr, values)?;
        Ok(Substitution {
            lines: vec![self.unicode(expr)],
            value,
            shown: format_number(value, digits),
        })
    }
}
