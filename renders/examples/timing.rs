//! Where the time of a picture goes: `cargo run --release -p renders --example timing -- [SIZE]`.

use renders::{Backend, Fingerprint, Options, Precision, Scene, raw, render};
use std::sync::atomic::AtomicBool;
use std::time::Instant;

/// Best wall-clock time of several runs and mean processor time of all of them, in milliseconds.
/// The machine's noise only ever adds to the first and hardly touches the second.
fn time(what: &str, mut work: impl FnMut()) {
    const RUNS: u32 = 30;
    let before = processor_ticks();
    let best = (0..RUNS)
        .map(|_| {
            let start = Instant::now();
            work();
            start.elapsed().as_secs_f64() * 1e3
        })
        .fold(f64::INFINITY, f64::min);
    // A tick is a hundredth of a second on Linux; elsewhere there is no such figure.
    let processor = before
        .zip(processor_ticks())
        .map(|(a, b)| 10.0 * (b - a) / f64::from(RUNS));
    let processor = processor.map_or("?".to_owned(), |ms| format!("{ms:.1}"));
    println!("{what:28} {best:8.2} ms, {processor:>6} ms of processor");
}

fn processor_ticks() -> Option<f64> {
    let stat = std::fs::read_to_string("/proc/self/stat").ok()?;
    let fields: Vec<&str> = stat.rsplit(')').next()?.split_whitespace().collect();
    fields.get(11)?.parse().ok()
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let size = std::env::args()
        .nth(1)
        .map_or(Ok(512), |text| text.parse())?;
    let library = formula::Library::new();
    let right = formula::parse("d_ggx() * v_ggx() * f_schlick() * n_dot_l")?;
    let wrong =
        formula::parse("d_ggx() * v_ggx() * f_schlick() * n_dot_l / (4 * n_dot_l * n_dot_v)")?;
    let fingerprint = Fingerprint {
        lesson: "timing",
        id: "timing",
        title: "Timing".to_owned(),
        caption: "How long a picture takes".to_owned(),
        library: &library,
        right: &right,
        wrong: &wrong,
        scene: Scene::new(0.7, 0.95, 60.0),
    };
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
