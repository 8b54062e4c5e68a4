//! Places in a chart and the strokes of one: pixels in, plotters' whole numbers out.

use crate::axis::Axis;
use crate::backend::{EIGHTHS, FAMILY};
use crate::canvas::{Align, Style};
use crate::colour::Rgb;
use crate::error::Error;
use crate::text::Weight;
use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

/// The part of the picture between the axes, in pixels.
#[derive(Clone, Copy)]
pub(crate) struct Frame {
    pub left: f64,
    pub top: f64,
    pub right: f64,
    pub bottom: f64,
}

impl Frame {
    pub fn x(self, axis: &Axis, value: f64) -> f64 {
        self.left + axis.share(value) * (self.right - self.left)
    }

    pub fn y(self, axis: &Axis, value: f64) -> f64 {
        self.bottom - axis.share(value) * (self.bottom - self.top)
    }
}

/// A curve as runs of drawable points in pixels, cut where it leaves the frame's top or bottom.
pub(crate) fn runs(
    points: &[(f64, f64)],
    x_axis: &Axis,
    y_axis: &Axis,
    frame: Frame,
) -> Vec<Vec<(f64, f64)>> {
    let mut runs: Vec<Vec<(f64, f64)>> = Vec::new();
    let mut previous: Option<(f64, f64)> = None;
    for &(x, y) in points {
        let (u, v) = (x_axis.share(x), y_axis.share(y));
        let here =
            (u.is_finite() && v.is_finite() && (-1e-9..=1.0 + 1e-9).contains(&u)).then_some((u, v));
        let segment = previous.zip(here).and_then(|(from, to)| clip(from, to));
        if let Some((from, to)) = segment {
            let pixel = |(u, v): (f64, f64)| {
                (
                    frame.left + u * (frame.right - frame.left),
                    frame.bottom - v * (frame.bottom - frame.top),
                )
            };
            let (from, to) = (pixel(from), pixel(to));
            match runs.last_mut() {
                Some(run) if run.last() == Some(&from) => run.push(to),
                _ => runs.push(vec![from, to]),
            }
        }
        previous = here;
    }
    runs
}

/// The part of a segment between the heights 0 and 1.
fn clip(from: (f64, f64), to: (f64, f64)) -> Option<((f64, f64), (f64, f64))> {
    let at = |height: f64| {
        let t = (height - from.1) / (to.1 - from.1);
        (from.0 + t * (to.0 - from.0), height)
    };
    if from.1.max(to.1) < 0.0 || from.1.min(to.1) > 1.0 {
        return None;
    }
    let inside = |point: (f64, f64)| match point.1 {
        v if v < 0.0 => at(0.0),
        v if v > 1.0 => at(1.0),
        _ => point,
    };
    Some((inside(from), inside(to)))
}

/// Draws in pixels on a plotters area that counts in eighths.
pub(crate) struct Pen<'a, B: DrawingBackend> {
    pub area: &'a DrawingArea<B, Shift>,
}

fn eighths(pixels: f64) -> i32 {
    (pixels * EIGHTHS).round() as i32
}

fn rgba(colour: Rgb, opacity: f64) -> RGBAColor {
    RGBColor(colour[0], colour[1], colour[2]).mix(opacity)
}

impl<B: DrawingBackend> Pen<'_, B> {
    fn draw<'e, E>(&self, element: &'e E) -> Result<(), Error>
    where
        E: plotters::element::Drawable<B>,
        &'e E: plotters::element::PointCollection<'e, (i32, i32)>,
    {
        self.area
            .draw(element)
            .map_err(|e| Error::Plot(e.to_string()))
    }

    pub fn rect(
        &self,
        left: f64,
        top: f64,
        right: f64,
        bottom: f64,
        colour: Rgb,
        opacity: f64,
    ) -> Result<(), Error> {
        let corners = [
            (eighths(left), eighths(top)),
            (eighths(right), eighths(bottom)),
        ];
        self.draw(&Rectangle::new(corners, rgba(colour, opacity).filled()))
    }

    pub fn path(
        &self,
        points: &[(f64, f64)],
        width: f64,
        colour: Rgb,
        opacity: f64,
    ) -> Result<(), Error> {
        let points: Vec<(i32, i32)> = points
            .iter()
            .map(|&(x, y)| (eighths(x), eighths(y)))
            .collect();
        let style = rgba(colour, opacity).stroke_width(eighths(width).max(1) as u32);
        self.draw(&PathElement::new(points, style))
    }

    pub fn polygon(&self, corners: &[(f64, f64)], colour: Rgb) -> Result<(), Error> {
        let corners: Vec<(i32, i32)> = corners
            .iter()
            .map(|&(x, y)| (eighths(x), eighths(y)))
            .collect();
        self.draw(&Polygon::new(corners, rgba(colour, 1.0).filled()))
    }

    pub fn disc(&self, x: f64, y: f64, radius: f64, colour: Rgb) -> Result<(), Error> {
        self.draw(&Circle::new(
            (eighths(x), eighths(y)),
            eighths(radius),
            rgba(colour, 1.0).filled(),
        ))
    }

    pub fn text(&self, x: f64, baseline: f64, style: Style, line: &str) -> Result<(), Error> {
        // plotters hangs a text 0.76 em below its top: from the baseline that is upwards.
        let top = baseline - 0.76 * f64::from(style.em);
        self.area
            .draw_text(line, &plotters_style(style), (eighths(x), eighths(top)))
            .map_err(|e| Error::Plot(e.to_string()))
    }

    pub fn text_up(&self, baseline: f64, y: f64, style: Style, line: &str) -> Result<(), Error> {
        let top = baseline - 0.76 * f64::from(style.em);
        let turned = plotters_style(style).transform(FontTransform::Rotate270);
        self.area
            .draw_text(line, &turned, (eighths(top), eighths(y)))
            .map_err(|e| Error::Plot(e.to_string()))
    }
}

fn plotters_style(style: Style) -> TextStyle<'static> {
    let slant = match style.weight {
        Weight::Regular => FontStyle::Normal,
        Weight::Bold => FontStyle::Bold,
    };
    let align = match style.align {
        Align::Left => HPos::Left,
        Align::Centre => HPos::Center,
        Align::Right => HPos::Right,
    };
    TextStyle {
        // plotters divides the size of a font by 1.24 to get the em.
        font: FontDesc::new(
            FontFamily::Name(FAMILY),
            f64::from(style.em) * EIGHTHS * 1.24,
            slant,
        ),
        color: rgba(style.colour, 1.0).to_backend_color(),
        pos: Pos::new(align, VPos::Top),
    }
}
