//! What came of it in files, for CI. They are written when all is printed: what cannot be written does not hide the verdict.

use adsdv_exam::ExamReport;

use super::{Examinee, junit, summary};
use crate::error::Error;
use crate::files::{unwritten, write_file};

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
