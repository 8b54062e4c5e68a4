//! Both panels as they are shaded: what is kept of each pixel, and how samples add up to it.

use crate::sample::{Part, Samples};
use crate::shade::{Job, Values};
use std::ops::Range;

/// Both panels, or some rows of them, from the top.
///
/// Values of several channels stand side by side for each pixel.
#[derive(Clone, Debug, Default)]
pub(crate) struct Shaded {
    /// Values that stand side by side for each pixel.
    channels: usize,
    /// Linear values, each pixel the mean over its area; empty unless asked for, and then the
    /// other columns are.
    pub right: Vec<f64>,
    pub wrong: Vec<f64>,
    /// What is seen of each pixel: exposed and cut at white before it is averaged over the
    /// pixel. A rim far brighter than white would else show stairs.
    pub right_seen: Vec<f32>,
    pub wrong_seen: Vec<f32>,
    /// The share of each pixel that is lit and seen.
    pub lit: Vec<f32>,
    /// The share of each pixel in which the wrong value is the greater.
    pub brighter: Vec<f32>,
    /// Mean over each pixel's lit part of log2(wrong / right).
    pub stops: Vec<f32>,
    /// Pixels that were evaluated for at least one light.
    pub pixels: u64,
    /// Points at which the formulas were evaluated, under each light.
    pub points: u64,
}

/// Luminance of linear red, green and blue (Rec. 709), or a grey value itself.
pub(crate) fn luminance(channels: &[f64]) -> f64 {
    match channels {
        [red, green, blue] if red == green && green == blue => *red,
        [red, green, blue] => 0.2126 * red + 0.7152 * green + 0.0722 * blue,
        _ => channels.iter().sum(),
    }
}

/// Makes a column that long and all 0, in the memory it has if that will do.
fn blank<T: Clone + Default>(column: &mut Vec<T>, len: usize) {
    if column.capacity() < len {
        // Fresh memory is 0 already: what is never written to costs nothing.
        *column = vec![T::default(); len];
    } else {
        column.clear();
        column.resize(len, T::default());
    }
}

impl Shaded {
    /// So many pixels, all black; linear values or what is seen.
    pub fn start(&mut self, pixels: usize, channels: usize, raw: bool) {
        let (linear, seen) = if raw { (pixels, 0) } else { (0, pixels) };
        blank(&mut self.right, channels * linear);
        blank(&mut self.wrong, channels * linear);
        blank(&mut self.right_seen, channels * seen);
        blank(&mut self.wrong_seen, channels * seen);
        blank(&mut self.lit, seen);
        blank(&mut self.brighter, seen);
        blank(&mut self.stops, seen);
        (self.channels, self.pixels, self.points) = (channels, 0, 0);
    }

    /// Values that stand side by side for each pixel.
    pub fn channels(&self) -> usize {
        self.channels.max(1)
    }

    /// All of it, to be filled.
    pub fn rows(&mut self) -> Rows<'_> {
        Rows {
            channels: self.channels(),
            right: &mut self.right,
            wrong: &mut self.wrong,
            right_seen: &mut self.right_seen,
            wrong_seen: &mut self.wrong_seen,
            lit: &mut self.lit,
            brighter: &mut self.brighter,
            stops: &mut self.stops,
        }
    }

    /// Drops the first so many pixels.
    pub fn drop_pixels(&mut self, pixels: usize) {
        let values = pixels * self.channels();
        for column in [&mut self.right, &mut self.wrong] {
            column.drain(..values.min(column.len()));
        }
        for column in [&mut self.right_seen, &mut self.wrong_seen] {
            column.drain(..values.min(column.len()));
        }
        for column in [&mut self.lit, &mut self.brighter, &mut self.stops] {
            column.drain(..pixels.min(column.len()));
        }
    }

    /// Adds rows that stand below these.
    pub fn append(&mut self, below: Self) {
        if self.lit.is_empty() && self.right.is_empty() {
            let (pixels, points) = (self.pixels, self.points);
            *self = below;
            self.pixels += pixels;
            self.points += points;
            return;
        }
        self.right.extend_from_slice(&below.right);
        self.wrong.extend_from_slice(&below.wrong);
        self.right_seen.extend_from_slice(&below.right_seen);
        self.wrong_seen.extend_from_slice(&below.wrong_seen);
        self.lit.extend_from_slice(&below.lit);
        self.brighter.extend_from_slice(&below.brighter);
        self.stops.extend_from_slice(&below.stops);
        self.pixels += below.pixels;
        self.points += below.points;
    }
}

/// Some rows of [`Shaded`] that one thread fills; a column that is not kept is empty.
#[derive(Debug)]
pub(crate) struct Rows<'a> {
    channels: usize,
    right: &'a mut [f64],
    wrong: &'a mut [f64],
    right_seen: &'a mut [f32],
    wrong_seen: &'a mut [f32],
    lit: &'a mut [f32],
    brighter: &'a mut [f32],
    stops: &'a mut [f32],
}

/// The first so many values and the rest; of an empty column both are empty.
fn split<T>(column: &mut [T], at: usize) -> (&mut [T], &mut [T]) {
    column.split_at_mut(at.min(column.len()))
}

impl<'a> Rows<'a> {
    /// How many pixels there are.
    pub fn len(&self) -> usize {
        self.lit.len().max(self.right.len() / self.channels)
    }

    /// The first so many pixels and the rest.
    pub fn split_at(self, pixels: usize) -> (Self, Self) {
        let channels = self.channels;
        let values = channels * pixels;
        let (right, right_rest) = split(self.right, values);
        let (wrong, wrong_rest) = split(self.wrong, values);
        let (right_seen, right_seen_rest) = split(self.right_seen, values);
        let (wrong_seen, wrong_seen_rest) = split(self.wrong_seen, values);
        let (lit, lit_rest) = split(self.lit, pixels);
        let (brighter, brighter_rest) = split(self.brighter, pixels);
        let (stops, stops_rest) = split(self.stops, pixels);
        let first = Self {
            channels,
            right,
            wrong,
            right_seen,
            wrong_seen,
            lit,
            brighter,
            stops,
        };
        let rest = Self {
            channels,
            right: right_rest,
            wrong: wrong_rest,
            right_seen: right_seen_rest,
            wrong_seen: wrong_seen_rest,
            lit: lit_rest,
            brighter: brighter_rest,
            stops: stops_rest,
        };
        (first, rest)
    }

    /// Copies the left half of every row of `size` pixels to the right one.
    pub fn mirror_across(&mut self, size: usize) {
        fn flip<T: Copy>(values: &mut [T], size: usize, channels: usize) {
            for row in values.chunks_exact_mut(size * channels) {
                for column in 0..size / 2 {
                    let pixel = column * channels..(column + 1) * channels;
                    row.copy_within(pixel, (size - 1 - column) * channels);
                }
            }
        }
        for column in [&mut *self.right, &mut *self.wrong] {
            flip(column, size, self.channels);
        }
        for column in [&mut *self.right_seen, &mut *self.wrong_seen] {
            flip(column, size, self.channels);
        }
        for column in [&mut *self.lit, &mut *self.brighter, &mut *self.stops] {
            flip(column, size, 1);
        }
    }

    /// Copies the rows of `size` pixels in reverse order to what mirrors them, as many as there are
    /// from its end.
    pub fn mirror_to(&self, twin: &mut Rows<'_>, size: usize) {
        fn flip<T: Copy>(from: &[T], to: &mut [T], row: usize) {
            if row > 0 {
                let rows = from.chunks_exact(row).zip(to.rchunks_exact_mut(row));
                rows.for_each(|(from, to)| to.copy_from_slice(from));
            }
        }
        let values = size * self.channels;
        flip(self.right, twin.right, values);
        flip(self.wrong, twin.wrong, values);
        flip(self.right_seen, twin.right_seen, values);
        flip(self.wrong_seen, twin.wrong_seen, values);
        flip(self.lit, twin.lit, size);
        flip(self.brighter, twin.brighter, size);
        flip(self.stops, twin.stops, size);
    }

    /// Writes the samples under the only light there is; the rows start at pixel `first`. Every
    /// sample is cut at white by itself. How many pixels are lit.
    pub fn put_only(
        &mut self,
        samples: &Samples,
        values: &Values,
        first: usize,
        job: &Job<'_>,
    ) -> u64 {
        let weights = job.weights(0);
        let mut lit = 0;
        for part in samples.parts() {
            let (index, pixel, count, shares) = part.laid_out();
            let at = (index..index + count, pixel - first);
            match shares {
                None if job.raw => self.put_linear(samples, values, at, weights),
                None => self.put_seen(samples, values, at, job),
                Some(shares) => self.put_edge(samples, values, shares, at, job),
            }
            lit += match shares {
                None => count as u64,
                Some(shares) => u64::from(shares.iter().sum::<f32>() > 0.0),
            };
        }
        lit
    }

    /// The linear values of whole pixels.
    fn put_linear(
        &mut self,
        samples: &Samples,
        values: &Values,
        (from, pixel): (Range<usize>, usize),
        weights: &[f64],
    ) {
        let channels = weights.len();
        let to = pixel * channels..(pixel + from.len()) * channels;
        let arrives = samples.arrives.get(from.clone());
        let panels = [
            (&mut self.right, &values.right),
            (&mut self.wrong, &values.wrong),
        ];
        for (panel, values) in panels {
            let (panel, values) = (&mut panel[to.clone()], &values[from.clone()]);
            match (arrives, weights) {
                (None, [weight]) => {
                    let pairs = panel.iter_mut().zip(values);
                    pairs.for_each(|(to, value)| *to = value * weight);
                }
                _ => {
                    for (i, (pixel, value)) in
                        panel.chunks_exact_mut(channels).zip(values).enumerate()
                    {
                        let arrives = arrives.map_or(1.0, |arrives| arrives[i]);
                        for (to, weight) in pixel.iter_mut().zip(weights) {
                            *to = value * arrives * weight;
                        }
                    }
                }
            }
        }
    }

    /// What is seen of whole pixels.
    fn put_seen(
        &mut self,
        samples: &Samples,
        values: &Values,
        (from, pixel): (Range<usize>, usize),
        job: &Job<'_>,
    ) {
        let weights = job.weights(0);
        let channels = weights.len();
        let to = pixel * channels..(pixel + from.len()) * channels;
        let arrives = samples.arrives.get(from.clone());
        let panels = [
            (&mut self.right_seen, &values.right),
            (&mut self.wrong_seen, &values.wrong),
        ];
        for (panel, values) in panels {
            let (panel, values) = (&mut panel[to.clone()], &values[from.clone()]);
            match (arrives, weights) {
                (None, [weight]) => {
                    let pairs = panel.iter_mut().zip(values);
                    pairs.for_each(|(to, value)| *to = job.seen(value * weight));
                }
                _ => {
                    for (i, (pixel, value)) in
                        panel.chunks_exact_mut(channels).zip(values).enumerate()
                    {
                        let arrives = arrives.map_or(1.0, |arrives| arrives[i]);
                        for (to, weight) in pixel.iter_mut().zip(weights) {
                            *to = job.seen(value * arrives * weight);
                        }
                    }
                }
            }
        }
        let ratios = &values.ratio[from.clone()];
        let to = pixel..pixel + from.len();
        self.lit[to.clone()].fill(1.0);
        let brighter = self.brighter[to.clone()].iter_mut().zip(ratios);
        brighter.for_each(|(to, ratio)| *to = f32::from(u8::from(*ratio > 1.0)));
        let stops_of = self.stops[to].iter_mut().zip(ratios);
        stops_of.for_each(|(to, ratio)| *to = stops(*ratio));
    }

    /// One pixel on an edge.
    fn put_edge(
        &mut self,
        samples: &Samples,
        values: &Values,
        shares: &[f32],
        (from, pixel): (Range<usize>, usize),
        job: &Job<'_>,
    ) {
        let weights = job.weights(0);
        for (index, share) in from.zip(shares) {
            let arrives = samples.arrives.get(index).copied().unwrap_or(1.0);
            let (right, wrong) = (values.right[index], values.wrong[index]);
            for (channel, weight) in weights.iter().enumerate() {
                let at = pixel * weights.len() + channel;
                let (right, wrong) = (right * arrives * weight, wrong * arrives * weight);
                if job.raw {
                    self.right[at] += f64::from(*share) * right;
                    self.wrong[at] += f64::from(*share) * wrong;
                } else {
                    self.right_seen[at] += share * job.seen(right);
                    self.wrong_seen[at] += share * job.seen(wrong);
                }
            }
            if !job.raw {
                self.lit[pixel] += share;
                if values.ratio[index] > 1.0 {
                    self.brighter[pixel] += share;
                }
                self.stops[pixel] += share * stops(values.ratio[index]);
            }
        }
        if !job.raw {
            self.stops[pixel] /= self.lit[pixel].max(f32::MIN_POSITIVE);
        }
    }

    /// After the last of several lights: the sums, or what is seen of them. How many pixels are
    /// lit.
    pub fn put_sums(&mut self, sums: &Sums, job: &Job<'_>) -> u64 {
        let channels = self.channels;
        if job.raw {
            self.right.copy_from_slice(&sums.right);
            self.wrong.copy_from_slice(&sums.wrong);
        } else {
            self.lit.copy_from_slice(&sums.lit);
        }
        let mut count = 0;
        for (pixel, &lit) in sums.lit.iter().enumerate() {
            if lit == 0.0 {
                continue;
            }
            count += 1;
            if job.raw {
                continue;
            }
            let values = pixel * channels..(pixel + 1) * channels;
            for at in values.clone() {
                let seen = |sum: f64| lit * job.seen(sum / f64::from(lit));
                self.right_seen[at] = seen(sums.right[at]);
                self.wrong_seen[at] = seen(sums.wrong[at]);
            }
            let ratio = luminance(&sums.wrong[values.clone()]) / luminance(&sums.right[values]);
            self.brighter[pixel] = if ratio > 1.0 { lit } else { 0.0 };
            self.stops[pixel] = stops(ratio);
        }
        count
    }
}

/// What several lights give some pixels together.
#[derive(Debug, Default)]
pub(crate) struct Sums {
    right: Vec<f64>,
    wrong: Vec<f64>,
    lit: Vec<f32>,
}

impl Sums {
    /// So many pixels without any light.
    pub fn start(&mut self, pixels: usize, channels: usize) {
        blank(&mut self.right, pixels * channels);
        blank(&mut self.wrong, pixels * channels);
        blank(&mut self.lit, pixels);
    }

    /// Adds the samples under one of the lights.
    pub fn add(&mut self, samples: &Samples, values: &Values, first: usize, weights: &[f64]) {
        let channels = weights.len();
        for part in samples.parts() {
            let (from, pixel, count, shares) = part.laid_out();
            let pixel = pixel - first;
            let arrives = samples.arrives.get(from..from + count);
            let own = [
                (&mut self.right, &values.right[from..from + count]),
                (&mut self.wrong, &values.wrong[from..from + count]),
            ];
            for (sums, values) in own {
                // Nothing, times an infinite value, is nothing here.
                let shining = weights
                    .iter()
                    .enumerate()
                    .filter(|(_, weight)| **weight > 0.0);
                for (channel, weight) in shining {
                    let value = |i: usize| match arrives {
                        None => weight * values[i],
                        Some(arrives) => arrives[i] * weight * values[i],
                    };
                    match shares {
                        None if channels == 1 => {
                            let sums = &mut sums[pixel..pixel + count];
                            match arrives {
                                None => sums
                                    .iter_mut()
                                    .zip(values)
                                    .for_each(|(sum, value)| *sum += weight * value),
                                Some(_) => sums
                                    .iter_mut()
                                    .enumerate()
                                    .for_each(|(i, sum)| *sum += value(i)),
                            }
                        }
                        None => {
                            let sums = &mut sums[pixel * channels..(pixel + count) * channels];
                            let sums = sums.iter_mut().skip(channel).step_by(channels);
                            sums.enumerate().for_each(|(i, sum)| *sum += value(i));
                        }
                        Some(shares) => {
                            let shares = shares.iter().enumerate();
                            let mean: f64 = shares.map(|(i, s)| f64::from(*s) * value(i)).sum();
                            sums[pixel * channels + channel] += mean;
                        }
                    }
                }
            }
            match shares {
                None => self.lit[pixel..pixel + count].fill(1.0),
                Some(shares) => {
                    let lit = &mut self.lit[pixel];
                    *lit = lit.max(shares.iter().sum());
                }
            }
        }
    }
}

impl<'a> Part<'a> {
    /// The first sample, the first pixel, how many samples, and their shares where they are those
    /// of one pixel.
    fn laid_out(&self) -> (usize, usize, usize, Option<&'a [f32]>) {
        match *self {
            Part::Pixels {
                first,
                pixel,
                count,
            } => (first, pixel, count, None),
            Part::Edge {
                first,
                pixel,
                shares,
            } => (first, pixel, shares.len(), Some(shares)),
        }
    }
}

/// A ratio in stops, within what a mean can bear; 0/0 says nothing and counts as equal.
fn stops(ratio: f64) -> f32 {
    const MOST: f32 = 64.0;
    // 2 to the power `MOST`, and one over it: what is beyond either, and infinity, is one of them.
    const GREATEST: f32 = 18_446_744_073_709_551_616.0;
    let bounded = (ratio as f32).clamp(1.0 / GREATEST, GREATEST);
    debug_assert!(ratio.is_nan() || log2(bounded).abs() <= MOST);
    if ratio.is_nan() { 0.0 } else { log2(bounded) }
}

/// log2 of a normal positive number, within 2e-7 of its value or of one: without a call and a
/// branch, so that several are computed at once.
fn log2(x: f32) -> f32 {
    // The bits of √½: from there the exponent is counted, so that what is left is in [√½, √2).
    const FROM: i32 = 0x3f35_04f3;
    let bits = x.to_bits().cast_signed();
    let exponent = (bits - FROM) >> 23;
    let mantissa = f32::from_bits((bits - (exponent << 23)).cast_unsigned());
    // ln m = 2 artanh((m − 1) / (m + 1)), an odd series (Abramowitz and Stegun 4.1.27) of which
    // |s| < 0.172 needs five terms.
    const OVER_LN_2: f32 = 2.0 * std::f32::consts::LOG2_E;
    let s = (mantissa - 1.0) / (mantissa + 1.0);
    let z = s * s;
    let series = 1.0 + z * (1.0 / 3.0 + z * (1.0 / 5.0 + z * (1.0 / 7.0 + z * (1.0 / 9.0))));
    exponent as f32 + OVER_LN_2 * s * series
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn logarithms_are_those_of_the_library() {
        let mut worst = 0.0_f64;
        for bits in (0x0100_0000..0x7f00_0000_u32).step_by(4099) {
            let x = f32::from_bits(bits);
            let exact = f64::from(x).log2();
            worst = worst.max((f64::from(log2(x)) - exact).abs() / exact.abs().max(1.0));
        }
        assert!(worst < 2e-7, "{worst:e}");
        for i in 1..1000 {
            let x = 1.0 + i as f32 * 1e-6;
            let exact = f64::from(x).log2();
            let found = f64::from(log2(x));
            assert!((found - exact).abs() < 3e-7 * exact, "{x}: {found}");
        }
    }

    #[test]
    fn stops_are_bounded() {
        for (ratio, expected) in [
            (1.0, 0.0),
            (8.0, 3.0),
            (0.25, -2.0),
            (0.0, -64.0),
            (f64::INFINITY, 64.0),
            (1e300, 64.0),
            (1e-300, -64.0),
            (f64::NAN, 0.0),
        ] {
            assert_eq!(stops(ratio), expected, "{ratio}");
        }
    }
}
