//! naga's complaints in plain words: one sentence, where, and what to do.

use std::ops::Range;

use naga::Span;
use naga::front::wgsl::ParseError;

use crate::names;
use crate::read::{Text, complaint};
use crate::{Complaint, Place};

/// What reading a text came upon.
pub fn reading(text: &Text<'_>, error: &ParseError) -> Complaint {
    let labels: Vec<(Span, &str)> = error.labels().collect();
    let here = labels.first().and_then(|(span, _)| text.range(*span));
    let message = error.message();
    if let Some((wanted, found)) = expectation(message) {
        return unexpected(text, wanted, found, here);
    }
    let quoted: Vec<&str> = message.split('`').skip(1).step_by(2).collect();
    let name = quoted.first().copied().unwrap_or_default();
    let said = Said {
        message,
        name,
        quoted: &quoted,
        labels: &labels,
        here: here
            .as_ref()
            .and_then(|range| text.source.get(range.clone())),
    };
    let about = here.or_else(|| labels.iter().find_map(|(span, _)| text.range(*span)));
    let place = about.map(|range| text.place_of(range));
    told(text, &said).at(place)
}

/// One message of naga, taken apart.
struct Said<'a> {
    message: &'a str,
    /// The first thing it quotes.
    name: &'a str,
    quoted: &'a [&'a str],
    labels: &'a [(Span, &'a str)],
    /// The text it points at.
    here: Option<&'a str>,
}

fn told(text: &Text<'_>, said: &Said<'_>) -> Complaint {
    let Said { message, name, .. } = said;
    let starts = |with: &str| message.starts_with(with);
    if starts("no definition in scope") {
        return names::unknown(text, name);
    }
    if let [from, to] = said.quoted
        && starts("automatic conversions")
    {
        let says = format!("This is {}, where {} is needed.", kind(from), kind(to));
        return match SCALARS.contains(from) && SCALARS.contains(to) {
            true => complaint(says).with_help(format!("Convert it: `{to}(…)`.")),
            false => complaint(says),
        };
    }
    if let [variable, wanted, given] = said.quoted
        && starts("the type of")
    {
        let (wanted, given) = (kind(wanted), kind(given));
        return complaint(format!(
            "`{variable}` is declared as {wanted}, and is given {given}."
        ));
    }
    if starts("the operand of the `*`") {
        return complaint("This is no operation on numbers: a `*` before a value is a pointer's.")
            .with_help("A power is a product, `x * x`, or `pow(x, 2.0)`.");
    }
    if starts("too many arguments") || starts("wrong number of arguments") {
        return arguments(said);
    }
    if starts("wrong type passed as argument") || starts("inconsistent type passed") {
        let number = message
            .split('#')
            .nth(1)
            .and_then(|rest| rest.split(' ').next())
            .unwrap_or("1");
        let has = said.labels.get(1).map_or("", |(_, label)| *label);
        let has = has.split(" has type ").nth(1).unwrap_or("another type");
        let says = format!(
            "`{name}` does not take {} as argument {number}.",
            kind(has.trim_matches('`'))
        );
        return match said.labels.get(2).and_then(|(_, label)| {
            let rest = label.split(" has type ").nth(1)?;
            rest.split(',').next()
        }) {
            Some(first) => complaint(says).with_help(format!(
                "All its arguments are of one type, and the first is {}.",
                kind(first)
            )),
            None => complaint(says),
        };
    }
    if starts("invalid left-hand side") {
        return fixed(text, said);
    }
    if starts("increment/decrement") {
        return complaint("`++` and `--` change a `var` that is a whole number, nothing else.")
            .with_help("Write `x = x + 1.0;` instead.");
    }
    if starts("redefinition of") {
        let before = said.labels.get(1).and_then(|(span, _)| text.place(*span));
        return match before {
            Some(Place { line, .. }) => complaint(format!(
                "`{name}` was defined before, on line {line}: choose another name."
            )),
            None => complaint(format!(
                "`{name}` is one of the functions that are there already: choose another name."
            )),
        };
    }
    if starts("declaration of") {
        return complaint(format!(
            "`{name}` needs itself to be defined; WGSL has no recursion."
        ))
        .with_help("Write it as a loop.");
    }
    if starts("invalid field accessor") {
        return complaint(format!(
            "There is no part `.{name}` here: this is a single number, or has fewer parts."
        ));
    }
    if starts("the concrete type") {
        let value = said.quoted.get(1).copied().unwrap_or("this number");
        return complaint(format!("{} cannot hold {value}.", kind(name)));
    }
    if message.ends_with("operation overflowed") {
        return complaint("This has no value that a number can hold: is it a division by zero?");
    }
    if message.contains("internal") || message.contains("nesting limit") {
        return complaint("This is nested too deep to be read.")
            .with_help("Give parts of it names of their own, with `let`.");
    }
    if starts("expected global declaration") {
        let word = said.here.unwrap_or("This");
        return complaint(format!("`{word}` cannot be used here."))
            .with_help("The function runs as plain WGSL; take this line away.");
    }
    if message.contains("reserved keyword") {
        return complaint(format!(
            "`{name}` is a word of WGSL's own: choose another name."
        ));
    }
    if let Some(operands) = message.strip_prefix("Incompatible operands: ") {
        let sign = operands.split('(').next().map_or("", operator_named);
        return complaint(format!("`{sign}` does not take these operands."))
            .with_help("`&&`, `||` and `!` join comparisons such as `x > 0.0`.");
    }
    if starts("invalid `switch` selector") {
        return complaint("`switch` chooses by a whole number, and this is none.");
    }
    complaint(sentence(message))
}

/// `expected X, found "Y"`, taken apart.
fn expectation(message: &str) -> Option<(&str, String)> {
    let rest = message.strip_prefix("expected ")?;
    let (wanted, found) = rest.rsplit_once(", found \"")?;
    let found = found.strip_suffix('"')?;
    Some((wanted, found.replace("\\\"", "\"").replace("\\n", "\n")))
}

/// Something stands where something else should.
fn unexpected(
    text: &Text<'_>,
    wanted: &str,
    found: String,
    here: Option<Range<usize>>,
) -> Complaint {
    let range = here.unwrap_or(text.source.len()..text.source.len());
    let at_it = |complaint: Complaint| complaint.at(Some(text.place_of(range.clone())));
    let before = text.source[..range.start].trim_end();
    // Right behind what stands before it.
    let behind = || {
        let place = text.place_of(before.len()..before.len());
        Some(place)
    };
    let is_comment = found.starts_with("/*");
    if is_comment {
        return at_it(complaint("This comment has no end: `*/` is missing."));
    }
    if found.is_empty() {
        let says = match wanted {
            "statement" => "The text ends in the middle of a function: a `}` is missing.".into(),
            _ => format!("The text ends too early: {} is missing.", noun(wanted)),
        };
        return complaint(says).at(behind());
    }
    let found = found.lines().next().unwrap_or_default().to_owned();
    match (wanted, found.as_str()) {
        ("`;`", "?") => at_it(
            complaint("WGSL has no `? :`.")
                .with_help("Write `select(otherwise, value, condition)`, or an `if`."),
        ),
        ("`;`", ")") => at_it(complaint(
            "This `)` closes nothing: there is one too many, or a `(` too few.",
        )),
        ("`;`", _) if text.source[before.len()..range.start].contains('\n') => {
            complaint("A `;` is missing at the end of this line.").at(behind())
        }
        ("`;`", _) => at_it(complaint(format!(
            "The statement should be over here: a `;` or an operator is missing before `{found}`."
        ))),
        ("`)`", "=") => at_it(complaint(
            "`=` gives a variable a value; to compare, write `==`.",
        )),
        ("`)`", _) => at_it(complaint(format!(
            "A `(` is still open here: a `)` is missing before `{found}`."
        ))),
        ("`{`", ":") => at_it(complaint(
            "The type that a function returns stands behind `->`, not behind `:`.",
        )),
        ("`{`", _) => at_it(
            complaint(format!("A `{{` is missing before `{found}`."))
                .with_help("WGSL wants braces even around a single statement."),
        ),
        ("`:`", _) => at_it(
            complaint("The type stands behind the name and a `:` in WGSL.")
                .with_help("A parameter is written `x: f32`."),
        ),
        ("expression", _) => at_it(complaint(format!(
            "A value should stand here, and there is `{found}`."
        ))),
        ("assignment or increment/decrement", _) if names::last_word(before) == "fn" => at_it(
            complaint("A function cannot stand inside another: is a `}` missing before it?"),
        ),
        ("assignment or increment/decrement", _) => {
            let word = names::last_word(before);
            let declares = names::foreign_type(word).is_some() || names::is_type(word);
            let says = match declares {
                true => "WGSL does not begin a declaration with the type.".to_owned(),
                false => format!("This is no statement: an `=` is missing before `{found}`."),
            };
            let help = match declares {
                true => format!(
                    "Write `let {found} = …;`, or `var {found} = …;` where it changes later."
                ),
                false => "A statement is `let x = …;`, `x = …;`, `return …;`, or a call.".into(),
            };
            at_it(complaint(says).with_help(help))
        }
        (wanted, "}") if wanted.starts_with("global item") => at_it(complaint(
            "This `}` closes nothing: there is one too many, or a `{` too few.",
        )),
        (wanted, _) if wanted.starts_with("global item") => at_it(
            complaint(format!(
                "`{found}` cannot stand outside of a function: there are `fn`, `const` and `struct`."
            ))
            .with_help("A function is written `fn name(x: f32) -> f32 { … }`."),
        ),
        _ => at_it(complaint(format!(
            "{} should stand here, and there is `{found}`.",
            sentence(&noun(wanted)).trim_end_matches('.')
        ))),
    }
}

/// What was expected, as a noun.
fn noun(wanted: &str) -> String {
    let short = wanted.split(" (").next().unwrap_or(wanted);
    match short {
        "identifier" => "a name".to_owned(),
        "expression" => "a value".to_owned(),
        _ if short.starts_with('`') => format!("a {short}"),
        _ => match short.chars().next() {
            Some(first) if first.is_alphanumeric() => format!("a {short}"),
            _ => format!("`{short}`"),
        },
    }
}

/// The wrong number of arguments.
fn arguments(said: &Said<'_>) -> Complaint {
    let function = said.here.unwrap_or(said.name);
    let mut numbers = said
        .message
        .split(|letter: char| !letter.is_ascii_digit())
        .filter(|number| !number.is_empty());
    match (numbers.next(), numbers.next()) {
        (Some(wanted), Some(found)) => complaint(format!(
            "`{function}` takes {}; here {} given.",
            count(wanted),
            match found {
                "1" => "1 is".to_owned(),
                found => format!("{found} are"),
            }
        )),
        _ => complaint(format!("`{function}` is given too many arguments.")),
    }
}

fn count(number: &str) -> String {
    match number {
        "1" => "1 argument".to_owned(),
        number => format!("{number} arguments"),
    }
}

/// An assignment to what does not change.
fn fixed(text: &Text<'_>, said: &Said<'_>) -> Complaint {
    let name = said.here.unwrap_or("this");
    let declared = said.labels.get(1).and_then(|(span, _)| text.range(*span));
    let by = declared.map(|range| names::last_word(text.source[..range.start].trim_end()));
    let says = format!("`{name}` cannot be given another value.");
    match by {
        Some(word @ ("let" | "const")) => complaint(says).with_help(format!(
            "It was declared with `{word}`; declare it with `var` instead."
        )),
        Some(_) => complaint(says).with_help(format!(
            "It is a parameter; copy it first: `var own_{name} = {name};`."
        )),
        None => complaint(says),
    }
}

/// What a conversion by name makes of one another.
const SCALARS: [&str; 3] = ["f32", "i32", "u32"];

/// A type as naga writes it, for people.
pub fn kind(name: &str) -> String {
    match name {
        "{AbstractFloat}" => "a number with a fraction".to_owned(),
        "{AbstractInt}" => "a whole number".to_owned(),
        name => format!(
            "`{}`",
            name.replace("{AbstractFloat}", "f32")
                .replace("{AbstractInt}", "i32")
        ),
    }
}

fn operator_named(name: &str) -> &'static str {
    match name {
        "LogicalAnd" => "&&",
        "LogicalOr" => "||",
        _ => "this operator",
    }
}

/// A sentence: a capital letter first, a full stop last.
pub fn sentence(text: &str) -> String {
    let text = text.trim().trim_end_matches('.');
    let mut letters = text.chars();
    match letters.next() {
        Some(first) => format!("{}{}.", first.to_uppercase(), letters.as_str()),
        None => "Something is wrong with this text.".to_owned(),
    }
}
