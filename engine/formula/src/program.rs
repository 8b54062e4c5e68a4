//! Formulas as a flat program for blocks of points: one operation over many points at a time,
//! so that the tree costs little more than compiled code of the same operations.

use crate::block::{Block, Blocks};
use crate::dag::{Dag, Id, Op};
use crate::error::Error;
use crate::eval::{Real, apply};
use crate::expr::Expr;
use crate::library::Library;
use brdf::batch::Isa;
use std::sync::Arc;

/// One input of a block.
#[derive(Clone, Copy, Debug)]
pub enum Column<'a, T> {
    /// The same value at every point: what depends only on such inputs is computed once.
    Uniform(T),
    /// A value for each point; as long as the output.
    Varying(&'a [T]),
}

/// Memory that block evaluation reuses between calls, and the set of instructions it uses.
#[derive(Debug)]
pub struct Scratch {
    isa: Isa,
    double: Blocks<f64>,
    single: Blocks<f32>,
}

impl Default for Scratch {
    fn default() -> Scratch {
        Scratch::on(Isa::best())
    }
}

impl Scratch {
    /// No memory yet, and the best instructions of this machine.
    pub fn new() -> Scratch {
        Scratch::default()
    }

    /// The same with these instructions. Results do not depend on them, not in a bit.
    pub fn on(isa: Isa) -> Scratch {
        Scratch {
            isa,
            double: Blocks::default(),
            single: Blocks::default(),
        }
    }
}

/// Formulas opened and compiled over named inputs.
///
/// Values outside a domain are NaN or infinite here, as in compiled code:
/// [`Library::eval`] is the one that explains.
#[derive(Clone, Debug)]
pub struct Program {
    operations: Arc<Operations>,
    inputs: Vec<String>,
}

/// What is computed: operands stand before the operations that need them.
#[derive(Debug)]
pub(crate) struct Operations {
    pub ops: Vec<Op>,
    /// The operation that is each formula's value.
    pub roots: Vec<Id>,
}

impl Library {
    /// Compiles an expression over the given inputs. Common parts are computed once.
    ///
    /// # Errors
    /// As [`Library::check_expr`]: the first of them.
    pub fn compile(&self, expr: &Expr, inputs: &[&str]) -> Result<Program, Error> {
        self.compile_all(&[expr], inputs)
    }

    /// Compiles several expressions over the same inputs into one program: what they have in
    /// common is computed once.
    ///
    /// # Errors
    /// As [`Library::check_expr`]: the first of them.
    pub fn compile_all(&self, exprs: &[&Expr], inputs: &[&str]) -> Result<Program, Error> {
        let mut dag = Dag::default();
        let mut roots = Vec::with_capacity(exprs.len());
        for expr in exprs {
            roots.push(self.lower_into(&mut dag, expr, Some(inputs))?);
        }
        let inputs = inputs.iter().map(ToString::to_string).collect();
        Ok(Program::new(&dag, &roots, inputs))
    }
}

impl Program {
    fn new(dag: &Dag, roots: &[Id], inputs: Vec<String>) -> Program {
        let needed = dag.needed_by(roots);
        let mut place = vec![0; dag.ops.len()];
        let mut ops = Vec::new();
        for (id, op) in dag.ops.iter().enumerate().filter(|(id, _)| needed[*id]) {
            place[id] = ops.len();
            // The dag's inputs are the program's, in the same order: they were given.
            ops.push(op.renumbered(|id| place[id]));
        }
        let roots = roots.iter().map(|root| place[*root]).collect();
        Program {
            operations: Arc::new(Operations { ops, roots }),
            inputs,
        }
    }

    /// The names of the inputs, in order.
    pub fn inputs(&self) -> &[String] {
        &self.inputs
    }

    /// The number of operations of one evaluation; a call of the core counts as one.
    pub fn ops(&self) -> usize {
        let ops = self.operations.ops.iter();
        ops.filter(|op| !op.operands().is_empty()).count()
    }

    /// Names of the core's functions that are called, each once.
    pub fn terms(&self) -> Vec<&'static str> {
        let mut names = Vec::new();
        for op in &self.operations.ops {
            if let Op::Term(term, _) = op
                && !names.contains(&term.0.name)
            {
                names.push(term.0.name);
            }
        }
        names
    }

    /// The value of the first formula at one point; an input that is missing is NaN.
    pub fn eval(&self, inputs: &[f64]) -> f64 {
        self.point(inputs)
    }

    /// The value at one point, every operation in f32.
    pub fn eval_f32(&self, inputs: &[f32]) -> f32 {
        self.point(inputs)
    }

    fn point<R: Real>(&self, inputs: &[R]) -> R {
        let Operations { ops, roots } = &*self.operations;
        let mut values: Vec<R> = Vec::with_capacity(ops.len());
        for op in ops {
            values.push(apply(op, inputs, |id| values[id]));
        }
        let value = roots.first().and_then(|root| values.get(*root));
        value.copied().unwrap_or(R::of(f64::NAN))
    }

    /// The values of the first formula at a block of points, in f64. A column that is missing
    /// or shorter than `out` gives NaN.
    pub fn eval_block_f64(&self, inputs: &[Column<f64>], out: &mut [f64], scratch: &mut Scratch) {
        self.eval_blocks_f64(inputs, &mut [out], scratch);
    }

    /// The values at a block of points, every operation in f32; otherwise as
    /// [`Program::eval_block_f64`].
    pub fn eval_block_f32(&self, inputs: &[Column<f32>], out: &mut [f32], scratch: &mut Scratch) {
        self.eval_blocks_f32(inputs, &mut [out], scratch);
    }

    /// The values of every formula at a block of points, in f64: one slice each, all of the
    /// same length; what is shorter than the longest gets what fits.
    pub fn eval_blocks_f64(
        &self,
        inputs: &[Column<f64>],
        outs: &mut [&mut [f64]],
        scratch: &mut Scratch,
    ) {
        let Scratch { isa, double, .. } = scratch;
        Block::new(&self.operations, self.inputs.len(), inputs, outs, *isa).run(double);
    }

    /// The values of every formula, every operation in f32; otherwise as
    /// [`Program::eval_blocks_f64`].
    pub fn eval_blocks_f32(
        &self,
        inputs: &[Column<f32>],
        outs: &mut [&mut [f32]],
        scratch: &mut Scratch,
    ) {
        let Scratch { isa, single, .. } = scratch;
        Block::new(&self.operations, self.inputs.len(), inputs, outs, *isa).run(single);
    }
}

impl Op {
    fn renumbered(&self, new: impl Fn(Id) -> Id) -> Op {
        match self {
            Op::Number(_) | Op::Pi | Op::Input(_) => self.clone(),
            Op::Neg(a) => Op::Neg(new(*a)),
            Op::Add(a, b) => Op::Add(new(*a), new(*b)),
            Op::Sub(a, b) => Op::Sub(new(*a), new(*b)),
            Op::Mul(a, b) => Op::Mul(new(*a), new(*b)),
            Op::Div(a, b) => Op::Div(new(*a), new(*b)),
            Op::PowInt(a, power) => Op::PowInt(new(*a), *power),
            Op::Pow(a, b) => Op::Pow(new(*a), new(*b)),
            Op::Compare(op, a, b) => Op::Compare(*op, new(*a), new(*b)),
            Op::Min(a, b) => Op::Min(new(*a), new(*b)),
            Op::Max(a, b) => Op::Max(new(*a), new(*b)),
            Op::Unary(function, a) => Op::Unary(*function, new(*a)),
            Op::Term(term, args) => Op::Term(*term, args.iter().map(|id| new(*id)).collect()),
        }
    }
}
