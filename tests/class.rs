//! An instructor with a class's logs: reviewing, judging again, learning phrases.

mod common;

use std::fs;
use std::path::Path;

use common::{Terminal, lessons, run_with, stderr, stdout};
use serde_json::Value;
use tutor::record::Record;
use tutor::session::{Event, Start};

const ITEM: &str = "smith-g2/explain-3";

fn explained(item: &str, text: &str, verdict: &str) -> Event {
    Event::Explained {
        item: item.into(),
        attempt: 1,
        text: text.into(),
        verdict: verdict.into(),
        met: Vec::new(),
        missed: Vec::new(),
        misconceptions: Vec::new(),
        slips: Vec::new(),
        unsure: Vec::new(),
        judge: "1".into(),
        why: Vec::new(),
    }
}

fn log(folder: &Path, learner: &str, events: Vec<Event>) {
    let start = Start {
        seed: 1,
        slips: Vec::new(),
    };
    let mut record = Record::new("0", "smith-g2", "hash", "2026-01-02T03:04:05Z", &start);
    for (second, event) in events.into_iter().enumerate() {
        record.push(&format!("2026-01-02T03:05:{second:02}Z"), 1, event);
    }
    let folder = folder.join(learner);
    fs::create_dir_all(&folder).expect("writable");
    fs::write(folder.join("one.toml"), record.to_toml()).expect("writable");
}

const UNHEARD: &str = "Hmm, I could not say what the difference is, sorry.";
const WRONG: &str = "Both are the same thing: it is only dim.";

/// Ada's answer nobody could judge, Bob's was called a pass by an older judge, Cleo's is fine.
fn class() -> tempfile::TempDir {
    let class = tempfile::tempdir().expect("a folder");
    log(
        class.path(),
        "ada",
        vec![explained(ITEM, UNHEARD, "unsure")],
    );
    log(class.path(), "bob", vec![explained(ITEM, WRONG, "pass")]);
    log(class.path(), "cleo", vec![explained(ITEM, UNHEARD, "fail")]);
    class
}

#[track_caller]
fn lobe(class: &Path, args: &[&str], input: &str) -> (i32, String, String) {
    let output = run_with(class, args, input);
    let code = output.status.code().expect("it ends");
    (code, stdout(&output), stderr(&output))
}

fn json(text: &str) -> Vec<Value> {
    text.lines()
        .map(|line| serde_json::from_str(line).expect("JSON"))
        .collect()
}

fn path(class: &tempfile::TempDir) -> String {
    class.path().display().to_string()
}

#[test]
fn regrade_shows_every_verdict_that_changed_and_no_other() {
    let class = class();
    let (code, out, err) = lobe(class.path(), &["regrade", &path(&class), "--json"], "");
    assert_eq!((code, err.as_str()), (0, ""));
    let changes: Vec<_> = json(&out)
        .iter()
        .map(|it| (it["learner"].clone(), it["was"].clone(), it["now"].clone()))
        .collect();
    let row = |learner: &str, was: &str, now: &str| (learner.into(), was.into(), now.into());
    assert_eq!(
        changes,
        [row("ada", "unsure", "fail"), row("bob", "pass", "fail")]
    );
    let (_, out, _) = lobe(class.path(), &["regrade", &path(&class)], "");
    assert!(out.contains("pass → fail"), "{out}");
    assert!(
        out.contains("3 explanations in 3 logs judged again") && out.contains("2 verdicts changed"),
        "{out}"
    );
}

#[test]
fn review_lists_what_waits_and_why() {
    let class = class();
    let folder = path(&class);
    let waits = |args: &[&str]| -> Vec<(Value, Value)> {
        let args = [&["review", &folder, "--list", "--json"], args].concat();
        let (code, out, _) = lobe(class.path(), &args, "");
        assert_eq!(code, 0);
        json(&out)
            .iter()
            .map(|it| (it["reason"].clone(), it["learner"].clone()))
            .collect()
    };
    let row = |reason: &str, learner: &str| (reason.into(), learner.into());
    assert_eq!(waits(&[]), [row("unsure", "ada"), row("changed", "bob")]);
    assert_eq!(waits(&["--all"]).len(), 3);
    assert_eq!(waits(&["--item", "smith-g2/explain-1"]), []);
}

#[test]
fn marks_are_kept_and_become_examples_of_the_lesson() {
    let class = class();
    let folder = path(&class);
    let own = tempfile::tempdir().expect("a folder");
    let lesson = own.path().join("02-smith-g2.toml");
    fs::copy(lessons().join("02-smith-g2.toml"), &lesson).expect("there");
    let own = path(&own);

    // A slip of the finger is taken back, then the second answer marked too.
    let (code, out, err) = lobe(
        class.path(),
        &["review", &folder, "--plain", "--lessons", &own],
        "p\nback\nf\nx\nf\n",
    );
    assert_eq!((code, err.as_str()), (0, ""), "{out}");
    assert!(out.contains("2 marked now, 0 left; 2 marks in"), "{out}");
    let marks = fs::read_to_string(class.path().join("marks.jsonl")).expect("kept");
    let verdicts: Vec<_> = json(&marks)
        .iter()
        .map(|it| it["verdict"].clone())
        .collect();
    assert_eq!(verdicts, ["fail", "fail"]);

    let (_, out, _) = lobe(class.path(), &["review", &folder, "--lessons", &own], "");
    assert!(out.starts_with("Nothing to mark"), "{out}");

    let add = [
        "review",
        &folder,
        "--examples",
        "--write",
        "--lessons",
        &own,
    ];
    let (code, out, err) = lobe(class.path(), &add, "");
    assert_eq!((code, err.as_str()), (0, ""), "{out}");
    assert!(out.contains("2 examples added"), "{out}");
    let text = fs::read_to_string(&lesson).expect("there");
    assert!(text.contains(UNHEARD) && text.contains(WRONG));
    let (_, out, _) = lobe(class.path(), &add, "");
    assert_eq!(out, "", "once is enough");

    // And the same file is what the judge is compared with.
    let marks = class.path().join("marks.jsonl").display().to_string();
    let (code, out, _) = lobe(class.path(), &["judge", "--evaluate", &marks, "--json"], "");
    assert_eq!(code, 0);
    assert_eq!(json(&out)[0]["accuracy"]["value"], 1.0);
}

#[test]
fn one_key_an_answer_on_the_screen() {
    let class = class();
    let mut terminal = Terminal::start(class.path(), (80, 24), &["review", &path(&class)]);
    terminal.wait_for("1 of 2, 0 marked");
    terminal.wait_for("The judge could not tell.");
    terminal.wait_for("I could not say what the difference is");
    // No pass comes out while the teacher says that a mistake is there.
    terminal.send("a");
    terminal.wait_for("which point is missing?");
    terminal.send("f");
    terminal.wait_for("2 of 2, 1 marked");
    let marks = class.path().join("marks.jsonl");
    assert_eq!(json(&fs::read_to_string(&marks).expect("saved")).len(), 1);
    terminal.send("b");
    terminal.wait_for("1 of 2, 0 marked");
    assert_eq!(fs::read_to_string(&marks).expect("saved"), "");
    terminal.send("l");
    terminal.wait_for("2 of 2, 0 marked");
    terminal.send("f");
    assert_eq!(terminal.wait(), 0);
    let left = json(&fs::read_to_string(&marks).expect("saved"));
    assert_eq!(left.len(), 1);
    assert_eq!(left[0]["writer"], "bob");
}

#[test]
fn what_is_wrong_with_a_class_is_said() {
    let home = tempfile::tempdir().expect("a folder");
    let nowhere = home.path().join("nowhere").display().to_string();
    for args in [["regrade", &nowhere], ["review", &nowhere]] {
        let (code, out, err) = lobe(home.path(), &args, "");
        assert_eq!((code, out.as_str()), (2, ""));
        assert!(err.contains("nowhere") && err.lines().count() == 1, "{err}");
    }
    let empty = home.path().display().to_string();
    let (code, _, err) = lobe(home.path(), &["regrade", &empty], "");
    assert_eq!(code, 2);
    assert!(err.contains("no log in"), "{err}");

    // One broken log is named and the others are judged.
    let class = class();
    fs::write(class.path().join("ada/two.toml"), "format = \"?\"").expect("writable");
    let (code, out, err) = lobe(class.path(), &["regrade", &path(&class)], "");
    assert_eq!(code, 1);
    assert!(err.contains("two.toml"), "{err}");
    assert!(out.contains("2 verdicts changed"), "{out}");

    // Marks that are not understood are never written over.
    let marks = class.path().join("marks.jsonl");
    fs::write(&marks, "{}\n").expect("writable");
    let (code, _, err) = lobe(class.path(), &["review", &path(&class), "--plain"], "f\n");
    assert_eq!(code, 2);
    assert!(err.contains("marks.jsonl:1"), "{err}");
    assert_eq!(fs::read_to_string(&marks).expect("there"), "{}\n");
}

#[test]
fn learning_prints_what_each_phrase_gains() {
    let home = tempfile::tempdir().expect("a folder");
    let file = home.path().join("marks.jsonl");
    let mark = |id: &str, writer: &str, text: &str| {
        format!(
            "{{\"id\":\"{id}\",\"item\":\"{ITEM}\",\"writer\":\"{writer}\",\"text\":\"{text}\",\"verdict\":\"pass\"}}\n"
        )
    };
    let marks = [
        mark("1", "A", "The bug frobnicates the silhouette."),
        mark("2", "B", "I think it frobnicates the silhouette."),
        mark("3", "C", "It frobnicates the silhouette badly."),
    ];
    fs::write(&file, marks.concat()).expect("writable");
    let file = file.display().to_string();
    let (code, out, err) = lobe(home.path(), &["judge", "--learn", &file, "--json"], "");
    assert_eq!((code, err.as_str()), (0, ""));
    let learned = &json(&out)[0];
    assert_eq!(learned["writers"], 3);
    let best = &learned["proposals"][0];
    assert!(
        best["phrase"]
            .as_str()
            .is_some_and(|it| it.contains("frobnicates")),
        "{learned}"
    );
    assert_eq!(best["gains"].as_array().map(Vec::len), Some(2));
    let (_, out, _) = lobe(home.path(), &["judge", "--learn", &file], "");
    assert!(
        out.contains("3 marked answers by 3 writers") && out.contains("+2 -0"),
        "{out}"
    );

    let (code, _, err) = lobe(home.path(), &["judge", "--learn", "/nowhere"], "");
    assert_eq!(code, 2);
    assert!(err.contains("/nowhere"), "{err}");
}
