//! Figure 2 above a run: the state that it led to, and the arrow that was taken last.

use std::fmt::{self, Write as _};

use adsdv_spec::Machine;
use adsdv_spec::export::{AsSvg, Background, Drawing, DrawnArrow, Mark};
use adsdv_spec::messages::AsState;

use super::sequence::Sequence;

/// Its width, in pixels.
const WIDTH: u32 = 640;
/// Its height, with room below.
pub(super) const HEIGHT: u32 = AsSvg::height(WIDTH) + 16;

/// Writes it with its upper left corner there.
pub(super) fn write(
    svg: &mut String,
    machine: &Machine,
    sequence: &Sequence,
    (x, y): (u32, u32),
) -> fmt::Result {
    let labels = labels(machine);
    let arrows: Vec<DrawnArrow<'_>> = labels
        .iter()
        .map(|(from, to, label)| DrawnArrow { from: *from, to: *to, label, mark: Mark::Usual })
        .collect();
    let (state, taken) = last(sequence);
    let drawing = Drawing { title: "Figure 2, and the state that the run led to", arrows: &arrows };
    let picture = drawing.svg().in_state(state).taken(taken).on(Background::Dark).within(x, y, WIDTH);
    write!(svg, "{picture}")
}

/// The arrows that the readings of a machine have, each with its section and, line by line, its alternatives.
fn labels(machine: &Machine) -> Vec<(AsState, AsState, String)> {
    let rules = &machine.edition().rules;
    let mut labels: Vec<(AsState, AsState, String)> = Vec::new();
    for taken in AsState::ALL.into_iter().flat_map(|state| machine.arrows(state)) {
        let (Some(row), Some(term)) = (taken.row(&rules.table), taken.term(&rules.table)) else { continue };
        let conditions: Vec<String> =
            term.literals().map(|(atom, value)| rules.text(atom, value).to_string()).collect();
        let guard = conditions.join(" and ");
        match labels.last_mut() {
            Some((from, to, label)) if (*from, *to) == (row.from, row.to) => {
                let _ = write!(label, "\nor {guard}");
            }
            _ => labels.push((row.from, row.to, format!("{}\n{guard}", row.section))),
        }
    }
    labels
}

/// The state in the end, and the last arrow to it.
fn last(sequence: &Sequence) -> (AsState, Option<(AsState, AsState)>) {
    let mut state = sequence.first;
    let mut taken = None;
    for next in sequence.events.iter().filter_map(|event| event.enters) {
        taken = Some((state, next));
        state = next;
    }
    (state, taken)
}
