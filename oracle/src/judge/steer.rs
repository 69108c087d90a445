//! The limit of the steer angle: each version of the document has one of its own, and the VCU shows the one in force.

use adsdv_spec::Edition;
use adsdv_spec::messages::SignalDef;

use super::{Judge, STEER};

/// The field of 523h that shows the limit.
const LIMIT: &str = "steer_angle_max";

/// The fields that it limits, of 513h and 523h.
const LIMITED: [&str; 3] = ["steer_request", "steer_angle", "steer_angle_request"];

impl Judge {
    /// Whether a value that the edition does not allow is the limit of another edition, or within that limit as the VCU shows it.
    /// Then it is no fault of anybody's that could be told.
    pub(super) fn is_within_another_limit(&self, signal: &SignalDef, raw: i32) -> bool {
        match signal.field {
            LIMIT => is_some_limit(raw),
            field if LIMITED.contains(&field) => self.limit_shown().is_some_and(|limit| raw.abs() <= limit),
            _ => false,
        }
    }

    /// The limit that the VCU showed last.
    fn limit_shown(&self) -> Option<i32> {
        let slot = self.slots.get(STEER)?;
        let limit = slot.def?.signal_of(LIMIT)?.raw(&slot.word.to_le_bytes())?;
        (slot.last.is_some() && is_some_limit(limit)).then_some(limit)
    }
}

/// Whether any edition allows this limit.
fn is_some_limit(raw: i32) -> bool {
    let limits = Edition::ALL.iter().filter_map(|edition| edition.bus.signal_of(LIMIT));
    { limits }.any(|limit| limit.allows(raw))
}
