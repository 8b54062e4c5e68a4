//! Directional albedos by a quadrature over the disc of slopes.

use super::rule::Rule;
use crate::real::{Real, lit, zero_unless_nan};
use crate::smith::sine;
use crate::term::{ALPHA, N_DOT_V, Term, entry};
use std::f64::consts::PI;

/// ∫ D V N·L dω with `visibility` for V as a function of N·L, over the directions l above
/// the horizon.
///
/// Integrated over the slopes (p, q) of h, p towards v, where D cos θ dω is the slope density
/// P₂₂ dp dq and dω_l = 4 V·H dω_h. There the region with l above the horizon is exactly the
/// disc with centre tan θ and radius sec θ, and N·L is μ (the power of the point in that
/// disc)/(1 + p² + q²), which does not cancel at its rim.
fn directional<R: Real>(mu: R, alpha: R, rule: &Rule, visibility: impl Fn(R) -> R) -> R {
    if mu < lit(0.1) && mu < lit::<R>(rule.seam) * alpha {
        directional_grazing(mu, alpha, rule, visibility)
    } else {
        directional_polar(mu, alpha, rule, visibility)
    }
}

/// Polar around the slope 0: r = α tan ψ up to the rim, ψ = 2 atan t, t = t_max y (2 − y).
fn directional_polar<R: Real>(mu: R, alpha: R, rule: &Rule, visibility: impl Fn(R) -> R) -> R {
    let (one, two) = (lit::<R>(1.0), lit::<R>(2.0));
    let sin = sine(mu);
    let mut sum = lit::<R>(0.0);
    for &cos_phi in &rule.cosines {
        let cos_phi = lit::<R>(cos_phi);
        let x = sin / mu * cos_phi;
        let root = (one + x * x).sqrt();
        // r² − 2 x r − 1 = (r − reach)(r + 1/reach).
        let reach = if x < lit(0.0) {
            one / (root - x)
        } else {
            root + x
        };
        let t_max = reach / (alpha + alpha.hypot(reach));
        for &(y, weight) in &rule.radial {
            let (y, weight) = (lit::<R>(y), lit::<R>(weight));
            let t = t_max * y * (two - y);
            let sec = one / (one + t * t);
            let (sin_psi, cos_psi) = (two * t * sec, (one - t) * (one + t) * sec);
            let r = alpha * sin_psi / cos_psi;
            let n_dot_l = mu * (reach - r) * (r + one / reach) / (one + r * r);
            let density = sin_psi * cos_psi * sec * (one - y) * t_max * weight;
            sum = sum + density * (mu + sin * r * cos_phi) * visibility(n_dot_l) * n_dot_l;
        }
    }
    // 4 for V·H, 2 each for t(y) and ψ(t); a half turn's midpoints stand for 2π over π.
    sum * lit(32.0 / rule.cosines.len() as f64)
}

/// Cartesian for grazing views, where the rim almost touches the slope 0: p = A tan²ζ from the
/// rim, q = sqrt(α² + p²) tan η, both half-angle tangents, so that the rim is smooth.
fn directional_grazing<R: Real>(mu: R, alpha: R, rule: &Rule, visibility: impl Fn(R) -> R) -> R {
    let (one, two) = (lit::<R>(1.0), lit::<R>(2.0));
    let sin = sine(mu);
    let near = mu / (one + sin);
    let far = (one + sin) / mu;
    let scale = near.hypot(alpha);
    // tan ζ at the far rim, and its half-angle tangent.
    let w_max = ((near + far) / scale).sqrt();
    let s_max = w_max / (one + one.hypot(w_max));
    let mut sum = lit::<R>(0.0);
    for &(x, x_weight) in &rule.radial {
        let (x, x_weight) = (lit::<R>(x), lit::<R>(x_weight));
        let s = s_max * x * (two - x);
        let cos_sec = one / ((one - s) * (one + s));
        let w = two * s * cos_sec;
        let from_rim = scale * w * w;
        let p = from_rim - near;
        let dp = two
            * scale
            * w
            * (two * (one + s * s) * cos_sec * cos_sec)
            * s_max
            * two
            * (one - x)
            * x_weight;
        let b = alpha.hypot(p);
        let q_max = (from_rim * (far - p).at_least(lit(0.0))).sqrt();
        let t_max = q_max / (b + b.hypot(q_max));
        let mut inner = lit::<R>(0.0);
        for &(y, y_weight) in &rule.radial {
            let (y, y_weight) = (lit::<R>(y), lit::<R>(y_weight));
            let t = t_max * y;
            let sec = one / (one + t * t);
            let cos_eta = (one - t) * (one + t) * sec;
            let q = b * (two * t * sec) / cos_eta;
            let n_dot_l = mu * (q_max - q) * (q_max + q) / (one + p * p + q * q);
            inner = inner + cos_eta * cos_eta * sec * y_weight * visibility(n_dot_l) * n_dot_l;
        }
        let ratio = alpha / b;
        sum = sum + dp * (ratio * ratio / b) * t_max * (mu + sin * p) * inner;
    }
    // 4 for V·H, 2 for the sign of q, 2 for η(t), over π.
    sum * lit(16.0 / PI)
}

/// A view in front of a surface: what the visibilities below have in common.
#[derive(Clone, Copy)]
struct View<R> {
    mu: R,
    alpha2: R,
    /// sqrt(μ² + α² (1 − μ²)).
    projected: R,
}

impl<R: Real> View<R> {
    /// sqrt(c² + α² (1 − c²)); no underflow, as α is at least 1e-9 here.
    #[inline(always)]
    fn project(self, c: R) -> R {
        (c * c + self.alpha2 * ((lit::<R>(1.0) - c) * (lit::<R>(1.0) + c))).sqrt()
    }

    /// [`v_ggx`](crate::v_ggx) of this view.
    #[inline(always)]
    fn correlated(self, n_dot_l: R) -> R {
        lit::<R>(0.5) / (n_dot_l * self.projected + self.mu * self.project(n_dot_l))
    }

    /// [`v_ggx_separable`](crate::v_ggx_separable) of this view.
    #[inline(always)]
    fn separable(self, n_dot_l: R) -> R {
        lit::<R>(1.0) / ((n_dot_l + self.project(n_dot_l)) * (self.mu + self.projected))
    }
}

/// Arguments of an albedo brought into their range, and the rule for the precision.
#[inline(always)]
fn albedo<R: Real>(n_dot_v: R, alpha: R, visibility: impl Fn(View<R>, R) -> R) -> R {
    if n_dot_v.is_nan() || alpha.is_nan() {
        return zero_unless_nan([n_dot_v, alpha]);
    }
    let mu = n_dot_v.at_least(lit(1e-9)).at_most(lit(1.0));
    let alpha = alpha.abs().at_least(lit(1e-9)).at_most(lit(1e6));
    let rule = Rule::of::<R>();
    let mut view = View {
        mu,
        alpha2: alpha * alpha,
        projected: mu,
    };
    view.projected = view.project(mu);
    directional(mu, alpha, rule, |n_dot_l| visibility(view, n_dot_l))
}

/// Directional albedo of GGX with F = 1 and the height-correlated G₂.
///
/// ```text
/// E(μ) = ∫ D V N·L dω,    E(μ) = 1 − μ ln(1 + 1/μ) at α = 1
/// ```
///
/// - *Source*: quadrature over the disc of slopes.
/// - *Arguments*: `n_dot_v` N·V in [0, 1]; `alpha` α = roughness² in [0, 1].
/// - *Value*: 0.307 (α = 1, seen straight on) to 1 (a mirror).
/// - *Outside*: a view at or below 0 gives the limit at grazing; α = 0 is a mirror.
/// - *Error*: 5.8e-6 in f32 (48 ulp of 1), where N·V is about 1.4 α, and small; 2.6e-9 in f64, where it is
///   4.3 α; 1e-12 in f64 at α = 1. The truth is another quadrature, of another integrand.
///
/// About 10 µs. For a table of it see [`AlbedoTable`](crate::AlbedoTable), for fits [`albedo_fits`](crate::albedo_fits).
///
/// ```
/// let mu: f64 = 0.3;
/// assert!((brdf::albedo_ggx(mu, 1.0) - (1.0 - mu * (1.0 + 1.0 / mu).ln())).abs() < 1e-12);
/// assert!((brdf::albedo_ggx(0.5f64, 0.16) - 0.926437508815).abs() < 1e-11);
/// ```
pub fn albedo_ggx<R: Real>(n_dot_v: R, alpha: R) -> R {
    albedo(n_dot_v, alpha, View::correlated)
}

pub(super) const ALBEDO_GGX: Term = entry!(
    albedo_ggx(n_dot_v: N_DOT_V, alpha: ALPHA),
    symbol: "E_GGX", latex: r"E_{\mathrm{GGX}}", cost: 100_000,
    doc: "directional albedo of GGX with F = 1, height-correlated Smith, 0 to 1",
    source: "quadrature over the disc of slopes",
    wgsl: None
);

/// Directional albedo of GGX with F = 1 and the separable G₂.
///
/// ```text
/// E(μ) = ∫ D G₁(l) G₁(v)/(4 N·L N·V) N·L dω
/// ```
///
/// - *Source*: quadrature over the disc of slopes.
/// - *Arguments*: `n_dot_v` N·V in [0, 1]; `alpha` α = roughness² in [0, 1].
/// - *Value*: never above [`albedo_ggx`].
/// - *Outside*: a view at or below 0 gives the limit at grazing; α = 0 is a mirror.
/// - *Error*: 6.2e-6 in f32 (52 ulp of 1), 2.9e-9 in f64.
///
/// ```
/// // The model that shadows too much loses more.
/// let (n_dot_v, alpha) = (0.05f64, 0.5);
/// assert!((brdf::albedo_ggx(n_dot_v, alpha) - 0.91254780).abs() < 1e-8);
/// assert!((brdf::albedo_ggx_separable(n_dot_v, alpha) - 0.79227645).abs() < 1e-8);
/// ```
pub fn albedo_ggx_separable<R: Real>(n_dot_v: R, alpha: R) -> R {
    albedo(n_dot_v, alpha, View::separable)
}

pub(super) const ALBEDO_GGX_SEPARABLE: Term = entry!(
    albedo_ggx_separable(n_dot_v: N_DOT_V, alpha: ALPHA),
    symbol: "E_separable", latex: r"E_{\mathrm{separable}}", cost: 100_000,
    doc: "directional albedo of GGX with F = 1, separable Smith, 0 to 1",
    source: "quadrature over the disc of slopes",
    wgsl: None
);

/// Directional albedo of the mistake that divides by 4 N·L N·V twice.
///
/// ```text
/// E(μ) = ∫ D V/(4 N·L N·V) N·L dω
/// ```
///
/// - *Source*: quadrature over the disc of slopes.
/// - *Arguments*: `n_dot_v` N·V in [0, 1]; `alpha` α = roughness² in [0, 1].
/// - *Value*: too dark when seen straight on, and far above 1 at grazing angles.
/// - *Outside*: a view at or below 0 gives the limit at grazing; α = 0 is a mirror.
/// - *Error*: 1.9e-5 of the value in f32, 4.4e-8 in f64.
///
/// ```
/// // Straight on three quarters are missing, and at the rim the surface shines by itself.
/// assert!((brdf::albedo_ggx_divided_twice(1.0f64, 0.16) - 0.30201515).abs() < 1e-8);
/// assert!(brdf::albedo_ggx_divided_twice(0.05f64, 0.16) > 18.0);
/// ```
pub fn albedo_ggx_divided_twice<R: Real>(n_dot_v: R, alpha: R) -> R {
    albedo(n_dot_v, alpha, |view, n_dot_l| {
        view.correlated(n_dot_l) / (lit::<R>(4.0) * n_dot_l * view.mu)
    })
}

pub(super) const ALBEDO_GGX_DIVIDED_TWICE: Term = entry!(
    albedo_ggx_divided_twice(n_dot_v: N_DOT_V, alpha: ALPHA),
    symbol: "E_twice", latex: r"E_{\mathrm{twice}}", cost: 100_000,
    doc: "directional albedo of GGX when the visibility is divided by 4 N·L N·V a second time",
    source: "quadrature over the disc of slopes",
    wgsl: None
);
