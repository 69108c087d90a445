//! Leads a program somewhere and does something with it, at once where it does what its model foresees.

use adsdv_conform::ProgramError;

use crate::interface::Seen;
use crate::pilot::Pilot;
use crate::record::Record;
use crate::subject::Subject;
use crate::ways::Ways;

/// Does something with a program from power-on; what comes of it, and what was asked and answered.
///
/// Each step depends on the answer before it. Of a program whose answers have to be waited for they are foreseen by its model, and all
/// steps are sent at once; only where an answer is another is it done again, step by step.
pub(crate) fn lead<T>(
    subject: &mut dyn Subject,
    ways: &Ways<'_>,
    act: impl Fn(&mut Pilot<'_>) -> Result<T, ProgramError>,
) -> Result<(T, Record), ProgramError> {
    if subject.is_waited_for() {
        let mut model = ways.model.clone().running();
        let mut foreseen = Seen { subject: &mut model, interface: ways.interface };
        let mut pilot = Pilot::new(&mut foreseen, ways)?;
        let done = act(&mut pilot)?;
        let asked = pilot.asked();
        if subject.steps(&asked.steps)? == asked.replies {
            return Ok((done, pilot.record()));
        }
    }
    let mut pilot = Pilot::new(subject, ways)?;
    let done = act(&mut pilot)?;
    Ok((done, pilot.record()))
}
