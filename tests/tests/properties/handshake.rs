//! The handshake, by a clock on the wall.

use adsdv_spec::messages::ShutdownCause;
use adsdv_spec::{Choice, Fault, Readings, Timing};

use crate::run::{Property, Seen};

/// AI_COMMS_LOST is shown while the VCU's bit has been unanswered for its time, and otherwise only as the cause that shut the
/// vehicle down; and the bit turns exactly when it is answered.
//= HS-4, HS-9, HS-13, HS-15, HS-16, D-8, D-18, D-26, D-44
pub(crate) struct Handshake {
    timing: Timing,
    always: bool,
    bit: bool,
    /// When the bit began to wait for its answer; `None` while there is no handshake.
    waits_since_ms: Option<u64>,
}

impl Handshake {
    pub(crate) fn new(timing: Timing, readings: Readings) -> Self {
        Self { timing, always: readings.is(Choice::HandshakeAlways), bit: false, waits_since_ms: None }
    }
}

impl Property for Handshake {
    fn see(&mut self, seen: &Seen<'_>) -> Result<(), String> {
        if seen.power_cycled {
            (self.bit, self.waits_since_ms) = (false, None);
        }
        let active = seen.inputs.tsms || self.always;
        let answered = active && seen.inputs.ai.status.handshake == self.bit;
        self.bit = active && self.bit != answered;
        self.waits_since_ms = match self.waits_since_ms {
            _ if !active => None,
            Some(since_ms) if !answered => Some(since_ms),
            _ => Some(seen.t_ms),
        };
        if seen.outputs.handshake != self.bit {
            return Err(format!("HANDSHAKE is {}, answered: {answered}", u8::from(seen.outputs.handshake)));
        }
        let waited_ms = self.waits_since_ms.map_or(0, |since_ms| seen.t_ms - since_ms);
        let lost = waited_ms >= self.timing.handshake_ms.into();
        let is_cause = seen.outputs.shutdown_cause == ShutdownCause::AiCommsFault;
        if seen.outputs.faults.has(Fault::AiCommsFault) != (lost || is_cause) {
            let shown = if lost { "is not" } else { "is" };
            return Err(format!(
                "the AI Computer has not answered for {waited_ms} ms, and AI_COMMS_LOST {shown} shown"
            ));
        }
        Ok(())
    }
}
