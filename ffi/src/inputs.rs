//! What the VCU sees at a step, as a struct of C.

use adsdv_spec::messages::{
    Ai2VcuBrake, Ai2VcuDriveF, Ai2VcuDriveR, Ai2VcuStatus, Ai2VcuSteer, Vcu2AiWheelCounts, Vcu2AiWheelSpeeds,
};
use adsdv_spec::{AiMessages, AiSilence, Inputs, Reports, ShutdownCircuit, Vehicle};

use crate::border::{Packed, Plain, answer, load, out};
use crate::edition::{self, adsdv_edition};
use crate::error::{adsdv_error, adsdv_status};
use crate::frame::adsdv_frame;
use crate::plain;

/// Everything that the VCU sees at one step. Flags are 0 or 1; numbers are raw, in steps of their signal, as on the bus.
/// adsdv_inputs_init sets it to a vehicle with everything off, at rest, without a fault; not all of that is 0.
// Bytes first, without a gap: see limits.rs.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct adsdv_inputs {
    /// The Autonomous System Master Switch is on.
    pub asms: u8,
    /// The Tractive System Master Switch is on.
    pub tsms: u8,
    /// The mission selected on the Autonomous Mission Indicator: an adsdv_ami_state.
    pub ami: u8,
    /// The state of the Emergency Braking System, as it reports it: an adsdv_ebs_state.
    pub ebs: u8,
    /// The remote "Go" switch is on.
    pub go: u8,

    /// Opens the shutdown circuit (section 3.5): the remote E-stop button is pressed.
    pub remote_estop: u8,
    /// Opens the shutdown circuit: the remote E-stop receiver has lost the transmitter.
    pub res_link_lost: u8,
    /// Opens the shutdown circuit: an E-stop button on the vehicle is pressed.
    pub vehicle_estop: u8,
    /// Opens the shutdown circuit: the inertial crash sensor is activated.
    pub crash_sensor: u8,
    /// Opens the shutdown circuit: the VCU detects a critical system fault that has no flag of its own.
    pub critical_fault: u8,
    /// Opens the shutdown circuit: the BMS detects a critical fault in the traction battery.
    pub bms_fault: u8,
    /// Opens the shutdown circuit: the autonomous driving dongle is not in the Multi-Purpose Port.
    pub mpp_dongle_removed: u8,

    /// Reported: HVIL or the shutdown circuit has an open circuit.
    pub hvil_open: u8,
    /// Reported: HVIL or the shutdown circuit has a short circuit.
    pub hvil_short: u8,
    /// Reported: the Emergency Braking System is faulty.
    pub ebs_fault: u8,
    /// Reported: the off-board charger is faulty.
    pub offboard_charger_fault: u8,
    /// Reported: the battery is being charged; a fault as soon as ASMS or TSMS is on.
    pub charging: u8,
    /// Reported: the traction battery is hot (a warning).
    pub batt_temp_high: u8,
    /// Reported: the traction battery's charge is low (a warning).
    pub batt_soc_low: u8,

    /// AI Computer, 510h: the answer to the VCU's HANDSHAKE bit.
    pub handshake: u8,
    /// AI Computer, 510h: it asks for an emergency stop.
    pub estop_request: u8,
    /// AI Computer, 510h: status of the mission, an adsdv_mission_status.
    pub mission_status: u8,
    /// AI Computer, 510h: requested direction, an adsdv_direction.
    pub direction_request: u8,
    /// AI Computer, 510h: laps; for the data logger.
    pub lap_counter: u8,
    /// AI Computer, 510h: cones detected now; for the data logger.
    pub cones_count_actual: u8,
    /// AI Computer, 510h: actual speed in km/h; for the data logger.
    pub veh_speed_actual: u8,
    /// AI Computer, 510h: demanded speed in km/h; for the data logger.
    pub veh_speed_demand: u8,
    /// AI Computer, 514h: requested front brake pressure, in 0.5 %.
    pub hyd_press_f_req: u8,
    /// AI Computer, 514h: requested rear brake pressure, in 0.5 %.
    pub hyd_press_r_req: u8,

    /// Measured: the hydraulic pressure of the front brakes, in 0.5 %.
    pub hyd_press_f: u8,
    /// Measured: the hydraulic pressure of the rear brakes, in 0.5 %.
    pub hyd_press_r: u8,
    /// Measured: the speed of the vehicle, in km/h.
    pub speed: u8,

    /// AI Computer, 510h: cones detected in all; for the data logger.
    pub cones_count_all: u16,
    /// AI Computer, 511h: requested front axle torque, in 0.1 Nm.
    pub front_axle_trq_request: u16,
    /// AI Computer, 511h: front motor speed limit, in rpm.
    pub front_motor_speed_max: u16,
    /// AI Computer, 512h: requested rear axle torque, in 0.1 Nm.
    pub rear_axle_trq_request: u16,
    /// AI Computer, 512h: rear motor speed limit, in rpm.
    pub rear_motor_speed_max: u16,
    /// AI Computer, 513h: requested steer angle, positive to the left, in 0.1 degrees.
    pub steer_request: i16,
    /// For how long there has been no valid 510h, in milliseconds; version 3.0 does not look at it.
    pub status_silence_ms: u16,
    /// For how long there has been no valid 511h, in milliseconds; version 3.0 does not look at it.
    pub drive_f_silence_ms: u16,
    /// For how long there has been no valid 512h, in milliseconds; version 3.0 does not look at it.
    pub drive_r_silence_ms: u16,
    /// For how long there has been no valid 513h, in milliseconds; version 3.0 does not look at it.
    pub steer_silence_ms: u16,
    /// For how long there has been no valid 514h, in milliseconds; version 3.0 does not look at it.
    pub brake_silence_ms: u16,

    /// Measured: the steer angle, positive to the left, in 0.1 degrees.
    pub steer_angle: i16,
    /// The largest steer angle that is allowed, in 0.1 degrees.
    pub steer_angle_max: u16,
    /// Measured: front left wheel speed, in rpm.
    pub fl_wheel_speed: u16,
    /// Measured: front right wheel speed, in rpm.
    pub fr_wheel_speed: u16,
    /// Measured: rear left wheel speed, in rpm.
    pub rl_wheel_speed: u16,
    /// Measured: rear right wheel speed, in rpm.
    pub rr_wheel_speed: u16,
    /// Measured: front left wheel speed pulse count.
    pub fl_pulse_count: u16,
    /// Measured: front right wheel speed pulse count.
    pub fr_pulse_count: u16,
    /// Measured: rear left wheel speed pulse count.
    pub rl_pulse_count: u16,
    /// Measured: rear right wheel speed pulse count.
    pub rr_pulse_count: u16,
    /// Measured: the drive torque at the front axle, in 0.1 Nm; negative brakes.
    pub front_axle_trq: i16,
    /// Measured: the drive torque at the rear axle, in 0.1 Nm; negative brakes.
    pub rear_axle_trq: i16,
    /// The largest drive torque that is allowed at the front axle, in 0.1 Nm.
    pub front_axle_trq_max: u16,
    /// The largest drive torque that is allowed at the rear axle, in 0.1 Nm.
    pub rear_axle_trq_max: u16,
}

// SAFETY: `repr(C)`, integers only.
unsafe impl Plain for adsdv_inputs {}
// SAFETY: `repr(C)`; 32 numbers of a byte, then 25 of two, and nothing else.
unsafe impl Packed<32, 25> for adsdv_inputs {}

plain::conversions!("inputs" adsdv_inputs[32, 25]: Inputs {
    asms,
    tsms,
    ami,
    ebs,
    go,
    sdc: ShutdownCircuit {
        remote_estop,
        res_link_lost,
        vehicle_estop,
        crash_sensor,
        critical_fault,
        bms_fault,
        mpp_dongle_removed,
    },
    reports: Reports {
        hvil_open,
        hvil_short,
        ebs_fault,
        offboard_charger_fault,
        charging,
        batt_temp_high,
        batt_soc_low,
    },
    ai: AiMessages {
        status: Ai2VcuStatus {
            handshake,
            estop_request,
            mission_status,
            direction_request,
            lap_counter,
            cones_count_actual,
            cones_count_all,
            veh_speed_actual,
            veh_speed_demand,
        },
        drive_f: Ai2VcuDriveF { front_axle_trq_request, front_motor_speed_max },
        drive_r: Ai2VcuDriveR { rear_axle_trq_request, rear_motor_speed_max },
        steer: Ai2VcuSteer { steer_request },
        brake: Ai2VcuBrake { hyd_press_f_req, hyd_press_r_req },
    },
    ai_silence: AiSilence {
        status_silence_ms,
        drive_f_silence_ms,
        drive_r_silence_ms,
        steer_silence_ms,
        brake_silence_ms,
    },
    vehicle: Vehicle {
        steer_angle,
        steer_angle_max,
        wheel_speeds: Vcu2AiWheelSpeeds { fl_wheel_speed, fr_wheel_speed, rl_wheel_speed, rr_wheel_speed },
        wheel_counts: Vcu2AiWheelCounts { fl_pulse_count, fr_pulse_count, rl_pulse_count, rr_pulse_count },
        front_axle_trq,
        rear_axle_trq,
        front_axle_trq_max,
        rear_axle_trq_max,
        hyd_press_f,
        hyd_press_r,
        speed,
    },
});

/// A vehicle with everything off, at rest, without a fault, and no message of the AI Computer yet.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn adsdv_inputs_init(
    inputs: *mut adsdv_inputs,
    error: *mut adsdv_error,
) -> adsdv_status {
    let work = || {
        // SAFETY: the caller promises it for the inputs.
        unsafe { out(inputs, "inputs")? }.set(adsdv_inputs::from(&Inputs::default()));
        Ok(())
    };
    // SAFETY: the caller promises it for the error.
    unsafe { answer(error, work) }
}

/// Takes over what a frame of the AI Computer (510h to 514h) says. `taken`, which may be NULL, is set to 1 if it is one,
/// and to 0 if it is any other frame, which changes nothing. A frame with too few bytes or a value that is not allowed
/// is an error, and changes nothing either, as if it had not come. A frame that is taken over ends the silence of its
/// message; the caller adds the time that passes to each silence before the frames of a step are received. The frame is one of
/// the default edition.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn adsdv_receive(
    inputs: *mut adsdv_inputs,
    frame: *const adsdv_frame,
    taken: *mut u8,
    error: *mut adsdv_error,
) -> adsdv_status {
    // SAFETY: the caller promises the same.
    unsafe { adsdv_receive_in(edition::DEFAULT, inputs, frame, taken, error) }
}

/// Takes over what a frame of the AI Computer says in an edition, likewise.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn adsdv_receive_in(
    edition: adsdv_edition,
    inputs: *mut adsdv_inputs,
    frame: *const adsdv_frame,
    taken: *mut u8,
    error: *mut adsdv_error,
) -> adsdv_status {
    let work = || {
        let number = edition;
        let edition = edition::given(number, "")?;
        // SAFETY: the caller promises it for the inputs and the frame.
        let (before, place, frame) =
            unsafe { (load(inputs, "inputs")?, out(inputs, "inputs")?, load(frame, "frame")?) };
        let mut inputs = before.read(number)?;
        let received = inputs.ai.receive(&edition.bus, frame.id, frame.sent()?)?;
        if received {
            inputs.ai_silence.end(frame.id);
        }
        if !taken.is_null() {
            // SAFETY: the caller promises it for `taken`.
            unsafe { out(taken, "taken")? }.set(u8::from(received));
        }
        place.set(adsdv_inputs::from(&inputs));
        Ok(())
    };
    // SAFETY: the caller promises it for the error.
    unsafe { answer(error, work) }
}
