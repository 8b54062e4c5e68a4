//! Maps: a value over two quantities, computed from the core and ready to be drawn.

use formula::Values;

use crate::lesson::{Lesson, Map, values};
use crate::prose::{Inline, plain};

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

/// What stands around a map.
#[derive(Clone, Debug, PartialEq)]
pub struct MapFrame {
    /// The lesson's id.
    pub lesson: String,
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
    /// What the colours mean.
    pub scale: Scale,
    /// What is to be seen.
    pub caption: Vec<Inline>,
}

impl Lesson {
    /// The map of that id, without its values.
    pub fn map_frame(&self, id: &str) -> Option<MapFrame> {
        let map = self.maps.iter().find(|map| map.id.text == id)?;
        let known = values(&map.with);
        let words = |text: &str| plain(&self.inline(text, &known));
        let says = map.says.as_ref();
        Some(MapFrame {
            lesson: self.id.text.clone(),
            id: map.id.text.clone(),
            title: words(&map.title),
            x_label: words(&map.x.label),
            y_label: words(&map.y.label),
            value_label: words(&map.value_label),
            x: (map.x.from, map.x.to),
            y: (map.y.from, map.y.to),
            scale: map.scale,
            caption: says.map_or_else(Vec::new, |says| self.inline(says, &known)),
        })
    }

    /// The values of the map of that id, at all of `xs` for each of `ys`; NaN where there is none.
    /// Empty where the formula cannot be evaluated at all.
    pub fn map_values(&self, id: &str, xs: &[f64], ys: &[f64]) -> Vec<f64> {
        let map = self.maps.iter().find(|map| map.id.text == id);
        map.map_or_else(Vec::new, |map| {
            self.values_at(map, &values(&map.with), xs, ys)
        })
    }

    /// [`Lesson::map_values`] at the middles of `count` by `count` cells, by rows from the bottom.
    pub fn map_cells(&self, id: &str, count: usize) -> Vec<f64> {
        let map = self.maps.iter().find(|map| map.id.text == id);
        map.map_or_else(Vec::new, |map| self.cells(map, &values(&map.with), count))
    }

    /// The values at the middles of `count` by `count` cells; empty where the formula cannot be
    /// evaluated there.
    pub(crate) fn cells(&self, map: &Map, known: &Values, count: usize) -> Vec<f64> {
        let middles = |from: f64, to: f64| -> Vec<f64> {
            let middle = |cell| from + (to - from) * (cell as f64 + 0.5) / count as f64;
            (0..count).map(middle).collect()
        };
        let (xs, ys) = (middles(map.x.from, map.x.to), middles(map.y.from, map.y.to));
        self.values_at(map, known, &xs, &ys)
    }

    fn values_at(&self, map: &Map, known: &Values, xs: &[f64], ys: &[f64]) -> Vec<f64> {
        let axes = [&map.x.name.text, &map.y.name.text];
        let known = known.iter().filter(|(name, _)| !axes.contains(name));
        let (mut names, mut inputs): (Vec<&str>, Vec<f64>) =
            known.map(|(name, value)| (name.as_str(), *value)).unzip();
        names.extend(axes.map(String::as_str));
        inputs.extend([0.0, 0.0]);
        let Ok(program) = self.library.compile(&map.is.expr, &names) else {
            return Vec::new();
        };
        let first = inputs.len() - 2;
        let mut found = Vec::with_capacity(xs.len() * ys.len());
        for &y in ys {
            for &x in xs {
                (inputs[first], inputs[first + 1]) = (x, y);
                let value = program.eval(&inputs);
                found.push(if value.is_finite() { value } else { f64::NAN });
            }
        }
        found
    }
}
