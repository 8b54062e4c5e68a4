//! Pictures of any size, written row by row as they are drawn: what is held in memory does not
//! grow with their height.

use crate::canvas::{Canvas, png_header};
use crate::colour::DARK;
use crate::cpu::Cpu;
use crate::error::Error;
use crate::exr;
use crate::paint::Tables;
use crate::picture::Page;
use crate::plan::Plan;
use crate::png16;
use crate::profile::Profile;
use crate::shade::{Job, Shaded, shade};
use crate::visibility::{COUNTED_APART, Tally, Visibility, holds_for, measure, tally};
use crate::{Fingerprint, LEAST_WITH_TEXT, Options, Precision, Report, Shown, engine, job, render};
use std::io::Write;
use std::ops::Range;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

/// What is held at once.
#[derive(Clone, Copy, Debug)]
struct Held {
    /// Panels up to this size are shaded whole, so that half of one can be copied where it
    /// mirrors the other; larger ones strip by strip.
    whole: u32,
    /// Pixels of a page, about.
    strip: usize,
}

const HELD: Held = Held {
    whole: 1024,
    strip: 1 << 21,
};

/// Draws a fingerprint as a PNG file in bounded memory, with all its words where they can be
/// read. The same picture as [`crate::render`], whatever the size; [`Options::compact`] does not
/// count.
///
/// # Errors
/// As [`crate::render`], and [`Error::Write`] where the file cannot be written.
pub fn write_png(
    fingerprint: &Fingerprint<'_>,
    options: &Options,
    cancel: &AtomicBool,
    to: &mut dyn Write,
) -> Result<Report, Error> {
    if options.size < LEAST_WITH_TEXT {
        // The words have no room, and all of it little memory.
        let picture = render(fingerprint, options, cancel)?;
        to.write_all(&picture.png()).map_err(unwritten)?;
        return Ok(picture.report);
    }
    write_png_holding(HELD, fingerprint, options, cancel, to)
}

fn write_png_holding(
    held: Held,
    fingerprint: &Fingerprint<'_>,
    options: &Options,
    cancel: &AtomicBool,
    to: &mut dyn Write,
) -> Result<Report, Error> {
    let start = Instant::now();
    let mut plan = Plan::of(fingerprint, options.skip);
    if options.size > held.whole {
        plan.no_mirror("the picture is drawn in strips, so that it needs little memory");
    }
    let cpu = Arc::new(Cpu::new(fingerprint, &plan, Precision::F64)?);
    let profile = Profile::of(fingerprint, &cpu);
    let shown = Shown {
        exposure: profile.exposure(),
        raw: false,
    };
    let job = job(fingerprint, options, &plan, shown, cancel)?;
    let engine = engine(fingerprint, options, &plan)?;
    let page = Page::new(fingerprint, job.panel, &profile, shown.exposure);
    let size = job.panel.size;

    let (backend, adapter) = engine.name();
    let counts = holds_for(backend, options);
    if !counts {
        plan.explain.push(COUNTED_APART.to_owned());
    }
    let mut window = Window {
        tally: counts.then(|| Tally::of(&job.panel)),
        ..Window::default()
    };
    if options.size <= held.whole {
        window.take(shade(&job, &engine)?);
    }
    let mut visibility = None;
    let writer = png_header(to, page.width as u32, page.height as u32);
    let mut writer = writer.map_err(unwritten)?;
    let mut file = writer.stream_writer().map_err(unwritten)?;
    let strip = (held.strip / page.width).max(1);
    for top in (0..page.height).step_by(strip) {
        let rows = top..(top + strip).min(page.height);
        let (shown, needed) = page.panel_rows(&rows);
        if !shown.is_empty() {
            window.forget(needed.start, size);
            while window.end(size) < needed.end {
                let from = window.end(size);
                let more = job.shade(&engine, from..needed.end)?;
                window.take(more);
            }
        }
        // Below the panels stand the figures of all their pixels.
        if window.end(size) == size && visibility.is_none() {
            let tally = match window.tally {
                Some(tally) => tally,
                None => tally(&job, &cpu, &window.tables.encode)?,
            };
            visibility = Some(measure(fingerprint, &cpu, &tally));
        }
        let mut canvas = Canvas::strip(page.width, page.height, rows, DARK.paper);
        let known = visibility.as_ref().unwrap_or(&Visibility::UNKNOWN);
        page.draw(
            &mut canvas,
            (&window.shaded, window.first),
            known,
            &window.tables,
        )?;
        file.write_all(canvas.rgb()).map_err(unwritten)?;
    }
    file.finish().map_err(unwritten)?;
    let pixels = u64::from(options.size).pow(2);
    Ok(Report {
        backend,
        adapter,
        precision: match backend {
            "gpu" => Precision::F32,
            _ => options.precision,
        },
        pixels_shaded: window.pixels,
        pixels_skipped: pixels - window.pixels,
        points: window.points,
        terms_evaluated: plan.evaluated,
        terms_skipped: plan.skipped,
        explain: plan.explain,
        exposure: shown.exposure,
        ms: start.elapsed().as_secs_f64() * 1e3,
        device_ms: engine.device_ms(),
        visibility: visibility.unwrap_or(Visibility::UNKNOWN),
    })
}

/// Writes the linear values of both panels as an OpenEXR file, in bounded memory: the layers
/// `buggy` and `correct`, 32-bit floats.
///
/// # Errors
/// As [`write_png`].
pub fn write_exr(
    fingerprint: &Fingerprint<'_>,
    options: &Options,
    cancel: &AtomicBool,
    to: &mut dyn Write,
) -> Result<(), Error> {
    values(fingerprint, options, cancel, |job, shade| {
        let (size, channels) = (job.panel.size, job.channels);
        to.write_all(&exr::header(size, channels))
            .map_err(unwritten)?;
        shade(&mut |first, shaded| {
            let rows = exr::rows(size, channels, first, &shaded.right, &shaded.wrong);
            to.write_all(&rows).map_err(unwritten)
        })?;
        to.flush().map_err(unwritten)
    })
}

/// Writes the values of both panels as a PNG file of 16 bits a channel, in bounded memory: see
/// [`crate::Raw::png16`].
///
/// # Errors
/// As [`write_png`].
pub fn write_png16(
    fingerprint: &Fingerprint<'_>,
    options: &Options,
    cancel: &AtomicBool,
    to: &mut dyn Write,
) -> Result<(), Error> {
    let exposure = crate::exposure(fingerprint);
    values(fingerprint, options, cancel, |job, shade| {
        let (size, channels) = (job.panel.size, job.channels);
        let mut writer = png16::header(to, size, channels).map_err(unwritten)?;
        let mut file = writer.stream_writer().map_err(unwritten)?;
        shade(&mut |_, shaded| {
            let rows = png16::rows(size * channels, &shaded.right, &shaded.wrong, exposure);
            file.write_all(&rows).map_err(unwritten)
        })?;
        file.finish().map_err(unwritten)
    })
}

/// What takes shaded rows, and the panel's row that the first of them is.
type Take<'a> = dyn FnMut(usize, &Shaded) -> Result<(), Error> + 'a;

/// Has all rows shaded, some at a time, by what `work` calls with what is to take them.
fn values(
    fingerprint: &Fingerprint<'_>,
    options: &Options,
    cancel: &AtomicBool,
    work: impl FnOnce(&Job<'_>, &dyn Fn(&mut Take<'_>) -> Result<(), Error>) -> Result<(), Error>,
) -> Result<(), Error> {
    let mut plan = Plan::of(fingerprint, options.skip);
    plan.no_mirror("the values are written row by row");
    let shown = Shown {
        exposure: 1.0,
        raw: true,
    };
    let job = job(fingerprint, options, &plan, shown, cancel)?;
    let engine = engine(fingerprint, options, &plan)?;
    let size = job.panel.size;
    let strip = (HELD.strip / 8 / size).max(16);
    work(&job, &|take: &mut Take<'_>| {
        (0..size).step_by(strip).try_for_each(|first| {
            let shaded = job.shade(&engine, first..(first + strip).min(size))?;
            take(first, &shaded)
        })
    })
}

fn unwritten(error: impl std::fmt::Display) -> Error {
    Error::Write(error.to_string())
}

/// The shaded rows that are held, and sums over all that were.
#[derive(Default)]
struct Window {
    shaded: Shaded,
    /// The panel's row that the first of them is.
    first: usize,
    /// The figures of all of them, where they are counted on these rows.
    tally: Option<Tally>,
    tables: Tables,
    pixels: u64,
    points: u64,
}

impl Window {
    /// One past the last row that is held.
    fn end(&self, size: usize) -> usize {
        self.first + self.shaded.lit.len() / size
    }

    /// Adds the rows that come next.
    fn take(&mut self, more: Shaded) {
        if let Some(tally) = &mut self.tally {
            tally.add(&more, &self.tables.encode);
        }
        self.pixels += more.pixels;
        self.points += more.points;
        self.shaded.append(more);
    }

    /// Drops the rows before `row`.
    fn forget(&mut self, row: usize, size: usize) {
        let dropped: Range<usize> = 0..row.saturating_sub(self.first);
        self.shaded.drop_pixels(dropped.len() * size);
        self.first += dropped.len();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Backend, Eye, Light, Scene, raw, render};
    use std::io::Cursor;

    fn bug(scene: Scene, work: impl FnOnce(&Fingerprint<'_>)) {
        let library = formula::Library::new();
        let parse = |text| formula::parse(text).unwrap_or_else(|e| panic!("{e}"));
        work(&Fingerprint {
            lesson: "test",
            id: "strips",
            title: "In strips".to_owned(),
            caption: "A caption that is long enough for a second line of text. ".repeat(3),
            library: &library,
            right: &parse("d_ggx() * v_ggx() * n_dot_l"),
            wrong: &parse("d_ggx() * v_ggx() * n_dot_l / (4 * n_dot_l * n_dot_v)"),
            scene,
        });
    }

    fn scenes() -> [Scene; 2] {
        let coloured = Light {
            turn_deg: 200.0,
            colour: [1.0, 0.5, 0.2],
            ..Light::distant(70.0)
        };
        [
            Scene::new(0.5, 0.9, 60.0),
            Scene {
                eye: Eye::Perspective { distance: 3.0 },
                lights: vec![Light::distant(20.0), coloured],
                ..Scene::new(0.5, 0.9, 0.0)
            },
        ]
    }

    const OPTIONS: Options = Options {
        size: 120,
        backend: Backend::Cpu,
        precision: Precision::F64,
        skip: true,
        compact: false,
    };

    #[track_caller]
    fn pixels(file: Vec<u8>) -> ((u32, u32), Vec<u8>) {
        let decoder = png::Decoder::new(Cursor::new(file));
        let mut reader = decoder.read_info().expect("a PNG");
        let mut bytes = vec![0; reader.output_buffer_size().expect("a size")];
        let frame = reader.next_frame(&mut bytes).expect("a whole PNG");
        ((frame.width, frame.height), bytes)
    }

    /// However little is held, the picture and its figures are the same.
    #[test]
    fn strips_make_the_whole_picture() {
        for scene in scenes() {
            bug(scene, |fingerprint| {
                let never = AtomicBool::new(false);
                let whole = render(fingerprint, &OPTIONS, &never).unwrap_or_else(|e| panic!("{e}"));
                let expected: Vec<&[u8]> = whole.rgba.chunks_exact(4).map(|p| &p[..3]).collect();
                for held in [
                    HELD,
                    Held {
                        whole: 16,
                        strip: 1,
                    },
                    Held {
                        whole: 16,
                        strip: 7000,
                    },
                    Held {
                        whole: 200,
                        strip: 30_000,
                    },
                ] {
                    let mut file = Vec::new();
                    let report = write_png_holding(held, fingerprint, &OPTIONS, &never, &mut file)
                        .unwrap_or_else(|e| panic!("{e}"));
                    let (size, bytes) = pixels(file);
                    assert_eq!(size, (whole.width, whole.height));
                    let pairs = bytes.chunks_exact(3).zip(&expected);
                    let differs = pairs.enumerate().find(|(_, (a, b))| a != *b);
                    let width = whole.width as usize;
                    let place = differs.map(|(at, pair)| (at % width, at / width, pair));
                    assert_eq!(place, None, "{held:?}");
                    let (some, all) = (report.visibility, whole.report.visibility);
                    assert!((some.lit_above_one - all.lit_above_one).abs() < 1e-9);
                    assert_eq!(some.changed_8, all.changed_8);
                    assert_eq!(some.rim_over_highlight, all.rim_over_highlight);
                }
            });
        }
    }

    #[test]
    fn streamed_values_are_the_whole_ones() {
        for scene in scenes() {
            bug(scene, |fingerprint| {
                let mut file = Vec::new();
                write_exr(fingerprint, &OPTIONS, &AtomicBool::new(false), &mut file)
                    .unwrap_or_else(|e| panic!("{e}"));
                let raw = raw(fingerprint, &OPTIONS).unwrap_or_else(|e| panic!("{e}"));
                assert!(file == raw.exr());
                let mut file = Vec::new();
                write_png16(fingerprint, &OPTIONS, &AtomicBool::new(false), &mut file)
                    .unwrap_or_else(|e| panic!("{e}"));
                let whole = raw.png16(crate::exposure(fingerprint));
                assert!(pixels(file) == pixels(whole));
            });
        }
    }
}
