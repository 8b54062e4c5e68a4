//! The same batches on all cores at once.

use super::batches::{Aligned, COUNT, Drawing, SAMPLE, specular};
use super::{Effort, Limit, Needs, Numbers, Row, opaque};
use brdf::batch::Isa;
use std::hint;
use std::num::NonZero;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread::{available_parallelism, scope, yield_now};
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
        let row = Row::new("all_cores", format!("{variant}, {threads} threads"), ns);
        let row = row.on(isa.name());
        match limit {
            Some(limit) => needs.share(limit, threads, row),
            None => row,
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

/// Where threads wait for each other without sleeping: one that has to be woken comes a tenth of
/// a run later than the others.
struct Meeting {
    threads: usize,
    arrived: AtomicUsize,
}

impl Meeting {
    fn of(threads: usize) -> Meeting {
        let arrived = AtomicUsize::new(0);
        Meeting { threads, arrived }
    }

    fn wait(&self) {
        let place = self.arrived.fetch_add(1, Ordering::AcqRel);
        let all = (place / self.threads + 1) * self.threads;
        let mut spins = 0u32;
        while self.arrived.load(Ordering::Acquire) < all {
            // The one that is waited for may need this core.
            spins += 1;
            if spins.is_multiple_of(1 << 12) {
                yield_now();
            }
            hint::spin_loop();
        }
    }
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
    let meeting = Meeting::of(threads);
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
