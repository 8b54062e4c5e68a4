//! What a bug looks like: two formulas and the scene that shows where they differ.

use std::sync::OnceLock;

use formula::Values;

use super::{Formula, Given, Lesson, Text, values};
use crate::finding::Place;

/// `[[fingerprint]]`: what a bug looks like.
#[derive(Clone, Debug)]
pub struct Fingerprint {
    /// Name, for references; unique within the lesson.
    pub id: Text,
    /// Heading.
    pub title: Text,
    /// The right formula.
    pub right: Formula,
    /// The wrong one.
    pub wrong: Formula,
    /// Roughness, f0, angle of the only light, distance of the eye, and what else the formulas
    /// need.
    pub scene: Vec<Given>,
    /// `[[fingerprint.light]]`: the lights, where `light_deg` alone does not say enough.
    pub lights: Vec<SceneLight>,
    /// Figures of the picture, as they are printed: `lobe check` compares them.
    pub seen: Vec<Given>,
    /// What becomes of the panels' means as the picture grows.
    pub means: Option<Means>,
    /// What the eye sees (prose).
    pub shows: Text,
    /// Where it does not show (prose).
    pub hides: Option<Text>,
}

/// `means`: the mean of the radiance over the sphere's disc, in pictures of several sizes. They are
/// measured when a plot first shows them.
#[derive(Clone, Debug)]
pub struct Means {
    /// Pixels a side of a panel.
    pub sizes: Vec<Printed>,
    measured: OnceLock<Vec<Total>>,
}

/// Means over the disc of one picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Total {
    /// Pixels a side of a panel.
    pub size: f64,
    /// Of the right formula.
    pub right: f64,
    /// Of the wrong one.
    pub wrong: f64,
}

/// Draws a lesson's fingerprint at all sizes of its `means`. Nothing here can draw: who can says how.
pub type Measure = fn(&Lesson, &Fingerprint, &Means) -> Vec<Total>;

/// Sizes of pictures of which a mean can be quoted, in pixels a side of a panel.
pub const MEAN_SIZES: std::ops::RangeInclusive<f64> = 16.0..=1024.0;

impl Means {
    /// Of pictures of these sizes.
    pub fn new(sizes: Vec<Printed>) -> Self {
        let measured = OnceLock::new();
        Self { sizes, measured }
    }

    /// The sizes that a picture can have: of what is no size nothing can be drawn.
    pub fn drawable(&self) -> impl Iterator<Item = u32> {
        let sizes = self.sizes.iter().map(|size| size.value);
        sizes
            .filter(|size| MEAN_SIZES.contains(size) && size.fract() == 0.0)
            .map(|size| size as u32)
    }
}

impl Lesson {
    /// Sizes and means of one of a fingerprint's panels; empty where nobody can draw.
    pub(crate) fn means(&self, picture: &str, wrong: bool) -> Vec<(f64, f64)> {
        let print = self.fingerprints.iter().find(|it| it.id.text == picture);
        let found = print.and_then(|print| Some((print, print.means.as_ref()?)));
        let Some(((print, means), measure)) = found.zip(self.measure) else {
            return Vec::new();
        };
        let totals = means.measured.get_or_init(|| measure(self, print, means));
        let of = |it: &Total| (it.size, if wrong { it.wrong } else { it.right });
        totals.iter().map(of).collect()
    }
}

/// A number of the file.
#[derive(Clone, Copy, Debug)]
pub struct Printed {
    /// The number.
    pub value: f64,
    /// Where it stands.
    pub place: Place,
}

/// One light of a scene.
#[derive(Clone, Debug)]
pub struct SceneLight {
    /// The whole entry.
    pub place: Place,
    /// Angle from the eye as seen from the sphere's centre, in degrees.
    pub deg: f64,
    /// Where around the eye's axis it stands, in degrees: 0 is right, 90 above.
    pub turn_deg: f64,
    /// From the sphere's centre, in radii; without it the light is distant.
    pub distance: Option<f64>,
    /// What its light is multiplied by.
    pub intensity: f64,
    /// Red, green, blue, linear.
    pub colour: [f64; 3],
}

impl SceneLight {
    /// The greatest of what its channels are multiplied by.
    pub fn weight(&self) -> f64 {
        self.intensity * self.colour.into_iter().fold(0.0, f64::max)
    }
}

/// Numbers of a scene that say where it is seen from; formulas do not know them.
pub const STAGING: [&str; 2] = ["eye_distance", "radius"];

/// The figures of a picture that can be quoted in `seen`, as `lobe render --json` names them.
pub const SEEN: [&str; 9] = [
    "lit_above_one",
    "disc_above_one",
    "ratio_at_highlight",
    "rim_over_highlight_wrong",
    "rim_over_highlight_right",
    "terminator_step",
    "growth_per_doubling",
    "brighter_by_8",
    "dimmer_by_8",
];

impl Fingerprint {
    /// A number of the scene.
    pub fn given(&self, name: &str) -> Option<&Given> {
        self.scene.iter().find(|given| given.name.text == name)
    }

    /// The numbers that its texts may use: those of the scene, the first light's angle as
    /// `light_deg`, and the figures in `seen`.
    pub fn known(&self) -> Values {
        let mut known = values(&self.scene);
        if let Some(first) = self.lights.first() {
            known.insert("light_deg".to_owned(), first.deg);
        }
        known.extend(values(&self.seen));
        known
    }
}
