//! What is looked at: a unit sphere of one material, an eye on the z axis, and its lights.
//!
//! x runs to the right of the picture, y upwards, z from the sphere's centre to the eye. All
//! lengths are in radii of the sphere.

use crate::error::Error;
use crate::geometry::Geometry;
use formula::Values;

/// What the material, the eye and the lights are.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// Perceptual roughness in [0, 1]; alpha is its square.
    pub roughness: f64,
    /// Reflectance at normal incidence in [0, 1].
    pub f0: f64,
    /// Where the sphere is seen from.
    pub eye: Eye,
    /// At least one. The first is the main light: the profile, the highlight and the terminator
    /// of the figures are its own.
    pub lights: Vec<Light>,
    /// Radius of the sphere's outline as a share of half the panel's width, in (0, 1].
    pub radius: f64,
    /// Further givens of the formulas, constant over the picture (`albedo`, `ior`, …).
    pub others: Values,
}

/// Where the sphere is seen from.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Eye {
    /// From so far that all rays are parallel.
    #[default]
    Orthographic,
    /// With perspective.
    Perspective {
        /// From the sphere's centre to the eye in radii, more than 1.
        distance: f64,
    },
}

/// One light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    /// Angle between the directions from the sphere's centre to the light and to the eye, in
    /// degrees, in [0, 180).
    pub deg: f64,
    /// Where around the eye's axis it stands, in degrees: 0 is right, 90 above.
    pub turn_deg: f64,
    /// From the sphere's centre in radii, more than 1; without it, so far that its rays are
    /// parallel.
    pub distance: Option<f64>,
    /// By what its light is multiplied where the sphere's centre is, at least 0. That of a near
    /// light falls with the square of the distance.
    pub intensity: f64,
    /// Red, green and blue of its light, linear, by which the intensity is multiplied; each at
    /// least 0.
    pub colour: [f64; 3],
}

/// Radius of the sphere's outline as a share of half the panel's width, unless a scene says
/// otherwise.
pub const RADIUS: f64 = 0.94;

/// The quantities that may change from point to point or from light to light, in the order of
/// the columns.
pub(crate) const VARYING: [&str; 7] = [
    "n_dot_l",
    "n_dot_v",
    "n_dot_h",
    "cos_phi",
    "v_dot_h",
    "l_dot_v",
    "light_deg",
];

/// Places of [`VARYING`] that are not always needed, or not always different.
pub(crate) mod column {
    pub const COS_PHI: usize = 3;
    pub const V_DOT_H: usize = 4;
    pub const L_DOT_V: usize = 5;
    pub const LIGHT_DEG: usize = 6;
}

impl Light {
    /// A white light of intensity 1, so far that its rays are parallel, on the right of the eye.
    pub fn distant(deg: f64) -> Self {
        Self {
            deg,
            turn_deg: 0.0,
            distance: None,
            intensity: 1.0,
            colour: [1.0; 3],
        }
    }

    /// What each channel of its light is multiplied by.
    pub(crate) fn weights(&self) -> [f64; 3] {
        self.colour.map(|channel| channel * self.intensity)
    }

    fn check(&self) -> Result<(), String> {
        let Self { deg, turn_deg, .. } = self;
        if !(0.0..180.0).contains(deg) {
            return Err(format!(
                "the light's angle is {deg}°, and must be at least 0 and below 180"
            ));
        }
        if !turn_deg.is_finite() {
            return Err(format!("the light's turn is {turn_deg}°"));
        }
        if let Some(distance) = self.distance
            && !(distance > 1.0 && distance.is_finite())
        {
            return Err(format!(
                "the light's distance is {distance} radii, and must be more than 1"
            ));
        }
        match self
            .weights()
            .into_iter()
            .find(|w| !(*w >= 0.0 && w.is_finite()))
        {
            Some(weight) => Err(format!(
                "a light's intensity times its colour is {weight}, and must be at least 0"
            )),
            None => Ok(()),
        }
    }
}

impl Scene {
    /// One distant light at `light_deg` on the right, seen without perspective.
    pub fn new(roughness: f64, f0: f64, light_deg: f64) -> Self {
        Self {
            roughness,
            f0,
            eye: Eye::Orthographic,
            lights: vec![Light::distant(light_deg)],
            radius: RADIUS,
            others: Values::new(),
        }
    }

    /// What is wrong with the scene, in one sentence.
    pub(crate) fn check(&self) -> Result<(), Error> {
        let wrong = |why: String| Err(Error::Scene(why));
        if self.lights.is_empty() {
            return wrong("there is no light".to_owned());
        }
        for light in &self.lights {
            light.check().map_err(Error::Scene)?;
        }
        if let Eye::Perspective { distance } = self.eye
            && !(distance > 1.0 && distance.is_finite())
        {
            return wrong(format!(
                "the eye's distance is {distance} radii, and must be more than 1"
            ));
        }
        if !(self.radius > 0.0 && self.radius <= 1.0) {
            let radius = self.radius;
            return wrong(format!(
                "the sphere's radius is {radius} of half the picture, and must be more than 0 and at most 1"
            ));
        }
        if let Some(name) = VARYING.iter().find(|name| self.others.contains_key(**name)) {
            return wrong(format!("{name} follows from the scene and cannot be given"));
        }
        match self
            .constants()
            .into_iter()
            .find(|(_, value)| !value.is_finite())
        {
            Some((name, value)) => wrong(format!(
                "{name} is {value}, which is not a number to shade with"
            )),
            None => Ok(()),
        }
    }

    /// The inputs of both formulas that are the same at every point under every light.
    pub(crate) fn constants(&self) -> Vec<(String, f64)> {
        let mut constants: Vec<(String, f64)> = vec![
            ("roughness".to_owned(), self.roughness),
            ("alpha".to_owned(), self.roughness * self.roughness),
            ("f0".to_owned(), self.f0),
        ];
        for (name, value) in &self.others {
            match constants.iter_mut().find(|(known, _)| known == name) {
                Some(slot) => slot.1 = *value,
                None => constants.push((name.clone(), *value)),
            }
        }
        constants
    }

    /// The sphere under each of its lights.
    pub(crate) fn geometries(&self) -> Vec<Geometry> {
        let under = |light: &Light| Geometry::new(self.eye, light);
        self.lights.iter().map(under).collect()
    }

    /// The sphere under its main light.
    pub(crate) fn geometry(&self) -> Geometry {
        let main = self.lights.first().copied();
        Geometry::new(self.eye, &main.unwrap_or(Light::distant(0.0)))
    }

    /// Whether every light is grey: one channel is enough.
    pub(crate) fn is_grey(&self) -> bool {
        let grey = |light: &Light| {
            light.colour[0] == light.colour[1] && light.colour[1] == light.colour[2]
        };
        self.lights.iter().all(grey)
    }

    /// Whether the half vector is the same all over the sphere, whatever the light.
    pub(crate) fn is_distant(&self) -> bool {
        self.eye == Eye::Orthographic && self.lights.iter().all(|light| light.distance.is_none())
    }

    /// Which of [`VARYING`] are the same under one light at every point, and which under every
    /// light.
    pub(crate) fn same(&self) -> Same {
        let mut a_light = [false; VARYING.len()];
        a_light[column::LIGHT_DEG] = true;
        a_light[column::V_DOT_H] = self.is_distant();
        a_light[column::L_DOT_V] = self.is_distant();
        let one_angle = self
            .lights
            .windows(2)
            .all(|pair| pair[0].deg == pair[1].deg);
        Same {
            a_light,
            everywhere: a_light.map(|same| same && one_angle),
        }
    }
}

/// Which of [`VARYING`] do not vary.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Same {
    /// The same at every point under one light.
    pub a_light: [bool; VARYING.len()],
    /// The same at every point under every light.
    pub everywhere: [bool; VARYING.len()],
}
