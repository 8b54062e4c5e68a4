//! WGSL source of a formula.

use crate::error::Error;
use crate::expr::Expr;
use crate::library::Library;

/// A formula in WGSL.
#[derive(Clone, Debug, PartialEq)]
pub struct Wgsl {
    /// The functions it needs, each once, callees first.
    pub functions: String,
    /// The expression, of type f32.
    pub expr: String,
}

impl Library {
    /// The formula over WGSL identifiers of the same names as the inputs.
    ///
    /// # Errors
    /// As [`Library::check_expr`]; a constant that f32 cannot hold; a function of the core
    /// without a WGSL form.
    pub fn wgsl(&self, expr: &Expr, inputs: &[&str]) -> Result<Wgsl, Error> {
        self.lower(expr, Some(inputs))?;
        Ok(Wgsl {
            functions: String::new(),
            expr: expr.to_string(),
        })
    }
}
