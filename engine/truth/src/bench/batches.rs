//! Many evaluations at once, in every instruction set of the machine.

use super::{Effort, Limit, Needs, Numbers, Row, Stopwatch, opaque};
use brdf::batch::{self, Conductor, Cosines, Input, Isa, Samples, Vectors};
use brdf::glam::Vec3;
use brdf::walk::{Walks, walk_mirrors};
use brdf::{Fresnel, Ggx, Sampler, Specular, d_ggx, f_conductor, f_schlick, v_ggx};
use std::ops::{Deref, DerefMut};
use std::rc::Rc;
use std::time::Duration;

/// Elements of a batch: eight slices of them fit in a second-level cache.
pub(super) const COUNT: usize = 4096;

/// Over how many rounds the time of each row is spread.
const ROUNDS: u32 = 40;

/// Numbers that begin where a cache line does, as those of an allocator need not.
pub(super) struct Aligned {
    all: Vec<f32>,
    start: usize,
}

impl Aligned {
    pub(super) fn new(values: impl Iterator<Item = f32>) -> Aligned {
        // Longest vector registers are 64 bytes.
        let mut all = vec![0.0; COUNT + 16];
        let start = all.as_ptr().align_offset(64).min(16);
        all[start..]
            .iter_mut()
            .zip(values)
            .for_each(|(to, value)| *to = value);
        Aligned { all, start }
    }

    pub(super) fn zeros() -> Aligned {
        Aligned::new(std::iter::empty())
    }

    pub(super) fn random(numbers: &mut Numbers, low: f64) -> Aligned {
        Aligned::new((0..COUNT).map(|_| numbers.between((low, 1.0)) as f32))
    }
}

impl Deref for Aligned {
    type Target = [f32];
    fn deref(&self) -> &[f32] {
        &self.all[self.start..self.start + COUNT]
    }
}

impl DerefMut for Aligned {
    fn deref_mut(&mut self) -> &mut [f32] {
        &mut self.all[self.start..self.start + COUNT]
    }
}

type Call = Box<dyn FnMut()>;

/// Divisions, square roots and products of an instruction set.
struct Units {
    isa: &'static str,
    watches: [Stopwatch<Call>; 5],
}

impl Units {
    fn new(isa: Isa) -> Units {
        let mut numbers = Numbers(1);
        let mut input = || Aligned::random(&mut numbers, 0.5);
        let (a, b, c, d, e, f) = (input(), input(), input(), input(), input(), input());
        let [mut x, mut y, mut z, mut v, mut w] = [0; 5].map(|_| Aligned::zeros());
        let calls: [Call; 5] = [
            Box::new(move || batch::divide(isa, &a, &b, opaque(&mut x))),
            Box::new(move || batch::square_root(isa, &c, opaque(&mut y))),
            Box::new(move || batch::multiply(isa, &d, opaque(&mut z))),
            Box::new(move || batch::divide_beside(isa, &e, opaque(&mut v))),
            Box::new(move || batch::square_root_beside(isa, &f, opaque(&mut w))),
        ];
        Units {
            isa: isa.name(),
            watches: calls.map(|call| Stopwatch::new(COUNT, call)),
        }
    }

    fn round(&mut self, time: Duration, least: usize) {
        for watch in &mut self.watches {
            watch.round(time, least);
        }
    }

    fn limit(&self) -> Limit {
        let [division, root, products, divisions_beside, roots_beside] =
            self.watches.each_ref().map(Stopwatch::ns);
        let product_ns = products / batch::PRODUCTS as f64;
        let extra =
            |beside: f64| ((beside - products) / product_ns).max(0.0) / batch::BESIDE as f64;
        Limit {
            isa: self.isa,
            division_ns: division,
            square_root_ns: root,
            product_ns,
            division_products: extra(divisions_beside),
            root_products: extra(roots_beside),
        }
    }
}

pub(super) fn limits(effort: Effort) -> Vec<Limit> {
    let measure = |isa: Isa| {
        let mut units = Units::new(isa);
        units.round(3 * effort.time, 5);
        units.limit()
    };
    Isa::available().into_iter().map(measure).collect()
}

/// A row whose time is being taken.
struct Subject {
    name: (&'static str, &'static str),
    isa: &'static str,
    needs: Option<Needs>,
    watch: Stopwatch<Call>,
    errors: Vec<f64>,
}

/// All of them.
pub(super) struct Batches {
    effort: Effort,
    rounds: u32,
    units: Vec<Units>,
    /// Group by group.
    subjects: Vec<Vec<Subject>>,
}

/// Divisions, square roots and products of an evaluation.
fn needs(divisions: f64, roots: f64, products: f64) -> Option<Needs> {
    Some(Needs {
        divisions,
        roots,
        products,
    })
}

impl Batches {
    pub(super) fn new(effort: Effort) -> Batches {
        Batches {
            effort,
            rounds: 0,
            units: Isa::available().into_iter().map(Units::new).collect(),
            subjects: vec![cosines(), vectors(), call(), conductor(), sample(), walk()],
        }
    }

    /// Every row once more, for a short while.
    pub(super) fn round(&mut self) {
        let time = self.effort.time / ROUNDS;
        for units in &mut self.units {
            // Everything is compared with them.
            units.round(2 * time, 3);
        }
        for subject in self.subjects.iter_mut().flatten() {
            subject.watch.round(time, 1);
        }
        self.rounds += 1;
    }

    /// The rounds that are missing, and what all have found; the units with the best of `limits`.
    pub(super) fn finish(mut self, limits: &[Limit]) -> Vec<Vec<Row>> {
        while self.rounds < ROUNDS {
            self.round();
        }
        let again = self.units.iter().map(Units::limit);
        let limits: Vec<Limit> = limits.iter().copied().zip(again).map(best).collect();
        let row = |subject: Subject| {
            let limit = limits.iter().find(|limit| limit.isa == subject.isa);
            let mut row = Row::new(subject.name.0, subject.name.1, subject.watch.ns());
            row.isa = subject.isa;
            if !subject.errors.is_empty() {
                row = row.with_errors("ulp", subject.errors);
            }
            match subject.needs.zip(limit) {
                Some((needs, limit)) => needs.share(limit, 1, row),
                None => row,
            }
        };
        let groups = self.subjects.into_iter();
        groups
            .map(|group| group.into_iter().map(row).collect())
            .collect()
    }
}

/// The lesser figures of two measurements of the same units.
fn best((a, b): (Limit, Limit)) -> Limit {
    Limit {
        isa: a.isa,
        division_ns: a.division_ns.min(b.division_ns),
        square_root_ns: a.square_root_ns.min(b.square_root_ns),
        product_ns: a.product_ns.min(b.product_ns),
        division_products: a.division_products.min(b.division_products),
        root_products: a.root_products.min(b.root_products),
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

fn subject(
    name: (&'static str, &'static str),
    isa: Isa,
    needs: Option<Needs>,
    errors: Vec<f64>,
    call: impl FnMut() + 'static,
) -> Subject {
    Subject {
        name,
        isa: isa.name(),
        needs,
        watch: Stopwatch::new(COUNT, Box::new(call)),
        errors,
    }
}

fn cosines() -> Vec<Subject> {
    // Hoisted, the root of the view is taken once, and more of the products.
    let variants = [
        ("batch", needs(1.0, 2.0, 18.0)),
        ("hoisted", needs(1.0, 1.0, 12.0)),
        ("perfect", needs(1.0, 1.0, 7.0)),
    ];
    let mut subjects = Vec::new();
    for isa in Isa::available() {
        for (variant, needs) in variants {
            let mut numbers = Numbers(2);
            let columns = [0; 6].map(|_| Aligned::random(&mut numbers, 0.01));
            let mut out = Aligned::zeros();
            specular(isa, variant, &columns, &mut out);
            let errors = {
                let input = input(variant, &columns);
                let at = |input: Input, i: usize| match input {
                    Input::Each(values) => f64::from(values[i]),
                    Input::All(value) => f64::from(value),
                };
                errors(&out, |i| {
                    let l = f64::from(input.n_dot_l[i]);
                    let (v, a) = (at(input.n_dot_v, i), at(input.alpha, i));
                    let u = f64::from(input.v_dot_h[i]);
                    let f = input.f0.map_or(1.0, |f0| f_schlick(at(f0, i), u));
                    d_ggx(f64::from(input.n_dot_h[i]), a) * v_ggx(l, v, a) * f * l
                })
            };
            let call = move || specular(isa, variant, &columns, opaque(&mut out));
            subjects.push(subject(("specular", variant), isa, needs, errors, call));
        }
    }
    subjects
}

/// Arguments of a variant from six columns.
fn input<'a>(variant: &str, [l, v, h, u, alpha, f0]: &'a [Aligned; 6]) -> Cosines<'a> {
    let each = Cosines {
        n_dot_l: l,
        n_dot_v: Input::Each(v),
        n_dot_h: h,
        v_dot_h: u,
        alpha: Input::Each(alpha),
        f0: Some(Input::Each(f0)),
    };
    if variant == "batch" {
        return each;
    }
    Cosines {
        n_dot_v: Input::All(0.6),
        alpha: Input::All(0.3),
        f0: (variant == "hoisted").then_some(Input::All(0.04)),
        ..each
    }
}

pub(super) fn specular(isa: Isa, variant: &str, columns: &[Aligned; 6], out: &mut [f32]) {
    batch::specular(isa, &input(variant, columns), out);
}

/// Divisions, square roots and products from vectors, α and f0 the same for all.
const VECTORS: (f64, f64, f64) = (2.0, 3.0, 23.0);

fn vectors() -> Vec<Subject> {
    let lobe = |f0: f32| Specular {
        ggx: Ggx::new(f64::from(0.3f32)),
        fresnel: Fresnel::Schlick {
            f0: [f64::from(f0); 3],
        },
    };
    let needs = needs(VECTORS.0, VECTORS.1, VECTORS.2);
    let mut subjects = Vec::new();
    for isa in Isa::available() {
        let (l, v) = (directions(3), directions(4));
        let column = |of: &[Vec3], i: usize| Aligned::new(of.iter().map(|v| v[i]));
        let columns = [0, 1, 2].map(|i| [column(&l, i), column(&v, i)]);
        let wide = |v: Vec3| v.to_array().map(f64::from);
        let truth = |f0: f32| {
            let (lobe, l, v) = (lobe(f0), &l, &v);
            move |i: usize| lobe.eval_cos(wide(l[i]), wide(v[i]))[0]
        };

        let [mut soa, mut dark, mut aos] = [0; 3].map(|_| Aligned::zeros());
        let columns = Rc::new(columns);
        let evaluate = move |columns: &[[Aligned; 2]; 3], f0: f32, out: &mut [f32]| {
            let [[lx, vx], [ly, vy], [lz, vz]] = columns;
            let input = Vectors {
                l: [lx, ly, lz],
                v: [Input::Each(vx), Input::Each(vy), Input::Each(vz)],
                alpha: Input::All(0.3),
                f0: Some(Input::All(f0)),
            };
            batch::specular_vectors(isa, &input, out);
        };
        evaluate(&columns, 0.04, &mut soa);
        evaluate(&columns, 0.0, &mut dark);
        batch::specular_vec3(isa, &l, &v, 0.3, Some(0.04), &mut aos);
        let (soa_errors, aos_errors) = (errors(&soa, truth(0.04)), errors(&aos, truth(0.04)));
        let dark_errors = errors(&dark, truth(0.0));
        let name = |variant| ("specular_vectors", variant);
        let input = Rc::clone(&columns);
        let call = move || evaluate(&input, 0.04, opaque(&mut soa));
        subjects.push(subject(name("batch"), isa, needs, soa_errors, call));
        // Below 0.01 it is computed with more care.
        let call = move || evaluate(&columns, 0.0, opaque(&mut dark));
        subjects.push(subject(name("f0 0"), isa, needs, dark_errors, call));
        let call = move || batch::specular_vec3(isa, &l, &v, 0.3, Some(0.04), opaque(&mut aos));
        subjects.push(subject(name("vec3"), isa, needs, aos_errors, call));
    }
    subjects
}

fn call() -> Vec<Subject> {
    let (l, v) = (directions(5), directions(6));
    let f0 = [0.9, 0.5, 0.2];
    let lobe = Specular {
        ggx: Ggx::new(0.3f32),
        fresnel: Fresnel::Schlick { f0 },
    };
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
    let call = move || {
        // By reference: a copy that is read back in other pieces than it was written in
        // costs more than the formula.
        for (l, v) in l.iter().zip(&v) {
            opaque(lobe.eval_cos(*opaque(l), *opaque(v)));
        }
    };
    let name = ("specular_rgb", "call");
    vec![subject(name, Isa::BASELINE, None, errors, call)]
}

fn conductor() -> Vec<Subject> {
    // Gold.
    let (n, k) = ([0.143f32, 0.375, 1.442], [3.983f32, 2.386, 1.603]);
    let colors = [0, 1, 2].map(|i| Conductor::new(n[i], k[i]));
    let row = |isa: Isa| {
        let u = Aligned::random(&mut Numbers(7), 0.0);
        let [mut r, mut g, mut b] = [0; 3].map(|_| Aligned::zeros());
        batch::conductor_rgb(isa, &colors, &u, [&mut r, &mut g, &mut b]);
        let truth = |i: usize| f_conductor(f64::from(n[0]), f64::from(k[0]), f64::from(u[i]));
        let errors = errors(&r, truth);
        let call = move || {
            batch::conductor_rgb(isa, &colors, &u, opaque([&mut r, &mut g, &mut b]));
        };
        // Two polynomials of degree 4 for each colour, one of them without a highest factor.
        let name = ("conductor_rgb", "batch");
        subject(name, isa, needs(3.0, 0.0, 21.0), errors, call)
    };
    Isa::available().into_iter().map(row).collect()
}

/// What a batch of samples is made of.
pub(super) struct Drawing {
    u: [Aligned; 2],
    l: [Aligned; 3],
    pdf: Aligned,
    pub(super) weight: Aligned,
}

impl Drawing {
    const VIEW: Vec3 = Vec3::new(0.48, -0.36, 0.8);

    pub(super) fn new() -> Drawing {
        let mut numbers = Numbers(8);
        Drawing {
            u: [0; 2].map(|_| Aligned::random(&mut numbers, 0.0)),
            l: [0; 3].map(|_| Aligned::zeros()),
            pdf: Aligned::zeros(),
            weight: Aligned::zeros(),
        }
    }

    pub(super) fn draw(&mut self, isa: Isa) {
        let [x, y, z] = &mut self.l;
        let out = Samples {
            l: [x, y, z],
            pdf: &mut self.pdf,
            weight: &mut self.weight,
        };
        let [u0, u1] = &self.u;
        batch::sample(isa, Self::VIEW, 0.4, [u0, u1], opaque(out));
    }
}

/// Divisions, square roots and products of a sample with density and weight of the direction as
/// rounded.
pub(super) const SAMPLE: (f64, f64, f64) = (3.0, 2.0, 30.0);

fn sample() -> Vec<Subject> {
    let ggx = Ggx::new(f64::from(0.4f32));
    let row = |isa: Isa| {
        let mut drawing = Drawing::new();
        drawing.draw(isa);
        // Weight and density of the direction as rounded.
        let v = Drawing::VIEW.to_array().map(f64::from);
        let l = |i: usize| drawing.l.each_ref().map(|l| f64::from(l[i]));
        let mut errors_of = errors(&drawing.weight, |i| {
            ggx.weight(l(i), v, Sampler::BoundedCap)
        });
        let above: Vec<usize> = (0..COUNT).filter(|&i| drawing.l[2][i] > 0.0).collect();
        let pdf: Vec<f32> = above.iter().map(|&i| drawing.pdf[i]).collect();
        errors_of.extend(errors(&pdf, |i| {
            ggx.pdf(l(above[i]), v, Sampler::BoundedCap)
        }));
        let needs = needs(SAMPLE.0, SAMPLE.1, SAMPLE.2);
        let call = move || drawing.draw(isa);
        subject(("sample", "batch"), isa, needs, errors_of, call)
    };
    Isa::available().into_iter().map(row).collect()
}

fn walk() -> Vec<Subject> {
    let v = Vec3::new(0.48, -0.36, 0.8);
    let row = |isa: Isa| {
        let [mut x, mut y, mut z] = [0; 3].map(|_| Aligned::zeros());
        let mut bounces = vec![0; COUNT];
        let call = move || {
            let out = Walks {
                l: [&mut x, &mut y, &mut z],
                bounces: &mut bounces,
            };
            walk_mirrors(isa, v, 0.5, 1, opaque(out));
        };
        subject(("walk", "batch"), isa, None, Vec::new(), call)
    };
    Isa::available().into_iter().map(row).collect()
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
