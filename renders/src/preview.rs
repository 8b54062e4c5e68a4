//! One fingerprint drawn again and again while its scene changes: the formulas are compiled once,
//! and a frame costs only its pixels.

use crate::cpu::Cpu;
use crate::paint::{self, Tables};
use crate::plan::Plan;
use crate::profile::Profile;
use crate::sample::Panel;
use crate::scene::VARYING;
use crate::shade::{Engine, Job, Shaded, shade, shade_again};
use crate::visibility::{self, Tally, Visibility};
use crate::{Error, Fingerprint, MAX_SIZE, MIN_SIZE, Precision, Raw, Scene};
use formula::{Expr, Library};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

/// Both formulas, ready for any scene with the same further givens, in f64 on the CPU: the panels
/// hold the figures too.
pub struct Preview {
    library: Library,
    right: Expr,
    wrong: Expr,
    plan: Plan,
    /// The quantities of the scene that the formulas need.
    needs: Vec<String>,
    cpu: Arc<Cpu>,
    tables: Tables,
    /// Memory of the frame before.
    shaded: Shaded,
    /// A frame is never cancelled.
    never: AtomicBool,
}

/// One picture of a [`Preview`].
#[derive(Clone, Debug)]
pub struct Frame {
    /// Width in pixels: three panels and what is between them.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// Red, green, blue, alpha of every pixel, sRGB, rows from the top.
    pub rgba: Vec<u8>,
    /// Factor by which both panels' values were multiplied before display.
    pub exposure: f64,
    /// Whether the bug shows.
    pub visibility: Visibility,
    /// How long both panels took to shade.
    pub shading: Duration,
}

impl Preview {
    /// Compiles both formulas.
    ///
    /// # Errors
    /// A formula that does not fit the scene.
    pub fn new(fingerprint: &Fingerprint<'_>) -> Result<Self, Error> {
        let plan = Plan::of_any_scene(fingerprint);
        let Fingerprint {
            library,
            right,
            wrong,
            ..
        } = fingerprint;
        let mut needs = library.needs(right);
        needs.append(&mut library.needs(wrong));
        Ok(Self {
            cpu: Arc::new(Cpu::new(fingerprint, &plan, Precision::F64)?),
            library: (*library).clone(),
            right: (*right).clone(),
            wrong: (*wrong).clone(),
            plan,
            needs: needs.into_iter().collect(),
            tables: Tables::default(),
            shaded: Shaded::default(),
            never: AtomicBool::new(false),
        })
    }

    /// Whether a formula takes in a quantity, so that changing it can change the picture.
    pub fn needs(&self, name: &str) -> bool {
        self.needs.iter().any(|need| need == name)
    }

    /// The three panels of `size` pixels a side, without text, and the figures. `stops` are added
    /// to the exposure that puts the brightest correct point just below white.
    ///
    /// # Errors
    /// A scene that cannot be, or with other givens than the one the formulas were compiled for;
    /// a size out of range.
    pub fn draw(&mut self, scene: &Scene, size: u32, stops: f64) -> Result<Frame, Error> {
        let columns = self.prepare(scene)?;
        let mut shaded = std::mem::take(&mut self.shaded);
        let frame = self.frame(scene, columns, size, stops, &mut shaded);
        self.shaded = shaded;
        frame
    }

    fn frame(
        &self,
        scene: &Scene,
        columns: [bool; VARYING.len()],
        size: u32,
        stops: f64,
        shaded: &mut Shaded,
    ) -> Result<Frame, Error> {
        let fingerprint = self.fingerprint(scene);
        let exposure = Profile::of(&fingerprint, &self.cpu).exposure() * stops.exp2();
        let start = Instant::now();
        let job = self.job(scene, columns, size, exposure, false)?;
        shade_again(&job, &self.engine(), shaded)?;
        let shading = start.elapsed();
        let tally = match job.panel.size <= visibility::LARGEST {
            true => Tally::of_all(&job.panel, shaded, &self.tables.encode),
            false => visibility::tally(&job, &self.cpu, &self.tables.encode)?,
        };
        let canvas = paint::compact(&job.panel, shaded, &self.tables);
        Ok(Frame {
            width: canvas.width() as u32,
            height: canvas.height() as u32,
            rgba: canvas.rgba(),
            exposure,
            visibility: visibility::measure(&fingerprint, &self.cpu, &tally),
            shading,
        })
    }

    /// The linear values behind the panels of [`Preview::draw`].
    ///
    /// # Errors
    /// As [`Preview::draw`].
    pub fn raw(&mut self, scene: &Scene, size: u32) -> Result<Raw, Error> {
        let columns = self.prepare(scene)?;
        let job = self.job(scene, columns, size, 1.0, true)?;
        let shaded = shade(&job, &self.engine())?;
        Ok(Raw {
            size,
            channels: shaded.channels() as u32,
            right: shaded.right,
            wrong: shaded.wrong,
        })
    }

    /// Takes over what the scene gives; the columns that its points need.
    fn prepare(&mut self, scene: &Scene) -> Result<[bool; VARYING.len()], Error> {
        scene.check()?;
        Arc::make_mut(&mut self.cpu).take_over(scene)?;
        let same = scene.same().a_light;
        Ok(std::array::from_fn(|index| {
            self.needs(VARYING[index]) && !same[index]
        }))
    }

    fn fingerprint(&self, scene: &Scene) -> Fingerprint<'_> {
        Fingerprint {
            lesson: "",
            id: "",
            title: String::new(),
            caption: String::new(),
            library: &self.library,
            right: &self.right,
            wrong: &self.wrong,
            scene: scene.clone(),
        }
    }

    fn engine(&self) -> Engine {
        Engine::Cpu(self.cpu.clone())
    }

    fn job(
        &self,
        scene: &Scene,
        columns: [bool; VARYING.len()],
        size: u32,
        exposure: f64,
        raw: bool,
    ) -> Result<Job<'_>, Error> {
        if !(MIN_SIZE..=MAX_SIZE).contains(&size) {
            return Err(Error::Size(size));
        }
        let mut panel = Panel {
            size: size as usize,
            radius: scene.radius,
            everywhere: !self.plan.lens,
            half: false,
            columns,
        };
        let geometries = scene.geometries();
        let pairs = geometries.iter().zip(&scene.lights);
        let lights: Vec<_> = pairs
            .map(|(geometry, light)| (*geometry, light.weights()))
            .filter(|(geometry, weights)| geometry.reaches() && *weights != [0.0; 3])
            .collect();
        panel.half = lights.iter().all(|(geometry, _)| geometry.is_upright());
        Ok(Job {
            panel,
            mirror: lights.iter().all(|(geometry, _)| geometry.is_level()),
            channels: if scene.is_grey() { 1 } else { 3 },
            exposure,
            raw,
            cancel: &self.never,
            lights,
        })
    }
}
