//! Conditions, in Promela and in the words of Figure 2.

use std::fmt;

use adsdv_spec::messages::AsState;
use adsdv_spec::table::Term;
use adsdv_spec::{Atom, Atoms, Choice, Fault, Faults, Machine, Observation, Rules};

use crate::document::Document;

/// The name of an atom in Promela: `go_on` for `go-on`.
pub(super) fn name(atom: Atom) -> String {
    atom.id().replace('-', "_")
}

/// All of these conditions, each with the value that it must have.
pub(super) fn all(conditions: impl Iterator<Item = (Atom, bool)>) -> String {
    let conditions: Vec<_> =
        conditions.map(|(atom, on)| format!("{}{}", if on { "" } else { "!" }, name(atom))).collect();
    if conditions.is_empty() { "true".into() } else { wrapped(&conditions, " && ", " &&\n            ") }
}

/// These, in lines of a length that can be read.
fn wrapped(items: &[impl AsRef<str>], between: &str, between_lines: &str) -> String {
    let line = |items: &[_]| items.iter().map(AsRef::as_ref).collect::<Vec<&str>>().join(between);
    items.chunks(PER_LINE).map(line).collect::<Vec<_>>().join(between_lines)
}

/// How many conditions stand in a line. Where one is broken, an operator ends it: Spin would end the statement otherwise.
const PER_LINE: usize = 4;

/// All of `on` and none of `off`.
pub(super) fn shows(on: Atoms, off: Atoms) -> String {
    all(on.iter().map(|atom| (atom, true)).chain(off.iter().map(|atom| (atom, false))))
}

/// One of these alternatives.
pub(super) fn any<'a>(terms: impl Iterator<Item = &'a Term>) -> String {
    wrapped(&bracketed(terms.map(|term| all(term.literals()))), " || ", " ||\n            ")
}

/// One of these expressions, in one line.
pub(super) fn one_of(expressions: impl Iterator<Item = String>) -> String {
    bracketed(expressions).join(" || ")
}

/// Expressions of which one must hold, so that each stands for itself; where there is none, none holds.
fn bracketed(expressions: impl Iterator<Item = String>) -> Vec<String> {
    let mut expressions: Vec<_> = expressions.collect();
    match expressions.as_mut_slice() {
        [] => expressions.push("false".into()),
        [_] => {}
        several => {
            for one in several.iter_mut().filter(|one| one.contains("&&")) {
                *one = format!("({one})");
            }
        }
    }
    expressions
}

/// A guard in the words of Figure 2.
pub(super) fn in_words<'a>(rules: &Rules, terms: impl Iterator<Item = &'a Term>, section: &str) -> String {
    let alternatives = terms.map(|term| {
        let words: Vec<_> = term.literals().map(|(atom, on)| rules.text(atom, on).to_string()).collect();
        let words =
            if words.is_empty() { "always".into() } else { wrapped(&words, " and ", "\n         *   and ") };
        if term.section == section { words } else { format!("{words} ({})", term.section) }
    });
    alternatives.collect::<Vec<_>>().join("\n         * or ")
}

/// The name of the cause that a fault is.
pub(super) fn cause(fault: Fault) -> String {
    format!("CAUSE_{}", fault.flag())
}

/// Whether a state is one of these.
pub(super) fn is_one_of(what: &str, states: &[AsState]) -> String {
    one_of(states.iter().map(|state| format!("{what} == {state}")))
}

/// The conditions of the inputs that the machine or its document has.
fn scope(machine: &Machine) -> Atoms {
    machine.scope().union(Document::of_machine(machine).scope)
}

/// Whether a fault of the battery does not open the shutdown circuit, to the machine.
pub(super) fn battery_is_apart(machine: &Machine) -> bool {
    machine.readings().is(Choice::BmsDriving)
}

/// What the machine goes by instead of `sdc_open` where that is so.
pub(super) const OTHERWISE_OPEN: &str = "sdc_open_otherwise";

/// A condition of the table as the machine sees it.
pub(super) fn seen_by(machine: &Machine, condition: String) -> String {
    if battery_is_apart(machine) {
        condition.replace(&name(Atom::SdcOpen), OTHERWISE_OPEN)
    } else {
        condition
    }
}

/// The atoms that are inputs of their own, not other names for faults.
pub(super) fn inputs_of(machine: &Machine) -> Atoms {
    let faults = Observation::new(Atoms::NONE, Observation::FAULTS);
    scope(machine).difference(faults.atoms())
}

/// Writes the inputs: what the environment chooses, and what follows from it.
pub(super) fn inputs(f: &mut fmt::Formatter<'_>, machine: &Machine) -> fmt::Result {
    let (rules, inputs) = (&machine.edition().rules, inputs_of(machine));
    f.write_str("/* The inputs of a step, chosen anew in each cycle: conditions, and faults by their flags in 520h. */\n")?;
    for atom in inputs.iter() {
        writeln!(f, "hidden byte {};  /* {} */", name(atom), rules.text(atom, true))?;
    }
    for fault in Observation::FAULTS.iter() {
        writeln!(f, "hidden byte {};", fault.flag())?;
    }
    let flags_of = |atom, faults: Faults| {
        let shown =
            |fault: &Fault| Observation::new(Atoms::NONE, Faults::NONE.with(*fault)).atoms().has(atom);
        one_of(faults.iter().filter(shown).map(|fault| fault.flag().into()))
    };
    for atom in scope(machine).difference(inputs).iter() {
        writeln!(f, "#define {} ({})", name(atom), flags_of(atom, Observation::FAULTS))?;
    }
    if battery_is_apart(machine) {
        let others = Observation::FAULTS.without(Fault::BmsFault);
        f.write_str(
            "/* The circuit that the machine sees: under this reading no fault of the battery opens it. */\n",
        )?;
        writeln!(f, "#define {OTHERWISE_OPEN} ({})", flags_of(Atom::SdcOpen, others))?;
    }
    let atoms = inputs.iter().map(|atom| format!("{} << {}", name(atom), atom as u8));
    let faults = Observation::FAULTS.iter().map(|fault| format!("{} << {}", fault.flag(), fault as u8));
    for (bits, inputs) in [("ATOMS", atoms.collect::<Vec<_>>()), ("FAULTS", faults.collect())] {
        writeln!(f, "#define {bits} ({})", wrapped(&inputs, " | ", " | \\\n    "))?;
    }
    f.write_str("\n")
}
