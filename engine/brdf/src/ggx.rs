//! GGX from vectors in the tangent frame: evaluate, sample, density.
//!
//! Given vectors instead of cosines nothing cancels: sin²θ is x² + y², the half vector is
//! used as l + v without its length, and 1 − V·H is |l − v|²/(4 (1 + V·H)). Directions are
//! expected to have length 1 and to point away from the surface.

use crate::fresnel::{conductor_rgb, f_dielectric};
use crate::real::{Real, lit, zero_unless_nan};
use crate::vector::{Vector, add, normalize, reflect, rescued, tamed};
use std::f64::consts::{FRAC_1_PI, PI};

/// A GGX surface: its widths along the tangent and the bitangent.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ggx<R> {
    /// Width along the tangent, more than 0.
    pub alpha_x: R,
    /// Width along the bitangent, more than 0.
    pub alpha_y: R,
}

/// How to draw directions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sampler {
    /// Visible normals from a projected hemisphere (Heitz 2018, JCGT 7-4).
    Hemisphere,
    /// The same normals from a spherical cap (Dupuy and Benyoub 2023, CGF 42-8, algorithm 1).
    SphericalCap,
    /// A cap without directions that must end below the horizon (Eto and Tokuyoshi 2023,
    /// SIGGRAPH Asia technical communications). The best of them, but for α near 1.
    BoundedCap,
    /// Proportional to the cosine, without knowledge of the surface.
    Cosine,
}

/// A drawn direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample<R> {
    /// The direction of the light. Below the horizon the weight is 0.
    pub l: Vector<R>,
    /// BRDF (F = 1) times N·L over the density.
    pub weight: R,
    /// Density with respect to the solid angle of `l`, in 1/sr.
    pub pdf: R,
}

impl<R: Real> Ggx<R> {
    /// The same width in all directions.
    #[inline(always)]
    pub fn new(alpha: R) -> Ggx<R> {
        Ggx {
            alpha_x: alpha,
            alpha_y: alpha,
        }
    }

    /// The same with widths whose squares can be computed with.
    fn tamed(&self) -> Ggx<R> {
        let width = |alpha: R| alpha.abs().at_least(lit(1e-9)).at_most(lit(1e6));
        Ggx {
            alpha_x: width(self.alpha_x),
            alpha_y: width(self.alpha_y),
        }
    }

    /// x and y of a vector, each times its width.
    #[inline(always)]
    fn stretched(&self, v: Vector<R>) -> (R, R) {
        (self.alpha_x * v[0], self.alpha_y * v[1])
    }

    /// sqrt(z² + α_x² x² + α_y² y²), which is z sqrt(1 + α² tan²θ).
    #[inline(always)]
    pub fn projected(&self, v: impl Into<Vector<R>>) -> R {
        let v = v.into();
        let (x, y) = self.stretched(v);
        (v[2] * v[2] + (x * x + y * y)).sqrt()
    }

    /// D of a half vector of any length, such as l + v.
    ///
    /// D = (m/(α_x α_y t))² α_x α_y/π with m = |h|², t = (h_x/α_x)² + (h_y/α_y)² + h_z²;
    /// see [`crate::d_ggx_aniso`]. 0 below the horizon, and for a vector without length.
    #[inline(always)]
    pub fn d(&self, h: impl Into<Vector<R>>) -> R {
        let h = h.into();
        let value = self.d_squares(h, h.map(|x| x * x));
        rescued(value, (h, h), *self, |ggx, h, _| {
            ggx.tamed().d_squares(h, h.map(|x| x * x))
        })
    }

    /// D of the half vector of `l` and `v`, of which the sums' rounding errors are kept: it
    /// costs a few operations and saves four units in the last place.
    #[inline(always)]
    pub fn d_between(&self, l: impl Into<Vector<R>>, v: impl Into<Vector<R>>) -> R {
        let (l, v) = (l.into(), v.into());
        let value = self.d_of_sum(l, v);
        rescued(value, (l, v), *self, |ggx, l, v| ggx.tamed().d_of_sum(l, v))
    }

    #[inline(always)]
    fn d_of_sum(&self, l: Vector<R>, v: Vector<R>) -> R {
        let (x, y, z) = (l[0].two_sum(v[0]), l[1].two_sum(v[1]), l[2].two_sum(v[2]));
        self.d_squares([x.0, y.0, z.0], [square(x), square(y), square(z)])
    }

    /// D of a half vector with its squared components.
    #[inline(always)]
    fn d_squares(&self, h: Vector<R>, [x, y, z]: Vector<R>) -> R {
        if h[2] < lit(0.0) {
            return zero_unless_nan(h);
        }
        // t times α_x α_y, without quotients where the widths are the same.
        let product = self.alpha_x * self.alpha_y;
        let across = if self.alpha_x == self.alpha_y {
            x + y
        } else {
            x * (self.alpha_y / self.alpha_x) + y * (self.alpha_x / self.alpha_y)
        };
        let m = x + y + z;
        if m == lit(0.0) {
            return m;
        }
        let q = m / (across + product * z);
        product * (q * q) * lit(FRAC_1_PI)
    }

    /// Λ of a direction, see [`crate::lambda_ggx`]; +∞ at and below the horizon.
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
    #[inline(always)]
    pub fn g1(&self, v: impl Into<Vector<R>>) -> R {
        let v = v.into();
        if v[2] <= lit(0.0) {
            return zero_unless_nan(v);
        }
        lit::<R>(2.0) * v[2] / (v[2] + self.projected(v))
    }

    /// Height-correlated visibility, see [`crate::v_ggx`]; 0 below the horizon.
    #[inline(always)]
    pub fn visibility(&self, l: impl Into<Vector<R>>, v: impl Into<Vector<R>>) -> R {
        let (l, v) = (l.into(), v.into());
        let value = self.visibility_of(l, v);
        rescued(value, (l, v), *self, |ggx, l, v| {
            ggx.tamed().visibility_of(l, v)
        })
    }

    #[inline(always)]
    fn visibility_of(&self, l: Vector<R>, v: Vector<R>) -> R {
        if l[2] < lit(0.0) || v[2] < lit(0.0) {
            return zero_unless_nan([l[2], v[2]]);
        }
        lit::<R>(0.5) / (l[2] * self.projected(v) + v[2] * self.projected(l))
    }

    /// The BRDF with F = 1: D V, in 1/sr.
    #[inline(always)]
    pub fn eval(&self, l: impl Into<Vector<R>>, v: impl Into<Vector<R>>) -> R {
        let (l, v) = (l.into(), v.into());
        let value = self.d_of_sum(l, v) * self.visibility_of(l, v);
        rescued(value, (l, v), *self, |ggx, l, v| {
            let ggx = ggx.tamed();
            ggx.d_of_sum(l, v) * ggx.visibility_of(l, v)
        })
    }

    /// Density with which [`Ggx::sample`] draws `l` for a view `v`, in 1/sr, for `l` above the
    /// horizon. Below it only [`Sampler::BoundedCap`] may never draw what has a density here.
    #[inline(always)]
    pub fn pdf(&self, l: impl Into<Vector<R>>, v: impl Into<Vector<R>>, sampler: Sampler) -> R {
        let (l, v) = (l.into(), v.into());
        if sampler == Sampler::Cosine {
            return l[2].at_least(lit(0.0)) * lit(FRAC_1_PI);
        }
        let value = self.d_of_sum(l, v) * self.visible_share(v, sampler);
        rescued(value, (l, v), (*self, sampler), |(ggx, sampler), l, v| {
            let ggx = ggx.tamed();
            ggx.d_of_sum(l, v) * ggx.visible_share(v, sampler)
        })
    }

    /// Density over D: 1/(2 (N·V + sqrt(…))), the normalisation of the visible normals over
    /// the 4 V·H of the mirror.
    #[inline(always)]
    fn visible_share(&self, v: Vector<R>, sampler: Sampler) -> R {
        let length = self.projected(v);
        let z = v[2];
        if z < lit(0.0) {
            // z + length without the difference.
            let (x, y) = self.stretched(v);
            return lit::<R>(0.5) * (length - z) / (x * x + y * y);
        }
        let k = if sampler == Sampler::BoundedCap {
            self.cap_bound(v)
        } else {
            lit(1.0)
        };
        lit::<R>(0.5) / (k * z + length)
    }

    /// How far down the cap of a view has to reach: Eto and Tokuyoshi's k.
    #[inline(always)]
    fn cap_bound(&self, v: Vector<R>) -> R {
        let one = lit::<R>(1.0);
        let a = self.alpha_x.at_most(self.alpha_y).clamp_unit();
        let s = one + (v[0] * v[0] + v[1] * v[1]).sqrt();
        let (a2, s2) = (a * a, s * s);
        (one - a) * (one + a) * s2 / (s2 + a2 * (v[2] * v[2]))
    }

    /// Draws a light for a view from two numbers in [0, 1).
    ///
    /// The weight is G₂/G₁ for visible normals, and BRDF · N·L / density for the others.
    pub fn sample(&self, v: impl Into<Vector<R>>, u: [R; 2], sampler: Sampler) -> Sample<R> {
        let v = v.into();
        let l = match sampler {
            Sampler::Cosine => cosine_direction(u),
            Sampler::Hemisphere => reflect(v, self.visible_normal(v, u)),
            Sampler::SphericalCap => self.cap_direction(v, u, lit(1.0)),
            Sampler::BoundedCap if v[2] > lit(0.0) => self.cap_direction(v, u, self.cap_bound(v)),
            Sampler::BoundedCap => self.cap_direction(v, u, lit(1.0)),
        };
        let d = self.d_between(l, v);
        let pdf = match sampler {
            Sampler::Cosine => l[2].at_least(lit(0.0)) * lit(FRAC_1_PI),
            _ => d * self.visible_share(v, sampler),
        };
        let weight = if l[2] <= lit(0.0) || v[2] <= lit(0.0) {
            zero_unless_nan([l[2], v[2]])
        } else if sampler == Sampler::Cosine {
            d * self.visibility(l, v) * lit(PI)
        } else {
            self.visibility(l, v) * l[2] / self.visible_share(v, sampler)
        };
        Sample { l, weight, pdf }
    }

    /// A normal that is visible from `v` (Heitz 2018).
    fn visible_normal(&self, v: Vector<R>, u: [R; 2]) -> Vector<R> {
        let (zero, one) = (lit::<R>(0.0), lit::<R>(1.0));
        let (x, y) = self.stretched(v);
        let view = normalize([x, y, v[2]]);
        let across = view[0] * view[0] + view[1] * view[1];
        let t1 = if across > zero {
            let scale = one / across.sqrt();
            [-view[1] * scale, view[0] * scale, zero]
        } else {
            [one, zero, zero]
        };
        let t2 = [
            view[1] * t1[2] - view[2] * t1[1],
            view[2] * t1[0] - view[0] * t1[2],
            view[0] * t1[1] - view[1] * t1[0],
        ];
        let (radius, phi) = (u[0].sqrt(), u[1] * lit(2.0 * PI));
        let (a, b) = (radius * phi.cos(), radius * phi.sin());
        let s = lit::<R>(0.5) * (one + view[2]);
        let b = (one - s) * (one - a * a).at_least(zero).sqrt() + s * b;
        let c = (one - a * a - b * b).at_least(zero).sqrt();
        let n = |i: usize| a * t1[i] + b * t2[i] + c * view[i];
        normalize([
            self.alpha_x * n(0),
            self.alpha_y * n(1),
            n(2).at_least(zero),
        ])
    }

    /// A light from the cap z > −`bound` z_v of the stretched sphere around a view.
    #[inline(always)]
    fn cap_direction(&self, v: Vector<R>, u: [R; 2], bound: R) -> Vector<R> {
        let one = lit::<R>(1.0);
        let (x, y) = self.stretched(v);
        let view = normalize([x, y, v[2]]);
        let low = bound * view[2];
        let z = (one - u[1]) * (one + low) - low;
        let sin = ((one - z) * (one + z)).at_least(lit(0.0)).sqrt();
        let phi = u[0] * lit(2.0 * PI);
        let m = add(view, [sin * phi.cos(), sin * phi.sin(), z]);
        reflect(
            v,
            normalize([self.alpha_x * m[0], self.alpha_y * m[1], m[2]]),
        )
    }
}

/// A direction with density cos θ/π.
fn cosine_direction<R: Real>(u: [R; 2]) -> Vector<R> {
    let (radius, phi) = (u[0].sqrt(), u[1] * lit(2.0 * PI));
    [
        radius * phi.cos(),
        radius * phi.sin(),
        (lit::<R>(1.0) - u[0]).at_least(lit(0.0)).sqrt(),
    ]
}

/// V·H = |l + v|/2 and 1 − V·H = |l − v|²/(4 (1 + V·H)), for directions of length 1.
///
/// Schlick takes the fifth power of the second, so that each of its ulps counts five times:
/// sums and differences keep their rounding errors, and far from l = v the plain difference
/// is the better one.
#[inline(always)]
pub fn v_dot_h_and_rest<R: Real>(l: impl Into<Vector<R>>, v: impl Into<Vector<R>>) -> (R, R) {
    let (l, v) = (l.into(), v.into());
    let (c, rest) = half_angle(l, v);
    if c <= lit(2.0) {
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

/// |a − b|² to its last digit.
#[inline(always)]
fn difference_squared<R: Real>(a: Vector<R>, b: Vector<R>) -> R {
    let (x, x_low) = square_exact(a[0].two_sum(-b[0]));
    let (y, y_low) = square_exact(a[1].two_sum(-b[1]));
    let (z, z_low) = square_exact(a[2].two_sum(-b[2]));
    let (sum, low) = x.two_sum(y);
    let (sum, low2) = sum.two_sum(z);
    sum + ((low + low2) + (x_low + y_low + z_low))
}

/// The square of an unevaluated sum as one.
#[inline(always)]
fn square_exact<R: Real>((high, low): (R, R)) -> (R, R) {
    let (square, square_low) = high.two_square();
    (square, square_low + lit::<R>(2.0) * high * low)
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
    /// Reflectance of the facet that mirrors `l` into `v`, directions of length 1.
    #[inline(always)]
    pub fn eval(&self, l: impl Into<Vector<R>>, v: impl Into<Vector<R>>) -> [R; 3] {
        let (c, rest) = v_dot_h_and_rest(l.into(), v.into());
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
    /// BRDF times N·L, D V F cos θ, in 1/sr, for directions of length 1; 0 below the horizon.
    #[inline(always)]
    pub fn eval_cos(&self, l: impl Into<Vector<R>>, v: impl Into<Vector<R>>) -> [R; 3] {
        let (l, v) = (l.into(), v.into());
        let value = self.ggx.eval(l, v) * l[2].at_least(lit(0.0));
        let [r, g, b] = self.fresnel.eval(l, v).map(|f| f * value);
        if (r + g + b).is_nan() {
            // ∞ · 0 at the peak or on the horizon of a mirror: nothing leaves there.
            let zero = |(), _, _| lit(0.0);
            return [
                rescued(r, (l, v), (), zero),
                rescued(g, (l, v), (), zero),
                rescued(b, (l, v), (), zero),
            ];
        }
        [r, g, b]
    }

    /// Draws a light for a view: the direction, its density and BRDF · N·L / density.
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
