//! The elementary functions: names, numbers of arguments, domains.

use crate::error::{Error, Span};
use crate::expr::Arg;

/// An elementary function of the language.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) enum Builtin {
    Sqrt,
    Exp,
    Ln,
    Log2,
    Abs,
    Min,
    Max,
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan,
    Pow,
    Deg,
}

use Builtin::*;

const ALL: [(&str, Builtin); 15] = [
    ("sqrt", Sqrt),
    ("exp", Exp),
    ("ln", Ln),
    ("log2", Log2),
    ("abs", Abs),
    ("min", Min),
    ("max", Max),
    ("sin", Sin),
    ("cos", Cos),
    ("tan", Tan),
    ("asin", Asin),
    ("acos", Acos),
    ("atan", Atan),
    ("pow", Pow),
    ("deg", Deg),
];

/// The names of the elementary functions.
pub fn builtin_names() -> impl Iterator<Item = &'static str> + Clone {
    ALL.iter().map(|(name, _)| *name)
}

impl Builtin {
    pub fn named(name: &str) -> Option<Builtin> {
        ALL.iter()
            .find(|(known, _)| *known == name)
            .map(|(_, builtin)| *builtin)
    }

    pub fn name(self) -> &'static str {
        ALL.iter()
            .find(|(_, builtin)| *builtin == self)
            .map_or("", |(name, _)| name)
    }

    /// Fewest and most arguments.
    fn arity(self) -> (usize, usize) {
        match self {
            Min | Max => (2, 16),
            Pow => (2, 2),
            _ => (1, 1),
        }
    }
}

/// Refuses a call of an elementary function with names or with the wrong number of
/// arguments.
pub(crate) fn check_args(name: &str, args: &[Arg], span: Span) -> Result<(), Error> {
    let Some(builtin) = Builtin::named(name) else {
        return Ok(());
    };
    let form = match builtin {
        Min | Max => format!("{name}(a, b)"),
        Pow => "pow(base, exponent)".to_string(),
        _ => format!("{name}(x)"),
    };
    if let Some(arg) = args.iter().find(|arg| arg.name.is_some()) {
        return Err(Error::new(
            arg.value.span,
            format!("{name} takes its arguments without names"),
        )
        .help(format!("write {form}")));
    }
    let (least, most) = builtin.arity();
    if args.len() < least || args.len() > most {
        let found = match args.len() {
            1 => "1 argument".to_string(),
            count => format!("{count} arguments"),
        };
        let wanted = match (least, most) {
            (1, 1) => "one".to_string(),
            (2, 2) => "two".to_string(),
            _ => format!("{least} to {most}"),
        };
        return Err(
            Error::new(span, format!("{name} takes {wanted}, found {found}"))
                .help(format!("write {form}")),
        );
    }
    Ok(())
}
