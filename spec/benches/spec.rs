//! How fast the specification runs: a step of the machine, and the codec of every message.
//!
//! ```text
//! cargo bench -p adsdv-spec                      everything
//! cargo bench -p adsdv-spec -- step              what has "step" in its name
//! ```
//!
//! The time shown is that of one call, but for the steps, which come eight at a time: there, the throughput counts
//! ("item/s" are steps, 100 Mitem/s are 10 ns). Each call gets the next of a few inputs, so that the compiler cannot
//! know the answer beforehand.

mod sample;

use adsdv_spec::editions::V3_0;
use adsdv_spec::messages::{
    Ai2LogDynamics2, Ai2VcuBrake, Ai2VcuDriveF, Ai2VcuDriveR, Ai2VcuStatus, Ai2VcuSteer, AnyMessage, Frame,
    Layout, Vcu2AiBrake, Vcu2AiDriveF, Vcu2AiDriveR, Vcu2AiStatus, Vcu2AiSteer, Vcu2AiWheelCounts,
    Vcu2AiWheelSpeeds, Vcu2LogDynamics1, Vcu2LogStatus,
};
use adsdv_spec::{AsState, Bus, Control, Edition, Inputs, Machine, Observation, Outputs};
use divan::counter::ItemsCount;
use divan::{Bencher, black_box};

use sample::{Ring, Stay, before_emergency_brake, frames};

/// The reference cycle.
const CYCLE_MS: u32 = 10;
const BUS: &Bus = &Edition::DEFAULT.bus;

static MACHINE: Machine = Machine::REFERENCE;

fn main() {
    divan::main();
}

/// A step in each state, each from where the one before ended: how long a VCU that only steps would take.
#[divan::bench(args = AsState::ALL)]
fn step(bencher: Bencher, state: AsState) {
    let Stay { mut control, inputs } = Stay::in_state(state);
    let inputs = inputs.into_items();
    bencher.counter(ItemsCount::new(inputs.len())).bench_local(|| {
        for inputs in black_box(&inputs) {
            black_box(&cycle(&mut control, inputs));
        }
    });
}

/// A step, and the nine frames that the VCU sends after it.
#[divan::bench(args = AsState::ALL)]
fn step_and_encode(bencher: Bencher, state: AsState) {
    let Stay { mut control, inputs } = Stay::in_state(state);
    let inputs = inputs.into_items();
    bencher.counter(ItemsCount::new(inputs.len())).bench_local(|| {
        for inputs in black_box(&inputs) {
            let messages = cycle(&mut control, inputs).messages(inputs);
            messages.frames(&MACHINE.edition().bus).for_each(|frame| {
                black_box(frame);
            });
        }
    });
}

/// A step as a VCU has it: a function that keeps the control state in memory. What the compiler makes of it does not
/// depend on the benchmark around it.
#[inline(never)]
fn cycle(control: &mut Control, inputs: &Inputs) -> Outputs {
    let (next, outputs) = MACHINE.step(control, inputs, CYCLE_MS);
    *control = next;
    outputs
}

/// A step without the observing of its inputs: the table alone.
#[divan::bench(args = AsState::ALL)]
fn react(bencher: Bencher, state: AsState) {
    let Stay { mut control, inputs } = Stay::in_state(state);
    let mut seen = inputs.map(|inputs| inputs.observe(&MACHINE.edition().rules.thresholds));
    bencher.bench_local(move || {
        let reaction = MACHINE.react(&control, *black_box(seen.next()), CYCLE_MS);
        control = reaction.control;
        black_box(&reaction);
    });
}

/// The observing alone.
#[divan::bench(args = AsState::ALL)]
fn observe(bencher: Bencher, state: AsState) {
    let inputs = Stay::in_state(state).inputs.into_items();
    bencher.counter(ItemsCount::new(inputs.len())).bench_local(|| {
        for inputs in black_box(&inputs) {
            black_box(observed(inputs));
        }
    });
}

#[inline(never)]
fn observed(inputs: &Inputs) -> Observation {
    inputs.observe(&MACHINE.edition().rules.thresholds)
}

/// What the VCU remembers alone, from what it has observed: as a search steps, which asks for nothing that is shown.
#[divan::bench(args = AsState::ALL)]
fn react_without_showing(bencher: Bencher, state: AsState) {
    let Stay { mut control, inputs } = Stay::in_state(state);
    let seen: Vec<Observation> = inputs.into_items().iter().map(observed).collect();
    bencher.counter(ItemsCount::new(seen.len())).bench_local(|| {
        for seen in black_box(&seen) {
            remembered(&mut control, *seen);
        }
    });
}

#[inline(never)]
fn remembered(control: &mut Control, seen: Observation) {
    *control = MACHINE.react(control, seen, CYCLE_MS).control;
}

/// The longest step: AS_DRIVING ends in EMERGENCY_BRAKE, for the last reason of the row, and the causes are found.
#[divan::bench]
fn step_to_emergency_brake(bencher: Bencher) {
    let (control, mut inputs) = before_emergency_brake();
    assert_eq!(cycle(&mut { control }, inputs.next()).state, AsState::EmergencyBrake);
    bencher.bench_local(move || {
        black_box(&cycle(&mut black_box(control), inputs.next()));
    });
}

#[divan::bench(types = [
    Vcu2LogDynamics1, Ai2LogDynamics2, Vcu2LogStatus, Ai2VcuStatus, Ai2VcuDriveF, Ai2VcuDriveR, Ai2VcuSteer,
    Ai2VcuBrake, Vcu2AiStatus, Vcu2AiDriveF, Vcu2AiDriveR, Vcu2AiSteer, Vcu2AiBrake, Vcu2AiWheelSpeeds,
    Vcu2AiWheelCounts,
])]
fn decode<M>(bencher: Bencher)
where
    V3_0: Layout<M>,
{
    let mut frames = frames(<V3_0 as Layout<M>>::DEF);
    bencher.bench_local(move || {
        black_box(&<V3_0 as Layout<M>>::decode(black_box(frames.next()).data()));
    });
}

#[divan::bench(types = [
    Vcu2LogDynamics1, Ai2LogDynamics2, Vcu2LogStatus, Ai2VcuStatus, Ai2VcuDriveF, Ai2VcuDriveR, Ai2VcuSteer,
    Ai2VcuBrake, Vcu2AiStatus, Vcu2AiDriveF, Vcu2AiDriveR, Vcu2AiSteer, Vcu2AiBrake, Vcu2AiWheelSpeeds,
    Vcu2AiWheelCounts,
])]
fn encode<M: Default>(bencher: Bencher)
where
    V3_0: Layout<M>,
{
    let frames = frames(<V3_0 as Layout<M>>::DEF);
    let mut messages = frames.map(|frame| <V3_0 as Layout<M>>::decode(frame.data()).unwrap_or_default());
    bencher.bench_local(move || {
        black_box(V3_0::encode(black_box(messages.next())));
    });
}

/// Each message by its identifier, which is the same all the time.
#[divan::bench(args = names())]
fn decode_any(bencher: Bencher, name: &str) {
    let mut frames = named(name);
    bencher.bench_local(move || {
        let frame = black_box(frames.next());
        black_box(&BUS.decode(frame.id, frame.data()));
    });
}

/// Each message as one of all messages.
#[divan::bench(args = names())]
fn encode_any(bencher: Bencher, name: &str) {
    let mut messages = any(named(name));
    bencher.bench_local(move || {
        black_box(BUS.encode(*black_box(messages.next())));
    });
}

/// All messages in turn, as on the bus.
#[divan::bench]
fn decode_any_in_turn(bencher: Bencher) {
    let mut frames = bus();
    bencher.bench_local(move || {
        let frame = black_box(frames.next());
        black_box(&BUS.decode(frame.id, frame.data()));
    });
}

/// All messages in turn, as on the bus.
#[divan::bench]
fn encode_any_in_turn(bencher: Bencher) {
    let mut messages = any(bus());
    bencher.bench_local(move || {
        black_box(BUS.encode(*black_box(messages.next())));
    });
}

fn names() -> impl Iterator<Item = &'static str> {
    BUS.messages.iter().map(|def| def.name)
}

fn named(name: &str) -> Ring<Frame> {
    Ring::new(BUS.messages.iter().filter(|def| def.name == name).flat_map(|def| frames(def).into_items()))
}

fn bus() -> Ring<Frame> {
    let each: Vec<_> = BUS.messages.iter().map(|def| frames(def).into_items()).collect();
    Ring::new((0..usize::from(sample::COUNT)).flat_map(|round| each.iter().map(move |frames| frames[round])))
}

fn any(frames: Ring<Frame>) -> Ring<AnyMessage> {
    frames.map(|frame| BUS.decode(frame.id, frame.data()).expect("every frame made here is allowed"))
}
