//! Who is meant by a name: the rules by which a call finds the arguments it leaves out.
//!
//! An explicit argument beats an implicit one. An implicit one is looked for among the
//! enclosing formula's own parameters, then among the givens. `alpha` may be satisfied by
//! `roughness` (alpha = roughness²) and the other way round; a parameter's own name wins.

use crate::builtin::{Builtin, builtin_names, check_args};
use crate::error::{Error, Span, excerpt};
use crate::expr::{Arg, Expr};
use crate::library::{Definition, Library};

/// How a value becomes the parameter it stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Convert {
    Same,
    /// roughness, where alpha is wanted.
    Square,
    /// alpha, where roughness is wanted.
    Root,
}

/// The other name of the same quantity.
pub(crate) fn twin(name: &str) -> Option<(&'static str, Convert)> {
    match name {
        "alpha" => Some(("roughness", Convert::Square)),
        "roughness" => Some(("alpha", Convert::Root)),
        _ => None,
    }
}

/// What a name refers to.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Found {
    /// A parameter of the enclosing definition.
    Own(String, Convert),
    /// A given of the whole expression.
    Given(String, Convert),
}

/// The names that are visible at one place.
#[derive(Clone, Copy)]
pub(crate) struct Scope<'a> {
    /// Parameters of the enclosing definition; none outside of one.
    pub own: Option<&'a [String]>,
    /// The givens; `None` where any name may turn out to be given.
    pub givens: Option<&'a [&'a str]>,
}

impl Scope<'_> {
    fn own(&self, name: &str) -> Option<Found> {
        let own = self.own?;
        let has = |wanted: &str| own.iter().any(|param| param == wanted);
        if has(name) {
            return Some(Found::Own(name.to_string(), Convert::Same));
        }
        let (other, convert) = twin(name).filter(|(other, _)| has(other))?;
        Some(Found::Own(other.to_string(), convert))
    }

    fn given(&self, name: &str) -> Option<Found> {
        let same = || Some(Found::Given(name.to_string(), Convert::Same));
        let Some(givens) = self.givens else {
            return same();
        };
        if givens.contains(&name) {
            return same();
        }
        let (other, convert) = twin(name).filter(|(other, _)| givens.contains(other))?;
        Some(Found::Given(other.to_string(), convert))
    }

    /// A name written in the formula.
    pub fn written(&self, name: &str) -> Option<Found> {
        match self.own {
            Some(_) => self.own(name),
            None => self.given(name),
        }
    }

    /// A parameter that a call leaves out.
    pub fn implied(&self, name: &str) -> Option<Found> {
        self.own(name).or_else(|| self.given(name))
    }

    fn known(&self) -> Vec<&str> {
        match (self.own, self.givens) {
            (Some(own), _) => own.iter().map(String::as_str).collect(),
            (None, Some(givens)) => givens.to_vec(),
            (None, None) => Vec::new(),
        }
    }

    /// The error for a name that [`Scope::written`] does not find.
    pub fn unknown(&self, library: &Library, name: &str, span: Span) -> Error {
        if library.definition(name).is_some() {
            return Error::new(span, format!("{name} is a formula, not a number"))
                .help(format!("write {name}()"));
        }
        if brdf::term(name).is_some() {
            return Error::new(span, format!("{name} is a function, not a number"))
                .help(format!("write {name}()"));
        }
        if Builtin::named(name).is_some() {
            return Error::new(span, format!("{name} needs its argument in parentheses"))
                .help(format!("write {name}(…)"));
        }
        let error = Error::new(span, format!("unknown name \"{}\"", excerpt(name)));
        let mut known = self.known();
        known.push("pi");
        let near = error.clone().nearest(name, known.iter().copied());
        if near.help.is_some() {
            return near;
        }
        known.pop();
        match (self.own.is_some(), known.is_empty()) {
            (true, _) => error.help("a formula sees only its own arguments: add it to them"),
            (false, true) => error.help("nothing is given here"),
            (false, false) => error.help(format!("given are {}", known.join(", "))),
        }
    }
}

/// What a call calls.
#[derive(Clone, Copy)]
pub(crate) enum Callee<'l> {
    Builtin(Builtin),
    Term(&'static brdf::Term),
    Definition(&'l Definition),
}

impl Library {
    /// Finds the function and refuses arguments it does not take.
    pub(crate) fn callee(&self, name: &str, args: &[Arg], span: Span) -> Result<Callee<'_>, Error> {
        let callee = if let Some(builtin) = Builtin::named(name) {
            Callee::Builtin(builtin)
        } else if let Some(definition) = self.definition(name) {
            Callee::Definition(definition)
        } else if let Some(term) = brdf::term(name) {
            Callee::Term(term)
        } else {
            let error = Error::new(span, format!("unknown function \"{}\"", excerpt(name)));
            let near = error.clone().nearest(name, self.callables());
            return Err(match near.help {
                Some(_) => near,
                None if name == "pi" || name.contains("_dot_") || twin(name).is_some() => {
                    Error::new(span, format!("{name} is a number, not a function"))
                        .help("write the product with *")
                }
                None => error,
            });
        };
        match callee {
            Callee::Builtin(_) => check_args(name, args, span)?,
            _ => check_named(name, &callee.params(), args, span)?,
        }
        Ok(callee)
    }

    /// Everything that can be called, for suggestions.
    pub(crate) fn callables(&self) -> Vec<&str> {
        let mut names: Vec<&str> = builtin_names().collect();
        names.extend(brdf::terms().iter().map(|term| term.name));
        names.extend(
            self.definitions()
                .map(|definition| definition.name.as_str()),
        );
        names
    }
}

impl<'l> Callee<'l> {
    /// Parameter names; empty for an elementary function, which has none.
    pub fn params(&self) -> Vec<&'l str> {
        match self {
            Callee::Builtin(_) => Vec::new(),
            Callee::Term(term) => term.params.iter().map(|param| param.name).collect(),
            Callee::Definition(definition) => {
                definition.params.iter().map(String::as_str).collect()
            }
        }
    }
}

fn check_named(name: &str, params: &[&str], args: &[Arg], span: Span) -> Result<(), Error> {
    let form = || {
        let named: Vec<String> = params.iter().map(|param| format!("{param} = …")).collect();
        format!("write {name}({})", named.join(", "))
    };
    for arg in args {
        let Some(wanted) = &arg.name else {
            // alpha and roughness are never a bare number.
            let obvious = params.len() == 1 && args.len() == 1 && twin(params[0]).is_none();
            if obvious {
                continue;
            }
            let error = Error::new(
                arg.value.span,
                format!("{name} takes its arguments by name"),
            );
            return Err(if params.is_empty() {
                Error::new(arg.value.span, format!("{name} takes no arguments"))
            } else {
                error.help(form())
            });
        };
        let fits = params.contains(&wanted.as_str())
            || twin(wanted).is_some_and(|(other, _)| params.contains(&other));
        if !fits {
            let message = format!("{name} has no argument {}", excerpt(wanted));
            let error = Error::new(arg.value.span, message);
            let near = error.clone().nearest(wanted, params.iter().copied());
            return Err(match near.help {
                Some(_) => near,
                None if params.is_empty() => error.help(format!("write {name}()")),
                None => error.help(form()),
            });
        }
        let doubled = twin(wanted).filter(|(other, _)| {
            !(params.contains(other) && params.contains(&wanted.as_str()))
                && args.iter().any(|arg| arg.name.as_deref() == Some(other))
        });
        if doubled.is_some() {
            return Err(Error::new(span, "both roughness and alpha are given")
                .help("give one of them: alpha = roughness^2"));
        }
    }
    Ok(())
}

/// Where the value of one parameter comes from.
pub(crate) enum Binding<'e> {
    /// Written in the call.
    Explicit(&'e Expr, Convert),
    /// Left out, found around the call.
    Implicit(Found),
}

/// The value of every parameter of a call, in the order of `params`.
pub(crate) fn bind<'e>(
    name: &str,
    params: &[&str],
    args: &'e [Arg],
    span: Span,
    scope: Scope<'_>,
) -> Result<Vec<Binding<'e>>, Error> {
    let argument = |wanted: &str| {
        args.iter()
            .find(|arg| arg.name.as_deref() == Some(wanted))
            .map(|arg| &arg.value)
    };
    params
        .iter()
        .map(|param| {
            if let Some(value) = argument(param) {
                return Ok(Binding::Explicit(value, Convert::Same));
            }
            if let [Arg { name: None, value }] = args {
                return Ok(Binding::Explicit(value, Convert::Same));
            }
            let other = twin(param).filter(|(other, _)| !params.contains(other));
            if let Some((value, convert)) =
                other.and_then(|(other, convert)| Some((argument(other)?, convert)))
            {
                return Ok(Binding::Explicit(value, convert));
            }
            scope.implied(param).map(Binding::Implicit).ok_or_else(|| {
                let or = match twin(param) {
                    Some((other, _)) => format!("{param} or {other}"),
                    None => param.to_string(),
                };
                Error::new(span, format!("{name} needs {or}, which is not given here"))
                    .help(format!("write {name}({param} = …)"))
            })
        })
        .collect()
}
