//! A shader to be mended, as a learner meets it: marked, on the screen, as plain text; and texts
//! that want to end the tutor.

mod common;

use std::fs;
use std::path::Path;
use std::process::Output;

use common::{Terminal, run_with, stderr, stdout};
use serde_json::Value;
use tutor::record::Record;
use tutor::session::Event;

const ITEM: &str = "ggx-d/mend";

/// A body in place of the function's.
fn d(body: &str) -> String {
    format!("fn d(n_dot_h: f32, roughness: f32) -> f32 {{\n{body}\n}}\n")
}

const RIGHT: &str = "    let a = roughness * roughness;
    let a2 = a * a;
    let b = n_dot_h * n_dot_h * (a2 - 1.0) + 1.0;
    return a2 / (3.14159265 * b * b);";

fn mark(item: &str, bytes: &[u8]) -> Output {
    let home = tempfile::tempdir().expect("a folder");
    let file = home.path().join("d.wgsl");
    fs::write(&file, bytes).expect("a file");
    let answer = format!("@{}", file.display());
    run_with(
        home.path(),
        &["mark", item, "--answer", &answer, "--json"],
        "",
    )
}

#[track_caller]
fn check_bytes(bytes: &[u8], result: &str, mistake: Option<&str>, says: &str) {
    check_item(ITEM, bytes, result, mistake, says);
}

#[track_caller]
fn check_item(item: &str, bytes: &[u8], result: &str, mistake: Option<&str>, says: &str) {
    let output = mark(item, bytes);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let marked: Value = serde_json::from_str(&stdout(&output)).expect("JSON");
    let said = marked["says"].as_str().expect("a sentence");
    let shown = String::from_utf8_lossy(&bytes[..bytes.len().min(200)]);
    assert_eq!(
        (marked["result"].as_str(), marked["mistake"].as_str()),
        (Some(result), mistake),
        "{shown}\n{said}"
    );
    assert!(said.contains(says), "{said:?} does not say {says:?}");
}

#[track_caller]
fn check(source: &str, result: &str, mistake: Option<&str>, says: &str) {
    check_bytes(source.as_bytes(), result, mistake, says);
}

#[test]
fn a_shader_is_marked_by_what_it_computes() {
    check(&d(RIGHT), "correct", None, "Correct.");
    // However it is written.
    let other = "    let t = n_dot_h * roughness * roughness;
    let k = pow(roughness, 2.0) / (1.0 - n_dot_h * n_dot_h + t * t);
    return k * k / acos(-1.0);";
    check(&d(other), "correct", None, "Correct.");
    let slider = RIGHT.replace("roughness * roughness", "roughness");
    check(
        &d(&slider),
        "mistake",
        Some("square-forgotten"),
        "the slider taken for α",
    );
    let tails = RIGHT.replace("b * b", "b");
    check(
        &d(&tails),
        "mistake",
        Some("bracket-not-squared"),
        "It is right at",
    );
    let four = RIGHT.replace("a2 / (", "4.0 * a2 / (");
    check(&d(&four), "wrong", None, "off by a factor 4 everywhere");
    check(&d("    return 0.5;"), "wrong", None, "it should give");
    let typo = RIGHT.replace("b * b", "b * bb");
    check(
        &d(&typo),
        "invalid",
        None,
        "Line 5, column 35: `bb` is not defined here.",
    );
}

#[test]
fn whatever_is_right_between_directions_is_right() {
    // F's cosine, as a body of `specular` has it.
    let rows = [
        ("sqrt(0.5 + 0.5 * l_dot_v)", "correct", None),
        (
            "(1.0 + l_dot_v) / sqrt(2.0 + 2.0 * l_dot_v)",
            "correct",
            None,
        ),
        ("cos(acos(l_dot_v) / 2.0)", "correct", None),
        ("(n_dot_l + n_dot_v) / (2.0 * n_dot_h)", "correct", None),
        ("n_dot_v", "mistake", Some("n-dot-v")),
        ("l_dot_v", "mistake", Some("half-angle-forgotten")),
        ("1.0 + l_dot_v", "mistake", Some("length-forgotten")),
    ];
    for (cosine, result, mistake) in rows {
        let source = format!(
            "fn specular(n_dot_l: f32, n_dot_v: f32, n_dot_h: f32, l_dot_v: f32,
            roughness: f32, f0: f32) -> f32 {{
    let alpha = roughness * roughness;
    let f = f_schlick(f0, {cosine});
    return d_ggx(n_dot_h, alpha) * v_ggx(n_dot_l, n_dot_v, alpha) * f * n_dot_l;
}}
"
        );
        check_item(
            "schlick-fresnel/mend",
            source.as_bytes(),
            result,
            mistake,
            "",
        );
    }
}

#[test]
fn a_text_that_wants_to_end_the_tutor_is_marked() {
    let endless = "    loop { if roughness > 2.0 { break; } }\n    return 1.0;";
    check(
        &d(endless),
        "wrong",
        None,
        "had not returned after 500,000 steps",
    );
    check(
        &d("    return 1.0 / (n_dot_h - n_dot_h);"),
        "wrong",
        None,
        "is infinite",
    );
    check(
        &d("    return sqrt(-n_dot_h);"),
        "wrong",
        None,
        "is not a number (NaN",
    );
    let parens = format!(
        "    return {}1.0{};",
        "(".repeat(10_000),
        ")".repeat(10_000)
    );
    check(&d(&parens), "invalid", None, "nested too deep");
    // Read without complaint, and too much for whoever reads on.
    let sum = format!("    return {}1.0;", "n_dot_h + ".repeat(6_000));
    let output = mark(ITEM, d(&sum).as_bytes());
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let array = "    var a: array<f32, 100000000>;\n    return a[3];";
    check(&d(array), "invalid", None, "100,000,000 numbers");
    let mut bomb = "fn c0(x: f32) -> f32 { return x; }\n".to_owned();
    for at in 1..60 {
        let before = at - 1;
        bomb += &format!("fn c{at}(x: f32) -> f32 {{ return c{before}(x) + c{before}(x); }}\n");
    }
    let bomb = format!("{bomb}{}", d("    return c59(n_dot_h);"));
    check(&bomb, "wrong", None, "had not returned after");
    check(
        &d("    return d(n_dot_h, roughness);"),
        "invalid",
        None,
        "no recursion",
    );
    check("", "invalid", None, "There is no text.");
    check("fn e() {}", "invalid", None, "There is no function `d`");
    check(
        "fn d(n_dot_h: f32) -> f32 { return 1.0; }",
        "invalid",
        None,
        "takes one number here",
    );
    let vector = d("    return vec2f(1.0);").replace("-> f32", "-> vec2f");
    check(&vector, "invalid", None, "does not return an f32");
    check(
        &" ".repeat(1 << 20),
        "invalid",
        None,
        "at most 65,536 are read",
    );
    check_bytes(b"fn d\xff\xfe", "invalid", None, "not UTF-8");
    check(
        "\0\u{1b}[2J",
        "invalid",
        None,
        "cannot stand outside of a function",
    );
}

#[test]
fn what_runs_too_long_is_ended_by_the_clock() {
    let slow = "    var s = 0.0;
    for (var i = 0; i < 15000; i++) { s += 1e-30; }
    return s;";
    let output = mark(ITEM, d(slow).as_bytes());
    let marked: Value = serde_json::from_str(&stdout(&output)).expect("JSON");
    let said = marked["says"].as_str().expect("a sentence");
    // Which limit it meets first depends on the machine.
    let known = ["after 5 seconds", "too many steps", "it should give"];
    assert!(known.iter().any(|words| said.contains(words)), "{said}");
    assert_eq!(marked["result"], "wrong");
}

#[test]
fn the_hidden_command_is_for_the_program_itself() {
    let home = tempfile::tempdir().expect("a folder");
    let output = run_with(home.path(), &["run-shader"], "hello");
    assert_eq!(output.status.code(), Some(2));
    assert!(
        stderr(&output).contains("for the program itself"),
        "{}",
        stderr(&output)
    );
    let help = stdout(&run_with(home.path(), &["--help"], ""));
    assert!(!help.contains("run-shader"), "{help}");
}

/// The lesson's exercise as a lesson of its own, so that it is reached at once.
fn lesson(folder: &Path, source: &str) {
    let text = fs::read_to_string(common::lessons().join("01-ggx-d.toml")).expect("a lesson");
    let start = text
        .find("[[exercise]]\nid = \"ggx-d/mend\"")
        .expect("the exercise");
    let end = start + text[start..].find("# --- ").expect("its end");
    let mut exercise = text[start..end].replace("ggx-d/mend", "one/mend");
    if !source.is_empty() {
        exercise = exercise.replacen("let alpha = roughness;", source, 1);
    }
    let head = "format = 1\nid = \"one\"\ntitle = \"One\"\nsummary = \"One.\"\nminutes = 1\nwhy = \"So.\"\nmodel = \"So.\"\n\n";
    fs::create_dir_all(folder).expect("a folder");
    fs::write(folder.join("01-one.toml"), format!("{head}{exercise}")).expect("a file");
}

#[track_caller]
fn check_lesson(source: &str, code: &str, says: &str) {
    let home = tempfile::tempdir().expect("a folder");
    let lessons = home.path().join("lessons");
    lesson(&lessons, source);
    let folder = lessons.display().to_string();
    let output = run_with(home.path(), &["check", &folder, "--format", "json"], "");
    let findings = stdout(&output);
    let about: Vec<Value> = findings
        .lines()
        .map(|line| serde_json::from_str::<Value>(line).expect("JSON"))
        .filter(|finding| {
            finding["code"]
                .as_str()
                .is_some_and(|it| it.starts_with("shader"))
        })
        .collect();
    match about.as_slice() {
        [] => assert!(code.is_empty(), "nothing is found: {findings}"),
        [finding] => {
            assert_eq!(finding["code"], code, "{findings}");
            assert!(
                finding["message"]
                    .as_str()
                    .is_some_and(|it| it.contains(says)),
                "{findings}"
            );
            assert!(
                finding["line"].as_u64().is_some_and(|line| line > 10),
                "{findings}"
            );
        }
        _ => panic!("{findings}"),
    }
}

#[test]
fn a_lessons_shaders_are_run_when_it_is_checked() {
    check_lesson("", "", "");
    check_lesson(
        "let alpha = rougness;",
        "shader-refused",
        "`rougness` is not defined here",
    );
    let right = "let alpha = roughness * roughness;";
    check_lesson(right, "shader-differs", "has no bug");
    check_lesson(
        "let alpha = roughness * 0.5;",
        "shader-unnamed",
        "no mistake with a name",
    );
    let endless = "var alpha = roughness; loop { if alpha > 2.0 { break; } }";
    check_lesson(endless, "shader-stopped", "does not return");
}

struct Learner {
    home: tempfile::TempDir,
}

impl Learner {
    fn new() -> Self {
        let home = tempfile::tempdir().expect("a folder");
        lesson(&home.path().join("lessons"), "");
        Self { home }
    }

    fn arguments(&self) -> Vec<String> {
        let path = |name: &str| self.home.path().join(name).display().to_string();
        let words = ["learn", "one", "--seed", "7"].map(str::to_owned);
        let folders = [
            "--lessons".into(),
            path("lessons"),
            "--progress".into(),
            path("progress"),
        ];
        words.into_iter().chain(folders).collect()
    }

    fn plain(&self, script: &str) -> String {
        let mut arguments = self.arguments();
        arguments.push("--plain".to_owned());
        let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
        let output = run_with(self.home.path(), &arguments, script);
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        stdout(&output)
    }

    fn terminal(&self, size: (u16, u16), editor: &str) -> Terminal {
        let arguments = self.arguments();
        let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
        Terminal::start_with(
            self.home.path(),
            size,
            &arguments,
            &[("EDITOR", editor), ("LOBE_PICTURES", "halfblocks")],
        )
    }

    /// Result and mistake of every attempt in the log.
    fn attempts(&self) -> Vec<(String, Option<String>)> {
        let folder = fs::read_dir(self.home.path().join("progress")).expect("a folder");
        let logs = folder.map(|entry| entry.expect("an entry").path());
        let logs = logs.filter(|path| path.extension().is_some_and(|it| it == "toml"));
        let events = logs.flat_map(|path| {
            let text = fs::read_to_string(path).expect("a log");
            Record::from_toml(&text).expect("a log").events()
        });
        events
            .filter_map(|event| match event {
                Event::Attempt {
                    result, mistake, ..
                } => Some((result, mistake)),
                _ => None,
            })
            .collect()
    }
}

#[test]
fn a_shader_is_mended_as_plain_text() {
    let learner = Learner::new();
    let typed = d(&RIGHT.replace("roughness * roughness", "roughness"));
    let script = format!(
        "\n.\n:2     let alpha = rougness * roughness;\n.\n:99 x\n{typed}.\n:2 let a = roughness * roughness;\n:show\n.\n\n"
    );
    let text = learner.plain(&script);
    // The shader as it is, with the numbers of its lines.
    assert!(
        text.contains("     2 |     let alpha = roughness;"),
        "{text}"
    );
    assert!(
        text.contains("✗ A known mistake. This is D with the slider taken for α."),
        "{text}"
    );
    assert!(
        text.contains("Picture: The ball that your function draws"),
        "{text}"
    );
    assert!(text.contains("yours"), "{text}");
    assert!(
        text.contains("! Not counted. Line 2, column 17: rougness is not defined here."),
        "{text}"
    );
    assert!(
        text.contains("    2 |     let alpha = rougness * roughness;"),
        "{text}"
    );
    assert!(text.contains("! :7 TEXT changes line 7"), "{text}");
    assert!(
        text.contains("+     let a = roughness * roughness;"),
        "{text}"
    );
    assert!(
        text.contains("✓ Correct. One square, and nothing"),
        "{text}"
    );
    let results: Vec<String> = learner.attempts().into_iter().map(|it| it.0).collect();
    assert_eq!(results, ["mistake", "invalid", "mistake", "correct"]);
}

#[test]
fn a_shader_is_mended_on_the_screen_and_found_again_after_a_power_cut() {
    let learner = Learner::new();
    let mended = learner.home.path().join("mended.wgsl");
    fs::write(&mended, d(RIGHT)).expect("a file");
    let editor = format!("cp {}", mended.display());
    let mut terminal = learner.terminal((80, 24), &editor);
    terminal.wait_for("Why this matters");
    terminal.send("G\r");
    terminal.wait_for("let alpha = roughness;");
    terminal.send("\x13");
    terminal.wait_for("A known mistake");
    terminal.wait_for("✓ saved");
    assert_eq!(
        learner.attempts(),
        [("mistake".to_owned(), Some("square-forgotten".to_owned()))]
    );
    // The ball has the room now; the field is one Tab away.
    terminal.wait_for("Tab to the field");
    terminal.send("\t");
    // In place: down to line 2, to its end, one letter away: the name is another one.
    terminal.send("\x1b[B\x1b[F\x7f\x7f;\x13");
    terminal.wait_for("roughnes is not defined here. Did you mean");
    common::wait_for("the log", || (learner.attempts().len() == 2).then_some(()));
    terminal.kill();

    let mut terminal = learner.terminal((200, 60), &editor);
    terminal.wait_for("let alpha = roughnes;");
    terminal.wait_for("A known mistake");
    // In the learner's own editor.
    terminal.send("\x0f");
    terminal.wait_for("let a = roughness * roughness;");
    terminal.send("\x13");
    terminal.wait_for("✓ Correct");
    terminal.wait_for("The ball that your function draws");
    common::wait_for("the log", || (learner.attempts().len() == 3).then_some(()));
    assert_eq!(learner.attempts()[2], ("correct".to_owned(), None));
    terminal.send("q");
    terminal.wait_for("Saved.");
    assert_eq!(terminal.wait(), 0);
}
