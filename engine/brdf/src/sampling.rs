//! Drawing lights for a view: visible normals in three ways, and the cosine.
//!
//! | [`Sampler`] | density of l | weight (F = 1) |
//! |---|---|---|
//! | [`Sampler::Hemisphere`], [`Sampler::SphericalCap`] | G₁(v) D/(4 N·V) | G₂/G₁(v) |
//! | [`Sampler::BoundedCap`] | D/(2 (k N·V + sqrt(…))) | D V N·L/density |
//! | [`Sampler::Cosine`] | N·L/π | D V π |
//!
//! The normals are those visible from v, D_v(m) = G₁(v) max(v·m, 0) D(m)/N·V, whose density is spread over
//! lights by dω_l = 4 v·m dω_m. Heitz and d'Eon 2014 introduced them; the first two samplers draw the same
//! ones in different ways. The bounded cap leaves out normals that must mirror below the horizon, and
//! divides the density by what remains: k = (1 − α²) s²/(s² + α² N·V²) with s = 1 + sin θ_v and α the
//! smaller width (Eto and Tokuyoshi 2023). With fewer lights wasted it is the best of them, but for α near
//! 1, where the cosine is.
//!
//! A light below the horizon has weight 0 and may be thrown away: that is what single scattering
//! loses. Views below the horizon work, too: a random walk comes from there.

use crate::ggx::Ggx;
use crate::real::{Real, lit, zero_unless_nan};
use crate::vector::{Vector, dot, normalize, rescued, tamed};
use std::f64::consts::{FRAC_1_PI, PI};

/// How to draw lights for a view: two ways to the visible normals, one that leaves out those which mirror
/// downwards, and one that knows nothing of the surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sampler {
    /// Visible normals from a projected hemisphere (Heitz 2018, JCGT 7-4). Numbers that are close to one
    /// another give normals that are.
    Hemisphere,
    /// The same normals from a spherical cap (Dupuy and Benyoub 2023, CGF 42-8): the same density, with
    /// less arithmetic.
    SphericalCap,
    /// A cap without directions that must end below the horizon (Eto and Tokuyoshi 2023,
    /// SIGGRAPH Asia technical communications). The best of them, but for α near 1.
    BoundedCap,
    /// Proportional to the cosine, without knowledge of the surface.
    Cosine,
}

/// A light that was drawn for a view.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample<R> {
    /// Its direction in the tangent frame, of length 1. It may lie below the horizon, where its weight is 0:
    /// the light is lost there, and to count only the others would be wrong.
    pub l: Vector<R>,
    /// BRDF (F = 1) times N·L over the density: times the reflectance and the light that comes from there,
    /// what the view gets. 0 to 1, but for [`Sampler::Cosine`], where it has no bound.
    pub weight: R,
    /// Density with respect to the solid angle of `l`, in 1/sr, see [`Ggx::pdf`].
    pub pdf: R,
}

/// Lights drawn for a view: how, how densely, and what each counts.
impl<R: Real> Ggx<R> {
    /// Density with which [`Ggx::sample`] draws `l` for a view `v`, for `l` above the horizon.
    ///
    /// ```text
    /// p = D/(2 (k N·V + sqrt(N·V² + α_x² v_x² + α_y² v_y²))),    k = 1 but for the bounded cap
    /// ```
    ///
    /// - *Source*: Heitz 2018; Dupuy and Benyoub 2023; Eto and Tokuyoshi 2023.
    /// - *Arguments*: `l` and `v` the directions to light and viewer in the tangent frame, of length
    ///   1; `sampler` by which the light was drawn.
    /// - *Value*: 1/sr, 0 to +∞. Its integral over all lights, those below the horizon included, is 1.
    /// - *Outside*: the density of the visible normals holds for views below the horizon, too. Of lights
    ///   below it, [`Sampler::BoundedCap`] may never draw what has a density here, and
    ///   [`Sampler::Cosine`] has none: 0.
    /// - *Error*: 10.5 ulp in f32, 8.1 in f64; 7.4 and 6.4 on a stretched surface.
    ///
    /// ```
    /// // The samplers of visible normals draw with one density, in two ways.
    /// use brdf::{Ggx, Sampler};
    /// let (ggx, v) = (Ggx::new(0.3f64), [0.8, 0.0, 0.6]);
    /// let drawn = ggx.sample(v, [0.25, 0.5], Sampler::SphericalCap);
    /// assert_eq!(drawn.pdf, ggx.pdf(drawn.l, v, Sampler::Hemisphere));
    /// // It is G₁ D/(4 N·V).
    /// let density = ggx.g1(v) * ggx.d_between(drawn.l, v) / (4.0 * v[2]);
    /// assert!((drawn.pdf / density - 1.0).abs() < 1e-13);
    /// ```
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
        let (a, s) = self.cap(v);
        let (a2, s2) = (a * a, s * s);
        (one - a) * (one + a) * s2 / (s2 + a2 * (v[2] * v[2]))
    }

    /// 1 − k, which of a smooth surface is all there is to know.
    #[inline(always)]
    fn cap_rest(&self, v: Vector<R>) -> R {
        let (a, s) = self.cap(v);
        let (a2, s2, z2) = (a * a, s * s, v[2] * v[2]);
        a2 * (s2 + z2) / (s2 + a2 * z2)
    }

    /// The smaller width, and 1 + sin θ.
    #[inline(always)]
    fn cap(&self, v: Vector<R>) -> (R, R) {
        let a = self.alpha_x.at_most(self.alpha_y).clamp_unit();
        (a, lit::<R>(1.0) + (v[0] * v[0] + v[1] * v[1]).sqrt())
    }

    /// Draws a light for a view from two numbers: the direction, its density, and what it counts.
    ///
    /// - *Source*: Heitz 2018, listing 1; Dupuy and Benyoub 2023; Eto and Tokuyoshi 2023.
    /// - *Arguments*: `v` the view, of length 1; `u` two numbers in [0, 1); `sampler` in which
    ///   of four ways.
    /// - *Value*: the direction, its weight BRDF · N·L / density (F = 1) and its density in 1/sr, both
    ///   of the direction as rounded. The mean weight is the directional albedo.
    /// - *Outside*: numbers are brought into [0, 1]. A view below the horizon draws normals that it sees
    ///   from there, with the weight 0; the cosine does not ask for the view.
    /// - *Error*: of the direction at most 12 ulp of 1, or what half a unit in the last place of
    ///   each argument changes, where that is more (0.38 to 0.55 of it found); of its density 10.7 ulp, of its
    ///   weight 6.3.
    ///
    /// ```
    /// use brdf::{Ggx, Sampler};
    /// let ggx = Ggx::new(0.4f64);
    /// let v = [0.6, 0.0, 0.8];
    /// let steps = 200;
    /// // A stratified estimate of the directional albedo.
    /// let mut sum = 0.0;
    /// for i in 0..steps * steps {
    ///     let u = [i / steps, i % steps].map(|i| (i as f64 + 0.5) / steps as f64);
    ///     sum += ggx.sample(v, u, Sampler::BoundedCap).weight;
    /// }
    /// let albedo = sum / (steps * steps) as f64;
    /// assert!((albedo - brdf::albedo_ggx(0.8, 0.4)).abs() < 1e-3);
    /// ```
    pub fn sample(&self, v: impl Into<Vector<R>>, u: [R; 2], sampler: Sampler) -> Sample<R> {
        let (v, u) = (v.into(), u.map(R::clamp_unit));
        let l = self.direction(v, u, sampler);
        let given = |v: Vector<R>| !v.into_iter().chain(u).any(R::is_nan);
        let l = if !l.into_iter().all(R::is_finite) && given(v) {
            self.tamed().direction(tamed(v), u, sampler)
        } else {
            l
        };
        Sample {
            l,
            weight: self.weight(l, v, sampler),
            pdf: self.pdf(l, v, sampler),
        }
    }

    #[inline(always)]
    fn direction(&self, v: Vector<R>, u: [R; 2], sampler: Sampler) -> Vector<R> {
        let bounded = sampler == Sampler::BoundedCap && v[2] > lit(0.0);
        match sampler {
            Sampler::Cosine => cosine_direction(u),
            Sampler::Hemisphere => self.visible_direction(v, u),
            _ if bounded => self.cap_direction(v, u, self.cap_rest(v)),
            _ => self.cap_direction(v, u, lit(0.0)),
        }
    }

    /// BRDF (F = 1) times N·L over [`Ggx::pdf`]: what a light drawn for a view counts.
    ///
    /// ```text
    /// w = G₂/G₁(v) = N·L (N·V + sqrt(…)) / (N·L sqrt(…) + N·V sqrt(…))    for visible normals
    /// ```
    ///
    /// - *Source*: Heitz 2018; Eto and Tokuyoshi 2023.
    /// - *Arguments*: `l` and `v` the directions to light and viewer in the tangent frame, of length
    ///   1; `sampler` by which the light was drawn.
    /// - *Value*: 0 to 1 for visible normals, of full accuracy however smooth the surface, since D
    ///   cancels.
    /// - *Outside*: 0 where the light or the view is not above the horizon.
    /// - *Error*: 6.3 ulp in f32, 5.3 in f64; 7.7 and 4.8 on a stretched surface.
    ///
    /// ```
    /// // Of visible normals the weight is what the light sees of what the view sees.
    /// use brdf::{Ggx, Sampler};
    /// let (ggx, l, v) = (Ggx::new(0.3f64), [-0.6, 0.0, 0.8], [0.8, 0.0, 0.6]);
    /// let weight = ggx.weight(l, v, Sampler::SphericalCap);
    /// assert!((weight - brdf::g2_ggx(0.8, 0.6, 0.3) / brdf::g1_ggx(0.6, 0.3)).abs() < 1e-15);
    /// ```
    #[inline(always)]
    pub fn weight(&self, l: impl Into<Vector<R>>, v: impl Into<Vector<R>>, sampler: Sampler) -> R {
        let (l, v) = (l.into(), v.into());
        if l[2] <= lit(0.0) || v[2] <= lit(0.0) {
            zero_unless_nan([l[2], v[2]])
        } else if sampler == Sampler::Cosine {
            self.eval(l, v) * lit(PI)
        } else {
            let value = self.visibility_of(l, v) * l[2] / self.visible_share(v, sampler);
            rescued(value, (l, v), (*self, sampler), |(ggx, sampler), l, v| {
                let ggx = ggx.tamed();
                ggx.visibility_of(l, v) * l[2] / ggx.visible_share(v, sampler)
            })
        }
    }

    /// The direction of a view on the stretched surface, with its sine and 1 − its cosine.
    #[inline(always)]
    fn stretched_view(&self, v: Vector<R>) -> (Vector<R>, R, R) {
        let (x, y) = self.stretched(v);
        let view = normalize([x, y, v[2]]);
        let sin2 = view[0] * view[0] + view[1] * view[1];
        let rest = if view[2] > lit(0.0) {
            sin2 / (lit::<R>(1.0) + view[2])
        } else {
            lit::<R>(1.0) - view[2]
        };
        (view, sin2.sqrt(), rest)
    }

    /// `v` mirrored in the normal that `m` of length `length` becomes when the surface is no
    /// longer stretched: v·m is `cosine`, that of the stretched view to `m`, times the
    /// stretched view's length, without a difference.
    #[inline(always)]
    fn mirrored(&self, v: Vector<R>, m: Vector<R>, cosine: R) -> Vector<R> {
        let m = [self.alpha_x * m[0], self.alpha_y * m[1], m[2]];
        let m2 = dot(m, m);
        let factor = lit::<R>(2.0) * self.projected(v) * cosine / m2;
        let factor = if factor.is_finite() { factor } else { lit(0.0) };
        [0, 1, 2].map(|i| factor * m[i] - v[i])
    }

    /// A light mirrored in a normal that is visible from `v` (Heitz 2018, listing 1).
    ///
    /// On the disc, (a, b) is drawn and b moved to b' = (1 − s) sqrt(1 − a²) + s b. Close to the
    /// rim all of sqrt(1 − a²) ± b, the height above the disc and the normal's own height are
    /// small differences: each is written as a product with 1 − r² = 1 − u₀ instead.
    fn visible_direction(&self, v: Vector<R>, u: [R; 2]) -> Vector<R> {
        let (zero, one, half) = (lit::<R>(0.0), lit::<R>(1.0), lit::<R>(0.5));
        let (view, sin, rest) = self.stretched_view(v);
        let (t1, up) = if sin > zero {
            (
                [-view[1] / sin, view[0] / sin],
                [view[0] / sin, view[1] / sin],
            )
        } else {
            ([one, zero], [zero, -one])
        };
        let (radius, phi) = (u[0].sqrt(), u[1] * lit(2.0 * PI));
        let (cos_phi, sin_phi) = (phi.cos(), phi.sin());
        let (a, b) = (radius * cos_phi, radius * sin_phi);
        let outside = one - u[0];
        let chord = (outside + u[0] * (sin_phi * sin_phi)).sqrt();
        // sqrt(1 − a²) − b and + b, whose product is 1 − u₀.
        let (above, below) = if b > zero {
            (outside / (chord + b), chord + b)
        } else {
            (chord - b, outside / (chord - b).at_least(lit(R::TINY)))
        };
        let (s, s_rest) = (half * (one + view[2]), half * rest);
        let moved = if b > zero {
            s_rest * chord + s * b
        } else {
            s * below - view[2] * chord
        };
        // b' − sqrt(1 − a²) and b' + sqrt(1 − a²).
        let height2 = s * above * (lit::<R>(2.0) * s_rest * chord + s * below);
        let height = height2.at_least(zero).sqrt();
        // The normal's height, moved sin + height cos.
        let z = if moved < zero && view[2] > zero {
            (chord * view[2] - moved) * s * below / (height * view[2] - moved * sin)
        } else {
            moved * sin + height * view[2]
        };
        let z = if z.is_nan() { zero } else { z };
        // The second axis of the disc is up times −cos, and sin along the normal.
        let toward = height * sin - moved * view[2];
        let m = [
            a * t1[0] + toward * up[0],
            a * t1[1] + toward * up[1],
            z.at_least(zero),
        ];
        self.mirrored(v, m, height)
    }

    /// A light from a cap of the stretched sphere around a view (Dupuy and Benyoub 2023, Eto and
    /// Tokuyoshi 2023): z from 1 down to −k z_v, `rest` = 1 − k.
    ///
    /// Near both ends of the cap z, sin and the normal's height z + z_v are differences; they
    /// are written in 1 − z = u₁ (1 + k z_v).
    #[inline(always)]
    fn cap_direction(&self, v: Vector<R>, u: [R; 2], rest: R) -> Vector<R> {
        let one = lit::<R>(1.0);
        let (view, _, view_rest) = self.stretched_view(v);
        let left_out = rest * view[2];
        let depth = one + (view[2] - left_out);
        let (down, up) = (u[1] * depth, (one - u[1]) * depth);
        // 1 − z, and 1 + z = up + 1 − k z_v.
        let sin = (down * (up + (view_rest + left_out)))
            .at_least(lit(0.0))
            .sqrt();
        let phi = u[0] * lit(2.0 * PI);
        let m = [
            view[0] + sin * phi.cos(),
            view[1] + sin * phi.sin(),
            up + left_out,
        ];
        // The sum of two unit vectors has |m|²/2 in common with each.
        self.mirrored(v, m, lit::<R>(0.5) * dot(m, m))
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
