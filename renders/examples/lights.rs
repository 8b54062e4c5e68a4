//! What skipping saves where there are 64 lights: `cargo run --release -p renders --example lights
//! -- [SIZE]`. The sphere's radius is 0.45 of half the picture.

mod common;

use common::{Bug, TWICE, processor};
use renders::{Backend, Light, Options, Scene, raw, shaded_points};

const LIGHTS: u32 = 64;
const ROUNDS: u32 = 12;

/// Evenly over the sphere of directions, from the eye's (0) to `share` of the way to the one
/// behind (1), on a spiral.
fn spiral(share: f64) -> Vec<Light> {
    let golden = 180.0 * (3.0 - 5.0_f64.sqrt());
    let light = |index: u32| {
        let z = 1.0 - 2.0 * share * (f64::from(index) + 0.5) / f64::from(LIGHTS);
        Light {
            turn_deg: golden * f64::from(index),
            intensity: 1.0 / f64::from(LIGHTS),
            ..Light::distant(z.acos().to_degrees())
        }
    };
    (0..LIGHTS).map(light).collect()
}

/// All at one angle from the eye, around it.
fn ring(deg: f64) -> Vec<Light> {
    let light = |index: u32| Light {
        turn_deg: 360.0 * f64::from(index) / f64::from(LIGHTS),
        ..Light::distant(deg)
    };
    (0..LIGHTS).map(light).collect()
}

/// The same at a distance of so many radii.
fn near(lights: Vec<Light>, distance: f64) -> Vec<Light> {
    let near = |light| Light {
        distance: Some(distance),
        ..light
    };
    lights.into_iter().map(near).collect()
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let size = std::env::args()
        .nth(1)
        .map_or(Ok(512), |text| text.parse())?;
    let bug = Bug::new(TWICE)?;
    println!(
        "{LIGHTS} lights, {size}² pixels, milliseconds of processor, best of {ROUNDS} rounds in turns"
    );
    println!(
        "{:36} {:>9} {:>9} {:>7} {:>11} {:>11} {:>7}",
        "", "skipping", "all", "times", "points", "points", "times"
    );
    for (name, lights) in [
        ("all around", spiral(1.0)),
        ("the half towards the eye", spiral(0.5)),
        ("the half behind", spiral(1.0).split_off(32).repeat(2)),
        ("a ring at 60°", ring(60.0)),
        ("a ring at 90°", ring(90.0)),
        ("all around, 2 radii away", near(spiral(1.0), 2.0)),
        ("all headlights", vec![Light::distant(0.0); LIGHTS as usize]),
    ] {
        let fingerprint = bug.on(Scene {
            lights,
            radius: 0.45,
            ..Scene::new(0.5, 0.95, 0.0)
        });
        let options = |skip| Options {
            size,
            backend: Backend::Cpu,
            skip,
            ..Options::default()
        };
        let mut best = [f64::INFINITY; 2];
        for _ in 0..ROUNDS {
            for (slot, skip) in best.iter_mut().zip([true, false]) {
                let start = processor().ok_or("no processor time to be had")?;
                raw(&fingerprint, &options(skip))?;
                let end = processor().ok_or("no processor time to be had")?;
                *slot = slot.min(end - start);
            }
        }
        let points = [true, false].map(|skip| shaded_points(&fingerprint, &options(skip)));
        let [some, all] = [points[0].clone()?, points[1].clone()?];
        println!(
            "{name:36} {:9.2} {:9.2} {:6.1}× {some:11} {all:11} {:6.1}×",
            best[0],
            best[1],
            best[1] / best[0],
            all as f64 / some as f64,
        );
    }
    Ok(())
}
