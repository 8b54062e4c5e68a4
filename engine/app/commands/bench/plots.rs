//! Time against error as pictures: a point further left is faster, one further down is more
//! accurate, on both axes by decades.

use std::fs;
use std::path::{Path, PathBuf};

use renders::{Dot, PlotSpec, Shape, plot_png, plot_svg};
use truth::bench::Row;

use crate::exit::Failure;

const SIZE: (u32, u32) = (1200, 800);

/// Errors below these are drawn at them: on a logarithmic axis 0 has no place.
const LEAST_ULP: f64 = 0.1;
const LEAST_RELATIVE: f64 = 1e-8;

/// What belongs into one picture.
struct Picture {
    file: &'static str,
    title: &'static str,
    holds: fn(&Row) -> bool,
    /// What has one colour, and a line from point to point.
    colour: fn(&Row) -> String,
    shape: fn(&Row) -> Shape,
    /// What the shapes are, as far as they occur.
    shapes: &'static [(Shape, &'static str)],
    /// What stands beside a point, where there is room.
    label: fn(&Row) -> String,
    /// What the time is of.
    one: &'static str,
    /// Whether all points are ways to the same, so that one front goes through them.
    same: bool,
}

const PICTURES: &[Picture] = &[
    Picture {
        file: "batches",
        title: "Whole lobes, conductors, samples: many at once",
        holds: |row| row.error_unit == "ulp" && brdf::term(&row.group).is_none(),
        colour: |row| format!("{}/{}", row.group, row.variant),
        ..FORMS
    },
    Picture {
        file: "distributions",
        title: "Distributions D: as printed, stable, and in lanes",
        holds: |row| form(row, &["d_"]),
        ..FORMS
    },
    Picture {
        file: "masking",
        title: "Masking Λ and G1: as printed, stable, and in lanes",
        holds: |row| form(row, &["lambda_", "g1_"]),
        ..FORMS
    },
    Picture {
        file: "shadowing",
        title: "Shadowing G2 and visibility V: as printed, stable, and in lanes",
        holds: |row| form(row, &["g2_", "v_ggx"]),
        ..FORMS
    },
    Picture {
        file: "classic-shadowing",
        title: "The classic shadowing functions without roughness",
        holds: |row| form(row, &["gsf_"]) && !takes_roughness(row),
        ..FORMS
    },
    Picture {
        file: "rough-shadowing",
        title: "The classic shadowing functions with roughness",
        holds: |row| form(row, &["gsf_"]) && takes_roughness(row),
        ..FORMS
    },
    Picture {
        file: "fresnel",
        title: "Fresnel reflectance: as printed, stable, and in lanes",
        holds: |row| form(row, &["f_schlick", "f_spher", "f_diel", "f_cond", "f_laz"]),
        ..FORMS
    },
    Picture {
        file: "diffuse",
        title: "Diffuse models: as printed, stable, and in lanes",
        holds: |row| form(row, &["diffuse_"]),
        ..FORMS
    },
    Picture {
        file: "approximate-shadowing",
        title: "Approximations of shadowing, and what they stand for",
        holds: |row| stands_for(row).is_some_and(|exact| exact.starts_with(['g', 'v'])),
        ..APPROXIMATIONS
    },
    Picture {
        file: "approximate-fresnel-and-diffuse",
        title: "Approximations of Fresnel and of Oren-Nayar, and what they stand for",
        holds: |row| stands_for(row).is_some_and(|exact| exact.starts_with(['f', 'd'])),
        ..APPROXIMATIONS
    },
    Picture {
        file: "diffuse-and-walks",
        title: "Diffuse light leaving a rough surface: two models, and random walks",
        holds: |row| stands_for(row) == Some("walk"),
        colour: |row| match row.variant.split_once(' ') {
            Some((_, walks)) => format!("random {walks}"),
            None => row.variant.clone(),
        },
        same: true,
        ..APPROXIMATIONS
    },
    Picture {
        file: "albedo",
        title: "Directional albedo: quadrature, table, fits, samplers, and random walks",
        holds: |row| row.group == "albedo" || row.group == "walk_albedo",
        colour: |row| match row.variant.split_once([',', ' ']) {
            _ if row.group == "walk_albedo" => format!("random walks, {}", row.precision),
            Some(("fit", _)) => "published fits".to_owned(),
            Some(("table", _)) => row.variant.clone(),
            _ => row.variant.split(',').next().unwrap_or_default().to_owned(),
        },
        shape: |_| Shape::Disc,
        shapes: &[],
        label: |row| match row.variant.split_once(", ") {
            Some((count, "each")) => count.to_owned(),
            Some((_, more)) => more.to_owned(),
            None => row.variant.clone(),
        },
        one: "albedo",
        same: true,
    },
    Picture {
        file: "pictures",
        title: "Pictures: two formulas on a sphere, at several sizes",
        holds: |row| row.group.starts_with("render/"),
        colour: |row| format!("{}, {}", row.variant, row.precision),
        label: |row| {
            let size = row.group.trim_start_matches("render/");
            format!("{size} × {size}")
        },
        same: false,
        ..PICTURE
    },
    Picture {
        file: "samples",
        title: "Pictures of 128 × 128: samples a pixel",
        holds: |row| row.group.starts_with("render_samples/"),
        colour: |row| format!("cpu, {}", row.precision),
        label: |row| row.variant.trim_end_matches(" a pixel").to_owned(),
        ..PICTURE
    },
];

/// Pictures against better ones.
const PICTURE: Picture = Picture {
    shape: |_| Shape::Disc,
    shapes: &[],
    one: "picture",
    same: true,
    ..FORMS
};

/// The ways to compute one term.
const FORMS: Picture = Picture {
    file: "",
    title: "",
    holds: |_| false,
    colour: |row| row.group.clone(),
    shape: |row| match (row.variant.as_str(), row.isa) {
        ("naive", _) => Shape::Ring,
        ("stable" | "call", _) => Shape::Disc,
        (_, "avx2") => Shape::Diamond,
        (_, "avx512") => Shape::Triangle,
        _ => Shape::Square,
    },
    shapes: &[
        (Shape::Ring, "one call, as printed"),
        (Shape::Disc, "one call, stable"),
        (Shape::Square, "batch"),
        (Shape::Diamond, "batch, AVX2"),
        (Shape::Triangle, "batch, AVX-512"),
    ],
    label: |_| String::new(),
    one: "evaluation",
    same: false,
};

/// A line from each approximation to what it stands for.
const APPROXIMATIONS: Picture = Picture {
    colour: |row| format!("for {}", stands_for(row).unwrap_or_default()),
    shape: |row| match stands_for(row) {
        Some(exact) if exact != row.variant => Shape::Ring,
        _ => Shape::Disc,
    },
    shapes: &[
        (Shape::Ring, "approximation"),
        (Shape::Disc, "what it stands for, in single precision"),
    ],
    label: |row| row.variant.clone(),
    ..FORMS
};

/// What the rows of a group approximate.
fn stands_for(row: &Row) -> Option<&str> {
    row.group.strip_suffix(" approximated")
}

/// A way to compute a term in single precision whose name starts like this.
fn form(row: &Row, starts: &[&str]) -> bool {
    row.error_unit == "ulp"
        && brdf::term(&row.group).is_some()
        && starts.iter().any(|start| row.group.starts_with(start))
}

fn takes_roughness(row: &Row) -> bool {
    brdf::term(&row.group)
        .is_some_and(|term| term.params.iter().any(|param| param.name == "roughness"))
}

/// Draws everything that there are rows for into a folder; the files written.
pub fn write(rows: &[Row], machine: &str, folder: &Path) -> Result<Vec<PathBuf>, Failure> {
    let mut files = Vec::new();
    for picture in PICTURES {
        let shown: Vec<&Row> = rows.iter().filter(|row| (picture.holds)(row)).collect();
        if shown.is_empty() {
            continue;
        }
        let spec = spec(picture, &shown, machine);
        let cannot = |error| Failure::unusable(format!("plot {}: {error}", picture.file));
        let svg = plot_svg(&spec, SIZE.0, SIZE.1).map_err(cannot)?;
        let png = plot_png(&spec, SIZE.0, SIZE.1).map_err(cannot)?;
        for (extension, bytes) in [("svg", svg.into_bytes()), ("png", png)] {
            let path = folder.join(format!("bench-{}.{extension}", picture.file));
            fs::write(&path, bytes).map_err(|error| Failure::unwritable(&path, &error))?;
            files.push(path);
        }
    }
    Ok(files)
}

fn spec(picture: &Picture, rows: &[&Row], machine: &str) -> PlotSpec {
    let relative = rows[0].error_unit == "relative";
    let (least, unit) = if relative {
        (LEAST_RELATIVE, "relative")
    } else {
        (LEAST_ULP, "units in the last place of f32")
    };
    let (time, of_ns) = unit_of_time(rows);
    let point = |row: &Row| (row.ns * of_ns, row.max_ulp.max(least));
    let mut series: Vec<(String, Vec<(f64, f64)>)> = Vec::new();
    let mut dots = Vec::new();
    for row in rows {
        let name = written((picture.colour)(row));
        let index = match series.iter().position(|series| series.0 == name) {
            Some(index) => index,
            None => {
                series.push((name, Vec::new()));
                series.len() - 1
            }
        };
        series[index].1.push(point(row));
        dots.push(Dot {
            series: index,
            shape: (picture.shape)(row),
            at: point(row),
            label: written((picture.label)(row)),
            outlined: row.pareto && !picture.same,
        });
    }
    let mut shapes = picture.shapes.to_vec();
    shapes.retain(|(shape, _)| dots.iter().any(|dot| dot.shape == *shape));
    // Short where there is more to say: the axis is no longer than the picture is high.
    let y_label = match rows.iter().any(|row| row.max_ulp < least) {
        true if relative => format!("worst error, relative; bottom: {least:e} or less"),
        true => format!("worst error, ulp of f32; bottom: {least} or less"),
        false => format!("worst error found, {unit}"),
    };
    PlotSpec {
        title: picture.title.to_owned(),
        x_label: format!("{time} for one {}, {machine}", picture.one),
        y_label,
        x_log: true,
        y_log: true,
        series,
        dots,
        shapes: shapes
            .into_iter()
            .map(|(shape, says)| (shape, says.to_owned()))
            .collect(),
        front: if picture.same {
            front(rows.iter().map(|row| point(row)).collect())
        } else {
            Vec::new()
        },
        ..PlotSpec::default()
    }
}

/// The unit of time in which the shortest is at least a tenth, and what a nanosecond is in it.
fn unit_of_time(rows: &[&Row]) -> (&'static str, f64) {
    let least = rows.iter().map(|row| row.ns).fold(f64::INFINITY, f64::min);
    match least {
        1e5.. => ("milliseconds", 1e-6),
        1e3.. => ("microseconds", 1e-3),
        _ => ("nanoseconds", 1.0),
    }
}

/// A name as it is printed: sizes with the sign that is not on every keyboard.
fn written(name: String) -> String {
    name.replace(" x ", " × ")
}

/// The points that no other is both left of and below, from left to right.
fn front(mut points: Vec<(f64, f64)>) -> Vec<(f64, f64)> {
    points.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let mut lowest = f64::INFINITY;
    points.retain(|point| {
        let better = point.1 < lowest;
        lowest = lowest.min(point.1);
        better
    });
    points
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(group: &str, variant: &str, isa: &'static str, ns: f64, max_ulp: f64) -> Row {
        Row {
            group: group.into(),
            variant: variant.into(),
            precision: "f32",
            isa,
            ns,
            limit_ratio: None,
            products_ratio: None,
            needs: None,
            max_ulp,
            p999_ulp: max_ulp,
            median_ulp: 0.0,
            error_unit: if group == "albedo" { "relative" } else { "ulp" },
            pareto: true,
        }
    }

    #[test]
    fn pictures_name_what_they_show() {
        let rows = [
            row("d_ggx", "stable", "baseline", 4.0, 7.0),
            row("d_ggx", "naive", "baseline", 3.0, 2e6),
            row("d_ggx", "batch", "avx2", 0.5, 7.0),
            row("specular", "batch", "baseline", 1.2, 9.0),
            row("specular", "batch", "avx2", 0.6, 9.0),
            row("albedo", "quadrature", "baseline", 9e3, 0.0),
            row("albedo", "cosine, 16 samples", "baseline", 9e2, 0.5),
        ];
        let folder = tempfile::tempdir().expect("a folder");
        let files = write(&rows, "a machine", folder.path()).expect("plots");
        let names: Vec<_> = files
            .iter()
            .filter_map(|file| file.file_name()?.to_str())
            .collect();
        assert_eq!(
            names,
            [
                "bench-batches.svg",
                "bench-batches.png",
                "bench-distributions.svg",
                "bench-distributions.png",
                "bench-albedo.svg",
                "bench-albedo.png"
            ]
        );
        let svg = |index: usize| fs::read_to_string(&files[index]).expect("text");
        for (index, label) in [
            (0, "specular/batch"),
            (0, "batch, AVX2"),
            (0, "nanoseconds for one evaluation, a machine"),
            (2, "d_ggx"),
            (2, "one call, as printed"),
            (2, "units in the last place"),
            (4, "quadrature"),
            (4, "16 samples"),
            (4, "Pareto front"),
            (4, "relative; bottom: 1e-8 or less"),
        ] {
            assert!(svg(index).contains(label), "{label}");
        }
        assert!(!svg(0).contains("Pareto front:"));
    }

    #[test]
    fn times_are_written_without_powers_of_ten() {
        let unit_of = |ns| unit_of_time(&[&row("d_ggx", "call", "baseline", ns, 1.0)]).0;
        assert_eq!(unit_of(0.2), "nanoseconds");
        assert_eq!(unit_of(2e4), "microseconds");
        assert_eq!(unit_of(4e5), "milliseconds");
    }

    #[test]
    fn a_front_is_what_nothing_beats() {
        let points = vec![(2.0, 2.0), (1.0, 3.0), (3.0, 2.5), (2.0, 1.0), (4.0, 0.5)];
        assert_eq!(front(points), [(1.0, 3.0), (2.0, 1.0), (4.0, 0.5)]);
    }
}
