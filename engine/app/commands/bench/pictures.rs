//! Pictures: the time of both panels of a fingerprint against what it does to their values.

use std::time::{Duration, Instant};

use formula::Library;
use renders::{
    Backend, Fingerprint, Light, Options, Precision, Raw, Scene, device_ms, gpu_adapter, raw,
};
use truth::bench::{Row, mark_pareto};

use crate::exit::Failure;

const RIGHT: &str = "d_ggx() * v_ggx() * f_schlick() * n_dot_l";
/// Divided by 4 N·L N·V once more.
const WRONG: &str = "d_ggx() * v_ggx() * f_schlick() / (4 * n_dot_v)";

/// How long to measure.
struct Effort {
    time: Duration,
    sizes: &'static [u32],
    /// Pixels a side of the picture that samples are measured against, as a multiple.
    reference: u32,
}

const QUICK: Effort = Effort {
    time: Duration::from_millis(60),
    sizes: &[256, 512, 1024],
    reference: 8,
};
const FULL: Effort = Effort {
    time: Duration::from_millis(600),
    sizes: &[256, 512, 1024, 2048],
    reference: 16,
};

/// All rows about pictures, group by group; `done` is told of each group when it is finished.
pub fn measure(quick: bool, mut done: impl FnMut(&[Row])) -> Result<Vec<Row>, Failure> {
    let effort = if quick { QUICK } else { FULL };
    let cannot = |why: String| Failure::unusable(format!("draw a picture to measure: {why}"));
    let parse = |text| formula::parse(text).map_err(|error| cannot(error.to_string()));
    let (right, wrong, library) = (parse(RIGHT)?, parse(WRONG)?, Library::new());
    let one = Fingerprint {
        lesson: "bench",
        id: "double-division",
        title: String::new(),
        caption: String::new(),
        library: &library,
        right: &right,
        wrong: &wrong,
        scene: Scene::new(0.7, 0.95, 60.0),
    };
    let mut many = one.clone();
    many.scene.lights = (0..64)
        .map(|i| Light {
            // A golden angle from one to the next: all around, none twice.
            turn_deg: 137.507_764 * f64::from(i),
            intensity: 1.0 / 64.0,
            ..Light::distant(5.0 + 1.3 * f64::from(i))
        })
        .collect();
    let mut all = Vec::new();
    let mut add = |rows: Result<Vec<Row>, renders::Error>| {
        let mut rows = rows.map_err(|error| cannot(error.to_string()))?;
        mark_pareto(&mut rows);
        done(&rows);
        all.append(&mut rows);
        Ok::<(), Failure>(())
    };
    for &size in effort.sizes {
        add(ways(&effort, &one, format!("render/{size}"), size))?;
    }
    let group = format!("render_lights/{}, 64 lights", effort.sizes[0]);
    add(ways(&effort, &many, group, effort.sizes[0]))?;
    add(samples(&effort, &one))?;
    Ok(all)
}

/// The shortest of some runs, in nanoseconds, and what was drawn.
fn drawn(
    effort: &Effort,
    fingerprint: &Fingerprint<'_>,
    options: &Options,
) -> Result<(f64, Raw), renders::Error> {
    let begin = Instant::now();
    let run = || {
        let start = Instant::now();
        raw(fingerprint, options).map(|picture| (start.elapsed(), picture))
    };
    // The first may load a driver: there is always a second.
    let mut best = run()?.0;
    let picture = loop {
        let (time, picture) = run()?;
        best = best.min(time);
        if begin.elapsed() >= effort.time {
            break picture;
        }
    };
    let best = best.as_secs_f64();
    Ok((best * 1e9, picture))
}

/// Errors of the pixels of both panels, as shares of the true value, or of a thousandth of the
/// panel's largest where that is more.
fn errors(picture: &Raw, truth: &Raw) -> Vec<f64> {
    let panel = |values: &[f64], truths: &[f64]| -> Vec<f64> {
        let least = 1e-3 * largest(truths);
        let error = |(value, truth): (&f64, &f64)| (value - truth).abs() / truth.abs().max(least);
        values.iter().zip(truths).map(error).collect()
    };
    let mut errors = panel(&picture.right, &truth.right);
    errors.extend(panel(&picture.wrong, &truth.wrong));
    errors
}

fn largest(values: &[f64]) -> f64 {
    values.iter().copied().fold(f64::MIN_POSITIVE, f64::max)
}

/// One size, in every way to draw it, against double precision that leaves nothing out.
fn ways(
    effort: &Effort,
    fingerprint: &Fingerprint<'_>,
    group: String,
    size: u32,
) -> Result<Vec<Row>, renders::Error> {
    let options = Options {
        size,
        backend: Backend::Cpu,
        ..Options::default()
    };
    let whole = Options {
        skip: false,
        ..options
    };
    let single = Options {
        precision: Precision::F32,
        ..options
    };
    let (ns, truth) = drawn(effort, fingerprint, &whole)?;
    let unskipped = Row::new(group.clone(), "cpu, nothing left out", ns)
        .in_precision("f64")
        .on(brdf::batch::Isa::best().name())
        .with_errors("relative", errors(&truth, &truth));
    let mut rows = vec![unskipped];
    let mut ways = vec![("cpu", "f64", options), ("cpu", "f32", single)];
    if gpu_adapter().is_ok() {
        let gpu = Options {
            backend: Backend::Gpu,
            ..options
        };
        ways.push(("gpu", "f32", gpu));
    }
    for (variant, precision, options) in ways {
        let (ns, picture) = drawn(effort, fingerprint, &options)?;
        let isa = match variant {
            "gpu" => "gpu",
            _ => brdf::batch::Isa::best().name(),
        };
        rows.push(
            Row::new(group.clone(), variant, ns)
                .in_precision(precision)
                .on(isa)
                .with_errors("relative", errors(&picture, &truth)),
        );
        if variant == "gpu"
            && let Some(ns) = on_its_own_clock(effort, fingerprint, &options)?
        {
            rows.push(
                Row::new(group.clone(), "gpu, by its own clock", ns)
                    .in_precision(precision)
                    .on(isa)
                    .with_errors("relative", errors(&picture, &truth)),
            );
        }
    }
    Ok(rows)
}

/// The shortest of some runs by the device's clock, in nanoseconds: without the shader's
/// compilation and the way there and back.
fn on_its_own_clock(
    effort: &Effort,
    fingerprint: &Fingerprint<'_>,
    options: &Options,
) -> Result<Option<f64>, renders::Error> {
    let begin = Instant::now();
    let mut best = device_ms(fingerprint, options)?;
    while best.is_some() && begin.elapsed() < effort.time {
        let ms = device_ms(fingerprint, options)?;
        best = best.zip(ms).map(|(best, ms)| best.min(ms));
    }
    Ok(best.map(|ms| ms * 1e6))
}

/// Samples a pixel of the smallest size, against many more: what edges and highlights lose.
/// Shares of the brightest pixel.
fn samples(effort: &Effort, fingerprint: &Fingerprint<'_>) -> Result<Vec<Row>, renders::Error> {
    const SIZE: u32 = 128;
    let at = |side: u32, precision| Options {
        size: SIZE * side,
        backend: Backend::Cpu,
        precision,
        ..Options::default()
    };
    let truth = raw(fingerprint, &at(effort.reference, Precision::F64))?;
    let truth = averaged(&truth.right, SIZE, effort.reference);
    let peak = largest(&truth);
    let mut rows = Vec::new();
    for precision in [Precision::F64, Precision::F32] {
        for side in [1, 2, 4] {
            let (ns, picture) = drawn(effort, fingerprint, &at(side, precision))?;
            let picture = averaged(&picture.right, SIZE, side);
            let errors = picture.iter().zip(&truth);
            let errors = errors.map(|(a, b)| (a - b).abs() / peak).collect();
            let variant = match side {
                1 => "1 sample a pixel".to_owned(),
                _ => format!("{} samples a pixel", side * side),
            };
            rows.push(
                Row::new("render_samples/128", variant, ns)
                    .in_precision(precision.name())
                    .on(brdf::batch::Isa::best().name())
                    .with_errors("relative", errors),
            );
        }
    }
    Ok(rows)
}

/// A panel of `size` pixels a side from one of `size · side`, the mean of each square.
fn averaged(values: &[f64], size: u32, side: u32) -> Vec<f64> {
    let (size, side) = (size as usize, side as usize);
    let row = size * side;
    let pixel = |index: usize| {
        let (x, y) = (index % size * side, index / size * side);
        let samples = (0..side * side).map(|i| {
            let at = (y + i / side) * row + x + i % side;
            values.get(at).copied().unwrap_or(f64::NAN)
        });
        samples.sum::<f64>() / (side * side) as f64
    };
    (0..size * size).map(pixel).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn squares_are_averaged() {
        let values: Vec<f64> = (0..16).map(f64::from).collect();
        assert_eq!(averaged(&values, 2, 2), [2.5, 4.5, 10.5, 12.5]);
        assert_eq!(averaged(&values, 4, 1), values);
    }

    #[test]
    fn pictures_are_measured() {
        const TINY: Effort = Effort {
            time: Duration::ZERO,
            sizes: &[32],
            reference: 4,
        };
        let (right, wrong, library) = (
            formula::parse(RIGHT).expect("a formula"),
            formula::parse(WRONG).expect("a formula"),
            Library::new(),
        );
        let fingerprint = Fingerprint {
            lesson: "bench",
            id: "test",
            title: String::new(),
            caption: String::new(),
            library: &library,
            right: &right,
            wrong: &wrong,
            scene: Scene::new(0.7, 0.95, 60.0),
        };
        let rows = ways(&TINY, &fingerprint, "render/32".into(), 32).expect("pictures");
        // Nothing left out is the truth; what is left out changes nothing but rounding.
        assert_eq!(rows[0].max_ulp, 0.0);
        assert!(rows[1].max_ulp < 1e-9, "{}", rows[1].max_ulp);
        let single = rows[2].max_ulp;
        assert!((1e-9..1e-2).contains(&single), "{single}");
        let rows = samples(&TINY, &fingerprint).expect("pictures");
        assert!(
            rows[0].max_ulp > rows[1].max_ulp,
            "more samples, less error"
        );
    }
}
