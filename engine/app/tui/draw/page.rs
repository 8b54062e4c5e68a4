//! A page: blocks laid out for a width, of which a window is drawn.
//!
//! Laying out is done once for a view and a width; scrolling only moves the window.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::Line;
use ratatui::widgets::Widget as _;
use tutor::map::MapFrame;
use tutor::prose::{Block, Inline, PlotView, TableView, plain};
use unicode_width::UnicodeWidthStr as _;

use super::picture::{self, Words};
use super::plot;
use super::prose::{prose, styled, table_rows};
use super::style::Palette;
use crate::fingerprints::{Kind, Subject};
use crate::text;
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

    /// The block that a line belongs to, and which of its lines that is.
    pub fn block_at(&self, line: usize) -> (usize, usize) {
        let next = self.starts.partition_point(|start| *start <= line);
        let index = next.saturating_sub(1);
        (index, line.saturating_sub(self.start_of(index)))
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
