//! Where the pixels of some rows are seen, whatever lights them: found once for all lights.

use crate::sample::{EDGE_GRID, Panel};
use std::ops::Range;

/// Up to this share of a line's half, nothing grows as it does towards the outline.
pub(crate) const INNER: f64 = 0.95;

/// x, q and the share of its pixel that a sample at the outline stands for.
type Sample = (f64, f64, f32);

/// What is known of some rows of pixels.
#[derive(Debug, Default)]
pub(crate) struct Places {
    rows: Range<usize>,
    size: usize,
    /// Where the pixels' middles are to the right, for every column of a panel.
    x: Vec<f64>,
    /// q of the pixels' middles, row by row, and in which columns of each row it is known.
    q: Vec<f64>,
    known: Vec<Range<usize>>,
    /// For each pixel the first of its samples at the outline, line by line; 0 is not known yet.
    edges: Vec<u32>,
    samples: Vec<[Sample; EDGE_GRID]>,
    /// What the columns' places are those of.
    of: Option<(usize, f64)>,
}

impl Places {
    /// Forgets all and starts with these rows of a panel.
    pub fn start(&mut self, panel: &Panel, rows: Range<usize>) {
        let pixels = rows.len() * panel.size;
        if self.of != Some((panel.size, panel.radius)) {
            self.of = Some((panel.size, panel.radius));
            self.x.clear();
            let middles = (0..panel.size).map(|column| panel.unit(column as f64 + 0.5));
            self.x.extend(middles);
        }
        self.known.clear();
        self.known.resize(rows.len(), 0..0);
        self.q.resize(pixels, 0.0);
        self.edges.clear();
        self.edges.resize(pixels, 0);
        // Number 0 is none.
        self.samples.clear();
        self.samples.push([(0.0, 0.0, 0.0); EDGE_GRID]);
        (self.size, self.rows) = (panel.size, rows);
    }

    /// The rows it was started with.
    pub fn rows(&self) -> Range<usize> {
        self.rows.clone()
    }

    /// The middles of pixels of a row that are on the sphere: x, y, q.
    pub fn line(
        &mut self,
        panel: &Panel,
        row: usize,
        columns: Range<usize>,
    ) -> (&[f64], f64, &[f64]) {
        let y = panel.up(row as f64 + 0.5);
        let row = row - self.rows.start;
        let q = &mut self.q[row * self.size..(row + 1) * self.size];
        let known = &mut self.known[row];
        if columns.start < known.start || columns.end > known.end {
            let all = match known.end == 0 {
                true => columns.clone(),
                false => columns.start.min(known.start)..columns.end.max(known.end),
            };
            for (q, x) in q[all.clone()].iter_mut().zip(&self.x[all.clone()]) {
                *q = (1.0 - (x * x + y * y)).sqrt();
            }
            *known = all;
        }
        (&self.x[columns.clone()], y, &q[columns])
    }

    /// The samples of one line of a pixel at the outline, where no light's edge cuts it.
    pub fn edge(
        &mut self,
        (column, row): (usize, usize),
        line: usize,
        stretch: &Stretch,
    ) -> &[Sample; EDGE_GRID] {
        let slot = &mut self.edges[(row - self.rows.start) * self.size + column];
        if *slot == 0 {
            *slot = self.samples.len() as u32;
            self.samples
                .extend([[(0.0, 0.0, f32::NAN); EDGE_GRID]; EDGE_GRID]);
        }
        let samples = &mut self.samples[*slot as usize + line];
        if samples[0].2.is_nan() {
            let mut slots = samples.iter_mut();
            stretch.sample(|x, q, share| {
                if let Some(slot) = slots.next() {
                    *slot = (x, q, share);
                }
            });
        }
        samples
    }
}

/// A stretch of a line within a pixel.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stretch {
    /// Half of what the sphere has of the line.
    pub rho: f64,
    pub from: f64,
    pub to: f64,
    /// A stretch as long as this would stand for the whole pixel.
    pub whole: f64,
}

impl Stretch {
    /// Whether it comes near the outline, where values may grow without bound.
    pub fn grows(&self) -> bool {
        // In units of the half line: a stretch that stays this far from the outline is even.
        self.from.abs().max(self.to.abs()) >= INNER * self.rho
    }

    /// Its samples: x, q, and the share of the pixel that each stands for. As many as
    /// [`EDGE_GRID`] where it [grows](Stretch::grows), evenly in the angle t of x = ρ sin t; else
    /// one in the middle, which tells the mean.
    ///
    /// There dx = q dt, and q falls to 0 at the outline as N·V does, so that what grows as
    /// 1/(N·V) towards the rim is averaged without error: points spread evenly in x would hit or
    /// miss the growth by chance.
    pub fn sample(&self, mut push: impl FnMut(f64, f64, f32)) {
        let &Self {
            rho,
            from,
            to,
            whole,
            ..
        } = self;
        if !self.grows() {
            let x = f64::midpoint(from, to);
            let q = ((rho - x) * (rho + x)).sqrt();
            push(x, q, ((to - from) / whole) as f32);
            return;
        }
        let places = even(unit(from, rho), unit(to, rho)).map(|(sin, cos)| (rho * sin, rho * cos));
        let weight: f64 = places.iter().map(|(_, q)| q).sum();
        for (x, q) in places {
            push(x, q, ((to - from) / whole * q / weight) as f32);
        }
    }
}

/// Sine and cosine of the angle t of a place x = ρ sin t.
pub(crate) fn unit(x: f64, rho: f64) -> (f64, f64) {
    let x = x.clamp(-rho, rho);
    (x / rho, ((rho - x) * (rho + x)).sqrt() / rho)
}

/// Sines and cosines in the middles of four equal parts of the angle from `a` to `b`, which is
/// less than half a turn.
fn even(a: (f64, f64), b: (f64, f64)) -> [(f64, f64); EDGE_GRID] {
    let half = halfway(a, b);
    let quarters = [halfway(a, half), halfway(half, b)];
    [
        halfway(a, quarters[0]),
        halfway(quarters[0], half),
        halfway(half, quarters[1]),
        halfway(quarters[1], b),
    ]
}

/// The direction halfway between two that are less than half a turn apart.
pub(crate) fn halfway(a: (f64, f64), b: (f64, f64)) -> (f64, f64) {
    let (x, y) = (a.0 + b.0, a.1 + b.1);
    let length = (x * x + y * y).sqrt();
    (x / length, y / length)
}
