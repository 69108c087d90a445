//! What `SHUTDOWN_CAUSE` may be, and what the faults may be.

use adsdv_spec::belief::{Causes, KnownFaults};
use adsdv_spec::messages::ShutdownCause;
use adsdv_spec::{Fault, Faults, Truth};

use super::around;
use crate::prelude::*;

/// **The cause of a shutdown is among those that may be its first**, for all faults that may be the reasons of it; with these
/// known it is known, and who knows less of them knows no more of it.
///
/// Requirements: D-16.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn the_first_cause_may_be() {
    let reasons: Faults = kani::any();
    let known = around::faults(reasons);
    // That there is one at least may be known though none is.
    let some = !reasons.is_empty() && kani::any();
    let causes = subject().first_cause(known, some);
    kani::cover!(!causes.none && known.present().is_empty(), "there is a cause, and none is certain");
    kani::cover!(causes.none && !reasons.is_empty(), "there may be none");
    assert!(causes.allows(reasons.cause()), "the cause may be");
    let exact = known == KnownFaults::exact(reasons);
    assert!(!exact || causes == Causes::exact(reasons.cause()), "with all known it is known");
    let less = subject().first_cause(around::less_of_faults(known), some && kani::any());
    assert!(less.covers(causes), "who knows less allows as much");
}

/// **The cause of the first shutdown stays, and a later one counts where there was none**: what it becomes may be, with all known it
/// is known, and who knows less knows no more of it.
///
/// Requirements: D-15.
#[cfg_attr(kani, kani::proof, kani::unwind(2))]
pub fn the_cause_that_was_there_stays() {
    let (before, later): (ShutdownCause, ShutdownCause) = (kani::any(), kani::any());
    let after = if before == ShutdownCause::NoShutdown { later } else { before };
    let (causes, then) = (around::causes(before), around::causes(later));
    let become_these = subject().cause_then(causes, then);
    kani::cover!(become_these.none, "there may be no cause then");
    kani::cover!(causes.none && causes != Causes::exact(before) && before != after, "a later one counts");
    assert!(become_these.allows(after), "the cause may be");
    let exact = causes == Causes::exact(before) && then == Causes::exact(later);
    assert!(!exact || become_these == Causes::exact(after), "with all known it is known");
    let less = subject().cause_then(around::more_causes(causes), around::more_causes(then));
    assert!(less.covers(become_these), "who knows less allows as much");
}

/// **The flag that a cause shows is of what may be shown**; with the cause known it is known, and who knows less of the cause
/// knows no more of the flag.
///
/// Requirements: D-17.
#[cfg_attr(kani, kani::proof, kani::unwind(2))]
pub fn the_flag_of_a_cause_may_be_shown() {
    let cause: ShutdownCause = kani::any();
    let causes = around::causes(cause);
    let shown = subject().cause_shown(causes);
    kani::cover!(causes != Causes::exact(cause), "not all is known");
    kani::cover!(!shown.present().is_empty(), "a flag is certain");
    assert!(shown.allows(Faults::of_cause(cause)), "the flag may be shown");
    let exact = causes == Causes::exact(cause);
    assert!(
        !exact || shown == KnownFaults::exact(Faults::of_cause(cause)),
        "with the cause known it is known"
    );
    let less = subject().cause_shown(around::more_causes(causes));
    assert!(less.covers(shown), "who knows less allows as much");
}

/// **The faults of one thing or another, of both together, and of some alone are known soundly**; with all known they are
/// known, and what is said of one of several faults is so.
///
/// Requirements: D-17.
#[cfg_attr(kani, kani::proof, kani::unwind(2))]
pub fn faults_are_joined_soundly() {
    let (one, other, some): (Faults, Faults, Faults) = (kani::any(), kani::any(), kani::any());
    let fault: Fault = kani::any();
    let (known, known_too) = (around::faults(one), around::faults(other));
    let (either, together) = subject().join_faults(known, known_too);
    kani::cover!(either != KnownFaults::NOTHING && either != known, "something is known of either");
    kani::cover!(known.any_of(some) == Truth::Unknown, "one of some may be present");
    assert!(either.allows(one) && either.allows(other), "what either is");
    assert!(either.covers(known) && either.covers(known_too), "what either may be");
    assert!(known.covers(known_too) == (either == known), "covered is what adds nothing");
    assert!(!known.covers(known_too) || known.allows(other), "what covers it allows what it does");
    assert!(together.allows(one.union(other)), "what both are");
    assert!(known.of_these(some).allows(one.intersection(some)), "those alone");
    assert!(known.any_of(some).allows(!one.intersection(some).is_empty()), "one of some");
    assert!(known.of(fault).allows(one.has(fault)), "each");
    if known == KnownFaults::exact(one) && known_too == KnownFaults::exact(other) {
        assert!(together == KnownFaults::exact(one.union(other)), "with all known both are");
        assert!(known.of_these(some) == KnownFaults::exact(one.intersection(some)), "and those alone");
        assert!(known.any_of(some) != Truth::Unknown, "and whether one is present");
    }
}

theorems![
    the_first_cause_may_be,
    the_cause_that_was_there_stays,
    the_flag_of_a_cause_may_be_shown,
    faults_are_joined_soundly,
];
