//! The list of lessons.

use std::sync::Arc;

use tutor::Lesson;
use tutor::session::progress::{self, LessonSummary};

use super::keys::Action;
use crate::lessons::Shelf;
use crate::sitting::now;
use crate::store::Store;

/// A lesson of the list.
pub struct Entry {
    pub number: u32,
    pub lesson: Arc<Lesson>,
    pub summary: LessonSummary,
}

/// The state of the list.
pub struct Picker {
    pub entries: Vec<Entry>,
    /// Files that cannot be taught, and why.
    pub broken: Vec<String>,
    pub at: usize,
    /// What became of the last lesson.
    pub said: Option<String>,
}

/// What the loop does next.
#[must_use]
pub enum Chosen {
    Nothing,
    Lesson {
        lesson: Arc<Lesson>,
    },
    /// What is due of it, alone.
    Due {
        lesson: Arc<Lesson>,
    },
    Leave,
}

impl Picker {
    /// A list of nothing, until there is a screen.
    pub fn empty() -> Self {
        Self {
            entries: Vec::new(),
            broken: Vec::new(),
            at: 0,
            said: None,
        }
    }

    pub fn new(shelf: &Shelf, store: &Store) -> Self {
        let entries = entries(shelf, store);
        // Where one left, else what is due, else what was never begun.
        let at = entries
            .iter()
            .position(|entry| {
                matches!(
                    entry.summary.state,
                    progress::LessonState::InProgress { .. }
                )
            })
            .or_else(|| {
                entries
                    .iter()
                    .position(|entry| !entry.summary.due.is_empty())
            })
            .or_else(|| {
                entries
                    .iter()
                    .position(|entry| entry.summary.state == progress::LessonState::New)
            })
            .unwrap_or(0);
        let broken = shelf
            .broken()
            .map(crate::lessons::File::why_broken)
            .collect();
        Self {
            entries,
            broken,
            at,
            said: None,
        }
    }

    pub fn act(&mut self, action: &Action) -> Chosen {
        match action {
            Action::Up => self.at = self.at.saturating_sub(1),
            Action::Down => self.at = (self.at + 1).min(self.entries.len().saturating_sub(1)),
            Action::Top => self.at = 0,
            Action::Bottom => self.at = self.entries.len().saturating_sub(1),
            Action::Enter | Action::Forward => {
                if let Some(entry) = self.entries.get(self.at) {
                    return Chosen::Lesson {
                        lesson: Arc::clone(&entry.lesson),
                    };
                }
            }
            Action::AskDue => {
                if let Some(entry) = self.entries.get(self.at) {
                    return Chosen::Due {
                        lesson: Arc::clone(&entry.lesson),
                    };
                }
            }
            Action::Quit => return Chosen::Leave,
            _ => {}
        }
        Chosen::Nothing
    }
}

/// Every lesson with how it stands. Logs that cannot be read count for nothing here; opening a
/// lesson names them.
pub fn entries(shelf: &Shelf, store: &Store) -> Vec<Entry> {
    let records = store.logs().map(|logs| logs.records()).unwrap_or_default();
    let today = now();
    shelf
        .files
        .iter()
        .filter_map(|file| {
            let lesson = file.lesson.clone()?;
            let summary = progress::summary(&lesson.id, &records, &today);
            Some(Entry {
                number: file.number,
                lesson,
                summary,
            })
        })
        .collect()
}
