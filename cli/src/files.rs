//! Files that options name, such as `--junit`: they are written when all is printed, so that what cannot be written does not hide the verdict.

use std::fs;
use std::io;
use std::path::Path;

use crate::error::Error;

/// Writes a file that an option names.
pub(crate) fn write_file(path: &Path, option: &str, text: &str) -> Result<(), Error> {
    fs::write(path, text).map_err(|error| match error.kind() {
        io::ErrorKind::StorageFull => Error {
            hint: format!("free some space, or name a file on another disk with {option}"),
            ..unwritten(path, option, &error)
        },
        _ => unwritten(path, option, &error),
    })
}

/// What an option asks for cannot be written.
pub(crate) fn unwritten(path: &Path, option: &str, error: &dyn std::error::Error) -> Error {
    Error {
        what: path.display().to_string(),
        why: format!("cannot write what {option} asks for: {error}"),
        hint: format!("name a file that can be written with {option}, in a directory that is there"),
    }
}
