//! Λ, G₁ and V from vectors.

use super::Ggx;
use crate::real::{Real, lit, zero_unless_nan};
use crate::vector::{Vector, rescued};

/// Λ, G₁ and V: what is hidden, and what is seen.
impl<R: Real> Ggx<R> {
    /// Λ of a direction, see [`lambda_ggx`](crate::lambda_ggx).
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

    /// G₁ of a direction, see [`g1_ggx`](crate::g1_ggx).
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

    /// Height-correlated visibility, see [`v_ggx`](crate::v_ggx).
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
    ///
    /// ```
    /// // As from cosines, where there are no two widths.
    /// let (ggx, l, v) = (brdf::Ggx::new(0.16f64), [0.6, 0.0, 0.8], [0.0, 0.8, 0.6]);
    /// assert!((ggx.visibility(l, v) - brdf::v_ggx(0.8, 0.6, 0.16)).abs() < 1e-15);
    /// ```
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
    /// Half of what V is the inverse of, for directions above the horizon.
    #[inline(always)]
    pub(super) fn facing(&self, l: Vector<R>, v: Vector<R>) -> R {
        l[2] * self.projected(v) + v[2] * self.projected(l)
    }
}
