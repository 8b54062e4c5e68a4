//! A shader that is no formula, drawn in the wrong one's place.

use formula::Library;
use renders::{Fingerprint, Options, Own, Scene, profile_own, render, render_own};
use std::sync::atomic::AtomicBool;

fn with(wrong: &str, check: impl FnOnce(&Fingerprint<'_>, &Fingerprint<'_>)) {
    let library = Library::new();
    let right = formula::parse("d_ggx() * n_dot_l").expect("a formula");
    let wrong = formula::parse(wrong).expect("a formula");
    let fingerprint = |wrong| Fingerprint {
        lesson: "test",
        id: "own",
        title: String::new(),
        caption: String::new(),
        library: &library,
        right: &right,
        wrong,
        scene: Scene::new(0.5, 0.04, 50.0),
    };
    check(&fingerprint(&right), &fingerprint(&wrong));
}

fn params(names: &[&str]) -> Vec<String> {
    names.iter().map(|name| (*name).to_owned()).collect()
}

#[test]
fn an_own_shader_draws_what_the_same_formula_draws() {
    with("roughness * n_dot_l * n_dot_l", |plain, wrong| {
        let own = Own::new(params(&["roughness", "n_dot_l"]), |points| {
            points.iter().map(|it| it[0] * it[1] * it[1]).collect()
        });
        let options = Options {
            size: 64,
            compact: true,
            backend: renders::Backend::Cpu,
            ..Options::default()
        };
        let cancel = AtomicBool::new(false);
        let drawn = render_own(plain, &own, &options, &cancel).expect("a picture");
        let formula = render(wrong, &options, &cancel).expect("a picture");
        assert_eq!(drawn.rgba.len(), formula.rgba.len());
        let apart = drawn.rgba.iter().zip(&formula.rgba);
        let apart = apart.filter(|(a, b)| a.abs_diff(**b) > 1).count();
        assert_eq!(apart, 0, "f32 for f64 moves a byte by one at most");
        let points = profile_own(plain, &own, 9);
        assert_eq!(points.len(), 9);
        for point in points {
            let expected = 0.5 * point.n_dot_l * point.n_dot_l;
            assert!((point.wrong - expected).abs() < 1e-6, "{point:?}");
            assert!(
                (point.right - point.wrong / point.ratio).abs() < 1e-6,
                "{point:?}"
            );
        }
    });
}

#[test]
fn a_quantity_that_the_scene_does_not_give_is_said() {
    with("n_dot_l", |plain, _| {
        let own = Own::new(params(&["thickness"]), |points| vec![0.0; points.len()]);
        let drawn = render_own(plain, &own, &Options::default(), &AtomicBool::new(false));
        let error = drawn.expect_err("no thickness").to_string();
        assert!(error.contains("thickness"), "{error}");
    });
}

#[test]
fn what_has_no_value_is_black() {
    with("n_dot_l", |plain, _| {
        let own = Own::new(params(&["n_dot_l"]), |_| Vec::new());
        for point in profile_own(plain, &own, 5) {
            assert_eq!(point.wrong, 0.0, "{point:?}");
        }
    });
}
