//! Fault flags, `FAULT_STATUS` and `SHUTDOWN_CAUSE`: whether 520h tells the truth (section 2.2).

use adsdv_spec::messages::{ShutdownCause, Vcu2AiStatus};
use adsdv_spec::{AsState, Atom, Atoms, Fault, Faults, Truth};

use super::likely::{self, no_frame};
use super::pending::Persisting;
use crate::judge::book::Book;
use crate::judge::estimator::base::{Estimator, is_active};
use crate::judge::estimator::history::Moment;
use crate::judge::estimator::status::StatusChange;
use crate::judge::finding::{Finding, Party, Rule, Severity};
use crate::judge::sampler::places::{AI_STATUS, STATUS};
use crate::judge::time::milliseconds;

/// What `FAULT_STATUS` sums up.
const FAULT_SUM: &str = "MSG-50"; //= MSG-50
/// What `WARNING_STATUS` sums up.
const WARNING_SUM: &str = "MSG-51"; //= MSG-51
/// What `SHUTDOWN_CAUSE` shows.
const CAUSE: &str = "MSG-64"; //= MSG-64

/// The faults whose conditions the bus shows.
const VISIBLE: [Fault; 5] = [
    Fault::AiComputerRequest,
    Fault::AiCommsFault,
    Fault::AutonomousBrakingFault,
    Fault::MissionStatusFault,
    Fault::BrakePlausibilityFault,
];

/// What must follow from what 520h has shown.
#[derive(Debug, Default)]
pub(super) struct Flags {
    cause: Option<CauseWatch>,
    /// Since when there is an emergency, and whether it is certain that its cause has a number.
    pub(super) brake: Option<(i64, bool)>,
    /// `FAULT_STATUS` and `WARNING_STATUS` contradict the flags that they sum up.
    fault_sum: Persisting,
    warning_sum: Persisting,
    /// The AI Computer asks for an emergency stop in every 510h that came.
    asking: Option<Asking>,
    /// Since when the flag of that is 0 again, where it was 1 in the frame before.
    estop_taken_back: Option<i64>,
}

/// The AI Computer asks for an emergency stop, by all that was recorded.
#[derive(Clone, Copy, Debug)]
struct Asking {
    since: i64,
    /// Whether the frame before is known, and did not ask: what follows one that nobody saw may have come before.
    begun: bool,
    /// Whether the Autonomous System was active then.
    active: bool,
    /// Whether the flag was 1 since, or it was reported that it is not.
    settled: bool,
}

/// A cause that was named: its flag and the shutdown must be seen as well.
#[derive(Clone, Copy, Debug)]
struct CauseWatch {
    since: i64,
    cause: ShutdownCause,
    flag_seen: bool,
    stop_seen: bool,
    /// Whether a frame of the VCU may be missing that showed either.
    gap: bool,
}

/// The VCU shows something wrong in 520h.
fn shows_wrongly(
    est: &Estimator,
    (severity, rule, requirement): (Severity, Rule, &'static str),
    t_ns: i64,
    seen: impl Into<String>,
    expected: &str,
) -> Finding {
    let finding = Finding::new(severity, Party::Vcu, "2.2", rule, t_ns).against(&[requirement]);
    finding.seen(seen).expected(expected).shown_by(est.sampler.last_frames(&[STATUS]))
}

/// Since when it has been so for too long, and how much that weighs: by the frames that came, a frame that may be missing in between
/// makes it a warning.
fn overdue(sum: &mut Persisting, est: &Estimator, t: i64) -> Option<(i64, Severity)> {
    let certain = sum.overdue(t - est.deadline).map(|since| (since, Severity::Violation));
    certain.or_else(|| Some((sum.likely_overdue(t - est.long_patience())?, Severity::Warning)))
}

/// The flags that are set.
fn set(status: &Vcu2AiStatus) -> String {
    Faults::shown_by(status).iter().map(Fault::flag).collect::<Vec<_>>().join(", ")
}

/// What could excuse it: that a frame was lost which showed it otherwise.
fn excuse(est: &Estimator, severity: Severity, name: &str, since: i64, t: i64) -> String {
    let gap = est.sampler.slot(STATUS).and_then(|slot| slot.longest_gap(t)).unwrap_or((since, t));
    let lost = || {
        format!(
            "{name} was otherwise in a frame that was lost ({})",
            no_frame(Vcu2AiStatus::ID, gap.0, gap.1)
        )
    };
    if severity == Severity::Warning { lost() } else { String::new() }
}

/// The faults whose flags have been raised, and whose conditions the bus shows.
pub(super) fn risen(shown: &StatusChange) -> impl Iterator<Item = Fault> {
    let new = shown
        .previous
        .map(|previous| Faults::shown_by(&shown.status).difference(Faults::shown_by(&previous)));
    VISIBLE.into_iter().filter(move |&fault| new.is_some_and(|new| new.has(fault)))
}

/// The cause is another than the one that was shown.
fn cause_changed(est: &Estimator, t: i64, shown: &StatusChange) -> Option<Finding> {
    let (old, new) = (shown.previous?.shutdown_cause, shown.status.shutdown_cause);
    if old == ShutdownCause::NoShutdown || old == new {
        return None;
    }
    let seen = format!(
        "SHUTDOWN_CAUSE changed from {} ({old}) to {} ({new}) after the shutdown",
        old as u8, new as u8
    );
    // That a cause goes when EMERGENCY_BRAKE is left is not excluded by the document's words.
    let braking = shown.old == Some(AsState::EmergencyBrake) && est.vcu.state == shown.old;
    let missing_since = shown.before.missing_since;
    let certain = braking && missing_since.is_none();
    let severity = if certain { Severity::Violation } else { Severity::Warning };
    let expected = "the first cause to stay until a power cycle";
    let finding = shows_wrongly(est, (severity, Rule::CauseChanged, CAUSE), t, seen, expected);
    let excuse = missing_since.map(|since| {
        format!("the vehicle was power-cycled meanwhile ({})", no_frame(Vcu2AiStatus::ID, since, t))
    });
    Some(finding.unless(excuse.unwrap_or_default()))
}

impl Flags {
    /// 520h shows something else.
    pub(super) fn shown(&mut self, est: &Estimator, book: &mut Book, t: i64, shown: &StatusChange) {
        let &StatusChange { status, gap, .. } = shown;
        if let Some(state) = shown.entered {
            let from_another = shown.change.is_some();
            self.brake = (state == AsState::EmergencyBrake && from_another).then_some((t, false));
        }
        let flags = Faults::shown_by(&status);
        if let Some(previous) = shown.previous {
            let flags_before = Faults::shown_by(&previous);
            if !gap {
                book.exercise_flags(flags.difference(flags_before));
            }
            let cause = status.shutdown_cause;
            if previous.shutdown_cause == ShutdownCause::NoShutdown && cause != previous.shutdown_cause {
                let flag_seen = Faults::of_cause(cause).is_subset(flags_before);
                let stop_seen = !is_active(shown.old);
                self.cause = Some(CauseWatch { since: t, cause, flag_seen, stop_seen, gap });
            }
            if let Some(watch) = &mut self.cause {
                watch.flag_seen |= Faults::of_cause(watch.cause).is_subset(flags);
                watch.stop_seen |= !is_active(Some(status.as_state));
            }
        }
        if status.ai_estop_request || shown.previous.is_some_and(|previous| previous.ai_estop_request) {
            self.estop_taken_back = (!status.ai_estop_request).then_some(t);
        }
        book.found(cause_changed(est, t, shown));
        let faults = !flags.without(Fault::AiComputerRequest).is_empty();
        let warnings = status.warn_batt_temp_high || status.warn_batt_soc_low;
        self.fault_sum.is(t, faults && !status.fault_status, gap);
        self.warning_sum.is(t, warnings && !status.warning_status, gap);
    }

    /// What 520h should have shown by now.
    pub(super) fn over_time(&mut self, est: &Estimator, book: &mut Book, t: i64) {
        let late = t - est.deadline;
        let Some(status) = est.vcu.status else { return };
        if self.cause.is_some_and(|watch| watch.since < late) {
            self.judge_cause(est, book, t);
        }
        for (sum, requirement, name, what) in [
            (&mut self.fault_sum, FAULT_SUM, "FAULT_STATUS", set as fn(&_) -> _),
            (&mut self.warning_sum, WARNING_SUM, "WARNING_STATUS", |_| "a battery warning".to_owned()),
        ] {
            let Some((since, severity)) = overdue(sum, est, t) else { continue };
            let seen = format!("{name} is 0, but {} is set", what(&status));
            let finding = shows_wrongly(est, (severity, Rule::StatusSum, requirement), since, seen, "1");
            book.found(finding.unless(excuse(est, severity, name, since, t)));
        }
        if let Some((since, certain)) = self.brake.take_if(|(since, _)| *since < late) {
            let readable = est.sampler.slot(STATUS).is_some_and(|slot| slot.bad == 0);
            if status.shutdown_cause == ShutdownCause::NoShutdown && readable {
                let severity = if certain { Severity::Violation } else { Severity::Warning };
                let seen = "SHUTDOWN_CAUSE is 0 (no shutdown) in EMERGENCY_BRAKE";
                book.found(shows_wrongly(
                    est,
                    (severity, Rule::CauseMissing, CAUSE),
                    since,
                    seen,
                    "the cause",
                ));
            }
        }
        // It may have been recorded before the 510h that it follows.
        if let Some(asking) = &mut self.asking {
            asking.settled |= status.ai_estop_request;
        }
        let unsettled = self.asking.filter(|asking| asking.active && !asking.settled && asking.since < late);
        if let Some(Asking { since, begun, .. }) = unsettled {
            let seen = format!(
                "AI_ESTOP_REQUEST is 0, though the AI Computer has asked for an emergency stop for {:.0} ms",
                milliseconds(t - since)
            );
            let missing = self.estop_missing(est, (since, t), begun, since + est.deadline, seen, "1");
            if let (Some(_), Some(asking)) = (&missing, &mut self.asking) {
                asking.settled = true;
            }
            book.found(missing);
        }
        // One that has begun anew has not heard the AI Computer yet, but soon will.
        let soon = est.window + 2 * est.cycle();
        if let Some(since) = self.estop_taken_back.take_if(|since| t - *since >= soon) {
            let seen = "AI_ESTOP_REQUEST went back to 0, though the AI Computer went on to ask for an emergency stop";
            let from = since - est.patience() - est.cycle();
            book.found(self.estop_missing(est, (from, t), true, since, seen, "1 as long as it asks"));
        }
    }

    /// 510h came with something new: whether it asks for an emergency stop, and whether the one before did, where that is known.
    pub(super) fn ai_asks(&mut self, est: &Estimator, t: i64, asks: bool, before: Option<bool>) {
        let (begun, active) = (before == Some(false), is_active(est.vcu.state));
        if !asks {
            self.asking = None;
        } else if begun || self.asking.is_none() {
            self.asking = Some(Asking { since: t, begun, active, settled: false });
        }
    }

    /// `AI_ESTOP_REQUEST` is 0, if the AI Computer asked between these times: for certain, where that may be, or in every frame that was
    /// recorded.
    fn estop_missing(
        &self,
        est: &Estimator,
        (from, to): (i64, i64),
        may_be_certain: bool,
        t: i64,
        seen: impl Into<String>,
        expected: &str,
    ) -> Option<Finding> {
        let asked = |moment: &Moment| {
            moment.known.of(Atom::AiEstop) == Truth::True && !moment.filled.has(Atom::AiEstop)
        };
        let certain = may_be_certain && est.is_seen_since(from) && est.moments(from, to).all(asked);
        let likely = || {
            let asking = self.asking.is_some_and(|asking| asking.since <= from);
            let last = est.sampler.last(AI_STATUS).is_some_and(|last| last >= to - est.patience());
            asking && last && !est.options.complete
        };
        let (severity, excuse) = if certain {
            (Severity::Violation, String::new())
        } else if likely() {
            (Severity::Warning, likely::excuse(est, Atoms::of(&[Atom::AiEstop]), from, to))
        } else {
            return None;
        };
        let what = (severity, Rule::FlagMissing, Fault::AiComputerRequest.requirement());
        Some(shows_wrongly(est, what, t, seen, expected).unless(excuse))
    }

    fn judge_cause(&mut self, est: &Estimator, book: &mut Book, t: i64) {
        let Some(CauseWatch { since, cause, flag_seen, stop_seen, gap }) = self.cause.take() else { return };
        let number = cause as u8;
        let severity = if gap { Severity::Warning } else { Severity::Violation };
        if let Some(fault) = Fault::of_cause(cause).filter(|_| !flag_seen) {
            let seen = format!("SHUTDOWN_CAUSE is {number} ({cause}), but {} is 0", fault.flag());
            let what = (severity, Rule::CauseWithoutFlag, CAUSE);
            let finding = shows_wrongly(est, what, since, seen, "it to be 1");
            book.found(finding.unless(excuse(est, severity, fault.flag(), since, t)));
        }
        if !stop_seen {
            let state = est.vcu.state.map_or("its state", AsState::name);
            let seen = format!("SHUTDOWN_CAUSE is {number} ({cause}), but the VCU stays in {state}");
            let what = (severity, Rule::CauseWithoutShutdown, CAUSE);
            let finding = shows_wrongly(est, what, since, seen, AsState::EmergencyBrake.name());
            book.found(finding.unless(excuse(est, severity, "AS_STATE", since, t)));
        }
    }
}
