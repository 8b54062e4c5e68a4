use super::*;

pub(crate) mod any;
mod replay;

fn small() -> Arc<Lesson> {
    let (lesson, findings) = crate::load::load("small.toml", include_str!("small.toml"));
    Arc::new(lesson.unwrap_or_else(|| panic!("the fixture does not load: {findings:#?}")))
}
