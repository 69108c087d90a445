//! The AI Computer's conduct, requirement by requirement.

use adsdv_can::ai::{Ai, Plan, Stage};
use adsdv_spec::messages::{
    AmiState, AsState, DirectionRequest, Frame, MissionStatus, Node, SteerAngle, Vcu2AiBrake, Vcu2AiDriveF,
    Vcu2AiStatus, Vcu2AiSteer, Vcu2AiWheelSpeeds, WheelSpeed,
};
use adsdv_spec::{AiMessages, Edition};

/// The frame of a message.
fn encoded(message: impl Into<adsdv_spec::messages::AnyMessage>) -> Frame {
    Edition::DEFAULT.bus.encode(message).expect("every edition has it")
}

/// What the VCU says, returned requests and all.
#[derive(Clone, Copy, Default)]
struct Vcu {
    status: Vcu2AiStatus,
    rpm: i32,
    steer: i32,
}

/// One cycle: the AI Computer hears the VCU, which has heard it.
fn cycle(ai: &mut Ai, vcu: Vcu, said: &AiMessages) -> AiMessages {
    let rpm = WheelSpeed::clamped(vcu.rpm);
    let speeds = Vcu2AiWheelSpeeds {
        fl_wheel_speed: rpm,
        fr_wheel_speed: rpm,
        rl_wheel_speed: rpm,
        rr_wheel_speed: rpm,
    };
    let brake = Vcu2AiBrake {
        hyd_press_f_req: said.brake.hyd_press_f_req,
        hyd_press_r_req: said.brake.hyd_press_r_req,
        ..Vcu2AiBrake::default()
    };
    let drive = Vcu2AiDriveF {
        front_axle_trq_request: said.drive_f.front_axle_trq_request,
        ..Vcu2AiDriveF::default()
    };
    let steer = Vcu2AiSteer { steer_angle: SteerAngle::clamped(vcu.steer), ..Vcu2AiSteer::default() };
    for frame in [encoded(vcu.status), encoded(drive), encoded(steer), encoded(brake), encoded(speeds)] {
        ai.receive(&frame).expect("what the VCU sends");
    }
    messages(&ai.cycle(10))
}

fn messages(frames: &[Frame]) -> AiMessages {
    let mut messages = AiMessages::default();
    for frame in frames {
        messages
            .receive(&Edition::DEFAULT.bus, frame.id, frame.data())
            .expect("it sends what the document allows");
    }
    messages
}

fn vcu(as_state: AsState) -> Vcu {
    Vcu {
        status: Vcu2AiStatus { as_state, ami_state: AmiState::Skidpad, ..Vcu2AiStatus::default() },
        ..Vcu::default()
    }
}

/// An AI Computer that drives since a second, and what it says.
fn driving() -> (Ai, AiMessages) {
    let mut ai = Ai::default();
    let mut said = cycle(&mut ai, vcu(AsState::Ready), &AiMessages::default());
    for _ in 0..100 {
        said = cycle(&mut ai, Vcu { rpm: 100, ..vcu(AsState::Driving) }, &said);
    }
    assert_eq!(ai.stage(), Stage::Driving);
    (ai, said)
}

#[test]
fn it_sends_every_message_of_the_ai_computer_once_it_has_heard_the_vcu() {
    let mut ai = Ai::default();
    assert_eq!(ai.cycle(10), []);
    // Somebody else, and garbage.
    assert_eq!(ai.receive(&Frame::new(0x123, &[1, 2]).expect("a frame")), Ok(()));
    ai.receive(&Frame::new(0x520, &[1]).expect("a frame")).expect_err("too short");
    ai.receive(&Frame::new(0x520, &[0, 0, 0xFF, 0, 0, 0, 0, 0]).expect("a frame"))
        .expect_err("no such state");
    assert_eq!(ai.cycle(10), []);
    assert_eq!(ai.receive(&encoded(Vcu2AiStatus::default())), Ok(()));
    let ids: Vec<u16> = ai.cycle(10).iter().map(|frame| frame.id).collect();
    assert_eq!(ids, [0x501, 0x510, 0x511, 0x512, 0x513, 0x514]);
    assert!(
        ids.iter()
            .all(|&id| Edition::DEFAULT.bus.message(id).is_some_and(|message| message.sender == Node::Ai))
    );
}

//= HS-5
#[test]
fn it_answers_the_handshake_in_every_state() {
    for as_state in AsState::ALL {
        let mut ai = Ai::default();
        for bit in [true, false, true, true, false] {
            let mut vcu = vcu(as_state);
            vcu.status.handshake = bit;
            assert_eq!(cycle(&mut ai, vcu, &AiMessages::default()).status.handshake, bit, "{as_state}");
        }
    }
}

//= RDY-7, DRV-5 to DRV-8
#[test]
fn it_confirms_the_mission_and_asks_for_nothing_before_as_driving() {
    for as_state in [AsState::Off, AsState::Ready] {
        let mut ai = Ai::default();
        let mut none = vcu(as_state);
        none.status.ami_state = AmiState::NotSelected;
        let said = cycle(&mut ai, none, &AiMessages::default());
        assert_eq!(said.status.mission_status, MissionStatus::NotSelected);
        let said = cycle(&mut ai, vcu(as_state), &said);
        assert_eq!(said.status.mission_status, MissionStatus::Selected);
        let status = said.status;
        let rest = AiMessages { status, ..AiMessages::default() };
        assert_eq!((said, status.direction_request), (rest, DirectionRequest::Neutral));
    }
}

//= DRV-10
#[test]
fn it_asks_for_forward_before_it_asks_for_torque() {
    let mut ai = Ai::default();
    let mut said = cycle(&mut ai, vcu(AsState::Ready), &AiMessages::default());
    said = cycle(&mut ai, vcu(AsState::Driving), &said);
    assert_eq!(said.status.direction_request, DirectionRequest::Forward);
    assert_eq!(said.status.mission_status, MissionStatus::Running);
    assert_eq!(said.drive_f.front_axle_trq_request.raw(), 0);
    said = cycle(&mut ai, vcu(AsState::Driving), &said);
    assert!(said.drive_f.front_axle_trq_request.raw() > 0 && said.drive_f.front_motor_speed_max.raw() > 0);
    assert!(said.status.veh_speed_demand.raw() > 0);
}

#[test]
fn it_takes_torque_away_as_it_comes_to_its_speed() {
    let (mut ai, mut said) = driving();
    let torque = |said: &AiMessages| said.drive_r.rear_axle_trq_request.raw();
    let full = torque(&said);
    said = cycle(&mut ai, Vcu { rpm: 180, ..vcu(AsState::Driving) }, &said);
    let less = torque(&said);
    said = cycle(&mut ai, Vcu { rpm: 195, ..vcu(AsState::Driving) }, &said);
    assert!(full > less && less > 0 && torque(&said) == 0, "{full} {less} {}", torque(&said));
}

//= FIN-2, FIN-3
#[test]
fn the_ai_computer_brakes_to_a_stop_and_sends_finished_only_then() {
    let (mut ai, mut said) = driving();
    let mut moving = 0;
    while ai.stage() == Stage::Driving {
        said = cycle(&mut ai, Vcu { rpm: 195, ..vcu(AsState::Driving) }, &said);
        moving += 1;
        assert!(moving < 10_000);
    }
    let limit = Edition::DEFAULT.rules.thresholds.wheel_speed.raw();
    let brakes =
        |said: &AiMessages| said.brake.hyd_press_f_req.raw() > 0 && said.brake.hyd_press_r_req.raw() > 0;
    // Exactly the threshold is not at rest (D-24).
    for rpm in [195, limit + 1, limit] {
        for _ in 0..100 {
            said = cycle(&mut ai, Vcu { rpm, ..vcu(AsState::Driving) }, &said);
            let AiMessages { status, drive_f, steer, .. } = said;
            assert_eq!(
                (ai.stage(), status.mission_status),
                (Stage::Braking, MissionStatus::Running),
                "{rpm}"
            );
            assert_eq!(status.direction_request, DirectionRequest::Forward, "{rpm}");
            assert_eq!((drive_f.front_axle_trq_request.raw(), steer.steer_request.raw()), (0, 0));
            assert!(brakes(&said), "{rpm}");
        }
    }
    for _ in 0..100 {
        said = cycle(&mut ai, Vcu { rpm: limit - 1, ..vcu(AsState::Driving) }, &said);
    }
    assert_eq!((ai.stage(), said.status.mission_status), (Stage::Finished, MissionStatus::Finished));
    assert!(brakes(&said));
    said = cycle(&mut ai, vcu(AsState::Finished), &said);
    assert_eq!(said.status.direction_request, DirectionRequest::Neutral);
    assert_eq!(said.status.mission_status, MissionStatus::Finished);
    assert!(brakes(&said));
    // Switched off, it begins again.
    said = cycle(&mut ai, vcu(AsState::Off), &said);
    assert_eq!(
        (ai.stage(), said.status.mission_status, brakes(&said)),
        (Stage::Selected, MissionStatus::Selected, false)
    );
}

#[test]
fn rest_before_the_vcu_returns_the_brakes_does_not_count() {
    let (mut ai, mut said) = driving();
    while ai.stage() == Stage::Driving {
        said = cycle(&mut ai, Vcu { rpm: 195, ..vcu(AsState::Driving) }, &said);
    }
    for _ in 0..100 {
        // A VCU that has not heard of the brakes.
        cycle(&mut ai, vcu(AsState::Driving), &AiMessages::default());
    }
    assert_eq!(ai.stage(), Stage::Braking);
}

#[test]
fn in_an_emergency_it_asks_for_nothing() {
    let (mut ai, said) = driving();
    let said = cycle(&mut ai, Vcu { rpm: 195, ..vcu(AsState::EmergencyBrake) }, &said);
    let AiMessages { status, .. } = said;
    assert_eq!(said, AiMessages { status, ..AiMessages::default() });
    assert_eq!(status.mission_status, MissionStatus::NotSelected);
    assert_eq!(status.direction_request, DirectionRequest::Neutral);
    assert!(!status.estop_request);
}

#[test]
fn without_the_vcu_or_asked_by_it_to_stop_it_brakes() {
    let silent = |cycles: usize| {
        let (mut ai, _) = driving();
        let last = (0..cycles).map(|_| messages(&ai.cycle(10))).last().expect("a cycle");
        (ai.stage(), last.status.direction_request, last.brake.hyd_press_f_req.raw() > 0)
    };
    assert_eq!(silent(4), (Stage::Driving, DirectionRequest::Forward, false));
    assert_eq!(silent(8), (Stage::Braking, DirectionRequest::Forward, true));
    let (mut ai, said) = driving();
    let mut asked = Vcu { rpm: 195, ..vcu(AsState::Driving) };
    asked.status.shutdown_request = true;
    let said = cycle(&mut ai, asked, &said);
    assert_eq!((ai.stage(), said.status.mission_status), (Stage::Braking, MissionStatus::Running));
}

#[test]
fn started_in_a_car_that_drives_it_stops_it() {
    let mut ai = Ai::default();
    let said = cycle(&mut ai, Vcu { rpm: 195, ..vcu(AsState::Driving) }, &AiMessages::default());
    assert_eq!((ai.stage(), said.status.direction_request), (Stage::Braking, DirectionRequest::Forward));
    assert!(said.brake.hyd_press_f_req.raw() > 0);
}

#[test]
fn a_plan_that_makes_no_sense_does_no_harm() {
    for value in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e300] {
        let plan = Plan {
            speed_mps: value,
            distance_m: value,
            torque_nm: value.abs(),
            sway_deg: value,
            sway_ms: value,
            brake_pct: value,
            settle_ms: u32::MAX,
        };
        let mut ai = Ai::new(Edition::DEFAULT, plan);
        let mut said = cycle(&mut ai, vcu(AsState::Ready), &AiMessages::default());
        for _ in 0..100 {
            said = cycle(&mut ai, Vcu { rpm: 50, ..vcu(AsState::Driving) }, &said);
        }
    }
}
