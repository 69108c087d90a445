//! What is to work: a whole mission, the rates, the answers.

use adsdv_can::ai::Ai;
use adsdv_can::status::HappeningKind;
use adsdv_oracle::judge::{Judge, JudgeOptions, Verdict};
use adsdv_spec::messages::AsState;

use super::{Bench, are_apart, count, mission, ms, run, vcu};

#[test]
fn a_whole_mission_is_driven_and_conforms() {
    let bench = Bench::new();
    bench.plug_in(Ai::default());
    let mut vcu = mission(&bench);
    run(&mut vcu, &bench, ms(60_000));
    let status = vcu.status();
    let way: Vec<AsState> = status
        .happened
        .iter()
        .filter_map(|happening| match happening.what {
            HappeningKind::State { to, .. } => to,
            _ => None,
        })
        .collect();
    let expected = [AsState::Off, AsState::Ready, AsState::Driving, AsState::Finished];
    assert_eq!(way.get(..expected.len()), Some(&expected[..]), "{:#?}", status.happened);
    assert!(status.distance_m > 10.0, "{} m", status.distance_m);
    // The status names each arrow with its section and what decided.
    let ready = status.happened.iter().find_map(|happening| match &happening.what {
        HappeningKind::State { to: Some(AsState::Ready), section, why, .. } => Some((*section, why.clone())),
        _ => None,
    });
    let (section, why) = ready.expect("it was ready");
    assert!(section == "3.1" && why.contains("AS master switch ON"), "{section}: {why}");

    let mut judge = Judge::new(JudgeOptions::default());
    for (at, frame) in bench.take_sent() {
        judge.frame(i64::try_from(at.as_nanos()).expect("a minute"), frame.id.into(), frame.data());
    }
    let report = judge.finish();
    assert_eq!(report.verdict(), Verdict::Conforms, "{:#?}", report.findings);
}

#[test]
fn each_message_has_its_rate() {
    let bench = Bench::new();
    let mut vcu = vcu(&bench, "0 tsms on\n");
    run(&mut vcu, &bench, ms(10_000));
    let sent = bench.take_sent();
    for id in [0x500, 0x520, 0x521, 0x522, 0x523, 0x524, 0x525, 0x526] {
        let times: Vec<_> = sent.iter().filter(|(_, frame)| frame.id == id).map(|(at, _)| *at).collect();
        assert_eq!(times.len(), 1001, "{id:X}h");
        assert!(are_apart(&times, ms(10)), "{id:X}h");
    }
    let times: Vec<_> = sent.iter().filter(|(_, frame)| frame.id == 0x502).map(|(at, _)| *at).collect();
    assert_eq!(times.len(), 101);
    assert!(are_apart(&times, ms(100)));
    assert_eq!(vcu.status().sent, 8 * 1001 + 101);
    assert_eq!((vcu.status().cycles.count, vcu.status().cycles.late), (1001, 0));
}

#[test]
fn the_answers_to_the_handshake_are_timed() {
    let bench = Bench::new();
    bench.plug_in(Ai::default());
    let mut vcu = vcu(&bench, "0 tsms on\n");
    run(&mut vcu, &bench, ms(2000));
    let status = vcu.status();
    assert!(status.responses.count() > 50, "{}", status.responses.count());
    // The AI Computer of the bench sends 4 ms after the VCU.
    assert_eq!((status.responses.min_ms(), status.responses.max_ms()), (Some(4.0), Some(4.0)));
    assert_eq!(status.last_response_ms, Some(4.0));
    assert_eq!(count(status, |what| *what == HappeningKind::AiHeard), 1);
}

#[test]
fn the_status_has_what_is_missing_and_what_comes_next() {
    let bench = Bench::new();
    let mut vcu = vcu(&bench, "5 asms on\n");
    run(&mut vcu, &bench, ms(100));
    let status = vcu.status();
    assert_eq!(status.bus, "bench0");
    assert_eq!(status.next.as_deref(), Some("at 5 s: asms on"));
    assert_eq!(status.missing.as_ref().map(|missing| missing.to), Some(AsState::Ready));
    assert_eq!((status.time_ms, status.in_state_ms), (100, 100));
    run(&mut vcu, &bench, ms(5100));
    assert!(vcu.status().inputs.asms);
    assert_eq!(count(vcu.status(), |what| *what == HappeningKind::Did("asms on".to_owned())), 1);
}
