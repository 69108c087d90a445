//! A runner in a thread: given orders, stopped in order, over by itself.

use std::sync::Arc;
use std::time::{Duration, Instant};

use adsdv_can::ai::Ai;
use adsdv_can::car::Action;
use adsdv_can::demo::LocalBus;
use adsdv_can::live::{Handle, Panicked, Runner, Vcu};
use adsdv_can::scenario::{Player, Scenario};
use adsdv_can::status::{HappeningKind, Status};
use adsdv_spec::Machine;

const PATIENCE: Duration = Duration::from_secs(20);

fn wait_for(handle: &Handle, is: impl Fn(&Status) -> bool) -> Arc<Status> {
    let begun = Instant::now();
    loop {
        let status = handle.status();
        if is(&status) {
            return status;
        }
        assert!(begun.elapsed() < PATIENCE, "{status:#?}");
        std::thread::sleep(Duration::from_millis(5));
    }
}

#[test]
fn the_handle_passes_actions_on_and_stops_at_a_whole_cycle() -> Result<(), Box<dyn std::error::Error>> {
    let handle = Handle::start(Vcu::new(LocalBus::new(Ai::default()), Machine::REFERENCE, None))?;
    wait_for(&handle, |status| status.sent > 50);
    handle.act("tsms on".parse::<Action>()?);
    wait_for(&handle, |status| status.inputs.tsms && status.responses.count() > 3);
    assert!(handle.is_running());
    let status = handle.join()?;
    assert!(
        status.happened.iter().any(|happening| happening.what == HappeningKind::Did("tsms on".to_owned()))
    );
    // Every cycle that began was sent to its end: eight frames each, and 502h with some.
    let slow = status.sent - 8 * status.cycles.count;
    let whole = status.time_ms / 100 + 1;
    assert!(slow >= 1 && slow <= whole, "{} frames in {} cycles", status.sent, status.cycles.count);
    Ok(())
}

#[test]
fn it_ends_where_the_scenario_does() -> Result<(), Box<dyn std::error::Error>> {
    let scenario: Scenario = "0.1 asms on\n+0.1 end\n".parse()?;
    let player = Player::new(&scenario);
    let handle = Handle::start(Vcu::new(LocalBus::new(Ai::default()), Machine::REFERENCE, Some(player)))?;
    let begun = Instant::now();
    while handle.is_running() {
        assert!(begun.elapsed() < PATIENCE);
        std::thread::sleep(Duration::from_millis(5));
    }
    let status = handle.join()?;
    assert!(status.inputs.asms && status.time_ms >= 200, "{} ms", status.time_ms);
    Ok(())
}

/// A runner with a mistake in it.
#[derive(Debug, Default)]
struct Mistaken(Status);

impl Runner for Mistaken {
    fn turn(&mut self) {
        panic!("a mistake, on purpose");
    }

    fn act(&mut self, _action: &Action) {}

    fn status(&self) -> &Status {
        &self.0
    }
}

#[test]
fn a_mistake_is_reported() -> std::io::Result<()> {
    let handle = Handle::start(Mistaken::default())?;
    while handle.is_running() {
        std::thread::sleep(Duration::from_millis(1));
    }
    assert_eq!(handle.join().err(), Some(Panicked));
    Ok(())
}
