//! How many instructions something takes, and how much stack.
//!
//! QEMU runs with `-icount shift=0`: an instruction takes a nanosecond of the board's time, whatever it is. Its timer counts at 25 MHz, in
//! steps of 40 of these.

use cortex_m::peripheral::{Peripherals, SYST, syst::SystClkSource};

/// The timer's steps, in instructions.
const STEP: u32 = 40;
/// Painted below the stack: more than anything here takes.
const BELOW: usize = 4096;
const PAINT: u32 = 0xA5A5_A5A5;

/// Lets the timer run.
pub(crate) fn start() {
    let Some(mut peripherals) = Peripherals::take() else { return };
    peripherals.SYST.set_clock_source(SystClkSource::Core);
    peripherals.SYST.set_reload(0x00FF_FFFF);
    peripherals.SYST.clear_current();
    peripherals.SYST.enable_counter();
}

/// How long something took at most, and all together.
#[derive(Default)]
pub(crate) struct Longest {
    pub(crate) most: u32,
    sum: u64,
    times: u32,
}

impl Longest {
    #[inline(never)]
    pub(crate) fn time<T>(&mut self, of: impl FnOnce() -> T) -> T {
        let begun = SYST::get_current();
        let result = of();
        let took = (begun.wrapping_sub(SYST::get_current()) & 0x00FF_FFFF) * STEP;
        self.most = self.most.max(took);
        self.sum += u64::from(took);
        self.times += 1;
        result
    }

    pub(crate) fn mean(&self) -> u64 {
        self.sum / u64::from(self.times.max(1))
    }
}

/// The stack below this place, painted.
pub(crate) struct Stack {
    top: usize,
}

impl Stack {
    #[inline(never)]
    pub(crate) fn paint() -> Self {
        let top = cortex_m::register::msp::read() as usize - 64;
        for at in (top - BELOW..top).step_by(4) {
            // SAFETY: below the stack of this function, in RAM that is nobody's.
            unsafe { core::ptr::write_volatile(at as *mut u32, PAINT) };
        }
        Self { top }
    }

    /// How many bytes of it were overwritten since.
    #[inline(never)]
    pub(crate) fn used(&self) -> usize {
        let painted = (self.top - BELOW..self.top).step_by(4);
        // SAFETY: as above.
        let untouched =
            painted.take_while(|&at| unsafe { core::ptr::read_volatile(at as *const u32) } == PAINT);
        BELOW - untouched.count() * 4
    }
}
