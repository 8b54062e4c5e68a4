//! Colours, each with something beside it that is not a colour.

use ratatui::style::{Color, Modifier, Style};
use tutor::prose::Tone;

use crate::text::Role;

/// The styles of the screen; without colours only weight and underlining are left.
#[derive(Clone, Copy, Debug)]
pub struct Palette {
    colours: bool,
}

/// Curves of a plot, told apart without colours by their marks.
const CURVES: [Color; 6] = [
    Color::Cyan,
    Color::Yellow,
    Color::Magenta,
    Color::Green,
    Color::LightRed,
    Color::LightBlue,
];

impl Palette {
    /// `NO_COLOR` set to anything but nothing takes the colours away.
    pub fn from_env() -> Self {
        let refused = std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty());
        Self { colours: !refused }
    }

    pub fn has_colours(self) -> bool {
        self.colours
    }

    fn fg(self, colour: Color) -> Style {
        if self.colours {
            Style::new().fg(colour)
        } else {
            Style::new()
        }
    }

    pub fn role(self, role: Role) -> Style {
        match role {
            Role::Text => Style::new(),
            Role::Strong => Style::new().add_modifier(Modifier::BOLD),
            Role::Emph => Style::new().add_modifier(Modifier::ITALIC),
            Role::Code => self.fg(Color::Cyan),
            Role::Math => self.fg(Color::Cyan).add_modifier(Modifier::BOLD),
            Role::Marked(tone) => self.tone(tone).add_modifier(Modifier::UNDERLINED),
        }
    }

    pub fn tone(self, tone: Tone) -> Style {
        match tone {
            Tone::Good => self.fg(Color::Green),
            Tone::Near => self.fg(Color::Yellow),
            Tone::Bad => self.fg(Color::Red),
            Tone::Info => self.fg(Color::Blue),
        }
    }

    pub fn heading(self) -> Style {
        self.fg(Color::Yellow).add_modifier(Modifier::BOLD)
    }

    pub fn title(self) -> Style {
        Style::new().add_modifier(Modifier::BOLD)
    }

    pub fn quiet(self) -> Style {
        if self.colours {
            Style::new().fg(Color::DarkGray)
        } else {
            Style::new().add_modifier(Modifier::DIM)
        }
    }

    pub fn key(self) -> Style {
        self.fg(Color::Yellow).add_modifier(Modifier::BOLD)
    }

    pub fn frame(self, focused: bool) -> Style {
        if focused {
            self.fg(Color::Cyan).add_modifier(Modifier::BOLD)
        } else {
            self.quiet()
        }
    }

    pub fn selected(self) -> Style {
        Style::new().add_modifier(Modifier::REVERSED)
    }

    pub fn here(self) -> Style {
        self.fg(Color::Cyan).add_modifier(Modifier::BOLD)
    }

    /// A curve that may be called by its colour.
    pub fn named_curve(self, name: &str, index: usize) -> Style {
        match name {
            "red" => self.fg(Color::LightRed),
            "green" => self.fg(Color::Green),
            "blue" => self.fg(Color::LightBlue),
            _ => self.curve(index),
        }
    }

    pub fn curve(self, index: usize) -> Style {
        self.fg(CURVES[index % CURVES.len()])
    }
}
