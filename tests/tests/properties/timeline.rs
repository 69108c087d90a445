//! A run as people read it: a scenario, with all that it cannot say as comments.

use std::fmt::Write as _;

use adsdv_spec::Machine;

use crate::operations::{Actor, Operation, Run};
use crate::run::{Event, Property, Seen, play};

/// What a machine does in a run, up to the first step at which a property does not hold.
///
/// What the operator does are lines of a scenario. What the AI Computer does and the vehicle measures are comments, as are
/// the changes of state: each with the state before and after, and the section of the arrow.
pub(crate) fn timeline(machine: &Machine, run: &Run, property: &mut impl Property) -> String {
    let Run { edition, readings, cycle_ms, .. } = run;
    let of = edition.version;
    let mut text = format!("# edition {of}, readings [{readings}], a step every {cycle_ms} ms\n");
    let mut event = |event: Event<'_>| match event {
        Event::Done(t_ms, operation) => {
            done(&mut text, t_ms, operation);
            Ok(())
        }
        Event::Step(seen) => {
            step(&mut text, machine, &seen);
            property.see(&seen).map_err(|wrong| (seen.t_ms, wrong))
        }
    };
    if let Err((t_ms, wrong)) = play(machine, run, &mut event) {
        let _ = writeln!(text, "# {:<8} wrong: {wrong}", seconds(t_ms));
    }
    text
}

fn done(text: &mut String, t_ms: u64, operation: Operation) {
    let time = seconds(t_ms);
    // Writing to a string does not fail.
    let _ = match operation.actor() {
        Some(Actor::Operator) => writeln!(text, "{time:<10} {operation}"),
        Some(Actor::Ai) => writeln!(text, "# {time:<8} AI: {operation}"),
        Some(Actor::Vehicle) => writeln!(text, "# {time:<8} vehicle: {operation}"),
        None => Ok(()),
    };
}

fn step(text: &mut String, machine: &Machine, seen: &Seen<'_>) {
    if let Some(row) = seen.outputs.row(machine) {
        let _ = writeln!(
            text,
            "# {:<8} {} -> {}, {}",
            seconds(seen.t_ms),
            row.from,
            seen.outputs.state,
            row.section
        );
    }
}

/// Milliseconds as seconds, without zeros at the end.
fn seconds(ms: u64) -> String {
    let text = format!("{}.{:03}", ms / 1000, ms % 1000);
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}
