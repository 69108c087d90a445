//! Why there is no answer: what was given, what is wrong with it, and what to do.

use std::fmt;
use std::io::{self, Write as _};
use std::path::Path;

use adsdv_can::socket::OpenError;
use adsdv_formats::OpenError as RecordingError;
use adsdv_oracle::log::LogError;

use crate::status::Status;

/// How a log is made, for everybody who gave something else.
const RECORD: &str =
    "adsdv check --help names the formats that are read; record a log with: candump -L can0 > run.log";

/// For everybody who gave the database of the interface.
const DATABASE: &str = "it is a CAN database and no recording; the editions' own are built in (adsdv dbc --edition 2026 prints one), and check \
                        recognises by itself which one a recording follows";

/// Prints as `<what>: <why>` with a line that starts with `hint:`.
#[derive(Debug)]
pub(crate) struct Error {
    /// What was given: a file, an option.
    pub(crate) what: String,
    /// What is wrong with it, and what was expected.
    pub(crate) why: String,
    /// What to do.
    pub(crate) hint: String,
}

impl Error {
    /// The log could not be opened.
    pub(crate) fn open(name: &str, error: &io::Error) -> Self {
        let hint = match error.kind() {
            io::ErrorKind::NotFound => "check the path; - stands for standard input".to_owned(),
            io::ErrorKind::PermissionDenied => {
                "this user may not read it; change its permissions, or copy it as a user who may".to_owned()
            }
            _ => RECORD.to_owned(),
        };
        Self { what: name.to_owned(), why: format!("cannot open the log: {error}"), hint }
    }

    /// The log could be opened, and is nothing that can be read.
    pub(crate) fn recording(name: &str, error: &RecordingError) -> Self {
        match error {
            RecordingError::Read(source) if source.kind() == io::ErrorKind::IsADirectory => {
                Self::directory(name)
            }
            RecordingError::Read(source) => {
                Self { what: name.to_owned(), why: error.to_string(), hint: unreadable(source).to_owned() }
            }
            RecordingError::Foreign(foreign) => {
                Self { what: name.to_owned(), why: error.to_string(), hint: foreign.hint.to_owned() }
            }
            RecordingError::NotBuilt { format, feature } => Self {
                what: name.to_owned(),
                why: format!("it is {format}, which this build does not read"),
                hint: format!(
                    "adsdv web judges it in a browser; for the command, cargo install --path cli --features {feature}, or take a \
                     release binary"
                ),
            },
        }
    }

    /// The log is a directory.
    pub(crate) fn directory(name: &str) -> Self {
        Self {
            what: name.to_owned(),
            why: "is a directory; expected a log of candump -L".to_owned(),
            hint: "give one of the files in it".to_owned(),
        }
    }

    /// The log was opened, and there is no report.
    pub(crate) fn log(name: &str, error: &LogError) -> Self {
        let hint = match error {
            LogError::Read(read) => unreadable(&read.source).to_owned(),
            LogError::NoFrame { first, .. } => {
                let begins = first.as_ref().map(|first| first.found.as_bytes()).unwrap_or_default();
                match begins {
                    [b'V', b'E', b'R', b'S', b'I', b'O', b'N', b' ', b'"', ..] => DATABASE.to_owned(),
                    _ => RECORD.to_owned(),
                }
            }
            LogError::Rules(_) => "name another edition with --edition, or other rules".to_owned(),
            LogError::NoSuchInterface { .. } => {
                "name another with --interface, or leave the option out for the first that speaks of the ADS-DV"
                    .to_owned()
            }
        };
        Self { what: name.to_owned(), why: error.to_string(), hint }
    }

    /// The answer could not be written.
    pub(crate) fn output(error: &io::Error) -> Self {
        let hint = match error.kind() {
            io::ErrorKind::StorageFull => "free some space, or write to another disk",
            _ => "send the output to a file or a terminal that can be written",
        };
        Self {
            what: "standard output".to_owned(),
            why: format!("cannot write the answer: {error}"),
            hint: hint.to_owned(),
        }
    }

    /// A counterexample could not be written.
    pub(crate) fn write(log: &Path, error: &io::Error) -> Self {
        let hint = match error.kind() {
            io::ErrorKind::NotFound | io::ErrorKind::NotADirectory => {
                "make the directory first, or name another with --logs"
            }
            io::ErrorKind::StorageFull => "free some space, or name a directory on another disk with --logs",
            _ => "name a directory that can be written with --logs",
        };
        let why = format!("cannot write counterexamples: {error}");
        Self { what: log.display().to_string(), why, hint: hint.to_owned() }
    }

    /// The log of a live bus could not be recorded.
    pub(crate) fn record(log: &Path, error: &io::Error) -> Self {
        let hint = match error.kind() {
            io::ErrorKind::StorageFull => "free some space, or name a file on another disk with --log",
            io::ErrorKind::NotFound => "make the directory first, or name another file with --log",
            _ => "name a file that can be written with --log",
        };
        let why = format!("cannot record the log: {error}");
        Self { what: log.display().to_string(), why, hint: hint.to_owned() }
    }

    /// A recording was named where an interface is expected, or why that interface cannot be used.
    pub(crate) fn interface(name: &str, error: OpenError) -> Self {
        if Path::new(name).is_file() {
            return Self {
                what: name.to_owned(),
                why: "is a file; expected a CAN interface, such as can0".to_owned(),
                hint: format!("a recording is judged by: adsdv check {name}"),
            };
        }
        error.into()
    }

    /// Nothing came from a live bus.
    pub(crate) fn silent_bus(interface: &str) -> Self {
        Self {
            what: interface.to_owned(),
            why: "no frame came, so that there is nothing to judge".to_owned(),
            hint: "is the car on, or `adsdv vcu` running, on this bus? candump shows what comes".to_owned(),
        }
    }

    /// The system did not give what every command may have.
    pub(crate) fn system(what: &str, error: &io::Error) -> Self {
        Self {
            what: what.to_owned(),
            why: format!("the system has none left: {error}"),
            hint: "end other programs, or ask for higher limits (ulimit -a)".to_owned(),
        }
    }

    /// The terminal screen could not be shown.
    pub(crate) fn screen(error: &io::Error) -> Self {
        Self {
            what: "the terminal".to_owned(),
            why: error.to_string(),
            hint: "run it in a terminal; `adsdv vcu --plain` and `adsdv demo` need none".to_owned(),
        }
    }

    /// A thread ended by a mistake in this program.
    pub(crate) fn mistake(interface: &str, panicked: adsdv_can::live::Panicked) -> Self {
        Self {
            what: interface.to_owned(),
            why: panicked.to_string(),
            hint: "start it again, and keep what it printed for the report".to_owned(),
        }
    }

    /// The Explorer could not have its port.
    pub(crate) fn port(port: u16, error: &io::Error) -> Self {
        let hint = "name another port with --port, or 0 for any that is free";
        let why = format!("cannot serve on this port: {error}");
        Self { what: format!("port {port}"), why, hint: hint.to_owned() }
    }

    /// Tells the user, and says how the command ends.
    pub(crate) fn print(&self) -> Status {
        // If standard error cannot be written there is nobody left to tell; the status still tells.
        let _ = writeln!(io::stderr(), "adsdv: {self}");
        Status::NoAnswer
    }
}

impl From<OpenError> for Error {
    fn from(OpenError { what, why, hint }: OpenError) -> Self {
        Self { what, why, hint }
    }
}

impl std::error::Error for Error {}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { what, why, hint } = self;
        write!(f, "{what}: {why}\nhint: {hint}")
    }
}

/// What to do about a source that cannot be read on.
fn unreadable(error: &io::Error) -> &'static str {
    match error.kind() {
        // What is unpacked says so, and no disk does.
        io::ErrorKind::InvalidData | io::ErrorKind::InvalidInput | io::ErrorKind::UnexpectedEof => {
            "it is damaged, or was cut off; copy it anew from where it was recorded"
        }
        _ => "copy the log to another disk, and check the copy",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_error_has_a_hint() {
        let cases = [
            (io::ErrorKind::NotFound, "check the path"),
            (io::ErrorKind::PermissionDenied, "permissions"),
            (io::ErrorKind::TimedOut, "candump -L"),
        ];
        for (kind, hint) in cases {
            let error = Error::open("run.log", &kind.into()).to_string();
            assert!(error.starts_with("run.log: cannot open the log: "), "{error}");
            assert!(
                error.lines().last().is_some_and(|l| l.starts_with("hint: ") && l.contains(hint)),
                "{error}"
            );
        }
    }
}
