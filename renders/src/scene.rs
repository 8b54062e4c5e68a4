//! The scene of every fingerprint: a unit sphere, an orthographic eye, one distant light.
//!
//! The eye looks along −z, the light stands in the xz-plane, so the picture mirrors at its
//! horizontal middle and the equator runs from the terminator over the highlight to the lit rim.

use crate::error::Error;
use formula::Values;

/// What the material and the light are.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// Perceptual roughness in [0, 1]; alpha is its square.
    pub roughness: f64,
    /// Reflectance at normal incidence in [0, 1].
    pub f0: f64,
    /// Angle of the distant light from the view in degrees, towards +x, in [0, 180).
    pub light_deg: f64,
    /// Further givens of the formulas, constant over the picture (`albedo`, `ior`, …).
    pub others: Values,
}

/// The quantities that change from point to point, in the order of the columns.
pub(crate) const VARYING: [&str; 4] = ["n_dot_l", "n_dot_v", "n_dot_h", AZIMUTH];

/// The azimuth between light and view: its column is filled only where a formula needs it.
pub(crate) const AZIMUTH: &str = "cos_phi";

/// One shaded point: the values of [`VARYING`] but the last, which few formulas need.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Point {
    pub n_dot_l: f64,
    pub n_dot_v: f64,
    pub n_dot_h: f64,
}

/// The directions of a scene, prepared once for all points.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Geometry {
    sin_light: f64,
    cos_light: f64,
    sin_half: f64,
    cos_half: f64,
}

impl Scene {
    /// What is wrong with the scene, in one sentence.
    pub(crate) fn check(&self) -> Result<(), Error> {
        if !(0.0..180.0).contains(&self.light_deg) {
            let light = self.light_deg;
            return Err(Error::Scene(format!(
                "light_deg is {light}, and must be at least 0 and below 180"
            )));
        }
        match self
            .constants()
            .into_iter()
            .find(|(_, value)| !value.is_finite())
        {
            Some((name, value)) => Err(Error::Scene(format!(
                "{name} is {value}, which is not a number to shade with"
            ))),
            None => Ok(()),
        }
    }

    /// The constant inputs of both formulas: name and value.
    pub(crate) fn constants(&self) -> Vec<(String, f64)> {
        let light = self.light_deg.to_radians();
        let mut constants: Vec<(String, f64)> = vec![
            ("roughness".to_owned(), self.roughness),
            ("alpha".to_owned(), self.roughness * self.roughness),
            ("f0".to_owned(), self.f0),
            ("v_dot_h".to_owned(), (light / 2.0).cos()),
            ("l_dot_v".to_owned(), light.cos()),
            ("light_deg".to_owned(), self.light_deg),
        ];
        for (name, value) in &self.others {
            match constants.iter_mut().find(|(known, _)| known == name) {
                Some(slot) => slot.1 = *value,
                None => constants.push((name.clone(), *value)),
            }
        }
        constants
    }

    pub(crate) fn geometry(&self) -> Geometry {
        let (sin_light, cos_light) = self.light_deg.to_radians().sin_cos();
        let (sin_half, cos_half) = (self.light_deg.to_radians() / 2.0).sin_cos();
        Geometry {
            sin_light,
            cos_light,
            sin_half,
            cos_half,
        }
    }
}

impl Geometry {
    /// The stretch of a line at height `y` (in radii) that is lit and seen: from the terminator
    /// to the rim. Empty, with both ends NaN, where the line misses the sphere.
    ///
    /// On the line, x = ρ sin t and z = ρ cos t with ρ² = 1 − y², so that
    /// N·L = ρ cos(t − light): positive beyond t = light − 90°.
    pub fn lit_stretch(&self, y: f64) -> (f64, f64) {
        let rho = (1.0 - y * y).sqrt();
        (-rho * self.cos_light, rho)
    }

    /// The point of the sphere seen at (`x`, `y`) in units of its radius; `None` off the disc or
    /// where the light does not reach.
    pub fn lit(&self, x: f64, y: f64) -> Option<Point> {
        let point = self.point(x, y)?;
        (point.n_dot_l > 0.0 && point.n_dot_v > 0.0).then_some(point)
    }

    /// The point of the sphere seen at (`x`, `y`), lit or not; `None` off the disc.
    pub fn point(&self, x: f64, y: f64) -> Option<Point> {
        let z2 = 1.0 - (x * x + y * y);
        (z2 >= 0.0).then(|| self.at(x, z2.sqrt()))
    }

    /// The point of the equator at angle `psi` (radians) from the disc's centre towards the light.
    pub fn equator(&self, psi: f64) -> Point {
        self.at(psi.sin(), psi.cos())
    }

    /// The point with these coordinates across and towards the eye.
    #[inline]
    pub fn at(&self, x: f64, z: f64) -> Point {
        Point {
            n_dot_l: x * self.sin_light + z * self.cos_light,
            n_dot_v: z,
            n_dot_h: (x * self.sin_half + z * self.cos_half).min(1.0),
        }
    }

    /// Cosine of the azimuth between light and view around the normal; 1 where either stands on it.
    pub fn cos_phi(&self, point: &Point) -> f64 {
        let (n_dot_l, n_dot_v) = (point.n_dot_l, point.n_dot_v);
        let sines = ((1.0 - n_dot_l * n_dot_l) * (1.0 - n_dot_v * n_dot_v))
            .max(0.0)
            .sqrt();
        if sines > 0.0 {
            ((self.cos_light - n_dot_l * n_dot_v) / sines).clamp(-1.0, 1.0)
        } else {
            1.0
        }
    }

    /// The lit stretch of the equator: angles of the terminator and of the rim, in radians.
    pub fn lit_equator(&self) -> (f64, f64) {
        let light = self.sin_light.atan2(self.cos_light);
        (
            light - std::f64::consts::FRAC_PI_2,
            std::f64::consts::FRAC_PI_2,
        )
    }

    /// The angle of the highlight (n = h) from the disc's centre, in radians.
    pub fn highlight(&self) -> f64 {
        self.sin_half.atan2(self.cos_half)
    }
}
