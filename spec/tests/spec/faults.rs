//! Faults: where each comes from, what it does, and what 520h tells of it.

use adsdv_spec::messages::{
    AsState, DirectionRequest, MissionStatus, ShutdownCause, Vcu2AiStatus, Vcu2AiWheelSpeeds, WheelSpeed,
};
use adsdv_spec::{Choice, Control, Edition, Fault, Inputs, Machine, Readings};

/// Sets off a fault.
type Cause = fn(&mut Inputs);
/// Reads a flag.
type Flag = fn(&Vcu2AiStatus) -> bool;

/// What opens the shutdown circuit, as a press or a removal rather than as a flag of its own: the VCU reports them all as cause 2.
const OPENING: [(&str, Cause); 6] = [
    ("remote E-stop", |i| i.sdc.remote_estop = true),    //= RTE-2
    ("remote link", |i| i.sdc.res_link_lost = true),     //= RTE-3
    ("vehicle E-stop", |i| i.sdc.vehicle_estop = true),  //= RTE-4
    ("crash sensor", |i| i.sdc.crash_sensor = true),     //= RTE-5
    ("critical fault", |i| i.sdc.critical_fault = true), //= RTE-6
    ("dongle removed", |i| i.sdc.mpp_dongle_removed = true), //= RTE-8
];

/// The faults with a flag and a number of their own, that the inputs alone decide.
const FLAGGED: [(Cause, Flag, ShutdownCause); 7] = [
    (|i| i.ai.status.estop_request = true, |s| s.ai_estop_request, ShutdownCause::AiComputerRequest), //= MSG-54
    (|i| i.reports.hvil_open = true, |s| s.hvil_open_fault, ShutdownCause::HvilOpenFault), //= MSG-55
    (|i| i.reports.hvil_short = true, |s| s.hvil_short_fault, ShutdownCause::HvilShortFault), //= MSG-56
    (|i| i.reports.ebs_fault = true, |s| s.ebs_fault, ShutdownCause::EbsFault),            //= MSG-57
    (
        |i| i.reports.offboard_charger_fault = true, //= MSG-58
        |s| s.offboard_charger_fault,
        ShutdownCause::OffboardChargerFault,
    ),
    (
        |i| i.reports.charging = true, //= MSG-62
        |s| s.charge_procedure_fault,
        ShutdownCause::ChargeProcedureFault,
    ),
    (|i| i.sdc.bms_fault = true, |s| s.bms_fault, ShutdownCause::BmsFault), //= MSG-63, RTE-7
];

/// AS_DRIVING at speed, with everything as it should be.
fn driving() -> Inputs {
    let mut inputs = Inputs { asms: true, tsms: true, go: true, ..Inputs::default() };
    inputs.ai.status.mission_status = MissionStatus::Running;
    inputs.ai.status.direction_request = DirectionRequest::Forward;
    inputs.vehicle.wheel_speeds =
        Vcu2AiWheelSpeeds { rl_wheel_speed: WheelSpeed::clamped(11), ..Vcu2AiWheelSpeeds::default() };
    inputs
}

/// A step from a state; its control state and its 520h.
fn step(control: &Control, inputs: &Inputs) -> (Control, Vcu2AiStatus) {
    let (after, outputs) = Machine::REFERENCE.step(control, inputs, 10);
    (after, outputs.messages(inputs).status)
}

fn from(state: AsState, cause: Cause) -> (Control, Vcu2AiStatus) {
    let mut inputs = driving();
    cause(&mut inputs);
    step(&Control { state, ..Control::INITIAL }, &inputs)
}

const ACTIVE: [AsState; 3] = [AsState::Ready, AsState::Driving, AsState::Finished];

//= D-12, D-14
#[test]
fn two_causes_open_the_shutdown_circuit_as_one_does() {
    for (one, first) in OPENING {
        for (other, second) in OPENING {
            let mut inputs = driving();
            first(&mut inputs);
            second(&mut inputs);
            assert!(inputs.faults().has(Fault::HvilOpenFault), "{one} and {other}");
            inputs.reports.hvil_open = true;
            assert!(inputs.faults().has(Fault::HvilOpenFault), "{one} and {other}, and an open HVIL");
        }
    }
}

//= RTE-1, DTE-1, FTE-1, D-12, D-14
#[test]
fn whatever_opens_the_shutdown_circuit_stops_the_vehicle() {
    for state in ACTIVE {
        assert_eq!(from(state, |_| {}).0.state, state, "without a fault it stays");
        for (name, cause) in OPENING {
            let (after, status) = from(state, cause);
            assert_eq!(after.state, AsState::EmergencyBrake, "{name} in {state}");
            assert!(status.hvil_open_fault && status.fault_status, "{name} in {state}");
            assert_eq!(status.shutdown_cause, ShutdownCause::HvilOpenFault, "{name} in {state}");
        }
    }
}

//= MSG-50, MSG-64, D-9, D-40, DTE-1, FTE-1
#[test]
fn a_fault_stops_the_vehicle_and_is_shown_by_its_flag_and_its_number_alone() {
    for state in ACTIVE {
        let (_, none) = from(state, |_| {});
        assert!(!none.fault_status && none.shutdown_cause == ShutdownCause::NoShutdown);
        for (cause, flag, number) in FLAGGED {
            let (after, status) = from(state, cause);
            assert_eq!(after.state, AsState::EmergencyBrake, "{number} in {state}");
            assert!(status.fault_status, "{number} in {state}");
            assert_eq!(status.shutdown_cause, number, "{state}");
            for (_, other, its_number) in FLAGGED {
                assert_eq!(other(&status), its_number == number, "{its_number} for {number} in {state}");
            }
            assert!(flag(&status), "{number} in {state}");
        }
    }
}

//= MSG-62
#[test]
fn charging_is_a_fault_only_with_a_master_switch_on() {
    for (asms, tsms) in [(false, false), (true, false), (false, true)] {
        let mut inputs = Inputs { asms, tsms, ..Inputs::default() };
        inputs.reports.charging = true;
        let (_, status) = step(&Control::INITIAL, &inputs);
        assert_eq!(status.charge_procedure_fault, asms || tsms);
    }
}

/// NEUTRAL and FINISHED at speed are faults of AS_DRIVING alone.
//= MSG-60, MSG-61, D-27, IMP-1 to IMP-4, DTE-4, DTE-5
#[test]
fn what_the_ai_computer_must_not_do_at_speed() {
    let neutral: Cause = |i| i.ai.status.direction_request = DirectionRequest::Neutral;
    let finished: Cause = |i| i.ai.status.mission_status = MissionStatus::Finished;
    let flags = |status: &Vcu2AiStatus| (status.autonomous_braking_fault, status.mission_status_fault);
    let cases = [
        (neutral, (true, false), ShutdownCause::AutonomousBrakingFault),
        (finished, (false, true), ShutdownCause::MissionStatusFault),
    ];
    for (cause, shown, number) in cases {
        let (after, status) = from(AsState::Driving, cause);
        assert_eq!((after.state, flags(&status)), (AsState::EmergencyBrake, shown));
        assert_eq!(status.shutdown_cause, number);
        for state in [AsState::Off, AsState::Ready, AsState::Finished, AsState::EmergencyBrake] {
            assert_eq!(flags(&from(state, cause).1), (false, false), "{state}");
        }
    }
}

/// A switch that is off has no number of its own.
//= D-13, DTE-2, DTE-3
#[test]
fn a_switch_off_in_as_driving_is_shown_as_an_open_circuit() {
    let off: [Cause; 2] = [|i| i.go = false, |i| i.asms = false];
    for cause in off {
        let (after, status) = from(AsState::Driving, cause);
        assert_eq!(after.state, AsState::EmergencyBrake);
        assert!(status.hvil_open_fault && status.shutdown_cause == ShutdownCause::HvilOpenFault);
    }
}

//= D-15 to D-17
#[test]
fn the_first_cause_stays_and_the_lowest_number_wins() {
    let (after, status) = from(AsState::Driving, |i| {
        i.sdc.bms_fault = true;
        i.reports.ebs_fault = true;
        i.reports.hvil_short = true;
    });
    assert_eq!(status.shutdown_cause, ShutdownCause::HvilShortFault, "3 of 3, 4 and 10");
    assert!(status.bms_fault && status.ebs_fault && status.hvil_short_fault);

    let mut inputs = driving();
    inputs.reports.hvil_open = true;
    let (after, status) = step(&after, &inputs);
    assert_eq!(status.shutdown_cause, ShutdownCause::HvilShortFault, "a lower number later changes nothing");
    assert!(status.hvil_short_fault, "the flag of the cause stays");
    assert!(status.hvil_open_fault && !status.bms_fault && !status.ebs_fault, "the others are live");

    // A VCU that needs no power cycle keeps the cause through a second emergency.
    let lenient = Machine::new(Edition::V3_0, Readings::DEFAULT.with(Choice::PowerCycleNotLatched));
    let ready = Control { state: AsState::Ready, power_cycle_needed: false, ..after };
    let (again, _) = lenient.step(&ready, &inputs, 10);
    assert_eq!((again.state, again.shutdown_cause), (AsState::EmergencyBrake, after.shutdown_cause));

    let over = Control { in_state_ms: 15_000, ..after };
    let (off, status) = step(&over, &Inputs { asms: false, ..driving() });
    assert_eq!((off.state, status.shutdown_cause), (AsState::Off, ShutdownCause::HvilShortFault));
}
