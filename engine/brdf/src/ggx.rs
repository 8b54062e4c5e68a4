//! GGX from vectors in the tangent frame; [`crate::sampling`] draws them.
//!
//! | symbol | item | source |
//! |---|---|---|
//! | D | [`Ggx::d`], [`Ggx::d_between`] | Walter et al. 2007, eq. 33; Burley 2012, eq. 13 |
//! | Λ, G₁ | [`Ggx::lambda`], [`Ggx::g1`] | Heitz 2014, eq. 86, 43 |
//! | V | [`Ggx::visibility`] | Heitz 2014, eq. 99 |
//! | D V | [`Ggx::eval`] | Walter et al. 2007, eq. 20 |
//! | V·H, 1 − V·H | [`v_dot_h_and_rest`] | Hammon 2017 |
//! | F | [`Fresnel`] | see [`crate::fresnel`] |
//! | D V F cos θ | [`Specular`] | Walter et al. 2007, eq. 20; Heitz 2014, eq. 99 |
//!
//! Given vectors instead of cosines nothing cancels: sin²θ is x² + y², the half vector is used as l + v
//! without its length, and 1 − V·H is |l − v|²/(4 (1 + V·H)). Directions are expected to have length 1 and
//! to point away from the surface; z is along the normal. Where lengths or widths are such that a square
//! overflows or vanishes, the value is that of the directions.
//!
//! ```
//! use brdf::{Fresnel, Ggx, Specular, glam::Vec3};
//!
//! let gold = Fresnel::Conductor { n: [0.143f32, 0.375, 1.442], k: [3.983, 2.386, 1.603] };
//! let lobe = Specular { ggx: Ggx::new(0.16), fresnel: gold };
//! let (l, v) = (Vec3::new(0.6, 0.0, 0.8), Vec3::new(-0.6, 0.0, 0.8));
//! let [red, green, blue] = lobe.eval_cos(l, v); // D V F cos θ, in 1/sr
//! assert!(red > green && green > blue);
//! ```

use crate::fresnel::{conductor_rgb, f_dielectric};
use crate::real::{Real, lit, plus, quotient, squared, times, zero_unless_nan};
use crate::sampling::{Sample, Sampler};
use crate::vector::{Vector, rescued, tamed};
use std::f64::consts::FRAC_1_PI;

/// A GGX surface: its widths along the tangent and the bitangent.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ggx<R> {
    /// Width along the tangent, more than 0.
    pub alpha_x: R,
    /// Width along the bitangent, more than 0.
    pub alpha_y: R,
}

impl<R: Real> Ggx<R> {
    /// The same width in all directions.
    ///
    /// - *Arguments*: `alpha` α = roughness² in (0, 1]; 0 is a mirror.
    #[inline(always)]
    pub fn new(alpha: R) -> Ggx<R> {
        Ggx {
            alpha_x: alpha,
            alpha_y: alpha,
        }
    }

    /// The same with widths whose squares can be computed with.
    pub(crate) fn tamed(&self) -> Ggx<R> {
        let width = |alpha: R| alpha.abs().at_least(lit(1e-9)).at_most(lit(1e6));
        Ggx {
            alpha_x: width(self.alpha_x),
            alpha_y: width(self.alpha_y),
        }
    }

    /// x and y of a vector, each times its width.
    #[inline(always)]
    pub(crate) fn stretched(&self, v: Vector<R>) -> (R, R) {
        (self.alpha_x * v[0], self.alpha_y * v[1])
    }

    /// How long a direction is where the surface is squeezed to α = 1.
    ///
    /// ```text
    /// sqrt(z² + α_x² x² + α_y² y²) = z sqrt(1 + α² tan²θ)
    /// ```
    ///
    /// - *Arguments*: `v`.
    #[inline(always)]
    pub fn projected(&self, v: impl Into<Vector<R>>) -> R {
        let v = v.into();
        let (x, y) = self.stretched(v);
        (v[2] * v[2] + (x * x + y * y)).sqrt()
    }

    /// D of a half vector of any length, such as l + v.
    ///
    /// ```text
    /// D = m² / (π α_x α_y t²),    m = |h|², t = (h_x/α_x)² + (h_y/α_y)² + h_z²
    /// ```
    ///
    /// - *Source*: Walter et al. 2007, eq. 33; Burley 2012, eq. 13; see [`crate::d_ggx_aniso`].
    /// - *Arguments*: `h` in the tangent frame, of any length.
    /// - *Value*: 1/sr.
    /// - *Outside*: 0 below the horizon, and for a vector without length.
    /// - *Error*: as [`Ggx::d_between`], for the vector given: four ulps more than that where it is a
    ///   rounded sum.
    #[inline(always)]
    pub fn d(&self, h: impl Into<Vector<R>>) -> R {
        let h = h.into();
        let value = self.d_squares(h, h.map(|x| x * x));
        rescued(value, (h, h), *self, |ggx, h, _| {
            ggx.tamed().d_squares(h, h.map(|x| x * x))
        })
    }

    /// D of the half vector of `l` and `v`, of which the sums' rounding errors are kept.
    ///
    /// ```text
    /// D as in Ggx::d with h = l + v
    /// ```
    ///
    /// - *Source*: Walter et al. 2007, eq. 33.
    /// - *Arguments*: `l` and `v` the directions to light and viewer in the tangent frame, of length
    ///   1.
    /// - *Value*: 1/sr.
    /// - *Outside*: 0 below the horizon and where l = −v.
    /// - *Error*: 10.0 ulp in f32, 8.0 in f64; 4.8 and 4.1 on a stretched surface.
    #[inline(always)]
    pub fn d_between(&self, l: impl Into<Vector<R>>, v: impl Into<Vector<R>>) -> R {
        let (l, v) = (l.into(), v.into());
        let value = self.d_of_sum(l, v);
        rescued(value, (l, v), *self, |ggx, l, v| ggx.tamed().d_of_sum(l, v))
    }

    #[inline(always)]
    pub(crate) fn d_of_sum(&self, l: Vector<R>, v: Vector<R>) -> R {
        let (h, squares) = half_squared(l, v);
        if self.alpha_x != self.alpha_y && h[2] >= lit(0.0) {
            let (a, b) = (self.alpha_x, self.alpha_y);
            let d = d_stretched(l[0], l[1], l[2], v[0], v[1], v[2], a, b);
            if d.is_finite() {
                return d;
            }
        }
        self.d_squares(h, squares)
    }

    /// D of a half vector with its squared components.
    #[inline(always)]
    fn d_squares(&self, h: Vector<R>, squares: Vector<R>) -> R {
        let d = self.d_unless_smooth(h, squares);
        if d.is_finite() {
            d
        } else {
            smooth_d(h[0], h[1], h[2], self.alpha_x, self.alpha_y, d)
        }
    }

    /// The same, but not finite where [`smooth_d`] is needed.
    #[inline(always)]
    fn d_unless_smooth(&self, h: Vector<R>, [x, y, z]: Vector<R>) -> R {
        if h[2] < lit(0.0) {
            return zero_unless_nan(h);
        }
        if self.alpha_x != self.alpha_y {
            let (zero, [x, y, z]) = (lit(0.0), h);
            return d_stretched(x, y, z, zero, zero, zero, self.alpha_x, self.alpha_y);
        }
        // t times α².
        let product = self.alpha_x * self.alpha_y;
        let across = x + y;
        let (m, m_low) = across.two_sum(z);
        if m == lit(0.0) {
            return m;
        }
        // The quotient counts twice, so that its sums keep their rounding errors.
        let (t, t_low) = across.two_sum(product * z);
        // Two quotients that do not wait for each other.
        let (q, over_t) = (m / t, lit::<R>(1.0) / t);
        let low = (m_low - q * t_low) * over_t;
        let q = if low.is_finite() { q + low } else { q };
        // One by one: q² overflows where D does not.
        product * q * q * lit(FRAC_1_PI)
    }

    /// The same with what rounding a squared component leaves, but not the sums of them.
    #[inline(always)]
    fn d_of_squares(&self, [x, y, z]: Vector<R>) -> R {
        let product = self.alpha_x * self.alpha_y;
        let xy = x + y;
        let across = if self.alpha_x == self.alpha_y {
            xy
        } else {
            let ratio = self.alpha_y / self.alpha_x;
            x * ratio + y / ratio
        };
        let q = (xy + z) / (across + product * z);
        product * lit(FRAC_1_PI) * q * q
    }

    /// Λ of a direction, see [`crate::lambda_ggx`].
    ///
    /// ```text
    /// Λ = (−1 + sqrt(1 + (α_x² x² + α_y² y²)/z²)) / 2
    /// ```
    ///
    /// - *Source*: Heitz 2014, eq. 86.
    /// - *Arguments*: `v` a direction of length 1.
    /// - *Value*: 0 to +∞.
    /// - *Outside*: +∞ at and below the horizon.
    /// - *Error*: 5.6 ulp in f32, 4.9 in f64.
    #[inline(always)]
    pub fn lambda(&self, v: impl Into<Vector<R>>) -> R {
        let v = v.into();
        let value = self.lambda_of(v);
        rescued(value, (v, v), *self, |ggx, v, _| ggx.tamed().lambda_of(v))
    }

    #[inline(always)]
    fn lambda_of(&self, v: Vector<R>) -> R {
        if v[2] <= lit(0.0) {
            return lit::<R>(1.0) / lit(0.0);
        }
        let (x, y) = self.stretched(v);
        let z = v[2];
        let s = x * x + y * y;
        lit::<R>(0.5) * (s / z) / (z + (z * z + s).sqrt())
    }

    /// G₁ of a direction, see [`crate::g1_ggx`].
    ///
    /// ```text
    /// G₁ = 2 z / (z + sqrt(z² + α_x² x² + α_y² y²))
    /// ```
    ///
    /// - *Source*: Heitz 2014, eq. 43 with 86.
    /// - *Arguments*: `v` a direction of length 1.
    /// - *Value*: 0 to 1.
    /// - *Outside*: 0 at and below the horizon.
    /// - *Error*: 4.1 ulp in f32, 2.7 in f64.
    #[inline(always)]
    pub fn g1(&self, v: impl Into<Vector<R>>) -> R {
        let v = v.into();
        let value = self.g1_of(v);
        rescued(value, (v, v), *self, |ggx, v, _| ggx.tamed().g1_of(v))
    }

    #[inline(always)]
    fn g1_of(&self, v: Vector<R>) -> R {
        if v[2] <= lit(0.0) {
            return zero_unless_nan(v);
        }
        lit::<R>(2.0) * v[2] / (v[2] + self.projected(v))
    }

    /// Height-correlated visibility, see [`crate::v_ggx`].
    ///
    /// ```text
    /// V = G₂/(4 N·L N·V) = 0.5 / (l_z sqrt(v_z² + α_x² v_x² + α_y² v_y²) + v_z sqrt(l_z² + α_x² l_x² + α_y² l_y²))
    /// ```
    ///
    /// - *Source*: Heitz 2014, eq. 99.
    /// - *Arguments*: `l` and `v` the directions to light and viewer in the tangent frame, of length
    ///   1.
    /// - *Value*: 1/4 at normal incidence to +∞.
    /// - *Outside*: 0 below the horizon; on it the limit.
    /// - *Error*: 5.0 ulp in f32, 4.0 in f64.
    #[inline(always)]
    pub fn visibility(&self, l: impl Into<Vector<R>>, v: impl Into<Vector<R>>) -> R {
        let (l, v) = (l.into(), v.into());
        let value = self.visibility_of(l, v);
        rescued(value, (l, v), *self, |ggx, l, v| {
            ggx.tamed().visibility_of(l, v)
        })
    }

    #[inline(always)]
    pub(crate) fn visibility_of(&self, l: Vector<R>, v: Vector<R>) -> R {
        if l[2] < lit(0.0) || v[2] < lit(0.0) {
            return zero_unless_nan([l[2], v[2]]);
        }
        lit::<R>(0.5) / (l[2] * self.projected(v) + v[2] * self.projected(l)).abs()
    }

    /// The BRDF with F = 1: D V.
    ///
    /// ```text
    /// f = D V
    /// ```
    ///
    /// - *Source*: Walter et al. 2007, eq. 20; Heitz 2014, eq. 99.
    /// - *Arguments*: `l` and `v` the directions to light and viewer in the tangent frame, of length
    ///   1.
    /// - *Value*: 1/sr, 0 to +∞. Reciprocal.
    /// - *Outside*: 0 below the horizon.
    /// - *Error*: 15.1 ulp in f32, 12.7 in f64; D here keeps fewer rounding errors than
    ///   [`Ggx::d_between`], for speed.
    #[inline(always)]
    pub fn eval(&self, l: impl Into<Vector<R>>, v: impl Into<Vector<R>>) -> R {
        let (l, v) = (l.into(), v.into());
        if l[2] < lit(0.0) || v[2] < lit(0.0) {
            return below_horizon(l, v);
        }
        let (_, squares) = half_squared(l, v);
        let value = self.d_of_squares(squares) * (lit::<R>(0.5) / self.facing(l, v));
        if value.is_finite() {
            value
        } else {
            eval_again(
                self.alpha_x,
                self.alpha_y,
                l[0],
                l[1],
                l[2],
                v[0],
                v[1],
                v[2],
            )
        }
    }

    /// Half of what V is the inverse of, for directions above the horizon.
    #[inline(always)]
    fn facing(&self, l: Vector<R>, v: Vector<R>) -> R {
        l[2] * self.projected(v) + v[2] * self.projected(l)
    }
}

/// 0, or a component that is NaN.
#[inline(always)]
fn below_horizon<R: Real>(l: Vector<R>, v: Vector<R>) -> R {
    zero_unless_nan([l[0], l[1], l[2], v[0], v[1], v[2]])
}

/// [`Ggx::eval`] where that needs more than the formula. It takes numbers for the reason that
/// [`rescued`] does.
#[cold]
#[inline(never)]
#[allow(clippy::too_many_arguments)]
fn eval_again<R: Real>(
    alpha_x: R,
    alpha_y: R,
    l_x: R,
    l_y: R,
    l_z: R,
    v_x: R,
    v_y: R,
    v_z: R,
) -> R {
    let (ggx, l, v) = (Ggx { alpha_x, alpha_y }, [l_x, l_y, l_z], [v_x, v_y, v_z]);
    let value = ggx.d_of_sum(l, v) * ggx.visibility_of(l, v);
    rescued(value, (l, v), ggx, |ggx, l, v| {
        let ggx = ggx.tamed();
        ggx.d_of_sum(l, v) * ggx.visibility_of(l, v)
    })
}

/// The sum of two directions, and the squares of its components with their sums' rounding
/// errors.
#[inline(always)]
fn half_squared<R: Real>(l: Vector<R>, v: Vector<R>) -> (Vector<R>, Vector<R>) {
    let (x, y, z) = (l[0].two_sum(v[0]), l[1].two_sum(v[1]), l[2].two_sum(v[2]));
    ([x.0, y.0, z.0], [square(x), square(y), square(z)])
}

/// D of a stretched surface from a light and a view: (α_x α_y m/t)² α_x α_y/π with m = |h|²,
/// t = α_y² h_x² + α_x² h_y² + α_x² α_y² h_z², h = l + v. Nothing of m and t is the same here, so
/// that both keep all of their rounding errors. It takes numbers for the reason that [`rescued`]
/// does.
#[inline(never)]
#[allow(clippy::too_many_arguments)]
fn d_stretched<R: Real>(
    l_x: R,
    l_y: R,
    l_z: R,
    v_x: R,
    v_y: R,
    v_z: R,
    alpha_x: R,
    alpha_y: R,
) -> R {
    let [x, y, z] = [l_x.two_sum(v_x), l_y.two_sum(v_y), l_z.two_sum(v_z)].map(squared);
    let m = plus(plus(x, y), z);
    if m.0 == lit(0.0) {
        return m.0;
    }
    let (a2, b2) = (alpha_x.two_square(), alpha_y.two_square());
    let t = plus(plus(times(b2, x), times(a2, y)), times(times(a2, b2), z));
    if t.0 < lit(R::TINY) {
        // Of too few digits: [`smooth_d`] has them.
        return m.0 / lit(0.0);
    }
    let product = alpha_x.two_prod(alpha_y);
    let (q, low) = quotient(times(product, m), t);
    let q = q + low;
    // One by one: the square overflows where D does not.
    product.0 * q * q * lit(FRAC_1_PI)
}

/// D of a surface so smooth that α² is not a number of full precision, where `d` is not finite:
/// (m/h_z²)²/(π α_x α_y (1 + (h_x/(α_x h_z))² + (h_y/(α_y h_z))²)²).
#[cold]
#[inline(never)]
fn smooth_d<R: Real>(x: R, y: R, z: R, alpha_x: R, alpha_y: R, d: R) -> R {
    let (p, q) = (x / z, y / z);
    let over = |p: R, alpha: R| if p == lit(0.0) { p } else { p / alpha };
    let (s, t) = (over(p, alpha_x), over(q, alpha_y));
    let spread = lit::<R>(1.0) + s * s + t * t;
    let m = (lit::<R>(1.0) + p * p + q * q) / spread;
    let value = (m / alpha_x) * (m / alpha_y) * lit(FRAC_1_PI);
    if value.is_nan() { d } else { value }
}

/// V·H and 1 − V·H, the second without cancellation.
///
/// ```text
/// V·H = |l + v|/2,    1 − V·H = |l − v|²/(4 (1 + V·H))
/// ```
///
/// - *Source*: Hammon 2017; identities of directions of length 1.
/// - *Arguments*: `l` and `v` the directions to light and viewer in the tangent frame, of length
///   1.
/// - *Value*: both 0 to 1.
/// - *Outside*: for other lengths those of the directions.
/// - *Error*: 1.9 and 3.1 ulp in f32, 1.7 and 2.8 in f64.
///
/// Schlick takes the fifth power of the second, so that each of its ulps counts five times: sums
/// and differences keep their rounding errors, and far from l = v the plain difference is the
/// better one.
#[inline(always)]
pub fn v_dot_h_and_rest<R: Real>(l: impl Into<Vector<R>>, v: impl Into<Vector<R>>) -> (R, R) {
    let (l, v) = (l.into(), v.into());
    let (c, rest) = half_angle(l, v);
    // Of directions the sum is 1.
    if c + rest <= lit(2.0) {
        (c, rest)
    } else {
        half_angle_of_directions(l[0], l[1], l[2], v[0], v[1], v[2])
    }
}

/// The same for vectors far from length 1, of which only the directions count. It takes numbers
/// for the reason that [`rescued`] does.
#[cold]
#[inline(never)]
fn half_angle_of_directions<R: Real>(l_x: R, l_y: R, l_z: R, v_x: R, v_y: R, v_z: R) -> (R, R) {
    let (l, v) = ([l_x, l_y, l_z], [v_x, v_y, v_z]);
    match l.into_iter().chain(v).find(|x| x.is_nan()) {
        Some(nan) => (nan, nan),
        None => half_angle(tamed(l), tamed(v)),
    }
}

#[inline(always)]
fn half_angle<R: Real>(l: Vector<R>, v: Vector<R>) -> (R, R) {
    let one = lit::<R>(1.0);
    let c = lit::<R>(0.5) * sum_squared(l, v).sqrt();
    let rest = if c < lit(0.5) {
        one - c
    } else {
        lit::<R>(0.25) * difference_squared(l, v) / (one + c)
    };
    (c, rest)
}

/// |a + b|², with the rounding errors of the sums.
#[inline(always)]
fn sum_squared<R: Real>(a: Vector<R>, b: Vector<R>) -> R {
    square(a[0].two_sum(b[0])) + square(a[1].two_sum(b[1])) + square(a[2].two_sum(b[2]))
}

/// |a − b|², with the rounding errors of all sums.
#[inline(always)]
fn difference_squared<R: Real>(a: Vector<R>, b: Vector<R>) -> R {
    let square = |(high, low): (R, R)| (high * high, high * low);
    let (x, x_low) = square(a[0].two_sum(-b[0]));
    let (y, y_low) = square(a[1].two_sum(-b[1]));
    let (z, z_low) = square(a[2].two_sum(-b[2]));
    let (sum, low) = x.two_sum(y);
    let (sum, low2) = sum.two_sum(z);
    sum + ((low + low2) + lit::<R>(2.0) * (x_low + y_low + z_low))
}

/// The square of an unevaluated sum, without its last term.
#[inline(always)]
fn square<R: Real>((high, low): (R, R)) -> R {
    high * high + lit::<R>(2.0) * high * low
}

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
    /// A conductor, see [`crate::f_conductor`].
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
    /// - *Source*: see [`crate::fresnel`].
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
    fn of_facet(&self, l: Vector<R>, v: Vector<R>) -> [R; 3] {
        let (c, rest) = v_dot_h_and_rest(l, v);
        self.at(c, rest)
    }

    /// Of V·H and 1 − V·H.
    #[inline(always)]
    fn at(&self, c: R, rest: R) -> [R; 3] {
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

/// A whole specular lobe: GGX with mirrors of some material.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Specular<R> {
    /// How the facets lie.
    pub ggx: Ggx<R>,
    /// What they are made of.
    pub fresnel: Fresnel<R>,
}

impl<R: Real> Specular<R> {
    /// BRDF times N·L.
    ///
    /// ```text
    /// f cos θ = D V F N·L
    /// ```
    ///
    /// - *Source*: Walter et al. 2007, eq. 20; Heitz 2014, eq. 99.
    /// - *Arguments*: `l` and `v` the directions to light and viewer in the tangent frame, of length
    ///   1.
    /// - *Value*: 1/sr, red, green and blue.
    /// - *Outside*: 0 below the horizon.
    /// - *Error*: with Schlick's reflectance 20.9 ulp in f32 and f64.
    #[inline(always)]
    pub fn eval_cos(&self, l: impl Into<Vector<R>>, v: impl Into<Vector<R>>) -> [R; 3] {
        let (l, v) = (l.into(), v.into());
        if l[2] < lit(0.0) || v[2] < lit(0.0) {
            return [below_horizon(l, v); 3];
        }
        let (_, squares) = half_squared(l, v);
        let facing = self.ggx.facing(l, v);
        let value = self.ggx.d_of_squares(squares) * (l[2] / (facing + facing));
        let (c, rest) = half_angle(l, v);
        let [r, g, b] = self.fresnel.at(c, rest).map(|f| f * value);
        if (r + g + b).is_finite() && c + rest <= lit(2.0) {
            [r, g, b]
        } else {
            self.eval_cos_again(l[0], l[1], l[2], v[0], v[1], v[2])
        }
    }

    /// [`Specular::eval_cos`] where that needs more than the formula. It takes numbers for the
    /// reason that [`rescued`] does.
    #[cold]
    #[inline(never)]
    fn eval_cos_again(&self, l_x: R, l_y: R, l_z: R, v_x: R, v_y: R, v_z: R) -> [R; 3] {
        let (l, v) = ([l_x, l_y, l_z], [v_x, v_y, v_z]);
        let value = self.ggx.eval(l, v) * l_z;
        // ∞ · 0 at the peak or on the horizon of a mirror: nothing leaves there.
        let nothing = |(), _, _| lit(0.0);
        self.fresnel
            .of_facet(l, v)
            .map(|f| rescued(f * value, (l, v), (), nothing))
    }

    /// Draws a light for a view: the direction, its density, and BRDF · N·L / density in three
    /// colours.
    ///
    /// - *Arguments*: `v` the view; `u` two numbers in [0, 1); `sampler` how.
    ///
    /// The mean of the weights over many `u` is the directional albedo. See [`Ggx::sample`].
    ///
    /// ```
    /// use brdf::{Fresnel, Ggx, Sampler, Specular};
    /// let lobe = Specular { ggx: Ggx::new(0.16f64), fresnel: Fresnel::Schlick { f0: [0.9, 0.5, 0.2] } };
    /// let (drawn, rgb) = lobe.sample([0.0, 0.0, 1.0], [0.3, 0.7], Sampler::BoundedCap);
    /// // The weight is BRDF · N·L over the density.
    /// let value = lobe.eval_cos(drawn.l, [0.0, 0.0, 1.0]);
    /// assert!((rgb[0] - value[0] / drawn.pdf).abs() < 1e-13);
    /// ```
    pub fn sample(
        &self,
        v: impl Into<Vector<R>>,
        u: [R; 2],
        sampler: Sampler,
    ) -> (Sample<R>, [R; 3]) {
        let v = v.into();
        let sample = self.ggx.sample(v, u, sampler);
        (
            sample,
            self.fresnel.eval(sample.l, v).map(|f| f * sample.weight),
        )
    }
}
