//! What goes wrong on a bus is reported, once, and the car goes on.

use adsdv_can::ai::Ai;
use adsdv_can::bus::{Disturbance, Event};
use adsdv_can::live::Runner as _;
use adsdv_can::status::HappeningKind;
use adsdv_oracle::candump::FrameKind;
use adsdv_spec::messages::{AsState, Vcu2AiStatus};

use super::bench::encoded;
use super::{Bench, count, happenings, mission, ms, run, vcu};

fn is_trouble(what: &HappeningKind) -> bool {
    matches!(what, HappeningKind::Disturbance(_))
}

#[test]
fn an_interface_that_goes_down_and_comes_back_is_reported_once_each() {
    for trouble in [Disturbance::Down, Disturbance::Gone] {
        let bench = Bench::new();
        let mut vcu = vcu(&bench, "");
        run(&mut vcu, &bench, ms(1000));
        assert_eq!(vcu.status().trouble, None);
        let sent = vcu.status().sent;

        bench.comes(ms(1005), Event::Disturbance(trouble.clone()));
        bench.sending(Err(trouble.clone()));
        run(&mut vcu, &bench, ms(2000));
        assert_eq!(vcu.status().trouble, Some(trouble.clone()));
        assert_eq!((vcu.status().sent, vcu.status().unsent), (sent, 100 * 8 + 10));

        bench.comes(ms(2005), Event::Up);
        bench.sending(Ok(()));
        run(&mut vcu, &bench, ms(3000));
        assert_eq!(vcu.status().trouble, None);
        assert_eq!(vcu.status().sent, sent + 100 * 8 + 10);
        // The car went on all the while.
        assert_eq!((vcu.status().cycles.count, vcu.status().cycles.late), (301, 0));
        let reported: Vec<_> = happenings(vcu.status())
            .into_iter()
            .filter(|(_, what)| is_trouble(what) || **what == HappeningKind::Up)
            .collect();
        assert_eq!(reported, [(1005, &HappeningKind::Disturbance(trouble)), (2005, &HappeningKind::Up)]);
    }
}

#[test]
fn bus_off_and_the_restart_are_reported() {
    let bench = Bench::new();
    let mut vcu = vcu(&bench, "");
    bench.frame_comes(ms(105), FrameKind::Error, 0x40, &[0; 8]);
    bench.comes(ms(105), Event::Disturbance(Disturbance::BusOff));
    bench.frame_comes(ms(505), FrameKind::Error, 0x100, &[0; 8]);
    bench.comes(ms(505), Event::Up);
    run(&mut vcu, &bench, ms(110));
    bench.sending(Err(Disturbance::Full));
    run(&mut vcu, &bench, ms(300));
    // A full queue is what comes of it, and no news.
    assert_eq!(vcu.status().trouble, Some(Disturbance::BusOff));
    bench.sending(Ok(()));
    run(&mut vcu, &bench, ms(400));
    assert_eq!(
        vcu.status().trouble,
        Some(Disturbance::BusOff),
        "that frames are taken does not mean that they are sent"
    );
    run(&mut vcu, &bench, ms(600));
    assert_eq!((vcu.status().trouble.clone(), vcu.status().errors), (None, 2));
    assert_eq!(count(vcu.status(), is_trouble), 1);
    assert_eq!(count(vcu.status(), |what| *what == HappeningKind::Up), 1);
}

#[test]
fn error_frames_are_counted_and_reported_in_words_not_too_often() {
    let bench = Bench::new();
    let mut vcu = vcu(&bench, "");
    for at in 0..2500 {
        bench.frame_comes(ms(at), FrameKind::Error, 0x4, &[0, 0x30, 0, 0, 0, 0, 0, 0]);
    }
    run(&mut vcu, &bench, ms(3000));
    assert_eq!((vcu.status().errors, vcu.status().received), (2500, 2500));
    let reported: Vec<_> = happenings(vcu.status())
        .into_iter()
        .filter_map(|(at, what)| match what {
            HappeningKind::ErrorFrame(text) => Some((at, text.as_str())),
            _ => None,
        })
        .collect();
    assert_eq!(reported.iter().map(|(at, _)| *at).collect::<Vec<_>>(), [0, 1000, 2000]);
    #[cfg(target_os = "linux")]
    assert!(reported[0].1.contains("controller problem"), "{reported:?}");
}

#[test]
fn a_full_queue_costs_frames_and_no_time() {
    let bench = Bench::new();
    let mut vcu = vcu(&bench, "");
    run(&mut vcu, &bench, ms(100));
    bench.sending(Err(Disturbance::Full));
    run(&mut vcu, &bench, ms(200));
    assert_eq!((vcu.status().trouble.clone(), vcu.status().unsent), (Some(Disturbance::Full), 81));
    bench.sending(Ok(()));
    run(&mut vcu, &bench, ms(1200));
    // Frames are taken again: for how long, nobody knows yet.
    assert_eq!((vcu.status().trouble.clone(), vcu.status().unsent), (Some(Disturbance::Full), 81));
    run(&mut vcu, &bench, ms(1300));
    assert_eq!((vcu.status().trouble.clone(), vcu.status().unsent), (None, 81));
    assert_eq!((vcu.status().cycles.count, vcu.status().cycles.late), (131, 0));
    let reported: Vec<_> = happenings(vcu.status()).into_iter().skip(1).collect();
    assert_eq!(reported, [(110, &HappeningKind::Disturbance(Disturbance::Full)), (1210, &HappeningKind::Up)]);
}

/// A bus that nobody answers on has room for a frame now and then.
#[test]
fn a_queue_that_is_full_again_and_again_is_reported_once() {
    let bench = Bench::new();
    let mut vcu = vcu(&bench, "1 asms on\n");
    for cycle in 1..=3000 {
        bench.sending(if cycle % 3 == 0 { Err(Disturbance::Full) } else { Ok(()) });
        run(&mut vcu, &bench, ms(cycle * 10));
    }
    bench.sending(Ok(()));
    run(&mut vcu, &bench, ms(32_000));
    let status = vcu.status();
    assert_eq!(
        count(status, |what| *what == HappeningKind::Disturbance(Disturbance::Full)),
        1,
        "{:#?}",
        status.happened
    );
    assert_eq!(count(status, |what| *what == HappeningKind::Up), 1);
    // What happened at the beginning is still there.
    assert_eq!(count(status, |what| matches!(what, HappeningKind::State { .. })), 1);
    assert_eq!(count(status, |what| matches!(what, HappeningKind::Did(_))), 1);
}

/// A controller that is restarted a tenth of a second after it has gone bus-off, and goes so again.
#[test]
fn a_flapping_bus_is_reported_now_and_then_and_as_it_stands() {
    let bench = Bench::new();
    let mut vcu = vcu(&bench, "");
    for round in 0..100 {
        bench.comes(ms(105 + round * 110), Event::Disturbance(Disturbance::BusOff));
        bench.comes(ms(205 + round * 110), Event::Up);
    }
    bench.comes(ms(11_105), Event::Disturbance(Disturbance::BusOff));
    run(&mut vcu, &bench, ms(13_000));
    let status = vcu.status();
    let reported: Vec<_> = happenings(status).into_iter().skip(1).collect();
    assert_eq!(reported.first(), Some(&(105, &HappeningKind::Disturbance(Disturbance::BusOff))));
    assert!((20..=26).contains(&reported.len()), "{reported:#?}");
    // Whatever was left out on the way, the last that is reported is how it stands.
    assert_eq!(status.trouble, Some(Disturbance::BusOff));
    assert_eq!(
        reported.last().map(|(_, what)| *what),
        Some(&HappeningKind::Disturbance(Disturbance::BusOff))
    );
}

/// It answers each time a little too late.
#[test]
fn an_ai_computer_that_pauses_again_and_again_is_reported_silent_once() {
    let bench = Bench::new();
    let mut vcu = vcu(&bench, "");
    let answer = [0; 8];
    for frame in 0..500 {
        bench.frame_comes(ms(15 + frame * 65), FrameKind::Standard, 0x510, &answer);
    }
    // Then it does as it should.
    for frame in 0..200 {
        bench.frame_comes(ms(32_515 + frame * 10), FrameKind::Standard, 0x510, &answer);
    }
    run(&mut vcu, &bench, ms(34_500));
    let reported: Vec<_> = happenings(vcu.status()).into_iter().skip(1).collect();
    let [(15, HappeningKind::AiHeard), (70, HappeningKind::AiSilent), (heard, HappeningKind::AiHeard)] =
        reported[..]
    else {
        panic!("{reported:#?}")
    };
    assert!((33_400..33_600).contains(&heard), "{heard}");
}

#[test]
fn frames_that_were_dropped_are_reported_and_not_too_often() {
    let bench = Bench::new();
    let mut vcu = vcu(&bench, "");
    run(&mut vcu, &bench, ms(100));
    for dropped in 1..=150 {
        bench.dropped(dropped);
        run(&mut vcu, &bench, ms(100 + dropped * 10));
    }
    run(&mut vcu, &bench, ms(4000));
    let reported: Vec<_> = happenings(vcu.status()).into_iter().skip(1).collect();
    let dropped = |frames| HappeningKind::Dropped { frames, small_buffer: false };
    assert_eq!(reported, [(110, &dropped(1)), (1110, &dropped(100)), (2110, &dropped(49))]);
    assert_eq!(vcu.status().dropped, 150);
}

#[test]
fn a_scenario_that_waits_in_vain_is_given_up_after_a_while() {
    let bench = Bench::new();
    let mut vcu = vcu(&bench, "1 asms on\nAS_READY end\n").with_patience(5000);
    while !vcu.is_over() {
        assert!(bench.time() < ms(10_000), "{:#?}", vcu.status());
        vcu.turn();
    }
    assert_eq!(bench.time(), ms(6000));
    let stuck = vcu.status().stuck.as_ref().map(ToString::to_string).unwrap_or_default();
    let reported = "line 2: expected AS_READY, found AS_OFF after 5 s; AS_READY (section 3.1) still needs: ";
    assert!(stuck.starts_with(reported) && stuck.contains("TS master switch ON"), "{stuck}");

    // Without patience that could end it waits on, as for an operator who is not there yet.
    let bench = Bench::new();
    let mut vcu = super::vcu(&bench, "AS_READY end\n");
    run(&mut vcu, &bench, ms(700_000));
    assert!(!vcu.is_over() && vcu.status().stuck.is_none());
}

#[test]
fn foreign_frames_change_nothing() {
    let quiet = Bench::new();
    let mut alone = vcu(&quiet, "0.5 asms on\n1 tsms on\n");
    run(&mut alone, &quiet, ms(3000));

    let bench = Bench::new();
    let mut vcu = vcu(&bench, "0.5 asms on\n1 tsms on\n");
    for at in 0..3000 {
        // The AI Computer's own identifiers as other frames than it sends, and others' as any.
        bench.frame_comes(ms(at), FrameKind::Extended, 0x510, &[0xFF; 8]);
        bench.frame_comes(ms(at), FrameKind::Remote { extended: false, len: 8 }, 0x510, &[]);
        bench.frame_comes(ms(at), FrameKind::Extended, 0x520, &[0xFF; 8]);
        bench.frame_comes(ms(at), FrameKind::Standard, 0x7FF, &[0xFF; 8]);
        bench.frame_comes(ms(at), FrameKind::Standard, 0x181, &[]);
    }
    run(&mut vcu, &bench, ms(3000));
    assert_eq!(bench.take_sent(), quiet.take_sent());
    let status = vcu.status();
    assert_eq!((status.received, status.foreign, status.refused), (15_000, 0, 0));
    assert_eq!(status.happened, alone.status().happened);
}

#[test]
fn garbage_of_the_ai_computer_is_refused_and_reported() {
    let quiet = Bench::new();
    let mut alone = vcu(&quiet, "");
    run(&mut alone, &quiet, ms(5000));

    let bench = Bench::new();
    let mut vcu = vcu(&bench, "");
    let (mut random, mut refused) = (fastrand::Rng::with_seed(1), 0);
    for at in 0..5000 {
        let bytes = random.u64(..).to_be_bytes();
        let id = 0x510 + (at % 5) as u16;
        let data = &bytes[..random.usize(..=8)];
        refused += u64::from(adsdv_spec::Edition::DEFAULT.bus.decode(id, data).is_err());
        bench.frame_comes(ms(at), FrameKind::Standard, id.into(), data);
    }
    run(&mut vcu, &bench, ms(5000));
    let status = vcu.status();
    assert!(refused > 1000, "{refused}");
    assert_eq!((status.received, status.refused), (5000, refused));
    // One a second for each of five identifiers.
    let reported = count(status, |what| matches!(what, HappeningKind::Refused(_)));
    assert!((5..=25).contains(&reported), "{reported}");
    let text = status.happened.iter().find_map(|happening| match &happening.what {
        HappeningKind::Refused(text) => Some(text.clone()),
        _ => None,
    });
    assert!(text.as_ref().is_some_and(|text| text.starts_with("51") && text.contains("h: ")), "{text:?}");
    assert_eq!(bench.take_sent().len(), quiet.take_sent().len());
    assert_eq!(status.cycles.late, 0);
}

#[test]
fn a_second_vcu_is_reported() {
    let bench = Bench::new();
    let mut vcu = vcu(&bench, "");
    run(&mut vcu, &bench, ms(500));
    let status = encoded(Vcu2AiStatus { as_state: AsState::Driving, ..Vcu2AiStatus::default() });
    for at in (500..2000).step_by(10) {
        bench.frame_comes(ms(at), FrameKind::Standard, status.id.into(), status.data());
    }
    run(&mut vcu, &bench, ms(2500));
    let reported: Vec<_> = happenings(vcu.status()).into_iter().skip(1).collect();
    let text = "somebody else sends 520h, which is the VCU's".to_owned();
    assert_eq!(
        reported,
        [(500, &HappeningKind::OtherVcu(text.clone())), (1500, &HappeningKind::OtherVcu(text))]
    );
    assert_eq!(vcu.status().foreign, 150);
    // It does not take the other's state for its own.
    assert_eq!(vcu.status().outputs.map(|outputs| outputs.state), Some(AsState::Off));
}

#[test]
fn an_ai_computer_that_vanishes_costs_the_mission_and_is_heard_again() {
    let bench = Bench::new();
    bench.plug_in(Ai::default());
    let mut vcu = mission(&bench);
    while vcu.status().outputs.map(|outputs| outputs.state) != Some(AsState::Driving) {
        assert!(bench.time() < ms(60_000), "{:#?}", vcu.status().happened);
        vcu.turn();
    }
    let unplugged = bench.time();
    bench.unplug();
    run(&mut vcu, &bench, unplugged + ms(300));
    let status = vcu.status();
    assert_eq!(status.outputs.map(|outputs| outputs.state), Some(AsState::EmergencyBrake));
    assert_eq!(count(status, |what| *what == HappeningKind::AiSilent), 1);
    assert!(
        status.ai_silent_ms.is_some_and(|silent| (290..=310).contains(&silent)),
        "{:?}",
        status.ai_silent_ms
    );
    let heard = count(status, |what| *what == HappeningKind::AiHeard);

    // It is seen at once, and reported when it has been heard for a second.
    bench.plug_in(Ai::default());
    run(&mut vcu, &bench, unplugged + ms(600));
    assert!(vcu.status().ai_silent_ms.is_some_and(|silent| silent < 20));
    assert_eq!(count(vcu.status(), |what| *what == HappeningKind::AiHeard), heard);
    run(&mut vcu, &bench, unplugged + ms(1400));
    assert_eq!(count(vcu.status(), |what| *what == HappeningKind::AiHeard), heard + 1);
    assert!(vcu.status().ai_silent_ms.is_some_and(|silent| silent < 20));
}

#[test]
fn a_power_cycle_silences_the_vcu_for_a_while() {
    let bench = Bench::new();
    let mut vcu = vcu(&bench, "1 power cycle\n");
    run(&mut vcu, &bench, ms(4000));
    let sent = bench.take_sent();
    let dark = sent.windows(2).map(|pair| pair[1].0.saturating_sub(pair[0].0)).max();
    assert!(dark.is_some_and(|dark| (ms(1000)..=ms(1020)).contains(&dark)), "{dark:?}");
    let states: Vec<_> = vcu
        .status()
        .happened
        .iter()
        .filter_map(|happening| match happening.what {
            HappeningKind::State { from, to, .. } => Some((from, to)),
            _ => None,
        })
        .collect();
    let off = Some(AsState::Off);
    assert_eq!(states, [(None, off), (off, None), (None, off)]);
}
