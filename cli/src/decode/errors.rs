//! What can be wrong, and what to do.

use std::io;
use std::path::Path;

use adsdv_decode::{DbcError, NotBuilt};

use crate::error::Error;

pub(super) fn single_line() -> Error {
    Error {
        what: "--single-line".to_owned(),
        why: "is for text, and --format asks for something else".to_owned(),
        hint: "leave one of the two options out".to_owned(),
    }
}

pub(super) fn layout() -> Error {
    Error {
        what: "--layout".to_owned(),
        why: "is for MCAP, and --format asks for something else".to_owned(),
        hint: "add --format mcap, or leave --layout out".to_owned(),
    }
}

pub(super) fn not_built(format: &str, error: NotBuilt) -> Error {
    Error {
        what: format!("--format {format}"),
        why: error.to_string(),
        hint: format!("cargo install adsdv --features {}, or take a release binary", error.feature),
    }
}

pub(super) fn write(file: &Path, error: &io::Error) -> Error {
    let hint = match error.kind() {
        io::ErrorKind::NotFound => "make the directory first, or name another file with --output",
        io::ErrorKind::IsADirectory => "name a file in it with --output",
        io::ErrorKind::StorageFull => "free some space, or name a file on another disk with --output",
        _ => "name a file that can be written with --output",
    };
    let why = format!("cannot write what was decoded: {error}");
    Error { what: file.display().to_string(), why, hint: hint.to_owned() }
}

pub(super) fn open_database(file: &Path, error: &io::Error) -> Error {
    let hint = match error.kind() {
        io::ErrorKind::NotFound => "check the path",
        io::ErrorKind::IsADirectory => "give one of the files in it; --dbc may be repeated",
        _ => "give a file that this user may read",
    };
    let why = format!("cannot read the database: {error}");
    Error { what: file.display().to_string(), why, hint: hint.to_owned() }
}

pub(super) fn database(file: &Path, error: &DbcError) -> Error {
    let hint = match error.line {
        Some(_) => {
            "correct that line, or take the message out; python -m cantools dump shows how others read the file"
        }
        None => "--dbc takes a CAN database (DBC), such as adsdv dbc prints",
    };
    Error { what: file.display().to_string(), why: error.to_string(), hint: hint.to_owned() }
}
