//! The expectations that scenarios share.

use adsdv_spec::messages::{
    Ai2LogDynamics2, Ai2VcuBrake, Ai2VcuDriveF, Ai2VcuDriveR, Ai2VcuStatus, Ai2VcuSteer, AsState,
    MissionStatus,
};

use crate::expectation::{Expectation, Kind, Within};
use crate::look::{Look, SENT};

/// In this time a program that runs has sent each of its messages once, and has answered what the operator does.
const SOON: Within = Within::Ms(1000);
/// What a person at the car would wait.
const PATIENT: Within = Within::Ms(2000);
/// Twice as often as every 10 ms, with some room.
const TOO_OFTEN: usize = 150;
/// Two messages of three are missing, one after the other, in milliseconds.
const GAP_MS: u64 = 30;

const fn sends(
    against: &'static [&'static str],
    seen: &'static str,
    expected: &'static str,
    then: fn(&Look) -> bool,
) -> Expectation {
    let kind = Kind::Comes { when: |look| look.runs_ms.is_some(), then, within: SOON };
    Expectation { against, section: "2.1", seen, expected, kind }
}

/// Each message of section 2.1 comes.
pub(crate) static SENDS: [Expectation; 6] = [
    sends(&["MSG-5"], "no AI2VCU_Status (510h) came", "it as soon as the VCU is heard", |look| {
        look.has_come(Ai2VcuStatus::ID)
    }),
    sends(&["MSG-16"], "no AI2VCU_Drive_F (511h) came", "it as soon as the VCU is heard", |look| {
        look.has_come(Ai2VcuDriveF::ID)
    }),
    sends(&["MSG-20"], "no AI2VCU_Drive_R (512h) came", "it as soon as the VCU is heard", |look| {
        look.has_come(Ai2VcuDriveR::ID)
    }),
    sends(&["MSG-23"], "no AI2VCU_Steer (513h) came", "it as soon as the VCU is heard", |look| {
        look.has_come(Ai2VcuSteer::ID)
    }),
    sends(&["MSG-26"], "no AI2VCU_Brake (514h) came", "it as soon as the VCU is heard", |look| {
        look.has_come(Ai2VcuBrake::ID)
    }),
    sends(&["MSG-1"], "no AI2LOG_Dynamics2 (501h) came", "it as soon as the VCU is heard", |look| {
        look.has_come(Ai2LogDynamics2::ID)
    }),
];

/// How many of its messages an AI Computer sends to the VCU: all of them but the last, which is for the logger.
fn to_the_vcu(any: impl Fn(u16) -> bool) -> bool {
    SENT.into_iter().filter(|id| *id != Ai2LogDynamics2::ID).any(any)
}

/// They come every 10 ms: not with gaps, and not far more often.
pub(crate) static CYCLES: [Expectation; 4] = [
    Expectation {
        against: &["MSG-98"],
        section: "2.1",
        seen: "one of 510h to 514h did not come for 30 ms",
        expected: "each of them every 10 ms",
        kind: Kind::Never {
            when: |look| to_the_vcu(|id| look.has_come(id)),
            what: |look| to_the_vcu(|id| look.silent_ms(id) >= GAP_MS),
        },
    },
    Expectation {
        against: &["MSG-98"],
        section: "2.1",
        seen: "one of 510h to 514h came more than 150 times in a second",
        expected: "each of them every 10 ms",
        kind: Kind::Never {
            when: |look| to_the_vcu(|id| look.has_come(id)),
            what: |look| to_the_vcu(|id| look.rate(id) > TOO_OFTEN),
        },
    },
    Expectation {
        against: &["MSG-102"],
        section: "2.1",
        seen: "AI2LOG_Dynamics2 (501h) did not come for 30 ms",
        expected: "it every 10 ms",
        kind: Kind::Never {
            when: |look| look.has_come(Ai2LogDynamics2::ID),
            what: |look| look.silent_ms(Ai2LogDynamics2::ID) >= GAP_MS,
        },
    },
    Expectation {
        against: &["MSG-102"],
        section: "2.1",
        seen: "AI2LOG_Dynamics2 (501h) came more than 150 times in a second",
        expected: "it every 10 ms",
        kind: Kind::Never {
            when: |look| look.has_come(Ai2LogDynamics2::ID),
            what: |look| look.rate(Ai2LogDynamics2::ID) > TOO_OFTEN,
        },
    },
];

/// The handshake is answered, in AS_OFF as well: that is the first thing an AI Computer has to do.
pub(crate) static ANSWERS: Expectation = Expectation {
    against: &["HS-5"],
    section: "2.4",
    seen: "the AI Computer has not answered HANDSHAKE",
    expected: "HANDSHAKE of 510h to follow that of 520h",
    kind: Kind::Ends { what: Look::is_unanswered, within: Within::Answer },
};

/// A mission that is selected is confirmed.
pub(crate) static SELECTS: Expectation = Expectation {
    against: &["RDY-7"],
    section: "3.1",
    seen: "MISSION_STATUS is not SELECTED though a mission is selected on the AMI",
    expected: "MISSION_STATUS SELECTED",
    kind: Kind::Comes {
        when: |look| look.runs_ms.is_some() && look.is(AsState::Off) && look.shows_mission(),
        then: |look| look.says(MissionStatus::Selected),
        within: PATIENT,
    },
};

/// Nothing is requested in AS_READY, so that "Go" lets the car drive.
pub(crate) static HOLDS_STILL: Expectation = Expectation {
    against: &["DRV-5", "DRV-6", "DRV-7", "DRV-8"],
    section: "3.2",
    seen: "the car does not leave AS_READY on \"Go\"",
    expected: "zero requests and NEUTRAL in AS_READY, so that it goes to AS_DRIVING",
    kind: Kind::Comes {
        when: |look| {
            look.is(AsState::Driving) || look.is(AsState::Ready) && look.go_in_time && look.is_straight()
        },
        then: |look| look.is(AsState::Driving),
        within: Within::Ms(200),
    },
};

/// The AI Computer asks the car to go forward.
pub(crate) static GOES_FORWARD: Expectation = Expectation {
    against: &["DRV-10"],
    section: "3.2",
    seen: "DIRECTION_REQUEST is not FORWARD in AS_DRIVING",
    expected: "FORWARD once the state is AS_DRIVING",
    kind: Kind::Comes { when: |look| look.is(AsState::Driving), then: Look::is_forward, within: PATIENT },
};

/// The mission comes to its end.
pub(crate) static COMPLETES: Expectation = Expectation {
    against: &["FIN-1"],
    section: "3.3",
    seen: "MISSION_STATUS is not FINISHED",
    expected: "the mission to be completed and reported so (--mission-time gives it more time)",
    kind: Kind::Comes {
        when: |look| look.is(AsState::Driving),
        then: |look| look.says(MissionStatus::Finished),
        within: Within::Mission,
    },
};

/// The brakes stop it.
pub(crate) static BRAKES: Expectation = Expectation {
    against: &["FIN-2"],
    section: "3.3",
    seen: "MISSION_STATUS is FINISHED, and no brake was requested when the vehicle moved last",
    expected: "the AI Computer to stop the vehicle with the service brake",
    kind: Kind::Never {
        when: |look| look.is(AsState::Driving) && look.has_moved && look.says(MissionStatus::Finished),
        what: |look| !look.braked,
    },
};

/// The AI Computer says that the vehicle has stopped.
pub(crate) static TELLS_STOP: Expectation = Expectation {
    against: &["FIN-3"],
    section: "3.3",
    seen: "MISSION_STATUS is not FINISHED though the vehicle has been stopped with the service brake",
    expected: "FINISHED once the vehicle has stopped",
    kind: Kind::Comes {
        when: |look| {
            look.is(AsState::Driving) && look.has_moved && look.braked && look.brakes() && look.is_at_rest()
        },
        then: |look| look.says(MissionStatus::Finished),
        within: Within::Ms(10_000),
    },
};
