//! `lobe eval`: an expression's value.

use formula::{Library, Values, parse};

use crate::cli::{Eval, Precision};
use crate::exit::{Done, Failure};
use crate::output;

pub fn run(args: &Eval) -> Result<Done, Failure> {
    let library = Library::new();
    let batch = match &args.batch {
        Some(path) => Some(super::lines_of(path)?),
        None => None,
    };
    let expressions: Vec<&String> = match &batch {
        Some(lines) => lines
            .iter()
            .filter(|line| !line.trim().is_empty())
            .collect(),
        None => args.expressions.iter().collect(),
    };
    let as_json = args.json || batch.is_some();
    let mut wrong = false;
    // One write for many lines.
    let mut out = String::new();
    for expression in expressions {
        let value = value(&library, expression, args.precision);
        wrong |= value.is_err();
        if as_json {
            out.push_str(&json(expression, &value));
            out.push('\n');
        } else {
            match value {
                Ok(value) => out.push_str(&format!(
                    "{expression} = {}\n",
                    human(value, args.precision)
                )),
                Err(error) => complain(expression, &error),
            }
        }
    }
    output::text(&out)?;
    Ok(Done::found(wrong))
}

fn value(library: &Library, text: &str, precision: Precision) -> Result<f64, formula::Error> {
    let expr = parse(text)?;
    let none = Values::new();
    match precision {
        Precision::F64 => library.eval(&expr, &none),
        Precision::F32 => library.eval_f32(&expr, &none),
    }
}

/// Shortest digits that come back as the same number in that precision.
fn human(value: f64, precision: Precision) -> String {
    match precision {
        Precision::F64 => value.to_string(),
        Precision::F32 => (value as f32).to_string(),
    }
}

/// Written by hand because the value has 17 significant digits.
fn json(text: &str, value: &Result<f64, formula::Error>) -> String {
    let quoted = |text: &str| serde_json::Value::from(text).to_string();
    match value {
        Ok(value) if value.is_finite() => {
            format!(
                "{{\"expr\":{},\"value\":{}}}",
                quoted(text),
                output::digits_17(*value)
            )
        }
        Ok(value) => no_value(&quoted(text), &quoted(&format!("the value is {value}"))),
        Err(error) => no_value(&quoted(text), &quoted(&error.to_string())),
    }
}

fn no_value(text: &str, error: &str) -> String {
    format!("{{\"expr\":{text},\"value\":null,\"error\":{error}}}")
}

/// The expression with the place of the error under it.
fn complain(text: &str, error: &formula::Error) {
    output::complain(&error.to_string());
    let start = error.span.start.min(text.len());
    if let (Some(before), Some(inside)) = (
        text.get(..start),
        text.get(start..error.span.end.min(text.len())),
    ) {
        let carets = "^".repeat(inside.chars().count().max(1));
        let before = " ".repeat(before.chars().count());
        output::note(&format!("  {text}\n  {before}{carets}"));
    }
}
