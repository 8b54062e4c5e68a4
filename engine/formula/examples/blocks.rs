//! What a formula costs a point in blocks, against compiled code of the same operations:
//! `cargo run --release -p formula --example blocks`.
//!
//! The loops are what a programmer would write by hand for that one formula, and are compiled
//! for the same set of instructions. Both run by turns in one process; the least of many short
//! repetitions counts.

use brdf::Real;
use brdf::batch::Isa;
use formula::{Column, Library, Scratch};
use std::hint::black_box;
use std::time::Instant;

const POINTS: usize = 2048;
const ROUNDS: usize = 4000;
const NAMES: [&str; 5] = ["n_dot_l", "n_dot_v", "n_dot_h", "roughness", "f0"];

/// A formula as a lesson writes it, and as a programmer does.
trait Formula {
    const NAME: &'static str;
    const TEXT: &'static str;
    fn at<R: Real>(l: R, v: R, h: R, roughness: R, f0: R) -> R;
}

/// The specular lobe from operations alone.
struct Textbook;

impl Formula for Textbook {
    const NAME: &'static str = "textbook";
    const TEXT: &'static str = "roughness^4 / (pi * (n_dot_h^2 * (roughness^4 - 1) + 1)^2) \
        * 0.5 / (n_dot_l * sqrt(roughness^4 + (1 - roughness^4) * n_dot_v^2) \
        + n_dot_v * sqrt(roughness^4 + (1 - roughness^4) * n_dot_l^2)) \
        * (f0 + (1 - f0) * (1 - n_dot_v)^5) * n_dot_l";
    #[inline(always)]
    fn at<R: Real>(l: R, v: R, h: R, roughness: R, f0: R) -> R {
        let c = R::of;
        let a2 = roughness * roughness * (roughness * roughness);
        let t = h * h * (a2 - c(1.0)) + c(1.0);
        let d = a2 / (c(std::f64::consts::PI) * (t * t));
        let s = |x: R| (a2 + (c(1.0) - a2) * (x * x)).sqrt();
        let below = l * s(v) + v * s(l);
        d * c(0.5) / below * (f0 + (c(1.0) - f0) * (c(1.0) - v).pow5()) * l
    }
}

/// Sums and products only, where every load and store shows.
struct Cheap;

impl Formula for Cheap {
    const NAME: &'static str = "no quotient";
    const TEXT: &'static str = "(n_dot_h^2 * roughness + n_dot_l * n_dot_v - f0 * n_dot_l) \
        * (1 - n_dot_v)^5 + (n_dot_l - n_dot_h) * (n_dot_v + n_dot_h)";
    #[inline(always)]
    fn at<R: Real>(l: R, v: R, h: R, roughness: R, f0: R) -> R {
        (h * h * roughness + l * v - f0 * l) * (R::of(1.0) - v).pow5() + (l - h) * (v + h)
    }
}

/// The core's three functions times the cosine.
#[inline(always)]
fn lobe<R: Real>([l, v, h]: [R; 3], alpha: R, f0: R, v_dot_h: R) -> R {
    brdf::d_ggx(h, alpha) * brdf::v_ggx(l, v, alpha) * brdf::f_schlick(f0, v_dot_h) * l
}

/// The right side of a lesson's fingerprint.
struct Right;

impl Formula for Right {
    const NAME: &'static str = "right";
    const TEXT: &'static str = "d_ggx() * v_ggx() * f_schlick(v_dot_h = n_dot_h) * n_dot_l";
    #[inline(always)]
    fn at<R: Real>(l: R, v: R, h: R, roughness: R, f0: R) -> R {
        lobe([l, v, h], roughness * roughness, f0, h)
    }
}

/// Divided twice.
struct Twice;

impl Formula for Twice {
    const NAME: &'static str = "twice";
    const TEXT: &'static str =
        "d_ggx() * v_ggx() * f_schlick(v_dot_h = n_dot_h) * n_dot_l / (4 * n_dot_l * n_dot_v)";
    #[inline(always)]
    fn at<R: Real>(l: R, v: R, h: R, roughness: R, f0: R) -> R {
        lobe([l, v, h], roughness * roughness, f0, h) / (R::of(4.0) * l * v)
    }
}

/// Roughness where alpha belongs.
struct Unsquared;

impl Formula for Unsquared {
    const NAME: &'static str = "unsquared";
    const TEXT: &'static str = "d_ggx(alpha = roughness) * v_ggx(alpha = roughness) \
        * f_schlick(v_dot_h = n_dot_h) * n_dot_l";
    #[inline(always)]
    fn at<R: Real>(l: R, v: R, h: R, roughness: R, f0: R) -> R {
        lobe([l, v, h], roughness, f0, h)
    }
}

/// Another cosine in the Fresnel term.
struct Cosine;

impl Formula for Cosine {
    const NAME: &'static str = "cosine";
    const TEXT: &'static str = "d_ggx() * v_ggx() * f_schlick(v_dot_h = n_dot_v) * n_dot_l";
    #[inline(always)]
    fn at<R: Real>(l: R, v: R, h: R, roughness: R, f0: R) -> R {
        lobe([l, v, h], roughness * roughness, f0, v)
    }
}

/// V written out, as the lesson about it does.
struct WrittenOut;

impl Formula for WrittenOut {
    const NAME: &'static str = "V written";
    const TEXT: &'static str = "d_ggx() * 0.5 \
        / (n_dot_l * sqrt(roughness^4 + (1 - roughness^4) * n_dot_v^2) \
        + n_dot_v * sqrt(roughness^4 + (1 - roughness^4) * n_dot_l^2)) \
        * f_schlick(v_dot_h = n_dot_h) * n_dot_l";
    #[inline(always)]
    fn at<R: Real>(l: R, v: R, h: R, roughness: R, f0: R) -> R {
        let a2 = roughness * roughness * (roughness * roughness);
        let s = |x: R| (a2 + (R::of(1.0) - a2) * (x * x)).sqrt();
        let below = l * s(v) + v * s(l);
        brdf::d_ggx(h, roughness * roughness) * R::of(0.5) / below * brdf::f_schlick(f0, h) * l
    }
}

struct Columns<R> {
    l: Vec<R>,
    v: Vec<R>,
    h: Vec<R>,
    roughness: R,
    f0: R,
}

#[inline(always)]
fn body<F: Formula, R: Real>(columns: &Columns<R>, out: &mut [R]) {
    let n = out.len();
    let (l, v, h) = (&columns.l[..n], &columns.v[..n], &columns.h[..n]);
    for i in 0..n {
        out[i] = F::at(l[i], v[i], h[i], columns.roughness, columns.f0);
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn avx2<F: Formula, R: Real>(columns: &Columns<R>, out: &mut [R]) {
    body::<F, R>(columns, out);
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,avx512f,avx512vl,avx512dq,avx512bw")]
fn avx512<F: Formula, R: Real>(columns: &Columns<R>, out: &mut [R]) {
    body::<F, R>(columns, out);
}

fn by_hand<F: Formula, R: Real>(isa: Isa, columns: &Columns<R>, out: &mut [R]) {
    match isa.name() {
        // SAFETY: an `Isa` names only what this machine has.
        #[cfg(target_arch = "x86_64")]
        "avx512" => unsafe { avx512::<F, R>(columns, out) },
        // SAFETY: as above.
        #[cfg(target_arch = "x86_64")]
        "avx2" => unsafe { avx2::<F, R>(columns, out) },
        _ => body::<F, R>(columns, out),
    }
}

trait Precision: Real + PartialEq {
    const NAME: &'static str;
    fn block(program: &formula::Program, c: &Columns<Self>, out: &mut [Self], s: &mut Scratch);
}

macro_rules! precision {
    ($real:ident, $block:ident) => {
        impl Precision for $real {
            const NAME: &'static str = stringify!($real);
            fn block(
                program: &formula::Program,
                c: &Columns<$real>,
                out: &mut [$real],
                s: &mut Scratch,
            ) {
                let inputs = [
                    Column::Varying(&c.l[..]),
                    Column::Varying(&c.v),
                    Column::Varying(&c.h),
                    Column::Uniform(c.roughness),
                    Column::Uniform(c.f0),
                ];
                program.$block(&inputs, out, s);
            }
        }
    };
}
precision!(f64, eval_block_f64);
precision!(f32, eval_block_f32);

fn measure<F: Formula, R: Precision>() {
    let library = Library::new();
    let expr = formula::parse(F::TEXT).unwrap_or_else(|error| panic!("{error}"));
    let program = library
        .compile(&expr, &NAMES)
        .unwrap_or_else(|error| panic!("{error}"));
    let column = |step: f64| -> Vec<R> {
        let at = |i: usize| 0.05 + 0.9 * (step * (i + 1) as f64).fract();
        (0..POINTS).map(|i| R::of(at(i))).collect()
    };
    let columns = Columns {
        l: column(0.7549),
        v: column(0.5698),
        h: column(0.4302),
        roughness: R::of(0.4),
        f0: R::of(0.04),
    };
    for isa in Isa::available() {
        let mut scratch = Scratch::on(isa);
        let (mut ours, mut theirs) = (vec![R::of(0.0); POINTS], vec![R::of(0.0); POINTS]);
        let (mut block, mut hand) = (f64::INFINITY, f64::INFINITY);
        for _ in 0..ROUNDS {
            let start = Instant::now();
            R::block(
                black_box(&program),
                &columns,
                black_box(&mut ours),
                &mut scratch,
            );
            block = block.min(start.elapsed().as_secs_f64());
            let start = Instant::now();
            by_hand::<F, R>(isa, black_box(&columns), black_box(&mut theirs));
            hand = hand.min(start.elapsed().as_secs_f64());
        }
        let apart = ours.iter().zip(&theirs).map(|(a, b)| {
            let (a, b) = (a.to_f64(), b.to_f64());
            (a - b).abs() / b.abs() / R::EPSILON
        });
        let ns = |seconds: f64| 1e9 * seconds / POINTS as f64;
        println!(
            "{:12} {} {:9} {:7.3} ns {:7.3} ns {:6.2} x   {:.1} ulp apart",
            F::NAME,
            R::NAME,
            isa.name(),
            ns(block),
            ns(hand),
            block / hand,
            apart.fold(0.0, f64::max),
        );
    }
}

fn both<F: Formula>() {
    measure::<F, f64>();
    measure::<F, f32>();
}

fn main() {
    println!("formula      in  on           block   by hand   ratio");
    both::<Textbook>();
    both::<Right>();
    both::<Twice>();
    both::<Unsquared>();
    both::<Cosine>();
    both::<WrittenOut>();
    both::<Cheap>();
}
