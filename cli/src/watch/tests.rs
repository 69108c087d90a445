//! Watching a bus whose events come from a script.

use std::collections::VecDeque;
use std::sync::atomic::AtomicBool;
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use adsdv_can::ai::{Ai, Plan};
use adsdv_can::bus::{Disturbance, Event, Listen, Received};
use adsdv_can::demo::{self, DemoOptions};
use adsdv_can::scenario::Scenario;
use adsdv_oracle::candump::FrameKind;
use adsdv_oracle::judge::Rule;
use adsdv_oracle::log::LogOptions;
use adsdv_spec::Edition;
use clap::Parser as _;

use super::*;
use crate::args::{Cli, Command};

/// A bus from which these come, as fast as they are taken; then it stops the command.
struct Script(VecDeque<Event>, Arc<AtomicBool>, Arc<Mutex<u64>>);

impl Listen for Script {
    fn name(&self) -> &'static str {
        "script0"
    }

    fn receive(&mut self, until: Instant) -> Event {
        self.0.pop_front().unwrap_or_else(|| {
            self.1.store(true, Ordering::Relaxed);
            thread::sleep(until.saturating_duration_since(Instant::now()).min(Duration::from_millis(5)));
            Event::Nothing
        })
    }

    fn dropped(&self) -> u64 {
        *self.2.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

fn frame(ms: i64) -> Event {
    let (kind, id, len, data) = (FrameKind::Standard, 0x520, 8, [0, 0, 1, 0, 0, 0, 0, 0]);
    Event::Frame(Received { time_ns: 1_795_209_995_000_000_000 + ms * 1_000_000, kind, id, len, data })
}

fn args(words: &[&str]) -> WatchArgs {
    let words = ["adsdv", "watch", "script0"].iter().chain(words);
    match Cli::try_parse_from(words).map(|cli| cli.command) {
        Ok(Command::Watch(args)) => args,
        other => panic!("{other:?}"),
    }
}

fn lines(args: &WatchArgs) -> Lines {
    Lines::new(args, args.edition.chosen().expect("the default"))
}

fn news(args: &WatchArgs, options: &LogOptions) -> News {
    News::new(lines(args), options.rules.clone())
}

fn watched(events: impl IntoIterator<Item = Event>, dropped: u64) -> Watched {
    // With --json nothing is printed while it is watched.
    watched_as(&["--json"], events, dropped)
}

fn watched_as(words: &[&str], events: impl IntoIterator<Item = Event>, dropped: u64) -> Watched {
    watched_by(&LogOptions::default(), words, events, dropped)
}

fn watched_by(
    options: &LogOptions,
    words: &[&str],
    events: impl IntoIterator<Item = Event>,
    dropped: u64,
) -> Watched {
    let stop = Arc::new(AtomicBool::new(false));
    let script = Script(events.into_iter().collect(), Arc::clone(&stop), Arc::new(Mutex::new(dropped)));
    watch(script, options, Audience::default(), news(&args(words), options), &stop).expect("it watches")
}

/// A mission of an edition, both sides.
fn mission(edition: &'static Edition) -> Vec<Event> {
    let mut events = Vec::new();
    let (ai, options) = (Ai::new(edition, Plan::DEFAULT), DemoOptions::default());
    demo::run(&Scenario::mission(), ai, &options, |time_ns, frame| {
        let (kind, id) = (FrameKind::Standard, frame.id.into());
        let (mut data, len) = ([0; 8], frame.data().len());
        data[..len].copy_from_slice(frame.data());
        let len = u8::try_from(len).expect("8 at most");
        events.push(Event::Frame(Received { time_ns, kind, id, len, data }));
        Ok::<(), std::convert::Infallible>(())
    })
    .expect("it drives");
    events
}

#[test]
fn a_bus_is_judged_by_the_edition_that_it_speaks_and_by_the_one_that_is_named() {
    for edition in Edition::ALL {
        let watched = watched(mission(edition), 0);
        let recognised = watched.watch.recognised().cloned().expect("it is decided");
        // Of editions with the same bus it is the newest, and the judge notes it.
        let alike: Vec<_> = Edition::ALL.iter().filter(|other| other.bus == edition.bus).collect();
        let told = (alike.last().map(|newest| newest.version), alike.len() == 1);
        assert_eq!((Some(recognised.edition.version), recognised.certain), told, "{recognised}");
        assert!(watched.news.is_recognised && watched.news.lines.is_read());
        let report = watched.watch.finish().expect("frames");
        let rules: Vec<_> = report.findings.iter().map(|finding| finding.rule).collect();
        assert_eq!(
            rules,
            if recognised.certain { vec![] } else { vec![Rule::Edition] },
            "nothing else is noted"
        );
        assert_eq!(report.transitions.len(), 4, "of the whole run");

        for named in Edition::ALL {
            let words = ["--json", "--edition", named.version];
            let watched = watched_as(&words, mission(edition), 0);
            assert!(watched.watch.recognised().is_none() && !watched.news.is_recognised);
        }
    }
}

#[test]
fn a_run_that_is_short_is_judged_by_the_edition_that_it_speaks_as_well() {
    for edition in Edition::ALL {
        // No more than three cycles: the lengths tell the newer ones from 3.0 at least.
        let watched = watched(mission(edition).into_iter().take(30), 0);
        let recognised = watched.watch.recognised().expect("it is decided in the end");
        let is_default = |edition: &Edition| edition == Edition::DEFAULT;
        assert_eq!(is_default(recognised.edition), is_default(edition), "{recognised}");
        assert!(watched.news.is_recognised);
    }
}

#[test]
fn a_reading_that_is_no_answer_in_the_edition_ends_the_watching() {
    let words = ["--json", "--reading", "fault-trigger=edge"];
    let allowed = watched_as(&words, mission(&Edition::V3_0), 0);
    assert!(allowed.news.lines.finish().is_ok());
    let refused = watched_as(&words, mission(&Edition::V4_0), 0);
    assert!(!refused.news.lines.is_read());
    let error = refused.news.lines.finish().expect_err("4.0 has no such answer").to_string();
    let said = "--reading fault-trigger=edge: is no answer in edition 4.0; expected fault-trigger=level\n";
    assert!(error.starts_with(said), "{error}");
}

/// The user's own rules, of a bus whose frames tell the edition.
fn with_rules(rules: &str, edition: &'static Edition) -> Watched {
    let options = LogOptions { rules: Some(rules.parse().expect(rules)), ..LogOptions::default() };
    watched_by(&options, &["--json"], mission(edition), 0)
}

#[test]
fn rules_are_judged_live_and_stand_in_the_json() {
    let watch = with_rules("parked: never AS_STATE is AS_DRIVING", &Edition::V4_0).watch;
    let recognised = watch.recognised().cloned().expect("it is decided");
    let traffic = watch.traffic();
    let report = watch.finish().expect("frames");
    assert_eq!((report.rules.len(), report.findings.len()), (1, 1), "{:?}", report.findings);
    let bus = json::Bus { traffic, outages: &[] };
    let text = json::watched(recognised.edition, Some(&recognised), &report, &bus);
    let printed: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    assert_eq!(printed["rules"][0]["verdict"], "broken");
    let schema: serde_json::Value = serde_json::from_str(json::WATCH_SCHEMA).expect("JSON");
    let validator = jsonschema::draft202012::new(&schema).expect("a schema");
    let errors: Vec<_> = validator.iter_errors(&printed).map(|error| error.to_string()).collect();
    assert!(errors.is_empty(), "{errors:#?}");
}

#[test]
fn rules_that_the_edition_has_not_end_the_watching() {
    let rules = "started: never AS_STATE is AS_INIT";
    assert!(with_rules(rules, &Edition::V2026).news.lines.is_read());
    let refused = with_rules(rules, &Edition::V4_0);
    assert!(!refused.news.lines.is_read() && refused.news.lines.finish().is_ok(), "the end tells why");
    assert!(matches!(refused.watch.finish(), Err(LogError::Rules(error)) if error.first().column == 28));
}

#[test]
fn the_first_line_says_how_the_edition_is_chosen() {
    let line = |words: &[&str]| lines(&args(words)).edition();
    assert_eq!(line(&[]), "edition as the frames tell; --edition names one");
    for edition in Edition::ALL {
        assert_eq!(line(&["--edition", edition.version]), format!("edition {}", edition.version));
    }
}

#[test]
fn every_frame_before_the_stop_is_judged_however_fast_they_come() {
    let watched = watched((0..100_000).map(frame), 0);
    assert_eq!(watched.watch.traffic().frames, 100_000);
    let report = watched.watch.finish().expect("frames");
    assert_eq!((report.frames, report.duration_ns), (100_000, 99_999_000_000));
}

#[test]
fn trouble_and_dropped_frames_are_in_the_end() {
    let events = [frame(0), Event::Disturbance(Disturbance::Down), Event::Up, frame(10)];
    let traffic = watched(events, 12).watch.traffic();
    assert_eq!((traffic.frames, traffic.troubles, traffic.dropped), (2, 1, 12));
    let text = lines::traffic(traffic, 10_000_000, Some("run.log"));
    assert_eq!(
        text,
        "bus: 200 frames/s, at most 2; 12 frames dropped, trouble 1 time; recorded in run.log\n"
    );
}

#[test]
fn the_json_of_a_live_bus_keeps_to_its_schema() {
    let events = [
        frame(0),
        Event::Disturbance(Disturbance::Down),
        Event::Up,
        Event::Disturbance(Disturbance::Gone),
        frame(10),
    ];
    let watch = watched(events, 12).watch;
    let (traffic, outages) = (watch.traffic(), watch.outages().to_vec());
    let recognised = watch.recognised().cloned().expect("it is decided");
    let report = watch.finish().expect("frames");
    let bus = json::Bus { traffic, outages: &outages };
    let text = json::watched(recognised.edition, Some(&recognised), &report, &bus);
    let printed: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    assert_eq!(printed["recognised"]["certain"], false, "520h alone tells nothing");
    let named = json::watched(recognised.edition, None, &report, &bus);
    assert!(!named.contains("recognised"), "{named}");
    let schema: serde_json::Value = serde_json::from_str(json::WATCH_SCHEMA).expect("JSON");
    let validator = jsonschema::draft202012::new(&schema).expect("a schema");
    let errors: Vec<_> = validator.iter_errors(&printed).map(|error| error.to_string()).collect();
    assert!(errors.is_empty(), "{errors:#?}");
    assert_eq!(printed["bus"]["dropped_frames"], 12);
    assert_eq!(printed["bus"]["troubles"].as_array().map(Vec::len), Some(2));
    assert!(
        printed["bus"]["troubles"][0]["until"].is_number()
            && printed["bus"]["troubles"][1]["until"].is_null()
    );
    let mut spoiled = printed.clone();
    spoiled["bus"]["extra"] = 1.into();
    assert!(!validator.is_valid(&spoiled) && !validator.is_valid(&without_bus(&printed)));

    // But for the bus it is the report of a log.
    let check: serde_json::Value = serde_json::from_str(json::CHECK_SCHEMA).expect("JSON");
    assert!(jsonschema::draft202012::new(&check).expect("a schema").is_valid(&without_bus(&printed)));
    for key in ["state", "transition", "finding", "response"] {
        assert_eq!(schema["$defs"][key], check["$defs"][key], "{key}");
    }
    assert_eq!(schema["properties"]["recognised"], check["properties"]["recognised"]);
    spoiled = printed.clone();
    spoiled["recognised"]["certain"] = "yes".into();
    assert!(!validator.is_valid(&spoiled));
}

fn without_bus(printed: &serde_json::Value) -> serde_json::Value {
    let mut report = printed.clone();
    report.as_object_mut().map(|report| report.remove("bus"));
    report
}

#[test]
fn an_output_that_fails_ends_the_watching_with_everything_recorded() {
    let stop = Arc::new(AtomicBool::new(false));
    let script = Script((0..5000).map(frame).collect(), Arc::clone(&stop), Arc::new(Mutex::new(3)));
    let log = std::env::temp_dir().join(format!("adsdv-watch-{}.log", std::process::id()));
    let recorder = Recorder::create(&log).expect("a file");
    let mut lines = lines(&args(&["--json"]));
    lines.note(Err(Error::output(&std::io::ErrorKind::StorageFull.into())));
    let news = News::new(lines, None);
    let watched = watch(
        script,
        &LogOptions::default(),
        Audience { recorder: Some(recorder), pages: None },
        news,
        &stop,
    )
    .expect("it watches");
    assert!(watched.audience.recorder.is_some_and(|recorder| recorder.finish().is_ok()));
    let text = std::fs::read_to_string(&log).expect("the log");
    _ = std::fs::remove_file(&log);
    assert!(
        text.starts_with("DROPCOUNT: dropped 3 CAN frames on 'script0' socket (total drops 3)\n"),
        "{text:.80}"
    );
    // All that was heard, and as much as was judged: the thread that listens may have been stopped early.
    assert_eq!(text.lines().count() as u64, watched.watch.traffic().frames + 1);
    assert!(watched.watch.traffic().frames > 0);
    let error = watched.news.lines.finish().expect_err("the output failed").to_string();
    assert!(error.starts_with("standard output: "), "{error}");
}

/// A bus on which nothing comes, and behind whose waiting the thread is held up.
struct HeldUp(Arc<Mutex<Vec<i64>>>);

impl Listen for HeldUp {
    fn name(&self) -> &'static str {
        "script0"
    }

    fn receive(&mut self, _: Instant) -> Event {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).push(ears::now_ns());
        thread::sleep(Duration::from_millis(20));
        Event::Nothing
    }

    fn dropped(&self) -> u64 {
        0
    }
}

#[test]
fn silence_is_reported_for_the_time_before_the_waiting() {
    let asked = Arc::new(Mutex::new(Vec::new()));
    let ears = Ears::start(HeldUp(Arc::clone(&asked))).expect("a thread");
    let heard = std::iter::repeat_with(|| ears.take()).flatten().take(3).collect::<Vec<_>>();
    let asked = asked.lock().unwrap_or_else(PoisonError::into_inner).clone();
    for (heard, asked) in heard.iter().zip(asked) {
        assert!(heard.now_ns <= asked, "{} ns after it was asked", heard.now_ns - asked);
    }
    drop(ears.finish());
}

/// A bus on which there is always a frame.
struct Endless(Arc<Mutex<usize>>);

impl Listen for Endless {
    fn name(&self) -> &'static str {
        "script0"
    }

    fn receive(&mut self, _: Instant) -> Event {
        *self.0.lock().unwrap_or_else(PoisonError::into_inner) += 1;
        thread::sleep(Duration::from_millis(1));
        frame(0)
    }

    fn dropped(&self) -> u64 {
        0
    }
}

#[test]
fn what_was_taken_from_a_bus_without_end_is_reported() {
    let taken = Arc::new(Mutex::new(0));
    let heard = Ears::start(Endless(Arc::clone(&taken))).expect("a thread").finish();
    assert_eq!(heard.len(), *taken.lock().unwrap_or_else(PoisonError::into_inner));
}
