//! Where a byte of a decoded TOML string stands in the file.

use crate::finding::Place;

/// The place in the file of `start..end` of a decoded string whose literal is at `literal`.
/// Where the literal cannot be followed (a bare key, say) it is the literal itself.
pub fn place_in(source: &str, literal: Place, decoded: &str, start: usize, end: usize) -> Place {
    let Some(raw) = source.get(literal.start..literal.end) else {
        return literal;
    };
    let start = start.min(decoded.len());
    let end = end.clamp(start, decoded.len());
    match (offset(raw, decoded, start), offset(raw, decoded, end)) {
        (Some(from), Some(to)) => Place {
            start: literal.start + from,
            end: literal.start + to.max(from),
        },
        _ => literal,
    }
}

/// The byte of the literal at which the decoded string's byte `target` is written.
fn offset(raw: &str, decoded: &str, target: usize) -> Option<usize> {
    let (quote, escapes) = if raw.starts_with("\"\"\"") {
        ("\"\"\"", true)
    } else if raw.starts_with("'''") {
        ("'''", false)
    } else if raw.starts_with('"') {
        ("\"", true)
    } else if raw.starts_with('\'') {
        ("'", false)
    } else if raw == decoded {
        return Some(target);
    } else {
        return None;
    };
    let mut at = quote.len();
    if quote.len() == 3 {
        // A line end right after the opening quotes is not part of the string.
        for line_end in ["\r\n", "\n"] {
            if raw[at..].starts_with(line_end) {
                at += line_end.len();
                break;
            }
        }
    }
    let body_end = raw.len().checked_sub(quote.len())?;
    let mut seen = 0;
    while seen < target {
        let rest = raw.get(at..body_end)?;
        let unit = unit(rest, escapes)?;
        match unit {
            Unit::Skipped(length) => at += length,
            Unit::Char(length, character) => {
                let left = decoded.get(seen..)?;
                if left.starts_with(character) {
                    seen += character.len_utf8();
                } else if !(character == '\r' && left.starts_with('\n')) {
                    return None;
                }
                at += length;
            }
        }
    }
    // A continued line belongs to what comes after it.
    while let Some(Unit::Skipped(length)) =
        raw.get(at..body_end).and_then(|rest| unit(rest, escapes))
    {
        at += length;
    }
    Some(at)
}

enum Unit {
    /// So many bytes that stand for nothing.
    Skipped(usize),
    /// So many bytes that stand for a character.
    Char(usize, char),
}

fn unit(rest: &str, escapes: bool) -> Option<Unit> {
    let first = rest.chars().next()?;
    if first != '\\' || !escapes {
        return Some(Unit::Char(first.len_utf8(), first));
    }
    let second = rest[1..].chars().next()?;
    let hex = |digits: usize| {
        let text = rest.get(2..2 + digits)?;
        let character = char::from_u32(u32::from_str_radix(text, 16).ok()?)?;
        Some(Unit::Char(2 + digits, character))
    };
    match second {
        'b' => Some(Unit::Char(2, '\u{8}')),
        't' => Some(Unit::Char(2, '\t')),
        'n' => Some(Unit::Char(2, '\n')),
        'f' => Some(Unit::Char(2, '\u{c}')),
        'r' => Some(Unit::Char(2, '\r')),
        'e' => Some(Unit::Char(2, '\u{1b}')),
        '"' => Some(Unit::Char(2, '"')),
        '\\' => Some(Unit::Char(2, '\\')),
        'x' => hex(2),
        'u' => hex(4),
        'U' => hex(8),
        _ if second.is_whitespace() => {
            let skipped = rest[1..]
                .find(|c: char| !matches!(c, ' ' | '\t' | '\r' | '\n'))
                .unwrap_or(rest.len() - 1);
            Some(Unit::Skipped(1 + skipped))
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(file: &str, needle: &str, column: usize) {
        let table = toml::de::DeTable::parse(file).expect("valid TOML");
        let value = table.get_ref().get("a").expect("key a");
        let decoded = value.get_ref().as_str().expect("a string");
        let start = decoded.find(needle).expect("needle in the string");
        let literal = Place {
            start: value.span().start,
            end: value.span().end,
        };
        let place = place_in(file, literal, decoded, start, start + needle.len());
        let (line, found) = crate::finding::line_and_column(file, place.start);
        assert_eq!((line * 100 + found), column, "{file:?}");
    }

    #[test]
    fn offsets_survive_quotes_and_escapes() {
        check("a = \"x 0.5\"", "0.5", 108);
        check("a = 'x 0.5'", "0.5", 108);
        check("a = \"\\u03b1 0.5\"", "0.5", 113);
        check("a = \"\\\"\\\\ 0.5\"", "0.5", 111);
        check("a = \"\"\"\nx\n y 0.5\"\"\"", "0.5", 304);
        check("a = \"\"\"\r\nx\r\n y 0.5\"\"\"", "0.5", 304);
        check("a = \"\"\"x \\\n   y 0.5\"\"\"", "0.5", 206);
        check("a = \"\"\"x \\\n   0.5\"\"\"", "0.5", 204);
        check("a = '''\nx \\ 0.5'''", "0.5", 205);
        check("a = \"α² 0.5\"", "0.5", 109);
    }
}
