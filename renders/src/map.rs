//! Maps: a value over two quantities, as colours with a labelled bar. For albedos over cosine
//! and roughness (furnace tests), and for slices through a BRDF.

use crate::axis::{Axis, Tick};
use crate::canvas::{Align, Canvas, Style, png};
use crate::colour::{DivergingTable, LIGHT, RATIO_STOPS, Rgb, mix};
use crate::error::Error;
use crate::text::{self, Weight};

/// What the colours of a map mean.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Scale {
    /// From dark to bright over this range, linearly; lower and higher values look like its ends.
    Linear(f64, f64),
    /// From dark to bright over this range, by factors.
    Log(f64, f64),
    /// A ratio: blue below 1, white at 1, orange above, by factors of two up to eight.
    Ratio,
}

/// A value over two quantities.
#[derive(Clone, Debug, PartialEq)]
pub struct MapSpec {
    /// Above the figure.
    pub title: String,
    /// Below the horizontal axis.
    pub x_label: String,
    /// Beside the vertical axis.
    pub y_label: String,
    /// Beside the bar of colours: what the value is.
    pub value_label: String,
    /// Ends of the horizontal axis.
    pub x: (f64, f64),
    /// Ends of the vertical axis, bottom and top.
    pub y: (f64, f64),
    /// Number of columns.
    pub columns: usize,
    /// Values by rows from the **bottom**, each from left to right; NaN is left blank.
    pub values: Vec<f64>,
    /// What the colours mean.
    pub scale: Scale,
}

impl Scale {
    /// The stretch of the bar on which a value stands, 0 to 1.
    fn share(self, value: f64) -> f64 {
        match self {
            Self::Linear(low, high) => (value - low) / (high - low),
            Self::Log(low, high) => (value / low).ln() / (high / low).ln(),
            Self::Ratio => (value.log2() / RATIO_STOPS + 1.0) / 2.0,
        }
    }

    fn colour(self, share: f64, ratio: &DivergingTable) -> Rgb {
        match self {
            Self::Ratio => ratio.colour(((2.0 * share - 1.0) * RATIO_STOPS) as f32),
            Self::Linear(..) | Self::Log(..) => sequential(share),
        }
    }

    /// The ends of the bar.
    fn ends(self) -> (f64, f64) {
        match self {
            Self::Linear(low, high) | Self::Log(low, high) => (low, high),
            Self::Ratio => ((-RATIO_STOPS).exp2(), RATIO_STOPS.exp2()),
        }
    }

    /// Ticks of the bar for these values: where there are some beyond an end, it says so.
    fn ticks_for(self, values: &[f64], count: usize) -> Vec<Tick> {
        let (low, high) = self.ends();
        let near = |a: f64, b: f64| (a - b).abs() < 1e-9 * b.abs();
        let mut ticks = self.ticks(count);
        for tick in &mut ticks {
            if near(tick.at, high) && values.iter().any(|value| *value > high) {
                tick.label.insert_str(0, "≥ ");
            }
            if near(tick.at, low) && values.iter().any(|value| *value < low) {
                tick.label.insert_str(0, "≤ ");
            }
        }
        ticks
    }

    fn ticks(self, count: usize) -> Vec<Tick> {
        let axis = |low, high, log| Axis::over((low, high), log);
        match self {
            Self::Linear(low, high) => axis(low, high, false),
            Self::Log(low, high) => axis(low, high, true),
            Self::Ratio => {
                let stops = RATIO_STOPS as i32;
                let label = |stop: i32| match stop {
                    0 => "1".to_owned(),
                    _ if stop < 0 => format!("1/{}", 1 << -stop),
                    _ => format!("{}", 1 << stop),
                };
                return (-stops..=stops)
                    .map(|stop| Tick {
                        at: f64::from(stop).exp2(),
                        label: label(stop),
                    })
                    .collect();
            }
        }
        .map(|axis| axis.ticks(count))
        .unwrap_or_default()
    }
}

/// Dark blue over green to pale yellow: lightness rises evenly, and no two of its colours are
/// confused under the common kinds of colour blindness (after viridis).
fn sequential(share: f64) -> Rgb {
    const STOPS: [Rgb; 7] = [
        [48, 18, 74],
        [59, 66, 134],
        [44, 113, 142],
        [32, 158, 136],
        [88, 199, 101],
        [180, 222, 44],
        [253, 231, 106],
    ];
    let at = if share.is_nan() {
        0.0
    } else {
        share.clamp(0.0, 1.0)
    } * (STOPS.len() - 1) as f64;
    let low = (at as usize).min(STOPS.len() - 2);
    mix(STOPS[low], STOPS[low + 1], at - low as f64)
}

/// How many rows the values fill.
fn rows(spec: &MapSpec) -> Result<usize, Error> {
    let rows = spec.values.len() / spec.columns.max(1);
    if rows == 0 || rows * spec.columns != spec.values.len() {
        return Err(Error::Plot(format!(
            "{} values do not fill rows of {}",
            spec.values.len(),
            spec.columns
        )));
    }
    Ok(rows)
}

/// The colours of a map alone, without a word: red, green, blue, alpha of every pixel, from the
/// top. Where there is no value it is transparent.
///
/// # Errors
/// Where the values do not fill whole rows.
pub fn map_pixels(spec: &MapSpec, width: u32, height: u32) -> Result<Vec<u8>, Error> {
    let rows = rows(spec)?;
    let ratio = DivergingTable::new();
    let share = |at: u32, of: u32| (f64::from(at) + 0.5) / f64::from(of);
    let mut rgba = Vec::with_capacity(4 * width as usize * height as usize);
    for row in 0..height {
        for column in 0..width {
            let value = sample(spec, rows, share(column, width), 1.0 - share(row, height));
            rgba.extend(value.map_or([0; 4], |value| {
                let [red, green, blue] = spec.scale.colour(spec.scale.share(value), &ratio);
                [red, green, blue, 255]
            }));
        }
    }
    Ok(rgba)
}

/// A map as a PNG file of `width` by `height` pixels.
///
/// # Errors
/// Where the picture is too small for its labels, or the values do not fill whole rows.
pub fn map_png(spec: &MapSpec, width: u32, height: u32) -> Result<Vec<u8>, Error> {
    let rows = rows(spec)?;
    let axes = [spec.x, spec.y].map(|range| Axis::over(range, false));
    let [Some(x_axis), Some(y_axis)] = axes else {
        return Err(Error::Plot("an axis of the map has no range".to_owned()));
    };
    let mut canvas = Canvas::new(width as usize, height as usize, LIGHT.paper);
    let (w, h) = (width as f32, height as f32);
    let em = (w.min(h * 1.6) / 58.0).clamp(9.0, 40.0);
    let y_ticks = y_axis.ticks((h / (4.0 * em)) as usize);
    let value_ticks = spec
        .scale
        .ticks_for(&spec.values, (h / (4.0 * em)) as usize);
    let widest = |ticks: &[Tick]| {
        ticks
            .iter()
            .map(|tick| text::width(&tick.label, em, Weight::Regular))
            .fold(0.0, f32::max)
    };
    let left = 3.3 * em + widest(&y_ticks);
    let right = (w - 6.2 * em - widest(&value_ticks)).round();
    let left = left.round();
    let (top, bottom) = ((3.4 * em).round(), (h - 3.8 * em).round());
    if right - left < 6.0 * em || bottom - top < 6.0 * em {
        return Err(Error::Plot(format!(
            "{width} by {height} pixels leave no room for the map"
        )));
    }

    let ratio = DivergingTable::new();
    let bar = (right + 1.5 * em, 1.4 * em);
    for row in top as i32..bottom as i32 {
        let up = 1.0 - (f64::from(row) + 0.5 - f64::from(top)) / f64::from(bottom - top);
        for column in left as i32..right as i32 {
            let across = (f64::from(column) + 0.5 - f64::from(left)) / f64::from(right - left);
            if let Some(value) = sample(spec, rows, across, up) {
                canvas.set(
                    column,
                    row,
                    spec.scale.colour(spec.scale.share(value), &ratio),
                );
            }
        }
        canvas.rect(
            bar.0,
            row as f32,
            bar.1,
            1.0,
            spec.scale.colour(up, &ratio),
            1.0,
        );
    }

    let style = |align, colour| Style::new(em, Weight::Regular, align, colour);
    let frame = [
        (left, top),
        (right, top),
        (right, bottom),
        (left, bottom),
        (left, top),
    ];
    canvas.stroke(&frame, 1.0, LIGHT.faint, 1.0);
    for tick in x_axis.ticks(((right - left) / (7.0 * em)) as usize) {
        let x = left + x_axis.share(tick.at) as f32 * (right - left);
        canvas.stroke(
            &[(x, bottom), (x, bottom + 0.4 * em)],
            1.0,
            LIGHT.faint,
            1.0,
        );
        canvas.text(
            x,
            bottom + 1.55 * em,
            style(Align::Centre, LIGHT.faint),
            &tick.label,
        );
    }
    for tick in y_ticks {
        let y = bottom - y_axis.share(tick.at) as f32 * (bottom - top);
        canvas.stroke(&[(left - 0.4 * em, y), (left, y)], 1.0, LIGHT.faint, 1.0);
        canvas.text(
            left - 0.7 * em,
            y + 0.36 * em,
            style(Align::Right, LIGHT.faint),
            &tick.label,
        );
    }
    for tick in value_ticks.iter().filter(|tick| !tick.label.is_empty()) {
        let y = bottom - spec.scale.share(tick.at) as f32 * (bottom - top);
        let end = bar.0 + bar.1;
        canvas.stroke(&[(end, y), (end + 0.4 * em, y)], 1.0, LIGHT.faint, 1.0);
        canvas.text(
            end + 0.7 * em,
            y + 0.36 * em,
            style(Align::Left, LIGHT.faint),
            &tick.label,
        );
    }
    let title = Style::new(1.3 * em, Weight::Bold, Align::Left, LIGHT.ink);
    let shortened = text::shorten(&spec.title, 1.3 * em, Weight::Bold, w - 2.0 * em);
    canvas.text(em, 2.0 * em, title, &shortened);
    canvas.text(
        (left + right) / 2.0,
        h - 0.9 * em,
        style(Align::Centre, LIGHT.ink),
        &spec.x_label,
    );
    let middle = (top + bottom) / 2.0;
    canvas.text_up(
        1.8 * em,
        middle,
        style(Align::Centre, LIGHT.ink),
        &spec.y_label,
    );
    canvas.text_up(
        w - 0.8 * em,
        middle,
        style(Align::Centre, LIGHT.ink),
        &spec.value_label,
    );
    Ok(png(width, height, &canvas.rgba()))
}

/// The value at shares (`across`, `up`) of the map, between the four values around it; the
/// nearest alone where one of them is missing.
fn sample(spec: &MapSpec, rows: usize, across: f64, up: f64) -> Option<f64> {
    let place = |share: f64, count: usize| {
        let at = (share * count as f64 - 0.5).clamp(0.0, (count - 1) as f64);
        let low = at as usize;
        (low, (low + 1).min(count - 1), at - low as f64)
    };
    let (x0, x1, s) = place(across, spec.columns);
    let (y0, y1, t) = place(up, rows);
    let at = |x: usize, y: usize| spec.values[y * spec.columns + x];
    let smooth = (1.0 - t) * ((1.0 - s) * at(x0, y0) + s * at(x1, y0))
        + t * ((1.0 - s) * at(x0, y1) + s * at(x1, y1));
    let nearest = at(if s < 0.5 { x0 } else { x1 }, if t < 0.5 { y0 } else { y1 });
    Some(if smooth.is_finite() { smooth } else { nearest }).filter(|value| !value.is_nan())
}
