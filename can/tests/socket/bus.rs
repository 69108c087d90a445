//! Frames in and out, and an interface that does not stay as it is.

use std::thread;
use std::time::{Duration, Instant, SystemTime};

use adsdv_can::bus::{Bus as _, Disturbance, Event, Listen, Received};
use adsdv_can::socket;
use adsdv_oracle::candump::FrameKind;
use adsdv_spec::messages::Frame;
use libtest_mimic::Completion;
use nix::libc;
use socketcan::{CanFrame, CanRemoteFrame, EmbeddedFrame as _, ExtendedId, Socket as _};

use super::vcan::{Other, Outcome, Test, Tried, Vcan, ensure, next, tc};

pub(crate) const TESTS: &[Test] = &[
    ("bus::frames_of_every_kind_come_with_their_time", every_kind),
    ("bus::what_comes_right_after_it_was_opened_is_in_order", first_frames),
    ("bus::what_is_sent_reaches_others_and_not_the_sender", sends),
    ("bus::an_interface_that_goes_down_and_up_is_reported", down_and_up),
    ("bus::an_interface_that_is_removed_and_made_again_is_reported", gone_and_back),
    ("bus::what_came_before_it_went_down_comes_before_that_is_reported", down_with_frames),
    ("bus::what_came_before_it_was_removed_comes_before_that_is_reported", gone_with_frames),
    ("bus::sending_to_one_that_went_down_loses_nothing_that_came", down_while_sending),
    ("bus::bus_off_and_restart_are_reported", bus_off),
    ("bus::a_burst_of_ten_times_a_full_bus_is_not_lost", burst),
    ("bus::what_is_dropped_is_counted", dropped),
    ("bus::a_full_queue_is_reported", full),
];

const FRAME: [u8; 8] = [1, 2, 3, 4, 5, 6, 7, 8];

fn frame(id: u16, data: &[u8]) -> Tried<Frame> {
    Frame::new(id, data).ok_or_else(|| "no such frame".into())
}

fn next_frame(bus: &mut impl Listen) -> Tried<Received> {
    match next(bus)? {
        Event::Frame(frame) => Ok(frame),
        other => Err(format!("expected a frame, and {other:?} came").into()),
    }
}

fn expect(bus: &mut impl Listen, expected: &Event) -> Tried {
    let came = next(bus)?;
    ensure!(came == *expected, "expected {expected:?}, and {came:?} came");
    Ok(())
}

fn every_kind() -> Outcome {
    let vcan = Vcan::new()?;
    let mut bus = socket::listen(&vcan.0)?;
    let other = vcan.other()?;
    let extended = ExtendedId::new(0x18FF_50E5).ok_or("no such identifier")?;
    let remote = CanRemoteFrame::new_remote(extended, 5).ok_or("no such frame")?;
    let before = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH)?.as_nanos();
    other.send_standard(0x520, &FRAME[..3])?;
    other.send(extended, &FRAME)?;
    other.0.write_frame(&CanFrame::Remote(remote))?;
    other.send_error(4, &[0, 0x30])?;
    let expected = [
        (FrameKind::Standard, 0x520, &FRAME[..3]),
        (FrameKind::Extended, 0x18FF_50E5, &FRAME),
        (FrameKind::Remote { extended: true, len: 5 }, 0x18FF_50E5, &[]),
        (FrameKind::Error, 4, &[0, 0x30, 0, 0, 0, 0, 0, 0]),
    ];
    let mut last = i64::try_from(before)?;
    for (kind, id, data) in expected {
        let came = next_frame(&mut bus)?;
        ensure!((came.kind, came.id, came.data()) == (kind, id, data), "{came:?}");
        ensure!(came.time_ns >= last, "{} after {last}", came.time_ns);
        last = came.time_ns;
    }
    let after = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH)?.as_nanos();
    ensure!(i128::from(last) <= i128::try_from(after)?, "a time in the future");
    // And when nothing comes, it waits as long as it was asked to.
    let begun = Instant::now();
    let nothing = bus.receive(begun + Duration::from_millis(30));
    let waited = begun.elapsed();
    ensure!(nothing == Event::Nothing && waited >= Duration::from_millis(30), "{nothing:?} after {waited:?}");
    ensure!(waited < Duration::from_millis(500), "it waited for {waited:?}");
    Ok(Completion::Completed)
}

/// The kernel begins to note when frames come a while after it was asked to. A frame from before has the time at which it is read,
/// which may be after that of the next. The kernel's worker has its turn when this thread sleeps.
fn first_frames() -> Outcome {
    let vcan = Vcan::new()?;
    let other = vcan.other()?;
    before_all_others(50, libc::SCHED_FIFO);
    let outcome = read_late(&vcan, &other);
    before_all_others(0, libc::SCHED_OTHER);
    outcome
}

/// Asks for a place in the order of who has a turn. Where that is refused, the test sees less.
fn before_all_others(sched_priority: libc::c_int, policy: libc::c_int) {
    // SAFETY: the parameters are there for as long as the call.
    let _ = unsafe { libc::sched_setscheduler(0, policy, &libc::sched_param { sched_priority }) };
}

fn read_late(vcan: &Vcan, other: &Other) -> Outcome {
    for _ in 0..20 {
        let mut bus = socket::listen(&vcan.0)?;
        for pause in [0, 2, 0, 5] {
            other.send_standard(0x520, &FRAME)?;
            thread::sleep(Duration::from_millis(pause));
        }
        let mut last = 0;
        for _ in 0..4 {
            let time_ns = next_frame(&mut bus)?.time_ns;
            ensure!(time_ns >= last, "{time_ns} after {last}");
            last = time_ns;
        }
        drop(bus);
        // The kernel stops to note it as late.
        thread::sleep(Duration::from_millis(5));
    }
    Ok(Completion::Completed)
}

fn sends() -> Outcome {
    let vcan = Vcan::new()?;
    let mut bus = socket::open(&vcan.0)?;
    let mut listener = socket::listen(&vcan.0)?;
    bus.send(&frame(0x520, &FRAME[..5])?)?;
    let came = next_frame(&mut listener)?;
    ensure!((came.id, came.data()) == (0x520, &FRAME[..5]), "{came:?}");
    let own = bus.receive(Instant::now() + Duration::from_millis(50));
    ensure!(own == Event::Nothing, "{own:?}");
    ensure!(vcan.sent()? == 1, "{} frames", vcan.sent()?);
    Ok(Completion::Completed)
}

fn down_and_up() -> Outcome {
    let vcan = Vcan::new()?;
    let mut bus = socket::open(&vcan.0)?;
    for _ in 0..3 {
        vcan.set("down")?;
        expect(&mut bus, &Event::Disturbance(Disturbance::Down))?;
        let sent = bus.send(&frame(0x520, &[])?);
        ensure!(sent == Err(Disturbance::Down), "{sent:?}");
        // While it is down nothing comes, and nothing is reported again.
        let nothing = bus.receive(Instant::now() + Duration::from_millis(500));
        ensure!(nothing == Event::Nothing, "{nothing:?}");
        vcan.set("up")?;
        expect(&mut bus, &Event::Up)?;
        bus.send(&frame(0x520, &[])?)?;
        vcan.other()?.send_standard(0x510, &FRAME)?;
        ensure!(next_frame(&mut bus)?.id == 0x510, "another frame");
    }
    Ok(Completion::Completed)
}

fn gone_and_back() -> Outcome {
    let vcan = Vcan::new()?;
    let mut bus = socket::open(&vcan.0)?;
    for _ in 0..2 {
        vcan.delete()?;
        // It goes down before it is gone: whether that is seen is a question of time.
        let mut came = next(&mut bus)?;
        if came == Event::Disturbance(Disturbance::Down) {
            came = next(&mut bus)?;
        }
        ensure!(came == Event::Disturbance(Disturbance::Gone), "{came:?}");
        let sent = bus.send(&frame(0x520, &[])?);
        ensure!(sent == Err(Disturbance::Gone), "{sent:?}");
        let nothing = bus.receive(Instant::now() + Duration::from_millis(300));
        ensure!(nothing == Event::Nothing, "{nothing:?}");
        vcan.add()?;
        vcan.set("up")?;
        // It may be seen between the two.
        let mut came = next(&mut bus)?;
        if came == Event::Disturbance(Disturbance::Down) {
            came = next(&mut bus)?;
        }
        ensure!(came == Event::Up, "{came:?}");
        bus.send(&frame(0x520, &[])?)?;
        vcan.other()?.send_standard(0x510, &FRAME)?;
        ensure!(next_frame(&mut bus)?.id == 0x510, "another frame");
    }
    Ok(Completion::Completed)
}

/// Frames that wait in the socket when the interface goes.
const WAITING: u8 = 100;

fn send_waiting(vcan: &Vcan) -> Tried {
    let other = vcan.other()?;
    (0..WAITING).try_for_each(|number| other.send_standard(0x123, &[number]))
}

fn expect_waiting(bus: &mut impl Listen) -> Tried {
    for number in 0..WAITING {
        let came = next_frame(bus)?;
        ensure!(came.data() == [number], "frame {number}: {came:?}");
    }
    Ok(())
}

fn is_down_until_up(vcan: &Vcan, bus: &mut impl Listen) -> Tried {
    expect(bus, &Event::Disturbance(Disturbance::Down))?;
    let nothing = bus.receive(Instant::now() + Duration::from_millis(500));
    ensure!(nothing == Event::Nothing, "{nothing:?}");
    vcan.set("up")?;
    expect(bus, &Event::Up)
}

fn down_with_frames() -> Outcome {
    let vcan = Vcan::new()?;
    let mut bus = socket::listen(&vcan.0)?;
    send_waiting(&vcan)?;
    vcan.set("down")?;
    expect_waiting(&mut bus)?;
    is_down_until_up(&vcan, &mut bus)?;
    // It is looked at again the next time as well.
    send_waiting(&vcan)?;
    vcan.set("down")?;
    expect_waiting(&mut bus)?;
    is_down_until_up(&vcan, &mut bus)?;
    Ok(Completion::Completed)
}

fn gone_with_frames() -> Outcome {
    let vcan = Vcan::new()?;
    let mut bus = socket::listen(&vcan.0)?;
    send_waiting(&vcan)?;
    vcan.delete()?;
    expect_waiting(&mut bus)?;
    let mut came = next(&mut bus)?;
    if came == Event::Disturbance(Disturbance::Down) {
        came = next(&mut bus)?;
    }
    ensure!(came == Event::Disturbance(Disturbance::Gone), "{came:?}");
    let nothing = bus.receive(Instant::now() + Duration::from_millis(500));
    ensure!(nothing == Event::Nothing, "{nothing:?}");
    Ok(Completion::Completed)
}

/// It is the sender that the kernel tells, and nobody else after it.
fn down_while_sending() -> Outcome {
    let vcan = Vcan::new()?;
    let mut bus = socket::open(&vcan.0)?;
    send_waiting(&vcan)?;
    vcan.set("down")?;
    let sent = bus.send(&frame(0x520, &[])?);
    ensure!(sent == Err(Disturbance::Down), "{sent:?}");
    expect_waiting(&mut bus)?;
    is_down_until_up(&vcan, &mut bus)?;

    send_waiting(&vcan)?;
    vcan.delete()?;
    let sent = bus.send(&frame(0x520, &[])?);
    ensure!(matches!(sent, Err(Disturbance::Gone | Disturbance::Down)), "{sent:?}");
    expect_waiting(&mut bus)?;
    Ok(Completion::Completed)
}

fn bus_off() -> Outcome {
    let vcan = Vcan::new()?;
    let mut bus = socket::open(&vcan.0)?;
    let other = vcan.other()?;
    other.send_error(0x40, &[])?;
    let came = next_frame(&mut bus)?;
    ensure!((came.kind, came.id) == (FrameKind::Error, 0x40), "{came:?}");
    expect(&mut bus, &Event::Disturbance(Disturbance::BusOff))?;
    // Restarted: by the driver, which says so, or as others are heard again.
    other.send_error(0x100, &[])?;
    expect(&mut bus, &Event::Up)?;
    ensure!(next_frame(&mut bus)?.id == 0x100, "another frame");
    other.send_error(0x40, &[])?;
    next_frame(&mut bus)?;
    expect(&mut bus, &Event::Disturbance(Disturbance::BusOff))?;
    other.send_standard(0x510, &[])?;
    expect(&mut bus, &Event::Up)?;
    ensure!(next_frame(&mut bus)?.id == 0x510, "another frame");
    Ok(Completion::Completed)
}

/// A tenth of a second of ten times a full bus, while the reader is busy with something else.
const BURST: u16 = 4000;

fn burst() -> Outcome {
    let vcan = Vcan::new()?;
    let mut bus = socket::listen(&vcan.0)?;
    let other = vcan.other()?;
    for round in 0..5 {
        for number in 0..BURST {
            other.send_standard(0x123, &number.to_be_bytes())?;
        }
        for number in 0..BURST {
            let came = next_frame(&mut bus)?;
            ensure!(came.data() == number.to_be_bytes(), "round {round}, frame {number}: {came:?}");
        }
    }
    ensure!(bus.dropped() == 0, "{} dropped", bus.dropped());
    Ok(Completion::Completed)
}

fn dropped() -> Outcome {
    let vcan = Vcan::new()?;
    let mut bus = socket::listen(&vcan.0)?;
    let other = vcan.other()?;
    // More than any buffer has room for.
    let sent = 120_000_u32;
    for number in 0..sent {
        other.send_standard(0x123, &number.to_be_bytes())?;
    }
    let mut received = 0;
    while let Event::Frame(_) = bus.receive(Instant::now() + Duration::from_millis(50)) {
        received += 1;
    }
    // The kernel tells with the next frame that it takes.
    other.send_standard(0x124, &[])?;
    next_frame(&mut bus)?;
    let dropped = bus.dropped();
    ensure!(
        dropped > 0 && received + dropped == u64::from(sent),
        "{sent} sent, {received} received, {dropped} dropped"
    );
    println!("bus::what_is_dropped_is_counted: {received} of {sent} had room");
    Ok(Completion::Completed)
}

fn full() -> Outcome {
    let vcan = Vcan::new()?;
    let mut bus = socket::open(&vcan.0)?;
    tc(&format!("qdisc add dev {} root netem delay 1s limit 20", vcan.0))?;
    let mut sent = 0;
    let begun = Instant::now();
    let trouble = loop {
        match bus.send(&frame(0x520, &FRAME)?) {
            Ok(()) => sent += 1,
            Err(trouble) => break trouble,
        }
        ensure!(sent < 10_000, "the queue never was full");
    };
    ensure!(trouble == Disturbance::Full, "{trouble}");
    ensure!(begun.elapsed() < Duration::from_millis(900), "it waited for room");
    thread::sleep(Duration::from_millis(1500));
    bus.send(&frame(0x520, &FRAME)?)?;
    Ok(Completion::Completed)
}
