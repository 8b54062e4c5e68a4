//! Reading fingerprints and their scenes.

use super::each_some;
use super::reader::Table;
use crate::lesson::{Fingerprint, Means, SceneLight};

pub fn read_fingerprint(table: &Table<'_, '_>) -> Option<Fingerprint> {
    let (id, title) = (table.need_text("id"), table.need_text("title"));
    let (scene, seen) = (table.givens("scene"), table.givens("seen"));
    let (shows, hides) = (table.need_text("shows"), table.text("hides"));
    let lights = each_some(table, "light", "[[fingerprint.light]]", read_light);
    let means = table.table("means", "`means`").map(|means| {
        let sizes = means.printed("size");
        means.finish();
        Means::new(sizes)
    });
    let (right, wrong) = (table.need_formula("right"), table.need_formula("wrong"));
    Some(Fingerprint {
        id,
        title,
        right: right?,
        wrong: wrong?,
        scene,
        lights,
        seen,
        means,
        shows,
        hides,
    })
}

fn read_light(table: &Table<'_, '_>) -> Option<SceneLight> {
    if !table.has("deg") {
        table.missing("deg", "deg = 60");
    }
    let deg = table.number("deg");
    let light = SceneLight {
        place: table.place,
        deg: deg.unwrap_or_default(),
        turn_deg: table.number("turn_deg").unwrap_or(0.0),
        distance: table.number("distance"),
        intensity: table.number("intensity").unwrap_or(1.0),
        colour: colour(table).unwrap_or([1.0; 3]),
    };
    deg.map(|_| light)
}

fn colour(table: &Table<'_, '_>) -> Option<[f64; 3]> {
    let numbers = table.numbers(table.get("colour")?, "`colour`")?;
    let three = <[f64; 3]>::try_from(numbers.as_slice()).ok();
    if three.is_none() {
        let message = format!("A colour has three numbers, not {}.", numbers.len());
        table.wrong(
            "colour",
            "count-differs",
            message,
            "colour = [1.0, 0.8, 0.6]",
        );
    }
    three
}
