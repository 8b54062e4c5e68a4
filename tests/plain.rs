//! A lesson as linear text.

mod common;

use std::fs;
use std::path::Path;

use common::{Terminal, run_with, stderr, stdout};

/// Goes through the beginning, answers well and badly, asks for hints, leaves in the middle of
/// an explanation.
fn script() -> String {
    let mut lines = vec![""; 40];
    lines.extend([
        ":hint", "0.5", "x", "", ":hint", ":hint", ":back", "", ":skip", ":help",
    ]);
    lines.extend([":skip"; 14]);
    lines.extend(["the middle gets dimmer", "and the rim"]);
    lines.join("\n")
}

fn learn(home: &Path, lesson: &str, folder: &str, input: &str) -> std::process::Output {
    let folder = home.join(folder).display().to_string();
    run_with(
        home,
        &[
            "learn",
            lesson,
            "--plain",
            "--seed",
            "7",
            "--progress",
            &folder,
        ],
        input,
    )
}

#[test]
fn the_same_script_gives_the_same_text() {
    for lesson in ["ggx-d", "smith-g2", "schlick-fresnel"] {
        let home = tempfile::tempdir().expect("a folder");
        let first = learn(home.path(), lesson, "first", &script());
        let second = learn(home.path(), lesson, "second", &script());
        assert_eq!(first.status.code(), Some(0), "{}", stderr(&first));
        let text = stdout(&first);
        assert_eq!(text, stdout(&second));
        assert!(
            text.lines().any(|line| line.starts_with("Saved.")),
            "{text}"
        );
        let home = home.path().display().to_string();
        assert!(
            !text.contains(&home) && !text.contains('\u{1b}'),
            "no paths, no escapes: {text}"
        );
        for line in text
            .lines()
            .filter(|line| !line.starts_with("> ") && !line.starts_with("    "))
        {
            assert!(line.chars().count() <= 80, "wider than 80: {line}");
        }
    }
}

#[test]
fn the_end_of_input_keeps_what_was_typed_and_comes_back_to_it() {
    let home = tempfile::tempdir().expect("a folder");
    // Skips everything up to the first explanation, and stops in the middle of it.
    let mut skips = String::new();
    let to_explanation = loop {
        let probe = tempfile::tempdir().expect("a folder");
        let text = stdout(&learn(probe.path(), "smith-g2", "p", &skips));
        if text.contains("a line of one `.` hands it in") {
            break skips;
        }
        skips.push_str(":skip\n");
        assert!(skips.len() < 600, "no explanation is asked for: {text}");
    };
    let input = format!("{to_explanation}The middle is too dark\nand the rim");
    assert_eq!(
        learn(home.path(), "smith-g2", "p", &input).status.code(),
        Some(0)
    );
    let again = stdout(&learn(home.path(), "smith-g2", "p", ""));
    assert!(again.contains("Resuming where you left."), "{again}");
    assert!(
        again.contains("| The middle is too dark\n| and the rim"),
        "{again}"
    );
    let handed_in = stdout(&learn(home.path(), "smith-g2", "p", "is too bright\n.\n"));
    assert!(handed_in.contains("The middle is too dark"), "{handed_in}");
    let log = fs::read_dir(home.path().join("p"))
        .expect("a folder")
        .filter_map(|entry| fs::read_to_string(entry.ok()?.path()).ok())
        .find(|text| text.contains("explained"))
        .expect("a log with the explanation");
    assert!(log.contains("is too bright"), "{log}");
}

#[test]
fn what_was_answered_to_one_line_is_not_said_again() {
    let home = tempfile::tempdir().expect("a folder");
    let text = stdout(&learn(home.path(), "smith-g2", "p", ":hint\n:foo\nabc\n"));
    assert_eq!(text.matches("There is no hint here.").count(), 1, "{text}");
    assert!(text.contains(":foo is no command."), "{text}");
}

#[test]
fn a_folder_that_cannot_be_written_is_said_before_the_lesson_starts() {
    let home = tempfile::tempdir().expect("a folder");
    fs::write(home.path().join("taken"), "a file").expect("writable");
    let output = learn(home.path(), "smith-g2", "taken", "\n\n");
    let text = stdout(&output);
    let said = text.find("cannot be saved").expect("it is said");
    assert!(text.contains("there is a file where"), "{text}");
    let first_screen = text.find("## ").expect("a first screen");
    assert!(said < first_screen, "{text}");
    assert!(text.contains("! Not saved:"), "{text}");
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("taken"), "{}", stderr(&output));
    assert_eq!(
        fs::read_to_string(home.path().join("taken")).expect("still there"),
        "a file"
    );
}

#[test]
fn an_unreadable_log_is_named_and_kept() {
    let home = tempfile::tempdir().expect("a folder");
    let folder = home.path().join("p");
    fs::create_dir(&folder).expect("writable");
    fs::write(
        folder.join("2020-01-01T00-00-00Z-smith-g2.toml"),
        "format = 1\nlesson =",
    )
    .expect("writable");
    let output = learn(home.path(), "smith-g2", "p", "\n");
    assert_eq!(output.status.code(), Some(0));
    assert!(
        stdout(&output).contains("A log could not be read"),
        "{}",
        stdout(&output)
    );
    assert!(
        stderr(&output).contains("2020-01-01T00-00-00Z-smith-g2.toml"),
        "{}",
        stderr(&output)
    );
    let kept = fs::read_dir(&folder)
        .expect("a folder")
        .filter_map(|entry| fs::read_to_string(entry.ok()?.path()).ok())
        .any(|text| text == "format = 1\nlesson =");
    assert!(kept, "the file is as it was");
}

#[test]
fn a_log_of_a_newer_version_stays_where_it_is() {
    for text in [
        "format = 2\nlesson = \"smith-g2\"\n",
        "format = 1\nprogram = \"9\"\nlesson = \"smith-g2\"\nhash = \"0\"\nseed = 7\nstarted = \"2020-01-01T00:00:00Z\"\n[[event]]\nkind = \"dreamt\"\n",
    ] {
        let home = tempfile::tempdir().expect("a folder");
        let folder = home.path().join("p");
        fs::create_dir(&folder).expect("writable");
        let log = folder.join("2020-01-01T00-00-00Z-smith-g2.toml");
        fs::write(&log, text).expect("writable");
        let output = learn(home.path(), "smith-g2", "p", "\n");
        assert_eq!(output.status.code(), Some(0));
        assert!(
            stdout(&output).contains("by a newer version"),
            "{}",
            stdout(&output)
        );
        assert!(
            stderr(&output).contains("smith-g2.toml"),
            "{}",
            stderr(&output)
        );
        assert_eq!(fs::read_to_string(&log).expect("in its place"), text);
    }
}

#[test]
fn a_dumb_terminal_gets_plain_text_and_interrupting_saves() {
    let home = tempfile::tempdir().expect("a folder");
    let folder = home.path().join("p").display().to_string();
    let args = ["learn", "2", "--progress", &folder];
    let mut terminal = Terminal::start_with(home.path(), (80, 24), &args, &[("TERM", "dumb")]);
    terminal.wait_for("[Empty line");
    terminal.send("\r");
    terminal.wait_for("Walkthrough 1");
    terminal.send("\u{3}");
    terminal.wait_for("Saved.");
    assert_eq!(terminal.wait(), 130);
}

/// The log of the only session.
fn log(home: &Path) -> String {
    fs::read_dir(home.join("p"))
        .expect("a folder")
        .filter_map(|entry| fs::read_to_string(entry.ok()?.path()).ok())
        .next()
        .unwrap_or_default()
}

#[test]
fn what_cannot_be_meant_as_an_answer_is_none() {
    // A choice, a number, and an explanation to write.
    for (skips, asked) in [
        (3, "[Type a number]"),
        (4, "keep 4 digits"),
        (14, "hands it in]"),
    ] {
        for (typed, said) in [
            ("?", ":hint  a hint; the third one is the answer"),
            ("help", ":skip  skip this"),
            (":?", ":quit  save and leave"),
            ("", "! "),
            (":foo", ":foo is no command"),
        ] {
            // Of an explanation it is a line like any other.
            if typed == ":foo" && skips == 14 {
                continue;
            }
            let home = tempfile::tempdir().expect("a folder");
            let input = format!("{}{typed}\n", ":skip\n".repeat(skips));
            let text = stdout(&learn(home.path(), "smith-g2", "p", &input));
            let after = text
                .rsplit_once(&format!("> {typed}\n"))
                .expect("it is echoed")
                .1;
            assert!(after.contains(said), "{typed:?}: {text}");
            // Said, and asked again.
            assert!(after.contains(asked), "{typed:?} at {asked}: {text}");
            let log = log(home.path());
            for kind in ["attempt", "explained", "draft"] {
                assert!(!log.contains(&format!("\"{kind}\"")), "{typed:?}: {log}");
            }
        }
    }
    let home = tempfile::tempdir().expect("a folder");
    let input = format!("{}quit\n:q\n", ":skip\n".repeat(4));
    let text = stdout(&learn(home.path(), "smith-g2", "p", &input));
    assert!(
        text.contains("! Commands begin with a colon: :quit"),
        "{text}"
    );
    assert!(
        text.contains("Saved. The same command goes on from here."),
        "{text}"
    );
    assert!(!log(home.path()).contains("\"attempt\""));
}
