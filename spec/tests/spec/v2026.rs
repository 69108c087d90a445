//! The vehicle of 2026: the state machine of version 4.0, what 520h shows beyond it, and the messages of the devices.

use adsdv_spec::messages::{Coding, Device, EbsStage, EbsState, Node, OpState, TsState};
use adsdv_spec::{Choice, Control, Edition, Inputs, Machine, Outputs};

const EDITION: Edition = Edition::V2026;

fn step(inputs: &Inputs) -> Outputs {
    Machine::new(EDITION, EDITION.readings).step(&Control::INITIAL, inputs, 10).1
}

//= D-67
#[test]
fn it_follows_the_rules_of_4_0_but_takes_torque_and_brake_at_once_for_no_fault() {
    let old = Edition::V4_0;
    assert_eq!((EDITION.rules, EDITION.faults, EDITION.choices), (old.rules, old.faults, old.choices));
    assert_eq!(EDITION.readings, old.readings.with(Choice::TorqueNever));
}

//= MSG-106 to MSG-108, D-71 to D-73
#[test]
fn the_status_shows_operation_tractive_system_and_ebs() {
    for charging in [false, true] {
        for tsms in [false, true] {
            for (ebs, stage) in [
                (EbsState::Unavailable, EbsStage::Init),
                (EbsState::Armed, EbsStage::Armed),
                (EbsState::Triggered, EbsStage::Triggered),
            ] {
                let mut inputs = Inputs { tsms, ebs, ..Inputs::default() };
                inputs.reports.charging = charging;
                let shown = step(&inputs).messages(&inputs).status;
                let operation = match (charging, tsms) {
                    (true, _) => OpState::Charge,
                    (false, true) => OpState::Auto,
                    (false, false) => OpState::Init,
                };
                let tractive = if tsms { TsState::Running } else { TsState::Init };
                assert_eq!((shown.op_state, shown.ts_state, shown.ebs_state), (operation, tractive, stage));
            }
        }
    }
}

//= MSG-116
#[test]
fn it_sends_no_120h() {
    let inputs = Inputs::default();
    let ids: Vec<_> = step(&inputs).messages(&inputs).frames(&EDITION.bus).map(|frame| frame.id).collect();
    assert_eq!(ids, [0x520, 0x521, 0x522, 0x523, 0x524, 0x525, 0x526, 0x500, 0x502]);
}

//= MSG-115, ID-20
#[test]
fn the_devices_have_identifiers_of_their_own() {
    let bus = EDITION.bus;
    assert_eq!(bus.devices.len(), 33);
    assert!(bus.devices.is_sorted_by(|one, next| one.id < next.id));
    for message in bus.devices {
        assert_eq!(bus.message(message.id), None, "{}", message.name);
        assert!(!bus.may_send(Node::Ai, message.id), "{}", message.name);
        assert_eq!(bus.may_send(Node::Vcu, message.id), message.sender == Device::Vcu, "{}", message.name);
        assert_eq!(bus.device(message.id), Some(message));
    }
    assert!(bus.may_send(Node::Ai, 0x303) && bus.may_send(Node::Vcu, 0x303));
    assert_ne!(bus, adsdv_spec::Bus { devices: &[], ..bus });
    assert!(format!("{bus:?}").contains("\"RES_TPDO\""));
    for edition in [Edition::V3_0, Edition::V4_0] {
        assert_eq!((edition.bus.devices.len(), edition.bus.device(0x181)), (0, None));
    }
}

/// Values as the tools of the bus read them.
//= MSG-115, D-70
#[test]
fn a_signal_of_a_device_has_its_unit() {
    let read = |id, name, data: &[u8]| {
        let signal = EDITION.bus.device(id).and_then(|message| message.signal(name)).expect(name);
        (signal.physical(data), signal.unit)
    };
    assert_eq!(read(0x300, "LEM_500A_ADC", &[0, 0, 0, 0, 0, 0, 0xC4, 0x09]), (Some(0.0), "A"));
    assert_eq!(read(0x600, "Temperature", &[0, 0, 0, 0, 0, 0, 0x80]), (Some(-40.0), "°C"));
    assert_eq!(read(0x610, "Rotation_X", &[0, 0, 0x20, 0xC1]), (Some(-10.0), "°/s"));
    assert_eq!(read(0x181, "ESTOP_STATUS", &[1]), (Some(1.0), ""), "a flag is no negative number");
    let flags = EDITION.bus.devices.iter().flat_map(|message| message.signals);
    assert!(flags.filter(|signal| signal.width == 1).all(|signal| signal.coding == Coding::Unsigned));
}
