//! Plots: curves computed from the core, ready to draw, and the pictures beside them.

use crate::lesson::{Figures, Lesson};
use crate::prose::Block;

impl Lesson {
    /// The plot of that id.
    pub fn plot(&self, id: &str) -> Option<Block> {
        let _ = self.plots.iter().find(|plot| plot.id.text == id)?;
        None
    }

    /// The fingerprint picture of that id.
    pub fn picture(&self, id: &str) -> Option<Block> {
        let _ = self.fingerprints.iter().find(|it| it.id.text == id)?;
        None
    }

    /// Everything shown below a text: tables, then plots, then pictures.
    pub fn figures(&self, figures: &Figures) -> Vec<Block> {
        let tables = figures.table.iter().filter_map(|id| self.table(id));
        let plots = figures.plot.iter().filter_map(|id| self.plot(id));
        let pictures = figures.picture.iter().filter_map(|id| self.picture(id));
        tables.chain(plots).chain(pictures).collect()
    }
}
