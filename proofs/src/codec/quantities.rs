//! Numbers that have a range.

use adsdv_spec::messages::{
    Acceleration, Ai2LogDynamics2, Ai2VcuBrake, Ai2VcuDriveF, Ai2VcuStatus, Ai2VcuSteer, AxleTorque,
    AxleTorqueRequest, BrakePressure, ConesCountAll, LapCounter, LogBrake, LogDriveTorque, LogSteerAngle,
    MotorSpeedMax, SpeedKmh, SteerAngle, SteerAngleMax, Vcu2AiDriveF, Vcu2AiSteer, Vcu2AiWheelSpeeds,
    Vcu2LogDynamics1, Vcu2LogStatus, WheelSpeed, YawRate,
};

use super::data::Data;
use crate::prelude::*;

/// A number, and the quantities that come of it.
struct Made {
    raw: i32,
    /// The one of this size, if that is not refused.
    exact: Option<i32>,
    /// The nearest.
    clamped: i32,
    /// What the receiver reads where that is sent.
    read: Option<i32>,
}

impl Made {
    /// Whether the range is this one.
    fn is_within(&self, lowest: i32, highest: i32) {
        let Self { raw, exact, clamped, .. } = *self;
        let within = (lowest..=highest).contains(&raw);
        kani::cover!(within, "in range");
        kani::cover!(exact.is_none(), "out of range");
        assert!(
            exact == if within { Some(raw) } else { None },
            "what is out of range is refused, and nothing else"
        );
        assert!(clamped == nearest(raw, lowest, highest), "the nearest value allowed");
    }

    /// Whether a signal of this range carries it.
    fn is_carried(&self, lowest: i32, highest: i32) {
        let carried = nearest(self.clamped, lowest, highest);
        assert!(self.read == Some(carried), "it is what the receiver reads, or what is nearest to it");
    }
}

/// The number in the range that is nearest to this one.
const fn nearest(raw: i32, lowest: i32, highest: i32) -> i32 {
    if raw < lowest {
        lowest
    } else if raw > highest {
        highest
    } else {
        raw
    }
}

/// Any number.
fn any_near(lowest: i32, highest: i32) -> i32 {
    // What is beside the ends of the range is what to look at where not all numbers are.
    #[cfg(not(kani))]
    if kani::any() {
        let ends = [lowest - 1, lowest, highest, highest + 1];
        return ends[usize::from(kani::any_where(|place: &u8| usize::from(*place) < ends.len()))];
    }
    let _ = (lowest, highest);
    kani::any()
}

/// What the receiver reads of a message in which only this is set.
fn read<M: Coded>(set: impl FnOnce(&mut M)) -> Option<M> {
    let mut message = M::default();
    set(&mut message);
    let frame = subject().sent(message.encode());
    M::decode(Data::of(&frame).received(frame.id).given()).ok()
}

/// A quantity has this range, also in a signal that carries it.
macro_rules! range {
    ($quantity:ident, $lowest:literal to $highest:literal, $message:ident.$signal:ident) => {
        range!($quantity, $lowest to $highest, $message.$signal of $lowest to $highest)
    };
    (
        $quantity:ident, $lowest:literal to $highest:literal,
        $message:ident.$signal:ident of $least:literal to $most:literal
    ) => {{
        let raw = any_near($lowest, $highest);
        let clamped = $quantity::clamped(raw);
        let made = Made {
            raw,
            exact: $quantity::from_raw(raw).ok().map($quantity::raw),
            clamped: clamped.raw(),
            read: read::<$message>(|message| message.$signal = clamped).map(|message| message.$signal.raw()),
        };
        made.is_within($lowest, $highest);
        made.is_carried($least, $most);
    }};
}

/// **A quantity stays in its range.** Of any number, one in range makes a quantity of that size, and one out of range is
/// refused. Where the nearest is asked for, it is the number itself or the end of the range that is nearest. And a message
/// carries it as that, or where the signal's own range is narrower, as what is nearest to it.
///
/// Requirements: MSG-2 to MSG-4, MSG-11, MSG-14, MSG-15, MSG-17, MSG-19, MSG-21, MSG-22, MSG-24, MSG-27, MSG-28,
/// MSG-30 to MSG-33, MSG-40, MSG-66, MSG-68, MSG-70, MSG-72, MSG-74, MSG-75, MSG-78, MSG-81, D-31.
#[cfg_attr(kani, kani::proof, kani::unwind(10))]
pub fn a_quantity_stays_in_its_range() {
    range!(SteerAngle, -300 to 300, Ai2VcuSteer.steer_request of -240 to 240);
    range!(SteerAngleMax, 0 to 300, Vcu2AiSteer.steer_angle_max of 0 to 240);
    range!(AxleTorque, -1950 to 1950, Vcu2AiDriveF.front_axle_trq);
    range!(AxleTorqueRequest, 0 to 1950, Ai2VcuDriveF.front_axle_trq_request);
    range!(MotorSpeedMax, 0 to 4000, Ai2VcuDriveF.front_motor_speed_max);
    range!(WheelSpeed, 0 to 1250, Vcu2AiWheelSpeeds.fl_wheel_speed);
    range!(BrakePressure, 0 to 200, Ai2VcuBrake.hyd_press_f_req);
    range!(SpeedKmh, 0 to 255, Ai2VcuStatus.veh_speed_actual);
    range!(LogSteerAngle, -128 to 127, Vcu2LogDynamics1.steer_actual);
    range!(LogBrake, 0 to 100, Vcu2LogDynamics1.brake_actual);
    range!(LogDriveTorque, -100 to 100, Vcu2LogDynamics1.drive_trq_actual);
    range!(Acceleration, -32768 to 32767, Ai2LogDynamics2.accel_lateral);
    range!(YawRate, -32768 to 32767, Ai2LogDynamics2.yaw_rate);
    range!(LapCounter, 0 to 15, Ai2VcuStatus.lap_counter);
    range!(ConesCountAll, 0 to 131_071, Vcu2LogStatus.cones_count_all);
}

theorems![a_quantity_stays_in_its_range];
