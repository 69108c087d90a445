//! Changes of state: those that were seen, and those that were due.

use adsdv_spec::belief::{Belief, Glimpse, KnownFaults};
use adsdv_spec::messages::Vcu2AiStatus;
use adsdv_spec::{AsState, Atom, Choice, Fault, Knowledge, Machine, Term, Truth};

use super::likely::{Likely, likely_unjustified, no_frame};
use super::pending::Pending;
use super::texts::{Mismatch, not_left, unjustified};
use crate::judge::book::Book;
use crate::judge::estimator::base::Estimator;
use crate::judge::estimator::readings::{WayOut, forced, guard, of_terms, possible, ways};
use crate::judge::estimator::status::{MEMORY, SeenChange};
use crate::judge::evidence::Frames;
use crate::judge::exercised::{ONLY_ARROWS, broken_by};
use crate::judge::finding::{Finding, Party, Rule, Severity};
use crate::judge::report::Transition;
use crate::judge::sampler::places::{LOG_STATUS, STATUS};
use crate::judge::time::MS;

/// A way out of the current state that is certain to be open.
#[derive(Clone, Copy, Debug)]
pub(super) struct Due {
    pub(super) since: i64,
    pub(super) way: WayOut,
    /// The last frames when it came to be.
    frames: Frames,
    /// Whether the guard held in a step that is over: then it does not matter that it holds no more.
    held: bool,
    pub(super) reported: bool,
}

impl Due {
    fn new(est: &Estimator, since: i64, way: WayOut, held: bool) -> Self {
        Self { since, way, frames: est.sampler.frames(), held, reported: false }
    }

    /// Whether it need not be watched any more. What has been reported stays until it is certain to be over, however many
    /// frames are missing.
    fn is_over(&self, known: Knowledge) -> bool {
        if self.reported { self.way.term.truth(known) == Truth::False } else { !self.held }
    }
}

/// What three-valued judgement says of a change under some readings.
#[derive(Clone, Copy)]
struct Judgement {
    truth: Truth,
    /// The alternative that decided, or may have, and what was known of it; of a change that cannot be: another that comes first.
    decided: Option<(Term, Knowledge)>,
}

/// What is known has changed: is a transition due now?
pub(super) fn reconsider(due: &mut Option<Due>, est: &Estimator, t: i64) {
    let known = est.known;
    let way = est.state_seen().and_then(|state| est.readings.due(state, known));
    let over = |due: &Due| due.is_over(known);
    match way {
        None => *due = due.filter(|due| !over(due)),
        Some(way) if due.is_none_or(|due| due.way.term.truth(known) != Truth::True && over(&due)) => {
            *due = Some(Due::new(est, t, way, false));
        }
        Some(_) => {}
    }
}

/// The window behind a change of a condition that counts has passed: was there a step that saw a guard hold?
pub(super) fn guard_held(due: &mut Option<Due>, est: &Estimator, t: i64, edge: Atom, truth: Truth) {
    let Some((state, known)) = est.step_of_change(t, edge, truth) else { return };
    let Some(way) = est.readings.due(state, known) else { return };
    if due.is_none_or(|due| due.is_over(est.known)) {
        *due = Some(Due::new(est, t, way, true));
    }
}

/// 520h still shows the old state: a transition that should have come by now is missing.
pub(super) fn due_at_status(
    due: &mut Option<Due>,
    likely: &mut Likely,
    est: &Estimator,
    t: i64,
) -> Option<Finding> {
    let due = due.as_mut().filter(|due| !due.reported && t > due.since + est.deadline)?;
    let atoms = due.way.term.on.union(due.way.term.off);
    let state = est.vcu.state.filter(|_| est.is_confirmed(atoms, due.since))?;
    due.reported = true;
    likely.is_certain();
    let pressed = due.way.term.on.has(Atom::SdcOpen) && est.remote.was_pressed(due.since, t);
    let pressed = if pressed { " (remote E-stop pressed)" } else { "" };
    let so_long = format!("{pressed} for more than {} ms", est.options.deadline_ms);
    let finding = not_left(est, Severity::Violation, state, &due.way, due.since, &so_long);
    let mut evidence = est.sampler.deciding_frames(&due.frames, atoms);
    evidence.extend(est.sampler.last_frames(&[STATUS]));
    Some(finding.shown_by(evidence))
}

/// A change of state was seen, and its window has passed: was there a reason? Tells whether an emergency is certain to have a
/// cause that has a number.
pub(super) fn judge_seen(est: &Estimator, book: &mut Book, pending: &Pending, seen: &SeenChange) -> bool {
    let &SeenChange { from, to, before, gap, at_step, shown, go_never_low_since } = seen;
    let t = pending.t;
    let start = before.min(t - est.window) - est.cycle();
    let window = est.at_step(t, start, at_step);
    // 502h comes rarely: where the sample behind differs, or there is none, that before does not speak for now.
    let after = est.throughout(t, t + est.window);
    let between = est.sampler.scope(LOG_STATUS).difference(after.on().union(after.off()));
    let moments =
        est.moments(start, t).filter(|moment| moment.state == Some(from)).map(|moment| moment.known);
    let instants: Vec<Knowledge> = moments.chain([at_step]).map(|known| known.forget(between)).collect();
    let machines = est.readings.of(from);
    let judged: Vec<Judgement> =
        machines.iter().map(|machine| judge(machine, (from, to), window, &instants)).collect();
    let mut justified = judged.iter().map(|j| j.truth).reduce(Truth::agree).unwrap_or(Truth::False);
    let between_missed =
        justified == Truth::False && gap && leads_through_others(est, (from, to), window, t - before);
    if between_missed {
        justified = Truth::Unknown;
    }
    // The alternatives that the VCU itself gives as its reason, as far as they are possible.
    let cause = est.vcu.status.and_then(|status| Fault::of_cause(status.shutdown_cause));
    let named: Vec<(Term, Knowledge)> = est
        .readings
        .terms(from, to)
        .filter(|term| cause.is_some() && term.fault == cause && term.truth(window) != Truth::False)
        .map(|term| (*term, window))
        .collect();
    let decided = judged.iter().find(|j| j.truth == justified).or(judged.first()).and_then(|j| j.decided);
    let decided = named.first().copied().filter(|_| justified == Truth::Unknown).or(decided);
    book.judged_change(est, t, justified);
    let deciding: Vec<_> = judged.iter().filter_map(|j| j.decided).chain(decided).collect();
    book.exercise_arrow(est, (from, to), justified, &deciding, window);
    let arrow = machines.iter().map(|machine| guard(machine, from, to)).find(|guard| !guard.is_empty());
    let section = arrow.as_ref().and_then(|guard| guard.first()).map_or("Figure 2", |way| way.section);
    let opens = decided.is_some_and(|(term, _)| term.on.has(Atom::SdcOpen));
    let remote_estop = opens && est.remote.was_pressed(start, t + est.window);
    let found = |severity, rule| {
        let atoms = of_terms(est.readings.terms(from, to));
        let finding = Finding::new(severity, Party::Vcu, section, rule, t);
        finding.shown_by(est.sampler.deciding_frames(&pending.frames, atoms))
    };
    let finding = match (&arrow, justified) {
        _ if between_missed => {
            let gap = no_frame(Vcu2AiStatus::ID, before, t);
            let stays =
                Mismatch::stays(format!("by all that was recorded {from} -> {to}, without a reason"), from);
            let excuse = format!("a state between was missed ({gap})");
            Some(stays.describe(found(Severity::Warning, Rule::Unjustified)).unless(excuse))
        }
        (None, Truth::False) => {
            let finding = found(Severity::Violation, Rule::NoArrow).against(&[ONLY_ARROWS]);
            let leads = |to| est.readings.terms(from, to).next().is_some();
            let ways = AsState::ALL.into_iter().filter(|&state| leads(state)).map(AsState::name);
            let ways = ways.collect::<Vec<_>>().join(", ");
            let finding = finding.seen(format!("{from} -> {to}: there is no such arrow"));
            Some(finding.expected(format!("{from} to stay, or one of its arrows to {ways}")))
        }
        (Some(guard), Truth::False) => {
            let overtaking = judged.iter().find_map(|j| j.decided).map(|(term, _)| term);
            let terms: Vec<Term> = guard.iter().map(|way| way.term).collect();
            let wrong = unjustified(&est.edition.rules, (from, to), &terms, window, overtaking);
            let broken = broken_by(est, from, to, &deciding, window);
            Some(wrong.describe(found(Severity::Violation, Rule::Unjustified)).against(&broken))
        }
        (_, Truth::Unknown) => {
            likely_unjustified(est, t, (from, to), shown, go_never_low_since).map(|(wrong, excuse)| {
                wrong.describe(found(Severity::Warning, Rule::Unjustified)).unless(excuse)
            })
        }
        _ => None,
    };
    book.found(finding);
    // Where the shutdown circuit decided: what is reported as the same fault (D-13).
    let or = if opens { named } else { Vec::new() };
    book.out.transition(Transition { t_ns: t, from, to, section, justified, decided, remote_estop, or });
    // A switch that is turned off has no cause of its own; that the remote E-stop has one is not said.
    let on = |atom| window.of(atom) == Truth::True;
    justified == Truth::True && on(Atom::Asms) && on(Atom::GoOn) && !remote_estop
}

/// Judges a change under the readings of a machine: `window` is known of all of the time in which its step was, and each of
/// `instants` at some time of it.
fn judge(
    machine: &Machine,
    (from, to): (AsState, AsState),
    window: Knowledge,
    instants: &[Knowledge],
) -> Judgement {
    let leads = |way: &WayOut| way.to == to;
    let Some(way) = possible(machine, (from, to), window) else {
        // Another that comes first, if there is such an arrow at all.
        let earlier = ways(machine, from).take_while(|way| !leads(way));
        let first = { earlier }.find(|way| way.term.truth(window) == Truth::True);
        let first = first.filter(|_| ways(machine, from).any(|way| leads(&way)));
        return Judgement { truth: Truth::False, decided: first.map(|way| (way.term, window)) };
    };
    let certain = |&known: &Knowledge| Some((forced(machine, from, known).filter(leads)?.term, known));
    match instants.iter().rev().find_map(certain) {
        Some(decided) => Judgement { truth: Truth::True, decided: Some(decided) },
        None => Judgement { truth: Truth::Unknown, decided: Some((way.term, window)) },
    }
}

/// Whether several steps can lead there in a time in which the log missed the states between: by what may be of the VCU after one step
/// and another, whatever it remembered before.
fn leads_through_others(
    est: &Estimator,
    (from, to): (AsState, AsState),
    window: Knowledge,
    gap: i64,
) -> bool {
    // What the VCU remembers was not seen; what it saw has to allow each step, and communication may be lost in any.
    let seen = Glimpse::new(window.forget(MEMORY), KnownFaults::NOTHING);
    let gap_ms = u32::try_from((gap + est.window) / MS).unwrap_or_default();
    let step = |state: AsState, before: &Belief| {
        est.readings.of(state).iter().fold(Belief::NONE, |after, machine| {
            let readings = machine.readings().with(Choice::HandshakeAlways).with(Choice::WatchAlways);
            let machine = Machine::new(est.edition, readings);
            after.or(&machine.react_known(&before.given(state), &seen, 0..=gap_ms))
        })
    };
    let only = |belief: &Belief, wanted: &dyn Fn(AsState) -> bool| {
        let states = belief.states().filter(|&state| wanted(state));
        states.fold(Belief::NONE, |only, state| only.or(&belief.given(state)))
    };
    let first = step(from, &Belief::anything(&est.edition.rules.timing));
    let mut between = only(&first, &|state| state != from && state != to);
    for _ in AsState::ALL {
        let after = between.states().fold(between, |after, state| after.or(&step(state, &between)));
        between = only(&after, &|state| state != from);
    }
    between.memory(to).is_some()
}
