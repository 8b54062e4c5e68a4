//! Blocks of text and tables as styled lines of a width.

use ratatui::text::{Line, Span};
use tutor::prose::{Block, Inline, TableView};
use unicode_width::UnicodeWidthStr as _;

use super::style::Palette;
use crate::text::{self, Piece, Pieces, Role};

pub fn styled(pieces: Pieces, palette: Palette) -> Line<'static> {
    pieces
        .into_iter()
        .map(|piece| Span::styled(piece.text, palette.role(piece.role)))
        .collect()
}

pub fn table_rows(table: &TableView, width: usize, palette: Palette) -> Vec<Line<'static>> {
    let mut lines: Vec<Line> = text::wrap_plain(&table.title, width, "", "")
        .into_iter()
        .filter(|line| !line.is_empty())
        .map(|line| Line::styled(line, palette.title()))
        .collect();
    match text::table_lines(table, width) {
        Some(rows) => {
            let styles = [palette.title(), palette.quiet()];
            lines.extend(rows.into_iter().enumerate().map(
                |(index, row)| match styles.get(index) {
                    Some(style) => Line::styled(row, *style),
                    None => Line::raw(row),
                },
            ));
        }
        None => {
            for row in &table.rows {
                let cells: Vec<String> = table
                    .header
                    .iter()
                    .zip(row)
                    .map(|(head, cell)| format!("{head}: {cell}"))
                    .collect();
                lines.extend(
                    text::wrap_plain(&cells.join("; "), width, "• ", "  ")
                        .into_iter()
                        .map(Line::raw),
                );
            }
        }
    }
    if !table.note.is_empty() {
        lines.extend(
            text::wrap(&text::pieces(&table.note), width)
                .into_iter()
                .map(|line| styled(line, palette)),
        );
    }
    lines
}

/// A block that is not a figure as styled lines.
pub fn prose(block: &Block, width: usize, palette: Palette) -> Vec<Line<'static>> {
    match block {
        Block::Heading(heading) => text::wrap_plain(heading, width, "", "")
            .into_iter()
            .map(|line| Line::styled(line, palette.heading()))
            .collect(),
        Block::Paragraph(inlines) => paragraph(inlines, width, palette),
        Block::List { ordered, items } => items
            .iter()
            .enumerate()
            .flat_map(|(index, item)| {
                let first = if *ordered {
                    format!("{}. ", index + 1)
                } else {
                    "• ".to_owned()
                };
                let rest = " ".repeat(first.width());
                hanging(
                    &text::pieces(item),
                    width,
                    Span::raw(first),
                    Span::raw(rest),
                    palette,
                )
            })
            .collect(),
        Block::CodeBlock(code) => around_mark(code, width.saturating_sub(2))
            .into_iter()
            .map(|line| Line::styled(format!("  {line}"), palette.role(Role::Code)))
            .collect(),
        Block::Quote(inlines) => {
            let bar = Span::styled("▌ ", palette.quiet());
            hanging(&text::pieces(inlines), width, bar.clone(), bar, palette)
        }
        Block::Derivation {
            name,
            lines,
            value,
            says,
        } => {
            let steps = text::derivation(name, lines, value);
            let last = steps.len().saturating_sub(1);
            let mut shown: Vec<Line> = steps
                .into_iter()
                .enumerate()
                .flat_map(|(index, (before, line))| {
                    let rest = " ".repeat(before.width() + 2);
                    let role = if index == last {
                        Role::Math
                    } else {
                        Role::Code
                    };
                    hanging(
                        &[Piece::new(line, role)],
                        width,
                        Span::raw(before),
                        Span::raw(rest),
                        palette,
                    )
                })
                .collect();
            if !says.is_empty() {
                let gap = Span::raw("  ");
                shown.extend(hanging(
                    &text::pieces(says),
                    width,
                    gap.clone(),
                    gap,
                    palette,
                ));
            }
            shown
        }
        Block::Verdict { tone, title, text } => {
            let style = palette.tone(*tone);
            let mut all = vec![Piece::new(title.trim_end_matches('.'), Role::Strong)];
            if !text.is_empty() {
                all.push(Piece::new(". ", Role::Strong));
                all.extend(text::pieces(text));
            }
            let sign = Span::styled(format!("{} ", text::symbol(*tone)), palette.tone(*tone));
            let bar = Span::styled("│ ", style);
            let mut lines = hanging(&all, width, sign, bar, palette);
            if let Some(first) = lines.first_mut() {
                for span in first.spans.iter_mut().skip(1).take(1) {
                    span.style = span.style.patch(style);
                }
            }
            lines
        }
        Block::Checklist { points } => points
            .iter()
            .flat_map(|(point, said)| {
                let first = Span::styled(format!("{} ", text::tick(*said)), palette.key());
                hanging(
                    &[Piece::new(point, Role::Text)],
                    width,
                    first,
                    Span::raw("    "),
                    palette,
                )
            })
            .collect(),
        Block::Quoted { text: words, marks } => {
            let all: Pieces = text::quoted(words, marks)
                .into_iter()
                .map(|piece| match piece.role {
                    Role::Marked(tone) => {
                        Piece::new(format!("{}{}", text::symbol(tone), piece.text), piece.role)
                    }
                    _ => piece,
                })
                .collect();
            let bar = Span::styled("▌ ", palette.quiet());
            hanging(&all, width, bar.clone(), bar, palette)
        }
        Block::Table(_) | Block::Plot(_) | Block::Map(_) | Block::Picture { .. } => Vec::new(),
    }
}

/// Lines of code; where one of them marks a place with `^` that lies beyond `width`, the part of
/// all of them in which it lies.
fn around_mark(code: &str, width: usize) -> Vec<String> {
    /// Columns seen behind the mark.
    const BEHIND: usize = 6;
    let mark = code.lines().find(|line| line.trim() == "^");
    let column = mark.map_or(0, |line| line.trim_end().chars().count());
    if column <= width {
        return code.lines().map(str::to_owned).collect();
    }
    let hidden = (column + BEHIND).saturating_sub(width) + 1;
    let part = |line: &str| {
        let rest: String = line.chars().skip(hidden).collect();
        match line.trim() {
            "^" | "" => format!(" {rest}"),
            _ => format!("…{rest}"),
        }
    };
    code.lines().map(part).collect()
}

fn paragraph(inlines: &[Inline], width: usize, palette: Palette) -> Vec<Line<'static>> {
    text::wrap(&text::pieces(inlines), width)
        .into_iter()
        .map(|line| styled(line, palette))
        .collect()
}

/// Wrapped lines with something before the first and the others.
fn hanging(
    pieces: &[Piece],
    width: usize,
    first: Span<'static>,
    rest: Span<'static>,
    palette: Palette,
) -> Vec<Line<'static>> {
    let room = width.saturating_sub(first.width().max(rest.width()));
    text::wrap(pieces, room)
        .into_iter()
        .enumerate()
        .map(|(index, line)| {
            let mut spans = vec![if index == 0 {
                first.clone()
            } else {
                rest.clone()
            }];
            spans.extend(styled(line, palette).spans);
            Line::from(spans)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::around_mark;

    #[track_caller]
    fn check(code: &str, width: usize, lines: &[&str]) {
        assert_eq!(around_mark(code, width), lines);
    }

    #[test]
    fn a_mark_beyond_the_edge_is_brought_into_view() {
        check(
            "let x = y z;\n          ^",
            12,
            &["let x = y z;", "          ^"],
        );
        check(
            "let x = y z;\n          ^",
            11,
            &["let x = y z;", "          ^"],
        );
        check("let x = y z;\n          ^", 10, &["…y z;", "   ^"]);
        check("no mark in this line", 4, &["no mark in this line"]);
    }
}
