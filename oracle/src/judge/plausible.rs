//! The AI Computer's torque and brake requests: never both at once (section 4 of version 4.0).
//!
//! They come in frames of their own, one after the other. So both are there for a moment when one takes the other's place, and
//! that counts only if the VCU itself says that it saw it.

use adsdv_spec::messages::{Ai2VcuBrake, Ai2VcuDriveF, Ai2VcuDriveR};
use adsdv_spec::{AsState, Atoms, Fault, Knowledge, Truth};

use super::events::{Pending, PendingKind};
use super::finding::{Finding, Party, Rule, Severity};
use super::transitions::conditions;
use super::{Judge, STATUS};

/// What decides it.
pub(super) const REQUESTS: Atoms = Ai2VcuDriveF::SCOPE.union(Ai2VcuDriveR::SCOPE).union(Ai2VcuBrake::SCOPE);

const FAULT: Fault = Fault::BrakePlausibilityFault;

impl Judge {
    /// Something has changed: does the AI Computer begin to ask for both?
    pub(super) fn consider_requests(&mut self, t: i64, state: AsState) {
        if !self.edition.faults.has(FAULT) {
            return;
        }
        let both = if state == AsState::Driving { self.does(FAULT) } else { Truth::False };
        match both {
            Truth::True if !self.ai.brakes_and_drives => {
                self.ai.brakes_and_drives = true;
                self.suspend(t, self.wait_for(REQUESTS) + self.cycle(), self.known, PendingKind::Both);
            }
            Truth::False => self.ai.brakes_and_drives = false,
            _ => {}
        }
    }

    pub(super) fn judge_both(&mut self, pending: &Pending, now: i64) {
        let t = pending.t;
        let told = self.vcu.status.is_some_and(|status| status.brake_plausibility_fault);
        let window = self.throughout(t, t + self.window, now);
        let drives = self.moments(t, now).iter().all(|moment| moment.state == Some(AsState::Driving))
            && self.slots.get(STATUS).is_some_and(|slot| slot.last.is_some_and(|last| last >= t));
        // Whether the VCU was still driving is certain where it goes on, or says why it does not.
        if self.left_driving_unseen(t) || !told && !drives {
            return;
        }
        let known = if told { pending.before } else { window };
        let under = |variant: &super::variants::Variant, known: Knowledge| {
            let mut terms = variant.iter().flat_map(|guard| &guard.terms);
            terms.find(|term| term.fault == Some(FAULT) && term.truth(known) == Truth::True).copied()
        };
        let terms: Vec<_> =
            self.variants.of(AsState::Driving).iter().map(|variant| under(variant, known)).collect();
        let Some(term) = terms.iter().find_map(|term| *term) else { return };
        let (severity, reservation) = if told || terms.iter().all(Option::is_some) {
            (Severity::Violation, "")
        } else {
            (Severity::Warning, " (a violation under some readings of the document only)")
        };
        let finding = Finding::new(severity, Party::Ai, term.section, Rule::BrakeAndTorque, t)
            .seen(format!("{} in AS_DRIVING", conditions(&self.edition.rules, &term, known)))
            .expected(format!("no request to drive and to brake at once{reservation}"))
            .shown_by(self.deciding_frames(&pending.frames, REQUESTS));
        self.found(finding);
    }
}
