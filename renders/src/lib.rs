//! A scene becomes an image: one bug as a picture, on a graphics processor or on the CPU, and
//! the plots of a lesson's tables.
//!
//! A [`Fingerprint`] is two formulas, the right one and the wrong one, and a scene that shows
//! where they differ: a sphere, its material, an eye and some lights. [`render`]
//! draws correct, buggy and their ratio side by side with the profile along the equator;
//! [`raw`] and [`profile`] give the numbers behind the picture.
//!
//! Both formulas are [`formula::Expr`]; nothing here knows what a lesson is. Nothing here
//! touches a file, and no graphics driver is loaded before a picture asks for one.

mod axis;
mod backend;
mod canvas;
mod chart;
mod colour;
mod contour;
mod convergence;
mod cpu;
mod device;
mod dots;
mod error;
mod exr;
mod geometry;
mod gpu;
mod label;
mod look;
mod map;
mod own;
mod paint;
mod pen;
mod picture;
mod places;
mod plan;
mod png16;
mod preview;
mod probe;
mod profile;
mod sample;
mod scene;
mod shade;
mod shaded;
mod stream;
mod text;
mod visibility;

pub use axis::{Axis, Tick};
pub use canvas::png;
pub use chart::{PlotSpec, plot_png, plot_svg};
pub use convergence::{Total, convergence};
pub use device::gpu_adapter;
pub use dots::{Dot, Shape};
pub use error::Error;
pub use gpu::GpuFormulas;
pub use look::{Look, Spot, look};
pub use map::{MapSpec, Scale, map_pixels, map_png};
pub use own::{Own, profile_own, render_own};
pub use preview::{Frame, Preview};
pub use profile::{ProfilePoint, point_at, profile};
pub use scene::{Eye, Light, RADIUS, Scene};
pub use stream::{write_exr, write_png, write_png16};
pub use visibility::Visibility;

use crate::canvas::Canvas;
use crate::colour::{DARK, EncodeTable};
use crate::cpu::Cpu;
use crate::device::Wanted;
use crate::gpu::Gpu;
use crate::paint::Tables;
use crate::picture::Page;
use crate::plan::Plan;
use crate::profile::Profile;
use crate::sample::Panel;
use crate::shade::{Engine, Job, Shaded, shade};
use crate::visibility::Tally;
use formula::{Expr, Library};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

/// Largest panel in pixels a side.
pub const MAX_SIZE: u32 = 8192;
const MIN_SIZE: u32 = 16;
/// Panels smaller than this are drawn without text: it could not be read.
const LEAST_WITH_TEXT: u32 = 96;

/// One bug as a picture: what is right and what is wrong, on a sphere.
#[derive(Clone, Debug)]
pub struct Fingerprint<'a> {
    /// The lesson it belongs to.
    pub lesson: &'a str,
    /// Its name within the lesson.
    pub id: &'a str,
    /// Title of the picture.
    pub title: String,
    /// One sentence below the title: what to look for.
    pub caption: String,
    /// The definitions that both formulas may call.
    pub library: &'a Library,
    /// Radiance of the correct shader, with its factor `n_dot_l`.
    pub right: &'a Expr,
    /// Radiance of the buggy shader.
    pub wrong: &'a Expr,
    /// The sphere's material, its lights and the eye.
    pub scene: Scene,
}

impl Fingerprint<'_> {
    /// Everything that the picture depends on, as text: two fingerprints with the same one give
    /// the same picture from the same version of this program. Formulas are in their canonical
    /// form, with their definitions opened: how they are spelt does not matter.
    pub fn key(&self, options: &Options) -> String {
        format!(
            "fingerprint\n{}\n{}\n{:?}\n{}\n{}\n{}\n{}\n{options:?}",
            self.library.canonical(self.right),
            self.library.canonical(self.wrong),
            self.scene,
            // The headings show them as they are written.
            self.library.unicode(self.right),
            self.library.unicode(self.wrong),
            self.title,
            self.caption,
        )
    }
}

/// What draws.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Backend {
    /// A graphics processor where there is a real one, else the CPU, which is faster than a
    /// software driver.
    #[default]
    Auto,
    /// Any adapter, software drivers included; [`Error::NoAdapter`] where there is none.
    Gpu,
    /// The CPU, in the [`Precision`] asked for.
    Cpu,
}

/// What the CPU computes in; a graphics processor computes in f32.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Precision {
    /// Double precision.
    #[default]
    F64,
    /// Single precision in every operation, as in a shader; about twice as fast.
    F32,
}

impl Precision {
    /// `f64` or `f32`.
    pub fn name(self) -> &'static str {
        match self {
            Self::F64 => "f64",
            Self::F32 => "f32",
        }
    }
}

/// How to draw.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Options {
    /// Width and height of one panel in pixels, 16 to [`MAX_SIZE`].
    pub size: u32,
    /// What draws.
    pub backend: Backend,
    /// What the CPU computes in.
    pub precision: Precision,
    /// Leave out what the picture does not need. Without it the picture is the same and slower.
    pub skip: bool,
    /// Only the three panels, without any text: for a terminal whose cells are coarser than
    /// letters. Panels under 96 pixels are always drawn so.
    pub compact: bool,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            size: 368,
            backend: Backend::Auto,
            precision: Precision::F64,
            skip: true,
            compact: false,
        }
    }
}

/// A finished picture.
#[derive(Clone, Debug)]
pub struct Picture {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// Red, green, blue, alpha of every pixel, sRGB, rows from the top.
    pub rgba: Vec<u8>,
    /// How it was made and whether the bug shows.
    pub report: Report,
}

impl Picture {
    /// The picture as a PNG file.
    pub fn png(&self) -> Vec<u8> {
        canvas::png(self.width, self.height, &self.rgba)
    }
}

/// How a picture was made, and what it shows in numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// `gpu` or `cpu`.
    pub backend: &'static str,
    /// The adapter's name where a graphics processor drew.
    pub adapter: Option<String>,
    /// What the panels were computed in.
    pub precision: Precision,
    /// Pixels of a panel that were shaded under at least one light, their mirror images aside.
    pub pixels_shaded: u64,
    /// Pixels of a panel that were not.
    pub pixels_skipped: u64,
    /// Points at which the formulas were evaluated: several in a pixel on an edge, and each under
    /// every light that reaches it.
    pub points: u64,
    /// Calls of the formulas that were evaluated.
    pub terms_evaluated: Vec<String>,
    /// Calls that were not evaluated point by point, and why.
    pub terms_skipped: Vec<String>,
    /// Every decision about what to leave out, as a sentence.
    pub explain: Vec<String>,
    /// Factor by which both panels' values were multiplied before display.
    pub exposure: f64,
    /// Wall-clock time from formulas to pixels, in milliseconds.
    pub ms: f64,
    /// What a graphics processor's own clock says both panels took it, in milliseconds, where it
    /// has one.
    pub device_ms: Option<f64>,
    /// Whether the bug shows.
    pub visibility: Visibility,
}

/// The linear values of both panels, rows from the top; 0 where nothing is lit or seen. Of
/// several channels, the values of a pixel stand side by side.
#[derive(Clone, Debug, PartialEq)]
pub struct Raw {
    /// Width and height in pixels.
    pub size: u32,
    /// 1, or 3 (red, green, blue) where a light has a colour.
    pub channels: u32,
    /// Values of the right formula; a pixel on an edge is averaged over its area.
    pub right: Vec<f64>,
    /// Values of the wrong formula.
    pub wrong: Vec<f64>,
}

/// Draws a fingerprint.
///
/// # Errors
/// A formula that does not fit the scene, no adapter (only with [`Backend::Gpu`]), a size out of
/// range, or [`Error::Cancelled`] soon after `cancel` becomes true.
pub fn render(
    fingerprint: &Fingerprint<'_>,
    options: &Options,
    cancel: &AtomicBool,
) -> Result<Picture, Error> {
    let plan = Plan::of(fingerprint, options.skip);
    render_planned(fingerprint, plan, options, cancel)
}

fn render_planned(
    fingerprint: &Fingerprint<'_>,
    mut plan: Plan,
    options: &Options,
    cancel: &AtomicBool,
) -> Result<Picture, Error> {
    let start = Instant::now();
    // The figures are in f64, whatever draws the panels.
    let cpu = Arc::new(Cpu::new(fingerprint, &plan, Precision::F64)?);
    let profile = Profile::of(fingerprint, &cpu);
    let exposure = profile.exposure();
    let shown = Shown {
        exposure,
        raw: false,
    };
    let drawn = draw_panels(fingerprint, options, &plan, shown, cancel)?;
    let tables = Tables::default();
    let tally = if visibility::holds_for(drawn.backend, options) {
        Tally::of_all(&drawn.panel, &drawn.shaded, &tables.encode)
    } else {
        plan.explain.push(visibility::COUNTED_APART.to_owned());
        let job = job(fingerprint, options, &plan, shown, cancel)?;
        visibility::tally(&job, &cpu, &tables.encode)?
    };
    let visibility = visibility::measure(fingerprint, &cpu, &tally);
    let canvas = if options.compact || options.size < LEAST_WITH_TEXT {
        paint::compact(&drawn.panel, &drawn.shaded, &tables)
    } else {
        let page = Page::new(fingerprint, drawn.panel, &profile, exposure);
        let mut canvas = Canvas::new(page.width, page.height, DARK.paper);
        page.draw(&mut canvas, (&drawn.shaded, 0), &visibility, &tables)?;
        canvas
    };
    let pixels = u64::from(options.size).pow(2);
    Ok(Picture {
        width: canvas.width() as u32,
        height: canvas.height() as u32,
        rgba: canvas.rgba(),
        report: Report {
            backend: drawn.backend,
            adapter: drawn.adapter,
            precision: match drawn.backend {
                "gpu" => Precision::F32,
                _ => options.precision,
            },
            pixels_shaded: drawn.shaded.pixels,
            pixels_skipped: pixels - drawn.shaded.pixels,
            points: drawn.shaded.points,
            terms_evaluated: plan.evaluated,
            terms_skipped: plan.skipped,
            explain: plan.explain,
            exposure,
            ms: start.elapsed().as_secs_f64() * 1e3,
            device_ms: drawn.device_ms,
            visibility,
        },
    })
}

/// The factor by which a fingerprint's values are multiplied before they are shown; 1 where a
/// formula does not fit the scene.
pub fn exposure(fingerprint: &Fingerprint<'_>) -> f64 {
    let plan = Plan::of(fingerprint, true);
    Cpu::new(fingerprint, &plan, Precision::F64)
        .map_or(1.0, |cpu| Profile::of(fingerprint, &cpu).exposure())
}

/// The linear values of both panels, without a picture.
///
/// # Errors
/// As [`render`].
pub fn raw(fingerprint: &Fingerprint<'_>, options: &Options) -> Result<Raw, Error> {
    let plan = Plan::of(fingerprint, options.skip);
    let drawn = draw_panels(
        fingerprint,
        options,
        &plan,
        Shown {
            exposure: 1.0,
            raw: true,
        },
        &AtomicBool::new(false),
    )?;
    Ok(Raw {
        size: options.size,
        channels: drawn.shaded.channels() as u32,
        right: drawn.shaded.right,
        wrong: drawn.shaded.wrong,
    })
}

/// The figures of a picture, without the picture: always in f64, whatever would draw it.
///
/// # Errors
/// As [`render`].
pub fn visibility(fingerprint: &Fingerprint<'_>, options: &Options) -> Result<Visibility, Error> {
    let plan = Plan::of(fingerprint, options.skip);
    let cpu = Arc::new(Cpu::new(fingerprint, &plan, Precision::F64)?);
    let shown = Shown {
        exposure: Profile::of(fingerprint, &cpu).exposure(),
        raw: false,
    };
    let never = AtomicBool::new(false);
    let job = job(fingerprint, options, &plan, shown, &never)?;
    let tally = visibility::tally(&job, &cpu, &EncodeTable::new())?;
    Ok(visibility::measure(fingerprint, &cpu, &tally))
}

/// What a graphics processor's own clock says both panels take it, in milliseconds; `None` where it
/// has no clock, or where none draws.
///
/// # Errors
/// As [`render`].
pub fn device_ms(fingerprint: &Fingerprint<'_>, options: &Options) -> Result<Option<f64>, Error> {
    let plan = Plan::of(fingerprint, options.skip);
    let shown = Shown {
        exposure: 1.0,
        raw: true,
    };
    let drawn = draw_panels(fingerprint, options, &plan, shown, &AtomicBool::new(false))?;
    Ok(drawn.device_ms)
}

/// At how many points, over all lights, the formulas are evaluated for a picture.
///
/// # Errors
/// As [`render`].
pub fn shaded_points(fingerprint: &Fingerprint<'_>, options: &Options) -> Result<u64, Error> {
    let plan = Plan::of(fingerprint, options.skip);
    let shown = Shown {
        exposure: 1.0,
        raw: true,
    };
    let drawn = draw_panels(fingerprint, options, &plan, shown, &AtomicBool::new(false))?;
    Ok(drawn.shaded.points)
}

/// Both panels, and how they came about.
struct Drawn {
    panel: Panel,
    shaded: Shaded,
    backend: &'static str,
    adapter: Option<String>,
    device_ms: Option<f64>,
}

/// What is to be shaded.
fn job<'a>(
    fingerprint: &Fingerprint<'_>,
    options: &Options,
    plan: &Plan,
    shown: Shown,
    cancel: &'a AtomicBool,
) -> Result<Job<'a>, Error> {
    if !(MIN_SIZE..=MAX_SIZE).contains(&options.size) {
        return Err(Error::Size(options.size));
    }
    let scene = &fingerprint.scene;
    scene.check()?;
    let panel = Panel {
        size: options.size as usize,
        radius: scene.radius,
        everywhere: !plan.lens,
        half: plan.half,
        columns: plan.columns,
    };
    let geometries = scene.geometries();
    let light = |&index: &usize| (geometries[index], scene.lights[index].weights());
    Ok(Job {
        panel,
        lights: plan.lights.iter().map(light).collect(),
        channels: if scene.is_grey() { 1 } else { 3 },
        mirror: plan.mirror,
        exposure: shown.exposure,
        raw: shown.raw,
        cancel,
    })
}

/// What evaluates the formulas.
fn engine(fingerprint: &Fingerprint<'_>, options: &Options, plan: &Plan) -> Result<Engine, Error> {
    let gpu = |wanted| Gpu::new(wanted, fingerprint, plan).map(|gpu| Engine::Gpu(Box::new(gpu)));
    let found = match options.backend {
        // Whatever was asked for: what draws nothing need not be started.
        _ if plan.lights.is_empty() => return Ok(Engine::Idle),
        Backend::Gpu => return gpu(Wanted::Any),
        Backend::Auto if device::may_be_there() => gpu(Wanted::Hardware).ok(),
        Backend::Auto | Backend::Cpu => None,
    };
    match found {
        Some(engine) => Ok(engine),
        None => {
            let cpu = Cpu::new(fingerprint, plan, options.precision)?;
            Ok(Engine::Cpu(Arc::new(cpu)))
        }
    }
}

fn draw_panels(
    fingerprint: &Fingerprint<'_>,
    options: &Options,
    plan: &Plan,
    shown: Shown,
    cancel: &AtomicBool,
) -> Result<Drawn, Error> {
    let job = job(fingerprint, options, plan, shown, cancel)?;
    let panel = job.panel;
    if job.lights.is_empty() {
        // Whatever was asked for: what draws nothing need not be started.
        return Ok(Drawn {
            panel,
            shaded: shade(&job, &Engine::Idle)?,
            backend: "cpu",
            adapter: None,
            device_ms: None,
        });
    }
    let on_cpu = || -> Result<Drawn, Error> {
        let engine = Engine::Cpu(Arc::new(Cpu::new(fingerprint, plan, options.precision)?));
        let shaded = shade(&job, &engine)?;
        Ok(Drawn {
            panel,
            shaded,
            backend: "cpu",
            adapter: None,
            device_ms: None,
        })
    };
    let on_gpu = |wanted| -> Result<Drawn, Error> {
        let gpu = Gpu::new(wanted, fingerprint, plan)?;
        let adapter = Some(gpu.adapter.clone());
        let engine = Engine::Gpu(Box::new(gpu));
        let shaded = shade(&job, &engine)?;
        let device_ms = engine.device_ms();
        Ok(Drawn {
            panel,
            shaded,
            backend: "gpu",
            adapter,
            device_ms,
        })
    };
    match options.backend {
        Backend::Cpu => on_cpu(),
        Backend::Gpu => on_gpu(Wanted::Any),
        Backend::Auto if !device::may_be_there() => on_cpu(),
        Backend::Auto => match on_gpu(Wanted::Hardware) {
            // Whatever ails the graphics processor, the CPU draws the same picture.
            Err(Error::NoAdapter(_) | Error::Gpu(_)) => on_cpu(),
            drawn => drawn,
        },
    }
}

/// What is wanted of the panels.
#[derive(Clone, Copy)]
struct Shown {
    exposure: f64,
    raw: bool,
}
