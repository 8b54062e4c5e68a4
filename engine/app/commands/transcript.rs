//! `lobe transcript`: a lesson as taught, as Markdown.

use tutor::session::transcript::transcript;

use crate::cli::{Folders, Transcript};
use crate::exit::{Done, Failure};
use crate::output;

/// The learner's last session of the lesson; where there is none, the lesson without answers.
pub fn run(folders: &Folders, args: &Transcript) -> Result<Done, Failure> {
    let shelf = super::shelf(folders)?;
    let lesson = shelf.find(&args.lesson)?;
    let logs = super::store(folders)?.logs()?;
    let last = logs
        .readable
        .iter()
        .rfind(|log| log.record.header.lesson == lesson.id.text);
    let record = last.filter(|_| !args.fresh).map(|log| &log.record);
    output::text(&(transcript(lesson, record).trim_end().to_owned() + "\n"))?;
    Ok(Done::Fine)
}
