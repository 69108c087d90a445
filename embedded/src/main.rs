//! A VCU without an operating system: it drives missions with everything that can go wrong, and measures itself.
//!
//! ```text
//! inputs by chance --> codec (510h to 514h) --> step --> codec (all frames of the VCU)
//!                        each measured: instructions by the timer, stack by what is overwritten of it
//! ```

#![no_std]
#![no_main]

mod chance;
mod measure;

use adsdv_spec::messages::{AmiState, EbsState};
use adsdv_spec::{AsState, Control, Edition, Inputs, Machine};
use cortex_m_rt::entry;
use cortex_m_semihosting::{debug, hprintln};

use chance::Chance;
use measure::{Longest, Stack};

/// Steps of each edition.
const STEPS: u32 = 20_000;
/// What a step and the codec may take of the stack, in bytes.
const MOST_STACK: usize = 1024;

#[entry]
fn main() -> ! {
    measure::start();
    hprintln!(
        "in RAM: {} bytes of Control, {} of Inputs; in flash or RAM: {} of Machine",
        size_of::<Control>(),
        size_of::<Inputs>(),
        size_of::<Machine>()
    );
    for edition in Edition::ALL {
        drive(edition);
    }
    debug::exit(debug::EXIT_SUCCESS);
    loop {}
}

#[panic_handler]
fn panic(info: &core::panic::PanicInfo<'_>) -> ! {
    hprintln!("{}", info);
    debug::exit(debug::EXIT_FAILURE);
    loop {}
}

/// What a mission begins with: all is on, but for "Go".
fn ready() -> Inputs {
    Inputs { asms: true, tsms: true, ami: AmiState::TrackDrive, ebs: EbsState::Armed, ..Inputs::default() }
}

fn drive(edition: &'static Edition) {
    let vcu = Machine::new(*edition, edition.readings);
    let (mut control, mut inputs) = (Control::INITIAL, ready());
    let mut chance = Chance::new();
    let mut seen = [0_u32; AsState::ALL.len()];
    let (mut react, mut receive, mut send) = (Longest::default(), Longest::default(), Longest::default());
    let mut deepest = 0;
    for _ in 0..STEPS {
        chance.change(&mut inputs, control.state);
        let frames: [_; 5] = core::array::from_fn(|at| inputs.ai.frames(&edition.bus).nth(at));
        let stack = Stack::paint();
        receive.time(|| {
            for frame in frames.iter().flatten() {
                let _ = inputs.ai.receive(&edition.bus, frame.id, frame.data());
            }
        });
        let dt_ms = chance.time();
        let (next, outputs) = react.time(|| vcu.step(&control, &inputs, dt_ms));
        let sent =
            send.time(|| outputs.messages(&inputs).frames(&edition.bus).fold(0, |sum, frame| sum ^ frame.id));
        core::hint::black_box(sent);
        deepest = deepest.max(stack.used());
        control = next;
        seen[control.state as usize % seen.len()] += 1;
        chance.answer(&mut inputs, outputs.handshake);
        if chance.one_of(2000) {
            (control, inputs) = (Control::INITIAL, ready());
        }
    }
    assert!(deepest < MOST_STACK, "a task for it would be larger than its users expect");
    assert!(seen.iter().all(|&times| times > 0), "each state was driven");
    hprintln!("edition {}: {} steps", edition.version, STEPS);
    hprintln!(
        "  step                         at most {:5} instructions, {:5} in the mean",
        react.most,
        react.mean()
    );
    hprintln!(
        "  510h to 514h decoded         at most {:5} instructions, {:5} in the mean",
        receive.most,
        receive.mean()
    );
    hprintln!(
        "  all frames of the VCU coded  at most {:5} instructions, {:5} in the mean",
        send.most,
        send.mean()
    );
    hprintln!("  stack                        at most {:5} bytes", deepest);
}
