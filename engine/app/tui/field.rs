//! What the learner types or arranges into, one widget for each kind of input.

use ratatui_textarea::{CursorMove, Input as Edit, Key, TextArea, WrapMode};
use tutor::view::Input;

use super::ball::Ball;
use super::keys::Focus;

/// The field of a screen, with what stands in it.
pub enum Field {
    None,
    Line(Box<TextArea<'static>>),
    Editor(Box<TextArea<'static>>),
    /// The text of a shader.
    Code(Box<TextArea<'static>>),
    /// A place on a ball.
    Place(Box<Ball>),
    Choice {
        at: usize,
    },
    Order(Order),
    Checklist {
        at: usize,
    },
}

/// Items being put in order.
pub struct Order {
    /// Places of the items as they were shown, in the order they have now.
    pub places: Vec<usize>,
    pub at: usize,
    /// The item at `at` moves with the arrows.
    pub grabbed: bool,
}

impl Field {
    pub fn of(input: &Input) -> Self {
        match input {
            Input::None => Self::None,
            Input::Number { draft, .. } => Self::Line(Box::new(line(&draft.replace('\n', " ")))),
            Input::Reply { draft, .. } => Self::Line(Box::new(reply(draft))),
            Input::Text { draft, .. } => Self::Editor(Box::new(editor(draft))),
            Input::Code { text, .. } => Self::Code(Box::new(code(text))),
            Input::Place { picture, at } => Self::Place(Box::new(Ball::new(picture, *at))),
            Input::Choice { .. } => Self::Choice { at: 0 },
            Input::Order { items } => Self::Order(Order {
                places: (0..items.len()).collect(),
                at: 0,
                grabbed: false,
            }),
            Input::Checklist { .. } => Self::Checklist { at: 0 },
        }
    }

    /// The field of a shader with another text in it.
    pub fn of_code(text: &str) -> Self {
        Self::Code(Box::new(code(
            &text.replace("\r\n", "\n").replace('\t', "    "),
        )))
    }

    /// Who gets the keys while this field is used.
    pub fn focus(&self) -> Focus {
        match self {
            Self::None => Focus::Page,
            Self::Line(_) => Focus::Line,
            Self::Editor(_) | Self::Code(_) => Focus::Editor,
            Self::Place(_) => Focus::Place,
            Self::Choice { .. } | Self::Order(_) | Self::Checklist { .. } => Focus::Options,
        }
    }

    /// What stands in a text field.
    pub fn text(&self) -> Option<String> {
        match self {
            Self::Line(area) | Self::Editor(area) | Self::Code(area) => {
                Some(area.lines().join("\n"))
            }
            _ => None,
        }
    }

    /// Gives a key to a text field. True where its text changed.
    pub fn edit(&mut self, key: Edit) -> bool {
        match self {
            Self::Line(area) | Self::Editor(area) => area.input(key),
            Self::Code(area) => {
                let begins = matches!(key.key, Key::Enter);
                let indent = begins.then(|| indent_at(area));
                let changed = area.input(key);
                // A new line begins below the one before.
                if let Some(indent) = indent.filter(|indent| !indent.is_empty()) {
                    area.insert_str(indent);
                }
                changed
            }
            _ => false,
        }
    }

    pub fn paste(&mut self, text: &str) {
        // Terminals send line breaks of a paste as carriage returns.
        let text = text.replace("\r\n", "\n").replace('\r', "\n");
        match self {
            Self::Line(area) => {
                area.insert_str(text.replace('\n', " ").trim());
            }
            Self::Editor(area) | Self::Code(area) => {
                area.insert_str(text);
            }
            _ => {}
        }
    }

    /// Moves the choice up or down; `count` options there are.
    pub fn step(&mut self, down: bool, count: usize) {
        let moved = |at: usize| {
            if down {
                (at + 1).min(count.saturating_sub(1))
            } else {
                at.saturating_sub(1)
            }
        };
        match self {
            Self::Choice { at } | Self::Checklist { at } => *at = moved(*at),
            Self::Order(order) => {
                let to = moved(order.at);
                if order.grabbed {
                    order.places.swap(order.at, to);
                }
                order.at = to;
            }
            _ => {}
        }
    }
}

impl Order {
    /// The order as it is handed in: "2 1 3".
    pub fn answer(&self) -> String {
        let numbers: Vec<String> = self
            .places
            .iter()
            .map(|place| (place + 1).to_string())
            .collect();
        numbers.join(" ")
    }
}

fn line(text: &str) -> TextArea<'static> {
    let mut area = TextArea::new(vec![text.to_owned()]);
    area.set_cursor_line_style(ratatui::style::Style::new());
    area.move_cursor(CursorMove::End);
    area
}

/// A line that may get long: it wraps instead of running out of the field.
fn reply(draft: &str) -> TextArea<'static> {
    let mut area = line(&draft.replace('\n', " "));
    area.set_wrap_mode(WrapMode::WordOrGlyph);
    area
}

fn editor(draft: &str) -> TextArea<'static> {
    let lines: Vec<String> = draft.split('\n').map(str::to_owned).collect();
    let mut area = TextArea::new(lines);
    area.set_cursor_line_style(ratatui::style::Style::new());
    area.set_wrap_mode(WrapMode::WordOrGlyph);
    area.set_max_histories(500);
    area.move_cursor(CursorMove::Bottom);
    area.move_cursor(CursorMove::End);
    area
}

/// Lines as they are, the first one first.
fn code(text: &str) -> TextArea<'static> {
    let lines = text.trim_end().split('\n').map(str::to_owned).collect();
    let mut area = TextArea::new(lines);
    area.set_cursor_line_style(ratatui::style::Style::new());
    area.set_line_number_style(ratatui::style::Style::new().dim());
    area.set_max_histories(500);
    area
}

/// The spaces that the line under the cursor begins with.
fn indent_at(area: &TextArea<'_>) -> String {
    let (row, column) = (area.cursor().0, area.cursor().1);
    let line = area.lines().get(row).map_or("", String::as_str);
    let spaces = line
        .chars()
        .take(column)
        .take_while(|letter| *letter == ' ');
    spaces.collect()
}

#[cfg(test)]
mod tests {
    use crossterm::event::{KeyCode, KeyEvent, KeyModifiers};
    use ratatui_textarea::Input as Edit;

    use super::*;

    #[track_caller]
    fn check_typed(draft: &str, keys: &str, text: &str) {
        let mut field = Field::Editor(Box::new(editor(draft)));
        for letter in keys.chars() {
            let code = if letter == '\r' {
                KeyCode::Enter
            } else {
                KeyCode::Char(letter)
            };
            field.edit(Edit::from(KeyEvent::new(code, KeyModifiers::NONE)));
        }
        assert_eq!(field.text().as_deref(), Some(text));
    }

    #[test]
    fn what_is_typed_at_once_is_what_stands_there() {
        check_typed("", "ab\rcd", "ab\ncd");
        check_typed("one", " two\rthree\r", "one two\nthree\n");
        check_typed("one\ntwo", " three", "one\ntwo three");
        check_typed(
            "",
            "q? the middle is\rtoo dark",
            "q? the middle is\ntoo dark",
        );
    }
}
