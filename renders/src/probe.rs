//! Single points of a scene, under all of its lights: for the profile, the exposure and the
//! figures, which are the same whatever the picture's size.

use crate::Fingerprint;
use crate::cpu::Cpu;
use crate::geometry::{Geometry, Point};
use crate::sample::Samples;
use crate::scene::VARYING;
use crate::shade::luminance;

/// A place in the picture, in radii of the outline from its centre: to the right, upwards, and
/// q = √(1 − x² − y²).
pub(crate) type Place = [f64; 3];

/// What is seen at one place.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Probed {
    /// The cosines under the main light, which may be negative.
    pub main: Point,
    /// Whether any light reaches it.
    pub lit: bool,
    /// Sums over all lights: red, green, blue.
    pub right: [f64; 3],
    pub wrong: [f64; 3],
    /// `wrong / right`, of the luminances where there are several lights; NaN where nothing is
    /// known of it.
    pub ratio: f64,
}

/// The lights of a scene, and what evaluates its formulas.
pub(crate) struct Probe<'a> {
    cpu: &'a Cpu,
    lights: Vec<(Geometry, [f64; 3])>,
    columns: [bool; VARYING.len()],
}

impl<'a> Probe<'a> {
    pub fn new(fingerprint: &Fingerprint<'_>, cpu: &'a Cpu) -> Self {
        let scene = &fingerprint.scene;
        let lights = scene.geometries().into_iter();
        let mut columns = scene.same().a_light.map(|same| !same);
        let needed =
            [fingerprint.right, fingerprint.wrong].map(|expr| fingerprint.library.needs(expr));
        for (column, name) in columns.iter_mut().zip(VARYING) {
            *column &= needed.iter().any(|names| names.contains(name));
        }
        Self {
            cpu,
            lights: lights
                .zip(scene.lights.iter().map(|light| light.weights()))
                .collect(),
            columns,
        }
    }

    /// The same, with the main light alone.
    pub fn of_main_light(&self) -> Self {
        Self {
            cpu: self.cpu,
            lights: self.lights[..1].to_vec(),
            columns: self.columns,
        }
    }

    pub fn several(&self) -> bool {
        self.lights.len() > 1
    }

    pub fn main(&self) -> &Geometry {
        &self.lights[0].0
    }

    pub fn geometries(&self) -> impl Iterator<Item = &Geometry> {
        self.lights.iter().map(|(geometry, _)| geometry)
    }

    /// What is seen at each place, in order.
    pub fn at(&self, places: &[Place]) -> Vec<Probed> {
        let mut found: Vec<Probed> = Vec::new();
        for (geometry, weights) in &self.lights {
            let points: Vec<Point> = places
                .iter()
                .map(|&[x, y, q]| geometry.at(x, y, q))
                .collect();
            if found.is_empty() {
                found.extend(points.iter().map(|&main| Probed {
                    main,
                    lit: false,
                    right: [0.0; 3],
                    wrong: [0.0; 3],
                    ratio: f64::NAN,
                }));
            }
            let values = self.cpu.evaluate(&Samples::of(
                geometry,
                &self.columns,
                points.iter().copied(),
            ));
            for (index, (probed, point)) in found.iter_mut().zip(&points).enumerate() {
                if !(point.n_dot_l > 0.0 && point.n_dot_v > 0.0) {
                    continue;
                }
                probed.lit = true;
                for (channel, weight) in weights
                    .iter()
                    .enumerate()
                    .filter(|(_, weight)| **weight > 0.0)
                {
                    probed.right[channel] += weight * point.arrives * values.right[index];
                    probed.wrong[channel] += weight * point.arrives * values.wrong[index];
                }
                probed.ratio = match self.several() {
                    true => luminance(&probed.wrong) / luminance(&probed.right),
                    false => values.ratio[index],
                };
            }
        }
        found
    }

    /// The places at these angles along the main light's direction.
    pub fn places(&self, angles: impl IntoIterator<Item = f64>) -> Vec<Place> {
        let place = |psi| self.main().place(psi);
        angles.into_iter().map(place).collect()
    }
}
