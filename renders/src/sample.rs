//! Where a panel is sampled: once in a pixel that lies wholly in the lit lens, on a grid of
//! points in a pixel that its edge crosses, nowhere else.

use crate::scene::{Geometry, Point};

/// Radius of the sphere, as a share of the panel's width.
pub const RADIUS_SHARE: f64 = 0.47;

/// Points a side in a pixel that an edge crosses.
const EDGE_GRID: usize = 4;

/// A square panel of `size` pixels with the sphere in its middle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Panel {
    pub size: usize,
    pub geometry: Geometry,
    /// Shade every pixel, even where nothing can be seen.
    pub everywhere: bool,
}

/// The samples of some rows: columns of inputs, and which pixel each belongs to.
#[derive(Clone, Debug, Default)]
pub(crate) struct Samples {
    pub n_dot_l: Vec<f64>,
    pub n_dot_v: Vec<f64>,
    pub n_dot_h: Vec<f64>,
    pub cos_phi: Vec<f64>,
    /// The pixel's index in the panel, and the share of it that the sample stands for.
    pub pixel: Vec<(u32, f32)>,
    /// Pixels with at least one sample.
    pub pixels: u64,
}

impl Samples {
    /// The points themselves, in the order given, each for a whole pixel of its own.
    pub fn of(points: impl IntoIterator<Item = Point>) -> Self {
        let mut samples = Self::default();
        for (index, point) in points.into_iter().enumerate() {
            samples.push(point, index as u32, 1.0);
            samples.pixels += 1;
        }
        samples
    }

    pub fn len(&self) -> usize {
        self.pixel.len()
    }

    fn push(&mut self, point: Point, pixel: u32, share: f32) {
        self.n_dot_l.push(point.n_dot_l);
        self.n_dot_v.push(point.n_dot_v);
        self.n_dot_h.push(point.n_dot_h);
        self.cos_phi.push(point.cos_phi);
        self.pixel.push((pixel, share));
    }
}

impl Panel {
    /// Radius of the sphere in pixels.
    pub fn radius(&self) -> f64 {
        RADIUS_SHARE * self.size as f64
    }

    /// Position of a pixel coordinate in units of the radius.
    pub fn unit(&self, pixels: f64) -> f64 {
        (pixels - self.size as f64 / 2.0) / self.radius()
    }

    /// The share of a pixel that the sphere's disc covers.
    pub fn cover(&self, column: usize, row: usize) -> f64 {
        let (x, y) = (self.unit(column as f64 + 0.5), self.unit(row as f64 + 0.5));
        (self.radius() * (1.0 - x.hypot(y)) + 0.5).clamp(0.0, 1.0)
    }

    /// The samples of the rows from `first` up to, not including, `last`.
    pub fn samples(&self, first: usize, last: usize) -> Samples {
        let mut samples = Samples::default();
        let reach = 1.0 + 1.0 / self.radius();
        let mut above = self.corners(first);
        for row in first..last {
            let below = self.corners(row + 1);
            let y = self.unit(row as f64 + 0.5);
            for column in 0..self.size {
                let x = self.unit(column as f64 + 0.5);
                if x * x + y * y > reach * reach && !self.everywhere {
                    continue;
                }
                let corners = [
                    above[column],
                    above[column + 1],
                    below[column],
                    below[column + 1],
                ];
                let pixel = (row * self.size + column) as u32;
                let before = samples.len();
                if corners.iter().all(|&inside| inside) {
                    if let Some(point) = self.geometry.lit(x, y) {
                        samples.push(point, pixel, 1.0);
                    }
                } else if corners.iter().any(|&inside| inside) || self.geometry.lit(x, y).is_some()
                {
                    self.edge(&mut samples, column, row, pixel);
                }
                samples.pixels += u64::from(samples.len() > before);
                if self.everywhere && samples.len() == before {
                    // Seen by nobody: shaded to show what skipping saves, and for nothing.
                    let point = self
                        .geometry
                        .point(x, y)
                        .unwrap_or(self.geometry.equator(0.0));
                    samples.push(point, pixel, 0.0);
                    samples.pixels += 1;
                }
            }
            above = below;
        }
        samples
    }

    /// Which of the pixel corners on one grid line lie in the lit lens.
    fn corners(&self, line: usize) -> Vec<bool> {
        let y = self.unit(line as f64);
        (0..=self.size)
            .map(|column| self.geometry.lit(self.unit(column as f64), y).is_some())
            .collect()
    }

    fn edge(&self, samples: &mut Samples, column: usize, row: usize, pixel: u32) {
        let share = 1.0 / (EDGE_GRID * EDGE_GRID) as f32;
        let offset = |i: usize| (i as f64 + 0.5) / EDGE_GRID as f64;
        for i in 0..EDGE_GRID {
            // The lower half is walked upwards, so that a pixel and its mirror image sum the same
            // numbers in the same order and agree to the last bit.
            let i = if 2 * row < self.size {
                i
            } else {
                EDGE_GRID - 1 - i
            };
            for j in 0..EDGE_GRID {
                let x = self.unit(column as f64 + offset(j));
                let y = self.unit(row as f64 + offset(i));
                if let Some(point) = self.geometry.lit(x, y) {
                    samples.push(point, pixel, share);
                }
            }
        }
    }
}
