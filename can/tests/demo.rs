//! Whole missions in simulated time: each sample comes to its end, and the judge finds nothing.

use std::convert::Infallible;
use std::time::{Duration, Instant};

use adsdv_can::ai::{Ai, Plan};
use adsdv_can::bus::{Bus as _, Event, Listen as _};
use adsdv_can::car::{Car, missing};
use adsdv_can::demo::{self, DemoOptions, LocalBus, Run, RunError, run};
use adsdv_can::scenario::Scenario;
use adsdv_oracle::candump::{Reader, write_frame};
use adsdv_oracle::judge::{self, Judge, Report, Severity};
use adsdv_oracle::log::{LogOptions, judge_log, judge_recognised};
use adsdv_oracle::remote::Remote;
use adsdv_spec::messages::{AsState, Frame};
use adsdv_spec::{Edition, Machine};

fn sample(name: &str) -> Scenario {
    let (_, text) = Scenario::SAMPLES.into_iter().find(|(sample, _)| *sample == name).expect("a sample");
    text.parse().unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// Runs a scenario; the log, and what the judge says of it.
fn judged(scenario: &Scenario) -> (Run, Vec<(i64, Frame)>, Report) {
    let mut judge = Judge::new(judge::JudgeOptions::default());
    let mut log = Vec::new();
    let run = run(scenario, Ai::default(), &DemoOptions::default(), |time_ns, frame| {
        judge.frame(time_ns, frame.id.into(), frame.data());
        log.push((time_ns, *frame));
        Ok::<(), Infallible>(())
    });
    (run.expect("it comes to its end"), log, judge.finish())
}

#[test]
fn each_sample_comes_to_its_end_and_the_judge_finds_nothing() {
    use AsState::{Driving, EmergencyBrake, Finished, Off, Ready};
    let expected: [(&str, &[AsState]); 5] = [
        ("mission", &[Ready, Driving, Finished, Off]),
        ("go-too-early", &[Ready, Driving]),
        ("go-lost", &[Ready, Driving, EmergencyBrake, Off]),
        ("remote-estop", &[Ready, Driving, EmergencyBrake, Off]),
        ("power-cycle", &[Ready, EmergencyBrake, Off, Ready, Driving, Finished, Off]),
    ];
    assert_eq!(expected.map(|(name, _)| name), Scenario::SAMPLES.map(|(name, _)| name));
    for (name, states) in expected {
        let (run, log, report) = judged(&sample(name));
        let seen: Vec<AsState> = report.transitions.iter().map(|transition| transition.to).collect();
        assert_eq!(seen, states, "{name}");
        assert_eq!(run.state, states.last().copied(), "{name}");
        for severity in [Severity::Violation, Severity::Warning] {
            assert_eq!(report.count(severity), 0, "{name}: {:#?}", report.findings);
        }
        assert_eq!((run.frames, report.frames), (log.len() as u64, log.len() as u64), "{name}");
        let max = report.responses.max_ms().expect("answers");
        assert!(max < 15.0, "{name}: {max}");
        assert!(run.actions.len() >= 5, "{name}");
    }
}

/// The log of a run in an edition, as candump writes it.
fn recorded(name: &str, edition: &Edition) -> Vec<u8> {
    let mut text = Vec::new();
    let ai = Ai::new(edition, Plan::DEFAULT);
    let run = run(&sample(name), ai, &DemoOptions::default(), |time_ns, frame| {
        write_frame(&mut text, time_ns, demo::BUS, frame.id.into(), frame.data())
    });
    run.unwrap_or_else(|error| panic!("{name}, {}: {error}", edition.version));
    text
}

#[test]
fn each_sample_conforms_in_each_edition_which_its_log_tells() {
    for edition in Edition::ALL {
        for (name, _) in Scenario::SAMPLES {
            let log = recorded(name, edition);
            let judged =
                judge_recognised(Reader::new(&log[..]), &LogOptions::default(), |_| {}).expect("a log");
            let recognised = judged.recognised;
            // Of editions with the same bus it is the newest.
            let alike: Vec<_> = Edition::ALL.iter().filter(|other| other.bus == edition.bus).collect();
            let told = (alike.last().map(|newest| newest.version), alike.len() == 1);
            assert_eq!((Some(recognised.edition.version), recognised.certain), told, "{recognised}");
            assert_eq!(recognised.against, [""; 0], "{name}: {recognised}");
            for severity in [Severity::Violation, Severity::Warning] {
                assert_eq!(judged.report.count(severity), 0, "{name}: {:#?}", judged.report.findings);
            }
            let pressed = judged.report.transitions.iter().any(|transition| transition.remote_estop);
            let shown = name == "remote-estop" && Remote::of(&edition.bus).is_some();
            assert_eq!(pressed, shown, "{name}, {}", edition.version);
        }
    }
}

#[test]
fn the_built_in_scenario_is_a_whole_mission() {
    assert_eq!(Scenario::mission(), sample("mission"));
    let (run, ..) = judged(&Scenario::mission());
    assert!((40.0..80.0).contains(&run.distance_m), "{run:?}");
    assert!((15_000..60_000).contains(&run.duration_ms), "{run:?}");
}

#[test]
fn a_log_of_the_run_is_judged_the_same() {
    let (_, log, report) = judged(&sample("remote-estop"));
    let mut text = Vec::new();
    for (time_ns, frame) in &log {
        write_frame(&mut text, *time_ns, demo::BUS, frame.id.into(), frame.data()).expect("a vector");
    }
    let read = judge_log(&text[..], &LogOptions::default(), |_| {}).expect("a log");
    assert_eq!((read.frames, read.findings.len()), (report.frames, report.findings.len()));
    let text = |report: &Report| format!("{:?} {:?}", report.transitions, report.findings);
    assert_eq!(text(&read), text(&report));
}

#[test]
fn frames_are_on_the_bus_one_after_the_other_and_at_their_rates() {
    let (run, log, _) = judged(&Scenario::mission());
    for pair in log.windows(2) {
        let [(before, _), (after, frame)] = pair else { continue };
        // The shortest frame of these has 5 bytes: 87 bits without any that is stuffed.
        assert!(after - before >= 87 * 2000, "{before} {after} {frame}");
    }
    let count = |id: u16| log.iter().filter(|(_, frame)| frame.id == id).count() as u64;
    let cycles = run.duration_ms / 10;
    for id in [0x500, 0x520, 0x521, 0x522, 0x523, 0x524, 0x525, 0x526] {
        assert_eq!(count(id), cycles, "{id:X}");
    }
    for id in [0x501, 0x510, 0x511, 0x512, 0x513, 0x514] {
        assert_eq!(count(id), cycles, "{id:X}");
    }
    assert_eq!(count(0x502), cycles.div_ceil(10));
}

#[test]
fn the_same_run_is_the_same_log() {
    assert_eq!(judged(&sample("go-lost")).1, judged(&sample("go-lost")).1);
}

#[test]
fn a_scenario_stuck_before_a_state_reports_it() {
    let scenario: Scenario =
        "0 asms on, tsms on, ami SKIDPAD\n\nAS_READY +5 go on\n+1 end".parse().expect("a scenario");
    let options = DemoOptions { patience_ms: 20_000, ..DemoOptions::default() };
    let error = run(&scenario, Ai::default(), &options, |_, _| Ok::<(), Infallible>(())).unwrap_err();
    assert_eq!(
        error.to_string(),
        "line 3: expected AS_READY, found AS_OFF after 20 s; AS_READY (section 3.1) still needs: EBS_state == ARMED"
    );
}

/// The message names what leads to the state that the scenario waits for, and what was done until then is there.
#[test]
fn a_stuck_scenario_reports_what_leads_to_the_awaited_state() {
    let options = DemoOptions { patience_ms: 20_000, ..DemoOptions::default() };
    let cases = [
        (
            "AS_DRIVING +1 remote_estop on\nAS_OFF end",
            "EMERGENCY_BRAKE after 20 s; AS_OFF (section 3.9) still needs: AS master switch OFF",
        ),
        (
            "AS_DRIVING +1 remote_estop on\n+16 asms off\n+1 asms on, remote_estop off\nAS_READY end",
            "AS_OFF after 20 s; AS_READY (section 3.1) still needs: a power cycle",
        ),
        (
            "AS_DRIVING +1 ami SKIDPAD\nAS_READY end",
            "AS_FINISHED after 20 s; AS_OFF (section 3.4) still needs: ",
        ),
        ("AS_DRIVING +1 asms on\nEMERGENCY_BRAKE end", "EMERGENCY_BRAKE (section 3.8) still needs: SDC open"),
    ];
    for (text, expected) in cases {
        let text = format!("0 asms on, tsms on, ami SKIDPAD, ebs ARMED\nAS_READY +5.5 go on\n{text}");
        let scenario: Scenario = text.parse().expect("a scenario");
        let error = run(&scenario, Ai::default(), &options, |_, _| Ok::<(), Infallible>(())).unwrap_err();
        assert!(error.to_string().contains(expected), "{error}\nexpected {expected}");
        let RunError::Waits { run, stuck } = error;
        let done: usize = scenario.lines().iter().map(|line| line.actions.len()).sum();
        assert_eq!((run.actions.len(), run.state), (done, stuck.state));
        assert!(run.duration_ms > 25_000 && run.frames > 10_000, "{run:?}");
    }
}

#[test]
fn a_sink_that_fails_stops_the_run() {
    let mut left = 100;
    let error = run(&Scenario::mission(), Ai::default(), &DemoOptions::default(), |_, _| {
        left -= 1;
        if left == 0 { Err("full") } else { Ok(()) }
    });
    assert!(matches!(error, Err(RunError::Sink("full"))));
    assert_eq!(left, 0);
}

#[test]
fn a_scenario_without_end_goes_on_for_a_second() {
    let scenario: Scenario = "2 asms on".parse().expect("a scenario");
    let (run, ..) = judged(&scenario);
    assert_eq!((run.duration_ms, run.state), (3010, Some(AsState::Off)));
    let scenario: Scenario = "2 asms on, end".parse().expect("a scenario");
    let (run, log, _) = judged(&scenario);
    assert_eq!(run.duration_ms, 2010);
    // What was done last can be seen.
    let last = log.iter().rev().find(|(_, frame)| frame.id == 0x520).expect("520h");
    assert_eq!(last.1.data()[1] & 0b10, 0b10);
}

/// The real time of a whole mission, written and judged. The bound is far away: it is well under a second.
#[test]
fn a_mission_takes_well_under_a_second() {
    let begun = Instant::now();
    judged(&Scenario::mission());
    let taken = begun.elapsed();
    assert!(taken < Duration::from_secs(2), "{taken:?}");
}

/// The loop of a VCU on the bus within the program, in real time, until the car is ready and waits for "Go".
#[test]
fn the_local_bus_has_an_ai_computer_on_it() {
    let mut bus = LocalBus::new(Ai::default());
    let mut car = Car::new(Machine::REFERENCE);
    for action in ["ami SKIDPAD", "ebs ARMED", "tsms on", "asms on"] {
        car.act(&action.parse().expect("an action"));
    }
    assert_eq!((bus.name(), bus.dropped()), ("demo", 0));
    let cycle = Duration::from_millis(10);
    let begun = Instant::now();
    let mut next = begun;
    let mut received = 0;
    for _ in 0..30 {
        for frame in car.cycle(10).frames {
            bus.send(&frame).expect("it takes every frame");
        }
        next += cycle;
        loop {
            match bus.receive(next) {
                Event::Frame(frame) => {
                    received += 1;
                    assert!(frame.time_ns > 1_500_000_000_000_000_000);
                    assert!(car.receive(&frame.frame().expect("a frame of the AI")).is_ok());
                }
                Event::Nothing => break,
                event => panic!("{event:?}"),
            }
        }
        assert!(Instant::now() >= next);
    }
    assert!(begun.elapsed() >= 30 * cycle);
    assert!((25 * 6..=31 * 6).contains(&received), "{received}");
    assert_eq!(car.outputs().map(|outputs| outputs.state), Some(AsState::Ready));
    let left = missing(&car).expect("the way to AS_DRIVING").to_string();
    assert!(left.contains("\"Go\" signal OFF -> ON"), "{left}");
}

#[test]
fn the_local_bus_does_not_catch_up_on_cycles_that_nobody_waited_for() {
    let mut bus = LocalBus::new(Ai::default());
    let mut vcu = Car::new(Machine::REFERENCE);
    for frame in vcu.cycle(10).frames {
        bus.send(&frame).expect("it takes every frame");
    }
    std::thread::sleep(Duration::from_millis(200));
    let now = Instant::now();
    let frames = std::iter::from_fn(|| match bus.receive(now) {
        Event::Frame(frame) => Some(frame.id),
        _ => None,
    });
    // One cycle that was due, and perhaps another since.
    let count = frames.filter(|&id| id == 0x510).count();
    assert!((1..=2).contains(&count), "{count}");
}
