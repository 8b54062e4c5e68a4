//! `lobe play`: one picture of a lesson under the arrow keys, or its numbers.

use tutor::Lesson;

use crate::cli::{Folders, Play};
use crate::exit::{Done, Failure};
use crate::fingerprints::{PROFILE_ROWS, figures, fingerprint, profile_of};
use crate::lessons::{Shelf, unknown};
use crate::tui::dials::{Dials, Quantity};
use crate::{output, text, tui};

pub fn run(folders: &Folders, args: &Play) -> Result<Done, Failure> {
    let lesson = &Shelf::one(folders.lessons.as_deref(), &args.lesson)?;
    let id = picture_of(lesson, args.picture.as_deref())?;
    let shown = fingerprint(lesson, id)
        .ok_or_else(|| Failure::unusable(format!("{} has no picture `{id}`", lesson.id.text)))?;
    let mut play = tui::play::Play::new(&shown)
        .map_err(|why| Failure::unusable(format!("{}/{id}: {why}", lesson.id.text)))?;
    turn(&mut play.dials, args);
    if !args.plain && super::learn::has_screen() {
        return tui::play::alone(play);
    }
    if [args.roughness, args.light, args.f0] == [None; 3] {
        output::line(
            "A picture to turn needs a terminal: give --roughness, --light or --f0 for its profile in numbers.",
        )?;
        return Ok(Done::Fine);
    }
    numbers(&renders::Fingerprint {
        scene: play.dials.scene(),
        ..shown
    })
}

/// The picture that was named, else the lesson's first.
fn picture_of<'a>(lesson: &'a Lesson, wanted: Option<&str>) -> Result<&'a str, Failure> {
    let mut ids = lesson
        .fingerprints
        .iter()
        .map(|entry| entry.id.text.as_str());
    let else_say = match ids.clone().next() {
        None => "the lesson has none".to_owned(),
        Some(_) => format!(
            "the lesson has {}",
            ids.clone().collect::<Vec<_>>().join(", ")
        ),
    };
    match wanted {
        None => ids
            .next()
            .ok_or_else(|| Failure::unusable(format!("{} has no picture", lesson.id.text))),
        Some(wanted) => ids
            .clone()
            .find(|id| *id == wanted)
            .ok_or_else(|| unknown("picture", wanted, ids, &else_say)),
    }
}

fn turn(dials: &mut Dials, args: &Play) {
    let given = [
        (Quantity::Roughness, args.roughness),
        (Quantity::Light, args.light),
        (Quantity::F0, args.f0),
    ];
    for (quantity, value) in given {
        if let Some(value) = value {
            dials.set(quantity, value);
        }
    }
}

/// What is seen, for those who do not see it.
fn numbers(fingerprint: &renders::Fingerprint<'_>) -> Result<Done, Failure> {
    let scene = &fingerprint.scene;
    let light = scene.lights.first().map_or(0.0, |light| light.deg);
    output::line(&format!(
        "{}\nroughness {}, light {}°, F0 {}",
        fingerprint.title,
        text::short(scene.roughness),
        text::short(light),
        text::short(scene.f0)
    ))?;
    let broken = |error: renders::Error| Failure::unusable(error.to_string());
    let mut preview = renders::Preview::new(fingerprint).map_err(broken)?;
    let frame = preview.draw(scene, 256, 0.0).map_err(broken)?;
    output::line("")?;
    for (name, value) in figures(&frame.visibility) {
        output::line(&format!("{name:<31}{value}"))?;
    }
    if let Some(table) = profile_of(fingerprint, PROFILE_ROWS) {
        output::line(&format!("\n{}", table.title))?;
        for line in text::table_lines(&table, usize::MAX).unwrap_or_default() {
            output::line(line.trim_end())?;
        }
    }
    Ok(Done::Fine)
}
