//! Single signs and what they stand for.

use super::text::Kind;

/// Marks that change how text is laid out and nothing else.
pub fn is_invisible(c: char) -> bool {
    matches!(c, '\u{200b}'..='\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2060}'..='\u{2069}' | '\u{feff}' | '\u{ad}')
}

pub fn superscript(c: char) -> Option<char> {
    Some(match c {
        '⁰' => '0',
        '¹' => '1',
        '²' => '2',
        '³' => '3',
        '⁴' => '4',
        '⁵' => '5',
        '⁺' => '+',
        '⁻' => '-',
        _ => return None,
    })
}

pub fn greek(c: char) -> Option<&'static str> {
    Some(match c {
        'α' | 'Α' => "alpha",
        'π' | 'Π' | 'ϖ' => "pi",
        'θ' | 'Θ' | 'ϑ' => "theta",
        'δ' | 'Δ' => "delta",
        'η' => "eta",
        'λ' | 'Λ' => "lambda",
        'σ' => "sigma",
        '∞' => "infinity",
        '∥' | '‖' => "parallel",
        '⊥' => "perpendicular",
        '½' => "half",
        '¼' => "quarter",
        '¾' => "three quarters",
        _ => return None,
    })
}

pub fn operator(c: char) -> Option<(&'static str, Kind)> {
    Some(match c {
        '∋' | '⊃' | '⊇' => ("contains", Kind::Word),
        '∈' | '⊂' | '⊆' => ("inside", Kind::Word),
        '→' | '⇒' | '⟶' | '⟹' | '↦' | '➔' | '➜' | '↗' | '⇾' => ("->", Kind::Op),
        '←' | '⇐' | '⟸' => ("<-", Kind::Op),
        '↑' => ("increases", Kind::Word),
        '↓' => ("decreases", Kind::Word),
        '≈' | '≃' | '∼' | '≅' | '~' => ("~", Kind::Op),
        '=' | '≡' | '≝' => ("=", Kind::Op),
        '≠' => ("!=", Kind::Op),
        '<' | '≤' | '≪' | '⩽' => ("<", Kind::Op),
        '>' | '≥' | '≫' | '⩾' => (">", Kind::Op),
        '+' | '±' => ("+", Kind::Op),
        '*' | '·' | '⋅' | '×' | '∙' | '∗' => ("*", Kind::Op),
        '/' | '÷' | '∕' => ("/", Kind::Op),
        '^' => ("^", Kind::Op),
        '(' | '[' | '⟨' | '〈' => ("(", Kind::Op),
        ')' | ']' | '⟩' | '〉' => (")", Kind::Op),
        ',' => (",", Kind::Comma),
        ';' | ':' => (";", Kind::Break),
        '—' => ("--", Kind::Break),
        '…' => ("...", Kind::Break),
        '!' | '。' => (".", Kind::Stop),
        '?' | '？' => ("?", Kind::Question),
        '•' | '‣' | '▪' | '◦' | '●' => (".", Kind::Stop),
        _ => return None,
    })
}

pub fn is_combining(c: char) -> bool {
    unicode_normalization::char::is_combining_mark(c)
}

/// What a closing brace of LaTeX stands for.
#[derive(Clone, Copy)]
pub enum Brace {
    Numerator,
    Denominator,
    Group,
    Silent,
}

/// What marks the items of the list that is being read.
#[derive(Clone, Copy, PartialEq)]
pub enum Items {
    Dash,
    Star,
    Number(u32),
}
