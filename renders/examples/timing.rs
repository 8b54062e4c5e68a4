//! Where the time of a picture goes: `cargo run --release -p renders --example timing -- [SIZE]`.

use renders::{Backend, Fingerprint, Options, Scene, raw, render};
use std::sync::atomic::AtomicBool;
use std::time::Instant;

/// Best of several runs, in milliseconds: the machine's noise only ever adds.
fn best(mut work: impl FnMut()) -> f64 {
    (0..9)
        .map(|_| {
            let start = Instant::now();
            work();
            start.elapsed().as_secs_f64() * 1e3
        })
        .fold(f64::INFINITY, f64::min)
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
        scene: Scene {
            roughness: 0.7,
            f0: 0.95,
            light_deg: 60.0,
            others: Default::default(),
        },
    };
    let options = Options {
        size,
        backend: Backend::Cpu,
        ..Options::default()
    };
    let cancel = AtomicBool::new(false);
    let picture = render(&fingerprint, &options, &cancel)?;
    println!(
        "panels, raw values      {:8.2} ms",
        best(|| drop(raw(&fingerprint, &options)))
    );
    let all = Options {
        skip: false,
        ..options
    };
    println!(
        "the same, no skipping   {:8.2} ms",
        best(|| drop(raw(&fingerprint, &all)))
    );
    println!(
        "picture                 {:8.2} ms",
        best(|| drop(render(&fingerprint, &options, &cancel)))
    );
    println!(
        "PNG                     {:8.2} ms",
        best(|| drop(picture.png()))
    );
    let compact = Options {
        size: 256,
        compact: true,
        ..options
    };
    println!(
        "compact, 256            {:8.2} ms",
        best(|| drop(render(&fingerprint, &compact, &cancel)))
    );
    if let Ok(adapter) = renders::gpu_adapter() {
        let gpu = Options {
            backend: Backend::Gpu,
            ..options
        };
        println!(
            "picture on {adapter}: {:.2} ms",
            best(|| drop(render(&fingerprint, &gpu, &cancel)))
        );
    }
    Ok(())
}
