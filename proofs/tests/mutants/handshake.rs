//! What the theorems of `handshake.rs` catch.

use adsdv_proofs::subject::Subject;
use adsdv_spec::Handshake;

use crate::Mutant;

pub(crate) fn mutants() -> Vec<Mutant> {
    let of = |theorem, what, step| Mutant::new(theorem, what, Stepping(step));
    vec![
        of("lost_if_and_only_if_unanswered_for_50_ms", "lost after 51 ms", |vcu, active, answer, dt_ms| {
            vcu.step(active, answer, dt_ms, 51)
        }),
        of(
            "lost_if_and_only_if_unanswered_for_50_ms",
            "a first step counts",
            |vcu, active, answer, dt_ms| Handshake { active: true, ..vcu }.step(active, answer, dt_ms, 50),
        ),
        of(
            "the_bit_turns_when_it_is_answered",
            "the bit turns with the fault",
            |vcu, active, answer, dt_ms| {
                let after = vcu.step(active, answer, dt_ms, 50);
                Handshake { bit: after.bit ^ (after.active && after.unanswered_ms == 50), ..after }
            },
        ),
        of("the_bit_turns_when_it_is_answered", "it never rests", |vcu, _, answer, dt_ms| {
            vcu.step(true, answer, dt_ms, 50)
        }),
        of("a_partner_in_time_is_never_lost", "an answer at 50 ms is late", |vcu, active, answer, dt_ms| {
            let after = vcu.step(active, answer, dt_ms, 50);
            let late = vcu.active && u32::from(vcu.unanswered_ms).saturating_add(dt_ms) >= 50;
            if late { Handshake { unanswered_ms: 50, ..after } } else { after }
        }),
        of(
            "a_silent_partner_is_always_found_out",
            "a long step does not count",
            |vcu, active, answer, dt_ms| vcu.step(active, answer, if dt_ms > 40 { 0 } else { dt_ms }, 50),
        ),
    ]
}

type Step = fn(Handshake, bool, bool, u32) -> Handshake;

#[derive(Clone)]
struct Stepping(Step);

impl Subject for Stepping {
    fn handshake(&self, before: Handshake, active: bool, answer: bool, dt_ms: u32) -> Handshake {
        (self.0)(before, active, answer, dt_ms)
    }
}
