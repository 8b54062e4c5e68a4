//! The commands, one file each.

mod bench;
mod check;
mod doctor;
mod eval;
mod evaluate;
mod exercise;
mod judge;
mod learn;
mod learn_phrases;
mod list;
mod mark;
mod play;
mod progress;
mod regrade;
mod render;
mod review;
mod run_shader;
mod stress;
mod transcript;

use std::path::Path;
use std::{fs, io};

use tutor::Lesson;
use tutor::lesson::Exercise;

use crate::cli::{Cli, Command, Folders};
use crate::exit::{Done, Failure};
use crate::lessons::{Shelf, unknown};
use crate::store::Store;

/// Runs what the command line asks for.
pub fn run(cli: Cli) -> Result<Done, Failure> {
    let folders = &cli.folders;
    match cli.command {
        None => learn::tutor(folders),
        Some(Command::Learn(args)) => learn::lesson(folders, &args),
        Some(Command::List(args)) => list::run(folders, args),
        Some(Command::Progress(args)) => progress::run(folders, args),
        Some(Command::Transcript(args)) => transcript::run(folders, &args),
        Some(Command::Eval(args)) => eval::run(&args),
        Some(Command::Exercise(args)) => exercise::run(folders, &args),
        Some(Command::Mark(args)) => mark::run(folders, &args),
        Some(Command::Judge(args)) => judge::run(folders, &args),
        Some(Command::Review(args)) => review::run(folders, &args),
        Some(Command::Regrade(args)) => regrade::run(folders, &args),
        Some(Command::Check(args)) => check::run(folders, &args),
        Some(Command::Play(args)) => play::run(folders, &args),
        Some(Command::Render(args)) => render::run(folders, &args),
        Some(Command::Bench(args)) => bench::run(&args),
        Some(Command::Stress(args)) => stress::run(&args),
        Some(Command::Doctor(args)) => doctor::run(folders, args),
        Some(Command::RunShader) => run_shader::run(),
    }
}

/// The lessons that can be taught; broken files are named on standard error.
fn shelf(folders: &Folders) -> Result<Shelf, Failure> {
    let shelf = Shelf::open(folders.lessons.as_deref())?;
    shelf.warn_of_broken();
    if shelf.lessons().next().is_none() {
        return Err(Failure::unusable(
            "no lesson can be read: mend these files, or name another folder with --lessons",
        ));
    }
    Ok(shelf)
}

fn store(folders: &Folders) -> Result<Store, Failure> {
    Store::new(folders.progress.as_deref())
}

/// The exercise of that id, in whatever lesson.
fn find_exercise<'a>(shelf: &'a Shelf, id: &str) -> Result<(&'a Lesson, &'a Exercise), Failure> {
    let found = shelf
        .lessons()
        .find_map(|lesson| Some((lesson.as_ref(), lesson.exercise(id)?)));
    found.ok_or_else(|| {
        let known = shelf
            .lessons()
            .flat_map(|lesson| exercises(lesson))
            .map(|exercise| exercise.id.text.as_str());
        unknown("exercise", id, known, "`lobe exercise --list` shows them")
    })
}

/// Every exercise of a lesson, the worked example to be filled in included.
fn exercises(lesson: &Lesson) -> impl Iterator<Item = &Exercise> {
    let faded = lesson
        .worked
        .as_ref()
        .and_then(|worked| worked.faded.as_ref());
    faded
        .map(|faded| &faded.exercise)
        .into_iter()
        .chain(&lesson.exercises)
}

/// The lines of a file, `-` for standard input.
fn lines_of(path: &Path) -> Result<Vec<String>, Failure> {
    let bytes = if path == Path::new("-") {
        let mut bytes = Vec::new();
        io::Read::read_to_end(&mut io::stdin().lock(), &mut bytes).map(|_| bytes)
    } else {
        fs::read(path)
    };
    let bytes = bytes.map_err(|error| Failure::unreadable(path, &error))?;
    let text = String::from_utf8(bytes).map_err(|_| {
        Failure::unusable(format!(
            "{} is not UTF-8 text: save it as UTF-8",
            path.display()
        ))
    })?;
    // Editors that mark UTF-8 put this before the first line.
    let text = text.strip_prefix('\u{feff}').unwrap_or(&text);
    Ok(text.lines().map(str::to_owned).collect())
}
