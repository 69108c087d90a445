//! What the theorems of `network.rs` catch: networks of other machines than the step is of.

use adsdv_network::Network;
use adsdv_proofs::subject::Subject;
use adsdv_spec::{Choice, Edition, Machine};

use crate::{Mutant, mutations};

/// For each AS state and edition: what the network has otherwise, and whether it is seen in a factor, or in the groups.
pub(crate) fn mutants() -> Vec<Mutant> {
    let step = |from: &str, change| {
        Mutant::new(leak(format!("the_network_is_the_step_from_{from}")), &format!("{change:?}"), change)
    };
    let group = |from: &str, change| {
        let theorem = leak(format!("lanes_of_a_group_come_to_the_same_from_{from}"));
        Mutant::new(theorem, &format!("{change:?}"), change)
    };
    let (table, answer) = (OtherNetwork::Table, OtherNetwork::Answer);
    let mut mutants = Vec::new();
    for suffix in ["", "_in_4_0"] {
        let of = |from: &str| format!("{from}{suffix}");
        mutants.extend([
            step(&of("off"), table("3.1: dropped")),
            step(&of("ready"), table("3.6: dropped")),
            step(&of("driving"), table("3.3: dropped")),
            step(&of("emergency_brake"), table("3.9: dropped")),
            step(&of("finished"), table("3.4: dropped")),
            step(&of("finished"), answer(Choice::HandshakeAlways)),
            group(&of("off"), table("3.1: dropped")),
            group(&of("ready"), answer(Choice::GoEdgeEnough)),
            group(&of("driving"), table("3.3: dropped")),
            group(&of("emergency_brake"), table("3.9: dropped")),
            group(&of("finished"), table("3.4: dropped")),
        ]);
    }
    mutants.extend([
        step("ready_otherwise", answer(Choice::HandshakeTsms)),
        step("driving_otherwise", table("3.3: dropped")),
        step("driving_by_edges", answer(Choice::FaultLevel)),
        group("off_otherwise", table("3.1: dropped")),
        group("ready_otherwise", answer(Choice::GoSeenLow)),
        group("driving_otherwise", table("3.3: dropped")),
        group("driving_by_edges", answer(Choice::FaultLevel)),
        group("emergency_brake_otherwise", table("3.9: dropped")),
        group("finished_otherwise", table("3.4: dropped")),
    ]);
    mutants
}

fn leak(text: String) -> &'static str {
    Box::leak(text.into_boxed_str())
}

/// A network of a machine that has something otherwise.
#[derive(Clone, Copy, Debug)]
enum OtherNetwork {
    /// The mutation of this name.
    Table(&'static str),
    /// Another answer.
    Answer(Choice),
}

impl Subject for OtherNetwork {
    fn network(&self, machine: &Machine) -> Network {
        let (edition, readings) = (machine.edition(), machine.readings());
        Network::new(&match *self {
            Self::Table(name) => {
                let of: &Edition = Edition::find(edition.version).expect("it is published");
                let found = mutations::all_of(of).find(|mutant| mutant.name == name);
                Machine::new(found.expect("there is such a mutation").edition, readings)
            }
            Self::Answer(choice) => Machine::new(*edition, readings.with(choice)),
        })
    }
}
