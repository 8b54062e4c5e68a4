//! Text in the bundled font: measured, broken into lines and drawn without any system font.

use ab_glyph::{Font, FontRef, GlyphId, Point, PxScale};
use std::sync::OnceLock;

/// Regular weight of the bundled subset of DejaVu Sans.
pub(crate) static REGULAR: &[u8] = include_bytes!("../fonts/DejaVuSans.ttf");
/// Bold weight of the bundled subset of DejaVu Sans.
pub(crate) static BOLD: &[u8] = include_bytes!("../fonts/DejaVuSans-Bold.ttf");

/// How heavy the strokes are.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Weight {
    /// Body text.
    Regular,
    /// Titles.
    Bold,
}

fn font(weight: Weight) -> &'static FontRef<'static> {
    static FONTS: OnceLock<[FontRef<'static>; 2]> = OnceLock::new();
    let fonts = FONTS.get_or_init(|| {
        // The bytes are compiled in and a test reads them: this cannot fail on a user's machine.
        [REGULAR, BOLD]
            .map(|bytes| FontRef::try_from_slice(bytes).expect("the bundled font is sound"))
    });
    match weight {
        Weight::Regular => &fonts[0],
        Weight::Bold => &fonts[1],
    }
}

/// One glyph with the pen position at which it starts, in pixels.
pub(crate) struct Placed {
    id: GlyphId,
    x: f32,
}

/// Places the glyphs of one line; the second value is the line's advance in pixels.
fn layout(text: &str, size: f32, weight: Weight) -> (Vec<Placed>, f32) {
    let font = font(weight);
    let per_unit = size / font.units_per_em().unwrap_or(2048.0);
    let mut pen = 0.0;
    let mut previous: Option<GlyphId> = None;
    let mut glyphs = Vec::with_capacity(text.len());
    for c in text.chars() {
        let id = font.glyph_id(c);
        if let Some(previous) = previous {
            pen += font.kern_unscaled(previous, id) * per_unit;
        }
        glyphs.push(Placed { id, x: pen });
        pen += font.h_advance_unscaled(id) * per_unit;
        previous = Some(id);
    }
    (glyphs, pen)
}

/// Width of one line in pixels; `size` is the em in pixels.
pub fn width(text: &str, size: f32, weight: Weight) -> f32 {
    layout(text, size, weight).1
}

/// Calls `ink(dx, dy, coverage)` for every touched pixel, `dx`, `dy` counted from the pixel that
/// holds the baseline's start; `fraction` is where in that pixel the pen starts, in [0, 1).
pub(crate) fn rasterise(
    text: &str,
    size: f32,
    weight: Weight,
    fraction: f32,
    mut ink: impl FnMut(i32, i32, f32),
) {
    let font = font(weight);
    let per_unit = size / font.units_per_em().unwrap_or(2048.0);
    // ab_glyph scales by the height of ascent and descent, not by the em.
    let scale = PxScale::from(font.height_unscaled() * per_unit);
    for glyph in layout(text, size, weight).0 {
        let position = Point {
            x: glyph.x + fraction,
            y: 0.0,
        };
        let Some(outline) = font.outline_glyph(glyph.id.with_scale_and_position(scale, position))
        else {
            continue;
        };
        let bounds = outline.px_bounds();
        let (left, top) = (bounds.min.x as i32, bounds.min.y as i32);
        outline.draw(|x, y, coverage| ink(left + x as i32, top + y as i32, coverage));
    }
}

/// Breaks `text` at spaces into lines of at most `max` pixels; a longer word stays whole.
pub fn wrap(text: &str, size: f32, weight: Weight, max: f32) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if width(&format!("{line} {word}"), size, weight) <= max => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

/// `text`, cut with an ellipsis where it is wider than `max` pixels.
pub fn shorten(text: &str, size: f32, weight: Weight, max: f32) -> String {
    let (glyphs, whole) = layout(text, size, weight);
    if whole <= max {
        return text.to_owned();
    }
    let room = max - width("…", size, weight);
    // A glyph starts where the text before it ends: keep what ends within the room.
    let kept = glyphs
        .iter()
        .skip(1)
        .take_while(|glyph| glyph.x <= room)
        .count();
    if kept == 0 {
        return String::new();
    }
    let kept: String = text.chars().take(kept).collect();
    format!("{}…", kept.trim_end())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bundled_fonts_draw_the_symbols_of_the_field() {
        for weight in [Weight::Regular, Weight::Bold] {
            for c in "Aé αβπθλσφΛ·×−√²³⁵₀₂→∞≤≥≠≈°%′∫".chars()
            {
                assert!(font(weight).glyph_id(c).0 != 0, "{weight:?} lacks {c}");
            }
        }
    }

    #[test]
    fn lines_are_broken_at_spaces_and_no_word_is_lost() {
        let text = "a rough metal shows what a smooth plastic ball hides from every eye";
        let lines = wrap(text, 12.0, Weight::Regular, 120.0);
        assert!(lines.len() > 2);
        assert_eq!(lines.join(" "), text);
        assert!(
            lines
                .iter()
                .all(|line| width(line, 12.0, Weight::Regular) <= 120.0)
        );
        assert!(shorten(text, 12.0, Weight::Bold, 80.0).ends_with('…'));
    }
}
