//! Steps as theorems draw them: any control state that keeps the invariant, any inputs, any time.

use adsdv_spec::messages::AsState;
#[cfg(not(kani))]
use adsdv_spec::{AiSilence, Atom, Atoms, Faults, Observation, Reads};
use adsdv_spec::{Control, Edition, Inputs, Machine, Outputs, Readings, Taken};

use crate::document::EDITION;
#[cfg(not(kani))]
use crate::kani;
#[cfg(kani)]
use crate::subject::Subject;
use crate::subject::subject;

/// A step of the subject.
#[derive(Clone, Copy, Debug)]
pub struct Step {
    /// The control state before it.
    pub before: Control,
    /// What the VCU sees.
    pub inputs: Inputs,
    /// The time since the last step, in milliseconds.
    pub dt_ms: u32,
    /// The control state after it.
    pub after: Control,
    /// What the step shows.
    pub outputs: Outputs,
}

impl Step {
    /// The step of the subject from here.
    pub fn of(before: Control, inputs: Inputs, dt_ms: u32) -> Self {
        let (after, outputs) = subject().step(&before, &inputs, dt_ms);
        Self { before, inputs, dt_ms, after, outputs }
    }

    /// The step of version 4.0 from here.
    pub fn of_4_0(before: Control, inputs: Inputs, dt_ms: u32) -> Self {
        Self::of_machine(subject().machine_of_4_0(), before, inputs, dt_ms)
    }

    /// The step of the vehicle of 2026 from here.
    pub fn of_2026(before: Control, inputs: Inputs, dt_ms: u32) -> Self {
        Self::of_machine(subject().machine_of_2026(), before, inputs, dt_ms)
    }

    fn of_machine(machine: &Machine, before: Control, inputs: Inputs, dt_ms: u32) -> Self {
        let (after, outputs) = subject().step_of(machine, &before, &inputs, dt_ms);
        Self { before, inputs, dt_ms, after, outputs }
    }

    /// Whether the step is from the one state to the other.
    pub fn leads(&self, from: AsState, to: AsState) -> bool {
        self.before.state == from && self.after.state == to
    }
}

/// Whether a control state keeps the invariant of the reference.
pub const fn keeps_invariant(control: &Control) -> bool {
    control.is_consistent(&EDITION.rules.timing, Readings::DEFAULT)
}

/// Any control state that keeps the invariant.
pub fn any_control() -> Control {
    kani::any_where(keeps_invariant)
}

/// Any control state of an AS state that keeps the invariant.
pub fn any_control_in(state: AsState) -> Control {
    let keeps = |control: &Control| control.state == state && keeps_invariant(control);
    // Written down, so that the proof knows it as a constant.
    Control { state, ..kani::any_where(keeps) }
}

/// Any step from a control state that keeps the invariant.
pub fn any_step() -> Step {
    Step::of(any_control(), kani::any(), kani::any())
}

/// Any step from an AS state.
pub fn any_step_from(state: AsState) -> Step {
    Step::of(any_control_in(state), kani::any(), kani::any())
}

/// Any step from an AS state, of which many stay there: by chance hardly any input leaves no reason to leave it.
pub fn any_step_that_may_stay(state: AsState) -> Step {
    let (before, inputs): (Control, Inputs) = (any_control_in(state), kani::any());
    #[cfg(not(kani))]
    let inputs = if kani::any() { without_a_reason(inputs) } else { inputs };
    Step::of(before, inputs, kani::any())
}

/// These inputs without what leads out of AS_READY, AS_DRIVING and AS_FINISHED.
#[cfg(not(kani))]
fn without_a_reason(inputs: Inputs) -> Inputs {
    let all = Reads { atoms: Observation::SCOPE, faults: Observation::FAULTS };
    let reasons = Atoms::of(&[Atom::AiEstop, Atom::MissionFinished, Atom::DirectionNeutral]);
    let atoms = subject().observe(&inputs).atoms().difference(reasons).with(Atom::Asms).with(Atom::GoOn);
    inputs.showing(Observation::new(atoms, Faults::NONE), &all, &EDITION.rules.thresholds)
}

/// Any outputs, also those that no step has.
pub fn any_outputs() -> Outputs {
    let taken = Taken { row: kani::any(), term: kani::any() };
    Outputs {
        from: kani::any(),
        state: kani::any(),
        taken: if kani::any() { Some(taken) } else { None },
        atoms: kani::any(),
        faults: kani::any(),
        shutdown_cause: kani::any(),
        handshake: kani::any(),
        go_signal: kani::any(),
        handshake_lost: kani::any(),
        missed_ms: if kani::any() { Some(kani::any()) } else { None },
    }
}

/// Any end of a step, also one that no step has: for what depends only on where a step has led and on the inputs.
pub fn any_end() -> Step {
    let outputs = any_outputs();
    Step {
        before: Control { state: outputs.from, ..Control::INITIAL },
        inputs: kani::any(),
        dt_ms: kani::any(),
        after: Control { state: outputs.state, ..Control::INITIAL },
        outputs,
    }
}

/// Whether a control state keeps the invariant of version 4.0.
pub const fn keeps_invariant_of_4_0(control: &Control) -> bool {
    control.is_consistent(&Edition::V4_0.rules.timing, Edition::V4_0.readings)
}

/// Any step of version 4.0 from a control state that keeps the invariant.
pub fn any_step_of_4_0() -> Step {
    let before = kani::any_where(keeps_invariant_of_4_0);
    let (inputs, dt_ms) = (kani::any(), kani::any());
    #[cfg(not(kani))]
    let (before, inputs, dt_ms) = in_time(&Edition::V4_0, before, inputs, dt_ms);
    Step::of_4_0(before, inputs, dt_ms)
}

/// Whether a control state keeps the invariant of the vehicle of 2026.
pub const fn keeps_invariant_of_2026(control: &Control) -> bool {
    control.is_consistent(&Edition::V2026.rules.timing, Edition::V2026.readings)
}

/// Any step of the vehicle of 2026 from a control state that keeps the invariant.
pub fn any_step_of_2026() -> Step {
    let before = kani::any_where(keeps_invariant_of_2026);
    let (inputs, dt_ms) = (kani::any(), kani::any());
    #[cfg(not(kani))]
    let (before, inputs, dt_ms) = in_time(&Edition::V2026, before, inputs, dt_ms);
    Step::of_2026(before, inputs, dt_ms)
}

/// Any step of version 4.0 from an AS state.
pub fn any_step_of_4_0_from(state: AsState) -> Step {
    let keeps = |control: &Control| control.state == state && keeps_invariant_of_4_0(control);
    let before = kani::any_where(keeps);
    let (inputs, dt_ms) = (kani::any(), kani::any());
    #[cfg(not(kani))]
    let (before, inputs, dt_ms) = in_time(&Edition::V4_0, before, inputs, dt_ms);
    // Written down, so that the proof knows it as a constant.
    Step::of_4_0(Control { state, ..before }, inputs, dt_ms)
}

/// What was drawn, half of it with silences that are hardly ever too long, and times about those of the edition. A
/// silence drawn at random nearly always is too long; a proof looks at everything anyhow.
#[cfg(not(kani))]
pub fn in_time(
    edition: &Edition,
    mut before: Control,
    mut inputs: Inputs,
    mut dt_ms: u32,
) -> (Control, Inputs, u32) {
    let rules = &edition.rules;
    let about = |limit: u16| limit - 1 + kani::any_where(|more: &u16| *more < 3);
    if let (Some(missed), true) = (rules.thresholds.missed_ms, kani::any()) {
        let short = || kani::any::<u16>() % missed;
        inputs.ai_silence = AiSilence {
            status_silence_ms: short(),
            drive_f_silence_ms: short(),
            drive_r_silence_ms: short(),
            steer_silence_ms: short(),
            brake_silence_ms: short(),
        };
        let silence = &mut inputs.ai_silence;
        match kani::any::<u16>() % 16 {
            0 => silence.status_silence_ms = about(missed),
            1 => silence.drive_f_silence_ms = about(missed),
            2 => silence.drive_r_silence_ms = about(missed),
            3 => silence.steer_silence_ms = about(missed),
            4 => silence.brake_silence_ms = about(missed),
            _ => {}
        }
    }
    if before.handshake.active && kani::any() {
        let limit = rules.timing.handshake_ms;
        before.handshake.unanswered_ms = about(limit).min(limit) - kani::any::<u16>() % (limit / 2);
        dt_ms = about(limit).saturating_sub(before.handshake.unanswered_ms).into();
    }
    (before, inputs, dt_ms)
}
