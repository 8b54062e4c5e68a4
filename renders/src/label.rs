//! Where the label of a marked point stands so that it covers neither curves nor other labels.

/// A rectangle in pixels: left, top, right, bottom.
pub(crate) type Box = (f64, f64, f64, f64);

/// What labels must keep away from.
#[derive(Default)]
pub(crate) struct Taken {
    points: Vec<(f64, f64)>,
    boxes: Vec<Box>,
}

impl Taken {
    /// Keeps labels off a curve, given in pixels.
    pub fn curve(&mut self, run: &[(f64, f64)], spacing: f64) {
        for pair in run.windows(2) {
            let (from, to) = (pair[0], pair[1]);
            let steps = ((to.0 - from.0).hypot(to.1 - from.1) / spacing)
                .ceil()
                .clamp(1.0, 1e4) as usize;
            self.points.extend((0..=steps).map(|step| {
                let t = step as f64 / steps as f64;
                (from.0 + t * (to.0 - from.0), from.1 + t * (to.1 - from.1))
            }));
        }
    }

    /// Keeps labels off a disc, given in pixels.
    pub fn disc(&mut self, (x, y): (f64, f64), radius: f64) {
        self.boxes
            .push((x - radius, y - radius, x + radius, y + radius));
    }

    /// The best place for a label `width` pixels wide beside the point (`x`, `y`), within
    /// `frame`; it is taken from then on.
    pub fn place(&mut self, at: (f64, f64), width: f64, em: f64, frame: Box) -> Box {
        let (_, place) = self.best(at, width, em, frame);
        self.boxes.push(place);
        place
    }

    /// The same where a label stands on nothing else, and no place where it would.
    pub fn place_if_free(
        &mut self,
        at: (f64, f64),
        width: f64,
        em: f64,
        frame: Box,
    ) -> Option<Box> {
        let (cost, place) = self.best(at, width, em, frame);
        // Lines may be crossed; labels, dots and the frame may not.
        (cost < 100.0).then(|| {
            self.boxes.push(place);
            place
        })
    }

    fn best(&self, (x, y): (f64, f64), width: f64, em: f64, frame: Box) -> (f64, Box) {
        let (gap, height) = (0.7 * em, 1.1 * em);
        let beside = [x + gap, x - gap - width, x - width / 2.0];
        // Further off it is less clear whose label it is: rather across a line or two.
        let heights = [
            (y - 0.5 * em - height, 0.0),
            (y + 0.5 * em, 0.0),
            (y - height / 2.0, 0.0),
            (y - 1.6 * em - height, 3.0),
            (y + 1.6 * em, 3.0),
            (y - 2.7 * em - height, 6.0),
            (y + 2.7 * em, 6.0),
            (y - 3.8 * em - height, 9.0),
            (y + 3.8 * em, 9.0),
        ];
        let mut best = (f64::INFINITY, (x + gap, y - height, x + gap + width, y));
        for (order, (&(top, far), &left)) in heights
            .iter()
            .flat_map(|top| beside.iter().map(move |left| (top, left)))
            .enumerate()
        {
            let place = (left, top, left + width, top + height);
            let covers_mark = place.0 < x + 0.5 * em
                && place.2 > x - 0.5 * em
                && place.1 < y + 0.5 * em
                && place.3 > y - 0.5 * em;
            let outside =
                place.0 < frame.0 || place.1 < frame.1 || place.2 > frame.2 || place.3 > frame.3;
            let cost = far
                + 1e-3 * order as f64
                + self
                    .points
                    .iter()
                    .filter(|point| holds(place, **point))
                    .count() as f64
                + 100.0
                    * self
                        .boxes
                        .iter()
                        .filter(|other| meet(place, **other))
                        .count() as f64
                + if covers_mark { 100.0 } else { 0.0 }
                + if outside { 1e4 } else { 0.0 };
            if cost < best.0 {
                best = (cost, place);
            }
        }
        best
    }
}

fn holds(place: Box, point: (f64, f64)) -> bool {
    place.0 <= point.0 && point.0 <= place.2 && place.1 <= point.1 && point.1 <= place.3
}

fn meet(a: Box, b: Box) -> bool {
    a.0 < b.2 && b.0 < a.2 && a.1 < b.3 && b.1 < a.3
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_label_leaves_the_curve_and_the_frame_alone() {
        let mut taken = Taken::default();
        let frame = (0.0, 0.0, 200.0, 100.0);
        // A curve that rises to the right through the mark.
        taken.curve(&[(0.0, 100.0), (200.0, 0.0)], 1.0);
        let first = taken.place((100.0, 50.0), 40.0, 10.0, frame);
        let second = taken.place((100.0, 50.0), 40.0, 10.0, frame);
        assert!(!meet(first, second), "{first:?} {second:?}");
        for place in [first, second] {
            assert!(
                taken.points.iter().all(|point| !holds(place, *point)),
                "{place:?}"
            );
            assert!(place.0 >= 0.0 && place.2 <= 200.0);
        }
        // Where the next label would stand is another mark.
        let next = Taken::default().place((40.0, 50.0), 40.0, 10.0, frame);
        let mut taken = Taken::default();
        taken.disc((next.0, next.1), 4.0);
        let other = taken.place((40.0, 50.0), 40.0, 10.0, frame);
        assert!(!meet(other, (next.0, next.1, next.0, next.1)), "{other:?}");
    }
}
