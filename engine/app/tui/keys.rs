//! The one place that reads keys: what a key means depends on where the learner is.

use crossterm::event::{
    Event, KeyCode, KeyEvent, KeyEventKind, KeyModifiers, MouseButton, MouseEventKind,
};
use ratatui_textarea::Input as Edit;

/// Who gets the keys.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Focus {
    /// The list of lessons.
    Picker,
    /// The page: single keys are commands.
    Page,
    /// A one-line field: every letter is text.
    Line,
    /// The text editor: every letter and Enter are text.
    Editor,
    /// The button below the editor.
    Button,
    /// Options, an order, a checklist: single keys are commands.
    Options,
    /// A cursor on a ball: arrows move it.
    Place,
    /// The help lies over everything.
    Help,
}

/// What the learner wants.
#[derive(Clone, Debug, PartialEq)]
pub enum Action {
    /// Enter: go on, answer, open.
    Enter,
    Back,
    Skip,
    Hint,
    Up,
    Down,
    /// Scroll the page whatever has the focus.
    PageUp,
    PageDown,
    Top,
    Bottom,
    /// To the next thing that can have the focus.
    NextFocus,
    /// On, where nothing waits for an answer.
    Forward,
    /// First what is due again.
    AskDue,
    /// Out of a field, out of the help.
    Leave,
    /// Hand in what the editor holds.
    HandIn,
    /// The text in the learner's own editor.
    OpenEditor,
    /// The picture in view under the arrow keys.
    Play,
    /// Tick, grab.
    Toggle,
    /// Scroll the page by so many lines.
    Scroll(i16),
    /// An option by its letter or number, from 0.
    Pick(usize),
    Yes,
    No,
    /// The cursor on a ball, so many cells to the right and down.
    Move(i16, i16),
    /// A cell of the screen was clicked: column and row.
    Click(u16, u16),
    /// A key for the field that has the focus.
    Edit(Edit),
    Paste(String),
    Help,
    /// Out of this screen.
    Quit,
    /// Ctrl-C: out of the program, from wherever.
    QuitAll,
    /// The size changed.
    Redraw,
    /// Draw everything again, for something else wrote over it.
    Repaint,
    /// Nothing means anything here.
    Nothing,
}

/// What an event means to whoever has the focus.
pub fn action(event: Event, focus: Focus) -> Action {
    match event {
        Event::Key(key) if key.kind != KeyEventKind::Release => of_key(key, focus),
        Event::Paste(text) => Action::Paste(text),
        Event::Resize(..) => Action::Redraw,
        Event::Mouse(mouse) => match mouse.kind {
            MouseEventKind::Down(MouseButton::Left) | MouseEventKind::Drag(MouseButton::Left) => {
                Action::Click(mouse.column, mouse.row)
            }
            MouseEventKind::ScrollDown => Action::Scroll(3),
            MouseEventKind::ScrollUp => Action::Scroll(-3),
            _ => Action::Nothing,
        },
        _ => Action::Nothing,
    }
}

fn of_key(key: KeyEvent, focus: Focus) -> Action {
    let control = key.modifiers.contains(KeyModifiers::CONTROL);
    if control {
        match key.code {
            KeyCode::Char('c') => return Action::QuitAll,
            KeyCode::Char('t') => return Action::Hint,
            KeyCode::Char('g') => return Action::Skip,
            KeyCode::Char('l') => return Action::Repaint,
            _ => {}
        }
    }
    match key.code {
        KeyCode::F(1) => return Action::Help,
        KeyCode::PageUp => return Action::PageUp,
        KeyCode::PageDown => return Action::PageDown,
        _ => {}
    }
    match focus {
        Focus::Help => of_help(key),
        Focus::Line => of_line(key),
        Focus::Editor => of_editor(key),
        Focus::Button => of_button(key),
        Focus::Page | Focus::Picker => of_page(key),
        Focus::Options => of_options(key),
        Focus::Place => of_place(key),
    }
}

fn of_help(key: KeyEvent) -> Action {
    match key.code {
        KeyCode::Esc | KeyCode::Enter | KeyCode::Char('?' | 'q') => Action::Leave,
        KeyCode::Up | KeyCode::Char('k') => Action::Up,
        KeyCode::Down | KeyCode::Char('j') => Action::Down,
        _ => Action::Nothing,
    }
}

fn of_line(key: KeyEvent) -> Action {
    match key.code {
        KeyCode::Enter => Action::Enter,
        KeyCode::Esc => Action::Leave,
        KeyCode::Tab | KeyCode::BackTab => Action::NextFocus,
        KeyCode::Up => Action::Up,
        KeyCode::Down => Action::Down,
        _ => Action::Edit(Edit::from(key)),
    }
}

fn of_editor(key: KeyEvent) -> Action {
    let control = key.modifiers.contains(KeyModifiers::CONTROL);
    let alt = key.modifiers.contains(KeyModifiers::ALT);
    match key.code {
        KeyCode::Char('s' | 'd') if control => Action::HandIn,
        KeyCode::Char('o') if control => Action::OpenEditor,
        KeyCode::Enter if control || alt => Action::HandIn,
        KeyCode::Esc => Action::Leave,
        KeyCode::Tab | KeyCode::BackTab => Action::NextFocus,
        _ => Action::Edit(Edit::from(key)),
    }
}

fn of_button(key: KeyEvent) -> Action {
    match key.code {
        KeyCode::Enter | KeyCode::Char(' ') => Action::HandIn,
        _ => of_page(key),
    }
}

fn of_page(key: KeyEvent) -> Action {
    match key.code {
        KeyCode::Enter => Action::Enter,
        KeyCode::Right | KeyCode::Char('l') => Action::Forward,
        KeyCode::Char(' ') => Action::PageDown,
        KeyCode::Left | KeyCode::Backspace | KeyCode::Char('h') => Action::Back,
        KeyCode::Up | KeyCode::Char('k') => Action::Up,
        KeyCode::Down | KeyCode::Char('j') => Action::Down,
        KeyCode::Home | KeyCode::Char('g') => Action::Top,
        KeyCode::End | KeyCode::Char('G') => Action::Bottom,
        KeyCode::Tab | KeyCode::BackTab => Action::NextFocus,
        KeyCode::Char('s') => Action::Skip,
        KeyCode::Char('t') => Action::Hint,
        KeyCode::Char('i') => Action::Play,
        KeyCode::Char('r') => Action::AskDue,
        KeyCode::Char('?') => Action::Help,
        KeyCode::Char('q') => Action::Quit,
        KeyCode::Esc => Action::Leave,
        _ => Action::Nothing,
    }
}

fn of_place(key: KeyEvent) -> Action {
    // With Shift farther.
    let far = match key.modifiers.contains(KeyModifiers::SHIFT) {
        true => 4,
        false => 1,
    };
    match key.code {
        KeyCode::Left | KeyCode::Char('h' | 'H') => Action::Move(-far, 0),
        KeyCode::Right | KeyCode::Char('l' | 'L') => Action::Move(far, 0),
        KeyCode::Up | KeyCode::Char('k' | 'K') => Action::Move(0, -far),
        KeyCode::Down | KeyCode::Char('j' | 'J') => Action::Move(0, far),
        KeyCode::Enter | KeyCode::Char(' ') => Action::HandIn,
        _ => of_page(key),
    }
}

fn of_options(key: KeyEvent) -> Action {
    match key.code {
        KeyCode::Enter => Action::Enter,
        KeyCode::Char(' ') => Action::Toggle,
        // Right and `l` go on elsewhere; here they would hand in by accident.
        KeyCode::Right | KeyCode::Char('l') => Action::Nothing,
        KeyCode::Char('y') => Action::Yes,
        KeyCode::Char('n') => Action::No,
        KeyCode::Char(digit @ '1'..='9') => Action::Pick(digit as usize - '1' as usize),
        KeyCode::Char(letter @ 'a'..='f') => Action::Pick(letter as usize - 'a' as usize),
        _ => of_page(key),
    }
}
