//! The batches against the terms, in every instruction set of this machine.

use brdf::batch::{self, Conductor, Cosines, Input, Isa, Samples, Vectors};
use brdf::glam::Vec3;
use brdf::{Fresnel, Ggx, Param, Sampler, Specular, d_ggx, f_conductor, f_schlick, terms, v_ggx};

const COUNT: usize = 4099;

struct Numbers(u64);

impl Numbers {
    fn unit(&mut self) -> f32 {
        self.0 = self
            .0
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (self.0 >> 40) as f32 / (1u64 << 24) as f32
    }

    fn many(&mut self, low: f32) -> Vec<f32> {
        (0..COUNT)
            .map(|_| low + (1.0 - low) * self.unit())
            .collect()
    }

    fn direction(&mut self) -> Vec3 {
        let (z, phi) = (
            self.unit() * 0.999 + 0.001,
            self.unit() * std::f32::consts::TAU,
        );
        let sin = ((1.0 - z) * (1.0 + z)).sqrt();
        Vec3::new(sin * phi.cos(), sin * phi.sin(), z).normalize()
    }
}

/// Worst distance in units of the last place of the truth.
fn worst_ulp(values: &[f32], truth: impl Fn(usize) -> f64) -> f64 {
    let ulp = |truth: f64| (truth.abs().max(1e-38).log2().floor() - 23.0).exp2();
    let error = |i: usize| (f64::from(values[i]) - truth(i)).abs() / ulp(truth(i));
    // `max` would pass over what is no number.
    (0..values.len()).map(error).fold(0.0, |worst, error| {
        if worst <= error || error.is_nan() {
            error
        } else {
            worst
        }
    })
}

#[track_caller]
fn check(what: &str, isa: Isa, worst: f64, bound: f64) {
    println!("{what:20} {:9} {worst:.1}", isa.name());
    assert!(worst <= bound, "{what} in {}: {worst} ulps", isa.name());
}

#[test]
fn cosines() {
    let mut numbers = Numbers(1);
    let [l, v, h, u] = [0; 4].map(|_| numbers.many(1e-3));
    let (alpha, f0) = (numbers.many(1e-4), numbers.many(0.0));
    for isa in Isa::available() {
        for hoisted in 0..12 {
            let pick = |bit: usize, values: &'static [f32], one| {
                if hoisted & bit == 0 {
                    Input::Each(values)
                } else {
                    Input::All(one)
                }
            };
            let leak = |values: &Vec<f32>| &*values.clone().leak();
            let (n_dot_v, alpha_in) = (pick(1, leak(&v), 0.6), pick(2, leak(&alpha), 0.3));
            let f0_in = match hoisted / 4 {
                0 => None,
                1 => Some(Input::Each(&f0)),
                _ => Some(Input::All(0.04)),
            };
            let input = Cosines {
                n_dot_l: &l,
                n_dot_v,
                n_dot_h: &h,
                v_dot_h: &u,
                alpha: alpha_in,
                f0: f0_in,
            };
            let mut out = vec![0.0; COUNT];
            batch::specular(isa, &input, &mut out);
            let at = |input: Input, i: usize| match input {
                Input::Each(values) => f64::from(values[i]),
                Input::All(value) => f64::from(value),
            };
            let worst = worst_ulp(&out, |i| {
                let (l, v, a) = (f64::from(l[i]), at(n_dot_v, i), at(alpha_in, i));
                let f = f0_in.map_or(1.0, |f0| f_schlick(at(f0, i), f64::from(u[i])));
                d_ggx(f64::from(h[i]), a) * v_ggx(l, v, a) * f * l
            });
            check("specular", isa, worst, 25.0);
        }
    }
}

#[test]
fn vectors() {
    let mut numbers = Numbers(2);
    let l: Vec<Vec3> = (0..COUNT).map(|_| numbers.direction()).collect();
    let v: Vec<Vec3> = (0..COUNT).map(|_| numbers.direction()).collect();
    let column = |of: &[Vec3], i: usize| of.iter().map(|v| v[i]).collect::<Vec<f32>>();
    let ([lx, ly, lz], [vx, vy, vz]) = (
        [0, 1, 2].map(|i| column(&l, i)),
        [0, 1, 2].map(|i| column(&v, i)),
    );
    for isa in Isa::available() {
        // Below an f0 of a hundredth another loop is chosen.
        for (alpha, f0) in [(0.01f32, 0.04f32), (0.3, 0.04), (0.3, 0.0), (1.0, 0.004)] {
            let truth = |i: usize| {
                let lobe = Specular {
                    ggx: Ggx::new(f64::from(alpha)),
                    fresnel: Fresnel::Schlick {
                        f0: [f64::from(f0); 3],
                    },
                };
                let wide = |v: Vec3| v.to_array().map(f64::from);
                lobe.eval_cos(wide(l[i]), wide(v[i]))[0]
            };
            let mut out = vec![0.0; COUNT];
            let input = Vectors {
                l: [&lx, &ly, &lz],
                v: [Input::Each(&vx), Input::Each(&vy), Input::Each(&vz)],
                alpha: Input::All(alpha),
                f0: Some(Input::All(f0)),
            };
            batch::specular_vectors(isa, &input, &mut out);
            check("vectors", isa, worst_ulp(&out, truth), 25.0);
            let mut transposed = vec![0.0; COUNT];
            batch::specular_vec3(isa, &l, &v, alpha, Some(f0), &mut transposed);
            assert_eq!(out, transposed);
        }
    }
}

/// Where nothing is reflected along the normal, the fifth power of 1 − V·H is all there is, down to
/// where single precision ends: |l − v|¹⁰/2¹⁵.
#[test]
fn close_directions_on_black() {
    let mut numbers = Numbers(8);
    let wide = |v: Vec3| v.to_array().map(f64::from);
    let lobe = Specular {
        ggx: Ggx::new(0.5),
        fresnel: Fresnel::Schlick { f0: [0.0; 3] },
    };
    for isa in Isa::available() {
        for apart in [0.3, 0.1, 0.01, 3e-3] {
            let l: Vec<Vec3> = (0..COUNT).map(|_| numbers.direction()).collect();
            let v = l
                .iter()
                .map(|l| (*l + apart * numbers.direction()).normalize());
            let v: Vec<Vec3> = v.collect();
            let mut out = vec![0.0; COUNT];
            batch::specular_vec3(isa, &l, &v, 0.5, Some(0.0), &mut out);
            let truth = |i: usize| lobe.eval_cos(wide(l[i]), wide(v[i]))[0];
            // What is smaller is not held with all digits.
            let kept = (0..COUNT).filter(|&i| truth(i) > 1e-36).collect::<Vec<_>>();
            let values: Vec<f32> = kept.iter().map(|&i| out[i]).collect();
            assert!(values.len() > COUNT / 4, "{apart}");
            let worst = worst_ulp(&values, |k| truth(kept[k]));
            check(&format!("{apart} apart"), isa, worst, 25.0);
        }
    }
}

#[test]
fn conductors() {
    let mut numbers = Numbers(3);
    let mut u = numbers.many(0.0);
    (u[0], u[1], u[2]) = (0.0, 1.0, 1e-6);
    for (n, k) in [
        (0.143, 3.983),
        (0.375, 2.386),
        (1.442, 1.603),
        (0.924, 2.447),
        (0.05, 1.5),
        (1.0, 1.0),
        (4.0, 8.0),
        (1.5, 0.0),
        (0.05, 4.0),
        (3.1, 3.3),
        (1.0, 0.1),
    ] {
        let color = Conductor::new(n, k);
        for isa in Isa::available() {
            let [mut r, mut g, mut b] = [0; 3].map(|_| vec![0.0; COUNT]);
            batch::conductor_rgb(isa, &[color; 3], &u, [&mut r, &mut g, &mut b]);
            let truth = |i: usize| f_conductor(f64::from(n), f64::from(k), f64::from(u[i]));
            check(
                &format!("conductor {n} {k}"),
                isa,
                worst_ulp(&r, truth),
                12.0,
            );
            assert_eq!(r, b);
        }
    }
}

#[test]
fn any_metal() {
    let mut numbers = Numbers(5);
    let u = numbers.many(0.0);
    let isa = Isa::best();
    for _ in 0..60 {
        let (n, k) = (0.05 + 4.0 * numbers.unit(), 10.0 * numbers.unit());
        let [mut r, mut g, mut b] = [0; 3].map(|_| vec![0.0; COUNT]);
        let color = Conductor::new(n, k);
        batch::conductor_rgb(isa, &[color; 3], &u, [&mut r, &mut g, &mut b]);
        let truth = |i: usize| f_conductor(f64::from(n), f64::from(k), f64::from(u[i]));
        check(&format!("{n} {k}"), isa, worst_ulp(&r, truth), 12.0);
    }
}

#[test]
fn samples() {
    let mut numbers = Numbers(4);
    let [u0, u1] = [0; 2].map(|_| numbers.many(0.0));
    for isa in Isa::available() {
        let views = [
            Vec3::new(0.48, -0.36, 0.8),
            Vec3::new(0.8, -0.6, 1e-5),
            Vec3::Z,
        ];
        let widths = [1e-4f32, 0.05, 0.4, 1.0];
        for (alpha, v) in widths.iter().flat_map(|&alpha| views.map(|v| (alpha, v))) {
            let [mut x, mut y, mut z, mut pdf, mut weight] = [0; 5].map(|_| vec![0.0; COUNT]);
            let out = Samples {
                l: [&mut x, &mut y, &mut z],
                pdf: &mut pdf,
                weight: &mut weight,
            };
            batch::sample(isa, v, alpha, [&u0, &u1], out);
            let ggx = Ggx::new(f64::from(alpha));
            let wide = v.to_array().map(f64::from);
            for i in 0..COUNT {
                let truth = ggx.sample(
                    wide,
                    [f64::from(u0[i]), f64::from(u1[i])],
                    Sampler::BoundedCap,
                );
                let l = [x[i], y[i], z[i]].map(f64::from);
                for (value, truth) in l.into_iter().zip(truth.l) {
                    assert!(
                        (value - truth).abs() < 2e-6 + 4e-7 / f64::from(alpha),
                        "{alpha} {i}: {l:?}, not {truth:?}"
                    );
                }
            }
            // The direction as rounded has the density and the weight that are returned.
            let light = |i: usize| [x[i], y[i], z[i]].map(f64::from);
            let density = |i| ggx.pdf(light(i), wide, Sampler::BoundedCap);
            let counts = |i| ggx.weight(light(i), wide, Sampler::BoundedCap);
            check("density", isa, worst_ulp(&pdf, density), 16.0);
            check("weight", isa, worst_ulp(&weight, counts), 16.0);
        }
    }
}

#[test]
fn short_and_hostile() {
    for isa in Isa::available() {
        let mut out = [7.0; 3];
        let (l, h) = ([0.5, -1.0, 0.0], [0.9; 9]);
        let input = Cosines {
            n_dot_l: &l,
            n_dot_v: Input::All(0.5),
            n_dot_h: &h,
            v_dot_h: &h,
            alpha: Input::All(0.5),
            f0: None,
        };
        batch::specular(isa, &input, &mut out);
        assert!(out[0] > 0.0);
        assert_eq!(out[1..], [0.0, 0.0]);
        batch::specular(isa, &input, &mut []);
    }
}

#[test]
fn every_term_is_the_same_in_lanes() {
    const COUNT: usize = 100;
    for term in terms().iter().filter(|term| term.cost < 10_000) {
        let column = |(i, param): (usize, &Param)| -> Vec<f32> {
            let (low, high) = param.range;
            let share = |k: usize| ((k * (7 + 2 * i) + 3 * i + 1) % COUNT) as f64 / COUNT as f64;
            (0..COUNT)
                .map(|k| (low + (high - low) * share(k)) as f32)
                .collect()
        };
        let columns: Vec<Vec<f32>> = term.params.iter().enumerate().map(column).collect();
        let slices: Vec<&[f32]> = columns.iter().map(Vec::as_slice).collect();
        let wide: Vec<Vec<f64>> = columns
            .iter()
            .map(|column| column.iter().map(|&x| f64::from(x)).collect())
            .collect();
        let doubles: Vec<&[f64]> = wide.iter().map(Vec::as_slice).collect();
        for isa in Isa::available() {
            let (mut single, mut double) = (vec![0.0; COUNT], vec![0.0; COUNT]);
            (term.f32_block)(isa, &slices, &mut single);
            (term.f64_block)(isa, &doubles, &mut double);
            for k in 0..COUNT {
                let args: Vec<f64> = wide.iter().map(|column| column[k]).collect();
                let narrow: Vec<f32> = columns.iter().map(|column| column[k]).collect();
                let name = format!("{} {} at {args:?}", term.name, isa.name());
                assert_eq!(single[k].to_bits(), (term.f32)(&narrow).to_bits(), "{name}");
                assert_eq!(double[k].to_bits(), (term.f64)(&args).to_bits(), "{name}");
            }
            (term.f32_block)(isa, &[], &mut single);
            assert!(single.iter().all(|x| x.is_nan()));
        }
    }
}

/// One value for all points is the same as that value at each.
#[test]
fn an_argument_may_be_one_value() {
    const COUNT: usize = 100;
    for term in terms().iter().filter(|term| term.cost < 10_000) {
        let value = |i: usize, k: usize| {
            let (low, high) = term.params[i].range;
            low + (high - low) * (((k * 7 + 3 * i + 1) % COUNT) as f64 / COUNT as f64)
        };
        let all = term.params.len();
        let material: Vec<bool> = term.params.iter().map(Param::is_of_material).collect();
        let one = (0..all).map(|only| (0..all).map(|i| i == only).collect());
        for same in one.chain([material, vec![true; all]]) {
            let same: Vec<bool> = same;
            let at = |i: usize, k: usize| value(i, if same[i] { 5 } else { k });
            let column = |i: usize| (0..COUNT).map(|k| at(i, k)).collect::<Vec<f64>>();
            let columns: Vec<Vec<f64>> = (0..all).map(column).collect();
            let slices = columns.iter().zip(&same);
            let slices = slices.map(|(column, same)| &column[..if *same { 1 } else { COUNT }]);
            let slices: Vec<&[f64]> = slices.collect();
            for isa in Isa::available() {
                let mut out = vec![0.0; COUNT];
                (term.f64_block)(isa, &slices, &mut out);
                for (k, out) in out.iter().enumerate() {
                    let args: Vec<f64> = (0..all).map(|i| at(i, k)).collect();
                    let expected = (term.f64)(&args);
                    let name = format!("{} {} at {args:?}, {same:?}", term.name, isa.name());
                    assert_eq!(out.to_bits(), expected.to_bits(), "{name}");
                }
            }
        }
    }
}

/// What does not fill a register is computed alone, and must not differ in a bit.
#[test]
fn any_length() {
    let mut numbers = Numbers(6);
    let columns = [0; 6].map(|_| numbers.many(0.01));
    let l: Vec<Vec3> = (0..COUNT).map(|_| numbers.direction()).collect();
    let v: Vec<Vec3> = (0..COUNT).map(|_| numbers.direction()).collect();
    let metal = [
        Conductor::new(0.143, 3.983),
        Conductor::new(0.375, 2.386),
        Conductor::new(1.442, 1.603),
    ];
    // Everything that fills slices of this length, one after the other.
    let all = |isa: Isa, n: usize, known: bool| {
        let [a, b, c, d, e, f] = columns.each_ref().map(|column| &column[..n]);
        let either = |values, value| match known {
            true => Input::All(value),
            false => Input::Each(values),
        };
        let cosines = Cosines {
            n_dot_l: a,
            n_dot_v: either(b, 0.6),
            n_dot_h: c,
            v_dot_h: d,
            alpha: either(e, 0.3),
            f0: Some(Input::Each(f)),
        };
        let mut out: [Vec<f32>; 10] = [0; 10].map(|_| vec![7.0; n]);
        let [o0, o1, o2, o3, o4, o5, o6, o7, o8, o9] = &mut out;
        batch::specular(isa, &cosines, o0);
        batch::specular_vec3(isa, &l[..n], &v, 0.3, Some(0.04), o1);
        batch::conductor_rgb(isa, &metal, a, [o2, o3, o4]);
        let samples = Samples {
            l: [o5, o6, o7],
            pdf: o8,
            weight: o9,
        };
        batch::sample(isa, Vec3::new(0.48, -0.36, 0.8), 0.4, [a, b], samples);
        out
    };
    for isa in Isa::available() {
        for known in [false, true] {
            let long = all(isa, 200, known);
            for n in 0..70 {
                for (short, long) in all(isa, n, known).iter().zip(&long) {
                    assert_eq!(short[..], long[..n], "{} {n}", isa.name());
                }
            }
        }
    }
}

/// A NaN stays in its place, and is not lost.
#[test]
fn not_a_number() {
    let good = [0.5; 40];
    let mut bad = good;
    bad[17] = f32::NAN;
    for isa in Isa::available() {
        for place in 0..4 {
            let pick = |i: usize| if i == place { &bad[..] } else { &good };
            let input = Cosines {
                n_dot_l: pick(0),
                n_dot_v: Input::Each(pick(1)),
                n_dot_h: pick(2),
                v_dot_h: pick(3),
                alpha: Input::All(0.4),
                f0: Some(Input::All(0.04)),
            };
            let mut out = [7.0; 40];
            batch::specular(isa, &input, &mut out);
            for (i, value) in out.iter().enumerate() {
                assert_eq!(value.is_nan(), i == 17, "{} {place} {i}", isa.name());
            }
        }
    }
}

/// What is given once for all is what is given for each, but for what then leaves the loop.
#[test]
fn given_once_or_each() {
    let mut numbers = Numbers(7);
    let l: Vec<Vec3> = (0..100).map(|_| numbers.direction()).collect();
    let column = |i: usize| l.iter().map(|l| l[i]).collect::<Vec<f32>>();
    let (light, v) = ([column(0), column(1), column(2)], numbers.direction());
    for f0 in [0.04, 0.004] {
        let same = [v.x, v.y, v.z, 0.3, f0].map(|value| vec![value; 100]);
        let once = [v.x, v.y, v.z, 0.3, f0].map(Input::All);
        for isa in Isa::available() {
            // One bit for each argument that is given once.
            let evaluate = |which: usize| {
                let pick = |i: usize| match which & 1 << i {
                    0 => Input::Each(&same[i]),
                    _ => once[i],
                };
                let input = Vectors {
                    l: light.each_ref().map(Vec::as_slice),
                    v: [pick(0), pick(1), pick(2)],
                    alpha: pick(3),
                    f0: Some(pick(4)),
                };
                let mut out = vec![0.0; 100];
                batch::specular_vectors(isa, &input, &mut out);
                out
            };
            for which in 1..32 {
                assert_eq!(evaluate(which), evaluate(0), "{} {which:b}", isa.name());
            }
        }
    }
}

/// An f0 below a hundredth is computed more carefully than one above: what one is beside must not
/// matter.
#[test]
fn neighbours_do_not_matter() {
    let mut numbers = Numbers(9);
    let l: Vec<Vec3> = (0..COUNT).map(|_| numbers.direction()).collect();
    let v: Vec<Vec3> = (0..COUNT).map(|_| numbers.direction()).collect();
    let column = |of: &[Vec3], i: usize| of.iter().map(|v| v[i]).collect::<Vec<f32>>();
    let ([lx, ly, lz], [vx, vy, vz]) = (
        [0, 1, 2].map(|i| column(&l, i)),
        [0, 1, 2].map(|i| column(&v, i)),
    );
    let f0: Vec<f32> = (0..COUNT).map(|_| 0.02 * numbers.unit()).collect();
    for isa in Isa::available() {
        let evaluate = |from: usize, to: usize| {
            let [x, y, z, a, b, c, f0] =
                [&lx, &ly, &lz, &vx, &vy, &vz, &f0].map(|of| of[from..to].to_vec());
            let input = Vectors {
                l: [&x, &y, &z],
                v: [Input::Each(&a), Input::Each(&b), Input::Each(&c)],
                alpha: Input::All(0.3),
                f0: Some(Input::Each(&f0)),
            };
            let mut out = vec![0.0; to - from];
            batch::specular_vectors(isa, &input, &mut out);
            out
        };
        let all = evaluate(0, COUNT);
        for i in 0..COUNT {
            assert_eq!(evaluate(i, i + 1), all[i..=i], "{} {i}", isa.name());
        }
        for (from, to) in [(1, 18), (7, 40), (3, COUNT)] {
            assert_eq!(evaluate(from, to), all[from..to], "{}", isa.name());
        }
    }
}
