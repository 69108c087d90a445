//! A bus at its limit for seconds, and one that is as fast as the machine: every frame has come, or is counted as lost.

use std::thread;
use std::time::{Duration, Instant};

use adsdv_can::ai::Ai;
use adsdv_can::live::{AiComputer, Handle, Vcu};
use adsdv_can::scenario::{Player, Scenario};
use adsdv_can::socket;
use adsdv_spec::messages::AsState;
use adsdv_spec::{Fault, Machine};
use libtest_mimic::Completion;

use super::command::{Program, adsdv, lines, log, text, without};
use super::vcan::{Outcome, Test, Tried, Vcan, ensure, wait_until};

pub(crate) const TESTS: &[Test] = &[
    ("load::a_full_bus_is_recorded_without_a_loss", full_bus),
    ("load::what_comes_as_fast_as_it_can_is_recorded_or_counted_as_lost", flood),
    ("load::the_vcu_drives_a_mission_beside_a_full_bus", mission),
];

/// About as many frames as fit on the bus of the ADS-DV in a second.
const FULL: u32 = 4000;
/// An identifier that the document does not know.
const FOREIGN: u16 = 0x123;

/// Sends frames as fast as a full bus does: those that were late are made up for.
fn send_full_bus(vcan: &Vcan, frames: u32) -> Tried {
    let other = vcan.other()?;
    let begun = Instant::now();
    for number in 0..frames {
        let due = Duration::from_secs(1) * number / FULL;
        // Some at a time: no sleep is as short as a frame.
        if number % 8 == 0 {
            thread::sleep(due.saturating_sub(begun.elapsed()));
        }
        other.send_standard(FOREIGN, &number.to_be_bytes())?;
    }
    Ok(())
}

/// What `adsdv watch --log` says of the frames that a sender sends: how many it saw, how many are in the log, and how many were
/// dropped.
fn watched(send: impl FnOnce(&Vcan) -> Tried) -> Tried<Option<[u64; 4]>> {
    let Some(adsdv) = adsdv() else { return Ok(None) };
    let vcan = Vcan::new()?;
    let file = log("load");
    let watch = Program::start(&adsdv, &["watch", &vcan.0, "--log", text(&file)?])?;
    wait_until("it watches", || file.exists())?;
    thread::sleep(Duration::from_secs(1));
    send(&vcan)?;
    // It is through when nothing is added to the log for a while.
    let mut recorded = (0, Instant::now());
    wait_until("all is recorded", || {
        thread::sleep(Duration::from_millis(100));
        let now = lines(&file);
        if now != recorded.0 {
            recorded = (now, Instant::now());
        }
        recorded.1.elapsed() > Duration::from_secs(2)
    })?;
    // The kernel tells how many were dropped with the next that comes.
    vcan.other()?.send_standard(FOREIGN, &[])?;
    thread::sleep(Duration::from_millis(500));
    watch.signal("INT")?;
    let (code, out, error) = watch.end()?;
    ensure!(code == Some(0), "{code:?} {error}\n{out}");
    let number_before = |what: &str| -> Tried<u64> {
        let before = out.split(what).next().filter(|before| before.len() < out.len());
        let number = before.and_then(|before| before.rsplit(|c: char| !c.is_ascii_digit()).next());
        Ok(number.ok_or_else(|| format!("no number before {what:?}:\n{out}"))?.parse()?)
    };
    let verdict = format!("{}: conforms", vcan.0);
    ensure!(out.contains(&verdict), "{out}");
    let dropped = out.lines().rev().find(|line| line.starts_with("bus: ")).ok_or("nothing of the bus")?;
    let dropped =
        dropped.split("; ").nth(1).and_then(|frames| frames.split(' ').next()).ok_or("none")?.parse()?;
    let numbers = [vcan.sent()?, number_before(" frames in ")?, lines(&file).try_into()?, dropped];
    let _ = std::fs::remove_file(file);
    Ok(Some(numbers))
}

fn full_bus() -> Outcome {
    let Some([sent, seen, recorded, dropped]) = watched(|vcan| send_full_bus(vcan, 3 * FULL))? else {
        return Ok(without());
    };
    println!("load::full_bus: {sent} sent, {seen} seen, {recorded} recorded, {dropped} dropped");
    ensure!(sent == u64::from(3 * FULL) + 1, "{sent} sent");
    ensure!(
        (seen, recorded, dropped) == (sent, sent, 0),
        "{seen} seen, {recorded} recorded, {dropped} dropped"
    );
    Ok(Completion::Completed)
}

fn flood() -> Outcome {
    let flood = |vcan: &Vcan| {
        let other = vcan.other()?;
        (0..60_000_u32).try_for_each(|number| other.send_standard(FOREIGN, &number.to_be_bytes()))
    };
    let Some([sent, seen, recorded, dropped]) = watched(flood)? else { return Ok(without()) };
    println!("load::flood: {sent} sent, {seen} seen, {recorded} recorded, {dropped} dropped");
    ensure!(sent == 60_001 && seen + dropped == sent, "{sent} sent, {seen} seen, {dropped} dropped");
    ensure!(recorded == seen, "{recorded} recorded of {seen}");
    Ok(Completion::Completed)
}

fn mission() -> Outcome {
    let vcan = Vcan::new()?;
    let ai = Handle::start(AiComputer::new(socket::open(&vcan.0)?, Ai::default()))?;
    let player = Player::new(&Scenario::mission());
    let vcu = Vcu::new(socket::open(&vcan.0)?, Machine::REFERENCE, Some(player)).with_patience(60_000);
    let vcu = Handle::start(vcu)?;
    let mut foreign = 0;
    while vcu.is_running() && foreign < 40 * FULL && !is_over(&vcu) {
        send_full_bus(&vcan, FULL)?;
        foreign += FULL;
    }
    let frames = ai.join()?.sent;
    // What is there already is taken before it stops.
    let expected = u64::from(foreign) + frames;
    let running = vcu.is_running();
    if running {
        wait_until("all has come", || vcu.status().received + vcu.status().dropped >= expected)?;
    }
    let status = vcu.join()?;
    let times = &status.responses;
    println!(
        "load::mission: {} of {expected} frames, {} dropped; {} answers, median {:.2} ms, worst {:.2} ms; {:?}",
        status.received,
        status.dropped,
        times.count(),
        times.quantile_ms(0.5).unwrap_or_default(),
        times.max_ms().unwrap_or_default(),
        status.cycles,
    );
    ensure!(status.dropped == 0, "{} dropped", status.dropped);
    ensure!(!running || status.received == expected, "{} of {expected} frames", status.received);
    let lost = status.outputs.is_some_and(|outputs| outputs.faults.has(Fault::AiCommsFault));
    ensure!(!lost, "the handshake was lost: {:#?}", status.happened);
    let driven = status.distance_m > 40.0;
    ensure!(driven, "{:#?}", status.happened);
    Ok(Completion::Completed)
}

/// Whether the mission is lost, so that nothing more is to be seen.
fn is_over(vcu: &Handle) -> bool {
    vcu.status().outputs.is_some_and(|outputs| outputs.state == AsState::EmergencyBrake)
}
