//! A whole lobe: D, V and F together.

use super::distribution::half_squared;
use super::eval::below_horizon;
use super::half_angle::half_angle;
use super::{Fresnel, Ggx};
use crate::real::{Real, lit};
use crate::sampling::{Sample, Sampler};
use crate::vector::{Vector, rescued};

/// A whole specular lobe: a GGX surface whose facets are mirrors of some material.
///
/// ```
/// use brdf::{Fresnel, Ggx, Specular};
/// let plastic = Specular { ggx: Ggx::new(0.16f64), fresnel: Fresnel::Dielectric { eta: 1.5 } };
/// let (l, v) = ([0.6, 0.0, 0.8], [-0.6, 0.0, 0.8]);
/// let [red, ..] = plastic.eval_cos(l, v);
/// // D V F N·L, all of it at N·H = 1 and V·H = 0.8.
/// let (d, v, f) = (brdf::d_ggx(1.0, 0.16), brdf::v_ggx(0.8, 0.8, 0.16), brdf::f_dielectric(1.5, 0.8));
/// assert!((red - d * v * f * 0.8).abs() < 1e-13);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Specular<R> {
    /// How the facets lie: D and V.
    pub ggx: Ggx<R>,
    /// What they are made of: F.
    pub fresnel: Fresnel<R>,
}

impl<R: Real> Specular<R> {
    /// BRDF times N·L: the radiance that a distant light of irradiance 1, across its direction, has in the
    /// view.
    ///
    /// ```text
    /// f cos θ = D V F N·L
    /// ```
    ///
    /// - *Source*: Walter et al. 2007, eq. 20; Heitz 2014, eq. 99.
    /// - *Arguments*: `l` and `v` the directions to light and viewer in the tangent frame, of length
    ///   1.
    /// - *Value*: 1/sr, red, green and blue, each 0 to +∞. Over N·L it is reciprocal.
    /// - *Outside*: 0 where the light or the view is below the horizon.
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
    /// - *Source*: as [`Ggx::sample`], with the weight times [`Fresnel::eval`].
    /// - *Arguments*: `v` the view in the tangent frame, of length 1; `u` two numbers in [0, 1);
    ///   `sampler` in which of four ways.
    /// - *Value*: the light as drawn for F = 1, and its weight in red, green and blue. The mean of the
    ///   weights over many `u` is the directional albedo in that colour.
    /// - *Outside*: as [`Ggx::sample`].
    /// - *Error*: of the direction and its density that of [`Ggx::sample`]; to its weight's, that of
    ///   [`Fresnel::eval`] is added.
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
