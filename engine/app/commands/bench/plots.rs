//! Time against error as pictures: a point further left is faster, one further down is more
//! accurate, on both axes by decades.

use std::fs;
use std::path::{Path, PathBuf};

use renders::{PlotSpec, plot_png, plot_svg};
use truth::bench::Row;

use crate::exit::Failure;

const SIZE: (u32, u32) = (1200, 800);

/// Errors below this are drawn at it: on a logarithmic axis 0 has no place.
const LEAST_ULP: f64 = 0.1;
const LEAST_RELATIVE: f64 = 1e-8;

/// What belongs into one picture.
struct Picture {
    file: &'static str,
    title: &'static str,
    holds: fn(&Row) -> bool,
    /// What a point is called.
    label: fn(&Row) -> String,
}

const PICTURES: &[Picture] = &[
    Picture {
        file: "batches",
        title: "Batches: each line is one loop, from its name to AVX2 and AVX-512",
        holds: |row| row.error_unit == "ulp" && is_batch(row),
        label: |row| match row.isa {
            "baseline" => format!("{}/{}", row.group, row.variant),
            isa => isa.to_owned(),
        },
    },
    Picture {
        file: "distributions",
        title: "Distributions: from the textbook form (naive) to the stable one",
        holds: |row| single(row, &["d_"]),
        label: name_of_form,
    },
    Picture {
        file: "shadowing",
        title: "Smith's shadowing: from the textbook form (naive) to the stable one",
        holds: |row| single(row, &["lambda_", "g1_", "g2_", "v_ggx"]),
        label: name_of_form,
    },
    Picture {
        file: "classic-shadowing",
        title: "The classic shadowing functions, one call of each",
        holds: |row| single(row, &["gsf_"]),
        label: name_of_form,
    },
    Picture {
        file: "fresnel-and-diffuse",
        title: "Fresnel and diffuse: from the textbook form (naive) to the stable one",
        holds: |row| single(row, &["f_", "diffuse_"]),
        label: name_of_form,
    },
    Picture {
        file: "approximations",
        title: "Approximations: each line leads from one to what it stands for",
        holds: |row| row.group.contains(" for ") && !against_walks(row),
        label: |row| row.variant.clone(),
    },
    Picture {
        file: "diffuse-and-walks",
        title: "Diffuse light leaving a rough surface: two models against random walks",
        holds: against_walks,
        label: |row| row.variant.clone(),
    },
    Picture {
        file: "albedo",
        title: "Directional albedo: by quadrature, and by sampling",
        holds: |row| row.group == "albedo",
        label: |row| match row.variant.split_once(", ") {
            Some((_, more)) if !more.starts_with("64 ") => more.to_owned(),
            _ => row.variant.clone(),
        },
    },
];

/// Walks take milliseconds: beside them the other approximations would be one point.
fn against_walks(row: &Row) -> bool {
    row.group.ends_with(" for walk")
}

fn is_batch(row: &Row) -> bool {
    brdf::term(&row.group).is_none() && !row.group.contains(" for ")
}

/// One call of a term in single precision whose name starts like this.
fn single(row: &Row, starts: &[&str]) -> bool {
    row.error_unit == "ulp"
        && brdf::term(&row.group).is_some()
        && starts.iter().any(|start| row.group.starts_with(start))
}

fn name_of_form(row: &Row) -> String {
    match row.variant.as_str() {
        "stable" => row.group.clone(),
        variant => format!("{}, {variant}", row.group),
    }
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
        (LEAST_ULP, "ulp of f32")
    };
    let point = |row: &Row| (row.ns, row.max_ulp.max(least));
    let mut lines: Vec<(String, Vec<(f64, f64)>)> = Vec::new();
    for row in rows {
        let key = line_of(row);
        match lines.iter_mut().find(|line| line.0 == key) {
            Some((_, points)) => points.push(point(row)),
            None => lines.push((key, vec![point(row)])),
        }
    }
    // The points are labelled; a legend would say the same again.
    let lines = lines.into_iter().map(|(_, points)| (String::new(), points));
    let mut marks: Vec<(String, f64, f64)> = Vec::new();
    for row in rows {
        let (x, y) = point(row);
        let mut label = (picture.label)(row);
        // What several approximations stand for is one name at nearly one place.
        let exact =
            row.group.contains(" for ") && !row.group.starts_with(&format!("{} for", row.variant));
        if exact && marks.iter().any(|mark| mark.0 == label) {
            label.clear();
        }
        marks.push((label, x, y));
    }
    let floor = if rows.iter().any(|row| row.max_ulp < least) {
        format!("; {least} or less at the bottom")
    } else {
        String::new()
    };
    PlotSpec {
        title: picture.title.to_owned(),
        x_label: format!("nanoseconds for one evaluation, {machine}"),
        y_label: format!("worst error at random points, {unit}{floor}"),
        x_log: true,
        y_log: true,
        scatter: true,
        series: lines.collect(),
        marks,
    }
}

/// Rows with the same name are joined by a line.
fn line_of(row: &Row) -> String {
    if row.group == "albedo" {
        // One line a sampler, over its numbers of samples.
        let sampler = row.variant.split(',').next().unwrap_or_default();
        return format!("albedo/{sampler}");
    }
    match row.variant.as_str() {
        "f64" | "stable" | "naive" => row.group.clone(),
        _ if row.group.contains(" for ") => row.group.clone(),
        variant => format!("{}/{variant}", row.group),
    }
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
            needs: None,
            max_ulp,
            p999_ulp: max_ulp,
            median_ulp: 0.0,
            error_unit: if group == "albedo" { "relative" } else { "ulp" },
            pareto: false,
        }
    }

    #[test]
    fn pictures_name_every_point() {
        let rows = [
            row("d_ggx", "stable", "baseline", 4.0, 7.0),
            row("d_ggx", "naive", "baseline", 3.0, 2e6),
            row("specular", "batch", "baseline", 1.2, 9.0),
            row("specular", "batch", "avx2", 0.6, 9.0),
            row("albedo", "quadrature", "baseline", 9e3, 0.0),
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
            (0, "avx2"),
            (2, "d_ggx, naive"),
            (4, "quadrature"),
        ] {
            assert!(svg(index).contains(label), "{label}");
        }
    }
}
