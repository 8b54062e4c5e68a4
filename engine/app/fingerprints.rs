//! A lesson's fingerprint as `renders` wants it, and its profile in numbers.

use renders::{Eye, Fingerprint, Light, RADIUS, Scene, Visibility};
use tutor::Lesson;
use tutor::exercise::look::{Sight, Spot};
use tutor::lesson::{Given, SceneLight};
use tutor::prose::{Block, Inline, TableView, plain};

use crate::text;

/// What a picture shows.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Subject {
    /// Id of the lesson.
    pub lesson: String,
    /// Id within the lesson: of the fingerprint, of the exercise, or of the map.
    pub id: String,
    pub kind: Kind,
}

/// What is drawn.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Kind {
    Fingerprint,
    /// The ball of a learner's own shader, whose text this is.
    Own(String),
    Map,
}

/// The fingerprint of that id, ready to draw.
pub fn fingerprint<'a>(lesson: &'a Lesson, id: &'a str) -> Option<Fingerprint<'a>> {
    let entry = lesson
        .fingerprints
        .iter()
        .find(|entry| entry.id.text == id)?;
    let (title, caption) = match lesson.picture(id) {
        Some(Block::Picture { title, caption, .. }) => (title, plain(&caption)),
        _ => (entry.title.text.clone(), String::new()),
    };
    Some(Fingerprint {
        lesson: &lesson.id.text,
        id,
        title,
        caption,
        library: &lesson.library,
        right: &entry.right.expr,
        wrong: &entry.wrong.expr,
        scene: scene(&entry.scene, &entry.lights),
    })
}

/// What is seen at a place of a picture, in radii from the ball's centre, and at the best
/// places; nothing anywhere, where the picture cannot be computed.
pub fn sight(lesson: &Lesson, id: &str, x: f64, y: f64) -> Sight {
    let spot = |it: renders::Spot| Spot {
        x: it.x,
        y: it.y,
        n_dot_l: it.n_dot_l,
        n_dot_v: it.n_dot_v,
        ratio: it.ratio,
        stops: it.stops(),
    };
    let seen = fingerprint(lesson, id).and_then(|print| renders::look(&print, x, y));
    Sight {
        here: seen.and_then(|it| it.here).map(spot),
        brightest: seen.and_then(|it| it.brightest).map(spot),
        darkest: seen.and_then(|it| it.darkest).map(spot),
    }
}

fn scene(given: &[Given], lights: &[SceneLight]) -> Scene {
    let mut others = tutor::lesson::values(given);
    let mut take = |name: &str| others.remove(name);
    let (roughness, f0) = (take("roughness"), take("f0"));
    let only = Light::distant(take("light_deg").unwrap_or(60.0));
    let (eye, radius) = (take("eye_distance"), take("radius"));
    let light = |light: &SceneLight| Light {
        deg: light.deg,
        turn_deg: light.turn_deg,
        distance: light.distance,
        intensity: light.intensity,
        colour: light.colour,
    };
    Scene {
        roughness: roughness.unwrap_or(0.5),
        f0: f0.unwrap_or(0.04),
        eye: eye.map_or(Eye::Orthographic, |distance| Eye::Perspective { distance }),
        lights: match lights {
            [] => vec![only],
            lights => lights.iter().map(light).collect(),
        },
        radius: radius.unwrap_or(RADIUS),
        others,
    }
}

/// The ball of a shader exercise, right and wrong alike, for a learner's own to be put in.
pub fn own_fingerprint<'a>(lesson: &'a Lesson, id: &'a str) -> Option<Fingerprint<'a>> {
    let task = tutor::exercise::shader::task(lesson.exercise(id)?)?;
    Some(Fingerprint {
        lesson: &lesson.id.text,
        id,
        title: String::new(),
        caption: String::new(),
        library: &lesson.library,
        right: &task.is.expr,
        wrong: &task.is.expr,
        scene: scene(&task.scene, &[]),
    })
}

/// The cosines along the equator of the sphere, for those who are to find a place on it without
/// seeing it.
pub fn places_table(lesson: &Lesson, id: &str) -> Option<TableView> {
    let mut table = profile_table(lesson, id)?;
    table.header.truncate(3);
    table.rows.iter_mut().for_each(|row| row.truncate(3));
    Some(table)
}

/// What the picture shows along the equator of the sphere, for those who do not see it.
pub fn profile_table(lesson: &Lesson, id: &str) -> Option<TableView> {
    profile_of(&fingerprint(lesson, id)?, PROFILE_ROWS)
}

/// The same of any scene.
pub fn profile_of(fingerprint: &Fingerprint<'_>, rows: usize) -> Option<TableView> {
    table_of(&renders::profile(fingerprint, rows), "buggy")
}

/// The figures that say whether the bug shows, as lines: name and value.
pub fn figures(seen: &Visibility) -> Vec<(&'static str, String)> {
    let number = |value: f64| match value.is_nan() {
        true => "–".to_owned(),
        false => text::short(value),
    };
    let (wrong, right) = seen.rim_over_highlight;
    vec![
        (
            "highlight, buggy / correct",
            format!("{}×", number(seen.ratio_at_highlight)),
        ),
        (
            "lit area that turns brighter",
            format!("{} %", number(100.0 * seen.lit_above_one)),
        ),
        (
            "rim / highlight",
            format!("correct {}, buggy {}", number(right), number(wrong)),
        ),
    ]
}

/// Rows of a profile that is read.
pub const PROFILE_ROWS: usize = 9;

/// Points along the equator as a table; `second` is what the wrong one is called.
pub fn table_of(points: &[renders::ProfilePoint], second: &str) -> Option<TableView> {
    if points.is_empty() {
        return None;
    }
    let header = ["across the ball", "N·L", "N·V", "correct", second, "ratio"];
    let rows = points
        .iter()
        .map(|point| {
            let numbers = [
                point.position,
                point.n_dot_l,
                point.n_dot_v,
                point.right,
                point.wrong,
                point.ratio,
            ];
            numbers
                .map(|number| {
                    if number.is_nan() {
                        "–".to_owned()
                    } else {
                        text::short(number)
                    }
                })
                .to_vec()
        })
        .collect();
    let note = "Across the ball: -1 is the rim away from the light, 1 the rim towards it; dark parts are left out.";
    Some(TableView {
        title: "Along the middle of the picture".to_owned(),
        header: header.map(str::to_owned).to_vec(),
        rows,
        note: vec![Inline::Text(note.to_owned())],
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lessons::Shelf;
    use crate::seen::figure;
    use renders::{Backend, Options, Precision, Raw};
    use std::sync::atomic::AtomicBool;
    use tutor::lesson::SEEN;

    fn values(fingerprint: &Fingerprint, skip: bool) -> Raw {
        let options = Options {
            size: 96,
            backend: Backend::Cpu,
            skip,
            ..Options::default()
        };
        renders::raw(fingerprint, &options).unwrap_or_else(|error| panic!("{error}"))
    }

    /// Every figure of a picture, to the last bit.
    fn seen(fingerprint: &Fingerprint, backend: Backend, precision: Precision) -> Vec<u64> {
        let options = Options {
            size: 64,
            backend,
            precision,
            ..Options::default()
        };
        let picture = renders::render(fingerprint, &options, &AtomicBool::new(false));
        let seen = picture.unwrap_or_else(|error| panic!("{error}")).report;
        SEEN.iter()
            .map(|name| figure(&seen.visibility, name).expect("a figure").to_bits())
            .collect()
    }

    /// Of every picture of every lesson: the same figures, whatever draws it. In f32 much of a
    /// picture may have a ratio of exactly 1 where it is a little more.
    #[test]
    fn every_backend_has_the_same_figures_of_every_lesson() {
        let adapter = renders::gpu_adapter();
        if let Err(error) = &adapter {
            let required = std::env::var("LOBE_REQUIRE_GPU").is_ok_and(|value| value == "1");
            assert!(!required, "LOBE_REQUIRE_GPU=1, but {error}");
            println!("skipped on graphics processors: no Vulkan adapter ({error})");
        }
        let shelf = Shelf::open(None).expect("lessons");
        let mut compared = 0;
        for lesson in shelf.lessons() {
            for entry in &lesson.fingerprints {
                let fingerprint = fingerprint(lesson, &entry.id).expect("a fingerprint");
                let on_cpu = |precision| seen(&fingerprint, Backend::Cpu, precision);
                let figures = on_cpu(Precision::F64);
                assert_eq!(figures, on_cpu(Precision::F32), "f32: {}", entry.id);
                if adapter.is_ok() {
                    let on_gpu = seen(&fingerprint, Backend::Gpu, Precision::F64);
                    assert_eq!(figures, on_gpu, "gpu: {}", entry.id);
                }
                let options = Options {
                    size: 64,
                    ..Options::default()
                };
                let alone = renders::visibility(&fingerprint, &options);
                let alone = alone.unwrap_or_else(|error| panic!("{error}"));
                let alone = SEEN.map(|name| figure(&alone, name).expect("a figure").to_bits());
                assert_eq!(figures, alone, "alone: {}", entry.id);
                compared += 1;
            }
        }
        assert!(compared > 0, "no lesson has a picture");
    }

    /// Of every picture of every lesson: what is skipped changes no bit of the right values,
    /// and of the wrong ones at most 8 ulp, where something cancels.
    #[test]
    fn what_is_skipped_changes_nothing_in_any_lesson() {
        let shelf = Shelf::open(None).expect("lessons");
        let mut compared = 0;
        for lesson in shelf.lessons() {
            for entry in &lesson.fingerprints {
                let fingerprint = fingerprint(lesson, &entry.id).expect("a fingerprint");
                let (skipping, all) = (values(&fingerprint, true), values(&fingerprint, false));
                let cancels = lesson
                    .library
                    .ratio(&entry.right.expr, &entry.wrong.expr)
                    .is_some();
                let scene = &fingerprint.scene;
                let drops_out = scene.roughness == 1.0 || scene.f0 == 1.0;
                let limits = [
                    if drops_out { 8 } else { 0 },
                    if drops_out || cancels { 8 } else { 0 },
                ];
                let pairs = [(&skipping.right, &all.right), (&skipping.wrong, &all.wrong)];
                for ((some, all), limit) in pairs.into_iter().zip(limits) {
                    assert!(some.iter().any(|value| *value > 0.0), "{}", entry.id);
                    for (index, (a, b)) in some.iter().zip(all).enumerate() {
                        let apart = a.to_bits().abs_diff(b.to_bits());
                        assert!(apart <= limit, "{}, pixel {index}: {a} and {b}", entry.id);
                    }
                    compared += some.len();
                }
            }
        }
        assert!(compared > 0, "no lesson has a picture");
    }
}
