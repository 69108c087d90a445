//! Messages of the AI Computer that are missed: each nearly too long and too long, in every state, watched and not.

use adsdv_spec::messages::AsState;
use adsdv_spec::{AiSilence, Atom, Machine};

use super::{Walk, braking_by, test, walk_cycle};
use crate::protocol::{INPUTS, InputField};
use crate::suite::{Kind, Test};

/// The tests of section 2.4 and 4 about missed messages; none where the edition has no such rule.
pub(super) fn tests(machine: &Machine) -> Vec<Test> {
    let Some(limit) = machine.edition().rules.thresholds.missed_ms else { return Vec::new() };
    let silences = INPUTS.iter().filter(|field| field.part == "ai_silence");
    let mut tests: Vec<Test> = silences.flat_map(|field| of_message(machine, field, limit)).collect();
    tests.extend(AsState::ALL.map(|state| in_state(machine, state, limit)));
    tests.push(with_tsms(machine, limit));
    tests.push(and_no_answer(machine, limit));
    tests
}

/// One message missing in AS_DRIVING, just below, at, and just above the limit.
fn of_message(machine: &Machine, field: &'static InputField, limit: u16) -> Vec<Test> {
    let limit = i32::from(limit);
    let of = |silence: i32| {
        let walk = Walk::to(machine, AsState::Driving).step(walk_cycle(machine), |inputs| {
            (field.set)(inputs, silence);
        });
        let about = format!("{} is {silence} in AS_DRIVING, and the other messages come", field.key);
        let rows = braking_by(machine, Atom::AiCommsLost).flat_map(|term| term.cites.requirements).copied();
        test(Kind::Limit, format!("missed-{}-{silence}", field.key), about, "2.4", walk)
            .checks(["HS-18", "D-52", "MSG-59"].into_iter().chain(rows))
    };
    [limit - 1, limit, limit + 1].map(of).into()
}

/// No message comes any more in a state, for nearly too long, and for too long; then they come again.
fn in_state(machine: &Machine, state: AsState, limit: u16) -> Test {
    let cycle = walk_cycle(machine);
    let walk = Walk::to(machine, state)
        .set(|inputs| inputs.tsms = true)
        .step(cycle, |inputs| inputs.ai_silence = AiSilence::of(limit - 1))
        .step(1, |inputs| inputs.ai_silence = AiSilence::of(limit))
        .step(cycle, |inputs| inputs.ai_silence = AiSilence::default());
    let about = format!("no message of the AI Computer comes in {state}, and then they come again");
    test(Kind::Handshake, format!("missed-in-{state}"), about, "2.4", walk)
        .checks(["HS-18", "HS-10", "D-52", "D-10", "D-18", "MSG-59"])
}

/// Silence is no fault while TSMS is off, and counts all the same.
fn with_tsms(machine: &Machine, limit: u16) -> Test {
    let cycle = walk_cycle(machine);
    let walk = Walk::new(machine)
        .step(cycle, |inputs| inputs.ai_silence = AiSilence::of(limit))
        .step(cycle, |inputs| inputs.tsms = true)
        .step(cycle, |inputs| inputs.tsms = false);
    let about = "missed messages are a fault while TSMS is on, even if they were missed before, and none while it is off";
    test(Kind::Handshake, "missed-with-tsms", about, "2.4", walk).checks(["HS-18", "D-52", "D-18"])
}

/// Messages are missed and the handshake is unanswered: the fault lasts for as long as either does.
fn and_no_answer(machine: &Machine, limit: u16) -> Test {
    let (cycle, handshake) = (walk_cycle(machine), machine.edition().rules.timing.handshake_ms);
    let walk = Walk::new(machine)
        .step(cycle, |inputs| inputs.tsms = true)
        .answering(false)
        .step(handshake.into(), |inputs| inputs.ai_silence.status_silence_ms = limit)
        .step(cycle, |inputs| inputs.ai_silence = AiSilence::default())
        .answering(true)
        .step(cycle, |inputs| inputs.ai_silence.brake_silence_ms = limit)
        .step(cycle, |inputs| inputs.ai_silence = AiSilence::default());
    let about =
        "messages are missed and the handshake is unanswered: the fault lasts for as long as either does";
    test(Kind::Handshake, "missed-and-unanswered", about, "2.4", walk)
        .checks(["HS-18", "D-52", "D-18", "MSG-59"])
}
