//! The equator of the sphere, through the disc's centre towards the main light: from its
//! terminator over its highlight to the lit rim.

use crate::cpu::Cpu;
use crate::plan::Plan;
use crate::probe::{Place, Probe, Probed};
use crate::shade::luminance;
use crate::{Fingerprint, Precision};
use std::f64::consts::{FRAC_PI_2, LN_2, TAU};

/// One point of the equator.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProfilePoint {
    /// Across the disc: −1 is the rim away from the light, 0 the centre, 1 the rim towards it.
    pub position: f64,
    /// Cosine between normal and main light; negative where only others reach.
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
/// Under several lights the whole equator, without the points that no light reaches.
///
/// Empty where a formula cannot be evaluated in this scene.
pub fn profile(fingerprint: &Fingerprint<'_>, samples: usize) -> Vec<ProfilePoint> {
    planned(fingerprint, &Plan::of(fingerprint, true), samples)
}

/// The same by a plan.
pub(crate) fn planned(
    fingerprint: &Fingerprint<'_>,
    plan: &Plan,
    samples: usize,
) -> Vec<ProfilePoint> {
    match Cpu::new(fingerprint, plan, Precision::F64) {
        Ok(cpu) => along(&Probe::new(fingerprint, &cpu), samples),
        Err(_) => Vec::new(),
    }
}

/// The point of the sphere seen at (`x`, `y`), in radii from the disc's centre, to the right and
/// upwards; `None` where nothing is lit or seen, or a formula does not fit the scene.
pub fn point_at(fingerprint: &Fingerprint<'_>, x: f64, y: f64) -> Option<ProfilePoint> {
    let q2 = 1.0 - (x * x + y * y);
    if q2.is_nan() || q2 <= 0.0 {
        return None;
    }
    let cpu = Cpu::new(fingerprint, &Plan::of(fingerprint, true), Precision::F64).ok()?;
    let probe = Probe::new(fingerprint, &cpu);
    let found = *probe.at(&[[x, y, q2.sqrt()]]).first()?;
    found.lit.then(|| point(x, &found))
}

fn point(position: f64, probed: &Probed) -> ProfilePoint {
    ProfilePoint {
        position,
        n_dot_l: probed.main.n_dot_l,
        n_dot_v: probed.main.n_dot_v,
        right: luminance(&probed.right),
        wrong: luminance(&probed.wrong),
        ratio: probed.ratio,
    }
}

fn along(probe: &Probe<'_>, samples: usize) -> Vec<ProfilePoint> {
    let (from, to) = match probe.several() {
        true => (-FRAC_PI_2, FRAC_PI_2),
        false => probe.main().lit_along(),
    };
    let angles: Vec<f64> = (0..samples)
        .map(|i| from + (to - from) * (i as f64 + 0.5) / samples as f64)
        .collect();
    at_angles(probe, &angles)
}

/// The lit points of the equator at these angles (radians from the centre towards the light).
pub(crate) fn at_angles(probe: &Probe<'_>, angles: &[f64]) -> Vec<ProfilePoint> {
    let probed = probe.at(&probe.places(angles.iter().copied()));
    let lit = angles.iter().zip(&probed).filter(|(_, probed)| probed.lit);
    lit.map(|(psi, probed)| point(psi.sin(), probed)).collect()
}

/// A dense profile, kept to draw the curves and to choose the exposure.
pub(crate) struct Profile {
    pub points: Vec<ProfilePoint>,
    /// What the wrong value does towards the rim.
    pub growth: Growth,
    /// The greatest correct value of any channel that was met.
    brightest: f64,
}

/// The brightest correct point is shown at this share of white.
pub(crate) const HIGHLIGHT_SHARE: f64 = 0.95;

impl Profile {
    pub fn of(fingerprint: &Fingerprint<'_>, cpu: &Cpu) -> Self {
        let probe = Probe::new(fingerprint, cpu);
        let points = along(&probe, 1024);
        let brightest = match probe.several() || !fingerprint.scene.is_grey() {
            true => brightest(&probe),
            false => finite(points.iter().map(|point| point.right)),
        };
        Self {
            points,
            growth: growth(&probe),
            brightest,
        }
    }

    /// The factor that puts the brightest correct point just below white. It depends on the
    /// scene alone, never on the bug or on the picture's size.
    pub fn exposure(&self) -> f64 {
        if self.brightest > 0.0 {
            HIGHLIGHT_SHARE / self.brightest
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

fn finite(values: impl Iterator<Item = f64>) -> f64 {
    values.filter(|value| value.is_finite()).fold(0.0, f64::max)
}

/// The greatest correct value at every light's highlight, along its direction, and over a grid.
fn brightest(probe: &Probe<'_>) -> f64 {
    const GRID: usize = 48;
    let mut places = Vec::new();
    for geometry in probe.geometries() {
        places.push(geometry.place(geometry.highlight()));
        let (from, to) = geometry.lit_along();
        let angle = |step: i32| from + (to - from) * (f64::from(step) + 0.5) / 16.0;
        places.extend((0..16).map(|step| geometry.place(angle(step))));
    }
    let unit = |step: usize| 2.0 * (step as f64 + 0.5) / GRID as f64 - 1.0;
    for (row, column) in (0..GRID * GRID).map(|index| (index / GRID, index % GRID)) {
        let (x, y) = (unit(column), unit(row));
        let q2 = 1.0 - x * x - y * y;
        if q2 > 0.0 {
            places.push([x, y, q2.sqrt()]);
        }
    }
    finite(probe.at(&places).iter().flat_map(|probed| probed.right))
}

/// How the wrong value grows towards the rim.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Growth {
    /// The greatest power of 1/(N·V) with which it does: 0 where it is finite there, 2 where its
    /// mean over the disc is not.
    pub power: f64,
    /// By how much its mean over the disc rises with every doubling of the picture's size; 0 where
    /// the mean is finite.
    pub per_doubling: f64,
}

impl Growth {
    /// Whether the mean over the disc has no limit.
    pub fn is_endless(&self) -> bool {
        self.power > 1.9
    }
}

/// From some places around the rim.
///
/// With q = √(1 − r²) the area of the disc is r dr dφ = q dq dφ, so that what goes as K(φ)/q² adds
/// K/π ∫ dφ ln(1/q₀) to the mean over the disc. Samples reach to q₀ ∝ 1/√size: twice the size
/// adds the mean of K over φ, times ln 2.
///
/// None of them is where a distant light's terminator meets the rim: any value that grows with
/// 1/(N·L·N·V) does so there as the square, but in one point, which adds up to nothing.
pub(crate) fn growth(probe: &Probe<'_>) -> Growth {
    const AROUND: usize = 16;
    const FAR: f64 = 1e-4;
    const NEAR: f64 = 1e-5;
    let turn = probe.main().turn_angle();
    let ring = |q: f64| {
        let radius = (1.0 - q * q).sqrt();
        (0..AROUND).map(move |i| {
            // The first is exactly towards the main light; none is square to it.
            let angle = turn + TAU * (i as f64 + if i == 0 { 0.0 } else { 0.5 }) / AROUND as f64;
            [radius * angle.cos(), radius * angle.sin(), q]
        })
    };
    let places: Vec<Place> = [FAR, NEAR].into_iter().flat_map(ring).collect();
    let probed = probe.at(&places);
    let (far, near) = probed.split_at(AROUND);
    let power = |(far, near): (&Probed, &Probed)| {
        (luminance(&near.wrong) / luminance(&far.wrong)).ln() / (FAR / NEAR).ln()
    };
    let mut growth = Growth {
        power: finite(far.iter().zip(near).map(power)),
        per_doubling: 0.0,
    };
    if growth.is_endless() {
        let coefficients = near.iter().map(|it| luminance(&it.wrong) * NEAR * NEAR);
        growth.per_doubling = LN_2 * coefficients.sum::<f64>() / AROUND as f64;
    }
    growth
}
