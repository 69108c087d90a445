//! The virtual VCU and the AI Computer on a bus of the kernel's.

use std::env;
use std::thread;
use std::time::{Duration, Instant};

use adsdv_can::ai::Ai;
use adsdv_can::bus::{Event, Listen as _};
use adsdv_can::live::{AiComputer, Handle, Vcu, Watch};
use adsdv_can::scenario::{Player, Scenario};
use adsdv_can::socket;
use adsdv_can::status::{HappeningKind, Status};
use adsdv_oracle::judge::Verdict;
use adsdv_oracle::log::LogOptions;
use adsdv_spec::messages::AsState;
use adsdv_spec::{Fault, Machine};
use libtest_mimic::Completion;

use super::vcan::{Outcome, Test, Tried, Vcan, ensure, undisturbed, wait_until};

pub(crate) const TESTS: &[Test] = &[
    ("run::a_whole_mission_conforms", mission),
    ("run::two_vcus_hear_of_each_other", two_vcus),
    ("run::an_ai_computer_that_vanishes_is_missed_and_heard_again", vanishes),
    ("run::the_cycle_is_held", cycle),
];

fn vcu(vcan: &Vcan, scenario: Option<&Scenario>) -> Tried<Handle> {
    Ok(Handle::start(Vcu::new(socket::open(&vcan.0)?, Machine::REFERENCE, scenario.map(Player::new)))?)
}

fn ai(vcan: &Vcan) -> Tried<Handle> {
    Ok(Handle::start(AiComputer::new(socket::open(&vcan.0)?, Ai::default()))?)
}

fn state(status: &Status) -> Option<AsState> {
    status.outputs.map(|outputs| outputs.state)
}

fn mission() -> Outcome {
    undisturbed("run::mission", watched_mission)
}

fn watched_mission() -> Tried<bool> {
    let vcan = Vcan::new()?;
    let mut listener = socket::listen(&vcan.0)?;
    let ai = ai(&vcan)?;
    let vcu = vcu(&vcan, Some(&Scenario::mission()))?;
    let mut watch = Watch::new(&vcan.0, LogOptions::default());
    let begun = Instant::now();
    while vcu.is_running() {
        ensure!(begun.elapsed() < Duration::from_secs(90), "{:#?}", vcu.status());
        if state(&vcu.status()) == Some(AsState::EmergencyBrake) {
            let status = vcu.join()?;
            let lost = status.outputs.is_some_and(|outputs| outputs.faults.has(Fault::AiCommsFault));
            ensure!(lost, "{:#?}", status.happened);
            return Ok(false);
        }
        if let Event::Frame(frame) = listener.receive(Instant::now() + Duration::from_millis(50)) {
            watch.dropped(listener.dropped());
            watch.frame(&frame);
        }
    }
    let (vcu, ai) = (vcu.join()?, ai.join()?);
    let to = |status: &Status| -> Vec<AsState> {
        let states = status.happened.iter().map(|happening| match happening.what {
            HappeningKind::State { to, .. } => to,
            _ => None,
        });
        states.flatten().collect()
    };
    let way = [AsState::Off, AsState::Ready, AsState::Driving, AsState::Finished, AsState::Off];
    ensure!(to(&vcu) == way, "{:#?}", vcu.happened);
    ensure!(to(&ai) == way, "{:#?}", ai.happened);
    ensure!(vcu.unsent + vcu.refused + vcu.foreign + vcu.dropped == 0, "{vcu:#?}");
    let sent = vcu.sent + ai.sent;
    ensure!(vcan.sent()? == sent, "{} of {sent} frames, with a listener on the bus", vcan.sent()?);
    let report = watch.finish()?;
    ensure!(report.verdict() == Verdict::Conforms, "{:#?}", report.findings);
    ensure!(report.transitions.len() == way.len() - 1, "{:#?}", report.transitions);
    Ok(true)
}

fn two_vcus() -> Outcome {
    let vcan = Vcan::new()?;
    let (one, two) = (vcu(&vcan, None)?, vcu(&vcan, None)?);
    wait_until("both hear the other", || one.status().foreign > 10 && two.status().foreign > 10)?;
    for status in [one.join()?, two.join()?] {
        let reported =
            status.happened.iter().any(|happening| matches!(happening.what, HappeningKind::OtherVcu(_)));
        ensure!(reported, "{:#?}", status.happened);
    }
    Ok(Completion::Completed)
}

fn vanishes() -> Outcome {
    let vcan = Vcan::new()?;
    let vcu = vcu(&vcan, Some(&"0 ebs ARMED, ami TRACK_DRIVE, tsms on, asms on\n".parse()?))?;
    let first = ai(&vcan)?;
    wait_until("it is ready", || state(&vcu.status()) == Some(AsState::Ready))?;
    first.join()?;
    wait_until("the AI Computer is missed", || state(&vcu.status()) == Some(AsState::EmergencyBrake))?;
    wait_until("the status says so", || {
        vcu.status().happened.iter().any(|happening| happening.what == HappeningKind::AiSilent)
    })?;
    let heard = |status: &Status| {
        status.happened.iter().filter(|happening| happening.what == HappeningKind::AiHeard).count()
    };
    let before = heard(&vcu.status());
    // Longer than a pause, so that the status says at once that it is heard.
    thread::sleep(Duration::from_secs(1));
    let second = ai(&vcan)?;
    wait_until("it is heard again", || heard(&vcu.status()) > before)?;
    second.join()?;
    vcu.join()?;
    Ok(Completion::Completed)
}

fn cycle() -> Outcome {
    undisturbed("run::cycle", held_cycle)
}

/// What the cycle is like is measured, and asserted only where the machine is said to be idle.
fn held_cycle() -> Tried<bool> {
    let vcan = Vcan::new()?;
    let (vcu, ai) = (vcu(&vcan, Some(&"0 tsms on\n".parse()?))?, ai(&vcan)?);
    thread::sleep(Duration::from_secs(10));
    let (status, _) = (vcu.join()?, ai.join()?);
    let cycles = status.cycles;
    println!(
        "run::the_cycle_is_held: {} cycles, {} late, {} left out; p99 {:.2} ms, worst {:.2} ms",
        cycles.count, cycles.late, cycles.left_out, cycles.p99_ms, cycles.worst_ms
    );
    let idle = env::var_os("ADSDV_IDLE").is_some_and(|value| value == "1");
    ensure!(!idle || cycles.p99_ms < 2.0, "the 99th percentile is {:.2} ms", cycles.p99_ms);
    // Whatever the machine: every cycle that was due is counted, as one that was or as one that was left out.
    let (counted, due) = (cycles.count + cycles.left_out, status.time_ms / 10 + 1);
    ensure!(counted <= due, "{cycles:?} in {} ms", status.time_ms);
    // The last turn may have lasted until the next was due.
    Ok(counted == due)
}
