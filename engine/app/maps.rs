//! A lesson's map as `renders` wants it, and in numbers.

use renders::MapSpec;
use tutor::Lesson;
use tutor::map::{MapFrame, Scale};
use tutor::prose::TableView;

use crate::text;

/// Most values across a table, and upwards.
const PLACES: usize = 6;

/// The map of that id with so many values across and upwards.
pub fn map_spec(lesson: &Lesson, id: &str, columns: usize) -> Option<MapSpec> {
    let frame = lesson.map_frame(id)?;
    Some(MapSpec {
        values: lesson.map_cells(id, columns),
        title: frame.title,
        x_label: frame.x_label,
        y_label: frame.y_label,
        value_label: frame.value_label,
        x: frame.x,
        y: frame.y,
        columns,
        scale: match frame.scale {
            Scale::Linear(from, to) => renders::Scale::Linear(from, to),
            Scale::Log(from, to) => renders::Scale::Log(from, to),
            Scale::Ratio => renders::Scale::Ratio,
        },
    })
}

/// The values of a map at a few round places.
pub fn map_table(lesson: &Lesson, id: &str) -> Option<TableView> {
    let frame = lesson.map_frame(id)?;
    let (xs, mut ys) = (round(frame.x), round(frame.y));
    // As on the map: the greatest is on top.
    ys.reverse();
    let values = lesson.map_values(id, &xs, &ys);
    let mut header = vec![format!("{} ↓, {} →", frame.y_label, frame.x_label)];
    header.extend(xs.iter().map(|x| text::short(*x)));
    let rows = ys.iter().zip(values.chunks(xs.len().max(1)));
    let cell = |value: &f64| match value.is_nan() {
        true => "–".to_owned(),
        false => text::short(*value),
    };
    let rows = rows.map(|(y, values)| {
        let mut row = vec![text::short(*y)];
        row.extend(values.iter().map(cell));
        row
    });
    Some(TableView {
        title: frame.value_label,
        header,
        rows: rows.collect(),
        note: Vec::new(),
    })
}

/// What stands below a map on the screen: where its axes run, and what its colours say.
pub fn legend(frame: &MapFrame, has_colours: bool) -> [String; 2] {
    let number = text::short;
    let ((left, right), (bottom, top)) = (frame.x, frame.y);
    let axes = format!(
        "{} → {}: {} · {} ↑ {}: {}",
        number(left),
        number(right),
        frame.x_label,
        number(bottom),
        number(top),
        frame.y_label
    );
    let colours = match frame.scale {
        Scale::Ratio if has_colours => "blue: below 1 · white: 1 · orange: above 1".to_owned(),
        Scale::Ratio => "- below 1 · = 1 · + above 1".to_owned(),
        Scale::Linear(from, to) => format!("dark: {} · bright: {}", number(from), number(to)),
        Scale::Log(from, to) => {
            format!(
                "dark: {} · bright: {}, by factors",
                number(from),
                number(to)
            )
        }
    };
    [axes, format!("{} ({colours})", frame.value_label)]
}

/// Round numbers within a range, at most [`PLACES`].
fn round((from, to): (f64, f64)) -> Vec<f64> {
    let rough = (to - from) / (PLACES - 1) as f64;
    let power = 10f64.powf(rough.log10().floor());
    let step = [1.0, 2.0, 2.5, 5.0, 10.0]
        .map(|factor| factor * power)
        .into_iter()
        .find(|step| *step >= 0.999 * rough)
        .unwrap_or(10.0 * power);
    let first = (from / step - 1e-9).ceil() as i64;
    let last = (to / step + 1e-9).floor() as i64;
    (first..=last).map(|index| index as f64 * step).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check_round(range: (f64, f64), expected: &[&str]) {
        let found: Vec<String> = round(range).into_iter().map(text::short).collect();
        assert_eq!(found, expected);
    }

    #[test]
    fn places_are_round_and_few() {
        check_round((0.01, 1.0), &["0.2", "0.4", "0.6", "0.8", "1"]);
        check_round((0.0, 90.0), &["0", "20", "40", "60", "80"]);
        check_round((0.05, 0.95), &["0.2", "0.4", "0.6", "0.8"]);
        check_round((-1.0, 1.0), &["-1", "-0.5", "0", "0.5", "1"]);
    }
}
