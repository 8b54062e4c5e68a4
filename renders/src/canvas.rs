//! A picture in memory: pixels, anti-aliased strokes, text, PNG.

use crate::colour::{Rgb, mix};
use crate::text::{self, Weight};
use std::io::Write;
use std::ops::Range;

/// Where a text stands relative to the point it is drawn at.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Align {
    /// The text starts there.
    Left,
    /// The text is centred there.
    Centre,
    /// The text ends there.
    Right,
}

/// Opaque sRGB pixels, rows from the top.
///
/// It may hold a part of its rows only: whatever is drawn elsewhere is lost. So a large picture
/// can be drawn strip by strip, each time the same way.
pub struct Canvas {
    width: usize,
    height: usize,
    /// The rows that are held.
    rows: Range<usize>,
    pixels: Vec<Rgb>,
}

impl Canvas {
    /// A canvas of one colour.
    pub fn new(width: usize, height: usize, paper: Rgb) -> Self {
        Self::strip(width, height, 0..height, paper)
    }

    /// Some rows of a canvas of one colour.
    pub fn strip(width: usize, height: usize, rows: Range<usize>, paper: Rgb) -> Self {
        Self {
            width,
            height,
            pixels: vec![paper; width * rows.len()],
            rows,
        }
    }

    /// The rows that are held.
    pub fn rows(&self) -> &Range<usize> {
        &self.rows
    }

    /// Whether any row from `top` to `bottom` is held.
    pub fn holds(&self, top: f32, bottom: f32) -> bool {
        bottom >= self.rows.start as f32 && top <= self.rows.end as f32
    }

    /// Red, green, blue of every pixel that is held.
    pub fn rgb(&self) -> &[u8] {
        self.pixels.as_flattened()
    }

    /// The pixels of those of some rows that are held.
    pub fn pixels_mut(&mut self, rows: Range<usize>) -> &mut [Rgb] {
        let held = &self.rows;
        let at = |row: usize| (row.clamp(held.start, held.end) - held.start) * self.width;
        &mut self.pixels[at(rows.start)..at(rows.end)]
    }

    /// Width in pixels.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Height in pixels.
    pub fn height(&self) -> usize {
        self.height
    }

    /// Red, green, blue, 255 of every pixel.
    pub fn rgba(&self) -> Vec<u8> {
        let mut rgba = vec![255; 4 * self.pixels.len()];
        for (to, [red, green, blue]) in rgba.chunks_exact_mut(4).zip(&self.pixels) {
            (to[0], to[1], to[2]) = (*red, *green, *blue);
        }
        rgba
    }

    /// Replaces one pixel; outside the canvas nothing happens.
    pub fn set(&mut self, x: i32, y: i32, colour: Rgb) {
        self.blend(x, y, colour, 1.0);
    }

    /// Lays `colour` over one pixel with `coverage` in [0, 1].
    pub fn blend(&mut self, x: i32, y: i32, colour: Rgb, coverage: f32) {
        let (Ok(column), Ok(row)) = (usize::try_from(x), usize::try_from(y)) else {
            return;
        };
        if column >= self.width || !self.rows.contains(&row) || coverage <= 0.0 {
            return;
        }
        let pixel = &mut self.pixels[(row - self.rows.start) * self.width + column];
        *pixel = if coverage >= 1.0 {
            colour
        } else {
            mix(*pixel, colour, f64::from(coverage))
        };
    }

    /// Fills the rectangle from (`x`, `y`), `width` by `height` pixels.
    pub fn rect(&mut self, x: f32, y: f32, width: f32, height: f32, colour: Rgb, opacity: f32) {
        let cover = |from: f32, to: f32, at: i32| {
            (to.min(at as f32 + 1.0) - from.max(at as f32)).clamp(0.0, 1.0)
        };
        let (first, last) = (self.rows.start as i32, self.rows.end as i32);
        for row in (y.floor() as i32).max(first)..((y + height).ceil() as i32).min(last) {
            let vertical = cover(y, y + height, row);
            for column in x.floor() as i32..(x + width).ceil() as i32 {
                let coverage = vertical * cover(x, x + width, column) * opacity;
                self.blend(column, row, colour, coverage);
            }
        }
    }

    /// A polyline `width` pixels thick with round joins and ends, blended once where it
    /// crosses itself.
    pub fn stroke(&mut self, points: &[(f32, f32)], width: f32, colour: Rgb, opacity: f32) {
        let segments: Vec<[(f32, f32); 2]> =
            points.windows(2).map(|pair| [pair[0], pair[1]]).collect();
        self.strokes(&segments, width, colour, opacity);
    }

    /// Segments in any order, drawn as one figure: where they meet or cross nothing is blended
    /// twice.
    pub fn strokes(&mut self, segments: &[[(f32, f32); 2]], width: f32, colour: Rgb, opacity: f32) {
        let reach = width / 2.0 + 1.0;
        let bound = |pick: fn(&(f32, f32)) -> f32, limits: &Range<usize>| {
            let values = segments
                .iter()
                .flatten()
                .map(pick)
                .filter(|v| v.is_finite());
            let (low, high) = values.fold((f32::INFINITY, f32::NEG_INFINITY), |(low, high), v| {
                (low.min(v), high.max(v))
            });
            let (first, last) = (limits.start as f32, limits.end as f32);
            let low = (low - reach).floor().clamp(first, last) as usize;
            (low, (high + reach).ceil().clamp(low as f32, last) as usize)
        };
        let (left, right) = bound(|p| p.0, &(0..self.width));
        let (top, bottom) = bound(|p| p.1, &self.rows);
        let columns = right - left;
        let mut coverage = vec![0.0_f32; columns * (bottom - top)];
        for &[(x0, y0), (x1, y1)] in segments {
            let (dx, dy) = (x1 - x0, y1 - y0);
            let length2 = dx * dx + dy * dy;
            if !length2.is_finite() {
                continue;
            }
            let first = ((y0.min(y1) - reach).floor().max(top as f32)) as usize;
            let last = ((y0.max(y1) + reach).ceil().min(bottom as f32)).max(0.0) as usize;
            // Empty where the segment is in no row that is held.
            for row in first..last {
                let y = row as f32 + 0.5;
                let from = ((x0.min(x1) - reach).floor().max(left as f32)) as usize;
                let to = ((x0.max(x1) + reach).ceil().min(right as f32)).max(0.0) as usize;
                for column in from..to {
                    let x = column as f32 + 0.5;
                    let t = if length2 > 0.0 {
                        (((x - x0) * dx + (y - y0) * dy) / length2).clamp(0.0, 1.0)
                    } else {
                        0.0
                    };
                    let (across, down) = (x - x0 - t * dx, y - y0 - t * dy);
                    let distance = (across * across + down * down).sqrt();
                    let covers = (width / 2.0 + 0.5 - distance).clamp(0.0, width.min(1.0));
                    let slot = &mut coverage[(row - top) * columns + column - left];
                    *slot = slot.max(covers);
                }
            }
        }
        for (index, covers) in coverage.into_iter().enumerate() {
            if covers > 0.0 {
                let (column, row) = (left + index % columns, top + index / columns);
                self.blend(column as i32, row as i32, colour, covers * opacity);
            }
        }
    }

    /// Fills a polygon, each pixel by the share of it that lies inside.
    pub fn polygon(&mut self, corners: &[(f32, f32)], colour: Rgb) {
        const SIDE: i32 = 4;
        let range = |of: fn(&(f32, f32)) -> f32| {
            let values = corners.iter().map(of);
            let (low, high) = values.fold((f32::MAX, f32::MIN), |(low, high), x| {
                (low.min(x), high.max(x))
            });
            low.floor() as i32..=high.ceil() as i32
        };
        // A ray to the right crosses the edges an odd number of times.
        let inside = |x: f32, y: f32| {
            let edges = corners.iter().zip(corners.iter().cycle().skip(1));
            let crossed = edges.filter(|(a, b)| {
                (a.1 > y) != (b.1 > y) && x < a.0 + (y - a.1) / (b.1 - a.1) * (b.0 - a.0)
            });
            crossed.count() % 2 == 1
        };
        for y in range(|corner| corner.1) {
            for x in range(|corner| corner.0) {
                let samples = (0..SIDE * SIDE).filter(|i| {
                    let at = |i: i32| (i as f32 + 0.5) / SIDE as f32;
                    inside(x as f32 + at(i % SIDE), y as f32 + at(i / SIDE))
                });
                let coverage = samples.count() as f32 / (SIDE * SIDE) as f32;
                if coverage > 0.0 {
                    self.blend(x, y, colour, coverage);
                }
            }
        }
    }

    /// A filled circle.
    pub fn disc(&mut self, x: f32, y: f32, radius: f32, colour: Rgb) {
        self.stroke(&[(x, y), (x, y)], 2.0 * radius, colour, 1.0);
    }

    /// One line of text: (`x`, `y`) is on the baseline.
    pub fn text(&mut self, x: f32, y: f32, style: Style, line: &str) {
        let Style {
            em,
            weight,
            align,
            colour,
        } = style;
        if !self.holds(y - 1.5 * em, y + 0.7 * em) {
            return;
        }
        let start = x - text::width(line, em, weight) * align.share();
        let (left, base) = (start.floor(), y.round() as i32);
        text::rasterise(line, em, weight, start - left, |dx, dy, coverage| {
            self.blend(left as i32 + dx, base + dy, colour, coverage);
        });
    }

    /// One line of text that reads upwards; (`x`, `y`) is on its baseline, which runs up.
    pub fn text_up(&mut self, x: f32, y: f32, style: Style, line: &str) {
        let Style {
            em,
            weight,
            align,
            colour,
        } = style;
        let start = y + text::width(line, em, weight) * align.share();
        text::rasterise(line, em, weight, 0.0, |dx, dy, coverage| {
            self.blend(
                x.round() as i32 + dy,
                start.round() as i32 - dx,
                colour,
                coverage,
            );
        });
    }
}

/// How a text looks and hangs.
#[derive(Clone, Copy, Debug)]
pub struct Style {
    /// The em in pixels.
    pub em: f32,
    /// How heavy it is.
    pub weight: Weight,
    /// Which of its ends is at the point it is drawn at.
    pub align: Align,
    /// Its colour.
    pub colour: Rgb,
}

impl Style {
    /// All of it at once.
    pub fn new(em: f32, weight: Weight, align: Align, colour: Rgb) -> Self {
        Self {
            em,
            weight,
            align,
            colour,
        }
    }
}

impl Align {
    /// The share of the text's width that stands before the point.
    pub(crate) fn share(self) -> f32 {
        match self {
            Self::Left => 0.0,
            Self::Centre => 0.5,
            Self::Right => 1.0,
        }
    }
}

/// A PNG file of `rgba` pixels, written without alpha and tagged as sRGB.
pub fn png(width: u32, height: u32, rgba: &[u8]) -> Vec<u8> {
    let mut rgb = vec![0; rgba.len() / 4 * 3];
    for (to, from) in rgb.chunks_exact_mut(3).zip(rgba.chunks_exact(4)) {
        to.copy_from_slice(&from[..3]);
    }
    let mut file = Vec::new();
    // Writing to memory fails only if the buffer and the header disagree, which they cannot.
    let written =
        png_header(&mut file, width, height).and_then(|mut writer| writer.write_image_data(&rgb));
    debug_assert!(written.is_ok(), "{written:?}");
    file
}

/// The start of a PNG file of red, green and blue bytes, tagged as sRGB.
pub fn png_header<W: Write>(
    to: W,
    width: u32,
    height: u32,
) -> Result<png::Writer<W>, png::EncodingError> {
    let mut encoder = png::Encoder::new(to, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::Fast);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    encoder.write_header()
}
