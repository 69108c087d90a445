//! A disturbance that takes its course.

use adsdv_spec::messages::{Frame, Vcu2AiStatus};
use adsdv_spec::{Edition, Vehicle};

use crate::disturbance::{Disturbance, Effect};
use crate::look::Look;

/// A disturbance, and since when it takes its course.
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
        if self.since.is_none() && self.disturbance.from.is_there(look) {
            self.since = Some(look.time_ms);
        }
    }

    fn lasts(&self, time_ms: u64) -> bool {
        let Disturbance { after_ms, for_ms, .. } = self.disturbance;
        let Some(begins) = self.since.map(|since| since.saturating_add(after_ms)) else { return false };
        (begins..begins.saturating_add(for_ms)).contains(&time_ms)
    }

    /// What the sensors show at this time.
    pub(crate) fn falsify(&self, time_ms: u64, vehicle: &mut Vehicle) {
        if let Effect::Sensors(sensors) = self.disturbance.effect
            && self.lasts(time_ms)
        {
            sensors.falsify(vehicle);
        }
    }

    /// When the frames of the cycle at this time come, if they come at all; what they say may be changed.
    pub(crate) fn frames(&mut self, time_ms: u64, edition: &Edition, frames: &mut [Frame]) -> Option<u64> {
        if !self.lasts(time_ms) {
            self.held = None;
            return Some(time_ms);
        }
        match self.disturbance.effect {
            Effect::Loses(every) if (time_ms / 10).is_multiple_of(every.max(1)) => None,
            Effect::Silences => None,
            Effect::Delays(ms) => Some(time_ms.saturating_add(ms)),
            Effect::Gathers(ms) => {
                let wait = ms.max(1) - time_ms % ms.max(1);
                Some(if wait == ms.max(1) { time_ms } else { time_ms.saturating_add(wait) })
            }
            Effect::HoldsHandshake => {
                self.hold(edition, frames);
                Some(time_ms)
            }
            Effect::Loses(_) | Effect::Sensors(_) => Some(time_ms),
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
