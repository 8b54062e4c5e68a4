//! Where on the ball a bug shows: the ratio at a place, against the place where it is greatest.

use crate::cpu::Cpu;
use crate::plan::Plan;
use crate::probe::{Place, Probe};
use crate::shade::luminance;
use crate::{Fingerprint, Precision};

/// Places across the ball that are compared: as many as a small picture has pixels.
const ACROSS: usize = 96;
/// Beyond so many stops more is not seen: a ratio of 0 or of infinity counts as this.
const MOST_STOPS: f64 = 16.0;

/// What is seen at one place of the ball.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spot {
    /// To the right of the disc's centre, in its radii.
    pub x: f64,
    /// Upwards.
    pub y: f64,
    /// Cosine between normal and main light.
    pub n_dot_l: f64,
    /// Cosine between normal and view.
    pub n_dot_v: f64,
    /// Value of the right formula, linear.
    pub right: f64,
    /// Value of the wrong formula, linear.
    pub wrong: f64,
    /// `wrong / right`.
    pub ratio: f64,
}

impl Spot {
    /// log2 of the ratio, at most 16 either way; 0 where nothing is known of it.
    pub fn stops(&self) -> f64 {
        let stops = self.ratio.log2();
        if stops.is_nan() {
            0.0
        } else {
            stops.clamp(-MOST_STOPS, MOST_STOPS)
        }
    }
}

/// A place that was pointed at, and the best there are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Look {
    /// The place; `None` beside the ball, or where no light reaches.
    pub here: Option<Spot>,
    /// Where the wrong formula is too bright by most; `None` where it is so nowhere.
    pub brightest: Option<Spot>,
    /// Where it is too dark by most.
    pub darkest: Option<Spot>,
}

impl Look {
    /// The place where the bug changes most, either way.
    pub fn best(&self) -> Option<Spot> {
        let all = [self.brightest, self.darkest].into_iter().flatten();
        all.max_by(|a, b| a.stops().abs().total_cmp(&b.stops().abs()))
    }
}

/// Looks at the place (`x`, `y`), in radii from the disc's centre. The outermost half percent of
/// the radius is left out of the best places: there a bug may be infinite, and nobody can point
/// at it.
///
/// `None` where a formula cannot be evaluated in this scene.
pub fn look(fingerprint: &Fingerprint<'_>, x: f64, y: f64) -> Option<Look> {
    let cpu = Cpu::new(fingerprint, &Plan::of(fingerprint, true), Precision::F64).ok()?;
    let probe = Probe::new(fingerprint, &cpu);
    let mut places: Vec<Place> = Vec::with_capacity(ACROSS * ACROSS);
    let at = |i: usize| (2 * i + 1) as f64 / ACROSS as f64 - 1.0;
    for row in 0..ACROSS {
        places.extend((0..ACROSS).filter_map(|column| place(at(column), at(row), 0.995)));
    }
    let pointed = place(x, y, 1.0);
    places.extend(pointed);
    let probed = probe.at(&places);
    let spots: Vec<Option<Spot>> = places
        .iter()
        .zip(&probed)
        .map(|(&[x, y, _], probed)| {
            probed.lit.then(|| Spot {
                x,
                y,
                n_dot_l: probed.main.n_dot_l,
                n_dot_v: probed.main.n_dot_v,
                right: luminance(&probed.right),
                wrong: luminance(&probed.wrong),
                ratio: probed.ratio,
            })
        })
        .collect();
    let here = match pointed {
        Some(_) => spots.last().copied().flatten(),
        None => None,
    };
    let grid = spots[..spots.len() - usize::from(pointed.is_some())].iter();
    let seen: Vec<Spot> = grid.flatten().copied().collect();
    let by_stops = |a: &&Spot, b: &&Spot| a.stops().total_cmp(&b.stops());
    let apart = |spot: &&Spot| spot.stops().abs() > 1e-9;
    Some(Look {
        here,
        brightest: seen
            .iter()
            .max_by(by_stops)
            .filter(|spot| spot.stops() > 0.0)
            .filter(apart)
            .copied(),
        darkest: seen
            .iter()
            .min_by(by_stops)
            .filter(|spot| spot.stops() < 0.0)
            .filter(apart)
            .copied(),
    })
}

/// The place, where it lies on the ball.
fn place(x: f64, y: f64, within: f64) -> Option<Place> {
    let r2 = x * x + y * y;
    (r2 < within * within).then(|| [x, y, (1.0 - r2).sqrt()])
}
