//! The arrow that is taken, and what is remembered then.

use adsdv_proofs::subject::Subject;
use adsdv_spec::belief::{Causes, Handshakes, KnownFaults, Look, Memory, Now, Outcome, Possible};
use adsdv_spec::messages::{AsState, ShutdownCause};
use adsdv_spec::{Atoms, Faults, Handshake, Knowledge, Machine, Taken, Truth};

use crate::Mutant;

/// The theorems on what is taken and on what is remembered, by their AS state.
const STATES: [(&str, AsState); 5] = [
    ("off", AsState::Off),
    ("ready", AsState::Ready),
    ("driving", AsState::Driving),
    ("emergency_brake", AsState::EmergencyBrake),
    ("finished", AsState::Finished),
];

pub(crate) fn mutants() -> Vec<Mutant> {
    let mut mutants = Vec::new();
    for (state, from) in STATES {
        for edition in ["", "_in_4_0"] {
            for looks in Looks::ALL.into_iter().filter(|looks| looks.matters_in(from)) {
                let theorem = format!("the_way_out_of_{state}_is_among_the_outcomes{edition}");
                mutants.push(Mutant::new(known(&theorem), looks.what(), looks));
            }
        }
        for forgets in Forgets::ALL.into_iter().filter(|forgets| forgets.matters_in(from)) {
            let theorem = format!("what_is_remembered_after_{state}_may_be");
            mutants.push(Mutant::new(known(&theorem), forgets.what(), forgets));
        }
    }
    for forgets in [Forgets::Reasons, Forgets::OtherTerms] {
        mutants.push(Mutant::new("what_is_remembered_after_driving_may_be_in_4_0", forgets.what(), forgets));
    }
    mutants
}

/// The theorem of this name.
fn known(name: &str) -> &'static str {
    adsdv_proofs::theorems::Theorem::find(name).unwrap_or_else(|| panic!("there is no theorem {name}")).name
}

/// Looks at an arrow otherwise.
#[derive(Clone, Copy)]
enum Looks {
    Hopes,
    Doubts,
    Ends,
    LearnsThatItFails,
}

impl Looks {
    const ALL: [Self; 4] = [Self::Hopes, Self::Doubts, Self::Ends, Self::LearnsThatItFails];

    /// Whether anything comes of it in a step from this state.
    const fn matters_in(self, from: AsState) -> bool {
        match self {
            // Each arrow out of it has one condition alone.
            Self::LearnsThatItFails => !matches!(from, AsState::Finished),
            _ => true,
        }
    }

    const fn what(self) -> &'static str {
        match self {
            Self::Hopes => "an arrow that may be taken is",
            Self::Doubts => "an arrow that is taken may be passed over",
            Self::Ends => "no state stays",
            Self::LearnsThatItFails => "each condition of an arrow that is passed over fails",
        }
    }
}

impl Subject for Looks {
    fn look(&self, machine: &Machine, from: AsState, place: usize, known: Knowledge) -> Look {
        let look = machine.look(from, place, known);
        match (self, look.outcome) {
            (Self::Hopes, Some(_)) => Look { rest: None, ..look },
            (Self::Doubts, Some(Outcome { taken: Some(_), .. })) => Look { rest: Some(known), ..look },
            (Self::Ends, Some(Outcome { taken: None, .. })) => Look { outcome: None, ..look },
            (Self::LearnsThatItFails, Some(Outcome { known: given, .. })) => {
                let learnt = given.on().union(given.off());
                let learnt = learnt.difference(known.on()).difference(known.off());
                let rest = look.rest.map(|rest| rest.learn(learnt, learnt.difference(given.on())));
                Look { rest, ..look }
            }
            _ => look,
        }
    }
}

/// Remembers otherwise.
#[derive(Clone, Copy)]
enum Forgets {
    Time,
    Handshake,
    Faults,
    Reasons,
    OtherTerms,
    Cause,
    PowerCycle,
    Go,
}

impl Forgets {
    const ALL: [Self; 8] = [
        Self::Time,
        Self::Handshake,
        Self::Faults,
        Self::Reasons,
        Self::OtherTerms,
        Self::Cause,
        Self::PowerCycle,
        Self::Go,
    ];

    const fn what(self) -> &'static str {
        match self {
            Self::Time => "a state that is entered has lasted as long as the one before it",
            Self::Handshake => "the handshake rests",
            Self::Faults => "no fault is shown",
            Self::Reasons => "an arrow has no reason",
            Self::OtherTerms => "only what is taken is a reason",
            Self::Cause => "a cause is forgotten",
            Self::PowerCycle => "nobody knows whether a power cycle is needed",
            Self::Go => "\"Go\" may always have been seen off",
        }
    }

    /// Whether anything comes of it in a step from this state.
    fn matters_in(self, from: AsState) -> bool {
        match self {
            // These have no arrow into EMERGENCY_BRAKE.
            Self::Reasons => !matches!(from, AsState::Off | AsState::EmergencyBrake),
            // The other states' alternatives have one fault.
            Self::OtherTerms => matches!(from, AsState::Driving),
            _ => true,
        }
    }
}

impl Subject for Forgets {
    fn remember_known(
        &self,
        machine: &Machine,
        from: AsState,
        memory: &Memory,
        now: &Now,
        taken: Option<(Taken, AsState)>,
    ) -> Possible {
        let possible = machine.remember_known(from, memory, now, taken);
        let of_memory = |memory| Possible { memory, ..possible };
        match self {
            Self::Time => of_memory(Memory { in_state: now.in_state, ..possible.memory }),
            Self::Handshake => {
                let rests = Handshakes::exact(Handshake::IDLE);
                of_memory(Memory { handshake: rests, ..possible.memory })
            }
            Self::Faults => Possible { faults: KnownFaults::exact(Faults::NONE), ..possible },
            Self::Reasons => {
                let stays = machine.remember_known(from, memory, now, None);
                of_memory(Memory { shutdown_cause: stays.memory.shutdown_cause, ..possible.memory })
            }
            Self::OtherTerms => {
                // As if no other condition were known to hold.
                let atoms = now.atoms.forget(Atoms::ALL);
                let now = Now { atoms, ..*now };
                let possible = machine.remember_known(from, memory, &now, taken);
                let only = KnownFaults::new(possible.faults.present(), Faults::ALL);
                Possible { faults: only, ..possible }
            }
            Self::Cause => of_memory(Memory {
                shutdown_cause: Causes::exact(ShutdownCause::NoShutdown),
                ..possible.memory
            }),
            Self::PowerCycle => of_memory(Memory { power_cycle_needed: Truth::Unknown, ..possible.memory }),
            Self::Go => of_memory(Memory { go_seen_low: Truth::Unknown, ..possible.memory }),
        }
    }
}
