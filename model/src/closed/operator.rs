//! The operator: the person at the switches and the remote control.

use adsdv_spec::messages::{AmiState, AsState};

use super::{Act, Closed, ClosedAction, ClosedState, DAWDLE_CYCLES, Mission, Operator, Switches, ai};

/// The mission that operators select; to the VCU they are all alike.
const MISSION: AmiState = AmiState::TrackDrive;

impl Closed {
    /// What the operator may do now.
    pub(super) fn acts(&self, state: &ClosedState, actions: &mut Vec<ClosedAction>) {
        match self.operator {
            Operator::Any if !state.acted && self.may_step(state) || self.skips_time => {
                let read =
                    |act: &Act| !self.is_shut_down(state) || matches!(act, Act::Tsms(_) | Act::Asms(_));
                actions.extend(all(state.switches).filter(read).map(ClosedAction::Operator));
                if self.faults {
                    actions.push(ClosedAction::RemoteEstop(!state.remote_estop));
                }
            }
            Operator::WellBehaved if state.rested => self.procedure(state, |act| {
                actions.push(ClosedAction::Operator(act));
            }),
            Operator::Any | Operator::WellBehaved => {}
        }
    }

    /// The next steps of the procedure. The operator sees the ASSI, and has a stopwatch.
    fn procedure(&self, state: &ClosedState, mut act: impl FnMut(Act)) {
        let Switches { asms, tsms, ami, ebs_armed, go } = state.switches;
        match (state.control.state, state.mission) {
            (AsState::Off, Mission::Ahead) => {
                if ami == AmiState::NotSelected {
                    act(Act::Mission(MISSION)); //= RDY-8
                }
                for (on, switch) in
                    [(tsms, Act::Tsms(true)), (asms, Act::Asms(true)), (ebs_armed, Act::EbsArmed(true))]
                {
                    if !on {
                        act(switch);
                    }
                }
            }
            // "Go" has been moved after the four acts before only if it was found on, or is on for good.
            (AsState::Ready, Mission::Ahead) if go && state.acts == ACTS_TO_READY => act(Act::Go(false)), //= DRV-13
            (AsState::Ready, Mission::Ahead) if !go && self.dwell_is_over(state) => act(Act::Go(true)),
            (AsState::Finished, _) if asms => act(Act::Asms(false)), // section 3.4
            _ => {}
        }
    }

    /// Whether AS_READY has lasted for the minimum dwell of the document.
    pub(super) fn dwell_is_over(&self, state: &ClosedState) -> bool {
        state.control.state == AsState::Ready && state.control.in_state_ms >= self.timing.ready_dwell_ms
    }

    /// Whether time may go on: not for long when somebody is to act, and not for ever when nobody does.
    pub(super) fn has_patience(&self, state: &ClosedState) -> bool {
        if self.operator == Operator::Any {
            return true;
        }
        let mut acts = Vec::new();
        self.acts(state, &mut acts);
        let awaited = !acts.is_empty() || ai::may_decide_to_stop(state.ai) || state.motion.must_slow_down();
        state.patience < if awaited { DAWDLE_CYCLES } else { self.longest_wait() }
    }

    /// How many cycles pass at most without anything that [`super::Rank`] counts: the dwell, and an answer that starts
    /// late, takes its time, and needs another one.
    const fn longest_wait(&self) -> u16 {
        let dwell = match self.timing.ready_dwell_ms.checked_div(self.timing.cycle_ms) {
            Some(cycles) => cycles,
            None => 0,
        };
        dwell.saturating_add(4 * (self.response_cycles() + 1))
    }
}

/// Mission, TSMS, ASMS and EBS.
const ACTS_TO_READY: u8 = 4;

fn all(now: Switches) -> impl Iterator<Item = Act> {
    let mission = match now.ami {
        AmiState::NotSelected => MISSION,
        _ => AmiState::NotSelected,
    };
    [
        Act::Mission(mission),
        Act::Tsms(!now.tsms),
        Act::Asms(!now.asms),
        Act::EbsArmed(!now.ebs_armed),
        Act::Go(!now.go),
    ]
    .into_iter()
}
