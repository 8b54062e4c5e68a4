//! Where lessons come from. No registry: every `*.toml` of the folder is a lesson.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use tutor::{Finding, Lesson, Place, Severity};

use crate::exit::{Failure, plain_reason};

/// The lessons that were built into the program: file name and text.
const BUILT_IN: &[(&str, &str)] = include!(concat!(env!("OUT_DIR"), "/lessons.rs"));

/// One lesson file as read.
pub struct File {
    /// As it was named by the user, or `lessons/NN-name.toml`.
    pub name: String,
    pub text: String,
    /// `NN` of `NN-name.toml`, else its place in the folder.
    pub number: u32,
    /// Absent where the file is broken; `findings` say why.
    pub lesson: Option<Arc<Lesson>>,
    pub findings: Vec<Finding>,
}

/// All lessons of one folder, in the order of their numbers.
pub struct Shelf {
    pub files: Vec<File>,
}

/// A lesson file that has not been read yet.
enum Source {
    Path(PathBuf),
    BuiltIn(&'static str, &'static str),
}

impl Source {
    fn name(&self) -> String {
        match self {
            Self::Path(path) => path.display().to_string(),
            Self::BuiltIn(name, _) => format!("lessons/{name}"),
        }
    }

    fn read(&self) -> File {
        let path = match self {
            Self::BuiltIn(_, text) => return File::read(self.name(), (*text).to_owned()),
            Self::Path(path) => path,
        };
        match fs::read(path) {
            Ok(bytes) => File::from_bytes(path, bytes),
            // One file that cannot be read must not close the others.
            Err(error) => {
                let why = format!("It cannot be read: {}.", plain_reason(&error));
                let help = "Move it out of the folder of lessons, or make it readable.";
                File::unreadable(self.name(), String::new(), Place::default(), why, help)
            }
        }
    }
}

impl Shelf {
    /// Looks in `folder`, `LOBE_LESSONS`, `./lessons`, and last in the program itself.
    pub fn open(folder: Option<&Path>) -> Result<Self, Failure> {
        Ok(Self::of(&sources(folder)?))
    }

    /// One lesson by id or number. Where the name of a file says that it is the one, no other is
    /// read.
    pub fn one(folder: Option<&Path>, wanted: &str) -> Result<Arc<Lesson>, Failure> {
        let sources = sources(folder)?;
        let named = sources.iter().find(|it| stem(&it.name()) == wanted);
        if let Some(file) = named.map(Source::read)
            && let Some(lesson) = file.lesson
            && lesson.id.text == wanted
        {
            return Ok(lesson);
        }
        Self::of(&sources).find(wanted).cloned()
    }

    fn of(sources: &[Source]) -> Self {
        let files = numbered(sources.iter().map(Source::read).collect());
        Self { files }
    }

    /// The files and folders that were named.
    pub fn of_paths(paths: &[PathBuf]) -> Result<Self, Failure> {
        let mut files = Vec::new();
        for path in paths {
            if path.is_dir() {
                files.extend(of_folder(path)?.iter().map(Source::read));
            } else {
                let bytes = fs::read(path).map_err(|error| Failure::unreadable(path, &error))?;
                files.push(File::from_bytes(path, bytes));
            }
        }
        Ok(Self {
            files: numbered(files),
        })
    }

    /// Every lesson that can be taught.
    pub fn lessons(&self) -> impl Iterator<Item = &Arc<Lesson>> {
        self.files.iter().filter_map(|file| file.lesson.as_ref())
    }

    /// The files that cannot be taught.
    pub fn broken(&self) -> impl Iterator<Item = &File> {
        self.files.iter().filter(|file| file.lesson.is_none())
    }

    /// Says on standard error which files cannot be taught; the others still open.
    pub fn warn_of_broken(&self) {
        for file in self.broken() {
            crate::output::complain(&file.why_broken());
        }
    }

    /// The file of a lesson with its lesson, by id or number.
    pub fn find(&self, wanted: &str) -> Result<&Arc<Lesson>, Failure> {
        let by_number = |file: &&File| wanted.parse() == Ok(file.number);
        let by_id = |file: &&File| match &file.lesson {
            Some(lesson) => lesson.id.text == wanted,
            None => stem(&file.name) == wanted,
        };
        let Some(file) = self
            .files
            .iter()
            .find(by_id)
            .or_else(|| self.files.iter().find(by_number))
        else {
            let ids = self.lessons().map(|lesson| lesson.id.text.as_str());
            return Err(unknown("lesson", wanted, ids, "`lobe list` shows them"));
        };
        file.lesson
            .as_ref()
            .ok_or_else(|| Failure::unusable(file.why_broken()))
    }
}

/// The files of `folder`, `LOBE_LESSONS`, `./lessons`, or those in the program itself.
fn sources(folder: Option<&Path>) -> Result<Vec<Source>, Failure> {
    if let Some(folder) = folder {
        return of_folder(folder);
    }
    if let Some(folder) = env::var_os("LOBE_LESSONS").filter(|value| !value.is_empty()) {
        return of_folder(Path::new(&folder));
    }
    Ok(of_folder(Path::new("lessons")).unwrap_or_else(|_| {
        let files = BUILT_IN.iter();
        files
            .map(|(name, text)| Source::BuiltIn(name, text))
            .collect()
    }))
}

fn of_folder(folder: &Path) -> Result<Vec<Source>, Failure> {
    let entries = fs::read_dir(folder).map_err(|error| Failure::unreadable(folder, &error))?;
    let mut paths: Vec<PathBuf> = entries
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter(|path| {
            path.extension()
                .is_some_and(|extension| extension == "toml")
        })
        .collect();
    paths.sort();
    if paths.is_empty() {
        return Err(Failure::unusable(format!(
            "no lesson in {}: put a .toml file there, or leave --lessons out to take the lessons built in",
            folder.display()
        )));
    }
    Ok(paths.into_iter().map(Source::Path).collect())
}

/// The name of a file without its folder, its number and its ending.
fn stem(name: &str) -> &str {
    let name = name.rsplit(['/', '\\']).next().unwrap_or(name);
    let stem = name.strip_suffix(".toml").unwrap_or(name);
    match stem.split_once('-') {
        Some((number, rest)) if number.parse::<u32>().is_ok() => rest,
        _ => stem,
    }
}

impl File {
    fn read(name: String, text: String) -> Self {
        let (lesson, findings) = tutor::load(&name, &text);
        let with_measure = |mut lesson: Lesson| {
            lesson.measure = Some(crate::seen::means);
            Arc::new(lesson)
        };
        Self {
            name,
            text,
            number: 0,
            lesson: lesson.map(with_measure),
            findings,
        }
    }

    fn from_bytes(path: &Path, bytes: Vec<u8>) -> Self {
        let name = path.display().to_string();
        match String::from_utf8(bytes) {
            Ok(text) => Self::read(name, text),
            Err(error) => {
                let start = error.utf8_error().valid_up_to();
                let text = String::from_utf8_lossy(error.as_bytes()).into_owned();
                let place = Place {
                    start,
                    end: start + char::REPLACEMENT_CHARACTER.len_utf8(),
                };
                let why = "This byte is not UTF-8 text.";
                Self::unreadable(name, text, place, why, "Save the file as UTF-8.")
            }
        }
    }

    /// A file that is no text, with the finding that says so.
    fn unreadable(
        name: String,
        text: String,
        place: Place,
        why: impl Into<String>,
        help: &str,
    ) -> Self {
        let finding = Finding::new(&name, &text, place, "unreadable", why).with_help(help);
        Self {
            name,
            text,
            number: 0,
            lesson: None,
            findings: vec![finding],
        }
    }

    /// The first error of the file as one line: file, line, column, what and what to do.
    pub fn why_broken(&self) -> String {
        let first = self
            .findings
            .iter()
            .find(|finding| finding.severity == Severity::Error)
            .or(self.findings.first());
        match first {
            Some(finding) => one_line(finding),
            None => format!(
                "{}: not a lesson; `lobe check {}` may say more",
                self.name, self.name
            ),
        }
    }

    fn own_number(&self) -> Option<u32> {
        let name = self.name.rsplit(['/', '\\']).next()?;
        name.split_once('-')?.0.parse().ok()
    }
}

/// `file:line:column: message; help`.
pub fn one_line(finding: &Finding) -> String {
    let mut line = format!(
        "{}:{}:{}: {}",
        finding.file, finding.line, finding.column, finding.message
    );
    if let Some(expected) = &finding.expected {
        line.push_str(&format!(" (expected {expected})"));
    }
    if let Some(help) = &finding.help {
        line.push_str(&format!("; {help}"));
    }
    line
}

fn numbered(mut files: Vec<File>) -> Vec<File> {
    for (place, file) in files.iter_mut().enumerate() {
        file.number = file.own_number().unwrap_or(place as u32 + 1);
    }
    files
}

/// "there is no lesson `smth-g2`: did you mean `smith-g2`?"
pub fn unknown<'a>(
    what: &str,
    wanted: &str,
    known: impl Iterator<Item = &'a str>,
    else_say: &str,
) -> Failure {
    let nearest = known
        .map(|name| (strsim::damerau_levenshtein(name, wanted), name))
        .filter(|(distance, name)| *distance <= 2 + name.len() / 4)
        .min();
    match nearest {
        Some((_, name)) => Failure::unusable(format!(
            "there is no {what} `{wanted}`: did you mean `{name}`?"
        )),
        None => Failure::unusable(format!("there is no {what} `{wanted}`: {else_say}")),
    }
}
