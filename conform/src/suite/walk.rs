//! A walk to where a test begins: as few steps as it takes.

use adsdv_spec::messages::{AmiState, AsState, DirectionRequest, EbsState, MissionStatus};
use adsdv_spec::{Atom, Control, Inputs, Machine};

use super::{Scenario, Step};

/// A machine that is walked, with the inputs as they stand. The AI Computer answers the handshake, unless the walk silences it.
#[derive(Clone, Debug)]
pub(super) struct Walk<'a> {
    machine: &'a Machine,
    control: Control,
    inputs: Inputs,
    steps: Vec<Step>,
    answers: bool,
}

impl<'a> Walk<'a> {
    /// At power-on, with everything off.
    pub(super) fn new(machine: &'a Machine) -> Self {
        let (control, inputs) = (Control::INITIAL, Inputs::default());
        Self { machine, control, inputs, steps: Vec::new(), answers: true }
    }

    /// The shortest way to a state, from which no arrow is taken as long as nothing changes.
    ///
    /// AS_READY has only been entered; AS_DRIVING and AS_FINISHED have come by way of it.
    pub(super) fn to(machine: &'a Machine, state: AsState) -> Self {
        let walk = Self::new(machine);
        match state {
            AsState::Off => walk,
            AsState::Ready => walk.into_ready(),
            AsState::Driving => Self::armed(machine)
                .step(walk_cycle(machine), |inputs| {
                    inputs.go = true;
                    inputs.ai.status.mission_status = MissionStatus::Running;
                })
                .set(|inputs| inputs.ai.status.direction_request = DirectionRequest::Forward),
            AsState::Finished => Self::to(machine, AsState::Driving)
                .step(walk_cycle(machine), |inputs| inputs.ai.status.mission_status = MissionStatus::Finished)
                .set(|inputs| inputs.ai.status.direction_request = DirectionRequest::Neutral),
            AsState::EmergencyBrake => Self::to(machine, AsState::Ready)
                .step(walk_cycle(machine), |inputs| inputs.sdc.vehicle_estop = true)
                .set(|inputs| inputs.sdc.vehicle_estop = false),
        }
    }

    /// AS_READY for as long as it has to last, with "Go" seen off: an edge of "Go" is accepted at the next step.
    pub(super) fn armed(machine: &'a Machine) -> Self {
        let dwell = machine.edition().rules.timing.ready_dwell_ms;
        Self::to(machine, AsState::Ready).step(dwell.into(), |_| {})
    }

    /// AS_OFF after an emergency.
    pub(super) fn after_an_emergency(machine: &'a Machine) -> Self {
        let timer = machine.edition().rules.timing.ebs_timer_ms;
        Self::to(machine, AsState::EmergencyBrake).step(timer.into(), |inputs| inputs.asms = false)
    }

    /// With inputs changed from the next step on.
    pub(super) fn set(mut self, change: impl FnOnce(&mut Inputs)) -> Self {
        change(&mut self.inputs);
        self
    }

    /// With an input showing an atom, or not.
    pub(super) fn show(mut self, atom: Atom, value: bool) -> Self {
        self.inputs.show(atom, value, &self.machine.edition().rules.thresholds);
        self
    }

    /// With an AI Computer that does not answer the handshake any more, or does again.
    pub(super) const fn answering(mut self, answers: bool) -> Self {
        self.answers = answers;
        self
    }

    /// With one more step, before which the inputs change.
    pub(super) fn step(mut self, dt_ms: u32, change: impl FnOnce(&mut Inputs)) -> Self {
        change(&mut self.inputs);
        self.inputs.ai.status.handshake = self.control.handshake.bit == self.answers;
        let inputs = self.inputs;
        self.control = self.machine.step(&self.control, &inputs, dt_ms).0;
        self.steps.push(Step { dt_ms, inputs });
        self
    }

    /// With the step into AS_READY.
    pub(super) fn into_ready(self) -> Self {
        let cycle = walk_cycle(self.machine);
        self.step(cycle, ready)
    }

    /// With one more cycle, in which nothing else changes.
    pub(super) fn cycle(self) -> Self {
        let cycle = walk_cycle(self.machine);
        self.step(cycle, |_| {})
    }

    /// The state to which the steps so far lead.
    pub(super) const fn state(&self) -> AsState {
        self.control.state
    }

    /// The inputs as they stand.
    pub(super) const fn inputs(&self) -> Inputs {
        self.inputs
    }

    /// The steps so far.
    pub(super) fn scenario(self) -> Scenario {
        Scenario { steps: self.steps }
    }
}

/// The cycle of the reference VCU.
pub(super) fn walk_cycle(machine: &Machine) -> u32 {
    machine.edition().rules.timing.cycle_ms.into()
}

/// What AS_READY asks for.
fn ready(inputs: &mut Inputs) {
    inputs.asms = true;
    inputs.tsms = true;
    inputs.ami = AmiState::TrackDrive;
    inputs.ebs = EbsState::Armed;
    inputs.ai.status.mission_status = MissionStatus::Selected;
}
