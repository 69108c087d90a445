//! What is known of an observation, of its conditions and its faults.

use adsdv_spec::belief::{Glimpse, KnownFaults};
use adsdv_spec::{Atom, Atoms, Choice, Edition, Fault, Faults, Knowledge, Machine, Observation, Truth};

use super::TRUTHS;

/// A condition that no fault decides, and one that is not of an observation.
const OTHERS: [Atom; 2] = [Atom::Asms, Atom::DwellElapsed];

/// The faults that are looked at: one that opens the circuit, the battery's, and one that does not.
const SOME: [Fault; 3] = [Fault::EbsFault, Fault::BmsFault, Fault::AiComputerRequest];

/// Observations with these faults alone.
fn observations() -> Vec<Observation> {
    let mut all = vec![Observation::default()];
    for fault in SOME {
        let with = |seen: &Observation| Observation::new(seen.atoms(), seen.faults().with(fault));
        let more: Vec<_> = all.iter().map(with).collect();
        all.extend(more);
    }
    let with_asms = |seen: &Observation| Observation::new(seen.atoms().with(Atom::Asms), seen.faults());
    let more: Vec<_> = all.iter().map(with_asms).collect();
    all.into_iter().chain(more).collect()
}

/// Everything that can be said of these conditions and faults; of all others, that they are off and absent.
fn said() -> Vec<(Knowledge, KnownFaults)> {
    let mut atoms = vec![Knowledge::exact(Atoms::NONE)];
    for atom in [Atom::SdcOpen, Atom::BmsFault, Atom::AiEstop, OTHERS[0]] {
        atoms = atoms.iter().flat_map(|known| TRUTHS.map(|truth| known.set(atom, truth))).collect();
    }
    let mut faults = vec![KnownFaults::exact(Faults::NONE)];
    for fault in SOME {
        let one = Faults::NONE.with(fault);
        let set = |known: &KnownFaults| {
            let (present, absent) = (known.present(), known.absent().difference(one));
            [
                KnownFaults::new(present, absent.union(one)),
                KnownFaults::new(present, absent),
                KnownFaults::new(present.union(one), absent),
            ]
        };
        faults = faults.iter().flat_map(set).collect();
    }
    atoms.iter().flat_map(|&atoms| faults.iter().map(move |&faults| (atoms, faults))).collect()
}

/// The least that allows all of these.
fn hull(some: &[Observation]) -> Option<Glimpse> {
    some.iter().map(|&seen| Glimpse::exact(seen)).reduce(|one, other| one.or(&other))
}

#[test]
fn a_glimpse_is_the_least_that_allows_what_may_be_seen() {
    let all = observations();
    for (atoms, faults) in said() {
        let may_be = |seen: &Observation| atoms.allows(seen.atoms()) && faults.allows(seen.faults());
        let seen: Vec<Observation> = all.iter().copied().filter(may_be).collect();
        let glimpse = Glimpse::new(atoms, faults);
        if let Some(expected) = hull(&seen) {
            assert_eq!(glimpse, expected, "{atoms:?}, {faults:?}");
            assert!(all.iter().all(|seen| glimpse.allows(*seen) == may_be(seen)), "{atoms:?}, {faults:?}");
        }
    }
}

#[test]
fn where_conditions_and_faults_disagree_what_is_so_counts() {
    let open = Knowledge::NOTHING.set(Atom::SdcOpen, Truth::True);
    let closed = Knowledge::NOTHING.set(Atom::SdcOpen, Truth::False);
    let none = KnownFaults::new(Faults::NONE, Faults::OPENING);
    let ebs = KnownFaults::new(Faults::NONE.with(Fault::EbsFault), Faults::NONE);

    let glimpse = Glimpse::new(open, none);
    assert_eq!(glimpse.atoms().of(Atom::SdcOpen), Truth::True);
    assert_eq!(glimpse.faults().any_of(Faults::OPENING), Truth::Unknown, "something opens it after all");
    let glimpse = Glimpse::new(closed, ebs);
    assert_eq!(glimpse.atoms().of(Atom::SdcOpen), Truth::True);
    assert_eq!(glimpse.faults().of(Fault::EbsFault), Truth::True);
    assert_eq!(glimpse.faults().of(Fault::HvilOpenFault), Truth::False);
}

#[test]
fn what_inputs_do_not_decide_is_off() {
    let on = Knowledge::NOTHING.set(OTHERS[1], Truth::True);
    let comms = KnownFaults::new(Faults::NONE.with(Fault::AiCommsFault), Faults::NONE);
    let glimpse = Glimpse::new(on, comms);
    assert_eq!(glimpse.atoms().of(OTHERS[1]), Truth::False);
    assert_eq!(glimpse.faults().of(Fault::AiCommsFault), Truth::False);
    assert_eq!(glimpse, Glimpse::NOTHING);
}

#[test]
fn a_glimpse_covers_what_it_allows_all_of() {
    let all = observations();
    let some: Vec<Glimpse> = said()
        .into_iter()
        .map(|(atoms, faults)| Glimpse::new(atoms, faults))
        .filter(|glimpse| all.iter().any(|seen| glimpse.allows(*seen)))
        .step_by(9)
        .collect();
    assert!(some.len() > 50);
    for one in &some {
        for other in &some {
            let covers = all.iter().all(|seen| one.allows(*seen) || !other.allows(*seen));
            assert_eq!(one.covers(other), covers, "{one:?} covers {other:?}");
            let either = one.or(other);
            assert!(either.covers(one) && either.covers(other));
        }
    }
}

/// The battery by itself opens the circuit, or under the reading does not: what is known of it follows.
//= D-54
#[test]
fn a_fault_of_the_battery_alone_opens_the_circuit_as_it_is_read() {
    let reading = Edition::V4_0.readings.with(Choice::BmsDriving);
    let all = observations();
    for machine in [Machine::REFERENCE, Machine::new(Edition::V4_0, reading)] {
        for (atoms, faults) in said() {
            let may_be = |seen: &&Observation| atoms.allows(seen.atoms()) && faults.allows(seen.faults());
            let known = all.iter().filter(may_be).map(|&seen| Knowledge::exact(machine.atoms_of(seen)));
            if let Some(expected) = known.reduce(Knowledge::meet) {
                let glimpse = Glimpse::new(atoms, faults);
                assert_eq!(machine.known_atoms_of(&glimpse), expected, "{atoms:?}, {faults:?}");
            }
        }
    }
}
