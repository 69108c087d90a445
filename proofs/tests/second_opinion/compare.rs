//! One step of the machine and one of the transcription, side by side.

use std::fmt;

use adsdv_spec::{Control, Edition, Inputs, Machine};

use adsdv_proofs::words::{self, Arrow, Verdict};

/// How many rows a Figure 2 has: as many in each edition.
pub(crate) const ROWS: usize = Edition::DEFAULT.rules.table.rows().len();

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
    let verdict = Verdict::of(control, &outputs);
    let in_words = words::of_version(machine.edition().version).unwrap_or_else(|| {
        panic!("proofs/src/words.rs, of_version: no words of {}", machine.edition().version)
    });
    let transcription = in_words(before, inputs, dt_ms, machine.readings());
    let section = outputs.row(machine).map(|row| row.section);
    let same_row = section == transcription.arrow.map(Arrow::section);
    if verdict == transcription && same_row && outputs.from == before.state {
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

impl fmt::Display for Disagreement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { before, inputs, dt_ms, machine, transcription } = self;
        writeln!(
            f,
            "the machine (spec/src/editions) and the transcription (proofs/src/words.rs) disagree on a step of {dt_ms} ms: \
             one of them is not what the document says"
        )?;
        writeln!(f, "from {before:#?}")?;
        writeln!(f, "with {inputs:#?}")?;
        writeln!(f, "the machine says: {machine:#?}")?;
        write!(f, "the transcription says: {transcription:#?}")
    }
}
