//! `lobe` and `lobe learn`.

use std::env;
use std::io::{self, IsTerminal as _};

use crate::cli::{Folders, Json, Learn};
use crate::due::Due;
use crate::exit::{Done, Failure};
use crate::lessons::Shelf;
use crate::sitting::Wish;
use crate::{config, output, plain, tui};

/// The list of lessons on the screen; without a screen, the list as text.
pub fn tutor(folders: &Folders) -> Result<Done, Failure> {
    if !has_screen() {
        return super::list::run(folders, Json::default());
    }
    // What is broken is said on the screen, not above it.
    let shelf = Shelf::open(folders.lessons.as_deref())?;
    let judge = config::read()?.judge;
    tui::run(&shelf, &super::store(folders)?, judge, tui::Open::List)
}

/// One lesson.
pub fn lesson(folders: &Folders, args: &Learn) -> Result<Done, Failure> {
    // Only the lesson asked for is worth a word here; `lobe list` names every broken file.
    let shelf = Shelf::open(folders.lessons.as_deref())?;
    let store = super::store(folders)?;
    let lesson = shelf.find(&args.lesson)?;
    let wish = Wish {
        new: args.new,
        seed: args.seed,
    };
    let judge = config::read()?.judge;
    let is_plain = args.plain || !has_screen();
    if args.due {
        let Some(due) = Due::within(&shelf, &store, lesson) else {
            output::line("Nothing of this lesson is due.")?;
            return Ok(Done::Fine);
        };
        return match is_plain {
            true => plain::run_due(due, &store, judge),
            false => tui::run(&shelf, &store, judge, tui::Open::Due(due)),
        };
    }
    match is_plain {
        true => {
            let due = Due::elsewhere(&shelf, &store, lesson);
            plain::run(lesson, wish, due, &store, judge)
        }
        false => tui::run(&shelf, &store, judge, tui::Open::Lesson(lesson, wish)),
    }
}

/// Whether there is a terminal that can be drawn on.
pub fn has_screen() -> bool {
    let dumb = env::var_os("TERM").is_some_and(|term| term == "dumb");
    !dumb && io::stdin().is_terminal() && io::stdout().is_terminal()
}
