//! What a step shows, as a struct of C.

use core::ffi::c_char;

use adsdv_spec::messages::Vcu2AiStatus;
use adsdv_spec::{Actuation, Machine, Outputs};

use crate::border::Plain;
use crate::inputs::adsdv_inputs;
use crate::limits::Checked;
use crate::plain::raw;
use crate::text::short;

/// What a step shows to the outside: the signals of 520h, what reaches the actuators, and which arrow of Figure 2 was
/// taken. Flags are 0 or 1; numbers are raw, in steps of their signal, as on the bus.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct adsdv_outputs {
    /// 520h: the state, an adsdv_as_state.
    pub as_state: u8,
    /// 520h: the HANDSHAKE bit that the AI Computer is to send back.
    pub handshake: u8,
    /// 520h: GO_SIGNAL.
    pub go_signal: u8,
    /// 520h: the steering is active.
    pub steering_status: u8,
    /// 520h: the VCU asks the AI Computer to shut down.
    pub shutdown_request: u8,
    /// 520h: the Autonomous System Master Switch is on.
    pub as_switch_status: u8,
    /// 520h: the Tractive System Master Switch is on.
    pub ts_switch_status: u8,
    /// 520h: the mission that is selected, an adsdv_ami_state.
    pub ami_state: u8,
    /// 520h: the fault that shut the system down, an adsdv_shutdown_cause.
    pub shutdown_cause: u8,
    /// 520h: one of the faults is there.
    pub fault_status: u8,
    /// 520h: one of the warnings is there.
    pub warning_status: u8,
    /// 520h: what the vehicle is operated for, the number of OP_STATE. Sent since 2026.
    pub op_state: u8,
    /// 520h: the state of the tractive system, the number of TS_STATE. Sent since 2026.
    pub ts_state: u8,
    /// 520h: the stage of the EBS, the number of EBS_STATE. Sent since 2026.
    pub ebs_state: u8,
    /// 520h, warning: the traction battery is hot.
    pub warn_batt_temp_high: u8,
    /// 520h, warning: the traction battery's charge is low.
    pub warn_batt_soc_low: u8,
    /// 520h, fault: the AI Computer asks for an emergency stop.
    pub ai_estop_request: u8,
    /// 520h, fault: the shutdown circuit or HVIL is open.
    pub hvil_open_fault: u8,
    /// 520h, fault: the shutdown circuit or HVIL has a short circuit.
    pub hvil_short_fault: u8,
    /// 520h, fault: the Emergency Braking System is faulty.
    pub ebs_fault: u8,
    /// 520h, fault: the off-board charger is faulty.
    pub offboard_charger_fault: u8,
    /// 520h, fault: the AI Computer does not answer the handshake.
    pub ai_comms_lost: u8,
    /// 520h, fault: NEUTRAL was requested while the vehicle was moving.
    pub autonomous_braking_fault: u8,
    /// 520h, fault: FINISHED was declared while the vehicle was moving.
    pub mission_status_fault: u8,
    /// 520h, fault: a master switch is on while the battery is being charged.
    pub charge_procedure_fault: u8,
    /// 520h, fault: the battery management system reports a critical fault.
    pub bms_fault: u8,
    /// 520h, fault: torque and hydraulic braking were requested at once, since version 4.0.
    pub brake_plausibility_fault: u8,

    /// Actuators: the direction of driving, an adsdv_direction.
    pub direction: u8,
    /// Actuators: the drive torque of the front axle, in 0.1 Nm.
    pub front_axle_trq: u16,
    /// Actuators: the speed limit of the front motor, in rpm.
    pub front_motor_speed_max: u16,
    /// Actuators: the drive torque of the rear axle, in 0.1 Nm.
    pub rear_axle_trq: u16,
    /// Actuators: the speed limit of the rear motor, in rpm.
    pub rear_motor_speed_max: u16,
    /// Actuators: the steer angle to go to, in 0.1 degrees; 0 while `steer_active` is.
    pub steer: i16,
    /// Actuators: there is a steer angle to go to.
    pub steer_active: u8,
    /// Actuators: the hydraulic pressure of the front brakes, in 0.5 %.
    pub hyd_press_f: u8,
    /// Actuators: the hydraulic pressure of the rear brakes, in 0.5 %.
    pub hyd_press_r: u8,
    /// Actuators: the Emergency Braking System is triggered.
    pub ebs_triggered: u8,

    /// The state before the step, an adsdv_as_state.
    pub from: u8,
    /// An arrow of Figure 2 was taken; all that follows is 0 if not.
    pub taken: u8,
    /// Which one: the row of the table of Figure 2, from 0.
    pub row: u8,
    /// Which alternative of its guard decided, from 0.
    pub term: u8,
    /// The section of the document that describes the arrow, such as "3.7".
    pub section: [c_char; 8],
    /// The section that the alternative comes from.
    pub term_section: [c_char; 8],
}

// SAFETY: `repr(C)`; integers and arrays of `char`.
unsafe impl Plain for adsdv_outputs {}

/// Copies fields of the same name; the fields of the source are all there are.
macro_rules! show {
    ($to:ident, $from:expr => $type:ident { $($field:ident),* $(,)? $(; or none: $optional:ident)? }) => {
        let $type { $($field,)* $($optional)? } = $from;
        $($to.$field = raw($field);)*
        $($to.$optional = raw($optional.unwrap_or_default());)?
    };
}

impl adsdv_outputs {
    // A call, with the inputs as C has them: a step that shows nothing then makes nothing of what is only shown.
    #[inline(never)]
    pub(crate) fn of(machine: &Machine, inputs: Checked<'_, adsdv_inputs>, outputs: Outputs) -> Self {
        let inputs = &inputs.read();
        let mut shown = Self { from: raw(outputs.from), ..Self::default() };
        show!(shown, outputs.status(inputs) => Vcu2AiStatus {
            as_state, handshake, go_signal, steering_status, shutdown_request, as_switch_status, ts_switch_status,
            ami_state, shutdown_cause, fault_status, warning_status, warn_batt_temp_high, warn_batt_soc_low,
            ai_estop_request, hvil_open_fault, hvil_short_fault, ebs_fault, offboard_charger_fault, ai_comms_lost,
            autonomous_braking_fault, mission_status_fault, charge_procedure_fault, bms_fault,
            brake_plausibility_fault, op_state, ts_state, ebs_state,
        });
        shown.actuate(outputs.actuation(inputs));
        if let Some(taken) = outputs.taken {
            shown.taken = 1;
            (shown.row, shown.term) = (taken.row, taken.term);
            shown.section = outputs.row(machine).map_or([0; 8], |row| short(row.section));
            shown.term_section = outputs.term(machine).map_or([0; 8], |term| short(term.section));
        }
        shown
    }

    #[inline(always)]
    fn actuate(&mut self, actuation: Actuation) {
        let shown = self;
        show!(shown, actuation => Actuation {
            front_axle_trq, front_motor_speed_max, rear_axle_trq, rear_motor_speed_max, direction, hyd_press_f,
            hyd_press_r, ebs_triggered; or none: steer
        });
        shown.steer_active = u8::from(actuation.steer.is_some());
    }
}
