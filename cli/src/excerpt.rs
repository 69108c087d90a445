//! `adsdv check --excerpt`: writes the excerpts of a log, and says what it wrote.

use std::fmt::Write as _;
use std::fs;
use std::io::{self, Write as _};
use std::path::Path;

use adsdv_oracle::excerpt::{Cut, Excerpts};

use crate::args::CheckArgs;
use crate::error::Error;
use crate::layout::{Seconds, counted};
use crate::output;
use crate::report::style::{self, Styled};

/// Makes the directory, before anything is read.
pub(crate) fn prepare(directory: &Path) -> Result<(), Error> {
    fs::create_dir_all(directory).map_err(|error| failed(directory, &error))
}

/// Writes each excerpt to a file of its own, and tells of all. What stands in the directory under other names is left alone.
pub(crate) fn write(
    args: &CheckArgs,
    directory: &Path,
    version: &str,
    excerpts: &Excerpts,
) -> Result<(), Error> {
    for (cut, number) in excerpts.cut.iter().zip(1..) {
        let file = directory.join(cut.name(number));
        fs::write(&file, &cut.log).map_err(|error| failed(&file, &error))?;
    }
    let text = text(directory, version, excerpts);
    if args.json {
        // Standard output is for the report. If standard error cannot be written, the files are there all the same.
        let _ = io::stderr().write_all(anstream::adapter::strip_str(&text).to_string().as_bytes());
        return Ok(());
    }
    output::styled(&text, args.color)
}

fn text(directory: &Path, version: &str, excerpts: &Excerpts) -> String {
    let mut text = format!("\n{}\n", Styled(style::HEADING, "EXCERPTS"));
    let directory = directory.display();
    if excerpts.cut.is_empty() {
        let _ = writeln!(text, "  no violations, no warnings: nothing was written to {directory}");
        return text;
    }
    let files = counted(excerpts.cut.len() as u64, "log");
    let _ = writeln!(text, "  {files} in {directory}; `adsdv check --edition {version}` judges each as here");
    for (cut, number) in excerpts.cut.iter().zip(1..) {
        let Cut { finding, frames, before_ns, shows, .. } = cut;
        let lines = counted(*frames as u64, "line");
        let name = cut.name(number);
        let _ = write!(text, "  {name:<32}  {} s, {lines}", Seconds(finding.t_ns));
        let _ = if *shows {
            writeln!(text)
        } else {
            writeln!(text, ": even from {} s before does not show it alone", Seconds(*before_ns))
        };
    }
    if excerpts.more > 0 {
        let _ = writeln!(text, "  {} more, without an excerpt", counted(excerpts.more as u64, "finding"));
    }
    text
}

fn failed(file: &Path, error: &io::Error) -> Error {
    let hint = match error.kind() {
        io::ErrorKind::AlreadyExists | io::ErrorKind::NotADirectory => {
            "it is no directory; name one with --excerpt, which is made if it is not there"
        }
        io::ErrorKind::StorageFull => "free some space, or name a directory on another disk with --excerpt",
        _ => "name a directory that can be written with --excerpt",
    };
    let why = format!("cannot write excerpts: {error}");
    Error { what: file.display().to_string(), why, hint: hint.to_owned() }
}
