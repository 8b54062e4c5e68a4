//! Where to look for a bug, against what is known of it.

use formula::{Expr, Library};
use renders::{Fingerprint, Look, Scene, look};

const CORRECT: &str = "d_ggx() * v_ggx() * f_schlick() * n_dot_l";

fn at(wrong: &str, light_deg: f64, (x, y): (f64, f64)) -> Look {
    let parse = |text: &str| -> Expr { formula::parse(text).unwrap_or_else(|e| panic!("{e}")) };
    let (library, right) = (Library::new(), parse(CORRECT));
    let wrong = parse(&format!("{CORRECT}{wrong}"));
    let fingerprint = Fingerprint {
        lesson: "test",
        id: "test",
        title: String::new(),
        caption: String::new(),
        library: &library,
        right: &right,
        wrong: &wrong,
        scene: Scene::new(0.5, 0.04, light_deg),
    };
    look(&fingerprint, x, y).expect("it can be evaluated")
}

const TWICE: &str = " / (4 * n_dot_l * n_dot_v)";

#[test]
fn the_double_division_is_best_seen_at_the_rim() {
    // A lamp at the eye: the ratio is 1/(4 cos²), a quarter in the middle, unbounded at the rim.
    let middle = at(TWICE, 0.0, (0.0, 0.0));
    let here = middle.here.expect("lit");
    assert!((here.ratio - 0.25).abs() < 1e-12, "{here:?}");
    let best = middle.best().expect("it shows");
    assert!(
        best.x.hypot(best.y) > 0.97 && best.stops() > 3.0,
        "{best:?}"
    );
    let darkest = middle.darkest.expect("the middle");
    assert!(darkest.x.hypot(darkest.y) < 0.02, "{darkest:?}");
    assert!((darkest.stops() + 2.0).abs() < 1e-3, "{darkest:?}");
}

#[test]
fn beside_the_ball_and_in_the_dark_there_is_nothing() {
    assert_eq!(at(TWICE, 0.0, (0.8, 0.8)).here, None);
    assert_eq!(at(TWICE, 0.0, (f64::NAN, 0.0)).here, None);
    assert_eq!(at(TWICE, 120.0, (-0.5, 0.0)).here, None);
    assert!(at(TWICE, 120.0, (0.9, 0.0)).here.is_some());
}

#[test]
fn what_is_right_shows_nowhere() {
    let look = at(" * 1", 60.0, (0.1, 0.2));
    assert_eq!(look.best(), None);
    assert_eq!(look.here.map(|here| here.stops()), Some(0.0));
}

#[test]
fn what_is_too_dark_everywhere_has_no_brightest_place() {
    let look = at(" / pi", 60.0, (0.1, 0.2));
    assert_eq!(look.brightest, None);
    let best = look.best().expect("it shows everywhere");
    assert!((best.ratio - 1.0 / std::f64::consts::PI).abs() < 1e-12);
}
