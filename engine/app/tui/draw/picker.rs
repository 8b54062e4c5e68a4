//! The list of lessons, drawn.

use ratatui::Frame;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};
use tutor::prose::Tone;
use tutor::session::progress::LessonState;

use super::chrome::{footer, key, rule};
use super::style::Palette;
use crate::due::still_asked;
use crate::text;
use crate::tui::picker::{Entry, Picker};

pub fn draw(frame: &mut Frame, picker: &Picker, palette: Palette) {
    let whole = frame.area();
    let row = |y: u16| Rect {
        y,
        height: 1.min(whole.bottom().saturating_sub(y)),
        ..whole
    };
    let title = Line::from(vec![
        Span::styled(" lobe", palette.heading()),
        Span::styled("  a tutor for microfacet shading", palette.quiet()),
    ]);
    frame.render_widget(title, row(whole.y));
    rule(frame, row(whole.y + 1), palette);

    let width = (whole.width.saturating_sub(2)).min(100);
    let body = Rect {
        x: whole.x + 1,
        y: whole.y + 3,
        width,
        height: whole.height.saturating_sub(4),
    };
    let mut lines: Vec<(Line, bool)> = Vec::new();
    for (index, entry) in picker.entries.iter().enumerate() {
        let here = index == picker.at;
        lines.extend(
            entry_lines(entry, here, width as usize, palette)
                .into_iter()
                .map(|line| (line, here)),
        );
    }
    if picker.entries.is_empty() {
        lines.push((Line::raw("There is no lesson that can be taught."), true));
    }
    for says in picker.broken.iter().chain(&picker.said) {
        let tone = if picker.said.as_ref() == Some(says) {
            Tone::Good
        } else {
            Tone::Bad
        };
        let wrapped = text::wrap_plain(
            says,
            width as usize,
            &format!("{} ", text::symbol(tone)),
            "  ",
        );
        lines.extend(
            wrapped
                .into_iter()
                .map(|line| (Line::styled(line, palette.tone(tone)), false)),
        );
    }

    let height = body.height as usize;
    let last_chosen = lines.iter().rposition(|(_, here)| *here).unwrap_or(0);
    let top = (last_chosen + 1).saturating_sub(height);
    for (y, (line, _)) in lines.into_iter().skip(top).take(height).enumerate() {
        frame.render_widget(
            line,
            Rect {
                y: body.y + y as u16,
                height: 1,
                ..body
            },
        );
    }
    let open = match picker
        .entries
        .get(picker.at)
        .map(|entry| &entry.summary.state)
    {
        Some(LessonState::InProgress { .. }) => "resume",
        Some(LessonState::New) | None => "begin",
        Some(_) => "take it again",
    };
    let due = picker
        .entries
        .get(picker.at)
        .map_or(0, |entry| still_asked(entry).len());
    let mut keys = vec![key("↑↓", "choose"), key("Enter", open)];
    if due > 0 {
        keys.push(key("r", "re-test what is due"));
    }
    keys.extend([key("?", "help"), key("q", "quit")]);
    footer(
        frame,
        row(whole.bottom().saturating_sub(1)),
        &keys,
        "",
        palette,
    );
}

fn entry_lines(entry: &Entry, here: bool, width: usize, palette: Palette) -> Vec<Line<'static>> {
    let (sign, tone) = match &entry.summary.state {
        LessonState::New => ("·", Tone::Info),
        LessonState::InProgress { .. } => ("▸", Tone::Near),
        LessonState::Passed { .. } => ("✓", Tone::Good),
        LessonState::NotYet { .. } => ("≈", Tone::Near),
    };
    let pointer = if here { "▸ " } else { "  " };
    let title_style = if here {
        palette.here()
    } else {
        palette.title()
    };
    let mut lines = Vec::new();
    let heading = format!("{}. {}", entry.number, entry.lesson.title);
    for (index, line) in text::wrap_plain(&heading, width.saturating_sub(16), "", "   ")
        .into_iter()
        .enumerate()
    {
        let before = if index == 0 { pointer } else { "  " };
        let mut spans = vec![
            Span::styled(before, palette.key()),
            Span::styled(line, title_style),
        ];
        if index == 0 {
            spans.push(Span::styled(
                format!("  {} min", entry.lesson.minutes),
                palette.quiet(),
            ));
        }
        lines.push(Line::from(spans));
    }
    let state = text::wrap_plain(
        &entry.summary.state.words(),
        width.saturating_sub(5),
        &format!("{sign} "),
        "  ",
    );
    lines.extend(
        state
            .into_iter()
            .map(|line| Line::styled(format!("     {line}"), palette.tone(tone))),
    );
    if !entry.summary.due.is_empty() {
        let due = format!("     ! {} due again", entry.summary.due.len());
        lines.push(Line::styled(due, palette.key()));
    }
    if here {
        let summary = text::wrap_plain(&entry.lesson.summary, width.saturating_sub(5), "", "");
        lines.extend(
            summary
                .into_iter()
                .map(|line| Line::styled(format!("     {line}"), palette.quiet())),
        );
    }
    lines.push(Line::default());
    lines
}
