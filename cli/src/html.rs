//! `--html`: writes a report as a page to look at.

use std::fs::File;
use std::io::{self, Read as _, Write as _};
use std::path::Path;

use adsdv_report::PageError;

use crate::error::Error;
use crate::{interrupt, output, recording, whole};

/// How every page begins.
const PAGE: &str = "<!doctype html>";

/// Whether the page is printed, in place of the report.
pub(crate) fn is_printed(file: Option<&Path>) -> bool {
    file == Some(Path::new(recording::STDOUT))
}

/// What goes with it, and what does not: told before anything is done that takes time.
pub(crate) fn prepare(file: Option<&Path>, json: bool) -> Result<(), Error> {
    if let Some(file) = file.filter(|file| file.is_dir()) {
        return Err(failed(file, &io::ErrorKind::IsADirectory.into()));
    }
    if let Some(file) = file.filter(|file| is_something_else(file)) {
        return Err(Error {
            what: format!("--html {}", file.display()),
            why: "would replace a file that is no page; expected the name of the page that is to be written"
                .to_owned(),
            hint:
                "name the page behind --html, such as --html run.html; to replace that file, remove it first"
                    .to_owned(),
        });
    }
    if is_printed(file) && json {
        return Err(Error {
            what: "--html -".to_owned(),
            why: "prints the page, and --json prints the report; expected one of them on standard output"
                .to_owned(),
            hint: "name a file for the page with --html".to_owned(),
        });
    }
    Ok(())
}

/// Whether there is a file that is no page, such as a recording that was named by mistake.
fn is_something_else(file: &Path) -> bool {
    let mut begin = Vec::new();
    let read = file.is_file().then(|| File::open(file)?.take(PAGE.len() as u64).read_to_end(&mut begin));
    matches!(read, Some(Ok(1..))) && !PAGE.as_bytes().eq_ignore_ascii_case(&begin)
}

/// The same for what takes long: a folder that is missing is told as well.
pub(crate) fn prepare_long(file: Option<&Path>, json: bool) -> Result<(), Error> {
    prepare(file, json)?;
    let Some(file) = file.filter(|file| !is_printed(Some(file))) else { return Ok(()) };
    whole::beside(file).map(drop).map_err(|error| failed(file, &error))
}

/// Writes it where it is asked for.
pub(crate) fn write(file: &Path, page: Result<String, PageError>) -> Result<(), Error> {
    let html = page.map_err(|error| failed(file, &error.into()))?;
    if is_printed(Some(file)) {
        return output::plain(&html);
    }
    let (mut out, unfinished) = whole::begin(file).map_err(|error| failed(file, &error))?;
    if let Some(unfinished) = &unfinished {
        interrupt::removes(unfinished.path()).map_err(|error| Error::system("signals", &error))?;
    }
    out.write_all(html.as_bytes()).and_then(|()| out.flush()).map_err(|error| failed(file, &error))?;
    drop(out);
    match unfinished.map(whole::Whole::finish) {
        None | Some(Ok(())) => Ok(()),
        Some(Err((target, error))) => Err(failed(&target, &error)),
    }
}

fn failed(file: &Path, error: &io::Error) -> Error {
    let hint = match error.kind() {
        io::ErrorKind::NotFound => "make the directory first, or name another file with --html",
        io::ErrorKind::IsADirectory => "name a file in it with --html",
        io::ErrorKind::StorageFull => "free some space, or name a file on another disk with --html",
        _ => "name a file that can be written with --html",
    };
    let why = format!("cannot write the page: {error}");
    Error { what: file.display().to_string(), why, hint: hint.to_owned() }
}
