//! Formulas as people write them on a board, in Unicode.

use crate::builtin::Builtin;
use crate::expr::{Arg, BinaryOp, CompareOp, Expr, Node, binding};
use crate::library::Library;
use crate::spelling::{dot_product, superscript, unicode_name};

impl Library {
    /// The formula in Unicode: `α² / (π·((N·H)²·(α² − 1) + 1)²)`.
    pub fn unicode(&self, expr: &Expr) -> String {
        Board::symbols(self).write(expr)
    }
}

/// How a formula is written.
pub(crate) struct Board<'a> {
    library: &'a Library,
    /// Significant digits of numbers that nobody typed.
    digits: Option<u32>,
}

impl<'a> Board<'a> {
    /// Names as symbols, numbers as typed.
    pub fn symbols(library: &'a Library) -> Board<'a> {
        Board {
            library,
            digits: None,
        }
    }

    /// Mostly numbers, rounded to so many significant digits.
    pub fn numbers(library: &'a Library, digits: u32) -> Board<'a> {
        Board {
            library,
            digits: Some(digits),
        }
    }

    /// The formula as text.
    pub fn write(&self, expr: &Expr) -> String {
        self.part(expr).0
    }

    /// The text, and how tightly it binds.
    fn part(&self, expr: &Expr) -> (String, u8) {
        match &expr.node {
            Node::Number { value, text } => self.number(*value, text),
            Node::Name(name) => {
                let text = unicode_name(name);
                let bind = if dot_product(name).is_some() || text.contains(' ') {
                    binding::DOT
                } else if text.ends_with('²') {
                    binding::POWER
                } else {
                    binding::ATOM
                };
                (text, bind)
            }
            Node::Neg(inner) => (
                format!("−{}", self.at_least(inner, binding::POWER)),
                binding::NEG,
            ),
            Node::Binary {
                op: BinaryOp::Pow,
                left,
                right,
            } => self.power(left, right),
            Node::Binary { op, left, right } => self.binary(*op, left, right),
            Node::Compare { op, left, right } => {
                let sign = match op {
                    CompareOp::Less => "<",
                    CompareOp::LessEqual => "≤",
                    CompareOp::Greater => ">",
                    CompareOp::GreaterEqual => "≥",
                    CompareOp::Equal => "=",
                    CompareOp::NotEqual => "≠",
                };
                let (left, right) = (
                    self.at_least(left, binding::SUM),
                    self.at_least(right, binding::SUM),
                );
                (format!("{left} {sign} {right}"), binding::COMPARE)
            }
            Node::Call { name, args } => match Builtin::named(name) {
                Some(builtin) => self.builtin(builtin, args),
                None => self.call(name, args),
            },
        }
    }

    /// The text, in parentheses where it binds less tightly than wanted.
    fn at_least(&self, expr: &Expr, least: u8) -> String {
        let (text, bind) = self.part(expr);
        if bind < least {
            format!("({text})")
        } else {
            text
        }
    }

    fn number(&self, value: f64, text: &str) -> (String, u8) {
        let spelled = match self.digits {
            Some(digits) if text.is_empty() => short(value, digits),
            _ => text.to_string(),
        };
        let text = spelled.replace('-', "−");
        match text.split_once(['e', 'E']) {
            Some((mantissa, exponent)) => {
                let exponent = exponent.trim_start_matches('+').replace('−', "-");
                let power = format!("10{}", superscript(&exponent));
                match mantissa {
                    "1" => (power, binding::POWER),
                    _ => (format!("{mantissa}·{power}"), binding::PRODUCT),
                }
            }
            None if text.starts_with('−') => (text, binding::NEG),
            None => (text, binding::ATOM),
        }
    }

    fn power(&self, base: &Expr, exponent: &Expr) -> (String, u8) {
        let base = self.at_least(base, binding::ATOM);
        let whole = match &exponent.node {
            Node::Number { text, .. } => Some(text.clone()),
            Node::Neg(inner) => match &inner.node {
                Node::Number { text, .. } => Some(format!("-{text}")),
                _ => None,
            },
            _ => None,
        };
        let digits = |text: &String| text.bytes().all(|b| b.is_ascii_digit() || b == b'-');
        let text = match whole.filter(digits) {
            Some(whole) => format!("{base}{}", superscript(&whole)),
            None => format!("{base}^{}", self.at_least(exponent, binding::ATOM)),
        };
        (text, binding::POWER)
    }

    fn binary(&self, op: BinaryOp, left: &Expr, right: &Expr) -> (String, u8) {
        let own = match op {
            BinaryOp::Add | BinaryOp::Sub => binding::SUM,
            _ => binding::PRODUCT,
        };
        let left_text = self.at_least(left, own);
        // A minus behind an operator is put in parentheses: 3 − (−2).
        let right_least = match (op, &right.node) {
            (
                BinaryOp::Mul,
                Node::Binary {
                    op: BinaryOp::Mul, ..
                },
            ) => binding::PRODUCT,
            (
                BinaryOp::Add,
                Node::Binary {
                    op: BinaryOp::Add, ..
                },
            ) => binding::SUM,
            (BinaryOp::Add | BinaryOp::Sub, Node::Neg(_)) => binding::POWER,
            (BinaryOp::Add | BinaryOp::Sub, Node::Number { value, .. }) if *value < 0.0 => {
                binding::POWER
            }
            (BinaryOp::Add | BinaryOp::Sub, _) => binding::DOT,
            _ => binding::POWER,
        };
        let right_text = self.at_least(right, right_least);
        let sign = match op {
            BinaryOp::Add => " + ",
            BinaryOp::Sub => " − ",
            BinaryOp::Div => " / ",
            // Between digits a tight dot would look like a decimal point.
            _ if self.digits.is_some() => " · ",
            _ => "·",
        };
        (format!("{left_text}{sign}{right_text}"), own)
    }

    fn builtin(&self, builtin: Builtin, args: &[Arg]) -> (String, u8) {
        let list = || {
            let written: Vec<String> = args.iter().map(|arg| self.write(&arg.value)).collect();
            written.join(", ")
        };
        match (builtin, args) {
            (Builtin::Pow, [base, exponent]) => self.power(&base.value, &exponent.value),
            (Builtin::Sqrt, [arg]) => match self.part(&arg.value) {
                (text, binding::ATOM) if !text.starts_with('√') => {
                    (format!("√{text}"), binding::POWER)
                }
                (text, _) => (format!("√({text})"), binding::POWER),
            },
            (Builtin::Abs, [arg]) => (format!("|{}|", self.write(&arg.value)), binding::ATOM),
            (Builtin::Deg, [arg]) => match self.part(&arg.value) {
                (text, binding::ATOM | binding::NEG) => (format!("{text}°"), binding::NEG),
                (text, _) => (format!("({text})°"), binding::POWER),
            },
            (Builtin::Log2, _) => (format!("log₂({})", list()), binding::ATOM),
            _ => (format!("{}({})", builtin.name(), list()), binding::ATOM),
        }
    }

    fn call(&self, name: &str, args: &[Arg]) -> (String, u8) {
        let symbol = match brdf::term(name) {
            Some(term) if self.library.definition(name).is_none() => term.symbol.to_string(),
            _ => unicode_name(name),
        };
        let spaced = symbol.contains([' ', '·']);
        match args {
            [] if spaced => (symbol, binding::DOT),
            [] => (symbol, binding::ATOM),
            [only] if only.name.as_deref().is_none_or(placeholder) => (
                format!("{symbol}({})", self.write(&only.value)),
                binding::ATOM,
            ),
            _ => {
                let written: Vec<String> = args
                    .iter()
                    .map(|arg| match &arg.name {
                        Some(name) => {
                            format!("{} = {}", unicode_name(name), self.write(&arg.value))
                        }
                        None => self.write(&arg.value),
                    })
                    .collect();
                (format!("{symbol}({})", written.join(", ")), binding::ATOM)
            }
        }
    }
}

/// A parameter that stands for anything: nobody writes `s(c = N·V)` on a board.
pub(crate) fn placeholder(name: &str) -> bool {
    name == "n_dot_x" || (unicode_name(name) == name && name.len() <= 2)
}

/// A number rounded to so many significant digits, without trailing zeros.
pub(crate) fn short(value: f64, digits: u32) -> String {
    crate::expr::plain(crate::digits::rounded(value, digits))
}
