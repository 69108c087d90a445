//! Every pair of rows of one state whose guards can hold at once.

use adsdv_spec::messages::AsState;
use adsdv_spec::{Atom, Machine, Row, Term};

use super::rows::name;
use super::{Walk, attempt, before, terms, test, walk_cycle, words};
use crate::suite::requirements::of_pair;
use crate::suite::{Kind, Test};

/// The tests of a machine's rows, two by two.
pub(super) fn tests(machine: &Machine) -> Vec<Test> {
    let mut tests = Vec::new();
    for from in AsState::ALL {
        let leaving: Vec<(&Row, &Term)> = terms(machine).filter(|(row, _)| row.from == from).collect();
        for (place, one) in leaving.iter().enumerate() {
            let later = leaving.iter().skip(place).filter(|other| other.0.section != one.0.section);
            // One alternative of each row is enough: those of a row lead to the same state.
            tests.extend(later.filter_map(|other| both(machine, *one, *other)));
        }
    }
    tests.extend(one_after_the_other(machine));
    tests
}

/// The arrow into AS_READY while the reason to leave it for EMERGENCY_BRAKE is there already: both are taken, in two steps.
fn one_after_the_other(machine: &Machine) -> [Test; 2] {
    let open = Walk::new(machine).set(|inputs| inputs.sdc.vehicle_estop = true);
    let lost = Walk::new(machine).step(walk_cycle(machine), |inputs| inputs.tsms = true).answering(false);
    let lost = lost.step(machine.edition().rules.timing.handshake_ms.into(), |_| {});
    [(Atom::SdcOpen, open), (Atom::AiCommsLost, lost)].map(|(atom, walk)| {
        let about = format!(
            "{} before AS_READY is entered, and only then EMERGENCY_BRAKE",
            words(machine, atom, true)
        );
        test(Kind::Pair, format!("3.1-with-{atom}"), about, "3.1", walk.into_ready().cycle()).checks(["D-45"])
    })
}

/// Both alternatives hold at once; `None` if they cannot.
fn both(machine: &Machine, one: (&Row, &Term), other: (&Row, &Term)) -> Option<Test> {
    let on = one.1.on.union(other.1.on);
    let off = one.1.off.union(other.1.off);
    let contradicts = !on.intersection(off).is_empty()
        || on.has(Atom::Moving) && on.has(Atom::AtRest)
        || on.has(Atom::MissionFinished) && on.has(Atom::MissionSelected);
    if contradicts {
        return None;
    }
    let term = Term { on, off, ..*one.1 };
    let row = one.0;
    // What the memory of either needs.
    let walk = before(machine, row, &term);
    let walk = attempt(machine, walk, &term, None);
    let (first, second) = (name(one.0, one.1), name(other.0, other.1));
    let about = format!("in {} the guards of {first} and of {second} hold at once", row.from);
    let ids = of_pair(one.0, other.0);
    Some(test(Kind::Pair, format!("{first}-with-{second}"), about, one.0.section, walk).checks(ids))
}
