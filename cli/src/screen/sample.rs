//! Cars in situations that the tests draw.

use adsdv_can::bus::Disturbance;
use adsdv_can::car::{Action, Car, Condition, Missing, missing};
use adsdv_can::status::{Cycles, Happening, HappeningKind, Status};
use adsdv_spec::messages::{
    AmiState, AsState, AxleTorque, AxleTorqueRequest, BrakePressure, DirectionRequest, EbsState,
    MissionStatus, MotorSpeedMax, ShutdownCause, SteerAngle, WheelSpeed,
};
use adsdv_spec::{Atom, Edition, Fault, Faults, Inputs, Machine, Outputs};

/// What the VCU says in this state, without a fault.
fn outputs(state: AsState) -> Outputs {
    let (_, outputs) = Machine::REFERENCE.step(&adsdv_spec::Control::INITIAL, &Inputs::default(), 10);
    Outputs { state, faults: Faults::NONE, shutdown_cause: ShutdownCause::NoShutdown, ..outputs }
}

fn happenings(all: impl IntoIterator<Item = (u64, HappeningKind)>) -> impl Iterator<Item = Happening> {
    all.into_iter().map(|(time_ms, what)| Happening { time_ms, what })
}

fn did(what: &str) -> HappeningKind {
    HappeningKind::Did(what.to_owned())
}

fn changed(from: Option<AsState>, to: Option<AsState>, section: &'static str, why: &str) -> HappeningKind {
    HappeningKind::State { from, to, section, why: why.to_owned() }
}

fn condition(atom: Atom, value: bool, action: Option<Action>) -> Condition {
    let text = Edition::DEFAULT.rules.text(atom, value).to_string();
    Condition { atom, value, text, left_ms: None, action }
}

/// The VCU has just been switched on, and there is no AI Computer.
pub(super) fn off() -> Status {
    let mut car = Car::new(Machine::REFERENCE);
    car.cycle(10);
    Status {
        bus: "vcan0".to_owned(),
        edition: Edition::V3_0.version,
        answer_limit_ms: Edition::V3_0.rules.timing.handshake_ms.into(),
        outputs: Some(outputs(AsState::Off)),
        in_state_ms: 1_240,
        missing: missing(&car),
        cycles: Cycles { count: 124, worst_ms: 0.21, p99_ms: 0.08, ..Cycles::default() },
        sent: 1_005,
        time_ms: 1_240,
        happened: happenings([(10, changed(None, Some(AsState::Off), "", ""))]).collect(),
        ..Status::default()
    }
}

/// AS_READY has just begun, and the AI Computer asks for too much.
pub(super) fn ready() -> Status {
    let conditions = vec![
        Condition { left_ms: Some(2_830), ..condition(Atom::DwellElapsed, true, None) },
        condition(Atom::FrontTorqueZero, true, None),
        condition(Atom::RearTorqueZero, true, None),
        condition(Atom::SteerRequestZero, true, None),
        condition(Atom::SteerStraight, true, None),
        condition(Atom::DirectionNeutral, true, None),
        condition(Atom::GoEdge, true, "go on".parse().ok()),
    ];
    Status {
        outputs: Some(outputs(AsState::Ready)),
        in_state_ms: 2_170,
        missing: Some(Missing { to: AsState::Driving, section: "3.2", conditions, then: None }),
        ..driving()
    }
}

/// A mission is under way, by a scenario.
pub(super) fn driving() -> Status {
    let mut inputs = Inputs {
        asms: true,
        tsms: true,
        ami: AmiState::TrackDrive,
        ebs: EbsState::Armed,
        go: true,
        ..Inputs::default()
    };
    let ai = &mut inputs.ai;
    ai.status.handshake = true;
    ai.status.mission_status = MissionStatus::Running;
    ai.status.direction_request = DirectionRequest::Forward;
    ai.drive_f.front_axle_trq_request = AxleTorqueRequest::clamped(500);
    ai.drive_r.rear_axle_trq_request = AxleTorqueRequest::clamped(755);
    ai.drive_f.front_motor_speed_max = MotorSpeedMax::MAX;
    ai.drive_r.rear_motor_speed_max = MotorSpeedMax::MAX;
    ai.steer.steer_request = SteerAngle::clamped(-85);
    let vehicle = &mut inputs.vehicle;
    vehicle.front_axle_trq = AxleTorque::clamped(497);
    vehicle.rear_axle_trq = AxleTorque::clamped(748);
    vehicle.steer_angle = SteerAngle::clamped(-81);
    let wheels = &mut vehicle.wheel_speeds;
    [wheels.fl_wheel_speed, wheels.fr_wheel_speed] = [379, 352].map(WheelSpeed::clamped);
    [wheels.rl_wheel_speed, wheels.rr_wheel_speed] = [377, 351].map(WheelSpeed::clamped);
    let (off, ready, driving) = (Some(AsState::Off), Some(AsState::Ready), Some(AsState::Driving));
    let mut status = Status {
        bus: "vcan0".to_owned(),
        edition: Edition::V3_0.version,
        answer_limit_ms: Edition::V3_0.rules.timing.handshake_ms.into(),
        inputs,
        outputs: Some(Outputs { handshake: true, go_signal: true, ..outputs(AsState::Driving) }),
        in_state_ms: 12_340,
        ai_silent_ms: Some(4),
        last_response_ms: Some(2.1),
        cycles: Cycles { count: 2_153, worst_ms: 0.64, p99_ms: 0.12, ..Cycles::default() },
        received: 10_766,
        sent: 17_440,
        speed_mps: 9.54,
        distance_m: 73.2,
        time_ms: 21_530,
        next: Some("at 25.0 s: remote_estop on".to_owned()),
        happened: happenings([
            (10, changed(None, off, "", "")),
            (1_000, did("tsms on")),
            (1_020, HappeningKind::AiHeard),
            (1_500, did("ami TRACK_DRIVE")),
            (2_000, did("ebs ARMED")),
            (2_500, did("asms on")),
            (
                2_510,
                changed(
                    off,
                    ready,
                    "3.1",
                    "AS master switch ON, TS master switch ON, AMI mission selected, \
                     MISSION_STATUS == SELECTED, EBS_state == ARMED, no power cycle needed",
                ),
            ),
            (9_180, did("go on")),
            (9_190, changed(ready, driving, "3.2", "5 second timer elapsed, \"Go\" signal OFF -> ON")),
        ])
        .collect(),
        ..Status::default()
    };
    for answer in 0..2_040_i64 {
        status.responses.add(1_600_000 + (answer * answer) % 1_700_000);
    }
    status
}

/// The worst has happened, all at once.
pub(super) fn emergency() -> Status {
    let mut status = driving();
    status.trouble = Some(Disturbance::Down);
    status.inputs.sdc.remote_estop = true;
    status.inputs.reports.hvil_open = true;
    status.inputs.reports.batt_soc_low = true;
    status.inputs.ai.status.estop_request = true;
    status.inputs.vehicle.hyd_press_f = BrakePressure::MAX;
    status.inputs.vehicle.hyd_press_r = BrakePressure::MAX;
    let faults = Faults::of(&[Fault::AiComputerRequest, Fault::HvilOpenFault, Fault::AiCommsFault]);
    status.outputs =
        Some(Outputs { faults, shutdown_cause: faults.cause(), ..outputs(AsState::EmergencyBrake) });
    status.time_ms = 26_400;
    status.in_state_ms = 1_390;
    let conditions = vec![
        Condition { left_ms: Some(13_610), ..condition(Atom::EbsTimerComplete, true, None) },
        condition(Atom::Asms, false, "asms off".parse().ok()),
    ];
    let then = Some(condition(Atom::PowerCycleNeeded, false, Some(Action::PowerCycle)));
    status.missing = Some(Missing { to: AsState::Off, section: "3.9", conditions, then });
    status.ai_silent_ms = Some(2_480);
    status.cycles = Cycles { count: 2_637, late: 2, left_out: 3, worst_ms: 23.4, p50_ms: 0.07, p99_ms: 0.31 };
    [status.unsent, status.refused, status.dropped] = [131, 3, 12];
    [status.foreign, status.errors] = [1, 7];
    status.next = None;
    let (driving, emergency) = (Some(AsState::Driving), Some(AsState::EmergencyBrake));
    status.happened.extend(happenings([
        (25_000, did("remote_estop on")),
        (25_010, changed(driving, emergency, "3.7", "SDC open")),
        (25_020, HappeningKind::Refused("513h: STEER_REQUEST cannot be 24.1 deg (raw 241), allowed: -24.0 to 24.0 deg in steps of 0.1 (raw -240 to 240)".to_owned())),
        (25_030, HappeningKind::OtherVcu("somebody else sends 520h, which is the VCU's".to_owned())),
        (25_100, HappeningKind::AiSilent),
        (25_400, HappeningKind::Late(2)),
        (25_600, HappeningKind::Disturbance(Disturbance::Down)),
    ]));
    status
}

/// The power is being cycled.
pub(super) fn dark() -> Status {
    Status { outputs: None, missing: None, ..off() }
}
