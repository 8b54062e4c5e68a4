//! WGSL source of a formula: definitions become functions, the core's twins come along.
//!
//! Float literals only; whole powers are products; every name that is not an input has a
//! prefix, so that none can be a keyword or hide a built-in: `lobe_` the core's twins,
//! `lesson_` the definitions (unless the caller chooses another), `formula_` helpers.

use crate::builtin::Builtin;
use crate::error::{Error, Span};
use crate::expr::{Arg, BinaryOp, Expr, Node, binding};
use crate::library::{Definition, Library, Values};
use crate::lower::whole_exponent;
use crate::pretty::short;
use crate::scope::{Binding, Callee, Convert, Found, Scope, bind};
use std::collections::{BTreeMap, BTreeSet};

/// Deepest nesting of parentheses and calls. Readers of WGSL recurse, some with tens of
/// kilobytes a level: what is deeper would end the program that draws it.
const MAX_NESTING: usize = 40;

/// A formula in WGSL.
#[derive(Clone, Debug, PartialEq)]
pub struct Wgsl {
    /// The functions it needs, each once, callees first.
    pub functions: String,
    /// The expression, of type f32.
    pub expr: String,
    parts: Vec<(String, String)>,
}

impl Wgsl {
    /// The functions of several formulas for one module, each name once. Formulas of
    /// libraries that differ need prefixes that differ ([`Library::wgsl_prefixed`]).
    pub fn functions_of(formulas: &[&Wgsl]) -> String {
        let mut seen = BTreeSet::new();
        let mut all = String::new();
        for (name, source) in formulas.iter().flat_map(|formula| &formula.parts) {
            if seen.insert(name) {
                all.push_str(source);
                all.push_str("\n\n");
            }
        }
        all
    }
}

impl Library {
    /// The formula over WGSL identifiers of the same names as the inputs.
    ///
    /// # Errors
    /// As [`Library::check_expr`]; a constant that f32 cannot hold; a function of the core
    /// that has no WGSL form.
    pub fn wgsl(&self, expr: &Expr, inputs: &[&str]) -> Result<Wgsl, Error> {
        self.wgsl_prefixed(expr, inputs, "lesson_")
    }

    /// The same with another prefix for the definitions, so that a right and a wrong
    /// library fit into one module.
    ///
    /// # Errors
    /// As [`Library::wgsl`].
    pub fn wgsl_prefixed(&self, expr: &Expr, inputs: &[&str], prefix: &str) -> Result<Wgsl, Error> {
        // Names, arguments, cycles and size are looked at once, here: what follows may
        // rely on them.
        self.lower(expr, Some(inputs))?;
        let mut writer = Writer {
            library: self,
            inputs,
            prefix,
            parts: Vec::new(),
            extras: BTreeMap::new(),
            nesting: 0,
        };
        let mut place = Place {
            definition: None,
            site: None,
            givens: BTreeSet::new(),
        };
        let (expr, _) = writer.expr(expr, &mut place)?;
        let parts = writer.parts;
        let mut formula = Wgsl {
            functions: String::new(),
            expr,
            parts,
        };
        formula.functions = Wgsl::functions_of(&[&formula]);
        Ok(formula)
    }
}

/// Where an expression stands.
struct Place<'l> {
    definition: Option<&'l Definition>,
    /// The call in the whole expression that led here.
    site: Option<Span>,
    /// Givens that a definition's function must be passed beside its parameters.
    givens: BTreeSet<String>,
}

impl Place<'_> {
    fn error(&self, error: Error) -> Error {
        match (self.site, self.definition) {
            (Some(site), Some(definition)) => Error {
                span: site,
                message: format!("in {}: {}", definition.name, error.message),
                help: error.help,
            },
            _ => error,
        }
    }
}

struct Writer<'l, 'i> {
    library: &'l Library,
    inputs: &'i [&'i str],
    prefix: &'i str,
    parts: Vec<(String, String)>,
    /// The givens that each definition's function takes.
    extras: BTreeMap<String, Vec<String>>,
    /// Open parentheses and calls of the function that is being written.
    nesting: usize,
}

/// Source and how tightly it binds.
type Part = (String, u8);

fn at_least((text, bind): Part, least: u8) -> String {
    if bind < least {
        format!("({text})")
    } else {
        text
    }
}

impl<'l> Writer<'l, '_> {
    fn expr(&mut self, expr: &Expr, place: &mut Place<'l>) -> Result<Part, Error> {
        self.nesting += 1;
        if self.nesting > MAX_NESTING {
            let message = "this is nested too deep for a shader";
            let help = "give parts of it names of their own";
            return Err(place.error(Error::new(expr.span, message).help(help)));
        }
        let part = self.node(expr, place)?;
        self.nesting -= 1;
        Ok(part)
    }

    fn node(&mut self, expr: &Expr, place: &mut Place<'l>) -> Result<Part, Error> {
        if constant(expr) {
            let value = self.library.eval(expr, &Values::new());
            let value = value.map_err(|error| place.error(error))?;
            return literal(value, expr.span).map_err(|error| place.error(error));
        }
        match &expr.node {
            Node::Number { value, .. } => literal(*value, expr.span),
            Node::Name(name) => {
                let found = self.scope(place).written(name);
                let found = found
                    .ok_or_else(|| self.scope(place).unknown(self.library, name, expr.span))?;
                Ok(self.found(found, place))
            }
            Node::Neg(inner) => {
                let inner = at_least(self.expr(inner, place)?, binding::POWER);
                Ok((format!("(-{inner})"), binding::ATOM))
            }
            Node::Binary {
                op: BinaryOp::Pow,
                left,
                right,
            } => self.power(left, right, place),
            Node::Binary { op, left, right } => {
                let own = match op {
                    BinaryOp::Add | BinaryOp::Sub => binding::SUM,
                    _ => binding::PRODUCT,
                };
                // A chain stands side by side, not inside one another.
                let chained = left.node.binding() >= own;
                self.nesting -= usize::from(chained);
                let left = at_least(self.expr(left, place)?, own);
                self.nesting += usize::from(chained);
                let right = at_least(self.expr(right, place)?, own + 1);
                Ok((format!("{left} {} {right}", op.symbol()), own))
            }
            Node::Compare { op, left, right } => {
                let left = at_least(self.expr(left, place)?, binding::SUM);
                let right = at_least(self.expr(right, place)?, binding::SUM);
                let text = format!("select(0.0, 1.0, {left} {} {right})", op.symbol());
                Ok((text, binding::ATOM))
            }
            Node::Call { name, args } => self.call(expr, name, args, place),
        }
    }

    fn scope<'a>(&'a self, place: &Place<'a>) -> Scope<'a> {
        Scope {
            own: place
                .definition
                .map(|definition| definition.params.as_slice()),
            givens: Some(self.inputs),
        }
    }

    fn found(&mut self, found: Found, place: &mut Place<'l>) -> Part {
        let (name, convert) = match found {
            Found::Own(name, convert) => (format!("p_{name}"), convert),
            Found::Given(name, convert) => {
                place.givens.insert(name.clone());
                (given(&name, place), convert)
            }
        };
        self.convert((name, binding::ATOM), convert)
    }

    fn convert(&mut self, part: Part, convert: Convert) -> Part {
        match convert {
            Convert::Same => part,
            Convert::Square => self.whole_power(part, 2),
            Convert::Root => (format!("sqrt({})", part.0), binding::ATOM),
        }
    }

    fn power(
        &mut self,
        base: &Expr,
        exponent: &Expr,
        place: &mut Place<'l>,
    ) -> Result<Part, Error> {
        let base = self.expr(base, place)?;
        if let Some(whole) = whole_exponent(exponent) {
            return Ok(self.whole_power(base, whole));
        }
        if matches!(&exponent.node, Node::Number { value, .. } if *value == 0.5) {
            return Ok((format!("sqrt({})", base.0), binding::ATOM));
        }
        let exponent = self.expr(exponent, place)?;
        Ok((format!("pow({}, {})", base.0, exponent.0), binding::ATOM))
    }

    /// Products instead of `pow`, which is neither exact nor defined for negative bases.
    fn whole_power(&mut self, base: Part, exponent: i32) -> Part {
        let positive = match exponent.unsigned_abs() {
            0 => return ("1.0".to_string(), binding::ATOM),
            1 => base,
            2 if base
                .0
                .bytes()
                .all(|byte| byte.is_ascii_alphanumeric() || byte == b'_') =>
            {
                (format!("{0} * {0}", base.0), binding::PRODUCT)
            }
            power => {
                let name = format!("formula_pow{power}");
                self.add(&name, power_source(&name, power));
                (format!("{name}({})", base.0), binding::ATOM)
            }
        };
        if exponent < 0 {
            let below = at_least(positive, binding::ATOM);
            (format!("1.0 / {below}"), binding::PRODUCT)
        } else {
            positive
        }
    }

    fn add(&mut self, name: &str, source: String) {
        if !self.parts.iter().any(|(known, _)| known == name) {
            self.parts.push((name.to_string(), source));
        }
    }

    fn call(
        &mut self,
        expr: &Expr,
        name: &str,
        args: &[Arg],
        place: &mut Place<'l>,
    ) -> Result<Part, Error> {
        let callee = self.library.callee(name, args, expr.span)?;
        if let Callee::Builtin(builtin) = callee {
            return self.elementary(builtin, args, place);
        }
        let bound = bind(name, &callee.params(), args, expr.span, self.scope(place))?;
        let mut values = Vec::new();
        for binding in bound {
            let (text, _) = match binding {
                Binding::Explicit(value, convert) => {
                    let part = self.expr(value, place)?;
                    self.convert(part, convert)
                }
                Binding::Implicit(found) => self.found(found, place),
            };
            values.push(text);
        }
        let function = match callee {
            Callee::Definition(definition) => {
                let site = place.site.unwrap_or(expr.span);
                for name in self.definition(definition, site)? {
                    values.push(given(&name, place));
                    place.givens.insert(name);
                }
                format!("{}{name}", self.prefix)
            }
            Callee::Term(term) => {
                self.twin(term, expr.span)
                    .map_err(|error| place.error(error))?;
                format!("lobe_{name}")
            }
            Callee::Builtin(_) => String::new(),
        };
        Ok((format!("{function}({})", values.join(", ")), binding::ATOM))
    }

    /// Writes the function of a definition and gives the givens it takes.
    fn definition(&mut self, definition: &'l Definition, site: Span) -> Result<Vec<String>, Error> {
        if let Some(extras) = self.extras.get(&definition.name) {
            return Ok(extras.clone());
        }
        let mut place = Place {
            definition: Some(definition),
            site: Some(site),
            givens: BTreeSet::new(),
        };
        let outside = std::mem::take(&mut self.nesting);
        let (body, _) = self.expr(&definition.body, &mut place)?;
        self.nesting = outside;
        let extras: Vec<String> = place.givens.into_iter().collect();
        let params = definition
            .params
            .iter()
            .map(|param| format!("p_{param}: f32"));
        let passed = extras.iter().map(|name| format!("given_{name}: f32"));
        let list: Vec<String> = params.chain(passed).collect();
        let name = format!("{}{}", self.prefix, definition.name);
        let source = format!(
            "// {}\nfn {name}({}) -> f32 {{\n    return {body};\n}}",
            definition.body,
            list.join(", ")
        );
        self.add(&name, source);
        self.extras.insert(definition.name.clone(), extras.clone());
        Ok(extras)
    }

    fn twin(&mut self, term: &brdf::Term, span: Span) -> Result<(), Error> {
        for name in term.wgsl_needs {
            if let Some(needed) = brdf::term(name)
                && needed.name != term.name
            {
                self.twin(needed, span)?;
            }
        }
        match term.wgsl {
            Some(source) => {
                self.add(&format!("lobe_{}", term.name), source.to_string());
                Ok(())
            }
            None => Err(Error::new(
                span,
                format!("{} has no WGSL form: it is an integral", term.name),
            )
            .help("pictures can use only what a shader can evaluate at a point")),
        }
    }

    fn elementary(
        &mut self,
        builtin: Builtin,
        args: &[Arg],
        place: &mut Place<'l>,
    ) -> Result<Part, Error> {
        if let (Builtin::Pow, [base, exponent]) = (builtin, args) {
            return self.power(&base.value, &exponent.value, place);
        }
        let mut values = Vec::new();
        for arg in args {
            values.push(self.expr(&arg.value, place)?);
        }
        let helper = match builtin {
            Builtin::Min | Builtin::Max => {
                let name = builtin.name();
                let all = values.into_iter().map(|(text, _)| text);
                let text = all.reduce(|left, right| format!("{name}({left}, {right})"));
                return Ok((text.unwrap_or_default(), binding::ATOM));
            }
            Builtin::Deg => {
                let angle = values.into_iter().next().unwrap_or_default();
                let angle = at_least(angle, binding::PRODUCT);
                let text = format!("{angle} * {:?}", std::f32::consts::PI / 180.0);
                return Ok((text, binding::PRODUCT));
            }
            Builtin::Asin => Some(("formula_asin", ASIN)),
            Builtin::Acos => Some(("formula_acos", ACOS)),
            Builtin::Atan => Some(("formula_atan", ATAN)),
            _ => None,
        };
        let function = match (helper, builtin) {
            (Some((name, source)), _) => {
                if name == "formula_acos" {
                    self.add("formula_asin", ASIN.to_string());
                }
                self.add(name, source.to_string());
                name
            }
            (None, Builtin::Ln) => "log",
            (None, other) => other.name(),
        };
        let list: Vec<String> = values.into_iter().map(|(text, _)| text).collect();
        Ok((format!("{function}({})", list.join(", ")), binding::ATOM))
    }
}

/// What a given is called where it is used: by its own name outside of functions.
fn given(name: &str, place: &Place<'_>) -> String {
    match place.definition {
        Some(_) => format!("given_{name}"),
        None => name.to_string(),
    }
}

/// Whether an expression has the same value everywhere without calling a formula.
fn constant(expr: &Expr) -> bool {
    let mut constant = true;
    expr.walk(&mut |expr| match &expr.node {
        Node::Name(name) => constant &= name == "pi",
        Node::Call { name, .. } => constant &= Builtin::named(name).is_some(),
        _ => {}
    });
    constant
}

fn literal(value: f64, span: Span) -> Result<Part, Error> {
    let narrow = value as f32;
    // Numbers below the smallest normal one are zero on many adapters.
    let held = narrow.is_finite() && (value == 0.0 || narrow.abs() >= f32::MIN_POSITIVE);
    if !held {
        return Err(
            Error::new(span, format!("f32 cannot hold {}", short(value, 6)))
                .help("a shader computes in f32, from 1.2e-38 to 3.4e38"),
        );
    }
    if value < 0.0 {
        return Ok((format!("({narrow:?})"), binding::ATOM));
    }
    Ok((format!("{narrow:?}"), binding::ATOM))
}

/// Products by squaring, in the order in which the CPU multiplies.
fn power_source(name: &str, power: u32) -> String {
    let mut lines = Vec::new();
    let mut square = "x".to_string();
    let mut result = String::new();
    let mut left = power;
    let mut reached = 1;
    while left > 0 {
        if left & 1 == 1 {
            result = match result.is_empty() {
                true => square.clone(),
                false => format!("{result} * {square}"),
            };
        }
        left >>= 1;
        if left > 0 {
            reached *= 2;
            lines.push(format!("    let x{reached} = {square} * {square};"));
            square = format!("x{reached}");
        }
    }
    lines.push(format!("    return {result};"));
    format!("fn {name}(x: f32) -> f32 {{\n{}\n}}", lines.join("\n"))
}

// The inverse functions of software Vulkan are good to 1e-4 only. These are the classic
// single-precision approximations of Moshier's Cephes library, good to 2e-7.
const ASIN: &str = "fn formula_asin(x: f32) -> f32 {
    let a = abs(x);
    let outer = a > 0.5;
    let z = select(a * a, 0.5 * (1.0 - a), outer);
    let s = select(a, sqrt(z), outer);
    let p = (((0.042163199 * z + 0.024181311) * z + 0.045470026) * z + 0.074953003) * z + 0.16666752;
    let inner = p * z * s + s;
    let angle = select(inner, 1.5707964 - 2.0 * inner, outer);
    return select(angle, -angle, x < 0.0);
}";

const ACOS: &str = "fn formula_acos(x: f32) -> f32 {
    if (x > 0.5) {
        return 2.0 * formula_asin(sqrt(0.5 * (1.0 - x)));
    }
    if (x < -0.5) {
        return 3.1415927 - 2.0 * formula_asin(sqrt(0.5 * (1.0 + x)));
    }
    return 1.5707964 - formula_asin(x);
}";

const ATAN: &str = "fn formula_atan(x: f32) -> f32 {
    let a = abs(x);
    var base = 0.0;
    var t = a;
    if (a > 2.4142137) {
        base = 1.5707964;
        t = -1.0 / a;
    } else if (a > 0.41421357) {
        base = 0.7853982;
        t = (a - 1.0) / (a + 1.0);
    }
    let z = t * t;
    let p = ((0.080537446 * z - 0.13877685) * z + 0.19977711) * z - 0.33332950;
    let angle = base + (p * z * t + t);
    return select(angle, -angle, x < 0.0);
}";
