//! A plot drawn with characters: axes with numbers, curves in braille, logarithms where asked.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::symbols::Marker;
use ratatui::text::{Line, Span};
use ratatui::widgets::{Axis, Chart, Dataset, GraphType, Widget as _};
use tutor::prose::PlotView;

use super::style::Palette;
use crate::text::short;

/// The marks of the curves, so that they are told apart without colours.
const MARKERS: [(Marker, &str); 4] = [
    (Marker::Braille, "⠤⠤"),
    (Marker::Dot, "••"),
    (Marker::HalfBlock, "▀▄"),
    (Marker::Bar, "▄▄"),
];

/// Rows of a plot of that width: the chart, its title and its legend.
pub fn height(plot: &PlotView, width: u16) -> u16 {
    let chart = (width / 4).clamp(10, 22);
    chart + 1 + legend(plot, width as usize, None).len() as u16
}

/// Draws the plot into the whole of `area`.
pub fn draw(plot: &PlotView, palette: Palette, area: Rect, buffer: &mut Buffer) {
    let legend = legend(plot, area.width as usize, Some(palette));
    let below = (legend.len() as u16).min(area.height);
    let chart_area = Rect {
        y: area.y + 1,
        height: area.height.saturating_sub(below + 1),
        ..area
    };
    Line::styled(plot.title.clone(), palette.title()).render(
        Rect {
            height: 1.min(area.height),
            ..area
        },
        buffer,
    );

    let x = Scale::of(plot.x_range, plot.x_log, usize::from(area.width / 14));
    let y = Scale::of(plot.y_range, plot.y_log, usize::from(chart_area.height / 3));
    let curves: Vec<Vec<(f64, f64)>> = plot
        .series
        .iter()
        .map(|(_, points)| x.and(&y, points.iter().copied()))
        .collect();
    let marks = x.and(&y, plot.marks.iter().map(|(_, x, y)| (*x, *y)));

    let mut datasets: Vec<Dataset> = curves
        .iter()
        .enumerate()
        .map(|(index, points)| {
            Dataset::default()
                .marker(MARKERS[index % MARKERS.len()].0)
                .graph_type(GraphType::Line)
                .style(palette.curve(index))
                .data(points)
        })
        .collect();
    datasets.push(
        Dataset::default()
            .marker(Marker::Block)
            .graph_type(GraphType::Scatter)
            .style(palette.key())
            .data(&marks),
    );
    Chart::new(datasets)
        .x_axis(x.axis(&plot.x_label, palette))
        .y_axis(y.axis(&plot.y_label, palette))
        .legend_position(None)
        .render(chart_area, buffer);

    for (row, line) in legend.into_iter().enumerate() {
        let at = chart_area.bottom() + row as u16;
        if at < area.bottom() {
            line.render(
                Rect {
                    y: at,
                    height: 1,
                    ..area
                },
                buffer,
            );
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
            palette.map(|palette| palette.curve(index)),
        )
    });
    let marks = plot.marks.iter().map(|(label, x, y)| {
        (
            "█",
            format!("{label} ({}, {})", short(*x), short(*y)),
            palette.map(Palette::key),
        )
    });
    let mut lines: Vec<Line<'static>> = Vec::new();
    for (sign, label, style) in curves.chain(marks) {
        let entry = [
            Span::styled(sign, style.unwrap_or_default()),
            Span::raw(format!(" {label}")),
        ];
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

/// An axis: where it begins and ends, in its own measure, and its numbers.
struct Scale {
    log: bool,
    from: f64,
    to: f64,
    ticks: Vec<String>,
}

impl Scale {
    fn of((from, to): (f64, f64), log: bool, most_ticks: usize) -> Self {
        let most = most_ticks.clamp(2, 8);
        if log && from > 0.0 && to > from {
            Self::log(from, to, most)
        } else {
            Self::linear(from, to, most)
        }
    }

    /// Whole decades, or every second or third where there are many.
    fn log(from: f64, to: f64, most: usize) -> Self {
        let low = from.log10().floor() as i32;
        let high = (to.log10().ceil() as i32).max(low + 1);
        let stride = ((high - low) as usize).div_ceil(most.max(1)).max(1) as i32;
        let high = low + (high - low + stride - 1) / stride * stride;
        let ticks = (low..=high)
            .step_by(stride as usize)
            .map(|power| short(10f64.powi(power)))
            .collect();
        Self {
            log: true,
            from: f64::from(low),
            to: f64::from(high),
            ticks,
        }
    }

    /// Round numbers that take in the range.
    fn linear(from: f64, to: f64, most: usize) -> Self {
        let span = if to > from { to - from } else { 1.0 };
        let rough = span / most as f64;
        let power = 10f64.powf(rough.log10().floor());
        let step = [1.0, 2.0, 2.5, 5.0, 10.0]
            .map(|factor| factor * power)
            .into_iter()
            .find(|step| *step >= rough * 0.999);
        let step = step.unwrap_or(10.0 * power);
        let low = (from / step + 1e-9).floor() * step;
        let count = (((to - low) / step - 1e-9).ceil() as usize).clamp(1, 20);
        let ticks = (0..=count)
            .map(|index| short(low + step * index as f64))
            .collect();
        Self {
            log: false,
            from: low,
            to: low + step * count as f64,
            ticks,
        }
    }

    fn place(&self, value: f64) -> Option<f64> {
        let place = if self.log {
            (value > 0.0).then(|| value.log10())?
        } else {
            value
        };
        (place.is_finite() && place >= self.from && place <= self.to).then_some(place)
    }

    fn and(&self, other: &Self, points: impl Iterator<Item = (f64, f64)>) -> Vec<(f64, f64)> {
        points
            .filter_map(|(x, y)| Some((self.place(x)?, other.place(y)?)))
            .collect()
    }

    fn axis(&self, label: &str, palette: Palette) -> Axis<'static> {
        let title = if self.log {
            format!("{label} (log)")
        } else {
            label.to_owned()
        };
        Axis::default()
            .title(Line::styled(title, palette.quiet()))
            .style(palette.quiet())
            .bounds([self.from, self.to])
            .labels(self.ticks.clone())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(range: (f64, f64), log: bool, most: usize, ticks: &[&str]) {
        assert_eq!(Scale::of(range, log, most).ticks, ticks);
    }

    #[test]
    fn axes_have_round_numbers() {
        check(
            (0.02, 1.0),
            false,
            5,
            &["0", "0.2", "0.4", "0.6", "0.8", "1"],
        );
        check((0.0, 12.43), false, 4, &["0", "5", "10", "15"]);
        check((0.3, 4.0), true, 4, &["0.1", "1", "10"]);
        check((1e-6, 1.0), true, 3, &["1.0e-6", "1.0e-4", "0.01", "1"]);
        check((1.0, 1.0), false, 4, &["1", "1.25", "1.5", "1.75", "2"]);
    }
}
