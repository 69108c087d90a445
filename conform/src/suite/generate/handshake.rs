//! The handshake at every phase: each edge answered, unanswered for nearly too long and for too long, in every state.

use adsdv_spec::Machine;
use adsdv_spec::messages::AsState;

use super::{Walk, test, walk_cycle};
use crate::suite::{Kind, Test};

/// The tests of section 2.4 and Figure 1.
pub(super) fn tests(machine: &Machine) -> Vec<Test> {
    let limit = u32::from(machine.edition().rules.timing.handshake_ms);
    let cycle = walk_cycle(machine);
    let on = || Walk::new(machine).set(|inputs| inputs.tsms = true);
    let started = || on().cycle();
    let tests = [
        (
            "goes-round",
            "both edges are answered, again and again",
            started().cycle().cycle().cycle(),
            vec!["MSG-42", "HS-1", "HS-4", "HS-6", "HS-7", "HS-8", "HS-12"],
        ),
        (
            "rising-edge-waits",
            "the bit stays as it is while its rising edge is unanswered",
            started().answering(false).step(limit - 1, |_| {}),
            vec!["HS-6", "HS-13", "HS-15"],
        ),
        (
            "rising-edge-lost",
            "the rising edge is unanswered for too long, and answered at last",
            started().answering(false).step(limit - 1, |_| {}).step(1, |_| {}).answering(true).cycle(),
            vec!["HS-9", "HS-15", "HS-16", "D-18"],
        ),
        (
            "falling-edge-lost",
            "the falling edge is unanswered for too long, however late the last answer came",
            started()
                .answering(false)
                .step(limit - 1, |_| {})
                .answering(true)
                .cycle()
                .answering(false)
                .step(limit - 1, |_| {})
                .step(1, |_| {}),
            vec!["HS-7", "HS-9", "HS-16"],
        ),
        (
            "answered-just-in-time",
            "the answer is seen at the very step at which the time is full",
            started().step(limit, |_| {}),
            vec!["HS-9", "D-26"],
        ),
        (
            "longer-than-the-limit",
            "the fault lasts for as long as the edge is unanswered",
            started().answering(false).step(limit + 1, |_| {}).step(10 * limit, |_| {}),
            vec!["HS-9", "HS-15"],
        ),
        (
            "begins-unanswered",
            "the AI Computer sends 1 before the handshake begins: no time counts before its first step",
            on().answering(false).step(limit, |_| {}).step(limit - 1, |_| {}).step(1, |_| {}),
            vec!["HS-12", "HS-16", "D-44"],
        ),
        (
            "rests-without-tsms",
            "TSMS off ends the handshake and its fault, and it begins anew",
            started()
                .answering(false)
                .step(limit, |_| {})
                .set(|inputs| inputs.tsms = false)
                .cycle()
                .set(|inputs| inputs.tsms = true)
                .answering(true)
                .step(cycle, |_| {}),
            vec!["HS-1", "D-8", "D-18"],
        ),
        (
            "never-without-tsms",
            "no silence is a fault while TSMS is off",
            Walk::new(machine).answering(false).step(10 * limit, |_| {}),
            vec!["HS-1", "D-8"],
        ),
    ];
    let mut tests: Vec<Test> = tests
        .into_iter()
        .map(|(name, about, walk, ids)| {
            test(Kind::Handshake, format!("handshake-{name}"), about, "2.4", walk).checks(ids)
        })
        .collect();
    for state in AsState::ALL {
        let about = format!("the AI Computer falls silent in {state}");
        let walk = Walk::to(machine, state).cycle().answering(false).step(limit - 1, |_| {}).step(1, |_| {});
        tests.push(
            test(Kind::Handshake, format!("handshake-silent-in-{state}"), about, "2.4", walk)
                .checks(["HS-9", "HS-10", "D-10", "MSG-59"]),
        );
    }
    tests
}
