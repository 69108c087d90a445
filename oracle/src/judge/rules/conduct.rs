//! The AI Computer's conduct: FINISHED and NEUTRAL at speed, torque and brakes at once, and requests that hold the vehicle.
//!
//! Torque and brake requests come in frames of their own, one after the other. So both are there for a moment when one takes the
//! other's place, and that counts only if the VCU itself says that it saw it.

use adsdv_spec::messages::{Ai2VcuBrake, Ai2VcuDriveF, Ai2VcuDriveR, Vcu2AiWheelSpeeds};
use adsdv_spec::{AsState, Atom, Atoms, Fault, Knowledge, Truth};

use super::pending::{Awaited, Pending};
use super::texts::conditions;
use crate::judge::book::Book;
use crate::judge::estimator::base::Estimator;
use crate::judge::estimator::readings::{WayOut, of_terms, section_of, ways};
use crate::judge::exercised::FINISHES_AT_REST;
use crate::judge::finding::{Finding, Party, Rule, Severity};
use crate::judge::margins::AT_SPEED;
use crate::judge::sampler::places::{AI_DRIVE_F, AI_DRIVE_R, AI_STATUS, AI_STEER, STATUS, scope};

/// What the AI Computer must not do in `AS_DRIVING`: what is forbidden while the vehicle is moving, and both requests.
const FORBIDDEN: [Fault; 3] = [AT_SPEED[0], AT_SPEED[1], BOTH];
/// Torque and brakes at once (section 4 of version 4.0).
pub(super) const BOTH: Fault = Fault::BrakePlausibilityFault;

/// The atoms of the AI Computer's messages that section 3.2, item 2, is about, among others.
const AI_SCOPE: Atoms =
    scope(AI_STATUS).union(scope(AI_DRIVE_F)).union(scope(AI_DRIVE_R)).union(scope(AI_STEER));

/// What decides whether a fault is there that the AI Computer causes in `AS_DRIVING`.
pub(super) const fn deciding(fault: Fault) -> Atoms {
    match fault {
        BOTH => Ai2VcuDriveF::SCOPE.union(Ai2VcuDriveR::SCOPE).union(Ai2VcuBrake::SCOPE),
        _ => scope(AI_STATUS).union(Vcu2AiWheelSpeeds::SCOPE),
    }
}

/// That NEUTRAL is not requested at speed: what the VCU has to do about it says so, as each edition has it.
const NEUTRAL_AT_REST: &[&str] = &["DTE-5", "IMP-6"]; //= DTE-5, IMP-6
/// That it does not request to drive and to brake at once: the same.
const BRAKE_OR_TORQUE: &[&str] = &["IMP-8"]; //= IMP-8

/// What is kept of it.
#[derive(Debug, Default)]
pub(super) struct Conduct {
    /// Whether the AI Computer was doing what is forbidden already, as far as that is reported or looked at.
    does: [bool; FORBIDDEN.len()],
    /// Since when requests hold the vehicle in AS_READY, and whether that was reported.
    held_since: Option<i64>,
    held_reported: bool,
}

impl Conduct {
    /// Something has changed: does the AI Computer begin what it must not do, or hold the vehicle? Tells what is to be looked at
    /// when the window has passed, and how long that takes.
    pub(super) fn reconsider(&mut self, est: &Estimator, book: &mut Book, t: i64) -> Vec<(i64, Awaited)> {
        let mut begins = Vec::new();
        let state = est.state_seen();
        for (fault, does) in
            FORBIDDEN.into_iter().zip(&mut self.does).filter(|_| state == Some(AsState::Driving))
        {
            let terms =
                est.readings.ways(AsState::Driving).iter().filter(|way| way.term.fault == Some(fault));
            let now = terms.fold(Truth::False, |any, way| any.or(way.term.truth(est.known)));
            if now == Truth::True && !*does {
                book.notice_forbidden(est, t, fault);
                let more = if fault == BOTH { est.cycle() } else { 0 };
                begins
                    .push((est.sampler.wait_for(deciding(fault)) + more, Awaited::Conduct(fault, est.known)));
            }
            // It has not ended only because a frame is missing.
            *does = now == Truth::True || now == Truth::Unknown && *does;
        }
        let held = state == Some(AsState::Ready)
            && est.known.of(Atom::DwellElapsed) == Truth::True
            && !requests(est).intersection(est.known.off()).is_empty();
        if state.is_some() {
            self.held_since = if held { self.held_since.or(Some(t)) } else { None };
        }
        begins
    }

    /// What may have been forbidden, and its window has passed. Returns for how long to wait on where that is not known yet.
    pub(super) fn judge(
        &mut self,
        est: &Estimator,
        book: &mut Book,
        pending: &Pending,
        (fault, before): (Fault, Knowledge),
    ) -> Option<i64> {
        let t = pending.t;
        let shown = est.sampler.last(STATUS).is_some_and(|last| last >= t);
        if est.left_unseen(t) {
            return None;
        }
        let flagged = est.vcu.status.is_some_and(|status| status.brake_plausibility_fault);
        let known = if fault != BOTH {
            if !shown {
                // What the VCU's state was then shows only in its next frame, if one comes before all is forgotten.
                return Some(est.now - t + est.window.max(est.cycle()));
            }
            before.set(Atom::Moving, est.throughout(t - est.window, t + est.window).of(Atom::Moving))
        } else if flagged {
            before
        } else if shown && est.moments(t, est.now).all(|moment| moment.state == Some(AsState::Driving)) {
            // The VCU was still driving for certain.
            est.throughout(t, t + est.window)
        } else {
            return None;
        };
        let holds = |way: &WayOut| way.term.fault == Some(fault) && way.term.truth(known) == Truth::True;
        let machines = est.readings.of(AsState::Driving);
        let terms: Vec<_> =
            machines.iter().map(|machine| ways(machine, AsState::Driving).find(holds)).collect();
        let Some(WayOut { term, .. }) = terms.iter().find_map(|way| *way) else {
            // It may go on, and show more clearly later.
            if let Some(does) = FORBIDDEN.iter().position(|&other| other == fault && fault != BOTH) {
                self.does[does] = false;
            }
            return None;
        };
        let certain = fault == BOTH && flagged || terms.iter().all(Option::is_some);
        let (severity, reservation) = if certain {
            (Severity::Violation, "")
        } else {
            (Severity::Warning, " (a violation under some readings of the document only)")
        };
        book.was_forbidden(fault);
        let (rule, broken, expected): (_, &[_], _) = match fault {
            Fault::MissionStatusFault => {
                (Rule::FinishedMoving, &[FINISHES_AT_REST], "FINISHED only once the vehicle has stopped")
            }
            BOTH => (Rule::BrakeAndTorque, BRAKE_OR_TORQUE, "no request to drive and to brake at once"),
            _ => (Rule::NeutralMoving, NEUTRAL_AT_REST, "NEUTRAL only once the vehicle has stopped"),
        };
        let asked = |id: &&&str| est.edition.requirements.has(id);
        let broken: Vec<_> = broken.iter().filter(asked).copied().collect();
        let section = section_of(&est.edition, fault);
        let finding = Finding::new(severity, Party::Ai, section, rule, t)
            .against(&broken)
            .seen(format!("{} in AS_DRIVING", conditions(&est.edition.rules, &term, known)))
            .expected(format!("{expected}{reservation}"))
            .shown_by(est.sampler.deciding_frames(&pending.frames, deciding(fault)));
        book.found(finding);
        None
    }

    /// When requests have held the vehicle for too long.
    pub(super) fn next(&self, est: &Estimator) -> i64 {
        self.held_since.filter(|_| !self.held_reported).map_or(i64::MAX, |since| since + est.deadline)
    }

    /// Requests have held the vehicle for too long, if they have.
    pub(super) fn held(&mut self, est: &Estimator) -> Option<Finding> {
        let since = self.held_since?;
        self.held_reported = true;
        let text = |atom| est.edition.rules.text(atom, false).to_string();
        let failed: Vec<String> = requests(est).intersection(est.known.off()).iter().map(text).collect();
        let finding = Finding::warning(Party::Ai, "3.2", Rule::ReadyHeld, since).seen(format!(
            "{} after the dwell of AS_READY: the VCU must not go on to AS_DRIVING",
            failed.join(" and ")
        ));
        let shown_by = est.sampler.deciding_frames(&est.sampler.frames(), requests(est));
        Some(finding.expected("zero requests and NEUTRAL").shown_by(shown_by))
    }
}

/// What section 3.2, item 2, asks of the AI Computer.
fn requests(est: &Estimator) -> Atoms {
    let terms = est.readings.terms(AsState::Ready, AsState::Driving);
    of_terms(terms).intersection(AI_SCOPE)
}
