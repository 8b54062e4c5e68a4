//! The surface that all else here is a function of.

use crate::real::{Real, lit};
use crate::vector::Vector;

/// A GGX surface: how wide its normals are spread along the tangent and along the bitangent.
///
/// ```
/// use brdf::Ggx;
/// let brushed = Ggx { alpha_x: 0.4f64, alpha_y: 0.05 };
/// let up = [0.0, 0.0, 1.0];
/// // At the normal D is 1/(π α_x α_y), and nothing is masked.
/// assert!((brushed.d(up) * std::f64::consts::PI * 0.4 * 0.05 - 1.0).abs() < 1e-14);
/// assert_eq!(brushed.g1(up), 1.0);
/// // Of the same tilt there are more facets along the wide axis.
/// assert!(brushed.d([0.3, 0.0, 1.0]) > brushed.d([0.0, 0.3, 1.0]));
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ggx<R> {
    /// α along the tangent, in (0, 1]. Where both widths are α, half of the surface has a slope below α.
    /// Only the square counts; 0 is a mirror along that axis.
    pub alpha_x: R,
    /// α along the bitangent, likewise.
    pub alpha_y: R,
}

/// The surface itself.
impl<R: Real> Ggx<R> {
    /// The same width in all directions.
    ///
    /// - *Arguments*: `alpha` α = roughness² in (0, 1].
    /// - *Outside*: only α² counts; 0 is a mirror; above 1 the formulas hold, but no material is meant.
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
    /// It is what all of Smith's functions are made of: Λ = (projected − z)/(2 z).
    ///
    /// - *Source*: the root of Heitz 2014, eq. 86, times z.
    /// - *Arguments*: `v` a direction of length 1.
    /// - *Value*: from |z| of a mirror to 1 where both widths are 1.
    /// - *Outside*: the same below the horizon as above it; in proportion to the length of `v`; +∞ where
    ///   a square overflows, 0 where all of them vanish.
    #[inline(always)]
    pub fn projected(&self, v: impl Into<Vector<R>>) -> R {
        let v = v.into();
        let (x, y) = self.stretched(v);
        (v[2] * v[2] + (x * x + y * y)).sqrt()
    }
}
