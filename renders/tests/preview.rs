//! A picture drawn again and again shows what a picture drawn once shows.

use formula::{Expr, Library};
use renders::{Backend, Eye, Fingerprint, Light, Options, Preview, Scene, raw, render};
use std::sync::atomic::AtomicBool;

const RIGHT: &str = "d_ggx() * v_ggx() * f_schlick() * n_dot_l";
const TWICE: &str = "d_ggx() * v_ggx() * f_schlick() * n_dot_l / (4 * n_dot_l * n_dot_v)";
const N_DOT_V: &str = "d_ggx() * v_ggx() * f_schlick(v_dot_h = n_dot_v) * n_dot_l";

struct Bug {
    library: Library,
    right: Expr,
    wrong: Expr,
}

impl Bug {
    fn new(wrong: &str) -> Self {
        let parse = |text| formula::parse(text).unwrap_or_else(|error| panic!("{error}"));
        Self {
            library: Library::new(),
            right: parse(RIGHT),
            wrong: parse(wrong),
        }
    }

    fn fingerprint(&self, scene: &Scene) -> Fingerprint<'_> {
        Fingerprint {
            lesson: "test",
            id: "test",
            title: String::new(),
            caption: String::new(),
            library: &self.library,
            right: &self.right,
            wrong: &self.wrong,
            scene: scene.clone(),
        }
    }

    /// Ready for a scene that is none of those drawn.
    fn preview(&self) -> Preview {
        let scene = Scene::new(0.31, 0.5, 17.0);
        Preview::new(&self.fingerprint(&scene)).unwrap_or_else(|error| panic!("{error}"))
    }
}

fn options() -> Options {
    Options {
        size: 64,
        backend: Backend::Cpu,
        compact: true,
        ..Options::default()
    }
}

/// To the last bit: linear values, pixels, exposure and figures.
#[track_caller]
fn same_as_drawn_once(preview: &mut Preview, bug: &Bug, scene: &Scene) {
    let fingerprint = bug.fingerprint(scene);
    let once = raw(&fingerprint, &options()).unwrap_or_else(|error| panic!("{error}"));
    let values = preview.raw(scene, 64).unwrap_or_else(|e| panic!("{e}"));
    assert!(once.right.iter().any(|value| *value > 0.0), "{scene:?}");
    assert_eq!(values, once, "{scene:?}");
    let picture = render(&fingerprint, &options(), &AtomicBool::new(false));
    let picture = picture.unwrap_or_else(|error| panic!("{error}"));
    let frame = preview.draw(scene, 64, 0.0);
    let frame = frame.unwrap_or_else(|error| panic!("{error}"));
    assert_eq!((frame.width, frame.height), (picture.width, picture.height));
    assert_eq!(frame.exposure, picture.report.exposure);
    assert_eq!(frame.visibility, picture.report.visibility);
    assert!(frame.rgba == picture.rgba, "other pixels: {scene:?}");
}

#[test]
fn every_scene_looks_as_it_does_when_drawn_once() {
    for wrong in [TWICE, N_DOT_V] {
        let bug = Bug::new(wrong);
        let mut preview = bug.preview();
        let mut turned = Scene::new(0.6, 0.9, 50.0);
        turned.lights[0].turn_deg = 70.0;
        turned.lights.push(Light::distant(120.0));
        let near = Scene {
            eye: Eye::Perspective { distance: 3.0 },
            ..Scene::new(0.5, 0.04, 35.0)
        };
        for scene in [
            Scene::new(0.7, 0.95, 60.0),
            Scene::new(0.2, 0.95, 60.0),
            Scene::new(0.7, 0.04, 0.0),
            Scene::new(0.99, 0.3, 140.0),
            turned,
            near,
            // And back again: nothing is left over.
            Scene::new(0.7, 0.95, 60.0),
        ] {
            same_as_drawn_once(&mut preview, &bug, &scene);
        }
    }
}

#[test]
fn roughness_changes_the_panels_and_not_a_ratio_that_is_free_of_it() {
    let bug = Bug::new(TWICE);
    let mut preview = bug.preview();
    let [rough, smooth] = [0.7, 0.3].map(|roughness| {
        preview
            .draw(&Scene::new(roughness, 0.95, 60.0), 64, 0.0)
            .unwrap_or_else(|error| panic!("{error}"))
    });
    let panel = |frame: &renders::Frame, from: u32, to: u32| -> Vec<u8> {
        let row = |y: u32| {
            let at = |x: u32| (4 * (y * frame.width + x)) as usize;
            frame.rgba[at(from)..at(to)].to_vec()
        };
        (0..frame.height).flat_map(row).collect()
    };
    let width = rough.width;
    assert!(panel(&rough, 0, 64) != panel(&smooth, 0, 64), "correct");
    assert!(panel(&rough, 66, 130) != panel(&smooth, 66, 130), "buggy");
    let ratio = |frame| panel(frame, width - 64, width);
    assert!(
        ratio(&rough) == ratio(&smooth),
        "1/(4 N·L N·V) has no alpha"
    );
    let (rough, smooth) = (rough.visibility, smooth.visibility);
    assert_eq!(rough.lit_above_one, smooth.lit_above_one);
    assert_eq!(rough.ratio_at_highlight, smooth.ratio_at_highlight);
    assert!(rough.rim_over_highlight.0 > smooth.rim_over_highlight.0);
}

#[test]
fn exposure_is_a_power_of_two_on_both_panels() {
    let bug = Bug::new(TWICE);
    let mut preview = bug.preview();
    let scene = Scene::new(0.7, 0.95, 60.0);
    let mut draw = |stops| preview.draw(&scene, 64, stops).expect("a picture");
    let (plain, brighter) = (draw(0.0), draw(2.0));
    assert_eq!(brighter.exposure, 4.0 * plain.exposure);
    let sum = |frame: &renders::Frame| frame.rgba.iter().map(|byte| u64::from(*byte)).sum::<u64>();
    assert!(sum(&brighter) > sum(&plain));
}

#[test]
fn what_the_formulas_need_is_known_and_other_givens_are_refused() {
    let bug = Bug::new(TWICE);
    let mut preview = bug.preview();
    for (name, needed) in [("alpha", true), ("f0", true), ("albedo", false)] {
        assert_eq!(preview.needs(name), needed, "{name}");
    }
    let mut scene = Scene::new(0.7, 0.95, 60.0);
    scene.others.insert("albedo".to_owned(), 0.5);
    assert!(preview.draw(&scene, 64, 0.0).is_err());
    assert!(preview.draw(&Scene::new(0.7, 0.95, 60.0), 64, 0.0).is_ok());
    assert!(preview.draw(&Scene::new(0.7, 0.95, 60.0), 8, 0.0).is_err());
    assert!(
        preview
            .draw(&Scene::new(0.7, 0.95, 200.0), 64, 0.0)
            .is_err()
    );
}
