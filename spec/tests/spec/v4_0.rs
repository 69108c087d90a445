//! The state machine of version 4.0, where it is another than that of 3.0: what ends `AS_DRIVING`, the messages that are
//! watched, and what 120h shows of them.

use adsdv_spec::messages::{
    AxleTorqueRequest, BrakePressure, DirectionRequest, EbsState, MissionStatus, ShutdownCause, SmAs, SmSys,
    StatusBrk, SysActionState, VcuStatus, WheelSpeed,
};
use adsdv_spec::{
    AiSilence, AsState, Choice, Control, Edition, Fault, Faults, Handshake, Inputs, Machine, Outputs,
};

const EDITION: Edition = Edition::V4_0;

/// Everything is on, and the vehicle stands.
fn on() -> Inputs {
    let mut inputs = Inputs { asms: true, tsms: true, go: true, ebs: EbsState::Armed, ..Inputs::default() };
    inputs.ai.status.mission_status = MissionStatus::Running;
    inputs.ai.status.direction_request = DirectionRequest::Forward;
    inputs
}

fn changed(change: impl FnOnce(&mut Inputs)) -> Inputs {
    let mut inputs = on();
    change(&mut inputs);
    inputs
}

fn machine(choices: &[Choice]) -> Machine {
    Machine::new(EDITION, choices.iter().fold(EDITION.readings, |readings, &choice| readings.with(choice)))
}

fn step(machine: &Machine, state: AsState, inputs: &Inputs) -> Outputs {
    machine.step(&Control { state, ..Control::INITIAL }, inputs, 10).1
}

/// Where a state leads with these inputs, and why.
fn leads(machine: &Machine, state: AsState, inputs: &Inputs) -> (AsState, ShutdownCause) {
    let outputs = step(machine, state, inputs);
    (outputs.state, outputs.shutdown_cause)
}

fn moving(inputs: &mut Inputs) {
    inputs.vehicle.wheel_speeds.rl_wheel_speed = WheelSpeed::clamped(11);
}

fn brake_and_torque(inputs: &mut Inputs) {
    inputs.ai.drive_r.rear_axle_trq_request = AxleTorqueRequest::clamped(1);
    inputs.ai.brake.hyd_press_f_req = BrakePressure::clamped(1);
}

const DRIVES_ON: (AsState, ShutdownCause) = (AsState::Driving, ShutdownCause::NoShutdown);

fn brakes(cause: ShutdownCause) -> (AsState, ShutdownCause) {
    (AsState::EmergencyBrake, cause)
}

//= DTE-1 to DTE-3, DTE-6 to DTE-13, IMP-5 to IMP-9, MSG-84, MSG-85, D-55, D-65
#[test]
fn each_of_the_ten_alternatives_ends_driving_with_its_cause() {
    use ShutdownCause::{
        AiCommsFault, AiComputerRequest, AutonomousBrakingFault, BmsFault, BrakePlausibilityFault, EbsFault,
        HvilOpenFault, MissionStatusFault,
    };
    let vcu = machine(&[]);
    let driving = |change: fn(&mut Inputs)| leads(&vcu, AsState::Driving, &changed(change));
    assert_eq!(driving(|_| {}), DRIVES_ON);
    assert_eq!(driving(|inputs| inputs.sdc.remote_estop = true), brakes(HvilOpenFault));
    assert_eq!(driving(|inputs| inputs.asms = false), brakes(HvilOpenFault));
    assert_eq!(driving(|inputs| inputs.go = false), brakes(HvilOpenFault));
    let finished = |inputs: &mut Inputs| inputs.ai.status.mission_status = MissionStatus::Finished;
    assert_eq!(leads(&vcu, AsState::Driving, &changed(finished)).0, AsState::Finished);
    let finished_moving = changed(|inputs| {
        finished(inputs);
        moving(inputs);
    });
    assert_eq!(leads(&vcu, AsState::Driving, &finished_moving), brakes(MissionStatusFault));
    let neutral = |inputs: &mut Inputs| inputs.ai.status.direction_request = DirectionRequest::Neutral;
    assert_eq!(leads(&vcu, AsState::Driving, &changed(neutral)), DRIVES_ON);
    let neutral_moving = changed(|inputs| {
        neutral(inputs);
        moving(inputs);
    });
    assert_eq!(leads(&vcu, AsState::Driving, &neutral_moving), brakes(AutonomousBrakingFault));
    assert_eq!(driving(brake_and_torque), brakes(BrakePlausibilityFault));
    assert_eq!(driving(|inputs| inputs.ai.status.estop_request = true), brakes(AiComputerRequest));
    assert_eq!(driving(|inputs| inputs.ai_silence = AiSilence::of(100)), brakes(AiCommsFault));
    assert_eq!(driving(|inputs| inputs.sdc.bms_fault = true), brakes(BmsFault));
    assert_eq!(driving(|inputs| inputs.ebs = EbsState::Unavailable), brakes(EbsFault));
    assert_eq!(driving(|inputs| inputs.ebs = EbsState::Triggered), DRIVES_ON, "D-55");
}

//= IMP-8, D-53, D-64
#[test]
fn torque_of_either_axle_and_either_brake_exclude_each_other() {
    let request = |front, rear, front_brake, rear_brake| {
        changed(|inputs| {
            inputs.ai.drive_f.front_axle_trq_request = AxleTorqueRequest::clamped(front);
            inputs.ai.drive_r.rear_axle_trq_request = AxleTorqueRequest::clamped(rear);
            inputs.ai.brake.hyd_press_f_req = BrakePressure::clamped(front_brake);
            inputs.ai.brake.hyd_press_r_req = BrakePressure::clamped(rear_brake);
        })
    };
    let (vcu, never) = (machine(&[]), machine(&[Choice::TorqueNever]));
    for (front, rear) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
        for (front_brake, rear_brake) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
            let inputs = request(front, rear, front_brake, rear_brake);
            let fault = front + rear > 0 && front_brake + rear_brake > 0;
            let expected = if fault { brakes(ShutdownCause::BrakePlausibilityFault) } else { DRIVES_ON };
            assert_eq!(leads(&vcu, AsState::Driving, &inputs), expected, "{inputs:?}");
            assert_eq!(leads(&never, AsState::Driving, &inputs), DRIVES_ON);
        }
    }
}

//= D-54, D-62, D-63
#[test]
fn outside_of_driving_the_readings_decide_what_an_emergency_is() {
    let comms = changed(|inputs| inputs.ai_silence = AiSilence::of(100));
    let estop = changed(|inputs| inputs.ai.status.estop_request = true);
    let battery = changed(|inputs| inputs.sdc.bms_fault = true);
    for state in [AsState::Ready, AsState::Finished] {
        let with = |choice, inputs| leads(&machine(&[choice]), state, inputs);
        let stays = (state, ShutdownCause::NoShutdown);
        assert_eq!(with(Choice::CommsEveryState, &comms), brakes(ShutdownCause::AiCommsFault));
        assert_eq!(with(Choice::CommsDriving, &comms), stays);
        assert_eq!(with(Choice::EstopEveryState, &estop), brakes(ShutdownCause::AiComputerRequest));
        assert_eq!(with(Choice::EstopDriving, &estop), stays);
        assert_eq!(with(Choice::BmsSdc, &battery), brakes(ShutdownCause::BmsFault));
        assert_eq!(with(Choice::BmsDriving, &battery), stays);
        let more = changed(|inputs| {
            inputs.sdc.bms_fault = true;
            inputs.reports.hvil_short = true;
        });
        let short = brakes(ShutdownCause::HvilShortFault);
        assert_eq!(with(Choice::BmsDriving, &more), short, "what else opens the circuit still does");
        assert_eq!(with(Choice::BmsSdc, &brake_and_torque_in(on())), stays, "judged in AS_DRIVING");
    }
    let battery = leads(&machine(&[Choice::BmsDriving]), AsState::Driving, &battery);
    assert_eq!(battery, brakes(ShutdownCause::BmsFault));
}

fn brake_and_torque_in(mut inputs: Inputs) -> Inputs {
    brake_and_torque(&mut inputs);
    inputs
}

//= HS-18, D-51, D-52
#[test]
fn a_message_is_missed_from_the_limit_on_while_the_handshake_is_performed() {
    let (vcu, always) = (machine(&[]), machine(&[Choice::WatchAlways]));
    for id in EDITION.bus.messages.iter().map(|message| message.id).filter(|id| *id >> 4 == 0x51) {
        let silent = |silence_ms| {
            let mut others = AiSilence::of(silence_ms);
            others.end(id);
            let mut silence = AiSilence::default().after(silence_ms.into());
            for other in EDITION.bus.messages.iter().map(|message| message.id).filter(|other| *other != id) {
                silence.end(other);
            }
            assert_eq!((silence.longest_ms(), others.longest_ms()), (silence_ms, silence_ms));
            changed(|inputs| inputs.ai_silence = silence)
        };
        assert_eq!(leads(&vcu, AsState::Driving, &silent(99)), DRIVES_ON);
        assert_eq!(leads(&vcu, AsState::Driving, &silent(100)), brakes(ShutdownCause::AiCommsFault));
        let unwatched = Inputs { tsms: false, ..silent(100) };
        assert_eq!(leads(&vcu, AsState::Driving, &unwatched), DRIVES_ON, "TSMS is off");
        assert_eq!(leads(&always, AsState::Driving, &unwatched), brakes(ShutdownCause::AiCommsFault));
        let again = step(&vcu, AsState::Off, &silent(0));
        assert!(!again.faults.has(Fault::AiCommsFault), "the fault ends with the next message");
    }
    assert_eq!(AiSilence::of(u16::MAX).after(u32::MAX), AiSilence::of(u16::MAX), "no time runs over");
}

//= HS-17, HS-19
#[test]
fn the_handshake_has_100_ms() {
    let vcu = machine(&[]);
    let unanswered = |ms| Control {
        state: AsState::Driving,
        handshake: Handshake { active: true, bit: true, unanswered_ms: ms },
        ..Control::INITIAL
    };
    let (late, _) = vcu.step(&unanswered(80), &on(), 10);
    assert_eq!((late.state, late.handshake.unanswered_ms), (AsState::Driving, 90));
    let (lost, outputs) = vcu.step(&late, &on(), 10);
    assert_eq!((lost.state, lost.shutdown_cause), brakes(ShutdownCause::AiCommsFault));
    assert!(outputs.handshake_lost && !step(&vcu, AsState::Driving, &on()).handshake_lost);
}

/// What 120h shows after a step from this state.
fn shown(state: AsState, inputs: &Inputs) -> VcuStatus {
    step(&machine(&[]), state, inputs).messages(inputs).vcu_status
}

//= MSG-88 to MSG-94, D-56 to D-59
#[test]
fn the_status_of_120h_tells_the_state_and_what_is_missed() {
    let driving = shown(AsState::Driving, &on());
    assert_eq!(EDITION.bus.encode(driving).map(|f| f.to_string()).as_deref(), Some("120#0430000000000200"));
    assert_eq!(EDITION.bus.encode(driving).and_then(|_| Edition::V3_0.bus.encode(driving)), None);

    let silent = changed(|inputs| inputs.ai_silence.drive_f_silence_ms = 100);
    let braking = shown(AsState::Driving, &silent);
    assert_eq!(EDITION.bus.encode(braking).map(|f| f.to_string()).as_deref(), Some("120#0440000040000220"));
    let unwatched = shown(AsState::Driving, &Inputs { tsms: false, ..silent });
    assert!(!unwatched.drive_f_timeout && unwatched.sm_sys == SmSys::Aux);

    let each = |change: fn(&mut AiSilence)| {
        let shown = shown(AsState::Off, &changed(|inputs| change(&mut inputs.ai_silence)));
        [
            shown.status_timeout,
            shown.drive_f_timeout,
            shown.drive_r_timeout,
            shown.steer_timeout,
            shown.brake_timeout,
        ]
    };
    assert_eq!(each(|silence| silence.status_silence_ms = 100), [true, false, false, false, false]);
    assert_eq!(each(|silence| silence.drive_f_silence_ms = 100), [false, true, false, false, false]);
    assert_eq!(each(|silence| silence.drive_r_silence_ms = 100), [false, false, true, false, false]);
    assert_eq!(each(|silence| silence.steer_silence_ms = 100), [false, false, false, true, false]);
    assert_eq!(each(|silence| silence.brake_silence_ms = 100), [false, false, false, false, true]);

    let charging = Inputs { tsms: false, asms: false, ..changed(|inputs| inputs.reports.charging = true) };
    assert_eq!(shown(AsState::Off, &charging).sys_action_state, SysActionState::Charge);
    assert_eq!(shown(AsState::Off, &Inputs::default()).sys_action_state, SysActionState::Initialise);
    for (state, name) in AsState::ALL.into_iter().zip([
        SmAs::Off,
        SmAs::Ready,
        SmAs::Driving,
        SmAs::EmergencyBrake,
        SmAs::Finished,
    ]) {
        let outputs = Outputs { state, ..step(&machine(&[]), AsState::Off, &Inputs::default()) };
        assert_eq!(outputs.messages(&Inputs::default()).vcu_status.sm_as, name);
    }
    let warned = |fault| {
        let outputs = Outputs {
            faults: Faults::NONE.with(fault),
            ..step(&machine(&[]), AsState::Off, &Inputs::default())
        };
        let VcuStatus {
            warn_brake_plausibility,
            warn_kl15_under_v,
            warn_ai_estop_req,
            warn_ai_comms_lost,
            warn_auto_braking,
            warn_mission_status,
            ..
        } = outputs.messages(&Inputs::default()).vcu_status;
        assert!(!warn_kl15_under_v, "no threshold is given");
        [
            warn_brake_plausibility,
            warn_ai_estop_req,
            warn_ai_comms_lost,
            warn_auto_braking,
            warn_mission_status,
        ]
    };
    assert_eq!(warned(Fault::BrakePlausibilityFault), [true, false, false, false, false]);
    assert_eq!(warned(Fault::AiComputerRequest), [false, true, false, false, false]);
    assert_eq!(warned(Fault::AiCommsFault), [false, false, true, false, false]);
    assert_eq!(warned(Fault::AutonomousBrakingFault), [false, false, false, true, false]);
    assert_eq!(warned(Fault::MissionStatusFault), [false, false, false, false, true]);
    assert_eq!(warned(Fault::EbsFault), [false; 5]);
}

//= MSG-86, MSG-87, D-60, D-61
#[test]
fn the_brakes_are_ready_and_both_states_of_the_ebs_are_one() {
    for state in AsState::ALL {
        for ebs in EbsState::ALL {
            let inputs = changed(|inputs| inputs.ebs = ebs);
            let outputs = Outputs { state, ..step(&machine(&[]), AsState::Off, &inputs) };
            let messages = outputs.messages(&inputs);
            assert_eq!(messages.brake.status_brk, StatusBrk::Ready);
            assert_eq!(messages.brake.status_ebs, messages.log_status.state_ebs);
            let braking = state == AsState::EmergencyBrake;
            assert_eq!(messages.brake.status_ebs, if braking { EbsState::Triggered } else { ebs });
        }
    }
}

/// Every other arrow is as it was: what 4.0 does not change, it does not change.
#[test]
fn all_other_rows_and_numbers_are_those_of_3_0() {
    let (old, new) = (Edition::V3_0.rules, EDITION.rules);
    for (before, now) in old.table.rows().iter().zip(new.table.rows()) {
        let changed = (now.from, now.to) == (AsState::Driving, AsState::EmergencyBrake);
        assert_eq!((before.from, before.to), (now.from, now.to));
        assert_eq!(before == now, !changed, "{}", now.section);
    }
    assert_eq!(old.table.rows().len(), new.table.rows().len());
    assert_eq!(old.priorities, new.priorities);
    assert_eq!(old.timing, adsdv_spec::Timing { handshake_ms: 50, ..new.timing });
    assert_eq!(old.thresholds, adsdv_spec::Thresholds { missed_ms: None, ..new.thresholds });
}

/// What 3.0 does not have cannot matter in it, whatever an observation says of it.
#[test]
fn what_an_edition_lacks_never_matters() {
    use adsdv_spec::Observation;
    let lacking = Observation::SCOPE.difference(Edition::V3_0.scope());
    assert_eq!(lacking.to_string(), "ebs-unavailable brake-request-zero ai-messages-missed bms-fault");
    assert_eq!(Observation::SCOPE.difference(EDITION.scope()).to_string(), "mission-running");
    let vcu = Machine::REFERENCE;
    for state in AsState::ALL {
        let control = Control { state, ..Control::INITIAL };
        let with =
            Observation::new(on().observe(&EDITION.rules.thresholds).atoms().union(lacking), Faults::NONE);
        let without = Observation::new(with.atoms().difference(lacking), Faults::NONE);
        assert_eq!(vcu.react(&control, with, 10), vcu.react(&control, without, 10), "{state}");
        assert!(vcu.reads(&control, 10).atoms.intersection(lacking).is_empty());
    }
}
