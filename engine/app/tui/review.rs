//! Marking answers on the screen: one key an answer, saved at once.

use std::time::Duration;

use crossterm::event::{self, Event, KeyCode, KeyEventKind, KeyModifiers};
use ratatui::Frame;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};
use tutor::judge::Verdict;
use tutor::review::{Effect, Key, Review};

use super::draw::chrome::{at_right, footer, key, rule};
use super::draw::style::Palette;
use super::draw::{has_room, too_small};
use super::guard::{self, Guard};
use crate::exit::{Failure, plain_reason};
use crate::sheet;
use crate::text::{self, Role};

/// How long the loop sleeps while no key comes; only a signal waits for it.
const IDLE: Duration = Duration::from_millis(500);

/// Runs until the last answer is marked or the teacher leaves. `carry_out` keeps a mark before
/// the next answer is shown.
pub fn run(
    review: &mut Review,
    carry_out: &mut dyn FnMut(Effect) -> Result<(), Failure>,
) -> Result<(), Failure> {
    let broken = |error: std::io::Error| {
        Failure::unusable(format!("the terminal gave up: {}", plain_reason(&error)))
    };
    let palette = Palette::from_env();
    let (_guard, mut terminal) = Guard::take().map_err(broken)?;
    let mut top = 0;
    while review.current().is_some() && guard::signalled().is_none() {
        terminal
            .draw(|frame| top = draw(frame, review, top, palette))
            .map_err(broken)?;
        if !event::poll(IDLE).map_err(broken)? {
            continue;
        }
        let Event::Key(pressed) = event::read().map_err(broken)? else {
            continue;
        };
        if pressed.kind == KeyEventKind::Release {
            continue;
        }
        let control = pressed.modifiers.contains(KeyModifiers::CONTROL);
        let key = match pressed.code {
            KeyCode::Char('c') if control => return Ok(()),
            _ if control => continue,
            KeyCode::Char('q') | KeyCode::Esc => return Ok(()),
            KeyCode::Char('p') => Key::Verdict(Verdict::Pass),
            KeyCode::Char('a') => Key::Verdict(Verdict::Partial),
            KeyCode::Char('f') => Key::Verdict(Verdict::Fail),
            KeyCode::Char(digit @ '1'..='9') => Key::Turn(digit as usize - '1' as usize),
            KeyCode::Enter => Key::Accept,
            KeyCode::Char('l') | KeyCode::Right => Key::Later,
            KeyCode::Char('b') | KeyCode::Left | KeyCode::Backspace => Key::Back,
            KeyCode::Down | KeyCode::Char('j') => {
                top += 1;
                continue;
            }
            KeyCode::Up | KeyCode::Char('k') => {
                top = top.saturating_sub(1);
                continue;
            }
            KeyCode::PageDown | KeyCode::Char(' ') => {
                top += 10;
                continue;
            }
            KeyCode::PageUp => {
                top = top.saturating_sub(10);
                continue;
            }
            _ => continue,
        };
        let before = review.place();
        if let Some(effect) = review.press(key) {
            carry_out(effect)?;
        }
        if review.place() != before {
            top = 0;
        }
    }
    Ok(())
}

/// Draws the sheet from line `top` on, or from the last that makes sense, which it gives back.
fn draw(frame: &mut Frame, review: &Review, top: usize, palette: Palette) -> usize {
    let whole = frame.area();
    if !has_room(whole) {
        too_small(frame);
        return top;
    }
    let row = |y: u16| Rect {
        y,
        height: 1,
        ..whole
    };
    let (at, of) = review.place();
    let title = Line::from(vec![
        Span::styled(" lobe review", palette.heading()),
        Span::styled(
            format!("  {} of {of}, {} marked", at + 1, review.marked()),
            palette.quiet(),
        ),
    ]);
    frame.render_widget(title, row(whole.y));
    let follows = review.follows();
    let tone = sheet::tone_of(follows);
    let verdict = format!("{} {} ", text::symbol(tone), follows.as_str());
    at_right(
        frame,
        row(whole.y),
        Line::styled(verdict, palette.tone(tone)),
    );
    rule(frame, row(whole.y + 1), palette);

    let said = review
        .said()
        .map(|said| text::wrap_plain(said, whole.width.saturating_sub(2) as usize, " ! ", "   "));
    let said = said.unwrap_or_default();
    let body = Rect {
        x: whole.x + 1,
        y: whole.y + 2,
        width: whole.width.saturating_sub(2).min(100),
        height: whole.height.saturating_sub(4 + said.len() as u16),
    };
    let lines = sheet::lines(review, body.width as usize);
    let top = top.min(lines.len().saturating_sub(body.height as usize));
    let more = lines.len() > top + body.height as usize;
    for (y, line) in lines
        .into_iter()
        .skip(top)
        .take(body.height as usize)
        .enumerate()
    {
        let spans: Vec<Span> = line
            .into_iter()
            .map(|piece| {
                let style = match piece.role {
                    Role::Emph => palette.quiet(),
                    role => palette.role(role),
                };
                Span::styled(piece.text, style)
            })
            .collect();
        let area = Rect {
            y: body.y + y as u16,
            height: 1,
            ..body
        };
        frame.render_widget(Line::from(spans), area);
    }
    for (index, line) in said.iter().enumerate() {
        let y = body.bottom() + index as u16;
        frame.render_widget(Line::styled(line.clone(), palette.key()), row(y));
    }
    rule(frame, row(whole.bottom() - 2), palette);
    let keys = [
        key("p", "pass"),
        key("a", "partial"),
        key("f", "fail"),
        key("1-9", "turn a point"),
        key("Enter", follows.as_str()),
        key("l", "later"),
        key("b", "back"),
        key("q", "quit"),
    ];
    let right = if more { "↓ more " } else { "" };
    footer(frame, row(whole.bottom() - 1), &keys, right, palette);
    top
}
