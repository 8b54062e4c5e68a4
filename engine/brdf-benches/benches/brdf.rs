//! Every term by itself and in blocks, batches in every instruction set, and what takes long.

use brdf::batch::{self, Conductor, Cosines, Input, Isa, Samples, Vectors};
use brdf::glam::Vec3;
use brdf::walk::{Facets, Walks, walk, walk_mirrors};
use brdf::{Fresnel, Ggx, Sampler, Specular, Term};
use divan::counter::ItemsCount;
use divan::{Bencher, black_box};
use std::sync::LazyLock;

fn main() {
    divan::main();
}

/// Elements of a batch: all its slices fit into the second-level cache.
const COUNT: usize = 2048;

/// Numbers that follow from a seed (SplitMix64).
struct Numbers(u64);

impl Numbers {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (((z ^ (z >> 31)) >> 12) as f64 + 0.5) / (1u64 << 52) as f64
    }

    fn column(&mut self, (low, high): (f64, f64)) -> Vec<f64> {
        (0..COUNT)
            .map(|_| low + (high - low) * self.unit())
            .collect()
    }

    fn cosines(&mut self) -> Vec<f32> {
        self.column((0.01, 1.0)).iter().map(|&x| x as f32).collect()
    }
}

fn directions(seed: u64) -> Vec<Vec3> {
    let mut numbers = Numbers(seed);
    let mut one = || {
        let (z, phi) = (numbers.unit(), std::f64::consts::TAU * numbers.unit());
        let sin = ((1.0 - z) * (1.0 + z)).sqrt();
        Vec3::from_array([sin * phi.cos(), sin * phi.sin(), z].map(|x| x as f32))
    };
    (0..COUNT).map(|_| one()).collect()
}

/// The name of an argument in the output.
macro_rules! named {
    ($name:ident($of:ty), $shows:expr) => {
        #[derive(Clone, Copy)]
        struct $name($of);

        impl std::fmt::Display for $name {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                let shows: for<'a> fn(&'a $of) -> &'a str = $shows;
                f.write_str(shows(&self.0))
            }
        }
    };
}
named!(Name(&'static Term), |term| term.name);
named!(Set(Isa), |isa| isa.name());

/// Terms that are closed forms.
static TERMS: LazyLock<Vec<Name>> = LazyLock::new(|| {
    let terms = brdf::terms().iter().filter(|term| term.cost < 10_000);
    terms.map(Name).collect()
});
static SETS: LazyLock<Vec<Set>> =
    LazyLock::new(|| Isa::available().into_iter().map(Set).collect());

/// A column for each argument.
fn columns(term: &Term) -> Vec<Vec<f64>> {
    let mut numbers = Numbers(1);
    let params = term.params.iter();
    params.map(|param| numbers.column(param.range)).collect()
}

fn narrow(columns: &[Vec<f64>]) -> Vec<Vec<f32>> {
    let narrow = |column: &Vec<f64>| column.iter().map(|&x| x as f32).collect();
    columns.iter().map(narrow).collect()
}

mod term {
    use super::*;

    /// `COUNT` calls, one after the other.
    #[divan::bench(args = TERMS.iter().copied())]
    fn calls(bencher: Bencher, Name(term): Name) {
        let columns = narrow(&columns(term));
        let args: Vec<Vec<f32>> = (0..COUNT)
            .map(|i| columns.iter().map(|column| column[i]).collect())
            .collect();
        bencher.counter(ItemsCount::new(COUNT)).bench_local(|| {
            for args in &args {
                black_box((term.f32)(black_box(args)));
            }
        });
    }

    #[divan::bench(args = TERMS.iter().copied())]
    fn block_f32(bencher: Bencher, Name(term): Name) {
        let columns = narrow(&columns(term));
        let slices: Vec<&[f32]> = columns.iter().map(Vec::as_slice).collect();
        let (isa, mut out) = (Isa::best(), vec![0.0; COUNT]);
        bencher
            .counter(ItemsCount::new(COUNT))
            .bench_local(|| (term.f32_block)(isa, black_box(&slices), black_box(&mut out)));
    }

    #[divan::bench(args = TERMS.iter().copied())]
    fn block_f64(bencher: Bencher, Name(term): Name) {
        let columns = columns(term);
        let slices: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
        let (isa, mut out) = (Isa::best(), vec![0.0; COUNT]);
        bencher
            .counter(ItemsCount::new(COUNT))
            .bench_local(|| (term.f64_block)(isa, black_box(&slices), black_box(&mut out)));
    }
}

mod batches {
    use super::*;

    #[divan::bench(args = SETS.iter().copied())]
    fn specular(bencher: Bencher, Set(isa): Set) {
        let mut numbers = Numbers(2);
        let [l, v, h, u, alpha, f0] = [0; 6].map(|_| numbers.cosines());
        let input = Cosines {
            n_dot_l: &l,
            n_dot_v: Input::Each(&v),
            n_dot_h: &h,
            v_dot_h: &u,
            alpha: Input::Each(&alpha),
            f0: Some(Input::Each(&f0)),
        };
        let mut out = vec![0.0; COUNT];
        bencher
            .counter(ItemsCount::new(COUNT))
            .bench_local(|| batch::specular(isa, black_box(&input), black_box(&mut out)));
    }

    #[divan::bench(args = SETS.iter().copied())]
    fn specular_hoisted(bencher: Bencher, Set(isa): Set) {
        let mut numbers = Numbers(2);
        let [l, h, u] = [0; 3].map(|_| numbers.cosines());
        let input = Cosines {
            n_dot_l: &l,
            n_dot_v: Input::All(0.6),
            n_dot_h: &h,
            v_dot_h: &u,
            alpha: Input::All(0.3),
            f0: Some(Input::All(0.04)),
        };
        let mut out = vec![0.0; COUNT];
        bencher
            .counter(ItemsCount::new(COUNT))
            .bench_local(|| batch::specular(isa, black_box(&input), black_box(&mut out)));
    }

    #[divan::bench(args = SETS.iter().copied())]
    fn specular_vectors(bencher: Bencher, Set(isa): Set) {
        let (l, v) = (directions(3), directions(4));
        let column = |of: &[Vec3], i: usize| of.iter().map(|v| v[i]).collect::<Vec<f32>>();
        let [lx, ly, lz] = [0, 1, 2].map(|i| column(&l, i));
        let [vx, vy, vz] = [0, 1, 2].map(|i| column(&v, i));
        let input = Vectors {
            l: [&lx, &ly, &lz],
            v: [Input::Each(&vx), Input::Each(&vy), Input::Each(&vz)],
            alpha: Input::All(0.3),
            f0: Some(Input::All(0.04)),
        };
        let mut out = vec![0.0; COUNT];
        bencher
            .counter(ItemsCount::new(COUNT))
            .bench_local(|| batch::specular_vectors(isa, black_box(&input), black_box(&mut out)));
    }

    #[divan::bench(args = SETS.iter().copied())]
    fn specular_vec3(bencher: Bencher, Set(isa): Set) {
        let (l, v, mut out) = (directions(3), directions(4), vec![0.0; COUNT]);
        bencher.counter(ItemsCount::new(COUNT)).bench_local(|| {
            let out = black_box(&mut out);
            batch::specular_vec3(isa, black_box(&l), &v, 0.3, Some(0.04), out);
        });
    }

    #[divan::bench(args = SETS.iter().copied())]
    fn conductor_rgb(bencher: Bencher, Set(isa): Set) {
        let gold = [(0.143, 3.983), (0.375, 2.386), (1.442, 1.603)];
        let colors = gold.map(|(n, k)| Conductor::new(n, k));
        let u = Numbers(7).cosines();
        let [mut r, mut g, mut b] = [0; 3].map(|_| vec![0.0; COUNT]);
        bencher.counter(ItemsCount::new(COUNT)).bench_local(|| {
            let out = black_box([&mut r[..], &mut g, &mut b]);
            batch::conductor_rgb(isa, &colors, black_box(&u), out);
        });
    }

    #[divan::bench(args = SETS.iter().copied())]
    fn sample(bencher: Bencher, Set(isa): Set) {
        let mut numbers = Numbers(8);
        let [u0, u1] = [0; 2].map(|_| numbers.cosines());
        let [mut x, mut y, mut z, mut pdf, mut weight] = [0; 5].map(|_| vec![0.0; COUNT]);
        let v = Vec3::new(0.48, -0.36, 0.8);
        bencher.counter(ItemsCount::new(COUNT)).bench_local(|| {
            let out = Samples {
                l: [&mut x[..], &mut y, &mut z],
                pdf: &mut pdf,
                weight: &mut weight,
            };
            batch::sample(isa, v, 0.4, black_box([&u0, &u1]), black_box(out));
        });
    }

    #[divan::bench(args = SETS.iter().copied())]
    fn walks(bencher: Bencher, Set(isa): Set) {
        let [mut x, mut y, mut z] = [0; 3].map(|_| vec![0.0; COUNT]);
        let mut bounces = vec![0; COUNT];
        let v = Vec3::new(0.48, -0.36, 0.8);
        bencher.counter(ItemsCount::new(COUNT)).bench_local(|| {
            let out = Walks {
                l: [&mut x[..], &mut y, &mut z],
                bounces: &mut bounces,
            };
            walk_mirrors(isa, v, 0.5, 1, black_box(out));
        });
    }
}

mod single {
    use super::*;

    const FACETS: [(&str, Facets<f32>); 3] = [
        ("mirrors", Facets::Mirror),
        ("diffuse", Facets::Diffuse { albedo: 0.8 }),
        (
            "coated",
            Facets::Coated {
                f0: 0.02,
                albedo: 0.8,
            },
        ),
    ];

    #[divan::bench]
    fn specular_rgb(bencher: Bencher) {
        let (l, v) = (directions(5), directions(6));
        let lobe = Specular {
            ggx: Ggx::new(0.3f32),
            fresnel: Fresnel::Schlick {
                f0: [0.9, 0.5, 0.2],
            },
        };
        bencher.counter(ItemsCount::new(COUNT)).bench_local(|| {
            for (&l, &v) in l.iter().zip(&v) {
                black_box(lobe.eval_cos(black_box(l), black_box(v)));
            }
        });
    }

    #[divan::bench(args = ["hemisphere", "spherical cap", "bounded cap", "cosine"])]
    fn sample(bencher: Bencher, sampler: &str) {
        let sampler = match sampler {
            "hemisphere" => Sampler::Hemisphere,
            "spherical cap" => Sampler::SphericalCap,
            "bounded cap" => Sampler::BoundedCap,
            _ => Sampler::Cosine,
        };
        let mut numbers = Numbers(9);
        let u: Vec<[f32; 2]> = (0..COUNT)
            .map(|_| [0; 2].map(|_| numbers.unit() as f32))
            .collect();
        let ggx = Ggx::new(0.4f32);
        bencher.counter(ItemsCount::new(COUNT)).bench_local(|| {
            for &u in &u {
                black_box(ggx.sample([0.6, 0.0, 0.8], black_box(u), sampler));
            }
        });
    }

    #[divan::bench(args = FACETS.map(|(name, _)| name))]
    fn walks(bencher: Bencher, name: &str) {
        let facets = FACETS.iter().find(|facets| facets.0 == name);
        let facets = facets.map_or(Facets::Mirror, |facets| facets.1);
        let mut numbers = Numbers(10);
        bencher.counter(ItemsCount::new(COUNT)).bench_local(|| {
            for _ in 0..COUNT {
                let next = || numbers.unit() as f32;
                black_box(walk(Ggx::new(0.5f32), facets, [0.6, 0.0, 0.8], next));
            }
        });
    }
}

mod integral {
    use super::*;

    #[divan::bench]
    fn albedo_f32() -> f32 {
        brdf::albedo_ggx(black_box(0.6f32), black_box(0.25))
    }

    #[divan::bench]
    fn albedo_f64() -> f64 {
        brdf::albedo_ggx(black_box(0.6f64), black_box(0.25))
    }

    #[divan::bench(sample_count = 10)]
    fn table_64() -> brdf::AlbedoTable {
        brdf::AlbedoTable::new(black_box(64))
    }

    #[divan::bench]
    fn weak_furnace() -> f64 {
        brdf::integral_g1_d_ggx(black_box(0.6f64), black_box(0.25))
    }
}
