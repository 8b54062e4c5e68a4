//! F from vectors.

use super::half_angle::v_dot_h_and_rest;
use crate::fresnel::{conductor_rgb, f_dielectric};
use crate::real::{Real, lit};
use crate::vector::Vector;

/// The mirror that the facets are made of, in three colours.
///
/// ```
/// use brdf::Fresnel;
/// // Copper, seen straight on: index n + ik in red, green and blue.
/// let copper = Fresnel::Conductor { n: [0.200f64, 0.924, 1.102], k: [3.912, 2.452, 2.142] };
/// let up = [0.0, 0.0, 1.0];
/// let [red, green, blue] = copper.eval(up, up);
/// assert!(red > 0.95 && green < 0.65 && blue < green);
/// // And so that it looks alike, where a base colour is all there is.
/// let schlick = Fresnel::Schlick { f0: [red, green, blue] };
/// assert!(schlick.eval(up, up).iter().zip([red, green, blue]).all(|(a, b)| (a - b).abs() < 1e-15));
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Fresnel<R> {
    /// Everything is reflected: F = 1.
    Perfect,
    /// Schlick's approximation, see [`f_schlick`](crate::f_schlick).
    Schlick {
        /// Reflectance at normal incidence, red, green and blue, each in [0, 1].
        f0: [R; 3],
    },
    /// A dielectric, exact, without dispersion: see [`f_dielectric`].
    Dielectric {
        /// Index of refraction, transmitted over incident, more than 0: 1.5 for glass in air.
        eta: R,
    },
    /// A conductor, exact, see [`f_conductor`](crate::f_conductor).
    Conductor {
        /// Real part of the index of refraction, red, green and blue, each at least 0.
        n: [R; 3],
        /// Imaginary part, by which the light is damped, each at least 0.
        k: [R; 3],
    },
}

impl<R: Real> Fresnel<R> {
    /// Reflectance of the facet that mirrors `l` into `v`.
    ///
    /// - *Source*: see [`fresnel`](crate::fresnel).
    /// - *Arguments*: `l` and `v` the directions to light and viewer in the tangent frame, of length
    ///   1.
    /// - *Value*: red, green and blue, each 0 to 1; f0 where l = v, 1 where l = −v.
    /// - *Outside*: only the directions count, and the side of the surface they lie on does not; what
    ///   an index outside its range gives, see the function of the variant.
    /// - *Error*: Schlick 20.3 ulp in f32, 16.7 in f64, most of it by the fifth power. The exact ones
    ///   are those of a V·H rounded to the precision, 1.9 ulp: near the critical angle of an index below
    ///   1 that is worth more.
    #[inline(always)]
    pub fn eval(&self, l: impl Into<Vector<R>>, v: impl Into<Vector<R>>) -> [R; 3] {
        let (l, v) = (l.into(), v.into());
        match *self {
            // ∞ − ∞, where nothing else is wrong.
            Fresnel::Schlick { f0 } if !f0.into_iter().all(R::is_finite) => {
                let f0 = f0.map(R::bounded);
                Fresnel::Schlick { f0 }.of_facet(l, v)
            }
            _ => self.of_facet(l, v),
        }
    }

    #[inline(always)]
    pub(super) fn of_facet(&self, l: Vector<R>, v: Vector<R>) -> [R; 3] {
        let (c, rest) = v_dot_h_and_rest(l, v);
        self.at(c, rest)
    }

    /// Of V·H and 1 − V·H.
    #[inline(always)]
    pub(super) fn at(&self, c: R, rest: R) -> [R; 3] {
        match *self {
            Fresnel::Perfect => [lit(1.0); 3],
            Fresnel::Schlick { f0 } => {
                let power = rest.pow5();
                f0.map(|f0| f0 + (lit::<R>(1.0) - f0) * power)
            }
            Fresnel::Dielectric { eta } => exact_dielectric(eta, c),
            Fresnel::Conductor { n, k } => exact_conductor(n, k, c),
        }
    }
}

/// Not inlined: its size would keep the rest of a lobe from being.
#[inline(never)]
fn exact_dielectric<R: Real>(eta: R, c: R) -> [R; 3] {
    [f_dielectric(eta, c); 3]
}

/// Not inlined either.
#[inline(never)]
fn exact_conductor<R: Real>(n: [R; 3], k: [R; 3], c: R) -> [R; 3] {
    conductor_rgb(n, k, c)
}
