//! Many evaluations at once, in every instruction set of the machine.

use super::{Effort, Errors, Limit, Numbers, Row, opaque, time};
use brdf::batch::{self, Conductor, Cosines, Input, Isa, Samples, Vectors};
use brdf::glam::Vec3;
use brdf::walk::{Walks, walk_mirrors};
use brdf::{Fresnel, Ggx, Sampler, Specular, d_ggx, f_conductor, f_schlick, v_ggx};

/// Elements of a batch: six slices of them fit in a second-level cache.
const COUNT: usize = 2048;

pub(super) fn limits(effort: Effort) -> Vec<Limit> {
    let mut numbers = Numbers(1);
    let [a, b] = [0; 2].map(|_| many(&mut numbers, 0.5));
    let mut out = vec![0.0; COUNT];
    let mut measure = |isa: Isa| Limit {
        isa: isa.name(),
        division_ns: time(effort, COUNT, || {
            batch::divide(isa, &a, &b, opaque(&mut out))
        }),
        square_root_ns: time(effort, COUNT, || {
            batch::square_root(isa, &a, opaque(&mut out))
        }),
    };
    Isa::available().into_iter().map(&mut measure).collect()
}

fn many(numbers: &mut Numbers, low: f64) -> Vec<f32> {
    (0..COUNT)
        .map(|_| numbers.between((low, 1.0)) as f32)
        .collect()
}

/// Divisions and square roots of an evaluation.
type Needs = (f64, f64);

struct Bench<'a> {
    effort: Effort,
    limits: &'a [Limit],
}

impl Bench<'_> {
    fn row(
        &self,
        name: (&str, &str),
        isa: Isa,
        needs: Option<Needs>,
        ns: f64,
        errors: Vec<f64>,
    ) -> Row {
        let limit = self.limits.iter().find(|limit| limit.isa == isa.name());
        let least = needs.zip(limit).map(|((divisions, roots), limit)| {
            divisions * limit.division_ns + roots * limit.square_root_ns
        });
        let error_unit = if errors.is_empty() { "none" } else { "ulp" };
        let errors = Errors::of(errors);
        Row {
            group: name.0.into(),
            variant: name.1.into(),
            precision: "f32",
            isa: isa.name(),
            ns,
            limit_ratio: least.map(|least| least / ns),
            needs,
            max_ulp: errors.max,
            p999_ulp: errors.p999,
            median_ulp: errors.median,
            error_unit,
            pareto: false,
        }
    }
}

/// Errors in units of the last place of single precision against a truth in double.
fn errors(values: &[f32], truth: impl Fn(usize) -> f64) -> Vec<f64> {
    let error = |(i, &value): (usize, &f32)| {
        let truth = truth(i);
        let ulp = (truth.abs().max(f64::from(f32::MIN_POSITIVE)).log2().floor() - 23.0).exp2();
        (f64::from(value) - truth).abs() / ulp
    };
    values.iter().enumerate().map(error).collect()
}

pub(super) fn groups(effort: Effort, limits: &[Limit]) -> Vec<Vec<Row>> {
    let bench = Bench { effort, limits };
    vec![
        bench.cosines(),
        bench.vectors(),
        bench.call(),
        bench.conductor(),
        bench.sample(),
        bench.walk(),
    ]
}

impl Bench<'_> {
    fn cosines(&self) -> Vec<Row> {
        let mut numbers = Numbers(2);
        let [l, v, h, u, alpha, f0] = [0; 6].map(|_| many(&mut numbers, 0.01));
        let mut out = vec![0.0; COUNT];
        let each = Cosines {
            n_dot_l: &l,
            n_dot_v: Input::Each(&v),
            n_dot_h: &h,
            v_dot_h: &u,
            alpha: Input::Each(&alpha),
            f0: Some(Input::Each(&f0)),
        };
        let all = Cosines {
            n_dot_v: Input::All(0.6),
            alpha: Input::All(0.3),
            f0: Some(Input::All(0.04)),
            ..each
        };
        // Hoisted, the root of the view is taken once.
        let variants = [
            ("batch", each, (1.0, 2.0)),
            ("hoisted", all, (1.0, 1.0)),
            ("perfect", Cosines { f0: None, ..all }, (1.0, 1.0)),
        ];
        let at = |input: Input, i: usize| match input {
            Input::Each(values) => f64::from(values[i]),
            Input::All(value) => f64::from(value),
        };
        let mut rows = Vec::new();
        for isa in Isa::available() {
            for (variant, input, needs) in variants {
                let ns = time(self.effort, COUNT, || {
                    batch::specular(isa, &input, opaque(&mut out))
                });
                let errors = errors(&out, |i| {
                    let (l, v, a) = (f64::from(l[i]), at(input.n_dot_v, i), at(input.alpha, i));
                    let f = input
                        .f0
                        .map_or(1.0, |f0| f_schlick(at(f0, i), f64::from(u[i])));
                    d_ggx(f64::from(h[i]), a) * v_ggx(l, v, a) * f * l
                });
                rows.push(self.row(("specular", variant), isa, Some(needs), ns, errors));
            }
        }
        rows
    }

    fn vectors(&self) -> Vec<Row> {
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
        let lobe = Specular {
            ggx: Ggx::new(f64::from(0.3f32)),
            fresnel: Fresnel::Schlick {
                f0: [f64::from(0.04f32); 3],
            },
        };
        let truth = |i: usize| {
            let wide = |v: Vec3| v.to_array().map(f64::from);
            lobe.eval_cos(wide(l[i]), wide(v[i]))[0]
        };
        let mut out = vec![0.0; COUNT];
        let mut rows = Vec::new();
        for isa in Isa::available() {
            let ns = time(self.effort, COUNT, || {
                batch::specular_vectors(isa, &input, opaque(&mut out))
            });
            rows.push(self.row(
                ("specular_vectors", "batch"),
                isa,
                Some((2.0, 3.0)),
                ns,
                errors(&out, truth),
            ));
            let ns = time(self.effort, COUNT, || {
                batch::specular_vec3(isa, &l, &v, 0.3, Some(0.04), opaque(&mut out));
            });
            rows.push(self.row(
                ("specular_vectors", "vec3"),
                isa,
                Some((2.0, 3.0)),
                ns,
                errors(&out, truth),
            ));
        }
        rows
    }

    fn call(&self) -> Vec<Row> {
        let (l, v) = (directions(5), directions(6));
        let f0 = [0.9, 0.5, 0.2];
        let lobe = Specular {
            ggx: Ggx::new(0.3f32),
            fresnel: Fresnel::Schlick { f0 },
        };
        let ns = time(self.effort, COUNT, || {
            // By reference: a copy that is read back in other pieces than it was written in
            // costs more than the formula.
            for (l, v) in l.iter().zip(&v) {
                opaque(lobe.eval_cos(*opaque(l), *opaque(v)));
            }
        });
        let wide = |v: Vec3| v.to_array().map(f64::from);
        let truth = Specular {
            ggx: Ggx::new(f64::from(0.3f32)),
            fresnel: Fresnel::Schlick {
                f0: f0.map(f64::from),
            },
        };
        let out: Vec<f32> = l
            .iter()
            .zip(&v)
            .map(|(&l, &v)| lobe.eval_cos(l, v)[0])
            .collect();
        let errors = errors(&out, |i| truth.eval_cos(wide(l[i]), wide(v[i]))[0]);
        vec![self.row(("specular_rgb", "call"), Isa::BASELINE, None, ns, errors)]
    }

    fn conductor(&self) -> Vec<Row> {
        let u = many(&mut Numbers(7), 0.0);
        // Gold.
        let (n, k) = ([0.143f32, 0.375, 1.442], [3.983f32, 2.386, 1.603]);
        let colors = [0, 1, 2].map(|i| Conductor::new(n[i], k[i]));
        let [mut r, mut g, mut b] = [0; 3].map(|_| vec![0.0; COUNT]);
        let mut rows = Vec::new();
        for isa in Isa::available() {
            let ns = time(self.effort, COUNT, || {
                batch::conductor_rgb(isa, &colors, &u, opaque([&mut r, &mut g, &mut b]));
            });
            let errors = errors(&r, |i| {
                f_conductor(f64::from(n[0]), f64::from(k[0]), f64::from(u[i]))
            });
            rows.push(self.row(
                ("conductor_rgb", "batch"),
                isa,
                Some((3.0, 0.0)),
                ns,
                errors,
            ));
        }
        rows
    }

    fn sample(&self) -> Vec<Row> {
        let mut numbers = Numbers(8);
        let [u0, u1] = [0; 2].map(|_| many(&mut numbers, 0.0));
        let [mut x, mut y, mut z, mut pdf, mut weight] = [0; 5].map(|_| vec![0.0; COUNT]);
        let v = Vec3::new(0.48, -0.36, 0.8);
        let ggx = Ggx::new(f64::from(0.4f32));
        let mut rows = Vec::new();
        for isa in Isa::available() {
            let ns = time(self.effort, COUNT, || {
                let l = [&mut x[..], &mut y, &mut z];
                let out = Samples {
                    l,
                    pdf: &mut pdf,
                    weight: &mut weight,
                };
                batch::sample(isa, v, 0.4, [&u0, &u1], opaque(out));
            });
            let errors = errors(&weight, |i| {
                let u = [f64::from(u0[i]), f64::from(u1[i])];
                ggx.sample(v.to_array().map(f64::from), u, Sampler::BoundedCap)
                    .weight
            });
            rows.push(self.row(("sample", "batch"), isa, Some((3.0, 2.0)), ns, errors));
        }
        rows
    }

    fn walk(&self) -> Vec<Row> {
        let [mut x, mut y, mut z] = [0; 3].map(|_| vec![0.0; COUNT]);
        let mut bounces = vec![0; COUNT];
        let v = Vec3::new(0.48, -0.36, 0.8);
        let mut rows = Vec::new();
        for isa in Isa::available() {
            let ns = time(self.effort, COUNT, || {
                let l = [&mut x[..], &mut y, &mut z];
                walk_mirrors(
                    isa,
                    v,
                    0.5,
                    1,
                    opaque(Walks {
                        l,
                        bounces: &mut bounces,
                    }),
                );
            });
            rows.push(self.row(("walk", "batch"), isa, None, ns, Vec::new()));
        }
        rows
    }
}

fn directions(seed: u64) -> Vec<Vec3> {
    let mut numbers = Numbers(seed);
    let mut one = || {
        let (z, phi) = (
            numbers.between((0.001, 1.0)),
            numbers.between((0.0, std::f64::consts::TAU)),
        );
        let sin = ((1.0 - z) * (1.0 + z)).sqrt();
        Vec3::from_array([sin * phi.cos(), sin * phi.sin(), z].map(|x| x as f32))
    };
    (0..COUNT).map(|_| one()).collect()
}
