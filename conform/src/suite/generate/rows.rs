//! Every alternative of every row, and every condition of it shown to matter on its own (MC/DC).

use adsdv_oracle::requirements::of_term;
use adsdv_spec::{Atom, Machine, Row, Term};

use super::{Walk, attempt, before, term_words, terms, test, walk_cycle, words};
use crate::suite::requirements::of_condition;
use crate::suite::{Kind, Test};

/// The tests of the alternatives that a machine has.
pub(super) fn tests(machine: &Machine) -> Vec<Test> {
    terms(machine).flat_map(|(row, term)| of(machine, row, term)).collect()
}

/// One alternative, taken, and not taken for want of each of its conditions.
pub(super) fn of(machine: &Machine, row: &Row, term: &Term) -> Vec<Test> {
    let name = name(row, term);
    let taken = attempt(machine, before(machine, row, term), term, None);
    let about = format!("{} leads from {} to {}", term_words(machine, term), row.from, row.to);
    // What stands beside the figure is not the figure's.
    let figure = (term.section == row.section).then_some("SM-1");
    let mut tests = vec![
        test(Kind::Row, name.clone(), about, term.section, taken).checks(of_term(row, term)).checks(figure),
    ];
    for (atom, value) in term.literals() {
        let about = format!("{}: {} is not left for {}", words(machine, atom, !value), row.from, row.to);
        let walk = without(machine, row, term, atom);
        tests.push(
            test(Kind::Condition, format!("{name}-but-{atom}"), about, term.section, walk)
                .checks(of_condition(row, term, atom)),
        );
    }
    tests
}

/// The name of an alternative: its row's section, and what it asks for if the row has others.
pub(super) fn name(row: &Row, term: &Term) -> String {
    let conditions: Vec<String> = term
        .literals()
        .map(|(atom, value)| if value { atom.to_string() } else { format!("not-{atom}") })
        .collect();
    // Where a row has several long alternatives they are readings of one question, of which a machine has one.
    if row.terms().len() == 1 || conditions.len() > 2 {
        return row.section.to_owned();
    }
    format!("{}-{}", row.section, conditions.join("-and-"))
}

/// The way to a step in which all conditions of an alternative hold but one.
fn without<'a>(machine: &'a Machine, row: &Row, term: &Term, atom: Atom) -> Walk<'a> {
    let timing = &machine.edition().rules.timing;
    let cycle = walk_cycle(machine);
    match atom {
        // "Go" is seen off while the time is not over yet, and comes on when it is.
        Atom::DwellElapsed => {
            let early = Walk::to(machine, row.from).step(u32::from(timing.ready_dwell_ms) - 1, |_| {});
            early.step(1, |inputs| inputs.go = true).cycle()
        }
        // "Go" is on when the time is over, and was never seen off.
        Atom::GoEdge => Walk::new(machine)
            .set(|inputs| inputs.go = true)
            .into_ready()
            .step(timing.ready_dwell_ms.into(), |_| {})
            .cycle(),
        Atom::PowerCycleNeeded => {
            attempt(machine, Walk::after_an_emergency(machine).step(cycle, |_| {}), term, None)
        }
        // A change is not seen if the value was there before: at a speed that is neither moving nor at rest, so that
        // no arrow was taken for it.
        Atom::MissionFinishedEdge | Atom::DirectionNeutralEdge => {
            let input = atom.input().unwrap_or(atom);
            let seen = Walk::to(machine, row.from).show(Atom::AtRest, false).show(input, true).cycle();
            seen.show(Atom::Moving, true).cycle()
        }
        _ => attempt(machine, before(machine, row, term), term, Some(atom)),
    }
}
