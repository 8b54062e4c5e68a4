//! What a frame costs while a scene changes: `cargo run --release -p renders --example preview --
//! [SIZE]`.

mod common;

use common::{Bug, rough_metal};
use renders::{Preview, Scene};
use std::time::Instant;

const FRAMES: usize = 400;

/// Least, median and 99th percentile in milliseconds.
fn print(what: &str, mut times: Vec<f64>) {
    times.sort_by(f64::total_cmp);
    let at = |share: f64| times[((times.len() - 1) as f64 * share) as usize];
    println!(
        "{what:32} min {:6.2}  median {:6.2}  p99 {:6.2} ms",
        at(0.0),
        at(0.5),
        at(0.99)
    );
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let size = std::env::args()
        .nth(1)
        .map_or(Ok(256), |text| text.parse())?;
    let bug = Bug::new("d_ggx() * v_ggx() * f_schlick(v_dot_h = n_dot_v) * n_dot_l")?;
    let fingerprint = bug.on(rough_metal());
    let start = Instant::now();
    let mut preview = Preview::new(&fingerprint)?;
    println!(
        "{:32} {:10.2} ms",
        "both formulas, compiled once",
        start.elapsed().as_secs_f64() * 1e3
    );
    let (mut shading, mut rest, mut whole) = (Vec::new(), Vec::new(), Vec::new());
    for frame in 0..FRAMES {
        let share = frame as f64 / FRAMES as f64;
        let scene = Scene::new(0.05 + 0.9 * share, 0.95, 120.0 * share);
        let start = Instant::now();
        let drawn = preview.draw(&scene, size, 0.0)?;
        let took = start.elapsed().as_secs_f64() * 1e3;
        let shaded = drawn.shading.as_secs_f64() * 1e3;
        shading.push(shaded);
        rest.push(took - shaded);
        whole.push(took);
    }
    println!("{FRAMES} frames of 3 panels of {size} by {size} pixels, f64, budget 33 ms a frame");
    print("both panels shaded", shading);
    print("exposure, figures, colours", rest);
    print("frame", whole);
    Ok(())
}
