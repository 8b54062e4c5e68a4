//! Points of a chart that say by their colour what they belong to and by their shape what kind
//! they are, and the line below which nothing lies.

use crate::axis::Axis;
use crate::canvas::{Align, Style};
use crate::chart::Chart;
use crate::colour::Rgb;
use crate::error::Error;
use crate::label::Taken;
use crate::pen::{Frame, Pen, runs};
use crate::text::{self, Weight};
use plotters::prelude::*;

/// How a point is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// A circle that is not filled.
    Ring,
    /// A filled circle.
    Disc,
    /// A filled square.
    Square,
    /// A filled square on its corner.
    Diamond,
    /// A filled triangle.
    Triangle,
}

/// A point with the colour of a curve and a shape of its own.
#[derive(Clone, Debug, PartialEq)]
pub struct Dot {
    /// Which of the curves it has the colour of.
    pub series: usize,
    /// What kind of point it is; [`crate::PlotSpec::shapes`] says what the kinds are.
    pub shape: Shape,
    /// Where it is, in the units of the axes.
    pub at: (f64, f64),
    /// What is written beside it; where there is no room, nothing is.
    pub label: String,
    /// Whether it is outlined: no other of its colour is better on both axes.
    pub outlined: bool,
}

/// What the legend says beside the names of the curves.
enum Key<'a> {
    Shape(Shape, &'a str),
    Outline,
    Front,
}

const FRONT: &str = "Pareto front: nothing is both faster and more accurate";
const OUTLINE: &str = "outlined: on the Pareto front of its group";

impl Chart<'_> {
    /// The second part of the legend, broken into rows of at most `width` pixels.
    fn keys(&self, width: f64) -> Vec<Vec<Key<'_>>> {
        let shapes = self.spec.shapes.iter();
        let shapes = shapes.map(|(shape, says)| Key::Shape(*shape, says));
        let front = (!self.spec.front.is_empty()).then_some(Key::Front);
        let outlined = self.spec.dots.iter().any(|dot| dot.outlined);
        let outline = outlined.then_some(Key::Outline);
        let mut rows: Vec<Vec<Key<'_>>> = Vec::new();
        let mut used = 0.0;
        for key in shapes.chain(outline).chain(front) {
            let needs = self.key_width(&key);
            match rows.last_mut() {
                Some(row) if used + needs <= width => {
                    row.push(key);
                    used += needs;
                }
                _ => {
                    rows.push(vec![key]);
                    used = needs;
                }
            }
        }
        rows
    }

    /// How many rows the second part of the legend takes.
    pub(crate) fn key_rows(&self, width: f64) -> usize {
        self.keys(width).len()
    }

    fn key_width(&self, key: &Key<'_>) -> f64 {
        let (says, sign) = match key {
            Key::Shape(_, says) => (*says, 2.6),
            Key::Outline => (OUTLINE, 2.6),
            Key::Front => (FRONT, 4.2),
        };
        f64::from(text::width(says, self.em as f32, Weight::Regular)) + sign * self.em
    }

    pub(crate) fn draw_keys<B: DrawingBackend>(
        &self,
        pen: &Pen<'_, B>,
        width: f64,
        top: f64,
    ) -> Result<(), Error> {
        let em = self.em;
        let mut y = top + 1.05 * em;
        for row in self.keys(width) {
            let mut x = em;
            for key in row {
                let (says, sign) = match key {
                    Key::Shape(shape, says) => {
                        let at = (x + 0.45 * em, y - 0.36 * em);
                        self.draw_shape(pen, at, (shape, 1.0), self.theme.faint, self.theme.paper)?;
                        (says, 1.2)
                    }
                    Key::Outline => {
                        let at = (x + 0.45 * em, y - 0.36 * em);
                        pen.disc(at.0, at.1, 0.5 * em, self.theme.ink)?;
                        pen.disc(at.0, at.1, 0.36 * em, self.theme.paper)?;
                        (OUTLINE, 1.2)
                    }
                    Key::Front => {
                        let line = [(x, y - 0.36 * em), (x + 1.8 * em, y - 0.36 * em)];
                        pen.path(&line, 0.5 * em, self.theme.front, 1.0)?;
                        (FRONT, 2.3)
                    }
                };
                let style = Style::new(em as f32, Weight::Regular, Align::Left, self.theme.ink);
                pen.text(x + sign * em, y, style, says)?;
                x += self.key_width(&key);
            }
            y += 1.7 * em;
        }
        Ok(())
    }

    fn draw_shape<B: DrawingBackend>(
        &self,
        pen: &Pen<'_, B>,
        (x, y): (f64, f64),
        (shape, scale): (Shape, f64),
        colour: Rgb,
        behind: Rgb,
    ) -> Result<(), Error> {
        let em = scale * self.em;
        let polygon = |corners: &[(f64, f64)]| {
            let corners: Vec<(f64, f64)> = corners
                .iter()
                .map(|(dx, dy)| (x + dx * em, y + dy * em))
                .collect();
            pen.polygon(&corners, colour)
        };
        match shape {
            Shape::Ring => {
                pen.disc(x, y, 0.38 * em, colour)?;
                pen.disc(x, y, 0.21 * em, behind)
            }
            Shape::Disc => pen.disc(x, y, 0.36 * em, colour),
            Shape::Square => polygon(&[(-0.32, -0.32), (0.32, -0.32), (0.32, 0.32), (-0.32, 0.32)]),
            Shape::Diamond => polygon(&[(0.0, -0.46), (0.46, 0.0), (0.0, 0.46), (-0.46, 0.0)]),
            Shape::Triangle => polygon(&[(0.0, -0.46), (0.44, 0.32), (-0.44, 0.32)]),
        }
    }

    /// Stairs through the points that nothing beats, drawn below everything else.
    pub(crate) fn draw_front<B: DrawingBackend>(
        &self,
        pen: &Pen<'_, B>,
        frame: Frame,
        (x_axis, y_axis): (&Axis, &Axis),
    ) -> Result<(), Error> {
        let front = &self.spec.front;
        let (Some(first), Some(last)) = (front.first(), front.last()) else {
            return Ok(());
        };
        let mut stairs = vec![(frame.x(x_axis, first.0), frame.top + 0.25 * self.em)];
        for &(x, y) in front {
            let (x, y) = (frame.x(x_axis, x), frame.y(y_axis, y));
            if let Some(&(_, above)) = stairs.last() {
                stairs.push((x, above));
            }
            stairs.push((x, y));
        }
        stairs.push((frame.right - 0.25 * self.em, frame.y(y_axis, last.1)));
        pen.path(&stairs, 0.5 * self.em, self.theme.front, 1.0)
    }

    pub(crate) fn draw_dots<B: DrawingBackend>(
        &self,
        pen: &Pen<'_, B>,
        frame: Frame,
        (x_axis, y_axis): (&Axis, &Axis),
        taken: &mut Taken,
    ) -> Result<(), Error> {
        let letters = 0.8 * self.em;
        let place = |at: (f64, f64)| (frame.x(x_axis, at.0), frame.y(y_axis, at.1));
        let dots = || {
            let dots = self.spec.dots.iter();
            dots.filter(|dot| x_axis.holds(dot.at.0) && y_axis.holds(dot.at.1))
        };
        for dot in dots() {
            taken.disc(place(dot.at), 0.55 * self.em);
        }
        for dot in dots() {
            let (at, colour) = (place(dot.at), self.colour(dot.series));
            if dot.outlined {
                self.draw_shape(pen, at, (dot.shape, 1.4), self.theme.ink, self.theme.ink)?;
            }
            self.draw_shape(pen, at, (dot.shape, 1.0), colour, self.theme.panel)?;
        }
        for dot in dots().filter(|dot| !dot.label.is_empty()) {
            let width = f64::from(text::width(&dot.label, letters as f32, Weight::Regular));
            let bounds = (frame.left, frame.top, frame.right, frame.bottom);
            let at = place(dot.at);
            if let Some(room) = taken.place_if_free(at, width, self.em, bounds) {
                // In the colour of the dot, and tied to it where it is a little way off.
                let colour = self.colour(dot.series);
                let near = (at.0.clamp(room.0, room.2), at.1.clamp(room.1, room.3));
                let away = (near.0 - at.0).hypot(near.1 - at.1);
                if away > 1.2 * self.em {
                    let share = 0.6 * self.em / away;
                    let from = |from: f64, to: f64| from + share * (to - from);
                    let tie = [(from(at.0, near.0), from(at.1, near.1)), near];
                    pen.path(&tie, 0.06 * self.em, colour, 1.0)?;
                    taken.curve(&tie, 0.5 * self.em);
                }
                let style = Style::new(letters as f32, Weight::Regular, Align::Left, colour);
                pen.text(room.0, room.3 - 0.35 * letters, style, &dot.label)?;
            }
        }
        Ok(())
    }

    /// The curves as thin lines: the dots on them are what is to be seen.
    pub(crate) fn draw_threads<B: DrawingBackend>(
        &self,
        pen: &Pen<'_, B>,
        frame: Frame,
        (x_axis, y_axis): (&Axis, &Axis),
        taken: &mut Taken,
    ) -> Result<(), Error> {
        for (index, (_, points)) in self.spec.series.iter().enumerate() {
            for run in runs(points, x_axis, y_axis, frame) {
                pen.path(&run, 0.1 * self.em, self.colour(index), 0.6)?;
                taken.curve(&run, 0.5 * self.em);
            }
        }
        Ok(())
    }
}
