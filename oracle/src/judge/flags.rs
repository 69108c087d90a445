//! Fault flags, `FAULT_STATUS`, `SHUTDOWN_CAUSE`, and `AI_COMMS_LOST`: whether 520h tells the truth (section 2.2).

use adsdv_spec::messages::{ShutdownCause, Vcu2AiStatus, Vcu2LogStatus};
use adsdv_spec::{AsState, Atom, Atoms, Choice, Fault, Faults, Knowledge, Reading, Term, Truth};

use super::events::{Pending, PendingKind, milliseconds};
use super::exercised::{HOLDS, UNANSWERED};
use super::finding::{Finding, Party, Rule, Severity};
use super::handshake::Suspect;
use super::history::Moment;
use super::status::is_active;
use super::transitions::conditions;
use super::{AI_STATUS, Judge, LOG_STATUS, STATUS};

/// A cause that was named: its flag and the shutdown must be seen as well.
#[derive(Clone, Copy, Debug)]
pub(super) struct CauseWatch {
    since: i64,
    cause: ShutdownCause,
    flag_seen: bool,
    stop_seen: bool,
}

/// An emergency that has begun.
#[derive(Clone, Copy, Debug)]
pub(super) struct BrakeWatch {
    pub(super) since: i64,
    /// Whether a fault that has a number is certain to be the reason.
    pub(super) certain: bool,
}

/// Since when the flags that sum up others contradict them.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sums {
    fault: Option<i64>,
    warning: Option<i64>,
}

/// A 502h that shows another state than 520h.
#[derive(Clone, Copy, Debug)]
pub(super) struct AssiSuspect {
    /// Since when; in the far future once that is reported.
    since: i64,
    /// What it showed last.
    shown: AsState,
}

/// What `FAULT_STATUS` sums up.
const FAULT_SUM: &str = "MSG-50"; //= MSG-50
/// What `WARNING_STATUS` sums up.
const WARNING_SUM: &str = "MSG-51"; //= MSG-51
/// What `SHUTDOWN_CAUSE` shows.
const CAUSE: &str = "MSG-64"; //= MSG-64
/// What `State_ASSI` shows.
const ASSI: &str = "MSG-35"; //= MSG-35

/// The faults whose conditions the bus shows.
const VISIBLE: [Fault; 5] = [
    Fault::AiComputerRequest,
    Fault::AiCommsFault,
    Fault::AutonomousBrakingFault,
    Fault::MissionStatusFault,
    Fault::BrakePlausibilityFault,
];

impl Judge {
    /// The VCU shows something wrong in 520h.
    fn shows_wrongly(
        &mut self,
        severity: Severity,
        rule: Rule,
        requirement: &'static str,
        t_ns: i64,
        (seen, expected): (String, &str),
    ) {
        let finding = Finding::new(severity, Party::Vcu, "2.2", rule, t_ns).against(&[requirement]);
        self.found(finding.seen(seen).expected(expected).shown_by(self.last_frames(&[STATUS])));
    }

    /// Flags and causes of two 520h that follow one another differ.
    pub(super) fn flags_changed(
        &mut self,
        t: i64,
        previous: &Vcu2AiStatus,
        status: &Vcu2AiStatus,
        old_state: Option<AsState>,
        before: Knowledge,
    ) {
        let (shown, shown_before) = (Faults::shown_by(status), Faults::shown_by(previous));
        for fault in VISIBLE {
            if shown.has(fault) && !shown_before.has(fault) {
                let deciding = match fault {
                    Fault::BrakePlausibilityFault => super::plausible::REQUESTS,
                    _ => super::ai::AT_SPEED_ATOMS,
                };
                self.suspend(t, self.wait_for(deciding), before, PendingKind::Flag(fault));
                if fault == Fault::AiCommsFault {
                    self.ai_was_silent(t);
                    self.judge_missed(t);
                }
            }
        }
        self.exercise_flags(t, shown.difference(shown_before));
        let (cause, old_cause) = (status.shutdown_cause, previous.shutdown_cause);
        if cause != old_cause {
            self.cause_changed(t, old_cause, cause, old_state, shown_before);
        }
        if let Some(watch) = &mut self.vcu.cause {
            watch.flag_seen |= Faults::of_cause(watch.cause).difference(shown).is_empty();
            watch.stop_seen |= !is_active(Some(status.as_state));
        }
    }

    /// 520h shows something else; behind a gap, what was wrong before it may have been right in between.
    pub(super) fn sums_seen(&mut self, t: i64, status: &Vcu2AiStatus, gap: bool) {
        let goes_on = |since: &i64| !gap || *since == i64::MAX;
        let Sums { fault, warning } = self.vcu.sums;
        let shown = Faults::shown_by(status);
        let fault_flags = shown.difference(Faults::NONE.with(Fault::AiComputerRequest));
        let warnings = status.warn_batt_temp_high || status.warn_batt_soc_low;
        let since = |wrong: bool, since: Option<i64>| if wrong { since.or(Some(t)) } else { None };
        self.vcu.sums = Sums {
            fault: since(!fault_flags.is_empty() && !status.fault_status, fault.filter(goes_on)),
            warning: since(warnings && !status.warning_status, warning.filter(goes_on)),
        };
    }

    fn cause_changed(
        &mut self,
        t: i64,
        old: ShutdownCause,
        new: ShutdownCause,
        old_state: Option<AsState>,
        shown_before: Faults,
    ) {
        if old == ShutdownCause::NoShutdown {
            let flag_seen = Faults::of_cause(new).difference(shown_before).is_empty();
            let stop_seen = !is_active(old_state);
            self.vcu.cause = Some(CauseWatch { since: t, cause: new, flag_seen, stop_seen });
            return;
        }
        let seen = format!(
            "SHUTDOWN_CAUSE changed from {} ({old}) to {} ({new}) after the shutdown",
            old as u8, new as u8
        );
        // That a cause goes when EMERGENCY_BRAKE is left is not excluded by the document's words.
        let braking = old_state == Some(AsState::EmergencyBrake) && self.vcu.state == old_state;
        let severity = if braking { Severity::Violation } else { Severity::Warning };
        let expected = "the first cause to stay until a power cycle";
        self.shows_wrongly(severity, Rule::CauseChanged, CAUSE, t, (seen, expected));
    }

    /// What 520h should have shown by now.
    pub(super) fn flags_over_time(&mut self, t: i64) {
        let late = t - self.deadline;
        if self.vcu.cause.is_some_and(|watch| watch.since < late) {
            self.judge_cause();
        }
        if let Some(since) = self.vcu.sums.fault.filter(|&since| since < late) {
            self.vcu.sums.fault = Some(i64::MAX);
            let shown = self.vcu.status.as_ref().map_or(Faults::NONE, Faults::shown_by);
            let flags: Vec<&str> = shown.iter().map(Fault::flag).collect();
            let seen = format!("FAULT_STATUS is 0, but {} is set", flags.join(", "));
            self.shows_wrongly(Severity::Violation, Rule::StatusSum, FAULT_SUM, since, (seen, "1"));
        }
        if let Some(since) = self.vcu.sums.warning.filter(|&since| since < late) {
            self.vcu.sums.warning = Some(i64::MAX);
            let seen = "WARNING_STATUS is 0, but a battery warning is set".to_owned();
            self.shows_wrongly(Severity::Violation, Rule::StatusSum, WARNING_SUM, since, (seen, "1"));
        }
        if self.vcu.brake.is_some_and(|brake| brake.since < late) {
            self.judge_missing_cause();
        }
        if self.vcu.status.is_some_and(|status| status.ai_estop_request) {
            self.vcu.estop_since = None;
        }
        if self.vcu.estop_since.is_some_and(|since| since < late) {
            self.judge_missing_estop(t);
        }
    }

    fn judge_cause(&mut self) {
        let Some(watch) = self.vcu.cause.take() else { return };
        let CauseWatch { since, cause, flag_seen, stop_seen } = watch;
        let number = cause as u8;
        if let Some(fault) = Fault::of_cause(cause).filter(|_| !flag_seen) {
            let seen = format!("SHUTDOWN_CAUSE is {number} ({cause}), but {} is 0", fault.flag());
            let told = (seen, "it to be 1");
            self.shows_wrongly(Severity::Violation, Rule::CauseWithoutFlag, CAUSE, since, told);
        }
        if !stop_seen {
            let state = self.vcu.state.map_or("its state", AsState::name);
            let seen = format!("SHUTDOWN_CAUSE is {number} ({cause}), but the VCU stays in {state}");
            let told = (seen, AsState::EmergencyBrake.name());
            self.shows_wrongly(Severity::Violation, Rule::CauseWithoutShutdown, CAUSE, since, told);
        }
    }

    fn judge_missing_cause(&mut self) {
        let Some(brake) = self.vcu.brake.take() else { return };
        let cause = self.vcu.status.map(|status| status.shutdown_cause);
        let readable = self.slots.get(super::STATUS).is_some_and(|slot| slot.bad == 0);
        if cause == Some(ShutdownCause::NoShutdown) && readable {
            let severity = if brake.certain { Severity::Violation } else { Severity::Warning };
            let seen = "SHUTDOWN_CAUSE is 0 (no shutdown) in EMERGENCY_BRAKE".to_owned();
            self.shows_wrongly(severity, Rule::CauseMissing, CAUSE, brake.since, (seen, "the cause"));
        }
    }

    fn judge_missing_estop(&mut self, t: i64) {
        let Some(since) = self.vcu.estop_since.take() else { return };
        let asked = |moment: &Moment| {
            moment.known.of(Atom::AiEstop) == Truth::True && !moment.filled.has(Atom::AiEstop)
        };
        if self.history.between(since, t).all(asked) {
            let seen = format!(
                "AI_ESTOP_REQUEST is 0, though the AI Computer has asked for an emergency stop for {:.0} ms",
                milliseconds(t - since)
            );
            let (requirement, at) = (Fault::AiComputerRequest.requirement(), since + self.deadline);
            self.shows_wrongly(Severity::Violation, Rule::FlagMissing, requirement, at, (seen, "1"));
        }
    }

    /// A flag was raised: could its condition have held?
    pub(super) fn judge_flag(&mut self, pending: &Pending, fault: Fault, now: i64) {
        let t = pending.t;
        let cycle = self.cycle();
        let start = t - self.window - cycle;
        let inputs = self.throughout(start, t + self.window, now);
        // What the flag itself says counts only from the flag on; it may be recorded behind what ended its reason.
        let before = self.history.throughout(start, t - 1).meet(pending.before);
        let window = inputs.set(Atom::AiCommsLost, before.of(Atom::AiCommsLost));
        // Section 2.4 asks for this flag whether an arrow follows from it or not.
        if fault == Fault::AiCommsFault && window.of(Atom::AiCommsLost) != Truth::False {
            self.exercise_flag(fault, window.of(Atom::AiCommsLost));
            return;
        }
        // An edge may lie before the window; what it needs besides does not.
        let edges = [Atom::MissionFinishedEdge, Atom::DirectionNeutralEdge];
        let known = edges.iter().fold(window, |known, &edge| known.set(edge, Truth::Unknown));
        let reasons = self.variants.terms_of(fault).filter(|term| !edge_excluded(term, window));
        let reason = { reasons }.map(|term| term.truth(known)).find(|&reason| reason != Truth::False);
        if let Some(reason) = reason {
            return self.exercise_flag(fault, reason);
        }
        // Told in the words of the first alternative, by the section of the last: those of section 3.7, and section 4 where the
        // reading that it stands for is possible.
        let missing = self.variants.terms_of(fault).next().copied();
        let section = self.variants.terms_of(fault).last().map_or("2.2", |term| term.section);
        let off = window.of(Atom::Tsms) == Truth::False
            && self.pinned(Reading::HandshakeActive) == Some(Choice::HandshakeTsms);
        let rules = &self.edition.rules;
        let (section, why) = match (fault, missing) {
            (Fault::AiCommsFault, _) if off => ("2.4", rules.text(Atom::Tsms, false).to_string()),
            (Fault::AiCommsFault, _) if rules.thresholds.missed_ms.is_some() => (
                "2.4",
                "the AI Computer answers the handshake in time, and none of its messages is missed"
                    .to_owned(),
            ),
            (Fault::AiCommsFault, _) => ("2.4", "the AI Computer answers the handshake in time".to_owned()),
            (Fault::AiComputerRequest, _) => {
                ("2.2", format!("{} all the time", rules.text(Atom::AiEstop, false)))
            }
            (_, Some(term)) => {
                (section, format!("never {}", conditions(rules, &term, Knowledge::exact(term.on))))
            }
            (_, None) => (section, "nothing can be its reason".to_owned()),
        };
        let deciding =
            self.variants.terms_of(fault).fold(Atoms::NONE, |all, term| all.union(term.on).union(term.off));
        let finding = Finding::violation(Party::Vcu, section, Rule::FlagUnfounded, t)
            .against(&[fault.requirement()])
            .seen(format!("{fault} was raised, but {why}"))
            .expected("0")
            .shown_by(self.deciding_frames(&pending.frames, deciding));
        self.found(finding);
    }

    /// The VCU changed its handshake bit: was the one before answered?
    pub(super) fn judge_edge(&mut self, t: i64, suspect: Suspect) {
        // Of a bit that was there for a moment, the only answer may be missing.
        let gap = self.slots.get(super::AI_STATUS).and_then(|slot| slot.gap_since(suspect.since));
        if !self.handshake.clears(suspect) && gap.is_none() {
            let bit = u8::from(suspect.bit);
            let finding = Finding::violation(Party::Vcu, "2.4", Rule::HandshakeEdge, t)
                .against(&[HOLDS[usize::from(suspect.bit)]])
                .seen(format!(
                    "HANDSHAKE changed from {bit} to {}, but the AI Computer never answered with {bit}",
                    1 - bit
                ))
                .expected("the VCU to wait for the answer")
                .shown_by(self.last_frames(&[STATUS, AI_STATUS]));
            self.found(finding);
        }
    }

    /// Brings what is known of lost communication up to date.
    pub(super) fn update_comms(&mut self, t: i64) {
        self.comms_known_at = t;
        let limit = self.handshake_limit();
        let tsms = self.known.of(Atom::Tsms);
        let pinned = self.pinned(Reading::HandshakeActive);
        let raised = self.vcu.shows_comms_lost() && is_active(self.vcu.state);
        let missed = self.is_missed(t);
        let unanswered = match (tsms, pinned) {
            (Truth::True, _) | (_, Some(Choice::HandshakeAlways)) => {
                self.handshake.lost(t, limit, self.window)
            }
            (Truth::False, Some(_)) => Truth::False,
            _ => match self.handshake.lost(t, limit, self.window) {
                Truth::False => Truth::False,
                _ => Truth::Unknown,
            },
        };
        let truth = if raised { Truth::True } else { unanswered.or(missed) };
        if truth != self.known.of(Atom::AiCommsLost) {
            self.learn(t, self.known.set(Atom::AiCommsLost, truth));
        }
        self.wake_at(self.comms_event());
    }

    /// When an unanswered edge, or a message that is silent, changes what is known.
    pub(super) fn comms_event(&self) -> i64 {
        self.edge_event().min(self.missed_event())
    }

    fn edge_event(&self) -> i64 {
        let limit = self.handshake_limit();
        let Some(edge) = self.handshake.edge_at().filter(|_| !self.handshake.is_answered()) else {
            return i64::MAX;
        };
        let (may, must) = (edge + limit - self.window, edge + limit + self.window);
        if self.comms_known_at < may {
            may
        } else if self.comms_known_at < must {
            must
        } else {
            i64::MAX
        }
    }

    pub(super) fn comms_time(&mut self, t: i64) {
        self.update_comms(t);
        let limit = self.handshake_limit();
        let late = self.handshake.unanswered(t).is_some_and(|waited| waited >= limit + self.window);
        if late && self.handshake.ai_is_wrong() && self.known.of(Atom::Tsms) == Truth::True {
            self.report_ai_late(t, Severity::Violation);
        }
        self.ai_was_silent(t);
        self.judge_missed(t);
    }

    /// 520h shows the same handshake bit as before: has it been so for too long?
    pub(super) fn comms_due(&mut self, t: i64) {
        let limit = self.handshake_limit();
        let Some(edge) = self.handshake.edge_at().filter(|edge| t - edge > limit + self.deadline) else {
            return;
        };
        let Some(status) = self.vcu.status else { return };
        let ai_was_there = self.ai_was_heard();
        if !ai_was_there && self.vcu.state == Some(AsState::Off) {
            // Nothing drives yet, and the AI Computer is still to start: every VCU waits for it.
            return;
        }
        if status.ai_comms_lost
            || !status.ts_switch_status
            || !self.vcu_is_seen()
            || !self.handshake.report_vcu()
        {
            return;
        }
        let at = edge + limit + self.deadline;
        let finding = if self.handshake.is_answered() {
            Finding::violation(Party::Vcu, "2.4", Rule::HandshakeEdge, at)
                .against(&[HOLDS[usize::from(status.handshake)]])
                .seen("HANDSHAKE did not change though the AI Computer answered it")
                .expected("it to change")
        } else {
            Finding::violation(Party::Vcu, "2.4", Rule::CommsLostDue, at)
                .against(UNANSWERED)
                .seen(format!(
                    "AI_COMMS_LOST is 0, but HANDSHAKE has been unanswered for {:.0} ms",
                    milliseconds(t - edge)
                ))
                .expected(format!("1 after {} ms", self.edition.rules.timing.handshake_ms))
        };
        self.found(finding.shown_by(self.last_frames(&[STATUS, AI_STATUS])));
    }

    /// Whether 520h has shown the same state all the time between `start` and `end`, with no frame missing.
    fn state_stood(&self, start: i64, end: i64) -> bool {
        let same = self.moments(start, end).iter().all(|moment| moment.state == self.vcu.state);
        same && self.history.throughout(start, end).of(Atom::Tsms) != Truth::Unknown
    }

    /// 502h shows a state; it should be that of 520h.
    pub(super) fn assi_seen(&mut self, t: i64, shown: AsState) {
        // A moment of its own, so that a change until the next sample can be told from this one.
        self.history.push(t, self.known, self.vcu.state);
        let Some(state) = self.vcu.state.filter(|_| self.vcu_is_seen()) else {
            self.vcu.assi = None;
            return;
        };
        let since = match self.vcu.assi {
            _ if shown == state => {
                self.vcu.assi = None;
                return;
            }
            Some(AssiSuspect { since, .. }) if since == i64::MAX || t - since <= self.deadline => since,
            Some(AssiSuspect { since, .. }) if self.state_stood(since - self.window, t) => {
                let section = self.edition.bus.message(Vcu2LogStatus::ID).map_or("", |def| def.section);
                let finding = Finding::violation(Party::Vcu, section, Rule::AssiDiffers, since)
                    .against(&[ASSI])
                    .seen(format!("502h shows State_ASSI {shown}, but 520h shows {state}"))
                    .expected("the same")
                    .shown_by(self.last_frames(&[STATUS, LOG_STATUS]));
                self.found(finding);
                i64::MAX
            }
            // It begins, or what 502h shows may have been so when it was sent.
            _ => t,
        };
        self.vcu.assi = Some(AssiSuspect { since, shown });
    }

    /// 502h came again with the same content.
    pub(super) fn assi_repeated(&mut self, t: i64) {
        match self.vcu.assi {
            Some(suspect) => self.assi_seen(t, suspect.shown),
            None => self.history.push(t, self.known, self.vcu.state),
        }
    }
}

/// Whether the value that an edge leads to is certain not to have been there.
fn edge_excluded(term: &Term, window: Knowledge) -> bool {
    let to = [
        (Atom::MissionFinishedEdge, Atom::MissionFinished),
        (Atom::DirectionNeutralEdge, Atom::DirectionNeutral),
    ];
    to.iter().any(|&(edge, level)| term.on.has(edge) && window.of(level) == Truth::False)
}
