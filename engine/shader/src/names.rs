//! Names that are not there: what was meant, in this text, in WGSL, or in another language.

use crate::Complaint;
use crate::read::{Text, complaint};

/// What other shading languages call it, and WGSL's word for it.
const FOREIGN: [(&str, &str); 22] = [
    ("float", "f32"),
    ("double", "f32"),
    ("half", "f32"),
    ("int", "i32"),
    ("uint", "u32"),
    ("float2", "vec2f"),
    ("float3", "vec3f"),
    ("float4", "vec4f"),
    ("lerp", "mix"),
    ("frac", "fract"),
    ("rsqrt", "inverseSqrt"),
    ("inversesqrt", "inverseSqrt"),
    ("sqr", "x * x"),
    ("square", "x * x"),
    ("mul", "a * b"),
    ("mod", "a % b"),
    ("fmod", "a % b"),
    ("fabs", "abs"),
    ("powf", "pow"),
    ("sqrtf", "sqrt"),
    ("ln", "log"),
    ("smooth_step", "smoothstep"),
];

/// The types before which C would put nothing.
const TYPES: [&str; 8] = [
    "f32", "i32", "u32", "bool", "vec2f", "vec3f", "vec4f", "vec3",
];

/// Functions that every WGSL has.
const BUILT_IN: [&str; 42] = [
    "abs",
    "acos",
    "acosh",
    "all",
    "any",
    "asin",
    "asinh",
    "atan",
    "atan2",
    "atanh",
    "ceil",
    "clamp",
    "cos",
    "cosh",
    "cross",
    "degrees",
    "distance",
    "dot",
    "exp",
    "exp2",
    "floor",
    "fma",
    "fract",
    "inverseSqrt",
    "length",
    "log",
    "log2",
    "max",
    "min",
    "mix",
    "normalize",
    "pow",
    "radians",
    "reflect",
    "round",
    "saturate",
    "select",
    "sign",
    "sin",
    "smoothstep",
    "sqrt",
    "step",
];

/// WGSL's words that may stand where a name may.
const KEYWORDS: [&str; 20] = [
    "fn", "let", "var", "const", "return", "if", "else", "for", "while", "loop", "switch", "case",
    "default", "break", "continue", "struct", "alias", "true", "false", "discard",
];

/// WGSL's word for a type of another language.
pub fn foreign_type(word: &str) -> Option<&'static str> {
    foreign(word).filter(|ours| TYPES.contains(ours))
}

pub fn is_type(word: &str) -> bool {
    TYPES.contains(&word)
}

fn foreign(word: &str) -> Option<&'static str> {
    let found = FOREIGN.iter().find(|(theirs, _)| *theirs == word);
    found.map(|(_, ours)| *ours)
}

/// A name that is defined nowhere.
pub fn unknown(text: &Text<'_>, name: &str) -> Complaint {
    if BUILT_IN.contains(&name) {
        return complaint(format!("`{name}` is a function: say of what, `{name}(…)`."));
    }
    if KEYWORDS.contains(&name) {
        return complaint(format!("`{name}` is a word of WGSL's own, and no value."));
    }
    let says = complaint(format!("`{name}` is not defined here."));
    if let Some(ours) = foreign(name) {
        return says.with_help(format!("WGSL writes `{ours}`."));
    }
    if ["pi", "PI", "M_PI"].contains(&name) {
        return says.with_help("WGSL has no π of its own: write `const PI = 3.14159265;`.");
    }
    let known = words(text.source)
        .chain(offered(text.offered))
        .chain(BUILT_IN)
        .filter(|known| *known != name);
    let near = known
        .map(|known| (strsim::jaro_winkler(name, known), known))
        .filter(|(likeness, _)| *likeness > 0.8)
        .max_by(|a, b| a.0.total_cmp(&b.0));
    match near {
        Some((_, near)) => says.with_help(format!("Did you mean `{near}`?")),
        None => says,
    }
}

/// The names that a text defines: behind `let`, `fn` and their like, and before a `:`.
fn words(source: &str) -> impl Iterator<Item = &str> {
    let code = source
        .lines()
        .map(|line| line.split("//").next().unwrap_or_default());
    code.flat_map(|line| {
        let mut found = Vec::new();
        let mut before = "";
        for range in word_ranges(line) {
            let word = &line[range.clone()];
            let declares = ["let", "var", "const", "fn"].contains(&before);
            let typed = line[range.end..].trim_start().starts_with(':');
            if (declares || typed) && !KEYWORDS.contains(&word) {
                found.push(word);
            }
            before = word;
        }
        found
    })
}

/// The functions offered that a learner is to call: not the inner ones, whose names begin with
/// the house's own.
fn offered(source: &str) -> impl Iterator<Item = &str> {
    let names = source.lines().filter_map(|line| {
        let rest = line.strip_prefix("fn ")?;
        rest.split('(').next()
    });
    names.filter(|name| !name.starts_with("lobe_"))
}

fn word_ranges(line: &str) -> impl Iterator<Item = std::ops::Range<usize>> {
    let in_word = |letter: char| letter.is_alphanumeric() || letter == '_';
    let mut at = 0;
    std::iter::from_fn(move || {
        let start = at + line[at..].find(in_word)?;
        let rest = &line[start..];
        let end = start + rest.find(|letter| !in_word(letter)).unwrap_or(rest.len());
        at = end;
        Some(start..end)
    })
}

/// The word that a text ends with.
pub fn last_word(text: &str) -> &str {
    let in_word = |letter: char| letter.is_alphanumeric() || letter == '_';
    let start = text
        .char_indices()
        .rev()
        .take_while(|(_, letter)| in_word(*letter))
        .last()
        .map_or(text.len(), |(at, _)| at);
    &text[start..]
}
