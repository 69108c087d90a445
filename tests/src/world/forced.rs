//! A VCU that does what a test forces on it instead of what the table says.

use adsdv_spec::messages::ShutdownCause;
use adsdv_spec::{AsState, Choice, Control, Machine, Table};

use super::World;

impl World {
    /// From now on the VCU stays in its state, whatever comes. It still shows what it sees.
    pub fn hold_state(&mut self) {
        let interface = self.vcu.edition().with_table(Table::new(&[]));
        self.vcu = Machine::new(interface, self.vcu.readings());
    }

    /// The VCU goes to a state, whatever the table says, and stays there.
    pub fn force(&mut self, state: AsState) {
        self.hold_state();
        let mut control = Control { state, in_state_ms: 0, go_seen_low: false, ..self.control };
        (control.was_running, control.was_forward) = (false, false);
        if state == AsState::EmergencyBrake && control.shutdown_cause == ShutdownCause::NoShutdown {
            control.shutdown_cause = ShutdownCause::HvilOpenFault;
            control.power_cycle_needed = self.vcu.readings().is(Choice::PowerCycleLatched);
        }
        self.control = control;
    }
}
