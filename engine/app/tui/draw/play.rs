//! The screen of a picture that is played with.

use ratatui::layout::Rect;
use ratatui::text::{Line, Span};
use ratatui::widgets::Widget as _;
use ratatui_image::sliced::{SignedPosition, SlicedImage};

use super::chrome::{footer, key, rule};
use super::picture::{COLOURS, SIGNS, names};
use super::style::Palette;
use crate::fingerprints::figures;
use crate::text;
use crate::tui::dials::Quantity;
use crate::tui::pictures::{Drawn, columns_in, rows_for};
use crate::tui::play::Play;

/// Rows around the panels: title, rule, names, colours, a free one, values, figures, footer.
const AROUND: u16 = 2 + 2 + 1 + 1 + 3 + 1;

/// Where everything goes.
pub struct Areas {
    pub panels: Rect,
}

impl Areas {
    /// On a screen of that size, the panels at most `columns` wide.
    pub fn new(whole: Rect, columns: u16) -> Self {
        let room = whole.height.saturating_sub(AROUND).max(2);
        let width = whole.width.saturating_sub(2).min(columns);
        // As high as the width allows, and as wide as the height does: three squares in a row.
        let height = rows_for(width).min(room);
        Self {
            panels: Rect {
                x: whole.x + 1,
                y: whole.y + 2,
                width: columns_in(height, width),
                height,
            },
        }
    }
}

pub fn draw(frame: &mut ratatui::Frame, play: &Play, columns: u16, palette: Palette) {
    let whole = frame.area();
    let panels = Areas::new(whole, columns).panels;
    let row = |y: u16| Rect {
        x: whole.x + 1,
        y: y.min(whole.bottom().saturating_sub(1)),
        width: whole.width.saturating_sub(2),
        height: 1,
    };
    frame.render_widget(
        Line::styled(play.title.clone(), palette.title()),
        row(whole.y),
    );
    rule(
        frame,
        Rect {
            y: whole.y + 1,
            height: 1,
            ..whole
        },
        palette,
    );
    let mut key_to_colours = COLOURS;
    match &play.shown {
        Err(why) => frame.render_widget(Line::raw(format!("! no picture: {why}")), row(panels.y)),
        Ok((_, Drawn::Pixels(image))) => {
            SlicedImage::new(image, SignedPosition::from((0, 0)))
                .render(panels, frame.buffer_mut());
        }
        Ok((_, Drawn::Shades(rows))) => {
            key_to_colours = SIGNS;
            for (y, letters) in (panels.y..panels.bottom()).zip(rows) {
                frame.render_widget(Line::raw(letters.as_str()), row(y));
            }
        }
    }
    let below = panels.bottom();
    let under = |y| Rect {
        width: panels.width,
        ..row(y)
    };
    frame.render_widget(
        Line::styled(names(panels.width as usize, false), palette.quiet()),
        under(below),
    );
    frame.render_widget(
        Line::styled(key_to_colours, palette.quiet()).right_aligned(),
        under(below + 1),
    );
    frame.render_widget(values(play, palette), row(below + 3));
    for (index, (name, value)) in lines(play).into_iter().enumerate() {
        let line = Line::from(vec![
            Span::styled(format!("{name:<31}"), palette.quiet()),
            Span::styled(value, palette.title()),
        ]);
        frame.render_widget(line, row(below + 4 + index as u16));
    }
    let keys = [
        key("↑↓", "choose"),
        key("←→", "change"),
        key("Shift, PgUp/PgDn", "more"),
        key("r", "as the lesson"),
        key("Esc", "back"),
    ];
    let foot = Rect {
        y: whole.bottom().saturating_sub(1),
        height: 1,
        ..whole
    };
    footer(frame, foot, &keys, "", palette);
}

/// Everything that can be turned with its value, the chosen one marked.
fn values(play: &Play, palette: Palette) -> Line<'static> {
    let mut line = Line::default();
    for (quantity, value, chosen) in play.dials.rows() {
        let written = match (quantity, &play.shown) {
            (Quantity::Exposure, Ok((frame, _))) => {
                let factor = format!("×{}", text::short(frame.exposure));
                match value {
                    0.0 => factor,
                    stops => format!("{stops:+} = {factor}"),
                }
            }
            _ => quantity.written(value),
        };
        let (mark, style) = match chosen {
            true => ("▸", palette.selected()),
            false => (" ", palette.title()),
        };
        line.push_span(Span::styled(mark, palette.here()));
        line.push_span(Span::raw(format!("{} ", quantity.name())));
        line.push_span(Span::styled(written, style));
        line.push_span(Span::raw("  "));
    }
    line
}

/// The figures that say whether the bug shows.
fn lines(play: &Play) -> Vec<(&'static str, String)> {
    match &play.shown {
        Ok((frame, _)) => figures(&frame.visibility),
        Err(_) => Vec::new(),
    }
}
