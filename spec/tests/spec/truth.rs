//! Three-valued truth: what is said is what holds however the unseen is.

use adsdv_spec::table::Term;
use adsdv_spec::{Atom, Atoms, Knowledge, Truth};

const ALL: [Truth; 3] = [Truth::False, Truth::Unknown, Truth::True];

/// What the value can turn out to be.
fn outcomes(truth: Truth) -> Vec<bool> {
    match truth {
        Truth::False => vec![false],
        Truth::Unknown => vec![false, true],
        Truth::True => vec![true],
    }
}

/// What can be said when all of these are possible.
fn claimed(outcomes: impl Iterator<Item = bool>) -> Truth {
    let all: Vec<_> = outcomes.collect();
    match (all.contains(&true), all.contains(&false)) {
        (true, false) => Truth::True,
        (false, true) => Truth::False,
        _ => Truth::Unknown,
    }
}

#[test]
fn and_or_and_agree_are_what_holds_however_the_unseen_is() {
    for a in ALL {
        for b in ALL {
            let pairs =
                || outcomes(a).into_iter().flat_map(move |a| outcomes(b).into_iter().map(move |b| (a, b)));
            assert_eq!(a.and(b), claimed(pairs().map(|(a, b)| a && b)), "{a} and {b}");
            assert_eq!(a.or(b), claimed(pairs().map(|(a, b)| a || b)), "{a} or {b}");
            assert_eq!(a.agree(b), claimed(outcomes(a).into_iter().chain(outcomes(b))), "{a} or else {b}");
        }
    }
}

/// What is claimed of a truth is what holds for the facts that it allows.
#[test]
fn truths_allow_facts_and_cover_each_other() {
    for one in ALL {
        for fact in [false, true] {
            let so = one == Truth::Unknown || one == Truth::from(fact);
            assert_eq!((one.allows(fact), one.not().allows(!fact)), (so, so), "{one}: {fact}");
        }
        for other in ALL {
            let all = [false, true].into_iter().all(|fact| one.allows(fact) || !other.allows(fact));
            assert_eq!(one.covers(other), all, "{one} covers {other}");
        }
    }
}

#[test]
fn a_truth_prints_its_name() {
    assert_eq!(ALL.map(|truth| truth.to_string()), ["false", "unknown", "true"]);
    assert_eq!(format!("{:>8}", Truth::True), "    true");
    assert_eq!((Truth::from(true), Truth::from(false)), (Truth::True, Truth::False));
}

/// Everything that can be known of three atoms, and each way in which these may be.
fn knowledge() -> impl Iterator<Item = (Knowledge, Vec<Atoms>)> {
    const ATOMS: [Atom; 3] = [Atom::Asms, Atom::Tsms, Atom::GoOn];
    ALL.into_iter().flat_map(|a| ALL.into_iter().flat_map(move |b| ALL.map(|c| [a, b, c]))).map(|truths| {
        let mut known = Knowledge::NOTHING;
        let mut ways = vec![Atoms::NONE];
        for (atom, truth) in ATOMS.into_iter().zip(truths) {
            if truth != Truth::Unknown {
                let on = Atoms::when(atom, truth == Truth::True);
                known = known.learn(Atoms::of(&[atom]), on);
            }
            ways = ways
                .iter()
                .flat_map(|way| outcomes(truth).into_iter().map(|on| way.union(Atoms::when(atom, on))))
                .collect();
        }
        (known, ways)
    })
}

#[test]
fn knowledge_allows_what_does_not_contradict_it() {
    let any: Vec<_> = knowledge().find(|(known, _)| *known == Knowledge::NOTHING).expect("nothing known").1;
    assert_eq!(any.len(), 8);
    for (known, ways) in knowledge() {
        for &atoms in &any {
            assert_eq!(known.allows(atoms), ways.contains(&atoms), "{known:?}, {atoms:?}");
        }
    }
}

#[test]
fn a_term_holds_as_far_as_is_known() {
    let terms = [
        Term::on("3.1", &[Atom::Asms]),
        Term::off("3.1", &[Atom::Asms]),
        Term::on("3.1", &[Atom::Asms, Atom::Tsms]),
        Term::on("3.1", &[Atom::Asms]).and_off(&[Atom::Tsms]),
        Term::on("3.1", &[Atom::Asms, Atom::GoOn]).and_off(&[Atom::Tsms]),
        Term::off("3.1", &[Atom::Asms, Atom::Tsms, Atom::GoOn]),
    ];
    for term in terms {
        let holds = |atoms: &Atoms| term.literals().all(|(atom, on)| atoms.has(atom) == on);
        assert!(term.literals().count() > 0);
        for (known, ways) in knowledge() {
            assert_eq!(term.truth(known), claimed(ways.iter().map(holds)), "{term:?}, {known:?}");
        }
    }
}
