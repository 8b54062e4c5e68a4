//! Where the time of a picture goes: `cargo run --release -p renders --example timing -- [SIZE]`.

mod common;

use common::{Bug, TWICE, processor, rough_metal};
use renders::{Backend, Options, Precision, raw, render};
use std::sync::atomic::AtomicBool;
use std::time::Instant;

/// Best wall-clock time of several runs and mean processor time of all of them, in milliseconds.
/// The machine's noise only ever adds to the first and hardly touches the second.
fn time(what: &str, mut work: impl FnMut()) {
    const RUNS: u32 = 30;
    let before = processor();
    let best = (0..RUNS)
        .map(|_| {
            let start = Instant::now();
            work();
            start.elapsed().as_secs_f64() * 1e3
        })
        .fold(f64::INFINITY, f64::min);
    let processor = before
        .zip(processor())
        .map(|(a, b)| (b - a) / f64::from(RUNS));
    let processor = processor.map_or("?".to_owned(), |ms| format!("{ms:.1}"));
    println!("{what:28} {best:8.2} ms, {processor:>6} ms of processor");
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let size = std::env::args()
        .nth(1)
        .map_or(Ok(512), |text| text.parse())?;
    let bug = Bug::new(TWICE)?;
    let fingerprint = bug.on(rough_metal());
    let options = Options {
        size,
        backend: Backend::Cpu,
        ..Options::default()
    };
    let cancel = AtomicBool::new(false);
    let picture = render(&fingerprint, &options, &cancel)?;
    time("panels, raw values", || drop(raw(&fingerprint, &options)));
    let narrow = Options {
        precision: Precision::F32,
        ..options
    };
    time("panels, raw values, f32", || {
        drop(raw(&fingerprint, &narrow))
    });
    time("picture, f32", || {
        drop(render(&fingerprint, &narrow, &cancel))
    });
    let all = Options {
        skip: false,
        ..options
    };
    time("the same, no skipping", || drop(raw(&fingerprint, &all)));
    time("picture", || drop(render(&fingerprint, &options, &cancel)));
    time("PNG", || drop(picture.png()));
    let compact = Options {
        size: 256,
        compact: true,
        ..options
    };
    time("compact, 256", || {
        drop(render(&fingerprint, &compact, &cancel))
    });
    if let Ok(adapter) = renders::gpu_adapter() {
        let gpu = Options {
            backend: Backend::Gpu,
            ..options
        };
        println!("on {adapter}:");
        time("picture", || drop(render(&fingerprint, &gpu, &cancel)));
    }
    Ok(())
}
