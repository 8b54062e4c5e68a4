//! Draws the fingerprints that are worth looking at while working on this crate:
//! `cargo run -p renders --example gallery -- DIR [SIZE]`.

use renders::{Backend, Fingerprint, MapSpec, Options, PlotSpec, Scale, Scene};
use std::sync::atomic::AtomicBool;

const ROWS: [(&str, &str, &str, f64, f64, f64); 8] = [
    (
        "double-division",
        "specular",
        "specular / (4 * n_dot_l * n_dot_v)",
        0.7,
        0.95,
        60.0,
    ),
    (
        "double-division-smooth",
        "specular",
        "specular / (4 * n_dot_l * n_dot_v)",
        0.2,
        0.95,
        60.0,
    ),
    (
        "double-division-headlight",
        "specular",
        "specular / (4 * n_dot_l * n_dot_v)",
        0.7,
        0.95,
        0.0,
    ),
    (
        "double-division-behind",
        "specular",
        "specular / (4 * n_dot_l * n_dot_v)",
        0.7,
        0.95,
        130.0,
    ),
    (
        "square-forgotten",
        "specular",
        "d_ggx(alpha = roughness) * v_ggx(alpha = roughness) * f_schlick() * n_dot_l",
        0.4,
        0.9,
        60.0,
    ),
    (
        "fresnel-n-dot-v",
        "specular",
        "d_ggx() * v_ggx() * f_schlick(v_dot_h = n_dot_v) * n_dot_l",
        0.7,
        0.04,
        60.0,
    ),
    ("pi-lost", "specular", "pi * specular", 0.4, 0.95, 60.0),
    ("nothing", "specular", "specular", 0.4, 0.95, 60.0),
];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let folder = arguments.next().unwrap_or_else(|| ".".to_owned());
    let size = arguments.next().map_or(Ok(368), |text| text.parse())?;
    let backend = match arguments.next().as_deref() {
        Some("gpu") => Backend::Gpu,
        Some("auto") => Backend::Auto,
        _ => Backend::Cpu,
    };
    let library = formula::Library::new();
    let specular = "d_ggx() * v_ggx() * f_schlick() * n_dot_l";
    for (id, right, wrong, roughness, f0, light_deg) in ROWS {
        let parse = |text: &str| formula::parse(&text.replace("specular", specular));
        let (right, wrong) = (parse(right)?, parse(wrong)?);
        let fingerprint = Fingerprint {
            lesson: "gallery",
            id,
            title: format!("Gallery: {id}"),
            caption: "A caption that says in one or two sentences what there is to see in the picture, and where the eye should go first.".to_owned(),
            library: &library,
            right: &right,
            wrong: &wrong,
            scene: Scene::new(roughness, f0, light_deg),
        };
        let options = Options {
            size,
            backend,
            ..Options::default()
        };
        let picture = renders::render(&fingerprint, &options, &AtomicBool::new(false))?;
        println!("{id}: {:?}", picture.report);
        std::fs::write(format!("{folder}/{id}.png"), picture.png())?;
        if id == "double-division" {
            let raw = renders::raw(&fingerprint, &options)?;
            std::fs::write(format!("{folder}/{id}.exr"), raw.exr())?;
        }
        let small = Options {
            size: 64,
            compact: true,
            ..options
        };
        let picture = renders::render(&fingerprint, &small, &AtomicBool::new(false))?;
        std::fs::write(format!("{folder}/{id}-compact.png"), picture.png())?;
    }

    let over = |f: fn(f64) -> f64| {
        (1..=100)
            .map(|i| f64::from(i) / 100.0)
            .map(|x| (x, f(x)))
            .collect()
    };
    let plot = PlotSpec {
        title: "Dividing twice: the buggy value over the correct one".to_owned(),
        x_label: "N·V".to_owned(),
        y_label: "buggy / correct".to_owned(),
        y_log: true,
        series: vec![
            ("N·L = 0.85".to_owned(), over(|x| 1.0 / (4.0 * 0.85 * x))),
            ("N·L = 0.5".to_owned(), over(|x| 1.0 / (2.0 * x))),
            ("N·L = 0.3".to_owned(), over(|x| 1.0 / (1.2 * x))),
        ],
        marks: vec![("equal: N·V = 0.5".to_owned(), 0.5, 1.0)],
        ..PlotSpec::default()
    };
    std::fs::write(
        format!("{folder}/plot.svg"),
        renders::plot_svg(&plot, 800, 500)?,
    )?;
    std::fs::write(
        format!("{folder}/plot.png"),
        renders::plot_png(&plot, 800, 500)?,
    )?;
    maps(&folder)
}

/// White furnaces: the albedo of the correct lobe and of the one that divides twice.
fn maps(folder: &str) -> Result<(), Box<dyn std::error::Error>> {
    const CELLS: usize = 40;
    let library = formula::Library::new();
    for (id, text, scale, value_label) in [
        (
            "furnace",
            "albedo_ggx()",
            Scale::Linear(0.0, 1.0),
            "albedo, F = 1",
        ),
        (
            "furnace-divided-twice",
            "albedo_ggx_divided_twice() / albedo_ggx()",
            Scale::Ratio,
            "albedo, divided twice / correct",
        ),
    ] {
        let expr = formula::parse(text)?;
        let cell = |i: usize| (i as f64 + 0.5) / CELLS as f64;
        let mut values = Vec::new();
        for row in 0..CELLS {
            for column in 0..CELLS {
                let given = [("n_dot_v", cell(column)), ("roughness", cell(row))];
                let given = given.map(|(name, value)| (name.to_owned(), value)).into();
                values.push(library.eval(&expr, &given)?);
            }
        }
        let spec = MapSpec {
            title: format!("White furnace: {text}"),
            x_label: "N·V".to_owned(),
            y_label: "roughness".to_owned(),
            value_label: value_label.to_owned(),
            x: (0.0, 1.0),
            y: (0.0, 1.0),
            columns: CELLS,
            values,
            scale,
        };
        std::fs::write(
            format!("{folder}/{id}.png"),
            renders::map_png(&spec, 800, 560)?,
        )?;
    }
    Ok(())
}
