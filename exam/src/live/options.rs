//! How an exam in real time is held: on which bus, and of whom.

use std::ffi::OsString;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use crate::exam::ExamOptions;

/// How an exam in real time is held.
#[derive(Clone, Debug)]
pub struct LiveOptions {
    /// What every exam has.
    pub exam: ExamOptions,
    /// Where.
    pub bus: LiveBus,
    /// How long a program may take from its start to its first frame.
    pub startup: Duration,
    /// How many scenarios run at once, where each has a bus of its own.
    pub jobs: usize,
    /// Set when the exam is to end early.
    pub stop: Arc<AtomicBool>,
}

impl LiveOptions {
    pub(super) fn stops(&self) -> bool {
        self.stop.load(Ordering::Acquire)
    }

    pub(super) fn at_once(&self) -> usize {
        if matches!(self.bus, LiveBus::Namespace(_)) { self.jobs.max(1) } else { 1 }
    }
}

/// The bus.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum LiveBus {
    /// An interface that is there.
    Interface(String),
    /// One of this name that is made for it. [`prepare_namespaces`](super::prepare_namespaces) was called before.
    Namespace(String),
}

/// Who is examined.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum LiveProgram {
    /// A program that is started afresh for each scenario.
    Started {
        /// Its file.
        program: OsString,
        /// Its arguments.
        args: Vec<OsString>,
    },
    /// Something that is on the bus all the time.
    Attached,
}
