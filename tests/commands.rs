//! What the commands print, as other programs read it.

mod common;

use std::fs;

use common::{run, run_with, stderr, stdout};
use serde_json::Value;

/// Every line as JSON.
#[track_caller]
fn json(text: &str) -> Vec<Value> {
    text.lines()
        .map(|line| serde_json::from_str(line).unwrap_or_else(|error| panic!("{error}: {line}")))
        .collect()
}

#[track_caller]
fn one(args: &[&str]) -> Value {
    let output = run(args);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let mut objects = json(&stdout(&output));
    assert_eq!(objects.len(), 1);
    objects.remove(0)
}

/// The names of an object, in the order in which they are printed.
fn names(object: &Value) -> Vec<&str> {
    let mut names: Vec<&str> = object
        .as_object()
        .expect("an object")
        .keys()
        .map(String::as_str)
        .collect();
    names.sort_unstable();
    names
}

#[track_caller]
fn check_eval(expr: &str, value: f64) {
    let object = one(&["eval", "--json", "--", expr]);
    assert_eq!(names(&object), ["expr", "value"]);
    assert_eq!(object["expr"], expr);
    let printed = object["value"].as_f64().expect("a number");
    assert!(
        (printed - value).abs() <= 1e-12 * value.abs(),
        "{expr}: {printed}"
    );
}

#[test]
fn eval_prints_values() {
    check_eval("1/3", 1.0 / 3.0);
    check_eval("-2^2", -4.0);
    check_eval(
        "v_ggx(n_dot_l = 0.6, n_dot_v = 0.8, roughness = 0.4)",
        0.513_218_039_315_330_2,
    );
    check_eval("2 > 1", 1.0);
    // A minus sign begins no option, and options may follow.
    let output = run(&["eval", "-2^2", "-deg(60)", "-1", "--json"]);
    let values: Vec<Value> = json(&stdout(&output));
    assert_eq!(values.len(), 3, "{}", stderr(&output));
    assert_eq!(
        values[0],
        serde_json::json!({"expr": "-2^2", "value": -4.0})
    );
}

#[test]
fn eval_keeps_seventeen_digits() {
    let text = stdout(&run(&["eval", "1/3", "--json"]));
    assert_eq!(text, "{\"expr\":\"1/3\",\"value\":0.33333333333333331}\n");
}

#[test]
fn eval_computes_in_f32() {
    let object = one(&["eval", "1/3", "--precision", "f32", "--json"]);
    assert_eq!(object["value"].as_f64(), Some(f64::from(1.0f32 / 3.0)));
    // In f64 the sum is 1e-8; in f32 it is lost on the way.
    let object = one(&["eval", "(1 + 1e-8) - 1", "--precision", "f32", "--json"]);
    assert_eq!(object["value"].as_f64(), Some(0.0));
}

#[test]
fn eval_says_where_there_is_no_value() {
    for expr in ["1/0", "ln(-1)", "1 +", "d_gxx(n_dot_h = 1, alpha = 1)", ""] {
        let output = run(&["eval", "--json", "--", expr]);
        assert_eq!(output.status.code(), Some(1), "{expr}");
        let object = &json(&stdout(&output))[0];
        assert_eq!(names(object), ["error", "expr", "value"]);
        assert!(
            object["value"].is_null() && object["error"].is_string(),
            "{object}"
        );
    }
    assert!(stderr(&run(&["eval", "d_gxx(n_dot_h = 1, alpha = 1)"])).contains("d_ggx"));
}

#[test]
fn eval_takes_a_batch() {
    let home = tempfile::tempdir().expect("a folder");
    let output = run_with(
        home.path(),
        &["eval", "--batch", "-"],
        "\u{feff}1+1\r\n\n1/0\nsqrt(2)\n",
    );
    assert_eq!(output.status.code(), Some(1));
    let objects = json(&stdout(&output));
    assert_eq!(objects.len(), 3);
    assert_eq!(objects[0], serde_json::json!({"expr": "1+1", "value": 2.0}));
    assert!(objects[1]["value"].is_null());
    assert_eq!(objects[2]["value"].as_f64(), Some(2f64.sqrt()));
}

#[test]
fn exercises_are_listed_drawn_and_marked() {
    let list = json(&stdout(&run(&["exercise", "--list", "--json"])));
    assert!(list.len() >= 8, "two lessons of at least four");
    for row in &list {
        assert_eq!(names(row), ["id", "kind", "lesson"]);
    }
    for row in list.iter().filter(|row| row["kind"] == "numeric") {
        let id = row["id"].as_str().expect("an id");
        let drawn = one(&["exercise", id, "--seed", "3", "--json"]);
        for name in [
            "id",
            "seed",
            "given",
            "prompt",
            "steps",
            "truth",
            "tolerance",
            "mistakes",
        ] {
            assert!(drawn.get(name).is_some(), "{id}: {name} in {drawn}");
        }
        assert_eq!(drawn["seed"], 3);
        assert!(
            drawn["tolerance"]["rel"]
                .as_f64()
                .is_some_and(|rel| rel >= 0.005),
            "{id}"
        );
        let truth = drawn["truth"].as_f64().expect("a number");
        let marked = one(&[
            "mark",
            id,
            "--seed",
            "3",
            "--json",
            "--answer",
            &format!("{truth:e}"),
        ]);
        assert_eq!(names(&marked), ["mistake", "result", "says"]);
        assert_eq!(marked["result"], "correct", "{id}");
        for mistake in drawn["mistakes"].as_array().expect("mistakes") {
            let value = mistake["value"].as_f64().expect("a number");
            if mistake["named"] == true {
                let answer = format!("{value:e}");
                let marked = one(&["mark", id, "--seed", "3", "--json", "--answer", &answer]);
                assert_eq!(marked["result"], "mistake", "{id}: {mistake}");
                assert_eq!(marked["mistake"], mistake["id"], "{id}");
            }
        }
        let marked = one(&["mark", id, "--seed", "3", "--json", "--answer", "what?"]);
        assert_eq!(marked["result"], "invalid", "{id}");
    }
}

#[test]
fn a_slip_is_carried_forward() {
    let drawn = one(&["exercise", "smith-g2/v", "--seed", "1", "--json"]);
    let given = &drawn["given"];
    let number = |name: &str| given[name].as_f64().expect("a given");
    // Alpha taken as the roughness itself; everything after it done right.
    let (alpha, l, v) = (number("roughness"), number("n_dot_l"), number("n_dot_v"));
    let root = |c: f64| (alpha * alpha + (1.0 - alpha * alpha) * c * c).sqrt();
    let steps: Vec<&str> = drawn["steps"]
        .as_array()
        .expect("steps")
        .iter()
        .filter_map(|step| step["name"].as_str())
        .collect();
    let earlier = format!("{}={alpha}", steps[0]);
    let marked = one(&[
        "mark",
        "smith-g2/v",
        "--seed",
        "1",
        "--json",
        "--step",
        steps[1],
        "--answer",
        &format!("{:.9}", root(v)),
        "--earlier",
        &earlier,
    ]);
    let other = one(&[
        "mark",
        "smith-g2/v",
        "--seed",
        "1",
        "--json",
        "--step",
        steps[1],
        "--answer",
        &format!("{:.9}", root(l)),
        "--earlier",
        &earlier,
    ]);
    assert!(
        marked["result"] == "carried" || other["result"] == "carried",
        "{marked} {other}"
    );
}

#[test]
fn answers_are_judged() {
    let home = tempfile::tempdir().expect("a folder");
    let answer = "It divides by 4 N.L N.V twice: V already contains that division, so the picture is \
                  multiplied by 1/(4 N.L N.V) once more.";
    let output = run_with(
        home.path(),
        &["judge", "smith-g2/explain-1", "--json"],
        answer,
    );
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let judged = &json(&stdout(&output))[0];
    assert_eq!(
        names(judged),
        ["item", "met", "misconceptions", "unsure", "verdict", "why"]
    );
    for why in judged["why"].as_array().expect("reasons") {
        assert_eq!(names(why), ["id", "quote"]);
        assert!(
            answer.contains(why["quote"].as_str().expect("words")),
            "{why}"
        );
    }
    let batch = format!(
        "{}\n{}\n",
        serde_json::json!({"id": 1, "item": "smith-g2/explain-1", "text": answer}),
        serde_json::json!({"id": "b", "item": "ggx-d/explain", "text": ""}),
    );
    let objects = json(&stdout(&run_with(
        home.path(),
        &["judge", "--batch", "-"],
        &batch,
    )));
    assert_eq!(objects[0]["id"], 1);
    assert_eq!(objects[0]["verdict"], judged["verdict"]);
    let unknown = serde_json::json!({"id": 1, "item": "smith-g2/explain-9", "text": ""});
    let output = run_with(
        home.path(),
        &["judge", "--batch", "-"],
        &format!("\n{unknown}\n"),
    );
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("-:2: "), "{}", stderr(&output));
    // A bad line takes no good one with it.
    let mixed = batch.replacen('\n', "\n{\"id\": 3}\n", 1);
    let output = run_with(home.path(), &["judge", "--batch", "-"], &mixed);
    assert_eq!(output.status.code(), Some(2));
    assert_eq!(json(&stdout(&output)), objects);
    assert!(
        stderr(&output).contains("-:2: not an answer"),
        "{}",
        stderr(&output)
    );
    assert!(
        stderr(&output).contains("1 of 3 lines"),
        "{}",
        stderr(&output)
    );
    assert_eq!(
        (&objects[1]["id"], &objects[1]["verdict"]),
        (&"b".into(), &"fail".into())
    );
}

#[test]
fn check_passes_on_the_lessons_and_finds_a_changed_digit() {
    let output = run(&["check"]);
    assert_eq!(output.status.code(), Some(0), "{}", stdout(&output));

    let text = fs::read_to_string(common::lessons().join("02-smith-g2.toml")).expect("a lesson");
    let line = 1 + text
        .lines()
        .position(|line| line.contains("0.5132"))
        .expect("the number is there");
    let home = tempfile::tempdir().expect("a folder");
    fs::copy(
        common::lessons().join("01-ggx-d.toml"),
        home.path().join("01-ggx-d.toml"),
    )
    .expect("writable");
    let changed = home.path().join("02-smith-g2.toml");
    fs::write(&changed, text.replacen("0.5132", "0.5133", 1)).expect("writable");
    let folder = home.path().display().to_string();

    let output = run(&["check", &folder, "--format", "json"]);
    assert_eq!(output.status.code(), Some(1));
    let findings = json(&stdout(&output));
    let found = findings
        .iter()
        .find(|finding| finding["line"] == line)
        .unwrap_or_else(|| panic!("{findings:?}"));
    let written = text.lines().nth(line - 1).expect("that line");
    let column = found["column"].as_u64().expect("a column") as usize;
    let at: String = written.chars().skip(column - 1).take(8).collect();
    assert!(at.contains("0.5132"), "column {column} of {written}");
    assert!(
        found["file"]
            .as_str()
            .is_some_and(|file| file.ends_with("02-smith-g2.toml"))
    );

    let human = stdout(&run(&["check", &folder]));
    assert!(
        human.contains("0.5133") && human.contains(&format!("02-smith-g2.toml:{line}:{column}")),
        "{human}"
    );
    let github = stdout(&run(&["check", &folder, "--format", "github"]));
    assert!(
        github.contains(&format!("line={line},col={column}")),
        "{github}"
    );
    let junit = stdout(&run(&["check", &folder, "--format", "junit"]));
    assert!(junit.contains("failures=\"1\""), "{junit}");
}

/// A lesson file with these bytes is told with its place; the other lesson still opens.
#[track_caller]
fn check_broken(bytes: &[u8], place: &str) {
    let home = tempfile::tempdir().expect("a folder");
    let copy = |name: &str| {
        fs::copy(common::lessons().join(name), home.path().join(name)).expect("writable");
    };
    copy("01-ggx-d.toml");
    fs::write(home.path().join("02-broken.toml"), bytes).expect("writable");
    let folder = home.path().display().to_string();
    let place = format!("02-broken.toml:{place}");

    let check = run(&["check", &folder]);
    assert_eq!(check.status.code(), Some(1), "{}", stderr(&check));
    assert!(stdout(&check).contains(&place), "{}", stdout(&check));
    for format in ["json", "github", "junit"] {
        let check = run(&["check", &folder, "--format", format]);
        assert_eq!(check.status.code(), Some(1), "{}", stderr(&check));
    }
    let list = run(&["list", "--json", "--lessons", &folder]);
    assert_eq!(list.status.code(), Some(0), "{}", stderr(&list));
    assert!(stderr(&list).contains(&place), "{}", stderr(&list));
    assert_eq!(json(&stdout(&list))[0]["id"], "ggx-d");
    let learn = run(&["learn", "broken", "--plain", "--lessons", &folder]);
    assert_eq!(learn.status.code(), Some(2));
    assert!(stderr(&learn).contains(&place), "{}", stderr(&learn));
}

#[test]
fn a_broken_lesson_closes_no_other() {
    check_broken(b"", "1:1");
    check_broken(b"format = 1\nid = \"x\xff\"\n", "2:8");
    check_broken(b"\xff\xfef\0o\0", "1:1");
    check_broken(b"format = 1\nid = \"x\n", "2:8");
    check_broken("[".repeat(100_000).as_bytes(), "1:");
    check_broken(b"format = 1\nid = \"\0\"\n", "2:7");
}

/// Findings of these lesson files: one alone, or several without the ones that they build on.
#[track_caller]
fn check_fine(files: &[&str]) {
    let paths: Vec<String> = files
        .iter()
        .map(|file| common::lessons().join(file).display().to_string())
        .collect();
    let args = ["check", "--format", "json"].into_iter();
    let args: Vec<&str> = args.chain(paths.iter().map(String::as_str)).collect();
    let output = run(&args);
    assert_eq!(stdout(&output), "", "{files:?}");
    assert_eq!(output.status.code(), Some(0), "{files:?}");
}

#[test]
fn lessons_are_checked_without_the_ones_they_build_on() {
    check_fine(&["02-smith-g2.toml"]);
    check_fine(&["02-smith-g2.toml", "02-smith-g2.toml"]);
    check_fine(&["02-smith-g2.toml", "03-schlick-fresnel.toml"]);

    // Lesson 1 is broken: lesson 2, which needs it, is not to blame.
    let home = tempfile::tempdir().expect("a folder");
    let second = "02-smith-g2.toml";
    fs::copy(common::lessons().join(second), home.path().join(second)).expect("writable");
    fs::write(home.path().join("01-ggx-d.toml"), "format = 1\nid = ?\n").expect("writable");
    let folder = home.path().display().to_string();
    for finding in json(&stdout(&run(&["check", &folder, "--format", "json"]))) {
        let file = finding["file"].as_str().expect("a file");
        assert!(file.ends_with("01-ggx-d.toml"), "{finding}");
    }
}

#[test]
fn without_any_lesson_nothing_is_taught() {
    let home = tempfile::tempdir().expect("a folder");
    fs::write(home.path().join("01-x.toml"), "").expect("writable");
    let folder = home.path().display().to_string();
    check_refused(
        &["render", "--lessons", &folder],
        &["01-x.toml:1:1", "--lessons"],
    );
}

#[test]
fn pictures_are_written() {
    let home = tempfile::tempdir().expect("a folder");
    let out = home.path().join("pictures");
    let args = [
        "render",
        "2",
        "--backend",
        "cpu",
        "--size",
        "64",
        "--json",
        "--out",
        &out.display().to_string(),
    ];
    let first = run_with(home.path(), &args, "");
    assert_eq!(first.status.code(), Some(0), "{}", stderr(&first));
    let lines = json(&stdout(&first));
    for line in &lines {
        for name in [
            "file",
            "lesson",
            "id",
            "backend",
            "adapter",
            "pixels_shaded",
            "pixels_skipped",
            "terms_evaluated",
            "terms_skipped",
            "cache_hit",
            "ms",
            "visibility",
        ] {
            assert!(line.get(name).is_some(), "{name} in {line}");
        }
        let bytes = fs::read(line["file"].as_str().expect("a path")).expect("a picture");
        assert!(
            bytes.starts_with(b"\x89PNG") || bytes.starts_with(b"<"),
            "{line}"
        );
    }
    assert!(lines.iter().any(|line| line["backend"] == "cpu"));
    assert!(lines.iter().any(|line| {
        line["file"]
            .as_str()
            .is_some_and(|file| file.ends_with(".svg"))
    }));
    let again = json(&stdout(&run_with(home.path(), &args, "")));
    assert!(again.iter().any(|line| line["cache_hit"] == true));
}

/// Bad usage ends with 2, one line, and what to do.
#[track_caller]
fn check_refused(args: &[&str], says: &[&str]) {
    let output = run(args);
    assert_eq!(
        output.status.code(),
        Some(2),
        "{args:?}: {}",
        stderr(&output)
    );
    assert_eq!(stdout(&output), "", "{args:?}");
    let complaint = stderr(&output);
    for word in says {
        assert!(
            complaint.contains(word),
            "{args:?}: {word:?} in {complaint}"
        );
    }
}

#[test]
fn bad_usage_says_what_to_do() {
    check_refused(
        &["learn", "smth-g2"],
        &["smth-g2", "did you mean `smith-g2`"],
    );
    check_refused(&["learn", "99"], &["99", "lobe list"]);
    check_refused(&["exercise", "smith-g2/w"], &["smith-g2/w"]);
    check_refused(
        &["mark", "smith-g2/v", "--answer", "1", "--step", "nonsense"],
        &["nonsense"],
    );
    check_refused(
        &["mark", "smith-g2/v", "--answer", "1", "--earlier", "alpha"],
        &["NAME=TEXT"],
    );
    check_refused(
        &[
            "mark",
            "smith-g2/v",
            "--answer",
            "1",
            "--earlier",
            "alpha=nonsense",
        ],
        &["--earlier alpha=nonsense"],
    );
    check_refused(&["judge", "smith-g2/explain-9"], &["smith-g2/explain"]);
    check_refused(
        &["check", "no/such/file.toml"],
        &["no/such/file.toml", "No such file"],
    );
    check_refused(&["eval", "--batch", "no/such/file"], &["no/such/file"]);
    check_refused(
        &["list", "--lessons", "no/such/folder"],
        &["no/such/folder"],
    );
    check_refused(&["render", "nothing"], &["nothing"]);
    check_refused(&["evla"], &["eval"]);
    for args in [
        &["mark", "--json"][..],
        &["eval"],
        &["render", "--size", "3"],
    ] {
        let complaint = stderr(&run(args));
        assert_eq!(complaint.lines().count(), 1, "{args:?}: {complaint}");
    }
}

#[test]
fn the_record_and_the_transcript_tell_what_was_answered() {
    let home = tempfile::tempdir().expect("a folder");
    let folder = home.path().join("p").display().to_string();
    let skips = ":skip\n".repeat(3);
    let learn = [
        "learn",
        "smith-g2",
        "--plain",
        "--seed",
        "7",
        "--progress",
        &folder,
    ];
    let text = stdout(&run_with(
        home.path(),
        &learn,
        &format!("{skips}0.123456\n"),
    ));
    assert!(text.contains("0.123456"), "{text}");
    let progress = run_with(
        home.path(),
        &["progress", "--progress", &folder, "--json"],
        "",
    );
    let session = &json(&stdout(&progress))[0];
    assert_eq!(session["lesson"], "smith-g2");
    assert_eq!(session["seed"], 7);
    assert_eq!(session["answers"][0]["text"], "0.123456");
    let transcript = stdout(&run_with(
        home.path(),
        &["transcript", "2", "--progress", &folder],
        "",
    ));
    assert!(
        transcript.starts_with("# ") && transcript.contains("0.123456"),
        "{transcript}"
    );
    let list = json(&stdout(&run_with(
        home.path(),
        &["list", "--progress", &folder, "--json"],
        "",
    )));
    assert!(
        list[1]["state"]
            .as_str()
            .is_some_and(|state| state.starts_with("in progress")),
        "{list:?}"
    );
}

#[test]
fn a_copied_program_teaches() {
    let home = tempfile::tempdir().expect("a folder");
    let copy = home.path().join("lobe");
    fs::copy(common::LOBE, &copy).expect("copied");
    let output = std::process::Command::new(copy)
        .args(["list", "--json"])
        .current_dir(home.path())
        .env_clear()
        .env("HOME", home.path())
        .output()
        .expect("the program starts");
    assert!(json(&stdout(&output)).len() >= 2);
}
