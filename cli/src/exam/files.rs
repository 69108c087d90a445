//! What came of it in files, for CI. They are written when all is printed: what cannot be written does not hide the verdict.

use std::fs;
use std::io;
use std::path::Path;

use adsdv_exam::ExamReport;

use super::{Examinee, junit, summary};
use crate::error::Error;

/// Writes those that somebody asks for.
pub(super) fn write(subject: &Examinee<'_>, report: &ExamReport) -> Result<(), Error> {
    if let Some(path) = &subject.args.junit {
        let xml = junit::text(subject, report).map_err(|error| unwritten(path, "--junit", &error))?;
        write_file(path, "--junit", &xml)?;
    }
    if let Some(path) = &subject.args.summary {
        write_file(path, "--summary", &summary::text(subject, report))?;
    }
    Ok(())
}

fn write_file(path: &Path, option: &str, text: &str) -> Result<(), Error> {
    fs::write(path, text).map_err(|error| match error.kind() {
        io::ErrorKind::StorageFull => Error {
            hint: format!("free some space, or name a file on another disk with {option}"),
            ..unwritten(path, option, &error)
        },
        _ => unwritten(path, option, &error),
    })
}

fn unwritten(path: &Path, option: &str, error: &dyn std::error::Error) -> Error {
    Error {
        what: path.display().to_string(),
        why: format!("cannot write what {option} asks for: {error}"),
        hint: format!("name a file that can be written with {option}, in a directory that is there"),
    }
}
