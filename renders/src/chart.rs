//! Line charts: laid out once, drawn through plotters as SVG or onto a [`Canvas`].
//!
//! Positions are computed in pixels and handed to the backend in eighths of a pixel, because
//! plotters' coordinates are whole numbers and a curve that is rounded to pixels shows steps.

use crate::axis::{Axis, Tick};
use crate::backend::{CanvasBackend, EIGHTHS};
use crate::canvas::{Align, Canvas, Style, png};
use crate::colour::{LIGHT, Rgb, Theme};
use crate::dots::{Dot, Shape};
use crate::error::Error;
use crate::label::Taken;
use crate::pen::{Frame, Pen, runs};
use crate::text::{self, Weight};
use plotters::coord::Shift;
use plotters::prelude::*;

/// A curve of at most so many points shows them.
const FEW: usize = 16;

/// A figure of curves, in the units of its axes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PlotSpec {
    /// Above the figure.
    pub title: String,
    /// Below the horizontal axis, with its unit.
    pub x_label: String,
    /// Beside the vertical axis, with its unit.
    pub y_label: String,
    /// Logarithmic horizontal axis; values that are not positive are left out.
    pub x_log: bool,
    /// Logarithmic vertical axis; values that are not positive are left out.
    pub y_log: bool,
    /// Lower and upper end of the vertical axis; from the values where left out.
    pub y_ends: (Option<f64>, Option<f64>),
    /// Each curve's name and points; a value that is not finite breaks the curve.
    pub series: Vec<(String, Vec<(f64, f64)>)>,
    /// Points worth a label: the label, x, y.
    pub marks: Vec<(String, f64, f64)>,
    /// Points that are the figure, in place of `marks`; the curves between them are thin.
    pub dots: Vec<Dot>,
    /// What the shapes of the points stand for.
    pub shapes: Vec<(Shape, String)>,
    /// Points that no other beats on both axes, from left to right: stairs are drawn through them.
    pub front: Vec<(f64, f64)>,
}

/// A figure with what only this crate's pictures need beyond [`PlotSpec`].
pub(crate) struct Chart<'a> {
    pub spec: &'a PlotSpec,
    pub theme: &'a Theme,
    pub x_range: Option<(f64, f64)>,
    pub y_range: Option<(f64, f64)>,
    /// Shaded stretches of the horizontal axis, with what they mean.
    pub bands: Vec<(f64, f64, String)>,
    /// Vertical lines, with what they mean.
    pub verticals: Vec<(f64, String)>,
    /// Size of the labels' em in pixels; everything else follows it.
    pub em: f64,
    /// Widths of the curves in ems, from the first on; the last holds for the rest. A wide one
    /// stays visible where a narrow one lies on it.
    pub widths: &'a [f64],
    /// What the marks are, said once in the legend; empty where each has its own label.
    pub marks_are: &'a str,
}

/// A plot as an SVG document of `width` by `height` pixels.
///
/// # Errors
/// Where the picture is too small to hold its labels, or nothing in it can be drawn.
pub fn plot_svg(spec: &PlotSpec, width: u32, height: u32) -> Result<String, Error> {
    let mut document = String::new();
    let eighths = (
        width.saturating_mul(EIGHTHS as u32),
        height.saturating_mul(EIGHTHS as u32),
    );
    {
        let area = SVGBackend::with_string(&mut document, eighths).into_drawing_area();
        page(spec, width, height).draw(&area, f64::from(width), f64::from(height))?;
        area.present().map_err(|e| Error::Plot(e.to_string()))?;
    }
    // The coordinates stay eighths (the viewBox); only the size on the page is in pixels.
    let in_eighths = format!("width=\"{}\" height=\"{}\"", eighths.0, eighths.1);
    let in_pixels = format!("role=\"img\" width=\"{width}\" height=\"{height}\"");
    let document = document.replacen(&in_eighths, &in_pixels, 1);
    let escaped = spec
        .title
        .replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;");
    Ok(document.replacen(">\n", &format!(">\n<title>{escaped}</title>\n"), 1))
}

/// A plot as a PNG file of `width` by `height` pixels.
///
/// # Errors
/// As [`plot_svg`].
pub fn plot_png(spec: &PlotSpec, width: u32, height: u32) -> Result<Vec<u8>, Error> {
    let mut canvas = Canvas::new(width as usize, height as usize, LIGHT.paper);
    page(spec, width, height).on_canvas(
        &mut canvas,
        0.0,
        0.0,
        f64::from(width),
        f64::from(height),
    )?;
    Ok(png(width, height, &canvas.rgba()))
}

/// A plot that stands alone on a page.
fn page(spec: &PlotSpec, width: u32, height: u32) -> Chart<'_> {
    let em = (f64::from(width.min(height * 8 / 5)) / 58.0).clamp(9.0, 40.0);
    Chart {
        spec,
        theme: &LIGHT,
        x_range: None,
        y_range: None,
        bands: Vec::new(),
        verticals: Vec::new(),
        em,
        widths: &[0.17],
        marks_are: "",
    }
}

impl Chart<'_> {
    /// Draws into the rectangle of a canvas that starts at (`left`, `top`).
    pub(crate) fn on_canvas(
        &self,
        canvas: &mut Canvas,
        left: f64,
        top: f64,
        width: f64,
        height: f64,
    ) -> Result<(), Error> {
        let area = CanvasBackend::new(canvas, left, top).into_drawing_area();
        self.draw(&area, width, height)
    }

    fn draw<B: DrawingBackend>(
        &self,
        area: &DrawingArea<B, Shift>,
        width: f64,
        height: f64,
    ) -> Result<(), Error> {
        let em = self.em;
        let finite = || {
            self.spec
                .series
                .iter()
                .flat_map(|(_, points)| points.iter().copied())
        };
        let marks = || {
            let marks = self.spec.marks.iter().map(|mark| (mark.1, mark.2));
            marks.chain(self.spec.dots.iter().map(|dot| dot.at))
        };
        let scatter = !self.spec.dots.is_empty();
        let x_axis = Axis::fit(
            finite().chain(marks()).map(|p| p.0),
            self.spec.x_log,
            self.x_range,
            scatter,
        );
        let y_axis = Axis::fit(
            finite().chain(marks()).map(|p| p.1),
            self.spec.y_log,
            self.y_range,
            true,
        );
        let y_axis = y_axis.and_then(|axis| axis.with_ends(self.spec.y_ends));
        let (Some(x_axis), Some(y_axis)) = (x_axis, y_axis) else {
            return Err(Error::Plot("no value in the plot can be drawn".to_owned()));
        };

        let pen = Pen { area };
        pen.rect(0.0, 0.0, width, height, self.theme.paper, 1.0)?;
        let legend_rows = self.legend_rows(width - 2.0 * em);
        let rows = legend_rows.len() + self.key_rows(width - 2.0 * em);
        let title = if self.spec.title.is_empty() {
            0.0
        } else {
            2.3 * em
        };
        let y_ticks = y_axis.ticks(((height - title) / (3.2 * em)).max(2.0) as usize);
        let tick_width = y_ticks
            .iter()
            .map(|tick| f64::from(text::width(&tick.label, em as f32, Weight::Regular)))
            .fold(0.0, f64::max);
        let y_label = if self.spec.y_label.is_empty() {
            0.0
        } else {
            1.9 * em
        };
        let frame = Frame {
            left: 0.8 * em + y_label + tick_width + 0.6 * em,
            top: 0.9 * em + title + 1.7 * em * rows as f64,
            right: width - 1.4 * em,
            bottom: height
                - 2.1 * em
                - if self.spec.x_label.is_empty() {
                    0.0
                } else {
                    1.7 * em
                },
        };
        if frame.right - frame.left < 4.0 * em || frame.bottom - frame.top < 3.0 * em {
            return Err(Error::Plot(format!(
                "{width} by {height} pixels leave no room for the plot"
            )));
        }
        let x_count = ((frame.right - frame.left) / (7.0 * em)).max(2.0) as usize;
        let x_axis = match self.x_range {
            None if !scatter => x_axis.to_ticks(x_count),
            _ => x_axis,
        };
        let x_ticks = x_axis.ticks(x_count);

        if title > 0.0 {
            let size = 1.3 * em;
            let line = text::shorten(
                &self.spec.title,
                size as f32,
                Weight::Bold,
                (width - 2.0 * em) as f32,
            );
            pen.text(
                em,
                1.7 * em,
                Style::new(size as f32, Weight::Bold, Align::Left, self.theme.ink),
                &line,
            )?;
        }
        self.draw_legend(&pen, &legend_rows, 0.6 * em + title)?;
        let below = 0.6 * em + title + 1.7 * em * legend_rows.len() as f64;
        self.draw_keys(&pen, width - 2.0 * em, below)?;
        self.draw_grid(&pen, frame, (&x_axis, &x_ticks), (&y_axis, &y_ticks))?;
        self.draw_bands(&pen, frame, &x_axis)?;
        let mut taken = Taken::default();
        let axes = (&x_axis, &y_axis);
        if scatter {
            self.draw_front(&pen, frame, axes)?;
            self.draw_threads(&pen, frame, axes, &mut taken)?;
            self.draw_dots(&pen, frame, axes, &mut taken)?;
        }
        let curves = if scatter { &[] } else { &self.spec.series[..] };
        for (index, (_, points)) in curves.iter().enumerate() {
            let colour = self.colour(index);
            let width = self
                .widths
                .get(index)
                .or(self.widths.last())
                .copied()
                .unwrap_or(0.17);
            for run in runs(points, &x_axis, &y_axis, frame) {
                pen.path(&run, width * em, colour, 1.0)?;
                taken.curve(&run, 0.25 * em);
            }
            // So few were measured one by one, and between them nothing is known.
            if points.len() <= FEW {
                for (x, y) in points {
                    if x_axis.holds(*x) && y_axis.holds(*y) {
                        let at = (frame.x(&x_axis, *x), frame.y(&y_axis, *y));
                        pen.disc(at.0, at.1, 1.5 * width * em, colour)?;
                    }
                }
            }
        }
        self.draw_marks(&pen, frame, axes, &mut taken)?;
        let middle = (frame.left + frame.right) / 2.0;
        pen.text(
            middle,
            height - 0.9 * em,
            Style::new(em as f32, Weight::Regular, Align::Centre, self.theme.ink),
            &self.spec.x_label,
        )?;
        pen.text_up(
            1.7 * em,
            (frame.top + frame.bottom) / 2.0,
            Style::new(em as f32, Weight::Regular, Align::Centre, self.theme.ink),
            &self.spec.y_label,
        )
    }

    /// The colour of a curve. One that is called red, green or blue is so.
    pub(crate) fn colour(&self, index: usize) -> Rgb {
        let (first, more) = (&self.theme.series, &self.theme.more);
        let index = match self.spec.series.get(index).map(|(name, _)| name.as_str()) {
            Some("blue") => 0,
            Some("red") => 1,
            Some("green") => 2,
            _ => index % (first.len() + more.len()),
        };
        let colours = first.iter().chain(more);
        colours.copied().nth(index).unwrap_or(self.theme.ink)
    }

    /// The names of the curves, broken into rows of at most `width` pixels.
    fn legend_rows(&self, width: f64) -> Vec<Vec<usize>> {
        let mut rows: Vec<Vec<usize>> = Vec::new();
        let mut used = 0.0;
        for (index, (name, _)) in self.spec.series.iter().enumerate() {
            if name.is_empty() {
                continue;
            }
            let needs = self.legend_width(name);
            match rows.last_mut() {
                Some(row) if used + needs <= width => {
                    row.push(index);
                    used += needs;
                }
                _ => {
                    rows.push(vec![index]);
                    used = needs;
                }
            }
        }
        rows
    }

    fn legend_width(&self, name: &str) -> f64 {
        f64::from(text::width(name, self.em as f32, Weight::Regular)) + 4.2 * self.em
    }

    fn draw_legend<B: DrawingBackend>(
        &self,
        pen: &Pen<'_, B>,
        rows: &[Vec<usize>],
        top: f64,
    ) -> Result<(), Error> {
        let em = self.em;
        for (row_index, row) in rows.iter().enumerate() {
            let y = top + 1.7 * em * row_index as f64 + 1.05 * em;
            let mut x = em;
            for &index in row {
                let colour = self.colour(index);
                pen.path(
                    &[(x, y - 0.36 * em), (x + 1.8 * em, y - 0.36 * em)],
                    0.22 * em,
                    colour,
                    1.0,
                )?;
                let name = &self.spec.series[index].0;
                pen.text(
                    x + 2.3 * em,
                    y,
                    Style::new(em as f32, Weight::Regular, Align::Left, self.theme.ink),
                    name,
                )?;
                x += self.legend_width(name);
            }
            // What the marks are stands after the last curve.
            if row_index + 1 == rows.len()
                && !self.marks_are.is_empty()
                && !self.spec.marks.is_empty()
            {
                pen.disc(x + 0.9 * em, y - 0.36 * em, 0.3 * em, self.theme.ink)?;
                let at = x + 2.3 * em;
                pen.text(
                    at,
                    y,
                    Style::new(em as f32, Weight::Regular, Align::Left, self.theme.ink),
                    self.marks_are,
                )?;
            }
        }
        Ok(())
    }

    fn draw_grid<B: DrawingBackend>(
        &self,
        pen: &Pen<'_, B>,
        frame: Frame,
        (x_axis, x_ticks): (&Axis, &[Tick]),
        (y_axis, y_ticks): (&Axis, &[Tick]),
    ) -> Result<(), Error> {
        let em = self.em;
        let theme = self.theme;
        pen.rect(
            frame.left,
            frame.top,
            frame.right,
            frame.bottom,
            theme.panel,
            1.0,
        )?;
        for tick in y_ticks {
            let y = frame.y(y_axis, tick.at);
            pen.path(
                &[(frame.left, y), (frame.right, y)],
                tick.weight(em),
                theme.grid,
                1.0,
            )?;
            pen.text(
                frame.left - 0.5 * em,
                y + 0.36 * em,
                Style::new(em as f32, Weight::Regular, Align::Right, theme.faint),
                &tick.label,
            )?;
        }
        for tick in x_ticks {
            let x = frame.x(x_axis, tick.at);
            pen.path(
                &[(x, frame.top), (x, frame.bottom)],
                tick.weight(em),
                theme.grid,
                1.0,
            )?;
            pen.text(
                x,
                frame.bottom + 1.35 * em,
                Style::new(em as f32, Weight::Regular, Align::Centre, theme.faint),
                &tick.label,
            )?;
        }
        Ok(())
    }

    fn draw_bands<B: DrawingBackend>(
        &self,
        pen: &Pen<'_, B>,
        frame: Frame,
        x_axis: &Axis,
    ) -> Result<(), Error> {
        let em = self.em;
        for (from, to, says) in &self.bands {
            let (left, right) = (frame.x(x_axis, *from), frame.x(x_axis, *to));
            pen.rect(left, frame.top, right, frame.bottom, self.theme.paper, 0.75)?;
            if right - left > f64::from(text::width(says, em as f32, Weight::Regular)) + em {
                let middle = (frame.top + frame.bottom) / 2.0;
                pen.text(
                    (left + right) / 2.0,
                    middle,
                    Style::new(em as f32, Weight::Regular, Align::Centre, self.theme.faint),
                    says,
                )?;
            }
        }
        for (at, says) in &self.verticals {
            let x = frame.x(x_axis, *at);
            let mut y = frame.top;
            while y < frame.bottom {
                pen.path(
                    &[(x, y), (x, (y + 0.35 * em).min(frame.bottom))],
                    0.09 * em,
                    self.theme.faint,
                    1.0,
                )?;
                y += 0.7 * em;
            }
            pen.text(
                x,
                frame.top - 0.45 * em,
                Style::new(
                    (0.9 * em) as f32,
                    Weight::Regular,
                    Align::Centre,
                    self.theme.faint,
                ),
                says,
            )?;
        }
        Ok(())
    }

    fn draw_marks<B: DrawingBackend>(
        &self,
        pen: &Pen<'_, B>,
        frame: Frame,
        (x_axis, y_axis): (&Axis, &Axis),
        taken: &mut Taken,
    ) -> Result<(), Error> {
        let em = self.em;
        for (label, x, y) in &self.spec.marks {
            if !x_axis.holds(*x) || !y_axis.holds(*y) {
                continue;
            }
            let (x, y) = (frame.x(x_axis, *x), frame.y(y_axis, *y));
            pen.disc(x, y, 0.42 * em, self.theme.panel)?;
            pen.disc(x, y, 0.3 * em, self.theme.ink)?;
            if label.is_empty() {
                continue;
            }
            let width = f64::from(text::width(label, em as f32, Weight::Regular));
            let bounds = (frame.left, frame.top, frame.right, frame.bottom);
            let place = taken.place((x, y), width, em, bounds);
            let style = Style::new(em as f32, Weight::Regular, Align::Left, self.theme.ink);
            pen.text(place.0, place.3 - 0.2 * em, style, label)?;
        }
        Ok(())
    }
}
