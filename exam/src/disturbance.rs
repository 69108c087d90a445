//! What goes wrong beside the AI Computer: frames of the VCU that do not come as they should, and sensors that lie.
//!
//! Whatever happens to frames of the VCU happens before they are on the bus, so that the judge sees what the AI Computer sees.

use adsdv_spec::messages::{Frame, Vcu2AiStatus};
use adsdv_spec::{Edition, Vehicle};

use crate::expectation::Condition;
use crate::look::Look;

/// Something that goes wrong, once in a scenario.
#[derive(Clone, Copy, Debug)]
pub struct Disturbance {
    /// It waits for this,
    pub from: Condition,
    /// then for so many milliseconds,
    pub after_ms: u64,
    /// and lasts for so many.
    pub for_ms: u64,
    /// What goes wrong.
    pub what: What,
}

/// The kinds of disturbances.
#[derive(Clone, Copy, Debug)]
pub enum What {
    /// The VCU's messages of each so manieth cycle are lost.
    Loses(u64),
    /// They come so many milliseconds late.
    Delays(u64),
    /// They come together, every so many milliseconds.
    Gathers(u64),
    /// None comes.
    Silences,
    /// HANDSHAKE of 520h stays as it is.
    HoldsHandshake,
    /// The sensors show something else.
    Sensors(fn(&mut Vehicle)),
}

/// A disturbance that takes its course.
#[derive(Clone, Debug)]
pub(crate) struct Course {
    disturbance: Disturbance,
    since: Option<u64>,
    held: Option<i32>,
}

impl Course {
    pub(crate) fn new(disturbance: &Disturbance) -> Self {
        Self { disturbance: *disturbance, since: None, held: None }
    }

    pub(crate) fn look(&mut self, look: &Look) {
        if self.since.is_none() && (self.disturbance.from)(look) {
            self.since = Some(look.time_ms);
        }
    }

    fn lasts(&self, time_ms: u64) -> bool {
        let Disturbance { after_ms, for_ms, .. } = self.disturbance;
        let Some(begins) = self.since.map(|since| since + after_ms) else { return false };
        (begins..begins + for_ms).contains(&time_ms)
    }

    /// What the sensors show at this time.
    pub(crate) fn falsify(&self, time_ms: u64, vehicle: &mut Vehicle) {
        if let What::Sensors(falsify) = self.disturbance.what
            && self.lasts(time_ms)
        {
            falsify(vehicle);
        }
    }

    /// When the frames of the cycle at this time come, if they come at all; what they say may be changed.
    pub(crate) fn frames(&mut self, time_ms: u64, edition: &Edition, frames: &mut [Frame]) -> Option<u64> {
        if !self.lasts(time_ms) {
            self.held = None;
            return Some(time_ms);
        }
        match self.disturbance.what {
            What::Loses(every) if (time_ms / 10).is_multiple_of(every.max(1)) => None,
            What::Silences => None,
            What::Delays(ms) => Some(time_ms + ms),
            What::Gathers(ms) => Some(time_ms.next_multiple_of(ms.max(1))),
            What::HoldsHandshake => {
                self.hold(edition, frames);
                Some(time_ms)
            }
            What::Loses(_) | What::Sensors(_) => Some(time_ms),
        }
    }

    fn hold(&mut self, edition: &Edition, frames: &mut [Frame]) {
        let signal = edition.bus.message(Vcu2AiStatus::ID).and_then(|message| message.signal_of("handshake"));
        for frame in frames.iter_mut().filter(|frame| frame.id == Vcu2AiStatus::ID) {
            if let Some((signal, raw)) = signal.and_then(|signal| Some((signal, signal.raw(&frame.data)?))) {
                frame.data = signal.put(frame.data, *self.held.get_or_insert(raw));
            }
        }
    }
}
