//! A formula with its definitions opened: every distinct operation once, operands before
//! the operations that need them. Nothing that walks it recurses.

use crate::builtin::Builtin;
use crate::error::Span;
use crate::expr::CompareOp;
use std::collections::HashMap;

/// Index of an operation.
pub(crate) type Id = usize;

/// One operation; operands by index. Equal operations are one.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Op {
    /// Bits of an f64, so that it can be hashed.
    Number(u64),
    Pi,
    Input(usize),
    Neg(Id),
    Add(Id, Id),
    Sub(Id, Id),
    Mul(Id, Id),
    Div(Id, Id),
    /// A small whole exponent: products, not a power function.
    PowInt(Id, i32),
    Pow(Id, Id),
    Compare(CompareOp, Id, Id),
    Min(Id, Id),
    Max(Id, Id),
    Unary(Builtin, Id),
    Term(TermRef, Vec<Id>),
}

/// A function of the core, compared by name.
#[derive(Clone, Copy)]
pub(crate) struct TermRef(pub &'static brdf::Term);

impl PartialEq for TermRef {
    fn eq(&self, other: &TermRef) -> bool {
        self.0.name == other.0.name
    }
}

impl Eq for TermRef {}

impl std::hash::Hash for TermRef {
    fn hash<H: std::hash::Hasher>(&self, state: &mut H) {
        self.0.name.hash(state);
    }
}

impl std::fmt::Debug for TermRef {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        out.write_str(self.0.name)
    }
}

impl Op {
    /// Indices of the operands.
    pub fn operands(&self) -> Vec<Id> {
        match self {
            Op::Number(_) | Op::Pi | Op::Input(_) => Vec::new(),
            Op::Neg(a) | Op::PowInt(a, _) | Op::Unary(_, a) => vec![*a],
            Op::Add(a, b)
            | Op::Sub(a, b)
            | Op::Mul(a, b)
            | Op::Div(a, b)
            | Op::Pow(a, b)
            | Op::Compare(_, a, b)
            | Op::Min(a, b)
            | Op::Max(a, b) => vec![*a, *b],
            Op::Term(_, args) => args.clone(),
        }
    }
}

/// Where an operation was written.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Origin {
    /// In the text of the whole expression.
    pub span: Span,
    /// In a definition: its index in [`Dag::definitions`] and the span in its text.
    pub within: Option<(usize, Span)>,
}

/// The opened formula.
#[derive(Clone, Debug, Default)]
pub(crate) struct Dag {
    pub ops: Vec<Op>,
    pub origins: Vec<Origin>,
    pub inputs: Vec<String>,
    /// Names of the definitions that were opened.
    pub definitions: Vec<String>,
    pub root: Id,
    seen: HashMap<Op, Id>,
}

impl Dag {
    /// The index of an operation, which is added unless it is there.
    pub fn push(&mut self, op: Op, origin: Origin) -> Id {
        if let Some(id) = self.seen.get(&op) {
            return *id;
        }
        let id = self.ops.len();
        self.seen.insert(op.clone(), id);
        self.ops.push(op);
        self.origins.push(origin);
        id
    }

    /// The index of an input, which is added unless it is there.
    pub fn input(&mut self, name: &str) -> usize {
        match self.inputs.iter().position(|input| input == name) {
            Some(index) => index,
            None => {
                self.inputs.push(name.to_string());
                self.inputs.len() - 1
            }
        }
    }

    /// Which operations the root needs.
    pub fn needed(&self) -> Vec<bool> {
        self.needed_by(&[self.root])
    }

    /// Which operations these need.
    pub fn needed_by(&self, roots: &[Id]) -> Vec<bool> {
        let mut needed = vec![false; self.ops.len()];
        for root in roots {
            if let Some(root) = needed.get_mut(*root) {
                *root = true;
            }
        }
        for id in (0..self.ops.len()).rev() {
            if needed[id] {
                for operand in self.ops[id].operands() {
                    needed[operand] = true;
                }
            }
        }
        needed
    }
}
