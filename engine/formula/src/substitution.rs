//! A formula with its numbers put in, step by step, as a person writes it on a board.

use crate::builtin::Builtin;
use crate::digits::{Digits, format_number, rounded, significant_digits};
use crate::error::Error;
use crate::expr::{Arg, BinaryOp, Expr, Node};
use crate::library::{Library, Values};
use crate::pretty::Board;
use crate::scope::{Binding, Callee, Convert, Found, Scope, bind, twin};
use crate::spelling::unicode_name;

/// Numeric lines shown at most, below the line in symbols where there is one.
const MOST_LINES: usize = 3;

/// Wider lines are left out where a shorter one follows.
const WIDEST: usize = 70;

/// The line in symbols may fill a terminal of 80 columns.
const WIDEST_SYMBOLS: usize = 76;

/// A definition opened inside a definition inside … is shown from this level on.
const MOST_OPENED: usize = 4;

/// The lines between a formula and its value.
#[derive(Clone, Debug, PartialEq)]
pub struct Substitution {
    /// At most four lines in Unicode, the result not among them: for a call of a
    /// definition first its body in symbols, then the numbers put in, then what is left
    /// after the inner operations. Empty where there is nothing to compute.
    ///
    /// Whoever computes with the numbers of any of these lines gets `shown`.
    pub lines: Vec<String>,
    /// The value at full precision.
    pub value: f64,
    /// The value with the digits asked for.
    pub shown: String,
}

/// The body of a definition that is called, and what its names stand for.
struct Opened<'l> {
    body: &'l Expr,
    values: Values,
    /// Equations that a reader needs, `c = N·V`.
    notes: Vec<String>,
}

/// One parameter of a call.
struct Bound<'l> {
    param: &'l str,
    value: f64,
    note: Option<String>,
}

impl Library {
    /// Puts numbers into a formula.
    ///
    /// # Errors
    /// As [`Library::eval`].
    pub fn substitution(
        &self,
        expr: &Expr,
        values: &Values,
        digits: Digits,
    ) -> Result<Substitution, Error> {
        let value = self.eval(expr, values)?;
        let shown = format_number(value, digits);
        let mut lines = Vec::new();
        let mut values = values.clone();
        let mut body = expr;
        for _ in 0..MOST_OPENED {
            let Some(opened) = self.open(body, &values)? else {
                break;
            };
            let symbols = Board::symbols(self).write(opened.body);
            lines.clear();
            lines.push(match opened.notes.is_empty() {
                true => symbols,
                false => format!("{symbols}  with {}", opened.notes.join(", ")),
            });
            (body, values) = (opened.body, opened.values);
        }
        let least = significant_digits(&shown).unwrap_or(4).max(3) + 1;
        let line = Lines {
            library: self,
            digits,
            shown: &shown,
            least,
        };
        match self.core_call(body, &values)? {
            Some(call) => lines.push(line.write(&call)),
            None => lines.extend(line.steps(&self.put_in(body, &values)?)?),
        }
        // Symbols that do not fit a line explain nothing.
        if lines.len() > 1 && lines[0].chars().count() > WIDEST_SYMBOLS {
            lines.remove(0);
        }
        Ok(Substitution {
            lines,
            value,
            shown,
        })
    }

    /// The body of the definition that an expression calls, the values its names have, and
    /// what to say about them.
    fn open(&self, expr: &Expr, values: &Values) -> Result<Option<Opened<'_>>, Error> {
        let Node::Call { name, args } = &expr.node else {
            return Ok(None);
        };
        let Callee::Definition(definition) = self.callee(name, args, expr.span)? else {
            return Ok(None);
        };
        let mut inner = values.clone();
        let mut notes = Vec::new();
        for Bound { param, value, note } in self.bound(expr, values)? {
            // A parameter hides the given that would be its other name.
            if let Some((other, _)) = twin(param)
                && !definition.params.iter().any(|own| own == other)
            {
                inner.remove(other);
            }
            inner.insert(param.to_string(), value);
            notes.extend(note);
        }
        Ok(Some(Opened {
            body: &definition.body,
            values: inner,
            notes,
        }))
    }

    /// Every parameter of a call with its value, and the equation that a reader needs.
    fn bound(&self, expr: &Expr, values: &Values) -> Result<Vec<Bound<'_>>, Error> {
        let Node::Call { name, args } = &expr.node else {
            return Ok(Vec::new());
        };
        let names: Vec<&str> = values.keys().map(String::as_str).collect();
        let scope = Scope {
            own: None,
            givens: Some(&names),
        };
        let params = self.callee(name, args, expr.span)?.params();
        let bindings = bind(name, &params, args, expr.span, scope)?;
        let mut bound = Vec::new();
        for (param, binding) in params.into_iter().zip(bindings) {
            let (source, convert, explicit) = match binding {
                Binding::Explicit(source, convert) => (source.clone(), convert, true),
                Binding::Implicit(Found::Own(name, convert) | Found::Given(name, convert)) => {
                    (Expr::name(&name), convert, false)
                }
            };
            let source = converted(source, convert);
            let value = self.eval(&source, values)?;
            let mut names_itself = false;
            source.walk(&mut |part| {
                names_itself |= matches!(&part.node, Node::Name(name) if name == param)
            });
            let noted = (explicit || convert != Convert::Same)
                && !matches!(&source.node, Node::Name(name) if name == param);
            let note = noted.then(|| {
                let right = if names_itself {
                    crate::pretty::short(value, 6)
                } else {
                    Board::symbols(self).write(&source)
                };
                format!("{} = {right}", unicode_name(param))
            });
            bound.push(Bound { param, value, note });
        }
        Ok(bound)
    }

    /// A call of the core with every argument as a number, where the expression is one.
    fn core_call(&self, expr: &Expr, values: &Values) -> Result<Option<Expr>, Error> {
        let Node::Call { name, args } = &expr.node else {
            return Ok(None);
        };
        let Callee::Term(_) = self.callee(name, args, expr.span)? else {
            return Ok(None);
        };
        let bound = self.bound(expr, values)?;
        let args = bound
            .into_iter()
            .map(|Bound { param, value, .. }| Arg {
                name: Some(param.to_string()),
                value: signed(value),
            })
            .collect();
        Ok(Some(Expr::call(name, args)))
    }

    /// Numbers for names and for calls; elementary operations stay.
    fn put_in(&self, expr: &Expr, values: &Values) -> Result<Expr, Error> {
        Ok(match &expr.node {
            Node::Number { .. } => expr.clone(),
            Node::Name(name) if name == "pi" => expr.clone(),
            Node::Name(_) => signed(self.eval(expr, values)?),
            Node::Call { name, .. } if Builtin::named(name).is_none() => {
                signed(self.eval(expr, values)?)
            }
            _ => {
                let mut expr = expr.clone();
                for child in expr.children_mut() {
                    *child = self.put_in(child, values)?;
                }
                expr
            }
        })
    }
}

fn converted(source: Expr, convert: Convert) -> Expr {
    match convert {
        Convert::Same => source,
        Convert::Square => Expr::binary(BinaryOp::Pow, source, Expr::number(2.0)),
        Convert::Root => {
            let arg = Arg {
                name: None,
                value: source,
            };
            Expr::call("sqrt", vec![arg])
        }
    }
}

/// A number that was computed or given and may be negative, as one leaf. Without a
/// spelling of its own it is rounded for the board.
fn signed(value: f64) -> Expr {
    Expr::made(Node::Number {
        value,
        text: String::new(),
    })
}

struct Lines<'a> {
    library: &'a Library,
    digits: Digits,
    shown: &'a str,
    least: u32,
}

impl Lines<'_> {
    /// The numbers put in, then the same with the inner operations done.
    fn steps(&self, full: &Expr) -> Result<Vec<String>, Error> {
        let height = height(full);
        let mut lines: Vec<String> = Vec::new();
        for level in 0..height {
            let line = self.write(&self.done(full, level)?);
            if lines.last() != Some(&line) {
                lines.push(line);
            }
        }
        let wide = |line: &String| line.chars().count() > WIDEST;
        while lines.len() > 1 && wide(&lines[0]) {
            lines.remove(0);
        }
        // The first, the last and the middle explain; more would not be read.
        if lines.len() > MOST_LINES {
            let last = lines.len() - 1;
            lines = (0..MOST_LINES)
                .map(|index| lines[index * last / (MOST_LINES - 1)].clone())
                .collect();
        }
        Ok(lines)
    }

    /// Every operation up to a level replaced by its value.
    fn done(&self, expr: &Expr, level: usize) -> Result<Expr, Error> {
        let own = height(expr);
        // An angle stays in degrees until the function that takes it is worked out.
        let angle = matches!(&expr.node, Node::Call { name, .. } if name == "deg");
        if own > 0 && own <= level && !angle {
            return Ok(signed(self.library.eval(expr, &Values::new())?));
        }
        self.inside(expr, level)
    }

    fn inside(&self, expr: &Expr, level: usize) -> Result<Expr, Error> {
        let mut result = expr.clone();
        match &mut result.node {
            // A chain is one operation to a reader: 4·0.8·0.6 is not shown as 3.2·0.6.
            Node::Binary { op, left, right } if chained(*op, left) => {
                **left = self.inside(left, level)?;
                **right = self.done(right, level)?;
            }
            _ => {
                for child in result.children_mut() {
                    *child = self.done(child, level)?;
                }
            }
        }
        Ok(result)
    }

    /// The line with as few digits as still give the result shown.
    fn write(&self, line: &Expr) -> String {
        let enough = (self.least..17).find(|digits| {
            let mut line = line.clone();
            shorten(&mut line, *digits);
            self.library
                .eval(&line, &Values::new())
                .is_ok_and(|value| format_number(value, self.digits) == self.shown)
        });
        Board::numbers(self.library, enough.unwrap_or(17)).write(line)
    }
}

fn shorten(expr: &mut Expr, digits: u32) {
    if let Node::Number { value, text } = &mut expr.node
        && text.is_empty()
    {
        *value = rounded(*value, digits);
    }
    for child in expr.children_mut() {
        shorten(child, digits);
    }
}

/// Whether the left operand continues the same chain of sums or products.
fn chained(op: BinaryOp, left: &Expr) -> bool {
    match (&left.node, op) {
        (Node::Binary { op: inner, .. }, BinaryOp::Add | BinaryOp::Sub) => {
            matches!(inner, BinaryOp::Add | BinaryOp::Sub)
        }
        (Node::Binary { op: inner, .. }, BinaryOp::Mul) => *inner == BinaryOp::Mul,
        _ => false,
    }
}

/// How many operations lie on top of each other, a chain counted as one.
fn height(expr: &Expr) -> usize {
    match &expr.node {
        Node::Number { .. } | Node::Name(_) => 0,
        Node::Neg(inner) => height(inner),
        // An angle in degrees is a number to a reader.
        Node::Call { name, args } if name == "deg" => {
            args.first().map_or(0, |arg| height(&arg.value))
        }
        Node::Binary { op, left, right } if chained(*op, left) => {
            height(left).max(height(right) + 1)
        }
        _ => 1 + expr.children().into_iter().map(height).max().unwrap_or(0),
    }
}
