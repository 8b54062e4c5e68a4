//! The scenes of fingerprints: what is missing, and what no scene can be.

use super::Checker;
use crate::finding::Place;
use crate::lesson::{Fingerprint, MEAN_SIZES, SEEN, SceneLight};

/// Quantities that a point of the scene has; nobody can give them.
const FOLLOW: [&str; 6] = [
    "n_dot_l", "n_dot_v", "n_dot_h", "cos_phi", "v_dot_h", "l_dot_v",
];

pub fn check(checker: &mut Checker<'_>) {
    for print in &checker.lesson.fingerprints {
        givens(checker, print);
        lights(checker, print);
        means(checker, print);
        for seen in &print.seen {
            let name = seen.name.text.as_str();
            if !SEEN.contains(&name) {
                let near = crate::load::nearest(name, SEEN.into_iter()).map(str::to_owned);
                let message = format!("No figure of a picture is called `{name}`.");
                let finding = checker.error(seen.name.place, "unknown-name", message);
                finding.help = Some(format!("There are {}.", SEEN.join(", ")));
                finding.expected = near;
            }
        }
    }
}

fn givens(checker: &mut Checker<'_>, print: &Fingerprint) {
    let example = "scene = { roughness = 0.7, f0 = 0.95, light_deg = 60 }";
    let known = ["roughness", "f0", "light_deg", "eye_distance", "radius"];
    let mut needed = vec!["roughness", "f0"];
    if print.lights.is_empty() {
        needed.push("light_deg");
    }
    for name in needed {
        if print.given(name).is_none() {
            let message = format!("The scene of `{}` has no `{name}`.", print.id);
            let names = print.scene.iter().map(|it| it.name.text.as_str());
            let near = crate::load::nearest(name, names.filter(|it| !known.contains(it)));
            let finding = checker.error_in(&print.id, "missing-key", message);
            finding.expected = Some(example.to_owned());
            finding.help = near.map(|near| format!("Is `{near}` meant for it?"));
        }
    }
    if let Some(light) = print.given("light_deg")
        && !print.lights.is_empty()
    {
        let message = "The scene has `light_deg`, and lights of its own below.";
        checker
            .error(light.name.place, "both-given", message)
            .expected = Some("one of them".to_owned());
    }
    for given in &print.scene {
        let name = given.name.text.as_str();
        if FOLLOW.contains(&name) {
            let message = format!("`{name}` follows from the scene, point by point.");
            checker.error(given.name.place, "not-a-scene", message);
        }
        let value = given.value;
        let (fits, range) = match name {
            "roughness" | "f0" => ((0.0..=1.0).contains(&value), "0 to 1"),
            "light_deg" => ((0.0..180.0).contains(&value), "0 to less than 180"),
            "eye_distance" => (value > 1.0, "more than 1: radii from the centre"),
            "radius" => (value > 0.0 && value <= 1.0, "more than 0, at most 1"),
            _ => continue,
        };
        within(checker, given.place, name, value, fits, range);
    }
}

fn means(checker: &mut Checker<'_>, print: &Fingerprint) {
    let Some(means) = &print.means else { return };
    let mut least = *MEAN_SIZES.start();
    for size in &means.sizes {
        let fits = (least..=*MEAN_SIZES.end()).contains(&size.value) && size.value.fract() == 0.0;
        let range = format!("a whole number from {least} to {}", MEAN_SIZES.end());
        within(checker, size.place, "size", size.value, fits, &range);
        least = least.max(size.value + 1.0);
    }
}

fn lights(checker: &mut Checker<'_>, print: &Fingerprint) {
    for light in &print.lights {
        let SceneLight {
            place,
            deg,
            intensity,
            ..
        } = *light;
        let fits = (0.0..180.0).contains(&deg);
        within(checker, place, "deg", deg, fits, "0 to less than 180");
        within(
            checker,
            place,
            "intensity",
            intensity,
            intensity >= 0.0,
            "0 or more",
        );
        if let Some(distance) = light.distance {
            let range = "more than 1: radii from the centre";
            within(checker, place, "distance", distance, distance > 1.0, range);
        }
        let least = light.colour.into_iter().fold(f64::INFINITY, f64::min);
        within(checker, place, "colour", least, least >= 0.0, "0 or more");
    }
    if !print.lights.is_empty() && print.lights.iter().all(|light| light.weight() <= 0.0) {
        let message = format!("No light of `{}` shines.", print.id);
        checker.error_in(&print.id, "not-a-scene", message);
    }
}

fn within(checker: &mut Checker<'_>, at: Place, name: &str, value: f64, fits: bool, range: &str) {
    if !fits {
        let value = crate::prose::shortest(value);
        let message = format!("`{name}` is {value}, which no scene can have.");
        checker.error(at, "out-of-range", message).expected = Some(range.to_owned());
    }
}
