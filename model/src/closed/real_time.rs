//! A run with scaled timers, printed with the real ones.

use adsdv_spec::messages::AsState;
use adsdv_spec::{Control, Inputs, Machine};
use stateright::Path;

use super::{Closed, ClosedAction, ClosedState};

impl Closed {
    /// What the VCU sees in each of its cycles along a run, with the timers of another machine: where a state lasts for its
    /// time, it lasts for that machine's time.
    ///
    /// The cycles that this takes come where no edge of the handshake is unanswered, are answered at once, and are even in
    /// number, so that the handshake is where it was: after them the run goes on as it did.
    pub fn inputs_for(&self, machine: &Machine, run: &Path<ClosedState, ClosedAction>) -> Vec<Inputs> {
        let cycle = u32::from(self.timing.cycle_ms);
        let mut control = Control::INITIAL;
        let mut seen: Vec<Inputs> = Vec::new();
        let mut waits = self.waits(machine, run).into_iter();
        let mut owed = 0;
        for inputs in Self::inputs(run) {
            owed += waits.next().unwrap_or_default();
            if control.handshake.unanswered_ms == 0 {
                let mut last = seen.last().copied().unwrap_or_default();
                for _ in 0..owed {
                    last.ai.status.handshake = control.handshake.bit;
                    control = machine.step(&control, &last, cycle).0;
                    seen.push(last);
                }
                owed = 0;
            }
            control = machine.step(&control, &inputs, cycle).0;
            seen.push(inputs);
        }
        seen
    }

    /// For each cycle of the VCU, for how many cycles more a state has to last from there on that lasts for its time.
    fn waits(&self, machine: &Machine, run: &Path<ClosedState, ClosedAction>) -> Vec<u16> {
        let run = run.clone().into_vec();
        let before: Vec<Control> = run
            .iter()
            .filter(|(_, action)| *action == Some(ClosedAction::VcuCycle))
            .map(|(state, _)| state.control)
            .collect();
        let mut waits = vec![0; before.len()];
        let mut entered = 0;
        for (place, control) in before.iter().enumerate() {
            let limit = self.machine.edition().rules.timing.in_state_limit(control.state);
            match place.checked_sub(1).and_then(|last| before.get(last)) {
                Some(last) if last.state == control.state => {}
                _ => entered = place,
            }
            // From this step on, the timer counts as elapsed.
            let elapsed = control.in_state_ms.saturating_add(self.timing.cycle_ms) >= limit;
            if elapsed && let Some(wait) = waits.get_mut(entered + 1) {
                *wait = self.missing(machine, control.state);
            }
        }
        waits
    }

    /// How many cycles a timer of the machine takes more than this model's, made even.
    fn missing(&self, machine: &Machine, state: AsState) -> u16 {
        let [real, scaled] =
            [machine, &self.machine].map(|machine| machine.edition().rules.timing.in_state_limit(state));
        let cycles = real.saturating_sub(scaled).checked_div(self.timing.cycle_ms).unwrap_or_default();
        cycles.saturating_add(cycles % 2)
    }
}

#[cfg(test)]
mod tests {
    use adsdv_spec::{Edition, Machine, Readings};
    use stateright::Path;

    use super::{AsState, Closed, ClosedAction, Control};
    use crate::closed::{Operator, dwell_cycles};

    /// The dwell is waited for in the cycle after AS_READY is entered, and only if the run lasts as long.
    #[test]
    fn a_run_waits_where_a_timer_elapses() {
        let timing = Edition::DEFAULT.rules.timing;
        let missing = timing.ready_dwell_ms / timing.cycle_ms - dwell_cycles(&timing);
        let model = Closed::scaled(*Edition::DEFAULT, Readings::DEFAULT, Operator::WellBehaved);
        let mission = model.clone().run_for("mission-can-be-finished").expect("it can");
        let states = mission.clone().into_states();
        let begin = states.first().expect("it begins").clone();
        let short =
            states.iter().position(|state| state.control.in_state_ms == 30).expect("it is ready so long");
        let actions: Vec<ClosedAction> = mission.clone().into_actions().into_iter().take(short).collect();
        let left = Path::from_actions(&model, begin, &actions).expect("a run");
        for (run, wait) in [(mission, missing + missing % 2), (left, 0)] {
            let steps = run.clone().into_vec().into_iter();
            let cycles = steps.filter(|(_, action)| *action == Some(ClosedAction::VcuCycle));
            let states: Vec<AsState> = cycles.map(|(state, _)| state.control.state).collect();
            let entered = states.iter().position(|state| *state == AsState::Ready).expect("it is ready");
            let mut waits = vec![0; states.len()];
            waits[entered + 1] = wait;
            assert_eq!(model.waits(&Machine::REFERENCE, &run), waits, "{states:?}");
        }
    }

    #[test]
    fn a_stretched_run_goes_through_the_same_states() {
        for name in ["mission-can-be-finished", "emergency-can-happen"] {
            let model = || Closed::scaled(*Edition::DEFAULT, Readings::DEFAULT, Operator::Any);
            let run = model().run_for(name).expect("it can");
            let machine = Machine::REFERENCE;
            let (mut control, mut states) = (Control::INITIAL, vec![AsState::Off]);
            for inputs in model().inputs_for(&machine, &run) {
                control = machine.step(&control, &inputs, 10).0;
                if states.last() != Some(&control.state) {
                    states.push(control.state);
                }
            }
            let mut expected: Vec<AsState> =
                run.into_states().iter().map(|state| state.control.state).collect();
            expected.dedup();
            assert_eq!(states, expected, "{name}");
        }
    }
}
