//! A plot drawn with characters: axes with round numbers at their exact places, curves in
//! braille, each with dashes of its own, logarithms where asked.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;
use ratatui::text::{Line, Span};
use ratatui::widgets::Widget as _;
use renders::Axis;
use tutor::prose::PlotView;
use unicode_width::UnicodeWidthStr as _;

use super::style::Palette;
use crate::text::short;

/// The dashes of the curves, so that they are told apart without colours: which dots of a run are
/// drawn, and what that looks like.
const DASHES: [(&[bool], &str); 4] = [
    (&[true], "⠒⠒⠒⠒"),
    (&[true, true, true, true, false, false], "⠒⠒ ⠒⠒"),
    (&[true, false], "⠂⠂⠂⠂"),
    (
        &[true, true, true, true, false, false, true, false, false],
        "⠒⠒ ⠂ ⠒⠒",
    ),
];

/// A curve of at most so many points was measured at each, and shows them.
const FEW: usize = 16;

/// Rows of a plot of that width: title, vertical label, chart, numbers, horizontal label, legend.
pub fn height(plot: &PlotView, width: u16) -> u16 {
    let chart = (width / 5).clamp(9, 20);
    chart + 5 + legend(plot, width as usize, None).len() as u16
}

/// Draws the plot into the whole of `area`.
pub fn draw(plot: &PlotView, palette: Palette, area: Rect, buffer: &mut Buffer) {
    let legend = legend(plot, area.width as usize, Some(palette));
    let below = legend.len() as u16 + 3;
    if area.height < below + 5 || area.width < 20 {
        return;
    }
    let row = |y: u16| Rect {
        y,
        height: 1,
        ..area
    };
    Line::styled(plot.title.clone(), palette.title()).render(row(area.y), buffer);

    let chart_rows = area.height - below - 2;
    let most = |cells: u16, each: u16| usize::from(cells / each).clamp(2, 8);
    let most_y = most(chart_rows, 3);
    let Some(y) = axis(plot.y_range, plot.y_log, most_y) else {
        return;
    };
    let y_numbers = numbers(&y, most_y);
    let widths = y_numbers.iter().map(|(_, label)| label.width());
    let gutter = widths.max().unwrap_or(1) as u16;
    let chart = Rect {
        x: area.x + gutter + 1,
        y: area.y + 2,
        width: area.width - gutter - 2,
        height: chart_rows,
    };
    let most_x = most(chart.width, 10);
    let Some(x) = axis(plot.x_range, plot.x_log, most_x) else {
        return;
    };
    draw_axes(&numbers(&x, most_x), &y_numbers, palette, chart, buffer);
    let named = |label: &str, log: bool| format!("{label}{}", if log { " (log)" } else { "" });
    let y_label = Line::styled(named(&plot.y_label, plot.y_log), palette.quiet());
    y_label.render(row(area.y + 1), buffer);
    let x_label = Line::styled(named(&plot.x_label, plot.x_log), palette.quiet());
    x_label
        .right_aligned()
        .render(row(chart.bottom() + 2), buffer);

    draw_curves(plot, palette, (&x, &y), chart, buffer);
    for (_, at, value) in &plot.marks {
        if let (Some(at), Some(value)) = (share(&x, *at), share(&y, *value)) {
            let (column, row) = cell_of(chart, at, value);
            buffer.set_string(column, row, "◆", palette.key());
        }
    }
    for (index, line) in legend.into_iter().enumerate() {
        line.render(row(chart.bottom() + 3 + index as u16), buffer);
    }
}

/// The style of a curve. One that is called red, green or blue is so.
fn style_of(plot: &PlotView, index: usize, palette: Palette) -> Style {
    match plot.series.get(index) {
        Some((name, _)) => palette.named_curve(name, index),
        None => palette.curve(index),
    }
}

/// The dots of the curves, eight to a cell, and which curve drew there last.
struct Dots {
    columns: usize,
    rows: usize,
    cells: Vec<(u8, usize)>,
}

impl Dots {
    fn new(chart: Rect) -> Self {
        let (columns, rows) = (usize::from(chart.width), usize::from(chart.height));
        let cells = vec![(0, 0); columns * rows];
        Self {
            columns,
            rows,
            cells,
        }
    }

    /// The dot of a place, both from 0 to 1, the second from the bottom.
    fn at(&self, (x, y): (f64, f64)) -> (f64, f64) {
        let most = |cells: usize, dots: usize| (cells * dots) as f64 - 1.0;
        (x * most(self.columns, 2), (1.0 - y) * most(self.rows, 4))
    }

    fn set(&mut self, x: usize, y: usize, curve: usize) {
        // As Unicode numbers them: three down on the left, three on the right, then the lowest.
        const BITS: [[u8; 2]; 4] = [[0x01, 0x08], [0x02, 0x10], [0x04, 0x20], [0x40, 0x80]];
        if let Some(cell) = self.cells.get_mut(y / 4 * self.columns + x / 2) {
            *cell = (cell.0 | BITS[y % 4][x % 2], curve);
        }
    }

    /// Strokes between neighbouring places, broken where there is none.
    fn curve(&mut self, places: &[Option<(f64, f64)>], curve: usize) {
        let dashes = DASHES[curve % DASHES.len()].0;
        let mut walked = 0;
        let mut last = None;
        for pair in places.windows(2) {
            let [Some(from), Some(to)] = [pair[0], pair[1]] else {
                continue;
            };
            let (from, to) = (self.at(from), self.at(to));
            let (across, down) = (to.0 - from.0, to.1 - from.1);
            let steps = across.abs().max(down.abs()).ceil().max(1.0);
            for step in 0..=steps as usize {
                let share = step as f64 / steps;
                let [x, y] = [from.0 + share * across, from.1 + share * down].map(f64::round);
                let dot = (x as usize, y as usize);
                if last.replace(dot) == Some(dot) {
                    continue;
                }
                if dashes[walked % dashes.len()] {
                    self.set(dot.0, dot.1, curve);
                }
                walked += 1;
            }
        }
    }
}

/// All curves. Where two share a cell both have their dots in it.
fn draw_curves(
    plot: &PlotView,
    palette: Palette,
    (x, y): (&Axis, &Axis),
    chart: Rect,
    buffer: &mut Buffer,
) {
    let mut dots = Dots::new(chart);
    let place = |(at, value): &(f64, f64)| Some((share(x, *at)?, share(y, *value)?));
    for (index, (_, points)) in plot.series.iter().enumerate() {
        let places: Vec<_> = points.iter().map(place).collect();
        dots.curve(&places, index);
    }
    for (row, cells) in dots.cells.chunks(dots.columns.max(1)).enumerate() {
        for (column, &(bits, curve)) in cells.iter().enumerate().filter(|(_, cell)| cell.0 != 0) {
            let letter = char::from_u32(0x2800 + u32::from(bits)).unwrap_or(' ');
            let at = (chart.x + column as u16, chart.y + row as u16);
            buffer.set_string(
                at.0,
                at.1,
                letter.to_string(),
                style_of(plot, curve, palette),
            );
        }
    }
    for (index, (_, points)) in plot.series.iter().enumerate() {
        let few = points.iter().filter(|_| points.len() <= FEW);
        for (at, value) in few.filter_map(place) {
            let (column, row) = cell_of(chart, at, value);
            buffer.set_string(column, row, "•", style_of(plot, index, palette));
        }
    }
}

/// The cell of a place, both from 0 to 1, the second from the bottom.
fn cell_of(chart: Rect, x: f64, y: f64) -> (u16, u16) {
    let cell = |share: f64, cells: u16| (share * f64::from(cells - 1)).round() as u16;
    (
        chart.x + cell(x, chart.width),
        chart.y + cell(1.0 - y, chart.height),
    )
}

/// The two axes, their ticks and numbers, around the chart.
fn draw_axes(
    x: &[(f64, String)],
    y: &[(f64, String)],
    palette: Palette,
    chart: Rect,
    buffer: &mut Buffer,
) {
    let style = palette.quiet();
    for row in chart.y..chart.bottom() {
        buffer.set_string(chart.x - 1, row, "│", style);
    }
    buffer.set_string(
        chart.x - 1,
        chart.bottom(),
        format!("└{}", "─".repeat(chart.width as usize)),
        style,
    );
    for (share, label) in y {
        let row = chart.y + ((1.0 - share) * f64::from(chart.height - 1)).round() as u16;
        buffer.set_string(chart.x - 1, row, "┤", style);
        buffer.set_string(chart.x - 1 - label.width() as u16, row, label, style);
    }
    let mut free_from = 0;
    for (share, label) in x {
        let column = chart.x + (share * f64::from(chart.width - 1)).round() as u16;
        buffer.set_string(column, chart.bottom(), "┴", style);
        let width = label.width() as u16;
        let start = (column.saturating_sub(width / 2)).min(chart.right() + 1 - width);
        if start >= free_from {
            buffer.set_string(start, chart.bottom() + 1, label, style);
            free_from = start + width + 1;
        }
    }
}

/// What the curves and marks are, as many to a line as fit.
fn legend(plot: &PlotView, width: usize, palette: Option<Palette>) -> Vec<Line<'static>> {
    let curves = plot.series.iter().enumerate().map(|(index, (label, _))| {
        let sign = DASHES[index % DASHES.len()].1;
        (
            sign,
            label.clone(),
            palette.map(|palette| style_of(plot, index, palette)),
        )
    });
    let marks = plot.marks.iter().map(|(label, x, y)| {
        let says = format!("{label} ({}, {})", short(*x), short(*y));
        ("◆", says, palette.map(Palette::key))
    });
    let mut lines: Vec<Line<'static>> = Vec::new();
    for (sign, label, style) in curves.chain(marks) {
        let sign = Span::styled(sign, style.unwrap_or_default());
        let entry = [sign, Span::raw(format!(" {label}"))];
        let entry_width: usize = entry.iter().map(Span::width).sum();
        match lines.last_mut() {
            Some(line) if line.width() + 3 + entry_width <= width => {
                line.push_span(Span::raw("   "));
                entry.into_iter().for_each(|span| line.push_span(span));
            }
            _ => lines.push(Line::from(entry.to_vec())),
        }
    }
    lines
}

/// An axis with at most so many numbers, which reaches those that are near its ends; a linear one
/// where a logarithmic one cannot be.
fn axis(range: (f64, f64), log: bool, most: usize) -> Option<Axis> {
    let axis = Axis::over(range, log).or_else(|| Axis::over(range, false));
    axis.map(|axis| axis.to_ticks(most))
}

/// The numbers of an axis, and how far along it each stands, from 0 to 1.
fn numbers(axis: &Axis, most: usize) -> Vec<(f64, String)> {
    let ticks = axis.ticks(most).into_iter();
    let labelled = ticks.filter(|tick| !tick.label.is_empty());
    labelled
        .map(|tick| (axis.share(tick.at), tick.label))
        .collect()
}

/// How far along an axis a value stands, where it does.
fn share(axis: &Axis, value: f64) -> Option<f64> {
    axis.holds(value).then(|| axis.share(value).clamp(0.0, 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(range: (f64, f64), log: bool, most: usize, expected: &[&str]) {
        let axis = axis(range, log, most).expect("a range");
        let numbers = numbers(&axis, most);
        let labels: Vec<&str> = numbers.iter().map(|(_, label)| label.as_str()).collect();
        assert_eq!(labels, expected);
    }

    #[test]
    fn axes_have_round_numbers() {
        let tenths = &["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"];
        check((0.1, 1.0), false, 5, &tenths[1..]);
        check((0.02, 0.98), false, 5, tenths);
        check((0.0, 12.43), false, 4, &["0", "5", "10"]);
        check((0.3, 4.0), true, 4, &["0.5", "1", "2"]);
        check((32.0, 512.0), true, 3, &["32", "128", "512"]);
        check((0.0, 90.0), false, 5, &["0", "30", "60", "90"]);
        // What no logarithm is of stands on a linear axis.
        check((0.0, 1.0), true, 5, tenths);
    }

    #[test]
    fn curves_keep_their_dots_and_their_dashes() {
        let mut dots = Dots::new(Rect::new(0, 0, 6, 2));
        dots.curve(&[Some((0.0, 1.0)), Some((1.0, 1.0))], 0);
        assert_eq!(dots.cells[..6], [(0x09, 0); 6]);
        // Four dots, then none for two; what another curve drew stays.
        dots.curve(&[Some((0.0, 6.0 / 7.0)), Some((1.0, 6.0 / 7.0))], 1);
        let both = |curve| (0x1b, curve);
        let expected = [both(1), both(1), (0x09, 0)].repeat(2);
        assert_eq!(dots.cells[..6], expected);
        dots.curve(&[Some((0.0, 0.0)), None, Some((1.0, 0.0))], 2);
        assert_eq!(dots.cells[6..], [(0, 0); 6], "nothing across a gap");
    }

    #[test]
    fn a_value_stands_where_its_number_says() {
        let axis = axis((0.01, 100.0), true, 6).expect("a range");
        assert!(share(&axis, 1.0).is_some_and(|share| (share - 0.5).abs() < 1e-12));
        assert_eq!(share(&axis, 0.0), None);
        assert_eq!(share(&axis, 1000.0), None);
    }
}
