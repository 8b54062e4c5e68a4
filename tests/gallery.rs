//! The committed pictures are what the program draws today.

mod common;

use std::fs;
use std::path::Path;

use common::{root, run};

struct Pixels {
    width: u32,
    height: u32,
    bytes: Vec<u8>,
}

#[track_caller]
fn read(path: &Path) -> Pixels {
    let file = fs::File::open(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    let decoder = png::Decoder::new(std::io::BufReader::new(file));
    let mut reader = decoder.read_info().expect("a PNG");
    let mut bytes = vec![0; reader.output_buffer_size().expect("a picture that fits")];
    let frame = reader.next_frame(&mut bytes).expect("a whole PNG");
    bytes.truncate(frame.buffer_size());
    Pixels {
        width: frame.width,
        height: frame.height,
        bytes,
    }
}

/// Every picture of every lesson lies in `renders/gallery`, and drawing it again, on the CPU,
/// gives the same to the eye: hardly a byte differs by more than 8 of 255. The gallery was
/// drawn on a graphics adapter, so this also holds the two against each other.
#[test]
fn the_gallery_is_what_is_drawn_today() {
    let gallery = root().join("renders/gallery");
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().to_str().expect("a plain name");
    let output = run(&["render", "--backend", "cpu", "--out", out]);
    assert!(output.status.success(), "{output:?}");
    let mut compared = 0;
    for entry in fs::read_dir(folder.path()).expect("pictures") {
        let path = entry.expect("a picture").path();
        let name = path.file_name().expect("a name");
        let kept = gallery.join(name);
        assert!(
            kept.exists(),
            "{} is missing: lobe render --backend gpu --out renders/gallery",
            kept.display()
        );
        if path.extension().is_some_and(|extension| extension == "png") {
            let (now, then) = (read(&path), read(&kept));
            assert_eq!(
                (now.width, now.height),
                (then.width, then.height),
                "{name:?}"
            );
            let apart = now.bytes.iter().zip(&then.bytes);
            let apart = apart.filter(|(a, b)| a.abs_diff(**b) > 8).count();
            assert!(
                apart * 500 < now.bytes.len(),
                "{name:?}: {apart} of {} bytes differ",
                now.bytes.len()
            );
            compared += 1;
        }
    }
    assert!(compared > 0, "nothing was drawn");
    for entry in fs::read_dir(&gallery).expect("the gallery") {
        let name = entry.expect("a picture").file_name();
        assert!(
            folder.path().join(&name).exists(),
            "renders/gallery/{} belongs to no lesson any more: remove it",
            name.display()
        );
    }
}
