//! The car: its frames at their rates, what it obeys, and that what it measures stays in range.

use adsdv_can::car::{
    Action, Car, Cycle, Missing, POWER_CYCLE_MS, Physics, Switch, UnknownSwitch, Vehicle, missing,
    missing_for,
};
use adsdv_oracle::remote::Remote;
use adsdv_spec::messages::{
    Ai2VcuBrake, Ai2VcuDriveF, Ai2VcuDriveR, Ai2VcuStatus, Ai2VcuSteer, AsState, AxleTorqueRequest,
    BrakePressure, DirectionRequest, Frame, MissionStatus, MotorSpeedMax, SteerAngle, Vcu2AiStatus,
    Vcu2LogDynamics1, Vcu2LogStatus, WheelSpeed,
};
use adsdv_spec::{Actuation, AiMessages, Choice, Edition, Machine, Readings};

mod operator;

/// The frame of a message.
fn encoded(message: impl Into<adsdv_spec::messages::AnyMessage>) -> Frame {
    Edition::DEFAULT.bus.encode(message).expect("every edition has it")
}

fn act(car: &mut Car, actions: &[&str]) {
    for action in actions {
        car.act(&action.parse().expect("an action"));
    }
}

/// What the AI Computer says, with the VCU's handshake bit of the cycle before.
fn send_status(car: &mut Car, status: Ai2VcuStatus) {
    let handshake = car.outputs().is_some_and(|outputs| outputs.handshake);
    let frame = encoded(Ai2VcuStatus { handshake, ..status });
    assert_eq!(car.receive(&frame), Ok(true));
}

/// Answers the handshake for so many cycles of 10 ms.
fn cycles(car: &mut Car, count: u32, status: Ai2VcuStatus) {
    for _ in 0..count {
        send_status(car, status);
        car.cycle(10);
    }
}

fn status(mission_status: MissionStatus, direction_request: DirectionRequest) -> Ai2VcuStatus {
    Ai2VcuStatus { mission_status, direction_request, ..Ai2VcuStatus::default() }
}

fn state(car: &Car) -> Option<AsState> {
    car.outputs().map(|outputs| outputs.state)
}

/// A car in AS_READY, 4.9 seconds before "Go" may come, and what the AI Computer says there.
fn ready() -> (Car, Ai2VcuStatus) {
    let mut car = Car::new(Machine::REFERENCE);
    let waits = status(MissionStatus::Selected, DirectionRequest::Neutral);
    act(&mut car, &["ami SKIDPAD", "ebs ARMED", "tsms on", "asms on"]);
    cycles(&mut car, 10, waits);
    assert_eq!(state(&car), Some(AsState::Ready));
    (car, waits)
}

fn full_torque(car: &mut Car) {
    let (trq, rpm) = (AxleTorqueRequest::MAX, MotorSpeedMax::MAX);
    let front = Ai2VcuDriveF { front_axle_trq_request: trq, front_motor_speed_max: rpm };
    let rear = Ai2VcuDriveR { rear_axle_trq_request: trq, rear_motor_speed_max: rpm };
    for frame in [encoded(front), encoded(rear)] {
        assert_eq!(car.receive(&frame), Ok(true));
    }
}

/// A car that drives, with full torque, and what the AI Computer says there.
fn driving() -> (Car, Ai2VcuStatus) {
    let (mut car, waits) = ready();
    cycles(&mut car, 510, waits);
    act(&mut car, &["go on"]);
    let drives = status(MissionStatus::Running, DirectionRequest::Forward);
    cycles(&mut car, 1, waits);
    assert_eq!(state(&car), Some(AsState::Driving));
    full_torque(&mut car);
    cycles(&mut car, 100, drives);
    assert!(car.vehicle().speed_mps() > 5.0, "{}", car.vehicle().speed_mps());
    (car, drives)
}

fn has_log_status(cycle: &Cycle) -> bool {
    cycle.frames.iter().any(|frame| frame.id == Vcu2LogStatus::ID)
}

#[test]
fn log_status_comes_every_100_ms_without_drift() {
    let sent = |dt_ms: u32, count: u32| {
        let mut car = Car::new(Machine::REFERENCE);
        let due = (0..count).filter(|_| has_log_status(&car.cycle(dt_ms)));
        due.map(|cycle| cycle * dt_ms).collect::<Vec<_>>()
    };
    assert_eq!(sent(10, 31), [0, 100, 200, 300]);
    assert_eq!(sent(1, 301), [0, 100, 200, 300]);
    // A cycle that is no part of 100 ms: each 502h in the first cycle at or after its time.
    assert_eq!(sent(30, 21), [0, 120, 210, 300, 420, 510, 600]);
    // Cycles that are longer than 100 ms each have one.
    assert_eq!(sent(250, 4), [0, 250, 500, 750]);
}

#[test]
fn a_cycle_sends_every_message_of_the_vcu_once() {
    let mut car = Car::new(Machine::REFERENCE);
    let ids: Vec<u16> = car.cycle(10).frames.iter().map(|frame| frame.id).collect();
    assert_eq!(ids, [0x520, 0x521, 0x522, 0x523, 0x524, 0x525, 0x526, 0x500, 0x502]);
}

#[test]
fn a_power_cycle_takes_a_second_and_forgets() {
    let (mut car, drives) = driving();
    act(&mut car, &["vehicle_estop on"]);
    cycles(&mut car, 1, drives);
    act(&mut car, &["vehicle_estop off"]);
    assert_eq!(state(&car), Some(AsState::EmergencyBrake));
    act(&mut car, &["power cycle"]);
    for _ in 0..POWER_CYCLE_MS / 10 {
        // It hears nothing.
        assert_eq!(car.receive(&encoded(drives)), Ok(false));
        let cycle = car.cycle(10);
        assert!(cycle.outputs.is_none() && car.outputs().is_none() && cycle.frames.is_empty());
        assert!(missing(&car).is_none());
        // The switches stay as they are.
        assert!(car.inputs().ai == AiMessages::default() && car.inputs().asms);
    }
    let cycle = car.cycle(10);
    assert_eq!(cycle.state(), Some(AsState::Off));
    assert!(has_log_status(&cycle));
    assert_eq!(cycle.outputs.map(|outputs| outputs.shutdown_cause.raw()), Some(0));
    assert!(!car.control().power_cycle_needed);
}

//= D-20
#[test]
fn garbage_of_the_ai_changes_nothing() {
    let (mut car, drives) = driving();
    let before = *car.inputs();
    let garbage = [
        (0x510, &[][..]),                      // too short
        (0x510, &[0, 0x80, 0, 0, 0, 0, 0, 0]), // a direction that there is not
        (0x511, &[0xFF, 0xFF, 0, 0]),          // too much torque
        (0x512, &[0, 0, 0xFF, 0xFF]),          // too fast
        (0x513, &[0xFF, 0x7F]),                // beyond the steering
        (0x514, &[201, 0]),                    // more than full pressure
    ];
    for (id, data) in garbage {
        let frame = Frame::new(id, data).expect("a frame");
        assert!(car.receive(&frame).is_err(), "{frame}");
        assert_eq!(*car.inputs(), before, "{frame}");
    }
    // Frames of others are none of its business.
    assert_eq!(car.receive(&encoded(Vcu2AiStatus::default())), Ok(false));
    assert_eq!(*car.inputs(), before);
    cycles(&mut car, 1, drives);
    assert_eq!(state(&car), Some(AsState::Driving));
}

#[test]
fn drive_and_steering_requests_move_nothing_outside_as_driving() {
    let (mut car, _) = ready();
    let steer = Ai2VcuSteer { steer_request: SteerAngle::MAX };
    full_torque(&mut car);
    assert_eq!(car.receive(&encoded(steer)), Ok(true));
    cycles(&mut car, 200, status(MissionStatus::Selected, DirectionRequest::Forward));
    assert_eq!(state(&car), Some(AsState::Ready));
    assert!(car.vehicle().distance_m() <= 0.0);
    assert_eq!(car.inputs().vehicle.steer_angle.raw(), 0);
}

#[test]
fn it_steers_and_rolls_as_it_is_asked_in_as_driving() {
    let (mut car, drives) = driving();
    let steer = Ai2VcuSteer { steer_request: SteerAngle::MAX };
    assert_eq!(car.receive(&encoded(steer)), Ok(true));
    cycles(&mut car, 100, drives);
    assert!(car.inputs().vehicle.steer_angle.raw() > 230);
    let speeds = car.inputs().vehicle.wheel_speeds;
    // To the left the right wheels are faster.
    assert!(speeds.fr_wheel_speed > speeds.fl_wheel_speed && speeds.rr_wheel_speed > speeds.rl_wheel_speed);
    let counts = car.inputs().vehicle.wheel_counts;
    assert!(counts.rr_pulse_count > counts.rl_pulse_count && counts.rl_pulse_count > 0);
}

#[test]
fn braking_brings_it_to_rest_exactly() {
    for pressure in [20, 100, 200] {
        let (mut car, drives) = driving();
        let none = [encoded(Ai2VcuDriveF::default()), encoded(Ai2VcuDriveR::default())];
        let pressure = BrakePressure::clamped(pressure);
        let brake = Ai2VcuBrake { hyd_press_f_req: pressure, hyd_press_r_req: pressure };
        for frame in none.into_iter().chain([encoded(brake)]) {
            assert_eq!(car.receive(&frame), Ok(true));
        }
        let before = car.vehicle().speed_mps();
        cycles(&mut car, 1, drives);
        cycles(&mut car, 3000, drives);
        assert!(before > 0.0 && car.vehicle().speed_mps() <= 0.0, "{pressure}");
        let vehicle = car.inputs().vehicle;
        let speeds = vehicle.wheel_speeds;
        for speed in
            [speeds.fl_wheel_speed, speeds.fr_wheel_speed, speeds.rl_wheel_speed, speeds.rr_wheel_speed]
        {
            assert_eq!(speed.raw(), 0, "{pressure}");
        }
        assert_eq!((vehicle.speed.raw(), vehicle.front_axle_trq.raw()), (0, 0), "{pressure}");
        // The brakes do not push it back.
        let distance = car.vehicle().distance_m();
        cycles(&mut car, 100, drives);
        assert!((car.vehicle().distance_m() - distance).abs() <= 0.0, "{pressure}");
    }
}

/// Full torque and full lock, with cycles of any length.
#[test]
fn what_is_measured_stays_in_range_at_any_cycle() {
    for steer in [SteerAngle::MIN, SteerAngle::default(), SteerAngle::MAX] {
        for dt_ms in [1, 10, 77, 1000, 60_000, u32::MAX] {
            let asked = Actuation {
                front_axle_trq: AxleTorqueRequest::MAX,
                rear_axle_trq: AxleTorqueRequest::MAX,
                front_motor_speed_max: MotorSpeedMax::MAX,
                rear_motor_speed_max: MotorSpeedMax::MAX,
                direction: DirectionRequest::Forward,
                steer: Some(steer),
                ..Actuation::default()
            };
            let mut vehicle = Vehicle::new(Physics::DEFAULT);
            let mut seen = adsdv_spec::Vehicle::default();
            for _ in 0..2000 {
                vehicle.advance(&asked, dt_ms);
                vehicle.measure(&mut seen);
                assert!((0.0..40.0).contains(&vehicle.speed_mps()), "{dt_ms}: {}", vehicle.speed_mps());
            }
            assert!((seen.steer_angle.raw() - steer.raw()).abs() <= 1, "{dt_ms}");
            let speeds = seen.wheel_speeds;
            let fastest = speeds.fr_wheel_speed.max(speeds.fl_wheel_speed);
            assert!(fastest > WheelSpeed::clamped(600), "{dt_ms}: {fastest}");
            assert!(vehicle.distance_m().is_finite() && vehicle.distance_m() > 0.0, "{dt_ms}");
        }
    }
}

/// Full lock, from the other side: as fast as the steering is, and then to where it is asked.
#[test]
fn the_steering_has_a_rate() {
    let asked = Actuation { steer: Some(SteerAngle::MAX), ..Actuation::default() };
    let angle = |ms: u32| {
        let mut vehicle = Vehicle::new(Physics { steer_rate_degps: 50.0, ..Physics::DEFAULT });
        let mut seen = adsdv_spec::Vehicle::default();
        for _ in 0..ms / 10 {
            vehicle.advance(&asked, 10);
        }
        vehicle.measure(&mut seen);
        seen.steer_angle.to_physical()
    };
    for ms in [10, 100, 300] {
        let most = 0.05 * f64::from(ms);
        assert!((angle(ms) - most).abs() < 0.1, "{ms} ms: {}", angle(ms));
    }
    assert!((angle(3000) - SteerAngle::MAX.to_physical()).abs() < 0.1);
}

/// The motors of the ADS-DV turn three and a half times as fast as its wheels.
#[test]
fn the_speed_limit_of_a_motor_is_one_of_the_wheels_by_the_gears() {
    for (motor, wheel) in [(700, 200.0), (3500, 1000.0), (4000, 1143.0)] {
        let asked = Actuation {
            front_axle_trq: AxleTorqueRequest::MAX,
            rear_axle_trq: AxleTorqueRequest::MAX,
            front_motor_speed_max: MotorSpeedMax::clamped(motor),
            rear_motor_speed_max: MotorSpeedMax::clamped(motor),
            direction: DirectionRequest::Forward,
            steer: Some(SteerAngle::default()),
            ..Actuation::default()
        };
        let mut vehicle = Vehicle::new(Physics { drag_per_m: 0.0, ..Physics::DEFAULT });
        let mut seen = adsdv_spec::Vehicle::default();
        let mut fastest: f64 = 0.0;
        for _ in 0..3000 {
            vehicle.advance(&asked, 10);
            vehicle.measure(&mut seen);
            fastest = fastest.max(seen.wheel_speeds.rl_wheel_speed.to_physical());
        }
        // The torque needs a moment to turn round.
        assert!((wheel - 1.0..wheel + 60.0).contains(&fastest), "{motor} rpm: {fastest}");
    }
}

#[test]
fn a_torque_request_brakes_beyond_the_speed_limit_of_the_motor() {
    let mut asked = Actuation {
        rear_axle_trq: AxleTorqueRequest::MAX,
        rear_motor_speed_max: MotorSpeedMax::MAX,
        direction: DirectionRequest::Forward,
        ..Actuation::default()
    };
    let mut vehicle = Vehicle::new(Physics::DEFAULT);
    (0..300).for_each(|_| vehicle.advance(&asked, 10));
    let fast = vehicle.speed_mps();
    asked.rear_motor_speed_max = MotorSpeedMax::clamped(100);
    (0..20).for_each(|_| vehicle.advance(&asked, 10));
    let mut seen = adsdv_spec::Vehicle::default();
    vehicle.measure(&mut seen);
    assert!(
        vehicle.speed_mps() < fast - 0.3 && seen.rear_axle_trq.raw() < 0,
        "{fast} {}",
        vehicle.speed_mps()
    );
    // In neutral it only rolls.
    asked.direction = DirectionRequest::Neutral;
    (0..100).for_each(|_| vehicle.advance(&asked, 10));
    vehicle.measure(&mut seen);
    assert_eq!(seen.rear_axle_trq.raw(), 0);
}

#[test]
fn pulse_counts_begin_again_when_they_are_full() {
    let asked = Actuation {
        rear_axle_trq: AxleTorqueRequest::MAX,
        rear_motor_speed_max: MotorSpeedMax::MAX,
        direction: DirectionRequest::Forward,
        ..Actuation::default()
    };
    let mut vehicle = Vehicle::new(Physics::DEFAULT);
    let mut seen = adsdv_spec::Vehicle::default();
    let (mut wraps, mut before) = (0, 0);
    for _ in 0..40_000 {
        vehicle.advance(&asked, 10);
        vehicle.measure(&mut seen);
        let count = seen.wheel_counts.rl_pulse_count;
        wraps += u32::from(count < before);
        before = count;
    }
    let turns = vehicle.distance_m() / (std::f64::consts::TAU * Physics::DEFAULT.wheel_radius_m);
    let pulses = turns * Physics::DEFAULT.pulses_per_turn;
    assert!(wraps >= 1, "{pulses} pulses");
    assert!(
        (pulses - f64::from(wraps * 65_536 + u32::from(before))).abs() <= 1.0,
        "{pulses} {wraps} {before}"
    );
}

#[test]
fn the_vcu_sends_the_speed_of_the_vehicle() {
    let (mut car, drives) = driving();
    send_status(&mut car, drives);
    let cycle = car.cycle(10);
    let frame = cycle.frames.iter().find(|frame| frame.id == Vcu2LogDynamics1::ID).expect("500h");
    let logged: Vcu2LogDynamics1 = Edition::DEFAULT.bus.decode_as(frame.data()).expect("it decodes");
    let logged_speed = logged.speed_actual.to_physical();
    assert!((logged_speed - car.vehicle().speed_mps() * 3.6).abs() < 2.0, "{logged_speed}");
}

/// The frames of the remote control in so many cycles, with what they say.
fn remotes(car: &mut Car, count: u32) -> Vec<String> {
    let frames: Vec<Frame> = (0..count).flat_map(|_| car.cycle(10).frames).collect();
    let remote = Remote::of(&car.machine().edition().bus).map(|remote| remote.message().id);
    frames.iter().filter(|frame| Some(frame.id) == remote).map(ToString::to_string).collect()
}

#[test]
fn the_remote_control_shows_its_switches_where_an_edition_has_it_on_the_bus() {
    for edition in Edition::ALL {
        let mut car = Car::new(Machine::new(**edition, edition.readings));
        let has = Remote::of(&edition.bus).is_some();
        for (actions, data) in [
            (&[][..], "181#0000000000006400"),
            (&["go on"], "181#0200000000006400"),
            (&["remote_estop on"], "181#0300000000006400"),
            (&["go off", "res_link_lost on"], "181#0100000000000000"),
        ] {
            act(&mut car, actions);
            let expected = if has { vec![data; 3] } else { vec![] };
            assert_eq!(remotes(&mut car, 3), expected, "{}: {actions:?}", edition.version);
        }
        act(&mut car, &["power cycle"]);
        assert_eq!(remotes(&mut car, 3), [""; 0], "it has no power either");
    }
}
