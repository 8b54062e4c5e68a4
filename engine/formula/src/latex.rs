//! Formulas in LaTeX, for transcripts and web pages.

use crate::builtin::Builtin;
use crate::expr::{Arg, BinaryOp, CompareOp, Expr, Node, binding};
use crate::library::Library;
use crate::pretty::placeholder;
use crate::spelling::{dot_product, latex_name};

impl Library {
    /// The formula in LaTeX, for math mode.
    pub fn latex(&self, expr: &Expr) -> String {
        part(self, expr).0
    }
}

/// The text, and how tightly it binds. A fraction is as tight as an atom, but not below a
/// power.
fn part(library: &Library, expr: &Expr) -> (String, u8) {
    match &expr.node {
        Node::Number { text, .. } => number(text),
        Node::Name(name) => {
            let bind = if dot_product(name).is_some() {
                binding::DOT
            } else if name == "alpha_squared" || name == "cos_phi" {
                binding::POWER
            } else {
                binding::ATOM
            };
            (latex_name(name), bind)
        }
        Node::Neg(inner) => (
            format!("-{}", at_least(library, inner, binding::POWER)),
            binding::NEG,
        ),
        Node::Binary { op, left, right } => binary(library, *op, left, right),
        Node::Compare { op, left, right } => {
            let sign = match op {
                CompareOp::Less => "<",
                CompareOp::LessEqual => r"\le",
                CompareOp::Greater => ">",
                CompareOp::GreaterEqual => r"\ge",
                CompareOp::Equal => "=",
                CompareOp::NotEqual => r"\ne",
            };
            let left = at_least(library, left, binding::SUM);
            let right = at_least(library, right, binding::SUM);
            (format!("{left} {sign} {right}"), binding::COMPARE)
        }
        Node::Call { name, args } => match Builtin::named(name) {
            Some(builtin) => elementary(library, builtin, args),
            None => call(library, name, args),
        },
    }
}

fn number(text: &str) -> (String, u8) {
    match text.split_once(['e', 'E']) {
        Some((mantissa, exponent)) => {
            let exponent = exponent.trim_start_matches('+');
            (
                format!(r"{mantissa} \cdot 10^{{{exponent}}}"),
                binding::PRODUCT,
            )
        }
        None => (text.to_string(), binding::ATOM),
    }
}

fn at_least(library: &Library, expr: &Expr, least: u8) -> String {
    let (text, bind) = part(library, expr);
    if bind < least {
        parenthesised(&text)
    } else {
        text
    }
}

fn parenthesised(text: &str) -> String {
    format!(r"\left({text}\right)")
}

fn binary(library: &Library, op: BinaryOp, left: &Expr, right: &Expr) -> (String, u8) {
    let inner = |expr: &Expr, least: u8| at_least(library, expr, least);
    match op {
        BinaryOp::Add => {
            let text = format!(
                "{} + {}",
                inner(left, binding::SUM),
                inner(right, binding::DOT)
            );
            (text, binding::SUM)
        }
        BinaryOp::Sub => {
            let text = format!(
                "{} - {}",
                inner(left, binding::SUM),
                inner(right, binding::DOT)
            );
            (text, binding::SUM)
        }
        BinaryOp::Mul => {
            // Two numbers side by side would read as one.
            let digits = ends_in_digit(left) && starts_with_digit(right);
            let sign = if digits { r"\cdot" } else { r"\," };
            let (left, right) = (inner(left, binding::PRODUCT), inner(right, binding::POWER));
            (format!("{left} {sign} {right}"), binding::PRODUCT)
        }
        BinaryOp::Div => {
            let text = format!(r"\frac{{{}}}{{{}}}", inner(left, 0), inner(right, 0));
            (text, binding::POWER)
        }
        BinaryOp::Pow => {
            let text = format!("{}^{{{}}}", inner(left, binding::ATOM), inner(right, 0));
            (text, binding::POWER)
        }
    }
}

fn ends_in_digit(expr: &Expr) -> bool {
    match &expr.node {
        Node::Number { .. } => true,
        Node::Binary {
            op: BinaryOp::Mul,
            right,
            ..
        } => ends_in_digit(right),
        Node::Neg(inner) => ends_in_digit(inner),
        _ => false,
    }
}

fn starts_with_digit(expr: &Expr) -> bool {
    match &expr.node {
        Node::Number { .. } => true,
        Node::Binary {
            op: BinaryOp::Pow,
            left,
            ..
        } => starts_with_digit(left),
        _ => false,
    }
}

fn elementary(library: &Library, builtin: Builtin, args: &[Arg]) -> (String, u8) {
    let list: Vec<String> = args.iter().map(|arg| part(library, &arg.value).0).collect();
    let list = list.join(", ");
    let function = |name: &str| (format!("{name}{}", parenthesised(&list)), binding::ATOM);
    match (builtin, args) {
        (Builtin::Pow, [base, exponent]) => {
            binary(library, BinaryOp::Pow, &base.value, &exponent.value)
        }
        (Builtin::Sqrt, _) => (format!(r"\sqrt{{{list}}}"), binding::ATOM),
        (Builtin::Abs, _) => (format!(r"\left|{list}\right|"), binding::ATOM),
        (Builtin::Deg, [arg]) => (
            format!(
                r"{}^{{\circ}}",
                at_least(library, &arg.value, binding::ATOM)
            ),
            binding::POWER,
        ),
        (Builtin::Asin, _) => function(r"\arcsin"),
        (Builtin::Acos, _) => function(r"\arccos"),
        (Builtin::Atan, _) => function(r"\arctan"),
        (Builtin::Log2, _) => function(r"\log_2"),
        _ => function(&format!(r"\{}", builtin.name())),
    }
}

fn call(library: &Library, name: &str, args: &[Arg]) -> (String, u8) {
    let symbol = match brdf::term(name) {
        Some(term) if library.definition(name).is_none() => term.latex.to_string(),
        _ => latex_name(name),
    };
    if args.is_empty() {
        let bind = if symbol.contains(' ') {
            binding::DOT
        } else {
            binding::ATOM
        };
        return (symbol, bind);
    }
    let list: Vec<String> = args
        .iter()
        .map(|arg| {
            let value = part(library, &arg.value).0;
            match &arg.name {
                Some(name) if args.len() > 1 || !placeholder(name) => {
                    format!("{} = {value}", latex_name(name))
                }
                _ => value,
            }
        })
        .collect();
    (
        format!("{symbol}{}", parenthesised(&list.join(", "))),
        binding::ATOM,
    )
}
