//! A whole step: what the VCU sees, what it does about it, and what of that shows.
#![expect(clippy::inline_always, reason = "measured: see benches/spec.rs")]

use crate::control::Control;
use crate::inputs::Inputs;
use crate::machine::{Machine, Reaction};
use crate::messages::AsState;
use crate::outputs::Outputs;
use crate::readings::Choice;

impl Machine {
    /// One step: what the VCU does when it sees these inputs `dt_ms` milliseconds after its last step.
    ///
    /// It is total: any control state, any inputs and any `dt_ms` have an answer, without a panic.
    ///
    /// ```
    /// use adsdv_spec::{AsState, Control, Inputs, Machine};
    /// use adsdv_spec::messages::{AmiState, EbsState, MissionStatus};
    ///
    /// let mut inputs = Inputs { asms: true, tsms: true, ebs: EbsState::Armed, ..Inputs::default() };
    /// inputs.ami = AmiState::TrackDrive;
    /// inputs.ai.status.mission_status = MissionStatus::Selected;
    ///
    /// let vcu = Machine::REFERENCE;
    /// let (control, outputs) = vcu.step(&Control::INITIAL, &inputs, 10);
    /// assert_eq!(control.state, AsState::Ready);
    /// assert_eq!(outputs.row(&vcu).map(|row| row.section), Some("3.1"));
    /// ```
    #[inline(always)]
    pub const fn step(&self, control: &Control, inputs: &Inputs, dt_ms: u32) -> (Control, Outputs) {
        let reaction = self.react(control, inputs.observe(&self.edition().rules.thresholds), dt_ms);
        (reaction.control, self.outputs(control.state, &reaction, inputs.go))
    }

    /// What a reaction, from this state, shows to the outside; `go` is the "Go" switch as it stands.
    #[inline(always)]
    pub const fn outputs(&self, from: AsState, reaction: &Reaction, go: bool) -> Outputs {
        let driving = matches!(reaction.control.state, AsState::Driving);
        Outputs {
            from,
            state: reaction.control.state,
            taken: reaction.taken,
            atoms: reaction.atoms,
            faults: reaction.faults,
            shutdown_cause: reaction.control.shutdown_cause,
            handshake: reaction.control.handshake.bit,
            handshake_lost: reaction.control.handshake.is_lost(self.edition().rules.timing.handshake_ms),
            missed_ms: if self.watches_messages(reaction.control.handshake.active) {
                self.edition().rules.thresholds.missed_ms
            } else {
                None
            },
            //= DRV-14, D-7
            go_signal: go && (driving || self.readings().is(Choice::GoRaw)),
        }
    }
}
