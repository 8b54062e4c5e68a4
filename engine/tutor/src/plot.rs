//! Plots: curves computed from the core, ready to draw, and the pictures beside them.

use formula::{Expr, Program, Values};

use crate::lesson::{AxisX, Curve, Figures, Given, Lesson, Plot, Series, values};
use crate::prose::{Block, PlotView, plain};

/// Points on a curve.
const POINTS: usize = 161;
/// How far a curve may be from a straight line between two of them, as a share of its height; else
/// there are more points, at most so many times halfway between.
const BENT: f64 = 1e-3;
const HALVINGS: u32 = 5;

impl Lesson {
    /// The plot of that id.
    pub fn plot(&self, id: &str) -> Option<Block> {
        let plot = self.plots.iter().find(|plot| plot.id.text == id)?;
        let series: Vec<(String, Vec<(f64, f64)>)> = plot
            .series
            .iter()
            .map(|series| {
                let label = self.label(&series.label, plot, &series.with);
                (label, self.curve(plot, series))
            })
            .collect();
        let marks: Vec<(String, f64, f64)> = plot
            .marks
            .iter()
            .filter_map(|mark| {
                let (x, y) = mark_point(self, plot, mark).ok()?;
                let drawable = y.is_finite() && (!plot.y.log || y > 0.0);
                drawable.then(|| (self.label(&mark.label, plot, &mark.with), x, y))
            })
            .collect();
        let heights = series
            .iter()
            .flat_map(|(_, points)| points.iter().map(|(_, y)| *y))
            .chain(marks.iter().map(|(_, _, y)| *y));
        let (low, high) = heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), y| {
            (low.min(y), high.max(y))
        });
        let y_range = (plot.y.from.unwrap_or(low), plot.y.to.unwrap_or(high));
        let y_range = if y_range.0 < y_range.1 {
            y_range
        } else if low.is_finite() {
            (
                low - 0.5 * low.abs().max(1e-9),
                low + 0.5 * low.abs().max(1e-9),
            )
        } else {
            (0.1, 1.0)
        };
        let known = values(&plot.with);
        Some(Block::Plot(PlotView {
            id: plot.id.text.clone(),
            title: plain(&self.inline(&plot.title, &known)),
            x_label: plain(&self.inline(&plot.x.label, &known)),
            y_label: plain(&self.inline(&plot.y.label, &known)),
            x_log: plot.x.log,
            y_log: plot.y.log,
            x_range: (plot.x.from, plot.x.to),
            y_range,
            y_given: (plot.y.from, plot.y.to),
            series,
            marks,
        }))
    }

    fn label(&self, text: &str, plot: &Plot, own: &[Given]) -> String {
        plain(&self.inline(text, &known_at(plot, own)))
    }

    fn curve(&self, plot: &Plot, series: &Series) -> Vec<(f64, f64)> {
        let mut points = match &series.is {
            Curve::Formula(formula) => self.computed(plot, &formula.expr, &series.with),
            Curve::Means { picture, wrong } => self.means(picture, *wrong),
        };
        points.retain(|(_, y)| y.is_finite() && (!plot.y.log || *y > 0.0));
        points
    }

    fn computed(&self, plot: &Plot, expr: &Expr, own: &[Given]) -> Vec<(f64, f64)> {
        let Ok((program, mut inputs)) = compile_curve(self, plot, expr, own) else {
            return Vec::new();
        };
        let mut value = |share: f64| {
            let x = at(&plot.x, share);
            if let Some(last) = inputs.last_mut() {
                *last = x;
            }
            let y = program.eval(&inputs);
            let height = if plot.y.log { y.ln() } else { y };
            Sampled {
                share,
                point: (x, y),
                height,
            }
        };
        let even: Vec<Sampled> = (0..POINTS)
            .map(|index| value(index as f64 / (POINTS - 1) as f64))
            .collect();
        let heights = even.iter().map(|sampled| sampled.height);
        let (low, high) = heights
            .filter(|height| height.is_finite())
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), y| {
                (low.min(y), high.max(y))
            });
        let allowed = BENT * (high - low);
        let mut points = Vec::with_capacity(2 * POINTS);
        for pair in even.windows(2) {
            points.push(pair[0].point);
            between(
                [&pair[0], &pair[1]],
                allowed,
                HALVINGS,
                &mut value,
                &mut points,
            );
        }
        points.extend(even.last().map(|last| last.point));
        points
    }

    /// The fingerprint picture of that id.
    pub fn picture(&self, id: &str) -> Option<Block> {
        let print = self.fingerprints.iter().find(|it| it.id.text == id)?;
        let known = print.known();
        let mut caption = self.inline(&print.shows, &known);
        if let Some(hides) = &print.hides {
            caption.push(crate::prose::Inline::Text(" ".to_owned()));
            caption.extend(self.inline(hides, &known));
        }
        Some(Block::Picture {
            lesson: self.id.text.clone(),
            id: print.id.text.clone(),
            title: plain(&self.inline(&print.title, &known)),
            caption,
            own: None,
        })
    }

    /// Everything shown below a text: tables, then plots, then maps, then pictures.
    pub fn figures(&self, figures: &Figures) -> Vec<Block> {
        let tables = figures.table.iter().filter_map(|id| self.table(id));
        let plots = figures.plot.iter().filter_map(|id| self.plot(id));
        let pictures = figures.picture.iter().filter_map(|id| self.picture(id));
        let maps = figures.map.iter().filter_map(|id| self.map_frame(id));
        let maps = maps.map(|frame| Block::Map(Box::new(frame)));
        tables.chain(plots).chain(maps).chain(pictures).collect()
    }
}

/// A point of a curve.
struct Sampled {
    /// How far along the axis.
    share: f64,
    point: (f64, f64),
    /// Its value as it is drawn.
    height: f64,
}

/// Adds points between two of a curve where it bends too much to be drawn as a straight line.
fn between(
    [from, to]: [&Sampled; 2],
    allowed: f64,
    halvings: u32,
    value: &mut dyn FnMut(f64) -> Sampled,
    points: &mut Vec<(f64, f64)>,
) {
    if halvings == 0 {
        return;
    }
    let middle = value(f64::midpoint(from.share, to.share));
    let bend = (middle.height - f64::midpoint(from.height, to.height)).abs();
    // Also where a value is missing: there is nothing to draw.
    if bend.is_nan() || bend <= allowed {
        return;
    }
    between([from, &middle], allowed, halvings - 1, value, points);
    points.push(middle.point);
    between([&middle, to], allowed, halvings - 1, value, points);
}

/// A point of the axis, from 0 at its left end to 1 at its right.
fn at(axis: &AxisX, share: f64) -> f64 {
    if share >= 1.0 {
        axis.to
    } else if axis.log {
        axis.from * (axis.to / axis.from).powf(share)
    } else {
        axis.from + (axis.to - axis.from) * share
    }
}

/// The numbers that a curve or a mark is computed from, besides x.
pub(crate) fn known_at(plot: &Plot, own: &[Given]) -> Values {
    let mut known = values(&plot.with);
    known.extend(values(own));
    known
}

/// A curve as a program, with its inputs; the last one is x.
///
/// # Errors
///
/// As [`formula::Library::compile`].
pub(crate) fn compile_curve(
    lesson: &Lesson,
    plot: &Plot,
    expr: &Expr,
    own: &[Given],
) -> Result<(Program, Vec<f64>), formula::Error> {
    let mut known = known_at(plot, own);
    known.remove(&plot.x.name.text);
    let mut names: Vec<&str> = known.keys().map(String::as_str).collect();
    let mut inputs: Vec<f64> = known.values().copied().collect();
    names.push(&plot.x.name.text);
    inputs.push(plot.x.from);
    Ok((lesson.library.compile(expr, &names)?, inputs))
}

/// Where a mark stands.
///
/// # Errors
///
/// As [`formula::Library::eval`].
pub(crate) fn mark_point(
    lesson: &Lesson,
    plot: &Plot,
    mark: &crate::lesson::Mark,
) -> Result<(f64, f64), formula::Error> {
    let mut known = known_at(plot, &mark.with);
    let x = lesson.library.eval(&mark.x.expr, &known)?;
    known.insert(plot.x.name.text.clone(), x);
    Ok((x, lesson.library.eval(&mark.is.expr, &known)?))
}
