//! Plots keep what they are given: labels, curves, marks.

use renders::{Error, MapSpec, PlotSpec, Scale, map_pixels, map_png, plot_png, plot_svg};

fn spec() -> PlotSpec {
    PlotSpec {
        title: "G2 & V < 1".to_owned(),
        x_label: "N·V".to_owned(),
        y_label: "buggy / correct".to_owned(),
        y_log: true,
        series: vec![
            (
                "N·L = 0.5".to_owned(),
                (1..50)
                    .map(|i| f64::from(i) / 50.0)
                    .map(|x| (x, 0.5 / x))
                    .collect(),
            ),
            (
                "broken".to_owned(),
                vec![(0.1, f64::NAN), (0.2, -1.0), (0.3, f64::INFINITY)],
            ),
        ],
        marks: vec![("equal here".to_owned(), 0.5, 1.0)],
        ..PlotSpec::default()
    }
}

#[test]
fn the_svg_holds_every_label() {
    let svg = plot_svg(&spec(), 800, 500).expect("a plot");
    for label in [
        "N·V",
        "buggy / correct",
        "N·L = 0.5",
        "equal here",
        "G2 &amp; V &lt; 1",
        "width=\"800\"",
    ] {
        assert!(svg.contains(label), "{label} is missing in\n{svg}");
    }
    assert!(svg.contains("polyline"));
    assert!(!svg.contains("NaN"));
}

#[test]
fn the_png_is_a_picture_of_the_size_asked_for() {
    let png = plot_png(&spec(), 320, 200).expect("a plot");
    assert!(png.starts_with(b"\x89PNG\r\n"));
    assert_eq!(png[16..24], [0, 0, 1, 64, 0, 0, 0, 200]);
}

#[test]
fn a_plot_without_values_or_room_is_an_error() {
    assert!(matches!(
        plot_svg(&PlotSpec::default(), 800, 500),
        Err(Error::Plot(_))
    ));
    assert!(matches!(plot_png(&spec(), 20, 20), Err(Error::Plot(_))));
    assert!(matches!(plot_svg(&spec(), 0, 0), Err(Error::Plot(_))));
}

/// The vertical axis ends where it is told to; nothing lies between ends that cross.
#[test]
fn ends_that_are_given_are_kept() {
    let ends = |y_ends| {
        let spec = PlotSpec { y_ends, ..spec() };
        plot_svg(&spec, 800, 500)
    };
    let label = |svg: &str, label: &str| svg.contains(&format!("\n{label}\n"));
    let free = ends((None, None)).expect("a plot");
    assert!(!label(&free, "1000") && label(&free, "10"), "{free}");
    let given = ends((Some(0.1), Some(1000.0))).expect("a plot");
    assert!(label(&given, "1000") && label(&given, "0.1"), "{given}");
    assert!(matches!(ends((Some(10.0), Some(1.0))), Err(Error::Plot(_))));
}

fn map(scale: Scale, values: Vec<f64>) -> MapSpec {
    MapSpec {
        title: "a map".to_owned(),
        x_label: "N·V".to_owned(),
        y_label: "roughness".to_owned(),
        value_label: "albedo".to_owned(),
        x: (0.0, 1.0),
        y: (0.0, 1.0),
        columns: 2,
        values,
        scale,
    }
}

#[test]
fn the_pixels_of_a_map_begin_at_its_top() {
    let values = vec![0.0, f64::NAN, 1.0, 1.0];
    let pixels = map_pixels(&map(Scale::Linear(0.0, 1.0), values), 2, 2).expect("a map");
    let pixel = |index: usize| &pixels[4 * index..4 * index + 4];
    assert_eq!(pixel(0), pixel(1), "the upper row is bright");
    assert!(pixel(0)[1] > 200 && pixel(2)[1] < 50, "{pixels:?}");
    assert_eq!(pixel(3), [0; 4], "no value");
}

#[test]
fn a_map_is_a_picture_whatever_its_values() {
    for scale in [
        Scale::Linear(0.0, 1.0),
        Scale::Log(0.01, 100.0),
        Scale::Ratio,
    ] {
        let values = vec![0.0, f64::NAN, f64::INFINITY, 0.5];
        let png = map_png(&map(scale, values), 400, 300).expect("a map");
        assert!(png.starts_with(b"\x89PNG\r\n"));
    }
    assert!(matches!(
        map_png(&map(Scale::Ratio, vec![1.0; 3]), 400, 300),
        Err(Error::Plot(_))
    ));
    assert!(matches!(
        map_png(&map(Scale::Ratio, vec![]), 400, 300),
        Err(Error::Plot(_))
    ));
    assert!(matches!(
        map_png(&map(Scale::Ratio, vec![1.0; 4]), 30, 30),
        Err(Error::Plot(_))
    ));
}
