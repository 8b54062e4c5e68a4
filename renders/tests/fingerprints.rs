//! The pictures against closed forms: what a bug does at the landmarks of the sphere.

use formula::{Expr, Library};
use renders::{
    Backend, Error, Eye, Fingerprint, Light, Options, Precision, RADIUS, Scene, convergence,
    point_at, profile, raw, render, visibility,
};
use std::sync::atomic::AtomicBool;

const CORRECT: &str = "d_ggx() * v_ggx() * f_schlick() * n_dot_l";
const DIVIDED_TWICE: &str = "d_ggx() * v_ggx() * f_schlick() * n_dot_l / (4 * n_dot_l * n_dot_v)";

struct Bug {
    library: Library,
    right: Expr,
    wrong: Expr,
    scene: Scene,
}

fn bug(right: &str, wrong: &str, roughness: f64, f0: f64, light_deg: f64) -> Bug {
    let parse = |text| formula::parse(text).unwrap_or_else(|e| panic!("{text}: {e}"));
    Bug {
        library: Library::new(),
        right: parse(right),
        wrong: parse(wrong),
        scene: Scene::new(roughness, f0, light_deg),
    }
}

impl Bug {
    fn fingerprint(&self) -> Fingerprint<'_> {
        Fingerprint {
            lesson: "test",
            id: "test",
            title: "A title".to_owned(),
            caption: "A caption".to_owned(),
            library: &self.library,
            right: &self.right,
            wrong: &self.wrong,
            scene: self.scene.clone(),
        }
    }

    fn picture(&self, options: &Options) -> renders::Picture {
        render(&self.fingerprint(), options, &AtomicBool::new(false))
            .unwrap_or_else(|e| panic!("{e}"))
    }
}

fn cpu(size: u32) -> Options {
    Options {
        size,
        backend: Backend::Cpu,
        ..Options::default()
    }
}

#[track_caller]
fn close(value: f64, expected: f64, relative: f64, what: &str) {
    assert!(
        (value - expected).abs() <= relative * expected.abs(),
        "{what}: {value} instead of {expected}"
    );
}

/// Ratio at the point of the equator that is nearest to what `distance` calls zero.
#[track_caller]
fn ratio_where(
    points: &[renders::ProfilePoint],
    distance: impl Fn(&renders::ProfilePoint) -> f64,
) -> f64 {
    points
        .iter()
        .min_by(|a, b| distance(a).abs().total_cmp(&distance(b).abs()))
        .map(|point| point.ratio)
        .expect("a profile has points")
}

/// One row: the wrong formula, then the expected ratio at the highlight, at the disc's centre,
/// near the rim (N·V = 0.05) and near the terminator (N·L = 0.05), light at 60°, roughness 0.4,
/// F0 0.04.
#[track_caller]
fn check_landmarks(wrong: &str, [highlight, centre, rim, terminator]: [f64; 4]) {
    let bug = bug(CORRECT, wrong, 0.4, 0.04, 60.0);
    let points = profile(&bug.fingerprint(), 30_000);
    let at = |distance: &dyn Fn(&renders::ProfilePoint) -> f64| ratio_where(&points, distance);
    close(at(&|p| p.position - 0.5), highlight, 5e-3, "highlight");
    close(at(&|p| p.position), centre, 5e-3, "centre");
    let lit_side = |p: &renders::ProfilePoint| if p.position > 0.0 { 0.0 } else { 9.0 };
    close(
        at(&|p| (p.n_dot_v - 0.05).abs() + lit_side(p)),
        rim,
        5e-3,
        "rim",
    );
    close(
        at(&|p| p.n_dot_l - 0.05 + if p.position > 0.0 { 9.0 } else { 0.0 }),
        terminator,
        5e-3,
        "terminator",
    );
}

#[test]
fn ratios_at_the_landmarks_are_the_closed_forms() {
    check_landmarks(
        "d_ggx(alpha = roughness) * v_ggx(alpha = roughness) * f_schlick() * n_dot_l",
        [0.157, 3.04, 2.69, 2.69],
    );
    check_landmarks(DIVIDED_TWICE, [1.0 / 3.0, 0.5, 5.62, 5.62]);
    check_landmarks(
        "d_ggx() * g2_ggx() * f_schlick() * n_dot_l",
        [3.0, 2.0, 0.178, 0.178],
    );
    check_landmarks(
        "d_ggx() * v_ggx() * f_schlick(v_dot_h = n_dot_v) * n_dot_l",
        [1.0, 0.999, 19.6, 0.999],
    );
    let pi = std::f64::consts::PI;
    check_landmarks("pi * d_ggx() * v_ggx() * f_schlick() * n_dot_l", [pi; 4]);
}

/// The lit area in which dividing twice brightens is min(1, 1 / (4 cos²(light/2))).
#[track_caller]
fn check_lit_area(light_deg: f64) {
    let picture = bug(CORRECT, DIVIDED_TWICE, 0.7, 0.95, light_deg).picture(&cpu(256));
    let cosine = (light_deg / 2.0).to_radians().cos();
    let expected = (1.0 / (4.0 * cosine * cosine)).min(1.0);
    let found = picture.report.visibility.lit_above_one;
    assert!(
        (found - expected).abs() < 2e-3,
        "{light_deg}°: {found} instead of {expected}"
    );
    if light_deg <= 120.0 {
        let disc = picture.report.visibility.disc_above_one;
        assert!(
            (disc - 0.25).abs() < 2e-3,
            "{light_deg}°: {disc} of the disc instead of 0.25"
        );
    }
}

#[test]
fn a_quarter_of_the_disc_turns_brighter_when_divided_twice() {
    [0.0, 30.0, 60.0, 90.0, 119.0, 150.0]
        .into_iter()
        .for_each(check_lit_area);
}

/// One row of the published table: roughness, light, rim over highlight of the buggy picture,
/// terminator step over highlight.
#[track_caller]
fn check_visibility(roughness: f64, light_deg: f64, rim: f64, terminator: f64) {
    let picture = bug(CORRECT, DIVIDED_TWICE, roughness, 0.9, light_deg).picture(&cpu(64));
    let visibility = picture.report.visibility;
    close(
        visibility.rim_over_highlight.0,
        rim,
        0.03,
        "rim over highlight",
    );
    close(
        visibility.terminator_step,
        terminator,
        0.01,
        "terminator step",
    );
}

#[test]
fn the_figures_say_where_the_double_division_shows() {
    check_visibility(0.2, 60.0, 0.00118, 0.000197);
    check_visibility(0.4, 60.0, 0.167, 0.0125);
    check_visibility(0.7, 30.0, 9.73, 0.95);
    check_visibility(0.7, 60.0, 5.58, 0.323);
    check_visibility(0.7, 90.0, 3.89, 0.241);
}

#[test]
fn raw_values_are_the_formula_at_the_pixels_centre() {
    let bug = bug(CORRECT, DIVIDED_TWICE, 0.4, 0.9, 60.0);
    let size = 65_u32;
    let raw = raw(&bug.fingerprint(), &cpu(size)).expect("the formulas fit the scene");
    let radius = RADIUS * f64::from(size) / 2.0;
    let (column, row) = (40_u32, 20_u32);
    let unit = |pixel: u32| (f64::from(pixel) + 0.5 - f64::from(size) / 2.0) / radius;
    let (x, y) = (unit(column), unit(row));
    let z = (1.0 - x * x - y * y).sqrt();
    let toward = |degrees: f64| x * degrees.to_radians().sin() + z * degrees.to_radians().cos();
    let values = [
        ("roughness", 0.4),
        ("f0", 0.9),
        ("n_dot_l", toward(60.0)),
        ("n_dot_v", z),
        ("n_dot_h", toward(30.0)),
        ("v_dot_h", 30_f64.to_radians().cos()),
    ]
    .map(|(name, value)| (name.to_owned(), value))
    .into();
    let index = (row * size + column) as usize;
    let expected = bug.library.eval(&bug.right, &values).expect("a value");
    close(raw.right[index], expected, 1e-12, "right");
    close(
        raw.wrong[index],
        expected / (4.0 * toward(60.0) * z),
        1e-12,
        "wrong",
    );
    assert_eq!(raw.right[0], 0.0, "nothing is outside the sphere");
}

/// Skipped pixels, lens and mirror change no bit; skipped terms change at most so many ulp of the
/// right and of the wrong values.
#[track_caller]
fn check_skipping(bug: &Bug, size: u32, ulps: (u64, u64)) {
    let skipping = raw(&bug.fingerprint(), &cpu(size)).expect("values");
    let all = raw(
        &bug.fingerprint(),
        &Options {
            skip: false,
            ..cpu(size)
        },
    )
    .expect("values");
    let apart = |a: &[f64], b: &[f64]| {
        assert_eq!(a.len(), b.len());
        // Radiance is never negative: its bits are in its order.
        let distances = a
            .iter()
            .zip(b)
            .map(|(a, b)| a.to_bits().abs_diff(b.to_bits()));
        distances.max().unwrap_or(0)
    };
    assert!(
        skipping.right.iter().any(|value| *value > 0.0),
        "all is black"
    );
    let right = apart(&skipping.right, &all.right);
    assert!(right <= ulps.0, "right: {right} ulps apart");
    let wrong = apart(&skipping.wrong, &all.wrong);
    assert!(wrong <= ulps.1, "wrong: {wrong} ulps apart");
}

#[test]
fn what_is_skipped_changes_nothing() {
    let at = |wrong, light_deg| bug(CORRECT, wrong, 0.4, 0.9, light_deg);
    check_skipping(&at(DIVIDED_TWICE, 60.0), 64, (0, 8));
    check_skipping(&at(DIVIDED_TWICE, 0.0), 65, (0, 8));
    check_skipping(&at(DIVIDED_TWICE, 140.0), 48, (0, 8));
    // Nothing cancels here.
    check_skipping(&at("d_ggx(alpha = roughness) * n_dot_l", 60.0), 65, (0, 0));
    check_skipping(&at("1 - n_dot_v", 100.0), 64, (0, 0));
    // D and F are constants.
    let wrong = "d_ggx() * v_ggx() * f_schlick() * n_dot_l * n_dot_l";
    check_skipping(&bug(CORRECT, wrong, 1.0, 1.0, 60.0), 64, (8, 8));
}

/// Scenes beyond one distant light seen from afar.
fn scenes() -> Vec<Scene> {
    let light = |deg, turn_deg, distance, colour| Light {
        turn_deg,
        distance,
        colour,
        ..Light::distant(deg)
    };
    let white = [1.0; 3];
    let one = Scene::new(0.4, 0.3, 60.0);
    let with = |eye, lights| Scene {
        eye,
        lights,
        ..one.clone()
    };
    let near = Eye::Perspective { distance: 3.0 };
    vec![
        with(near, vec![Light::distant(60.0)]),
        with(near, vec![light(110.0, 0.0, None, white)]),
        with(Eye::Orthographic, vec![light(60.0, 0.0, Some(2.5), white)]),
        with(near, vec![light(30.0, 70.0, Some(1.5), [1.0, 0.5, 0.25])]),
        with(Eye::Orthographic, vec![light(120.0, 90.0, None, white)]),
        with(
            Eye::Orthographic,
            vec![
                Light::distant(20.0),
                light(80.0, 180.0, None, white),
                light(100.0, 0.0, None, [0.2, 0.4, 0.6]),
            ],
        ),
        with(
            near,
            vec![
                Light::distant(45.0),
                light(130.0, 200.0, Some(4.0), [2.0, 0.0, 0.0]),
                // Behind the sphere, and dark: neither is seen.
                light(175.0, 0.0, Some(1.2), white),
                light(10.0, 0.0, None, [0.0; 3]),
            ],
        ),
        // Both in the vertical plane; both at the camera, where both halves are copied.
        with(
            near,
            vec![
                light(50.0, 90.0, Some(1.6), [1.0, 0.5, 0.25]),
                light(95.0, 270.0, None, white),
            ],
        ),
        with(Eye::Orthographic, vec![light(140.0, 270.0, None, white)]),
        with(near, vec![light(0.0, 0.0, Some(2.0), white)]),
    ]
}

#[test]
fn what_is_skipped_changes_nothing_in_any_scene() {
    for scene in scenes() {
        for (wrong, ulps) in [
            (DIVIDED_TWICE, (0, 8)),
            (
                "d_ggx() * v_ggx() * f_schlick(v_dot_h = n_dot_v) * n_dot_l",
                (0, 8),
            ),
            (
                "diffuse_oren_nayar(albedo = 0.5, sigma = 0.4) * n_dot_l",
                (0, 0),
            ),
        ] {
            let mut bug = bug(CORRECT, wrong, 0.4, 0.3, 60.0);
            bug.scene = Scene {
                radius: 0.8,
                ..scene.clone()
            };
            check_skipping(&bug, 57, ulps);
            check_skipping(&bug, 51, ulps);
            check_skipping(&bug, 40, ulps);
            check_skipping(&bug, 51, ulps);
        }
    }
}

/// Every sum of several lights is what the lights give one by one.
#[test]
fn lights_add_up() {
    let scene = scenes()[5].clone();
    let mut all = bug(CORRECT, DIVIDED_TWICE, 0.4, 0.3, 60.0);
    all.scene = scene.clone();
    let sum = raw(&all.fingerprint(), &cpu(48)).expect("values");
    let mut expected = vec![0.0; sum.right.len()];
    for light in &scene.lights {
        let mut one = bug(CORRECT, DIVIDED_TWICE, 0.4, 0.3, 60.0);
        one.scene.lights = vec![Light {
            colour: [1.0; 3],
            ..*light
        }];
        let alone = raw(&one.fingerprint(), &cpu(48)).expect("values");
        for (pixel, value) in alone.right.iter().enumerate() {
            for (channel, weight) in light.colour.iter().enumerate() {
                expected[3 * pixel + channel] += weight * value;
            }
        }
    }
    for (index, (found, expected)) in sum.right.iter().zip(&expected).enumerate() {
        assert!(
            (found - expected).abs() <= 1e-12 * expected.abs(),
            "{index}: {found}, {expected}"
        );
    }
}

/// A distant eye and a distant light are the limits of near ones.
#[test]
fn far_is_the_limit_of_near() {
    let mut far = bug(CORRECT, DIVIDED_TWICE, 0.5, 0.3, 60.0);
    let expected = raw(&far.fingerprint(), &cpu(48)).expect("values");
    far.scene.eye = Eye::Perspective { distance: 1e7 };
    far.scene.lights[0].distance = Some(1e7);
    let found = raw(&far.fingerprint(), &cpu(48)).expect("values");
    let brightest = expected.right.iter().fold(0.0_f64, |a, &b| a.max(b));
    for (found, expected) in found.right.iter().zip(&expected.right) {
        assert!(
            (found - expected).abs() < 1e-5 * brightest,
            "{found}, {expected}"
        );
    }
}

#[test]
fn the_plan_says_what_cancels_and_what_is_constant() {
    let report = bug(CORRECT, DIVIDED_TWICE, 0.7, 0.95, 60.0)
        .picture(&cpu(32))
        .report;
    let skipped = report.terms_skipped.join("; ");
    for expected in [
        "d_ggx() of the buggy formula: cancels",
        "f_schlick(): the same over the whole picture",
    ] {
        assert!(
            skipped.contains(expected),
            "{expected} is missing in {skipped}"
        );
    }
    assert_eq!(report.terms_evaluated, ["d_ggx()", "v_ggx()"]);
    let options = Options {
        skip: false,
        ..cpu(32)
    };
    let report = bug(CORRECT, DIVIDED_TWICE, 0.7, 0.95, 60.0)
        .picture(&options)
        .report;
    assert_eq!((report.pixels_skipped, report.terms_skipped.len()), (0, 0));
}

/// What the report of a scene says.
#[track_caller]
fn check_explained(scene: Scene, says: &[&str], not: &[&str]) {
    let mut bug = bug(CORRECT, DIVIDED_TWICE, 0.4, 0.3, 60.0);
    bug.scene = scene;
    let report = bug.picture(&cpu(32)).report;
    let text = report.explain.join("\n");
    for part in says {
        assert!(text.contains(part), "{part:?} is missing in\n{text}");
    }
    for part in not {
        assert!(!text.contains(part), "{part:?} is in\n{text}");
    }
}

#[test]
fn the_plan_knows_what_varies_in_a_scene() {
    let scenes = scenes();
    let constant = "f_schlick(): the same over the whole picture";
    let mirrors = "the lower half is copied";
    // V·H varies with a near eye or a near light.
    check_explained(scenes[0].clone(), &[mirrors], &[constant]);
    check_explained(scenes[2].clone(), &[mirrors], &[constant]);
    check_explained(scenes[3].clone(), &[], &[mirrors, constant]);
    let across = "the right half is copied";
    let both = "both halves beside the light's direction are shaded";
    check_explained(scenes[0].clone(), &[], &[across, both]);
    check_explained(scenes[3].clone(), &[both], &[across]);
    check_explained(scenes[7].clone(), &[across], &[mirrors, both]);
    check_explained(scenes[9].clone(), &[across, mirrors], &[both]);
    check_explained(
        scenes[4].clone(),
        &[constant, "evaluated once", across],
        &[mirrors],
    );
    check_explained(scenes[5].clone(), &[mirrors, "under each light"], &[]);
    check_explained(
        scenes[6].clone(),
        &[
            "light 3 is not shaded: it stands behind",
            "light 4 is not shaded: it gives no light",
        ],
        &["nothing is lit"],
    );
    let full = Scene {
        roughness: 1.0,
        f0: 1.0,
        ..scenes[0].clone()
    };
    check_explained(full, &["d_ggx(): the same", constant], &[]);
    let dark = Scene {
        lights: scenes[6].lights[2..].to_vec(),
        ..scenes[0].clone()
    };
    check_explained(dark.clone(), &["nothing is lit"], &[]);
    // So there is nothing to ask a graphics processor for.
    let mut unlit = bug(CORRECT, DIVIDED_TWICE, 0.4, 0.3, 60.0);
    unlit.scene = dark;
    let options = Options {
        backend: Backend::Gpu,
        ..cpu(32)
    };
    let report = unlit.picture(&options).report;
    assert_eq!((report.backend, report.points), ("cpu", 0));
}

#[test]
fn the_picture_shows_a_sphere_and_the_same_one_each_time() {
    let bug = bug(CORRECT, DIVIDED_TWICE, 0.7, 0.95, 60.0);
    let picture = bug.picture(&cpu(96));
    assert_eq!(
        picture.rgba.len(),
        (picture.width * picture.height * 4) as usize
    );
    let mut colours: Vec<&[u8]> = picture.rgba.chunks_exact(4).collect();
    colours.sort_unstable();
    colours.dedup();
    assert!(colours.len() > 200, "only {} colours", colours.len());
    assert_eq!(picture.rgba, bug.picture(&cpu(96)).rgba);
    assert!(picture.png().starts_with(b"\x89PNG\r\n"));
    let report = picture.report;
    assert_eq!(report.backend, "cpu");
    assert_eq!(report.pixels_shaded + report.pixels_skipped, 96 * 96);
    assert!(report.pixels_skipped > report.pixels_shaded);
    assert!(report.terms_evaluated.contains(&"d_ggx()".to_owned()));
    assert!(
        report
            .terms_skipped
            .iter()
            .any(|term| term.starts_with("f_schlick()"))
    );
}

#[test]
fn the_compact_picture_is_the_panels_alone() {
    let options = Options {
        compact: true,
        ..cpu(64)
    };
    let picture = bug(CORRECT, DIVIDED_TWICE, 0.7, 0.95, 60.0).picture(&options);
    assert_eq!((picture.width, picture.height), (3 * 64 + 4, 64));
}

#[test]
fn the_total_of_a_divergent_bug_grows_with_the_picture() {
    let sizes = [64, 256, 1024];
    let totals = |light_deg| {
        let bug = bug(CORRECT, DIVIDED_TWICE, 0.7, 0.95, light_deg);
        convergence(&bug.fingerprint(), &sizes).expect("totals")
    };
    let headlight = totals(0.0);
    close(
        headlight[0].right,
        headlight[2].right,
        2e-3,
        "the right total settles",
    );
    // ∫ dA/(N·V)² grows by the same amount with every doubling of the size.
    let steps = [1, 2].map(|i| headlight[i].wrong - headlight[i - 1].wrong);
    close(
        steps[1],
        steps[0],
        0.1,
        "the wrong total grows like a logarithm",
    );
    assert!(
        headlight[2].wrong > 1.2 * headlight[0].wrong,
        "{headlight:?}"
    );
    // Two doublings from one size to the next.
    let growth = |light_deg| {
        let bug = bug(CORRECT, DIVIDED_TWICE, 0.7, 0.95, light_deg);
        let seen = visibility(&bug.fingerprint(), &cpu(64)).expect("figures");
        seen.growth_per_doubling
    };
    let four = headlight[2].wrong - headlight[0].wrong;
    close(four, 4.0 * growth(0.0), 0.06, "as the figure says");
    let closed = 0.49 * 0.95 * std::f64::consts::LN_2 / (16.0 * std::f64::consts::PI);
    close(growth(0.0), closed, 1e-6, "which is α·F₀·ln 2 / 16π");
    let sixty = totals(60.0);
    close(sixty[1].wrong, sixty[2].wrong, 0.02, "elsewhere it settles");
    assert_eq!(growth(60.0), 0.0);
}

#[test]
fn a_point_of_the_sphere_can_be_asked_for() {
    let bug = bug(CORRECT, DIVIDED_TWICE, 0.7, 0.95, 60.0);
    let point = point_at(&bug.fingerprint(), 0.5, 0.0).expect("the highlight is lit");
    close(point.ratio, 1.0 / 3.0, 1e-12, "ratio at the highlight");
    assert_eq!(point_at(&bug.fingerprint(), -0.8, 0.0), None);
    assert_eq!(point_at(&bug.fingerprint(), 1.0, 1.0), None);
}

#[test]
fn what_cannot_be_drawn_is_said_in_one_line() {
    let cancelled = AtomicBool::new(true);
    let good = bug(CORRECT, CORRECT, 0.4, 0.04, 60.0);
    assert_eq!(
        render(&good.fingerprint(), &cpu(64), &cancelled).unwrap_err(),
        Error::Cancelled
    );
    let huge = render(&good.fingerprint(), &cpu(100_000), &AtomicBool::new(false)).unwrap_err();
    assert_eq!(huge, Error::Size(100_000));
    for (roughness, light_deg) in [
        (0.4, 180.0),
        (0.4, -1.0),
        (f64::NAN, 60.0),
        (0.4, f64::INFINITY),
    ] {
        let bad = bug(CORRECT, CORRECT, roughness, 0.04, light_deg);
        let error = render(&bad.fingerprint(), &cpu(64), &AtomicBool::new(false)).unwrap_err();
        assert!(matches!(error, Error::Scene(_)), "{error}");
        assert!(profile(&bad.fingerprint(), 9).is_empty());
    }
    let unknown = bug(CORRECT, "d_ggx() * colour", 0.4, 0.04, 60.0);
    let error = render(&unknown.fingerprint(), &cpu(64), &AtomicBool::new(false)).unwrap_err();
    assert!(error.to_string().contains("wrong formula"), "{error}");
    assert!(!error.to_string().contains('\n'), "{error}");
}

#[test]
fn values_outside_a_domain_paint_black_and_never_stop_the_picture() {
    let broken = bug(
        "ln(n_dot_l - 1)",
        "1 / (n_dot_h - n_dot_h)",
        0.4,
        0.04,
        60.0,
    );
    broken.picture(&cpu(32));
}

/// In f32 every operation is rounded to f32, so the values differ, and little.
#[test]
fn single_precision_is_close_and_not_the_same() {
    for skip in [true, false] {
        let bug = bug(CORRECT, DIVIDED_TWICE, 0.4, 0.9, 60.0);
        let wide = Options { skip, ..cpu(128) };
        let narrow = Options {
            precision: Precision::F32,
            ..wide
        };
        let (a, b) = [wide, narrow]
            .map(|options| raw(&bug.fingerprint(), &options).unwrap_or_else(|e| panic!("{e}")))
            .into();
        let pairs = || {
            a.right
                .iter()
                .chain(&a.wrong)
                .zip(b.right.iter().chain(&b.wrong))
        };
        let brightest = a.right.iter().fold(0.0_f64, |a, &b| a.max(b));
        for (a, b) in pairs() {
            let tolerance = 1e-5 * a.abs() + 1e-7 * brightest;
            assert!((a - b).abs() <= tolerance, "{a} and {b}");
        }
        assert!(pairs().any(|(a, b)| a != b), "nothing was computed in f32");
        assert_eq!(bug.picture(&narrow).report.precision, Precision::F32);
    }
}
