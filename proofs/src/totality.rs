//! Nothing panics, overflows or reads out of bounds, whatever it is given: also with control states that no VCU gets to,
//! and after the longest time that can be counted.
//!
//! Kani checks that by itself, in everything that a harness reaches; without Kani the tests panic. Each theorem asserts a
//! little more: that what comes out is something that there is. That no frame makes a decoder panic is in
//! [`codec`](crate::codec).

use adsdv_spec::messages::AsState::{self, Driving, EmergencyBrake, Finished, Off, Ready};
use adsdv_spec::messages::{Frame, Vcu2AiSteer};
use adsdv_spec::{Control, Faults, Inputs, Observation, Outputs, Taken, VcuMessages};

use crate::invariant::counts_to_ms;
use crate::prelude::*;

/// Notes the extremes of a step: the longest time, a timer beyond its limit, and a control state that there cannot be.
fn cover_extremes(before: &Control, dt_ms: u32) {
    kani::cover!(dt_ms == u32::MAX, "the longest time");
    kani::cover!(before.in_state_ms > counts_to_ms(before.state), "a timer beyond its limit");
    kani::cover!(before.state == Driving && before.power_cycle_needed, "driving after an emergency");
}

/// **A step is total.** Every control state, all inputs and every time have an answer, in which no timer is beyond its
/// limit and no fault is shown that there is not.
///
/// Requirements: SM-1, DRV-4, ETO-1, HS-9.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn a_step_is_total() {
    let Step { before, dt_ms, after, outputs, .. } = Step::of(kani::any(), kani::any(), kani::any());
    cover_extremes(&before, dt_ms);
    assert!(after.in_state_ms <= counts_to_ms(after.state), "the time in the state is within its limit");
    assert!(after.handshake.unanswered_ms <= 50, "the handshake's time is within its limit");
    assert!(outputs.faults.is_subset(Faults::ALL), "the faults are faults");
}

/// **A reaction is total.** Every control state, every observation and every time have an answer, in which an arrow is taken
/// exactly where the state changes.
///
/// Requirements: SM-1, SM-18.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn a_reaction_is_total() {
    let (before, seen, dt_ms): (Control, Observation, u32) = (kani::any(), kani::any(), kani::any());
    let reaction = subject().react(&before, seen, dt_ms);
    cover_extremes(&before, dt_ms);
    kani::cover!(reaction.taken.is_some(), "an arrow is taken");
    let stays = reaction.control.state == before.state;
    assert!(reaction.taken.is_none() == stays, "an arrow is taken exactly where the state changes");
}

/// **Observing is total.** All inputs have an observation, and it is one that inputs can have.
///
/// Requirements: SM-1.
#[cfg_attr(kani, kani::proof, kani::unwind(2))]
pub fn an_observation_is_total() {
    let inputs: Inputs = kani::any();
    let seen = subject().observe(&inputs);
    kani::cover!(inputs.vehicle.steer_angle.raw() == -240, "the steering is all the way to the right");
    kani::cover!(inputs.vehicle.wheel_speeds.fl_wheel_speed.raw() == 10, "a wheel at the limit");
    kani::cover!(inputs.reports.charging && !inputs.asms && !inputs.tsms, "charging, which is no fault now");
    assert!(seen.is_possible(), "inputs can look like this");
}

/// Claims it of any control state of an AS state.
fn what_is_read_is_total(state: AsState) {
    let (before, dt_ms) = (Control { state, ..kani::any() }, kani::any());
    let (subject, reads) = (subject(), subject().reads(&before, dt_ms));
    kani::cover!(dt_ms == u32::MAX, "the longest time");
    kani::cover!(before.in_state_ms > counts_to_ms(before.state), "a timer beyond its limit");
    assert!(reads.atoms.is_subset(Observation::SCOPE), "conditions that inputs decide");
    assert!(reads.atoms.is_subset(subject.machine().edition().scope()), "conditions that the edition has");
    assert!(reads.faults.is_subset(Observation::FAULTS), "faults that inputs decide");
}

harnesses! {
    /// **The machine says of every control state what a step can depend on**, and it is what inputs can show, and what the edition has.
    /// As nothing else decides a step ([`factoring`](crate::factoring)), what an edition lacks can never matter in it.
    ///
    /// Requirements: SM-1.
    unwind 31;
    what_is_read_in_off_is_total = what_is_read_is_total(Off);
    what_is_read_in_ready_is_total = what_is_read_is_total(Ready);
    what_is_read_in_driving_is_total = what_is_read_is_total(Driving);
    what_is_read_in_finished_is_total = what_is_read_is_total(Finished);
    what_is_read_in_emergency_brake_is_total = what_is_read_is_total(EmergencyBrake);
}

/// Claims that what a step from this state takes was possible; whether anything was.
///
/// A harness for each state, and a loop over the rows by their numbers: so a proof knows each row as a constant.
#[expect(clippy::needless_range_loop, reason = "an index is what makes a row a constant")]
#[expect(
    clippy::cast_possible_truncation,
    reason = "a table has at most MAX_ROWS rows, and a row MAX_TERMS terms"
)]
fn what_is_taken_is_possible(state: AsState) -> bool {
    let before = Control { state, ..kani::any() };
    let Step { dt_ms, after, outputs, .. } = Step::of(before, kani::any(), kani::any());
    let subject = subject();
    let machine = subject.machine();
    let rows = machine.edition().rules.table.rows();
    let (mut found, mut any) = (false, false);
    for row in 0..rows.len() {
        if rows[row].from != state {
            continue;
        }
        for term in 0..rows[row].terms().len() {
            let alternative = Taken { row: row as u8, term: term as u8 };
            let possible = machine.is_possible(&before, dt_ms, alternative);
            any |= possible;
            found |= possible && outputs.taken == Some(alternative) && rows[row].to == after.state;
        }
    }
    kani::cover!(dt_ms == u32::MAX, "the longest time");
    kani::cover!(outputs.taken.is_some(), "an arrow is taken");
    assert!(found || outputs.taken.is_none(), "what is taken is possible, and leads where the step leads");
    any
}

/// **The machine says what is possible of every control state in AS_OFF**: the alternative that a step takes is among those that were.
///
/// Requirements: SM-1, SM-18.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn what_is_taken_in_off_is_possible() {
    let any = what_is_taken_is_possible(Off);
    kani::cover!(!any, "nothing is possible before a power cycle");
}

/// **The machine says what is possible of every control state in AS_READY.**
///
/// Requirements: SM-1, SM-18.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn what_is_taken_in_ready_is_possible() {
    what_is_taken_is_possible(Ready);
}

/// **The machine says what is possible of every control state in AS_DRIVING.**
///
/// Requirements: SM-1, SM-18.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn what_is_taken_in_driving_is_possible() {
    what_is_taken_is_possible(Driving);
}

/// **The machine says what is possible of every control state in AS_FINISHED.**
///
/// Requirements: SM-1, SM-18.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn what_is_taken_in_finished_is_possible() {
    what_is_taken_is_possible(Finished);
}

/// **The machine says what is possible of every control state in EMERGENCY_BRAKE.**
///
/// Requirements: SM-1, SM-18.
#[cfg_attr(kani, kani::proof, kani::unwind(13))]
pub fn what_is_taken_in_emergency_brake_is_possible() {
    let any = what_is_taken_is_possible(EmergencyBrake);
    kani::cover!(!any, "nothing is possible while the EBS timer runs");
}

/// **What a step shows can be looked up**: every number of a row or a term has an answer, if only that there is none.
///
/// Requirements: SM-1.
#[cfg_attr(kani, kani::proof, kani::unwind(2))]
pub fn what_was_taken_is_looked_up() {
    let outputs = any_outputs();
    let subject = subject();
    let (row, term) = (outputs.row(subject.machine()), outputs.term(subject.machine()));
    kani::cover!(row.is_some() && term.is_none(), "a row without that term");
    kani::cover!(row.is_none() && outputs.taken.is_some(), "there is no such row");
    kani::cover!(term.is_some(), "there is a term");
    assert!(outputs.taken.is_some() || row.is_none(), "no row where none was taken");
    assert!(row.is_some() || term.is_none(), "a term is a row's");
    let in_figure_2 = outputs.taken.is_some_and(|taken| taken.row < 9);
    assert!(row.is_some() == in_figure_2, "Figure 2 has nine arrows");
}

/// **What reaches the actuators is total**: all outputs and all requests have an answer.
///
/// Requirements: D-21, D-42, D-43.
#[cfg_attr(kani, kani::proof, kani::unwind(2))]
pub fn an_actuation_is_total() {
    let (outputs, inputs) = (any_outputs(), kani::any());
    let actuation = subject().actuation(&outputs, &inputs);
    kani::cover!(actuation.front_axle_trq.raw() > 1900, "nearly all the torque there is");
    assert!(
        actuation.steer.is_some() == (outputs.state == Driving),
        "the steering is active in AS_DRIVING only"
    );
    assert!(
        actuation.ebs_triggered == (outputs.state == EmergencyBrake),
        "the EBS brakes in EMERGENCY_BRAKE only"
    );
}

/// **What the VCU sends is total**: all outputs and all inputs make messages. No mean, sum or percentage of what was measured
/// and requested overflows.
///
/// Requirements: MSG-48.
#[cfg_attr(kani, kani::proof, kani::unwind(2))]
pub fn messages_are_total() {
    let (outputs, inputs): (Outputs, Inputs) = (any_outputs(), kani::any());
    let messages = subject().messages(&outputs, &inputs);
    let (front, rear) = (inputs.ai.drive_f.front_axle_trq_request, inputs.ai.drive_r.rear_axle_trq_request);
    kani::cover!(front.raw() > 1900 && rear.raw() > 1900, "nearly all the torque there is");
    kani::cover!(inputs.vehicle.front_axle_trq.raw() < 0, "a torque that brakes");
    assert!(messages.status.as_state == outputs.state, "AS_STATE is the state");
}

/// **Every message can be sent**: whatever its fields hold, each that the edition has becomes a frame that can be on the bus.
///
/// Requirements: D-30, D-34.
#[cfg_attr(kani, kani::proof, kani::unwind(12))]
pub fn frames_are_total() {
    let messages = VcuMessages {
        status: kani::any(),
        drive_f: kani::any(),
        drive_r: kani::any(),
        steer: kani::any(),
        brake: kani::any(),
        wheel_speeds: kani::any(),
        wheel_counts: kani::any(),
        log_dynamics: kani::any(),
        vcu_status: kani::any(),
        log_status: kani::any(),
    };
    kani::cover!(messages.wheel_speeds.fl_wheel_speed.raw() == 1250, "a wheel turns as fast as it can");
    for message in messages.all() {
        let Some(frame) = Layouts::write(&message) else { continue };
        let frame = subject().sent(frame);
        assert!(0x500 <= frame.id && frame.id <= 0x526, "an identifier of the VCU");
        assert!(frame.len <= 8, "as long as a frame can be");
    }
}

/// **The lenient reading is total**: a row of any place and width, also one that no table has, reads and writes any data of
/// any length; and where it does not fit a frame it reads nothing, and leaves the data as it is.
///
/// Requirements: D-30.
#[cfg_attr(kani, kani::proof, kani::unwind(10))]
pub fn a_row_of_any_shape_is_total() {
    let mut row = <Vcu2AiSteer as Coded>::DEF.signals[0];
    (row.start, row.width, row.signed) = (kani::any(), kani::any(), kani::any());
    (row.min, row.max) = (kani::any(), kani::any());
    let data: [u8; 9] = kani::any();
    let len = usize::from(kani::any_where(|len: &u8| *len <= 9));
    let raw: i32 = kani::any();
    let [b0, b1, b2, b3, b4, b5, b6, b7, _] = data;
    let frame = [b0, b1, b2, b3, b4, b5, b6, b7];

    let end = u32::from(row.start) + u32::from(row.width);
    let fits = 1 <= row.width && row.width <= 32 && end <= 64;
    let read = row.raw(&data[..len]);
    let put = subject().put(&row, frame, raw);
    kani::cover!(!fits && row.width == 255 && row.start == 255, "far out of the frame");
    kani::cover!(row.width == 32 && read.is_some(), "as wide as can be");
    assert!(read.is_some() == (fits && end.div_ceil(8) as usize <= len), "read if it fits and is there");
    assert!(
        fits || u64::from_le_bytes(put) == u64::from_le_bytes(frame),
        "what does not fit changes nothing"
    );
    assert!(row.allows(raw) == (row.min <= raw && raw <= row.max), "allowed in its range");
}

/// **A frame is total**: with any identifier, length and data it gives the bytes that are sent, and says whether it can be on
/// the bus; and it is made of any data that fits.
///
/// Requirements: D-30, D-34.
#[cfg_attr(kani, kani::proof, kani::unwind(10))]
pub fn a_frame_is_total() {
    let frame = Frame { id: kani::any(), len: kani::any(), data: kani::any() };
    let sent = frame.data().len();
    kani::cover!(frame.len == 255, "longer than a frame");
    kani::cover!(frame.is_valid() && frame.len == 8, "all of it is sent");
    assert!(sent == usize::from(frame.len).min(8), "as many bytes as it says, at most eight");
    let unsent = u64::from_le_bytes(frame.data).checked_shr(8 * u32::from(frame.len)).unwrap_or(0);
    let valid = frame.id <= 0x7FF && frame.len <= 8 && unsent == 0;
    assert!(frame.is_valid() == valid, "it can be on the bus");

    let data: [u8; 9] = kani::any();
    let len = usize::from(kani::any_where(|len: &u8| *len <= 9));
    let made = subject().frame(frame.id, &data[..len]);
    assert!(made.is_some() == (frame.id <= 0x7FF && len <= 8), "made of what fits");
    assert!(made.is_none_or(|made| made.is_valid() && usize::from(made.len) == len), "and valid");
}

theorems![
    a_step_is_total,
    a_reaction_is_total,
    an_observation_is_total,
    what_is_read_in_off_is_total,
    what_is_read_in_ready_is_total,
    what_is_read_in_driving_is_total,
    what_is_read_in_finished_is_total,
    what_is_read_in_emergency_brake_is_total,
    what_is_taken_in_off_is_possible,
    what_is_taken_in_ready_is_possible,
    what_is_taken_in_driving_is_possible,
    what_is_taken_in_finished_is_possible,
    what_is_taken_in_emergency_brake_is_possible,
    what_was_taken_is_looked_up,
    an_actuation_is_total,
    messages_are_total,
    frames_are_total,
    a_row_of_any_shape_is_total,
    a_frame_is_total,
];
