//! Which files paths name: those that are named, those that a pattern names, and those in directories.

use std::ffi::OsStr;
use std::fmt;
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use walkdir::WalkDir;

/// A file that may be a recording.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Found {
    /// Where it is.
    pub path: PathBuf,
    /// It was found in a directory, so that nobody said that it is a recording.
    pub by_directory: bool,
    /// How long it is, in bytes; 0 where that is not known.
    pub bytes: u64,
}

impl Found {
    fn new(path: PathBuf, by_directory: bool) -> Self {
        let bytes = fs::metadata(&path).map_or(0, |metadata| metadata.len());
        Self { path, by_directory, bytes }
    }

    /// Opens the file, for [`open`](crate::open); `read` counts the bytes that are read of it, and may be shared with other files.
    ///
    /// # Errors
    ///
    /// Fails where the file cannot be opened.
    pub fn source(&self, read: &Arc<AtomicU64>) -> io::Result<impl Read + Send + 'static> {
        Ok(Counted { source: File::open(&self.path)?, read: Arc::clone(read) })
    }
}

/// Why it is not known which files are meant.
#[derive(Debug)]
pub enum FindError {
    /// There is no such file, and as a pattern it names none.
    Pattern {
        /// What was given.
        pattern: PathBuf,
        /// Why it names none.
        why: String,
    },
    /// A directory, or one below it, cannot be listed.
    Directory {
        /// What was given.
        path: PathBuf,
        /// Why it cannot.
        source: io::Error,
    },
}

impl FindError {
    /// What was given.
    pub fn path(&self) -> &Path {
        match self {
            Self::Pattern { pattern, .. } => pattern,
            Self::Directory { path, .. } => path,
        }
    }

    /// What is wrong with it, without what was given.
    pub fn why(&self) -> String {
        match self {
            Self::Pattern { why, .. } => format!("is no file, and no pattern that names some: {why}"),
            Self::Directory { source, .. } => format!("cannot list the directory: {source}"),
        }
    }
}

impl fmt::Display for FindError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.path().display(), self.why())
    }
}

impl std::error::Error for FindError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Pattern { .. } => None,
            Self::Directory { source, .. } => Some(source),
        }
    }
}

/// Whether a path may name several files.
pub fn is_several(path: &Path) -> bool {
    path.is_dir() || is_pattern(path)
}

/// Whether it is a pattern that no shell has replaced by the files: that of Windows leaves it to programs.
fn is_pattern(path: &Path) -> bool {
    !path.exists() && path.to_str().is_some_and(|path| path.contains(['*', '?']))
}

/// All files that paths name, in their order: a directory names all in it and below it, by their names, but for hidden ones; a path with `*` or
/// `?` that is no file names those that match. A file that is not there is found all the same, so that opening it says why.
///
/// ```
/// let found = adsdv_formats::find(&["no-such.log".into()])?;
/// assert!(found[0].source(&std::sync::Arc::default()).is_err());
/// # Ok::<(), adsdv_formats::FindError>(())
/// ```
///
/// # Errors
///
/// Fails where a directory cannot be listed, or a pattern names nothing.
pub fn find(paths: &[PathBuf]) -> Result<Vec<Found>, FindError> {
    let mut found = Vec::new();
    for path in paths {
        if is_pattern(path) {
            for path in matching(path)? {
                add(&mut found, &path)?;
            }
        } else {
            add(&mut found, path)?;
        }
    }
    Ok(found)
}

fn add(found: &mut Vec<Found>, path: &Path) -> Result<(), FindError> {
    if !path.is_dir() {
        found.push(Found::new(path.to_owned(), false));
        return Ok(());
    }
    let hidden = |name: &OsStr| name.to_str().is_some_and(|name| name.starts_with('.'));
    let entries = WalkDir::new(path).sort_by_file_name().into_iter();
    for entry in entries.filter_entry(|entry| entry.depth() == 0 || !hidden(entry.file_name())) {
        let entry =
            entry.map_err(|error| FindError::Directory { path: path.to_owned(), source: error.into() })?;
        if entry.file_type().is_file() {
            found.push(Found::new(entry.into_path(), true));
        }
    }
    Ok(())
}

fn matching(pattern: &Path) -> Result<Vec<PathBuf>, FindError> {
    let none = |why: String| FindError::Pattern { pattern: pattern.to_owned(), why };
    let paths = glob::glob(pattern.to_str().unwrap_or_default()).map_err(|error| none(error.to_string()))?;
    let paths = paths.collect::<Result<Vec<_>, _>>().map_err(|error| none(error.to_string()))?;
    if paths.is_empty() { Err(none("nothing matches".to_owned())) } else { Ok(paths) }
}

/// A source whose bytes are counted.
struct Counted<R> {
    source: R,
    read: Arc<AtomicU64>,
}

impl<R: Read> Read for Counted<R> {
    fn read(&mut self, room: &mut [u8]) -> io::Result<usize> {
        let len = self.source.read(room)?;
        self.read.fetch_add(len as u64, Ordering::Relaxed);
        Ok(len)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_found_in_the_order_of_the_paths_and_those_of_a_directory_by_name() {
        let samples = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/samples");
        let paths = [
            samples.join("vector.asc"),
            samples.clone(),
            samples.join("*.mcap"),
            samples.join("no-such.log"),
        ];
        let found = find(&paths).expect("they are there");
        let names: Vec<String> = found.iter().map(|one| one.path.display().to_string()).collect();
        let of_directory: Vec<&Found> = found.iter().filter(|one| one.by_directory).collect();
        assert!(of_directory.is_sorted_by_key(|one| &one.path) && of_directory.len() > 15, "{names:?}");
        assert!(names[0].ends_with("vector.asc") && names[1] == of_directory[0].path.display().to_string());
        let last: Vec<&str> = names.iter().rev().take(4).filter_map(|name| name.rsplit('/').next()).collect();
        assert_eq!(last, ["no-such.log", "zstd.mcap", "unchunked.mcap", "lz4.mcap"]);
        assert_eq!(found.last().map(|one| one.bytes), Some(0));
    }

    #[test]
    fn what_is_read_of_a_file_is_counted() {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/samples/vector.asc");
        let [found] = &find(&[path]).expect("it is there")[..] else { panic!("one") };
        let read = Arc::default();
        let mut source = found.source(&read).expect("it can be opened");
        let copied = io::copy(&mut source, &mut io::sink()).expect("it can be read");
        assert!(copied > 100 && copied == found.bytes && copied == read.load(Ordering::Relaxed));
    }

    #[test]
    fn a_pattern_that_names_nothing_is_an_error_that_says_so() {
        let error = find(&["no-such-*.log".into()]).expect_err("nothing matches");
        assert_eq!(
            error.to_string(),
            "no-such-*.log: is no file, and no pattern that names some: nothing matches"
        );
    }
}
