//! What the command's exit status means.

use std::process::ExitCode;

use adsdv_oracle::judge::Verdict;

/// How the command ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Status {
    /// The log conforms, or what was asked for has been printed.
    Conforms,
    /// The log violates the document, or does not show what was required.
    Violates,
    /// There is no answer: the input could not be read, the output not written, or the arguments are wrong.
    NoAnswer,
}

impl From<Verdict> for Status {
    fn from(verdict: Verdict) -> Self {
        match verdict {
            Verdict::Conforms => Self::Conforms,
            Verdict::Violates => Self::Violates,
        }
    }
}

impl From<Status> for ExitCode {
    fn from(status: Status) -> Self {
        match status {
            Status::Conforms => Self::SUCCESS,
            Status::Violates => Self::from(1),
            Status::NoAnswer => Self::from(2),
        }
    }
}
