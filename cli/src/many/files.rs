//! Which files are judged: those that are named, those that a pattern names, and those in directories.

use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use adsdv_formats::Log;
use walkdir::WalkDir;

use crate::check::Failed;
use crate::error::Error;
use crate::recording;

/// A file to be judged.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Found {
    pub(super) path: PathBuf,
    /// It was found in a directory, so that nobody said that it is a log.
    pub(super) by_directory: bool,
    /// How long it is.
    pub(super) bytes: u64,
}

impl Found {
    fn new(path: PathBuf, by_directory: bool) -> Self {
        let bytes = fs::metadata(&path).map_or(0, |metadata| metadata.len());
        Self { path, by_directory, bytes }
    }

    /// Opens it; `read` counts the bytes that are read.
    pub(super) fn open(&self, read: &Arc<AtomicU64>) -> Result<Log, Failed> {
        let name = self.path.display().to_string();
        let file = File::open(&self.path).map_err(|error| Failed::Open(Error::open(&name, &error)))?;
        let source = Counted { source: file, read: Arc::clone(read) };
        adsdv_formats::open(source).map_err(|error| Failed::Open(Error::recording(&name, &error)))
    }
}

/// Whether an argument may name several logs.
pub(super) fn is_several(log: &Path) -> bool {
    log.is_dir() || is_pattern(log)
}

/// Whether it is a pattern that no shell has replaced by the files: that of Windows leaves it to programs.
fn is_pattern(log: &Path) -> bool {
    !log.exists() && log.to_str().is_some_and(|log| log.contains(['*', '?']))
}

/// All files that the arguments name, in their order, those of a directory by name.
pub(super) fn find(logs: &[PathBuf]) -> Result<Vec<Found>, Error> {
    let mut found = Vec::new();
    for log in logs {
        if log == Path::new(recording::STDIN) {
            return Err(Error {
                what: "-".to_owned(),
                why: "standard input is judged alone; expected files and directories beside each other"
                    .to_owned(),
                hint: "save it first: cat > run.log".to_owned(),
            });
        }
        if is_pattern(log) {
            for log in matching(log)? {
                add(&mut found, &log)?;
            }
        } else {
            add(&mut found, log)?;
        }
    }
    Ok(found)
}

fn add(found: &mut Vec<Found>, log: &Path) -> Result<(), Error> {
    if !log.is_dir() {
        found.push(Found::new(log.to_owned(), false));
        return Ok(());
    }
    let hidden = |name: &std::ffi::OsStr| name.to_str().is_some_and(|name| name.starts_with('.'));
    let entries = WalkDir::new(log).sort_by_file_name().into_iter();
    for entry in entries.filter_entry(|entry| entry.depth() == 0 || !hidden(entry.file_name())) {
        let entry = entry.map_err(|error| unlisted(log, &error))?;
        if entry.file_type().is_file() {
            found.push(Found::new(entry.into_path(), true));
        }
    }
    Ok(())
}

fn matching(pattern: &Path) -> Result<Vec<PathBuf>, Error> {
    let text = pattern.to_str().unwrap_or_default();
    let wrong = |error: &dyn std::error::Error| Error {
        what: text.to_owned(),
        why: format!("is no file, and no pattern that names some: {error}"),
        hint: "check the path; * stands for any characters of a name".to_owned(),
    };
    let paths = glob::glob(text).map_err(|error| wrong(&error))?;
    let paths: Vec<PathBuf> = paths.collect::<Result<_, _>>().map_err(|error| wrong(&error))?;
    if paths.is_empty() { Err(wrong(&io::Error::other("nothing matches"))) } else { Ok(paths) }
}

fn unlisted(log: &Path, error: &walkdir::Error) -> Error {
    Error {
        what: log.display().to_string(),
        why: format!("cannot list the directory: {error}"),
        hint: "this user may not read it; change its permissions, or name the files".to_owned(),
    }
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
