//! A page: blocks laid out for a width, of which a window is drawn.
//!
//! Laying out is done once for a view and a width; scrolling only moves the window.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};
use ratatui::widgets::Widget as _;
use tutor::map::MapFrame;
use tutor::prose::{Block, Inline, PlotView, TableView, plain};
use unicode_width::UnicodeWidthStr as _;

use super::picture::{self, Words};
use super::plot;
use super::style::Palette;
use crate::fingerprints::{Kind, Subject};
use crate::text::{self, Piece, Pieces, Role};
use crate::tui::pictures::{Pictures, map_size};

/// Prose wider than this is hard to read.
const PROSE: u16 = 90;
/// From here on figures stand beside the prose instead of below it.
const TWO_COLUMNS: u16 = 146;
/// The least width in which a plot says something.
const PLOT: u16 = 38;

/// What stands somewhere on a page.
enum What {
    Line(Line<'static>),
    Plot(Box<PlotView>),
    Picture {
        subject: Subject,
        title: String,
    },
    Map {
        subject: Subject,
        frame: Box<MapFrame>,
    },
}

struct Placed {
    x: u16,
    y: usize,
    width: u16,
    height: usize,
    what: What,
}

/// Blocks laid out.
pub struct Page {
    placed: Vec<Placed>,
    height: usize,
    /// Where each block begins.
    starts: Vec<usize>,
}

/// A figure is what stands in the second column where there is one.
fn is_figure(block: &Block) -> bool {
    matches!(
        block,
        Block::Table(_) | Block::Plot(_) | Block::Map(_) | Block::Picture { .. }
    )
}

impl Page {
    pub fn new(blocks: &[Block], width: u16, palette: Palette) -> Self {
        let two = width >= TWO_COLUMNS
            && blocks.iter().any(is_figure)
            && !has_pair_for(blocks, width - PROSE - 4);
        let prose = width.min(PROSE);
        let mut page = Self {
            placed: Vec::new(),
            height: 0,
            starts: Vec::new(),
        };
        let mut left = Column {
            x: 0,
            width: prose,
            y: 0,
        };
        let mut right = if two {
            Column {
                x: prose + 4,
                width: width - prose - 4,
                y: 0,
            }
        } else {
            Column {
                x: 0,
                width: width.min(PROSE + 30),
                y: 0,
            }
        };
        let mut index = 0;
        while index < blocks.len() {
            let figures = blocks[index..]
                .iter()
                .take_while(|block| is_figure(block))
                .count();
            if figures == 0 {
                page.starts.push(left.y);
                page.put_prose(&blocks[index], &mut left, palette);
                index += 1;
                continue;
            }
            // In two columns a figure begins no higher than the prose it belongs to.
            let column = if two {
                right.y = right.y.max(left.y.saturating_sub(12));
                &mut right
            } else {
                right.y = left.y;
                &mut right
            };
            for pair in side_by_side(&blocks[index..index + figures], column.width) {
                page.starts.extend(pair.iter().map(|_| column.y));
                page.put_figures(&pair, column, palette);
            }
            if !two {
                left.y = right.y;
            }
            index += figures;
        }
        page.height = left.y.max(if two { right.y } else { 0 }).saturating_sub(1);
        page
    }

    pub fn height(&self) -> usize {
        self.height
    }

    /// Where the block at `index` begins; the page's end for later ones.
    pub fn start_of(&self, index: usize) -> usize {
        self.starts.get(index).copied().unwrap_or(self.height)
    }

    /// The pictures of this page and the sizes wanted.
    pub fn pictures(&self) -> impl Iterator<Item = (&Subject, u16, u16)> {
        self.placed.iter().filter_map(|placed| match &placed.what {
            What::Picture { subject, .. } | What::Map { subject, .. } => {
                let width = match &placed.what {
                    // Its words may be wider.
                    What::Map { .. } => map_size(placed.width).0,
                    _ => placed.width,
                };
                Some((subject, width, placed.height as u16 - picture::AROUND))
            }
            _ => None,
        })
    }

    /// The first fingerprint of the lesson of which something stands in these rows.
    pub fn picture_in(&self, rows: std::ops::Range<usize>) -> Option<&Subject> {
        self.placed.iter().find_map(|placed| match &placed.what {
            What::Picture { subject, .. }
                if subject.kind == Kind::Fingerprint
                    && placed.y < rows.end
                    && placed.y + placed.height > rows.start =>
            {
                Some(subject)
            }
            _ => None,
        })
    }

    /// Draws the rows from `scroll` on into `area`.
    pub fn draw(
        &self,
        scroll: usize,
        pictures: &Pictures,
        palette: Palette,
        area: Rect,
        buffer: &mut Buffer,
    ) {
        let bottom = scroll + area.height as usize;
        for placed in &self.placed {
            if placed.y >= bottom || placed.y + placed.height <= scroll || placed.x >= area.width {
                continue;
            }
            let width = placed.width.min(area.width - placed.x);
            match &placed.what {
                What::Line(line) => {
                    let y = area.y + (placed.y - scroll) as u16;
                    line.render(Rect::new(area.x + placed.x, y, width, 1), buffer);
                }
                What::Plot(view) => {
                    let whole = Rect::new(0, 0, width, placed.height as u16);
                    let mut drawn = Buffer::empty(whole);
                    plot::draw(view, palette, whole, &mut drawn);
                    copy_visible(&drawn, placed, scroll, area, buffer);
                }
                What::Picture { subject, .. } | What::Map { subject, .. } => {
                    let window = Rect {
                        x: area.x + placed.x,
                        width,
                        ..area
                    };
                    let words = match &placed.what {
                        What::Map { frame, .. } => Words::of_map(frame),
                        What::Picture { title, .. } => Words::of_picture(title, subject, width),
                        What::Line(_) | What::Plot(_) => continue,
                    };
                    let offset = placed.y as i32 - scroll as i32;
                    picture::draw(
                        pictures,
                        subject,
                        &words,
                        placed.height as u16,
                        offset,
                        palette,
                        window,
                        buffer,
                    );
                }
            }
        }
    }

    fn put_prose(&mut self, block: &Block, column: &mut Column, palette: Palette) {
        for line in prose(block, column.width as usize, palette) {
            self.put(column, What::Line(line), 1);
        }
        column.y += 1;
    }

    fn put_figures(&mut self, figures: &[&Block], column: &mut Column, palette: Palette) {
        let top = column.y;
        let mut lowest = top;
        let mut x = column.x;
        for (index, figure) in figures.iter().enumerate() {
            let last = index + 1 == figures.len();
            let width = if last {
                column.x + column.width - x
            } else {
                figure_width(figure, column.width)
            };
            let mut slot = Column { x, width, y: top };
            match figure {
                Block::Table(table) => {
                    for line in table_rows(table, width as usize, palette) {
                        self.put(&mut slot, What::Line(line), 1);
                    }
                }
                Block::Plot(view) => {
                    slot.width = width.min(PROSE);
                    let height = plot::height(view, slot.width);
                    self.put(
                        &mut slot,
                        What::Plot(Box::new(view.clone())),
                        height as usize,
                    );
                }
                Block::Map(frame) => {
                    let (_, rows) = map_size(width);
                    let what = What::Map {
                        subject: Subject {
                            lesson: frame.lesson.clone(),
                            id: frame.id.clone(),
                            kind: Kind::Map,
                        },
                        frame: frame.clone(),
                    };
                    self.put(&mut slot, what, usize::from(rows + picture::AROUND));
                    self.put_caption(&frame.caption, &mut slot, palette);
                }
                Block::Picture {
                    lesson,
                    id,
                    title,
                    caption,
                    own,
                } => {
                    let height = picture::height(width) as usize;
                    let what = What::Picture {
                        subject: Subject {
                            lesson: lesson.clone(),
                            id: id.clone(),
                            kind: own.clone().map_or(Kind::Fingerprint, Kind::Own),
                        },
                        title: title.clone(),
                    };
                    self.put(&mut slot, what, height);
                    self.put_caption(caption, &mut slot, palette);
                }
                _ => {}
            }
            lowest = lowest.max(slot.y);
            x += width + 3;
        }
        column.y = lowest + 1;
    }

    fn put_caption(&mut self, caption: &[Inline], slot: &mut Column, palette: Palette) {
        for line in text::wrap(&text::pieces(caption), slot.width.min(PROSE) as usize) {
            self.put(slot, What::Line(styled(line, palette)), 1);
        }
    }

    fn put(&mut self, column: &mut Column, what: What, height: usize) {
        self.placed.push(Placed {
            x: column.x,
            y: column.y,
            width: column.width,
            height,
            what,
        });
        column.y += height;
    }
}

struct Column {
    x: u16,
    width: u16,
    y: usize,
}

/// Copies the rows of a figure that the window shows.
fn copy_visible(drawn: &Buffer, placed: &Placed, scroll: usize, area: Rect, buffer: &mut Buffer) {
    for row in 0..drawn.area.height {
        let y = placed.y + row as usize;
        if y < scroll || y >= scroll + area.height as usize {
            continue;
        }
        for column in 0..drawn.area.width {
            let target = (area.x + placed.x + column, area.y + (y - scroll) as u16);
            if let (Some(to), Some(from)) = (buffer.cell_mut(target), drawn.cell((column, row))) {
                *to = from.clone();
            }
        }
    }
}

/// Whether a table and its plot would stand side by side below the prose, but not in a second
/// column that is `column` wide.
fn has_pair_for(blocks: &[Block], column: u16) -> bool {
    blocks.windows(2).any(|pair| match pair {
        [Block::Table(table), Block::Plot(_)] => table_width(table, column) + 3 + PLOT > column,
        _ => false,
    })
}

/// A table goes beside the plot that follows it (or before it) where both fit.
fn side_by_side(figures: &[Block], width: u16) -> Vec<Vec<&Block>> {
    let mut groups: Vec<Vec<&Block>> = Vec::new();
    for figure in figures {
        let joins = groups
            .last()
            .is_some_and(|group| match (group.as_slice(), figure) {
                ([Block::Table(table)], Block::Plot(_)) => {
                    table_width(table, width) + 3 + PLOT <= width
                }
                _ => false,
            });
        match groups.last_mut() {
            Some(group) if joins => group.push(figure),
            _ => groups.push(vec![figure]),
        }
    }
    groups
}

fn figure_width(figure: &Block, width: u16) -> u16 {
    match figure {
        Block::Table(table) => table_width(table, width),
        _ => width,
    }
}

/// The width of a table: its columns, and a title and note wrapped under them.
fn table_width(table: &TableView, most: u16) -> u16 {
    let columns = text::column_widths(table);
    let cells = columns.iter().sum::<usize>() + 2 * columns.len().saturating_sub(1);
    let words = table.title.width().max(plain(&table.note).width()).min(36);
    (cells.max(words) as u16).min(most)
}

fn styled(pieces: Pieces, palette: Palette) -> Line<'static> {
    pieces
        .into_iter()
        .map(|piece| Span::styled(piece.text, palette.role(piece.role)))
        .collect()
}

fn table_rows(table: &TableView, width: usize, palette: Palette) -> Vec<Line<'static>> {
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
fn prose(block: &Block, width: usize, palette: Palette) -> Vec<Line<'static>> {
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
