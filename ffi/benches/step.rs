//! How fast the library steps: through the C interface, and the specification itself beside it.
//!
//! ```text
//! cargo bench -p adsdv-ffi
//! ```
//!
//! divan shows each state on its own ("item/s" are steps); the last lines are all of them, as ratios.

// The samples are those of the specification's own benchmarks, some of which are not needed here.
#[allow(dead_code)]
#[path = "../../spec/benches/sample/mod.rs"]
mod sample;

use std::ptr::{null, null_mut};
use std::time::{Duration, Instant};

use adsdv::{
    adsdv_control, adsdv_frame, adsdv_inputs, adsdv_machine, adsdv_outputs, adsdv_status, adsdv_step,
    adsdv_step_each, adsdv_step_n,
};
use adsdv_spec::{AsState, Control, Inputs, Machine, Outputs};
use divan::counter::ItemsCount;
use divan::{Bencher, black_box};

use sample::Stay;

const CYCLE_MS: u32 = 10;

/// How many times the inputs of a state are those of a call for many steps.
const TURNS: u8 = 16;

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

/// Many steps in one call.
#[divan::bench(args = AsState::ALL)]
fn c_many(bencher: Bencher, state: AsState) {
    let mut c = InC::new(state, None);
    bencher.counter(ItemsCount::new(c.many.len())).bench_local(|| c.round_at_once(Wanted::LAST));
}

/// And with what each of them shows.
#[divan::bench(args = AsState::ALL)]
fn c_many_shown(bencher: Bencher, state: AsState) {
    let mut c = InC::new(state, None);
    bencher.counter(ItemsCount::new(c.many.len())).bench_local(|| c.round_at_once(Wanted::SHOWN));
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
    /// The same inputs over and over: those of many steps.
    many: Vec<adsdv_inputs>,
    /// What these fill.
    controls: Vec<adsdv_control>,
    outputs: Vec<adsdv_outputs>,
    dt_ms: Vec<u32>,
}

/// What is asked for of many steps, beside what the VCU remembers after the last.
#[derive(Clone, Copy)]
struct Wanted {
    controls: bool,
    outputs: bool,
}

impl Wanted {
    const LAST: Self = Self { controls: false, outputs: false };
    const REMEMBERED: Self = Self { controls: true, outputs: false };
    const SHOWN: Self = Self { controls: false, outputs: true };
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
        let control = adsdv_control::from(&control);
        let inputs: Vec<adsdv_inputs> = inputs.iter().map(adsdv_inputs::from).collect();
        Self {
            machine,
            control,
            many: inputs.repeat(usize::from(TURNS)),
            controls: vec![control; inputs.len() * usize::from(TURNS)],
            outputs: vec![adsdv_outputs::default(); inputs.len() * usize::from(TURNS)],
            dt_ms: vec![CYCLE_MS; inputs.len() * usize::from(TURNS)],
            inputs,
        }
    }

    /// So many times these steps in one call.
    fn round_at_once(&mut self, wanted: Wanted) {
        let step = black_box(adsdv_step_n);
        let controls = if wanted.controls { self.controls.as_mut_ptr() } else { null_mut() };
        let outputs = if wanted.outputs { self.outputs.as_mut_ptr() } else { null_mut() };
        let (inputs, dt_ms, count) = (black_box(&self.many).as_ptr(), self.dt_ms.as_ptr(), self.many.len());
        // SAFETY: the pointers are to what they are said to be, or NULL.
        let status = unsafe {
            let control = &raw mut self.control;
            step(null(), control, inputs, dt_ms, count, controls, outputs, null_mut(), null_mut())
        };
        assert_eq!(status, adsdv_status::ADSDV_OK);
        black_box((&self.controls, &self.outputs));
    }

    /// As many steps, each of a VCU of its own.
    fn round_of_each(&mut self) {
        let step = black_box(adsdv_step_each);
        let (inputs, dt_ms, count) = (black_box(&self.many).as_ptr(), self.dt_ms.as_ptr(), self.many.len());
        let controls = self.controls.as_mut_ptr();
        // SAFETY: the pointers are to what they are said to be, or NULL.
        let status =
            unsafe { step(null(), controls, inputs, dt_ms, count, null_mut(), null_mut(), null_mut()) };
        assert_eq!(status, adsdv_status::ADSDV_OK);
        black_box(&self.controls);
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

/// What the steps of a state are made with: its name, how often it is called, and a call.
type Way = (&'static str, u32, fn(&mut InC));

/// All states together: the fastest of a few runs of each.
fn summary() {
    const ROUNDS: u32 = 40_000;
    const RUNS: u32 = 7;

    let mut rust: Vec<InRust> = AsState::ALL.map(InRust::new).into();
    let mut c: Vec<InC> = AsState::ALL.map(|state| InC::new(state, None)).into();
    let steps =
        f64::from(sample::COUNT) * f64::from(ROUNDS) * f64::from(u32::try_from(rust.len()).expect("few"));
    let calls = ROUNDS / u32::from(TURNS);
    let ways: [Way; 5] = [
        ("adsdv_step", ROUNDS, |c| c.round(null_mut())),
        ("adsdv_step_n", calls, |c| c.round_at_once(Wanted::LAST)),
        ("adsdv_step_n with controls", calls, |c| c.round_at_once(Wanted::REMEMBERED)),
        ("adsdv_step_n with outputs", calls, |c| c.round_at_once(Wanted::SHOWN)),
        ("adsdv_step_each", calls, InC::round_of_each),
    ];
    let (mut in_rust, mut in_c) = (Duration::MAX, [Duration::MAX; 5]);
    for _ in 0..RUNS {
        in_rust = in_rust.min(timed(|| (0..ROUNDS).for_each(|_| rust.iter_mut().for_each(InRust::round))));
        for ((_, rounds, way), least) in ways.iter().zip(&mut in_c) {
            *least = (*least).min(timed(|| (0..*rounds).for_each(|_| c.iter_mut().for_each(way))));
        }
    }
    let ns = |time: Duration| time.as_secs_f64() / steps * 1e9;
    println!("\na step of the specification in Rust: {:.1} ns", ns(in_rust));
    for ((name, ..), time) in ways.iter().zip(in_c) {
        println!("{name}: {:.1} ns, {:.2} times", ns(time), time.as_secs_f64() / in_rust.as_secs_f64());
    }
}

fn timed(work: impl FnOnce()) -> Duration {
    let start = Instant::now();
    work();
    start.elapsed()
}
