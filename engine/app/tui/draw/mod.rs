//! Drawing: every function takes the state by shared reference and changes nothing.

pub mod chrome;
pub mod help;
pub mod input;
pub mod keys;
pub mod lesson;
pub mod page;
pub mod picker;
pub mod picture;
pub mod play;
pub mod plot;
pub mod prose;
pub mod style;

use ratatui::Frame;
use ratatui::layout::Rect;
use ratatui::text::Line;
use ratatui::widgets::{Paragraph, Wrap};

/// The least terminal in which a lesson can be read.
pub const LEAST: (u16, u16) = (40, 12);

/// Whether there is room to teach in.
pub fn has_room(area: Rect) -> bool {
    area.width >= LEAST.0 && area.height >= LEAST.1
}

/// Says what to do in a terminal that is too small.
pub fn too_small(frame: &mut Frame) {
    let area = frame.area();
    let text = format!(
        "lobe needs {}×{}; this is {}×{}. Make it larger, or q.",
        LEAST.0, LEAST.1, area.width, area.height
    );
    frame.render_widget(
        Paragraph::new(Line::raw(text)).wrap(Wrap { trim: true }),
        area,
    );
}
