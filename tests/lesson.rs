//! A learner takes each lesson on the screen, errs, and loses the power after every answer.

mod common;

use std::fs;
use std::path::Path;
use std::sync::Arc;

use common::Terminal;
use tutor::Lesson;
use tutor::exercise::{Truth, draw};
use tutor::record::Record;
use tutor::session::{Effect, Event, Msg, Session, Start};
use tutor::view::{Input, Saving, Stage, View};

const SEED: u64 = 7;
const SIZE: (u16, u16) = (100, 40);
/// The file that the editor copies from.
const MENDED: &str = "mended.wgsl";

/// What a learner does on one screen.
enum Deed {
    /// Reads to the end and goes on.
    GoOn,
    /// Types a line.
    Line(String),
    /// Writes an explanation.
    Explain(String),
    /// Moves to an option.
    Choose(usize),
    /// Puts items, by their places as shown, into this order.
    Sort(Vec<usize>),
    /// Writes a shader in an editor, and runs it.
    Mend(String),
    /// Points at a place at this height of the ball's centre, so far to the right.
    Point(f64),
    /// Marks every point as said.
    TickAll(usize),
}

struct Learner {
    lesson: Arc<Lesson>,
    home: tempfile::TempDir,
    terminal: Terminal,
    /// Every answer given, in order.
    given: Vec<String>,
    erred: bool,
    missed: bool,
}

impl Learner {
    fn new(file: &str) -> Self {
        let path = common::lessons().join(file);
        let text = fs::read_to_string(&path).expect("a lesson file");
        let (lesson, findings) = tutor::load(&path.display().to_string(), &text);
        let lesson = Arc::new(lesson.unwrap_or_else(|| panic!("{findings:?}")));
        let home = tempfile::tempdir().expect("a folder");
        let terminal = start(home.path(), &lesson.id.text);
        Self {
            lesson,
            home,
            terminal,
            given: Vec::new(),
            erred: false,
            missed: false,
        }
    }

    fn record(&self) -> Option<Record> {
        let folder = fs::read_dir(self.home.path().join("progress")).ok()?;
        let file = folder
            .filter_map(|entry| Some(entry.ok()?.path()))
            .find(|path| {
                path.extension()
                    .is_some_and(|extension| extension == "toml")
            })?;
        let text = fs::read_to_string(file).ok()?;
        Some(Record::from_toml(&text).expect("a log is whole at any time"))
    }

    /// The session as the log tells it: the screen has to show the same.
    fn session(&self) -> Session {
        match self.record() {
            Some(record) => {
                let (session, changed) = Session::resume(
                    Arc::clone(&self.lesson),
                    record.start(),
                    &record.header.hash,
                    &record.events(),
                );
                assert_eq!(changed, None);
                session
            }
            None => Session::new(
                Arc::clone(&self.lesson),
                Start {
                    seed: SEED,
                    slips: Vec::new(),
                },
            ),
        }
    }

    /// What to do on this screen: right, but for one known mistake and one poor explanation.
    fn deed(&mut self, session: &Session) -> Deed {
        match &session.screen().input {
            Input::None => Deed::GoOn,
            Input::Number { .. } => Deed::Line(self.number(session)),
            Input::Reply { .. } => Deed::Line(self.reply(session)),
            Input::Text { .. } => Deed::Explain(self.explanation(session)),
            Input::Code { .. } => Deed::Mend(self.solution(session)),
            // The highlight, and the rim.
            Input::Place { picture, .. } => Deed::Point(match picture.as_str() {
                "double-division" => 0.5,
                _ => 0.98,
            }),
            Input::Choice { options } => {
                let right = (0..options.len()).find(|at| {
                    attempt(session, &(at + 1).to_string())
                        .is_some_and(|(_, _, _, result)| result == "correct")
                });
                Deed::Choose(right.expect("one option is right"))
            }
            Input::Order { .. } => Deed::Sort(self.right_order(session)),
            Input::Checklist { points } => Deed::TickAll(points.len()),
        }
    }

    fn number(&mut self, session: &Session) -> String {
        let (item, step, seed, _) = attempt(session, "?").expect("an answer is an attempt");
        let exercise = self
            .lesson
            .exercise(&item)
            .expect("an exercise of the lesson");
        let drawn = draw(&self.lesson, exercise, seed).expect("numbers");
        let step = drawn
            .steps
            .iter()
            .find(|it| it.name == step)
            .or(drawn.steps.last())
            .expect("a step");
        let named = drawn
            .mistakes
            .iter()
            .find(|it| it.named && it.step == step.name);
        match named {
            Some(mistake) if !self.erred => {
                self.erred = true;
                mistake.value.to_string()
            }
            _ => step.truth.to_string(),
        }
    }

    /// A reply to a question of the tutor's.
    fn reply(&mut self, session: &Session) -> String {
        let key = &session.screen().key;
        let item = key.split(':').nth(1).expect("a question is on the screen");
        let explain = self.lesson.explain(item).expect("a question of the lesson");
        let pass = explain
            .rubric
            .example
            .iter()
            .find(|it| it.verdict == "pass");
        pass.expect("an example that passes").text.trim().to_owned()
    }

    fn solution(&self, session: &Session) -> String {
        let key = &session.screen().key;
        let item = key.strip_prefix("practice:").expect("an exercise");
        let exercise = self.lesson.exercise(item).expect("an exercise");
        let task = tutor::exercise::shader::task(exercise).expect("a shader");
        task.solution.trim_end().to_owned()
    }

    fn right_order(&self, session: &Session) -> Vec<usize> {
        let (item, _, seed, _) = attempt(session, "1").expect("an answer is an attempt");
        let exercise = self
            .lesson
            .exercise(&item)
            .expect("an exercise of the lesson");
        match draw(&self.lesson, exercise, seed).expect("a draw").truth {
            Truth::Order(places) => places,
            other => panic!("{item} is no order: {other:?}"),
        }
    }

    fn explanation(&mut self, session: &Session) -> String {
        let item = explained_item(session);
        let explain = self
            .lesson
            .explain(&item)
            .expect("a question of the lesson");
        let example = |verdict: &str| {
            explain
                .rubric
                .example
                .iter()
                .find(|it| it.verdict == verdict)
        };
        let poor = example("fail")
            .or(example("partial"))
            .filter(|_| !self.missed);
        let answer = poor.or(example("pass")).expect("an example that passes");
        self.missed = true;
        answer.text.trim().to_owned()
    }

    /// Does it, and waits until the log has it and the screen says so.
    fn act(&mut self, deed: Deed) {
        let before = self.record().map_or(0, |record| entries(&record));
        let answered_before = self.record().map_or(0, |record| answers(&record).len());
        if let Deed::Mend(text) = &deed {
            // The editor is one that copies.
            fs::write(self.home.path().join(MENDED), text).expect("a file");
            self.terminal.send("\x0f");
            common::wait_for("the draft", || {
                let record = self.record()?;
                let last = &record.entries.last()?.event;
                matches!(last, Event::Draft { text: draft, .. } if draft == text).then_some(())
            });
        }
        let terminal = &mut self.terminal;
        match &deed {
            // To the end of the page first: what is not read yet is not left.
            Deed::GoOn => terminal.send("G\r"),
            Deed::Line(text) => terminal.send(&format!("{text}\r")),
            // Pasted, as line breaks are text there.
            Deed::Explain(text) => terminal.send(&format!("\x1b[200~{text}\x1b[201~\x13")),
            Deed::Mend(_) => terminal.send("\x13"),
            Deed::Point(x) => terminal.send(&pointing(*x)),
            Deed::Choose(at) => terminal.send(&format!("{}\r", at + 1)),
            Deed::Sort(places) => terminal.send(&sorting(places)),
            Deed::TickAll(count) => terminal.send(&format!("{}\r", "y".repeat(*count))),
        }
        let answered = |record: &Record| {
            entries(record) > before
                && match &deed {
                    Deed::GoOn => true,
                    Deed::Line(text) | Deed::Explain(text) | Deed::Mend(text) => {
                        answers(record).iter().any(|it| it.trim() == text.trim())
                    }
                    Deed::Choose(_) | Deed::Sort(_) | Deed::Point(_) => {
                        answers(record).len() > answered_before
                    }
                    Deed::TickAll(_) => {
                        matches!(
                            record.entries.last().map(|it| &it.event),
                            Some(Event::SelfMarked { .. })
                        ) || record
                            .entries
                            .iter()
                            .rev()
                            .take(2)
                            .any(|it| matches!(it.event, Event::SelfMarked { .. }))
                    }
                }
        };
        common::wait_for("the log", || {
            self.record().filter(|record| answered(record))
        });
        if let Deed::Line(text) | Deed::Explain(text) | Deed::Mend(text) = deed {
            self.given.push(text);
        }
    }

    /// The screen shows where the log says we are, and that it is saved.
    fn look(&self, view: &View) {
        let heading: String = view.heading.chars().take(30).collect();
        let number = match &view.input {
            Input::Number { label, .. } => label.chars().take(20).collect(),
            _ => String::new(),
        };
        self.terminal
            .wait_until(&format!("{heading:?} and {number:?}"), |screen| {
                let saved = view.saving == Saving::Nothing || screen.contains("✓ saved");
                saved && screen.contains(&heading) && screen.contains(&number)
            });
    }

    /// The power goes, and comes back.
    fn lose_power(&mut self) {
        self.terminal.kill();
        self.terminal = start(self.home.path(), &self.lesson.id.text);
    }
}

fn start(home: &Path, lesson: &str) -> Terminal {
    let progress = home.join("progress").display().to_string();
    let seed = SEED.to_string();
    let editor = format!("cp {}", home.join(MENDED).display());
    Terminal::start_with(
        home,
        SIZE,
        &["learn", lesson, "--seed", &seed, "--progress", &progress],
        &[("EDITOR", &editor), ("LOBE_PICTURES", "halfblocks")],
    )
}

/// Keys that sort items: each is grabbed where it is, moved up to its place, and dropped.
fn sorting(places: &[usize]) -> String {
    let mut now: Vec<usize> = (0..places.len()).collect();
    let mut keys = String::new();
    let mut cursor = 0;
    for (to, item) in places.iter().enumerate() {
        let from = now
            .iter()
            .position(|it| it == item)
            .expect("the item is there");
        let steps = from.abs_diff(cursor);
        keys.push_str(&(if from > cursor { "j" } else { "k" }).repeat(steps));
        keys.push_str(&format!(" {} ", "k".repeat(from - to)));
        now.remove(from);
        now.insert(to, *item);
        cursor = to;
    }
    keys.push('\r');
    keys
}

/// Entries, drafts left out: they are saved whenever typing pauses.
fn entries(record: &Record) -> usize {
    record
        .entries
        .iter()
        .filter(|entry| !matches!(entry.event, Event::Draft { .. }))
        .count()
}

/// Every answer in a log.
fn answers(record: &Record) -> Vec<String> {
    let answer = |event: &Event| match event {
        Event::Attempt { text, .. }
        | Event::Explained { text, .. }
        | Event::Replied { text, .. } => Some(text.clone()),
        _ => None,
    };
    record
        .entries
        .iter()
        .filter_map(|entry| answer(&entry.event))
        .collect()
}

/// Keys that move the cursor from wherever it is, and look: on a screen of 40 rows the ball has 20,
/// 40 columns, and a radius of 0.94 of half of that.
fn pointing(x: f64) -> String {
    let column = (x * 0.94 + 1.0) / 2.0 * 40.0;
    let (left, right) = ("\x1b[1;2D".repeat(12), "l".repeat(column as usize));
    format!("{left}{right}\r")
}

/// What an answer would be here: item, step, seed and result.
fn attempt(session: &Session, text: &str) -> Option<(String, String, u64, String)> {
    let effects = session.clone().update(Msg::Answer(text.to_owned()));
    effects.into_iter().find_map(|effect| match effect {
        Effect::Save(Event::Attempt {
            item,
            step,
            seed,
            result,
            ..
        }) => Some((item, step, seed, result)),
        _ => None,
    })
}

/// The question on the screen.
fn explained_item(session: &Session) -> String {
    let effects = session
        .clone()
        .update(Msg::Answer("I do not know.".to_owned()));
    let item = effects.into_iter().find_map(|effect| match effect {
        Effect::Save(Event::Explained { item, .. }) => Some(item),
        _ => None,
    });
    item.expect("an explanation is judged")
}

#[track_caller]
fn check_lesson(file: &str) {
    let mut learner = Learner::new(file);
    // A lesson has far fewer screens; this is for a lesson that goes in circles.
    for _ in 0..400 {
        let session = learner.session();
        learner.look(session.screen());
        if session.screen().stage == Stage::Result {
            break;
        }
        let deed = learner.deed(&session);
        let is_answer = !matches!(deed, Deed::GoOn);
        learner.act(deed);
        if is_answer {
            learner.look(learner.session().screen());
            learner.lose_power();
        }
    }
    let outcome = learner.session().outcome();
    assert!(outcome.finished, "{outcome:?}");
    assert!(learner.erred && learner.missed);
    assert!(
        outcome.words.starts_with("PASS on retry, after"),
        "{}",
        outcome.words
    );
    learner.terminal.wait_for("PASS on retry, after");

    let record = learner.record().expect("a log");
    let kept = answers(&record);
    for answer in &learner.given {
        assert!(
            kept.iter().any(|it| it.trim() == answer.trim()),
            "lost: {answer}"
        );
    }
    let named = |event: &Event| matches!(event, Event::Attempt { mistake: Some(_), result, .. } if result == "mistake");
    assert!(
        record.entries.iter().any(|entry| named(&entry.event)),
        "the mistake was named"
    );

    learner.terminal.send("q");
    learner.terminal.wait_for("Saved.");
    assert_eq!(learner.terminal.wait(), 0);
}

#[test]
fn the_first_lesson_survives_a_power_cut_after_every_answer() {
    check_lesson("01-ggx-d.toml");
}

#[test]
fn the_second_lesson_survives_a_power_cut_after_every_answer() {
    check_lesson("02-smith-g2.toml");
}

#[test]
fn the_third_lesson_survives_a_power_cut_after_every_answer() {
    check_lesson("03-schlick-fresnel.toml");
}
