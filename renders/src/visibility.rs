//! Whether the bug shows: a few numbers that say what the eye may miss.

use crate::colour::EncodeTable;
use crate::cpu::Cpu;
use crate::error::Error;
use crate::probe::{Place, Probe, Probed};
use crate::profile::growth;
use crate::sample::Panel;
use crate::shade::{Engine, Job, Shaded, luminance, shade};
use crate::{Fingerprint, Options, Precision};
use std::sync::Arc;

/// What is counted in pixels is counted on a panel of at most this size: a larger one would
/// change no digit that is printed.
pub(crate) const LARGEST: usize = 1024;

/// What a fingerprint shows, in numbers: always computed in f64, so that they are the same
/// whatever draws. (In f32 every ratio within 6e-8 of 1 is 1, and that can be a good part of a
/// picture.) Under several lights highlight and terminator are the
/// main light's, the first of the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Visibility {
    /// Share of the lit, visible area in which the buggy value is greater than the correct one.
    pub lit_above_one: f64,
    /// The same area as a share of the whole disc.
    pub disc_above_one: f64,
    /// `wrong / right` where the normal is the half vector.
    pub ratio_at_highlight: f64,
    /// Median value of the outermost 1/256 of the radius, where it is lit, over the value at the
    /// highlight: of the wrong formula, and of the right one.
    pub rim_over_highlight: (f64, f64),
    /// What the wrong value jumps by where the light ends, over its own highlight: 0 where it
    /// fades out as it should, or where the light stands behind the eye and has no terminator.
    pub terminator_step: f64,
    /// By how much the mean of the buggy radiance over the disc rises with every doubling of the
    /// picture's size, where it grows towards the rim as 1/(N·V)² and so has no limit; else 0.
    pub growth_per_doubling: f64,
    /// Share of the lit pixels whose sRGB value, at the picture's exposure, changes by more than
    /// 8 of 255: upwards, and downwards.
    pub changed_8: (f64, f64),
}

impl Visibility {
    /// Of a picture of which nothing is known yet.
    pub(crate) const UNKNOWN: Self = Self {
        lit_above_one: f64::NAN,
        disc_above_one: f64::NAN,
        ratio_at_highlight: f64::NAN,
        rim_over_highlight: (f64::NAN, f64::NAN),
        terminator_step: f64::NAN,
        growth_per_doubling: f64::NAN,
        changed_8: (f64::NAN, f64::NAN),
    };
}

pub(crate) fn measure(fingerprint: &Fingerprint<'_>, cpu: &Cpu, tally: &Tally) -> Visibility {
    let probe = Probe::new(fingerprint, cpu);
    let main = probe.main();
    let (terminator, _) = main.lit_along();
    let highlight = probe.at(&probe.places([main.highlight()]));
    // Just inside: the limit from the lit side, not the value at the edge itself. What the other
    // lights give there is no step.
    let edge = probe.of_main_light().at(&probe.places([terminator + 1e-6]));
    let wrong = |found: &[Probed]| found.first().map_or(f64::NAN, |it| luminance(&it.wrong));
    let right = |found: &[Probed]| found.first().map_or(f64::NAN, |it| luminance(&it.right));
    let rim = rim_median(&probe);

    let lit_pixels = tally.lit_pixels as f64;
    Visibility {
        lit_above_one: share(tally.brighter_area, tally.lit_area),
        disc_above_one: share(tally.brighter_area, tally.disc),
        ratio_at_highlight: highlight.first().map_or(f64::NAN, |it| it.ratio),
        rim_over_highlight: (rim.0 / wrong(&highlight), rim.1 / right(&highlight)),
        terminator_step: if terminator > -1.5 {
            wrong(&edge) / wrong(&highlight)
        } else {
            0.0
        },
        growth_per_doubling: growth(&probe).per_doubling,
        changed_8: (
            share(tally.brighter as f64, lit_pixels),
            share(tally.dimmer as f64, lit_pixels),
        ),
    }
}

/// Said of a picture whose figures were not counted on it.
pub(crate) const COUNTED_APART: &str = "the figures are counted on a panel of their own, in f64 on the CPU: they are the same whatever draws";

/// Whether what `backend` drew holds the figures: in f64, and on the panel that they are counted
/// on.
pub(crate) fn holds_for(backend: &str, options: &Options) -> bool {
    backend == "cpu" && options.precision == Precision::F64 && options.size as usize <= LARGEST
}

/// The sums for a picture that was drawn otherwise: `cpu` computes in f64.
pub(crate) fn tally(job: &Job<'_>, cpu: &Arc<Cpu>, encode: &EncodeTable) -> Result<Tally, Error> {
    let panel = Panel {
        size: job.panel.size.min(LARGEST),
        everywhere: false,
        ..job.panel
    };
    let lights = job.lights.clone();
    let job = Job {
        panel,
        lights,
        raw: false,
        ..*job
    };
    let engine = match job.lights.is_empty() {
        true => Engine::Idle,
        false => Engine::Cpu(cpu.clone()),
    };
    let shaded = shade(&job, &engine)?;
    Ok(Tally::of_all(&panel, &shaded, encode))
}

/// Sums over the pixels of a picture.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tally {
    /// Areas in pixels: of the disc, lit, and lit where the wrong value is the greater.
    disc: f64,
    lit_area: f64,
    brighter_area: f64,
    /// Pixels that are lit at all, and those of them that become visibly brighter or dimmer.
    lit_pixels: u64,
    brighter: u64,
    dimmer: u64,
}

impl Tally {
    /// Of a panel of which no row was added yet.
    pub fn of(panel: &Panel) -> Self {
        Self {
            disc: std::f64::consts::PI * panel.outline().powi(2),
            lit_area: 0.0,
            brighter_area: 0.0,
            lit_pixels: 0,
            brighter: 0,
            dimmer: 0,
        }
    }

    /// Of a whole panel.
    pub fn of_all(panel: &Panel, shaded: &Shaded, encode: &EncodeTable) -> Self {
        let mut tally = Self::of(panel);
        tally.add(shaded, encode);
        tally
    }

    /// Adds the pixels of some rows.
    pub fn add(&mut self, shaded: &Shaded, encode: &EncodeTable) {
        let channels = shaded.channels();
        for (index, (&lit, &brighter)) in shaded.lit.iter().zip(&shaded.brighter).enumerate() {
            if lit == 0.0 {
                continue;
            }
            self.lit_area += f64::from(lit);
            self.brighter_area += f64::from(brighter);
            self.lit_pixels += 1;
            let level = |seen: f32| 255.0 * encode.signal(seen);
            // The channel that changes most.
            let change = (index * channels..(index + 1) * channels)
                .map(|at| level(shaded.wrong_seen[at]) - level(shaded.right_seen[at]))
                .fold(0.0_f32, |most, change| {
                    if change.abs() > most.abs() {
                        change
                    } else {
                        most
                    }
                });
            self.brighter += u64::from(change > 8.0);
            self.dimmer += u64::from(change < -8.0);
        }
    }
}

fn share(part: f64, whole: f64) -> f64 {
    if whole > 0.0 { part / whole } else { 0.0 }
}

/// Medians of both formulas over the lit part of the ring between 255/256 of the radius and the
/// radius, in the same points whatever the picture's size.
fn rim_median(probe: &Probe<'_>) -> (f64, f64) {
    const RINGS: usize = 16;
    const SECTORS: usize = 256;
    let places: Vec<Place> = (0..RINGS)
        .flat_map(|ring| {
            let radius = 1.0 - (ring as f64 + 0.5) / (RINGS as f64 * 256.0);
            let q = ((1.0 - radius) * (1.0 + radius)).sqrt();
            (0..SECTORS).map(move |sector| {
                let angle = std::f64::consts::TAU * (sector as f64 + 0.5) / SECTORS as f64;
                [radius * angle.cos(), radius * angle.sin(), q]
            })
        })
        .collect();
    let probed = probe.at(&places);
    let lit = || probed.iter().filter(|probed| probed.lit);
    (
        median(lit().map(|probed| luminance(&probed.wrong)).collect()),
        median(lit().map(|probed| luminance(&probed.right)).collect()),
    )
}

fn median(mut values: Vec<f64>) -> f64 {
    if values.is_empty() {
        return 0.0;
    }
    let middle = values.len() / 2;
    *values.select_nth_unstable_by(middle, f64::total_cmp).1
}
