//! A file that is there when all of it is written, and not before: of a format that nobody can read a part of.

use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

use super::errors;
use crate::error::Error;

/// A file under another name beside its own, until it is whole.
pub(super) struct WholeFile {
    written: NamedTempFile,
    /// As it was asked for, and as it is without links.
    asked: PathBuf,
    target: PathBuf,
}

impl WholeFile {
    /// Begins one, unless that is the name of something else than a file: a device or a pipe is written as it is.
    pub(super) fn begin(file: &Path) -> Result<Option<Self>, Error> {
        let target = match fs::metadata(file) {
            Ok(found) if !found.is_file() => return Ok(None),
            Ok(_) => fs::canonicalize(file).unwrap_or_else(|_| file.to_owned()),
            Err(_) => file.to_owned(),
        };
        let folder =
            target.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let written = made_in(folder).map_err(|error| errors::write(file, &error))?;
        Ok(Some(Self { written, asked: file.to_owned(), target }))
    }

    /// What to write to.
    pub(super) fn writer(&self) -> Result<File, Error> {
        self.written.as_file().try_clone().map_err(|error| errors::write(&self.asked, &error))
    }

    /// It is whole. One that is there is replaced.
    pub(super) fn keep(self) -> Result<(), Error> {
        let kept = self.written.persist(&self.target);
        kept.map(drop).map_err(|error| errors::write(&self.asked, &error.error))
    }
}

/// A file with the permissions that any other new one has, and with errors that do not name it: nobody has asked for it.
fn made_in(folder: &Path) -> io::Result<NamedTempFile> {
    tempfile::Builder::new().prefix(".adsdv-").suffix(".part").make_in(folder, |path| File::create_new(path))
}
