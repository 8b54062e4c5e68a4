//! Whether the bug shows: a few numbers that say what the eye may miss.

use crate::Fingerprint;
use crate::colour::EncodeTable;
use crate::cpu::Cpu;
use crate::profile::at_angles;
use crate::sample::Samples;
use crate::shade::Shaded;

/// What a fingerprint shows, in numbers.
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
    /// Share of the lit pixels whose sRGB value, at the picture's exposure, changes by more than
    /// 8 of 255: upwards, and downwards.
    pub changed_8: (f64, f64),
}

pub(crate) fn measure(fingerprint: &Fingerprint<'_>, cpu: &Cpu, shaded: &Shaded) -> Visibility {
    let geometry = fingerprint.scene.geometry();
    let (terminator, _) = geometry.lit_equator();
    // Just inside: the limit from the lit side, not the value at the edge itself.
    let on_equator = at_angles(fingerprint, cpu, &[geometry.highlight(), terminator + 1e-6]);
    let (highlight, edge) = (on_equator[0], on_equator[1]);
    let rim = rim_median(fingerprint, cpu);

    let area = |shares: &[f32]| shares.iter().map(|&share| f64::from(share)).sum::<f64>();
    let (brighter_area, lit_area) = (area(&shaded.brighter), area(&shaded.lit));
    let (brighter, dimmer) = changed(shaded);
    Visibility {
        lit_above_one: share(brighter_area, lit_area),
        disc_above_one: share(brighter_area, disc_area(shaded)),
        ratio_at_highlight: highlight.ratio,
        rim_over_highlight: (rim.0 / highlight.wrong, rim.1 / highlight.right),
        terminator_step: if terminator > -1.5 {
            edge.wrong / highlight.wrong
        } else {
            0.0
        },
        changed_8: (brighter, dimmer),
    }
}

fn share(part: f64, whole: f64) -> f64 {
    if whole > 0.0 { part / whole } else { 0.0 }
}

fn disc_area(shaded: &Shaded) -> f64 {
    let size = (shaded.lit.len() as f64).sqrt();
    std::f64::consts::PI * (crate::RADIUS_SHARE * size).powi(2)
}

/// Medians of both formulas over the lit part of the ring between 255/256 of the radius and the
/// radius, in the same points whatever the picture's size.
fn rim_median(fingerprint: &Fingerprint<'_>, cpu: &Cpu) -> (f64, f64) {
    const RINGS: usize = 16;
    const SECTORS: usize = 256;
    let geometry = fingerprint.scene.geometry();
    let points = (0..RINGS).flat_map(|ring| {
        let radius = 1.0 - (ring as f64 + 0.5) / (RINGS as f64 * 256.0);
        (0..SECTORS).filter_map(move |sector| {
            let angle = std::f64::consts::TAU * (sector as f64 + 0.5) / SECTORS as f64;
            geometry.lit(radius * angle.cos(), radius * angle.sin())
        })
    });
    let values = cpu.evaluate(&Samples::of(&geometry, points));
    (median(values.wrong), median(values.right))
}

fn median(mut values: Vec<f64>) -> f64 {
    if values.is_empty() {
        return 0.0;
    }
    let middle = values.len() / 2;
    *values.select_nth_unstable_by(middle, f64::total_cmp).1
}

/// Shares of the lit pixels that become visibly brighter and dimmer.
fn changed(shaded: &Shaded) -> (f64, f64) {
    let encode = EncodeTable::new();
    let (mut lit, mut brighter, mut dimmer) = (0_u64, 0_u64, 0_u64);
    for index in 0..shaded.lit.len() {
        if shaded.lit[index] == 0.0 {
            continue;
        }
        lit += 1;
        let level = |seen: f32| 255.0 * encode.signal(seen);
        let change = level(shaded.wrong_seen[index]) - level(shaded.right_seen[index]);
        brighter += u64::from(change > 8.0);
        dimmer += u64::from(change < -8.0);
    }
    (
        share(brighter as f64, lit as f64),
        share(dimmer as f64, lit as f64),
    )
}
