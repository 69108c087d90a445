//! Whole runs, right and wrong, judged as they should be.

use adsdv_model::{Phase, Run};
use adsdv_oracle::judge::{Report, Rule, Section, Severity, Verdict};
use adsdv_spec::messages::AsState::{self, Driving, EmergencyBrake, Finished, Off, Ready};
use adsdv_spec::{Atom, Choice, Edition, Fault, Machine, Mutation, Readings, Truth};

use crate::path::{CYCLE_MS, Path, blamed, judged, with_choice};

/// Nanoseconds in a millisecond.
const MS: i64 = 1_000_000;

fn mission() -> Path {
    let mut path = Path::new(&Machine::REFERENCE);
    path.driving();
    path.off(&[Atom::Moving]).on(&[Atom::AtRest]).hold(200);
    path.off(&[Atom::MissionRunning]).on(&[Atom::MissionFinished]).hold(200);
    path.off(&[Atom::Asms]).hold(200);
    path.arrives(Off);
    path
}

/// The reference VCU with one thing changed.
fn mutant(name: &str) -> Machine {
    let mutation = Mutation::all(Edition::DEFAULT).find(|mutation| mutation.to_string() == name);
    let mutation = mutation.unwrap_or_else(|| panic!("there is a mutation {name:?}"));
    Machine::new(mutation.apply(Edition::DEFAULT), Readings::DEFAULT)
}

/// What the judge lays to the VCU.
fn found(report: &Report) -> Vec<(Rule, Section)> {
    blamed(report).iter().map(|finding| (finding.rule, finding.section)).collect()
}

#[test]
fn a_mission_conforms_and_every_transition_is_justified() {
    let report = mission().judged();
    assert_eq!(report.verdict(), Verdict::Conforms, "{:#?}", report.findings);
    assert_eq!(report.count(Severity::Warning), 0, "{:#?}", report.findings);
    let taken: Vec<_> = report.transitions.iter().map(|t| (t.from, t.to, t.justified)).collect();
    let expected = [(Off, Ready), (Ready, Driving), (Driving, Finished), (Finished, Off)];
    assert_eq!(taken, expected.map(|(from, to)| (from, to, Truth::True)));
}

#[test]
fn frames_come_in_the_order_of_time_and_502h_only_now_and_then() {
    let run = mission().run();
    let frames: Vec<_> = run.frames().collect();
    assert!(frames.first().is_some_and(|(t_ns, _)| *t_ns == 0));
    assert!(frames.windows(2).all(|pair| pair[0].0 < pair[1].0));
    let cycles = run.cycles().len();
    let Edition { rules, bus, .. } = *Edition::DEFAULT;
    let slow = bus.message(0x502).expect("502h").cycle_ms;
    let each = usize::from(slow / rules.timing.cycle_ms);
    let count = |id| frames.iter().filter(|(_, frame)| frame.id == id).count();
    assert_eq!(count(0x502), cycles.div_ceil(each) + 1, "and once when the EBS is armed");
    for id in [0x500, 0x510, 0x511, 0x512, 0x513, 0x514, 0x520, 0x521, 0x522, 0x523, 0x524, 0x525, 0x526] {
        assert_eq!(count(id), cycles, "{id:X}");
    }
}

#[test]
fn an_ebs_that_is_armed_between_two_502h_is_seen_to_be_armed() {
    let switches = [Atom::Asms, Atom::Tsms, Atom::AmiSelected, Atom::MissionSelected];
    let mut path = Path::new(&Machine::REFERENCE);
    path.hold(30).on(&switches).on(&[Atom::EbsArmed]).cycle();
    path.arrives(Ready).off(&[Atom::Asms]).cycle();
    path.arrives(Off).off(&[Atom::EbsArmed]).hold(30);
    let report = path.judged();
    assert_eq!(report.verdict(), Verdict::Conforms, "{:#?}", report.findings);
}

#[test]
fn a_vcu_that_drives_on_without_go_violates_section_3_7_then() {
    let mut path = Path::new(&mutant("3.7 term 1: dropped"));
    path.driving().off(&[Atom::GoOn]).cycle();
    path.arrives(Driving);
    let run = path.run().persisting(Run::AFTERMATH_MS);
    let off_ns = run.steps().last().expect("the path has steps").t_ns;
    let report = judged(&run, Readings::DEFAULT);
    let [finding] = blamed(&report)[..] else { panic!("one finding: {:#?}", report.findings) };
    assert_eq!((finding.rule, finding.section), (Rule::Due, "3.7".into()));
    let late = finding.t_ns - off_ns;
    assert!((-20 * MS..=80 * MS).contains(&late), "{late} ns after \"Go\" went off");
}

#[test]
fn a_transition_that_one_step_allows_wrongly_is_seen_to_be_wrong() {
    // The wheels are not straight, and only the last step would have looked.
    let mut path = Path::new(&mutant("3.2 term 0: steer-straight dropped"));
    path.ready();
    while !path.control.go_seen_low {
        path.cycle();
    }
    path.on(&[Atom::GoOn]).off(&[Atom::SteerStraight]).cycle();
    path.arrives(Driving);
    let report = path.judged();
    assert_eq!(found(&report), [(Rule::Unjustified, "3.2".into())], "{:#?}", report.findings);
}

#[test]
fn a_vcu_that_starts_without_the_ebs_violates_section_3_1() {
    let mut path = Path::new(&mutant("3.1 term 0: ebs-armed dropped"));
    path.on(&[Atom::Asms, Atom::Tsms, Atom::AmiSelected, Atom::MissionSelected]).cycle();
    path.arrives(Ready);
    let report = path.judged();
    assert_eq!(found(&report), [(Rule::Unjustified, "3.1".into())], "{:#?}", report.findings);
}

#[test]
fn lost_communication_goes_on_until_it_is_seen_to_be_ignored() {
    let mut path = Path::new(&mutant("3.7 term 7: dropped"));
    path.driving();
    path.answers = false;
    let limit = u32::from(Edition::DEFAULT.rules.timing.handshake_ms);
    path.hold(limit + CYCLE_MS);
    assert!(path.control.handshake.is_lost(Edition::DEFAULT.rules.timing.handshake_ms));
    path.arrives(Driving);
    let report = path.judged();
    assert_eq!(found(&report), [(Rule::Due, "3.7".into())], "{:#?}", report.findings);
}

#[test]
fn an_ai_computer_that_answers_goes_on_answering() {
    let mut path = Path::new(&Machine::REFERENCE);
    path.ready();
    path.answers = false;
    path.hold(30); // not yet too long
    let report = path.judged();
    assert_eq!(report.verdict(), Verdict::Conforms, "{:#?}", report.findings);
    let last = path.run().persisting(Run::AFTERMATH_MS).cycles().last().copied();
    assert_eq!(last.map(|cycle| cycle.after.state), Some(Ready));
}

#[test]
fn whether_neutral_while_moving_violates_depends_on_the_reading() {
    let mut path = Path::new(&with_choice(Choice::FaultEdge));
    path.driving();
    // NEUTRAL before the wheels turn again, so that there is no change to it while they do.
    path.off(&[Atom::Moving]).on(&[Atom::AtRest]).hold(100);
    path.on(&[Atom::DirectionNeutral]).hold(100);
    path.off(&[Atom::AtRest]).on(&[Atom::Moving]).hold(100);
    path.arrives(Driving);
    let run = path.run().persisting(Run::AFTERMATH_MS);
    let edge = judged(&run, Readings::DEFAULT.with(Choice::FaultEdge));
    assert!(blamed(&edge).is_empty(), "{:#?}", edge.findings);
    let level = judged(&run, Readings::DEFAULT.with(Choice::FaultLevel));
    assert_eq!(found(&level), [(Rule::Due, "3.7".into())], "{:#?}", level.findings);
}

#[test]
fn a_power_cycle_is_a_gap_and_no_violation() {
    let mut path = Path::new(&Machine::REFERENCE);
    path.driving().fault(Fault::BmsFault).hold(100);
    path.arrives(EmergencyBrake).power_cycle().driving();
    let run = path.run().persisting(Run::AFTERMATH_MS);
    let report = judged(&run, Readings::DEFAULT);
    assert_eq!(report.verdict(), Verdict::Conforms, "{:#?}", report.findings);
    assert_eq!(report.findings.iter().filter(|finding| finding.rule == Rule::Gap).count(), 1);
    let states: Vec<AsState> = report.transitions.iter().map(|transition| transition.to).collect();
    assert_eq!(states, [Ready, Driving, EmergencyBrake, Ready, Driving]);
    let ups = run.cycles().iter().filter(|cycle| cycle.phase == Phase::PowerUp && cycle.t_ns > 0).count();
    assert!(ups > 0 && run.steps().count() == path.actions.len() - 1);
}
