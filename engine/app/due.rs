//! What is due again in other lessons than the one opened, and how it is asked first: lesson by
//! lesson, each in a log of its own lesson.

use std::collections::VecDeque;
use std::sync::Arc;

use tutor::Lesson;
use tutor::session::progress::{self, DueItem};

use crate::exit::Failure;
use crate::lessons::Shelf;
use crate::sitting::{Sitting, Wish};
use crate::store::Store;
use crate::tui::picker::{Entry, entries};

/// More at once would be another lesson.
const MOST_AT_ONCE: usize = 6;

/// Items of one lesson.
struct Batch {
    lesson: Arc<Lesson>,
    items: Vec<String>,
}

/// What is due.
pub struct Due {
    /// So many items are due in all.
    count: usize,
    /// Of so many lessons.
    lessons: usize,
    /// Those to be asked.
    batches: VecDeque<Batch>,
}

impl Due {
    /// What is due in other lessons than `lesson`.
    pub fn elsewhere(shelf: &Shelf, store: &Store, lesson: &Lesson) -> Option<Self> {
        Self::of(shelf, store, |entry| entry.lesson.id.text != lesson.id.text)
    }

    /// What is due in a lesson.
    pub fn within(shelf: &Shelf, store: &Store, lesson: &Lesson) -> Option<Self> {
        Self::of(shelf, store, |entry| entry.lesson.id.text == lesson.id.text)
    }

    fn of(shelf: &Shelf, store: &Store, wanted: impl Fn(&Entry) -> bool) -> Option<Self> {
        let entries: Vec<Entry> = entries(shelf, store).into_iter().filter(wanted).collect();
        // What a lesson no longer asks is due no more.
        let due: Vec<(&str, Vec<DueItem>)> = entries
            .iter()
            .map(|entry| (entry.lesson.id.text.as_str(), still_asked(entry)))
            .collect();
        let count = due.iter().map(|(_, items)| items.len()).sum();
        let lessons = due.iter().filter(|(_, items)| !items.is_empty()).count();
        let due: Vec<(&str, &[DueItem])> = due
            .iter()
            .map(|(id, items)| (*id, items.as_slice()))
            .collect();
        let batches: VecDeque<Batch> = progress::ask_first(&due, MOST_AT_ONCE)
            .into_iter()
            .filter_map(|(id, items)| {
                let entry = entries.iter().find(|entry| entry.lesson.id.text == id)?;
                let lesson = Arc::clone(&entry.lesson);
                Some(Batch { lesson, items })
            })
            .collect();
        (count > 0).then_some(Self {
            count,
            lessons,
            batches,
        })
    }

    /// What is due, and that `key` has it asked first.
    pub fn words(&self, key: &str) -> String {
        let asked: usize = self.batches.iter().map(|batch| batch.items.len()).sum();
        let of = match (self.lessons, self.batches.front()) {
            (1, Some(batch)) => format!("“{}”", batch.lesson.title.text),
            (lessons, _) => format!("{lessons} other lessons"),
        };
        match self.count {
            1 => format!("A question of {of} is due again. {key} asks it first."),
            count if count == asked => {
                format!("{count} questions of {of} are due again. {key} asks them first.")
            }
            count => {
                format!(
                    "{count} questions of {of} are due again. {key} asks {asked} of them first."
                )
            }
        }
    }
}

/// The items due in a lesson that it still asks.
pub fn still_asked(entry: &Entry) -> Vec<DueItem> {
    let asks = |id: &str| entry.lesson.exercise(id).is_some() || entry.lesson.explain(id).is_some();
    let due = entry.summary.due.iter();
    due.filter(|due| asks(&due.item)).cloned().collect()
}

/// What is to be asked, and the lesson that was opened.
pub struct Lineup {
    batches: VecDeque<Batch>,
    then: Option<(Arc<Lesson>, Wish)>,
}

impl Lineup {
    /// First what is due, then that lesson, where one is named.
    pub fn new(due: Due, then: Option<(Arc<Lesson>, Wish)>) -> Self {
        Self {
            batches: due.batches,
            then,
        }
    }

    /// What comes now; `None` at the end.
    pub fn next(&mut self, store: &Store) -> Result<Option<Sitting>, Failure> {
        if let Some(batch) = self.batches.pop_front() {
            return Sitting::ask_due(&batch.lesson, store, batch.items).map(Some);
        }
        match self.then.take() {
            Some((lesson, wish)) => Sitting::open(&lesson, store, wish).map(Some),
            None => Ok(None),
        }
    }
}
