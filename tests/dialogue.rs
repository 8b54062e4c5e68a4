//! The tutor asks back: in the terminal, as plain text, and across a power cut.

mod common;

use std::fs;
use std::path::{Path, PathBuf};

use common::{Terminal, root, run_with, stderr, stdout};

const QUESTION: &str = "What does squaring do to a number?";
/// One point made, the other half said.
const ANSWER: &str = "It multiplies the number by itself.";

/// A home with a small lesson in it.
struct Learner {
    home: tempfile::TempDir,
    lessons: PathBuf,
}

impl Learner {
    fn new() -> Self {
        let home = tempfile::tempdir().expect("a folder");
        let lessons = home.path().join("lessons");
        fs::create_dir(&lessons).expect("writable");
        let from = root().join("engine/tutor/src/session/tests/small.toml");
        fs::copy(from, lessons.join("01-small.toml")).expect("the small lesson");
        Self { home, lessons }
    }

    fn args(&self, more: &[&str]) -> Vec<String> {
        let folder = |path: &Path| path.display().to_string();
        let mut args = vec!["learn".to_owned(), "small".to_owned()];
        args.extend(more.iter().map(|it| (*it).to_owned()));
        args.extend(["--seed".into(), "7".into()]);
        args.extend(["--lessons".into(), folder(&self.lessons)]);
        args.extend(["--progress".into(), folder(&self.home.path().join("p"))]);
        args
    }

    /// One sitting as plain text.
    #[track_caller]
    fn plain(&self, lines: &[&str]) -> String {
        let args = self.args(&["--plain"]);
        let args: Vec<&str> = args.iter().map(String::as_str).collect();
        let output = run_with(self.home.path(), &args, &lines.join("\n"));
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        stdout(&output)
    }

    /// Leaves out everything before the first question.
    #[track_caller]
    fn skip_to_question(&self) {
        for _ in 0..20 {
            if self.plain(&[]).contains(QUESTION) {
                return;
            }
            self.plain(&[":skip"]);
        }
        panic!("no question is asked");
    }

    fn log(&self) -> String {
        fs::read_dir(self.home.path().join("p"))
            .expect("a folder")
            .filter_map(|entry| Some(entry.ok()?.path()))
            .find(|path| path.extension().is_some_and(|it| it == "toml"))
            .and_then(|path| fs::read_to_string(path).ok())
            .expect("a log")
    }

    fn terminal(&self, size: (u16, u16)) -> Terminal {
        let args = self.args(&[]);
        let args: Vec<&str> = args.iter().map(String::as_str).collect();
        Terminal::start(self.home.path(), size, &args)
    }
}

/// From the answer on: what is typed, and what is said in that order.
#[track_caller]
fn check_plain(lines: &[&str], says: &[&str]) {
    let learner = Learner::new();
    learner.skip_to_question();
    let text = learner.plain(lines);
    // Lines are wrapped wherever they are full.
    let words: Vec<&str> = text.split_whitespace().collect();
    let text = words.join(" ");
    let mut rest = text.as_str();
    for part in says {
        let at = rest.find(part);
        let at = at.unwrap_or_else(|| panic!("no {part:?} in its place in\n{text}"));
        rest = &rest[at + part.len()..];
    }
}

#[test]
fn plain_text_asks_back_one_line_at_a_time() {
    check_plain(
        &[ANSWER, ".", "no idea", "", ":hint", "an area"],
        &[
            "! One question. You say “",
            "and that is right. What if the number",
            "[One line; :hint for more help, :skip for no more questions]",
            "! A hint. I do not hear it yet. What becomes of the unit?",
            "! Write a few words, take a hint",
            "! Fill in the blank. A length becomes ___.",
            "> [✓ an area]",
            "✓ Yes.",
            "✓ Now it is all there.",
        ],
    );
    check_plain(
        &[ANSWER, ".", ":hint", ":hint", ":hint"],
        &[
            "A length becomes ___.",
            "The answer. A length becomes an area.",
            "Part of it",
        ],
    );
    check_plain(
        &[ANSWER, ".", ":skip"],
        &["One question", "As you like", "Part of it", "Still missing"],
    );
}

#[test]
fn an_end_in_the_middle_of_it_comes_back_to_the_same_question() {
    let learner = Learner::new();
    learner.skip_to_question();
    learner.plain(&[ANSWER, ".", "no idea"]);
    let again = learner.plain(&[]);
    assert!(again.contains("no idea"), "{again}");
    assert!(again.contains("A hint. I do not hear it yet."), "{again}");
    assert!(again.contains("Your reply"), "{again}");
    assert!(!again.contains("Fill in"), "{again}");
    let done = learner.plain(&["a length becomes an area"]);
    assert!(done.contains("Now it is all there"), "{done}");
    let log = learner.log();
    assert_eq!(log.matches("kind = \"replied\"").count(), 2, "{log}");
}

#[test]
fn on_the_screen_question_hint_blank_and_checklist_survive_a_power_cut() {
    for size in [(80, 24), (200, 60)] {
        let learner = Learner::new();
        learner.skip_to_question();
        let mut terminal = learner.terminal(size);
        terminal.wait_for("In your own words");
        let half = "It multiplies the number by itself. A length becomes a surface.";
        terminal.send(&format!("\x1b[200~{half}\x1b[201~\x13"));
        terminal.wait_for("One question");
        terminal.wait_for("You say “A length becomes a surface”");
        terminal.wait_for("Your reply");
        terminal.send("no idea\r");
        terminal.wait_for("A hint");
        terminal.wait_for("✓ saved");
        terminal.kill();

        let mut terminal = learner.terminal(size);
        terminal.wait_for("A hint");
        terminal.wait_for("Your reply");
        // Half a reply is kept through the next help, by Ctrl-T.
        terminal.send("a sur");
        terminal.wait_for("a sur");
        terminal.send("\x14");
        terminal.wait_for("What belongs in the blank");
        terminal.wait_until("the reply begun", |screen| screen.contains("┃ a sur"));
        terminal.send("\x14");
        terminal.wait_for("Does your answer say this?");
        terminal.wait_for("[?] A length becomes an area.");
        terminal.send("y");
        terminal.wait_for("[x] A length becomes an area.");
        terminal.wait_for("✓ saved");
        terminal.kill();

        let mut terminal = learner.terminal(size);
        terminal.wait_for("[x] A length becomes an area.");
        terminal.send("\r");
        terminal.wait_for("By your own marking: yes");
        terminal.wait_for("✓ saved");
        let log = learner.log();
        for kind in ["explained", "replied", "hint", "marked", "self-marked"] {
            assert!(
                log.contains(&format!("kind = \"{kind}\"")),
                "no {kind} in\n{log}"
            );
        }
        terminal.send("q");
        assert_eq!(terminal.wait(), 0);
    }
}

#[test]
fn esc_and_s_want_no_more_questions() {
    let learner = Learner::new();
    learner.skip_to_question();
    let mut terminal = learner.terminal((80, 24));
    terminal.wait_for("In your own words");
    terminal.send(&format!("\x1b[200~{ANSWER}\x1b[201~\x13"));
    terminal.wait_for("no more questions");
    terminal.send("\x1b");
    terminal.wait_until("the page's keys", |screen| {
        screen.contains(" quit") && !screen.contains("leave field")
    });
    terminal.send("s");
    terminal.wait_for("Still missing");
    terminal.send("q");
    assert_eq!(terminal.wait(), 0);
}
