//! Tables: computed from the core, ready to draw.

use crate::lesson::Lesson;
use crate::prose::Block;

impl Lesson {
    /// The table of that id.
    pub fn table(&self, id: &str) -> Option<Block> {
        let _ = self.tables.iter().find(|table| table.id.text == id)?;
        None
    }
}
