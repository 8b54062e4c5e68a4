//! The tree, and its spelling in the language it was parsed from.

use crate::error::Span;
use std::fmt;

/// A formula: what it says and where in the text it says so.
#[derive(Clone, Debug, PartialEq)]
pub struct Expr {
    /// What it says.
    pub node: Node,
    /// Where it stands in the text parsed; empty in a tree that no text gave.
    pub span: Span,
}

/// One node of a formula.
#[derive(Clone, Debug, PartialEq)]
pub enum Node {
    /// A number, with the spelling of the author.
    Number {
        /// Its value; never negative, NaN or infinite after parsing.
        value: f64,
        /// As it was written.
        text: String,
    },
    /// A given, a parameter, or `pi`.
    Name(String),
    /// Unary minus.
    Neg(Box<Expr>),
    /// Arithmetic with two operands.
    Binary {
        /// The operation.
        op: BinaryOp,
        /// Left operand.
        left: Box<Expr>,
        /// Right operand.
        right: Box<Expr>,
    },
    /// A comparison: 1 where it holds, 0 where not.
    Compare {
        /// The relation.
        op: CompareOp,
        /// Left operand.
        left: Box<Expr>,
        /// Right operand.
        right: Box<Expr>,
    },
    /// A function of the core, of a lesson, or an elementary one.
    Call {
        /// The function.
        name: String,
        /// Its arguments in the order written.
        args: Vec<Arg>,
    },
}

/// An argument of a call, by name or (elementary functions) by position.
#[derive(Clone, Debug, PartialEq)]
pub struct Arg {
    /// The parameter it is for.
    pub name: Option<String>,
    /// What is passed.
    pub value: Expr,
}

/// The arithmetic operations.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[allow(missing_docs)]
pub enum BinaryOp {
    Add,
    Sub,
    Mul,
    Div,
    Pow,
}

/// The comparisons.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[allow(missing_docs)]
pub enum CompareOp {
    Less,
    LessEqual,
    Greater,
    GreaterEqual,
    Equal,
    NotEqual,
}

impl BinaryOp {
    /// As typed on a keyboard.
    pub fn symbol(self) -> &'static str {
        match self {
            BinaryOp::Add => "+",
            BinaryOp::Sub => "-",
            BinaryOp::Mul => "*",
            BinaryOp::Div => "/",
            BinaryOp::Pow => "^",
        }
    }
}

impl CompareOp {
    /// As typed on a keyboard.
    pub fn symbol(self) -> &'static str {
        match self {
            CompareOp::Less => "<",
            CompareOp::LessEqual => "<=",
            CompareOp::Greater => ">",
            CompareOp::GreaterEqual => ">=",
            CompareOp::Equal => "==",
            CompareOp::NotEqual => "!=",
        }
    }
}

/// How tightly a node binds; a looser one needs parentheses inside a tighter one.
pub(crate) mod binding {
    pub const COMPARE: u8 = 1;
    pub const SUM: u8 = 2;
    /// `N·H` looks like a product and is none: tighter than a sum, looser than a product.
    pub const DOT: u8 = 3;
    pub const PRODUCT: u8 = 4;
    pub const NEG: u8 = 5;
    pub const POWER: u8 = 6;
    pub const ATOM: u8 = 7;
}

impl Node {
    pub(crate) fn binding(&self) -> u8 {
        match self {
            Node::Compare { .. } => binding::COMPARE,
            Node::Binary { op, .. } => match op {
                BinaryOp::Add | BinaryOp::Sub => binding::SUM,
                BinaryOp::Mul | BinaryOp::Div => binding::PRODUCT,
                BinaryOp::Pow => binding::POWER,
            },
            Node::Neg(_) => binding::NEG,
            Node::Number { value, .. } if *value < 0.0 => binding::NEG,
            Node::Number { .. } | Node::Name(_) | Node::Call { .. } => binding::ATOM,
        }
    }
}

/// Builders for trees that no text gave: their spans are empty.
impl Expr {
    pub(crate) fn made(node: Node) -> Expr {
        Expr {
            node,
            span: Span::default(),
        }
    }

    /// A number as a tree; a negative one is a minus before a positive one.
    pub fn number(value: f64) -> Expr {
        if value < 0.0 {
            return Expr::made(Node::Neg(Box::new(Expr::number(-value))));
        }
        Expr::made(Node::Number {
            value,
            text: plain(value),
        })
    }

    /// A name as a tree.
    pub fn name(name: &str) -> Expr {
        Expr::made(Node::Name(name.to_string()))
    }

    pub(crate) fn binary(op: BinaryOp, left: Expr, right: Expr) -> Expr {
        Expr::made(Node::Binary {
            op,
            left: Box::new(left),
            right: Box::new(right),
        })
    }

    pub(crate) fn call(name: &str, args: Vec<Arg>) -> Expr {
        Expr::made(Node::Call {
            name: name.to_string(),
            args,
        })
    }

    /// Direct subtrees, left to right.
    pub(crate) fn children(&self) -> Vec<&Expr> {
        match &self.node {
            Node::Number { .. } | Node::Name(_) => Vec::new(),
            Node::Neg(inner) => vec![inner],
            Node::Binary { left, right, .. } | Node::Compare { left, right, .. } => {
                vec![left, right]
            }
            Node::Call { args, .. } => args.iter().map(|arg| &arg.value).collect(),
        }
    }

    pub(crate) fn children_mut(&mut self) -> Vec<&mut Expr> {
        match &mut self.node {
            Node::Number { .. } | Node::Name(_) => Vec::new(),
            Node::Neg(inner) => vec![inner],
            Node::Binary { left, right, .. } | Node::Compare { left, right, .. } => {
                vec![left, right]
            }
            Node::Call { args, .. } => args.iter_mut().map(|arg| &mut arg.value).collect(),
        }
    }

    /// Calls `see` on the node and on everything below it, parents first.
    pub(crate) fn walk<'e>(&'e self, see: &mut impl FnMut(&'e Expr)) {
        see(self);
        for child in self.children() {
            child.walk(see);
        }
    }

    /// The same tree ignoring where it stands in a text and how its numbers are spelled.
    pub fn same(&self, other: &Expr) -> bool {
        let kind = match (&self.node, &other.node) {
            (Node::Number { value: a, .. }, Node::Number { value: b, .. }) => a == b,
            (Node::Name(a), Node::Name(b)) => a == b,
            (Node::Neg(_), Node::Neg(_)) => true,
            (Node::Binary { op: a, .. }, Node::Binary { op: b, .. }) => a == b,
            (Node::Compare { op: a, .. }, Node::Compare { op: b, .. }) => a == b,
            (Node::Call { name: a, args: c }, Node::Call { name: b, args: d }) => {
                a == b
                    && c.len() == d.len()
                    && c.iter().zip(d).all(|(left, right)| left.name == right.name)
            }
            _ => false,
        };
        kind && self
            .children()
            .into_iter()
            .zip(other.children())
            .all(|(left, right)| left.same(right))
    }
}

/// The shortest decimal that reads back as the same number, in digits the lexer takes.
pub(crate) fn plain(value: f64) -> String {
    let magnitude = value.abs();
    if magnitude != 0.0 && !(1e-5..1e16).contains(&magnitude) {
        format!("{value:e}")
    } else {
        format!("{value}")
    }
}

impl fmt::Display for Expr {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let inner = |out: &mut fmt::Formatter<'_>, expr: &Expr, least: u8| {
            if expr.node.binding() < least {
                write!(out, "({expr})")
            } else {
                write!(out, "{expr}")
            }
        };
        match &self.node {
            Node::Number { text, .. } => out.write_str(text),
            Node::Name(name) => out.write_str(name),
            Node::Neg(operand) => {
                out.write_str("-")?;
                inner(out, operand, binding::NEG)
            }
            Node::Binary {
                op: BinaryOp::Pow,
                left,
                right,
            } => {
                inner(out, left, binding::ATOM)?;
                out.write_str("^")?;
                // A minus may stand in an exponent without parentheses.
                inner(out, right, binding::NEG)
            }
            Node::Binary { op, left, right } => {
                let own = self.node.binding();
                inner(out, left, own)?;
                write!(out, " {} ", op.symbol())?;
                inner(out, right, own + 1)
            }
            Node::Compare { op, left, right } => {
                inner(out, left, binding::SUM)?;
                write!(out, " {} ", op.symbol())?;
                inner(out, right, binding::SUM)
            }
            Node::Call { name, args } => {
                write!(out, "{name}(")?;
                for (index, arg) in args.iter().enumerate() {
                    if index > 0 {
                        out.write_str(", ")?;
                    }
                    if let Some(name) = &arg.name {
                        write!(out, "{name} = ")?;
                    }
                    write!(out, "{}", arg.value)?;
                }
                out.write_str(")")
            }
        }
    }
}
