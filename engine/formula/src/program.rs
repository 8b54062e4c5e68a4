//! A formula as a flat program for blocks of points.

use crate::dag::Dag;
use crate::error::Error;
use crate::eval::{Real, apply};
use crate::expr::Expr;
use crate::library::Library;

/// One input of a block.
#[derive(Clone, Copy, Debug)]
pub enum Column<'a, T> {
    /// The same value at every point: what depends only on such inputs is computed once.
    Uniform(T),
    /// A value for each point; as long as the output.
    Varying(&'a [T]),
}

/// Memory that block evaluation reuses between calls.
#[derive(Debug, Default)]
pub struct Scratch {
    _f64: Vec<Vec<f64>>,
    _f32: Vec<Vec<f32>>,
}

impl Scratch {
    /// No memory yet.
    pub fn new() -> Scratch {
        Scratch::default()
    }
}

/// A formula opened and compiled over named inputs. Values outside a domain are NaN or
/// infinite here, as in compiled code: [`Library::eval`] is the one that explains.
#[derive(Clone, Debug)]
pub struct Program {
    dag: Dag,
    inputs: Vec<String>,
}

impl Library {
    /// Compiles an expression over the given inputs.
    ///
    /// # Errors
    /// As [`Library::check_expr`]: the first of them.
    pub fn compile(&self, expr: &Expr, inputs: &[&str]) -> Result<Program, Error> {
        let dag = self.lower(expr, Some(inputs))?;
        let inputs = inputs.iter().map(ToString::to_string).collect();
        Ok(Program { dag, inputs })
    }
}

impl Program {
    /// The names of the inputs, in order.
    pub fn inputs(&self) -> &[String] {
        &self.inputs
    }

    /// The number of operations of one evaluation.
    pub fn ops(&self) -> usize {
        self.dag.needed().iter().filter(|needed| **needed).count()
    }

    /// The value at one point.
    pub fn eval(&self, inputs: &[f64]) -> f64 {
        self.point(inputs)
    }

    fn point<R: Real>(&self, inputs: &[R]) -> R {
        let mut values: Vec<R> = Vec::with_capacity(self.dag.ops.len());
        for op in &self.dag.ops {
            values.push(apply(op, inputs, |id| values[id]));
        }
        values.get(self.dag.root).copied().unwrap_or(R::ZERO)
    }

    fn block<R: Real>(&self, inputs: &[Column<R>], out: &mut [R]) {
        let mut point = vec![R::ZERO; inputs.len()];
        for (index, out) in out.iter_mut().enumerate() {
            for (slot, column) in point.iter_mut().zip(inputs) {
                *slot = match column {
                    Column::Uniform(value) => *value,
                    Column::Varying(values) => values.get(index).copied().unwrap_or(R::ZERO),
                };
            }
            *out = self.point(&point);
        }
    }

    /// The values at a block of points, in f64.
    pub fn eval_block_f64(&self, inputs: &[Column<f64>], out: &mut [f64], _: &mut Scratch) {
        self.block(inputs, out);
    }

    /// The values at a block of points, every operation in f32.
    pub fn eval_block_f32(&self, inputs: &[Column<f32>], out: &mut [f32], _: &mut Scratch) {
        self.block(inputs, out);
    }
}
