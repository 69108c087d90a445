//! "Go" in 520h against the switch itself, where the remote control is on the bus.
//!
//! Whether `GO_SIGNAL` is the switch or the edge that the VCU accepted is a question of its own. By either answer it is 1 in
//! `AS_DRIVING` while the switch is on: section 3.2 wants it sent before that state is entered. Elsewhere it is wrong only where the
//! VCU is known to show the switch. That it is 1 before `AS_DRIVING` while the switch is off fits neither answer; but recordings keep
//! it at 1 behind a run, so that nobody is accused of it.

use adsdv_spec::messages::Vcu2AiStatus;
use adsdv_spec::{AsState, Atom, Choice, Reading};

use super::likely::no_frame;
use super::pending::Persisting;
use crate::judge::estimator::base::Estimator;
use crate::judge::estimator::status::{SeenChange, StatusChange};
use crate::judge::finding::{Finding, Party, Rule, Severity};
use crate::judge::sampler::places::{REMOTE, STATUS};

/// That it is sent at all.
const SENT: &str = "MSG-46"; //= MSG-46
/// That it is sent as 1 once the edge is detected.
const DETECTED: &str = "DRV-14"; //= DRV-14

/// What is kept of it.
#[derive(Debug, Default)]
pub(super) struct GoSignal {
    differs: Persisting,
    /// When 520h came last.
    at: Option<i64>,
}

/// How much it weighs that `GO_SIGNAL` is this in a state, while the switch is the other way.
const fn weighs(state: AsState, signal: bool, raw: bool) -> Option<Severity> {
    //= D-7
    match (state, signal) {
        (AsState::Driving, false) => Some(Severity::Violation),
        // It should not drive at all: that is for Figure 2.
        (AsState::Driving, true) => None,
        _ if raw => Some(Severity::Violation),
        (AsState::Off | AsState::Ready, true) => Some(Severity::Note),
        _ => None,
    }
}

/// An arrow that needs "Go" was taken, and the frame that shows it shows "Go" as well. By either answer it is 1 then: where the remote
/// control is not on the bus, that is all that tells of "Go". Where it is known to be the switch, there was no edge, which Figure 2
/// tells.
pub(super) fn entered(est: &Estimator, t: i64, shown: &StatusChange) -> Option<Finding> {
    //= DRV-14, D-7
    let SeenChange { from, to, before, gap, .. } = shown.change?;
    let switch = est.remote.shown.is_some() || est.pinned(Reading::GoSignal) == Some(Choice::GoRaw);
    let needs_go = est.readings.terms(from, to).any(|term| term.on.has(Atom::GoEdge));
    if shown.status.go_signal || switch || !needs_go {
        return None;
    }
    let (severity, excuse) = if gap {
        (
            Severity::Warning,
            format!("it was 1 in a frame that was lost ({})", no_frame(Vcu2AiStatus::ID, before, t)),
        )
    } else {
        (Severity::Violation, String::new())
    };
    let finding = Finding::new(severity, Party::Vcu, "3.2", Rule::GoDiffers, t).against(&[DETECTED]);
    let finding =
        finding.seen(format!("{from} -> {to} with GO_SIGNAL 0")).expected("1, for \"Go\" leads there");
    Some(finding.unless(excuse).shown_by(est.sampler.last_frames(&[STATUS])))
}

impl GoSignal {
    /// 520h came: does it show what the switch is?
    pub(super) fn compare(&mut self, est: &Estimator, t: i64) -> Option<Finding> {
        let raw = est.pinned(Reading::GoSignal) == Some(Choice::GoRaw);
        let differs = || {
            let (switch, status) = (est.remote.shown?.go, est.vcu.status?);
            let state = est.state_seen().filter(|_| status.go_signal != switch)?;
            Some((state, status.go_signal, weighs(state, status.go_signal, raw)?))
        };
        let differs = differs();
        let missing = self.at.replace(t).is_none_or(|at| t - at > est.window);
        let turned = self.differs.since.is_some_and(|since| est.remote.go_changed_since(since));
        self.differs.is(t, differs.is_some(), missing || turned);
        let (since, (state, signal, severity)) = (self.differs.overdue(t - est.patience())?, differs?);
        let driving = state == AsState::Driving;
        let (section, requirement) = if driving { ("3.2", DETECTED) } else { ("2.2", SENT) };
        let switch = if signal { "off" } else { "on" };
        let seen = format!(
            "GO_SIGNAL is {} in {state}, but the remote control shows \"Go\" {switch}",
            u8::from(signal)
        );
        let finding = Finding::new(severity, Party::Vcu, section, Rule::GoDiffers, since)
            .against(&[requirement])
            .seen(seen)
            .expected(u8::from(!signal).to_string());
        Some(finding.shown_by(est.sampler.last_frames(&[STATUS, REMOTE])))
    }
}
