//! What the examples that measure have in common: a bug on a rough metal, and the processor's time.

// Each example uses its part of it.
#![allow(dead_code)]

use formula::{Expr, Library};
use renders::{Fingerprint, Scene};

/// Dividing by 4 N·L N·V once more.
pub const TWICE: &str = "d_ggx() * v_ggx() * f_schlick() * n_dot_l / (4 * n_dot_l * n_dot_v)";

/// A rough metal under a distant light at 60°.
pub fn rough_metal() -> Scene {
    Scene::new(0.7, 0.95, 60.0)
}

/// The specular term and a wrong one.
pub struct Bug {
    library: Library,
    right: Expr,
    wrong: Expr,
}

impl Bug {
    pub fn new(wrong: &str) -> Result<Self, formula::Error> {
        Ok(Self {
            library: Library::new(),
            right: formula::parse("d_ggx() * v_ggx() * f_schlick() * n_dot_l")?,
            wrong: formula::parse(wrong)?,
        })
    }

    pub fn on(&self, scene: Scene) -> Fingerprint<'_> {
        Fingerprint {
            lesson: "example",
            id: "bug",
            title: "A bug on a ball".to_owned(),
            caption: "How long a picture takes".to_owned(),
            library: &self.library,
            right: &self.right,
            wrong: &self.wrong,
            scene,
        }
    }
}

/// Milliseconds of processor that all threads of this process have had, where the system says
/// (Linux): what else runs on the machine hardly changes it.
pub fn processor() -> Option<f64> {
    let tasks = std::fs::read_dir("/proc/self/task").ok()?;
    let had = |task: std::io::Result<std::fs::DirEntry>| -> Option<f64> {
        let text = std::fs::read_to_string(task.ok()?.path().join("schedstat")).ok()?;
        let nanoseconds: f64 = text.split_whitespace().next()?.parse().ok()?;
        Some(nanoseconds * 1e-6)
    };
    Some(tasks.filter_map(had).sum())
}
