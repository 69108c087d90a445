//! What the theorems on version 4.0 catch.

use adsdv_spec::messages::AsState;
use adsdv_spec::{Choice, Edition, Fault, Faults, Machine};

use crate::otherwise::Otherwise;
use crate::{Changed, Mutant};

/// Mistakes in the table of 4.0, its times and its thresholds.
const TABLE: &[(&str, &[&str])] = &[
    (
        "a_step_of_4_0_is_what_the_document_says",
        &["handshake -1", "missed message -1", "3.7 term 10: dropped"],
    ),
    ("driving_sdc_in_4_0", &["3.7 term 0: dropped", "3.3: one place earlier"]),
    ("driving_asms_in_4_0", &["3.7 term 1: dropped", "3.7 term 1: fault dropped"]),
    ("driving_go_off_in_4_0", &["3.7 term 2: dropped", "3.7 term 2: fault dropped"]),
    ("driving_finished_in_4_0", &["3.7 term 3: dropped", "3.7 term 3: fault dropped", "wheel speed +1"]),
    ("driving_neutral_in_4_0", &["3.7 term 4: dropped", "3.7 term 4: fault dropped", "wheel speed +1"]),
    (
        "driving_brake_plausibility_in_4_0",
        &["3.7 term 5: dropped", "3.7 term 6: dropped", "3.7 term 6: fault dropped"],
    ),
    ("driving_estop_in_4_0", &["3.7 term 7: dropped"]),
    ("driving_handshake_in_4_0", &["3.7 term 8: dropped", "handshake +1"]),
    ("driving_missed_in_4_0", &["3.7 term 8: dropped", "missed message +1"]),
    ("driving_ebs_in_4_0", &["3.7 term 10: dropped", "3.7 term 10: fault dropped"]),
    (
        "driving_founded_in_4_0",
        &[
            "3.7 term 5: brake-request-zero dropped",
            "3.7 term 10: ebs-unavailable flipped",
            "handshake -1",
            "missed message -1",
            "wheel speed -1",
        ],
    ),
    ("driving_cause_in_4_0", &["3.7 term 10: fault dropped", "3.7 term 6: fault dropped"]),
    ("standing_brakes_in_4_0", &["3.5 term 0: dropped", "3.8 term 1: dropped", "missed message +1"]),
    ("handshake_in_4_0", &["handshake +1", "handshake -1"]),
    ("comms_lost_in_4_0", &["handshake -1", "missed message +1"]),
];

pub(crate) fn mutants() -> Vec<Mutant> {
    let of_table = |&(theorem, mutations): &(&'static str, &[&str])| {
        mutations.iter().map(|mutation| Mutant::table_of_4_0(theorem, mutation)).collect::<Vec<_>>()
    };
    let read_as = |theorem, choice: Choice| {
        Mutant::new(theorem, &choice.to_string(), Changed::read_as(&Edition::V4_0, choice))
    };
    let mut watches_3_0 = Edition::V3_0;
    watches_3_0.rules.thresholds.missed_ms = Some(100);
    let mut others = vec![
        read_as("standing_brakes_in_4_0", Choice::EstopEveryState),
        read_as("standing_brakes_in_4_0", Choice::CommsDriving),
        read_as("standing_brakes_in_4_0", Choice::BmsDriving),
        read_as("driving_brake_plausibility_in_4_0", Choice::TorqueNever),
        read_as("comms_lost_in_4_0", Choice::WatchAlways),
        read_as("driving_founded_in_4_0", Choice::WatchAlways),
        Mutant::new("driving_bms_in_4_0", "a fault of the battery counts neither way", {
            let dropped = Changed::named_in(&Edition::V4_0, "3.7 term 9: dropped").edition;
            let machine = Machine::new(dropped, dropped.readings.with(Choice::BmsDriving));
            Changed { edition: dropped, machine }
        }),
        Mutant::new(
            "comms_lost_in_4_0",
            "the flag stays in AS_READY",
            Otherwise(|before, _, after, outputs| {
                if before.handshake.unanswered_ms == 100 && after.state == AsState::Ready {
                    outputs.faults = outputs.faults.union(Faults::NONE.with(Fault::AiCommsFault));
                }
            }),
        ),
        Mutant::new(
            "silence",
            "the silence of 513h forgets that \"Go\" was off",
            Otherwise(|_, inputs, after, _| {
                after.go_seen_low &= inputs.ai_silence.steer_silence_ms < 50;
                after.handshake.bit ^= inputs.ai_silence.steer_silence_ms == 77;
            }),
        ),
    ];
    others.extend(
        ["no_silence_matters_in_3_0", "what_an_edition_lacks_never_matters"].map(|theorem| {
            Mutant::new(theorem, "3.0 watches for missed messages", Changed::of(&watches_3_0))
        }),
    );
    TABLE.iter().flat_map(of_table).chain(others).collect()
}
