//! A plot drawn with characters: axes with round numbers at their exact places, curves in
//! braille, each with dashes of its own, logarithms where asked.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;
use ratatui::text::{Line, Span};
use ratatui::widgets::Widget as _;
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
    let y = Scale::of(
        plot.y_range,
        plot.y_log,
        plot.y_label.contains("degrees"),
        usize::from(chart_rows / 3),
    );
    let gutter = y
        .ticks
        .iter()
        .map(|(_, label)| label.width())
        .max()
        .unwrap_or(1) as u16;
    let chart = Rect {
        x: area.x + gutter + 1,
        y: area.y + 2,
        width: area.width - gutter - 2,
        height: chart_rows,
    };
    let x = Scale::of(
        plot.x_range,
        plot.x_log,
        plot.x_label.contains("degrees"),
        usize::from(chart.width / 10),
    );
    draw_axes(&x, &y, palette, chart, buffer);
    let named = |label: &str, log: bool| format!("{label}{}", if log { " (log)" } else { "" });
    let y_label = Line::styled(named(&plot.y_label, plot.y_log), palette.quiet());
    y_label.render(row(area.y + 1), buffer);
    let x_label = Line::styled(named(&plot.x_label, plot.x_log), palette.quiet());
    x_label
        .right_aligned()
        .render(row(chart.bottom() + 2), buffer);

    draw_curves(plot, palette, (&x, &y), chart, buffer);
    for (_, at, value) in &plot.marks {
        if let (Some(at), Some(value)) = (x.share(*at), y.share(*value)) {
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
    (x, y): (&Scale, &Scale),
    chart: Rect,
    buffer: &mut Buffer,
) {
    let mut dots = Dots::new(chart);
    let place = |(at, value): &(f64, f64)| Some((x.share(*at)?, y.share(*value)?));
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
fn draw_axes(x: &Scale, y: &Scale, palette: Palette, chart: Rect, buffer: &mut Buffer) {
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
    for (share, label) in &y.ticks {
        let row = chart.y + ((1.0 - share) * f64::from(chart.height - 1)).round() as u16;
        buffer.set_string(chart.x - 1, row, "┤", style);
        buffer.set_string(chart.x - 1 - label.width() as u16, row, label, style);
    }
    let mut free_from = 0;
    for (share, label) in &x.ticks {
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

/// An axis: where it begins and ends, in its own measure, and its numbers with their places.
struct Scale {
    log: bool,
    from: f64,
    to: f64,
    ticks: Vec<(f64, String)>,
}

impl Scale {
    fn of((from, to): (f64, f64), log: bool, degrees: bool, most_ticks: usize) -> Self {
        let most = most_ticks.clamp(2, 8);
        if log && from > 0.0 && to > from {
            Self::log(from, to, most)
        } else {
            Self::linear(from, to, degrees, most)
        }
    }

    /// Whole decades, or every second or third where there are many; 2 and 5 where there is
    /// hardly a decade.
    fn log(from: f64, to: f64, most: usize) -> Self {
        let (low, high) = (from.log10(), to.log10());
        let (first, last) = (low.floor() as i32, high.ceil() as i32);
        let stride = ((high - low) as usize / most.max(1)).max(1);
        let within: &[f64] = if high - low < 2.0 {
            &[1.0, 2.0, 5.0]
        } else {
            &[1.0]
        };
        let span = (high - low).max(f64::MIN_POSITIVE);
        let decades = (first..=last)
            .step_by(stride)
            .flat_map(|power| within.iter().map(move |step| step * 10f64.powi(power)));
        let ticks = doublings(from, to, most).unwrap_or_else(|| decades.collect());
        let ticks = ticks
            .into_iter()
            .map(|value| ((value.log10() - low) / span, short(value)))
            .filter(|(share, _)| (-1e-9..=1.0 + 1e-9).contains(share))
            .collect();
        Self {
            log: true,
            from: low,
            to: high,
            ticks,
        }
    }

    /// Round numbers within the range; parts of a right angle where degrees are meant.
    fn linear(from: f64, to: f64, degrees: bool, most: usize) -> Self {
        let to = if to > from { to } else { from + 1.0 };
        let span = to - from;
        let rough = span / most as f64;
        let power = 10f64.powf(rough.log10().floor());
        let enough = |step: &f64| *step >= rough * 0.999;
        let angle = [5.0, 10.0, 15.0, 30.0, 45.0, 90.0].into_iter().find(enough);
        let step = [1.0, 2.0, 2.5, 5.0]
            .map(|factor| factor * power)
            .into_iter()
            .find(enough)
            .unwrap_or(10.0 * power);
        let step = angle.filter(|_| degrees && rough > 2.0).unwrap_or(step);
        // A tick that lies just beyond an end becomes the end.
        let near = |end: f64, tick: f64| match (end - tick).abs() < 0.025 * span {
            true => tick,
            false => end,
        };
        let from = near(from, (from / step).floor() * step);
        let to = near(to, (to / step).ceil() * step);
        let span = to - from;
        let first = (from / step - 1e-9).ceil() as i64;
        let last = (to / step + 1e-9).floor() as i64;
        let ticks = (first..=last.min(first + 20))
            .map(|index| index as f64 * step)
            .map(|value| ((value - from) / span, short(value)))
            .collect();
        Self {
            log: false,
            from,
            to,
            ticks,
        }
    }

    /// How far along the axis a value is, from 0 to 1.
    fn share(&self, value: f64) -> Option<f64> {
        if self.log && value <= 0.0 {
            return None;
        }
        let place = if self.log { value.log10() } else { value };
        let share = (place - self.from) / (self.to - self.from);
        (-1e-9..=1.0 + 1e-9)
            .contains(&share)
            .then(|| share.clamp(0.0, 1.0))
    }
}

/// Powers of two, where both ends are: such are the sizes of pictures.
fn doublings(from: f64, to: f64, most: usize) -> Option<Vec<f64>> {
    let power = |end: f64| {
        let exponent = end.log2().round();
        (exponent.exp2() == end && (1.0..=20.0).contains(&exponent)).then_some(exponent as i32)
    };
    let (first, last) = (power(from)?, power(to)?);
    let every = (last.abs_diff(first) as usize).div_ceil(most).max(1);
    let powers = (first..=last).step_by(every);
    Some(powers.map(|power| f64::from(power).exp2()).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(range: (f64, f64), log: bool, most: usize, ticks: &[&str]) {
        check_scale(&Scale::of(range, log, false, most), ticks);
    }

    #[track_caller]
    fn check_scale(scale: &Scale, ticks: &[&str]) {
        let labels: Vec<&str> = scale
            .ticks
            .iter()
            .map(|(_, label)| label.as_str())
            .collect();
        assert_eq!(labels, ticks);
    }

    #[test]
    fn axes_have_round_numbers() {
        check((0.1, 1.0), false, 5, &["0.2", "0.4", "0.6", "0.8", "1"]);
        check(
            (0.02, 0.98),
            false,
            5,
            &["0", "0.2", "0.4", "0.6", "0.8", "1"],
        );
        check((32.0, 512.0), true, 8, &["32", "64", "128", "256", "512"]);
        check((32.0, 512.0), true, 3, &["32", "128", "512"]);
        check((0.0, 12.43), false, 4, &["0", "5", "10"]);
        check(
            (-60.0, 90.0),
            false,
            6,
            &["-50", "-25", "0", "25", "50", "75"],
        );
        check((0.3, 4.0), true, 4, &["0.5", "1", "2"]);
        check(
            (0.01, 1000.0),
            true,
            6,
            &["0.01", "0.1", "1", "10", "100", "1000"],
        );
        check((1.0, 1.0), false, 4, &["1", "1.25", "1.5", "1.75", "2"]);
    }

    #[test]
    fn degrees_are_parts_of_a_right_angle() {
        let degrees = |to: f64, most: usize| Scale::of((0.0, to), false, true, most);
        check_scale(&degrees(90.0, 2), &["0", "45", "90"]);
        check_scale(&degrees(90.0, 5), &["0", "30", "60", "90"]);
        check_scale(&degrees(4.0, 4), &["0", "1", "2", "3", "4"]);
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
        let scale = Scale::of((0.01, 100.0), true, false, 6);
        assert_eq!(scale.share(1.0), Some(0.5));
        assert_eq!(scale.share(0.0), None);
        assert_eq!(scale.share(1000.0), None);
    }
}
