//! A whole lobe: D, V and F together.

use super::distribution::half_squared;
use super::eval::below_horizon;
use super::half_angle::half_angle;
use super::{Fresnel, Ggx};
use crate::real::{Real, lit};
use crate::sampling::{Sample, Sampler};
use crate::vector::{Vector, rescued};

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
