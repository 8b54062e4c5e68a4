//! χ² tests of every sampler against its density, where they are hard: smooth surfaces, grazing
//! views, stretched surfaces, views from below, directions that end below the horizon.
//!
//! A lobe of α = 0.001 would fill one bin of a grid over the sphere. The bins here are a grid over
//! the *stretched light* c: the direction that mirrors the view in the facet where the surface is
//! stretched to α = 1. Visible normals are spread evenly there (Dupuy and Benyoub 2023), so that
//! all bins expect about as many. What a bin expects is not taken from that: it is the integral of
//! [`Ggx::pdf`] over the lights that belong to it, by quadrature.
//!
//! The seeds are fixed, and so is the level: all tests of a group together raise a false alarm
//! once in a thousand seeds (Bonferroni). Densities that are wrong by little are rejected.

mod numbers;

use brdf::batch::{self, Isa, Samples};
use brdf::glam::Vec3;
use brdf::{Ggx, Sampler};
use numbers::Numbers;
use std::f64::consts::{FRAC_1_SQRT_2, PI};

const ROWS: usize = 16;
const COLUMNS: usize = 24;
const BINS: usize = ROWS * COLUMNS;
const DRAWN: usize = 100_000;

type Vector = [f64; 3];
type Density = fn(Ggx<f64>, Vector, Vector, Sampler) -> f64;

fn direction(cos: f64, phi: f64) -> Vector {
    let sin = ((1.0 - cos) * (1.0 + cos)).sqrt();
    [sin * phi.cos(), sin * phi.sin(), cos]
}

fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn normalized(a: Vector) -> Vector {
    let length = dot(a, a).sqrt();
    a.map(|x| x / length)
}

fn sum(a: Vector, b: Vector) -> Vector {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

fn mirrored(v: Vector, m: Vector) -> Vector {
    let twice = 2.0 * dot(v, m);
    [0, 1, 2].map(|i| twice * m[i] - v[i])
}

/// A grid in which a density is tame: a point in the unit square for each light, and back.
#[derive(Clone, Copy)]
enum Grid {
    /// Height and azimuth of the stretched light, from the lowest that a facet can mirror to.
    Stretched {
        ggx: Ggx<f64>,
        v: Vector,
        view: Vector,
    },
    /// sin² θ and azimuth of the light itself.
    Disc,
}

impl Grid {
    fn new(ggx: Ggx<f64>, v: Vector, sampler: Sampler) -> Grid {
        if sampler == Sampler::Cosine {
            return Grid::Disc;
        }
        let view = normalized([ggx.alpha_x * v[0], ggx.alpha_y * v[1], v[2]]);
        Grid::Stretched { ggx, v, view }
    }

    fn place(self, l: Vector) -> [f64; 2] {
        let turn = |c: Vector| c[1].atan2(c[0]) / (2.0 * PI) + 0.5;
        match self {
            Grid::Stretched { ggx, v, view } => {
                let h = sum(l, v);
                let m = normalized([h[0] / ggx.alpha_x, h[1] / ggx.alpha_y, h[2]]);
                let c = mirrored(view, m);
                [(c[2] + view[2]) / (1.0 + view[2]), turn(c)]
            }
            Grid::Disc => [l[0] * l[0] + l[1] * l[1], turn(l)],
        }
    }

    /// The light at a place, and its solid angle over the area in the square.
    fn light(self, [row, turn]: [f64; 2]) -> (Vector, f64) {
        let phi = (turn - 0.5) * 2.0 * PI;
        match self {
            Grid::Stretched { ggx, v, view } => {
                let c = direction(row * (1.0 + view[2]) - view[2], phi);
                let m = normalized(sum(c, view));
                let stretched = [ggx.alpha_x * m[0], ggx.alpha_y * m[1], m[2]];
                let length = dot(stretched, stretched).sqrt();
                let h = stretched.map(|x| x / length);
                // dω_c = 4 c·m dω_m, dω_h = α_x α_y/length³ dω_m, dω_l = 4 v·h dω_h.
                let facets = ggx.alpha_x * ggx.alpha_y / (length * length * length);
                let angle = dot(v, h) / dot(view, m) * facets;
                (mirrored(v, h), angle * 2.0 * PI * (1.0 + view[2]))
            }
            Grid::Disc => {
                let z = (1.0 - row).sqrt();
                (direction(z, phi), PI / z)
            }
        }
    }
}

/// The part of a stretch of rows of which the lights are above the horizon.
fn above(grid: Grid, turn: f64, [low, high]: [f64; 2]) -> [f64; 2] {
    // Not at the ends themselves: at the lowest place there may be no half vector.
    let inside = |share: f64| low + (high - low) * share;
    let is_above = |row: f64| grid.light([row, turn]).0[2] > 0.0;
    match [1e-9, 1.0 - 1e-9].map(|share| is_above(inside(share))) {
        [true, true] => [low, high],
        [false, false] => [low, low],
        [_, up] => {
            let (mut outside, mut within) = if up { (low, high) } else { (high, low) };
            for _ in 0..50 {
                let middle = 0.5 * (outside + within);
                if is_above(middle) {
                    within = middle;
                } else {
                    outside = middle;
                }
            }
            if up { [within, high] } else { [low, within] }
        }
    }
}

/// What was asked for: a surface, a view, a sampler.
#[derive(Debug, Clone, Copy)]
struct Case {
    ggx: Ggx<f64>,
    v: Vector,
    sampler: Sampler,
}

impl Case {
    /// How many of the lights drawn are expected in each bin; those below the horizon only where
    /// `below`.
    fn expected(&self, density: Density, below: bool) -> Vec<f64> {
        let grid = Grid::new(self.ggx, self.v, self.sampler);
        // The horizon's edge through the bins is bent.
        let (rows, columns) = (6, if below { 6 } else { 48 });
        let mut expected = vec![0.0; BINS];
        for (bin, expected) in expected.iter_mut().enumerate() {
            let (row, column) = (bin / COLUMNS, bin % COLUMNS);
            for j in 0..columns {
                let turn = (column as f64 + (j as f64 + 0.5) / columns as f64) / COLUMNS as f64;
                for i in 0..rows {
                    let ends = [i, i + 1].map(|i| (row * rows + i) as f64 / (ROWS * rows) as f64);
                    let [low, high] = if below { ends } else { above(grid, turn, ends) };
                    if low == high {
                        continue;
                    }
                    let (l, angle) = grid.light([0.5 * (low + high), turn]);
                    let area = (high - low) / (columns * COLUMNS) as f64;
                    *expected += density(self.ggx, l, self.v, self.sampler) * angle * area;
                }
            }
        }
        expected
            .into_iter()
            .map(|share| share * DRAWN as f64)
            .collect()
    }

    /// The chance that lights with this density are as far from it as those drawn are.
    fn chance(&self, density: Density, mut draw: impl FnMut() -> Vector) -> f64 {
        // What a bounded cap leaves out of the directions below the horizon has a density all
        // the same: it is the one that the directions above need.
        let below = self.sampler != Sampler::BoundedCap || self.v[2] <= 0.0;
        let expected = self.expected(density, below);
        let grid = Grid::new(self.ggx, self.v, self.sampler);
        let mut seen = vec![0.0; BINS];
        for _ in 0..DRAWN {
            let l = draw();
            if !below && l[2] <= 0.0 {
                continue;
            }
            let [row, turn] = grid.place(l);
            let row = (row * ROWS as f64).clamp(0.0, ROWS as f64 - 1.0) as usize;
            let column = (turn * COLUMNS as f64).clamp(0.0, COLUMNS as f64 - 1.0) as usize;
            seen[row * COLUMNS + column] += 1.0;
        }
        // Those that count nowhere have a bin of their own, and bins that expect little share one.
        let missing = |counts: &[f64]| DRAWN as f64 - counts.iter().sum::<f64>();
        let mut all: Vec<(f64, f64)> = expected.iter().copied().zip(seen.iter().copied()).collect();
        if !below {
            all.push((missing(&expected), missing(&seen)));
        }
        let (many, few): (Vec<_>, Vec<_>) = all.into_iter().partition(|bin| bin.0 >= 8.0);
        let rest = few
            .iter()
            .fold((0.0, 0.0), |rest, bin| (rest.0 + bin.0, rest.1 + bin.1));
        let mut bins = many;
        if rest.0 > 2.0 {
            bins.push(rest);
        } else if rest.1 > 12.0 {
            // Drawn where next to none should be.
            return 0.0;
        }
        let chi2: f64 = bins.iter().map(|(e, s)| (s - e) * (s - e) / e).sum();
        tail(chi2, bins.len() as f64 - 1.0)
    }
}

/// Chance that χ² of so many degrees of freedom is larger (Wilson and Hilferty 1931).
fn tail(chi2: f64, freedom: f64) -> f64 {
    let spread = 2.0 / (9.0 * freedom);
    let z = ((chi2 / freedom).cbrt() - (1.0 - spread)) / spread.sqrt();
    0.5 * libm::erfc(z * FRAC_1_SQRT_2)
}

fn own(ggx: Ggx<f64>, l: Vector, v: Vector, sampler: Sampler) -> f64 {
    ggx.pdf(l, v, sampler)
}

fn surfaces() -> Vec<Ggx<f64>> {
    let stretched = [(0.02, 0.3), (0.5, 0.05), (0.3, 0.8), (0.003, 0.004)];
    [1e-4, 1e-3, 0.01, 0.03, 0.1, 0.35, 1.0]
        .map(|alpha| (alpha, alpha))
        .into_iter()
        .chain(stretched)
        .map(|(alpha_x, alpha_y)| Ggx { alpha_x, alpha_y })
        .collect()
}

/// Draws lights in double precision, and checks what is said of each.
fn drawing(case: Case, seed: u64) -> impl FnMut() -> Vector {
    let mut numbers = Numbers(seed);
    move || {
        let u = [numbers.unit(), numbers.unit()];
        let sample = case.ggx.sample(case.v, u, case.sampler);
        let pdf = case.ggx.pdf(sample.l, case.v, case.sampler);
        assert!((sample.pdf - pdf).abs() <= 1e-9 * pdf, "{case:?} {u:?}");
        sample.l
    }
}

/// The same in single precision.
fn drawing_single(case: Case, seed: u64) -> impl FnMut() -> Vector {
    let mut numbers = Numbers(seed);
    let (ggx, v) = (
        Ggx {
            alpha_x: case.ggx.alpha_x as f32,
            alpha_y: case.ggx.alpha_y as f32,
        },
        case.v.map(|x| x as f32),
    );
    move || {
        let u = [0; 2].map(|_| (numbers.unit() * 16_777_216.0).floor() as f32 / 16_777_216.0);
        ggx.sample(v, u, case.sampler).l.map(f64::from)
    }
}

#[track_caller]
fn all_are_likely(chances: &[(Case, f64)]) {
    let level = 1e-3 / chances.len() as f64;
    let unlikely: Vec<_> = chances
        .iter()
        .filter(|(_, p)| p.is_nan() || *p < level)
        .collect();
    let least = chances
        .iter()
        .map(|(_, p)| *p)
        .fold(1.0, |least: f64, p| if p < least { p } else { least });
    println!(
        "{} tests at {level:.1e} each, the least {least:.1e}",
        chances.len()
    );
    assert!(unlikely.is_empty(), "{unlikely:#?}");
}

/// Every surface from every view that `cosines` names.
fn cases(surfaces: &[Ggx<f64>], cosines: &[f64], samplers: &[Sampler]) -> Vec<Case> {
    let mut cases = Vec::new();
    for &ggx in surfaces {
        for &cos in cosines {
            for &sampler in samplers {
                let v = direction(cos, 0.4);
                cases.push(Case { ggx, v, sampler });
            }
        }
    }
    cases
}

const VISIBLE: [Sampler; 3] = [
    Sampler::Hemisphere,
    Sampler::SphericalCap,
    Sampler::BoundedCap,
];

#[test]
fn visible_normals_have_their_density() {
    // The last two from below, where a random walk comes from.
    let cosines = [1.0, 0.7, 0.15, 0.05, 0.02, 1e-3, -0.05, -0.6];
    let chances: Vec<_> = cases(&surfaces(), &cosines, &VISIBLE)
        .into_iter()
        .zip(1..)
        .map(|(case, seed)| (case, case.chance(own, drawing(case, seed))))
        .collect();
    all_are_likely(&chances);
}

#[test]
fn in_single_precision_too() {
    // Below α = 0.01 the places of the bins are those of the rounding.
    let surfaces: Vec<_> = surfaces()
        .into_iter()
        .filter(|ggx| ggx.alpha_x >= 0.01)
        .collect();
    let chances: Vec<_> = cases(&surfaces, &[1.0, 0.15, 0.02], &VISIBLE)
        .into_iter()
        .zip(1001..)
        .map(|(case, seed)| (case, case.chance(own, drawing_single(case, seed))))
        .collect();
    all_are_likely(&chances);
}

#[test]
fn the_cosine_has_its_density() {
    let case = cases(&[Ggx::new(0.3)], &[0.5], &[Sampler::Cosine])[0];
    let chances: Vec<_> = (1..4)
        .map(|seed| (case, case.chance(own, drawing(case, seed))))
        .collect();
    all_are_likely(&chances);
}

/// The batch draws by bounded caps, and has its own arithmetic in every instruction set.
#[test]
fn batches_have_their_density() {
    let surfaces = [0.01, 0.03, 0.1, 0.5, 1.0].map(Ggx::new);
    let mut chances = Vec::new();
    for (case, seed) in cases(&surfaces, &[1.0, 0.15, 0.02], &[Sampler::BoundedCap])
        .into_iter()
        .zip(2001..)
    {
        for isa in Isa::available() {
            let mut numbers = Numbers(seed);
            let mut many = || -> Vec<f32> {
                let unit = |_| (numbers.unit() * 16_777_216.0).floor() as f32 / 16_777_216.0;
                (0..DRAWN).map(unit).collect()
            };
            let (u0, u1) = (many(), many());
            let [mut x, mut y, mut z, mut pdf, mut weight] = [0; 5].map(|_| vec![0.0; DRAWN]);
            let out = Samples {
                l: [&mut x, &mut y, &mut z],
                pdf: &mut pdf,
                weight: &mut weight,
            };
            let v = Vec3::from_array(case.v.map(|x| x as f32));
            batch::sample(isa, v, case.ggx.alpha_x as f32, [&u0, &u1], out);
            let mut index = 0;
            let chance = case.chance(own, || {
                index += 1;
                [x[index - 1], y[index - 1], z[index - 1]].map(f64::from)
            });
            chances.push((case, chance));
        }
    }
    all_are_likely(&chances);
}

/// A test that accepts everything would pass all of the above.
#[test]
fn wrong_densities_are_rejected() {
    let rough = Ggx::new(0.1);
    let stretched = Ggx {
        alpha_x: 0.02,
        alpha_y: 0.3,
    };
    // α off by a fifteenth.
    let wider: Density = |ggx, l, v, sampler| Ggx::new(ggx.alpha_x * 1.066).pdf(l, v, sampler);
    let turned: Density = |ggx, l, v, sampler| {
        let (alpha_x, alpha_y) = (ggx.alpha_y, ggx.alpha_x);
        Ggx { alpha_x, alpha_y }.pdf(l, v, sampler)
    };
    // The cap that is not bounded.
    let unbounded: Density = |ggx, l, v, _| ggx.pdf(l, v, Sampler::SphericalCap);
    // All normals instead of the visible ones: D cos/(4 V·H).
    let all: Density = |ggx, l, v, _| {
        let h = normalized(sum(l, v));
        ggx.d(h) * h[2] / (4.0 * dot(v, h))
    };
    // Normals as if seen from elsewhere.
    let elsewhere: Density = |ggx, l, v, sampler| ggx.pdf(l, v, sampler) * (1.0 + 0.1 * l[0]);
    for (ggx, cos, sampler, density) in [
        (rough, 0.7, Sampler::Hemisphere, wider),
        (Ggx::new(0.01), 0.02, Sampler::SphericalCap, wider),
        (stretched, 0.7, Sampler::SphericalCap, turned),
        (Ggx::new(0.35), 0.15, Sampler::BoundedCap, unbounded),
        (rough, 0.15, Sampler::Hemisphere, all),
        (rough, 0.05, Sampler::SphericalCap, all),
        (Ggx::new(1.0), 0.3, Sampler::SphericalCap, elsewhere),
        (Ggx::new(1.0), 0.3, Sampler::Cosine, elsewhere),
    ] {
        let v = direction(cos, 0.4);
        let case = Case { ggx, v, sampler };
        let chance = case.chance(density, drawing(case, 1));
        assert!(chance < 1e-7, "{case:?}: {chance}");
        assert!(case.chance(own, drawing(case, 1)) > 1e-4, "{case:?}");
    }
    // And directions that are not those of the density: the weakest mistake, one number off.
    let case = cases(&[rough], &[0.7], &[Sampler::BoundedCap])[0];
    let mut draw = drawing(case, 1);
    let mut index = 0;
    let chance = case.chance(own, || {
        index += 1;
        let l = draw();
        if index % 8 == 0 {
            [l[0], -l[1], l[2]]
        } else {
            l
        }
    });
    assert!(chance < 1e-7, "{chance}");
}
