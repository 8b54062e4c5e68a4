//! A picture under the arrow keys: opened, turned, left; and its numbers without a screen.

mod common;

use common::{Terminal, run, stderr, stdout};

#[test]
fn a_picture_is_turned_and_its_figures_follow() {
    let home = tempfile::tempdir().expect("a folder");
    let args = ["play", "smith-g2", "double-division"];
    let mut terminal = Terminal::start(home.path(), (80, 24), &args);
    terminal.wait_for("▸roughness 0.7");
    // The last of a frame.
    terminal.wait_for("Esc back");
    let figures = |screen: &str| -> Vec<String> {
        let lines = screen.lines().map(str::trim);
        let of = lines.filter(|line| line.starts_with("rim / highlight"));
        of.map(str::to_owned).collect()
    };
    let before = figures(&terminal.text());
    assert_eq!(before.len(), 1, "{}", terminal.text());
    // Smoother by a big step and a small one.
    terminal.send("\u{1b}[6~\u{1b}[D");
    terminal.wait_for("▸roughness 0.59");
    terminal.wait_until("other figures", |screen| figures(screen) != before);
    terminal.send("\u{1b}[B\u{1b}[C");
    terminal.wait_for("▸light 61°");
    terminal.send("r");
    terminal.wait_for("▸light 60°");
    terminal.wait_until("the lesson's figures", |screen| figures(screen) == before);
    terminal.resize(200, 60);
    terminal.wait_until("a larger picture", |screen| {
        screen.matches('▀').count() > 1000
    });
    terminal.send("\u{1b}");
    assert_eq!(terminal.wait(), 0);
}

/// The screen once nothing comes any more: a frame may arrive in parts.
fn settled(terminal: &Terminal) -> String {
    let mut before = terminal.text();
    loop {
        std::thread::sleep(std::time::Duration::from_millis(300));
        let now = terminal.text();
        if now == before {
            return now;
        }
        before = now;
    }
}

#[test]
fn leaving_leads_back_to_the_very_page() {
    let home = tempfile::tempdir().expect("a folder");
    let folder = home.path().join("p").display().to_string();
    let args = ["learn", "smith-g2", "--seed", "7", "--progress", &folder];
    // Keys that come while a terminal is asked what it can show are lost.
    let more = [("LOBE_PICTURES", "halfblocks")];
    let mut terminal = Terminal::start_with(home.path(), (200, 100), &args, &more);
    terminal.wait_for("Enter on");
    let heading = |screen: &str| screen.lines().nth(1).map(str::to_owned);
    while !terminal.text().contains("i turn the picture") {
        let here = heading(&terminal.text());
        terminal.send("G\r");
        terminal.wait_until("another page", |screen| heading(screen) != here);
    }
    terminal.wait_for("▀▀▀▀");
    terminal.wait_for("✓ saved");
    let here = settled(&terminal);
    terminal.send("i");
    terminal.wait_for("▸roughness");
    terminal.send("\u{1b}[C");
    terminal.send("q");
    terminal.wait_until("the page", |screen| screen.contains("i turn the picture"));
    terminal.wait_for("▀▀▀▀");
    let back = settled(&terminal);
    let seen = |text: &str| -> Vec<String> {
        text.lines()
            .map(|line| line.trim_end().to_owned())
            .collect()
    };
    let (before, after) = (seen(&here), seen(&back));
    let apart: Vec<_> = before.iter().zip(&after).filter(|(a, b)| a != b).collect();
    assert!(apart.is_empty(), "{apart:#?}");
    terminal.send("\u{3}");
    assert_eq!(terminal.wait(), 0);
}

#[test]
fn without_a_screen_it_says_so_or_gives_the_numbers() {
    let text = stdout(&run(&["play", "smith-g2"]));
    assert!(text.contains("needs a terminal"), "{text}");
    assert_eq!(text.lines().count(), 1, "{text}");
    let at = |roughness| {
        let args = ["play", "smith-g2", "--plain", "--roughness", roughness];
        stdout(&run(&args))
    };
    let (smooth, rough) = (at("0.2"), at("0.8"));
    assert!(smooth.contains("roughness 0.2, light 60°"), "{smooth}");
    assert!(smooth.contains("across the ball"), "{smooth}");
    assert!(smooth.lines().count() > 12, "{smooth}");
    let rim = |text: &str| -> Option<String> {
        let mut lines = text.lines();
        lines
            .find(|line| line.starts_with("rim /"))
            .map(str::to_owned)
    };
    assert!(
        rim(&smooth).is_some() && rim(&smooth) != rim(&rough),
        "{rough}"
    );
}

#[test]
fn what_is_not_there_is_named() {
    for (args, why) in [
        (&["play", "smith-g3"][..], "did you mean `smith-g2`"),
        (
            &["play", "smith-g2", "double-divsion"],
            "did you mean `double-division`",
        ),
        (&["play", "smith-g2", "--roughness", "2"], "from 0.02 to 1"),
    ] {
        let output = run(args);
        assert_eq!(output.status.code(), Some(2), "{args:?}");
        assert!(
            stderr(&output).contains(why),
            "{args:?}: {}",
            stderr(&output)
        );
    }
}
