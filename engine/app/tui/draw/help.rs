//! The help that lies over everything.

use ratatui::Frame;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, Clear};

use super::style::Palette;

const KEYS: [(&str, &str); 20] = [
    ("Enter, →, l", "go on; Enter also answers"),
    ("←, h", "back one screen; nothing is lost"),
    ("↑ ↓, k j", "scroll, or choose"),
    ("PgUp PgDn, Space", "scroll by pages"),
    ("g G", "to the top, to the bottom"),
    ("Tab", "between page, field and button"),
    ("Esc", "leave a field, so that single keys are commands"),
    ("t, Ctrl-T", "a hint; the third one is the answer"),
    ("s, Ctrl-G", "skip this"),
    ("r", "re-test: first what is due again"),
    ("i", "the picture in view under the arrow keys"),
    ("Ctrl-S", "hand in an explanation; run a shader"),
    ("Ctrl-O", "a shader in your own editor ($EDITOR)"),
    ("y n", "tick a point of a checklist, or not"),
    ("Space", "in an order: grab an item, then move it"),
    (
        "q, Ctrl-C",
        "save and leave; you come back to this very screen",
    ),
    ("Ctrl-L", "draw the screen again"),
    ("? F1", "this help"),
    ("", ""),
    ("Numbers", "0.56, 0,56 or arithmetic: 0.4^4, 1/pi, cos(60°)"),
];

/// Rows that the help could show beyond those it shows.
pub fn last_scroll(height: u16) -> usize {
    KEYS.len().saturating_sub(height.saturating_sub(4) as usize)
}

pub fn draw(frame: &mut Frame, scroll: usize, palette: Palette) {
    let whole = frame.area();
    let width = 76.min(whole.width.saturating_sub(2));
    let height = (KEYS.len() as u16 + 2).min(whole.height.saturating_sub(2));
    let area = Rect {
        x: whole.x + (whole.width - width) / 2,
        y: whole.y + (whole.height - height) / 2,
        width,
        height,
    };
    let block = Block::bordered()
        .border_style(palette.frame(true))
        .title(Line::styled(" Keys ", palette.title()))
        .title_bottom(Line::styled(" Esc closes ", palette.quiet()));
    let inner = block.inner(area);
    frame.render_widget(Clear, area);
    frame.render_widget(block, area);
    for (row, (keys, does)) in KEYS
        .iter()
        .skip(scroll)
        .take(inner.height as usize)
        .enumerate()
    {
        let line = Line::from(vec![
            Span::styled(format!(" {keys:<18}"), palette.key()),
            Span::raw(*does),
        ]);
        frame.render_widget(
            line,
            Rect {
                y: inner.y + row as u16,
                height: 1,
                ..inner
            },
        );
    }
}
