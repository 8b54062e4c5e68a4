//! The graphics processor and the CPU agree. Without an adapter the tests say that they were
//! skipped; with LOBE_REQUIRE_GPU=1 they fail instead.

use formula::Library;
use renders::{Backend, Error, Eye, Fingerprint, Light, Options, Scene, gpu_adapter, raw, render};
use std::sync::atomic::AtomicBool;

fn adapter() -> bool {
    match gpu_adapter() {
        Ok(_) => true,
        Err(error) => {
            let required = std::env::var("LOBE_REQUIRE_GPU").is_ok_and(|value| value == "1");
            assert!(!required, "LOBE_REQUIRE_GPU=1, but {error}");
            println!("skipped: no Vulkan adapter ({error})");
            false
        }
    }
}

/// Both backends on one wrong formula: relative difference where a value is not tiny.
#[track_caller]
fn check_agreement(wrong: &str, scene: Scene) {
    let mut library = Library::new();
    library
        .define("s", &["c", "alpha"], "sqrt(alpha^2 + (1 - alpha^2) * c^2)")
        .and_then(|()| {
            library.define(
                "visibility",
                &["n_dot_l", "n_dot_v", "alpha"],
                "0.5 / (n_dot_l * s(c = n_dot_v) + n_dot_v * s(c = n_dot_l))",
            )
        })
        .expect("definitions");
    let right = formula::parse("d_ggx() * visibility() * f_schlick() * n_dot_l").expect("right");
    let wrong = formula::parse(wrong).expect("wrong");
    let fingerprint = Fingerprint {
        lesson: "test",
        id: "gpu",
        title: String::new(),
        caption: String::new(),
        library: &library,
        right: &right,
        wrong: &wrong,
        scene,
    };
    let options = |backend| Options {
        size: 96,
        backend,
        ..Options::default()
    };
    let cpu = raw(&fingerprint, &options(Backend::Cpu)).expect("the CPU draws");
    let gpu = match raw(&fingerprint, &options(Backend::Gpu)) {
        Ok(raw) => raw,
        Err(error) => panic!("{error}"),
    };
    for (which, cpu, gpu) in [
        ("right", &cpu.right, &gpu.right),
        ("wrong", &cpu.wrong, &gpu.wrong),
    ] {
        let brightest = cpu.iter().fold(0.0_f64, |a, &b| a.max(b));
        for (index, (&a, &b)) in cpu.iter().zip(gpu).enumerate() {
            let tolerance = 2e-4 * a.abs() + 1e-7 * brightest;
            assert!(
                (a - b).abs() <= tolerance,
                "{which} at pixel {index}: {a} and {b}"
            );
        }
    }
}

#[test]
fn both_backends_agree() {
    if !adapter() {
        return;
    }
    let divided_twice = "d_ggx() * visibility() * f_schlick() * n_dot_l / (4 * n_dot_l * n_dot_v)";
    let one = |roughness, light_deg| Scene::new(roughness, 0.9, light_deg);
    check_agreement(divided_twice, one(0.7, 60.0));
    check_agreement(divided_twice, one(0.2, 30.0));
    let lights = |lights| Scene {
        lights,
        ..one(0.5, 0.0)
    };
    let coloured = Light {
        turn_deg: 200.0,
        distance: Some(2.0),
        colour: [1.0, 0.5, 0.2],
        ..Light::distant(70.0)
    };
    check_agreement(
        divided_twice,
        lights(vec![Light::distant(60.0), Light::distant(20.0)]),
    );
    check_agreement(divided_twice, lights(vec![coloured, Light::distant(100.0)]));
    check_agreement(
        "d_ggx() * v_ggx() * diffuse_oren_nayar(albedo = 0.5, sigma = 0.5) * n_dot_l",
        Scene {
            eye: Eye::Perspective { distance: 2.5 },
            ..lights(vec![coloured])
        },
    );
    check_agreement(
        "d_ggx(alpha = roughness) * v_ggx(alpha = roughness) * f_schlick() * n_dot_l",
        one(0.4, 60.0),
    );
    check_agreement(
        "d_ggx() * v_ggx() * f_schlick(v_dot_h = n_dot_v) * n_dot_l",
        one(0.5, 100.0),
    );
}

/// The whole pictures: the same to the eye, nearly everywhere to the byte.
#[test]
fn both_backends_draw_the_same_picture() {
    if !adapter() {
        return;
    }
    let library = Library::new();
    let right = formula::parse("d_ggx() * v_ggx() * f_schlick() * n_dot_l").expect("right");
    let wrong = formula::parse("d_ggx() * v_ggx() * n_dot_l").expect("wrong");
    let fingerprint = Fingerprint {
        lesson: "test",
        id: "gpu",
        title: "The same".to_owned(),
        caption: "from both".to_owned(),
        library: &library,
        right: &right,
        wrong: &wrong,
        scene: Scene::new(0.5, 0.3, 60.0),
    };
    let draw = |backend| {
        let options = Options {
            size: 128,
            backend,
            ..Options::default()
        };
        render(&fingerprint, &options, &AtomicBool::new(false)).unwrap_or_else(|e| panic!("{e}"))
    };
    let (cpu, gpu) = (draw(Backend::Cpu), draw(Backend::Gpu));
    assert_eq!((cpu.width, cpu.height), (gpu.width, gpu.height));
    assert_eq!(gpu.report.backend, "gpu");
    assert!(gpu.report.adapter.is_some());
    let apart = cpu
        .rgba
        .iter()
        .zip(&gpu.rgba)
        .filter(|(a, b)| a.abs_diff(**b) > 2)
        .count();
    assert!(
        apart * 1000 < cpu.rgba.len(),
        "{apart} of {} bytes differ",
        cpu.rgba.len()
    );
}

#[test]
fn a_missing_adapter_is_one_line_with_what_to_install() {
    let error = Error::NoAdapter("none was found".to_owned()).to_string();
    assert!(
        error.contains("mesa-vulkan-drivers") && !error.contains('\n'),
        "{error}"
    );
}
