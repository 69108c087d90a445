//! What the control state remembers from one step to the next, and what that decides.

use adsdv_spec::messages::{
    AmiState, DirectionRequest, EbsState, MissionStatus, Vcu2AiWheelSpeeds, WheelSpeed,
};
use adsdv_spec::{AsState, Choice, Control, Edition, Inputs, Machine, Mutation, Readings, Timing};

const TIMING: Timing = Edition::V3_0.rules.timing;

fn under(choice: Choice) -> Machine {
    Machine::new(Edition::V3_0, Readings::DEFAULT.with(choice))
}

/// AS_READY with all that Figure 2 asks for on the way to AS_DRIVING but "Go".
fn ready() -> Inputs {
    let mut inputs = Inputs { asms: true, tsms: true, ebs: EbsState::Armed, ..Inputs::default() };
    inputs.ami = AmiState::TrackDrive;
    inputs.ai.status.mission_status = MissionStatus::Selected;
    inputs
}

/// AS_DRIVING, forward and at speed.
fn driving() -> Inputs {
    let mut inputs = Inputs { go: true, ..ready() };
    inputs.ai.status.mission_status = MissionStatus::Running;
    inputs.ai.status.direction_request = DirectionRequest::Forward;
    inputs.vehicle.wheel_speeds =
        Vcu2AiWheelSpeeds { fl_wheel_speed: WheelSpeed::clamped(500), ..Vcu2AiWheelSpeeds::default() };
    inputs
}

fn control(state: AsState) -> Control {
    Control { state, ..Control::INITIAL }
}

fn after(machine: &Machine, control: &Control, inputs: &Inputs, dt_ms: u32) -> Control {
    machine.step(control, inputs, dt_ms).0
}

#[test]
fn the_time_in_a_state_begins_with_it_and_stops_at_its_limit() {
    let vcu = Machine::REFERENCE;
    let entered = after(&vcu, &Control::INITIAL, &ready(), 10);
    assert_eq!((entered.state, entered.in_state_ms), (AsState::Ready, 0));
    // With the AI Computer's answer, as otherwise it would be lost.
    let later = |control: &Control, dt_ms| {
        let mut inputs = ready();
        inputs.ai.status.handshake = control.handshake.bit;
        after(&vcu, control, &inputs, dt_ms)
    };
    let soon = later(&entered, 30);
    assert_eq!((soon.state, soon.in_state_ms), (AsState::Ready, 30));
    let much_later = later(&soon, u32::MAX);
    assert_eq!((much_later.state, much_later.in_state_ms), (AsState::Ready, TIMING.ready_dwell_ms));
    assert_eq!(later(&much_later, 10).in_state_ms, TIMING.ready_dwell_ms);
}

//= DRV-11, D-6
#[test]
fn go_off_is_remembered_where_the_conditions_of_as_driving_hold() {
    let waited = Control { in_state_ms: TIMING.ready_dwell_ms, ..control(AsState::Ready) };
    let go = Inputs { go: true, ..ready() };
    let mut torque = ready();
    torque.ai.status.direction_request = DirectionRequest::Forward;
    let vcu = Machine::REFERENCE;
    assert!(after(&vcu, &waited, &ready(), 10).go_seen_low);
    assert!(!after(&vcu, &waited, &go, 10).go_seen_low, "Go is on");
    assert!(!after(&vcu, &waited, &torque, 10).go_seen_low, "another condition does not hold");
    assert!(!after(&vcu, &control(AsState::Ready), &ready(), 10).go_seen_low, "it is too early");
    assert!(under(Choice::GoEdgeEnough).step(&waited, &torque, 10).0.go_seen_low, "the edge is enough");
    assert!(!under(Choice::GoEdgeEnough).step(&waited, &go, 10).0.go_seen_low, "Go is on");

    let armed = Control { go_seen_low: true, ..waited };
    assert_eq!(after(&vcu, &armed, &go, 10).state, AsState::Driving);
    assert_eq!(after(&vcu, &waited, &go, 10).state, AsState::Ready, "it was never seen off");
    assert_eq!(after(&vcu, &armed, &ready(), 10).state, AsState::Ready, "it is still off");
}

/// A table without the arrow has no edge to wait for.
#[test]
fn go_off_is_not_remembered_without_the_arrow() {
    let mutation = Mutation::all(&Edition::V3_0).find(|mutation| mutation.to_string() == "3.2: dropped");
    let mutant = mutation.expect("the arrow is there").apply(&Edition::V3_0);
    for choice in [Choice::GoEdgeEnough, Choice::FaultEdge] {
        let machine = Machine::new(mutant, Readings::DEFAULT.with(choice));
        for inputs in [ready(), Inputs { asms: false, ..ready() }, driving(), Inputs::default()] {
            assert!(!after(&machine, &control(AsState::Ready), &inputs, 10).go_seen_low, "{choice}");
        }
    }
}

//= IMP-2, IMP-3, D-2
#[test]
fn where_the_change_counts_what_was_requested_is_remembered() {
    let (level, edge) = (Machine::REFERENCE, under(Choice::FaultEdge));
    let memory = |machine: &Machine, inputs: &Inputs| {
        let Control { state, was_running, was_forward, .. } =
            after(machine, &control(AsState::Driving), inputs, 10);
        assert_eq!(state, AsState::Driving);
        (was_running, was_forward)
    };
    let mut still = driving();
    still.vehicle.wheel_speeds = Vcu2AiWheelSpeeds::default();
    still.ai.status.mission_status = MissionStatus::Selected;
    still.ai.status.direction_request = DirectionRequest::Neutral;
    assert_eq!(memory(&level, &driving()), (false, false));
    assert_eq!(memory(&edge, &driving()), (true, true));
    assert_eq!(memory(&edge, &still), (false, false));
}

//= IMP-2, IMP-3, D-2
#[test]
fn where_the_change_counts_it_takes_one() {
    let edge = under(Choice::FaultEdge);
    let (mut finished, mut neutral) = (driving(), driving());
    finished.ai.status.mission_status = MissionStatus::Finished;
    neutral.ai.status.direction_request = DirectionRequest::Neutral;
    for was_running in [false, true] {
        for was_forward in [false, true] {
            let before = Control { was_running, was_forward, ..control(AsState::Driving) };
            let brakes = |inputs: &Inputs| after(&edge, &before, inputs, 10).state == AsState::EmergencyBrake;
            assert_eq!((brakes(&finished), brakes(&neutral)), (was_running, was_forward), "{before:?}");
            assert!(!brakes(&driving()));
        }
    }
}

//= D-3, D-4
#[test]
fn a_reading_lets_as_off_overtake_in_its_state_alone() {
    let mut both = Inputs { asms: false, ..driving() };
    both.sdc.remote_estop = true;
    for (choice, at) in
        [(Choice::ReadyOffFirst, AsState::Ready), (Choice::FinishedOffFirst, AsState::Finished)]
    {
        for from in [AsState::Ready, AsState::Driving, AsState::Finished] {
            let first = after(&Machine::REFERENCE, &control(from), &both, 10).state;
            assert_eq!(first, AsState::EmergencyBrake, "{from}");
            let expected = if from == at { AsState::Off } else { AsState::EmergencyBrake };
            assert_eq!(
                after(&under(choice), &control(from), &both, 10).state,
                expected,
                "{choice} in {from}"
            );
        }
    }
}

//= D-5
#[test]
fn a_reading_lets_as_finished_overtake() {
    let mut both = driving();
    both.sdc.remote_estop = true;
    both.ai.status.mission_status = MissionStatus::Finished;
    both.vehicle.wheel_speeds = Vcu2AiWheelSpeeds::default();
    let state = |machine: &Machine| after(machine, &control(AsState::Driving), &both, 10).state;
    assert_eq!(state(&Machine::REFERENCE), AsState::EmergencyBrake);
    assert_eq!(state(&under(Choice::DrivingFinishedFirst)), AsState::Finished);
    assert_eq!(state(&under(Choice::ReadyOffFirst)), AsState::EmergencyBrake);
}
