//! The warnings of 120h, which version 4.0 has, beside the fault flags of 520h.
//!
//! No version says that the two are the same: the names do, and so the judge notes it where they differ, and blames nobody.

use adsdv_spec::messages::VcuStatus;
use adsdv_spec::{Fault, Faults};

use super::Judge;
use super::finding::{Party, Rule, Severity};

/// What 120h shows, and since when some of it differs from 520h.
#[derive(Clone, Copy, Debug)]
pub(super) struct Warned {
    /// The warnings, as the faults of their names.
    shown: Faults,
    /// Those that differ from the flags, all the time.
    differing: Faults,
    since: i64,
    noted: bool,
}

/// The warnings of a 120h, each with the fault of its name.
//= D-57
const fn warnings(status: &VcuStatus) -> [(bool, Fault); 5] {
    [
        (status.warn_brake_plausibility, Fault::BrakePlausibilityFault),
        (status.warn_ai_estop_req, Fault::AiComputerRequest),
        (status.warn_ai_comms_lost, Fault::AiCommsFault),
        (status.warn_auto_braking, Fault::AutonomousBrakingFault),
        (status.warn_mission_status, Fault::MissionStatusFault),
    ]
}

impl Judge {
    /// 120h shows warnings; they should be the fault flags of 520h.
    pub(super) fn warnings_seen(&mut self, t: i64, status: &VcuStatus) {
        let shown = warnings(status)
            .iter()
            .fold(Faults::NONE, |shown, &(is_shown, fault)| if is_shown { shown.with(fault) } else { shown });
        self.warned(t, shown);
    }

    /// 120h came again with the same content.
    pub(super) fn warnings_repeated(&mut self, t: i64) {
        if let Some(Warned { shown, .. }) = self.vcu.warned {
            self.warned(t, shown);
        }
    }

    fn warned(&mut self, t: i64, shown: Faults) {
        let status = self.vcu.status.filter(|_| self.vcu_is_seen());
        let differing = status.map_or(Faults::NONE, |status| {
            let all = Faults::of(&warnings(&VcuStatus::default()).map(|(_, fault)| fault));
            let flags = Faults::shown_by(&status).intersection(all);
            flags.difference(shown).union(shown.difference(flags))
        });
        let before = self.vcu.warned.filter(|before| !before.differing.intersection(differing).is_empty());
        let begins = Warned { shown, differing, since: t, noted: false };
        let mut warned = before.map_or(begins, |before| Warned {
            shown,
            differing: before.differing.intersection(differing),
            ..before
        });
        // Frames that are on their way, or lost, do not make as much of a difference.
        let long = !warned.differing.is_empty() && t - warned.since > self.deadline.max(self.window);
        if long && !std::mem::replace(&mut warned.noted, true) {
            self.note_warnings(&warned);
        }
        self.vcu.warned = Some(warned);
    }

    #[cold]
    fn note_warnings(&mut self, warned: &Warned) {
        let one = |fault: Fault| {
            let (there, here) = if warned.shown.has(fault) { ("a", "not set") } else { ("no", "set") };
            format!("{there} warning of {fault}, which is {here} in 520h")
        };
        let all: Vec<String> = warned.differing.iter().map(one).collect();
        let message = format!("120h shows {}; expected the same of both", all.join(", "));
        let section = self.edition.bus.message(VcuStatus::ID).map_or("", |def| def.section);
        self.report(Severity::Note, Party::Vcu, section, Rule::WarningDiffers, message);
    }
}
