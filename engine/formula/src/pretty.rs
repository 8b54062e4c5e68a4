//! Formulas for people: Unicode for the screen, LaTeX for paper.

use crate::expr::Expr;
use crate::library::Library;

impl Library {
    /// The formula in Unicode.
    pub fn unicode(&self, expr: &Expr) -> String {
        expr.to_string()
    }

    /// The formula in LaTeX.
    pub fn latex(&self, expr: &Expr) -> String {
        expr.to_string()
    }
}
