//! What stands around every screen: the footer with the keys that work here.

use ratatui::Frame;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};
use unicode_width::UnicodeWidthStr as _;

use super::style::Palette;

/// A key and what it does here.
pub type Key = (&'static str, String);

/// A key with a fixed meaning.
pub fn key(name: &'static str, does: &str) -> Key {
    (name, does.to_owned())
}

/// The keys that work here, as many as fit, the most important first; `right` at the right.
pub fn footer(frame: &mut Frame, area: Rect, keys: &[Key], right: &str, palette: Palette) {
    let room = (area.width as usize).saturating_sub(right.width() + 2);
    let mut line = Line::default();
    for (name, does) in keys {
        let gap = if line.spans.is_empty() { "" } else { "  " };
        let width = gap.width() + name.width() + 1 + does.width();
        // A shorter one may still have room.
        if line.width() + width > room {
            continue;
        }
        line.push_span(Span::raw(gap));
        line.push_span(Span::styled(*name, palette.key()));
        line.push_span(Span::styled(format!(" {does}"), palette.quiet()));
    }
    frame.render_widget(line, area);
    at_right(frame, area, Line::styled(right.to_owned(), palette.quiet()));
}

/// A line that ends at the right edge.
pub fn at_right(frame: &mut Frame, area: Rect, line: Line) {
    let width = (line.width() as u16).min(area.width);
    let at = Rect {
        x: area.right() - width,
        width,
        height: 1.min(area.height),
        ..area
    };
    frame.render_widget(line, at);
}

/// A rule over the whole width.
pub fn rule(frame: &mut Frame, area: Rect, palette: Palette) {
    frame.render_widget(
        Line::styled("─".repeat(area.width as usize), palette.quiet()),
        area,
    );
}

/// The beginning of a text that fits into `width` columns.
pub fn cut(text: &str, width: usize) -> String {
    if text.width() <= width {
        return text.to_owned();
    }
    let mut short = String::new();
    for letter in text.chars() {
        if short.width() + 2 > width {
            break;
        }
        short.push(letter);
    }
    short + "…"
}
