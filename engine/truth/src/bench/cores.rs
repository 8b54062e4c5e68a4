//! The same batches on all cores at once.

use super::batches::{Aligned, COUNT, Drawing, SAMPLE, specular};
use super::{Effort, Limit, Needs, Numbers, Row, opaque};
use brdf::batch::Isa;
use std::num::NonZero;
use std::sync::Barrier;
use std::thread::{available_parallelism, scope};
use std::time::{Duration, Instant};

/// Of each thread between two meetings: short beside what a scheduler gives it.
const RUN: Duration = Duration::from_micros(400);

pub(super) fn rows(effort: Effort, limits: &[Limit]) -> Vec<Row> {
    let isa = Isa::best();
    let threads = available_parallelism().map_or(1, NonZero::get);
    let limit = limits.iter().find(|limit| limit.isa == isa.name());
    let row = |variant: &str, (divisions, roots, products), ns: f64| {
        let needs = Needs {
            divisions,
            roots,
            products,
        };
        let least = limit.map(|limit| needs.least(limit));
        Row {
            group: "all_cores".into(),
            variant: format!("{variant}, {threads} threads"),
            precision: "f32",
            isa: isa.name(),
            ns,
            limit_ratio: least.as_ref().map(|(least, _)| least / threads as f64 / ns),
            needs: least.map(|(_, needs)| needs),
            max_ulp: 0.0,
            p999_ulp: 0.0,
            median_ulp: 0.0,
            error_unit: "none",
            pareto: false,
        }
    };
    let cosines = together(effort, threads, || {
        let mut numbers = Numbers(2);
        let columns = [0; 6].map(|_| Aligned::random(&mut numbers, 0.01));
        let mut out = Aligned::zeros();
        move || specular(isa, "batch", &columns, opaque(&mut out))
    });
    let samples = together(effort, threads, || {
        let mut drawing = Drawing::new();
        move || drawing.draw(isa)
    });
    vec![
        row("specular/batch", (1.0, 2.0, 18.0), cosines),
        row("sample/batch", SAMPLE, samples),
    ]
}

/// Nanoseconds for one evaluation of all threads together, from the first that begins to the
/// last that ends, in the best of many runs. Each thread has data of its own.
fn together<F: FnMut()>(effort: Effort, threads: usize, make: impl Fn() -> F + Sync) -> f64 {
    let calls = {
        let mut call = make();
        call();
        let start = Instant::now();
        call();
        let once = start.elapsed().as_secs_f64().max(1e-9);
        ((RUN.as_secs_f64() / once) as usize).clamp(1, 100_000)
    };
    let runs = (effort.time.as_secs_f64() / RUN.as_secs_f64()).clamp(3.0, 1000.0) as usize;
    let meeting = Barrier::new(threads);
    let work = || {
        let mut call = make();
        call();
        let run = |_| {
            meeting.wait();
            let start = Instant::now();
            for _ in 0..calls {
                call();
            }
            (start, Instant::now())
        };
        (0..runs).map(run).collect::<Vec<_>>()
    };
    let times: Vec<Vec<(Instant, Instant)>> = scope(|scope| {
        let workers: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
        let joined = workers.into_iter().filter_map(|worker| worker.join().ok());
        joined.collect()
    });
    let wall = |run: usize| {
        let start = times.iter().map(|times| times[run].0).min();
        let end = times.iter().map(|times| times[run].1).max();
        let time = start.zip(end).map(|(start, end)| end - start);
        time.map_or(f64::INFINITY, |time| time.as_secs_f64())
    };
    let best = (0..runs).map(wall).fold(f64::INFINITY, f64::min);
    best * 1e9 / (threads * calls * COUNT) as f64
}
