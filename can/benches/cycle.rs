//! How well the VCU holds its cycle of 10 ms on this machine, beside what a bare loop that sleeps until each cycle can do: what
//! the VCU adds is the difference. Nothing is asserted: a busy machine is no mistake.
//!
//! `cargo bench -p adsdv-can --bench cycle`, on a machine that does nothing else.

use std::thread;
use std::time::{Duration, Instant};

use adsdv_can::ai::Ai;
use adsdv_can::clock::Clock;
use adsdv_can::demo::LocalBus;
use adsdv_can::live::Vcu;
use adsdv_can::scenario::{Player, Scenario};
use adsdv_can::status::Cycles;
use adsdv_spec::{Edition, Machine};

/// For so long each of them runs.
const TIME: Duration = Duration::from_secs(10);

fn print(name: &str, cycles: &Cycles) {
    let Cycles { count, late, left_out, p50_ms, p99_ms, worst_ms } = cycles;
    println!(
        "{name:<12} {count} cycles, {late} late, {left_out} left out; \
         lateness p50 {p50_ms:.3}, p99 {p99_ms:.3}, worst {worst_ms:.3} ms"
    );
}

/// Sleeps until each cycle, and does nothing else.
fn bare() -> Cycles {
    let mut clock = Clock::new(Instant::now(), Edition::DEFAULT.rules.timing.cycle_ms.into());
    let end = Instant::now() + TIME;
    while clock.deadline() < end {
        thread::sleep(clock.deadline().saturating_duration_since(Instant::now()));
        clock.begin(Instant::now());
    }
    clock.cycles()
}

/// The VCU with its car in a mission, and an AI Computer on a bus within this program.
fn vcu() -> Cycles {
    let player = Player::new(&Scenario::mission());
    let mut vcu = Vcu::new(LocalBus::new(Ai::default()), Machine::REFERENCE, Some(player));
    let end = Instant::now() + TIME;
    while Instant::now() < end {
        vcu.turn();
    }
    vcu.status().cycles
}

fn main() {
    print("bare sleep", &bare());
    print("virtual VCU", &vcu());
}
