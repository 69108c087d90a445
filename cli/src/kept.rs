//! What is read is kept: nothing is written in its place.

use std::fs;
use std::path::Path;

use crate::error::Error;

/// Refuses to write what an option asks for where that would replace one of the files that are read.
pub(crate) fn keep<'a>(
    read: impl IntoIterator<Item = &'a Path>,
    option: &str,
    file: Option<&Path>,
) -> Result<(), Error> {
    // What is not there yet replaces nothing.
    let Some(file) = file.filter(|file| file.is_file()) else { return Ok(()) };
    let Some(replaced) = read.into_iter().find(|read| is_same(read, file)) else { return Ok(()) };
    Err(Error {
        what: format!("{option} {}", file.display()),
        why: format!(
            "would replace {}, which is read; expected another file, so that nothing is lost",
            replaced.display()
        ),
        hint: format!("name the file that is to be written behind {option}"),
    })
}

fn is_same(one: &Path, other: &Path) -> bool {
    matches!((fs::canonicalize(one), fs::canonicalize(other)), (Ok(one), Ok(other)) if one == other)
}
