//! What `lobe render` keeps, and what it writes besides pictures.

mod common;

use std::fs;
use std::path::{Path, PathBuf};

use common::{run_with, stderr, stdout};

/// Every picture of the first lesson, drawn small: its file and whether it came from the cache.
#[track_caller]
fn render(home: &Path, more: &[&str]) -> Vec<(PathBuf, bool)> {
    let out = home.join("out");
    let out = out.to_str().expect("a plain name");
    let mut args = vec![
        "render",
        "ggx-d",
        "--backend",
        "cpu",
        "--size",
        "64",
        "--json",
    ];
    args.extend(["--out", out]);
    args.extend(more);
    let output = run_with(home, &args, "");
    assert!(output.status.success(), "{}", stderr(&output));
    stdout(&output)
        .lines()
        .map(|line| {
            let report: serde_json::Value = serde_json::from_str(line).expect("JSON");
            let file = report["file"].as_str().expect("a file");
            (file.into(), report["cache_hit"].as_bool().expect("a bool"))
        })
        .collect()
}

fn bytes(drawn: &[(PathBuf, bool)]) -> Vec<Vec<u8>> {
    let read = |(path, _): &(PathBuf, bool)| fs::read(path).expect("a picture");
    drawn.iter().map(read).collect()
}

fn caches(home: &Path) -> Vec<PathBuf> {
    let folder = home.join(".cache/lobe/pictures");
    let entries = fs::read_dir(folder).expect("a folder of caches");
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.expect("a file").path()).collect();
    paths.sort();
    paths
}

#[test]
fn a_picture_is_drawn_once() {
    let home = tempfile::tempdir().expect("a folder");
    let home = home.path();
    let first = render(home, &[]);
    assert!(first.iter().all(|(_, hit)| !hit), "{first:?}");
    let drawn = bytes(&first);
    let again = render(home, &[]);
    assert!(again.iter().all(|(_, hit)| *hit), "{again:?}");
    assert_eq!(bytes(&again), drawn);
    let forced = render(home, &["--force"]);
    assert!(forced.iter().all(|(_, hit)| !hit), "{forced:?}");
    assert_eq!(bytes(&forced), drawn);
    // Another precision is another picture; plots and maps know none.
    let narrow = render(home, &["--precision", "f32"]);
    let redrawn = narrow.iter().filter(|(_, hit)| !hit).count();
    assert_eq!(redrawn, 1, "{narrow:?}");
}

/// The files that a name stands for, or what is said of it.
#[track_caller]
fn check_named(name: &str, expected: Result<&[&str], &str>) {
    let home = tempfile::tempdir().expect("a folder");
    let out = home.path().join("out");
    let args = ["render", name, "--size", "64", "--backend", "cpu", "--out"];
    let args = args.into_iter().chain(out.to_str());
    let output = run_with(home.path(), &args.collect::<Vec<_>>(), "");
    match expected {
        Ok(files) => {
            assert!(output.status.success(), "{}", stderr(&output));
            let entries = fs::read_dir(&out).expect("a folder of pictures");
            let mut found: Vec<_> = entries
                .map(|entry| entry.expect("a file").file_name())
                .collect();
            found.sort();
            assert_eq!(found, files);
        }
        Err(says) => {
            assert_eq!(output.status.code(), Some(2));
            assert_eq!(stderr(&output).lines().count(), 1);
            assert!(stderr(&output).contains(says), "{}", stderr(&output));
            assert!(!out.exists(), "nothing is drawn");
        }
    }
}

#[test]
fn one_picture_is_drawn_alone() {
    let one = "smith-g2-double-division.png";
    check_named("smith-g2/double-division", Ok(&[one]));
    check_named("2/double-division", Ok(&[one]));
    let plot = ["smith-g2-ratio.png", "smith-g2-ratio.svg"];
    check_named("smith-g2/ratio", Ok(&plot));
    check_named("smith-g2/furnace", Ok(&["smith-g2-furnace.png"]));
    check_named(
        "ggx-d/square",
        Err("ggx-d has no picture `square`: it has square-forgotten, two-balls, tails,"),
    );
    check_named("smth-g2/ratio", Err("did you mean `smith-g2`?"));
}

#[test]
fn a_broken_or_foreign_cache_is_none() {
    let home = tempfile::tempdir().expect("a folder");
    let home = home.path();
    let drawn = bytes(&render(home, &[]));
    let caches = caches(home);
    for (index, path) in caches.iter().enumerate() {
        let mut kept = fs::read(path).expect("an entry");
        match index % 4 {
            // Cut off, changed in one bit, empty, another picture's.
            0 => kept.truncate(kept.len() - 1),
            1 => *kept.last_mut().expect("a byte") ^= 1,
            2 => kept.clear(),
            _ => kept = fs::read(&caches[(index + 1) % caches.len()]).expect("an entry"),
        }
        fs::write(path, kept).expect("room");
    }
    let again = render(home, &[]);
    assert!(again.iter().all(|(_, hit)| !hit), "{again:?}");
    assert_eq!(bytes(&again), drawn);
    assert!(render(home, &[]).iter().all(|(_, hit)| *hit));
}

#[test]
fn values_are_written_on_request() {
    let home = tempfile::tempdir().expect("a folder");
    for (format, ending, start) in [
        ("exr", "exr", [0x76, 0x2f, 0x31, 0x01]),
        ("png16", "png", *b"\x89PNG"),
    ] {
        let drawn = render(home.path(), &["--values", format]);
        let name = format!("ggx-d-square-forgotten-values.{ending}");
        let found = drawn.iter().find(|(path, _)| path.ends_with(&name));
        let (path, _) = found.unwrap_or_else(|| panic!("no {name} in {drawn:?}"));
        assert!(fs::read(path).expect("a file").starts_with(&start));
    }
}
