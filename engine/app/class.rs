//! A class's folder: the logs of its learners, and the teacher's marks beside them.

use std::fs;
use std::path::{Path, PathBuf};

use tutor::class::{Explanation, explanations};
use tutor::judge::evaluate::Marked;

use crate::exit::{Failure, plain_reason};
use crate::output;
use crate::store::{self, Store};

/// Where the marks are kept: JSONL, as `lobe judge --evaluate` and `--learn` read it.
const MARKS: &str = "marks.jsonl";
/// Folders are looked into so deep: class, learner, and one more.
const DEEPEST: usize = 3;

/// An explanation and whose it is.
pub struct Answered {
    pub learner: String,
    /// The log, from the class's folder on.
    pub log: String,
    pub explanation: Explanation,
}

/// Everything that was said in a class.
pub struct Class {
    pub folder: PathBuf,
    pub answers: Vec<Answered>,
    pub logs: usize,
    /// Whether something could not be read, and has been named.
    pub incomplete: bool,
}

impl Class {
    /// Reads every log below a folder; what cannot be read is named on standard error.
    pub fn read(folder: &Path) -> Result<Class, Failure> {
        let mut class = Class {
            folder: folder.to_owned(),
            answers: Vec::new(),
            logs: 0,
            incomplete: false,
        };
        // A folder that is not there is the teacher's slip, not an empty class.
        fs::read_dir(folder).map_err(|error| Failure::unreadable(folder, &error))?;
        class.read_folder(folder, 0)?;
        if class.logs == 0 && !class.incomplete {
            return Err(Failure::unusable(format!(
                "no log in {}: name the folder that holds your learners' folders of *.toml logs",
                folder.display()
            )));
        }
        Ok(class)
    }

    fn read_folder(&mut self, folder: &Path, depth: usize) -> Result<(), Failure> {
        let store = Store {
            folder: folder.to_owned(),
        };
        let logs = store.logs()?;
        for broken in &logs.unreadable {
            self.incomplete = true;
            output::complain(&format!("{}: {}", broken.path.display(), broken.why));
        }
        for log in logs.readable {
            self.logs += 1;
            let name = self.relative(&log.path);
            let learner = self.learner(folder);
            let answers = explanations(&log.record).into_iter();
            self.answers.extend(answers.map(|explanation| Answered {
                learner: learner.clone(),
                log: name.clone(),
                explanation,
            }));
        }
        if depth == DEEPEST {
            return Ok(());
        }
        let entries = match fs::read_dir(folder) {
            Ok(entries) => entries,
            Err(error) => {
                self.incomplete = true;
                let why = plain_reason(&error);
                output::complain(&format!("cannot read {}: {why}", folder.display()));
                return Ok(());
            }
        };
        let mut folders: Vec<PathBuf> = entries
            .filter_map(|entry| Some(entry.ok()?.path()))
            .filter(|path| path.is_dir())
            .filter(|path| !name_of(path).starts_with('.'))
            .collect();
        folders.sort();
        for folder in folders {
            self.read_folder(&folder, depth + 1)?;
        }
        Ok(())
    }

    fn relative(&self, path: &Path) -> String {
        let path = path.strip_prefix(&self.folder).unwrap_or(path);
        let parts: Vec<String> = path
            .components()
            .map(|part| part.as_os_str().to_string_lossy().into_owned())
            .collect();
        parts.join("/")
    }

    /// A learner goes by his folder.
    fn learner(&self, folder: &Path) -> String {
        match self.relative(folder) {
            own if own.is_empty() => {
                let whole = fs::canonicalize(folder).unwrap_or_else(|_| folder.to_owned());
                name_of(&whole)
            }
            own => own,
        }
    }
}

fn name_of(path: &Path) -> String {
    let name = path.file_name().unwrap_or_default();
    name.to_string_lossy().into_owned()
}

/// The teacher's marks on a class, written whole after every mark.
pub struct Marks {
    pub path: PathBuf,
    pub all: Vec<Marked>,
}

impl Marks {
    /// The marks made so far; none where the file is not there yet.
    pub fn of(folder: &Path) -> Result<Marks, Failure> {
        let path = folder.join(MARKS);
        let mut all = Vec::new();
        if path.exists() {
            let text =
                fs::read_to_string(&path).map_err(|error| Failure::unreadable(&path, &error))?;
            for (index, line) in text.lines().enumerate() {
                if line.trim().is_empty() {
                    continue;
                }
                // A file that is not understood is never written over.
                let mark = serde_json::from_str(line).map_err(|error| {
                    Failure::unusable(format!(
                        "{}:{}: not a mark ({error}): mend or remove this line",
                        path.display(),
                        index + 1
                    ))
                })?;
                all.push(mark);
            }
        }
        Ok(Marks { path, all })
    }

    pub fn has(&self, id: &str) -> bool {
        self.all.iter().any(|mark| mark.id == id)
    }

    /// Keeps a mark in the place of an older one of its name.
    pub fn keep(&mut self, mark: Marked) -> Result<(), Failure> {
        self.all.retain(|old| old.id != mark.id);
        self.all.push(mark);
        self.write()
    }

    pub fn forget(&mut self, id: &str) -> Result<(), Failure> {
        self.all.retain(|old| old.id != id);
        self.write()
    }

    fn write(&self) -> Result<(), Failure> {
        let mut text = String::new();
        for mark in &self.all {
            text.push_str(&serde_json::to_string(mark).unwrap_or_default());
            text.push('\n');
        }
        store::replace(&self.path, &text).map_err(|error| Failure::unwritable(&self.path, &error))
    }
}
