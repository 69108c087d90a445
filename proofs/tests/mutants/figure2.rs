//! What the theorems of `figure2.rs` catch.

use crate::Mutant;

pub(crate) fn mutants() -> Vec<Mutant> {
    [
        ("a_step_is_what_the_document_says", "3.6: dropped"),
        ("a_step_is_what_the_document_says", "3.7 term 1: fault dropped"),
        ("a_step_is_what_the_document_says", "handshake +1"),
        ("off_to_ready", "3.1 term 0: power-cycle-needed dropped"),
        ("off_to_ready", "3.1 term 0: ebs-armed dropped"),
        ("ready_to_emergency_brake", "3.5 term 2: dropped"),
        ("ready_to_emergency_brake", "3.6: one place earlier"),
        ("ready_to_off", "3.6: leads to AS_FINISHED"),
        ("ready_to_driving", "ready dwell +1"),
        ("ready_to_driving", "straight +1"),
        ("ready_to_driving", "3.2 term 0: go-edge dropped"),
        ("driving_to_emergency_brake", "wheel speed +1"),
        ("driving_to_emergency_brake", "3.3: one place earlier"),
        ("driving_to_finished", "wheel speed -1"),
        ("driving_to_finished", "3.3 term 0: mission-finished flipped"),
        ("emergency_brake_to_off", "EBS timer +1"),
        ("emergency_brake_to_off", "3.9 term 0: asms dropped"),
        ("finished_to_emergency_brake", "3.8 term 1: dropped"),
        ("finished_to_off", "3.4: dropped"),
        ("no_other_arrow", "3.4: leads to AS_DRIVING"),
    ]
    .into_iter()
    .map(|(theorem, mutation)| Mutant::table(theorem, mutation))
    .collect()
}
