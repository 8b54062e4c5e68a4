//! What two formulas have in common, and what a formula is apart from its spelling.

use crate::dag::{Dag, Id, Op};
use crate::expr::{Arg, BinaryOp, Expr, Node};
use crate::library::Library;
use std::collections::BTreeMap;
use std::fmt::Write;

/// A quotient with more nodes than this is not simpler than what it was made of.
const MOST_NODES: usize = 400;

/// Greatest exponent of a factor.
const MOST_EXPONENT: i64 = 64;

impl Library {
    /// `wrong / right` with definitions opened and common factors cancelled: for a division
    /// done twice `1 / (4 * n_dot_l * n_dot_v)`. None where no common factor but numbers is
    /// found, or where the result is not small.
    ///
    /// Where right and wrong are both 0 the quotient is the limit, which is what a picture
    /// of the ratio should show.
    pub fn ratio(&self, right: &Expr, wrong: &Expr) -> Option<Expr> {
        self.ratio_over(right, wrong, None)
    }

    /// [`Library::ratio`] in terms of the given names: roughness squared for alpha, where
    /// only roughness is given.
    pub fn ratio_of(&self, right: &Expr, wrong: &Expr, givens: &[&str]) -> Option<Expr> {
        self.ratio_over(right, wrong, Some(givens))
    }

    fn ratio_over(&self, right: &Expr, wrong: &Expr, givens: Option<&[&str]>) -> Option<Expr> {
        // In one dag equal parts of both are one operation.
        let mut dag = Dag::default();
        let right = self.lower_into(&mut dag, right, givens).ok()?;
        let wrong = self.lower_into(&mut dag, wrong, givens).ok()?;
        let below = factors(&dag, right)?;
        let above = factors(&dag, wrong)?;
        let mut quotient = above.clone();
        let mut cancelled = right == wrong;
        for (id, exponent) in &below.of {
            let number = matches!(dag.ops[*id], Op::Number(_) | Op::Pi);
            let shared = above
                .of
                .get(id)
                .is_some_and(|other| (*other > 0) == (*exponent > 0));
            cancelled |= shared && !number;
            *quotient.of.entry(*id).or_insert(0) -= exponent;
        }
        if !cancelled {
            return None;
        }
        quotient.negative ^= below.negative;
        quotient.tree(&dag)
    }

    /// The text of an expression with its definitions opened, the same for every spelling
    /// of the same operations in the same order: what a content hash is taken of.
    pub fn canonical(&self, expr: &Expr) -> String {
        let Ok(dag) = self.lower(expr, None) else {
            return format!("unreadable {expr}");
        };
        let needed = dag.needed();
        let mut numbers = vec![0; dag.ops.len()];
        let mut text = String::new();
        let ops = dag.ops.iter().enumerate().filter(|(id, _)| needed[*id]);
        for (number, (id, op)) in ops.enumerate() {
            numbers[id] = number;
            // Writing to a String cannot fail.
            let _ = match op {
                Op::Number(bits) => write!(text, "{:?}", f64::from_bits(*bits)),
                Op::Pi => write!(text, "pi"),
                Op::Input(index) => write!(text, "{}", dag.inputs[*index]),
                Op::Neg(_) => write!(text, "neg"),
                Op::Add(..) => write!(text, "add"),
                Op::Sub(..) => write!(text, "sub"),
                Op::Mul(..) => write!(text, "mul"),
                Op::Div(..) => write!(text, "div"),
                Op::PowInt(_, exponent) => write!(text, "^{exponent}"),
                Op::Pow(..) => write!(text, "pow"),
                Op::Compare(op, ..) => write!(text, "{}", op.symbol()),
                Op::Min(..) => write!(text, "min"),
                Op::Max(..) => write!(text, "max"),
                Op::Unary(function, _) => write!(text, "{}", function.name()),
                Op::Term(term, _) => write!(text, "{}", term.0.name),
            };
            for operand in op.operands() {
                let _ = write!(text, " {}", numbers[operand]);
            }
            text.push('\n');
        }
        text
    }
}

/// A product: which operations to which powers.
#[derive(Clone)]
struct Factors {
    of: BTreeMap<Id, i64>,
    negative: bool,
}

/// Takes products, quotients and whole powers apart.
fn factors(dag: &Dag, id: Id) -> Option<Factors> {
    let mut open = BTreeMap::from([(id, 1_i64)]);
    let mut of = BTreeMap::new();
    let mut negative = false;
    // Operands stand before what needs them, so that the last open one gets no more powers:
    // each is taken apart once, however often it is shared.
    while let Some((id, exponent)) = open.pop_last() {
        if exponent == 0 {
            continue;
        }
        if exponent.abs() > MOST_EXPONENT {
            return None;
        }
        let mut more = |id: Id, exponent: i64| *open.entry(id).or_insert(0) += exponent;
        match dag.ops[id] {
            Op::Mul(a, b) => {
                more(a, exponent);
                more(b, exponent);
            }
            Op::Div(a, b) => {
                more(a, exponent);
                more(b, -exponent);
            }
            Op::Neg(a) => {
                negative ^= exponent % 2 != 0;
                more(a, exponent);
            }
            Op::PowInt(a, power) => more(a, exponent * i64::from(power)),
            Op::Number(bits) if f64::from_bits(bits) == 1.0 => {}
            _ => {
                of.insert(id, exponent);
            }
        }
    }
    Some(Factors { of, negative })
}

impl Factors {
    fn tree(&self, dag: &Dag) -> Option<Expr> {
        let mut room = MOST_NODES;
        let mut above = Vec::new();
        let mut below = Vec::new();
        let number = |id: &Id| matches!(dag.ops[*id], Op::Number(_) | Op::Pi);
        let (numbers, others): (Vec<_>, Vec<_>) = self
            .of
            .iter()
            .filter(|(_, e)| **e != 0)
            .partition(|(id, _)| number(id));
        for (id, exponent) in numbers.into_iter().chain(others) {
            if exponent.abs() > MOST_EXPONENT {
                return None;
            }
            let base = tree(dag, *id, &mut room)?;
            let factor = match exponent.abs() {
                1 => base,
                power => Expr::binary(BinaryOp::Pow, base, Expr::number(power as f64)),
            };
            if *exponent > 0 {
                above.push(factor);
            } else {
                below.push(factor);
            }
        }
        let product = |factors: Vec<Expr>| {
            factors
                .into_iter()
                .reduce(|left, right| Expr::binary(BinaryOp::Mul, left, right))
        };
        let above = product(above).unwrap_or_else(|| Expr::number(1.0));
        let quotient = match product(below) {
            Some(below) => Expr::binary(BinaryOp::Div, above, below),
            None => above,
        };
        Some(match self.negative {
            true => Expr::made(Node::Neg(Box::new(quotient))),
            false => quotient,
        })
    }
}

/// An operation as a tree again; none where that is large. The room bounds the recursion.
fn tree(dag: &Dag, id: Id, room: &mut usize) -> Option<Expr> {
    *room = room.checked_sub(1)?;
    let mut sub = |id: &Id| tree(dag, *id, room);
    let call = |name: &str, args: Vec<Expr>| {
        let args = args.into_iter().map(|value| Arg { name: None, value });
        Expr::call(name, args.collect())
    };
    Some(match &dag.ops[id] {
        Op::Number(bits) => Expr::number(f64::from_bits(*bits)),
        Op::Pi => Expr::name("pi"),
        Op::Input(index) => Expr::name(&dag.inputs[*index]),
        Op::Neg(a) => Expr::made(Node::Neg(Box::new(sub(a)?))),
        Op::Add(a, b) => Expr::binary(BinaryOp::Add, sub(a)?, sub(b)?),
        Op::Sub(a, b) => Expr::binary(BinaryOp::Sub, sub(a)?, sub(b)?),
        Op::Mul(a, b) => Expr::binary(BinaryOp::Mul, sub(a)?, sub(b)?),
        Op::Div(a, b) => Expr::binary(BinaryOp::Div, sub(a)?, sub(b)?),
        Op::PowInt(a, power) => {
            Expr::binary(BinaryOp::Pow, sub(a)?, Expr::number(f64::from(*power)))
        }
        Op::Pow(a, b) => Expr::binary(BinaryOp::Pow, sub(a)?, sub(b)?),
        Op::Compare(op, a, b) => Expr::made(Node::Compare {
            op: *op,
            left: Box::new(sub(a)?),
            right: Box::new(sub(b)?),
        }),
        Op::Min(a, b) => call("min", vec![sub(a)?, sub(b)?]),
        Op::Max(a, b) => call("max", vec![sub(a)?, sub(b)?]),
        Op::Unary(function, a) => call(function.name(), vec![sub(a)?]),
        Op::Term(term, args) => {
            let mut named = Vec::new();
            for (param, arg) in term.0.params.iter().zip(args) {
                named.push(Arg {
                    name: Some(param.name.to_string()),
                    value: sub(arg)?,
                });
            }
            Expr::call(term.0.name, named)
        }
    })
}
