//! What two messages of the VCU show of the same: its state in 502h, and the Emergency Braking System in 520h and 524h.
//!
//! Of the latter the guards go by the state in 524h. The stage in 520h, which the database of 2026 adds, has numbers of its own, and
//! no document says how the two belong together; but where both have a name for the same, they should agree.

use adsdv_spec::messages::{EbsStage, EbsState, Vcu2LogStatus};
use adsdv_spec::{AsState, Atom, Truth};

use super::pending::Persisting;
use crate::judge::estimator::base::Estimator;
use crate::judge::finding::{Finding, Party, Rule};
use crate::judge::sampler::places::{BRAKE, LOG_STATUS, STATUS};

/// What `State_ASSI` shows.
const ASSI: &str = "MSG-35"; //= MSG-35

/// The state in 502h.
#[derive(Debug, Default)]
pub(super) struct Assi {
    shown: Option<AsState>,
    /// It differs from that of 520h.
    differs: Persisting,
}

impl Assi {
    /// 502h came, with this state if it says another than before.
    pub(super) fn shown(&mut self, est: &Estimator, t: i64, shown: Option<AsState>) -> Option<Finding> {
        self.shown = shown.or(self.shown);
        let shown = self.shown?;
        let Some(state) = est.state_seen() else {
            self.differs.pauses();
            return None;
        };
        // It begins, or what 502h shows may have been so when it was sent.
        let late = t - est.deadline;
        let anew = self.differs.since.is_some_and(|since| since < late && !stood(est, since - est.window, t));
        self.differs.is(t, state != shown, anew);
        let since = self.differs.overdue(late)?;
        let section = est.edition.bus.message(Vcu2LogStatus::ID).map_or("", |def| def.section);
        let finding = Finding::violation(Party::Vcu, section, Rule::AssiDiffers, since)
            .against(&[ASSI])
            .seen(format!("502h shows State_ASSI {shown}, but 520h shows {state}"))
            .expected("the same");
        Some(finding.shown_by(est.sampler.last_frames(&[STATUS, LOG_STATUS])))
    }
}

/// Whether 520h has shown the same state all the time between `start` and `end`, with no frame missing.
pub(super) fn stood(est: &Estimator, start: i64, end: i64) -> bool {
    let same = est.moments(start, end).all(|moment| moment.state == est.vcu.state);
    same && est.history.throughout(start, end).of(Atom::Tsms) != Truth::Unknown
}

/// The Emergency Braking System in two messages.
#[derive(Debug, Default)]
pub(super) struct Ebs {
    /// In 520h; `None` where the edition has no such signal, or its value is none.
    pub(super) stage: Option<EbsStage>,
    /// In 524h.
    pub(super) status: Option<EbsState>,
    differs: Persisting,
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

impl Ebs {
    /// 520h came: does it show the same as 524h does?
    pub(super) fn compare(&mut self, est: &Estimator, t: i64) -> Option<Finding> {
        let both = self.stage.zip(self.status).filter(|_| est.sampler.is_fresh(BRAKE));
        self.differs.is(t, both.is_some_and(|(stage, status)| !agree(stage, status)), false);
        // Each shows a change in its own time.
        let (since, (stage, status)) = (self.differs.overdue(t - est.patience())?, both?);
        let finding = Finding::note(Party::Vcu, "2.2", Rule::EbsDiffers, since)
            .seen(format!("520h shows EBS_STATE {stage}, but 524h shows STATUS_EBS {status}"))
            .expected("them to agree");
        Some(finding.shown_by(est.sampler.last_frames(&[STATUS, BRAKE])))
    }
}
