//! A picture under the arrow keys, over the whole terminal.
//!
//! A frame is drawn between two looks at the keyboard: it costs a few milliseconds, and all keys
//! that wait are one step, so that a held key drops frames and never runs ahead of the screen.
//! Without a key nothing is drawn.

use std::io::{self, stdout};
use std::time::Duration;

use crossterm::event::{Event, KeyCode, KeyEvent, KeyEventKind, KeyModifiers};
use crossterm::execute;
use crossterm::terminal::{Clear, ClearType};
use ratatui::layout::{Rect, Size};
use ratatui_image::picker::{Picker, ProtocolType};
use renders::{Fingerprint, Frame, Preview};

use super::dials::Dials;
use super::draw::play::{Areas, draw};
use super::draw::style::Palette;
use super::draw::{has_room, too_small};
use super::guard::{self, Guard, Screen};
use super::keyboard::Keyboard;
use super::pictures::{Drawn, paint_again};
use super::probe;
use crate::exit::{Done, Failure, plain_reason};

/// How long the loop sleeps while no key comes; only a signal waits for it.
const IDLE: Duration = Duration::from_millis(500);

/// Pixels of a panel's side, at most: what a frame may cost while a key is held.
const MOST: u32 = 256;

/// How the learner left.
#[must_use]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Left {
    /// Back to where the picture was.
    Back,
    /// Out of the program.
    QuitAll,
}

/// What a key means here.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Key {
    Choose { next: bool },
    Turn { up: bool, big: bool },
    Reset,
    Repaint,
    Back,
    QuitAll,
}

fn key(pressed: KeyEvent) -> Option<Key> {
    let control = pressed.modifiers.contains(KeyModifiers::CONTROL);
    let big = pressed.modifiers.contains(KeyModifiers::SHIFT);
    Some(match pressed.code {
        KeyCode::Char('c') if control => Key::QuitAll,
        KeyCode::Char('l') if control => Key::Repaint,
        _ if control => return None,
        KeyCode::Up | KeyCode::Char('k') | KeyCode::BackTab => Key::Choose { next: false },
        KeyCode::Down | KeyCode::Char('j') | KeyCode::Tab => Key::Choose { next: true },
        KeyCode::Left => Key::Turn { up: false, big },
        KeyCode::Right => Key::Turn { up: true, big },
        KeyCode::Char(letter @ ('h' | 'l')) => Key::Turn {
            up: letter == 'l',
            big: false,
        },
        KeyCode::Char(letter @ ('H' | 'L')) => Key::Turn {
            up: letter == 'L',
            big: true,
        },
        KeyCode::PageUp => Key::Turn {
            up: true,
            big: true,
        },
        KeyCode::PageDown => Key::Turn {
            up: false,
            big: true,
        },
        KeyCode::Char('r') => Key::Reset,
        KeyCode::Esc | KeyCode::Char('q' | 'i') => Key::Back,
        _ => return None,
    })
}

/// What is on the screen.
pub struct Play {
    pub title: String,
    pub dials: Dials,
    preview: Preview,
    /// The panels as they were drawn last, with their figures (the pixels are in the second); or
    /// why there are none.
    pub shown: Result<(Frame, Drawn), String>,
    /// What they were drawn for.
    drawn_for: Option<(Dials, Rect)>,
    frames: u32,
}

impl Play {
    /// Of a lesson's picture.
    ///
    /// # Errors
    /// In one sentence, where a formula does not fit the scene.
    pub fn new(fingerprint: &Fingerprint<'_>) -> Result<Self, String> {
        let preview = Preview::new(fingerprint).map_err(|error| error.to_string())?;
        let dials = Dials::new(fingerprint.scene.clone(), |name| preview.needs(name));
        Ok(Self {
            title: fingerprint.title.clone(),
            dials,
            preview,
            shown: Err("nothing is drawn yet".to_owned()),
            drawn_for: None,
            frames: 0,
        })
    }

    /// Draws the panels for a screen of that size, unless they are those already.
    fn fit(&mut self, whole: Rect, picker: &Picker, palette: Palette) {
        let area = Areas::new(whole, room_for(picker)).panels;
        if self.drawn_for.as_ref() == Some(&(self.dials.clone(), area)) {
            return;
        }
        self.shown = self.paint(area, picker, palette);
        self.drawn_for = Some((self.dials.clone(), area));
    }

    fn paint(
        &mut self,
        area: Rect,
        picker: &Picker,
        palette: Palette,
    ) -> Result<(Frame, Drawn), String> {
        let font = picker.font_size();
        let size = match picker.protocol_type() {
            // Half-blocks have two pixels a cell; twice that, to be averaged.
            ProtocolType::Halfblocks => u32::from(area.width) * 2 / 3,
            // Three panels and two gaps, each of which is a 32nd of one: it need not be scaled.
            _ => {
                let width = u32::from(area.width) * u32::from(font.width);
                (width * 16 / 49).min(u32::from(area.height) * u32::from(font.height))
            }
        };
        let size = size.clamp(64, MOST);
        let mut frame = self
            .preview
            .draw(&self.dials.scene(), size, self.dials.stops())
            .map_err(|error| error.to_string())?;
        self.frames = self.frames.wrapping_add(1);
        let drawn = paint_again(
            picker,
            palette.has_colours(),
            (frame.width, frame.height, std::mem::take(&mut frame.rgba)),
            Size::new(area.width, area.height),
            self.frames,
        )?;
        Ok((frame, drawn))
    }

    /// What a key does; `None` where the learner stays.
    fn press(&mut self, key: Key) -> Option<Left> {
        match key {
            Key::Choose { next } => self.dials.choose(next),
            Key::Turn { up, big } => self.dials.turn(up, big),
            Key::Reset => self.dials.reset(),
            Key::Repaint => {}
            Key::Back => return Some(Left::Back),
            Key::QuitAll => return Some(Left::QuitAll),
        }
        None
    }

    /// Runs until the learner leaves.
    pub fn run(
        &mut self,
        terminal: &mut Screen,
        keyboard: &mut Keyboard,
        picker: &Picker,
        palette: Palette,
    ) -> io::Result<Left> {
        clear(terminal)?;
        loop {
            let whole: Rect = Rect::from((ratatui::layout::Position::ORIGIN, terminal.size()?));
            let room = has_room(whole);
            if room {
                self.fit(whole, picker, palette);
            }
            terminal.draw(|frame| match room {
                true => draw(frame, self, room_for(picker), palette),
                false => too_small(frame),
            })?;
            if let Some(left) = self.keys(terminal, keyboard)? {
                return Ok(left);
            }
        }
    }

    /// Waits for keys, and takes all that came.
    fn keys(&mut self, terminal: &mut Screen, keyboard: &mut Keyboard) -> io::Result<Option<Left>> {
        let mut changed = false;
        while !changed {
            if guard::signalled().is_some() {
                return Ok(Some(Left::QuitAll));
            }
            let mut wait = IDLE;
            while keyboard.poll(wait)? {
                wait = Duration::ZERO;
                let pressed = match keyboard.read()? {
                    Event::Key(pressed) if pressed.kind != KeyEventKind::Release => pressed,
                    Event::Resize(..) => {
                        changed = true;
                        continue;
                    }
                    _ => continue,
                };
                let Some(key) = key(pressed) else { continue };
                if key == Key::Repaint {
                    clear(terminal)?;
                }
                changed = true;
                if let Some(left) = self.press(key) {
                    return Ok(Some(left));
                }
            }
        }
        Ok(None)
    }
}

/// Columns that all panels may take: beyond what is drawn there is nothing to be seen.
fn room_for(picker: &Picker) -> u16 {
    match picker.protocol_type() {
        ProtocolType::Halfblocks => u16::MAX,
        _ => (MOST * 49 / 16 / u32::from(picker.font_size().width.max(1))) as u16,
    }
}

fn clear(terminal: &mut Screen) -> io::Result<()> {
    execute!(stdout(), Clear(ClearType::All))?;
    // Twice: what stood on the screen is forgotten, and so is what was about to.
    terminal.swap_buffers();
    Ok(())
}

/// One picture alone, without a lesson around it.
pub fn alone(mut play: Play) -> Result<Done, Failure> {
    let broken = |error: io::Error| {
        Failure::unusable(format!("the terminal gave up: {}", plain_reason(&error)))
    };
    let (_guard, mut terminal) = Guard::take().map_err(broken)?;
    let (picker, typed) = probe::picker();
    let mut keyboard = Keyboard::default();
    keyboard.put_back(&typed);
    let left = play.run(&mut terminal, &mut keyboard, &picker, Palette::from_env());
    left.map(|_| Done::Fine).map_err(broken)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(code: KeyCode, modifiers: KeyModifiers, expected: Option<Key>) {
        assert_eq!(key(KeyEvent::new(code, modifiers)), expected, "{code:?}");
    }

    #[test]
    fn keys_are_read() {
        let (none, shift) = (KeyModifiers::NONE, KeyModifiers::SHIFT);
        let turn = |up, big| Some(Key::Turn { up, big });
        check(KeyCode::Right, none, turn(true, false));
        check(KeyCode::Left, shift, turn(false, true));
        check(KeyCode::PageUp, none, turn(true, true));
        check(KeyCode::PageDown, none, turn(false, true));
        check(KeyCode::Up, none, Some(Key::Choose { next: false }));
        check(KeyCode::Char('r'), none, Some(Key::Reset));
        check(KeyCode::Esc, none, Some(Key::Back));
        check(
            KeyCode::Char('c'),
            KeyModifiers::CONTROL,
            Some(Key::QuitAll),
        );
        check(KeyCode::Char('x'), none, None);
    }
}
