//! The sources of the crate, as tests search them.

use std::fs;
use std::path::{Path, PathBuf};

/// Every source file of the crate, but for the stand-in.
pub(crate) fn sources() -> Vec<(PathBuf, String)> {
    fn add(folder: &Path, files: &mut Vec<(PathBuf, String)>) {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                if path.file_name() != Some("kani".as_ref()) {
                    add(&path, files);
                }
            } else {
                let text = fs::read_to_string(&path).unwrap();
                files.push((path, text));
            }
        }
    }
    let mut files = Vec::new();
    add(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src"), &mut files);
    files
}
