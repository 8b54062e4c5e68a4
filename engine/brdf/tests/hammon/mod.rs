//! Hammon's simulation of 2017 as its slides print it, for comparison with the right one.
//!
//! His slides let a ray that hits draw its facet from D alone among those that face it. What a
//! ray meets is D weighted by |T·m|, the visible normals: [`brdf::walk::walk`] draws those.
//! Everything else here is the same walk, written plainly.

#[path = "../numbers/mod.rs"]
mod numbers;

pub use numbers::Numbers;

use brdf::{albedo_ggx, diffuse_hammon, f_schlick, lambda_ggx};
use std::f64::consts::{PI, TAU};

/// His F0, of water.
pub const F0: f64 = 0.02;

/// A view at a cosine.
pub fn view(cos: f64) -> [f64; 3] {
    [((1.0 - cos) * (1.0 + cos)).sqrt(), 0.0, cos]
}

/// Views that stand for equal shares of cosine-weighted light.
pub fn views(count: u32) -> impl Iterator<Item = f64> {
    (0..count).map(move |i| ((f64::from(i) + 0.5) / f64::from(count)).sqrt())
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// A walk over coated facets with the normals of the slides: how often it was mirrored and how
/// often let in, and where it left to.
pub fn walk_of_the_slides(
    alpha: f64,
    f0: f64,
    v: [f64; 3],
    numbers: &mut Numbers,
) -> (u32, u32, [f64; 3]) {
    let (mut from, mut depth, mut mirrored, mut inside) = (v, 0.0, 0, 0);
    loop {
        let e = -numbers.unit().ln();
        if from[2] < 0.0 {
            depth -= e / lambda_ggx(-from[2], alpha);
            if depth <= 0.0 {
                return (mirrored, inside, from.map(|x| -x));
            }
        } else {
            depth += e / (1.0 + lambda_ggx(from[2], alpha));
        }
        let m = loop {
            let u = numbers.unit();
            let (sin, cos) = (alpha * (u / (1.0 - u)).sqrt()).atan().sin_cos();
            let phi = TAU * numbers.unit();
            let m = [sin * phi.cos(), sin * phi.sin(), cos];
            if dot(m, from) > 0.0 {
                break m;
            }
        };
        let l = if numbers.unit() < f_schlick(f0, dot(m, from)) {
            mirrored += 1;
            let twice = 2.0 * dot(m, from);
            [0, 1, 2].map(|i| twice * m[i] - from[i])
        } else {
            inside += 1;
            loop {
                let (z, phi) = (1.0 - 2.0 * numbers.unit(), TAU * numbers.unit());
                let sin = ((1.0 - z) * (1.0 + z)).sqrt();
                let l = [m[0] + sin * phi.cos(), m[1] + sin * phi.sin(), m[2] + z];
                let length = dot(l, l).sqrt();
                let l = l.map(|x| x / length);
                if numbers.unit() >= (1.0 - dot(l, m)).powi(5) {
                    break l;
                }
            }
        };
        from = l.map(|x| -x);
    }
}

/// Share of the light that leaves after one bounce, after no more than mirrors, and after being
/// let in once and more often, by the walk of the slides.
pub fn split_of_the_slides(alpha: f64, v: [f64; 3], walks: u32, numbers: &mut Numbers) -> [f64; 3] {
    let mut counts = [0u32; 3];
    for _ in 0..walks {
        let (_, inside, _) = walk_of_the_slides(alpha, F0, v, numbers);
        counts[inside.min(2) as usize] += 1;
    }
    counts.map(|count| f64::from(count) / f64::from(walks))
}

/// What the published fit returns of its *single* and its *multi* for a view: albedos, the
/// second over the square of the facets' albedo.
pub fn fit(cos: f64, alpha: f64) -> [f64; 2] {
    const COUNT: u32 = 96;
    let v = view(cos);
    // The fit is albedo (single + albedo multi): two albedos tell the two apart.
    let mut sums = [0.0; 2];
    for l_z in views(COUNT) {
        for j in 0..COUNT {
            let phi = PI * (f64::from(j) + 0.5) / f64::from(COUNT);
            let l_dot_v = view(l_z)[0] * phi.cos() * v[0] + l_z * v[2];
            let of = |albedo: f64| diffuse_hammon(l_z, cos, l_dot_v, alpha, albedo) / albedo;
            let (half, full) = (of(0.5), of(1.0));
            sums[0] += 2.0 * half - full;
            sums[1] += 2.0 * (full - half);
        }
    }
    sums.map(|sum| sum * PI / f64::from(COUNT * COUNT))
}

/// Share of the light that single scattering between mirrors loses, by quadrature.
pub fn lost(cos: f64, alpha: f64) -> f64 {
    1.0 - albedo_ggx(cos, alpha)
}
