//! The ball of a "where would you look?": a small picture, two pixels a cell, and a cursor on it.

use std::sync::atomic::AtomicBool;

use renders::{Backend, Fingerprint, Options};
use tutor::Lesson;

use crate::fingerprints::fingerprint;

/// Between two panels of a compact picture.
const GAP: usize = 2;
/// Rows of cells: enough to point with, few enough to leave the question in sight.
const ROWS: std::ops::RangeInclusive<u16> = 8..=20;

/// The ball in pixels, and where the cursor is.
pub struct Ball {
    picture: String,
    /// Columns, and twice the rows.
    size: usize,
    /// Red, green, blue.
    pixels: Vec<[u8; 3]>,
    /// The cell of the cursor.
    pub at: (u16, u16),
    /// Where somebody pointed before the size was known.
    pending: Option<(f64, f64)>,
    /// The outline as a share of half the width.
    radius: f64,
}

impl Ball {
    pub fn new(picture: &str, at: Option<(f64, f64)>) -> Self {
        Self {
            picture: picture.to_owned(),
            size: 0,
            pixels: Vec::new(),
            at: (0, 0),
            pending: Some(at.unwrap_or((0.0, 0.0))),
            radius: 1.0,
        }
    }

    /// Rows that the ball wants of `room`.
    pub fn rows(room: u16) -> u16 {
        (room * 3 / 5).clamp(*ROWS.start(), *ROWS.end())
    }

    /// Draws the ball for so many rows, where that was not done yet; the cursor stays where it
    /// is on the ball.
    pub fn fit(&mut self, lesson: &Lesson, rows: u16) {
        let size = 2 * usize::from(rows);
        if size == self.size || rows == 0 {
            return;
        }
        let at = self.pending.take().unwrap_or_else(|| self.place());
        self.size = size;
        self.pixels = vec![[0; 3]; size * size];
        if let Some(fingerprint) = fingerprint(lesson, &self.picture) {
            self.radius = fingerprint.scene.radius;
            draw(&fingerprint, size, &mut self.pixels);
        }
        self.point_at(at);
    }

    /// Columns and rows of cells.
    pub fn cells(&self) -> (u16, u16) {
        (self.size as u16, self.size as u16 / 2)
    }

    /// The upper and the lower pixel of a cell.
    pub fn cell(&self, column: u16, row: u16) -> [[u8; 3]; 2] {
        let at = |y: usize| {
            let index = y * self.size + usize::from(column);
            self.pixels.get(index).copied().unwrap_or_default()
        };
        let top = 2 * usize::from(row);
        [at(top), at(top + 1)]
    }

    /// The cursor's place in radii of the ball: to the right and upwards.
    pub fn place(&self) -> (f64, f64) {
        let (columns, rows) = self.cells();
        let share = |at: u16, of: u16| (f64::from(at) + 0.5) / f64::from(of.max(1)) * 2.0 - 1.0;
        (
            share(self.at.0, columns) / self.radius,
            -share(self.at.1, rows) / self.radius,
        )
    }

    /// Puts the cursor on the cell of a place.
    fn point_at(&mut self, (x, y): (f64, f64)) {
        let (columns, rows) = self.cells();
        let cell = |share: f64, of: u16| {
            let at = ((share * self.radius + 1.0) / 2.0 * f64::from(of)).floor();
            at.clamp(0.0, f64::from(of.saturating_sub(1))) as u16
        };
        self.at = (cell(x, columns), cell(-y, rows));
    }

    /// Moves the cursor by so many cells.
    pub fn step(&mut self, (right, down): (i16, i16)) {
        let (columns, rows) = self.cells();
        let moved =
            |at: u16, by: i16, of: u16| at.saturating_add_signed(by).min(of.saturating_sub(1));
        self.at = (
            moved(self.at.0, right, columns),
            moved(self.at.1, down, rows),
        );
    }

    /// The answer as it is handed in.
    pub fn answer(&self) -> String {
        let (x, y) = self.place();
        format!("{x:.3} {y:.3}")
    }
}

/// The buggy panel, which is the middle one of a compact picture.
fn draw(fingerprint: &Fingerprint<'_>, size: usize, pixels: &mut [[u8; 3]]) {
    let options = Options {
        size: size as u32,
        backend: Backend::Cpu,
        compact: true,
        ..Options::default()
    };
    // Where nothing can be drawn the ball stays black, and every answer says why.
    let Ok(picture) = renders::render(fingerprint, &options, &AtomicBool::new(false)) else {
        return;
    };
    let rows = picture.rgba.chunks_exact(4 * picture.width as usize);
    for (row, into) in rows.zip(pixels.chunks_exact_mut(size)) {
        for (pixel, into) in row.chunks_exact(4).skip(size + GAP).zip(into) {
            *into = [pixel[0], pixel[1], pixel[2]];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ball(rows: u16) -> Ball {
        let mut ball = Ball::new("nothing", Some((0.5, -0.5)));
        ball.size = 2 * usize::from(rows);
        ball.pixels = vec![[0; 3]; ball.size * ball.size];
        let at = ball.pending.take().expect("given");
        ball.point_at(at);
        ball
    }

    #[test]
    fn a_cell_and_its_place_agree() {
        for rows in [8, 13, 20] {
            let mut ball = ball(rows);
            let (x, y) = ball.place();
            // A cell is twice as high as it is wide.
            let half = 1.0 / f64::from(rows) + 1e-9;
            assert!(
                (x - 0.5).abs() <= half && (y + 0.5).abs() <= half,
                "{x} {y}"
            );
            let at = ball.at;
            ball.point_at((x, y));
            assert_eq!(ball.at, at);
        }
    }

    #[test]
    fn the_cursor_stays_on_the_picture() {
        let mut ball = ball(10);
        ball.step((-100, -100));
        assert_eq!(ball.at, (0, 0));
        ball.step((1, 0));
        assert_eq!(ball.at, (1, 0));
        ball.step((100, 100));
        assert_eq!(ball.at, (19, 9));
        let (x, y) = ball.place();
        assert!(x > 0.9 && y < -0.85, "{x} {y}");
    }
}
