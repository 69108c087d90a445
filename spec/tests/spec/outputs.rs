//! What the VCU lets through to the actuators, and what it tells: each value from where the document has it.

use adsdv_spec::messages::{
    AmiState, AsState, AxleTorque, AxleTorqueRequest, BrakePressure, ConesCountAll, DirectionRequest,
    EbsState, LapCounter, MotorSpeedMax, ServiceBrake, SpeedKmh, StatusBrk, SteerAngle, SteerAngleMax,
    Vcu2AiBrake, Vcu2AiDriveF, Vcu2AiDriveR, Vcu2AiStatus, Vcu2AiSteer, Vcu2AiWheelCounts, Vcu2AiWheelSpeeds,
    Vcu2LogDynamics1, Vcu2LogStatus, WheelSpeed,
};
use adsdv_spec::{Actuation, Assi, Atom, Control, Inputs, Machine, Outputs};

/// Inputs under which every state stays, with requests and measurements of which no two are the same.
fn busy() -> Inputs {
    let mut inputs = Inputs {
        asms: true,
        tsms: true,
        go: true,
        ami: AmiState::Autocross,
        ebs: EbsState::Armed,
        ..Inputs::default()
    };
    let ai = &mut inputs.ai;
    ai.status.direction_request = DirectionRequest::Forward;
    ai.status.lap_counter = LapCounter::clamped(9);
    ai.status.cones_count_actual = 200;
    ai.status.cones_count_all = 60_000;
    ai.status.veh_speed_actual = SpeedKmh::clamped(31);
    ai.status.veh_speed_demand = SpeedKmh::clamped(32);
    ai.drive_f.front_axle_trq_request = AxleTorqueRequest::clamped(1000);
    ai.drive_f.front_motor_speed_max = MotorSpeedMax::clamped(1001);
    ai.drive_r.rear_axle_trq_request = AxleTorqueRequest::clamped(1100);
    ai.drive_r.rear_motor_speed_max = MotorSpeedMax::clamped(1101);
    ai.steer.steer_request = SteerAngle::clamped(104);
    ai.brake.hyd_press_f_req = BrakePressure::clamped(101);
    ai.brake.hyd_press_r_req = BrakePressure::clamped(60);
    let vehicle = &mut inputs.vehicle;
    vehicle.steer_angle = SteerAngle::clamped(-99);
    vehicle.steer_angle_max = SteerAngleMax::clamped(220);
    vehicle.front_axle_trq = AxleTorque::clamped(-800);
    vehicle.rear_axle_trq = AxleTorque::clamped(-700);
    vehicle.front_axle_trq_max = AxleTorqueRequest::clamped(1500);
    vehicle.rear_axle_trq_max = AxleTorqueRequest::clamped(1600);
    vehicle.hyd_press_f = BrakePressure::clamped(90);
    vehicle.hyd_press_r = BrakePressure::clamped(51);
    vehicle.speed = SpeedKmh::clamped(33);
    let rpm = WheelSpeed::clamped;
    vehicle.wheel_speeds = Vcu2AiWheelSpeeds {
        fl_wheel_speed: rpm(401),
        fr_wheel_speed: rpm(402),
        rl_wheel_speed: rpm(403),
        rr_wheel_speed: rpm(404),
    };
    vehicle.wheel_counts =
        Vcu2AiWheelCounts { fl_pulse_count: 1, fr_pulse_count: 2, rl_pulse_count: 3, rr_pulse_count: 65_535 };
    inputs
}

/// A step of the reference that stays in a state.
fn in_state(state: AsState, inputs: &Inputs) -> Outputs {
    let (_, outputs) = Machine::REFERENCE.step(&Control { state, ..Control::INITIAL }, inputs, 10);
    assert_eq!(outputs.state, state, "the inputs lead out of it");
    outputs
}

//= SM-1
#[test]
fn a_step_returns_the_arrow_and_the_alternative_that_it_took() {
    let vcu = Machine::REFERENCE;
    let inputs = Inputs { go: false, ..busy() };
    let (_, outputs) = vcu.step(&Control { state: AsState::Driving, ..Control::INITIAL }, &inputs, 10);
    let (row, term) = (outputs.row(&vcu).expect("an arrow"), outputs.term(&vcu).expect("an alternative"));
    assert_eq!((row.section, row.from, row.to), ("3.7", AsState::Driving, AsState::EmergencyBrake));
    assert!(row.terms().contains(term));
    assert_eq!(term.literals().collect::<Vec<_>>(), [(Atom::GoOn, false)]);
    let stays = in_state(AsState::Driving, &busy());
    assert_eq!((stays.row(&vcu), stays.term(&vcu)), (None, None));
}

//= SM-3
#[test]
fn a_power_cycle_leads_to_as_off() {
    assert_eq!(Control::default(), Control::INITIAL);
    let (_, outputs) = Machine::REFERENCE.step(&Control::INITIAL, &busy(), 10);
    assert_eq!((outputs.from, outputs.state), (AsState::Off, AsState::Off));
}

#[test]
fn each_state_has_its_light() {
    for (state, light) in [
        (AsState::Off, "off"),                       //= SM-4
        (AsState::Ready, "yellow, continuous"),      //= SM-5
        (AsState::Driving, "yellow, flashing"),      //= SM-6
        (AsState::EmergencyBrake, "blue, flashing"), //= SM-7
        (AsState::Finished, "blue, continuous"),     //= SM-8
    ] {
        assert_eq!(Assi::of(state).to_string(), light, "{state}");
        assert_eq!(in_state(state, &busy()).assi(), Assi::of(state));
    }
}

//= MSG-18, MSG-25, D-41
#[test]
fn as_driving_lets_every_request_through_as_it_is() {
    let inputs = busy();
    let expected = Actuation {
        front_axle_trq: AxleTorqueRequest::clamped(1000),
        front_motor_speed_max: MotorSpeedMax::clamped(1001),
        rear_axle_trq: AxleTorqueRequest::clamped(1100),
        rear_motor_speed_max: MotorSpeedMax::clamped(1101),
        direction: DirectionRequest::Forward,
        steer: Some(SteerAngle::clamped(104)),
        hyd_press_f: BrakePressure::clamped(101),
        hyd_press_r: BrakePressure::clamped(60),
        ebs_triggered: false,
    };
    assert_eq!(in_state(AsState::Driving, &inputs).actuation(&inputs), expected);
}

//= DRV-2, DRV-3, FIN-5, FIN-6, D-21, D-41
#[test]
fn as_ready_and_as_finished_let_brake_requests_through_alone() {
    let inputs = busy();
    let expected = Actuation {
        hyd_press_f: BrakePressure::clamped(101),
        hyd_press_r: BrakePressure::clamped(60),
        ..Actuation::default()
    };
    assert_eq!((expected.steer, expected.front_axle_trq.raw()), (None, 0));
    for state in [AsState::Ready, AsState::Finished] {
        assert_eq!(in_state(state, &inputs).actuation(&inputs), expected, "{state}");
    }
}

//= D-21, D-42, D-43
#[test]
fn as_off_lets_nothing_through_and_emergency_brake_brakes_fully() {
    let inputs = busy();
    assert_eq!(in_state(AsState::Off, &inputs).actuation(&inputs), Actuation::default());
    let full = BrakePressure::from_pct(100.0).expect("in range");
    let expected =
        Actuation { hyd_press_f: full, hyd_press_r: full, ebs_triggered: true, ..Actuation::default() };
    assert_eq!(in_state(AsState::EmergencyBrake, &inputs).actuation(&inputs), expected);
}

/// The powertrain is ready for commands before the state is left: they act from the very step that enters AS_DRIVING,
/// and no longer from the very step that enters AS_FINISHED.
//= DRV-1, FIN-5, FIN-6
#[test]
fn commands_act_from_the_step_that_enters_as_driving_to_the_step_that_leaves_it() {
    let vcu = Machine::REFERENCE;
    let mut inputs = busy();
    inputs.ai.status.direction_request = DirectionRequest::Neutral;
    inputs.ai.drive_f.front_axle_trq_request = AxleTorqueRequest::MIN;
    inputs.ai.drive_r.rear_axle_trq_request = AxleTorqueRequest::MIN;
    inputs.ai.steer.steer_request = SteerAngle::clamped(0);
    inputs.vehicle.steer_angle = SteerAngle::clamped(0);
    inputs.vehicle.wheel_speeds = Vcu2AiWheelSpeeds::default();
    let ready = Control { state: AsState::Ready, in_state_ms: 5000, go_seen_low: true, ..Control::INITIAL };

    let (driving, outputs) = vcu.step(&ready, &inputs, 10);
    assert_eq!(outputs.state, AsState::Driving);
    let actuation = outputs.actuation(&inputs);
    assert_eq!(actuation.steer, Some(SteerAngle::clamped(0)), "the steering is active");
    assert_eq!(actuation.front_motor_speed_max.raw(), 1001, "the motors have their limits");

    let asked = Inputs { ai: busy().ai, ..inputs };
    let (driving, outputs) = vcu.step(&driving, &asked, 10);
    assert_eq!(outputs.actuation(&asked).front_axle_trq.raw(), 1000);

    let mut finished = asked;
    finished.ai.status.mission_status = adsdv_spec::messages::MissionStatus::Finished;
    let (_, outputs) = vcu.step(&driving, &finished, 10);
    assert_eq!(outputs.state, AsState::Finished);
    let actuation = outputs.actuation(&finished);
    assert_eq!(
        (actuation.front_axle_trq.raw(), actuation.rear_axle_trq.raw(), actuation.steer),
        (0, 0, None)
    );
}

//= MSG-65 to MSG-83
#[test]
fn requests_are_returned_and_measurements_passed_on() {
    let inputs = busy();
    let (ai, vehicle) = (inputs.ai, inputs.vehicle);
    for state in AsState::ALL {
        let messages = in_state(state, &inputs).messages(&inputs);
        assert_eq!(
            messages.drive_f,
            Vcu2AiDriveF {
                front_axle_trq: vehicle.front_axle_trq,
                front_axle_trq_request: ai.drive_f.front_axle_trq_request,
                front_axle_trq_max: vehicle.front_axle_trq_max,
            }
        );
        assert_eq!(
            messages.drive_r,
            Vcu2AiDriveR {
                rear_axle_trq: vehicle.rear_axle_trq,
                rear_axle_trq_request: ai.drive_r.rear_axle_trq_request,
                rear_axle_trq_max: vehicle.rear_axle_trq_max,
            }
        );
        assert_eq!(
            messages.steer,
            Vcu2AiSteer {
                steer_angle: vehicle.steer_angle,
                steer_angle_max: vehicle.steer_angle_max,
                steer_angle_request: ai.steer.steer_request,
            }
        );
        assert_eq!(
            messages.brake,
            Vcu2AiBrake {
                hyd_press_f: vehicle.hyd_press_f,
                hyd_press_f_req: ai.brake.hyd_press_f_req,
                hyd_press_r: vehicle.hyd_press_r,
                hyd_press_r_req: ai.brake.hyd_press_r_req,
                status_brk: StatusBrk::Ready,
                status_ebs: messages.log_status.state_ebs,
            }
        );
        assert_eq!(
            (messages.wheel_speeds, messages.wheel_counts),
            (vehicle.wheel_speeds, vehicle.wheel_counts)
        );
    }
}

//= MSG-42 to MSG-49, RDY-6, D-37, D-38
#[test]
fn the_status_shows_switches_states_and_signals() {
    let inputs = busy();
    for state in AsState::ALL {
        let status = in_state(state, &inputs).messages(&inputs).status;
        let driving = state == AsState::Driving;
        let expected = Vcu2AiStatus {
            handshake: status.handshake,
            as_switch_status: true,
            ts_switch_status: true,
            go_signal: driving,
            steering_status: driving,
            as_state: state,
            ami_state: AmiState::Autocross,
            // Version 3.0 sends none of these three.
            op_state: status.op_state,
            ts_state: status.ts_state,
            ebs_state: status.ebs_state,
            ..Vcu2AiStatus::default()
        };
        assert_eq!(status, expected, "no fault, no warning, no request to shut down");
    }
    let off = Inputs { asms: false, ..busy() };
    let status = in_state(AsState::Off, &off).messages(&off).status;
    assert!(!status.as_switch_status && status.ts_switch_status);
    let off = Inputs { tsms: false, ..busy() };
    let status = in_state(AsState::Ready, &off).messages(&off).status;
    assert!(status.as_switch_status && !status.ts_switch_status);
    assert!(!status.handshake, "it rests while TSMS is off");

    // While the AI Computer sends the bit back at once, the VCU's alternates.
    let mut control = Control::INITIAL;
    let mut inputs = busy();
    for cycle in 0..6 {
        let (next, outputs) = Machine::REFERENCE.step(&control, &inputs, 10);
        control = next;
        let bit = outputs.messages(&inputs).status.handshake;
        assert_eq!(bit, cycle % 2 == 0);
        inputs.ai.status.handshake = bit;
    }
}

//= DRV-14, D-7, MSG-46
#[test]
fn go_signal_comes_with_as_driving_and_goes_with_the_switch() {
    let go = |inputs: &Inputs, control: &Control| {
        let (after, outputs) = Machine::REFERENCE.step(control, inputs, 10);
        (after.state, outputs.messages(inputs).status.go_signal)
    };
    let mut inputs = Inputs { asms: true, tsms: true, go: true, ..Inputs::default() };
    let ready = Control { state: AsState::Ready, in_state_ms: 5000, ..Control::INITIAL };
    assert_eq!(go(&inputs, &ready), (AsState::Ready, false), "the switch has been on since before");
    let seen_low = Control { go_seen_low: true, ..ready };
    assert_eq!(go(&inputs, &seen_low), (AsState::Driving, true), "the step that accepts the edge tells it");
    inputs.go = false;
    let driving = Control { state: AsState::Driving, ..Control::INITIAL };
    assert_eq!(go(&inputs, &driving), (AsState::EmergencyBrake, false));
}

//= MSG-51 to MSG-53, D-39
#[test]
fn a_warning_is_summed_up() {
    for (hot, low) in [(false, false), (true, false), (false, true), (true, true)] {
        let mut inputs = busy();
        (inputs.reports.batt_temp_high, inputs.reports.batt_soc_low) = (hot, low);
        let status = in_state(AsState::Driving, &inputs).messages(&inputs).status;
        assert_eq!((status.warn_batt_temp_high, status.warn_batt_soc_low), (hot, low));
        assert_eq!(status.warning_status, hot || low);
        assert!(!status.fault_status, "a warning is no fault");
    }
}

//= MSG-29 to MSG-33, D-47 to D-50
#[test]
fn the_vcu_sends_the_dynamics_to_the_logger() {
    let inputs = busy();
    let log = in_state(AsState::Driving, &inputs).messages(&inputs).log_dynamics;
    let raw = |log: Vcu2LogDynamics1| {
        [
            log.speed_actual.raw(),
            log.speed_target.raw(),
            log.steer_actual.raw(),
            log.steer_target.raw(),
            log.brake_actual.raw(),
            log.brake_target.raw(),
            log.drive_trq_actual.raw(),
            log.drive_trq_target.raw(),
        ]
    };
    // -9.9 and 10.4 degrees in halves of a degree; 45 % and 25.5 %, 50.5 % and 30 %; -150 Nm and 210 Nm of 390 Nm.
    assert_eq!(raw(log), [33, 32, -19, 20, 35, 40, -38, 53]);

    let mut most = busy();
    most.ai.drive_f.front_axle_trq_request = AxleTorqueRequest::MAX;
    most.ai.drive_r.rear_axle_trq_request = AxleTorqueRequest::MAX;
    most.ai.brake.hyd_press_f_req = BrakePressure::MAX;
    most.ai.brake.hyd_press_r_req = BrakePressure::MAX;
    let log = in_state(AsState::Driving, &most).messages(&most).log_dynamics;
    assert_eq!((log.drive_trq_target.raw(), log.brake_target.raw()), (100, 100));
}

//= MSG-34 to MSG-40, D-28, D-29
#[test]
fn the_vcu_sends_the_status_to_the_logger() {
    let inputs = busy();
    for state in AsState::ALL {
        let braking = state == AsState::EmergencyBrake;
        let expected = Vcu2LogStatus {
            state_assi: state,
            state_ebs: if braking { EbsState::Triggered } else { EbsState::Armed },
            state_ami: AmiState::Autocross,
            state_steering: state == AsState::Driving,
            state_service_brake: ServiceBrake::Engaged,
            lap_counter: LapCounter::clamped(9),
            cones_count_actual: 200,
            cones_count_all: ConesCountAll::clamped(60_000),
        };
        assert_eq!(in_state(state, &inputs).messages(&inputs).log_status, expected);
    }
}

//= MSG-39, D-46
#[test]
fn the_service_brake_is_engaged_available_or_disengaged() {
    for (front, rear, tsms, expected) in [
        (1, 0, true, ServiceBrake::Engaged),
        (0, 1, false, ServiceBrake::Engaged),
        (0, 0, true, ServiceBrake::Available),
        (0, 0, false, ServiceBrake::Disengaged),
    ] {
        let mut inputs = Inputs { tsms, ..Inputs::default() };
        inputs.vehicle.hyd_press_f = BrakePressure::clamped(front);
        inputs.vehicle.hyd_press_r = BrakePressure::clamped(rear);
        let log = in_state(AsState::Off, &inputs).messages(&inputs).log_status;
        assert_eq!(log.state_service_brake, expected, "{front} {rear} {tsms}");
    }
}

//= MSG-29, MSG-34, MSG-41, MSG-65, MSG-69, MSG-73, MSG-77, MSG-80, MSG-82
#[test]
fn every_message_is_sent_under_its_identifier() {
    let inputs = busy();
    let frames =
        in_state(AsState::Driving, &inputs).messages(&inputs).frames(&Machine::REFERENCE.edition().bus);
    let ids: Vec<u16> = frames.map(|frame| frame.id).collect();
    assert_eq!(ids, [0x520, 0x521, 0x522, 0x523, 0x524, 0x525, 0x526, 0x500, 0x502]);
}
