//! The Emergency Braking System in two messages: its stage in 520h, which the database of 2026 adds, and its state in 524h.
//!
//! The guards go by the state. The stage has numbers of its own, and no document says how the two belong together; but where both
//! have a name for the same, they should agree.

use adsdv_spec::messages::{EbsStage, EbsState};

use super::finding::{Finding, Party, Rule};
use super::{BRAKE, Judge, STATUS};

/// What the two messages showed last.
#[derive(Debug, Default)]
pub(super) struct Stages {
    /// In 520h; `None` where the edition has no such signal, or its value is none.
    pub(super) stage: Option<EbsStage>,
    /// In 524h.
    pub(super) status: Option<EbsState>,
    /// Since when they differ; in the far future once that is reported.
    differ_since: Option<i64>,
}

/// Whether both may be shown at once: D-73. Before it is armed, or where it is faulty, it is not available.
const fn agree(stage: EbsStage, status: EbsState) -> bool {
    //= D-73
    match stage {
        EbsStage::Armed => matches!(status, EbsState::Armed),
        EbsStage::Triggered => matches!(status, EbsState::Triggered),
        EbsStage::Init | EbsStage::Charging | EbsStage::Discharging | EbsStage::Fault => {
            matches!(status, EbsState::Unavailable)
        }
    }
}

impl Judge {
    /// 520h came: does it show the same of the EBS as 524h does?
    pub(super) fn compare_ebs(&mut self, t: i64) {
        let comes = self.slots.get(BRAKE).is_some_and(|slot| slot.fresh);
        let (Some(stage), Some(status), true) = (self.ebs.stage, self.ebs.status, comes) else {
            self.ebs.differ_since = None;
            return;
        };
        if agree(stage, status) {
            self.ebs.differ_since = None;
            return;
        }
        let since = *self.ebs.differ_since.get_or_insert(t);
        // Each shows a change in its own time.
        if t.saturating_sub(since) <= self.window + self.deadline {
            return;
        }
        self.ebs.differ_since = Some(i64::MAX);
        let finding = Finding::note(Party::Vcu, "2.2", Rule::EbsDiffers, since)
            .seen(format!("520h shows EBS_STATE {stage}, but 524h shows STATUS_EBS {status}"))
            .expected("them to agree")
            .shown_by(self.last_frames(&[STATUS, BRAKE]));
        self.found(finding);
    }
}
