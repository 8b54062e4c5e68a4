//! The equator of the sphere, from the terminator over the highlight to the lit rim.

use crate::Fingerprint;
use crate::cpu::Cpu;
use crate::plan::Plan;
use crate::sample::Samples;

/// One point of the equator.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProfilePoint {
    /// Across the disc: −1 is the rim away from the light, 0 the centre, 1 the rim towards it.
    pub position: f64,
    /// Cosine between normal and light.
    pub n_dot_l: f64,
    /// Cosine between normal and view.
    pub n_dot_v: f64,
    /// Value of the right formula, linear.
    pub right: f64,
    /// Value of the wrong formula, linear.
    pub wrong: f64,
    /// `wrong / right`; NaN where both are 0 and nothing more is known.
    pub ratio: f64,
}

/// `samples` points of the lit equator, evenly spaced in angle, so that rim and terminator are as
/// well resolved as the middle. The ends themselves, where a bug may be infinite, are left out.
///
/// Empty where a formula cannot be evaluated in this scene.
pub fn profile(fingerprint: &Fingerprint<'_>, samples: usize) -> Vec<ProfilePoint> {
    match Cpu::new(fingerprint, &Plan::of(fingerprint, true)) {
        Ok(cpu) => along(fingerprint, &cpu, samples),
        Err(_) => Vec::new(),
    }
}

/// The point of the sphere seen at (`x`, `y`), in radii from the disc's centre, x towards the
/// light, y upwards; `None` where nothing is lit or seen, or a formula does not fit the scene.
pub fn point_at(fingerprint: &Fingerprint<'_>, x: f64, y: f64) -> Option<ProfilePoint> {
    let geometry = fingerprint.scene.geometry();
    let point = geometry.lit(x, y)?;
    let cpu = Cpu::new(fingerprint, &Plan::of(fingerprint, true)).ok()?;
    let values = cpu.evaluate(&Samples::of(&geometry, [point]));
    Some(ProfilePoint {
        position: x,
        n_dot_l: point.n_dot_l,
        n_dot_v: point.n_dot_v,
        right: *values.right.first()?,
        wrong: *values.wrong.first()?,
        ratio: *values.ratio.first()?,
    })
}

fn along(fingerprint: &Fingerprint<'_>, cpu: &Cpu, samples: usize) -> Vec<ProfilePoint> {
    let (from, to) = fingerprint.scene.geometry().lit_equator();
    let angles: Vec<f64> = (0..samples)
        .map(|i| from + (to - from) * (i as f64 + 0.5) / samples as f64)
        .collect();
    at_angles(fingerprint, cpu, &angles)
}

/// The points of the equator at these angles (radians from the centre towards the light).
pub(crate) fn at_angles(
    fingerprint: &Fingerprint<'_>,
    cpu: &Cpu,
    angles: &[f64],
) -> Vec<ProfilePoint> {
    let geometry = fingerprint.scene.geometry();
    let samples = Samples::of(&geometry, angles.iter().map(|&psi| geometry.equator(psi)));
    let values = cpu.evaluate(&samples);
    angles
        .iter()
        .enumerate()
        .map(|(i, psi)| ProfilePoint {
            position: psi.sin(),
            n_dot_l: samples.n_dot_l[i],
            n_dot_v: samples.n_dot_v[i],
            right: values.right[i],
            wrong: values.wrong[i],
            ratio: values.ratio[i],
        })
        .collect()
}

/// A dense profile, kept to draw the curves and to choose the exposure.
pub(crate) struct Profile {
    pub points: Vec<ProfilePoint>,
    /// The power of 1/(N·V) with which the wrong value grows towards the rim: 0 where it is
    /// finite there, 2 where its sum over the picture is not.
    pub rim_growth: f64,
}

/// The brightest correct point is shown at this share of white.
pub(crate) const HIGHLIGHT_SHARE: f64 = 0.95;

impl Profile {
    pub fn of(fingerprint: &Fingerprint<'_>, cpu: &Cpu) -> Self {
        let near_rim = [1e-4, 1e-5].map(|n_dot_v: f64| n_dot_v.acos());
        let ends = at_angles(fingerprint, cpu, &near_rim);
        let rim_growth = (ends[1].wrong / ends[0].wrong).log10();
        Self {
            points: along(fingerprint, cpu, 1024),
            rim_growth,
        }
    }

    /// The factor that puts the brightest correct point of the equator just below white. It
    /// depends on the scene alone, never on the bug or on the picture's size.
    pub fn exposure(&self) -> f64 {
        let brightest = self
            .points
            .iter()
            .map(|p| p.right)
            .filter(|v| v.is_finite())
            .fold(0.0, f64::max);
        if brightest > 0.0 {
            HIGHLIGHT_SHARE / brightest
        } else {
            1.0
        }
    }

    /// Positions where the wrong curve crosses the right one, with the value there.
    pub fn crossings(&self) -> Vec<(f64, f64)> {
        let log = |p: &ProfilePoint| p.ratio.log2();
        self.points
            .windows(2)
            .filter_map(|pair| {
                let (a, b) = (log(&pair[0]), log(&pair[1]));
                // Two curves that are one up to rounding do not cross.
                let crosses = a * b < 0.0 && a.abs().max(b.abs()) > 1e-6 && (a - b).is_finite();
                crosses.then(|| {
                    let t = a / (a - b);
                    let between = |from: f64, to: f64| from + t * (to - from);
                    (
                        between(pair[0].position, pair[1].position),
                        between(pair[0].right, pair[1].right),
                    )
                })
            })
            .collect()
    }
}
