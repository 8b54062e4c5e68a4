//! Where a panel is sampled: once in a pixel that lies wholly in the lit lens of a light, on a
//! grid of points in a pixel that its edge crosses, nowhere else.

use crate::geometry::{Geometry, Point, Stretches};
use crate::places::{INNER, Places, Stretch, halfway, unit};
use crate::scene::{VARYING, column};
use std::ops::Range;

/// Lines in a pixel that an edge crosses, and points on each where it is the outline.
pub(crate) const EDGE_GRID: usize = 4;

/// A square panel of `size` pixels with the sphere in its middle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Panel {
    pub size: usize,
    /// Radius of the outline as a share of half the width.
    pub radius: f64,
    /// Shade every pixel, even where nothing can be seen.
    pub everywhere: bool,
    /// Sample the left half only, the middle column included: the right one is its mirror image.
    pub half: bool,
    /// The columns of [`VARYING`] to fill at every point; of the others one value is kept.
    pub columns: [bool; VARYING.len()],
}

/// One input of the formulas at all samples.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Input<'a> {
    /// The same at each.
    Uniform(f64),
    /// One value for each.
    Varying(&'a [f64]),
}

/// The samples of some rows under one light: columns of inputs, and which pixels they belong to.
#[derive(Clone, Debug, Default)]
pub(crate) struct Samples {
    /// The values of [`VARYING`]; empty where they are all the same or not needed.
    columns: [Vec<f64>; VARYING.len()],
    /// What stands for an empty column.
    uniform: [f64; VARYING.len()],
    /// Whether the light is near, so that not all of it arrives everywhere.
    near: bool,
    /// How much of the light arrives; empty where all of it does.
    pub arrives: Vec<f64>,
    /// What the samples stand for, in their order.
    spans: Vec<Span>,
    /// The share of its pixel that each sample at an edge stands for.
    shares: Vec<f32>,
}

/// Some samples that follow each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Span {
    /// One for each of so many whole pixels from this one on.
    Pixels { pixel: u32, count: u32 },
    /// So many in one pixel.
    Edge { pixel: u32, count: u32 },
    /// So many that nobody sees.
    Unseen { count: u32 },
}

/// Some samples, and what they stand for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Part<'a> {
    /// The samples from `first` on are those of the whole pixels from `pixel` on.
    Pixels {
        first: usize,
        pixel: usize,
        count: usize,
    },
    /// The samples from `first` on stand for these shares of a pixel.
    Edge {
        first: usize,
        pixel: usize,
        shares: &'a [f32],
    },
}

impl Samples {
    /// The points themselves, in the order given, each for a whole pixel of its own.
    pub fn of(
        geometry: &Geometry,
        columns: &[bool; VARYING.len()],
        points: impl IntoIterator<Item = Point>,
    ) -> Self {
        let mut samples = Self::default();
        samples.start(geometry);
        for point in points {
            samples.push(columns, &point);
        }
        let count = samples.len() as u32;
        samples.spans.push(Span::Pixels { pixel: 0, count });
        samples
    }

    pub fn len(&self) -> usize {
        self.columns[0].len()
    }

    /// The samples that are seen, in their order.
    pub fn parts(&self) -> impl Iterator<Item = Part<'_>> {
        let (mut next, mut edges) = (0, 0);
        self.spans.iter().filter_map(move |span| {
            let first = next;
            match *span {
                Span::Pixels { pixel, count } => {
                    let (pixel, count) = (pixel as usize, count as usize);
                    next += count;
                    Some(Part::Pixels {
                        first,
                        pixel,
                        count,
                    })
                }
                Span::Edge { pixel, count } => {
                    next += count as usize;
                    let shares = &self.shares[edges..edges + count as usize];
                    edges += count as usize;
                    let pixel = pixel as usize;
                    Some(Part::Edge {
                        first,
                        pixel,
                        shares,
                    })
                }
                Span::Unseen { count } => {
                    next += count as usize;
                    None
                }
            }
        })
    }

    /// Empties all columns for the points under this light.
    fn start(&mut self, geometry: &Geometry) {
        self.columns.iter_mut().for_each(Vec::clear);
        self.arrives.clear();
        self.spans.clear();
        self.shares.clear();
        self.near = geometry.is_near_light();
        let (v_dot_h, l_dot_v) = geometry.of_distant();
        self.uniform[column::V_DOT_H] = v_dot_h;
        self.uniform[column::L_DOT_V] = l_dot_v;
        self.uniform[column::LIGHT_DEG] = geometry.light_deg;
    }

    #[inline]
    fn push(&mut self, wanted: &[bool; VARYING.len()], point: &Point) {
        self.columns[0].push(point.n_dot_l);
        self.columns[1].push(point.n_dot_v);
        self.columns[2].push(point.n_dot_h);
        if wanted[column::COS_PHI] {
            self.columns[column::COS_PHI].push(Geometry::cos_phi(point));
        }
        if wanted[column::V_DOT_H] {
            self.columns[column::V_DOT_H].push(point.v_dot_h);
        }
        if wanted[column::L_DOT_V] {
            self.columns[column::L_DOT_V].push(point.l_dot_v);
        }
        if wanted[column::LIGHT_DEG] {
            self.columns[column::LIGHT_DEG].push(self.uniform[column::LIGHT_DEG]);
        }
        if self.near {
            self.arrives.push(point.arrives);
        }
    }

    /// [`Samples::push`] of places at the same height `y`, at once where that is possible.
    fn push_line(
        &mut self,
        wanted: &[bool; VARYING.len()],
        geometry: &Geometry,
        (x, y, q): (&[f64], f64, &[f64]),
    ) {
        let simple = geometry.is_distant() && wanted[column::COS_PHI..].iter().all(|it| !it);
        let places = x.iter().zip(q).map(|(&x, &q)| [x, y, q]);
        if simple {
            let [n_dot_l, n_dot_v, n_dot_h, ..] = &mut self.columns;
            n_dot_l.extend(places.clone().map(|n| geometry.distant_n_dot_l(n)));
            n_dot_v.extend_from_slice(q);
            n_dot_h.extend(places.map(|n| geometry.distant_n_dot_h(n)));
        } else {
            for [x, y, q] in places {
                self.push(wanted, &geometry.at(x, y, q));
            }
        }
    }

    /// [`Samples::push`] of a place that stands for this share of a pixel, if it is lit and seen.
    #[inline]
    fn push_share(
        &mut self,
        wanted: &[bool; VARYING.len()],
        geometry: &Geometry,
        [x, y, q]: [f64; 3],
        share: f32,
    ) {
        let point = geometry.at(x, y, q);
        if point.n_dot_l > 0.0 && point.n_dot_v > 0.0 {
            self.push(wanted, &point);
            self.shares.push(share);
        }
    }

    /// One of [`VARYING`] from `start` up to, not including, `end`.
    pub fn input(&self, index: usize, range: Range<usize>) -> Input<'_> {
        match self.columns[index].get(range) {
            Some(values) if !self.columns[index].is_empty() => Input::Varying(values),
            _ => Input::Uniform(self.uniform[index]),
        }
    }

    /// [`Samples::input`] of every one of [`VARYING`].
    pub fn inputs(&self, range: &Range<usize>) -> [Input<'_>; VARYING.len()] {
        std::array::from_fn(|index| self.input(index, range.clone()))
    }
}

/// A line on which pixels at an edge are sampled; it stands for a band of a quarter of the row.
#[derive(Clone, Copy, Default)]
struct Line {
    y: f64,
    /// Half of what the sphere has of it.
    rho: f64,
    /// The share of the band that lies on the sphere.
    share: f64,
    /// What is lit of the line.
    lit: Stretches,
}

impl Line {
    /// The line for the band between two heights. At the top and the bottom of the sphere it is in
    /// the middle of the angle rather than of the height, for the reason in [`Stretch::sample`].
    fn of(geometry: &Geometry, from: f64, to: f64) -> Self {
        let (y, share) = if from.abs().max(to.abs()) < INNER {
            (f64::midpoint(from, to), 1.0)
        } else {
            let (low, high) = (from.clamp(-1.0, 1.0), to.clamp(-1.0, 1.0));
            let (y, _) = halfway(unit(low, 1.0), unit(high, 1.0));
            (y, (high - low) / (to - from))
        };
        let lit = match share > 0.0 {
            true => geometry.lit(y),
            false => Stretches::default(),
        };
        let rho = (1.0 - y * y).sqrt();
        Self { y, rho, share, lit }
    }
}

/// What a light reaches in one row of pixels.
#[derive(Default)]
struct Row {
    /// The lines within the row on which pixels at an edge are sampled.
    lines: [Line; EDGE_GRID],
    /// Columns that the lens touches, and among them those it fills.
    touched: Stretches,
    filled: Stretches,
}

impl Panel {
    /// Radius of the sphere's outline in pixels.
    pub fn outline(&self) -> f64 {
        self.radius * self.size as f64 / 2.0
    }

    /// Position of a pixel coordinate in units of the outline's radius, to the right.
    pub fn unit(&self, pixels: f64) -> f64 {
        (pixels - self.size as f64 / 2.0) * (1.0 / self.outline())
    }

    /// The same upwards.
    pub fn up(&self, pixels: f64) -> f64 {
        -self.unit(pixels)
    }

    /// The share of a pixel that the sphere's disc covers.
    pub fn cover(&self, column: usize, row: usize) -> f64 {
        let (x, y) = (self.unit(column as f64 + 0.5), self.unit(row as f64 + 0.5));
        (self.outline() * (1.0 - (x * x + y * y).sqrt()) + 0.5).clamp(0.0, 1.0)
    }

    /// The columns of a row in which [`Panel::cover`] may be more than 0, and among them some where
    /// it is 1: all but a few.
    pub fn discs(&self, row: usize) -> (Range<usize>, Range<usize>) {
        let (outline, middle) = (self.outline(), self.size as f64 / 2.0);
        let y = row as f64 + 0.5 - middle;
        let half = |radius: f64| (radius * radius - y * y).max(0.0).sqrt();
        let clamp = |at: f64| at.clamp(0.0, self.size as f64) as usize;
        // A column is named by its left side; one more on each side keeps rounding out.
        let touched = half(outline + 1.5) + 1.0;
        let touched = clamp((middle - touched).floor())..clamp((middle + touched).ceil());
        let covered = half((outline - 1.5).max(0.0)) - 1.0;
        let covered = clamp((middle - covered).ceil())..clamp((middle + covered).floor());
        match covered.start < covered.end {
            true => (touched, covered),
            false => (touched.clone(), touched.end..touched.end),
        }
    }

    /// The samples of the rows from `first` up to, not including, `last` under one light.
    #[cfg(test)]
    pub fn samples(&self, geometry: &Geometry, first: usize, last: usize) -> Samples {
        let (mut samples, mut places) = (Samples::default(), Places::default());
        places.start(self, first..last);
        self.fill(&mut samples, &mut places, geometry);
        samples
    }

    /// The samples of the rows that the places were started with, under one light.
    pub fn fill(&self, samples: &mut Samples, places: &mut Places, geometry: &Geometry) {
        samples.start(geometry);
        for row in places.rows() {
            let reach = self.row(geometry, row);
            let end = match self.half {
                true => self.size.div_ceil(2),
                false => self.size,
            };
            let clip = |at: f64| (at as usize).min(end);
            let columns = |span: &(f64, f64)| clip(span.0)..clip(span.1);
            let mut next = 0;
            for touched in reach.touched.as_slice().iter().map(columns) {
                self.unseen(samples, geometry, row, next..touched.start);
                next = touched.start;
                for filled in reach.filled.as_slice().iter().map(columns) {
                    if filled.is_empty() || filled.start < next || filled.end > touched.end {
                        continue;
                    }
                    for column in next..filled.start {
                        self.edge(samples, places, geometry, &reach, (column, row));
                    }
                    let line = places.line(self, row, filled.clone());
                    samples.push_line(&self.columns, geometry, line);
                    let (pixel, count) = (self.pixel(filled.start, row), filled.len() as u32);
                    samples.spans.push(Span::Pixels { pixel, count });
                    next = filled.end;
                }
                for column in next..touched.end {
                    self.edge(samples, places, geometry, &reach, (column, row));
                }
                next = touched.end;
            }
            self.unseen(samples, geometry, row, next..end);
        }
    }

    fn pixel(&self, column: usize, row: usize) -> u32 {
        (row * self.size + column) as u32
    }

    /// Which pixels of a row the lit lens touches and fills.
    fn row(&self, geometry: &Geometry, row: usize) -> Row {
        let at = |part: f64| self.up(row as f64 + part);
        if at(1.0) >= 1.0 || at(0.0) <= -1.0 {
            // Above or below the sphere.
            return Row::default();
        }
        // The lower half is walked upwards, so that a pixel and its mirror image sum the same
        // numbers in the same order and agree to the last bit.
        let lines: [Line; EDGE_GRID] = std::array::from_fn(|i| {
            let i = if 2 * row < self.size {
                i
            } else {
                EDGE_GRID - 1 - i
            };
            let part = |i: usize| i as f64 / EDGE_GRID as f64;
            Line::of(geometry, at(part(i + 1)), at(part(i)))
        });
        // Counted from the nearer side, so that mirrored stretches have mirrored pixels.
        let (size, middle) = (self.size as f64, self.size as f64 / 2.0);
        let before = |unit: f64| match unit * self.outline() {
            at if at <= 0.0 => (middle + at).floor(),
            at => size - (middle - at).ceil(),
        };
        let after = |unit: f64| size - before(-unit);
        let whole = |stretches: &Stretches, outwards: bool| {
            let mut whole = Stretches::default();
            for &(from, to) in stretches.as_slice() {
                let (from, to) = match outwards {
                    true => (before(from), after(to)),
                    false => (after(from), before(to)),
                };
                whole.push((from.clamp(0.0, size), to.clamp(0.0, size)));
            }
            whole
        };
        let borders = [geometry.lit(at(0.0)), geometry.lit(at(1.0))];
        if let Some((touched, filled)) = plain(&lines, &borders) {
            return Row {
                touched: whole(&touched, true),
                filled: whole(&filled, false),
                lines,
            };
        }
        let mut touched = Stretches::default();
        let mut filled = whole(&borders[0], false).and(&whole(&borders[1], false));
        for line in &lines {
            touched = touched.or(&whole(&line.lit, true));
            filled = filled.and(&whole(&line.lit, false));
        }
        Row {
            lines,
            touched,
            filled,
        }
    }

    /// Pixels that nobody sees: shaded to show what skipping saves, and counted for nothing. What
    /// is outside the sphere counts as its middle.
    fn unseen(
        &self,
        samples: &mut Samples,
        geometry: &Geometry,
        row: usize,
        columns: Range<usize>,
    ) {
        if !self.everywhere || columns.is_empty() {
            return;
        }
        let count = columns.len() as u32;
        let y = self.up(row as f64 + 0.5);
        for column in columns {
            let x = self.unit(column as f64 + 0.5);
            let q2 = 1.0 - (x * x + y * y);
            let [x, y, q] = match q2 >= 0.0 {
                true => [x, y, q2.sqrt()],
                false => [0.0, 0.0, 1.0],
            };
            samples.push(&self.columns, &geometry.at(x, y, q));
        }
        samples.spans.push(Span::Unseen { count });
    }

    /// A pixel that an edge of the lens crosses: the mean over its lit part, line by line.
    fn edge(
        &self,
        samples: &mut Samples,
        places: &mut Places,
        geometry: &Geometry,
        reach: &Row,
        (column, row): (usize, usize),
    ) {
        let before = samples.shares.len();
        let (left, right) = (self.unit(column as f64), self.unit(column as f64 + 1.0));
        // The right half is walked to the left, as its mirror image is walked to the right: both
        // sum the same numbers in the same order.
        let turned = 2 * column >= self.size;
        let (left, right) = if turned {
            (-right, -left)
        } else {
            (left, right)
        };
        let side = if turned { -1.0 } else { 1.0 };
        for (index, line) in reach.lines.iter().enumerate() {
            let rho = line.rho;
            let lit = line.lit.as_slice();
            for place in 0..lit.len() {
                let (from, to) = if turned {
                    let (from, to) = lit[lit.len() - 1 - place];
                    (-to, -from)
                } else {
                    lit[place]
                };
                let stretch = Stretch {
                    rho,
                    from: from.max(left),
                    to: to.min(right),
                    whole: (right - left) * EDGE_GRID as f64 / line.share,
                };
                if stretch.from >= stretch.to {
                    continue;
                }
                let mut push = |place: [f64; 3], share: f32| {
                    samples.push_share(&self.columns, geometry, place, share);
                };
                // What the sphere has of the line, whatever the light.
                let uncut = stretch.from == left.max(-rho) && stretch.to == right.min(rho);
                if uncut && stretch.grows() {
                    let known = places.edge((column, row), index, &stretch);
                    known
                        .iter()
                        .for_each(|&(x, q, share)| push([side * x, line.y, q], share));
                } else {
                    stretch.sample(|x, q, share| push([side * x, line.y, q], share));
                }
            }
        }
        let count = (samples.shares.len() - before) as u32;
        if count > 0 {
            let pixel = self.pixel(column, row);
            samples.spans.push(Span::Edge { pixel, count });
        } else {
            self.unseen(samples, geometry, row, column..column + 1);
        }
    }
}

/// What is touched and what is filled where every line has one stretch and all overlap: nearly
/// everywhere.
fn plain(lines: &[Line; EDGE_GRID], borders: &[Stretches; 2]) -> Option<(Stretches, Stretches)> {
    let one = |stretches: &Stretches| match stretches.as_slice() {
        [only] => Some(*only),
        _ => None,
    };
    let (mut touched, mut filled) = (one(&lines[0].lit)?, one(&lines[0].lit)?);
    for line in &lines[1..] {
        let (from, to) = one(&line.lit)?;
        touched = (touched.0.min(from), touched.1.max(to));
        filled = (filled.0.max(from), filled.1.min(to));
    }
    for border in borders {
        let (from, to) = one(border)?;
        filled = (filled.0.max(from), filled.1.min(to));
    }
    let stretch = |stretch| {
        let mut stretches = Stretches::default();
        stretches.push(stretch);
        stretches
    };
    (filled.0 < filled.1).then(|| (stretch(touched), stretch(filled)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Eye, Light};

    const SIZE: usize = 200;

    fn panel() -> Panel {
        Panel {
            size: SIZE,
            radius: 0.94,
            everywhere: false,
            half: false,
            columns: [true; VARYING.len()],
        }
    }

    /// The sampled area is the expected one, in squares of the radius, and every sample is lit.
    #[track_caller]
    fn check_area(eye: Eye, light: Light, expected: f64) {
        let panel = panel();
        let samples = panel.samples(&Geometry::new(eye, &light), 0, panel.size);
        let covered = |part: Part<'_>| match part {
            Part::Pixels { count, .. } => count as f64,
            Part::Edge { shares, .. } => shares.iter().map(|share| f64::from(*share)).sum(),
        };
        let area = samples.parts().map(covered).sum::<f64>() / panel.outline().powi(2);
        assert!(
            (area - expected).abs() < 2e-3 * expected,
            "{eye:?}, {light:?}: {area} instead of {expected}"
        );
        for i in 0..samples.len() {
            assert!(
                samples.columns[0][i] > 0.0 && samples.columns[1][i] > 0.0,
                "sample {i}: {eye:?}, {light:?}"
            );
        }
    }

    /// The area of the disc in which the normal, found by shooting a ray at the sphere, is turned
    /// to the light.
    fn shot(eye: Eye, light: &Light) -> f64 {
        const STEPS: i32 = 1500;
        let (deg, turn) = (light.deg.to_radians(), light.turn_deg.to_radians());
        let towards = [deg.sin() * turn.cos(), deg.sin() * turn.sin(), deg.cos()];
        let unit = |step: i32| (2.0 * f64::from(step) + 1.0) / f64::from(STEPS) - 1.0;
        let normal = |x: f64, y: f64| match eye {
            Eye::Orthographic => [x, y, (1.0 - x * x - y * y).sqrt()],
            Eye::Perspective { distance } => {
                // The outline is seen at tan = 1/√(distance² − 1).
                let tan = 1.0 / (distance * distance - 1.0).sqrt();
                let ray = [x * tan, y * tan, -1.0];
                let length2 = ray[0] * ray[0] + ray[1] * ray[1] + 1.0;
                let along = distance
                    * (1.0 - (1.0 - length2 * (1.0 - 1.0 / (distance * distance))).sqrt())
                    / length2;
                [ray[0] * along, ray[1] * along, distance - along]
            }
        };
        let lit = |x: f64, y: f64| {
            let n = normal(x, y);
            let facing: f64 = (0..3).map(|i| n[i] * towards[i]).sum();
            facing > light.distance.map_or(0.0, |distance| 1.0 / distance)
        };
        let places = (0..STEPS).flat_map(|row| (0..STEPS).map(move |column| (row, column)));
        let hits = places
            .map(|(row, column)| (unit(column), unit(row)))
            .filter(|(x, y)| x * x + y * y < 1.0 && lit(*x, *y))
            .count();
        4.0 * hits as f64 / f64::from(STEPS).powi(2)
    }

    #[test]
    fn the_lens_is_sampled_and_nothing_else() {
        for deg in [0.0, 30.0, 60.0, 90.0, 130.0] {
            for turn_deg in [0.0, 45.0, 90.0, 180.0, 260.0] {
                let light = Light {
                    turn_deg,
                    ..Light::distant(deg)
                };
                // The area of the lit lens is π/2 (1 + cos light) of the radius squared.
                let area = std::f64::consts::FRAC_PI_2 * (1.0 + deg.to_radians().cos());
                check_area(Eye::Orthographic, light, area);
            }
        }
    }

    #[test]
    fn the_lens_of_a_near_light_or_eye_is_sampled_and_nothing_else() {
        let light = |deg, turn_deg, distance| Light {
            turn_deg,
            distance,
            ..Light::distant(deg)
        };
        let near = Eye::Perspective { distance: 1.8 };
        for (eye, light) in [
            (Eye::Orthographic, light(40.0, 30.0, Some(1.5))),
            (Eye::Orthographic, light(100.0, 120.0, Some(3.0))),
            (near, light(0.0, 0.0, None)),
            (near, light(70.0, 0.0, None)),
            (near, light(110.0, 90.0, None)),
            (near, light(35.0, 200.0, Some(1.2))),
            (
                Eye::Perspective { distance: 40.0 },
                light(80.0, 77.0, Some(9.0)),
            ),
        ] {
            check_area(eye, light, shot(eye, &light));
        }
    }
}
