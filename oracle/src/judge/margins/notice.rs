//! Where the judge notices what is worth keeping.

use adsdv_spec::messages::{Ai2VcuStatus, DirectionRequest, MissionStatus, Vcu2AiWheelSpeeds};
use adsdv_spec::{AsState, Fault, Truth};

use super::super::ai::AT_SPEED;
use super::super::{Judge, MS, STEER, WHEEL_SPEEDS, lenient};
use super::kept::{Go, Peak, Reaction, lower, raise};

/// The field of 523h with the angle of the front wheels.
pub(super) const ANGLE: &str = "steer_angle";

impl Judge {
    /// More time has passed between two frames of a message than ever before.
    #[cold]
    pub(in crate::judge) fn longer_gap(&mut self, index: usize, before: i64, t: i64) {
        let gap = t - before;
        let silent = self.margins.whole_since.is_some_and(|since| before < since);
        let past = self.watched_limit(index).is_some_and(|limit| gap > limit);
        if !silent && (!past || self.is_reported_missed(index)) {
            self.margins.gap(index, gap, t);
        }
    }

    /// The AI Computer sends another status. `previous` is the one before, if it is certain that there was none in between.
    pub(in crate::judge) fn notice_declared(
        &mut self,
        t: i64,
        now: Ai2VcuStatus,
        previous: Option<Ai2VcuStatus>,
    ) {
        let finished = |status: Ai2VcuStatus| status.mission_status == MissionStatus::Finished;
        let neutral = |status: Ai2VcuStatus| status.direction_request == DirectionRequest::Neutral;
        let limit = i64::from(self.edition.rules.thresholds.wheel_speed.raw());
        let begins = [
            finished(now) && previous.is_some_and(|before| !finished(before)),
            neutral(now) && previous.is_some_and(|before| !neutral(before)),
        ];
        if self.vcu.state != Some(AsState::Driving) || begins == [false; 2] {
            return;
        }
        let Some(speed) = self.wheel_speed().filter(|&speed| speed <= limit) else { return };
        if begins[0] && speed < limit {
            self.exercise_finished();
        }
        let kept = self.margins.speeds.iter_mut().zip(begins).filter(|(_, begins)| *begins);
        kept.for_each(|(kept, _)| raise(kept, Peak { value: speed, t }));
    }

    /// The AI Computer does, as far as is seen yet, what section 3.7 forbids while moving.
    pub(in crate::judge) fn notice_at_speed(&mut self, t: i64, index: usize) {
        let speed = self.wheel_speed();
        if let Some(kept) = self.margins.too_fast.get_mut(index) {
            *kept = speed.map(|value| Peak { value, t });
        }
    }

    /// That is reported.
    pub(in crate::judge) fn was_at_speed(&mut self, fault: Fault) {
        if let Some(index) = AT_SPEED.iter().position(|&other| other == fault) {
            self.margins.is_too_fast(index);
        }
    }

    /// The AI Computer answered an edge. Whether an answer past the limit was late, the watch of the handshake tells.
    #[inline]
    pub(in crate::judge) fn notice_answer(&mut self, t: i64, after: i64) {
        if after <= self.handshake_limit() {
            self.margins.answered(t, after);
        }
    }

    /// The speed of the fastest wheel, in raw steps.
    fn wheel_speed(&self) -> Option<i64> {
        let slot = self.slots.get(WHEEL_SPEEDS).filter(|slot| slot.fresh && slot.bad == 0)?;
        let read = lenient::decode::<Vcu2AiWheelSpeeds>(&self.edition.bus, slot.word.to_le_bytes());
        Some(read.message.fastest().raw().into())
    }

    /// The VCU shows another state; `before` is when it showed the old one last, and `gap` tells whether a frame may be missing
    /// in between.
    pub(in crate::judge) fn notice_change(
        &mut self,
        t: i64,
        from: AsState,
        to: AsState,
        before: i64,
        gap: bool,
    ) {
        if to == AsState::EmergencyBrake && !gap {
            self.notice_reaction(t, from);
        }
        let ready_since = self.margins.ready_since.take();
        if (from, to) == (AsState::Ready, AsState::Driving) {
            let dwell = ready_since.map(|since| t - since);
            self.margins.going = Some(Go { t, angle: self.steer_angle(), dwell });
        }
        if to == AsState::Ready {
            self.margins.ready_since = Some(before);
        }
    }

    fn notice_reaction(&mut self, t: i64, from: AsState) {
        let Some(due) = self.margins.due.filter(|due| due.way.to == AsState::EmergencyBrake && due.since < t)
        else {
            return;
        };
        let took = t - due.since;
        if took <= self.deadline || due.reported {
            let took = Peak { value: took, t };
            self.margins.reacted(Reaction { took, way: due.way, from });
        }
    }

    /// The angle of the front wheels to either side, in raw steps.
    fn steer_angle(&self) -> Option<i64> {
        let slot = self.slots.get(STEER).filter(|slot| slot.fresh)?;
        let signal = slot.def?.signal_of(ANGLE)?;
        let raw = signal.raw(&slot.word.to_le_bytes()).filter(|&raw| signal.allows(raw))?;
        Some(i64::from(raw).abs())
    }

    /// Whether the change of state at `t` was right, as far as is known.
    pub(in crate::judge) fn judged_change(&mut self, t: i64, justified: Truth) {
        let Some(Go { angle, dwell, .. }) = self.margins.going.take_if(|going| going.t == t) else { return };
        let rules = &self.edition.rules;
        let (straight, least) = (rules.thresholds.straight.raw(), rules.timing.ready_dwell_ms);
        let wrong = justified == Truth::False;
        if let Some(value) = angle.filter(|&angle| wrong || angle < straight.into()) {
            raise(&mut self.margins.angle, Peak { value, t });
        }
        if let Some(value) = dwell.filter(|&dwell| wrong || dwell >= i64::from(least) * MS) {
            lower(&mut self.margins.dwell, Peak { value, t });
        }
    }

    /// Nothing is known of what came before.
    pub(in crate::judge) fn notice_unknown_state(&mut self) {
        self.margins.ready_since = None;
        self.margins.going = None;
    }

    /// The end of the log: what has not come until now, though it was reported.
    pub(in crate::judge) fn notice_end(&mut self, end: i64) {
        for index in 0..self.slots.len() {
            let last = self.slots.get(index).and_then(|slot| slot.last);
            if let Some(last) = last.filter(|_| self.is_reported_missed(index)) {
                self.margins.gap(index, end - last, end);
            }
        }
        if let Some(waited) = self.handshake.unanswered(end).filter(|_| self.handshake.is_reported()) {
            self.margins.answered(end, waited);
        }
    }
}
