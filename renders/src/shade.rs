//! From samples to two panels of linear values, and what only the samples know.

use crate::cpu::Cpu;
use crate::error::Error;
use crate::geometry::Geometry;
use crate::gpu::Gpu;
use crate::places::Places;
use crate::sample::{Panel, Samples};
use crate::shaded::{Rows, Sums};
use rayon::prelude::*;
use std::cell::RefCell;
use std::ops::Range;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

pub(crate) use crate::shaded::{Shaded, luminance};

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
    pub fn of_both(right: Vec<f64>, wrong: Vec<f64>) -> Self {
        let mut values = Self {
            ratio: vec![0.0; right.len()],
            right,
            wrong,
        };
        values.divide();
        values
    }

    /// From the right formula and the ratio, which is known even where both values are 0.
    pub fn of_ratio(right: Vec<f64>, ratio: Vec<f64>) -> Self {
        let mut values = Self {
            wrong: vec![0.0; right.len()],
            right,
            ratio,
        };
        values.multiply();
        values
    }

    /// Room for so many.
    pub fn resize(&mut self, count: usize) {
        for column in [&mut self.right, &mut self.wrong, &mut self.ratio] {
            column.resize(count, 0.0);
        }
    }

    /// Finds the ratio, once both values are there.
    pub fn divide(&mut self) {
        let pairs = self.right.iter_mut().zip(&mut self.wrong);
        for ((right, wrong), ratio) in pairs.zip(&mut self.ratio) {
            // `max` also turns a NaN into 0.
            (*right, *wrong) = (right.max(0.0), wrong.max(0.0));
            *ratio = *wrong / *right;
        }
    }

    /// Finds the wrong value, once the right one and the ratio are there.
    pub fn multiply(&mut self) {
        let pairs = self.right.iter_mut().zip(&mut self.wrong);
        for ((right, wrong), ratio) in pairs.zip(&self.ratio) {
            *wrong = (*right * ratio).max(0.0);
            *right = right.max(0.0);
        }
    }
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

/// Memory of a thread, used again for every band.
#[derive(Default)]
struct Work {
    places: Places,
    samples: Samples,
    values: Values,
    sums: Sums,
}

thread_local! {
    static WORK: RefCell<Work> = RefCell::new(Work::default());
}

/// Some rows that are evaluated together, where they go, and what mirrors them.
struct Band<'a> {
    rows: Range<usize>,
    into: Rows<'a>,
    twin: Option<Rows<'a>>,
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
    /// Keep the linear values, and not what is seen.
    pub raw: bool,
    pub cancel: &'a AtomicBool,
}

impl Job<'_> {
    pub fn weights(&self, light: usize) -> &[f64] {
        &self.lights[light].1[..self.channels]
    }

    /// A linear value as it is seen: exposed, and cut at white.
    pub fn seen(&self, value: f64) -> f32 {
        (value * self.exposure).min(1.0) as f32
    }

    /// Some rows, evaluated together: how many pixels are lit, and at how many points the formulas
    /// were evaluated.
    fn band(&self, engine: &Engine, band: Band<'_>) -> Result<(u64, u64), Error> {
        if self.cancel.load(Ordering::Relaxed) {
            return Err(Error::Cancelled);
        }
        WORK.with_borrow_mut(|work| {
            let Work {
                places,
                samples,
                values,
                sums,
            } = work;
            let Band {
                rows,
                mut into,
                twin,
            } = band;
            let size = self.panel.size;
            let first = rows.start * size;
            let several = self.lights.len() > 1;
            if several {
                sums.start(rows.len() * size, self.channels);
            }
            let (mut lit, mut points) = (0, 0);
            let mut put = |light: usize, samples: &Samples, values: &Values| {
                points += samples.len() as u64;
                match several {
                    true => sums.add(samples, values, first, self.weights(light)),
                    false => lit = into.put_only(samples, values, first, self),
                }
            };
            places.start(&self.panel, rows.clone());
            match engine {
                // A core's cache holds the samples under one light.
                Engine::Cpu(cpu) => {
                    for (light, (geometry, _)) in self.lights.iter().enumerate() {
                        self.panel.fill(samples, places, geometry);
                        cpu.evaluate_into(samples, values);
                        put(light, samples, values);
                    }
                }
                // A graphics processor wants them all at once.
                Engine::Gpu(gpu) => {
                    let mut under = |(geometry, _): &(Geometry, [f64; 3])| {
                        let mut samples = Samples::default();
                        self.panel.fill(&mut samples, places, geometry);
                        samples
                    };
                    let samples: Vec<Samples> = self.lights.iter().map(&mut under).collect();
                    let values = gpu.evaluate(&samples)?;
                    for (light, (samples, values)) in samples.iter().zip(&values).enumerate() {
                        put(light, samples, values);
                    }
                }
                Engine::Idle => {}
            }
            if several {
                lit = into.put_sums(sums, self);
            }
            if self.panel.half {
                into.mirror_across(size);
            }
            if let Some(mut twin) = twin {
                into.mirror_to(&mut twin, size);
            }
            let pixels = match self.panel.everywhere && !self.lights.is_empty() {
                true => (rows.len() * size) as u64,
                false => lit,
            };
            Ok((pixels, points))
        })
    }

    /// Some rows of the panel.
    pub fn shade(&self, engine: &Engine, rows: Range<usize>) -> Result<Shaded, Error> {
        let mut shaded = Shaded::default();
        shaded.start(rows.len() * self.panel.size, self.channels, self.raw);
        self.shade_into(engine, rows, &mut shaded, false)?;
        Ok(shaded)
    }

    /// Some rows of the panel, in bands of rows that are put where they belong, so that the result
    /// does not depend on how many threads there are; if they are to be mirrored, their images
    /// below them.
    fn shade_into(
        &self,
        engine: &Engine,
        rows: Range<usize>,
        shaded: &mut Shaded,
        mirror: bool,
    ) -> Result<(), Error> {
        let height = match engine {
            Engine::Cpu(_) if self.lights.len() > 1 => BAND_OF_LIGHTS,
            Engine::Cpu(_) | Engine::Idle => BAND,
            Engine::Gpu(_) => {
                (TILE / self.panel.size / self.lights.len().max(1)).clamp(1, rows.len().max(1))
            }
        };
        let size = self.panel.size;
        let (mut above, mut below) = shaded.rows().split_at(rows.len() * size);
        let mut bands = Vec::with_capacity(rows.len().div_ceil(height));
        for first in rows.clone().step_by(height) {
            let rows = first..(first + height).min(rows.end);
            let (into, rest) = above.split_at(rows.len() * size);
            above = rest;
            let twin = match mirror {
                true => {
                    // A row in the middle is its own image.
                    let left = below.len().saturating_sub(rows.len() * size);
                    let (rest, twin) = below.split_at(left);
                    below = rest;
                    Some(twin)
                }
                false => None,
            };
            bands.push(Band { rows, into, twin });
        }
        let band = |band: Band<'_>| self.band(engine, band);
        let counts: Result<Vec<(u64, u64)>, Error> = match engine {
            Engine::Cpu(_) | Engine::Idle => bands.into_par_iter().map(band).collect(),
            Engine::Gpu(_) => bands.into_iter().map(band).collect(),
        };
        for (pixels, points) in counts? {
            shaded.pixels += pixels;
            shaded.points += points;
        }
        Ok(())
    }
}

/// Shades a whole panel.
pub(crate) fn shade(job: &Job<'_>, engine: &Engine) -> Result<Shaded, Error> {
    let mut shaded = Shaded::default();
    shade_again(job, engine, &mut shaded)?;
    Ok(shaded)
}

/// The same into memory that is there already.
pub(crate) fn shade_again(
    job: &Job<'_>,
    engine: &Engine,
    shaded: &mut Shaded,
) -> Result<(), Error> {
    let size = job.panel.size;
    shaded.start(size * size, job.channels, job.raw);
    let rows = if job.mirror { size.div_ceil(2) } else { size };
    job.shade_into(engine, 0..rows, shaded, job.mirror)
}
