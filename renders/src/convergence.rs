//! What a picture's total does as it gets larger. A bug that is not integrable, such as dividing
//! twice under a headlight, never settles; that is a property of the bug, not of the renderer.

use crate::shade::luminance;
use crate::{Backend, Error, Fingerprint, Options, raw};

/// The light that reaches the eye from the whole disc, as the mean radiance over it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Total {
    /// Pixels a side of the panel it was measured on.
    pub size: u32,
    /// Mean of the right formula over the disc.
    pub right: f64,
    /// Mean of the wrong formula over the disc.
    pub wrong: f64,
}

/// The totals at several sizes, on the CPU.
///
/// # Errors
/// As [`raw`].
pub fn convergence(fingerprint: &Fingerprint<'_>, sizes: &[u32]) -> Result<Vec<Total>, Error> {
    let total = |&size: &u32| {
        let options = Options {
            size,
            backend: Backend::Cpu,
            ..Options::default()
        };
        let raw = raw(fingerprint, &options)?;
        let radius = fingerprint.scene.radius * f64::from(size) / 2.0;
        let disc = std::f64::consts::PI * radius * radius;
        let pixels = |values: &[f64]| -> f64 {
            let pixels = values.chunks_exact(raw.channels as usize);
            pixels.map(luminance).sum()
        };
        let mean = |values: &[f64]| pixels(values) / disc;
        Ok(Total {
            size,
            right: mean(&raw.right),
            wrong: mean(&raw.wrong),
        })
    };
    sizes.iter().map(total).collect()
}
