//! The conditions that no input of a program can change, and what can therefore not be found out about it.

use adsdv_spec::mutation::{Change, TermChange};
use adsdv_spec::{AsState, Atom, Atoms, Edition, Inputs, Term};

use crate::deviation::Deviation;
use crate::dials::dials;
use crate::interface::Interface;
use crate::model::Model;

/// The keys of the wheels, in the order of the message.
const WHEELS: [&str; 4] = ["fl_wheel_speed", "fr_wheel_speed", "rl_wheel_speed", "rr_wheel_speed"];
/// What is remembered of a condition that changed: without a change there is none.
const EDGES: [(Atom, Atom); 3] = [
    (Atom::GoEdge, Atom::GoOn),
    (Atom::MissionFinishedEdge, Atom::MissionFinished),
    (Atom::DirectionNeutralEdge, Atom::DirectionNeutral),
];

/// The conditions that always are as they are at power-on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fixed {
    atoms: Atoms,
    at_power_on: Atoms,
}

impl Fixed {
    /// Those that the inputs of a program cannot change, and all inputs could.
    pub(crate) fn of(edition: &Edition, interface: &Interface) -> Self {
        let usual = Model::new(edition, &[]);
        let at_power_on = observed(&usual, &Inputs::default());
        let fixed = changing(&usual, &Interface::default()).difference(changing(&usual, interface));
        let edges = EDGES.iter().filter(|(_, atom)| fixed.has(*atom));
        let atoms = edges.fold(fixed, |fixed, (edge, _)| fixed.with(*edge));
        Self { atoms, at_power_on }
    }

    /// Whether an alternative of an arrow can hold at all.
    pub(crate) fn can_hold(&self, term: &Term) -> bool {
        term.literals().all(|(atom, on)| !self.atoms.has(atom) || self.at_power_on.has(atom) == on)
    }

    /// Whether an arrow can be taken, by any of its alternatives.
    pub(crate) fn can_be_taken(&self, edition: &Edition, from: AsState, to: AsState) -> bool {
        let usual = Model::new(edition, &[]);
        usual.terms(from).any(|(term, leads)| leads == to && self.can_hold(&term))
    }

    /// Whether the inputs of a program can tell a deviation from another that says as much.
    pub(crate) fn can_tell(&self, edition: &Edition, interface: &Interface, deviation: &Deviation) -> bool {
        let rows = edition.rules.table.rows();
        let holds = |row: usize, term: usize| {
            rows.get(row).and_then(|row| row.terms().get(term)).is_some_and(|term| self.can_hold(term))
        };
        match *deviation {
            Deviation::Changed(Change::Term(row, term, change)) => match change {
                TermChange::LiteralDropped(atom) | TermChange::LiteralFlipped(atom) => !self.atoms.has(atom),
                _ => holds(row, term),
            },
            Deviation::Joined { row, one, other } => holds(row, one) && holds(row, other),
            Deviation::Wheels(wheels) => {
                let mut counted = WHEELS.iter().enumerate().filter(|(wheel, _)| wheels.looks_at(*wheel));
                counted.all(|(_, key)| interface.has(key))
            }
            _ => true,
        }
    }
}

/// The conditions that hold by these inputs.
pub(crate) fn observed(usual: &Model, inputs: &Inputs) -> Atoms {
    let machine = usual.machine();
    machine.atoms_of(inputs.observe(&machine.edition().rules.thresholds))
}

/// The conditions that these inputs change, by one of them or by two.
fn changing(usual: &Model, interface: &Interface) -> Atoms {
    let dials = dials(usual, interface);
    let changes = || dials.iter().flat_map(|dial| dial.values.iter().map(|raw| (dial.field, *raw)));
    let plain = observed(usual, &Inputs::default());
    let mut changing = Atoms::NONE;
    for (one, raw) in changes() {
        let mut first = Inputs::default();
        (one.set)(&mut first, raw);
        for (other, raw) in changes() {
            let mut both = first;
            (other.set)(&mut both, raw);
            let seen = observed(usual, &both);
            changing = changing.union(seen.difference(plain)).union(plain.difference(seen));
        }
    }
    changing
}
