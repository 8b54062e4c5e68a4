//! The screen of a lesson: where we are, the page, the field, the keys.

use ratatui::Frame;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};
use tutor::prose::Tone;
use tutor::view::{Progress, Saving, View};

use super::chrome::{at_right, cut, footer, rule};
use super::input;
use super::keys::keys;
use super::style::Palette;
use crate::text;
use crate::tui::keys::Focus;
use crate::tui::lesson::{GOING_ON, LessonScreen};
use crate::tui::pictures::Pictures;

/// From here on the stages stand in a column of their own.
const SIDEBAR_FROM: u16 = 126;
const SIDEBAR: u16 = 24;
const HEADER: u16 = 3;
/// A screen with fewer rows has no row to spare for title and rule.
const LOW: u16 = 18;
/// A screen with fewer columns has none to spare in the footer.
const NARROW: u16 = 60;

/// Where everything goes.
pub struct Areas {
    header: Rect,
    sidebar: Option<Rect>,
    pub page: Rect,
    note: Rect,
    pub input: Rect,
    footer: Rect,
}

impl Areas {
    pub fn new(screen: &LessonScreen, whole: Rect) -> Self {
        let header = Rect {
            height: if whole.height < LOW { 1 } else { HEADER },
            ..whole
        };
        let footer = Rect {
            y: whole.bottom().saturating_sub(1),
            height: 1,
            ..whole
        };
        let body = Rect {
            y: header.bottom(),
            height: footer.y.saturating_sub(header.bottom()),
            ..whole
        };
        let (sidebar, body) = if whole.width >= SIDEBAR_FROM {
            let sidebar = Rect {
                width: SIDEBAR,
                ..body
            };
            (
                Some(sidebar),
                Rect {
                    x: body.x + SIDEBAR + 2,
                    width: body.width - SIDEBAR - 2,
                    ..body
                },
            )
        } else {
            (None, body)
        };
        let body = Rect {
            x: body.x + 1,
            width: body.width.saturating_sub(2),
            ..body
        };
        let input_height = input::height(screen, body.width, body.height);
        let notes = notes(screen, body.width as usize, header.height == 1);
        let note_height = (notes.len() as u16).min(body.height / 2);
        let room = body.height.saturating_sub(input_height + note_height);
        // The field stands right below a short page, where the eye is.
        let page_height = room.min(screen.page.height() as u16 + 1);
        let page = Rect {
            height: page_height,
            ..body
        };
        let note = Rect {
            y: page.bottom(),
            height: note_height,
            ..body
        };
        let input = Rect {
            y: note.bottom(),
            height: input_height,
            ..body
        };
        Self {
            header,
            sidebar,
            page,
            note,
            input,
            footer,
        }
    }
}

pub fn draw(frame: &mut Frame, screen: &LessonScreen, pictures: &Pictures, palette: Palette) {
    let areas = Areas::new(screen, frame.area());
    let view = screen.view();
    header(frame, areas.header, view, areas.sidebar.is_none(), palette);
    if let Some(area) = areas.sidebar {
        sidebar(frame, area, view, palette);
    }
    screen.page.draw(
        screen.scroll,
        pictures,
        palette,
        areas.page,
        frame.buffer_mut(),
    );
    let notes = notes(screen, areas.note.width as usize, areas.header.height == 1);
    for (row, (tone, line)) in notes.into_iter().enumerate() {
        if row < areas.note.height as usize {
            let at = Rect {
                y: areas.note.y + row as u16,
                height: 1,
                ..areas.note
            };
            frame.render_widget(Line::styled(line, palette.tone(tone)), at);
        }
    }
    input::draw(frame, areas.input, screen, palette);
    let narrow = areas.footer.width < NARROW;
    let right = match (screen.has_more_below(), screen.scroll > 0) {
        (true, _) if narrow => "▼",
        (true, _) => "▼ more below",
        (false, true) if narrow => "▲",
        (false, true) => "▲ more above",
        (false, false) => "",
    };
    footer(
        frame,
        areas.footer,
        &keys(screen, areas.footer.width),
        right,
        palette,
    );
}

/// Title and whether all is saved; the stages or their names; a rule.
fn header(frame: &mut Frame, area: Rect, view: &View, with_stages: bool, palette: Palette) {
    let row = |row: u16| Rect {
        y: area.y + row,
        height: 1,
        ..area
    };
    let saved = saving(&view.saving, palette);
    let title = cut(
        &view.lesson_title,
        (area.width as usize).saturating_sub(saved.width() + 3),
    );
    let is_low = area.height == 1;
    if !is_low {
        frame.render_widget(Line::styled(format!(" {title}"), palette.title()), row(0));
    }

    let mut line = Line::raw(" ");
    if with_stages {
        for (_, progress) in &view.stages {
            let (sign, style) = sign(*progress, palette);
            line.push_span(Span::styled(sign, style));
        }
        line.push_span(Span::raw("  "));
    }
    line.push_span(Span::styled(view.stage.title(), palette.here()));
    let (at, of) = view.place;
    if of > 1 {
        line.push_span(Span::styled(format!(" {at}/{of}"), palette.quiet()));
    }
    if !view.heading.is_empty() && view.heading != view.stage.title() {
        line.push_span(Span::styled(" · ", palette.quiet()));
        let beside = if is_low { saved.width() + 1 } else { 0 };
        let room = (area.width as usize).saturating_sub(line.width() + 1 + beside);
        line.push_span(Span::styled(cut(&view.heading, room), palette.heading()));
    }
    if !is_low {
        frame.render_widget(line, row(1));
        rule(frame, row(2), palette);
    } else {
        frame.render_widget(line, row(0));
    }
    at_right(frame, row(0), saved);
}

fn sign(progress: Progress, palette: Palette) -> (&'static str, ratatui::style::Style) {
    match progress {
        Progress::Done => ("✓", palette.tone(Tone::Good)),
        Progress::Here => ("▸", palette.here()),
        Progress::Ahead => ("·", palette.quiet()),
    }
}

fn saving(saving: &Saving, palette: Palette) -> Line<'static> {
    match saving {
        Saving::Nothing => Line::default(),
        Saving::Waiting => Line::styled("… saving ", palette.quiet()),
        Saving::Saved => Line::styled("✓ saved ", palette.tone(Tone::Good)),
        Saving::Failed(_) => Line::styled("✗ not saved ", palette.tone(Tone::Bad)),
    }
}

fn sidebar(frame: &mut Frame, area: Rect, view: &View, palette: Palette) {
    for (index, (stage, progress)) in view.stages.iter().enumerate() {
        let y = area.y + 1 + 2 * index as u16;
        if y >= area.bottom() {
            break;
        }
        let (mark, style) = sign(*progress, palette);
        let name = if *progress == Progress::Here {
            palette.here()
        } else {
            style
        };
        let line = Line::from(vec![
            Span::raw("  "),
            Span::styled(mark, style),
            Span::styled(format!(" {}", stage.title()), name),
        ]);
        frame.render_widget(
            line,
            Rect {
                y,
                height: 1,
                ..area
            },
        );
    }
    for y in area.y..area.bottom() {
        frame.render_widget(
            Line::styled("│", palette.quiet()),
            Rect {
                x: area.right() - 1,
                y,
                width: 1,
                height: 1,
            },
        );
    }
}

/// Lines between page and field: what was said about the last key, what cannot be saved.
fn notes(screen: &LessonScreen, width: usize, is_low: bool) -> Vec<(Tone, String)> {
    let mut notes: Vec<(Tone, String)> = Vec::new();
    if let Some((sign, what)) = screen.waiting() {
        notes.push((Tone::Info, format!("{sign} {what} …")));
    }
    let mut say = |tone: Tone, says: &str| {
        let lines = text::wrap_plain(says, width, &format!("{} ", text::symbol(tone)), "  ");
        notes.extend(lines.into_iter().map(|line| (tone, line)));
    };
    for line in &screen.greeting {
        // Where rows are few, that one is seen anyhow.
        if is_low && line == GOING_ON {
            continue;
        }
        say(Tone::Info, line);
    }
    if let Some(offer) = &screen.offer {
        let keys = match screen.focus {
            Focus::Line | Focus::Editor => "Esc, then r",
            _ => "r",
        };
        say(Tone::Info, &offer.words(keys));
    }
    if let Some(note) = screen
        .view()
        .note
        .as_ref()
        .filter(|note| !screen.greeting.contains(note))
    {
        say(Tone::Info, note);
    }
    if let Some(why) = &screen.leaving_unsaved {
        say(
            Tone::Bad,
            &format!(
                "Not everything is saved: {why}. q again leaves all the same; any other key stays."
            ),
        );
    } else if let Saving::Failed(why) = &screen.view().saving {
        say(
            Tone::Bad,
            &format!("Not saved: {why}. It is kept here and tried again."),
        );
    }
    notes
}
