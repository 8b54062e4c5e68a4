//! The teaching: lessons as data, prose with live numbers, exercises drawn and marked, the
//! judge, the session.
//!
//! Nothing here touches a file, the environment, a clock, a thread or a process, and nothing
//! is random but what a seed decides. A lesson comes in as text and leaves as blocks to draw.

pub mod check;
pub mod class;
pub mod exercise;
pub mod finding;
pub mod judge;
pub mod lesson;
pub mod load;
pub mod map;
pub mod opinion;
pub mod plot;
pub mod prose;
pub mod record;
pub mod review;
pub mod rubric;
pub mod session;
pub mod table;
pub mod view;
pub mod worked;

pub use check::{check, check_all};
pub use finding::{Finding, Place, Severity};
pub use lesson::Lesson;
pub use load::load;
