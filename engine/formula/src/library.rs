//! The formulas of one lesson on top of the core's terms, and what can be wrong with them.

use crate::builtin::Builtin;
use crate::error::{Error, Span, excerpt, nearest};
use crate::expr::{Expr, Node};
use crate::parse::parse;
use crate::scope::{Callee, Scope, bind};
use std::collections::{BTreeMap, BTreeSet};

/// Greatest number of operations of a formula with its definitions opened.
pub const MAX_OPERATIONS: usize = 4096;

/// The givens of a formula, by name. Cosines and shares are pure numbers, angles radians.
pub type Values = BTreeMap<String, f64>;

/// A formula of a lesson: `[formula.NAME] of = [...] is = "..."`.
#[derive(Clone, Debug)]
pub struct Definition {
    /// What calls it.
    pub name: String,
    /// Its parameters, all passed by name.
    pub params: Vec<String>,
    /// What it says.
    pub body: Expr,
    /// What the author wrote; the body's spans point into it.
    pub text: String,
}

/// The core's terms plus the definitions of one lesson.
#[derive(Clone, Debug, Default)]
pub struct Library {
    definitions: BTreeMap<String, Definition>,
}

impl Library {
    /// The core's terms and nothing else.
    pub fn new() -> Library {
        Library::default()
    }

    /// Adds a definition. It may call others that are added later; [`Library::check`]
    /// looks at the whole.
    ///
    /// # Errors
    /// A span into `text`, or an empty one where the name or a parameter is at fault: not
    /// a name, taken already, or twice the same.
    pub fn define(&mut self, name: &str, params: &[&str], text: &str) -> Result<(), Error> {
        let at = Span::default();
        name_fits(name).map_err(|message| Error::new(at, message))?;
        if Builtin::named(name).is_some() || name == "pi" {
            return Err(Error::new(at, format!("{name} is part of the language"))
                .help("choose another name"));
        }
        if brdf::term(name).is_some() {
            return Err(Error::new(at, format!("{name} is a function of the core"))
                .help("choose another name; `core` says which one a formula must equal"));
        }
        if self.definitions.contains_key(name) {
            return Err(Error::new(at, format!("{name} is defined twice")));
        }
        for (index, param) in params.iter().enumerate() {
            name_fits(param).map_err(|message| Error::new(at, message))?;
            if *param == "pi" {
                return Err(Error::new(at, "pi is a constant, not an argument"));
            }
            if params[..index].contains(param) {
                return Err(Error::new(at, format!("argument {param} stands twice")));
            }
        }
        let definition = Definition {
            name: name.to_string(),
            params: params.iter().map(ToString::to_string).collect(),
            body: parse(text)?,
            text: text.to_string(),
        };
        self.definitions.insert(name.to_string(), definition);
        Ok(())
    }

    /// A definition by name.
    pub fn definition(&self, name: &str) -> Option<&Definition> {
        self.definitions.get(name)
    }

    /// All definitions, by name.
    pub fn definitions(&self) -> impl Iterator<Item = &Definition> {
        self.definitions.values()
    }

    /// The same library with one body exchanged.
    pub(crate) fn with_body(&self, name: &str, body: &Expr) -> Library {
        let mut library = self.clone();
        if let Some(definition) = library.definitions.get_mut(name) {
            definition.text = body.to_string();
            // Read again, so that spans point into the new text.
            definition.body = parse(&definition.text).unwrap_or_else(|_| body.clone());
        }
        library
    }

    /// Everything wrong with the definitions: unknown names and arguments, cycles, size.
    /// Each error with the name of the definition into whose text it points.
    pub fn check(&self) -> Vec<(String, Error)> {
        let mut errors: BTreeMap<&str, Vec<Error>> = BTreeMap::new();
        for definition in self.definitions() {
            let scope = Scope {
                own: Some(&definition.params),
                givens: None,
            };
            errors.insert(&definition.name, self.look_up(&definition.body, scope));
        }
        // Cycles and size show only in the whole, and only where every part can be read;
        // each is told once.
        for definition in self.definitions() {
            let mut parts = self.uses(&definition.body);
            parts.insert(definition.name.clone());
            let readable = parts
                .iter()
                .all(|name| errors.get(name.as_str()).is_none_or(Vec::is_empty));
            if readable && let Err(error) = self.lower_definition(definition) {
                errors.insert(&definition.name, vec![error]);
            }
        }
        let named = |(name, errors): (&str, Vec<Error>)| {
            let name = name.to_string();
            errors.into_iter().map(move |error| (name.clone(), error))
        };
        errors.into_iter().flat_map(named).collect()
    }

    /// Everything wrong with an expression over the given `names`, without evaluating it.
    pub fn check_expr(&self, expr: &Expr, names: &[&str]) -> Vec<Error> {
        let scope = Scope {
            own: None,
            givens: Some(names),
        };
        let mut errors = self.look_up(expr, scope);
        if errors.is_empty()
            && let Err(error) = self.lower(expr, Some(names))
        {
            errors.push(error);
        }
        errors
    }

    /// Unknown names, unknown functions and arguments that do not fit, in one tree.
    fn look_up(&self, expr: &Expr, scope: Scope<'_>) -> Vec<Error> {
        let mut errors = Vec::new();
        expr.walk(&mut |expr| match &expr.node {
            Node::Name(name) if name != "pi" && scope.written(name).is_none() => {
                errors.push(scope.unknown(self, name, expr.span));
            }
            Node::Call { name, args } => match self.callee(name, args, expr.span) {
                Err(error) => errors.push(error),
                Ok(Callee::Builtin(_)) => {}
                Ok(callee) => {
                    errors.extend(bind(name, &callee.params(), args, expr.span, scope).err());
                }
            },
            _ => {}
        });
        errors
    }

    /// The free names (givens) an expression finally needs, through definitions and left
    /// out arguments.
    ///
    /// Where `alpha` and `roughness` would both do, the one that is written is named; where
    /// neither is written and both are wanted, `roughness`.
    pub fn needs(&self, expr: &Expr) -> BTreeSet<String> {
        let mut needs: BTreeSet<String> = match self.lower(expr, None) {
            Ok(dag) => {
                let needed = dag.needed();
                (0..dag.ops.len())
                    .filter(|id| needed[*id])
                    .filter_map(|id| match dag.ops[id] {
                        crate::dag::Op::Input(input) => dag.inputs.get(input).cloned(),
                        _ => None,
                    })
                    .collect()
            }
            Err(_) => BTreeSet::new(),
        };
        if needs.contains("alpha") && needs.contains("roughness") {
            let mut written = BTreeSet::new();
            expr.walk(&mut |expr| {
                if let Node::Name(name) = &expr.node {
                    written.insert(name.as_str());
                }
            });
            match (written.contains("alpha"), written.contains("roughness")) {
                (true, true) => {}
                (true, false) => {
                    needs.remove("roughness");
                }
                (false, _) => {
                    needs.remove("alpha");
                }
            }
        }
        needs
    }

    /// The definitions an expression uses, directly or through others, by name.
    pub fn uses(&self, expr: &Expr) -> BTreeSet<String> {
        let mut found = BTreeSet::new();
        let mut open = vec![expr];
        while let Some(expr) = open.pop() {
            expr.walk(&mut |expr| {
                if let Node::Call { name, .. } = &expr.node
                    && let Some(definition) = self.definition(name)
                    && found.insert(name.clone())
                {
                    open.push(&definition.body);
                }
            });
        }
        found
    }

    /// The known name nearest to a misspelt one: a definition, a term of the core or an
    /// elementary function.
    pub fn nearest_callable(&self, written: &str) -> Option<String> {
        nearest(written, self.callables()).map(str::to_string)
    }
}

/// Names are ASCII words, as WGSL and TOML keys want them.
fn name_fits(name: &str) -> Result<(), String> {
    let mut chars = name.chars();
    let starts = chars.next().is_some_and(|c| c.is_ascii_alphabetic());
    let goes_on = chars.all(|c| c.is_ascii_alphanumeric() || c == '_');
    if starts && goes_on && name.len() <= 64 && !name.contains("__") {
        Ok(())
    } else {
        Err(format!(
            "\"{}\" is not a name: letters, digits and single _, a letter first",
            excerpt(name)
        ))
    }
}
