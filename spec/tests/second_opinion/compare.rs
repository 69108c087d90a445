//! One step of the machine and one of the transcription, side by side.

use std::fmt;

use adsdv_spec::messages::Vcu2AiStatus;
use adsdv_spec::{Control, Faults, Inputs, Interface, Machine};

use crate::transcription::{self, Flags, Verdict};

/// How many rows Figure 2 has.
pub(crate) const ROWS: usize = Interface::V3_0.table.rows().len();

/// How often each row of the table was taken.
pub(crate) type Count = [u32; ROWS];

/// A step that the machine and the transcription see differently.
#[derive(Clone, Debug)]
pub(crate) struct Disagreement {
    before: Control,
    inputs: Inputs,
    dt_ms: u32,
    machine: Verdict,
    transcription: Verdict,
}

/// Steps both; the control state after the step if they agree in everything that the transcription says.
pub(crate) fn step(
    machine: &Machine,
    before: &Control,
    inputs: &Inputs,
    dt_ms: u32,
    taken: &mut Count,
) -> Result<Control, Box<Disagreement>> {
    let (control, outputs) = machine.step(before, inputs, dt_ms);
    if let Some(row) = outputs.taken {
        taken[usize::from(row.row)] += 1;
    }
    let verdict = Verdict {
        control,
        state: outputs.state,
        arrow: outputs.row(machine).map(|row| row.clause),
        flags: flags(outputs.faults),
        shutdown_cause: outputs.shutdown_cause,
        handshake: outputs.handshake,
        go_signal: outputs.go_signal,
    };
    let transcription = transcription::step(before, inputs, dt_ms, machine.readings());
    if verdict == transcription && outputs.from == before.state {
        Ok(control)
    } else {
        Err(Box::new(Disagreement {
            before: *before,
            inputs: *inputs,
            dt_ms,
            machine: verdict,
            transcription,
        }))
    }
}

/// The faults as 520h shows them.
fn flags(faults: Faults) -> Flags {
    let mut shown = Vcu2AiStatus::default();
    faults.show(&mut shown);
    Flags {
        ai_estop_request: shown.ai_estop_request,
        hvil_open_fault: shown.hvil_open_fault,
        hvil_short_fault: shown.hvil_short_fault,
        ebs_fault: shown.ebs_fault,
        offboard_charger_fault: shown.offboard_charger_fault,
        ai_comms_lost: shown.ai_comms_lost,
        autonomous_braking_fault: shown.autonomous_braking_fault,
        mission_status_fault: shown.mission_status_fault,
        charge_procedure_fault: shown.charge_procedure_fault,
        bms_fault: shown.bms_fault,
    }
}

impl fmt::Display for Disagreement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { before, inputs, dt_ms, machine, transcription } = self;
        writeln!(f, "the machine and the transcription disagree on a step of {dt_ms} ms")?;
        writeln!(f, "from {before:#?}")?;
        writeln!(f, "with {inputs:#?}")?;
        writeln!(f, "the machine says: {machine:#?}")?;
        write!(f, "the transcription says: {transcription:#?}")
    }
}
