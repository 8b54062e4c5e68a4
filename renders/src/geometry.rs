//! The sphere under one light: which part of it is lit and seen, and the cosines at its points.
//!
//! Points are named by where they are *seen*: (x, y) in radii of the outline, and q = √(1 − x² −
//! y²), so that (x, y, q) is a unit vector. Without perspective that is the normal itself. An
//! eye at distance e sees at (x, y) the normal (k·x, k·y, 1 + e·q) / (e + q) with k = √(e² − 1):
//! a projective map of the sphere onto itself, under which the edge of a light stays a circle.
//! So what is lit is a·(x, y, q) > b for every eye and every light, and on a line of the picture
//! it is a stretch in the angle t of x = ρ sin t, q = ρ cos t.

use crate::scene::{Eye, Light};
use std::f64::consts::FRAC_PI_2;

/// The values of one shaded point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Point {
    pub n_dot_l: f64,
    pub n_dot_v: f64,
    pub n_dot_h: f64,
    pub v_dot_h: f64,
    pub l_dot_v: f64,
    /// How much of the light arrives: 1 from a distant one.
    pub arrives: f64,
}

type Vector = [f64; 3];

fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Sine and cosine of an angle in degrees, exact where they are 0 or ±1: a picture under a light
/// straight to the right mirrors to the last bit.
fn sin_cos(degrees: f64) -> (f64, f64) {
    match degrees.rem_euclid(360.0) {
        0.0 => (0.0, 1.0),
        90.0 => (1.0, 0.0),
        180.0 => (0.0, -1.0),
        270.0 => (-1.0, 0.0),
        _ => degrees.to_radians().sin_cos(),
    }
}

/// An eye at a distance.
#[derive(Clone, Copy, Debug)]
struct Near {
    distance: f64,
    /// √(distance² − 1): what the outline's radius is seen under.
    reach: f64,
}

/// The directions of a scene with one light, prepared once for all points.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Geometry {
    near: Option<Near>,
    /// From the centre to the light, unit.
    light: Vector,
    light_distance: Option<f64>,
    /// The light's angle in degrees, as it was given.
    pub light_deg: f64,
    /// Lit is where `lens · (x, y, q) > least`.
    lens: Vector,
    least: f64,
    /// Direction in the picture towards the light.
    turn: (f64, f64),
    /// The half vector of a distant light and a distant eye, unit.
    half: Vector,
    /// V·H and L·V of a distant light and a distant eye.
    v_dot_h: f64,
    l_dot_v: f64,
}

/// Some stretches of a line, from left to right, apart from each other.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Stretches {
    count: usize,
    of: [(f64, f64); Self::MOST],
}

impl Stretches {
    const MOST: usize = 4;

    pub fn as_slice(&self) -> &[(f64, f64)] {
        &self.of[..self.count]
    }

    /// Adds a stretch to the right of those there are; joins the last where it meets it, or
    /// where there is no more room.
    pub fn push(&mut self, (from, to): (f64, f64)) {
        // Also false where an end is NaN: the line misses the sphere.
        if from < to {
            if self.count > 0 && (self.of[self.count - 1].1 >= from || self.count == Self::MOST) {
                let last = &mut self.of[self.count - 1].1;
                *last = last.max(to);
            } else {
                self.of[self.count] = (from, to);
                self.count += 1;
            }
        }
    }

    /// What lies in one or the other.
    pub fn or(&self, other: &Self) -> Self {
        let (mut a, mut b) = (self.as_slice(), other.as_slice());
        let mut both = Self::default();
        while let Some(next) = match (a.first(), b.first()) {
            (Some(x), Some(y)) if y.0 < x.0 => take(&mut b),
            (Some(_), _) => take(&mut a),
            (None, _) => take(&mut b),
        } {
            both.push(next);
        }
        both
    }

    /// What lies in both.
    pub fn and(&self, other: &Self) -> Self {
        let mut both = Self::default();
        for a in self.as_slice() {
            for b in other.as_slice() {
                both.push((a.0.max(b.0), a.1.min(b.1)));
            }
        }
        both
    }
}

fn take(stretches: &mut &[(f64, f64)]) -> Option<(f64, f64)> {
    let (first, rest) = stretches.split_first()?;
    *stretches = rest;
    Some(*first)
}

impl Geometry {
    pub fn new(eye: Eye, light: &Light) -> Self {
        let (sin_light, cos_light) = sin_cos(light.deg);
        let (sin_half, cos_half) = sin_cos(light.deg / 2.0);
        let (sin_turn, cos_turn) = sin_cos(light.turn_deg);
        let towards = |sin: f64, cos: f64| [sin * cos_turn, sin * sin_turn, cos];
        let direction = towards(sin_light, cos_light);
        // The light stands over a point's horizon where n·light > 1/distance.
        let horizon = light.distance.map_or(0.0, |distance| 1.0 / distance);
        let near = match eye {
            Eye::Orthographic => None,
            Eye::Perspective { distance } => Some(Near {
                distance,
                reach: ((distance - 1.0) * (distance + 1.0)).sqrt(),
            }),
        };
        let (lens, least) = match near {
            None => (direction, horizon),
            Some(Near { distance, reach }) => (
                [
                    reach * direction[0],
                    reach * direction[1],
                    distance * direction[2] - horizon,
                ],
                horizon * distance - direction[2],
            ),
        };
        Self {
            near,
            light: direction,
            light_distance: light.distance,
            light_deg: light.deg,
            lens,
            least,
            turn: (cos_turn, sin_turn),
            half: towards(sin_half, cos_half),
            v_dot_h: cos_half,
            l_dot_v: cos_light,
        }
    }

    /// Whether the half vector is the same at every point.
    pub fn is_distant(&self) -> bool {
        self.near.is_none() && self.light_distance.is_none()
    }

    /// Whether the light is at a distance that counts.
    pub fn is_near_light(&self) -> bool {
        self.light_distance.is_some()
    }

    /// Where around the disc's centre the light stands, in radians from the right, upwards.
    pub fn turn_angle(&self) -> f64 {
        self.turn.1.atan2(self.turn.0)
    }

    /// V·H and L·V where they are the same at every point.
    pub fn of_distant(&self) -> (f64, f64) {
        (self.v_dot_h, self.l_dot_v)
    }

    /// Whether the light is in the plane through the eye's axis and the picture's horizontal.
    pub fn is_level(&self) -> bool {
        self.light[1] == 0.0
    }

    /// Whether the light is in the plane through the eye's axis and the picture's vertical.
    pub fn is_upright(&self) -> bool {
        self.light[0] == 0.0
    }

    /// Whether the light reaches anything that is seen.
    pub fn reaches(&self) -> bool {
        // The greatest of lens · (x, y, q) over the half sphere q > 0.
        let [x, y, q] = self.lens;
        let most = if q > 0.0 {
            dot(self.lens, self.lens).sqrt()
        } else {
            x.hypot(y)
        };
        most > self.least
    }

    /// The stretches of the line at height `y` that are lit and seen. Empty where the line
    /// misses the sphere.
    pub fn lit(&self, y: f64) -> Stretches {
        let mut found = Stretches::default();
        let rho = (1.0 - y * y).sqrt();
        let [across, up, towards] = self.lens;
        let needed = self.least - y * up;
        let ends = [-rho * across > needed, rho * across > needed];
        // Where across · x + towards · q is just what is needed, on the circle x² + q² = ρ²:
        // two places, of which those on the seen half, q > 0, are edges.
        let length2 = across * across + towards * towards;
        let root = (length2 * rho * rho - needed * needed).sqrt();
        let edge = |root: f64| {
            let (x, q) = (
                (needed * across - towards * root) / length2,
                (needed * towards + across * root) / length2,
            );
            (q > 0.0).then(|| x.clamp(-rho, rho))
        };
        // No root is no edge.
        match (edge(root), edge(-root)) {
            (Some(a), Some(b)) if ends[0] && ends[1] => {
                found.push((-rho, a.min(b)));
                found.push((a.max(b), rho));
            }
            (Some(a), Some(b)) => found.push((a.min(b), a.max(b))),
            (Some(at), None) | (None, Some(at)) if ends[0] && !ends[1] => found.push((-rho, at)),
            (Some(at), None) | (None, Some(at)) if ends[1] && !ends[0] => found.push((at, rho)),
            _ if rho * towards > needed => found.push((-rho, rho)),
            _ => {}
        }
        found
    }

    /// The place that is seen towards the light, or away from it, at angle `psi` (radians) from
    /// the disc's centre: at sin psi of the outline's radius, in radii, and q there.
    pub fn place(&self, psi: f64) -> [f64; 3] {
        let (sin, cos) = psi.sin_cos();
        [sin * self.turn.0, sin * self.turn.1, cos]
    }

    /// N·L where [`Geometry::is_distant`].
    #[inline]
    pub fn distant_n_dot_l(&self, n: [f64; 3]) -> f64 {
        dot(n, self.light)
    }

    /// N·H where [`Geometry::is_distant`].
    #[inline]
    pub fn distant_n_dot_h(&self, n: [f64; 3]) -> f64 {
        dot(n, self.half).min(1.0)
    }

    /// The point seen at (`x`, `y`), with q = √(1 − x² − y²).
    #[inline]
    pub fn at(&self, x: f64, y: f64, q: f64) -> Point {
        if self.is_distant() {
            let n = [x, y, q];
            return Point {
                n_dot_l: self.distant_n_dot_l(n),
                n_dot_v: q,
                n_dot_h: self.distant_n_dot_h(n),
                v_dot_h: self.v_dot_h,
                l_dot_v: self.l_dot_v,
                arrives: 1.0,
            };
        }
        let (n, v, n_dot_v) = match self.near {
            None => ([x, y, q], [0.0, 0.0, 1.0], q),
            Some(Near {
                distance: e,
                reach: k,
            }) => {
                let n = [k * x / (e + q), k * y / (e + q), (1.0 + e * q) / (e + q)];
                let away = k * ((e - q) / (e + q)).sqrt();
                let v = [-n[0] / away, -n[1] / away, (e - n[2]) / away];
                // e·n_z − 1 = k² q / (e + q): no cancellation towards the outline.
                (n, v, q * k / ((e - q) * (e + q)).sqrt())
            }
        };
        let (l, n_dot_l, arrives) = match self.light_distance {
            None => (self.light, dot(n, self.light), 1.0),
            Some(d) => {
                let to = [0, 1, 2].map(|i| d * self.light[i] - n[i]);
                let away = dot(to, to).sqrt();
                let n_dot_l = (d * dot(n, self.light) - 1.0) / away;
                (to.map(|c| c / away), n_dot_l, (d / away).powi(2))
            }
        };
        let l_dot_v = dot(l, v).clamp(-1.0, 1.0);
        let v_dot_h = (0.5 + 0.5 * l_dot_v).sqrt();
        Point {
            n_dot_l,
            n_dot_v,
            // `min` also makes a 1 of 0/0, where light and eye face each other across a point.
            n_dot_h: ((n_dot_l + n_dot_v) / (2.0 * v_dot_h)).min(1.0),
            v_dot_h,
            l_dot_v,
            arrives,
        }
    }

    /// The stretch of [`Geometry::place`] that is lit and seen: angles of the terminator and of
    /// the outline, in radians. Empty (both the same) where the light reaches nothing there.
    pub fn lit_along(&self) -> (f64, f64) {
        let [x, y, q] = self.lens;
        let across = x * self.turn.0 + y * self.turn.1;
        let most = across.hypot(q);
        if most <= self.least {
            return (FRAC_PI_2, FRAC_PI_2);
        }
        let (middle, half) = (across.atan2(q), (self.least / most).clamp(-1.0, 1.0).acos());
        let end = |t: f64| t.clamp(-FRAC_PI_2, FRAC_PI_2);
        (end(middle - half), end(middle + half))
    }

    /// Where along the light's direction the normal is the half vector, as an angle from the
    /// disc's centre in radians.
    pub fn highlight(&self) -> f64 {
        if self.is_distant() {
            return (self.light_deg / 2.0).to_radians();
        }
        // From under the eye to the outline the normal turns to the light; at the highlight it
        // is as far from the one as from the other.
        let (mut from, mut to) = (0.0, self.lit_along().1);
        for _ in 0..60 {
            let middle = f64::midpoint(from, to);
            let [x, y, q] = self.place(middle);
            let point = self.at(x, y, q);
            if point.n_dot_l > point.n_dot_v {
                to = middle;
            } else {
                from = middle;
            }
        }
        f64::midpoint(from, to)
    }

    /// Cosine of the azimuth between light and view around the normal; 1 where either stands on it.
    pub fn cos_phi(point: &Point) -> f64 {
        let (n_dot_l, n_dot_v) = (point.n_dot_l, point.n_dot_v);
        let sines = ((1.0 - n_dot_l * n_dot_l) * (1.0 - n_dot_v * n_dot_v))
            .max(0.0)
            .sqrt();
        if sines > 0.0 {
            ((point.l_dot_v - n_dot_l * n_dot_v) / sines).clamp(-1.0, 1.0)
        } else {
            1.0
        }
    }
}
