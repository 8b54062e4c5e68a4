//! The learner's logs: one TOML file a session, rewritten whole after every event.
//!
//! A log goes to a temporary file, which is synced and renamed over the old one, and then the
//! folder is synced: whatever dies, there is a whole log. Writing happens on a thread of its
//! own. What cannot be written stays in memory and is tried again. Nothing here overwrites a
//! file that it could not read.

use std::env;
use std::ffi::OsString;
use std::fs::{self, File, TryLockError};
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, Sender};
use std::thread::{self, JoinHandle};
use std::time::Duration;

use etcetera::BaseStrategy as _;
use tutor::record::Record;
use tutor::session::Event;

use crate::exit::{Failure, plain_reason};

/// How long a failed write waits before it is tried again by itself.
const RETRY: Duration = Duration::from_secs(2);

/// The folder of logs.
#[derive(Clone, Debug)]
pub struct Store {
    pub folder: PathBuf,
}

/// A log that was read.
pub struct Log {
    pub path: PathBuf,
    pub record: Record,
}

/// A log that could not be read, and why.
pub struct Unreadable {
    pub path: PathBuf,
    pub why: String,
    /// A newer version of the program can read it.
    pub is_newer: bool,
}

/// Everything in the folder, oldest session first.
#[derive(Default)]
pub struct Logs {
    pub readable: Vec<Log>,
    pub unreadable: Vec<Unreadable>,
}

impl Logs {
    /// What was read, without where.
    pub fn records(&self) -> Vec<Record> {
        self.readable.iter().map(|log| log.record.clone()).collect()
    }
}

impl Store {
    /// `folder`, `LOBE_PROGRESS`, or the user's data folder. Touches nothing yet.
    pub fn new(folder: Option<&Path>) -> Result<Self, Failure> {
        if let Some(folder) = folder {
            return Ok(Self {
                folder: folder.to_owned(),
            });
        }
        if let Some(folder) = env::var_os("LOBE_PROGRESS").filter(|value| !value.is_empty()) {
            return Ok(Self {
                folder: folder.into(),
            });
        }
        match etcetera::choose_base_strategy() {
            Ok(strategy) => Ok(Self {
                folder: strategy.data_dir().join("lobe").join("progress"),
            }),
            Err(_) => Err(Failure::unusable(
                "no home folder to keep your answers in: name a folder with --progress DIR",
            )),
        }
    }

    /// Reads every log. A folder that is not there yet holds none.
    pub fn logs(&self) -> Result<Logs, Failure> {
        let entries = match fs::read_dir(&self.folder) {
            Ok(entries) => entries,
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(Logs::default()),
            Err(error) => return Err(Failure::unreadable(&self.folder, &error)),
        };
        let mut paths: Vec<PathBuf> = entries
            .filter_map(|entry| Some(entry.ok()?.path()))
            .filter(|path| {
                path.extension()
                    .is_some_and(|extension| extension == "toml")
            })
            .filter(|path| !is_hidden(path))
            .collect();
        paths.sort();
        let mut logs = Logs::default();
        for path in paths {
            let read = fs::read_to_string(&path)
                .map_err(|error| (plain_reason(&error), false))
                .and_then(|text| {
                    Record::from_toml(&text).map_err(|error| (error.to_string(), error.is_newer))
                });
            match read {
                Ok(record) => logs.readable.push(Log { path, record }),
                Err((why, is_newer)) => logs.unreadable.push(Unreadable {
                    path,
                    why,
                    is_newer,
                }),
            }
        }
        logs.readable
            .sort_by(|a, b| a.record.header.started.cmp(&b.record.header.started));
        Ok(logs)
    }

    /// Whether an answer could be saved now; else why not. Leaves nothing behind.
    pub fn try_out(&self) -> Result<(), String> {
        if self.folder.exists() && !self.folder.is_dir() {
            return Err("there is a file where the folder should be".into());
        }
        let attempt = || {
            fs::create_dir_all(&self.folder)?;
            let path = self
                .folder
                .join(format!(".lobe-{}.try", std::process::id()));
            let written = File::create(&path).and_then(|mut file| {
                file.write_all(&[b'\n'; 4096])?;
                file.sync_all()
            });
            let _ = fs::remove_file(&path);
            written
        };
        attempt().map_err(|error| plain_reason(&error))
    }

    /// Moves a log that cannot be read out of the way; its new name, or why it stayed.
    pub fn set_aside(&self, unreadable: &Unreadable) -> Result<PathBuf, String> {
        let aside = (0..)
            .map(|number: u32| {
                let mut name: OsString = unreadable.path.clone().into();
                name.push(if number == 0 {
                    ".unreadable".into()
                } else {
                    format!(".unreadable-{number}")
                });
                PathBuf::from(name)
            })
            .find(|path| !path.exists())
            .unwrap_or_else(|| unreadable.path.clone());
        fs::rename(&unreadable.path, &aside).map_err(|error| plain_reason(&error))?;
        Ok(aside)
    }

    /// A log for a session that begins now. No file appears before the first event.
    pub fn begin(&self, record: Record) -> Writer {
        let safe = |text: &str| -> String {
            text.chars()
                .map(|c| {
                    if c.is_ascii_alphanumeric() || c == '-' {
                        c
                    } else {
                        '-'
                    }
                })
                .collect()
        };
        let started = record
            .header
            .started
            .split(['.', 'Z'])
            .next()
            .unwrap_or_default();
        let stem = format!("{}Z-{}", safe(started), safe(&record.header.lesson));
        for number in 0u32.. {
            let name = if number == 0 {
                format!("{stem}.toml")
            } else {
                format!("{stem}-{number}.toml")
            };
            let path = self.folder.join(name);
            if path.exists() {
                continue;
            }
            match lock(&path) {
                Lock::Elsewhere => {}
                Lock::Ours(lock) => return Writer::spawn(path, record, Some(lock)),
                // Where not even a lock can be made nothing can be saved either; the writer
                // will say so, and go on trying.
                Lock::Impossible => return Writer::spawn(path, record, None),
            }
        }
        unreachable!("one of four billion names is free")
    }

    /// Goes on with a log; `None` where the session is open in another program.
    pub fn resume(&self, log: &Log) -> Option<Writer> {
        let lock = match lock(&log.path) {
            Lock::Ours(lock) => Some(lock),
            Lock::Impossible => None,
            Lock::Elsewhere => return None,
        };
        Some(Writer::spawn(log.path.clone(), log.record.clone(), lock))
    }
}

enum Lock {
    Ours(File),
    Elsewhere,
    Impossible,
}

fn lock(log: &Path) -> Lock {
    let made = log
        .parent()
        .map_or(Ok(()), fs::create_dir_all)
        .and_then(|()| File::create(beside(log, "lock")));
    let Ok(file) = made else {
        return Lock::Impossible;
    };
    match file.try_lock() {
        Ok(()) => Lock::Ours(file),
        Err(TryLockError::WouldBlock) => Lock::Elsewhere,
        // A file system without locks: going on beats refusing to teach.
        Err(TryLockError::Error(_)) => Lock::Impossible,
    }
}

/// `.NAME.ending` beside the log `NAME`.
fn beside(log: &Path, ending: &str) -> PathBuf {
    let name = log.file_name().unwrap_or_default().to_string_lossy();
    log.with_file_name(format!(".{name}.{ending}"))
}

fn is_hidden(path: &Path) -> bool {
    path.file_name()
        .is_some_and(|name| name.to_string_lossy().starts_with('.'))
}

/// What became of the first `count` events.
struct Report {
    count: usize,
    /// Where they could not be written, all of them are kept and tried again.
    result: Result<(), String>,
}

struct Item {
    at: String,
    took_ms: u64,
    event: Event,
}

/// Writes one log in the background.
pub struct Writer {
    orders: Option<Sender<Item>>,
    reports: Receiver<Report>,
    thread: Option<JoinHandle<Result<(), String>>>,
    sent: usize,
    /// How many events were heard of, saved or not.
    told: usize,
}

impl Writer {
    fn spawn(path: PathBuf, record: Record, lock: Option<File>) -> Self {
        let (orders, inbox) = mpsc::channel();
        let (outbox, reports) = mpsc::channel();
        let thread = thread::spawn(move || {
            let result = write_until_closed(&path, record, &inbox, &outbox);
            if lock.is_some() {
                let _ = fs::remove_file(beside(&path, "lock"));
            }
            result
        });
        Self {
            orders: Some(orders),
            reports,
            thread: Some(thread),
            sent: 0,
            told: 0,
        }
    }

    /// Has an event appended and the log written.
    pub fn append(&mut self, at: String, took_ms: u64, event: Event) {
        self.sent += 1;
        if let Some(orders) = &self.orders {
            // The thread ends only when this sender is gone.
            let _ = orders.send(Item { at, took_ms, event });
        }
    }

    /// News since the last time: a failure, or that all events so far are saved.
    pub fn news(&mut self) -> Option<Result<(), String>> {
        let mut news = None;
        while let Ok(report) = self.reports.try_recv() {
            news = self.note(report).or(news);
        }
        news
    }

    /// The same, waiting for it.
    pub fn wait_for_news(&mut self, at_most: Duration) -> Option<Result<(), String>> {
        let report = self.reports.recv_timeout(at_most).ok()?;
        let first = self.note(report);
        self.news().or(first)
    }

    fn note(&mut self, report: Report) -> Option<Result<(), String>> {
        self.told = report.count;
        // That a part is saved is no news; that something failed is.
        (report.result.is_err() || report.count == self.sent).then_some(report.result)
    }

    /// Whether a write is on its way, and news will come soon.
    pub fn is_busy(&self) -> bool {
        self.told < self.sent
    }

    /// Writes what is left, tries a last time where writing failed, and ends.
    pub fn close(mut self) -> Result<(), String> {
        self.end()
    }

    fn end(&mut self) -> Result<(), String> {
        self.orders = None;
        match self.thread.take().map(JoinHandle::join) {
            Some(Ok(result)) => result,
            Some(Err(_)) => Err("the writer of the log broke down".into()),
            None => Ok(()),
        }
    }
}

impl Drop for Writer {
    fn drop(&mut self) {
        let _ = self.end();
    }
}

fn write_until_closed(
    path: &Path,
    mut record: Record,
    inbox: &Receiver<Item>,
    outbox: &Sender<Report>,
) -> Result<(), String> {
    let mut count = 0;
    let mut last: Result<(), String> = Ok(());
    loop {
        let order = if last.is_err() {
            inbox.recv_timeout(RETRY)
        } else {
            inbox.recv().map_err(|_| RecvTimeoutError::Disconnected)
        };
        let closed = matches!(order, Err(RecvTimeoutError::Disconnected));
        let new: Vec<Item> = order.into_iter().chain(inbox.try_iter()).collect();
        count += new.len();
        let nothing_to_write = new.is_empty() && last.is_ok();
        for item in new {
            record.push(&item.at, item.took_ms, item.event);
        }
        if !nothing_to_write {
            last = replace(path, &record.to_toml()).map_err(|error| plain_reason(&error));
            let report = Report {
                count,
                result: last.clone(),
            };
            // Nobody listens any more once the session is closed.
            let _ = outbox.send(report);
        }
        if closed {
            return last;
        }
    }
}

/// Puts `text` in the place of the file at `path`: all of it, or nothing.
pub fn replace(path: &Path, text: &str) -> io::Result<()> {
    let folder = path.parent().unwrap_or(Path::new("."));
    fs::create_dir_all(folder)?;
    let temporary = beside(path, "tmp");
    let written = File::create(&temporary)
        .and_then(|mut file| {
            file.write_all(text.as_bytes())?;
            file.sync_all()
        })
        .and_then(|()| fs::rename(&temporary, path));
    if written.is_err() {
        let _ = fs::remove_file(&temporary);
        return written;
    }
    sync_folder(folder)
}

#[cfg(unix)]
fn sync_folder(folder: &Path) -> io::Result<()> {
    File::open(folder)?.sync_all()
}

/// Elsewhere a folder cannot be opened; the rename is all there is.
#[cfg(not(unix))]
fn sync_folder(_folder: &Path) -> io::Result<()> {
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use tutor::session::Start;

    fn record(started: &str) -> Record {
        Record::new(
            "0",
            "smith-g2",
            "0123456789abcdef",
            started,
            &Start {
                seed: 7,
                slips: Vec::new(),
            },
        )
    }

    fn event(text: &str) -> Event {
        Event::Skip {
            screen: text.to_owned(),
        }
    }

    #[test]
    fn what_was_reported_as_saved_is_in_the_file() {
        let folder = tempfile::tempdir().expect("a folder");
        let store = Store {
            folder: folder.path().join("new/deeper"),
        };
        assert!(
            store
                .logs()
                .expect("no folder yet is fine")
                .readable
                .is_empty()
        );
        assert_eq!(store.try_out(), Ok(()));
        let mut writer = store.begin(record("2026-01-02T03:04:05Z"));
        writer.append("2026-01-02T03:04:06Z".into(), 5, event("a"));
        while writer.wait_for_news(Duration::from_secs(60)) != Some(Ok(())) {}
        let logs = store.logs().expect("readable");
        assert_eq!(logs.readable.len(), 1);
        assert_eq!(logs.readable[0].record.entries.len(), 1);
        assert!(
            store.resume(&logs.readable[0]).is_none(),
            "open here already"
        );
        assert_eq!(writer.close(), Ok(()));
        let names: Vec<_> = fs::read_dir(&store.folder)
            .expect("a folder")
            .filter_map(Result::ok)
            .collect();
        assert_eq!(names.len(), 1, "only the log is left: {names:?}");
        let mut writer = store.resume(&logs.readable[0]).expect("free again");
        writer.append("2026-01-02T03:05:06Z".into(), 5, event("b"));
        assert_eq!(writer.close(), Ok(()));
        assert_eq!(
            store.logs().expect("readable").readable[0]
                .record
                .entries
                .len(),
            2
        );
    }

    #[test]
    fn two_sessions_of_one_second_keep_two_files() {
        let folder = tempfile::tempdir().expect("a folder");
        let store = Store {
            folder: folder.path().into(),
        };
        for _ in 0..2 {
            let mut first = store.begin(record("2026-01-02T03:04:05Z"));
            first.append("2026-01-02T03:04:06Z".into(), 5, event("a"));
            assert_eq!(first.close(), Ok(()));
        }
        assert_eq!(store.logs().expect("readable").readable.len(), 2);
    }

    #[test]
    fn a_folder_that_appears_later_gets_what_was_kept() {
        let folder = tempfile::tempdir().expect("a folder");
        let blocked = folder.path().join("blocked");
        fs::write(&blocked, "a file where the folder should be").expect("writable");
        let store = Store {
            folder: blocked.clone(),
        };
        assert!(store.try_out().is_err());
        let mut writer = store.begin(record("2026-01-02T03:04:05Z"));
        writer.append("2026-01-02T03:04:06Z".into(), 5, event("a"));
        assert!(matches!(
            writer.wait_for_news(Duration::from_secs(60)),
            Some(Err(_))
        ));
        fs::remove_file(&blocked).expect("ours");
        writer.append("2026-01-02T03:04:07Z".into(), 5, event("b"));
        assert!(writer.is_busy());
        while writer.wait_for_news(Duration::from_secs(60)) != Some(Ok(())) {}
        assert!(!writer.is_busy());
        assert_eq!(writer.close(), Ok(()));
        assert_eq!(
            store.logs().expect("readable").readable[0]
                .record
                .entries
                .len(),
            2
        );
    }

    #[test]
    fn an_unreadable_log_is_set_aside_and_kept() {
        let folder = tempfile::tempdir().expect("a folder");
        let store = Store {
            folder: folder.path().into(),
        };
        for expected in ["x.toml.unreadable", "x.toml.unreadable-1"] {
            fs::write(folder.path().join("x.toml"), "format = \"?\"").expect("writable");
            let logs = store.logs().expect("the folder is readable");
            let aside = store.set_aside(&logs.unreadable[0]).expect("movable");
            assert!(aside.ends_with(expected), "{}", aside.display());
        }
    }
}
