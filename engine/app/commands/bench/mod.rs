//! `lobe bench`: run time against error, for every term and every way to compute it.

mod pictures;
mod plots;

use std::io::{self, IsTerminal as _};
use std::num::NonZero;
use std::path::{Path, PathBuf};
use std::{fs, thread};

use serde::Serialize;
use truth::bench::{Effort, Limit, Row, limits, run as measure};

use crate::cli::Bench;
use crate::exit::{Done, Failure};
use crate::output;

pub fn run(args: &Bench) -> Result<Done, Failure> {
    let effort = if args.quick {
        Effort::QUICK
    } else {
        Effort::FULL
    };
    let out = out_folder(args);
    if let Some(folder) = &out {
        // Before minutes of measuring, not after.
        fs::create_dir_all(folder).map_err(|error| Failure::unwritable(folder, &error))?;
    }
    let (machine, load, width) = (machine(), load(), Width::of_output());
    output::progress("measuring divisions, square roots and products");
    let limits = limits(effort);
    output::progress("");
    let foreword = foreword(&machine, &load, &limits);
    if args.json {
        foreword.lines().for_each(output::complain);
    } else {
        output::text(&foreword)?;
        output::text(&heading(width))?;
    }

    let mut printed = Ok(());
    let mut done = |group: &[Row]| {
        output::progress("");
        if printed.is_ok() {
            printed = print(group, args.json, width);
        }
        if let Some(row) = group.first() {
            output::progress(&format!("after {}", row.group));
        }
    };
    let mut rows = measure(effort, &limits, &mut done);
    rows.extend(pictures::measure(args.quick, &mut done)?);
    output::progress("");
    printed?;

    if let Some(folder) = &out {
        for file in plots::write(&rows, &machine, folder)? {
            let line = format!("plot {}", file.display());
            if args.json {
                output::complain(&line);
            } else {
                output::line(&line)?;
            }
        }
    }
    Ok(Done::Fine)
}

/// Where the plots go; with `--json` only where a folder is named, so that a program that
/// reads the figures finds no files it did not ask for.
fn out_folder(args: &Bench) -> Option<PathBuf> {
    match &args.out {
        Some(folder) => Some(folder.clone()),
        None if args.json => None,
        None => Some(Path::new("lobe-bench").to_owned()),
    }
}

/// The processor.
fn machine() -> String {
    let read = |path| fs::read_to_string(path).unwrap_or_default();
    let info = read("/proc/cpuinfo");
    let field = |name: &str| {
        let value = info.lines().find_map(|line| line.strip_prefix(name));
        value.map(|value| value.trim_start_matches([' ', '\t', ':']).to_owned())
    };
    let mut machine = field("model name").unwrap_or_else(|| std::env::consts::ARCH.to_owned());
    if let (Some(family), Some(model)) = (field("cpu family"), field("model\t")) {
        machine.push_str(&format!(" (family {family}, model {model})"));
    }
    machine
}

/// How busy the machine is: on a shared one the figures are worse than they need be.
fn load() -> String {
    let cores = thread::available_parallelism().map_or(1, NonZero::get);
    let load = fs::read_to_string("/proc/loadavg").unwrap_or_default();
    match load.split_whitespace().next() {
        Some(load) => format!("{cores} cores, load {load} at the start"),
        None => format!("{cores} cores"),
    }
}

fn foreword(machine: &str, load: &str, limits: &[Limit]) -> String {
    let mut text = format!(
        "{machine}, {load}\n\
         One thread, data in cache, the best of many runs. Its units, in nanoseconds a lane of f32:\n"
    );
    for limit in limits {
        text.push_str(&format!(
            "  {:<9} division {:.3}  square root {:.3}  product {:.4}; beside products a division \
             counts as {:.1} of them, a root as {:.1}\n",
            limit.isa,
            limit.division_ns,
            limit.square_root_ns,
            limit.product_ns,
            limit.division_products,
            limit.root_products
        ));
    }
    text
}

/// How many columns a table may take.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Width {
    /// All columns, a hundred characters.
    Full,
    /// Without those that follow from others, eighty.
    Narrow,
}

impl Width {
    /// Full but on a terminal that is narrower.
    fn of_output() -> Width {
        let columns = crossterm::terminal::size().map_or(u16::MAX, |(columns, _)| columns);
        if io::stdout().is_terminal() && columns < 100 {
            Width::Narrow
        } else {
            Width::Full
        }
    }
}

/// One line of the table: what stands at its beginning, the way to compute, and the figures.
struct Cells<'a> {
    star: char,
    variant: &'a str,
    precision: &'a str,
    isa: &'a str,
    ns: String,
    meval_s: String,
    share: String,
    needs: String,
    products: String,
    worst: String,
    p999: String,
    median: String,
}

impl Cells<'_> {
    fn line(&self, width: Width) -> String {
        let Cells {
            star,
            variant,
            precision,
            isa,
            ns,
            meval_s,
            share,
            needs,
            products,
            worst,
            p999,
            median,
        } = self;
        let line = match width {
            Width::Full => format!(
                "{star} {variant:<27} {precision:<3} {isa:<8} {ns:>8} {meval_s:>6} {share:>4} \
                 {needs:<4} {products:>4} {worst:>8} {p999:>8} {median:>8}"
            ),
            Width::Narrow => format!(
                "{star} {variant:<27} {precision:<3} {isa:<8} {ns:>8} {share:>5} {worst:>8} \
                 {median:>8}"
            ),
        };
        format!("{}\n", line.trim_end())
    }
}

/// What stands above the columns.
fn heading(width: Width) -> String {
    let columns = Cells {
        star: ' ',
        variant: "",
        precision: "",
        isa: "",
        ns: "ns".into(),
        meval_s: "M/s".into(),
        share: "÷√".into(),
        needs: "of".into(),
        products: "×".into(),
        worst: "worst".into(),
        p999: "p99.9".into(),
        median: "median".into(),
    };
    let limit = match width {
        Width::Full => {
            "÷√: share of what the unit allows that divides and takes roots; ×: of what those allow that\n\
             multiply, which divisions and roots need, too. The larger is of the one that limits."
        }
        Width::Narrow => "÷√: share of what the unit allows that divides and takes roots.",
    };
    format!(
        "\n{limit}\n\
         Errors in units of the last place of the row's precision; r: relative. Random points.\n\
         *: no other way in the group is as fast and as accurate.\n\n{}",
        columns.line(width)
    )
}

/// What a group is about, where its name does not say it.
fn note(group: &str) -> &'static str {
    match group {
        "albedo" => "directional albedo, F = 1; asked of the quadrature: 1e-5 in 15,000 ns",
        "albedo_schlick" => "the same with Schlick's Fresnel, f0 = 0.04",
        "albedo_at_alpha_1" => "against E = 1 - N·V ln(1 + 1/N·V)",
        "albedo_table" => "asked: 2e8 ns",
        "weak_furnace" => "the integral of D G1 (v·m) over N·V, which is 1",
        "furnace" => "what a white metal returns of all it receives, against 1",
        "furnace_diffuse" => "the same of the diffuse models at roughness 0.7",
        "reciprocity" => "f(l, v) against f(v, l)",
        "walk approximated" => "albedo without what was only mirrored, base 0.8",
        "walk_albedo" => "share of walks that leave after one bounce, against the quadrature",
        group if group.starts_with("render/") || group.starts_with("render_lights/") => {
            "ns for both panels; error of a pixel against double precision, nothing left out"
        }
        "render_samples/128" => "ns for both panels; share of the brightest, against many samples",
        "walk_energy" => "all that comes back from mirrors, against 1",
        _ => "",
    }
}

fn print(group: &[Row], as_json: bool, width: Width) -> Result<(), Failure> {
    if as_json {
        return group
            .iter()
            .try_for_each(|row| output::json(&Line::of(row)));
    }
    let Some(first) = group.first() else {
        return Ok(());
    };
    let mut text = match note(&first.group) {
        "" => format!("{}\n", first.group),
        note => format!("{}: {note}\n", first.group),
    };
    for row in group {
        text.push_str(&table_row(row, width));
    }
    output::text(&text)
}

fn table_row(row: &Row, width: Width) -> String {
    let percent = |ratio: f64| format!("{:.0}%", 100.0 * ratio);
    let share = row.limit_ratio.map(percent).unwrap_or_default();
    let products = row.products_ratio.map(percent).unwrap_or_default();
    let needs = row.needs.clone().unwrap_or_default();
    let error = |error| match row.error_unit {
        "none" => "-".to_owned(),
        "relative" if error == 0.0 => "0r".to_owned(),
        "relative" => format!("{error:.1e}r"),
        _ => short_error(error),
    };
    Cells {
        star: if row.pareto { '*' } else { ' ' },
        variant: &row.variant,
        precision: row.precision,
        isa: row.isa,
        ns: short(row.ns),
        meval_s: short(row.meval_s()),
        share,
        needs,
        products,
        worst: error(row.max_ulp),
        p999: error(row.p999_ulp),
        median: error(row.median_ulp),
    }
    .line(width)
}

/// About four digits.
fn short(x: f64) -> String {
    match x {
        _ if x < 0.01 => format!("{x:.1e}"),
        _ if x < 10.0 => format!("{x:.3}"),
        _ if x < 100.0 => format!("{x:.2}"),
        _ if x < 1000.0 => format!("{x:.1}"),
        _ => format!("{x:.0}"),
    }
}

fn short_error(ulp: f64) -> String {
    match ulp {
        _ if ulp < 1000.0 => format!("{ulp:.2}"),
        _ if ulp < 1e7 => format!("{ulp:.0}"),
        _ => format!("{ulp:.1e}"),
    }
}

/// A row as JSON; null where nothing is known, or an error is infinite.
#[derive(Serialize)]
struct Line<'a> {
    group: &'a str,
    variant: &'a str,
    precision: &'a str,
    isa: &'a str,
    ns: f64,
    meval_s: f64,
    limit_ratio: Option<f64>,
    /// The same of the units that multiply.
    #[serde(skip_serializing_if = "Option::is_none")]
    products_ratio: Option<f64>,
    max_ulp: Option<f64>,
    p999_ulp: Option<f64>,
    median_ulp: Option<f64>,
    pareto: bool,
    /// Where the errors are not in units of the last place of the row's precision.
    #[serde(skip_serializing_if = "Option::is_none")]
    error_unit: Option<&'a str>,
}

impl<'a> Line<'a> {
    fn of(row: &'a Row) -> Self {
        let known = |error: f64| Some(error).filter(|x| x.is_finite() && row.error_unit != "none");
        Self {
            group: &row.group,
            variant: &row.variant,
            precision: row.precision,
            isa: row.isa,
            ns: row.ns,
            meval_s: row.meval_s(),
            limit_ratio: row.limit_ratio,
            products_ratio: row.products_ratio,
            max_ulp: known(row.max_ulp),
            p999_ulp: known(row.p999_ulp),
            median_ulp: known(row.median_ulp),
            pareto: row.pareto,
            error_unit: (!row.error_unit.starts_with("ulp")).then_some(row.error_unit),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use unicode_width::UnicodeWidthStr as _;

    fn row(ns: f64, max_ulp: f64, error_unit: &'static str) -> Row {
        Row {
            group: "specular".into(),
            variant: "spherical cap, 1024 samples".into(),
            precision: "f32",
            isa: "baseline",
            ns,
            limit_ratio: Some(0.934),
            products_ratio: Some(0.5),
            needs: Some("3÷2√".into()),
            max_ulp,
            p999_ulp: max_ulp,
            median_ulp: max_ulp / 2.0,
            error_unit,
            pareto: true,
        }
    }

    #[test]
    fn the_table_fits() {
        check_table_fits(Width::Full, 100);
        check_table_fits(Width::Narrow, 80);
    }

    #[track_caller]
    fn check_table_fits(width: Width, columns: usize) {
        for ns in [0.2, 12.3, 4_321_987.0] {
            for (error, unit) in [
                (0.0, "none"),
                (1e-12, "relative"),
                (0.4, "ulp"),
                (9_999_999.0, "ulp"),
                (3e38, "ulp of f64"),
                (f64::INFINITY, "ulp"),
            ] {
                let line = table_row(&row(ns, error, unit), width);
                assert!(line.trim_end().width() <= columns, "{line}");
            }
        }
        // The sentences above the table may be broken by the terminal.
        let heading = heading(width);
        let last = heading.lines().last().unwrap_or_default();
        assert!(last.contains("worst") && last.width() <= columns, "{last}");
    }

    #[track_caller]
    fn check_json(row: &Row, end: &str) {
        let line = serde_json::to_string(&Line::of(row)).expect("JSON");
        let begin = "{\"group\":\"specular\",\"variant\":\"spherical cap, 1024 samples\",\
                     \"precision\":\"f32\",\"isa\":\"baseline\",\"ns\":0.5,\"meval_s\":2000.0,\
                     \"limit_ratio\":0.934,\"products_ratio\":0.5,";
        assert_eq!(line, format!("{begin}{end}"));
    }

    #[test]
    fn a_row_as_json() {
        check_json(
            &row(0.5, 3.0, "ulp"),
            "\"max_ulp\":3.0,\"p999_ulp\":3.0,\"median_ulp\":1.5,\"pareto\":true}",
        );
        check_json(
            &row(0.5, 0.25, "relative"),
            "\"max_ulp\":0.25,\"p999_ulp\":0.25,\"median_ulp\":0.125,\"pareto\":true,\
             \"error_unit\":\"relative\"}",
        );
        check_json(
            &row(0.5, 0.0, "none"),
            "\"max_ulp\":null,\"p999_ulp\":null,\"median_ulp\":null,\"pareto\":true,\
             \"error_unit\":\"none\"}",
        );
    }
}
