//! What one edition changes of another, as data.

use adsdv_spec::{Bus, Edition, Rules};
use serde::Serialize;

use super::change::{Change, Parts, Sides};
use super::devices::{self, DeviceOutline};
use super::faults::{self, CauseOutline, FaultOutline};
use super::figure2::{self, ArrowChange, ArrowOutline, OrderChange, PriorityOutline};
use super::messages::{self, MessageChange, MessageOutline};
use super::numbers;
use super::questions::{self, Questions};
use super::reserved::{self, Range};

/// What one edition changes of another.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct Difference {
    /// The version of the edition before.
    pub(super) from: &'static str,
    /// The version of the edition after.
    pub(super) to: &'static str,
    /// Whether anything is new, gone or changed.
    pub(super) differs: bool,
    #[serde(flatten)]
    pub(super) changed: Changed,
}

/// The parts of an edition.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct Changed {
    pub(super) messages: Parts<MessageOutline, MessageChange>,
    pub(super) arrows: Parts<ArrowOutline, ArrowChange>,
    pub(super) order: Vec<OrderChange>,
    pub(super) priorities: Sides<PriorityOutline>,
    pub(super) timing: Vec<Change>,
    pub(super) thresholds: Vec<Change>,
    pub(super) faults: Sides<FaultOutline>,
    pub(super) causes: Sides<CauseOutline>,
    pub(super) reserved: Sides<Range>,
    pub(super) devices: Sides<DeviceOutline>,
    pub(super) readings: Questions,
}

impl Difference {
    /// What the second edition changes of the first.
    pub(super) fn between(from: &Edition, to: &Edition) -> Self {
        // Without `..`, so that a further field has to be compared before this compiles. How frames are read and written
        // follows from the messages, and where the answers by default matter they stand with their questions. The requirements
        // say in sentences what all the others are.
        let Edition { version, document: _, rules, faults, choices: _, readings: _, bus, requirements: _ } =
            from;
        let Rules { table: _, priorities: _, timing, thresholds } = rules;
        // What asks for them differs where they do.
        let Bus {
            messages,
            devices,
            reserved: _,
            cycles: _,
            lengths: _,
            senders: _,
            read: _,
            write: _,
            holds: _,
        } = bus;
        let (arrows, order) = figure2::compare(from, to);
        let changed = Changed {
            messages: messages::compare(messages, to.bus.messages),
            arrows,
            order,
            priorities: figure2::priorities(from, to),
            timing: numbers::timing(timing, &to.rules.timing),
            thresholds: numbers::thresholds(thresholds, &to.rules.thresholds),
            faults: faults::compare(*faults, to.faults),
            causes: faults::causes(bus, &to.bus),
            reserved: reserved::compare(bus, &to.bus),
            devices: devices::compare(devices, to.bus.devices),
            readings: questions::compare(from, to),
        };
        Self { from: version, to: to.version, differs: !changed.is_empty(), changed }
    }
}

impl Changed {
    fn is_empty(&self) -> bool {
        let Self {
            messages,
            arrows,
            order,
            priorities,
            timing,
            thresholds,
            faults,
            causes,
            reserved,
            devices,
            readings,
        } = self;
        messages.is_empty()
            && arrows.is_empty()
            && order.is_empty()
            && priorities.is_empty()
            && timing.is_empty()
            && thresholds.is_empty()
            && faults.is_empty()
            && causes.is_empty()
            && reserved.is_empty()
            && devices.is_empty()
            && readings.is_empty()
    }
}
