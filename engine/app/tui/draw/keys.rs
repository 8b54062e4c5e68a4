//! The keys of the footer: those that do something on this page now, and what.

use tutor::view::{Input, View};

use super::chrome::{Key, key};
use crate::tui::field::Field;
use crate::tui::keys::Focus;
use crate::tui::lesson::LessonScreen;

/// From here on there is room to say what is skipped.
const ROOMY: u16 = 60;

/// The keys that work here, the most important first.
pub fn keys(screen: &LessonScreen, width: u16) -> Vec<Key> {
    match screen.focus {
        Focus::Line | Focus::Editor => in_field(screen, width),
        _ => on_page(screen, width),
    }
}

/// Where every letter is text.
fn in_field(screen: &LessonScreen, width: u16) -> Vec<Key> {
    let view = screen.view();
    let text = screen.field.text().unwrap_or_default();
    let typed = !text.trim().is_empty();
    let mut keys: Vec<Key> = Vec::new();
    match &screen.field {
        Field::Code(_) => {
            keys.push(key("Ctrl-S", "run"));
            keys.push(key("Ctrl-O", "your editor"));
        }
        Field::Editor(_) if typed => keys.push(key("Ctrl-S", "hand in")),
        Field::Editor(_) => {}
        _ if typed => keys.push(key("Enter", "answer")),
        _ if view.can.next => keys.push(key("Enter", next(view))),
        _ => {}
    }
    if view.can.hint.is_some() {
        keys.push(key("Ctrl-T", hint(view)));
    }
    if view.can.skip {
        keys.push(key("Ctrl-G", skip(view, width)));
    }
    keys.push(key("F1", "help"));
    keys.push(key("Esc", "leave the field"));
    if screen.scrolls() {
        keys.push(match screen.focus {
            Focus::Line => key("↑↓", "scroll"),
            _ => key("PgUp/PgDn", "scroll"),
        });
    }
    keys.push(key("Ctrl-C", "quit"));
    keys
}

/// Where single letters are commands.
fn on_page(screen: &LessonScreen, width: u16) -> Vec<Key> {
    let view = screen.view();
    let mut keys: Vec<Key> = Vec::new();
    match (screen.focus, &screen.field) {
        (Focus::Place, _) => {
            keys.push(key("↑↓←→", "move (Shift: far)"));
            keys.push(key("Enter", "look here"));
        }
        (Focus::Button, field) => {
            let does = match field {
                Field::Code(_) => "run",
                _ => "hand in",
            };
            keys.push(key("Enter", does));
            keys.push(key("Tab", "to the page"));
        }
        (Focus::Options, Field::Order(order)) => {
            keys.push(key("↑↓", if order.grabbed { "move it" } else { "choose" }));
            keys.push(key("Space", if order.grabbed { "drop" } else { "grab" }));
            keys.push(key("Enter", "hand in"));
        }
        (Focus::Options, Field::Checklist { .. }) => {
            keys.push(key("y n", "said it or not"));
            keys.push(key("↑↓", "choose"));
            if is_marked(&view.input) {
                keys.push(key("Enter", "done"));
            }
        }
        (Focus::Options, _) => {
            keys.push(key("↑↓", "choose"));
            keys.push(key("Enter", "answer"));
        }
        _ => {
            if screen.has_more_below() {
                keys.push(key("Enter", "read on"));
            } else if view.can.next {
                keys.push(key("Enter", next(view)));
            }
            if view.input != Input::None {
                keys.push(key("Tab", "to the field"));
            }
        }
    }
    let answers = matches!(screen.focus, Focus::Options | Focus::Place);
    if answers && view.can.next {
        keys.push(key("Esc, Enter", next(view)));
    }
    if screen.offer.is_some() {
        keys.push(key("r", "first what is due"));
    }
    if screen.picture_in_view().is_some() {
        keys.push(key("i", "turn the picture"));
    }
    if view.can.back {
        // On a ball the arrows move the cursor.
        keys.push(match screen.focus {
            Focus::Place => key("Backspace", "back"),
            _ => key("←", "back"),
        });
    }
    if view.can.hint.is_some() {
        keys.push(key("t", hint(view)));
    }
    if view.can.skip {
        keys.push(key("s", skip(view, width)));
    }
    keys.push(key("q", "quit"));
    keys.push(key("?", "help"));
    keys
}

fn is_marked(input: &Input) -> bool {
    match input {
        Input::Checklist { points } => points.iter().all(|point| point.said.is_some()),
        _ => false,
    }
}

fn next(view: &View) -> &str {
    match view.next_label.as_str() {
        "" => "on",
        label => label,
    }
}

fn hint(view: &View) -> &'static str {
    match view.can.hint {
        Some(1) => "hint",
        Some(2) => "second hint",
        _ => "show the answer",
    }
}

fn skip(view: &View, width: u16) -> &str {
    match view.skip_label.as_str() {
        "" => "skip",
        label if width < ROOMY && label.starts_with("skip ") => "skip",
        label => label,
    }
}
