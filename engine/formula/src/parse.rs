//! Tokens become a tree. Precedence climbing in one function: the depth of its recursion
//! and the height of every tree it returns are limited, so that nothing that walks a tree
//! later can exhaust the stack.

use crate::builtin::Builtin;
use crate::error::{Error, Span, excerpt};
use crate::expr::{Arg, BinaryOp, Expr, Node, binding};
use crate::lex::{Lexed, Token, lex};

/// Longest text of a formula, in bytes.
pub const MAX_TEXT: usize = 4096;

/// Greatest height of a formula's tree; a sum of as many terms is as high.
pub const MAX_DEPTH: usize = 100;

/// Parses the author's language.
///
/// `^` is right-associative and binds tighter than unary minus; there is no implicit
/// product; `α π ² · − × √ °` mean what they look like. Names are not looked up here.
///
/// # Errors
/// A span into `text` and what was expected there.
pub fn parse(text: &str) -> Result<Expr, Error> {
    if text.len() > MAX_TEXT {
        let span = Span {
            start: 0,
            end: text.len(),
        };
        return Err(Error::new(
            span,
            format!(
                "a formula has at most {MAX_TEXT} bytes, this one {}",
                text.len()
            ),
        )
        .help("give parts of it names of their own"));
    }
    let tokens = lex(text)?;
    if tokens.len() == 1 {
        let span = Span {
            start: 0,
            end: text.len(),
        };
        return Err(Error::new(span, "expected a formula, found nothing"));
    }
    let mut parser = Parser {
        text,
        tokens,
        at: 0,
        depth: 0,
    };
    let (expr, _) = parser.expr(0)?;
    match &parser.peek().token {
        Token::End => Ok(expr),
        _ => Err(parser.unexpected("an operator or the end")),
    }
}

struct Parser<'t> {
    text: &'t str,
    tokens: Vec<Lexed>,
    at: usize,
    depth: usize,
}

/// A tree and its height.
type Grown = (Expr, usize);

impl Parser<'_> {
    fn peek(&self) -> &Lexed {
        &self.tokens[self.at.min(self.tokens.len() - 1)]
    }

    fn next(&mut self) -> Lexed {
        let lexed = self.peek().clone();
        self.at += 1;
        lexed
    }

    fn unexpected(&self, expected: &str) -> Error {
        let lexed = self.peek();
        match &lexed.token {
            Token::End => Error::new(lexed.span, format!("expected {expected}, found the end")),
            Token::Assign => Error::new(lexed.span, format!("expected {expected}, found \"=\""))
                .help("= names an argument, == compares"),
            _ => Error::new(
                lexed.span,
                format!(
                    "expected {expected}, found \"{}\"",
                    excerpt(lexed.span.of(self.text))
                ),
            ),
        }
    }

    fn too_deep(&self, span: Span) -> Error {
        Error::new(
            span,
            format!("nested or chained more than {MAX_DEPTH} deep"),
        )
        .help("give parts of it names of their own")
    }

    /// Wraps children into a node, minding the height.
    fn grow(&self, node: Node, span: Span, below: usize) -> Result<Grown, Error> {
        if below + 1 > MAX_DEPTH {
            return Err(self.too_deep(span));
        }
        Ok((Expr { node, span }, below + 1))
    }

    /// An expression whose operators all bind at least as tightly as `least`.
    fn expr(&mut self, least: u8) -> Result<Grown, Error> {
        self.depth += 1;
        if self.depth > MAX_DEPTH {
            return Err(self.too_deep(self.peek().span));
        }
        let mut left = self.prefix()?;
        let mut compared = false;
        loop {
            let (bind, op) = match &self.peek().token {
                Token::Plus => (binding::SUM, Some(BinaryOp::Add)),
                Token::Minus => (binding::SUM, Some(BinaryOp::Sub)),
                Token::Times => (binding::PRODUCT, Some(BinaryOp::Mul)),
                Token::Over => (binding::PRODUCT, Some(BinaryOp::Div)),
                Token::Caret => (binding::POWER, Some(BinaryOp::Pow)),
                Token::Compare(_) => (binding::COMPARE, None),
                Token::Number { .. } | Token::Name(_) | Token::Open | Token::Root => {
                    return Err(self.implicit_product(left.0.span));
                }
                _ => break,
            };
            if bind < least {
                break;
            }
            let lexed = self.next();
            // A power takes its own kind on the right; the others need something tighter.
            let right = self.expr(if bind == binding::POWER {
                bind
            } else {
                bind + 1
            })?;
            let span = left.0.span.to(right.0.span);
            let below = left.1.max(right.1);
            let (l, r) = (Box::new(left.0), Box::new(right.0));
            let node = match (op, lexed.token) {
                (Some(op), _) => Node::Binary {
                    op,
                    left: l,
                    right: r,
                },
                (None, Token::Compare(op)) if !compared => {
                    compared = true;
                    Node::Compare {
                        op,
                        left: l,
                        right: r,
                    }
                }
                _ => {
                    return Err(Error::new(lexed.span, "a comparison cannot be chained")
                        .help("multiply two comparisons to ask for both"));
                }
            };
            left = self.grow(node, span, below)?;
        }
        self.depth -= 1;
        Ok(left)
    }

    fn implicit_product(&self, left: Span) -> Error {
        let right = self.peek().span;
        let span = Span {
            start: left.start,
            end: right.end,
        };
        let right = match self.peek().token {
            Token::Open => "(…)".to_string(),
            _ => excerpt(right.of(self.text)),
        };
        let left = left.of(self.text);
        if Builtin::named(left).is_some() {
            let message = format!("{left} needs its argument in parentheses");
            return Error::new(span, message).help(format!("write {left}(…)"));
        }
        let tail = match left.char_indices().rev().nth(23) {
            Some((cut, _)) => format!("…{}", &left[cut..]),
            None => left.to_string(),
        };
        Error::new(
            span,
            format!("\"{tail} {right}\": write the product with *"),
        )
    }

    fn prefix(&mut self) -> Result<Grown, Error> {
        match self.peek().token {
            Token::Minus => {
                let minus = self.next();
                let (inner, below) = self.expr(binding::NEG)?;
                let span = minus.span.to(inner.span);
                self.grow(Node::Neg(Box::new(inner)), span, below)
            }
            Token::Plus => {
                self.next();
                self.expr(binding::NEG)
            }
            _ => {
                let atom = self.atom()?;
                self.postfix(atom)
            }
        }
    }

    fn postfix(&mut self, mut left: Grown) -> Result<Grown, Error> {
        loop {
            let lexed = self.peek().clone();
            let span = left.0.span.to(lexed.span);
            match lexed.token {
                Token::Superscript(digits) => {
                    self.next();
                    let exponent = superscript_value(&digits, lexed.span)?;
                    let node = Node::Binary {
                        op: BinaryOp::Pow,
                        left: Box::new(left.0),
                        right: Box::new(exponent),
                    };
                    left = self.grow(node, span, left.1.max(2))?;
                }
                Token::Degree => {
                    self.next();
                    let arg = Arg {
                        name: None,
                        value: left.0,
                    };
                    let node = Node::Call {
                        name: "deg".to_string(),
                        args: vec![arg],
                    };
                    left = self.grow(node, span, left.1)?;
                }
                _ => return Ok(left),
            }
        }
    }

    fn atom(&mut self) -> Result<Grown, Error> {
        let lexed = self.peek().clone();
        match lexed.token {
            Token::Number { value, text } => {
                self.next();
                self.grow(Node::Number { value, text }, lexed.span, 0)
            }
            Token::Name(name) => {
                self.next();
                match self.peek().token {
                    Token::Open => self.call(name, lexed.span),
                    Token::Superscript(_)
                        if self.tokens.get(self.at + 1).map(|next| &next.token)
                            == Some(&Token::Open)
                            && Builtin::named(&name).is_some() =>
                    {
                        Err(Error::new(
                            lexed.span.to(self.peek().span),
                            format!("write the power behind the call: {name}(…)^2"),
                        ))
                    }
                    _ => self.grow(Node::Name(name), lexed.span, 0),
                }
            }
            Token::Root => {
                self.next();
                self.depth += 1;
                if self.depth > MAX_DEPTH {
                    return Err(self.too_deep(lexed.span));
                }
                let (value, below) = self.atom()?;
                self.depth -= 1;
                let span = lexed.span.to(value.span);
                let node = Node::Call {
                    name: "sqrt".to_string(),
                    args: vec![Arg { name: None, value }],
                };
                self.grow(node, span, below)
            }
            Token::Open => {
                self.next();
                let (mut inner, below) = self.expr(0)?;
                let close = self.close(lexed.span)?;
                inner.span = lexed.span.to(close);
                Ok((inner, below))
            }
            Token::Superscript(_) | Token::Degree | Token::Times | Token::Over | Token::Caret => {
                Err(self.unexpected("a number or a name before it"))
            }
            _ => Err(self.unexpected("a number, a name or \"(\"")),
        }
    }

    /// The closing parenthesis of the one opened at `open`.
    fn close(&mut self, open: Span) -> Result<Span, Error> {
        match self.peek().token {
            Token::Close => Ok(self.next().span),
            Token::End => Err(self.unexpected("\")\"").help(format!(
                "it closes the \"(\" at column {}",
                self.text[..open.start].chars().count() + 1
            ))),
            _ => Err(self.unexpected("\")\"")),
        }
    }

    fn call(&mut self, name: String, at: Span) -> Result<Grown, Error> {
        let open = self.next().span;
        let mut args: Vec<Arg> = Vec::new();
        let mut below = 0;
        while self.peek().token != Token::Close {
            let named = match (&self.peek().token, self.tokens.get(self.at + 1)) {
                (Token::Name(name), Some(next)) if next.token == Token::Assign => {
                    Some(name.clone())
                }
                _ => None,
            };
            if let Some(argument) = &named {
                let span = self.next().span;
                self.next();
                if args.iter().any(|arg| arg.name.as_ref() == Some(argument)) {
                    return Err(Error::new(
                        span,
                        format!("argument {} is given twice", excerpt(argument)),
                    ));
                }
            }
            let (value, height) = self.expr(0)?;
            below = below.max(height);
            args.push(Arg { name: named, value });
            match self.peek().token {
                Token::Comma => {
                    self.next();
                }
                Token::Close => {}
                _ => {
                    return Err(self
                        .close(open)
                        .err()
                        .unwrap_or_else(|| self.unexpected("\")\"")));
                }
            }
        }
        let span = at.to(self.next().span);
        self.grow(Node::Call { name, args }, span, below)
    }
}

fn superscript_value(digits: &str, span: Span) -> Result<Expr, Error> {
    let (negative, text) = match digits.strip_prefix('-') {
        Some(rest) => (true, rest),
        None => (false, digits),
    };
    match text.parse::<u16>() {
        Ok(value) => {
            let node = Node::Number {
                value: f64::from(value),
                text: text.to_string(),
            };
            let number = Expr { node, span };
            Ok(if negative {
                Expr {
                    node: Node::Neg(Box::new(number)),
                    span,
                }
            } else {
                number
            })
        }
        Err(_) => Err(Error::new(span, "this exponent is not a number")),
    }
}
