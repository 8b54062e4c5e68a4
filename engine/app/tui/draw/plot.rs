//! A plot drawn with characters: axes with round numbers at their exact places, curves in
//! braille and other marks, logarithms where asked.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Color, Style};
use ratatui::symbols::Marker;
use ratatui::text::{Line, Span};
use ratatui::widgets::Widget as _;
use ratatui::widgets::canvas::{Canvas, Line as Stroke};
use tutor::prose::PlotView;
use unicode_width::UnicodeWidthStr as _;

use super::style::Palette;
use crate::text::short;

/// The marks of the curves, so that they are told apart without colours.
const MARKERS: [(Marker, &str); 4] = [
    (Marker::Braille, "⠒⠒"),
    (Marker::Dot, "••"),
    (Marker::HalfBlock, "▀▄"),
    (Marker::Bar, "▄▄"),
];

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

    for (index, (_, points)) in plot.series.iter().enumerate() {
        let marker = MARKERS[index % MARKERS.len()].0;
        let colour = style_of(plot, index, palette).fg.unwrap_or(Color::Reset);
        curve(points, marker, colour, (&x, &y), chart, buffer);
    }
    for (_, at, value) in &plot.marks {
        if let (Some(at), Some(value)) = (x.share(*at), y.share(*value)) {
            let column = (at * f64::from(chart.width - 1)).round() as u16;
            let row = ((1.0 - value) * f64::from(chart.height - 1)).round() as u16;
            buffer.set_string(chart.x + column, chart.y + row, "◆", palette.key());
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

/// A curve as strokes between its neighbouring points.
fn curve(
    points: &[(f64, f64)],
    marker: Marker,
    colour: Color,
    (x, y): (&Scale, &Scale),
    chart: Rect,
    buffer: &mut Buffer,
) {
    let places: Vec<Option<(f64, f64)>> = points
        .iter()
        .map(|(at, value)| Some((x.share(*at)?, y.share(*value)?)))
        .collect();
    Canvas::default()
        .marker(marker)
        .x_bounds([0.0, 1.0])
        .y_bounds([0.0, 1.0])
        .paint(|canvas| {
            for pair in places.windows(2) {
                if let [Some((x1, y1)), Some((x2, y2))] = *pair {
                    canvas.draw(&Stroke::new(x1, y1, x2, y2, colour));
                }
            }
        })
        .render(chart, buffer);
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
        let sign = MARKERS[index % MARKERS.len()].1;
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
        let ticks = (first..=last)
            .step_by(stride)
            .flat_map(|power| within.iter().map(move |step| step * 10f64.powi(power)))
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
        check((0.02, 1.0), false, 5, &["0.2", "0.4", "0.6", "0.8", "1"]);
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
    fn a_value_stands_where_its_number_says() {
        let scale = Scale::of((0.01, 100.0), true, false, 6);
        assert_eq!(scale.share(1.0), Some(0.5));
        assert_eq!(scale.share(0.0), None);
        assert_eq!(scale.share(1000.0), None);
    }
}
