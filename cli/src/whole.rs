//! A file that is there when all of it is written; until then, what had its name is as it was.

use std::ffi::{OsStr, OsString};
use std::fs::{self, File, OpenOptions};
use std::io;
#[cfg(unix)]
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};

use tempfile::{Builder, TempPath};

/// A file that has to get its name.
pub(crate) struct Whole {
    path: TempPath,
    target: PathBuf,
}

/// What is to be written, and what has to be done then; a device or a pipe is written, and not replaced.
pub(crate) fn begin(file: &Path) -> io::Result<(File, Option<Whole>)> {
    if fs::metadata(file).is_ok_and(|metadata| !metadata.is_file()) {
        return Ok((File::create(file)?, None));
    }
    // Where there is a link, what it names is replaced.
    let target = fs::canonicalize(file).unwrap_or_else(|_| file.to_owned());
    let (folder, prefix) = beside(&target)?;
    let made = builder(&prefix, 0o666).tempfile_in(folder);
    let (written, path) = made.map_err(|error| io::Error::from(error.kind()))?.into_parts();
    Ok((written, Some(Whole { path, target })))
}

impl Whole {
    /// The name that it has until then: what ends the command removes it.
    pub(crate) fn path(&self) -> PathBuf {
        self.path.to_path_buf()
    }

    /// All is written: gives it its name.
    pub(crate) fn finish(self) -> Result<(), (PathBuf, io::Error)> {
        let Self { path, target } = self;
        // Some disks say only now that they are full.
        let synced = OpenOptions::new().append(true).open(&path).and_then(|file| file.sync_all());
        synced
            .and_then(|()| path.persist(&target).map_err(|error| error.error))
            .map_err(|error| (target, error))
    }
}

/// Where that is made which gets the name of `target`, and how its own name begins.
pub(crate) fn beside(target: &Path) -> io::Result<(&Path, OsString)> {
    let folder = target.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    fs::metadata(folder)?;
    let mut prefix = OsString::from(".");
    prefix.push(target.file_name().unwrap_or_default());
    prefix.push(".");
    Ok((folder, prefix))
}

/// Makes files and directories with such names, and with the permissions that they have when they are made without a detour.
#[cfg_attr(not(unix), expect(unused_variables, reason = "there are no such permissions"))]
pub(crate) fn builder(prefix: &OsStr, mode: u32) -> Builder<'_, 'static> {
    let mut builder = Builder::new();
    builder.prefix(prefix);
    #[cfg(unix)]
    builder.permissions(PermissionsExt::from_mode(mode));
    builder
}
