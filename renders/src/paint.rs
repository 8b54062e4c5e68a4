//! From shaded pixels to colours: the three panels.

use crate::canvas::Canvas;
use crate::colour::{DARK, DivergingTable, EncodeTable, Rgb, mix, srgb_decode};
use crate::contour;
use crate::sample::Panel;
use crate::shade::Shaded;
use rayon::prelude::*;
use std::array::from_fn;
use std::ops::Range;

/// The sphere where no light reaches it, in the ratio's panel.
const UNLIT: Rgb = [9, 10, 13];

/// Rows that are painted together.
const BAND: usize = 16;

/// What colours are looked up in: computed once, for as many panels as are to be painted.
#[derive(Default)]
pub(crate) struct Tables {
    pub encode: EncodeTable,
    diverging: DivergingTable,
}

/// Only the panels, for a terminal.
pub(crate) fn compact(panel: &Panel, shaded: &Shaded, tables: &Tables) -> Canvas {
    let size = panel.size;
    let gap = (size / 32).max(1);
    let mut canvas = Canvas::new(3 * size + 2 * gap, size, DARK.paper);
    let columns = [0, size + gap, 2 * (size + gap)];
    panels(&mut canvas, panel, (shaded, 0), columns, 0, tables);
    canvas
}

/// How wide the line is on which both values are equal.
pub(crate) fn contour_width(size: usize) -> f32 {
    (size as f32 / 180.0).max(1.0)
}

/// Paints the three panels with their left edges at `columns`, as far as the canvas holds their
/// rows. `shaded` starts at row `first`.
pub(crate) fn panels(
    canvas: &mut Canvas,
    panel: &Panel,
    (shaded, first): (&Shaded, usize),
    columns: [usize; 3],
    top: usize,
    tables: &Tables,
) {
    let (size, width) = (panel.size, canvas.width());
    let held = canvas.rows().clone();
    let own = |row: usize| row.saturating_sub(top).min(size);
    let rows = own(held.start)..own(held.end);
    let page = Page {
        panel,
        shaded,
        tables,
        surround: DARK.panel.map(|byte| srgb_decode(byte) as f32),
    };
    let pixels = canvas.pixels_mut(top + rows.start..top + rows.end);
    let bands = pixels.par_chunks_mut((BAND * width).max(1)).enumerate();
    bands.for_each(|(band, pixels)| {
        for (index, pixels) in pixels.chunks_exact_mut(width).enumerate() {
            let row = rows.start + band * BAND + index;
            page.row(row, (row - first) * size, pixels, columns);
        }
    });
    let offset = (columns[2] as f32, top as f32);
    let contour: Vec<[(f32, f32); 2]> = contour::ratio_one(shaded, size, first)
        .into_iter()
        .map(|ends| ends.map(|(x, y)| (x + offset.0, y + offset.1)))
        .collect();
    canvas.strokes(&contour, contour_width(size), [24, 24, 28], 1.0);
}

struct Page<'a> {
    panel: &'a Panel,
    shaded: &'a Shaded,
    tables: &'a Tables,
    surround: [f32; 3],
}

impl Page<'_> {
    /// A row of all three panels, the first pixel of which was shaded as that many before.
    fn row(&self, row: usize, start: usize, pixels: &mut [Rgb], columns: [usize; 3]) {
        let size = self.panel.size;
        for left in columns {
            pixels[left..left + size].fill(DARK.panel);
        }
        let (touched, covered) = self.panel.discs(row);
        for column in (touched.start..covered.start).chain(covered.end..touched.end) {
            let cover = self.panel.cover(column, row);
            let colours = self.at(start + column, cover);
            for (left, colour) in columns.into_iter().zip(colours) {
                pixels[left + column] = colour;
            }
        }
        self.inside(start, covered, pixels, columns);
    }

    /// Pixels that the disc covers wholly.
    fn inside(&self, start: usize, covered: Range<usize>, pixels: &mut [Rgb], columns: [usize; 3]) {
        let Self { shaded, tables, .. } = self;
        let from = start + covered.start..start + covered.end;
        let channels = shaded.channels();
        let panels = [&shaded.right_seen, &shaded.wrong_seen];
        for (seen, left) in panels.into_iter().zip(columns) {
            let pixels = &mut pixels[left + covered.start..left + covered.end];
            let seen = &seen[from.start * channels..from.end * channels];
            if channels == 1 {
                for (pixel, seen) in pixels.iter_mut().zip(seen) {
                    *pixel = [tables.encode.byte(*seen); 3];
                }
            } else {
                for (pixel, seen) in pixels.iter_mut().zip(seen.chunks_exact(channels)) {
                    *pixel = from_fn(|channel| tables.encode.byte(seen[channel % channels]));
                }
            }
        }
        let left = columns[2];
        let pixels = &mut pixels[left + covered.start..left + covered.end];
        let ratios = shaded.lit[from.clone()].iter().zip(&shaded.stops[from]);
        for (pixel, (&lit, &stops)) in pixels.iter_mut().zip(ratios) {
            *pixel = self.ratio(lit, stops, 1.0);
        }
    }

    /// A pixel of the ratio's panel that lies on the disc, of which it has this share.
    fn ratio(&self, lit: f32, stops: f32, cover: f64) -> Rgb {
        let unlit = || match cover {
            1.0 => UNLIT,
            _ => mix(DARK.panel, UNLIT, cover),
        };
        match lit {
            0.0 => unlit(),
            1.0 => self.tables.diverging.colour(stops),
            _ => mix(unlit(), self.tables.diverging.colour(stops), f64::from(lit)),
        }
    }

    /// The colours of any pixel, of which the disc covers this share.
    fn at(&self, index: usize, cover: f64) -> [Rgb; 3] {
        let Self { shaded, tables, .. } = self;
        if cover == 0.0 {
            return [DARK.panel; 3];
        }
        let channels = shaded.channels();
        let behind = 1.0 - cover as f32;
        let shown = |seen: &[f32]| {
            let seen = &seen[index * channels..(index + 1) * channels];
            from_fn(|channel| {
                tables
                    .encode
                    .byte(seen[channel % channels] + behind * self.surround[channel])
            })
        };
        [
            shown(&shaded.right_seen),
            shown(&shaded.wrong_seen),
            self.ratio(shaded.lit[index], shaded.stops[index], cover),
        ]
    }
}
