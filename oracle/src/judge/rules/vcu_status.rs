//! 120h, which version 4.0 adds: whether what it says of the AI Computer's messages, of faults and of the state is so (section 2.2).
//!
//! No document says whether a flag of 120h shows what is so now or keeps what was, when it is watched, and whether a warning is the
//! fault of its name or comes before it. So a flag is judged where all of that agrees: it must not be raised while the bus shows
//! that there was nothing to raise it for, and a timeout must be there once a message is missed for certain. All else that does
//! not fit is a note, or a warning where it is wrong only for a flag that shows the fault itself.

use adsdv_spec::messages::{SmAs, SmSys, SysActionState, VcuStatus};
use adsdv_spec::{AsState, Atom, Atoms, Fault, Faults, Knowledge, Truth};

use super::alike::stood;
use super::likely::excuse;
use super::pending::{Pending, Persisting};
use super::rise::{Raised, Rise};
use crate::judge::book::Book;
use crate::judge::estimator::base::Estimator;
use crate::judge::estimator::silences::WATCHED;
use crate::judge::finding::{Finding, Party, Rule, Severity};
use crate::judge::sampler::Came;
use crate::judge::sampler::content::FrameContent;
use crate::judge::sampler::places::{AI_STATUS, STATUS, VCU_STATUS};
use crate::judge::time::{MS, SILENCE_NS};

/// The state of the Autonomous System.
const STATE: &str = "MSG-90"; //= MSG-90
/// A timeout of a message.
const TIMEOUT: &str = "MSG-92"; //= MSG-92
/// An error of the handshake.
const HANDSHAKE: &str = "MSG-93"; //= MSG-93
/// A warning.
const WARNING: &str = "MSG-94"; //= MSG-94

/// A bit of 120h.
type Bit = fn(&VcuStatus) -> bool;

/// The warnings of which the bus shows what they are about: the fault of that name, and the flag.
const WARNINGS: [(Fault, Bit, &str); 5] = [
    (Fault::BrakePlausibilityFault, |shown| shown.warn_brake_plausibility, "warn_brake_plausibility"),
    (Fault::AiComputerRequest, |shown| shown.warn_ai_estop_req, "warn_ai_estop_req"),
    (Fault::AiCommsFault, |shown| shown.warn_ai_comms_lost, "warn_ai_comms_lost"),
    (Fault::AutonomousBrakingFault, |shown| shown.warn_auto_braking, "warn_auto_braking"),
    (Fault::MissionStatusFault, |shown| shown.warn_mission_status, "warn_mission_status"),
];

/// What they are called, in the same order.
pub(super) const TIMEOUTS: [&str; WATCHED.len()] =
    ["status_timeout", "drive_f_timeout", "drive_r_timeout", "steer_timeout", "brake_timeout"];

/// The flag of the handshake.
const ANSWER: &str = "handshake_timeout";

/// What 120h has shown.
#[derive(Debug, Default)]
pub(super) struct StatusWatch {
    shown: Option<VcuStatus>,
    /// What its enumerations show, as far as that is anything.
    sm_as: Option<SmAs>,
    sm_sys: Option<SmSys>,
    action: Option<SysActionState>,
    state_differs: Persisting,
    mode_differs: Persisting,
    warnings_differ: [Persisting; WARNINGS.len()],
    /// A flag is not raised, though its message is missed, or the handshake not answered.
    timeouts_missing: [Persisting; WATCHED.len()],
    handshake_missing: Persisting,
}

/// The timeouts, in the order of the messages that are watched.
pub(super) const fn timeouts(shown: &VcuStatus) -> [bool; WATCHED.len()] {
    [
        shown.status_timeout,
        shown.drive_f_timeout,
        shown.drive_r_timeout,
        shown.steer_timeout,
        shown.brake_timeout,
    ]
}

/// What a signal of 120h is called.
pub(super) fn name_of(est: &Estimator, field: &str) -> &'static str {
    let signal = || est.sampler.def(VCU_STATUS)?.signal_of(field);
    signal().map_or("", |signal| signal.name)
}

/// Something is wrong in 120h.
fn wrong(
    est: &Estimator,
    (severity, rule): (Severity, Rule),
    requirement: &'static str,
    t: i64,
    seen: String,
) -> Finding {
    let section = est.sampler.def(VCU_STATUS).map_or("", |def| def.section);
    Finding::new(severity, Party::Vcu, section, rule, t).against(&[requirement]).seen(seen)
}

impl StatusWatch {
    /// 120h came with something new. Tells which flags were raised since the one before; where one may be missing in between, only the
    /// handshake's, of which what was recorded tells as well.
    pub(super) fn shown(
        &mut self,
        est: &Estimator,
        came: &Came,
        content: &FrameContent,
        shown: VcuStatus,
    ) -> Vec<Rise> {
        self.sm_as = Some(shown.sm_as).filter(|_| !content.is_bad("sm_as"));
        self.sm_sys = Some(shown.sm_sys).filter(|_| !content.is_bad("sm_sys"));
        self.action = Some(shown.sys_action_state).filter(|_| !content.is_bad("sys_action_state"));
        let before = came.before.filter(|before| came.t - before < SILENCE_NS);
        let Some((was, since)) = self.shown.replace(shown).zip(before) else { return Vec::new() };
        let rises = |of: fn(&VcuStatus) -> bool| of(&shown) && !of(&was);
        let (new, old) = (timeouts(&shown), timeouts(&was));
        let timeouts = new.into_iter().zip(old).enumerate().filter(|(_, (new, old))| *new && !*old);
        let warnings = WARNINGS.iter().enumerate().filter(|(_, (_, of, _))| rises(*of));
        let answered = || est.seems_answered(came.t, est.sampler.last(STATUS).zip(est.vcu.status));
        let (rises_now, gap) = (rises(|shown| shown.handshake_timeout), !came.was_fresh);
        let handshake = rises_now.then(|| Raised::Handshake { answered: answered(), gap });
        let timeouts = timeouts.map(|(place, _)| Raised::Timeout(place));
        let others = timeouts.chain(warnings.map(|(place, _)| Raised::Warning(place)));
        let raised = others.filter(|_| !gap).chain(handshake);
        raised.map(|raised| Rise { raised, since }).collect()
    }

    /// 120h came, maybe with the same as before: what has been so for too long?
    pub(super) fn over_time(&mut self, est: &Estimator, book: &mut Book, t: i64) {
        let Some(shown) = self.shown else { return };
        book.found(self.missing_timeout(est, t, &shown));
        book.found(self.missing_handshake(est, t, &shown));
        book.found(self.other_state(est, t));
        book.found(self.other_mode(est, t));
        self.other_warnings(est, book, t, &shown);
    }

    /// A message is missed, and its flag is not raised.
    fn missing_timeout(&mut self, est: &Estimator, t: i64, shown: &VcuStatus) -> Option<Finding> {
        let watching = est.silences.is_watching(t, est.known.of(Atom::Tsms)) == Truth::True;
        let mut overdue = None;
        for (place, (missing, raised)) in self.timeouts_missing.iter_mut().zip(timeouts(shown)).enumerate() {
            let silent = || est.silences.is_silent(place, t, &est.sampler) == Truth::True;
            missing.is(t, watching && !raised && silent(), false);
            overdue = overdue.or(missing.overdue(t - est.deadline).map(|since| (place, since)));
        }
        let (place, since) = overdue?;
        let index = *WATCHED.get(place)?;
        let (def, name) = (est.sampler.def(index)?, name_of(est, TIMEOUTS.get(place)?));
        let limit = est.silences.limit.unwrap_or_default() / MS;
        let seen = format!("{name} is 0, but {} ({:03X}h) has not come for {limit} ms", def.name, def.id);
        let what = (Severity::Violation, Rule::FlagMissing);
        let finding = wrong(est, what, TIMEOUT, since + est.deadline, seen).expected("1");
        Some(finding.shown_by(est.sampler.last_frames(&[index, VCU_STATUS])))
    }

    /// The handshake is not answered, and its flag is not raised.
    fn missing_handshake(&mut self, est: &Estimator, t: i64, shown: &VcuStatus) -> Option<Finding> {
        let limit = est.handshake_limit();
        let lost =
            est.handshake.lost(t, limit, est.window) == Truth::True && est.sampler.last(AI_STATUS).is_some();
        let on = est.known.of(Atom::Tsms) == Truth::True;
        self.handshake_missing.is(t, lost && on && !shown.handshake_timeout, false);
        let since = self.handshake_missing.overdue(t - est.deadline)?;
        let name = name_of(est, ANSWER);
        let seen = format!("{name} is 0, but HANDSHAKE has been unanswered for {} ms", limit / MS);
        let what = (Severity::Violation, Rule::FlagMissing);
        let finding = wrong(est, what, HANDSHAKE, since + est.deadline, seen).expected("1");
        Some(finding.shown_by(est.sampler.last_frames(&[STATUS, AI_STATUS, VCU_STATUS])))
    }

    /// It shows another state than 520h does. What AS_R2D stands for no document says, so that it fits every state.
    fn other_state(&mut self, est: &Estimator, t: i64) -> Option<Finding> {
        let (Some(state), Some(sm_as)) = (est.state_seen(), self.sm_as) else {
            self.state_differs.pauses();
            return None;
        };
        //= D-59
        let same = match sm_as {
            SmAs::Off => state == AsState::Off,
            SmAs::Ready => state == AsState::Ready,
            SmAs::Driving => state == AsState::Driving,
            SmAs::EmergencyBrake => state == AsState::EmergencyBrake,
            SmAs::Finished => state == AsState::Finished,
            SmAs::R2d => true,
        };
        let late = t - est.deadline;
        let anew =
            self.state_differs.since.is_some_and(|since| since < late && !stood(est, since - est.window, t));
        self.state_differs.is(t, !same, anew);
        let since = self.state_differs.overdue(late)?;
        let seen = format!("120h shows SM_AS {sm_as}, but 520h shows {state}");
        let finding = wrong(est, (Severity::Violation, Rule::SmAsDiffers), STATE, since, seen);
        Some(finding.expected("the same").shown_by(est.sampler.last_frames(&[STATUS, VCU_STATUS])))
    }

    /// It tells of another mode while 520h shows AS_DRIVING. That mode is the only one with a meaning that is certain, and no
    /// document says that the two belong together.
    fn other_mode(&mut self, est: &Estimator, t: i64) -> Option<Finding> {
        //= D-58
        let sm_sys = self.sm_sys.filter(|&shown| shown != SmSys::DriveAutonomous);
        let action = self.action.filter(|&shown| shown != SysActionState::DriveAuto);
        let driving = est.state_seen() == Some(AsState::Driving) && est.known.of(Atom::Tsms) == Truth::True;
        self.mode_differs.is(t, driving && (sm_sys.is_some() || action.is_some()), false);
        let since = self.mode_differs.overdue(t - est.patience())?;
        let sm_sys = sm_sys.map(|shown| format!("SM_SYS {shown}"));
        let action = action.map(|shown| format!("SYS_ACTION_STATE {shown}"));
        let shown: Vec<String> = sm_sys.into_iter().chain(action).collect();
        let seen = format!("120h shows {}, but 520h shows {}", shown.join(" and "), AsState::Driving);
        let section = est.sampler.def(VCU_STATUS)?.section;
        let finding = Finding::note(Party::Vcu, section, Rule::ModeDiffers, since).seen(seen);
        let expected = format!("{} and {}", SmSys::DriveAutonomous, SysActionState::DriveAuto);
        Some(finding.expected(expected).shown_by(est.sampler.last_frames(&[STATUS, VCU_STATUS])))
    }

    /// Warnings that are not the faults of their names.
    fn other_warnings(&mut self, est: &Estimator, book: &mut Book, t: i64, shown: &VcuStatus) {
        let status = est.vcu.status.filter(|_| est.vcu_is_seen());
        for ((fault, raised, field), differs) in WARNINGS.into_iter().zip(&mut self.warnings_differ) {
            //= D-57
            let flag = status.map(|status| Faults::shown_by(&status).has(fault));
            differs.is(t, flag.is_some_and(|flag| flag != raised(shown)), false);
            let Some(since) = differs.overdue(t - est.patience()) else { continue };
            let (warns, flag) = (u8::from(raised(shown)), u8::from(!raised(shown)));
            let seen =
                format!("120h shows {} {warns}, but 520h shows {} {flag}", name_of(est, field), fault.flag());
            let section = est.sampler.def(VCU_STATUS).map_or("", |def| def.section);
            let finding = Finding::note(Party::Vcu, section, Rule::WarningDiffers, since);
            let finding = finding.seen(seen).expected("them to agree");
            book.found(finding.shown_by(est.sampler.last_frames(&[STATUS, VCU_STATUS])));
        }
    }
}

/// How long to wait until it is known whether a flag was raised rightly.
pub(super) fn wait_for(est: &Estimator, rise: Rise) -> i64 {
    match rise.raised {
        Raised::Timeout(_) | Raised::Handshake { .. } => est.window,
        Raised::Warning(place) => {
            est.sampler.wait_for(WARNINGS.get(place).map_or(Atoms::NONE, |(fault, ..)| about(*fault)))
        }
    }
}

/// What the bus shows of a fault.
const fn about(fault: Fault) -> Atoms {
    match fault {
        Fault::AiComputerRequest => Atoms::of(&[Atom::AiEstop]),
        Fault::AutonomousBrakingFault => Atoms::of(&[Atom::DirectionNeutral, Atom::Moving]),
        Fault::MissionStatusFault => Atoms::of(&[Atom::MissionFinished, Atom::Moving]),
        Fault::BrakePlausibilityFault => {
            Atoms::of(&[Atom::FrontTorqueZero, Atom::RearTorqueZero, Atom::BrakeRequestZero])
        }
        _ => Atoms::NONE,
    }
}

/// Why a warning was raised for nothing, in all of a time of which this is known, and whether even a warning ahead of the fault is
/// excluded; `None` where there may have been a reason.
fn unfounded(fault: Fault, known: Knowledge) -> Option<(Severity, &'static [(Atom, bool)])> {
    let is = |atom, value: bool| known.of(atom) == Truth::from(value);
    let all =
        |these: &'static [(Atom, bool)]| these.iter().all(|&(atom, value)| is(atom, value)).then_some(these);
    let certain = |these| all(these).map(|these| (Severity::Violation, these));
    let likely = |these| all(these).map(|these| (Severity::Warning, these));
    match fault {
        Fault::AiComputerRequest => certain(&[(Atom::AiEstop, false)]),
        Fault::AiCommsFault => likely(&[(Atom::AiCommsLost, false)]),
        Fault::AutonomousBrakingFault => {
            certain(&[(Atom::DirectionNeutral, false)]).or_else(|| likely(&[(Atom::Moving, false)]))
        }
        Fault::MissionStatusFault => {
            certain(&[(Atom::MissionFinished, false)]).or_else(|| likely(&[(Atom::Moving, false)]))
        }
        Fault::BrakePlausibilityFault => certain(&[(Atom::BrakeRequestZero, true)])
            .or_else(|| certain(&[(Atom::FrontTorqueZero, true), (Atom::RearTorqueZero, true)])),
        _ => None,
    }
}

/// A flag of 120h was raised, and its window has passed: could there have been a reason?
pub(super) fn judge_raised(est: &Estimator, pending: &Pending, rise: Rise) -> Option<Finding> {
    let (t, start) = (pending.t, rise.since - est.window - est.cycle());
    let end = t + est.window;
    let rules = &est.edition.rules;
    // What 520h says of lost communication counts up to the flag only: the VCU may raise both for nothing.
    let lost = || est.history.throughout(start, t - 1).of(Atom::AiCommsLost);
    let (severity, requirement, field, why, shows) = match rise.raised {
        Raised::Timeout(place) => {
            let index = *WATCHED.get(place)?;
            let def = est.sampler.def(index)?;
            if est.now < end || !est.silences.has_come(place, start, est.now) {
                return None;
            }
            let why = format!("{} ({:03X}h) has come all the time", def.name, def.id);
            (Severity::Violation, TIMEOUT, *TIMEOUTS.get(place)?, why, vec![index, VCU_STATUS])
        }
        Raised::Handshake { answered, gap } => {
            let severity = match lost() {
                _ if est.now < end => return None,
                Truth::False if !gap => Severity::Violation,
                Truth::False | Truth::Unknown if answered && !est.options.complete => Severity::Warning,
                _ => return None,
            };
            let by = if severity == Severity::Violation { "" } else { "by all that was recorded " };
            let why = format!("{by}the AI Computer answers the handshake in time");
            (severity, HANDSHAKE, ANSWER, why, vec![STATUS, AI_STATUS, VCU_STATUS])
        }
        Raised::Warning(place) => {
            let &(fault, _, field) = WARNINGS.get(place)?;
            let known = est.throughout(start, end);
            let known =
                if fault == Fault::AiCommsFault { known.set(Atom::AiCommsLost, lost()) } else { known };
            let (severity, reasons) = unfounded(fault, known)?;
            let words = reasons.iter().map(|&(atom, value)| rules.text(atom, value).to_string());
            let why = format!("{} all the time", words.collect::<Vec<_>>().join(" and "));
            let atoms = reasons.iter().fold(Atoms::NONE, |all, &(atom, _)| all.with(atom));
            let deciding = est.sampler.deciding_slots(atoms).map(|(index, _)| index);
            (severity, WARNING, field, why, deciding.chain([VCU_STATUS]).collect())
        }
    };
    let seen = format!("{} was raised, but {why}", name_of(est, field));
    let finding = wrong(est, (severity, Rule::FlagUnfounded), requirement, t, seen).expected("0");
    let excuse = match (rise.raised, severity) {
        (Raised::Handshake { .. }, Severity::Warning) => {
            excuse(est, Atoms::of(&[Atom::AiCommsLost]), start, est.now)
        }
        _ => String::new(),
    };
    Some(finding.unless(excuse).shown_by(est.sampler.frames_of(&pending.frames, &shows)))
}
