//! Puts the text of every `lessons/*.toml` into the program, so that a copied binary teaches.

use std::fmt::Write as _;
use std::path::Path;
use std::{env, fs};

fn main() {
    let root = env::var("CARGO_MANIFEST_DIR").expect("cargo sets CARGO_MANIFEST_DIR");
    let folder = Path::new(&root).join("lessons");
    println!("cargo::rerun-if-changed=lessons");
    println!("cargo::rerun-if-changed=engine/app/build.rs");

    let mut names: Vec<String> = fs::read_dir(&folder)
        .map(|entries| {
            entries
                .filter_map(|entry| entry.ok()?.file_name().into_string().ok())
                .filter(|name| name.ends_with(".toml"))
                .collect()
        })
        .unwrap_or_default();
    names.sort();

    let mut source = String::from("&[\n");
    for name in &names {
        println!("cargo::rerun-if-changed=lessons/{name}");
        let path = folder.join(name);
        writeln!(source, "    ({name:?}, include_str!({path:?})),")
            .expect("a String takes any text");
    }
    source.push_str("]\n");

    let out = env::var("OUT_DIR").expect("cargo sets OUT_DIR");
    fs::write(Path::new(&out).join("lessons.rs"), source).expect("OUT_DIR is writable");
}
