//! Opens the recording that an argument names.

use std::fs::File;
use std::io;
use std::path::Path;

use adsdv_formats::Log;

use crate::error::Error;

/// The name that stands for standard input.
pub(crate) const STDIN: &str = "-";
/// The name that stands for standard output.
pub(crate) const STDOUT: &str = "-";

/// What an error and a report call it.
pub(crate) fn name(log: &Path) -> String {
    if is_stdin(log) { "standard input".to_owned() } else { log.display().to_string() }
}

/// Opens it, whatever format it has; `label` names it where it cannot be opened.
pub(crate) fn open(log: &Path, label: &str) -> Result<Log, Error> {
    let opened = if is_stdin(log) {
        adsdv_formats::open(io::stdin())
    } else {
        adsdv_formats::open(File::open(log).map_err(|error| Error::open(label, &error))?)
    };
    opened.map_err(|error| Error::recording(label, &error))
}

fn is_stdin(log: &Path) -> bool {
    log == Path::new(STDIN)
}
