//! From samples to two panels of linear values, and what only the samples know.

use crate::cpu::Cpu;
use crate::error::Error;
use crate::gpu::Gpu;
use crate::sample::{Panel, Samples};
use rayon::prelude::*;
use std::sync::atomic::{AtomicBool, Ordering};

/// Rows of a panel that are sampled and evaluated together: their samples stay in the cache.
const BAND: usize = 4;

/// Values of both formulas at some samples, negative ones and NaN as 0.
#[derive(Clone, Debug, Default)]
pub(crate) struct Values {
    pub right: Vec<f64>,
    pub wrong: Vec<f64>,
}

/// What evaluates the formulas.
pub(crate) enum Engine {
    Cpu(Cpu),
    Gpu(Box<Gpu>),
}

impl Engine {
    pub fn evaluate(&self, samples: &Samples) -> Result<Values, Error> {
        let mut values = match self {
            Self::Cpu(cpu) => cpu.evaluate(samples),
            Self::Gpu(gpu) => gpu.evaluate(samples)?,
        };
        for value in values.right.iter_mut().chain(&mut values.wrong) {
            // `max` also turns a NaN into 0.
            *value = value.max(0.0);
        }
        Ok(values)
    }
}

/// Both panels, rows from the top.
#[derive(Clone, Debug, Default)]
pub(crate) struct Shaded {
    pub right: Vec<f64>,
    pub wrong: Vec<f64>,
    /// The share of each pixel that is lit and seen.
    pub lit: Vec<f32>,
    /// Lit area in pixels, and the part of it in which the wrong value is the greater.
    pub lit_area: f64,
    pub brighter_area: f64,
    pub pixels: u64,
}

impl Shaded {
    fn empty(pixels: usize) -> Self {
        Self {
            right: vec![0.0; pixels],
            wrong: vec![0.0; pixels],
            lit: vec![0.0; pixels],
            ..Self::default()
        }
    }

    /// Adds the samples of the rows that start at pixel `first`.
    fn add(&mut self, samples: &Samples, values: &Values, first: usize) {
        let (mut lit_area, mut brighter_area) = (0.0, 0.0);
        for (index, &(pixel, share)) in samples.pixel.iter().enumerate() {
            if share == 0.0 {
                continue;
            }
            let pixel = pixel as usize - first;
            let (right, wrong, area) = (values.right[index], values.wrong[index], f64::from(share));
            self.right[pixel] += area * right;
            self.wrong[pixel] += area * wrong;
            self.lit[pixel] += share;
            lit_area += area;
            brighter_area += if wrong > right { area } else { 0.0 };
        }
        self.lit_area += lit_area;
        self.brighter_area += brighter_area;
        self.pixels += samples.pixels;
    }
}

/// Shades a whole panel. Bands are summed in their order, so the result does not depend on how
/// many threads there are.
pub(crate) fn shade(
    panel: &Panel,
    engine: &Engine,
    mirror: bool,
    cancel: &AtomicBool,
) -> Result<Shaded, Error> {
    let size = panel.size;
    let rows = if mirror { size.div_ceil(2) } else { size };
    let mut shaded = match engine {
        Engine::Cpu(_) => {
            let bands: Vec<usize> = (0..rows).step_by(BAND).collect();
            let band = |&first: &usize| {
                if cancel.load(Ordering::Relaxed) {
                    return Err(Error::Cancelled);
                }
                let last = (first + BAND).min(rows);
                let samples = panel.samples(first, last);
                let mut part = Shaded::empty((last - first) * size);
                part.add(&samples, &engine.evaluate(&samples)?, first * size);
                Ok(part)
            };
            let parts: Result<Vec<Shaded>, Error> = bands.par_iter().map(band).collect();
            let mut whole = Shaded::default();
            for part in parts? {
                whole.right.extend(part.right);
                whole.wrong.extend(part.wrong);
                whole.lit.extend(part.lit);
                whole.lit_area += part.lit_area;
                whole.brighter_area += part.brighter_area;
                whole.pixels += part.pixels;
            }
            whole
        }
        Engine::Gpu(_) => {
            let samples = panel.samples(0, rows);
            if cancel.load(Ordering::Relaxed) {
                return Err(Error::Cancelled);
            }
            let mut whole = Shaded::empty(rows * size);
            whole.add(&samples, &engine.evaluate(&samples)?, 0);
            whole
        }
    };
    if mirror {
        for row in rows..size {
            let twin = size - 1 - row;
            let range = twin * size..(twin + 1) * size;
            shaded.right.extend_from_within(range.clone());
            shaded.wrong.extend_from_within(range.clone());
            shaded.lit.extend_from_within(range);
        }
    }
    Ok(shaded)
}
