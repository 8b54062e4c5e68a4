//! Where keys come from: first those that came while the terminal was asked something, then the
//! terminal's own.

use std::collections::VecDeque;
use std::io;
use std::time::Duration;

use crossterm::event::{self, Event, KeyCode, KeyEvent, KeyModifiers};

/// The keys that wait.
#[derive(Default)]
pub struct Keyboard {
    kept: VecDeque<Event>,
}

impl Keyboard {
    /// Takes over what was typed while somebody else read the terminal.
    pub fn put_back(&mut self, typed: &[u8]) {
        self.kept.extend(events(typed));
    }

    /// Waits for a key, that long at most.
    pub fn poll(&self, patience: Duration) -> io::Result<bool> {
        Ok(!self.kept.is_empty() || event::poll(patience)?)
    }

    /// The next key.
    pub fn read(&mut self) -> io::Result<Event> {
        match self.kept.pop_front() {
            Some(event) => Ok(event),
            None => event::read(),
        }
    }
}

/// Bytes of a terminal in raw mode as keys. What is no key is passed over.
fn events(mut bytes: &[u8]) -> Vec<Event> {
    let mut events = Vec::new();
    while let Some((event, rest)) = first(bytes) {
        events.extend(event);
        bytes = rest;
    }
    events
}

/// Whether bytes end in the middle of a key.
pub fn is_cut_short(mut bytes: &[u8]) -> bool {
    while let Some((_, rest)) = first(bytes) {
        bytes = rest;
    }
    !bytes.is_empty()
}

/// The first key, if it is one, and what follows; `None` where it does not end here.
fn first(bytes: &[u8]) -> Option<(Option<Event>, &[u8])> {
    const PASTE: &[u8] = b"\x1b[200~";
    const PASTED: &[u8] = b"\x1b[201~";
    if let Some(rest) = bytes.strip_prefix(PASTE) {
        let end = rest.windows(PASTED.len()).position(|it| it == PASTED)?;
        let text = String::from_utf8_lossy(&rest[..end]).into_owned();
        return Some((Some(Event::Paste(text)), &rest[end + PASTED.len()..]));
    }
    match bytes {
        [] => None,
        [0x1b, b'[', rest @ ..] => {
            let end = rest.iter().position(|byte| matches!(byte, 0x40..=0x7e))?;
            let key = sequence(&rest[..end], rest[end]);
            Some((key.map(Event::Key), &rest[end + 1..]))
        }
        [0x1b, b'O', letter, rest @ ..] => Some((sequence(b"", *letter).map(Event::Key), rest)),
        [0x1b, b'O'] => None,
        [0x1b] => Some((Some(key(KeyCode::Esc, KeyModifiers::NONE)), &[])),
        // Escape twice is Escape, and whatever follows.
        [0x1b, 0x1b, ..] => Some((Some(key(KeyCode::Esc, KeyModifiers::NONE)), &bytes[1..])),
        [0x1b, rest @ ..] => {
            let (letter, rest) = first(rest)?;
            let with_alt = |event| match event {
                Event::Key(mut key) => {
                    key.modifiers |= KeyModifiers::ALT;
                    Event::Key(key)
                }
                other => other,
            };
            Some((letter.map(with_alt), rest))
        }
        [byte @ 0..0x80, rest @ ..] => Some((Some(ascii(*byte)), rest)),
        _ => {
            let length = match bytes[0] {
                0xc0..0xe0 => 2,
                0xe0..0xf0 => 3,
                0xf0..0xf8 => 4,
                _ => 1,
            };
            let letter = bytes.get(..length)?;
            let letter = std::str::from_utf8(letter)
                .ok()
                .and_then(|it| it.chars().next());
            match letter {
                Some(letter) => Some((Some(of_char(letter)), &bytes[length..])),
                None => Some((None, &bytes[1..])),
            }
        }
    }
}

fn key(code: KeyCode, modifiers: KeyModifiers) -> Event {
    Event::Key(KeyEvent::new(code, modifiers))
}

fn of_char(letter: char) -> Event {
    let modifiers = match letter.is_uppercase() {
        true => KeyModifiers::SHIFT,
        false => KeyModifiers::NONE,
    };
    key(KeyCode::Char(letter), modifiers)
}

fn ascii(byte: u8) -> Event {
    let control = |letter: u8| key(KeyCode::Char(letter.into()), KeyModifiers::CONTROL);
    match byte {
        0 => control(b' '),
        b'\r' => key(KeyCode::Enter, KeyModifiers::NONE),
        b'\t' => key(KeyCode::Tab, KeyModifiers::NONE),
        0x7f => key(KeyCode::Backspace, KeyModifiers::NONE),
        0x01..=0x1a => control(byte - 1 + b'a'),
        0x1b => key(KeyCode::Esc, KeyModifiers::NONE),
        0x1c..0x20 => control(byte - 0x1c + b'4'),
        letter => of_char(letter.into()),
    }
}

/// A key that has a name, by its numbers and last letter: `\x1b[1;2A` is Shift and up.
fn sequence(numbers: &[u8], last: u8) -> Option<KeyEvent> {
    let text = std::str::from_utf8(numbers).ok()?;
    let numbers: Vec<u8> = match text {
        "" => Vec::new(),
        text => text
            .split(';')
            .map(|it| it.parse().ok())
            .collect::<Option<_>>()?,
    };
    let code = match (last, numbers.first()) {
        (b'A', _) => KeyCode::Up,
        (b'B', _) => KeyCode::Down,
        (b'C', _) => KeyCode::Right,
        (b'D', _) => KeyCode::Left,
        (b'H', _) | (b'~', Some(1 | 7)) => KeyCode::Home,
        (b'F', _) | (b'~', Some(4 | 8)) => KeyCode::End,
        (b'Z', _) => KeyCode::BackTab,
        (b'P', _) | (b'~', Some(11)) => KeyCode::F(1),
        (b'~', Some(2)) => KeyCode::Insert,
        (b'~', Some(3)) => KeyCode::Delete,
        (b'~', Some(5)) => KeyCode::PageUp,
        (b'~', Some(6)) => KeyCode::PageDown,
        _ => return None,
    };
    // xterm: one more than the sum of Shift 1, Alt 2, Control 4.
    let held = numbers.get(1).map_or(0, |number| number.saturating_sub(1));
    let mut modifiers = KeyModifiers::NONE;
    modifiers.set(KeyModifiers::SHIFT, held & 1 != 0);
    modifiers.set(KeyModifiers::ALT, held & 2 != 0);
    modifiers.set(KeyModifiers::CONTROL, held & 4 != 0);
    Some(KeyEvent::new(code, modifiers))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(typed: &str, keys: &[(KeyCode, KeyModifiers)]) {
        let expected: Vec<Event> = keys.iter().map(|(code, held)| key(*code, *held)).collect();
        assert_eq!(events(typed.as_bytes()), expected, "{typed:?}");
        assert!(!is_cut_short(typed.as_bytes()), "{typed:?}");
    }

    #[test]
    fn bytes_are_the_keys_that_made_them() {
        use KeyCode::{Backspace, Char, Enter, Esc, F, Home, PageDown, Tab, Up};
        const NONE: KeyModifiers = KeyModifiers::NONE;
        const SHIFT: KeyModifiers = KeyModifiers::SHIFT;
        const CONTROL: KeyModifiers = KeyModifiers::CONTROL;
        check("", &[]);
        check(
            "0.5\r",
            &[
                (Char('0'), NONE),
                (Char('.'), NONE),
                (Char('5'), NONE),
                (Enter, NONE),
            ],
        );
        check("αÄ", &[(Char('α'), NONE), (Char('Ä'), SHIFT)]);
        check(
            "\u{3}\t\u{7f}",
            &[(Char('c'), CONTROL), (Tab, NONE), (Backspace, NONE)],
        );
        check("\x1b", &[(Esc, NONE)]);
        check("\x1bs", &[(Char('s'), KeyModifiers::ALT)]);
        check(
            "\x1b[A\x1bOA\x1b[1;2A",
            &[(Up, NONE), (Up, NONE), (Up, SHIFT)],
        );
        check(
            "\x1b[6~\x1bOP\x1b[H",
            &[(PageDown, NONE), (F(1), NONE), (Home, NONE)],
        );
        check("a\x1b[<0;3;4Mb", &[(Char('a'), NONE), (Char('b'), NONE)]);
    }

    #[test]
    fn a_paste_is_one() {
        let pasted = events(b"\x1b[200~two\rlines\x1b[201~");
        assert_eq!(pasted, [Event::Paste("two\rlines".to_owned())]);
    }

    #[test]
    fn what_does_not_end_is_waited_for() {
        for typed in [&b"a\x1b[1;2"[..], b"\xc3", b"\x1b[200~half", b"\x1bO"] {
            assert!(is_cut_short(typed), "{typed:?}");
        }
    }
}
