//! Which kind of picture the terminal can show. Asked only when a picture is wanted, with a
//! time limit, by the thread that also reads keys: no reader is left behind to eat them. What is
//! typed meanwhile comes back with the answer.

use std::env;

use ratatui_image::FontSize;
use ratatui_image::picker::{Picker, ProtocolType};

use super::keyboard::is_cut_short;

/// What the terminal answered.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Answer {
    kitty: bool,
    sixel: bool,
    cell: Option<(u16, u16)>,
}

/// Asks the terminal. Half-blocks where it says nothing; `LOBE_PICTURES` (`kitty`, `iterm2`,
/// `sixel`, `halfblocks`) overrides what it says. Also what was typed before it answered.
pub fn picker() -> (Picker, Vec<u8>) {
    let forced = env::var("LOBE_PICTURES")
        .ok()
        .and_then(|name| protocol(&name));
    if forced == Some(ProtocolType::Halfblocks) {
        // They need nothing to be known.
        return (Picker::halfblocks(), Vec::new());
    }
    let came = asked();
    let typed = typed(&came);
    (of_answer(parse(&came), forced), typed)
}

fn of_answer(answer: Answer, forced: Option<ProtocolType>) -> Picker {
    let cell = answer.cell.or_else(cell_from_window);
    let Some((width, height)) = cell else {
        // Without the size of a cell in pixels only half-blocks come out right.
        return Picker::halfblocks();
    };
    // Deprecated in favour of the query that leaves a reader behind.
    #[allow(deprecated)]
    let mut picker = Picker::from_fontsize(FontSize::new(width, height));
    // Inside a multiplexer the names in the environment are those of the terminal outside.
    let named = if inside_multiplexer() {
        ProtocolType::Halfblocks
    } else {
        picker.protocol_type()
    };
    picker.set_protocol_type(forced.unwrap_or_else(|| best(answer, named)));
    picker
}

/// The name that `lobe doctor` prints.
pub fn name(protocol: ProtocolType) -> &'static str {
    match protocol {
        ProtocolType::Halfblocks => "half-blocks",
        ProtocolType::Sixel => "sixel",
        ProtocolType::Kitty => "kitty",
        ProtocolType::Iterm2 => "iTerm2",
    }
}

fn best(answer: Answer, named: ProtocolType) -> ProtocolType {
    // These two say yes to what they draw wrongly; iTerm2's protocol they draw well.
    let has = |name: &str| env::var_os(name).is_some_and(|value| !value.is_empty());
    if has("WEZTERM_EXECUTABLE") || has("KONSOLE_VERSION") {
        return ProtocolType::Iterm2;
    }
    match answer {
        Answer { kitty: true, .. } => ProtocolType::Kitty,
        _ if named == ProtocolType::Iterm2 => named,
        Answer { sixel: true, .. } => ProtocolType::Sixel,
        _ => ProtocolType::Halfblocks,
    }
}

fn protocol(name: &str) -> Option<ProtocolType> {
    match name {
        "kitty" => Some(ProtocolType::Kitty),
        "iterm2" => Some(ProtocolType::Iterm2),
        "sixel" => Some(ProtocolType::Sixel),
        "halfblocks" => Some(ProtocolType::Halfblocks),
        _ => None,
    }
}

fn inside_multiplexer() -> bool {
    ["TMUX", "STY", "ZELLIJ"]
        .iter()
        .any(|name| env::var_os(name).is_some())
}

fn cell_from_window() -> Option<(u16, u16)> {
    let window = crossterm::terminal::window_size().ok()?;
    let width = window.width.checked_div(window.columns)?;
    let height = window.height.checked_div(window.rows)?;
    (width > 0 && height > 0).then_some((width, height))
}

/// Reads the answers to the three questions of [`asked`].
fn parse(answer: &[u8]) -> Answer {
    let text = String::from_utf8_lossy(answer);
    let mut found = Answer {
        kitty: text.contains("_Gi=31;OK"),
        ..Answer::default()
    };
    for sequence in text.split("\u{1b}[").skip(1) {
        if let Some(attributes) = sequence
            .strip_prefix('?')
            .and_then(|rest| rest.split_once('c'))
        {
            found.sixel = attributes
                .0
                .split(';')
                .skip(1)
                .any(|attribute| attribute == "4");
        } else if let Some((size, _)) = sequence.split_once('t') {
            let numbers: Vec<u16> = size
                .split(';')
                .filter_map(|number| number.parse().ok())
                .collect();
            if let [6, height, width] = numbers[..] {
                found.cell = (height > 0 && width > 0).then_some((width, height));
            }
        }
    }
    found
}

/// Asks for kitty's graphics, the size of a cell, and last what every terminal answers.
#[cfg(unix)]
fn asked() -> Vec<u8> {
    use std::io::Write as _;
    use std::time::{Duration, Instant};

    use rustix::event::{PollFd, PollFlags, Timespec, poll};

    const QUESTIONS: &[u8] = b"\x1b_Gi=31,s=1,v=1,a=q,t=d,f=24;AAAA\x1b\\\x1b[16t\x1b[c";
    const LIMIT: Duration = Duration::from_millis(250);
    /// The rest of a key that has begun is on its way.
    const REST_OF_A_KEY: Duration = Duration::from_millis(20);

    let mut answer = Vec::new();
    let mut out = std::io::stdout();
    if out.write_all(QUESTIONS).and_then(|()| out.flush()).is_err() {
        return answer;
    }
    let until = Instant::now() + LIMIT;
    let stdin = rustix::stdio::stdin();
    let mut chunk = [0u8; 256];
    loop {
        let left = match complete(&answer) {
            false => until.saturating_duration_since(Instant::now()),
            true if is_cut_short(&typed(&answer)) => REST_OF_A_KEY,
            true => break,
        };
        let Ok(timeout) = Timespec::try_from(left) else {
            break;
        };
        let mut waiting = [PollFd::new(&stdin, PollFlags::IN)];
        if !matches!(poll(&mut waiting, Some(&timeout)), Ok(1..)) {
            break;
        }
        match rustix::io::read(stdin, &mut chunk) {
            Ok(count @ 1..) => answer.extend_from_slice(&chunk[..count]),
            _ => break,
        }
    }
    answer
}

#[cfg(not(unix))]
fn asked() -> Vec<u8> {
    Vec::new()
}

/// Where each answer begins and ends: of kitty `ESC _ … ESC \`, of others `ESC [ 6 ; … t` and
/// `ESC [ ? … c`.
fn answers(came: &[u8]) -> Vec<std::ops::Range<usize>> {
    const FORMS: [(&[u8], &[u8]); 3] = [
        (b"\x1b_G", b"\x1b\\"),
        (b"\x1b[6;", b"t"),
        (b"\x1b[?", b"c"),
    ];
    let mut found = Vec::new();
    let mut at = 0;
    while at < came.len() {
        let end = FORMS.iter().find_map(|(begins, ends)| {
            let rest = came[at..].strip_prefix(*begins)?;
            let length = rest.windows(ends.len()).position(|it| it == *ends)?;
            // Shift-PageDown begins as the size of a cell does.
            let is_one = !rest[..length]
                .iter()
                .any(|byte| matches!(byte, 0x1b | b'~'));
            is_one.then_some(at + begins.len() + length + ends.len())
        });
        match end {
            Some(end) => {
                found.push(at..end);
                at = end;
            }
            None => at += 1,
        }
    }
    found
}

/// What came that is no answer.
fn typed(came: &[u8]) -> Vec<u8> {
    let mut typed = Vec::new();
    let mut at = 0;
    for answer in answers(came) {
        typed.extend_from_slice(&came[at..answer.start]);
        at = answer.end;
    }
    typed.extend_from_slice(&came[at..]);
    typed
}

/// Whether the last question was answered.
fn complete(answer: &[u8]) -> bool {
    let start = answer.windows(3).position(|window| window == b"\x1b[?");
    start.is_some_and(|start| answer[start..].contains(&b'c'))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(answer: &str, kitty: bool, sixel: bool, cell: Option<(u16, u16)>) {
        assert_eq!(parse(answer.as_bytes()), Answer { kitty, sixel, cell });
    }

    #[test]
    fn answers_are_read() {
        check("", false, false, None);
        check("\x1b[?62;22c", false, false, None);
        check("\x1b[6;18;9t\x1b[?62;4;22c", false, true, Some((9, 18)));
        check(
            "\x1b_Gi=31;OK\x1b\\\x1b[6;20;10t\x1b[?62c",
            true,
            false,
            Some((10, 20)),
        );
        check("\x1b[6;0;0t\x1b[?64;1;2c", false, false, None);
        check("q\x1b[?4c", false, false, None);
    }

    #[track_caller]
    fn check_typed(came: &str, expected: &str) {
        let typed = typed(came.as_bytes());
        assert_eq!(String::from_utf8_lossy(&typed), expected, "{came:?}");
    }

    #[test]
    fn what_is_no_answer_was_typed() {
        check_typed("", "");
        check_typed("0.5\r", "0.5\r");
        check_typed("\x1b[?62;22c", "");
        check_typed("a\x1b_Gi=31;OK\x1b\\b\x1b[6;20;10tc\x1b[?62cd", "abcd");
        check_typed("\x1b[6~\x1b[A\x1b[?62;4c\x1b", "\x1b[6~\x1b[A\x1b");
        check_typed("\x1b[6;2~t\x1b[?62c", "\x1b[6;2~t");
        // Cut off by the time limit: better a stray key than a lost one.
        check_typed("x\x1b[?62", "x\x1b[?62");
    }
}
