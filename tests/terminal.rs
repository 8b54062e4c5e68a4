//! The screen: any size, given back whatever happens.

mod common;

use std::fs;

use common::{Terminal, signal};

fn learn(home: &std::path::Path, size: (u16, u16)) -> Terminal {
    let folder = home.join("p").display().to_string();
    Terminal::start(
        home,
        size,
        &["learn", "smith-g2", "--seed", "7", "--progress", &folder],
    )
}

#[test]
fn the_list_opens_a_lesson_and_comes_back() {
    let home = tempfile::tempdir().expect("a folder");
    let folder = home.path().join("p").display().to_string();
    let mut terminal = Terminal::start(home.path(), (80, 24), &["--progress", &folder]);
    terminal.wait_for("q quit");
    terminal.wait_for("Smith G2");
    terminal.send("j\r");
    terminal.wait_for("Enter on");
    terminal.send("?");
    terminal.wait_for("Esc closes");
    terminal.send("\u{1b}");
    terminal.wait_until("the help to close", |screen| !screen.contains("Esc closes"));
    terminal.send("\r");
    terminal.wait_for("✓ saved");
    terminal.send("q");
    terminal.wait_for("in progress");
    terminal.send("q");
    assert_eq!(terminal.wait(), 0);
}

#[test]
fn every_size_is_drawn() {
    for size in [(200, 60), (80, 24), (40, 12), (20, 5), (1, 1)] {
        let home = tempfile::tempdir().expect("a folder");
        let mut terminal = learn(home.path(), size);
        if size.0 >= 80 {
            terminal.wait_for("Smith G2");
        } else if size.0 >= 40 {
            // No row is spared for a title.
            terminal.wait_for("Why this matters");
        } else if size.0 >= 20 {
            terminal.wait_for("lobe needs");
        }
        terminal.send("\r\r\r");
        terminal.resize(20, 5);
        terminal.wait_for("lobe needs");
        terminal.resize(100, 30);
        terminal.wait_for("Smith G2");
        terminal.send("q");
        assert_eq!(terminal.wait(), 0, "{size:?}");
    }
}

#[test]
fn signals_save_and_give_the_terminal_back() {
    for name in ["TERM", "INT", "HUP"] {
        let home = tempfile::tempdir().expect("a folder");
        let mut terminal = learn(home.path(), (80, 24));
        terminal.wait_for("Enter on");
        assert!(terminal.modes().0, "the alternate screen");
        terminal.send("\r");
        terminal.wait_for("✓ saved");
        signal(terminal.process(), name);
        terminal.wait();
        assert_eq!(
            terminal.modes(),
            (false, false),
            "{name}: the screen is back, the cursor shows"
        );
        assert!(
            terminal.raw().contains("\u{1b}[?2004l"),
            "{name}: pasting is as it was"
        );
    }
}

#[cfg(debug_assertions)]
#[test]
fn a_panic_gives_the_terminal_back_before_it_is_told() {
    let home = tempfile::tempdir().expect("a folder");
    let args = ["learn", "smith-g2"];
    let mut terminal =
        Terminal::start_with(home.path(), (80, 24), &args, &[("LOBE_TEST_PANIC", "1")]);
    terminal.wait();
    assert_eq!(terminal.modes(), (false, false));
    let raw = terminal.raw();
    let back = raw
        .rfind("\u{1b}[?1049l")
        .expect("the screen is given back");
    let told = raw.find("panicked").expect("it is told");
    assert!(back < told, "{raw}");
}

#[test]
fn no_color_leaves_no_colour() {
    let home = tempfile::tempdir().expect("a folder");
    let folder = home.path().join("p").display().to_string();
    let args = ["learn", "smith-g2", "--progress", &folder];
    let mut terminal = Terminal::start_with(home.path(), (80, 24), &args, &[("NO_COLOR", "1")]);
    terminal.wait_for("Enter on");
    terminal.send("\r");
    terminal.wait_for("✓ saved");
    terminal.send("q");
    terminal.wait();
    let raw = terminal.raw();
    let coloured = (30..=37)
        .chain(90..=97)
        .any(|code| raw.contains(&format!("\u{1b}[{code}m")) || raw.contains(&format!(";{code}m")));
    assert!(!coloured && !raw.contains("[38;"), "{raw:?}");
}

#[test]
fn a_picture_appears_and_the_learner_moves_on() {
    let home = tempfile::tempdir().expect("a folder");
    let mut terminal = learn(home.path(), (200, 100));
    terminal.wait_for("Enter on");
    let heading = |screen: &str| screen.lines().nth(1).map(str::to_owned);
    // The heading, not the screen: "saved" changes it too, and a frame may be half there.
    while !terminal.text().contains("Where it shows") {
        let here = heading(&terminal.text());
        terminal.send("G\r");
        terminal.wait_until("another page", |screen| heading(screen) != here);
    }
    terminal.wait_for("log2 of the ratio");
    // Half-blocks: what every terminal has.
    terminal.wait_for("▀▀▀▀");
    let here = heading(&terminal.text());
    terminal.send("G\r");
    terminal.wait_until("the next screen", |screen| heading(screen) != here);
    terminal.send("\u{3}");
    assert_eq!(terminal.wait(), 0);
}

/// The row of the screen below the first that contains `text`.
fn below<'a>(screen: &'a str, text: &str) -> Option<&'a str> {
    let mut lines = screen.lines().skip_while(|line| !line.contains(text));
    lines.next().and(lines.next())
}

#[test]
fn a_map_is_drawn_with_its_axes() {
    for (no_colours, signs, key) in [
        ("", "▀▀▀▀▀▀▀▀", "orange: above 1"),
        ("1", "++++====", "+ above 1"),
    ] {
        let home = tempfile::tempdir().expect("a folder");
        let folder = home.path().join("p").display().to_string();
        let args = ["learn", "smith-g2", "--seed", "7", "--progress", &folder];
        let more = [("LOBE_PICTURES", "halfblocks"), ("NO_COLOR", no_colours)];
        let mut terminal = Terminal::start_with(home.path(), (200, 120), &args, &more);
        terminal.wait_for("Enter on");
        let heading = |screen: &str| screen.lines().nth(1).map(str::to_owned);
        while !terminal.text().contains("Where it hides") {
            let here = heading(&terminal.text());
            terminal.send("G\r");
            terminal.wait_until("another page", |screen| heading(screen) != here);
        }
        terminal.wait_until("the map", |screen| {
            below(screen, "White furnace, divided twice").is_some_and(|row| row.contains(signs))
        });
        terminal.wait_for("0.01 → 1: N·V · 0.05 ↑ 1: roughness");
        terminal.wait_for(key);
        terminal.send("\u{3}");
        assert_eq!(terminal.wait(), 0);
    }
}

#[test]
fn what_cannot_be_saved_is_kept_and_said_and_saved_later() {
    let home = tempfile::tempdir().expect("a folder");
    let blocked = home.path().join("p");
    fs::write(&blocked, "a file where the folder should be").expect("writable");
    let mut terminal = learn(home.path(), (80, 24));
    terminal.wait_for("cannot be saved");
    terminal.send("\r");
    terminal.wait_for("✗ not saved");
    terminal.send("q");
    terminal.wait_for("q again leaves");
    terminal.send("x");
    fs::remove_file(&blocked).expect("ours");
    terminal.wait_for("✓ saved");
    assert!(blocked.is_dir());
    terminal.send("q");
    assert_eq!(terminal.wait(), 0);
}

#[test]
fn a_broken_lesson_is_named_and_the_others_open() {
    let home = tempfile::tempdir().expect("a folder");
    let lessons = home.path().join("lessons");
    fs::create_dir(&lessons).expect("writable");
    for file in ["01-ggx-d.toml", "02-smith-g2.toml"] {
        fs::copy(common::lessons().join(file), lessons.join(file)).expect("writable");
    }
    fs::write(
        lessons.join("03-broken.toml"),
        "format = 1\nid = \"broken\"\ntitle = \n",
    )
    .expect("writable");
    let lessons = lessons.display().to_string();
    let folder = home.path().join("p").display().to_string();
    let args = ["--lessons", &lessons, "--progress", &folder];
    let mut terminal = Terminal::start(home.path(), (160, 40), &args);
    terminal.wait_for("03-broken.toml:3:");
    terminal.send("\r");
    terminal.wait_for("Enter on");
    terminal.send("\u{3}");
    assert_eq!(terminal.wait(), 0);
}

/// Skips to the first explanation, in plain text, and leaves.
fn go_to_explanation(home: &std::path::Path) {
    let folder = home.join("p").display().to_string();
    let args = [
        "learn",
        "smith-g2",
        "--plain",
        "--seed",
        "7",
        "--progress",
        &folder,
    ];
    for _ in 0..60 {
        let text = common::stdout(&common::run_with(home, &args, ":skip\n"));
        if text.contains("a line of one `.` hands it in") {
            return;
        }
    }
    panic!("no explanation is asked for");
}

#[test]
fn a_text_half_written_survives_a_power_cut() {
    let home = tempfile::tempdir().expect("a folder");
    go_to_explanation(home.path());
    let mut terminal = learn(home.path(), (80, 24));
    terminal.wait_for("Hand in");
    // Letters that are commands elsewhere are text here.
    terminal.send("q? the middle is\rtoo dark");
    terminal.wait_for("too dark");
    // The log itself, not the file that will take its place.
    let log = || {
        fs::read_dir(home.path().join("p"))
            .ok()?
            .filter_map(|entry| Some(entry.ok()?.path()))
            .filter(|path| {
                path.extension()
                    .is_some_and(|extension| extension == "toml")
            })
            .filter_map(|path| fs::read_to_string(path).ok())
            .find(|text| text.contains("too dark"))
    };
    common::wait_for("the draft in the log", log);
    terminal.kill();
    let mut terminal = learn(home.path(), (80, 24));
    terminal.wait_for("q? the middle is");
    terminal.wait_for("too dark");
    terminal.send("\u{3}");
    assert_eq!(terminal.wait(), 0);
}

#[test]
fn a_lesson_open_elsewhere_is_not_written_twice() {
    let home = tempfile::tempdir().expect("a folder");
    let mut first = learn(home.path(), (80, 24));
    first.wait_for("Enter on");
    first.send("\r");
    first.wait_for("✓ saved");
    let mut second = learn(home.path(), (80, 24));
    second.wait_for("open in another window");
    second.send("\r");
    second.wait_for("✓ saved");
    for terminal in [&mut first, &mut second] {
        terminal.send("q");
        assert_eq!(terminal.wait(), 0);
    }
    let logs = fs::read_dir(home.path().join("p"))
        .expect("a folder")
        .count();
    assert_eq!(logs, 2);
}

/// Leaves out everything up to the first number that is asked for, in plain text, and leaves.
fn go_to_exercise(home: &std::path::Path) {
    let folder = home.join("p").display().to_string();
    let args = ["learn", "smith-g2", "--plain", "--seed", "7", "--progress"];
    let args = [&args[..], &[&folder]].concat();
    let text = common::stdout(&common::run_with(home, &args, &":skip\n".repeat(4)));
    assert!(text.contains("## Exercises 2 of"), "{text}");
}

/// The footer.
fn last_line(screen: &str) -> &str {
    screen.lines().last().unwrap_or_default()
}

#[test]
fn the_footer_says_what_the_keys_do_here() {
    let home = tempfile::tempdir().expect("a folder");
    let mut terminal = learn(home.path(), (80, 24));
    terminal.wait_for("Enter on");
    assert!(!terminal.text().contains("skip"), "{}", terminal.text());
    terminal.send("\u{3}");
    terminal.wait();
    go_to_exercise(home.path());
    let mut terminal = learn(home.path(), (80, 24));
    terminal.wait_for("Ctrl-G skip this exercise");
    terminal.send("0.5");
    terminal.wait_for("Enter answer");
    terminal.send("\u{7f}\u{7f}\u{7f}\u{14}");
    terminal.wait_for("Ctrl-T second hint");
    // The answer is shown, and left as it is.
    terminal.send("\u{14}\u{14}\r");
    terminal.wait_for("Left as it is.");
    terminal.wait_for("Enter on");
    let footer = last_line(&terminal.text()).to_owned();
    assert!(!footer.contains("skip"), "{footer}");
    terminal.send("\r");
    terminal.wait_for("Exercises 3/");
    // One key from within a field, and a way back.
    terminal.send("\u{7}");
    terminal.wait_for("Exercises 4/");
    terminal.send("\u{3}");
    assert_eq!(terminal.wait(), 0);
}

#[test]
fn keys_typed_while_the_terminal_is_asked_are_not_lost() {
    let home = tempfile::tempdir().expect("a folder");
    let mut terminal = learn(home.path(), (80, 24));
    // No frame waits for the answer; a learner does not wait either.
    terminal.wait_for("Enter on");
    let heading = |screen: &str| screen.lines().nth(1).map(str::to_owned);
    while !terminal.text().contains("Where it shows") {
        let here = heading(&terminal.text());
        terminal.send("G\r");
        terminal.wait_until("another page", |screen| heading(screen) != here);
    }
    common::wait_for("the question", || {
        terminal.raw().contains("\u{1b}[16t").then_some(())
    });
    terminal.send("G\u{1b}[6;18;9t\r\u{1b}[?62;22c");
    terminal.wait_until("the next page", |screen| !screen.contains("Where it shows"));
    terminal.send("\u{3}");
    assert_eq!(terminal.wait(), 0);
}

#[test]
fn a_number_half_typed_survives_a_power_cut() {
    let home = tempfile::tempdir().expect("a folder");
    go_to_exercise(home.path());
    let mut terminal = learn(home.path(), (80, 24));
    terminal.wait_for("Ctrl-G skip this exercise");
    terminal.send("0.4^2/");
    let log = || {
        fs::read_dir(home.path().join("p"))
            .ok()?
            .filter_map(|entry| Some(entry.ok()?.path()))
            .filter(|path| path.extension().is_some_and(|it| it == "toml"))
            .filter_map(|path| fs::read_to_string(path).ok())
            .find(|text| text.contains("0.4^2/"))
    };
    common::wait_for("the draft in the log", log);
    terminal.send("pi");
    terminal.wait_for("0.4^2/pi");
    terminal.kill();
    let text = {
        let folder = home.path().join("p").display().to_string();
        let args = ["learn", "smith-g2", "--plain", "--progress", &folder];
        common::stdout(&common::run_with(home.path(), &args, ""))
    };
    assert!(text.contains("You had begun to write:\n| 0.4^2/"), "{text}");
    let mut terminal = learn(home.path(), (80, 24));
    terminal.wait_for("0.4^2/");
    terminal.send("2");
    terminal.wait_for("0.4^2/2");
    terminal.send("\u{3}");
    assert_eq!(terminal.wait(), 0);
}

#[test]
fn a_low_terminal_shows_what_is_asked_and_where_it_is_answered() {
    // A choice, a number, a shader, a place, an explanation.
    for (skips, asked, field) in [
        (3, "lines is wrong", "┏ Which one?"),
        (4, "How large is the G2", "┏ G2 "),
        (6, "This came over", "┏ fn specular"),
        (13, "A rough metal ball", "┏ The buggy ball"),
        (14, "let specular", "┏ In your own words"),
    ] {
        let home = tempfile::tempdir().expect("a folder");
        let folder = home.path().join("p").display().to_string();
        let args = [
            "learn",
            "smith-g2",
            "--plain",
            "--seed",
            "7",
            "--progress",
            &folder,
        ];
        common::run_with(home.path(), &args, &":skip\n".repeat(skips));
        let mut terminal = learn(home.path(), (40, 12));
        terminal.wait_until("question and field", |screen| {
            screen.contains(asked) && screen.contains(field) && screen.contains('┗')
        });
        // Out of the field the page gets the rows.
        terminal.send("\u{1b}");
        terminal.wait_until("more of the page", |screen| {
            let rows = screen.lines().skip(1);
            rows.take_while(|row| !row.contains('╭')).count() >= 4 && screen.contains('╭')
        });
        terminal.send("\u{3}");
        assert_eq!(terminal.wait(), 0);
    }
}

#[test]
fn the_mark_under_a_shaders_error_is_in_view() {
    for size in [(80, 24), (40, 12)] {
        let home = tempfile::tempdir().expect("a folder");
        let folder = home.path().join("p").display().to_string();
        let args = [
            "learn",
            "smith-g2",
            "--plain",
            "--seed",
            "7",
            "--progress",
            &folder,
        ];
        common::run_with(home.path(), &args, &":skip\n".repeat(6));
        let mut terminal = learn(home.path(), size);
        terminal.wait_for("┏ fn specular");
        // A word too many behind the seventh line.
        terminal.send("\u{1b}[B\u{1b}[B\u{1b}[B\u{1b}[B\u{1b}[B\u{1b}[B\u{5}x y\u{13}");
        terminal.wait_until("the error and its mark", |screen| {
            screen.contains("Line 7") && screen.lines().any(|row| row.trim() == "^")
        });
        terminal.send("\u{3}");
        assert_eq!(terminal.wait(), 0);
    }
}
