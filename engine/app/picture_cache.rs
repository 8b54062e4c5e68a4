//! Pictures that were drawn before, in the user's folder of caches: a file each, named after a
//! hash of everything that the picture depends on.
//!
//! A file is one line of JSON, which says how the picture came about, and the picture. What is
//! broken, cut off or somebody else's is as good as not there; a cache that cannot be written
//! costs time only.

use std::fs;
use std::path::PathBuf;

use etcetera::BaseStrategy as _;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

/// Where one picture is kept.
pub struct Entry {
    path: PathBuf,
    key: String,
}

/// The first line of a file.
#[derive(Serialize, Deserialize)]
struct Header<R> {
    /// Hash of the key, so that a file of another name is not taken for this one.
    key: String,
    /// Hash of the picture.
    picture: String,
    report: R,
}

impl Entry {
    /// The entry of what `description` describes; `None` where this user or program has no place.
    pub fn of(description: &str) -> Option<Self> {
        let key = hash(format!("{}\n{description}", version()?).as_bytes());
        let caches = etcetera::choose_base_strategy().ok()?.cache_dir();
        let path = caches.join("lobe").join("pictures").join(&key);
        Some(Self { path, key })
    }

    /// The picture and its report, if it is there and whole.
    pub fn read<R: DeserializeOwned>(&self) -> Option<(R, Vec<u8>)> {
        let mut bytes = fs::read(&self.path).ok()?;
        let end = bytes.iter().position(|byte| *byte == b'\n')?;
        let header: Header<R> = serde_json::from_slice(&bytes[..end]).ok()?;
        let picture = bytes.split_off(end + 1);
        let whole = header.key == self.key && header.picture == hash(&picture);
        whole.then_some((header.report, picture))
    }

    /// Keeps a picture. The file appears whole or not at all.
    pub fn write<R: Serialize>(&self, report: &R, picture: &[u8]) {
        let header = Header {
            key: self.key.clone(),
            picture: hash(picture),
            report,
        };
        let Ok(mut bytes) = serde_json::to_vec(&header) else {
            return;
        };
        bytes.push(b'\n');
        bytes.extend_from_slice(picture);
        let Some(folder) = self.path.parent() else {
            return;
        };
        let _ = fs::create_dir_all(folder);
        if let Ok(file) = tempfile::NamedTempFile::new_in(folder)
            && fs::write(file.path(), bytes).is_ok()
        {
            let _ = file.persist(&self.path);
        }
    }
}

fn hash(bytes: &[u8]) -> String {
    blake3::hash(bytes).to_hex().to_string()
}

/// The very program that draws: another build may draw otherwise.
fn version() -> Option<String> {
    let program = std::env::current_exe().and_then(fs::metadata).ok()?;
    let built = program.modified().ok()?;
    let built = built.duration_since(std::time::UNIX_EPOCH).ok()?;
    let version = env!("CARGO_PKG_VERSION");
    Some(format!("{version} {} {built:?}", program.len()))
}
