//! What can be wrong, and what to do.

use std::io;
use std::path::Path;

use adsdv_decode::{BeginError, DbcError, NotBuilt};

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

pub(super) fn table() -> Error {
    Error {
        what: "--table".to_owned(),
        why: "is for Parquet, and --format does not ask for that".to_owned(),
        hint: "add --format parquet, or leave --table out".to_owned(),
    }
}

pub(super) fn messages_without_directory() -> Error {
    Error {
        what: "--table messages".to_owned(),
        why: "writes a file for each message, and there is no directory for them".to_owned(),
        hint: "name one that is new or empty with --output".to_owned(),
    }
}

pub(super) fn terminal() -> Error {
    Error {
        what: "--format".to_owned(),
        why: "asks for what is no text, and standard output is a terminal".to_owned(),
        hint: "write it to a file with --output, or into a pipe".to_owned(),
    }
}

pub(super) fn not_built(error: NotBuilt) -> Error {
    Error {
        what: format!("--format {}", error.feature),
        why: error.to_string(),
        hint: format!("cargo install --path cli --features {}, or take a release binary", error.feature),
    }
}

pub(super) fn begin(output: Option<&Path>, error: &BeginError) -> Error {
    match error {
        BeginError::NotBuilt(error) => not_built(*error),
        BeginError::Sink(sink) => written(output, &sink.0),
    }
}

/// What was decoded could not be written, to a file or to standard output.
pub(super) fn written(output: Option<&Path>, error: &io::Error) -> Error {
    output.map_or_else(|| Error::output(error), |file| write(file, error))
}

pub(super) fn full_directory(directory: &Path) -> Error {
    Error {
        what: directory.display().to_string(),
        why: "is not empty, and what is in it would be taken for a part of this log".to_owned(),
        hint: "name a directory that is new or empty with --output".to_owned(),
    }
}

pub(super) fn write(file: &Path, error: &io::Error) -> Error {
    let hint = match error.kind() {
        io::ErrorKind::NotFound => "make the directory first, or name another file with --output",
        io::ErrorKind::IsADirectory => "name a file in it with --output",
        io::ErrorKind::NotADirectory => "it is no directory; name one that is new or empty with --output",
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_format_that_is_not_built_in_is_named_with_its_feature() {
        let error = begin(None, &BeginError::NotBuilt(NotBuilt { format: "Parquet", feature: "parquet" }));
        assert_eq!(
            error.to_string(),
            "--format parquet: this build does not write Parquet: it was built without the feature parquet\nhint: cargo install --path cli --features parquet, or take a release binary"
        );
    }
}
