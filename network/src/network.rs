//! The network of a machine, and what a control state makes of it.

use adsdv_spec::table::{MAX_ROWS, MAX_TERMS};
use adsdv_spec::{AsState, Atom, Atoms, Control, Fault, Faults, Machine, Observation, Taken};

use crate::heard::Heard;

/// The guards of a machine as gates: its arrows, state by state, in the order of evaluation.
#[derive(Clone, Copy, Debug)]
pub struct Network {
    pub(crate) machine: Machine,
    gates: [Gate; MAX_ROWS * MAX_TERMS],
    /// Where the gates of each state begin; those of state `n` end where those of `n + 1` begin.
    begins: [usize; AsState::ALL.len() + 2],
}

/// A term of the table: what must hold for its arrow to be taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Gate {
    /// The atoms that must hold.
    pub on: Atoms,
    /// The atoms that must not hold.
    pub off: Atoms,
    /// Where its arrow leads.
    pub to: AsState,
    /// The fault that it is reported as; `None` where the faults of the inputs say it themselves.
    pub fault: Option<Fault>,
    /// Its place in the table.
    pub taken: Taken,
}

impl Network {
    /// The network of a machine.
    pub fn new(machine: &Machine) -> Self {
        const NOWHERE: Gate = Gate {
            on: Atoms::NONE,
            off: Atoms::NONE,
            to: AsState::Off,
            fault: None,
            taken: Taken { row: 0, term: 0 },
        };
        let mut network = Self {
            machine: *machine,
            gates: [NOWHERE; MAX_ROWS * MAX_TERMS],
            begins: [0; AsState::ALL.len() + 2],
        };
        let table = &machine.edition().rules.table;
        let mut filled = 0;
        for from in AsState::ALL {
            network.begins[from as usize] = filled;
            for taken in machine.arrows(from) {
                if let (Some(row), Some(term), true) =
                    (taken.row(table), taken.term(table), filled < network.gates.len())
                {
                    network.gates[filled] =
                        Gate { on: term.on, off: term.off, to: row.to, fault: term.fault, taken };
                    filled += 1;
                }
            }
            network.begins[from as usize + 1] = filled;
        }
        network
    }

    /// The machine.
    pub const fn machine(&self) -> &Machine {
        &self.machine
    }

    /// The network for steps out of a control state, `dt_ms` milliseconds after the last one.
    pub fn at(&self, control: &Control, dt_ms: u32) -> Wired<'_> {
        let machine = &self.machine;
        let outside = Observation::SCOPE.difference(machine.scope());
        let heard = Heard::of(machine, control.handshake, dt_ms);
        let always = machine.memory_atoms(control, dt_ms, Atoms::NONE);
        let most = machine.memory_atoms(control, dt_ms, Atoms::ALL);
        let lost = Atoms::when(Atom::AiCommsLost, heard.can_be_lost());
        Wired {
            machine,
            gates: self
                .gates
                .get(self.begins[control.state as usize]..self.begins[control.state as usize + 1])
                .unwrap_or_default(),
            control: *control,
            outside,
            opening: machine.opening(),
            always,
            by_input: most.difference(always),
            never: Atoms::ALL.difference(Observation::SCOPE).difference(most).difference(lost).union(outside),
            heard,
        }
    }
}

/// A network with what a control state decides wired in.
#[derive(Clone, Copy, Debug)]
pub struct Wired<'a> {
    pub(crate) machine: &'a Machine,
    /// Those of the state, in the order of evaluation.
    pub(crate) gates: &'a [Gate],
    pub(crate) control: Control,
    /// The conditions of inputs that the edition does not have.
    pub(crate) outside: Atoms,
    /// The faults that open the shutdown circuit.
    pub(crate) opening: Faults,
    /// The atoms that the control state decides, and which hold whatever is seen.
    pub(crate) always: Atoms,
    /// Those that hold when their input does.
    pub(crate) by_input: Atoms,
    /// Those that do not hold whatever is seen.
    pub(crate) never: Atoms,
    pub(crate) heard: Heard,
}
