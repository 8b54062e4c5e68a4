//! Everything `lobe check` says about lessons beyond reading them.

use crate::finding::Finding;
use crate::lesson::Lesson;

/// What is wrong with one lesson.
pub fn check(lesson: &Lesson) -> Vec<Finding> {
    let _ = lesson;
    Vec::new()
}

/// What is wrong with lessons, each alone and all together.
pub fn check_all(lessons: &[Lesson]) -> Vec<Finding> {
    lessons.iter().flat_map(check).collect()
}
