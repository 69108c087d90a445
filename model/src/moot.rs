//! Parts of the table that are moot: under the answers given they decide nothing, and under another answer they do.
//!
//! Version 4.0 reads BMS_FAULT as one of the faults that open the shutdown circuit, so that the alternative of its own that
//! Figure 2 has for it changes no step. It is there for those who read it otherwise.

use adsdv_spec::{Choice, Machine};

use crate::exploration::{Options, explore};
use crate::look::Engine;
use crate::parts::Part;
use crate::short_timers::short_timers;
use crate::vectors::Vectors;

/// Of these parts, those that decide a step of the machine when one question is answered otherwise, each with the first
/// answer under which it does.
///
/// Timers are short, by the lemma `short-timers`.
pub(crate) fn moot(machine: &Machine, dead: &[Part], threads: usize, engine: Engine) -> Vec<(Part, Choice)> {
    let edition = machine.edition();
    let document = short_timers(edition);
    let options = Options { vectors: Vectors::Few, threads, document, engine, further: 0 };
    let mut moot: Vec<(Part, Choice)> = Vec::new();
    for choice in edition.choices.difference(machine.readings().choices()).iter() {
        let mut left = dead.iter().filter(|part| moot.iter().all(|(other, _)| !other.is(part))).peekable();
        if left.peek().is_none() {
            break;
        }
        let other = Machine::new(edition.with_timing(document), machine.readings().with(choice));
        let parts = explore(other, options, |_| {}).parts;
        let decides = |part: &&Part| parts.iter().any(|(other, decides)| *decides && other.is(part));
        let found: Vec<_> = left.filter(decides).map(|part| (part.clone(), choice)).collect();
        moot.extend(found);
    }
    moot
}

#[cfg(test)]
mod tests {
    use adsdv_spec::{Atom, Edition, Row, Table, Term};

    use super::*;

    /// The parts that decide nothing, and those of them that are moot.
    fn found(edition: &Edition, choices: &[Choice]) -> (Vec<String>, Vec<String>) {
        let short = edition.with_timing(short_timers(edition));
        let readings = choices.iter().fold(edition.readings, |readings, &choice| readings.with(choice));
        let machine = Machine::new(short, readings);
        let options =
            Options { vectors: Vectors::Few, threads: 1, document: short.rules.timing, ..Options::default() };
        let parts = explore(machine, options, |_| {}).parts;
        let dead: Vec<Part> =
            parts.into_iter().filter(|(_, decides)| !decides).map(|(part, _)| part).collect();
        let moot = moot(&machine, &dead, 1, Engine::default());
        let listed = moot.iter().map(|(part, choice)| format!("{part}, but for {choice}"));
        (dead.iter().map(Part::to_string).collect(), listed.collect())
    }

    #[test]
    fn with_its_default_answers_no_edition_has_a_part_that_is_dead_for_good() {
        for edition in crate::state_machines() {
            let (dead, moot) = found(edition, &[]);
            assert_eq!(dead.len(), moot.len(), "{}: {dead:?}, {moot:?}", edition.version);
        }
    }

    #[test]
    fn a_fault_of_the_battery_that_opens_the_circuit_needs_no_alternative_of_its_own() {
        let edition = Edition::find("4.0").expect("it has the question");
        let part = "AS_DRIVING -> EMERGENCY_BRAKE (3.7): BMS_FAULT == TRUE";
        assert_eq!(
            found(edition, &[]),
            (vec![part.to_owned()], vec![format!("{part}, but for bms-fault=driving")])
        );
        assert_eq!(found(edition, &[Choice::BmsDriving]), (vec![], vec![]));
    }

    #[test]
    fn without_the_latch_the_power_cycle_is_moot() {
        let (dead, moot) = found(Edition::DEFAULT, &[Choice::PowerCycleNotLatched]);
        assert_eq!((dead.len(), moot.len()), (1, 1), "{dead:?}");
        assert!(moot[0].ends_with(", but for power-cycle=latched"), "{moot:?}");
    }

    /// An alternative that cannot hold is moot under no answer.
    #[test]
    fn what_no_answer_brings_to_life_is_not_moot() {
        let mut rows = Edition::DEFAULT.rules.table.rows().to_vec();
        let finished = rows.iter_mut().find(|row| row.section == "3.3").expect("a row");
        let mut terms = finished.terms().to_vec();
        terms.push(Term::on("3.3", &[Atom::MissionFinished, Atom::EbsTimerComplete]));
        *finished = Row::new(finished.from, finished.to, finished.section, &terms);
        let (dead, moot) = found(&Edition::DEFAULT.with_table(Table::new(&rows)), &[]);
        assert!(!dead.is_empty() && moot.is_empty(), "{dead:?}, {moot:?}");
    }
}
