//! The virtual VCU, the AI Computer and the live judge on a bus on which everything goes wrong.

mod ai;
mod bench;
mod edition;
mod faults;
mod handle;
mod load;
mod watch;
mod whole_mission;

use std::time::Duration;

use adsdv_can::live::Vcu;
use adsdv_can::scenario::{Player, Scenario};
use adsdv_can::status::{HappeningKind, Status};
use adsdv_spec::Machine;

use bench::Bench;

const fn ms(ms: u64) -> Duration {
    Duration::from_millis(ms)
}

/// A VCU on a bench, with what the operator does, if anything.
fn vcu(bench: &Bench, scenario: &str) -> Vcu<Bench> {
    let scenario = (!scenario.is_empty()).then(|| scenario.parse().expect("a scenario"));
    play(bench, scenario.as_ref())
}

/// A VCU on a bench whose operator drives a whole mission.
fn mission(bench: &Bench) -> Vcu<Bench> {
    play(bench, Some(&Scenario::mission()))
}

fn play(bench: &Bench, scenario: Option<&Scenario>) -> Vcu<Bench> {
    Vcu::new(bench.clone(), Machine::REFERENCE, scenario.map(Player::new))
}

/// Whether there is the same time between each two.
fn are_apart(times: &[Duration], by: Duration) -> bool {
    times.windows(2).all(|pair| pair[0] + by == pair[1])
}

/// Takes turns until so long after the start.
fn run(vcu: &mut Vcu<Bench>, bench: &Bench, until: Duration) {
    while bench.time() < until {
        vcu.turn();
    }
}

/// What happened, with its time, in order.
fn happenings(status: &Status) -> Vec<(u64, &HappeningKind)> {
    status.happened.iter().map(|happening| (happening.time_ms, &happening.what)).collect()
}

/// How often something happened.
fn count(status: &Status, is: impl Fn(&HappeningKind) -> bool) -> usize {
    status.happened.iter().filter(|happening| is(&happening.what)).count()
}
