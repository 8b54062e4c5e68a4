//! One fingerprint drawn again and again while its scene changes: the formulas are compiled once,
//! and a frame costs only its pixels.

use crate::colour::EncodeTable;
use crate::cpu::Cpu;
use crate::plan::Plan;
use crate::profile::Profile;
use crate::sample::Panel;
use crate::scene::VARYING;
use crate::shade::{Engine, Job, Shaded, shade};
use crate::visibility::{self, Visibility};
use crate::{Error, Fingerprint, MAX_SIZE, MIN_SIZE, Precision, Raw, Scene, picture};
use formula::{Expr, Library};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

/// Both formulas, ready for any scene with the same further givens. The panels are in f32 on the
/// CPU, the figures in f64.
pub struct Preview {
    library: Library,
    right: Expr,
    wrong: Expr,
    plan: Plan,
    /// The quantities of the scene that the formulas need.
    needs: Vec<String>,
    shades: Arc<Cpu>,
    measures: Arc<Cpu>,
    encode: EncodeTable,
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
            shades: Arc::new(Cpu::new(fingerprint, &plan, Precision::F32)?),
            measures: Arc::new(Cpu::new(fingerprint, &plan, Precision::F64)?),
            library: (*library).clone(),
            right: (*right).clone(),
            wrong: (*wrong).clone(),
            plan,
            needs: needs.into_iter().collect(),
            encode: EncodeTable::new(),
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
        let fingerprint = self.fingerprint(scene);
        let exposure = Profile::of(&fingerprint, &self.measures).exposure() * stops.exp2();
        let start = Instant::now();
        let job = self.job(scene, columns, size, exposure, false)?;
        let shaded = self.shade(&job)?;
        let shading = start.elapsed();
        let tally = visibility::tally(&job, &self.measures, &self.encode)?;
        let canvas = picture::compact(&job.panel, &shaded);
        Ok(Frame {
            width: canvas.width() as u32,
            height: canvas.height() as u32,
            rgba: canvas.rgba(),
            exposure,
            visibility: visibility::measure(&fingerprint, &self.measures, &tally),
            shading,
        })
    }

    /// The linear values behind the panels of [`Preview::draw`].
    ///
    /// # Errors
    /// As [`Preview::draw`].
    pub fn raw(&mut self, scene: &Scene, size: u32) -> Result<Raw, Error> {
        let columns = self.prepare(scene)?;
        let shaded = self.shade(&self.job(scene, columns, size, 1.0, true)?)?;
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
        for cpu in [&mut self.measures, &mut self.shades] {
            Arc::make_mut(cpu).take_over(scene)?;
        }
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

    fn shade(&self, job: &Job<'_>) -> Result<Shaded, Error> {
        shade(job, &Engine::Cpu(self.shades.clone()))
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
        let panel = Panel {
            size: size as usize,
            radius: scene.radius,
            everywhere: !self.plan.lens,
            columns,
        };
        let geometries = scene.geometries();
        let pairs = geometries.iter().zip(&scene.lights);
        let lights: Vec<_> = pairs
            .map(|(geometry, light)| (*geometry, light.weights()))
            .filter(|(geometry, weights)| geometry.reaches() && *weights != [0.0; 3])
            .collect();
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
