//! What can be wrong with the log itself.

use adsdv_oracle::judge::{JudgeOptions, Party, Report, Rule, Severity, Verdict};
use adsdv_proofs::seed::seed;
use adsdv_spec::messages::{AsState, Node, Vcu2AiStatus, Vcu2AiSteer};
use adsdv_tests::bus::{BUS, def_of};
use adsdv_tests::world::{Chance, MS, Random, Recorded, World, judge, violations};

use crate::check::{by, is_reported};

/// A run through every state, which conforms.
fn run() -> World {
    let mut world = World::reference();
    world.finished();
    world.inputs.asms = false;
    world.inputs.go = false;
    world.wait(1000);
    world
}

fn notes(report: &Report, rule: Rule) -> usize {
    report.findings.iter().filter(|f| f.severity == Severity::Note && f.rule == rule).count()
}

fn only_of(log: &[Recorded], node: Node) -> Vec<Recorded> {
    let sent_by = |id| BUS.message(id).is_some_and(|message| message.sender == node);
    log.iter().copied().filter(|recorded| sent_by(recorded.frame.id)).collect()
}

#[test]
fn one_side_alone_conforms() {
    for node in [Node::Ai, Node::Vcu] {
        let log = only_of(&run().log, node);
        let report = judge(&log, JudgeOptions::default());
        assert_eq!(report.verdict(), Verdict::Conforms, "{node} only: {:#?}", violations(&report));
        assert_eq!(notes(&report, Rule::OneSided), 1, "{node} only");
    }
}

#[test]
fn a_log_that_begins_or_ends_anywhere_conforms() {
    let mut worlds = vec![run(), World::reference()];
    worlds[1].after_emergency();
    let seed = seed();
    let mut random = Random::with_seed(seed);
    for world in &worlds {
        for cut in 0..200 {
            let end = world.t.unsigned_abs();
            let (one, other) = (random.below(end).cast_signed(), random.below(end).cast_signed());
            let within = one.min(other)..=one.max(other);
            let log: Vec<Recorded> = world.log.iter().copied().filter(|r| within.contains(&r.t)).collect();
            let report = judge(&log, JudgeOptions::default());
            let violations = violations(&report);
            assert_eq!(report.verdict(), Verdict::Conforms, "seed {seed}, cut {cut}: {violations:#?}");
        }
    }
}

/// What was before the log begins is not known: it may be the reason of what comes at once.
#[test]
fn a_transition_at_the_beginning_of_a_log_blames_nobody() {
    let mut world = World::reference();
    world.wait(1000);
    let forced = world.t;
    world.force(AsState::Ready);
    world.wait(300);
    for (before, expected) in [(10, false), (300, true)] {
        let mut log = world.log.clone();
        log.retain(|recorded| recorded.t >= forced - before * MS);
        let report = judge(&log, JudgeOptions::default());
        let found = by(&report, Party::Vcu).iter().any(|finding| finding.rule == Rule::Unjustified);
        assert_eq!(found, expected, "{before} ms before");
    }
}

#[test]
fn a_log_that_runs_backwards_blames_nobody() {
    let mut log = run().log;
    log.reverse();
    let report = judge(&log, JudgeOptions::default());
    assert_eq!(report.verdict(), Verdict::Conforms, "{:#?}", violations(&report));
    assert_eq!(report.frames, u64::try_from(log.len()).expect("a short log"), "all are counted");
    assert!(notes(&report, Rule::TimeBackwards) > 0);
}

/// Two frames in each other's place, the first of a state and the one before: the older is not taken for a change.
#[test]
fn states_that_changed_places_blame_nobody() {
    let world = run();
    let id = def_of::<Vcu2AiStatus>().id;
    let state = |place: &usize| {
        BUS.decode_as::<Vcu2AiStatus>(world.log[*place].frame.data()).map(|status| status.as_state)
    };
    let places: Vec<usize> = (0..world.log.len()).filter(|&place| world.log[place].frame.id == id).collect();
    let changes = places.windows(2).filter(|pair| state(&pair[0]) != state(&pair[1]));
    let mut count = 0;
    for pair in changes {
        let mut log = world.log.clone();
        log.swap(pair[0], pair[1]);
        let report = judge(&log, JudgeOptions::default());
        assert_eq!(report.verdict(), Verdict::Conforms, "{:#?}", violations(&report));
        count += 1;
    }
    assert_eq!(count, 4, "through every state");
}

/// A recorder that writes times of its own: of several frames of one message at the same time, each counts.
#[test]
fn a_coarse_clock_blames_nobody_and_loses_nothing() {
    let mut log = run().log;
    for recorded in &mut log {
        recorded.t -= recorded.t.rem_euclid(20 * MS);
    }
    let report = judge(&log, JudgeOptions::default());
    assert_eq!(report.verdict(), Verdict::Conforms, "{:#?}", violations(&report));
    let states: Vec<AsState> = report.transitions.iter().map(|transition| transition.to).collect();
    assert_eq!(states, [AsState::Ready, AsState::Driving, AsState::Finished, AsState::Off]);
}

/// Its program may well leave cycles out. That is no loss: what the VCU does meanwhile shows.
#[test]
fn an_ai_computer_that_leaves_cycles_out_excuses_no_vcu() {
    let mut world = World::reference();
    world.finished();
    world.hold_state();
    world.inputs.asms = false;
    world.wait(2000);
    let mut random = Random::with_seed(1);
    let is_ai = |id| BUS.message(id).is_some_and(|message| message.sender == Node::Ai);
    world.log.retain(|recorded| !is_ai(recorded.frame.id) || !random.one_in(3));
    is_reported(
        &world,
        JudgeOptions::default(),
        Party::Vcu,
        &[(Rule::Due, "3.4")],
        "the AI leaves cycles out",
    );
}

/// The run with each frame of one message made this long.
fn resized(world: &World, id: u16, len: usize) -> Report {
    let mut log = world.log.clone();
    for recorded in log.iter_mut().filter(|recorded| recorded.frame.id == id) {
        recorded.frame.len = u8::try_from(len).expect("a frame is short");
        recorded.frame.data[len..].fill(0);
    }
    judge(&log, JudgeOptions::default())
}

#[test]
fn frames_too_short_are_reported_once() {
    let world = run();
    for message in BUS.messages.iter().filter(|m| world.log.iter().any(|r| r.frame.id == m.id)) {
        let report = resized(&world, message.id, message.bytes_needed() - 1);
        let party = message.sender.into();
        let found: Vec<Rule> = by(&report, party).iter().map(|finding| finding.rule).collect();
        assert_eq!(found, [Rule::TooShort], "{}: {:#?}", message.name, violations(&report));
        assert_eq!(violations(&report).len(), 1, "{}: {:#?}", message.name, violations(&report));
    }
}

/// What a frame says may be the same when it is cut off: zeros were there.
#[test]
fn frames_that_become_too_short_are_reported_then() {
    let mut log = run().log;
    let id = Vcu2AiSteer::ID;
    let places: Vec<usize> = (0..log.len()).filter(|&place| log[place].frame.id == id).collect();
    let [before, short] = [1, 0].map(|back| places[places.len() / 2 - back]);
    assert_eq!(log[before].frame, log[short].frame);
    let (t, frame) = (log[short].t - log[0].t, &mut log[short].frame);
    frame.len = u8::try_from(def_of::<Vcu2AiSteer>().bytes_needed() - 1).expect("a frame is short");
    let end = usize::from(frame.len);
    assert!(frame.data[end..].iter().all(|&byte| byte == 0), "nothing is lost");
    let report = judge(&log, JudgeOptions::default());
    let found: Vec<(Rule, i64)> = by(&report, Party::Vcu).iter().map(|one| (one.rule, one.t_ns)).collect();
    assert_eq!(found, [(Rule::TooShort, t)], "{:#?}", violations(&report));
}

#[test]
fn another_length_that_holds_every_signal_is_a_note() {
    let world = run();
    let mut count = 0;
    for message in BUS.messages.iter().filter(|m| m.bytes_needed() < usize::from(m.len)) {
        if !world.log.iter().any(|r| r.frame.id == message.id) {
            continue;
        }
        let report = resized(&world, message.id, message.bytes_needed());
        assert_eq!(report.verdict(), Verdict::Conforms, "{}: {:#?}", message.name, violations(&report));
        assert_eq!(notes(&report, Rule::Length), 1, "{}", message.name);
        count += 1;
    }
    assert!(count > 0, "some messages end in unused bytes");
}

/// AS_DRIVING, with all time stamps from some moment on set back.
fn set_back(ms: i64) -> Report {
    let mut world = World::reference();
    world.driving();
    let since = world.t + 1000 * MS;
    world.wait(3000);
    for recorded in world.log.iter_mut().filter(|recorded| recorded.t >= since) {
        recorded.t -= ms * MS;
    }
    world.judge(JudgeOptions::default())
}

#[test]
fn time_that_goes_back_is_no_violation() {
    let shuffled = set_back(5);
    assert_eq!(shuffled.verdict(), Verdict::Conforms, "{:#?}", violations(&shuffled));
    let restarted = set_back(100_000);
    assert_eq!(restarted.verdict(), Verdict::Conforms, "{:#?}", violations(&restarted));
    assert_eq!(notes(&restarted, Rule::TimeBackwards), 1);
}

#[test]
fn a_vcu_that_comes_back_in_off_is_a_note() {
    let mut world = World::reference();
    world.driving();
    let since = world.t;
    world.wait(2000);
    world.log.retain(|r| r.t < since || BUS.message(r.frame.id).is_none_or(|m| m.sender == Node::Ai));
    let mut vcu = World::reference();
    vcu.wait(1000);
    let offset = world.t;
    let later = vcu.log.iter().map(|recorded| Recorded { t: recorded.t + offset, ..*recorded });
    world.log.extend(later);

    let report = judge(&world.log, JudgeOptions::default());
    assert!(by(&report, Party::Vcu).is_empty(), "{:#?}", violations(&report));
    assert_eq!(notes(&report, Rule::Gap), 1);
    assert!(report.transitions.iter().all(|transition| transition.to != AsState::Off));
}
