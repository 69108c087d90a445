//! `--dbc`: a database of the user's own.

use std::fs::File;
use std::io::Read as _;
use std::path::Path;

use adsdv_decode::{Database, MAX_DBC};

use super::errors;
use crate::error::Error;

/// Reads it, and no more of it than a database may have.
pub(super) fn read(file: &Path) -> Result<Database, Error> {
    let mut text = Vec::new();
    let opened = File::open(file).map_err(|error| errors::open_database(file, &error))?;
    opened
        .take(MAX_DBC as u64 + 1)
        .read_to_end(&mut text)
        .map_err(|error| errors::open_database(file, &error))?;
    Database::read(&file.display().to_string(), &text).map_err(|error| errors::database(file, &error))
}
