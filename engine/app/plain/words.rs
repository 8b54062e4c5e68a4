//! The words around a lesson that is read as text, and what a learner's line means there.

use tutor::session::Msg;
use tutor::view::{Input, View};

/// Where we are, in one line.
pub fn headline(view: &View) -> String {
    let (at, of) = view.place;
    let place = if of > 1 {
        format!(" {at} of {of}")
    } else {
        String::new()
    };
    let stage = view.stage.title();
    if view.heading.is_empty() || view.heading == stage {
        format!("## {stage}{place}")
    } else {
        format!("## {stage}{place}: {}", view.heading)
    }
}

/// What can be typed now.
pub fn help(view: &View, offers_due: bool) -> Vec<String> {
    let mut lines = Vec::new();
    let mut say = |works: bool, line: &str| {
        if works {
            lines.push(line.to_owned());
        }
    };
    say(view.can.next, "An empty line goes on.");
    say(
        view.can.hint.is_some(),
        match view.can.hint {
            Some(1) => ":hint  a hint; the third one is the answer",
            Some(2) => ":hint  a second hint; the third one is the answer",
            _ => ":hint  the answer",
        },
    );
    say(view.can.back, ":back  the screen before; nothing is lost");
    say(
        view.can.skip,
        &match view.skip_label.as_str() {
            "" => ":skip  leave this out".to_owned(),
            label => format!(":skip  {label}"),
        },
    );
    say(offers_due, ":due  what is due of other lessons, first");
    say(
        true,
        ":quit  save and leave; the same command comes back here",
    );
    say(
        matches!(view.input, Input::Code { .. }),
        ":7 TEXT changes line 7 of the shader; :show prints it, :edit opens your editor",
    );
    say(
        matches!(view.input, Input::Number { .. }),
        "Numbers: 0.56, 5.6e-1, 0,56 or arithmetic such as 0.4^4, 1/pi.",
    );
    lines
}

/// Whether a line can be meant for nobody but the tutor.
pub fn asks_for_help(line: &str) -> bool {
    matches!(
        line.to_lowercase().as_str(),
        "?" | "??" | "help" | "help!" | "help?"
    )
}

/// Whether a line is the name of a command where no words are asked for.
pub fn is_command_without_colon(line: &str, input: &Input) -> bool {
    const NAMES: [&str; 6] = ["quit", "exit", "back", "skip", "hint", "due"];
    let wants_words = matches!(
        input,
        Input::Text { .. } | Input::Reply { .. } | Input::Code { .. }
    );
    !wants_words && NAMES.contains(&line)
}

/// A text with the numbers of its lines.
pub fn numbered(text: &str) -> Vec<String> {
    let lines = text.trim_end().lines().enumerate();
    lines
        .map(|(index, line)| {
            format!("    {:>2} | {line}", index + 1)
                .trim_end()
                .to_owned()
        })
        .collect()
}

/// A text with one line changed, its indentation kept where none is typed, and that line as it
/// is now.
pub fn with_line(text: &str, number: &str, new: &str) -> Option<(String, String)> {
    let index = number.parse::<usize>().ok()?.checked_sub(1)?;
    let mut lines: Vec<String> = text.trim_end().lines().map(str::to_owned).collect();
    let old = lines.get_mut(index)?;
    let indent: String = old.chars().take_while(|letter| *letter == ' ').collect();
    *old = format!("{indent}{new}").trim_end().to_owned();
    let shown = format!("    {:>2} | {old}", index + 1);
    Some((lines.join("\n"), shown))
}

/// "y", "n", "2 y".
pub fn checklist(line: &str, open: Option<usize>) -> Option<Msg> {
    let mut words = line.split_whitespace();
    let first = words.next()?;
    let (point, word) = match first.parse::<usize>() {
        Ok(number) => (number.checked_sub(1)?, words.next()?),
        Err(_) => (open?, first),
    };
    let said = match word {
        "y" | "yes" | "j" => true,
        "n" | "no" => false,
        _ => return None,
    };
    Some(Msg::Mark { point, said })
}
