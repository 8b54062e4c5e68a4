//! The field at the foot of a screen.

use ratatui::Frame;
use ratatui::layout::{Position, Rect};
use ratatui::style::{Color, Style};
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, BorderType};
use tutor::view::Input;

use unicode_width::UnicodeWidthStr as _;

use super::chrome::cut;
use super::style::Palette;
use crate::text;
use crate::tui::ball::Ball;
use crate::tui::field::Field;
use crate::tui::keys::Focus;
use crate::tui::lesson::LessonScreen;

/// Fields are as wide as prose is.
const WIDEST: u16 = 96;

/// Rows for page and field together that are too few for both to be seen whole.
pub const LOW: u16 = 16;

/// Rows that the field wants of `room`.
pub fn height(screen: &LessonScreen, width: u16, room: u16) -> u16 {
    let inner = width.min(WIDEST).saturating_sub(6) as usize;
    let low = room < LOW;
    // Who has left the field wants to read.
    let reads = screen.focus == Focus::Page;
    let rows = match (&screen.view().input, &screen.field) {
        (Input::None, _) | (_, Field::None) => return 0,
        (Input::Number { .. }, _) => 1,
        (Input::Reply { .. }, _) => match (low, reads) {
            (false, _) => 3,
            (true, false) => 2,
            (true, true) => 1,
        },
        // Large enough to see what one writes, small enough to see what one answers.
        (Input::Text { .. }, _) => match (low, reads) {
            (false, _) => (room / 3).clamp(4, 14),
            (true, false) => 3,
            (true, true) => 1,
        },
        // The function as a whole, where the page leaves room for it.
        (Input::Code { .. }, field) => {
            let lines = field
                .text()
                .map_or(1, |text| text.split('\n').count() as u16);
            let most = match reads {
                true if low => 1,
                true if room < 40 => 3,
                _ => (room * 2 / 3).max(4),
            };
            lines.clamp(most.min(3), most)
        }
        (Input::Place { .. }, _) if low && reads => 3,
        (Input::Place { .. }, _) => Ball::rows(room),
        (Input::Choice { options }, _) => wrapped_rows(options.iter().map(String::as_str), inner),
        (Input::Order { items }, _) => wrapped_rows(items.iter().map(String::as_str), inner),
        (Input::Checklist { points }, _) => {
            wrapped_rows(points.iter().map(|point| point.text.as_str()), inner)
        }
    };
    let most = match &screen.field {
        // What is asked stays in view above what it is chosen from.
        Field::Choice { .. } | Field::Order(_) | Field::Checklist { .. } if low => match reads {
            true => 3,
            false => room.saturating_sub(4),
        },
        _ => room.saturating_sub(2),
    };
    (rows + 2).min(most)
}

fn wrapped_rows<'a>(items: impl Iterator<Item = &'a str>, width: usize) -> u16 {
    items
        .map(|item| text::wrap_plain(item, width, "", "").len() as u16)
        .sum()
}

pub fn draw(frame: &mut Frame, area: Rect, screen: &LessonScreen, palette: Palette) {
    if area.height < 3 {
        return;
    }
    let area = Rect {
        width: area.width.min(WIDEST),
        ..area
    };
    let focused = matches!(
        screen.focus,
        Focus::Line | Focus::Editor | Focus::Options | Focus::Place
    );
    let view = screen.view();
    let (label, note) = match &view.input {
        Input::None => return,
        Input::Number { label, note, .. } | Input::Reply { label, note, .. } => {
            (label.clone(), note.clone())
        }
        Input::Text { label, .. } => (label.clone(), String::new()),
        Input::Code { label, note, .. } => (format!("fn {label}"), note.replace('`', "")),
        Input::Place { .. } => (
            "The buggy ball: where would you look?".to_owned(),
            String::new(),
        ),
        Input::Choice { .. } => ("Which one?".to_owned(), String::new()),
        Input::Order { .. } => (
            "Put in order".to_owned(),
            "Space grabs, arrows move".to_owned(),
        ),
        Input::Checklist { .. } => (
            "Does your answer say this?".to_owned(),
            "y or n for each, then Enter".to_owned(),
        ),
    };
    let mut frame_block = Block::bordered()
        .border_type(if focused {
            BorderType::Thick
        } else {
            BorderType::Rounded
        })
        .border_style(palette.frame(focused))
        .title(Line::styled(
            format!(" {} ", cut(&label, area.width.saturating_sub(4).into())),
            palette.title(),
        ));
    let button = match &screen.field {
        Field::Code(_) => " [ Run: Ctrl-S ] ",
        Field::Editor(_) => " [ Hand in: Ctrl-S ] ",
        _ => "",
    };
    let note = cut(
        &note,
        (area.width as usize).saturating_sub(4 + button.width()),
    );
    if !note.is_empty() {
        frame_block = frame_block.title_bottom(Line::styled(format!(" {note} "), palette.quiet()));
    }
    if !button.is_empty() {
        let style = if screen.focus == Focus::Button {
            palette.selected()
        } else {
            palette.key()
        };
        frame_block = frame_block.title_bottom(Line::styled(button, style).right_aligned());
    }
    let inner = frame_block.inner(area);
    frame.render_widget(frame_block, area);
    match &screen.field {
        Field::None => {}
        Field::Line(field) | Field::Editor(field) | Field::Code(field) => {
            let inner = Rect {
                x: inner.x + 1,
                width: inner.width.saturating_sub(2),
                ..inner
            };
            frame.render_widget(field.as_ref(), inner);
            if focused {
                // The terminal's own cursor too, for those who follow it by ear or magnifier.
                let cursor = field.screen_cursor();
                let (top, left) = field.scroll_offset();
                let x = inner.x + (cursor.col as u16).saturating_sub(left);
                let y = inner.y + (cursor.row as u16).saturating_sub(top);
                if inner.contains(Position { x, y }) {
                    frame.set_cursor_position((x, y));
                }
            }
        }
        Field::Place(ball) => draw_ball(frame, inner, ball, screen, palette),
        Field::Choice { at } => {
            if let Input::Choice { options } = &view.input {
                let rows = options.iter().enumerate().map(|(index, option)| {
                    (format!("{}. ", index + 1), option.clone(), index == *at)
                });
                list(frame, inner, rows.collect(), focused, palette);
            }
        }
        Field::Order(order) => {
            if let Input::Order { items } = &view.input {
                let rows = order.places.iter().enumerate().map(|(index, place)| {
                    let here = index == order.at;
                    let sign = if here && order.grabbed {
                        "↕  "
                    } else {
                        "·  "
                    };
                    (
                        sign.to_owned(),
                        items.get(*place).cloned().unwrap_or_default(),
                        here,
                    )
                });
                list(frame, inner, rows.collect(), focused, palette);
            }
        }
        Field::Checklist { at } => {
            if let Input::Checklist { points } = &view.input {
                let rows = points.iter().enumerate().map(|(index, point)| {
                    (
                        format!("{} ", text::tick(point.said)),
                        point.text.clone(),
                        index == *at,
                    )
                });
                list(frame, inner, rows.collect(), focused, palette);
            }
        }
    }
}

/// The cells within the frame of a field.
pub fn inside(area: Rect) -> Rect {
    Rect {
        x: area.x + 1,
        y: area.y + 1,
        width: area.width.min(WIDEST).saturating_sub(2),
        height: area.height.saturating_sub(2),
    }
}

/// The ball with its cursor, and what is known of the place under it.
fn draw_ball(frame: &mut Frame, area: Rect, ball: &Ball, screen: &LessonScreen, palette: Palette) {
    const SHADES: [char; 5] = [' ', '░', '▒', '▓', '█'];
    let (columns, rows) = ball.cells();
    let colour = |[red, green, blue]: [u8; 3]| Color::Rgb(red, green, blue);
    let brightness = |[red, green, blue]: [u8; 3]| {
        (3 * u32::from(red) + 6 * u32::from(green) + u32::from(blue)) / 10
    };
    for row in 0..rows.min(area.height) {
        for column in 0..columns.min(area.width) {
            let pair = ball.cell(column, row);
            let (sign, style) = match (ball.at == (column, row), palette.has_colours()) {
                (true, true) => {
                    let light = brightness(pair[0]) + brightness(pair[1]) > 255;
                    let (ink, paper) = match light {
                        true => (Color::Black, Color::White),
                        false => (Color::Black, Color::Yellow),
                    };
                    ('+', Style::new().fg(ink).bg(paper).bold())
                }
                (true, false) => ('+', palette.selected()),
                (false, true) => ('▀', Style::new().fg(colour(pair[0])).bg(colour(pair[1]))),
                (false, false) => {
                    let mean = (brightness(pair[0]) + brightness(pair[1])) / 2;
                    (SHADES[(mean / 52).min(4) as usize], Style::new())
                }
            };
            let at = (area.x + column, area.y + row);
            if let Some(cell) = frame.buffer_mut().cell_mut(at) {
                cell.set_char(sign).set_style(style);
            }
        }
    }
    let beside = Rect {
        x: area.x + columns.min(area.width) + 2,
        width: area.width.saturating_sub(columns + 2),
        ..area
    };
    for (row, line) in screen.under_cursor().into_iter().enumerate() {
        if row < beside.height as usize {
            let at = Rect {
                y: beside.y + row as u16,
                height: 1,
                ..beside
            };
            frame.render_widget(Line::styled(line, palette.quiet()), at);
        }
    }
}

/// Rows of which one is chosen; the window follows it.
fn list(
    frame: &mut Frame,
    area: Rect,
    rows: Vec<(String, String, bool)>,
    focused: bool,
    palette: Palette,
) {
    let mut lines: Vec<Line> = Vec::new();
    let mut chosen = 0..0;
    for (sign, words, here) in rows {
        let start = lines.len();
        let pointer = if here { "▸ " } else { "  " };
        let rest = " ".repeat(sign.chars().count() + 2);
        let style = if here && focused {
            palette.here()
        } else {
            ratatui::style::Style::new()
        };
        for (index, line) in text::wrap_plain(
            &words,
            (area.width as usize).saturating_sub(rest.len() + 1),
            "",
            "",
        )
        .into_iter()
        .enumerate()
        {
            let before = if index == 0 {
                format!("{pointer}{sign}")
            } else {
                rest.clone()
            };
            lines.push(Line::from(vec![
                Span::styled(before, palette.key()),
                Span::styled(line, style),
            ]));
        }
        if here {
            chosen = start..lines.len();
        }
    }
    let height = area.height as usize;
    let top = chosen.end.saturating_sub(height).min(chosen.start);
    for (row, line) in lines.into_iter().skip(top).take(height).enumerate() {
        frame.render_widget(
            line,
            Rect {
                y: area.y + row as u16,
                height: 1,
                ..area
            },
        );
    }
}
