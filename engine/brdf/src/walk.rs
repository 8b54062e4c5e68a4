//! Random walks on the microsurface: what the closed forms approximate.
//!
//! | item | what |
//! |---|---|
//! | [`walk()`] | one ray between mirrors, diffuse or coated facets |
//! | [`walk_mirrors`] | many rays between mirrors, from one view |
//! | [`Split`] | where the light of one view goes: mirrored, once inside, more often |
//!
//! A ray that enters from `v` moves between the facets of Smith's surface until it leaves. Smith's surface
//! has no memory, so that one number is enough for where the ray is: the optical depth x = −ln C₁(h) under
//! the top, C₁ the share of the surface below the height h.
//!
//! ```text
//! e  from the exponential distribution
//! up, along w:    x ← x − e/Λ(w),            out where x ≤ 0
//! down, along w:  x ← x + e/(1 + Λ(−w))
//! at each hit:    a normal of those visible against the ray, density ∝ D(m) max(−w·m, 0)
//! ```
//!
//! No height distribution is needed: it cancels. With mirrors all light leaves again; its share after one
//! hit is [`albedo_ggx`](crate::albedo_ggx).
//!
//! Heitz, Hanika, d'Eon and Dachsbacher 2016; Hammon 2017, appendix, whose slides draw the normal from D
//! alone: that is not the distribution of what a ray meets. `tests/hammon.rs` holds what follows: with
//! visible normals light takes the same way back and single scattering is ∫ D G₂, with those of the
//! slides neither.
//!
//! ```
//! use brdf::{Ggx, walk::{Facets, walk}};
//! // Any source of numbers in (0, 1); this one is no good for more than an example.
//! let mut seed = 1u64;
//! let mut next = || {
//!     seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
//!     ((seed >> 11) as f64 + 0.5) / (1u64 << 53) as f64
//! };
//! let v = [0.6, 0.0, 0.8];
//! let (mut once, walks) = (0, 20_000);
//! for _ in 0..walks {
//!     let exit = walk(Ggx::new(0.5), Facets::Mirror, v, &mut next).expect("not given up");
//!     assert_eq!(exit.weight, 1.0); // mirrors keep all light
//!     once += i32::from(exit.bounces == 1);
//! }
//! let share = f64::from(once) / f64::from(walks);
//! assert!((share - brdf::albedo_ggx(0.8, 0.5)).abs() < 0.02);
//! ```

use crate::batch::{Isa, Level, dispatch, ln_unit};
use crate::ggx::Ggx;
use crate::real::{Real, Single, lit};
use crate::sampling::Sampler;
use crate::vector::{Vector, add, dot, normalize, reflect, scale};
use glam::Vec3;
use std::f64::consts::PI;

/// What the facets of a walk are made of.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Facets<R> {
    /// Perfect mirrors: all light leaves again.
    Mirror,
    /// Lambertian, with their own albedo.
    Diffuse {
        /// Share that is not absorbed at a hit, in [0, 1].
        albedo: R,
    },
    /// A smooth coat over a diffuse base: mirrored with Schlick's reflectance, else let in,
    /// and out again with density ∝ cos θ (1 − (1 − cos θ)⁵) (Hammon 2017).
    Coated {
        /// Reflectance of the coat at normal incidence, in [0, 1].
        f0: R,
        /// Albedo of the base, in [0, 1].
        albedo: R,
    },
}

/// A ray that has left the surface: where to, and after what.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Exit<R> {
    /// Its direction in the tangent frame, of length 1, above the horizon.
    pub l: Vector<R>,
    /// What is left of its energy, 0 to 1: the product of the albedos on its way.
    pub weight: R,
    /// Hits on the way, at least 1.
    pub bounces: u32,
    /// How many of them were diffuse; 0 where all were mirrors.
    pub diffuse: u32,
}

/// Walks longer than this are given up; for α ≤ 1 none is seen.
const MOST_BOUNCES: u32 = 10_000;

/// One walk between the facets, from a view until it leaves again.
///
/// - *Source*: Heitz, Hanika, d'Eon and Dachsbacher 2016; Hammon 2017, appendix, with the correction
///   that this module's page tells of.
/// - *Arguments*: `ggx` how the facets lie; `facets` what they are made of; `v` where the ray comes
///   from, of length 1 and above the horizon; `next` gives independent numbers in (0, 1).
/// - *Value*: the ray that has left. `None` where it was given up after 10,000 hits, which no α in [0, 1]
///   needs.
/// - *Outside*: what comes from below the horizon leaves at once, without a hit.
pub fn walk<R: Real>(
    ggx: Ggx<R>,
    facets: Facets<R>,
    v: impl Into<Vector<R>>,
    mut next: impl FnMut() -> R,
) -> Option<Exit<R>> {
    let (zero, one) = (lit::<R>(0.0), lit::<R>(1.0));
    // The direction the ray comes from, seen from its next hit.
    let mut from = v.into();
    let (mut depth, mut weight, mut diffuse) = (zero, one, 0);
    for bounces in 0..MOST_BOUNCES {
        // The direction of travel is −from.
        let z = -from[2];
        let e = -next().ln();
        let length = ggx.projected(from);
        if z > zero {
            let (x, y) = (ggx.alpha_x * from[0], ggx.alpha_y * from[1]);
            // e/Λ, Λ = (length − z)/(2 z) without the difference.
            depth = depth - e * (lit::<R>(2.0) * z) * ((length + z) / (x * x + y * y));
            if depth <= zero || depth.is_nan() {
                return Some(Exit {
                    l: scale(from, -one),
                    weight,
                    bounces,
                    diffuse,
                });
            }
        } else {
            depth = depth + e * (lit::<R>(-2.0) * z) / (length - z);
        }
        let m = normal(ggx, from, [next(), next()]);
        let mirrored = match facets {
            Facets::Mirror => true,
            Facets::Diffuse { albedo } => {
                weight = weight * albedo;
                false
            }
            Facets::Coated { f0, albedo } => {
                let mirrored = next() < crate::f_schlick(f0, dot(from, m));
                if !mirrored {
                    weight = weight * albedo;
                }
                mirrored
            }
        };
        let l = if mirrored {
            reflect(from, m)
        } else {
            diffuse += 1;
            loop {
                let l = cosine_around(m, [next(), next()]);
                // 20 of 21 are kept.
                let rest = (one - dot(l, m)).pow5();
                let coated = matches!(facets, Facets::Coated { .. });
                // Of a NaN every direction is kept, or there would be no end.
                if !coated || rest.is_nan() || next() >= rest {
                    break l;
                }
            }
        };
        from = scale(l, -one);
    }
    None
}

/// Where the light of one view goes: its shares by how often it was let into the facets.
///
/// The way of a ray does not depend on the albedo, so that one simulation answers for all of
/// them: light that was inside k times carries albedoᵏ.
#[derive(Debug, Clone, PartialEq)]
pub struct Split {
    /// Walks that this is the mean of.
    pub walks: u32,
    /// Share of the energy that was only mirrored.
    pub specular: f64,
    /// Share that was inside once, twice, and so on before the albedo is taken off; the last
    /// entry holds all that were inside more often.
    pub diffuse: [f64; 16],
}

impl Split {
    /// Follows rays from a view into facets under a coat.
    ///
    /// - *Source*: Hammon 2017, appendix, with visible normals.
    /// - *Arguments*: `ggx` how the facets lie; `f0` the coat's reflectance at normal incidence; `v` the
    ///   view, of length 1 and above the horizon; `walks` how many rays; `next` gives independent numbers
    ///   in (0, 1).
    /// - *Value*: shares of the light, each with a standard error of at most 0.5/sqrt(walks).
    ///
    /// ```
    /// use brdf::{Ggx, walk::Split};
    /// let mut seed = 7u64;
    /// let mut next = || {
    ///     seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
    ///     ((seed >> 11) as f64 + 0.5) / (1u64 << 53) as f64
    /// };
    /// let split = Split::new(Ggx::new(0.36), 0.04, [0.6, 0.0, 0.8], 2_000, &mut next);
    /// // A white base under a clear coat gives all light back; a grey one keeps more than half of it.
    /// assert!((split.specular + split.diffuse(1.0) - 1.0).abs() < 1e-2);
    /// assert!(split.diffuse(0.5) < 0.5 * split.diffuse(1.0));
    /// ```
    pub fn new<R: Real>(
        ggx: Ggx<R>,
        f0: R,
        v: impl Into<Vector<R>>,
        walks: u32,
        mut next: impl FnMut() -> R,
    ) -> Split {
        let v = v.into();
        let albedo = lit(1.0);
        let mut counts = [0u32; 17];
        for _ in 0..walks {
            if let Some(exit) = walk(ggx, Facets::Coated { f0, albedo }, v, &mut next) {
                counts[(exit.diffuse as usize).min(16)] += 1;
            }
        }
        let share = |count: u32| f64::from(count) / f64::from(walks.max(1));
        Split {
            walks,
            specular: share(counts[0]),
            diffuse: std::array::from_fn(|k| share(counts[k + 1])),
        }
    }

    /// Share of the energy that leaves after one diffuse bounce, over the albedo: what Hammon
    /// calls *single*, with the mirrors before and after it.
    pub fn single(&self) -> f64 {
        self.diffuse[0]
    }

    /// Share that leaves after two diffuse bounces or more, over the square of the albedo: what
    /// Hammon calls *multi*, which does depend on the albedo.
    pub fn multi(&self, albedo: f64) -> f64 {
        let more = self.diffuse[1..].iter().rev();
        more.fold(0.0, |rest, share| share + albedo * rest)
    }

    /// Share of the energy that leaves after having been inside, for a base of that albedo in [0, 1]:
    /// albedo (single + albedo multi).
    ///
    /// With `specular` it is all that comes back: 1 for a white base, but for the few walks that were inside
    /// more than sixteen times.
    pub fn diffuse(&self, albedo: f64) -> f64 {
        albedo * (self.single() + albedo * self.multi(albedo))
    }
}

/// A normal visible from `v`, which may lie below the horizon (Dupuy and Benyoub 2023).
fn normal<R: Real>(ggx: Ggx<R>, v: Vector<R>, u: [R; 2]) -> Vector<R> {
    let l = ggx.sample(v, u, Sampler::SphericalCap).l;
    normalize(add(l, v))
}

/// A direction with density cos/π around `m`: a point on the sphere that touches it.
fn cosine_around<R: Real>(m: Vector<R>, u: [R; 2]) -> Vector<R> {
    let z = lit::<R>(1.0) - lit::<R>(2.0) * u[0];
    let sin = (lit::<R>(2.0) * (u[0] * (lit::<R>(1.0) - u[0])).at_least(lit(0.0)).sqrt())
        .at_least(lit(0.0));
    let phi = u[1] * lit(2.0 * PI);
    normalize(add(m, [sin * phi.cos(), sin * phi.sin(), z]))
}

/// What [`walk_mirrors`] fills in: one element a walk. What is longer than the shortest slice is left alone.
#[derive(Debug)]
pub struct Walks<'a> {
    /// Where each ray left to, of length 1: along the tangent, the bitangent and the normal.
    pub l: [&'a mut [f32]; 3],
    /// How often it was mirrored, at least once.
    pub bounces: &'a mut [u32],
}

/// Walks between perfect mirrors from one view, one for each element of the slices.
///
/// - *Source*: as [`walk()`].
/// - *Arguments*: `isa` the instructions to use, see [`Isa::best`]; `v` where the rays come from, of length 1
///   and above the horizon; `alpha` α in [1e-4, 1], the same in all directions; `seed` any number: the same
///   gives the same walks, up to the rounding of an instruction set.
/// - *Value*: in `out`.
/// - *Outside*: as of all [`crate::batch`]es, what is outside may be NaN.
///
/// ```
/// use brdf::{batch::Isa, glam::Vec3, walk::{Walks, walk_mirrors}};
/// let [mut x, mut y, mut z] = [(); 3].map(|()| vec![0.0f32; 20_000]);
/// let mut bounces = vec![0; 20_000];
/// let out = Walks { l: [&mut x, &mut y, &mut z], bounces: &mut bounces };
/// walk_mirrors(Isa::best(), Vec3::new(0.6, 0.0, 0.8), 0.5, 1, out);
/// // One bounce is single scattering.
/// let once = bounces.iter().filter(|&&bounces| bounces == 1).count() as f64 / 20_000.0;
/// assert!((once - brdf::albedo_ggx(0.8, 0.5)).abs() < 0.02);
/// ```
pub fn walk_mirrors(isa: Isa, v: Vec3, alpha: f32, seed: u64, out: Walks) {
    dispatch!(isa, walks_body(v: Vec3, alpha: f32, seed: u64, out: Walks))
}

/// Walks that are under way at the same time; those that have left are closed up.
const BLOCK: usize = 512;

struct Block {
    /// The direction each ray comes from.
    from: [[f32; BLOCK]; 3],
    depth: [f32; BLOCK],
    /// Set where the ray has left.
    out: [f32; BLOCK],
    /// The walk's own random bits, and its place in the output.
    key: [u32; BLOCK],
    index: [u32; BLOCK],
}

#[inline(always)]
fn walks_body<S: Single>(v: Vec3, alpha: f32, seed: u64, out: Walks) {
    let [x, y, z] = out.l;
    let n = x.len().min(y.len()).min(z.len()).min(out.bounces.len());
    let (x, y, z, bounces) = (&mut x[..n], &mut y[..n], &mut z[..n], &mut out.bounces[..n]);
    let mut block = Block {
        from: [[0.0; BLOCK]; 3],
        depth: [0.0; BLOCK],
        out: [0.0; BLOCK],
        key: [0; BLOCK],
        index: [0; BLOCK],
    };
    let mut first = 0;
    while first < n {
        let mut active = BLOCK.min(n - first);
        for i in 0..active {
            let index = (first + i) as u32;
            block.from[0][i] = v.x;
            block.from[1][i] = v.y;
            block.from[2][i] = v.z;
            block.depth[i] = 0.0;
            block.index[i] = index;
            block.key[i] = mix(index ^ (seed as u32)).wrapping_add((seed >> 32) as u32);
        }
        first += active;
        for bounce in 0..MOST_BOUNCES {
            if active == 0 {
                break;
            }
            step::<S>(&mut block, active, alpha, bounce);
            let mut kept = 0;
            for i in 0..active {
                let to = block.index[i] as usize;
                if block.out[i] != 0.0 {
                    x[to] = -block.from[0][i];
                    y[to] = -block.from[1][i];
                    z[to] = -block.from[2][i];
                    bounces[to] = bounce;
                } else {
                    for from in &mut block.from {
                        from[kept] = from[i];
                    }
                    block.depth[kept] = block.depth[i];
                    block.index[kept] = block.index[i];
                    block.key[kept] = block.key[i];
                    kept += 1;
                }
            }
            active = kept;
        }
    }
}

/// One flight and, where it ends inside, one mirror, for all rays of a block.
#[inline(always)]
#[allow(clippy::needless_range_loop)]
fn step<S: Single>(block: &mut Block, active: usize, alpha: f32, bounce: u32) {
    let active = active.min(BLOCK);
    let (one, two) = (lit::<S>(1.0), lit::<S>(2.0));
    let alpha = S::load(alpha);
    let a2 = alpha * alpha;
    let salt = [0, 1, 2].map(|i| {
        mix(bounce
            .wrapping_mul(3)
            .wrapping_add(i)
            .wrapping_add(0x9e37_79b9))
    });
    for i in 0..active {
        let v = [
            S::load(block.from[0][i]),
            S::load(block.from[1][i]),
            S::load(block.from[2][i]),
        ];
        let unit = |salt: u32| {
            S::load(((mix(block.key[i] ^ salt) >> 8) as f32 + 0.5) * (1.0 / 16_777_216.0))
        };
        let (u0, u1, u2) = (unit(salt[0]), unit(salt[1]), unit(salt[2]));
        let across = a2 * v[0].mul_add(v[0], v[1] * v[1]);
        let length = v[2].mul_add(v[2], across).sqrt();
        let up = v[2] < lit(0.0);
        let height = v[2].abs();
        // Up: −2 z e (length + z)/across. Down: 2 z e/(length + z).
        let sum = length + height;
        let (top, bottom) = if up { (-sum, across) } else { (one, sum) };
        let e = -ln_unit(u0);
        let depth = S::load(block.depth[i]) + two * height * e * top / bottom;
        // Also out where it rises straight up and across is 0: −∞.
        let left = up && depth <= lit(0.0);
        // A visible normal, by the cap of the stretched sphere.
        let invert = one / length;
        let std = [alpha * v[0] * invert, alpha * v[1] * invert, v[2] * invert];
        let cap = (one - u1).mul_add(one + std[2], -std[2]);
        let sin = ((one - cap) * (one + cap)).at_least(lit(0.0)).sqrt();
        let (sin_phi, cos_phi) = u2.sin_cos_turn();
        let m = [
            alpha * sin.mul_add(cos_phi, std[0]),
            alpha * sin.mul_add(sin_phi, std[1]),
            std[2] + cap,
        ];
        let m2 = m[0].mul_add(m[0], m[1].mul_add(m[1], m[2] * m[2]));
        let vm = v[0].mul_add(m[0], v[1].mul_add(m[1], v[2] * m[2]));
        let factor = two * vm / m2;
        // The next direction it comes from is that of v mirrored, turned around.
        let next = |axis: usize| {
            let from = v[axis] - factor * m[axis];
            if left { v[axis] } else { from }
        };
        let (x, y, z) = (next(0), next(1), next(2));
        block.from[0][i] = x.store();
        block.from[1][i] = y.store();
        block.from[2][i] = z.store();
        block.depth[i] = depth.store();
        block.out[i] = if left { 1.0 } else { 0.0 };
    }
}

/// Bits that look random (Wellons' low-bias hash).
#[inline(always)]
fn mix(mut x: u32) -> u32 {
    x ^= x >> 16;
    x = x.wrapping_mul(0x7feb_352d);
    x ^= x >> 15;
    x = x.wrapping_mul(0x846c_a68b);
    x ^ (x >> 16)
}
