//! From a text to a function that can be called, or to what is wrong with it.

use naga::valid::{Capabilities, ValidationFlags, Validator};
use naga::{Function, Handle, Module, Scalar, Span, TypeInner};

use crate::machine::Limits;
use crate::{Complaint, MOST_BYTES, Place, Task, invalid, support, thousands, words};

/// Lines longer than this are not shown whole.
const WIDEST: usize = 120;

/// The text that naga reads: what is offered, then what was written.
pub struct Text<'a> {
    pub whole: String,
    /// Where the written part starts.
    start: usize,
    pub source: &'a str,
    pub offered: &'a str,
}

impl<'a> Text<'a> {
    pub fn new(task: &'a Task) -> Text<'a> {
        let whole = format!("{}\n{}", task.offered, task.source);
        Text {
            start: task.offered.len() + 1,
            whole,
            source: &task.source,
            offered: &task.offered,
        }
    }

    /// The bytes of the written part that a span covers.
    pub fn range(&self, span: Span) -> Option<std::ops::Range<usize>> {
        let range = span.to_range()?;
        let start = range.start.checked_sub(self.start)?;
        let end = range.end.checked_sub(self.start)?;
        self.source.get(start..end).map(|_| start..end)
    }

    pub fn place(&self, span: Span) -> Option<Place> {
        self.range(span).map(|range| self.place_of(range))
    }

    /// The place of some bytes; what goes over several lines is cut at the first one's end.
    pub fn place_of(&self, range: std::ops::Range<usize>) -> Place {
        let before = &self.source[..range.start];
        let start = before.rfind('\n').map_or(0, |at| at + 1);
        let rest = &self.source[start..];
        let text = rest.lines().next().unwrap_or_default();
        let column = self.source[start..range.start].chars().count();
        let width = self.source[range].lines().next().unwrap_or_default();
        let shown = |letter: char| if letter.is_control() { ' ' } else { letter };
        // A line that nobody could read on a screen is cut on both sides.
        let cut = match text.chars().count() > WIDEST {
            true => column.saturating_sub(WIDEST / 2),
            false => 0,
        };
        Place {
            line: before.matches('\n').count() + 1,
            column: column + 1,
            width: width.chars().count().max(1),
            text: text.chars().skip(cut).take(WIDEST).map(shown).collect(),
            mark: column - cut + 1,
        }
    }
}

/// Something about the whole text.
pub fn complaint(says: impl Into<String>) -> Complaint {
    Complaint {
        says: says.into(),
        help: None,
        place: None,
    }
}

impl Complaint {
    pub(crate) fn with_help(mut self, help: impl Into<String>) -> Complaint {
        self.help = Some(help.into());
        self
    }

    pub(crate) fn at(mut self, place: Option<Place>) -> Complaint {
        self.place = place;
        self
    }
}

/// Reads, validates, and finds the function.
pub fn read(task: &Task, limits: Limits) -> Result<(Module, Handle<Function>), Complaint> {
    if task.source.len() > MOST_BYTES {
        return Err(complaint(format!(
            "This text has {} bytes; at most {} are read.",
            thousands(task.source.len() as u64),
            thousands(MOST_BYTES as u64)
        )));
    }
    if task.source.trim().is_empty() {
        let help = format!("Write the function `{}`.", task.function);
        return Err(complaint("There is no text.").with_help(help));
    }
    let text = Text::new(task);
    let module =
        naga::front::wgsl::parse_str(&text.whole).map_err(|error| words::reading(&text, &error))?;
    Validator::new(ValidationFlags::all(), Capabilities::empty())
        .validate(&module)
        .map_err(|error| invalid::validating(&text, &module, &error))?;
    support::check(&text, &module, limits)?;
    let function = signature(task, &text, &module)?;
    Ok((module, function))
}

/// The function of that name, where it takes and returns what it should.
fn signature(task: &Task, text: &Text<'_>, module: &Module) -> Result<Handle<Function>, Complaint> {
    let name = &task.function;
    let wanted = wanted(task);
    let found = module
        .functions
        .iter()
        .find(|(_, function)| function.name.as_deref() == Some(name));
    let Some((handle, function)) = found else {
        if module.entry_points.iter().any(|entry| entry.name == *name) {
            let says = format!("`{name}` is marked as a whole shader; it should be a function.");
            let help = format!("Take the attribute that begins with `@` away: `{wanted}`.");
            return Err(complaint(says).with_help(help));
        }
        return Err(
            complaint(format!("There is no function `{name}` in this text."))
                .with_help(format!("Keep its name and what it takes: `{wanted}`.")),
        );
    };
    let place = text.place(module.functions.get_span(handle));
    let wrong = |says: String| {
        let help = format!("It should read `{wanted}`.");
        Err(complaint(says).with_help(help).at(place.clone()))
    };
    let is_f32 = |ty| module.types[ty].inner == TypeInner::Scalar(Scalar::F32);
    let (has, takes) = (function.arguments.len(), task.params.len());
    if has != takes {
        let numbers = |count: usize| match count {
            0 => "nothing".to_owned(),
            1 => "one number".to_owned(),
            count => format!("{count} numbers"),
        };
        return wrong(format!(
            "`{name}` takes {} here, and should take {}.",
            numbers(has),
            numbers(takes)
        ));
    }
    for (argument, param) in function.arguments.iter().zip(&task.params) {
        let called = argument.name.as_deref().unwrap_or(param);
        if !is_f32(argument.ty) {
            return wrong(format!(
                "The parameter `{called}` of `{name}` is not of type f32."
            ));
        }
        if called != param && task.params.iter().any(|other| other == called) {
            return wrong(format!(
                "The parameters of `{name}` stand in another order: `{called}` is where `{param}` should be."
            ));
        }
    }
    match &function.result {
        Some(result) if is_f32(result.ty) => Ok(handle),
        Some(_) => wrong(format!("`{name}` does not return an f32.")),
        None => wrong(format!("`{name}` returns nothing.")),
    }
}

/// `fn name(a: f32, b: f32) -> f32`.
fn wanted(task: &Task) -> String {
    let params: Vec<String> = task
        .params
        .iter()
        .map(|param| format!("{param}: f32"))
        .collect();
    format!("fn {}({}) -> f32", task.function, params.join(", "))
}
