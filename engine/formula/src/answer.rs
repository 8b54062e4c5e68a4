//! The learner's dialect: arithmetic, and never a call that gives the truth away. What
//! cannot be read is said so that it costs nothing but a second look.

use crate::builtin::{Builtin, builtin_names};
use crate::error::{Error, excerpt};
use crate::expr::{Arg, Expr, Node};
use crate::parse::parse;
use crate::spelling::unicode_name;

/// Parses what a learner types: literals, `+ - * / ^`, parentheses, `pi`, elementary
/// functions and the `names` of the exercise; never a function of the core.
///
/// A comma is a decimal comma where the whole answer is one number. A leading `=` or `≈`
/// is overlooked, and names may be typed as `NdotL`, `N·L` or `n_dot_l`, or as they are printed:
/// `β` for `light_deg`.
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

/// How a name is printed, and the name that this is read as: `β` and `beta` for `light_deg`. None
/// where it is printed as it is typed, or as more than a name.
fn symbol(name: &str) -> Option<(String, String)> {
    let printed = unicode_name(name);
    match parse(&printed).ok()?.node {
        Node::Name(read) if read != name => Some((printed, read)),
        _ => None,
    }
}

/// A name as it can be typed, and as it is printed where that is another one.
fn typable(name: &str) -> String {
    symbol(name).map_or_else(
        || name.to_owned(),
        |(printed, _)| format!("{name} ({printed})"),
    )
}

/// Looks up every name of a learner's answer, respelling `NdotL` as `n_dot_l`.
fn answer_names(mut expr: Expr, names: &[&str]) -> Result<Expr, Error> {
    let span = expr.span;
    match &mut expr.node {
        Node::Name(name) if name == "pi" || names.contains(&name.as_str()) => {}
        Node::Name(name) => {
            let flat = |name: &str| name.replace('_', "").to_lowercase();
            let known = std::iter::once("pi").chain(names.iter().copied());
            let meant = known.clone().find(|known| flat(known) == flat(name));
            let printed = || {
                let mut names = names.iter().copied();
                names.find(|known| symbol(known).is_some_and(|(_, read)| read == *name))
            };
            match meant.or_else(printed) {
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
                        let names: Vec<String> = names.iter().map(|name| typable(name)).collect();
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
