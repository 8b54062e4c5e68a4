//! The house stands as it is drawn: arrows point down only, and what teaches and computes
//! touches nothing outside of itself.

mod common;

use std::fs;
use std::path::{Path, PathBuf};

/// Every Rust file below a folder.
fn sources(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).expect("a folder");
    entries
        .flat_map(|entry| {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                sources(&path)
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                vec![path]
            } else {
                Vec::new()
            }
        })
        .collect()
}

/// A file's text without its tests, which may read fixtures.
fn program_text(path: &Path) -> String {
    let text = fs::read_to_string(path).expect("UTF-8");
    match text.find("#[cfg(test)]\nmod tests {") {
        Some(tests) => text[..tests].to_owned(),
        None => text,
    }
}

/// Whether a word stands in code, and not as the end of a longer name.
fn names(code: &str, word: &str) -> bool {
    let is_name = |letter: char| letter.is_alphanumeric() || letter == '_';
    code.match_indices(word)
        .any(|(at, _)| !code[..at].ends_with(is_name))
}

#[track_caller]
fn check_touches_nothing(room: &str) {
    const OUTSIDE: [&str; 12] = [
        "std::fs",
        "std::env",
        "std::net",
        "std::process",
        "std::thread",
        "std::time",
        "std::io",
        "Instant::now",
        "SystemTime",
        "println!(",
        "eprintln!(",
        "rand::",
    ];
    for path in sources(&common::root().join(room).join("src")) {
        if path.file_name().is_some_and(|name| name == "tests.rs") {
            continue;
        }
        for (number, line) in program_text(&path).lines().enumerate() {
            let code = line.split("//").next().unwrap_or_default();
            for word in OUTSIDE {
                assert!(
                    !names(code, word),
                    "{}:{}: {word}",
                    path.display(),
                    number + 1
                );
            }
        }
    }
}

#[test]
fn mathematics_formulas_and_teaching_touch_nothing_outside() {
    check_touches_nothing("engine/brdf");
    check_touches_nothing("engine/formula");
    check_touches_nothing("engine/tutor");
    check_touches_nothing("engine/shader");
}

/// The crates of this house that a crate needs to run.
fn needs(room: &str) -> Vec<String> {
    let text =
        fs::read_to_string(common::root().join(room).join("Cargo.toml")).expect("a manifest");
    let manifest: toml::Table = text.parse().expect("TOML");
    let ours = [
        "brdf", "formula", "tutor", "renders", "shader", "truth", "lobe",
    ];
    let dependencies = manifest.get("dependencies").and_then(toml::Value::as_table);
    let names = dependencies.into_iter().flat_map(toml::Table::keys);
    names
        .filter(|name| ours.contains(&name.as_str()))
        .cloned()
        .collect()
}

#[track_caller]
fn check_needs_only(room: &str, below: &[&str]) {
    for need in needs(room) {
        assert!(below.contains(&need.as_str()), "{room} needs {need}");
    }
}

#[test]
fn arrows_point_down() {
    check_needs_only("engine/brdf", &[]);
    check_needs_only("engine/formula", &["brdf"]);
    check_needs_only("engine/tutor", &["formula", "brdf"]);
    check_needs_only("renders", &["formula", "brdf"]);
    check_needs_only("engine/shader", &[]);
}
