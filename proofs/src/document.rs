//! The edition of theorems that name none. The theorems of others say which one they are about.

use adsdv_spec::{Edition, Machine};

/// The edition.
pub(crate) const EDITION: &Edition = Edition::DEFAULT;

/// Its state machine, with its default readings.
pub(crate) const MACHINE: &Machine = &Machine::new(*EDITION, EDITION.readings);

/// Its layouts.
pub(crate) use adsdv_spec::editions::V3_0 as Layouts;
