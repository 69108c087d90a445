//! What could be told from the bus at all: an observer who misses nothing, knows when each step was, and asks of every step whether a VCU
//! of the specification could have sent what was sent, whatever the inputs were that no frame shows.
//!
//! It is exact where the judge reasons with three values and tolerances, takes far longer, and knows nothing of the judge: what it tells
//! and the judge does not is what the judge misses.

use std::collections::HashSet;

use adsdv_oracle::remote::Remote;
use adsdv_spec::messages::{EbsState, Frame, Node, Vcu2AiStatus};
use adsdv_spec::{Control, Edition, Faults, Inputs, Machine};
use adsdv_tests::world::{MS, Recorded, World};

/// The time between two steps, in milliseconds.
pub(crate) const CYCLE_MS: u16 = Edition::DEFAULT.rules.timing.cycle_ms;

/// Whether the recording of a run, with nothing late and nothing lost, shows that its VCU is not the specification's.
pub(crate) fn can_tell(specification: &Machine, world: &World) -> bool {
    let bus = &specification.edition().bus;
    let mut possible = HashSet::from([Control::INITIAL]);
    for (inputs, frames) in steps(world) {
        let sends = |frame: Frame| frames.iter().all(|sent| sent.id != frame.id || *sent == frame);
        let hidden = hidden(specification, inputs, &frames);
        let mut after = HashSet::new();
        for (control, inputs) in
            possible.iter().flat_map(|control| hidden.iter().map(move |inputs| (control, inputs)))
        {
            let (next, outputs) = specification.step(control, inputs, CYCLE_MS.into());
            if !after.contains(&next) && outputs.messages(inputs).frames(bus).all(sends) {
                after.insert(next);
            }
        }
        if after.is_empty() {
            return true;
        }
        possible = after;
    }
    false
}

/// The inputs of each step, and what the VCU sent at it.
pub(crate) fn steps(world: &World) -> impl Iterator<Item = (&Inputs, Vec<Frame>)> {
    let cycle = i64::from(CYCLE_MS) * MS;
    let mut sent = world.log.iter().filter(|recorded| recorded.sender() == Some(Node::Vcu)).peekable();
    world.steps.iter().zip(1..).map(move |((_, inputs), step)| {
        let mut frames = Vec::new();
        while let Some(Recorded { frame, .. }) = sent.next_if(|recorded| recorded.t < step * cycle) {
            frames.push(*frame);
        }
        (inputs, frames)
    })
}

/// All that the inputs may have been at a step of which the bus shows these frames: what the AI Computer sent and what sensors measured
/// is on the bus, and so are the switches of the remote control where it is.
pub(crate) fn hidden(specification: &Machine, seen: &Inputs, frames: &[Frame]) -> Vec<Inputs> {
    let bus = &specification.edition().bus;
    let Inputs { ami, ai, ai_silence, vehicle, .. } = *seen;
    let mut inputs = Inputs { ami, ai, ai_silence, vehicle, ..Inputs::default() };
    let shown = frames.iter().find(|frame| frame.id == Vcu2AiStatus::ID);
    let shown = shown.and_then(|frame| bus.decode_as::<Vcu2AiStatus>(frame.data()).ok()).unwrap_or_default();
    (inputs.reports.batt_temp_high, inputs.reports.batt_soc_low) =
        (shown.warn_batt_temp_high, shown.warn_batt_soc_low);
    let mut all: Vec<Inputs> = EbsState::ALL.map(|ebs| Inputs { ebs, ..inputs }).to_vec();
    either(&mut all, |inputs| inputs.asms = true);
    either(&mut all, |inputs| inputs.tsms = true);
    if Remote::of(bus).is_some() {
        for inputs in &mut all {
            (inputs.go, inputs.sdc.remote_estop) = (seen.go, seen.sdc.remote_estop);
        }
    } else {
        either(&mut all, |inputs| inputs.go = true);
    }
    // A fault whose flag is shown is there, or was; one whose flag is not shown is not.
    for fault in Faults::OPENING.intersection(Faults::shown_by(&shown)).iter() {
        either(&mut all, |inputs| inputs.show_fault(fault, true));
    }
    all
}

/// All of them with a change, and without.
pub(crate) fn either(all: &mut Vec<Inputs>, change: impl Fn(&mut Inputs)) {
    let changed = |inputs: &Inputs| {
        let mut inputs = *inputs;
        change(&mut inputs);
        inputs
    };
    let others: Vec<Inputs> = all.iter().map(changed).collect();
    all.extend(others);
}
