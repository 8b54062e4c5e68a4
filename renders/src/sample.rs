//! Where a panel is sampled: once in a pixel that lies wholly in the lit lens, on a grid of
//! points in a pixel that its edge crosses, nowhere else.

use crate::scene::{Geometry, Point};

/// Radius of the sphere, as a share of the panel's width.
pub const RADIUS_SHARE: f64 = 0.47;

/// Lines in a pixel that an edge crosses, and points on each.
const EDGE_GRID: usize = 4;

/// A square panel of `size` pixels with the sphere in its middle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Panel {
    pub size: usize,
    pub geometry: Geometry,
    /// Whether a formula needs the azimuth between light and view.
    pub azimuth: bool,
    /// Shade every pixel, even where nothing can be seen.
    pub everywhere: bool,
}

/// The samples of some rows: columns of inputs, and which pixel each belongs to.
#[derive(Clone, Debug, Default)]
pub(crate) struct Samples {
    pub n_dot_l: Vec<f64>,
    pub n_dot_v: Vec<f64>,
    pub n_dot_h: Vec<f64>,
    /// Empty where no formula needs it.
    pub cos_phi: Vec<f64>,
    /// The pixel's index in the panel, and the share of it that the sample stands for.
    pub pixel: Vec<(u32, f32)>,
    /// Pixels with at least one sample.
    pub pixels: u64,
}

impl Samples {
    /// The points themselves, in the order given, each for a whole pixel of its own.
    pub fn of(geometry: &Geometry, points: impl IntoIterator<Item = Point>) -> Self {
        let mut samples = Self::default();
        for (index, point) in points.into_iter().enumerate() {
            samples.push(point, index as u32, 1.0);
            samples.cos_phi.push(geometry.cos_phi(&point));
            samples.pixels += 1;
        }
        samples
    }

    pub fn len(&self) -> usize {
        self.pixel.len()
    }

    #[inline]
    fn push(&mut self, point: Point, pixel: u32, share: f32) {
        self.n_dot_l.push(point.n_dot_l);
        self.n_dot_v.push(point.n_dot_v);
        self.n_dot_h.push(point.n_dot_h);
        self.pixel.push((pixel, share));
    }

    /// The columns of [`crate::scene::VARYING`] from `start` up to, not including, `end`.
    pub fn columns(&self, start: usize, end: usize) -> [Option<&[f64]>; 4] {
        [&self.n_dot_l, &self.n_dot_v, &self.n_dot_h, &self.cos_phi]
            .map(|column| column.get(start..end))
    }
}

/// Columns of one row: those that the lit lens touches, and among them those it fills.
struct Reach {
    touched: std::ops::Range<usize>,
    filled: std::ops::Range<usize>,
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
        (self.radius() * (1.0 - (x * x + y * y).sqrt()) + 0.5).clamp(0.0, 1.0)
    }

    /// The samples of the rows from `first` up to, not including, `last`.
    pub fn samples(&self, first: usize, last: usize) -> Samples {
        let mut samples = Samples::default();
        for row in first..last {
            let reach = self.reach(row);
            if self.everywhere {
                self.unseen(&mut samples, row, 0..reach.touched.start);
            }
            let pixel = |column: usize| (row * self.size + column) as u32;
            for column in reach.touched.start..reach.filled.start {
                self.edge(&mut samples, column, row, pixel(column));
            }
            let y = self.unit(row as f64 + 0.5);
            for column in reach.filled.clone() {
                if let Some(point) = self.geometry.point(self.unit(column as f64 + 0.5), y) {
                    samples.push(point, pixel(column), 1.0);
                    samples.pixels += 1;
                }
            }
            for column in reach.filled.end..reach.touched.end {
                self.edge(&mut samples, column, row, pixel(column));
            }
            if self.everywhere {
                self.unseen(&mut samples, row, reach.touched.end..self.size);
            }
        }
        if self.azimuth {
            samples.cos_phi = (0..samples.len())
                .map(|i| {
                    self.geometry.cos_phi(&Point {
                        n_dot_l: samples.n_dot_l[i],
                        n_dot_v: samples.n_dot_v[i],
                        n_dot_h: samples.n_dot_h[i],
                    })
                })
                .collect();
        }
        samples
    }

    /// Which pixels of a row the lit lens touches and fills, from where its edges cross the
    /// row's upper, middle and lower line.
    fn reach(&self, row: usize) -> Reach {
        let lines =
            [0.0, 0.5, 1.0].map(|part| self.geometry.lit_stretch(self.unit(row as f64 + part)));
        let seen = |(from, to): &&(f64, f64)| from < to;
        let pixels = |unit: f64| unit * self.radius() + self.size as f64 / 2.0;
        let column = |at: f64| at.clamp(0.0, self.size as f64) as usize;
        let start = lines
            .iter()
            .filter(seen)
            .map(|line| line.0)
            .fold(f64::INFINITY, f64::min);
        let end = lines
            .iter()
            .filter(seen)
            .map(|line| line.1)
            .fold(f64::NEG_INFINITY, f64::max);
        if start >= end {
            let nothing = self.size..self.size;
            return Reach {
                touched: nothing.clone(),
                filled: nothing,
            };
        }
        let touched = column(pixels(start).floor())..column(pixels(end).ceil());
        let inner = if lines.iter().all(|line| seen(&line)) {
            let from = lines
                .iter()
                .map(|line| line.0)
                .fold(f64::NEG_INFINITY, f64::max);
            let to = lines
                .iter()
                .map(|line| line.1)
                .fold(f64::INFINITY, f64::min);
            column(pixels(from).ceil())..column(pixels(to).floor())
        } else {
            0..0
        };
        let filled = if inner.start < inner.end {
            inner
        } else {
            touched.end..touched.end
        };
        Reach { touched, filled }
    }

    /// Pixels that nobody sees: shaded to show what skipping saves, and counted for nothing.
    fn unseen(&self, samples: &mut Samples, row: usize, columns: std::ops::Range<usize>) {
        let y = self.unit(row as f64 + 0.5);
        for column in columns {
            let x = self.unit(column as f64 + 0.5);
            let point = self
                .geometry
                .point(x, y)
                .unwrap_or(self.geometry.equator(0.0));
            samples.push(point, (row * self.size + column) as u32, 0.0);
            samples.pixels += 1;
        }
    }

    /// Samples one stretch of a line whose half-width on the sphere is `rho`; a stretch as long as
    /// `whole` would stand for the whole pixel.
    fn stretch(
        &self,
        samples: &mut Samples,
        (from, to): (f64, f64),
        rho: f64,
        whole: f64,
        pixel: u32,
    ) {
        let angle = |x: f64| (x / rho).clamp(-1.0, 1.0).asin();
        let (start, end) = (angle(from), angle(to));
        let points: [Point; EDGE_GRID] = std::array::from_fn(|j| {
            let t = start + (end - start) * (j as f64 + 0.5) / EDGE_GRID as f64;
            self.geometry.at(rho * t.sin(), rho * t.cos())
        });
        let weight: f64 = points.iter().map(|point| point.n_dot_v).sum();
        for point in points {
            if point.n_dot_l > 0.0 && point.n_dot_v > 0.0 {
                let share = (to - from) / whole * point.n_dot_v / weight;
                samples.push(point, pixel, share as f32);
            }
        }
    }

    /// A pixel that an edge of the lens crosses: the mean over its lit part.
    ///
    /// On each of a few lines the lit stretch within the pixel is sampled evenly in the angle t
    /// of x = ρ sin t. There dx = N·V dt, so that what grows as 1/(N·V) towards the rim is
    /// averaged without error: points spread evenly in x would hit or miss the growth by chance.
    fn edge(&self, samples: &mut Samples, column: usize, row: usize, pixel: u32) {
        let before = samples.len();
        let (left, right) = (self.unit(column as f64), self.unit(column as f64 + 1.0));
        let offset = |i: usize| (i as f64 + 0.5) / EDGE_GRID as f64;
        for i in 0..EDGE_GRID {
            // The lower half is walked upwards, so that a pixel and its mirror image sum the same
            // numbers in the same order and agree to the last bit.
            let i = if 2 * row < self.size {
                i
            } else {
                EDGE_GRID - 1 - i
            };
            let y = self.unit(row as f64 + offset(i));
            let (terminator, rim) = self.geometry.lit_stretch(y);
            let (from, to) = (terminator.max(left), rim.min(right));
            // Also false where the line misses the sphere and both ends are NaN.
            if from < to {
                self.stretch(
                    samples,
                    (from, to),
                    rim,
                    (right - left) * EDGE_GRID as f64,
                    pixel,
                );
            }
        }
        if samples.len() > before {
            samples.pixels += 1;
        } else if self.everywhere {
            self.unseen(samples, row, column..column + 1);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Scene;

    /// The area of the lit lens is π/2 (1 + cos light) of the radius squared.
    #[track_caller]
    fn check_area(light_deg: f64) {
        let scene = Scene {
            roughness: 0.4,
            f0: 0.04,
            light_deg,
            others: Default::default(),
        };
        let panel = Panel {
            size: 200,
            geometry: scene.geometry(),
            azimuth: false,
            everywhere: false,
        };
        let samples = panel.samples(0, panel.size);
        let area: f64 = samples
            .pixel
            .iter()
            .map(|(_, share)| f64::from(*share))
            .sum();
        let expected = std::f64::consts::FRAC_PI_2
            * (1.0 + light_deg.to_radians().cos())
            * panel.radius().powi(2);
        assert!(
            (area - expected).abs() < 2e-3 * expected,
            "{light_deg}°: {area} instead of {expected}"
        );
        for i in 0..samples.len() {
            assert!(
                samples.n_dot_l[i] > 0.0 && samples.n_dot_v[i] > 0.0,
                "sample {i} at {light_deg}°"
            );
        }
    }

    #[test]
    fn the_lens_is_sampled_and_nothing_else() {
        [0.0, 30.0, 60.0, 90.0, 130.0]
            .into_iter()
            .for_each(check_area);
    }
}
