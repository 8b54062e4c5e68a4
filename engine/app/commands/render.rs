//! `lobe render`: fingerprints and maps as PNG, plots as SVG and PNG.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

use renders::{Fingerprint, Options, PlotSpec};
use serde::{Deserialize, Serialize};
use tutor::Lesson;
use tutor::prose::Block;

use crate::cli::{Backend, Folders, Precision, Render, Values};
use crate::exit::{Done, Failure};
use crate::fingerprints::fingerprint;
use crate::lessons::Shelf;
use crate::maps::map_spec;
use crate::output;
use crate::picture_cache::Entry;
use crate::seen::figure;

/// Panels up to this size are kept, to be drawn but once; in pixels.
const KEPT: u32 = 2048;
/// Width and height of a plot's file, and of a map's.
const PLOT: (u32, u32) = (960, 600);
const MAP: (u32, u32) = (800, 600);
/// Values across a map, and upwards.
const CELLS: usize = 48;

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
    growth_per_doubling: Option<f64>,
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
            growth_per_doubling: number("growth_per_doubling"),
            brighter_by_8: number("brighter_by_8"),
            dimmer_by_8: number("dimmer_by_8"),
        }
    }
}

/// What a picture is.
#[derive(Clone, Copy)]
enum Kind {
    Fingerprint,
    Plot,
    Map,
}

/// Every picture of a lesson, in the order in which they are drawn, by its id.
fn pictures(lesson: &Lesson) -> Vec<(Kind, &str)> {
    let fingerprints = lesson.fingerprints.iter().map(|it| &it.id);
    let plots = lesson.plots.iter().map(|it| &it.id);
    let maps = lesson.maps.iter().map(|it| &it.id);
    let fingerprints = fingerprints.map(|id| (Kind::Fingerprint, id.text.as_str()));
    let plots = plots.map(|id| (Kind::Plot, id.text.as_str()));
    let maps = maps.map(|id| (Kind::Map, id.text.as_str()));
    fingerprints.chain(plots).chain(maps).collect()
}

/// The picture of a lesson that was named.
fn named<'a>(lesson: &'a Lesson, wanted: &str) -> Result<(Kind, &'a str), Failure> {
    let all = pictures(lesson);
    let found = all.iter().copied().find(|(_, id)| slug(id) == wanted);
    found.ok_or_else(|| {
        let ids: Vec<&str> = all.iter().map(|(_, id)| slug(id)).collect();
        let lesson = &lesson.id.text;
        let has = match ids.as_slice() {
            [] => "none".to_owned(),
            ids => ids.join(", "),
        };
        Failure::unusable(format!("{lesson} has no picture `{wanted}`: it has {has}"))
    })
}

pub fn run(folders: &Folders, args: &Render) -> Result<Done, Failure> {
    let folder = folders.lessons.as_deref();
    let mut lessons: Vec<(Arc<Lesson>, Option<&str>)> = Vec::new();
    if args.names.is_empty() {
        lessons.extend(
            super::shelf(folders)?
                .lessons()
                .map(|it| (it.clone(), None)),
        );
    }
    for name in &args.names {
        let (lesson, picture) = match name.split_once('/') {
            Some((lesson, picture)) => (lesson, Some(picture)),
            None => (name.as_str(), None),
        };
        lessons.push((Shelf::one(folder, lesson)?, picture));
    }
    // A name that is none is said before anything is drawn.
    let mut wanted = Vec::new();
    for (lesson, picture) in &lessons {
        match picture {
            Some(picture) => wanted.push((lesson, vec![named(lesson, picture)?])),
            None => wanted.push((lesson, pictures(lesson))),
        }
    }
    let out = out_folder(args.out.as_deref());
    fs::create_dir_all(&out).map_err(|error| Failure::unwritable(&out, &error))?;
    for (lesson, pictures) in wanted {
        for (kind, id) in pictures {
            match kind {
                Kind::Fingerprint => draw_fingerprint(lesson, id, args, &out)?,
                Kind::Plot => {
                    for ending in ["svg", "png"] {
                        say(&draw_plot(lesson, id, ending, args, &out)?, args)?;
                    }
                }
                Kind::Map => say(&draw_map(lesson, id, args, &out)?, args)?,
            }
        }
    }
    Ok(Done::Fine)
}

fn draw_fingerprint(lesson: &Lesson, id: &str, args: &Render, out: &Path) -> Result<(), Failure> {
    let Some(fingerprint) = fingerprint(lesson, id) else {
        return Ok(());
    };
    say(&draw(&fingerprint, args, out)?, args)?;
    if let Some(format) = args.values {
        say(&write_values(&fingerprint, args, format, out)?, args)?;
    }
    Ok(())
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

/// A picture from the cache, or from `make`: its report says which.
fn cached(
    description: &str,
    path: &Path,
    args: &Render,
    make: impl FnOnce() -> Result<(Report, Vec<u8>), Failure>,
) -> Result<Report, Failure> {
    let start = Instant::now();
    // Without skipping the point is to compute, not to have.
    let entry = Entry::of(description).filter(|_| !args.no_skip);
    let known = entry.as_ref().filter(|_| !args.force);
    let (mut report, bytes, cache_hit) = match known.and_then(Entry::read::<Report>) {
        Some((report, bytes)) => (report, bytes, true),
        None => {
            let (report, bytes) = make()?;
            (report, bytes, false)
        }
    };
    write(path, &bytes)?;
    report.file = path.display().to_string();
    report.cache_hit = cache_hit;
    report.ms = milliseconds(start);
    if let (Some(entry), false) = (&entry, cache_hit) {
        entry.write(&report, &bytes);
    }
    Ok(report)
}

fn options(args: &Render) -> Options {
    Options {
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
    }
}

/// A fingerprint's file, without its ending.
fn stem(lesson: &str, id: &str) -> String {
    format!("{lesson}-{}", slug(id))
}

fn failed(lesson: &str, id: &str, error: &renders::Error) -> Failure {
    Failure::unusable(format!("{lesson}/{id}: {error}"))
}

fn draw(fingerprint: &Fingerprint, args: &Render, out: &Path) -> Result<Report, Failure> {
    let (lesson, id) = (fingerprint.lesson, fingerprint.id);
    let path = out.join(format!("{}.png", stem(lesson, id)));
    let options = options(args);
    let description = format!("{lesson}\n{id}\n{}", fingerprint.key(&options));
    made(&description, &path, args, |to| {
        let made = renders::write_png(fingerprint, &options, &AtomicBool::new(false), to)
            .map_err(|error| failed(lesson, id, &error))?;
        Ok(Report {
            adapter: made.adapter,
            precision: Some(made.precision.name().to_owned()),
            pixels_shaded: made.pixels_shaded,
            pixels_skipped: made.pixels_skipped,
            points: made.points,
            terms_evaluated: made.terms_evaluated,
            terms_skipped: made.terms_skipped,
            explain: made.explain,
            device_ms: made.device_ms,
            visibility: Some(Visibility::of(&made.visibility)),
            ..Report::of(lesson, id, made.backend)
        })
    })
}

/// The values of both panels, for whoever wants to measure rather than look.
fn write_values(
    fingerprint: &Fingerprint,
    args: &Render,
    format: Values,
    out: &Path,
) -> Result<Report, Failure> {
    let (lesson, id) = (fingerprint.lesson, fingerprint.id);
    let options = options(args);
    let ending = match format {
        Values::Exr => "exr",
        Values::Png16 => "png",
    };
    let path = out.join(format!("{}-values.{ending}", stem(lesson, id)));
    let description = format!("values {format:?}\n{}", fingerprint.key(&options));
    made(&description, &path, args, |to| {
        let never = AtomicBool::new(false);
        let written = match format {
            Values::Exr => renders::write_exr(fingerprint, &options, &never, to),
            Values::Png16 => renders::write_png16(fingerprint, &options, &never, to),
        };
        written.map_err(|error| failed(lesson, id, &error))?;
        Ok(Report::of(lesson, id, "values"))
    })
}

/// A file of pixels from the cache, or from `make`. A large one is written as it comes, and not
/// kept besides.
fn made(
    description: &str,
    path: &Path,
    args: &Render,
    make: impl FnOnce(&mut dyn io::Write) -> Result<Report, Failure>,
) -> Result<Report, Failure> {
    if args.size <= KEPT {
        return cached(description, path, args, || {
            let mut bytes = Vec::new();
            let report = make(&mut bytes)?;
            Ok((report, bytes))
        });
    }
    let start = Instant::now();
    let mut report = whole(path, make)?;
    report.file = path.display().to_string();
    report.ms = milliseconds(start);
    Ok(report)
}

/// Writes a file as it comes. Until it is whole it has another name.
fn whole<T>(
    path: &Path,
    work: impl FnOnce(&mut dyn io::Write) -> Result<T, Failure>,
) -> Result<T, Failure> {
    let unwritable = |error: io::Error| Failure::unwritable(path, &error);
    let part = path.with_extension("part");
    let mut file = io::BufWriter::new(fs::File::create(&part).map_err(unwritable)?);
    let done = work(&mut file).and_then(|done| {
        io::Write::flush(&mut file).map_err(unwritable)?;
        fs::rename(&part, path).map_err(unwritable)?;
        Ok(done)
    });
    if done.is_err() {
        // Of no use to anybody; where it cannot be removed the error said enough.
        let _ = fs::remove_file(&part);
    }
    done
}

impl Report {
    /// What is known of every picture.
    fn of(lesson: &str, id: &str, backend: &str) -> Self {
        Self {
            file: String::new(),
            lesson: lesson.to_owned(),
            id: id.to_owned(),
            backend: backend.to_owned(),
            adapter: None,
            precision: None,
            pixels_shaded: 0,
            pixels_skipped: 0,
            points: 0,
            terms_evaluated: Vec::new(),
            terms_skipped: Vec::new(),
            explain: Vec::new(),
            cache_hit: false,
            ms: 0.0,
            device_ms: None,
            visibility: None,
        }
    }
}

fn draw_plot(
    lesson: &Lesson,
    id: &str,
    ending: &str,
    args: &Render,
    out: &Path,
) -> Result<Report, Failure> {
    let path = out.join(format!("{}.{ending}", stem(&lesson.id, id)));
    // The file's hash stands for all that it says: nothing is computed to find the picture.
    let description = format!("plot {PLOT:?} {ending}\n{}\n{id}", lesson.hash);
    cached(&description, &path, args, || {
        let Some(Block::Plot(view)) = lesson.plot(id) else {
            return Err(Failure::unusable(format!(
                "{}/{id}: no such plot",
                lesson.id
            )));
        };
        let spec = PlotSpec {
            title: view.title,
            x_label: view.x_label,
            y_label: view.y_label,
            x_log: view.x_log,
            y_log: view.y_log,
            y_ends: view.y_given,
            series: view.series,
            marks: view.marks,
            ..PlotSpec::default()
        };
        let (width, height) = PLOT;
        let bytes = match ending {
            "svg" => renders::plot_svg(&spec, width, height).map(String::into_bytes),
            _ => renders::plot_png(&spec, width, height),
        };
        let bytes = bytes.map_err(|error| failed(&lesson.id, id, &error))?;
        Ok((Report::of(&lesson.id, id, "plot"), bytes))
    })
}

fn draw_map(lesson: &Lesson, id: &str, args: &Render, out: &Path) -> Result<Report, Failure> {
    let path = out.join(format!("{}.png", stem(&lesson.id, id)));
    let description = format!("map {MAP:?}\n{}\n{id}", lesson.hash);
    cached(&description, &path, args, || {
        let Some(spec) = map_spec(lesson, id, CELLS) else {
            return Err(Failure::unusable(format!(
                "{}/{id}: no such map",
                lesson.id
            )));
        };
        let bytes = renders::map_png(&spec, MAP.0, MAP.1);
        let bytes = bytes.map_err(|error| failed(&lesson.id, id, &error))?;
        Ok((Report::of(&lesson.id, id, "map"), bytes))
    })
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
