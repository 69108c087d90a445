//! An edition that nobody has published: what a further edition takes is one file, in which it stands as what it changes.
//!
//! It has another threshold, another length and another message than version 3.0, and one message less.

#![allow(unreachable_pub, reason = "what makes an edition makes public ones")]

extern crate std;

use std::string::ToString;

use super::V3_0;
use crate::bus::bus;
use crate::edition::{Edition, Rules};
use crate::export::{Dbc, Figure2};
use crate::limits::Thresholds;
use crate::messages::layout::layouts;
use crate::messages::{
    Ai2LogDynamics2, Ai2VcuBrake, Ai2VcuDriveF, Ai2VcuDriveR, Ai2VcuStatus, Ai2VcuSteer, Layout, SteerAngle,
    Vcu2AiBrake, Vcu2AiDriveF, Vcu2AiDriveR, Vcu2AiStatus, Vcu2AiSteer, Vcu2AiWheelCounts, Vcu2AiWheelSpeeds,
    Vcu2LogDynamics1, Vcu2LogStatus, WheelSpeed,
};
use crate::{Atom, Inputs, Machine};

/// The layouts of the fictional edition.
enum Fictional {}

layouts! { Fictional:
    Ai2VcuSteer = "AI2VCU_Steer", 2 bytes, every 10 ms, section "2.1" {
        steer_request = "STEER_REQUEST_deg" 0|16 in -200 to 200;
    }

    Ai2VcuBrake = "AI2VCU_Friction", 8 bytes, every 20 ms, section "2.1" {
        hyd_press_r_req = "REAR_pct" 0|8;
        hyd_press_f_req = "FRONT_pct" 16|8;
    }
}

bus! { Fictional, lengths cites ["D-30"]:
    Vcu2LogDynamics1 of V3_0;
    Ai2LogDynamics2 of V3_0;
    Vcu2LogStatus of V3_0;
    Ai2VcuStatus of V3_0;
    Ai2VcuDriveF of V3_0;
    Ai2VcuDriveR of V3_0;
    Ai2VcuSteer of Fictional;
    Ai2VcuBrake of Fictional;
    Vcu2AiStatus of V3_0;
    Vcu2AiDriveF of V3_0;
    Vcu2AiDriveR of V3_0;
    Vcu2AiSteer of V3_0;
    Vcu2AiBrake of V3_0;
    Vcu2AiWheelSpeeds of V3_0;
}

const FICTIONAL: Edition = Edition {
    version: "fictional",
    rules: Rules {
        thresholds: Thresholds { wheel_speed: WheelSpeed::clamped(25), ..Edition::V3_0.rules.thresholds },
        ..Edition::V3_0.rules
    },
    bus: Fictional::bus(Edition::V3_0.bus.reserved),
    ..Edition::V3_0
};

#[test]
fn the_state_machine_follows_its_threshold() {
    let vcu = Machine::new(FICTIONAL, FICTIONAL.readings);
    let mut inputs = Inputs::default();
    inputs.vehicle.wheel_speeds.fl_wheel_speed = WheelSpeed::clamped(20);
    let at_rest = |edition: &Edition| inputs.observe(&edition.rules.thresholds).atoms().has(Atom::AtRest);
    assert!(at_rest(vcu.edition()) && !at_rest(&Edition::V3_0));
    assert!(
        Figure2(&vcu).to_string().contains("all wheel speeds &lt; 25 rpm"),
        "and so does what is printed"
    );
}

#[test]
fn the_bus_is_what_the_list_says() {
    let bus = Fictional::bus(&[]);
    assert_eq!((bus.messages, bus.reserved.len()), (Fictional::MESSAGES, 0));
    assert!(!bus.is_reserved(0x000) && FICTIONAL.bus.is_reserved(0x000));
}

#[test]
fn the_codec_follows_its_layouts() {
    let bus = &FICTIONAL.bus;
    let steer = Ai2VcuSteer { steer_request: SteerAngle::clamped(-100) };
    let frame = bus.encode(steer).expect("513h");
    assert_eq!(frame.to_string(), "513#9CFF");
    assert_eq!(bus.decode(frame.id, frame.data()), Ok(steer.into()));
    assert!(bus.decode(0x513, &[201, 0]).is_err() && Edition::V3_0.bus.decode(0x513, &[201, 0]).is_ok());

    let brake: Ai2VcuBrake = bus.decode_as(&[1, 0, 2]).expect("514h");
    assert_eq!((brake.hyd_press_f_req.raw(), brake.hyd_press_r_req.raw()), (2, 1));
    assert_eq!(bus.named("AI2VCU_Friction").map(|message| message.id), Some(0x514));
    assert!(Dbc(&FICTIONAL).to_string().contains("BO_ 1300 AI2VCU_Friction: 8 AI\n"));
}

#[test]
fn what_it_does_not_change_is_as_it_was() {
    let counts = Vcu2AiWheelCounts::default();
    assert_eq!((FICTIONAL.bus.encode(counts), FICTIONAL.bus.holds(counts)), (None, false));
    assert_eq!(FICTIONAL.bus.messages.len() + 1, Edition::V3_0.bus.messages.len());
    for (one, other) in FICTIONAL.bus.messages.iter().zip(Edition::V3_0.bus.messages) {
        assert_eq!(one == other, !matches!(one.id, 0x513 | 0x514), "{}", one.name);
    }
    assert_eq!(<V3_0 as Layout<Ai2VcuSteer>>::DEF.len, 8);
    assert_eq!(FICTIONAL.rules.table, Edition::V3_0.rules.table);
    assert_ne!(FICTIONAL, Edition::V3_0);
}
