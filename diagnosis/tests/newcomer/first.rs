//! One that runs the handshake all the time, and makes mistakes that hide one another.

use adsdv_diagnosis::{Deviation, Diagnosis};
use adsdv_spec::{AsState, Inputs};

use AsState::{Driving, EmergencyBrake, Finished, Off, Ready};

use crate::asked::{self, EDITION, Newcomer, raw};

const HVIL_OPEN: i32 = 2;
const EBS: i32 = 4;
const COMMS: i32 = 6;
const AI_REQUEST: i32 = 1;

/// What is wrong with the state machine; without anything it is against decisions of this project alone, where the document is silent.
#[derive(Clone, Copy, Debug, Default)]
struct Mistakes {
    /// The AI Computer has 100 ms to answer.
    patient: bool,
    /// ESTOP_REQUEST is looked at in AS_DRIVING alone.
    estop_while_driving: bool,
    /// FINISHED and NEUTRAL while the vehicle moves are no emergencies.
    plausible: bool,
    /// An emergency in AS_DRIVING has a cause of its own.
    own_causes: bool,
    /// SHUTDOWN_CAUSE and the need of a power cycle end with the emergency.
    forgets: bool,
}

/// The state machine.
#[derive(Debug)]
struct First {
    mistakes: Mistakes,
    state: AsState,
    lasts_ms: u32,
    bit: bool,
    unanswered_ms: u32,
    cause: i32,
    needs_power_cycle: bool,
    go_before: bool,
}

impl First {
    const fn new(mistakes: Mistakes) -> Self {
        let (state, lasts_ms, bit, unanswered_ms, cause) = (Off, 0, false, 0, 0);
        Self {
            mistakes,
            state,
            lasts_ms,
            bit,
            unanswered_ms,
            cause,
            needs_power_cycle: false,
            go_before: true,
        }
    }

    fn go_to(&mut self, state: AsState) {
        (self.state, self.lasts_ms) = (state, 0);
    }

    fn brake(&mut self, cause: i32) {
        if self.cause == 0 {
            self.cause = cause;
        }
        self.needs_power_cycle = true;
        self.go_to(EmergencyBrake);
    }
}

impl Newcomer for First {
    fn anew(&self) -> Self {
        Self::new(self.mistakes)
    }

    fn one_step(&mut self, dt_ms: u32, inputs: &Inputs) -> [i32; 4] {
        let raw = |key: &str| raw(inputs, key);
        let is = |key: &str| raw(key) != 0;
        let Mistakes { patient, estop_while_driving, plausible, own_causes, forgets } = self.mistakes;
        self.lasts_ms = self.lasts_ms.saturating_add(dt_ms);
        // It never rests.
        if is("handshake") == self.bit {
            (self.bit, self.unanswered_ms) = (!self.bit, 0);
        } else {
            self.unanswered_ms = self.unanswered_ms.saturating_add(dt_ms);
        }
        let lost = self.unanswered_ms >= if patient { 100 } else { 50 };
        let open = is("remote_estop") || is("vehicle_estop") || is("hvil_open");
        let go_edge = is("go") && !self.go_before;
        self.go_before = is("go");
        let wheels = ["fl_wheel_speed", "fr_wheel_speed", "rl_wheel_speed", "rr_wheel_speed"];
        let moves = wheels.iter().any(|wheel| raw(wheel) > 10);
        let rests = wheels.iter().all(|wheel| raw(wheel) < 10);
        let (neutral, finished) = (!is("direction_request"), raw("mission_status") == 3);
        let estop = is("estop_request");
        let asked = ["front_axle_trq_request", "rear_axle_trq_request", "steer_request"];
        match self.state {
            Off if is("asms")
                && is("tsms")
                && is("ami")
                && raw("mission_status") == 1
                && raw("ebs") == 2
                && (forgets || !self.needs_power_cycle) =>
            {
                self.go_to(Ready);
            }
            Ready | Finished if open => self.brake(HVIL_OPEN),
            Ready | Finished if lost => self.brake(COMMS),
            Ready | Finished if estop && !estop_while_driving => self.brake(AI_REQUEST),
            Ready | Finished if !is("asms") => self.go_to(Off),
            Ready
                if self.lasts_ms >= 5000
                    && go_edge
                    && neutral
                    && raw("steer_angle").abs() < 50
                    && !asked.iter().any(|key| is(key)) =>
            {
                self.go_to(Driving);
            }
            Driving if open || !is("go") || !is("asms") => {
                self.brake(if own_causes { EBS } else { HVIL_OPEN });
            }
            Driving if estop => self.brake(AI_REQUEST),
            Driving if lost => self.brake(COMMS),
            Driving if moves && neutral && !plausible => self.brake(7),
            Driving if moves && finished && !plausible => self.brake(8),
            Driving if finished && rests => self.go_to(Finished),
            EmergencyBrake if self.lasts_ms >= 15_000 && !is("asms") => {
                self.go_to(Off);
                if forgets {
                    self.cause = 0;
                }
            }
            _ => {}
        }
        [self.state.raw(), self.bit.into(), lost.into(), self.cause]
    }
}

fn found(mistakes: Mistakes) -> Diagnosis {
    asked::found(First::new(mistakes))
}

/// What it does its own way with no mistake at all: answers to open questions, which fault counts of two, for how long one shows, and
/// when the handshake begins.
const OWN: &[&str] = &[
    "driving:cause:2-before-1",
    "go-edge=edge",
    "handshake-active=always",
    "remembers:live-flags",
    "remembers:time-before-handshake",
];
/// The same, where it looks at ESTOP_REQUEST in each state.
const IN_EACH_STATE: &[&str] = &[
    "finished:cause:2-before-1",
    "finished:cause:6-before-1",
    "ready:cause:2-before-1",
    "ready:cause:6-before-1",
];

#[track_caller]
fn names(mistakes: Mistakes, expected: &[&str]) {
    let found = found(mistakes);
    let in_each_state = if mistakes.estop_while_driving { &[] } else { IN_EACH_STATE };
    asked::names(&found, expected.iter().chain(OWN).chain(in_each_state));
}

#[test]
fn a_program_that_is_its_own_only_where_the_document_is_silent_has_no_other_deviation() {
    names(Mistakes::default(), &[]);
    for id in OWN.iter().chain(IN_EACH_STATE) {
        let Some(deviation) = Deviation::find(EDITION, id) else { continue };
        let requirements = deviation.requirements(EDITION);
        assert!(requirements.iter().any(|id| id.starts_with("D-")), "{id}: {requirements:?}");
    }
}

#[test]
fn an_estop_request_that_two_states_do_not_look_at_is_another_answer_to_an_open_question() {
    let mistakes = Mistakes { estop_while_driving: true, ..Mistakes::default() };
    names(mistakes, &["ai-estop=driving"]);
}

#[test]
fn two_implausibilities_that_are_missing_are_two() {
    let mistakes = Mistakes { plausible: true, ..Mistakes::default() };
    names(mistakes, &["driving-brake:4:missing", "driving-brake:6:missing"]);
}

#[test]
fn causes_that_depend_on_the_state_are_named_by_the_state() {
    let mistakes = Mistakes { own_causes: true, ..Mistakes::default() };
    names(mistakes, &["driving:cause:2=4"]);
}

#[test]
fn all_mistakes_of_a_newcomer_are_named_one_by_one() {
    let mistakes = Mistakes {
        patient: true,
        estop_while_driving: true,
        plausible: true,
        own_causes: true,
        forgets: true,
    };
    names(
        mistakes,
        &[
            "ai-estop=driving",
            "driving-brake:4:missing",
            "driving-brake:6:missing",
            "driving:cause:2=4",
            "handshake:+50ms",
            "power-cycle=not-latched",
            "remembers:cause-until-left",
        ],
    );
}
