//! The figures that a lesson quotes of its pictures: what they are called, and whether they are so.
//!
//! A figure that follows from the formulas and the geometry alone is computed so, and the picture has
//! to show it too; the others are what the picture shows.

use formula::Expr;
use renders::{Backend, Eye, Fingerprint, Options, Scene, Visibility};
use tutor::lesson::{Means, Total};
use tutor::{Finding, Lesson, Place};

use crate::fingerprints::fingerprint;

/// Pixels a side of the panel that figures are counted on.
const SIZE: u32 = 384;
/// How far a figure that is counted in pixels may be from its closed form, relatively.
const COUNTED: f64 = 5e-3;

/// A figure of a picture by the name that lessons and `lobe render --json` call it.
pub fn figure(seen: &Visibility, name: &str) -> Option<f64> {
    Some(match name {
        "lit_above_one" => seen.lit_above_one,
        "disc_above_one" => seen.disc_above_one,
        "ratio_at_highlight" => seen.ratio_at_highlight,
        "rim_over_highlight_wrong" => seen.rim_over_highlight.0,
        "rim_over_highlight_right" => seen.rim_over_highlight.1,
        "terminator_step" => seen.terminator_step,
        "growth_per_doubling" => seen.growth_per_doubling,
        "brighter_by_8" => seen.changed_8.0,
        "dimmer_by_8" => seen.changed_8.1,
        _ => return None,
    })
}

/// The figures that a lesson quotes of its pictures and that are not so.
pub fn check_seen(lesson: &Lesson) -> Vec<Finding> {
    let entries = lesson.fingerprints.iter();
    entries
        .filter(|entry| !entry.seen.is_empty() || entry.means.is_some())
        .flat_map(|entry| check_entry(lesson, entry))
        .collect()
}

/// What a finding is made of: where, which kind, and the sentence.
type Told<'a> = &'a dyn Fn(Place, &'static str, String) -> Finding;

fn check_entry(lesson: &Lesson, entry: &tutor::lesson::Fingerprint) -> Vec<Finding> {
    let Some(fingerprint) = fingerprint(lesson, &entry.id) else {
        return Vec::new();
    };
    let finding = |place: Place, code, message: String| {
        Finding::new(&lesson.file, &lesson.source, place, code, message)
    };
    check_figures(lesson, entry, &fingerprint, &finding)
        .unwrap_or_else(|error| vec![finding(entry.id.place, "not-a-scene", format!("{error}."))])
}

fn check_figures(
    lesson: &Lesson,
    entry: &tutor::lesson::Fingerprint,
    fingerprint: &Fingerprint<'_>,
    finding: Told<'_>,
) -> Result<Vec<Finding>, renders::Error> {
    let mut found = Vec::new();
    let options = Options {
        size: SIZE,
        backend: Backend::Cpu,
        ..Options::default()
    };
    let seen = renders::visibility(fingerprint, &options)?;
    for quoted in &entry.seen {
        let name = quoted.name.text.as_str();
        let shown = &lesson.source[quoted.place.start..quoted.place.end];
        let Some(drawn) = figure(&seen, name) else {
            // The name was found to be unknown already.
            continue;
        };
        let closed = closed_form(fingerprint, name);
        // What is counted in pixels is known to a fifth of a percent.
        let agrees = match closed {
            Some(value) => formula::agrees_with_printed(value, shown),
            None => [1.0, 0.998, 1.002]
                .iter()
                .any(|share| formula::agrees_with_printed(share * drawn, shown)),
        };
        if !agrees {
            let value = printed_as(closed.unwrap_or(drawn), shown);
            let who = if closed.is_some() {
                "the closed form gives"
            } else {
                "the picture shows"
            };
            let message = format!("`{name}` is quoted as {shown}; {who} {value}.");
            found.push(finding(quoted.place, "number-differs", message).expecting(value));
        }
        if let Some(value) = closed
            && (drawn - value).abs() > COUNTED * value
        {
            let message =
                format!("`{name}` is {value} in closed form, but the picture shows {drawn}.");
            found.push(finding(quoted.place, "number-differs", message));
        }
    }
    Ok(found)
}

/// A number with as many digits as are printed.
fn printed_as(value: f64, shown: &str) -> String {
    let digits = formula::significant_digits(shown).unwrap_or(3);
    formula::format_number(value, formula::Digits::Significant(digits))
}

/// The means of a fingerprint's panels, at all sizes of its `means` that a picture can have; empty
/// where nothing can be drawn.
pub fn means(lesson: &Lesson, entry: &tutor::lesson::Fingerprint, means: &Means) -> Vec<Total> {
    let Some(fingerprint) = fingerprint(lesson, &entry.id) else {
        return Vec::new();
    };
    let sizes: Vec<u32> = means.drawable().collect();
    let totals = renders::convergence(&fingerprint, &sizes).unwrap_or_default();
    let total = |it: renders::Total| Total {
        size: f64::from(it.size),
        right: it.right,
        wrong: it.wrong,
    };
    totals.into_iter().map(total).collect()
}

/// A figure that is known without a picture, under one distant light at the angle β from a distant
/// eye; `None` where it is not.
fn closed_form(fingerprint: &Fingerprint<'_>, name: &str) -> Option<f64> {
    let [light] = fingerprint.scene.lights.as_slice() else {
        return None;
    };
    if fingerprint.scene.eye != Eye::Orthographic || light.distance.is_some() {
        return None;
    }
    let beta = light.deg.to_radians();
    // Of the disc, the lit lens has (1 + cos β)/2 = cos²(β/2).
    let lens = (beta / 2.0).cos().powi(2);
    match name {
        "lit_above_one" => above_one(fingerprint, beta, lens),
        "disc_above_one" => above_one(fingerprint, beta, lens).map(|share| share * lens),
        "ratio_at_highlight" => {
            let [right, wrong] = at(fingerprint, beta / 2.0)?;
            Some(wrong / right)
        }
        // Just inside of the terminator, which is a quarter turn from the light.
        "terminator_step" if beta > 0.0 => {
            let [_, edge] = at(fingerprint, beta - std::f64::consts::FRAC_PI_2 + 1e-6)?;
            let [_, highlight] = at(fingerprint, beta / 2.0)?;
            Some(edge / highlight)
        }
        "terminator_step" => Some(0.0),
        "growth_per_doubling" => growth(fingerprint, light.deg),
        _ => None,
    }
}

/// The share of the lit lens in which the wrong value is the greater.
fn above_one(fingerprint: &Fingerprint<'_>, beta: f64, lens: f64) -> Option<f64> {
    let is = |right: &str, wrong: &str| has_ratio(fingerprint, right, wrong).unwrap_or(false);
    if is("4 * n_dot_l * n_dot_v", "1") {
        // N·L·N·V is spread evenly over the lens, from 0 to cos²(β/2).
        return Some((1.0 / (4.0 * lens)).min(1.0));
    }
    let by_n_dot_v = is("f_schlick()", "f_schlick(v_dot_h = n_dot_v)");
    if by_n_dot_v && fingerprint.scene.f0 < 1.0 && beta <= std::f64::consts::FRAC_PI_3 {
        // Where N·V < V·H = cos(β/2): outside of a disc of radius sin(β/2), all of it lit as long
        // as it stays within the terminator, cos β from the middle.
        return Some(1.0 - (beta / 2.0).tan().powi(2));
    }
    None
}

/// Whether buggy / correct is `wrong / right`, whatever both have in common.
fn has_ratio(fingerprint: &Fingerprint<'_>, right: &str, wrong: &str) -> Option<bool> {
    let library = fingerprint.library;
    // What has nothing in common has no ratio: here it is D.
    let parse = |text| formula::parse(&format!("d_ggx() * ({text})")).ok();
    let wanted = library.ratio(&parse(right)?, &parse(wrong)?)?;
    let found = library.ratio(fingerprint.right, fingerprint.wrong)?;
    Some(library.canonical(&found) == library.canonical(&wanted))
}

/// What dividing twice adds to the mean over the disc with every doubling of the picture's size.
///
/// At the rim, with the light at the camera and N·L = N·V = c → 0, D is α²/π, V is 1/(4αc) and F is
/// F₀, so that D·V·F·c/(4c²) goes as αF₀/(16πc²); the mean of 1/c² over a disc that is sampled to
/// within a share of a pixel grows by ln 2.
fn growth(fingerprint: &Fingerprint<'_>, light_deg: f64) -> Option<f64> {
    if !has_ratio(fingerprint, "4 * n_dot_l * n_dot_v", "1")? {
        return None;
    }
    if light_deg > 0.0 {
        return Some(0.0);
    }
    let Scene { roughness, f0, .. } = fingerprint.scene;
    let ggx = formula::parse("d_ggx() * v_ggx() * f_schlick() * n_dot_l").ok()?;
    for psi in [0.2, 0.9, 1.5] {
        let [right, _] = at(fingerprint, psi)?;
        let known = value(fingerprint, &ggx, psi)?;
        if (right - known).abs() > 1e-9 * known {
            return None;
        }
    }
    let alpha = roughness * roughness;
    Some(alpha * f0 * std::f64::consts::LN_2 / (16.0 * std::f64::consts::PI))
}

/// Both formulas where the normal is turned from the eye towards the light by so many radians.
fn at(fingerprint: &Fingerprint<'_>, psi: f64) -> Option<[f64; 2]> {
    Some([
        value(fingerprint, fingerprint.right, psi)?,
        value(fingerprint, fingerprint.wrong, psi)?,
    ])
}

fn value(fingerprint: &Fingerprint<'_>, expr: &Expr, psi: f64) -> Option<f64> {
    let scene = &fingerprint.scene;
    let beta = scene.lights.first()?.deg.to_radians();
    let mut known = scene.others.clone();
    let between = psi > 0.0 && psi < beta;
    for (name, value) in [
        ("n_dot_l", (psi - beta).cos()),
        ("n_dot_v", psi.cos()),
        ("n_dot_h", (psi - beta / 2.0).cos()),
        ("v_dot_h", (beta / 2.0).cos()),
        ("l_dot_v", beta.cos()),
        // All three are in one plane.
        ("cos_phi", if between { -1.0 } else { 1.0 }),
        ("light_deg", beta.to_degrees()),
        ("roughness", scene.roughness),
        ("alpha", scene.roughness * scene.roughness),
        ("f0", scene.f0),
    ] {
        known.entry(name.to_owned()).or_insert(value);
    }
    fingerprint.library.eval(expr, &known).ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{LN_2, PI};

    /// The closed form of a figure, and what pictures show of it.
    #[track_caller]
    fn check(right: &str, wrong: &str, deg: f64, name: &str, expected: Option<f64>) {
        let library = formula::Library::new();
        let parse = |text| formula::parse(text).unwrap_or_else(|error| panic!("{error}"));
        let fingerprint = Fingerprint {
            lesson: "test",
            id: "closed",
            title: String::new(),
            caption: String::new(),
            library: &library,
            right: &parse(right),
            wrong: &parse(wrong),
            scene: Scene::new(0.6, 0.3, deg),
        };
        let closed = closed_form(&fingerprint, name);
        match (closed, expected) {
            (None, None) => return,
            (Some(a), Some(b)) if (a - b).abs() <= 1e-9 * b => {}
            _ => panic!("{name} at {deg}°: {closed:?} instead of {expected:?}"),
        }
        let options = Options {
            size: SIZE,
            ..Options::default()
        };
        let seen = renders::visibility(&fingerprint, &options);
        let seen = seen.unwrap_or_else(|error| panic!("{error}"));
        let (drawn, closed) = (
            figure(&seen, name).expect("a figure"),
            closed.expect("some"),
        );
        assert!(
            (drawn - closed).abs() <= COUNTED * closed,
            "{name} at {deg}°: {closed} in closed form, {drawn} in the picture"
        );
    }

    /// The right mean settles, and the wrong one rises by what the lesson says of it.
    #[test]
    fn the_means_of_a_lesson_are_those_of_its_pictures() {
        let shelf = crate::lessons::Shelf::open(None).expect("lessons");
        let lesson = shelf.find("smith-g2").expect("the lesson");
        let Some(tutor::prose::Block::Plot(plot)) = lesson.plot("growth") else {
            panic!("no plot");
        };
        let [(_, right), (_, wrong)] = plot.series.as_slice() else {
            panic!("{} curves", plot.series.len());
        };
        let print = lesson.fingerprints.iter();
        let mut print = print.filter_map(|print| Some((print, print.means.as_ref()?)));
        let (print, means) = print.next().expect("a fingerprint with means");
        let sizes: Vec<f64> = means.drawable().map(f64::from).collect();
        for points in [right, wrong] {
            assert_eq!(points.iter().map(|it| it.0).collect::<Vec<_>>(), sizes);
        }
        let said = print.known()["growth_per_doubling"];
        for (right, wrong) in right.windows(2).zip(wrong.windows(2)) {
            assert!((right[1].1 / right[0].1 - 1.0).abs() < 1e-3, "{right:?}");
            let rise = wrong[1].1 - wrong[0].1;
            assert!((rise / said - 1.0).abs() < 0.1, "{wrong:?}, said {said}");
        }
    }

    const GGX: &str = "d_ggx() * v_ggx() * f_schlick() * n_dot_l";

    #[test]
    fn dividing_twice_is_known_without_a_picture() {
        let twice = "d_ggx() * v_ggx() * f_schlick() / (4 * n_dot_v)";
        for (deg, name, expected) in [
            (0.0, "lit_above_one", 0.25),
            (60.0, "lit_above_one", 1.0 / 3.0),
            (60.0, "disc_above_one", 0.25),
            (130.0, "lit_above_one", 1.0),
            (60.0, "ratio_at_highlight", 1.0 / 3.0),
            (0.0, "growth_per_doubling", 0.36 * 0.3 * LN_2 / (16.0 * PI)),
            (60.0, "growth_per_doubling", 0.0),
            (0.0, "terminator_step", 0.0),
        ] {
            check(GGX, twice, deg, name, Some(expected));
        }
        check(GGX, twice, 60.0, "brighter_by_8", None);
    }

    #[test]
    fn fresnel_by_n_dot_v_is_known_without_a_picture() {
        let n_dot_v = "d_ggx() * v_ggx() * f_schlick(v_dot_h = n_dot_v) * n_dot_l";
        for (deg, name, expected) in [
            (0.0, "lit_above_one", Some(1.0)),
            (60.0, "lit_above_one", Some(2.0 / 3.0)),
            (60.0, "disc_above_one", Some(0.5)),
            (30.0, "disc_above_one", Some(0.75_f64.sqrt())),
            (61.0, "lit_above_one", None),
            (40.0, "ratio_at_highlight", Some(1.0)),
        ] {
            check(GGX, n_dot_v, deg, name, expected);
        }
    }

    #[test]
    fn any_bug_is_known_at_the_highlight() {
        let square = "d_ggx(alpha = roughness) * v_ggx() * f_schlick() * n_dot_l";
        check(GGX, square, 50.0, "ratio_at_highlight", Some(0.36));
        check(GGX, square, 50.0, "lit_above_one", None);
    }
}
