//! F from vectors.

use super::half_angle::v_dot_h_and_rest;
use crate::fresnel::{conductor_rgb, f_dielectric};
use crate::real::{Real, lit};
use crate::vector::Vector;

/// The mirror that the facets are made of, in three colours.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Fresnel<R> {
    /// Everything is reflected.
    Perfect,
    /// Schlick's approximation with the reflectance at normal incidence.
    Schlick {
        /// Reflectance at normal incidence, red, green and blue.
        f0: [R; 3],
    },
    /// A dielectric, see [`f_dielectric`].
    Dielectric {
        /// Index of refraction, transmitted over incident.
        eta: R,
    },
    /// A conductor, see [`f_conductor`](crate::f_conductor).
    Conductor {
        /// Real part of the index of refraction, red, green and blue.
        n: [R; 3],
        /// Imaginary part.
        k: [R; 3],
    },
}

impl<R: Real> Fresnel<R> {
    /// Reflectance of the facet that mirrors `l` into `v`.
    ///
    /// - *Source*: see [`fresnel`](crate::fresnel).
    /// - *Arguments*: `l` and `v` the directions to light and viewer in the tangent frame, of length
    ///   1.
    /// - *Value*: red, green and blue, 0 to 1.
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
