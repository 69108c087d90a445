//! How fast the library steps: through the C interface, and the specification itself beside it.
//!
//! ```text
//! cargo bench -p adsdv-ffi
//! ```
//!
//! divan shows each state on its own ("item/s" are steps); the last line is all of them, as a ratio.

// The samples are those of the specification's own benchmarks, some of which are not needed here.
#[allow(dead_code)]
#[path = "../../spec/benches/sample/mod.rs"]
mod sample;

use std::ptr::{null, null_mut};
use std::time::{Duration, Instant};

use adsdv::{
    adsdv_control, adsdv_frame, adsdv_inputs, adsdv_machine, adsdv_outputs, adsdv_status, adsdv_step,
};
use adsdv_spec::{AsState, Control, Inputs, Machine, Outputs};
use divan::counter::ItemsCount;
use divan::{Bencher, black_box};

use sample::Stay;

const CYCLE_MS: u32 = 10;

static MACHINE: Machine = Machine::REFERENCE;

fn main() {
    divan::main();
    summary();
}

/// The specification's step, as a VCU in Rust has it.
#[divan::bench(args = AsState::ALL)]
fn rust(bencher: Bencher, state: AsState) {
    let mut rust = InRust::new(state);
    bencher.counter(ItemsCount::new(rust.inputs.len())).bench_local(|| rust.round());
}

/// The same step through the C interface, with what it shows.
#[divan::bench(args = AsState::ALL)]
fn c(bencher: Bencher, state: AsState) {
    let mut c = InC::new(state, None);
    bencher.counter(ItemsCount::new(c.inputs.len())).bench_local(|| c.round(null_mut()));
}

/// And with the nine frames that the VCU sends.
#[divan::bench(args = AsState::ALL)]
fn c_with_frames(bencher: Bencher, state: AsState) {
    let mut c = InC::new(state, None);
    let mut frames = [adsdv_frame::default(); 9];
    bencher.counter(ItemsCount::new(c.inputs.len())).bench_local(|| c.round(frames.as_mut_ptr()));
}

/// Another reading of the document than the reference.
#[divan::bench(args = AsState::ALL)]
fn c_with_a_reading(bencher: Bencher, state: AsState) {
    let mut c = InC::new(state, Some(c"power-cycle=not-latched"));
    bencher.counter(ItemsCount::new(c.inputs.len())).bench_local(|| c.round(null_mut()));
}

struct InRust {
    control: Control,
    inputs: Vec<Inputs>,
}

impl InRust {
    fn new(state: AsState) -> Self {
        let Stay { control, inputs } = Stay::in_state(state);
        Self { control, inputs: inputs.into_items() }
    }

    fn round(&mut self) {
        for inputs in black_box(&self.inputs) {
            black_box(&cycle(&mut self.control, inputs));
        }
    }
}

/// A step as a VCU has it: a function that keeps the control state in memory.
#[inline(never)]
fn cycle(control: &mut Control, inputs: &Inputs) -> Outputs {
    let (next, outputs) = MACHINE.step(control, inputs, CYCLE_MS);
    *control = next;
    outputs
}

struct InC {
    machine: Option<adsdv_machine>,
    control: adsdv_control,
    inputs: Vec<adsdv_inputs>,
}

impl InC {
    fn new(state: AsState, readings: Option<&std::ffi::CStr>) -> Self {
        let InRust { control, inputs } = InRust::new(state);
        let machine = readings.map(|readings| {
            let mut machine = adsdv_machine { edition: 0, readings: 0 };
            // SAFETY: the pointers are to what they are said to be.
            let status =
                unsafe { adsdv::adsdv_machine_init(&raw mut machine, readings.as_ptr(), null_mut()) };
            assert_eq!(status, adsdv_status::ADSDV_OK);
            machine
        });
        Self { machine, control: (&control).into(), inputs: inputs.iter().map(adsdv_inputs::from).collect() }
    }

    fn round(&mut self, frames: *mut adsdv_frame) {
        // Through a pointer that the compiler does not know: as a call from C is.
        let step = black_box(adsdv_step);
        let machine = self.machine.as_ref().map_or(null(), std::ptr::from_ref);
        for inputs in black_box(&self.inputs) {
            let mut outputs = adsdv_outputs::default();
            // SAFETY: the pointers are to what they are said to be.
            let status = unsafe {
                step(machine, &raw mut self.control, inputs, CYCLE_MS, &raw mut outputs, frames, null_mut())
            };
            assert_eq!(status, adsdv_status::ADSDV_OK);
            black_box(&outputs);
        }
    }
}

/// All states together: the fastest of a few runs of each.
fn summary() {
    const ROUNDS: u32 = 40_000;
    const RUNS: u32 = 7;

    let mut rust: Vec<InRust> = AsState::ALL.map(InRust::new).into();
    let mut c: Vec<InC> = AsState::ALL.map(|state| InC::new(state, None)).into();
    let steps = u32::from(sample::COUNT) * u32::try_from(rust.len()).expect("there are few states");
    let (mut in_rust, mut in_c) = (Duration::MAX, Duration::MAX);
    for _ in 0..RUNS {
        in_rust = in_rust.min(timed(|| (0..ROUNDS).for_each(|_| rust.iter_mut().for_each(InRust::round))));
        in_c = in_c.min(timed(|| (0..ROUNDS).for_each(|_| c.iter_mut().for_each(|c| c.round(null_mut())))));
    }
    let million_a_second = |time: Duration| f64::from(steps) * f64::from(ROUNDS) / time.as_secs_f64() / 1e6;
    println!(
        "\nsteps a second: {:.1} million through C, {:.1} million in Rust: {:.2} times the time",
        million_a_second(in_c),
        million_a_second(in_rust),
        in_c.as_secs_f64() / in_rust.as_secs_f64(),
    );
}

fn timed(work: impl FnOnce()) -> Duration {
    let start = Instant::now();
    work();
    start.elapsed()
}
