//! Which edition a recording is of.

use adsdv_oracle::candump::{FrameKind, Reader, Record};
use adsdv_oracle::judge::{JudgeOptions, Report, Rule, Severity, Verdict};
use adsdv_oracle::log::{Judged, LogJudge, LogOptions, judge_log, judge_recognised};
use adsdv_oracle::recognise::Recognised;
use adsdv_spec::Edition;
use adsdv_spec::messages::{Node, Vcu2AiBrake, Vcu2LogDynamics1};
use adsdv_tests::world::{MS, Recorded, World};

const MISSION: &[u8] = include_bytes!("../../logs/mission.log");
const FINISHED_WHILE_MOVING: &[u8] = include_bytes!("../../logs/finished-while-moving.log");

fn tell(judge: &mut LogJudge, recorded: &Recorded, later: i64) {
    judge.frame(&Record {
        line: 1,
        time_ns: recorded.t + later,
        interface: "can0",
        kind: FrameKind::Standard,
        id: recorded.frame.id.into(),
        data: recorded.frame.data(),
        direction: None,
        terminated: true,
    });
}

fn heard(log: &[Recorded]) -> (Recognised, Report) {
    let mut judge = LogJudge::recognising(LogOptions::default());
    for recorded in log {
        tell(&mut judge, recorded, 0);
    }
    judge.time_passes(i64::MAX);
    let recognised = judge.recognised().expect("enough was heard").clone();
    (recognised, judge.finish(0).expect("there are frames"))
}

fn mission(edition: &Edition) -> Vec<Recorded> {
    let mut world = World::of(edition);
    world.finished();
    world.log
}

/// By which edition a whole run of an edition is judged, and whether the frames tell it from all others: the newest of those with the
/// same bus.
fn told(edition: &'static Edition) -> (&'static Edition, bool) {
    let alike = || Edition::ALL.iter().filter(|other| other.bus == edition.bus);
    (alike().next_back().expect("the edition itself"), alike().count() == 1)
}

fn notes(report: &Report) -> Vec<&str> {
    let notes = report.findings.iter().filter(|finding| finding.rule == Rule::Edition);
    notes.map(|note| note.seen.as_str()).collect()
}

fn counts(report: &Report) -> [usize; 3] {
    [Severity::Violation, Severity::Warning, Severity::Note].map(|severity| report.count(severity))
}

fn recorded(log: &[u8]) -> Judged {
    judge_recognised(Reader::new(log), &LogOptions::default(), |_| {}).expect("a log")
}

#[test]
fn both_recordings_are_of_4_0_without_its_120h() {
    let conforms = (MISSION, Verdict::Conforms, [0, 0, 6]);
    let violates = (FINISHED_WHILE_MOVING, Verdict::Violates, [2, 0, 4]);
    for (log, verdict, expected) in [conforms, violates] {
        let Judged { report, failure, recognised, .. } = recorded(log);
        assert!(failure.is_none());
        assert_eq!((recognised.edition.version, recognised.certain), ("4.0", true), "{recognised}");
        assert!(recognised.evidence.contains(&"511h has 4 bytes (3.0: 8)".to_owned()), "{recognised}");
        // The vehicle's limit of the steer angle was that of version 3.0.
        let against = ["120h is absent (4.0: every 10 ms)", "ANGLE_MAX of 523h is 240 (4.0: 0 to 210)"];
        assert_eq!(recognised.against, against);
        assert_eq!(notes(&report).len(), 1);
        assert!(
            !report.findings.iter().any(|finding| finding.rule == Rule::Length),
            "{:#?}",
            report.findings
        );
        assert_eq!(report.verdict(), verdict, "{:#?}", report.findings);
        assert_eq!(counts(&report), expected, "{:#?}", report.findings);
    }
}

/// A vehicle of version 3.0 that sends shorter frames than its database says.
#[test]
fn under_3_0_the_recordings_are_judged_as_ever() {
    let options = LogOptions { judge: JudgeOptions::of(&Edition::V3_0), ..LogOptions::default() };
    let judged = |log| counts(&judge_log(log, &options, |_| {}).expect("a log"));
    assert_eq!((judged(MISSION), judged(FINISHED_WHILE_MOVING)), ([0, 0, 10], [2, 0, 9]));
}

#[test]
fn a_run_of_each_edition_is_recognised_and_judged_by_it() {
    for edition in Edition::ALL {
        let (recognised, report) = heard(&mission(edition));
        // Two whole editions would be a long message.
        let is_told = (recognised.edition, recognised.certain) == told(edition);
        assert!(is_told, "a run of {}: {recognised}", edition.version);
        assert_eq!(recognised.against, [""; 0], "{recognised}");
        let noted = report.findings.iter().all(|finding| finding.rule == Rule::Edition);
        assert!(noted && report.findings.is_empty() == recognised.certain, "{:#?}", report.findings);
        assert_eq!(report.transitions.len(), 3);
    }
}

/// The AI Computer's messages are the same in 4.0 and in later ones, as long as it steers by no more than 4.0 allows.
#[test]
fn either_side_alone_tells_the_edition() {
    for edition in Edition::ALL {
        for node in [Node::Ai, Node::Vcu] {
            let mut log = mission(edition);
            log.retain(|recorded| recorded.sender() == Some(node));
            let (recognised, report) = heard(&log);
            let fits = recognised.edition == *edition || recognised.alike.contains(edition);
            let alone = told(edition).1 && node == Node::Vcu || *edition == Edition::DEFAULT;
            assert!(fits && recognised.certain == alone, "{}: {node}: {recognised}", edition.version);
            assert_eq!(report.verdict(), Verdict::Conforms);
            if !alone {
                let [note] = notes(&report)[..] else { panic!("{:#?}", report.findings) };
                let newest = Edition::ALL.last().expect("an edition").version;
                let judged_by = format!("judged by version {newest}, though 4.0 ");
                assert!(note.starts_with(&judged_by) && note.contains(" as well"), "{note}");
            }
        }
    }
}

/// What remains tells as much: neither 500h nor a device is recorded.
#[test]
fn a_run_of_2026_is_recognised_by_its_states_alone() {
    let mut log = mission(&Edition::V2026);
    log.retain(|recorded| recorded.sender().is_some() && recorded.frame.id != Vcu2LogDynamics1::ID);
    let (recognised, report) = heard(&log);
    assert_eq!((recognised.edition, recognised.certain), told(&Edition::V2026), "{recognised}");
    let noted = notes(&report).len() == report.findings.len();
    assert!(noted && report.findings.is_empty() == recognised.certain, "{:#?}", report.findings);
}

#[test]
fn a_run_that_fits_no_edition_is_judged_by_the_nearest() {
    let mut log = mission(&Edition::V2026);
    for recorded in log.iter_mut().filter(|recorded| recorded.frame.id == Vcu2AiBrake::ID) {
        recorded.frame.len = 7;
    }
    let (recognised, report) = heard(&log);
    assert_eq!((recognised.edition, recognised.certain), told(&Edition::V2026), "{recognised}");
    let bytes = |edition: &Edition| edition.bus.message(Vcu2AiBrake::ID).map_or(0, |message| message.len);
    let expected = Edition::ALL.iter().map(|edition| format!("{}: {}", edition.version, bytes(edition)));
    let expected: Vec<String> = expected.collect();
    assert_eq!(recognised.against, [format!("524h has 7 bytes ({})", expected.join(", "))]);
    let [note] = notes(&report)[..] else { panic!("{:#?}", report.findings) };
    let judged_by = format!("judged by version {}", recognised.edition.version);
    assert!(note.starts_with(&judged_by) && note.contains("; but 524h has 7 bytes"), "{note}");
    assert_eq!(report.verdict(), Verdict::Conforms);
}

/// Another bus with the devices on it is not the one to judge, even where they come first.
#[test]
fn a_device_does_not_choose_the_interface() {
    let device = "(1.0) can1 181#0000000000006400\n";
    let status = "(1.0) can0 520#0000010000000000\n";
    let judged = recorded(format!("{device}{status}{device}{status}").as_bytes());
    let others = judged.report.findings.iter().filter(|finding| finding.rule == Rule::NotJudged);
    let others: Vec<&str> = others.map(|finding| finding.seen.as_str()).collect();
    assert_eq!(others, ["1 frame on interface can1, not judged"]);
}

/// With or without a line feed behind it.
#[test]
fn of_a_log_with_a_broken_frame_of_a_device_only_nothing_wrong_is_said() {
    let rules = |report: &Report| report.findings.iter().map(|finding| finding.rule).collect::<Vec<Rule>>();
    let options = LogOptions { judge: JudgeOptions::of(&Edition::V2026), ..LogOptions::default() };
    for data in ["", "02", "02000000000064"] {
        for end in ["", "\n"] {
            let log = format!("(1.0) can0 181#{data}{end}");
            let judged = recorded(log.as_bytes());
            // Who does not know the device knows that the identifier is reserved.
            assert_eq!(rules(&judged.report), [Rule::Edition, Rule::Reserved, Rule::OneSided], "{data}");
            let report = judge_log(log.as_bytes(), &options, |_| {}).expect("a log");
            assert_eq!(rules(&report), [Rule::OneSided], "{data}");
            assert_eq!((report.frames, report.verdict()), (1, Verdict::Conforms));
        }
    }
}

#[test]
fn where_the_sides_differ_the_vcu_counts() {
    let from = |edition, node| {
        let mut log = mission(edition);
        log.retain(|recorded| recorded.sender() == Some(node));
        log
    };
    let differ = [
        (&Edition::V3_0, &Edition::V4_0),
        (&Edition::V4_0, &Edition::V3_0),
        (&Edition::V2026, &Edition::V3_0),
    ];
    for (vcu, ai) in differ {
        let mut log = [from(vcu, Node::Vcu), from(ai, Node::Ai)].concat();
        log.sort_by_key(|recorded| recorded.t);
        let (recognised, report) = heard(&log);
        assert_eq!(recognised.edition, told(vcu).0, "{recognised}");
        assert!(recognised.against.iter().any(|against| against.starts_with("511h has")), "{recognised}");
        assert_eq!(notes(&report).len(), 1, "{:#?}", report.findings);
    }
}

#[test]
fn too_little_is_judged_by_the_default_and_said_to_be() {
    let mut log = mission(&Edition::V4_0);
    log.retain(|recorded| [0x510, 0x520].contains(&recorded.frame.id));
    let (recognised, report) = heard(&log);
    assert_eq!((recognised.edition, recognised.certain), (Edition::DEFAULT, false), "{recognised}");
    assert_eq!(notes(&report), ["judged by version 3.0, as the frames do not tell which"]);
}

#[test]
fn nothing_is_no_log() {
    assert!(judge_recognised(Reader::new(&b""[..]), &LogOptions::default(), |_| {}).is_err());
    let other = b"(1.0) can0 123#00\n";
    let judged = judge_recognised(Reader::new(&other[..]), &LogOptions::default(), |_| {}).expect("a frame");
    assert_eq!((judged.recognised.edition, judged.recognised.certain), (Edition::DEFAULT, false));
}

#[test]
fn after_a_second_a_live_bus_is_judged_and_nothing_is_lost() {
    let log = mission(&Edition::V4_0);
    let mut judge = LogJudge::recognising(LogOptions::default());
    let mut decided = None;
    for recorded in &log {
        tell(&mut judge, recorded, 0);
        if decided.is_none() && judge.recognised().is_some() {
            decided = Some(recorded.t / MS);
        }
    }
    assert_eq!(decided, Some(1000));
    let report = judge.finish(0).expect("there are frames");
    assert_eq!((report.frames, report.transitions.len()), (log.len() as u64, 3));
}

#[test]
fn frames_that_fit_another_edition_later_are_noted_once() {
    let mut judge = LogJudge::recognising(LogOptions::default());
    let (first, then) = (mission(&Edition::V4_0), mission(&Edition::V3_0));
    let later = first.last().expect("frames").t + 10 * MS;
    for recorded in &first {
        tell(&mut judge, recorded, 0);
    }
    for recorded in &then {
        tell(&mut judge, recorded, later);
    }
    let report = judge.finish(0).expect("there are frames");
    let [note] = notes(&report)[..] else { panic!("{:#?}", report.findings) };
    assert!(
        note.starts_with("judged by version 4.0 all the same, but from here on the frames fit version 3.0"),
        "{note}"
    );
    let note = report.findings.iter().find(|finding| finding.rule == Rule::Edition).expect("it is there");
    assert!((0..100 * MS).contains(&(note.t_ns - later)), "{note:?}");
}
