//! From samples to two panels of linear values, and what only the samples know.

use crate::cpu::Cpu;
use crate::error::Error;
use crate::geometry::Geometry;
use crate::gpu::Gpu;
use crate::sample::{Panel, Part, Samples};
use rayon::prelude::*;
use std::ops::Range;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Samples that a graphics processor is given at once, about: what they need is bounded.
const TILE: usize = 1 << 20;

/// Rows of a panel that are sampled and evaluated together: their samples stay in the cache.
const BAND: usize = 4;
/// The same under several lights, each of which reaches fewer pixels of a row.
const BAND_OF_LIGHTS: usize = 32;

/// Values of both formulas at some samples, negative ones and NaN as 0, and their ratio.
#[derive(Clone, Debug, Default)]
pub(crate) struct Values {
    pub right: Vec<f64>,
    pub wrong: Vec<f64>,
    pub ratio: Vec<f64>,
}

impl Values {
    /// From both formulas; 0/0 leaves no ratio (NaN).
    pub fn of_both(mut right: Vec<f64>, mut wrong: Vec<f64>) -> Self {
        right.iter_mut().chain(&mut wrong).for_each(clamp);
        let ratio = right
            .iter()
            .zip(&wrong)
            .map(|(right, wrong)| wrong / right)
            .collect();
        Self {
            right,
            wrong,
            ratio,
        }
    }

    /// From the right formula and the ratio, which is known even where both values are 0.
    pub fn of_ratio(mut right: Vec<f64>, ratio: Vec<f64>) -> Self {
        let mut wrong: Vec<f64> = right
            .iter()
            .zip(&ratio)
            .map(|(right, ratio)| right * ratio)
            .collect();
        right.iter_mut().chain(&mut wrong).for_each(clamp);
        Self {
            right,
            wrong,
            ratio,
        }
    }
}

/// Negative radiance and NaN are black.
fn clamp(value: &mut f64) {
    // `max` also turns a NaN into 0.
    *value = value.max(0.0);
}

/// What evaluates the formulas.
pub(crate) enum Engine {
    Cpu(Arc<Cpu>),
    Gpu(Box<Gpu>),
    /// Nothing is to be evaluated.
    Idle,
}

impl Engine {
    /// What the graphics processor's own clock says all work so far took it, in milliseconds.
    pub fn device_ms(&self) -> Option<f64> {
        match self {
            Self::Gpu(gpu) => gpu.device_ms(),
            Self::Cpu(_) | Self::Idle => None,
        }
    }

    /// What it is, and the adapter's name.
    pub fn name(&self) -> (&'static str, Option<String>) {
        match self {
            Self::Gpu(gpu) => ("gpu", Some(gpu.adapter.clone())),
            Self::Cpu(_) | Self::Idle => ("cpu", None),
        }
    }
}

/// Both panels, or some rows of them, from the top.
///
/// Values of several channels stand side by side for each pixel.
#[derive(Clone, Debug, Default)]
pub(crate) struct Shaded {
    /// Linear values, each pixel the mean over its area; empty unless asked for.
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

impl Shaded {
    fn empty(pixels: usize, channels: usize, raw: bool) -> Self {
        let values = if raw { channels * pixels } else { 0 };
        Self {
            right: vec![0.0; values],
            wrong: vec![0.0; values],
            right_seen: vec![0.0; channels * pixels],
            wrong_seen: vec![0.0; channels * pixels],
            lit: vec![0.0; pixels],
            brighter: vec![0.0; pixels],
            stops: vec![0.0; pixels],
            pixels: 0,
            points: 0,
        }
    }

    /// Values that stand side by side for each pixel.
    pub fn channels(&self) -> usize {
        (self.right_seen.len() / self.lit.len().max(1)).max(1)
    }

    /// Adds the samples under the only light there is; the rows start at pixel `first`. Every
    /// sample is cut at white by itself.
    fn add_only(&mut self, samples: &Samples, values: &Values, first: usize, job: &Job<'_>) {
        let weights = job.weights(0);
        let mut add = |index: usize, pixel: usize, share: f32| {
            let (right, wrong) = (values.right[index], values.wrong[index]);
            let arrives = samples.arrives.get(index).copied().unwrap_or(1.0);
            for (channel, weight) in weights.iter().enumerate() {
                let at = pixel * weights.len() + channel;
                let (right, wrong) = (right * arrives * weight, wrong * arrives * weight);
                if let (Some(right_sum), Some(wrong_sum)) =
                    (self.right.get_mut(at), self.wrong.get_mut(at))
                {
                    *right_sum += f64::from(share) * right;
                    *wrong_sum += f64::from(share) * wrong;
                }
                self.right_seen[at] += share * job.seen(right);
                self.wrong_seen[at] += share * job.seen(wrong);
            }
            self.lit[pixel] += share;
            self.brighter[pixel] += if values.ratio[index] > 1.0 {
                share
            } else {
                0.0
            };
            self.stops[pixel] += share * stops(values.ratio[index]);
        };
        for part in samples.parts() {
            match part {
                Part::Pixels {
                    first: index,
                    pixel,
                    count,
                } => (0..count).for_each(|i| add(index + i, pixel - first + i, 1.0)),
                Part::Edge {
                    first: index,
                    pixel,
                    shares,
                } => {
                    for (i, share) in shares.iter().enumerate() {
                        add(index + i, pixel - first, *share);
                    }
                }
            }
        }
        for (stops, lit) in self.stops.iter_mut().zip(&self.lit) {
            *stops /= lit.max(f32::MIN_POSITIVE);
        }
    }

    /// Adds the samples under one of several lights to the linear values.
    fn add_light(&mut self, samples: &Samples, values: &Values, first: usize, weights: &[f64]) {
        let channels = weights.len();
        for part in samples.parts() {
            let (from, pixel, count, shares) = match part {
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
            };
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

    /// After the last of several lights: what is seen of their sum.
    fn finish(&mut self, channels: usize, job: &Job<'_>) {
        for (pixel, &lit) in self.lit.iter().enumerate() {
            if lit == 0.0 {
                continue;
            }
            let values = pixel * channels..(pixel + 1) * channels;
            for at in values.clone() {
                let seen = |sum: f64| lit * job.seen(sum / f64::from(lit));
                self.right_seen[at] = seen(self.right[at]);
                self.wrong_seen[at] = seen(self.wrong[at]);
            }
            let ratio = luminance(&self.wrong[values.clone()]) / luminance(&self.right[values]);
            self.brighter[pixel] = if ratio > 1.0 { lit } else { 0.0 };
            self.stops[pixel] = stops(ratio);
        }
        if !job.raw {
            self.right = Vec::new();
            self.wrong = Vec::new();
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

    pub fn append(&mut self, below: &Self) {
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

    /// Adds a copy of these pixels at the end, which were evaluated already.
    fn append_copy(&mut self, pixels: Range<usize>, channels: usize) {
        let values = pixels.start * channels..pixels.end * channels;
        if !self.right.is_empty() {
            self.right.extend_from_within(values.clone());
            self.wrong.extend_from_within(values.clone());
        }
        self.right_seen.extend_from_within(values.clone());
        self.wrong_seen.extend_from_within(values);
        self.lit.extend_from_within(pixels.clone());
        self.brighter.extend_from_within(pixels.clone());
        self.stops.extend_from_within(pixels);
    }
}

/// A ratio in stops, within what a mean can bear; 0/0 says nothing and counts as equal.
fn stops(ratio: f64) -> f32 {
    const MOST: f32 = 64.0;
    if ratio.is_nan() {
        0.0
    } else {
        (ratio as f32).log2().clamp(-MOST, MOST)
    }
}

/// What is shaded and how.
pub(crate) struct Job<'a> {
    pub panel: Panel,
    /// The sphere under each light that counts, and what each channel of that light is
    /// multiplied by.
    pub lights: Vec<(Geometry, [f64; 3])>,
    /// 1 where all lights are grey, else 3.
    pub channels: usize,
    /// Evaluate the upper half only: the lower is its mirror image.
    pub mirror: bool,
    pub exposure: f64,
    /// Keep the linear values.
    pub raw: bool,
    pub cancel: &'a AtomicBool,
}

impl Job<'_> {
    fn weights(&self, light: usize) -> &[f64] {
        &self.lights[light].1[..self.channels]
    }

    /// A linear value as it is seen: exposed, and cut at white.
    fn seen(&self, value: f64) -> f32 {
        (value * self.exposure).min(1.0) as f32
    }

    /// Some rows, evaluated together.
    fn rows(&self, engine: &Engine, rows: Range<usize>) -> Result<Shaded, Error> {
        if self.cancel.load(Ordering::Relaxed) {
            return Err(Error::Cancelled);
        }
        let size = self.panel.size;
        let first = rows.start * size;
        let several = self.lights.len() > 1;
        let mut part = Shaded::empty(rows.len() * size, self.channels, self.raw || several);
        let add = |part: &mut Shaded, light: usize, samples: &Samples, values: &Values| {
            part.points += samples.len() as u64;
            match several {
                true => part.add_light(samples, values, first, self.weights(light)),
                false => part.add_only(samples, values, first, self),
            }
        };
        match engine {
            // A core's cache holds the samples under one light.
            Engine::Cpu(cpu) => {
                let mut samples = Samples::default();
                for (light, (geometry, _)) in self.lights.iter().enumerate() {
                    self.panel
                        .fill(&mut samples, geometry, rows.start, rows.end);
                    add(&mut part, light, &samples, &cpu.evaluate(&samples));
                }
            }
            // A graphics processor wants them all at once.
            Engine::Gpu(gpu) => {
                let under = |(geometry, _): &(Geometry, [f64; 3])| {
                    self.panel.samples(geometry, rows.start, rows.end)
                };
                let samples: Vec<Samples> = self.lights.iter().map(under).collect();
                let values = gpu.evaluate(&samples)?;
                for (light, (samples, values)) in samples.iter().zip(&values).enumerate() {
                    add(&mut part, light, samples, values);
                }
            }
            Engine::Idle => {}
        }
        if several {
            part.finish(self.channels, self);
        }
        let lit = part.lit.iter().filter(|lit| **lit > 0.0).count();
        part.pixels = match self.panel.everywhere && !self.lights.is_empty() {
            true => (rows.len() * size) as u64,
            false => lit as u64,
        };
        Ok(part)
    }

    /// Some rows of the panel, in bands that are put together in their order, so that the result
    /// does not depend on how many threads there are.
    pub fn shade(&self, engine: &Engine, rows: Range<usize>) -> Result<Shaded, Error> {
        let band = match engine {
            Engine::Cpu(_) if self.lights.len() > 1 => BAND_OF_LIGHTS,
            Engine::Cpu(_) | Engine::Idle => BAND,
            Engine::Gpu(_) => {
                (TILE / self.panel.size / self.lights.len().max(1)).clamp(1, rows.len().max(1))
            }
        };
        let starts: Vec<usize> = rows.clone().step_by(band).collect();
        let band = |&first: &usize| self.rows(engine, first..(first + band).min(rows.end));
        let parts: Result<Vec<Shaded>, Error> = match engine {
            Engine::Cpu(_) | Engine::Idle => starts.par_iter().map(band).collect(),
            Engine::Gpu(_) => starts.iter().map(band).collect(),
        };
        let mut whole = Shaded::default();
        parts?.iter().for_each(|part| whole.append(part));
        Ok(whole)
    }
}

/// Shades a whole panel.
pub(crate) fn shade(job: &Job<'_>, engine: &Engine) -> Result<Shaded, Error> {
    let size = job.panel.size;
    let rows = if job.mirror { size.div_ceil(2) } else { size };
    let mut shaded = job.shade(engine, 0..rows)?;
    for row in rows..size {
        let twin = size - 1 - row;
        shaded.append_copy(twin * size..(twin + 1) * size, job.channels);
    }
    Ok(shaded)
}
