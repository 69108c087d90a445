//! What came of logs in files, for CI.

use super::row::{Row, Rows};
use super::{junit, summary};
use crate::args::CheckArgs;
use crate::error::Error;
use crate::files::{unwritten, write_file};
use crate::judged::Subject;

/// The same of a log that is judged alone.
pub(crate) fn write_one(args: &CheckArgs, name: &str, subject: &Subject) -> Result<(), Error> {
    if args.junit.is_none() && args.summary.is_none() {
        return Ok(());
    }
    let mut rows = Rows::default();
    rows.add(Row::of(name, subject), None);
    write(args, &rows)
}

/// Writes those that somebody asks for.
pub(super) fn write(args: &CheckArgs, rows: &Rows) -> Result<(), Error> {
    if let Some(path) = &args.junit {
        let xml = junit::text(&rows.all).map_err(|error| unwritten(path, "--junit", &error))?;
        write_file(path, "--junit", &xml)?;
    }
    if let Some(path) = &args.summary {
        write_file(path, "--summary", &summary::text(rows))?;
    }
    Ok(())
}
