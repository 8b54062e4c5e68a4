//! `lobe bench`: run time against error, for every term and every way to compute it.

mod plots;

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
    let (machine, load) = (machine(), load());
    output::progress("measuring divisions, square roots and products");
    let limits = limits(effort);
    output::progress("");
    let foreword = foreword(&machine, &load, &limits);
    if args.json {
        foreword.lines().for_each(output::complain);
    } else {
        output::text(&foreword)?;
        output::text(&heading())?;
    }

    let mut printed = Ok(());
    let rows = measure(effort, &limits, |group| {
        output::progress("");
        if printed.is_ok() {
            printed = print(group, args.json);
        }
        if let Some(row) = group.first() {
            output::progress(&format!("after {}", row.group));
        }
    });
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
            "  {:<9} division {:.3}  square root {:.3}  product {:.4}\n",
            limit.isa, limit.division_ns, limit.square_root_ns, limit.product_ns
        ));
    }
    text
}

/// What stands above the columns.
fn heading() -> String {
    format!(
        "\nlimit: share of what those units allow: divisions (÷) and roots (√) share one, products (×) have\n\
         others; of whichever takes longer.\n\
         Errors in units of the last place of the row's precision; r: relative. Random points.\n\
         *: no other way in the group is as fast and as accurate.\n\n  \
         {:<27} {:<3} {:<8} {:>8} {:>7} {:>5} {:<4} {:>8} {:>8} {:>8}\n",
        "", "", "", "ns", "M/s", "limit", "of", "worst", "p99.9", "median"
    )
}

fn print(group: &[Row], as_json: bool) -> Result<(), Failure> {
    if as_json {
        return group
            .iter()
            .try_for_each(|row| output::json(&Line::of(row)));
    }
    let Some(first) = group.first() else {
        return Ok(());
    };
    let mut text = format!("{}\n", first.group);
    for row in group {
        text.push_str(&table_row(row));
    }
    output::text(&text)
}

fn table_row(row: &Row) -> String {
    let share = row
        .limit_ratio
        .map(|ratio| format!("{:.0}%", 100.0 * ratio));
    let (share, needs) = (
        share.unwrap_or_default(),
        row.needs.as_deref().unwrap_or_default(),
    );
    let error = |error| match row.error_unit {
        "none" => "-".to_owned(),
        "relative" => format!("{error:.1e}r"),
        _ => short_error(error),
    };
    let line = format!(
        "{} {:<27} {:<3} {:<8} {:>8} {:>7} {share:>5} {needs:<4} {:>8} {:>8} {:>8}",
        if row.pareto { '*' } else { ' ' },
        row.variant,
        row.precision,
        row.isa,
        short(row.ns),
        short(row.meval_s()),
        error(row.max_ulp),
        error(row.p999_ulp),
        error(row.median_ulp),
    );
    format!("{}\n", line.trim_end())
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
            needs: Some("3÷2√".into()),
            max_ulp,
            p999_ulp: max_ulp,
            median_ulp: max_ulp / 2.0,
            error_unit,
            pareto: true,
        }
    }

    #[test]
    fn the_table_fits_a_hundred_columns() {
        for ns in [0.2, 12.3, 4_321_987.0] {
            for (error, unit) in [
                (0.0, "none"),
                (1e-12, "relative"),
                (0.4, "ulp"),
                (9_999_999.0, "ulp"),
                (3e38, "ulp of f64"),
                (f64::INFINITY, "ulp"),
            ] {
                let line = table_row(&row(ns, error, unit));
                assert!(line.trim_end().width() <= 100, "{line}");
            }
        }
        assert!(heading().lines().all(|line| line.width() <= 100));
    }

    #[track_caller]
    fn check_json(row: &Row, end: &str) {
        let line = serde_json::to_string(&Line::of(row)).expect("JSON");
        let begin = "{\"group\":\"specular\",\"variant\":\"spherical cap, 1024 samples\",\
                     \"precision\":\"f32\",\"isa\":\"baseline\",\"ns\":0.5,\"meval_s\":2000.0,\
                     \"limit_ratio\":0.934,";
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
