//! What the operator does: the procedure of sections 3.1 and 3.2, and nothing more after an emergency.

use adsdv_model::closed::{Act, Closed, ClosedAction, ClosedState, Operator};
use adsdv_spec::messages::{AmiState, AsState, ShutdownCause};
use adsdv_spec::{Control, Machine};
use stateright::Model;

/// What a well-behaved operator may do.
fn acts(state: &ClosedState) -> Vec<Act> {
    let mut actions = Vec::new();
    Closed::new(Machine::REFERENCE, Operator::WellBehaved).actions(state, &mut actions);
    let acts = actions.into_iter();
    acts.filter_map(|action| if let ClosedAction::Operator(act) = action { Some(act) } else { None })
        .collect()
}

/// A state with this control state of the VCU, in which an operator has the time to act.
fn state(control: Control) -> ClosedState {
    ClosedState { control, rested: true, ..ClosedState::default() }
}

//= RDY-8
#[test]
fn the_mission_is_selected_once() {
    let selects = |state: &ClosedState| acts(state).iter().any(|act| matches!(act, Act::Mission(_)));
    let mut state = state(Control::INITIAL);
    assert!(selects(&state));
    assert!(!acts(&state).contains(&Act::Mission(AmiState::NotSelected)));
    state.switches.ami = AmiState::TrackDrive;
    assert!(!selects(&state));
}

//= DRV-13
#[test]
fn go_is_turned_off_where_it_is_found_on_and_on_again_after_the_dwell() {
    let ready = |in_state_ms, go, acts| {
        let mut state = state(Control { state: AsState::Ready, in_state_ms, ..Control::INITIAL });
        (state.switches.go, state.acts) = (go, acts);
        state
    };
    // After mission, TSMS, ASMS and EBS; the fifth act turns it off.
    assert_eq!(acts(&ready(0, true, 4)), [Act::Go(false)]);
    assert_eq!(acts(&ready(4990, false, 5)), []);
    assert_eq!(acts(&ready(5000, false, 5)), [Act::Go(true)]);
    assert_eq!(acts(&ready(5000, true, 6)), []);
}

#[test]
fn asms_is_turned_off_once_when_the_mission_is_finished() {
    let mut state = state(Control { state: AsState::Finished, ..Control::INITIAL });
    assert_eq!(acts(&state), []);
    state.switches.asms = true;
    assert_eq!(acts(&state), [Act::Asms(false)]);
}

/// The model has no power cycle, so a run ends in AS_OFF after an emergency: nobody goes on without one.
//= ETO-4
#[test]
fn nobody_drives_on_after_an_emergency() {
    for operator in [Operator::WellBehaved, Operator::Any] {
        let model = Closed::new(Machine::REFERENCE, operator);
        let actions = |shutdown_cause| {
            let control = Control { shutdown_cause, ..Control::INITIAL };
            let mut actions = Vec::new();
            model.actions(&state(control), &mut actions);
            actions
        };
        assert!(!actions(ShutdownCause::NoShutdown).is_empty());
        assert_eq!(actions(ShutdownCause::HvilOpenFault), []);
    }
}
