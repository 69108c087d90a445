//! The faults that 520h shows, and the numbers by which it names one as the cause of a shutdown.

use adsdv_spec::{Bus, Faults};
use serde::Serialize;

use super::change::Sides;

/// The field of 520h that carries the cause.
const CAUSE: &str = "shutdown_cause";

/// A fault.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct FaultOutline {
    /// The signal that is its flag.
    pub(super) flag: &'static str,
    /// Its number as the cause of a shutdown, whether or not the edition has that among its causes.
    pub(super) cause: u8,
}

/// A cause of a shutdown.
#[derive(Clone, Debug, Serialize)]
pub(super) struct CauseOutline {
    pub(super) value: i32,
    pub(super) name: &'static str,
}

/// A cause is its number: how an edition spells it stands with the signal.
impl PartialEq for CauseOutline {
    fn eq(&self, other: &Self) -> bool {
        self.value == other.value
    }
}

/// The faults that are new or gone.
pub(super) fn compare(from: Faults, to: Faults) -> Sides<FaultOutline> {
    let outlines = |faults: Faults| {
        let outline =
            |fault: adsdv_spec::Fault| FaultOutline { flag: fault.flag(), cause: fault.cause() as u8 };
        faults.iter().map(outline).collect::<Vec<_>>()
    };
    Sides::of(&outlines(from), &outlines(to))
}

/// The causes that are new or gone.
pub(super) fn causes(from: &Bus, to: &Bus) -> Sides<CauseOutline> {
    let causes = |bus: &Bus| {
        let values = bus.signal_of(CAUSE).map(|signal| signal.values).unwrap_or_default();
        values.iter().map(|&(value, name)| CauseOutline { value, name }).collect::<Vec<_>>()
    };
    Sides::of(&causes(from), &causes(to))
}
