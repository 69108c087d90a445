//! The handshake as section 2.4 tells it and Figure 1 draws it.

use adsdv_spec::messages::{AsState, ShutdownCause};
use adsdv_spec::{Control, Edition, Handshake, Inputs, Machine};

const LIMIT_MS: u16 = Edition::V3_0.rules.timing.handshake_ms;

/// A handshake that is performed, a step of 5 ms later.
fn after_5_ms(vcu: Handshake, answer: bool) -> Handshake {
    vcu.step(true, answer, 5, LIMIT_MS)
}

/// Figure 1: the AI Computer answers after 20 ms, and the VCU needs 5 ms for its own next edge.
//= HS-4, HS-6 to HS-8, HS-12 to HS-14
#[test]
fn figure_1_has_a_period_of_50_ms() {
    let mut vcu = Handshake::IDLE;
    let (mut edges, mut edge_at) = (Vec::new(), 0);
    for now_ms in (0..500).step_by(5) {
        // The answer is the bit of 20 ms ago, seen at the next step of the VCU.
        let answer = if now_ms >= edge_at + 25 { vcu.bit } else { !vcu.bit };
        let answer = if edges.is_empty() { false } else { answer };
        let before = vcu.bit;
        vcu = after_5_ms(vcu, answer);
        assert!(!vcu.is_lost(LIMIT_MS), "at {now_ms} ms");
        if vcu.bit != before {
            edges.push((now_ms, vcu.bit));
            edge_at = now_ms;
        }
    }
    let expected: Vec<_> = (0..500).step_by(25).map(|ms| (ms, ms % 50 == 0)).collect();
    assert_eq!(edges, expected, "it begins with a rising edge, and then alternates");
}

/// The bit waits for the answer, and the fault comes 50 ms after the edge: when the last answer came does not matter.
//= HS-9, HS-15, HS-16, D-26
#[test]
fn an_edge_that_stays_unanswered_is_a_fault_after_50_ms() {
    for answered_after in [0, 5, 20, 45] {
        let mut vcu = after_5_ms(Handshake::IDLE, false);
        for _ in 0..answered_after / 5 {
            vcu = after_5_ms(vcu, !vcu.bit);
        }
        let mut vcu = after_5_ms(vcu, vcu.bit);
        let edge = vcu.bit;
        for ms in (5..=200).step_by(5) {
            let in_time = after_5_ms(vcu, edge);
            assert!(!in_time.is_lost(LIMIT_MS) && in_time.bit != edge, "an answer at {ms} ms ends the wait");
            vcu = after_5_ms(vcu, !edge);
            assert_eq!((vcu.bit, vcu.is_lost(LIMIT_MS)), (edge, ms >= 50), "{ms} ms after the edge");
        }
    }
}

/// What went before the handshake began does not count.
//= HS-1, D-8, D-44
#[test]
fn it_is_performed_while_tsms_is_on_and_begins_anew_with_it() {
    let vcu = Machine::REFERENCE;
    let mut control = Control::INITIAL;
    // An AI Computer that says 1, and would not be answering.
    let mut inputs = Inputs::default();
    inputs.ai.status.handshake = true;
    for _ in 0..2 {
        inputs.tsms = false;
        for _ in 0..20 {
            control = vcu.step(&control, &inputs, 10).0;
            assert_eq!(control.handshake, Handshake::IDLE);
        }
        inputs.tsms = true;
        for ms in (0..=100).step_by(10) {
            control = vcu.step(&control, &inputs, 10).0;
            assert_eq!(control.handshake.is_lost(LIMIT_MS), ms >= 50, "{ms} ms after TSMS came on");
        }
    }
}

/// In the states in which the vehicle may move or stands ready, the fault stops it; in AS_OFF it only shows.
//= HS-10, D-10, D-18, MSG-59
#[test]
fn a_fault_stops_the_vehicle_but_in_as_off() {
    let vcu = Machine::REFERENCE;
    let mut inputs = Inputs { asms: true, tsms: true, go: true, ..Inputs::default() };
    let lost = Handshake { active: true, bit: true, unanswered_ms: LIMIT_MS };
    for state in AsState::ALL {
        let control = Control { state, handshake: lost, ..Control::INITIAL };
        inputs.ai.status.handshake = false;
        let (after, outputs) = vcu.step(&control, &inputs, 10);
        assert!(outputs.messages(&inputs).status.ai_comms_lost, "{state}");
        let stays = matches!(state, AsState::Off | AsState::EmergencyBrake);
        assert_eq!(after.state, if stays { state } else { AsState::EmergencyBrake }, "{state}");
        assert_eq!(after.shutdown_cause == ShutdownCause::AiCommsFault, !stays, "{state}");

        inputs.ai.status.handshake = true;
        let (after, outputs) = vcu.step(&control, &inputs, 10);
        assert!(!outputs.messages(&inputs).status.ai_comms_lost, "{state}: answered at last");
        assert_eq!(after.state, state);
    }
}
