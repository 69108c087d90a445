//! What the theorems of `safety` catch: for each property a mistake in the table, and mistakes that no table has.

use adsdv_proofs::subject::Subject;
use adsdv_spec::messages::ShutdownCause;
use adsdv_spec::{Actuation, AsState, Choice, Inputs, Outputs};

use crate::Mutant;
use crate::otherwise::{Otherwise, ReadAs};

/// Mistakes in the table, the times and the thresholds.
const TABLE: &[(&str, &[&str])] = &[
    (
        "ready_switches",
        &["3.1 term 0: asms dropped", "3.1 term 0: tsms dropped", "3.1 term 0: ebs-armed flipped"],
    ),
    ("ready_ami", &["3.1 term 0: ami-selected dropped"]),
    ("ready_mission_status", &["3.1 term 0: mission-selected dropped"]),
    ("ready_due", &["3.1: dropped", "3.1 term 0: power-cycle-needed flipped"]),
    ("driving_dwell", &["3.2 term 0: dwell-elapsed dropped", "ready dwell -1"]),
    (
        "driving_requests",
        &[
            "3.2 term 0: front-torque-zero dropped",
            "3.2 term 0: rear-torque-zero dropped",
            "3.2 term 0: steer-request-zero dropped",
            "3.2 term 0: steer-straight dropped",
            "3.2 term 0: direction-neutral dropped",
            "straight +1",
        ],
    ),
    ("driving_go", &["3.2 term 0: go-edge dropped", "3.2 term 0: dwell-elapsed dropped", "straight -1"]),
    ("driving_due", &["3.2: dropped", "ready dwell +1", "straight -1"]),
    ("driving_sdc", &["3.7 term 0: dropped", "3.3: one place earlier"]),
    ("driving_asms", &["3.7 term 2: dropped", "3.3: one place earlier"]),
    ("driving_go_off", &["3.7 term 1: dropped", "3.3: one place earlier"]),
    ("driving_finished", &["3.7 term 3: dropped", "wheel speed +1"]),
    ("driving_neutral", &["3.7 term 5: dropped", "wheel speed +1"]),
    ("driving_comms", &["3.7 term 7: dropped", "handshake +1"]),
    ("driving_estop", &["3.7 term 8: dropped"]),
    ("ready_sdc", &["3.5 term 0: dropped", "3.6: one place earlier"]),
    ("finished_sdc", &["3.8 term 0: dropped", "3.4: one place earlier"]),
    ("ready_asms", &["3.6: dropped"]),
    ("finished_asms", &["3.4: dropped"]),
    ("ready_comms", &["3.5 term 1: dropped", "handshake +1"]),
    ("finished_comms", &["3.8 term 1: dropped", "handshake +1"]),
    ("ready_estop", &["3.5 term 2: dropped"]),
    ("finished_estop", &["3.8 term 2: dropped"]),
    (
        "finished_at_rest",
        &["3.3 term 0: mission-finished dropped", "3.3 term 0: at-rest dropped", "wheel speed +1"],
    ),
    ("finished_due", &["3.3: dropped", "wheel speed -1"]),
    ("figure_2_arrows", &["3.6: leads to AS_FINISHED"]),
    ("brake_founded", &["3.7 term 5: moving dropped", "handshake -1", "wheel speed -1"]),
    ("off_founded", &["3.6 term 0: asms flipped", "3.4 term 0: asms dropped"]),
    ("actuators", &["3.7 term 0: dropped", "3.7 term 1: dropped", "3.7 term 2: dropped"]),
    ("go_signal", &["3.2 term 0: go-edge dropped"]),
    ("brake_time", &["3.9 term 0: ebs-timer-complete dropped", "EBS timer -1"]),
    ("brake_asms", &["3.9 term 0: asms dropped"]),
    ("brake_due", &["3.9: dropped", "EBS timer +1"]),
    ("power_cycle", &["3.1 term 0: power-cycle-needed dropped"]),
    ("shutdown_cause", &["3.7 term 1: fault dropped"]),
    ("control_invariant", &["handshake -1", "handshake +1", "ready dwell -1", "EBS timer +1"]),
];

pub(crate) fn mutants() -> Vec<Mutant> {
    let of_table = |&(theorem, mutations): &(&'static str, &[&str])| {
        mutations.iter().map(|mutation| Mutant::table(theorem, mutation)).collect::<Vec<_>>()
    };
    TABLE.iter().flat_map(of_table).chain(of_memory()).chain(of_outputs()).collect()
}

/// Mistakes in what is remembered.
fn of_memory() -> [Mutant; 10] {
    let otherwise = |theorem, what, change| Mutant::new(theorem, what, Otherwise(change));
    [
        otherwise("driving_go", "that \"Go\" was seen off is never forgotten", |before, _, after, _| {
            after.go_seen_low |= before.go_seen_low;
        }),
        otherwise(
            "driving_go",
            "\"Go\" that is off at the first look at AS_READY counts",
            |before, inputs, after, _| {
                after.go_seen_low |=
                    before.state == AsState::Off && after.state == AsState::Ready && !inputs.go;
            },
        ),
        otherwise("brake_time", "the timer goes on in the next state", |before, _, after, _| {
            if after.state == AsState::EmergencyBrake {
                after.in_state_ms = after.in_state_ms.max(before.in_state_ms);
            }
        }),
        otherwise("shutdown_cause", "the last cause stays", |_, inputs, after, outputs| {
            if after.state == AsState::EmergencyBrake && inputs.sdc.bms_fault {
                after.shutdown_cause = ShutdownCause::BmsFault;
                outputs.shutdown_cause = ShutdownCause::BmsFault;
            }
        }),
        otherwise("shutdown_cause", "AS_OFF forgets the cause", |_, _, after, outputs| {
            if outputs.taken.is_some() && after.state == AsState::Off {
                after.shutdown_cause = ShutdownCause::NoShutdown;
            }
        }),
        otherwise("shutdown_cause", "520h shows the cause a step late", |before, _, _, outputs| {
            outputs.shutdown_cause = before.shutdown_cause;
        }),
        otherwise(
            "control_invariant",
            "the timer begins anew when the handshake is answered",
            |_, _, after, _| {
                if after.handshake.unanswered_ms == 0 {
                    after.in_state_ms = 0;
                }
            },
        ),
        otherwise("control_invariant", "the handshake waits for its first edge", |before, _, after, _| {
            if !before.handshake.active && after.handshake.active && !after.handshake.bit {
                after.handshake.unanswered_ms = 1;
            }
        }),
        otherwise("control_invariant", "the bit stays as it is", |before, _, after, _| {
            if before.handshake.active && after.handshake.active {
                after.handshake.bit = before.handshake.bit;
            }
        }),
        otherwise("control_invariant", "no power cycle is needed", |_, _, after, _| {
            after.power_cycle_needed = false;
        }),
    ]
}

/// Mistakes in what is shown, and choices that the defaults are not.
fn of_outputs() -> [Mutant; 6] {
    let read_as = |theorem, choice: Choice| Mutant::new(theorem, &choice.to_string(), ReadAs::new(choice));
    [
        Mutant::new("actuators", "AS_FINISHED steers on", SteersOn),
        read_as("comms_tsms", Choice::HandshakeAlways),
        read_as("go_signal", Choice::GoRaw),
        read_as("ready_ami", Choice::MissionStatusOnly),
        read_as("ready_mission_status", Choice::MissionAmi),
        read_as("control_invariant", Choice::HandshakeAlways),
    ]
}

/// The steering goes on in AS_FINISHED.
#[derive(Clone)]
struct SteersOn;

impl Subject for SteersOn {
    fn actuation(&self, outputs: &Outputs, inputs: &Inputs) -> Actuation {
        let actuation = outputs.actuation(inputs);
        if outputs.state == AsState::Finished {
            return Actuation { steer: Some(inputs.ai.steer.steer_request), ..actuation };
        }
        actuation
    }
}
