//! From samples to two panels of linear values, and what only the samples know.

use crate::cpu::Cpu;
use crate::error::Error;
use crate::gpu::Gpu;
use crate::sample::{Panel, Samples};
use rayon::prelude::*;
use std::sync::atomic::{AtomicBool, Ordering};

/// Rows of a panel that are sampled and evaluated together: their samples stay in the cache.
const BAND: usize = 4;

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
    Cpu(Box<Cpu>),
    Gpu(Box<Gpu>),
}

impl Engine {
    pub fn evaluate(&self, samples: &Samples) -> Result<Values, Error> {
        match self {
            Self::Cpu(cpu) => Ok(cpu.evaluate(samples)),
            Self::Gpu(gpu) => gpu.evaluate(samples),
        }
    }
}

/// Both panels, rows from the top.
#[derive(Clone, Debug, Default)]
pub(crate) struct Shaded {
    /// Linear values, each pixel the mean over its area; empty unless asked for.
    pub right: Vec<f64>,
    pub wrong: Vec<f64>,
    /// What is seen of each pixel: every sample exposed and cut at white before it is averaged.
    /// A rim far brighter than white would else show stairs.
    pub right_seen: Vec<f32>,
    pub wrong_seen: Vec<f32>,
    /// The share of each pixel that is lit and seen.
    pub lit: Vec<f32>,
    /// The share of each pixel in which the wrong value is the greater.
    pub brighter: Vec<f32>,
    /// Mean over each pixel's lit part of log2(wrong / right).
    pub stops: Vec<f32>,
    /// Pixels that were evaluated.
    pub pixels: u64,
}

impl Shaded {
    fn empty(pixels: usize, raw: bool) -> Self {
        let values = if raw { pixels } else { 0 };
        Self {
            right: vec![0.0; values],
            wrong: vec![0.0; values],
            right_seen: vec![0.0; pixels],
            wrong_seen: vec![0.0; pixels],
            lit: vec![0.0; pixels],
            brighter: vec![0.0; pixels],
            stops: vec![0.0; pixels],
            pixels: 0,
        }
    }

    /// Adds the samples of the rows that start at pixel `first`.
    fn add(&mut self, samples: &Samples, values: &Values, first: usize, exposure: f64) {
        let seen = |value: f64| (value * exposure).min(1.0) as f32;
        for (index, &(pixel, share)) in samples.pixel.iter().enumerate() {
            if share == 0.0 {
                continue;
            }
            let pixel = pixel as usize - first;
            let (right, wrong) = (values.right[index], values.wrong[index]);
            if let (Some(right_sum), Some(wrong_sum)) =
                (self.right.get_mut(pixel), self.wrong.get_mut(pixel))
            {
                *right_sum += f64::from(share) * right;
                *wrong_sum += f64::from(share) * wrong;
            }
            self.right_seen[pixel] += share * seen(right);
            self.wrong_seen[pixel] += share * seen(wrong);
            self.lit[pixel] += share;
            self.brighter[pixel] += if values.ratio[index] > 1.0 {
                share
            } else {
                0.0
            };
            self.stops[pixel] += share * stops(values.ratio[index]);
        }
        for (stops, lit) in self.stops.iter_mut().zip(&self.lit) {
            *stops /= lit.max(f32::MIN_POSITIVE);
        }
        self.pixels += samples.pixels;
    }

    fn append(&mut self, below: &Self) {
        self.right.extend_from_slice(&below.right);
        self.wrong.extend_from_slice(&below.wrong);
        self.right_seen.extend_from_slice(&below.right_seen);
        self.wrong_seen.extend_from_slice(&below.wrong_seen);
        self.lit.extend_from_slice(&below.lit);
        self.brighter.extend_from_slice(&below.brighter);
        self.stops.extend_from_slice(&below.stops);
        self.pixels += below.pixels;
    }

    /// Adds a copy of these pixels at the end, which were evaluated already.
    fn append_copy(&mut self, pixels: std::ops::Range<usize>) {
        if !self.right.is_empty() {
            self.right.extend_from_within(pixels.clone());
            self.wrong.extend_from_within(pixels.clone());
        }
        self.right_seen.extend_from_within(pixels.clone());
        self.wrong_seen.extend_from_within(pixels.clone());
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
    /// Evaluate the upper half only: the lower is its mirror image.
    pub mirror: bool,
    pub exposure: f64,
    /// Keep the linear values.
    pub raw: bool,
    pub cancel: &'a AtomicBool,
}

/// Shades a whole panel. Bands are put together in their order, so the result does not depend
/// on how many threads there are.
pub(crate) fn shade(job: &Job<'_>, engine: &Engine) -> Result<Shaded, Error> {
    let size = job.panel.size;
    let rows = if job.mirror { size.div_ceil(2) } else { size };
    let band = |first: usize, last: usize| {
        if job.cancel.load(Ordering::Relaxed) {
            return Err(Error::Cancelled);
        }
        let samples = job.panel.samples(first, last);
        let mut part = Shaded::empty((last - first) * size, job.raw);
        part.add(
            &samples,
            &engine.evaluate(&samples)?,
            first * size,
            job.exposure,
        );
        Ok(part)
    };
    let mut shaded = match engine {
        Engine::Cpu(_) => {
            let starts: Vec<usize> = (0..rows).step_by(BAND).collect();
            let parts: Result<Vec<Shaded>, Error> = starts
                .par_iter()
                .map(|&first| band(first, (first + BAND).min(rows)))
                .collect();
            let mut whole = Shaded::default();
            parts?.iter().for_each(|part| whole.append(part));
            whole
        }
        Engine::Gpu(_) => band(0, rows)?,
    };
    for row in rows..size {
        let twin = size - 1 - row;
        shaded.append_copy(twin * size..(twin + 1) * size);
    }
    Ok(shaded)
}
