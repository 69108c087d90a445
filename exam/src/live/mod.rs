//! The exam in real time, on a bus of SocketCAN: the program is one like any other on the bus, and knows nothing of an exam.
//!
//! | to read about | look in |
//! |---|---|
//! | all scenarios, several at once, and once more where this machine was late | `exam` |
//! | one scenario: the cycle of 10 ms, what comes, what is sent | `session` |
//! | who is examined: a program that is started afresh, or one that runs all the time | `under_test` |
//! | how late this machine was, and what is in doubt for that | `late` |
//! | frames that are not of the document | `odd` |
//! | a bus in a namespace of its own | `namespace` |
//! | on which bus, and of whom | `options` |
//! | why an exam ends early | `error` |

mod error;
mod exam;
mod late;
#[cfg(target_os = "linux")]
mod namespace;
#[cfg(not(target_os = "linux"))]
#[path = "no_namespace.rs"]
mod namespace;
mod odd;
mod options;
mod session;
#[cfg(test)]
mod tests;
mod under_test;

pub use error::LiveError;
pub use exam::{LiveProgress, LiveReport, exam_live};
pub use namespace::prepare as prepare_namespaces;
pub use options::{LiveBus, LiveOptions, LiveProgram};
