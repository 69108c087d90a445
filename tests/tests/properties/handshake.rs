//! The handshake, by a clock on the wall, and the messages that are missed.

use adsdv_conform::protocol::INPUTS;
use adsdv_spec::messages::ShutdownCause;
use adsdv_spec::{Choice, Edition, Fault, Inputs};

use crate::operations::{Run, SILENCES};
use crate::run::{Property, Seen};

/// AI_COMMS_LOST is shown while the VCU's bit has been unanswered for its time, or, in an edition that watches messages, while one
/// has been missing for its time and is watched; and otherwise only as the cause that shut the vehicle down. The bit turns exactly
/// when it is answered.
//= HS-4, HS-9, HS-13, HS-15 to HS-18, D-8, D-18, D-26, D-44, D-51
pub(crate) struct Handshake {
    limit_ms: u64,
    missed_ms: Option<u16>,
    always: bool,
    always_watched: bool,
    bit: bool,
    /// When the bit began to wait for its answer; `None` while there is no handshake.
    waits_since_ms: Option<u64>,
}

impl Handshake {
    pub(crate) fn new(run: &Run) -> Self {
        let Run { edition: Edition { rules, .. }, readings, .. } = run;
        Self {
            limit_ms: rules.timing.handshake_ms.into(),
            missed_ms: rules.thresholds.missed_ms,
            always: readings.is(Choice::HandshakeAlways),
            always_watched: readings.is(Choice::WatchAlways),
            bit: false,
            waits_since_ms: None,
        }
    }

    /// Whether a message has been missing for its time.
    fn misses(&self, inputs: &Inputs) -> bool {
        let silences = INPUTS.iter().filter(|field| field.part == SILENCES).map(|field| (field.get)(inputs));
        silences.max().zip(self.missed_ms).is_some_and(|(longest_ms, limit_ms)| longest_ms >= limit_ms.into())
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
        let missed = self.misses(seen.inputs) && (active || self.always_watched);
        let lost = waited_ms >= self.limit_ms || missed;
        let is_cause = seen.outputs.shutdown_cause == ShutdownCause::AiCommsFault;
        if seen.outputs.faults.has(Fault::AiCommsFault) != (lost || is_cause) {
            let shown = if lost { "is not" } else { "is" };
            return Err(format!(
                "the AI Computer has not answered for {waited_ms} ms, missed: {missed}, and AI_COMMS_LOST {shown} shown"
            ));
        }
        Ok(())
    }
}
