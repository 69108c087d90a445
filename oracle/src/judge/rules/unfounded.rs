//! Fault flags that were raised: could their conditions have held (section 2.2)?

use adsdv_spec::{Atom, Choice, Fault, Knowledge, Reading, Truth};

use super::conduct::deciding;
use super::likely::excuse;
use super::pending::Pending;
use super::texts::conditions;
use crate::judge::book::Book;
use crate::judge::estimator::base::Estimator;
use crate::judge::estimator::readings::of_terms;
use crate::judge::estimator::status::PriorKnowledge;
use crate::judge::finding::{Finding, Party, Rule, Severity};

/// A flag was raised, and its window has passed: could its condition have held?
pub(super) fn judge_flag(
    est: &Estimator,
    book: &mut Book,
    pending: &Pending,
    fault: Fault,
    before: PriorKnowledge,
) {
    let (t, missing_since) = (pending.t, before.missing_since);
    let (start, end) = (missing_since.unwrap_or(t) - est.window - est.cycle(), t + est.window);
    // What the flag itself says counts only from the flag on; it may be recorded behind what ended its reason.
    let lost = est.history.throughout(start, t - 1).meet(before.known).of(Atom::AiCommsLost);
    let window = est.throughout(start, end).set(Atom::AiCommsLost, lost);
    // Where a frame of the VCU may be missing, so may be the one that raised it.
    let reason = if missing_since.is_some() { Truth::Unknown } else { reason_of(est, fault, window) };
    if reason == Truth::False {
        return book.found(Some(unfounded(est, pending, Severity::Violation, fault, window)));
    }
    if missing_since.is_none() {
        book.exercise_flag(fault, reason);
    }
    let lost = before.shown.of(Atom::AiCommsLost);
    let shown = est.shown_throughout(start, end, before.shown).set(Atom::AiCommsLost, lost);
    if reason == Truth::Unknown && !est.options.complete && reason_of(est, fault, shown) == Truth::False {
        let excuse = excuse(est, of_terms(est.readings.terms_of(fault)), start, est.now);
        book.found(Some(unfounded(est, pending, Severity::Warning, fault, shown).unless(excuse)));
    }
}

/// Whether the condition of a flag held, by what is known of all of the time in which it may have.
fn reason_of(est: &Estimator, fault: Fault, window: Knowledge) -> Truth {
    // Section 2.4 asks for this flag whether an arrow follows from it or not.
    let lost = window.of(Atom::AiCommsLost);
    if fault == Fault::AiCommsFault && lost != Truth::False {
        return lost;
    }
    // An edge may lie before the window; what it needs besides does not.
    let edges = [Atom::MissionFinishedEdge, Atom::DirectionNeutralEdge];
    let known = edges.into_iter().fold(window, |known, edge| {
        let excluded = edge.input().is_some_and(|level| window.of(level) == Truth::False);
        known.set(edge, if excluded { Truth::False } else { Truth::Unknown })
    });
    let mut reasons = est.readings.terms_of(fault).map(|term| term.truth(known));
    reasons.find(|&reason| reason != Truth::False).unwrap_or(Truth::False)
}

/// What is said of a flag whose condition did not hold: for certain, or by all that was recorded.
///
/// In the words of the first alternative, by the section of the last: those of section 3.7, and section 4 where the reading that it
/// stands for is possible.
fn unfounded(
    est: &Estimator,
    pending: &Pending,
    severity: Severity,
    fault: Fault,
    window: Knowledge,
) -> Finding {
    let rules = &est.edition.rules;
    let terms = || est.readings.terms_of(fault);
    let off = window.of(Atom::Tsms) == Truth::False
        && est.pinned(Reading::HandshakeActive) == Some(Choice::HandshakeTsms);
    let (section, why) = match (fault, terms().next()) {
        (Fault::AiCommsFault, _) if off => ("2.4", rules.text(Atom::Tsms, false).to_string()),
        (Fault::AiCommsFault, _) => {
            let missed = rules.thresholds.missed_ms.map_or("", |_| ", and none of its messages is missed");
            ("2.4", format!("the AI Computer answers the handshake in time{missed}"))
        }
        (Fault::AiComputerRequest, _) => {
            ("2.2", format!("{} all the time", rules.text(Atom::AiEstop, false)))
        }
        (_, Some(term)) => {
            let section = terms().last().map_or("2.2", |term| term.section);
            (section, format!("never {}", conditions(rules, term, Knowledge::exact(term.on))))
        }
        (_, None) => ("2.2", "nothing can be its reason".to_owned()),
    };
    let by = if severity == Severity::Violation { "" } else { "by all that was recorded " };
    Finding::new(severity, Party::Vcu, section, Rule::FlagUnfounded, pending.t)
        .against(&[fault.requirement()])
        .seen(format!("{fault} was raised, but {by}{why}"))
        .expected("0")
        .shown_by(est.sampler.deciding_frames(&pending.frames, of_terms(terms())))
}

/// How long to wait until it is known whether a flag was raised rightly.
pub(super) fn wait_for(est: &Estimator, fault: Fault) -> i64 {
    est.sampler.wait_for(deciding(fault))
}
