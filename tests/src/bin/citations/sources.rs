//! Files: the sources to read, and the annotations to write.

use std::collections::BTreeMap;
use std::path::Path;
use std::{fs, io};

/// A source file.
#[derive(Clone, Debug)]
pub(crate) struct Source {
    /// Its path, with `/` between folders.
    pub(crate) path: String,
    pub(crate) text: String,
}

/// This program's own folder: what it says about citations are none.
const OWN: &str = "tests/src/bin/citations";

/// Every Rust source below a folder, in the order of their paths. What was built is left out, and so are hidden folders.
pub(crate) fn all(root: &Path) -> io::Result<Vec<Source>> {
    let mut found = Vec::new();
    below(root, "", &mut found)?;
    found.sort_by(|a, b| a.path.cmp(&b.path));
    Ok(found)
}

fn below(root: &Path, folder: &str, found: &mut Vec<Source>) -> io::Result<()> {
    for entry in fs::read_dir(root.join(folder)).map_err(|error| named(Path::new(folder), &error))? {
        let entry = entry?;
        let name = entry.file_name().to_string_lossy().into_owned();
        let path = if folder.is_empty() { name.clone() } else { format!("{folder}/{name}") };
        if entry.file_type()?.is_dir() {
            if !name.starts_with('.') && name != "target" && path != OWN {
                below(root, &path, found)?;
            }
        } else if Path::new(&name).extension().is_some_and(|extension| extension == "rs") {
            found.push(Source { text: read(&root.join(&path))?, path });
        }
    }
    Ok(())
}

/// The text of a file; the error names it.
pub(crate) fn read(path: &Path) -> io::Result<String> {
    fs::read_to_string(path).map_err(|error| named(path, &error))
}

/// Writes files into a folder, in which nothing else is left.
pub(crate) fn write_anew(folder: &Path, files: &BTreeMap<String, String>) -> io::Result<()> {
    match fs::remove_dir_all(folder) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(named(folder, &error)),
        _ => {}
    }
    for (path, text) in files {
        let path = folder.join(path);
        let parent = path.parent().unwrap_or(folder);
        fs::create_dir_all(parent)
            .and_then(|()| fs::write(&path, text))
            .map_err(|error| named(&path, &error))?;
    }
    Ok(())
}

fn named(path: &Path, error: &io::Error) -> io::Error {
    io::Error::new(error.kind(), format!("{}: {error}", path.display()))
}
