//! A tree and its library become a [`Dag`]: calls of definitions opened, arguments found,
//! equal operations shared. Every question about a formula's value starts here.

use crate::builtin::Builtin;
use crate::dag::{Dag, Id, Op, Origin, TermRef};
use crate::error::{Error, Span};
use crate::expr::{BinaryOp, Expr, Node};
use crate::library::{Definition, Library, MAX_OPERATIONS};
use crate::scope::{Binding, Callee, Convert, Found, Scope, bind};
use std::collections::HashMap;

/// Greatest depth of a formula with its definitions opened.
const MAX_OPENED_DEPTH: usize = 300;

/// Largest whole exponent that becomes products.
pub(crate) const MAX_PRODUCT_POWER: i32 = 64;

impl Library {
    /// Opens an expression. `givens` become the first inputs; without them any name is
    /// taken as given.
    pub(crate) fn lower(&self, expr: &Expr, givens: Option<&[&str]>) -> Result<Dag, Error> {
        let mut dag = Dag::default();
        let root = self.lower_into(&mut dag, expr, givens)?;
        dag.root = root;
        Ok(dag)
    }

    /// Opens an expression into a dag that may hold others, sharing what they share.
    pub(crate) fn lower_into(
        &self,
        dag: &mut Dag,
        expr: &Expr,
        givens: Option<&[&str]>,
    ) -> Result<Id, Error> {
        for name in givens.unwrap_or(&[]) {
            dag.input(name);
        }
        let mut lowerer = Lowerer {
            library: self,
            dag,
            givens,
            opened: HashMap::new(),
            stack: Vec::new(),
            depth: 0,
            steps: 0,
        };
        lowerer.expr(expr, &Frame::default())
    }

    /// Opens a definition's body with its parameters as inputs and anything else given.
    /// Spans are into the definition's text.
    pub(crate) fn lower_definition(&self, definition: &Definition) -> Result<Dag, Error> {
        let mut dag = Dag::default();
        let mut lowerer = Lowerer {
            library: self,
            dag: &mut dag,
            givens: None,
            opened: HashMap::new(),
            stack: vec![definition.name.clone()],
            depth: 0,
            steps: 0,
        };
        let origin = Origin {
            span: Span::default(),
            within: None,
        };
        let mut params = Vec::new();
        for param in &definition.params {
            let input = lowerer.dag.input(param);
            params.push(lowerer.dag.push(Op::Input(input), origin));
        }
        let frame = Frame {
            definition: Some(definition),
            params,
            site: None,
        };
        let root = lowerer.expr(&definition.body, &frame)?;
        dag.root = root;
        Ok(dag)
    }
}

/// The definition whose body is being opened.
#[derive(Default)]
struct Frame<'l> {
    definition: Option<&'l Definition>,
    /// Values of its parameters.
    params: Vec<Id>,
    /// Where the whole expression called it, and its index among the opened ones; none
    /// where spans are into the text itself.
    site: Option<(Span, usize)>,
}

struct Lowerer<'l, 'd> {
    library: &'l Library,
    dag: &'d mut Dag,
    givens: Option<&'d [&'d str]>,
    /// The same definition with the same arguments is opened once.
    opened: HashMap<(String, Vec<Id>), Id>,
    stack: Vec<String>,
    depth: usize,
    steps: usize,
}

impl<'l> Lowerer<'l, '_> {
    fn origin(&self, span: Span, frame: &Frame) -> Origin {
        match frame.site {
            Some((site, index)) => Origin {
                span: site,
                within: Some((index, span)),
            },
            None => Origin { span, within: None },
        }
    }

    /// An error inside a definition points at the call and names the definition.
    fn error(&self, error: Error, frame: &Frame) -> Error {
        match (frame.site, frame.definition) {
            (Some((site, _)), Some(definition)) => Error {
                span: site,
                message: format!("in {}: {}", definition.name, error.message),
                help: error.help,
            },
            _ => error,
        }
    }

    fn push(&mut self, op: Op, span: Span, frame: &Frame) -> Id {
        let origin = self.origin(span, frame);
        self.dag.push(op, origin)
    }

    fn expr(&mut self, expr: &Expr, frame: &Frame<'l>) -> Result<Id, Error> {
        let span = expr.span;
        self.depth += 1;
        self.steps += 1;
        // Too large is the whole, not the definition in which that shows.
        let whole = frame.site.map_or(span, |(site, _)| site);
        if self.depth > MAX_OPENED_DEPTH {
            let message = "with its definitions opened this is nested too deep";
            return Err(Error::new(whole, message));
        }
        if self.steps > MAX_OPERATIONS || self.dag.ops.len() > MAX_OPERATIONS {
            let message = format!(
                "with its definitions opened this has more than {MAX_OPERATIONS} operations"
            );
            return Err(Error::new(whole, message));
        }
        let id = match &expr.node {
            Node::Number { value, .. } => self.push(Op::Number(value.to_bits()), span, frame),
            Node::Name(name) if name == "pi" => self.push(Op::Pi, span, frame),
            Node::Name(name) => {
                let found = self.scope(frame).written(name).ok_or_else(|| {
                    let error = self.scope(frame).unknown(self.library, name, span);
                    self.error(error, frame)
                })?;
                self.found(found, span, frame)
            }
            Node::Neg(inner) => {
                let inner = self.expr(inner, frame)?;
                self.push(Op::Neg(inner), span, frame)
            }
            Node::Binary {
                op: BinaryOp::Pow,
                left,
                right,
            } => self.power(left, right, span, frame)?,
            Node::Binary { op, left, right } => {
                let (left, right) = (self.expr(left, frame)?, self.expr(right, frame)?);
                let op = match op {
                    BinaryOp::Add => Op::Add(left, right),
                    BinaryOp::Sub => Op::Sub(left, right),
                    BinaryOp::Mul => Op::Mul(left, right),
                    BinaryOp::Div => Op::Div(left, right),
                    BinaryOp::Pow => Op::Pow(left, right),
                };
                self.push(op, span, frame)
            }
            Node::Compare { op, left, right } => {
                let (left, right) = (self.expr(left, frame)?, self.expr(right, frame)?);
                self.push(Op::Compare(*op, left, right), span, frame)
            }
            Node::Call { .. } => self.call(expr, frame)?,
        };
        self.depth -= 1;
        Ok(id)
    }

    fn scope<'a>(&'a self, frame: &'a Frame<'l>) -> Scope<'a> {
        Scope {
            own: frame
                .definition
                .map(|definition| definition.params.as_slice()),
            givens: self.givens,
        }
    }

    fn found(&mut self, found: Found, span: Span, frame: &Frame) -> Id {
        let (id, convert) = match found {
            Found::Own(name, convert) => {
                let params = frame
                    .definition
                    .map_or(&[][..], |definition| &definition.params);
                let index = params.iter().position(|param| *param == name).unwrap_or(0);
                (frame.params.get(index).copied().unwrap_or(0), convert)
            }
            Found::Given(name, convert) => {
                let input = self.dag.input(&name);
                (self.push(Op::Input(input), span, frame), convert)
            }
        };
        self.convert(id, convert, span, frame)
    }

    fn convert(&mut self, id: Id, convert: Convert, span: Span, frame: &Frame) -> Id {
        match convert {
            Convert::Same => id,
            Convert::Square => self.push(Op::PowInt(id, 2), span, frame),
            Convert::Root => self.push(Op::Unary(Builtin::Sqrt, id), span, frame),
        }
    }

    fn power(
        &mut self,
        base: &Expr,
        exponent: &Expr,
        span: Span,
        frame: &Frame<'l>,
    ) -> Result<Id, Error> {
        let base = self.expr(base, frame)?;
        if let Some(whole) = whole_exponent(exponent) {
            return Ok(self.push(Op::PowInt(base, whole), span, frame));
        }
        let exponent = self.expr(exponent, frame)?;
        Ok(self.push(Op::Pow(base, exponent), span, frame))
    }

    fn call(&mut self, expr: &Expr, frame: &Frame<'l>) -> Result<Id, Error> {
        let Node::Call { name, args } = &expr.node else {
            return self.expr(expr, frame);
        };
        let span = expr.span;
        let callee = self
            .library
            .callee(name, args, span)
            .map_err(|error| self.error(error, frame))?;
        if let Callee::Builtin(builtin) = callee {
            if let (Builtin::Pow, [base, exponent]) = (builtin, args.as_slice()) {
                return self.power(&base.value, &exponent.value, span, frame);
            }
            let mut values = Vec::new();
            for arg in args {
                values.push(self.expr(&arg.value, frame)?);
            }
            let mut id = values.first().copied().unwrap_or(0);
            match builtin {
                Builtin::Min | Builtin::Max => {
                    for value in &values[1..] {
                        let op = match builtin {
                            Builtin::Min => Op::Min(id, *value),
                            _ => Op::Max(id, *value),
                        };
                        id = self.push(op, span, frame);
                    }
                }
                _ => id = self.push(Op::Unary(builtin, id), span, frame),
            }
            return Ok(id);
        }
        let bound = bind(name, &callee.params(), args, span, self.scope(frame))
            .map_err(|error| self.error(error, frame))?;
        let mut values = Vec::new();
        for binding in bound {
            values.push(match binding {
                Binding::Explicit(value, convert) => {
                    let id = self.expr(value, frame)?;
                    self.convert(id, convert, value.span, frame)
                }
                Binding::Implicit(found) => self.found(found, span, frame),
            });
        }
        match callee {
            Callee::Definition(definition) => self.open(definition, values, span, frame),
            Callee::Term(term) => Ok(self.push(Op::Term(TermRef(term), values), span, frame)),
            Callee::Builtin(_) => Ok(0),
        }
    }

    fn open(
        &mut self,
        definition: &'l Definition,
        params: Vec<Id>,
        span: Span,
        frame: &Frame<'l>,
    ) -> Result<Id, Error> {
        let key = (definition.name.clone(), params.clone());
        if let Some(id) = self.opened.get(&key) {
            return Ok(*id);
        }
        if let Some(start) = self.stack.iter().position(|name| *name == definition.name) {
            let mut round = self.stack[start..].to_vec();
            round.push(definition.name.clone());
            let message = format!(
                "{} is defined by itself: {}",
                definition.name,
                round.join(" → ")
            );
            let whole = frame.site.map_or(span, |(site, _)| site);
            return Err(Error::new(whole, message));
        }
        let known = self
            .dag
            .definitions
            .iter()
            .position(|name| *name == definition.name);
        let index = known.unwrap_or_else(|| {
            self.dag.definitions.push(definition.name.clone());
            self.dag.definitions.len() - 1
        });
        self.stack.push(definition.name.clone());
        let inner = Frame {
            definition: Some(definition),
            params,
            site: Some((frame.site.map_or(span, |(site, _)| site), index)),
        };
        let id = self.expr(&definition.body, &inner)?;
        self.stack.pop();
        self.opened.insert(key, id);
        Ok(id)
    }
}

/// The exponent, where it is a small whole number written as such.
pub(crate) fn whole_exponent(expr: &Expr) -> Option<i32> {
    match &expr.node {
        Node::Number { value, .. }
            if value.fract() == 0.0 && value.abs() <= f64::from(MAX_PRODUCT_POWER) =>
        {
            Some(*value as i32)
        }
        Node::Neg(inner) => match &inner.node {
            Node::Number { .. } => whole_exponent(inner).map(|value| -value),
            _ => None,
        },
        _ => None,
    }
}
