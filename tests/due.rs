//! What is due of other lessons is offered when a lesson is opened, and kept in their own logs.

mod common;

use std::fs;
use std::path::Path;

use common::{Terminal, run_with, stdout};

fn learn(home: &Path, args: &[&str], input: &str) -> String {
    let folder = home.join("p").display().to_string();
    let all = [&["learn"][..], args, &["--plain", "--progress", &folder]].concat();
    let output = run_with(home, &all, input);
    assert_eq!(output.status.code(), Some(0), "{}", common::stderr(&output));
    stdout(&output)
}

/// Logs by the lesson they are of.
fn logs(home: &Path, lesson: &str) -> Vec<String> {
    let of = format!("lesson = \"{lesson}\"");
    fs::read_dir(home.join("p"))
        .expect("a folder")
        .filter_map(|entry| fs::read_to_string(entry.ok()?.path()).ok())
        .filter(|text| text.contains(&of))
        .collect()
}

/// An answer in the first lesson, long ago.
fn answer_long_ago(home: &Path) {
    learn(
        home,
        &["ggx-d", "--seed", "7"],
        &format!("{}0.123456\n", ":skip\n".repeat(3)),
    );
    for entry in fs::read_dir(home.join("p")).expect("a folder") {
        let path = entry.expect("a file").path();
        let text = fs::read_to_string(&path).expect("a log");
        let start = text.find("started = \"").expect("a header") + 11;
        let day = text[start..start + 10].to_owned();
        fs::write(&path, text.replace(&day, "2020-01-02")).expect("writable");
    }
}

#[test]
fn plain_text_asks_what_is_due_where_it_is_wanted() {
    let home = tempfile::tempdir().expect("a folder");
    assert!(!learn(home.path(), &["smith-g2"], "").contains(":due"));
    answer_long_ago(home.path());
    let before = logs(home.path(), "ggx-d");
    let text = learn(home.path(), &["smith-g2"], "");
    let offered = text.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(
        offered.contains("GGX D” is due again. :due asks it first."),
        "{text}"
    );
    let text = learn(home.path(), &["smith-g2"], ":due\n:hint\n");
    assert!(text.contains("# Due again: "), "{text}");
    assert!(text.contains("What is left stays due."), "{text}");
    // Left in the middle: it goes on in the same log, and then to the lesson opened.
    let text = learn(home.path(), &["smith-g2"], ":due\n0.123456\n:skip\n\n");
    assert!(text.contains("Resuming where you left."), "{text}");
    assert!(text.contains("RIGHT: none of one"), "{text}");
    let opened = text.rfind("# Facets both seen").expect("the lesson opens");
    assert!(
        opened > text.find("RIGHT: none").expect("a result"),
        "{text}"
    );
    let after = logs(home.path(), "ggx-d");
    assert_eq!(after.len(), before.len() + 1);
    assert!(
        after.contains(&before[0]),
        "the log of the lesson is as it was"
    );
    let asked = after.iter().find(|text| text.contains("\"due-again\""));
    let asked = asked.expect("a log of what was asked");
    assert!(
        asked.contains("0.123456") && !asked.contains("smith-g2"),
        "{asked}"
    );
    assert!(
        logs(home.path(), "smith-g2").is_empty(),
        "nothing was done there"
    );
    // It was looked at today, so nothing is due.
    let text = learn(home.path(), &["smith-g2"], ":due\n");
    assert!(text.contains("Nothing waits to be asked first."), "{text}");
    let text = learn(home.path(), &["ggx-d", "--due"], "");
    assert_eq!(text, "Nothing of this lesson is due.\n");
}

#[test]
fn one_lesson_alone_can_be_asked_for() {
    let home = tempfile::tempdir().expect("a folder");
    answer_long_ago(home.path());
    let text = learn(home.path(), &["ggx-d", "--due"], ":skip\n\n");
    assert!(text.starts_with("# Due again: "), "{text}");
    assert!(text.ends_with("\nSaved.\n"), "{text}");
}

#[test]
fn on_the_screen_one_key_asks_it_first() {
    let home = tempfile::tempdir().expect("a folder");
    answer_long_ago(home.path());
    let folder = home.path().join("p").display().to_string();
    let args = ["learn", "smith-g2", "--progress", &folder];
    let mut terminal = Terminal::start(home.path(), (80, 24), &args);
    terminal.wait_for("r first what is due");
    terminal.send("r");
    terminal.wait_for("Due again: ");
    terminal.send("\u{7}");
    terminal.wait_for("RIGHT: none of one");
    terminal.send("\r");
    terminal.wait_for("Facets both seen");
    terminal.wait_until("no offer", |screen| !screen.contains("first what is due"));
    terminal.send("\u{3}");
    assert_eq!(terminal.wait(), 0);

    // From the list, where the lesson says how much of it is due.
    let home = tempfile::tempdir().expect("a folder");
    answer_long_ago(home.path());
    let folder = home.path().join("p").display().to_string();
    let mut terminal = Terminal::start(home.path(), (80, 24), &["--progress", &folder]);
    terminal.wait_for("r re-test what is due");
    terminal.send("r");
    terminal.wait_for("Due again: ");
    terminal.send("\u{7}");
    terminal.wait_for("RIGHT: none of one");
    terminal.send("\r");
    terminal.wait_for("Saved.");
    terminal.send("q");
    assert_eq!(terminal.wait(), 0);
}
