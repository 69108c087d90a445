//! Where the answer goes: to standard output, to a file as it comes, or to a file or a directory that is there when all of it is written.

use std::fs::{self, File};
use std::io::{self, IsTerminal as _, Write};
use std::path::{Path, PathBuf};

use tempfile::TempDir;

use super::errors;
use crate::args::{DecodeArgs, DecodedTable};
use crate::error::Error;
use crate::whole::{self, Whole, beside, builder};
use crate::{interrupt, recording};

/// What has to be done when all is written, so that it is there. Without that, nothing is.
pub(super) enum Unfinished {
    /// Nothing has to be done.
    Nothing,
    /// A file has to get its name.
    File(Whole),
    /// A directory has to get its name.
    Directory(TempDir, PathBuf),
    /// The files in a directory have to go where that is.
    Files(TempDir, PathBuf),
}

/// What `--output` names; `None` for standard output.
pub(super) fn output(args: &DecodeArgs) -> Result<Option<&Path>, Error> {
    let output = args.output.as_deref().filter(|output| *output != Path::new(recording::STDOUT));
    if output.is_none() && args.table == Some(DecodedTable::Messages) {
        return Err(errors::messages_without_directory());
    }
    if output.is_none() && args.format.is_binary() && io::stdout().is_terminal() {
        return Err(errors::terminal());
    }
    Ok(output)
}

/// Standard output, or a file that is written as it comes.
pub(super) fn stream(output: Option<&Path>) -> Result<Box<dyn Write + Send>, Error> {
    Ok(match output {
        Some(file) => Box::new(File::create(file).map_err(|error| errors::write(file, &error))?),
        None => Box::new(io::stdout()),
    })
}

/// Standard output, or a file that is there when it is whole.
pub(super) fn whole(output: Option<&Path>) -> Result<(Box<dyn Write + Send>, Unfinished), Error> {
    let Some(file) = output else { return Ok((stream(output)?, Unfinished::Nothing)) };
    let (writer, unfinished) = whole::begin(file).map_err(|error| errors::write(file, &error))?;
    let Some(unfinished) = unfinished else { return Ok((Box::new(writer), Unfinished::Nothing)) };
    interrupt::removes(unfinished.path()).map_err(|error| Error::system("signals", &error))?;
    Ok((Box::new(writer), Unfinished::File(unfinished)))
}

/// A directory that is there, or has something in it, when every file is whole; and where these are to be made.
pub(super) fn directory(target: &Path) -> Result<(PathBuf, Unfinished), Error> {
    // One that is there may be a link or another disk, and is kept.
    let is_there = match fs::read_dir(target).map(|mut entries| entries.next().is_none()) {
        Ok(true) => true,
        Ok(false) => return Err(errors::full_directory(target)),
        Err(error) if error.kind() == io::ErrorKind::NotFound => false,
        Err(error) => return Err(errors::write(target, &error)),
    };
    let (folder, prefix) = beside(target).map_err(|error| errors::write(target, &error))?;
    let made = builder(&prefix, 0o777).tempdir_in(if is_there { target } else { folder });
    let made = made.map_err(|error| errors::write(target, &error.kind().into()))?;
    let (path, target) = (made.path().to_owned(), target.to_owned());
    interrupt::removes(path.clone()).map_err(|error| Error::system("signals", &error))?;
    Ok((path, if is_there { Unfinished::Files(made, target) } else { Unfinished::Directory(made, target) }))
}

impl Unfinished {
    /// All is written: gives it its name.
    pub(super) fn finish(self) -> Result<(), Error> {
        match self {
            Self::Nothing => Ok(()),
            Self::File(whole) => whole.finish().map_err(|(target, error)| errors::write(&target, &error)),
            Self::Directory(directory, target) => {
                fs::rename(directory.path(), &target).map_err(|error| errors::write(&target, &error))?;
                // It has another name now, and nothing is left to be removed.
                let _ = directory.keep();
                Ok(())
            }
            Self::Files(directory, target) => {
                let rename = |file: io::Result<fs::DirEntry>| {
                    let file = file?;
                    fs::rename(file.path(), target.join(file.file_name()))
                };
                let renamed = fs::read_dir(directory.path()).and_then(|mut files| files.try_for_each(rename));
                renamed.map_err(|error| errors::write(&target, &error))
            }
        }
    }
}
