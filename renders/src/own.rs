//! A shader that is no formula in place of the wrong one: somebody's own, whatever runs it.

use crate::error::Error;
use crate::plan::Plan;
use crate::scene::VARYING;
use crate::{Fingerprint, Options, Picture, ProfilePoint, profile, render_planned};
use formula::Column;
use std::fmt;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// Computes many points at once: the arguments of each, in the order of the parameters.
type Shade = dyn Fn(&[Vec<f32>]) -> Vec<f32> + Send + Sync;

/// A function of some of a scene's quantities, to be drawn beside the right formula.
#[derive(Clone)]
pub struct Own {
    params: Vec<String>,
    shade: Arc<Shade>,
}

impl fmt::Debug for Own {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Own").field("params", &self.params).finish()
    }
}

impl Own {
    /// `params` are names that formulas of the scene may use (`n_dot_l`, `roughness`, …); `shade`
    /// gives a value for each point that it is given, NaN where it has none.
    pub fn new(
        params: Vec<String>,
        shade: impl Fn(&[Vec<f32>]) -> Vec<f32> + Send + Sync + 'static,
    ) -> Self {
        Self {
            params,
            shade: Arc::new(shade),
        }
    }

    /// Where the scene's inputs hold each parameter.
    pub(crate) fn places(&self, inputs: &[&str]) -> Result<Vec<usize>, Error> {
        self.params
            .iter()
            .map(|param| {
                let place = inputs.iter().position(|name| name == param);
                place.ok_or_else(|| Error::Scene(format!("the scene gives no {param}")))
            })
            .collect()
    }

    /// The values at some points, whose inputs stand in columns.
    pub(crate) fn evaluate(&self, places: &[usize], columns: &[Column<'_, f64>], out: &mut [f64]) {
        let value = |place: usize, point: usize| match columns[place] {
            Column::Uniform(value) => value as f32,
            Column::Varying(values) => values[point] as f32,
        };
        let row = |point| places.iter().map(|place| value(*place, point)).collect();
        let rows: Vec<Vec<f32>> = (0..out.len()).map(row).collect();
        out.fill(f64::NAN);
        for (out, value) in out.iter_mut().zip((self.shade)(&rows)) {
            *out = f64::from(value);
        }
    }
}

/// What is computed for a shader that is no formula: nothing cancels, and every column has to be
/// there.
fn plan(fingerprint: &Fingerprint<'_>, own: &Own) -> Plan {
    Plan {
        ratio: None,
        columns: [true; VARYING.len()],
        own: Some(own.clone()),
        ..Plan::of(fingerprint, true)
    }
}

/// Draws a fingerprint with somebody's own shader in place of the wrong formula, on the CPU.
///
/// # Errors
/// As [`crate::render`].
pub fn render_own(
    fingerprint: &Fingerprint<'_>,
    own: &Own,
    options: &Options,
    cancel: &AtomicBool,
) -> Result<Picture, Error> {
    let options = Options {
        backend: crate::Backend::Cpu,
        ..*options
    };
    render_planned(fingerprint, plan(fingerprint, own), &options, cancel)
}

/// The profile of somebody's own shader beside the right formula's.
pub fn profile_own(fingerprint: &Fingerprint<'_>, own: &Own, samples: usize) -> Vec<ProfilePoint> {
    profile::planned(fingerprint, &plan(fingerprint, own), samples)
}
