//! The line on which the wrong value equals the right one.

use crate::shade::Shaded;

/// Segments of the contour in pixels, by marching over the squares between pixel centres. The
/// first of the shaded rows is the panel's row `first`.
pub(crate) fn ratio_one(shaded: &Shaded, size: usize, first: usize) -> Vec<[(f32, f32); 2]> {
    // Only whole lit pixels: an edge pixel's mean belongs to a part of it.
    let field = |column: usize, row: usize| {
        let index = row * size + column;
        (shaded.lit[index] > 0.99).then(|| shaded.stops[index])
    };
    let mut segments = Vec::new();
    let rows = shaded.lit.len() / size;
    // Where the line runs along an edge of the light, bits of it would look out between edge
    // pixels: it ends a pixel before.
    let inside = |column: usize, row: usize| {
        let near = |at: usize, most: usize| at.saturating_sub(1)..(at + 3).min(most);
        near(row, rows).all(|row| {
            let pixels = near(column, size).map(|column| row * size + column);
            pixels.into_iter().all(|index| shaded.lit[index] > 0.99)
        })
    };
    for row in 0..rows.saturating_sub(1) {
        let [above, below] = [row, row + 1].map(|row| &shaded.stops[row * size..(row + 1) * size]);
        for (column, (above, below)) in above.windows(2).zip(below.windows(2)).enumerate() {
            // Nearly everywhere nothing crosses.
            let negative = |value: &f32| *value < 0.0;
            let signs = [&above[1], &below[0], &below[1]].map(negative);
            if signs == [negative(&above[0]); 3] {
                continue;
            }
            let corners = [(0, 0), (1, 0), (1, 1), (0, 1)];
            let values = corners.map(|(dx, dy)| field(column + dx, row + dy).unwrap_or(f32::NAN));
            // Rounding alone is not a crossing.
            let clear = values.iter().any(|v| v.abs() > 1e-6);
            if !clear || values.iter().any(|v| !v.is_finite()) {
                continue;
            }
            let crosses = values.iter().any(|v| (*v < 0.0) != (values[0] < 0.0));
            if !crosses || !inside(column, row) {
                continue;
            }
            let mut ends: Vec<(f32, f32)> = Vec::new();
            for side in 0..4 {
                let (a, b) = (values[side], values[(side + 1) % 4]);
                if (a < 0.0) != (b < 0.0) {
                    let t = a / (a - b);
                    let at = |corner: (usize, usize)| {
                        (
                            (column + corner.0) as f32 + 0.5,
                            (first + row + corner.1) as f32 + 0.5,
                        )
                    };
                    let (from, to) = (at(corners[side]), at(corners[(side + 1) % 4]));
                    ends.push((from.0 + t * (to.0 - from.0), from.1 + t * (to.1 - from.1)));
                }
            }
            segments.extend(ends.chunks_exact(2).map(|pair| [pair[0], pair[1]]));
        }
    }
    segments
}
