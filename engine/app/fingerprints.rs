//! A lesson's fingerprint as `renders` wants it, and its profile in numbers.

use renders::{Fingerprint, Scene};
use tutor::Lesson;
use tutor::prose::{Block, Inline, TableView, plain};

use crate::text;

/// The fingerprint of that id, ready to draw.
pub fn fingerprint<'a>(lesson: &'a Lesson, id: &'a str) -> Option<Fingerprint<'a>> {
    let entry = lesson
        .fingerprints
        .iter()
        .find(|entry| entry.id.text == id)?;
    let mut others = tutor::lesson::values(&entry.scene);
    let mut take = |name: &str, otherwise: f64| others.remove(name).unwrap_or(otherwise);
    let (roughness, f0, light_deg) = (
        take("roughness", 0.5),
        take("f0", 0.04),
        take("light_deg", 60.0),
    );
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
        scene: Scene {
            others,
            ..Scene::new(roughness, f0, light_deg)
        },
    })
}

/// What the picture shows along the equator of the sphere, for those who do not see it.
pub fn profile_table(lesson: &Lesson, id: &str) -> Option<TableView> {
    const ROWS: usize = 9;
    let points = renders::profile(&fingerprint(lesson, id)?, ROWS);
    if points.is_empty() {
        return None;
    }
    let header = ["across the ball", "N·L", "N·V", "correct", "buggy", "ratio"];
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
