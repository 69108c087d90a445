//! One that begins the handshake with 1 whenever the tractive system comes on, leaves its bit as it was when that goes off, and takes a
//! tractive system that is off for an open shutdown circuit.

use adsdv_spec::{AsState, Inputs};

use AsState::{Driving, EmergencyBrake, Finished, Off, Ready};

use crate::asked::{Newcomer, found, names, raw};

/// What is wrong with the state machine, beside what is against decisions of this project alone.
#[derive(Clone, Copy, Debug, Default)]
struct Slips {
    /// AS_READY lasts for four seconds at least.
    hasty: bool,
    /// NEUTRAL while the vehicle moves is no emergency.
    rolls: bool,
    /// ESTOP_REQUEST is not looked at in AS_FINISHED.
    deaf_when_finished: bool,
    /// SHUTDOWN_CAUSE is not written yet.
    no_cause: bool,
}

/// The state machine.
#[derive(Debug)]
struct Second {
    slips: Slips,
    state: AsState,
    lasts_ms: u32,
    bit: bool,
    waits_ms: u32,
    lost: bool,
    cause: i32,
    go_before: bool,
    tsms_before: bool,
    braked: bool,
}

impl Second {
    const fn new(slips: Slips) -> Self {
        Self {
            slips,
            state: Off,
            lasts_ms: 0,
            bit: false,
            waits_ms: 0,
            lost: false,
            cause: 0,
            go_before: false,
            tsms_before: false,
            braked: false,
        }
    }

    fn shake_hands(&mut self, dt_ms: u32, tsms: bool, answer: bool) {
        if tsms && !self.tsms_before {
            (self.bit, self.waits_ms) = (true, 0);
        } else if tsms && answer == self.bit {
            (self.bit, self.waits_ms) = (!self.bit, 0);
        } else if tsms {
            self.waits_ms = self.waits_ms.saturating_add(dt_ms);
            self.lost |= self.waits_ms >= 50;
        }
        self.tsms_before = tsms;
    }
}

impl Newcomer for Second {
    fn anew(&self) -> Self {
        Self::new(self.slips)
    }

    fn one_step(&mut self, dt_ms: u32, inputs: &Inputs) -> [i32; 4] {
        let raw = |key: &str| raw(inputs, key);
        let is = |key: &str| raw(key) != 0;
        let Slips { hasty, rolls, deaf_when_finished, no_cause } = self.slips;
        self.lasts_ms = self.lasts_ms.saturating_add(dt_ms);
        self.shake_hands(dt_ms, is("tsms"), is("handshake"));
        let circuit = !is("tsms") || is("hvil_open") || is("vehicle_estop") || is("remote_estop");
        let wheels = ["fl_wheel_speed", "fr_wheel_speed", "rl_wheel_speed", "rr_wheel_speed"].map(raw);
        let fastest = wheels.into_iter().max().unwrap_or_default();
        let edge = is("go") && !self.go_before;
        self.go_before = is("go");
        let (finished, neutral) = (raw("mission_status") == 3, !is("direction_request"));
        let asked = ["front_axle_trq_request", "rear_axle_trq_request", "steer_request"].map(raw) != [0; 3];
        let emergency = |faults: &[(bool, i32)]| faults.iter().find(|(is, _)| *is).map(|(_, cause)| *cause);
        let (ai, comms) = ((is("estop_request"), 1), (self.lost, 6));
        let ai_finished = (ai.0 && !deaf_when_finished, 1);
        let cause = match self.state {
            Ready => emergency(&[(circuit, 2), comms, ai]),
            Driving => emergency(&[
                (circuit || !is("go") || !is("asms"), 2),
                comms,
                ai,
                (neutral && fastest > 10 && !rolls, 7),
                (finished && fastest > 10, 8),
            ]),
            Finished => emergency(&[(circuit, 2), comms, ai_finished]),
            Off | EmergencyBrake => None,
        };
        let next = match self.state {
            _ if cause.is_some() => Some(EmergencyBrake),
            Off if is("asms")
                && is("tsms")
                && is("ami")
                && raw("mission_status") == 1
                && raw("ebs") == 2
                && !self.braked =>
            {
                Some(Ready)
            }
            Ready | Finished if !is("asms") => Some(Off),
            Ready
                if self.lasts_ms >= if hasty { 4000 } else { 5000 }
                    && edge
                    && neutral
                    && !asked
                    && raw("steer_angle").abs() < 50 =>
            {
                Some(Driving)
            }
            Driving if finished && fastest < 10 => Some(Finished),
            EmergencyBrake if self.lasts_ms >= 15_000 && !is("asms") => Some(Off),
            _ => None,
        };
        if let Some(cause) = cause.filter(|_| self.cause == 0 && !no_cause) {
            self.cause = cause;
        }
        if let Some(next) = next {
            (self.state, self.lasts_ms) = (next, 0);
            self.braked |= next == EmergencyBrake;
        }
        [self.state.raw(), self.bit.into(), self.lost.into(), self.cause]
    }
}

/// What it does its own way with no mistake at all.
const OWN: &[&str] = &[
    "go-edge=edge",
    "opens:tsms=0",
    "remembers:comms-lost-for-good",
    "remembers:handshake-begins-with-1",
    "remembers:handshake-bit",
];
/// Which of two faults counts, where it writes a cause.
const CAUSES: &[&str] = &[
    "driving:cause:2-before-1",
    "driving:cause:6-before-1",
    "finished:cause:2-before-1",
    "finished:cause:6-before-1",
    "ready:cause:2-before-1",
    "ready:cause:6-before-1",
];

#[test]
fn a_handshake_and_a_shutdown_circuit_of_its_own_hide_nothing() {
    let found = found(Second::new(Slips::default()));
    names(&found, OWN.iter().chain(CAUSES));
}

#[test]
fn its_slips_are_named_one_by_one() {
    let slips = Slips { hasty: true, rolls: true, deaf_when_finished: true, no_cause: true };
    let expected = [
        "brake:shows:shutdown_cause=0",
        "driving-brake:6:missing",
        "finished-brake:3:missing",
        "ready-dwell:-1000ms",
        // It has none in AS_OFF either.
        "remembers:cause-until-left",
    ];
    names(&found(Second::new(slips)), expected.iter().chain(OWN));
}
