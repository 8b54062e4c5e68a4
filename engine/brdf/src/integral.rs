//! Integrals over the hemisphere, and figures that follow from them.
//!
//! | symbol | function | how |
//! |---|---|---|
//! | ∫ D dω | [`integral_d_ggx`] | closed form, 1 to 2 |
//! | ∫ D cos θ dω | [`integral_d_cos_ggx`] | 1 |
//! | ∫ D G₁ v·m dm / N·V | [`integral_g1_d_ggx`] | quadrature; the weak furnace: 1 |
//! | E(μ) | [`albedo_ggx`], [`albedo_ggx_separable`], [`albedo_ggx_divided_twice`] | quadrature |
//! | share of a disc | [`share_ratio_above`] | closed form |
//!
//! E(μ) is the directional albedo with F = 1: what of the light from one direction leaves again after a
//! single mirror. What is missing from 1 was mirrored down and lost; [`energy`](crate::energy) puts it back.

use crate::real::{Real, lit, zero_unless_nan};
use crate::smith::sine;
use crate::term::{ALPHA, N_DOT_V, Param, Term, entry};
use std::f64::consts::PI;
use std::sync::LazyLock;

pub(crate) const TERMS: &[Term] = &[
    INTEGRAL_D_GGX,
    INTEGRAL_D_COS_GGX,
    INTEGRAL_G1_D_GGX,
    ALBEDO_GGX,
    ALBEDO_GGX_SEPARABLE,
    ALBEDO_GGX_DIVIDED_TWICE,
    SHARE_RATIO_ABOVE,
];

/// ∫ D dω of GGX: the area of all facets over that of the surface.
///
/// ```text
/// ∫ D dω = 1 + α² atanh(s)/s,    s = sqrt(1 − α²)
/// ```
///
/// - *Source*: closed form, from Walter et al. 2007, eq. 33.
/// - *Arguments*: `alpha` α = roughness² in [0, 1].
/// - *Value*: 1 (α = 0) to 2 (α = 1), and on for α > 1 with atan in place of atanh. It is not 1:
///   only ∫ D cos θ is.
/// - *Outside*: the sign of α is ignored.
/// - *Error*: 2.3 ulp in f32, 2.1 in f64.
///
/// ```
/// assert_eq!(brdf::integral_d_ggx(1.0), 2.0); // the roughest surface has twice the area
/// assert!((brdf::integral_d_ggx(0.16f64) - 1.06533492660).abs() < 1e-11);
/// ```
pub fn integral_d_ggx<R: Real>(alpha: R) -> R {
    let one = lit::<R>(1.0);
    let a = alpha.abs().bounded();
    if a == lit(0.0) {
        return one;
    }
    let s2 = (one - a) * (one + a);
    let s = (one - a).abs().sqrt() * (one + a).sqrt();
    let ratio = if s2 > lit(0.75) {
        ((one + s) / a).ln() / s
    } else if s2 > lit(0.0) {
        lit::<R>(0.5) * (lit::<R>(2.0) * s / (one - s)).ln_1p() / s
    } else if s2 < lit(0.0) {
        s.atan() / s
    } else {
        one + s
    };
    one + a * (a * ratio)
}

const INTEGRAL_D_GGX: Term = entry!(
    integral_d_ggx(alpha: ALPHA),
    symbol: "∫D", latex: r"\int D", cost: 40,
    doc: "integral of the GGX distribution over the hemisphere: facet area per surface area, 1 to 2",
    source: "closed form, from Walter et al. 2007, eq. 33",
    wgsl: Some("fn lobe_integral_d_ggx(alpha: f32) -> f32 {
    let s2 = (1.0 - alpha) * (1.0 + alpha);
    if (alpha <= 0.0) { return 1.0; }
    if (s2 < 0.001) { return 1.0 + alpha * alpha * (1.0 + s2 / 3.0); }
    let s = sqrt(s2);
    return 1.0 + alpha * alpha * log((1.0 + s) / alpha) / s;
}")
);

/// ∫ D cos θ dω of GGX: what normalises D.
///
/// ```text
/// ∫ D cos θ dω = 1
/// ```
///
/// - *Source*: Walter et al. 2007, eq. 33.
/// - *Arguments*: `alpha` α = roughness² in [0, 1].
/// - *Value*: 1 for every α.
/// - *Outside*: 1, too.
/// - *Error*: none.
pub fn integral_d_cos_ggx<R: Real>(alpha: R) -> R {
    if alpha.is_nan() { alpha } else { lit(1.0) }
}

const INTEGRAL_D_COS_GGX: Term = entry!(
    integral_d_cos_ggx(alpha: ALPHA),
    symbol: "∫D cos θ", latex: r"\int D \cos\theta", cost: 1,
    doc: "integral of the GGX distribution times the cosine: 1, which is its normalisation",
    source: "Walter et al. 2007, eq. 33",
    wgsl: Some("fn lobe_integral_d_cos_ggx(alpha: f32) -> f32 {
    return 1.0;
}")
);

/// The weak white furnace: visible facets over the surface they cover, by quadrature of D and G₁.
///
/// ```text
/// ∫ D G₁(v) max(v·m, 0) dm / N·V = 1
/// ```
///
/// - *Source*: Heitz 2014, the weak white furnace test.
/// - *Arguments*: `n_dot_v` N·V in [0, 1]; `alpha` α = roughness² in [0, 1].
/// - *Value*: 1 for every view, within 1e-7: in any direction the visible facets cover exactly the
///   surface. This is what fixes G₁ once D is chosen, and what a wrong pairing of the two breaks.
/// - *Outside*: below N·V = 0.001 that view is taken.
/// - *Error*: for N·V and α from 0.1 up 5.1e-6 in f32, 1.9e-14 in f64.
///
/// Over the slopes (p, q) with p = r cos φ, where v·m > 0 is the half plane r cos φ tan θ > −1. D
/// is evaluated at a cosine, which below α = 1e-4 no longer carries it.
pub fn integral_g1_d_ggx<R: Real>(n_dot_v: R, alpha: R) -> R {
    if n_dot_v.is_nan() || alpha.is_nan() {
        return zero_unless_nan([n_dot_v, alpha]);
    }
    let (zero, one, two) = (lit::<R>(0.0), lit::<R>(1.0), lit::<R>(2.0));
    let mu = n_dot_v.at_least(lit(1e-3)).at_most(one);
    let alpha = alpha.abs().at_least(lit(1e-6)).at_most(lit(1e6));
    let rule: &Rule = if R::EPSILON < 1e-10 { &FINE } else { &COARSE };
    let sin = sine(mu);
    let mut sum = zero;
    for &cos_phi in &rule.cosines {
        let cos_phi = lit::<R>(cos_phi);
        // tan ψ up to the edge of the half plane, r = α tan ψ.
        let toward = alpha * sin * cos_phi;
        let t_max = if toward < zero {
            // The half-angle tangent of atan(μ/−toward).
            mu / (-toward + toward.hypot(mu))
        } else {
            one
        };
        for &(y, weight) in &rule.radial {
            let (y, weight) = (lit::<R>(y), lit::<R>(weight));
            let t = t_max * y;
            let sec = one / (one + t * t);
            let (sin_psi, cos_psi) = (two * t * sec, (one - t) * (one + t) * sec);
            let r = alpha * sin_psi / cos_psi;
            let cos_m = one / one.hypot(r);
            // dm = cos³ dp dq, and dp dq = r dr dφ with dr = α/cos²ψ dψ, dψ = 2 sec dt.
            let area = cos_m * cos_m * cos_m * (r * alpha / (cos_psi * cos_psi)) * two * sec;
            let v_dot_m = (mu + sin * r * cos_phi) * cos_m;
            sum = sum + weight * t_max * area * v_dot_m * crate::d::d_ggx(cos_m, alpha);
        }
    }
    let turn = lit(2.0 * PI / rule.cosines.len() as f64);
    crate::smith::g1_ggx(mu, alpha) / mu * sum * turn
}

const INTEGRAL_G1_D_GGX: Term = entry!(
    integral_g1_d_ggx(n_dot_v: N_DOT_V, alpha: ALPHA),
    symbol: "∫D G₁ v·m", latex: r"\int D G_1 (v \cdot m)", cost: 1_000_000,
    doc: "visible facet area over the surface's own, by quadrature of D and G1 of GGX: 1 for every view",
    source: "Heitz 2014, the weak white furnace test",
    wgsl: None
);

/// Gauss-Legendre nodes and weights on [0, 1].
fn gauss_legendre(n: usize) -> Vec<(f64, f64)> {
    let node = |i: usize| {
        let mut x = libm::cos(PI * (i as f64 + 0.75) / (n as f64 + 0.5));
        let mut derivative = 1.0;
        // Newton's method on the Legendre polynomial; five steps from here are enough.
        for _ in 0..8 {
            let (mut p, mut q) = (1.0, 0.0);
            for k in 0..n {
                let k = k as f64;
                (p, q) = (((2.0 * k + 1.0) * x * p - k * q) / (k + 1.0), p);
            }
            derivative = n as f64 * (x * p - q) / (x * x - 1.0);
            x -= p / derivative;
        }
        (
            0.5 - 0.5 * x,
            1.0 / ((1.0 - x * x) * derivative * derivative),
        )
    };
    (0..n).map(node).collect()
}

/// The nodes of a quadrature over the slopes.
struct Rule {
    /// Nodes and weights on [0, 1].
    radial: Vec<(f64, f64)>,
    /// cos φ of the midpoints of half a turn.
    cosines: Vec<f64>,
}

impl Rule {
    fn new(n: usize) -> Rule {
        let cosines = (0..n)
            .map(|i| libm::cos(PI * (i as f64 + 0.5) / n as f64))
            .collect();
        Rule {
            radial: gauss_legendre(n),
            cosines,
        }
    }
}

static COARSE: LazyLock<Rule> = LazyLock::new(|| Rule::new(32));
static FINE: LazyLock<Rule> = LazyLock::new(|| Rule::new(128));

static AVERAGE: LazyLock<Vec<(f64, f64)>> = LazyLock::new(|| gauss_legendre(24));

/// Nodes and weights of an average over the views.
pub(crate) fn average_nodes() -> &'static [(f64, f64)] {
    &AVERAGE
}

/// ∫ D V N·L dω with `visibility` for V as a function of N·L, over the directions l above
/// the horizon.
///
/// Integrated over the slopes (p, q) of h, p towards v, where D cos θ dω is the slope density
/// P₂₂ dp dq and dω_l = 4 V·H dω_h. There the region with l above the horizon is exactly the
/// disc with centre tan θ and radius sec θ, and N·L is μ (the power of the point in that
/// disc)/(1 + p² + q²), which does not cancel at its rim.
fn directional<R: Real>(mu: R, alpha: R, rule: &Rule, visibility: impl Fn(R) -> R) -> R {
    if mu < lit(0.1) && mu < lit::<R>(1.22) * alpha {
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
    let rule: &Rule = if R::EPSILON < 1e-10 { &FINE } else { &COARSE };
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
/// - *Error*: 7.3e-6 in f32 (61 ulp of 1), 1.0e-7 in f64, both where N·V is about 1.25 α, and small;
///   1e-12 in f64 at α = 1. The truth is another quadrature, of another integrand.
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

const ALBEDO_GGX: Term = entry!(
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
/// - *Error*: 7.8e-6 in f32 (65 ulp of 1), 1.1e-7 in f64.
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

const ALBEDO_GGX_SEPARABLE: Term = entry!(
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
/// - *Error*: 1.9e-5 of the value in f32, 2.8e-7 in f64.
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

const ALBEDO_GGX_DIVIDED_TWICE: Term = entry!(
    albedo_ggx_divided_twice(n_dot_v: N_DOT_V, alpha: ALPHA),
    symbol: "E_twice", latex: r"E_{\mathrm{twice}}", cost: 100_000,
    doc: "directional albedo of GGX when the visibility is divided by 4 N·L N·V a second time",
    source: "quadrature over the disc of slopes",
    wgsl: None
);

/// Share of the lit, visible disc of a sphere where a second division by 4 N·L N·V changes the
/// value by more than `ratio`.
///
/// ```text
/// share = min(1, 1/(4 ratio cos²(β/2)))
/// ```
///
/// - *Source*: closed form: on that part of the disc N·L N·V is distributed uniformly in image
///   area between 0 and cos²(β/2).
/// - *Arguments*: `ratio` > 0; `light_deg` β in degrees, 0 to 180.
/// - *Value*: 0 to 1, for a distant light and an orthographic view.
/// - *Outside*: `ratio` ≤ 0 gives 1.
/// - *Error*: 5.9 ulp in f32, 5.3 in f64.
///
/// ```
/// // With the light behind the eye a quarter of the ball is too bright, and the rest too dark.
/// assert_eq!(brdf::share_ratio_above(1.0, 0.0), 0.25);
/// // With the light at the side half of what is lit.
/// assert!((brdf::share_ratio_above(1.0f64, 90.0) - 0.5).abs() < 1e-15);
/// ```
pub fn share_ratio_above<R: Real>(ratio: R, light_deg: R) -> R {
    if ratio <= lit(0.0) {
        return lit(1.0);
    }
    // The cosine of half the angle; close to 180° the sine of what is missing keeps its digits.
    let half = lit::<R>(PI / 360.0);
    let light_deg = light_deg.bounded();
    let c = if light_deg > lit(90.0) {
        ((lit::<R>(180.0) - light_deg) * half).sin()
    } else {
        (light_deg * half).cos()
    };
    (lit::<R>(0.25) / (ratio * (c * c))).at_most(lit(1.0))
}

const RATIO: Param = Param {
    name: "ratio",
    range: (0.25, 10.0),
    unit: "1",
    meaning: "factor by which a second division changes the value",
};
const LIGHT_DEG: Param = Param {
    name: "light_deg",
    range: (0.0, 150.0),
    unit: "deg",
    meaning: "angle between the light and the view",
};

const SHARE_RATIO_ABOVE: Term = entry!(
    share_ratio_above(ratio: RATIO, light_deg: LIGHT_DEG),
    symbol: "share", latex: r"\mathrm{share}", cost: 20,
    doc: "share of the lit, visible disc of a sphere where 1/(4 N·L N·V) exceeds a ratio",
    source: "closed form: N·L N·V is uniform in image area on (0, cos²(light/2))",
    wgsl: Some("fn lobe_share_ratio_above(ratio: f32, light_deg: f32) -> f32 {
    if (ratio <= 0.0) { return 1.0; }
    let c = cos(light_deg * 0.0087266462599716479);
    return min(0.25 / (ratio * c * c), 1.0);
}")
);
