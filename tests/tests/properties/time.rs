//! Looking more often than needed changes nothing: a wait is a wait, in one step or in many.
//!
//! Of all the looks of a run, any may be left out at which no arrow is taken, no edge of the handshake answered or begun,
//! nothing about to change, and no edge of "Go" seen that comes too early. At every other look the VCU remembers and shows the
//! same.
//!
//! An edge of "Go" comes too early where any edge counts that the conditions meet (`go-edge=edge`), and the 5 seconds of
//! AS_READY are not over: who looks at it then has seen it, and who looks next when they are over sees it only then, and
//! drives. Where "Go" has to be seen off while the conditions hold, there is no such edge.
//!
//! The theorems `two_steps_in_off_are_one` to `two_steps_in_emergency_brake_are_one` and `two_steps_are_one_where_an_edge_is_enough`
//! of `adsdv-proofs` prove the same of one look that is left out, under the default readings and under `go-edge=edge`. This tries
//! whole runs, under any readings of any edition.

use std::convert::Infallible;

use adsdv_spec::messages::{AmiState, EbsState, MissionStatus, SignalValue as _};
use adsdv_spec::{Atom, Atoms, Choice, Control, Edition, Inputs, Machine, Outputs, Readings};
use proptest::sample;

use crate::holds::{holds, regressions};
use crate::operations::{Operation, Run, runs};
use crate::run::{Event, Seen, Silent, play};
use crate::runs::machine;
use crate::timeline::timeline;

/// How many runs are tried.
const CASES: u32 = 50;

/// So old is an edge of the handshake when the AI Computer answers it; the looks before that can be left out.
const RESPONSE_MS: u16 = 30;

/// One look of the VCU.
#[derive(Clone, Copy, Debug)]
struct Look {
    t_ms: u64,
    dt_ms: u32,
    inputs: Inputs,
    power_cycled: bool,
    after: Control,
    outputs: Outputs,
    /// An arrow was taken, the handshake went on, or "Go" came too early.
    happened: bool,
}

/// An edge of "Go" that is seen before the 5 seconds are over, and counts at this look alone.
fn go_comes_too_early(readings: Readings, outputs: &Outputs) -> bool {
    readings.is(Choice::GoEdgeEnough)
        && outputs.atoms.has(Atom::GoEdge)
        && !outputs.atoms.has(Atom::DwellElapsed)
}

/// A run, look by look, with an AI Computer that takes its time if it answers at all.
fn looks(machine: &Machine, run: &Run) -> Vec<Look> {
    let mut control = Control::INITIAL;
    let mut looks = Vec::new();
    let mut bit = false;
    let Ok(_) = play::<Infallible>(machine, run, &mut |event| {
        let Event::Step(Seen { t_ms, dt_ms, inputs, power_cycled, outputs: prompt }) = event else {
            return Ok(());
        };
        if power_cycled {
            control = Control::INITIAL;
        }
        // In the run itself the answer is prompt, if there is one.
        let answers = inputs.ai.status.handshake == bit;
        bit = prompt.handshake;
        let mut inputs = *inputs;
        let waited_ms = u32::from(control.handshake.unanswered_ms).saturating_add(dt_ms);
        let answer = answers && waited_ms >= RESPONSE_MS.into();
        inputs.ai.status.handshake = control.handshake.bit == answer;
        let before = control;
        let (after, outputs) = machine.step(&before, &inputs, dt_ms);
        control = after;
        let goes_on =
            before.handshake.active == after.handshake.active && before.handshake.bit == after.handshake.bit;
        let happened =
            outputs.taken.is_some() || !goes_on || go_comes_too_early(machine.readings(), &outputs);
        looks.push(Look { t_ms, dt_ms, inputs, power_cycled, after, outputs, happened });
        Ok(())
    });
    looks
}

/// Leaves out all looks that may be but each `kept`th, and compares what is left.
fn same_with_fewer_looks(run: &Run, kept: usize) -> Result<usize, String> {
    let machine = machine(run);
    let looks = looks(&machine, run);
    let mut control = Control::INITIAL;
    let (mut left_out, mut dt_ms, mut power_cycled) = (0, 0_u32, false);
    for (place, look) in looks.iter().enumerate() {
        dt_ms = dt_ms.saturating_add(look.dt_ms);
        power_cycled |= look.power_cycled;
        let goes_on =
            looks.get(place + 1).is_some_and(|next| next.inputs == look.inputs && !next.power_cycled);
        if goes_on && !look.happened && place % kept != 0 {
            left_out += 1;
            continue;
        }
        if std::mem::take(&mut power_cycled) {
            control = Control::INITIAL;
        }
        let (after, outputs) = machine.step(&control, &look.inputs, std::mem::take(&mut dt_ms));
        control = after;
        let shown = |outputs: &Outputs| Outputs { atoms: Atoms::NONE, ..*outputs };
        if after != look.after || shown(&outputs) != shown(&look.outputs) {
            return Err(format!(
                "at {} ms, with {left_out} looks left out, {} is {} and {after:?} is {:?}",
                look.t_ms, outputs.state, look.outputs.state, look.after
            ));
        }
    }
    Ok(left_out)
}

#[test]
fn fewer_looks_see_the_same() {
    let values = (runs(), sample::select(vec![2, 3, 7, usize::MAX]));
    let left_out = std::cell::Cell::new(0);
    holds(
        CASES,
        regressions!("time"),
        &values,
        |(run, kept)| {
            left_out.set(left_out.get() + same_with_fewer_looks(run, *kept)?);
            Ok(())
        },
        |(run, kept)| format!("each {kept}th look is kept\n{}", timeline(&machine(run), run, &mut Silent)),
    );
    assert!(left_out.get() > 1000, "{} looks were left out", left_out.get());
}

/// The run that showed what an edge of "Go" changes: with `go-edge=edge` it comes at 4.999 s of AS_READY, a millisecond before
/// a look that may be the next one.
#[test]
fn an_edge_of_go_just_before_the_end_of_the_dwell_is_looked_at() {
    let set = Operation::set;
    let run = Run {
        edition: Edition::DEFAULT,
        readings: Readings::DEFAULT.with(Choice::GoEdgeEnough),
        cycle_ms: 1,
        operations: vec![
            set("tsms", 1),
            set("ami", AmiState::TrackDrive.to_raw()),
            set("ebs", EbsState::Armed.to_raw()),
            set("mission_status", MissionStatus::Selected.to_raw()),
            set("asms", 1),
            Operation::Wait(1),
            Operation::Wait(4998),
            set("go", 1),
            Operation::Wait(20),
        ],
    };
    let looks = looks(&machine(&run), &run);
    let early = looks.iter().filter(|look| go_comes_too_early(run.readings, &look.outputs)).count();
    assert_eq!(early, 1, "the edge is seen once");
    for kept in [2, 3, 7, usize::MAX] {
        let left_out = same_with_fewer_looks(&run, kept).unwrap_or_else(|wrong| panic!("{kept}: {wrong}"));
        assert!(left_out > 2000, "{kept}: {left_out} looks are left out");
    }
}
