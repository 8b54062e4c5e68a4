//! `lobe render`: fingerprints as PNG, plots as SVG and PNG.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

use etcetera::BaseStrategy as _;
use renders::{Fingerprint, Options, PlotSpec};
use serde::{Deserialize, Serialize};
use tutor::Lesson;
use tutor::prose::{Block, PlotView};

use crate::cli::{Backend, Folders, Precision, Render};
use crate::exit::{Done, Failure};
use crate::fingerprints::{figure, fingerprint};
use crate::output;

/// Width and height of a plot's file.
const PLOT: (u32, u32) = (960, 600);

/// How a picture came about.
#[derive(Clone, Serialize, Deserialize)]
struct Report {
    file: String,
    lesson: String,
    id: String,
    backend: String,
    adapter: Option<String>,
    /// `f64` or `f32`; null for a plot.
    precision: Option<String>,
    pixels_shaded: u64,
    pixels_skipped: u64,
    points: u64,
    terms_evaluated: Vec<String>,
    terms_skipped: Vec<String>,
    /// Every decision about what to leave out, as a sentence.
    explain: Vec<String>,
    cache_hit: bool,
    ms: f64,
    /// What the graphics processor's own clock counted; null where there is none.
    device_ms: Option<f64>,
    visibility: Option<Visibility>,
}

/// What the picture shows; null where there is no number.
#[derive(Clone, Serialize, Deserialize)]
struct Visibility {
    lit_above_one: Option<f64>,
    disc_above_one: Option<f64>,
    ratio_at_highlight: Option<f64>,
    rim_over_highlight_wrong: Option<f64>,
    rim_over_highlight_right: Option<f64>,
    terminator_step: Option<f64>,
    brighter_by_8: Option<f64>,
    dimmer_by_8: Option<f64>,
}

impl Visibility {
    fn of(seen: &renders::Visibility) -> Self {
        let number = |name| figure(seen, name).filter(|number| number.is_finite());
        Self {
            lit_above_one: number("lit_above_one"),
            disc_above_one: number("disc_above_one"),
            ratio_at_highlight: number("ratio_at_highlight"),
            rim_over_highlight_wrong: number("rim_over_highlight_wrong"),
            rim_over_highlight_right: number("rim_over_highlight_right"),
            terminator_step: number("terminator_step"),
            brighter_by_8: number("brighter_by_8"),
            dimmer_by_8: number("dimmer_by_8"),
        }
    }
}

pub fn run(folders: &Folders, args: &Render) -> Result<Done, Failure> {
    let shelf = super::shelf(folders)?;
    let lessons: Vec<&Arc<Lesson>> = if args.names.is_empty() {
        shelf.lessons().collect()
    } else {
        args.names
            .iter()
            .map(|wanted| shelf.find(wanted))
            .collect::<Result<_, _>>()?
    };
    let out = out_folder(args.out.as_deref());
    fs::create_dir_all(&out).map_err(|error| Failure::unwritable(&out, &error))?;
    for lesson in lessons {
        for entry in &lesson.fingerprints {
            if let Some(fingerprint) = fingerprint(lesson, &entry.id) {
                say(&draw(&fingerprint, args, &out)?, args)?;
            }
        }
        for entry in &lesson.plots {
            if let Some(Block::Plot(view)) = lesson.plot(&entry.id) {
                for report in draw_plot(lesson, &view, &out)? {
                    say(&report, args)?;
                }
            }
        }
    }
    Ok(Done::Fine)
}

fn out_folder(wanted: Option<&Path>) -> PathBuf {
    let gallery = Path::new("renders/gallery");
    match wanted {
        Some(folder) => folder.to_owned(),
        None if gallery.is_dir() => gallery.to_owned(),
        None => PathBuf::from("lobe-pictures"),
    }
}

fn say(report: &Report, args: &Render) -> Result<(), Failure> {
    if args.json {
        return output::json(report);
    }
    let by = match (&report.adapter, report.cache_hit) {
        (_, true) => "unchanged".to_owned(),
        (Some(adapter), false) => format!("{}, {adapter}", report.backend),
        (None, false) => report.backend.clone(),
    };
    output::line(&format!("{}  {by}  {:.0} ms", report.file, report.ms))?;
    if args.explain && !report.explain.is_empty() {
        let Report {
            pixels_shaded,
            pixels_skipped,
            points,
            ..
        } = report;
        output::line(&format!(
            "  {pixels_shaded} pixels shaded, {pixels_skipped} left out; formulas evaluated at {points} points"
        ))?;
        for line in &report.explain {
            output::line(&format!("  - {line}"))?;
        }
    }
    Ok(())
}

fn draw(fingerprint: &Fingerprint, args: &Render, out: &Path) -> Result<Report, Failure> {
    let start = Instant::now();
    let path = out.join(format!(
        "{}-{}.png",
        fingerprint.lesson,
        slug(fingerprint.id)
    ));
    let file = path.display().to_string();
    let cached = cache_entry(fingerprint, args);
    if !args.force
        && !args.no_skip
        && let Some((mut report, png)) = cached.as_deref().and_then(read_cache)
    {
        write(&path, &png)?;
        report.file = file;
        report.cache_hit = true;
        report.ms = milliseconds(start);
        return Ok(report);
    }
    let options = Options {
        size: args.size,
        skip: !args.no_skip,
        backend: match args.backend {
            Backend::Auto => renders::Backend::Auto,
            Backend::Gpu => renders::Backend::Gpu,
            Backend::Cpu => renders::Backend::Cpu,
        },
        precision: match args.precision {
            Precision::F64 => renders::Precision::F64,
            Precision::F32 => renders::Precision::F32,
        },
        ..Options::default()
    };
    let picture =
        renders::render(fingerprint, &options, &AtomicBool::new(false)).map_err(|error| {
            Failure::unusable(format!(
                "{}/{}: {error}",
                fingerprint.lesson, fingerprint.id
            ))
        })?;
    let png = picture.png();
    write(&path, &png)?;
    let made = picture.report;
    let report = Report {
        file,
        lesson: fingerprint.lesson.to_owned(),
        id: fingerprint.id.to_owned(),
        backend: made.backend.to_owned(),
        adapter: made.adapter,
        precision: Some(made.precision.name().to_owned()),
        pixels_shaded: made.pixels_shaded,
        pixels_skipped: made.pixels_skipped,
        points: made.points,
        terms_evaluated: made.terms_evaluated,
        terms_skipped: made.terms_skipped,
        explain: made.explain,
        cache_hit: false,
        ms: milliseconds(start),
        device_ms: made.device_ms,
        visibility: Some(Visibility::of(&made.visibility)),
    };
    if let (Some(entry), false) = (&cached, args.no_skip) {
        write_cache(entry, &report, &png);
    }
    Ok(report)
}

fn draw_plot(lesson: &Lesson, view: &PlotView, out: &Path) -> Result<Vec<Report>, Failure> {
    let spec = PlotSpec {
        title: view.title.clone(),
        x_label: view.x_label.clone(),
        y_label: view.y_label.clone(),
        x_log: view.x_log,
        y_log: view.y_log,
        series: view.series.clone(),
        marks: view.marks.clone(),
        ..PlotSpec::default()
    };
    let failed =
        |error: renders::Error| Failure::unusable(format!("{}/{}: {error}", lesson.id, view.id));
    let (width, height) = PLOT;
    let stem = format!("{}-{}", lesson.id, slug(&view.id));
    let mut reports = Vec::new();
    for ending in ["svg", "png"] {
        let start = Instant::now();
        let bytes = match ending {
            "svg" => renders::plot_svg(&spec, width, height)
                .map_err(failed)?
                .into_bytes(),
            _ => renders::plot_png(&spec, width, height).map_err(failed)?,
        };
        let path = out.join(format!("{stem}.{ending}"));
        write(&path, &bytes)?;
        reports.push(Report {
            file: path.display().to_string(),
            lesson: lesson.id.text.clone(),
            id: view.id.clone(),
            backend: "plot".to_owned(),
            adapter: None,
            precision: None,
            pixels_shaded: 0,
            pixels_skipped: 0,
            points: 0,
            terms_evaluated: Vec::new(),
            terms_skipped: Vec::new(),
            explain: Vec::new(),
            cache_hit: false,
            ms: milliseconds(start),
            device_ms: None,
            visibility: None,
        });
    }
    Ok(reports)
}

fn write(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    // A picture that is there already keeps its time stamp.
    if fs::read(path).is_ok_and(|there| there == bytes) {
        return Ok(());
    }
    fs::write(path, bytes).map_err(|error| Failure::unwritable(path, &error))
}

fn slug(id: &str) -> &str {
    id.rsplit('/').next().unwrap_or(id)
}

fn milliseconds(since: Instant) -> f64 {
    (since.elapsed().as_secs_f64() * 1e6).round() / 1e3
}

/// Where a picture with exactly these formulas, numbers and words is kept; named after a hash
/// of all of them, and of this very program.
fn cache_entry(fingerprint: &Fingerprint, args: &Render) -> Option<PathBuf> {
    let program = std::env::current_exe().and_then(fs::metadata).ok()?;
    let built = program
        .modified()
        .ok()?
        .duration_since(std::time::UNIX_EPOCH)
        .ok()?;
    let library = fingerprint.library;
    let content = format!(
        "{:?} {built:?} {} | {} | {} | {:?} | {} | {} | {} | {:?} {:?} | {} | {}",
        program.len(),
        env!("CARGO_PKG_VERSION"),
        library.canonical(fingerprint.right),
        library.canonical(fingerprint.wrong),
        fingerprint.scene,
        fingerprint.title,
        fingerprint.caption,
        args.size,
        args.backend,
        args.precision,
        fingerprint.lesson,
        fingerprint.id,
    );
    let folder = etcetera::choose_base_strategy()
        .ok()?
        .cache_dir()
        .join("lobe")
        .join("pictures");
    Some(folder.join(blake3::hash(content.as_bytes()).to_hex().as_str()))
}

fn read_cache(entry: &Path) -> Option<(Report, Vec<u8>)> {
    let report = serde_json::from_slice(&fs::read(entry.with_extension("json")).ok()?).ok()?;
    Some((report, fs::read(entry.with_extension("png")).ok()?))
}

/// A cache that cannot be written costs time only. The report comes last: with it the entry is
/// whole.
fn write_cache(entry: &Path, report: &Report, png: &[u8]) {
    let _ = entry.parent().map(fs::create_dir_all);
    if fs::write(entry.with_extension("png"), png).is_ok()
        && let Ok(text) = serde_json::to_vec(report)
    {
        let _ = fs::write(entry.with_extension("json"), text);
    }
}
