//! Maps: a value over two quantities, computed from the core and ready to be drawn.

use formula::Values;

use crate::lesson::{Lesson, Map, values};
use crate::prose::plain;

/// Values across a map, and upwards.
const COLUMNS: usize = 48;

/// What the colours of a map mean.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Scale {
    /// From dark to bright over this range, linearly.
    Linear(f64, f64),
    /// From dark to bright over this range, by factors.
    Log(f64, f64),
    /// A ratio: one colour below 1, another above.
    Ratio,
}

/// A map with its values.
#[derive(Clone, Debug, PartialEq)]
pub struct MapView {
    /// Name of the map in its lesson.
    pub id: String,
    /// Heading.
    pub title: String,
    /// Below the horizontal axis.
    pub x_label: String,
    /// Beside the vertical axis.
    pub y_label: String,
    /// Beside the bar of colours.
    pub value_label: String,
    /// Ends of the horizontal axis.
    pub x: (f64, f64),
    /// Ends of the vertical axis, bottom and top.
    pub y: (f64, f64),
    /// Number of columns.
    pub columns: usize,
    /// Values at the middles of the cells, by rows from the bottom; NaN where there is none.
    pub values: Vec<f64>,
    /// What the colours mean.
    pub scale: Scale,
}

impl Lesson {
    /// The map of that id.
    pub fn map(&self, id: &str) -> Option<MapView> {
        let map = self.maps.iter().find(|map| map.id.text == id)?;
        let known = values(&map.with);
        let words = |text: &str| plain(&self.inline(text, &known));
        Some(MapView {
            id: map.id.text.clone(),
            title: words(&map.title),
            x_label: words(&map.x.label),
            y_label: words(&map.y.label),
            value_label: words(&map.value_label),
            x: (map.x.from, map.x.to),
            y: (map.y.from, map.y.to),
            columns: COLUMNS,
            values: self.cells(map, &known, COLUMNS),
            scale: map.scale,
        })
    }

    /// The values at the middles of `count` by `count` cells; empty where the formula cannot be
    /// evaluated there.
    pub(crate) fn cells(&self, map: &Map, known: &Values, count: usize) -> Vec<f64> {
        let axes = [&map.x.name.text, &map.y.name.text];
        let known = known.iter().filter(|(name, _)| !axes.contains(name));
        let (mut names, mut inputs): (Vec<&str>, Vec<f64>) =
            known.map(|(name, value)| (name.as_str(), *value)).unzip();
        names.extend(axes.map(String::as_str));
        inputs.extend([0.0, 0.0]);
        let Ok(program) = self.library.compile(&map.is.expr, &names) else {
            return Vec::new();
        };
        let middle = |(from, to): (f64, f64), cell: usize| {
            from + (to - from) * (cell as f64 + 0.5) / count as f64
        };
        let first = inputs.len() - 2;
        let mut cells = Vec::with_capacity(count * count);
        for row in 0..count {
            for column in 0..count {
                inputs[first] = middle((map.x.from, map.x.to), column);
                inputs[first + 1] = middle((map.y.from, map.y.to), row);
                let value = program.eval(&inputs);
                cells.push(if value.is_finite() { value } else { f64::NAN });
            }
        }
        cells
    }
}
