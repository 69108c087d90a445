//! What reaches the motors, and what a power cycle is needed for.

use adsdv_spec::messages::ShutdownCause;
use adsdv_spec::{Actuation, AsState, Choice, Readings};

use crate::run::{Property, Seen};

/// Drive and steering requests reach the actuators only while the light says that the vehicle drives, with "Go" and ASMS on
/// and the shutdown circuit closed; and, where an emergency asks for a power cycle, from the emergency on not before it.
/// SHUTDOWN_CAUSE names the first emergency until then.
//= DRV-2, DRV-3, FIN-5, FIN-6, DTE-1 to DTE-3, ETO-3, D-11, D-15, D-21
pub(crate) struct Power {
    latched: bool,
    cause: ShutdownCause,
}

impl Power {
    pub(crate) fn new(readings: Readings) -> Self {
        Self { latched: readings.is(Choice::PowerCycleLatched), cause: ShutdownCause::NoShutdown }
    }
}

fn drives(actuation: &Actuation) -> bool {
    let nothing = Actuation {
        hyd_press_f: actuation.hyd_press_f,
        hyd_press_r: actuation.hyd_press_r,
        ebs_triggered: actuation.ebs_triggered,
        ..Actuation::default()
    };
    *actuation != nothing
}

impl Property for Power {
    fn see(&mut self, seen: &Seen<'_>) -> Result<(), String> {
        let Seen { inputs, outputs, .. } = seen;
        if seen.power_cycled {
            self.cause = ShutdownCause::NoShutdown;
        }
        if drives(&outputs.actuation(inputs)) {
            let shown = outputs.messages(inputs);
            let allowed = [
                ("State_ASSI is AS_DRIVING", shown.log_status.state_assi == AsState::Driving),
                ("GO_SIGNAL is on", shown.status.go_signal),
                ("AS_SWITCH_STATUS is on", shown.status.as_switch_status),
                ("the remote E-stop button is released", !inputs.sdc.remote_estop),
                ("the crash sensor is silent", !inputs.sdc.crash_sensor),
                ("no emergency came before", !self.latched || self.cause == ShutdownCause::NoShutdown),
            ];
            if let Some((what, _)) = allowed.iter().find(|(_, holds)| !holds) {
                return Err(format!("the motors obey, but it is not so that {what}"));
            }
        }
        let emergency = outputs.state == AsState::EmergencyBrake;
        let (before, cause) =
            (std::mem::replace(&mut self.cause, outputs.shutdown_cause), outputs.shutdown_cause);
        let none = ShutdownCause::NoShutdown;
        if before == none && (cause != none) != emergency {
            return Err(format!("SHUTDOWN_CAUSE is {} in {}", cause.name(), outputs.state));
        }
        if before != none && cause != before {
            return Err(format!("SHUTDOWN_CAUSE was {} and is {}", before.name(), cause.name()));
        }
        Ok(())
    }
}
