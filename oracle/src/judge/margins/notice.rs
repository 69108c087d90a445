//! Where the judge notices what is worth keeping.

use adsdv_spec::messages::{Ai2VcuStatus, DirectionRequest, MissionStatus, Vcu2AiWheelSpeeds};
use adsdv_spec::{AsState, Fault, Truth};

use super::kept::{AT_SPEED, Go, Peak, Reaction, lower, raise};
use crate::judge::book::Book;
use crate::judge::estimator::base::Estimator;
use crate::judge::estimator::status::SeenChange;
use crate::judge::sampler::places::{STEER, WHEEL_SPEEDS};
use crate::judge::time::MS;

/// The field of 523h with the angle of the front wheels.
pub(super) const ANGLE: &str = "steer_angle";

impl Book {
    /// More time has passed between two frames of a message than ever before.
    #[cold]
    pub(in crate::judge) fn longer_gap(
        &mut self,
        est: &Estimator,
        missed: bool,
        index: usize,
        before: i64,
        t: i64,
    ) {
        let gap = t - before;
        let silent = self.margins.whole_since.is_some_and(|since| before < since);
        let past = est.silences.limit_of(index).is_some_and(|limit| gap > limit);
        if !silent && (!past || missed) {
            self.margins.gap(index, gap, t);
        }
    }

    /// The AI Computer sends another status. `previous` is the one before, if it is certain that there was none in between.
    pub(in crate::judge) fn notice_declared(
        &mut self,
        est: &Estimator,
        t: i64,
        now: Ai2VcuStatus,
        previous: Option<Ai2VcuStatus>,
    ) {
        let finished = |status: Ai2VcuStatus| status.mission_status == MissionStatus::Finished;
        let neutral = |status: Ai2VcuStatus| status.direction_request == DirectionRequest::Neutral;
        let limit = i64::from(est.edition.rules.thresholds.wheel_speed.raw());
        let begins = [
            finished(now) && previous.is_some_and(|before| !finished(before)),
            neutral(now) && previous.is_some_and(|before| !neutral(before)),
        ];
        if est.vcu.state != Some(AsState::Driving) || begins == [false; 2] {
            return;
        }
        let Some(speed) = wheel_speed(est).filter(|&speed| speed <= limit) else { return };
        if begins[0] && speed < limit {
            self.exercise_finished();
        }
        let kept = self.margins.speeds.iter_mut().zip(begins).filter(|(_, begins)| *begins);
        kept.for_each(|(kept, _)| raise(kept, Peak { value: speed, t }));
    }

    /// The AI Computer does, as far as is seen yet, what is forbidden; of some of it the speed is kept.
    pub(in crate::judge) fn notice_forbidden(&mut self, est: &Estimator, t: i64, fault: Fault) {
        let speed = wheel_speed(est);
        let kept = AT_SPEED.into_iter().zip(&mut self.margins.too_fast).find(|(other, _)| *other == fault);
        if let Some((_, kept)) = kept {
            *kept = speed.map(|value| Peak { value, t });
        }
    }

    /// That is reported.
    pub(in crate::judge) fn was_forbidden(&mut self, fault: Fault) {
        if let Some(index) = AT_SPEED.iter().position(|&other| other == fault) {
            self.margins.is_too_fast(index);
        }
    }

    /// The AI Computer answered an edge. Whether an answer past the limit was late, the watch of the handshake tells.
    #[inline]
    pub(in crate::judge) fn answered(&mut self, t: i64, after: i64, limit: i64) {
        self.out.responses.add(after);
        if after <= limit {
            self.margins.answered(t, after);
        }
    }

    /// The VCU shows another state.
    pub(in crate::judge) fn notice_change(&mut self, est: &Estimator, t: i64, change: &SeenChange) {
        let &SeenChange { from, to, before, gap, .. } = change;
        if to == AsState::EmergencyBrake && !gap {
            self.notice_reaction(est, t, from);
        }
        let ready_since = self.margins.ready_since.take();
        if (from, to) == (AsState::Ready, AsState::Driving) {
            let dwell = ready_since.map(|since| t - since);
            self.margins.going = Some(Go { t, angle: steer_angle(est), dwell });
        }
        if to == AsState::Ready {
            self.margins.ready_since = Some(before);
        }
    }

    fn notice_reaction(&mut self, est: &Estimator, t: i64, from: AsState) {
        let due = self.margins.due.filter(|(since, way, _)| way.to == AsState::EmergencyBrake && *since < t);
        let Some((since, way, reported)) = due else { return };
        let took = t - since;
        if took <= est.deadline || reported {
            self.margins.reacted(Reaction { took: Peak { value: took, t }, way, from });
        }
    }

    /// Whether the change of state at `t` was right, as far as is known.
    pub(in crate::judge) fn judged_change(&mut self, est: &Estimator, t: i64, justified: Truth) {
        let Some(Go { angle, dwell, .. }) = self.margins.going.take_if(|going| going.t == t) else { return };
        let rules = &est.edition.rules;
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
    pub(in crate::judge) fn notice_end(&mut self, est: &Estimator, missed: &[bool], end: i64) {
        for (index, _) in missed.iter().enumerate().filter(|(_, missed)| **missed) {
            if let Some(last) = est.sampler.last(index) {
                self.margins.gap(index, end - last, end);
            }
        }
        if let Some(waited) = est.handshake.unanswered(end).filter(|_| est.handshake.reported_ai) {
            self.margins.answered(end, waited);
        }
    }
}

/// The speed of the fastest wheel, in raw steps.
fn wheel_speed(est: &Estimator) -> Option<i64> {
    let slot = est.sampler.slot(WHEEL_SPEEDS).filter(|slot| slot.fresh && slot.bad == 0)?;
    let read: Vcu2AiWheelSpeeds = est.edition.bus.decode_as(&slot.word.to_le_bytes()).ok()?;
    Some(read.fastest().raw().into())
}

/// The angle of the front wheels to either side, in raw steps.
fn steer_angle(est: &Estimator) -> Option<i64> {
    let slot = est.sampler.slot(STEER).filter(|slot| slot.fresh)?;
    let signal = slot.def?.signal_of(ANGLE)?;
    let raw = signal.raw(&slot.word.to_le_bytes()).filter(|&raw| signal.allows(raw))?;
    Some(i64::from(raw).abs())
}
