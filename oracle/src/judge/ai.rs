//! The AI Computer's conduct: the handshake, FINISHED and NEUTRAL at speed, and requests that hold the vehicle.

use adsdv_spec::messages::{Ai2VcuStatus, DirectionRequest, MissionStatus};
use adsdv_spec::{AsState, Atom, Atoms, Fault, Truth};

use super::events::{Pending, PendingKind, milliseconds};
use super::exercised::{ANSWERS, FINISHES_AT_REST};
use super::finding::{Finding, Party, Rule, Severity};
use super::scope::scope;
use super::transitions::conditions;
use super::{AI_STATUS, Judge, STATUS};

/// What the judge keeps of the AI Computer.
#[derive(Debug, Default)]
pub(super) struct AiSide {
    status: Option<Ai2VcuStatus>,
    /// Whether the AI Computer was doing this at speed already, as far as that is reported or looked at.
    at_speed: [bool; 2],
    /// Since when requests hold the vehicle in AS_READY.
    held_since: Option<i64>,
    held_reported: bool,
    /// Whether the AI Computer asks for torque and for brakes at once, as far as that is reported or looked at.
    pub(super) brakes_and_drives: bool,
}

impl AiSide {
    /// The VCU is in another state, or in one that is known anew.
    pub(super) fn entered(&mut self) {
        self.at_speed = [false; 2];
        self.held_since = None;
        self.held_reported = false;
        self.brakes_and_drives = false;
    }
}

/// What section 3.7 forbids the AI Computer while the vehicle is moving.
pub(super) const AT_SPEED: [Fault; 2] = [Fault::MissionStatusFault, Fault::AutonomousBrakingFault];

/// What decides it.
pub(super) const AT_SPEED_ATOMS: Atoms =
    scope(AI_STATUS).union(adsdv_spec::messages::Vcu2AiWheelSpeeds::SCOPE);

impl Judge {
    /// Whether the AI Computer ever sent its status.
    pub(super) fn ai_was_heard(&self) -> bool {
        self.slots.get(AI_STATUS).is_some_and(|slot| slot.last.is_some())
    }

    /// 510h came with something new. `continuous` tells whether the frame before is known, too.
    pub(super) fn ai_status(&mut self, t: i64, status: Ai2VcuStatus, continuous: bool) {
        let previous = self.ai.status.replace(status).filter(|_| continuous);
        let mut known = self.known.learn(scope(AI_STATUS), status.atoms());
        let driving = self.vcu.state == Some(AsState::Driving);
        let finished = |s: Ai2VcuStatus| s.mission_status == MissionStatus::Finished;
        let running = |s: Ai2VcuStatus| s.mission_status == MissionStatus::Running;
        let neutral = |s: Ai2VcuStatus| s.direction_request == DirectionRequest::Neutral;
        let forward = |s: Ai2VcuStatus| s.direction_request == DirectionRequest::Forward;
        for (edge, is, was) in [
            (Atom::MissionFinishedEdge, finished(status), previous.map(|p| (finished(p), running(p)))),
            (Atom::DirectionNeutralEdge, neutral(status), previous.map(|p| (neutral(p), forward(p)))),
        ] {
            let truth = match was {
                _ if !is || !driving => Truth::False,
                Some((true, _)) => continue,
                Some((_, false)) => Truth::False,
                // At rest it does no harm, but when the VCU sees it the vehicle may move.
                Some((_, true)) => Truth::Unknown.or(known.of(Atom::Moving)),
                None => Truth::Unknown,
            };
            known = known.set(edge, truth);
            self.change_seen(t, edge, truth);
        }
        // Where the frame before is not known, the flag may have been shown and taken back.
        if driving && status.estop_request && previous.is_some_and(|p| !p.estop_request) {
            self.vcu.estop_since = Some(t);
        }
        if !status.estop_request {
            self.vcu.estop_since = None;
        }
        self.notice_declared(t, status, previous);
        self.learn(t, known);
        self.answer(t, status.handshake);
    }

    /// 510h came again with the same content.
    #[inline]
    pub(super) fn answer_repeated(&mut self, t: i64) {
        if let Some(status) = self.ai.status {
            self.answer(t, status.handshake);
        }
    }

    /// The AI Computer's handshake bit was seen.
    pub(super) fn answer(&mut self, t: i64, bit: bool) {
        if let Some(response) = self.meter.ai(t, bit) {
            self.out.responses.add(response);
            self.notice_answer(t, response);
        }
        if self.handshake.ai(t, bit) {
            self.answered(t);
        }
    }

    #[cold]
    fn answered(&mut self, t: i64) {
        let limit = self.handshake_limit();
        if self.handshake.response().is_some_and(|response| response > limit) {
            // Too late on the bus. If the VCU saw it in time all the same, it is no more than worth a look.
            let told = self.vcu.shows_comms_lost();
            self.report_ai_late(t, if told { Severity::Violation } else { Severity::Warning });
            self.margins.answered(t, self.handshake.response().unwrap_or_default());
        }
        self.update_comms(t);
    }

    pub(super) fn report_ai_late(&mut self, t: i64, severity: Severity) {
        let Some(edge) = self.handshake.edge_at() else { return };
        if !self.handshake.report_ai() {
            return;
        }
        let limit = i64::from(self.edition.rules.timing.handshake_ms);
        let told = if self.vcu.shows_comms_lost() { ", and the VCU has raised AI_COMMS_LOST" } else { "" };
        let waited = milliseconds(t - edge);
        let t_ns = t.min(edge + self.handshake_limit());
        let finding = Finding::new(severity, Party::Ai, "2.4", Rule::HandshakeLate, t_ns)
            .against(&[ANSWERS])
            .seen(format!("the AI Computer has not answered HANDSHAKE for {waited:.0} ms{told}"))
            .expected(format!("an answer within {limit} ms"))
            .shown_by(self.last_frames(&[STATUS, AI_STATUS]));
        self.found(finding);
    }

    /// The VCU says that communication is lost, and it is: unless the log shows an answer in time, the AI Computer is at
    /// fault. Before the time is up, nobody can tell.
    pub(super) fn ai_was_silent(&mut self, t: i64) {
        let seen = self.ai_was_heard();
        let told = self.vcu.shows_comms_lost();
        let limit = self.handshake_limit();
        if seen && told && self.handshake.unanswered(t).is_some_and(|waited| waited >= limit) {
            let off = matches!(self.vcu.state, Some(AsState::Off) | None);
            self.report_ai_late(t, if off { Severity::Warning } else { Severity::Violation });
        }
    }

    /// Something has changed: does the AI Computer begin what it must not do at speed, or hold the vehicle?
    pub(super) fn consider_speed(&mut self, t: i64, state: AsState) {
        if state == AsState::Driving {
            for (index, fault) in AT_SPEED.into_iter().enumerate() {
                let Some(&before) = self.ai.at_speed.get(index) else { continue };
                let now = match self.does(fault) {
                    Truth::True if !before => {
                        self.notice_at_speed(t, index);
                        self.suspend(
                            t,
                            self.wait_for(AT_SPEED_ATOMS),
                            self.known,
                            PendingKind::AtSpeed(fault),
                        );
                        true
                    }
                    Truth::True => true,
                    // It has not ended only because a frame is missing.
                    Truth::Unknown => before,
                    Truth::False => false,
                };
                if let Some(at_speed) = self.ai.at_speed.get_mut(index) {
                    *at_speed = now;
                }
            }
        }
        let holds = state == AsState::Ready
            && self.known.of(Atom::DwellElapsed) == Truth::True
            && !self.requests.intersection(self.known.off()).is_empty();
        match (holds, self.ai.held_since) {
            (true, None) => {
                self.ai.held_since = Some(t);
                self.wake_at(self.held_event());
            }
            (false, _) => self.ai.held_since = None,
            _ => {}
        }
    }

    /// Whether, under some reading, the condition of this fault is true.
    pub(super) fn does(&self, fault: Fault) -> Truth {
        let terms = self.variants.terms(AsState::Driving).iter().filter(|term| term.fault == Some(fault));
        terms.fold(Truth::False, |any, term| any.or(term.truth(self.known)))
    }

    pub(super) fn judge_at_speed(&mut self, pending: &Pending, fault: Fault, now: i64) {
        let t = pending.t;
        if self.left_driving_unseen(t) {
            return;
        }
        let shown = self.slots.get(STATUS).is_some_and(|slot| slot.last.is_some_and(|last| last >= t));
        if !shown {
            // What the VCU's state was then shows only in its next frame, if one comes before all is forgotten.
            let wait = now - t + self.window.max(self.cycle());
            return self.suspend(t, wait, pending.before, PendingKind::AtSpeed(fault));
        }
        let around = self.throughout(t - self.window, t + self.window, now);
        let known = pending.before.set(Atom::Moving, around.of(Atom::Moving));
        let under = |variant: &super::variants::Variant| {
            variant
                .iter()
                .flat_map(|guard| &guard.terms)
                .find(|term| term.fault == Some(fault) && term.truth(known) == Truth::True)
                .copied()
        };
        let terms: Vec<_> = self.variants.of(AsState::Driving).iter().map(under).collect();
        let Some(term) = terms.iter().find_map(|term| *term) else {
            // It may go on, and show more clearly later.
            let index = AT_SPEED.iter().position(|&other| other == fault);
            if let Some(at_speed) = index.and_then(|index| self.ai.at_speed.get_mut(index)) {
                *at_speed = false;
            }
            if let Some(state) = self.vcu.state.filter(|_| self.vcu_is_seen()) {
                self.consider_speed(now, state);
            }
            return;
        };
        let (severity, reservation) = if terms.iter().all(Option::is_some) {
            (Severity::Violation, "")
        } else {
            (Severity::Warning, " (a violation under some readings of the document only)")
        };
        self.was_at_speed(fault);
        // Those of Figure 2 are the VCU's.
        let (rule, broken, expected): (_, &[_], _) = match fault {
            Fault::MissionStatusFault => (Rule::FinishedMoving, &[FINISHES_AT_REST], "FINISHED"),
            _ => (Rule::NeutralMoving, &[], "NEUTRAL"),
        };
        // Section 3.7 is where both readings meet.
        let finding = Finding::new(severity, Party::Ai, "3.7", rule, t)
            .against(broken)
            .seen(format!("{} in AS_DRIVING", conditions(&self.edition.rules, &term, known)))
            .expected(format!("{expected} only once the vehicle has stopped{reservation}"))
            .shown_by(self.deciding_frames(&pending.frames, AT_SPEED_ATOMS));
        self.found(finding);
    }

    /// Whether the VCU may have left AS_DRIVING before `t` in a frame that is missing from the log.
    pub(super) fn left_driving_unseen(&self, t: i64) -> bool {
        self.vcu.left.is_some_and(|left| left.gap && left.before <= t && t <= left.at)
    }

    pub(super) fn held_event(&self) -> i64 {
        match self.ai.held_since {
            Some(since) if !self.ai.held_reported => since + self.deadline,
            _ => i64::MAX,
        }
    }

    pub(super) fn report_held(&mut self) {
        self.ai.held_reported = true;
        let Some(since) = self.ai.held_since else { return };
        let text = |atom| self.edition.rules.text(atom, false).to_string();
        let failed: Vec<String> = self.requests.intersection(self.known.off()).iter().map(text).collect();
        let finding = Finding::warning(Party::Ai, "3.2", Rule::ReadyHeld, since)
            .seen(format!(
                "{} after the dwell of AS_READY: the VCU must not go on to AS_DRIVING",
                failed.join(" and ")
            ))
            .expected("zero requests and NEUTRAL")
            .shown_by(self.deciding_frames(&self.frames(), self.requests));
        self.found(finding);
    }
}
