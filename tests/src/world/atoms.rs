//! Making a condition of Figure 2 true or false, by what the operator, the vehicle or the AI Computer does.

use adsdv_spec::{Atom, Inputs, Observation};

use super::World;

impl World {
    /// Makes a condition true or false from now on. Where a threshold decides, the value is the one next to it.
    ///
    /// # Panics
    ///
    /// What only time or the past decides cannot be set: it must be so already.
    pub fn set(&mut self, atom: Atom, value: bool) {
        match atom {
            Atom::AiHandshake => {
                self.ai_answers = false;
                self.show(atom, value);
            }
            Atom::AiCommsLost => self.ai_answers = !value,
            Atom::DwellElapsed | Atom::EbsTimerComplete => {
                let timing = &self.vcu.edition().rules.timing;
                let elapsed = self.control.in_state_ms >= timing.in_state_limit(self.control.state);
                assert_eq!(elapsed, value, "{atom} is decided by how long the state has lasted");
            }
            Atom::PowerCycleNeeded => {
                assert_eq!(self.control.power_cycle_needed, value, "{atom} is decided by the past");
            }
            _ => self.show(atom.input().unwrap_or(atom), value),
        }
    }

    /// Makes the inputs show a condition, with the value next to the threshold even if they showed it already.
    fn show(&mut self, atom: Atom, value: bool) {
        assert!(Observation::SCOPE.has(atom), "{atom} is shown by inputs");
        let thresholds = &self.vcu.edition().rules.thresholds;
        let mut inputs = Inputs { ai: self.ai, ..self.inputs };
        inputs.show(atom, !value, thresholds);
        inputs.show(atom, value, thresholds);
        self.ai = inputs.ai;
        self.inputs = Inputs { ai: self.inputs.ai, ..inputs };
    }
}
