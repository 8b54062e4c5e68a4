//! Tokens become a tree. Precedence climbing in one function: the depth of its recursion
//! and the height of every tree it returns are limited, so that nothing that walks a tree
//! later can exhaust the stack.

use crate::builtin::{Builtin, builtin_names};
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

/// Parses what a learner types: literals, `+ - * / ^`, parentheses, `pi`, elementary
/// functions and the `names` of the exercise; never a function of the core.
///
/// A comma is a decimal comma where the whole answer is one number. A leading `=` or `≈`
/// is overlooked, and names may be typed as `NdotL`, `N·L` or `n_dot_l`.
///
/// # Errors
/// A span into `text` and what was expected there: nothing that should cost an attempt.
pub fn parse_answer(text: &str, names: &[&str]) -> Result<Expr, Error> {
    let trimmed = text.trim_start();
    let body = trimmed.trim_start_matches(['=', '≈']);
    let skipped = text.len() - body.len();
    let shift = |mut error: Error| {
        error.span.start += skipped;
        error.span.end += skipped;
        error
    };
    if let Some(dotted) = decimal_comma(body) {
        return parse(&dotted)
            .map(|expr| shifted(expr, skipped))
            .map_err(shift);
    }
    let expr = match parse(body) {
        Ok(expr) => shifted(expr, skipped),
        Err(error) => {
            let error = if looks_like_decimal_comma(body) {
                error.help("write decimals with a point in arithmetic, as in 0.4^4")
            } else {
                error
            };
            return Err(shift(error));
        }
    };
    answer_names(expr, names)
}

/// `0,56` as `0.56`, where the whole text is one number with one comma.
pub(crate) fn decimal_comma(text: &str) -> Option<String> {
    let text = text.trim();
    let unsigned = text.trim_start_matches(['+', '-', '−', '–']).trim_start();
    let (whole, rest) = unsigned.split_once(',')?;
    let digits = |part: &str| !part.is_empty() && part.bytes().all(|b| b.is_ascii_digit());
    let (fraction, exponent) = match rest.split_once(['e', 'E']) {
        Some((fraction, exponent)) => (fraction, Some(exponent)),
        None => (rest, None),
    };
    let exponent_fits = exponent
        .is_none_or(|exponent| digits(exponent.strip_prefix(['+', '-']).unwrap_or(exponent)));
    ((whole.is_empty() || digits(whole)) && digits(fraction) && exponent_fits)
        .then(|| text.replacen(',', ".", 1))
}

fn looks_like_decimal_comma(text: &str) -> bool {
    text.as_bytes()
        .windows(3)
        .any(|w| w[0].is_ascii_digit() && w[1] == b',' && w[2].is_ascii_digit())
}

fn shifted(mut expr: Expr, by: usize) -> Expr {
    expr.span.start += by;
    expr.span.end += by;
    let node = expr.node;
    expr.node = match node {
        Node::Neg(inner) => Node::Neg(Box::new(shifted(*inner, by))),
        Node::Binary { op, left, right } => Node::Binary {
            op,
            left: Box::new(shifted(*left, by)),
            right: Box::new(shifted(*right, by)),
        },
        Node::Compare { op, left, right } => Node::Compare {
            op,
            left: Box::new(shifted(*left, by)),
            right: Box::new(shifted(*right, by)),
        },
        Node::Call { name, args } => Node::Call {
            name,
            args: args
                .into_iter()
                .map(|arg| Arg {
                    name: arg.name,
                    value: shifted(arg.value, by),
                })
                .collect(),
        },
        leaf => leaf,
    };
    expr
}

/// Looks up every name of a learner's answer, respelling `NdotL` as `n_dot_l`.
fn answer_names(mut expr: Expr, names: &[&str]) -> Result<Expr, Error> {
    let span = expr.span;
    match &mut expr.node {
        Node::Name(name) if name == "pi" || names.contains(&name.as_str()) => {}
        Node::Name(name) => {
            let flat = |name: &str| name.replace('_', "").to_lowercase();
            let known = std::iter::once("pi").chain(names.iter().copied());
            match known.clone().find(|known| flat(known) == flat(name)) {
                Some(known) => *name = known.to_string(),
                None if brdf::term(name).is_some() => {
                    return Err(
                        Error::new(span, format!("{name} would give the answer away"))
                            .help("put numbers in and work it out"),
                    );
                }
                None if Builtin::named(name).is_some() => {
                    return Err(Error::new(
                        span,
                        format!("{name} needs parentheses: {name}(…)"),
                    ));
                }
                None => {
                    let error = Error::new(span, format!("unknown name \"{}\"", excerpt(name)));
                    let near = error.clone().nearest(name, known);
                    return Err(if near.help.is_some() || names.is_empty() {
                        near
                    } else {
                        error.help(format!("known here: {}", names.join(", ")))
                    });
                }
            }
        }
        Node::Compare { .. } => {
            return Err(Error::new(
                span,
                "an answer is one number, not a comparison",
            ));
        }
        Node::Call { name, args } => {
            if Builtin::named(name).is_none() {
                let error = if brdf::term(name).is_some() {
                    Error::new(span, format!("{name}(…) would give the answer away"))
                        .help("put numbers in and work it out")
                } else if names.contains(&name.as_str()) || name == "pi" {
                    Error::new(span, format!("{name} is a number, not a function"))
                        .help("write the product with *")
                } else {
                    Error::new(span, format!("unknown function \"{}\"", excerpt(name)))
                        .nearest(name, builtin_names())
                };
                return Err(error);
            }
            crate::builtin::check_args(name, args, span)?;
        }
        Node::Number { .. } | Node::Neg(_) | Node::Binary { .. } => {}
    }
    for child in expr.children_mut() {
        let owned = std::mem::replace(child, Expr::number(0.0));
        *child = answer_names(owned, names)?;
    }
    Ok(expr)
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
