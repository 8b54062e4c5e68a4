//! The place of a picture on a page: the picture, or what keeps it.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::Line;
use ratatui::widgets::Widget as _;
use ratatui_image::sliced::{SignedPosition, SlicedImage};

use tutor::map::MapFrame;

use super::style::Palette;
use crate::fingerprints::{Kind, Subject};
use crate::maps::legend;
use crate::tui::pictures::{Pictures, State, columns_in, rows_for};

/// Rows around a picture: its title, the names of its panels, what the colours say.
pub const AROUND: u16 = 3;

/// Rows for a picture of that width and what stands around it.
pub fn height(width: u16) -> u16 {
    rows_for(width) + AROUND
}

/// What the colours of the third panel say.
pub const COLOURS: &str = "blue: too dark · white, line: right · orange: too bright";

/// What the signs there say, where there are no colours.
pub const SIGNS: &str = "- too dark · = right · + too bright";

/// What stands around a picture.
pub struct Words<'a> {
    title: &'a str,
    /// Right below it.
    names: String,
    /// What its colours say, and what its letters say where it has none.
    keys: [String; 2],
}

impl<'a> Words<'a> {
    /// Of the three panels of a fingerprint or of a learner's own shader.
    pub fn of_picture(title: &'a str, subject: &Subject, width: u16) -> Self {
        let is_own = matches!(subject.kind, Kind::Own(_));
        Self {
            title,
            names: names(usize::from(columns_in(rows_for(width), width)), is_own),
            keys: [COLOURS, SIGNS].map(str::to_owned),
        }
    }

    pub fn of_map(frame: &'a MapFrame) -> Self {
        let [axes, key] = legend(frame, true);
        let [_, signs] = legend(frame, false);
        Self {
            title: &frame.title,
            names: axes,
            keys: [key, signs],
        }
    }
}

/// Draws a picture `height` rows high that begins `offset` rows below the top of `window`
/// (above it, where negative).
#[allow(clippy::too_many_arguments)]
pub fn draw(
    pictures: &Pictures,
    subject: &Subject,
    words: &Words<'_>,
    height: u16,
    offset: i32,
    palette: Palette,
    window: Rect,
    buffer: &mut Buffer,
) {
    let mut line = |row: i32, line: Line| {
        if (0..i32::from(window.height)).contains(&row) {
            line.render(
                Rect {
                    y: window.y + row as u16,
                    height: 1,
                    ..window
                },
                buffer,
            );
        }
    };
    line(
        offset,
        Line::styled(words.title.to_owned(), palette.title()),
    );
    line(
        offset + i32::from(height) - 2,
        Line::styled(words.names.clone(), palette.quiet()),
    );
    let state = pictures.state(subject);
    let key = match state {
        Some(State::Shades(_)) => &words.keys[1],
        _ => &words.keys[0],
    };
    line(
        offset + i32::from(height) - 1,
        match subject.kind {
            Kind::Map => Line::styled(key.clone(), palette.quiet()),
            Kind::Fingerprint | Kind::Own(_) => {
                Line::styled(key.clone(), palette.quiet()).right_aligned()
            }
        },
    );
    let middle = offset + i32::from(height / 2);
    match state {
        Some(State::Shades(rows)) => {
            for (row, shades) in (offset + 1..).zip(rows) {
                line(row, Line::raw(shades.as_str()));
            }
        }
        Some(State::Ready(image)) => {
            // Far outside of the window it does not matter how far.
            let top = (offset + 1).clamp(i32::from(i16::MIN) / 2, i32::from(i16::MAX) / 2) as i16;
            SlicedImage::new(image, SignedPosition::from((0, top))).render(window, buffer);
        }
        Some(State::Drawing { spinner }) => {
            const FRAMES: [char; 8] = ['⠋', '⠙', '⠸', '⠴', '⠦', '⠇', '⠏', '⠋'];
            let frame = FRAMES[spinner % FRAMES.len()];
            line(
                middle,
                Line::styled(format!("  {frame} drawing the picture …"), palette.quiet()),
            );
        }
        Some(State::Failed(reason)) => {
            line(
                middle,
                Line::styled(format!("  ! no picture: {reason}"), palette.quiet()),
            );
        }
        None => {}
    }
}

/// The names of the three panels, each below its own.
pub fn names(width: usize, is_own: bool) -> String {
    let third = width / 3;
    let second = if is_own { "yours" } else { "buggy" };
    ["correct", second, "log2 of the ratio"]
        .map(|name| format!("{name:^third$}"))
        .concat()
}
