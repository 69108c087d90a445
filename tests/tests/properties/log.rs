//! A run that was recorded: the judge finds nothing against the VCU, and its timeline is that of the run; and it says the same
//! of the frames, of the log that is written of them, and piece by piece while they come.

use adsdv_conform::protocol::InputField;
use adsdv_oracle::candump::write_frame;
use adsdv_oracle::judge::{Judge, JudgeOptions, Party, Report, Severity};
use adsdv_oracle::log::{LogOptions, judge_log};
use adsdv_spec::messages::{
    Ai2VcuBrake, Ai2VcuDriveF, Ai2VcuDriveR, Ai2VcuStatus, Ai2VcuSteer, AmiState, EbsState, MissionStatus,
};
use adsdv_spec::{AsState, Control, Edition, Inputs, Readings};
use adsdv_tests::world::{MS, Recorded, World, judge};

use crate::holds::{holds, regressions};
use crate::operations::{Operation, Run, SILENCES, runs};
use crate::run::Silent;
use crate::runs::machine;
use crate::timeline::timeline;

/// How many runs are tried.
const CASES: u32 = 50;

/// For so long nobody sends while the power is off.
const POWERLESS: i64 = 1000 * MS;

/// For so long an EBS state lasts at least: 502h, which shows it, comes every 100 ms.
const EBS_LASTS: i64 = 300 * MS;

/// For so long a run goes on when all is done, so that the judge has seen what comes of it.
const SETTLED_MS: u32 = 200;

/// The messages that version 4.0 watches, each with the input that says how long it has been missing.
const WATCHED: [(u16, &str); 5] = [
    (Ai2VcuStatus::ID, "status_silence_ms"),
    (Ai2VcuDriveF::ID, "drive_f_silence_ms"),
    (Ai2VcuDriveR::ID, "drive_r_silence_ms"),
    (Ai2VcuSteer::ID, "steer_silence_ms"),
    (Ai2VcuBrake::ID, "brake_silence_ms"),
];

/// A change of state, and when.
type Change = (i64, AsState, AsState);

/// The run on a simulated bus, with the changes of state in it.
fn recorded(run: &Run) -> (World, Vec<Change>) {
    let mut world = World::new(machine(run));
    let mut changes = Vec::new();
    // What changes in the first cycle after the power was switched on does not show.
    let mut dark = true;
    let mut ebs_changed = i64::MIN;
    for &operation in &run.operations {
        match operation {
            Operation::Answers(answers) => world.ai_answers = answers,
            Operation::PowerCycle => {
                world.control = Control::INITIAL;
                world.t += POWERLESS;
                dark = true;
            }
            Operation::Wait(ms) => wait(&mut world, ms, &mut dark, &mut changes),
            Operation::Set(..) | Operation::Wheels(_) => {
                let mut inputs = Inputs { ai: world.ai, ..world.inputs };
                operation.act(&mut inputs);
                // The VCU hears of what the AI Computer changes with its next frame.
                world.ai = inputs.ai;
                if let Operation::Set(field @ InputField { part: SILENCES, .. }, raw) = operation {
                    misses(&mut world, field, raw);
                    continue;
                }
                let changes_ebs = inputs.ebs != world.inputs.ebs;
                if !changes_ebs || world.t.saturating_sub(ebs_changed) > EBS_LASTS {
                    if changes_ebs {
                        ebs_changed = world.t;
                    }
                    world.inputs = Inputs { ai: world.inputs.ai, ..inputs };
                }
            }
        }
    }
    wait(&mut world, SETTLED_MS, &mut dark, &mut changes);
    (world, changes)
}

/// A message goes missing: in a recording a silence lasts for as long as there is no frame.
fn misses(world: &mut World, field: &InputField, raw: i32) {
    let (id, _) = WATCHED.iter().find(|(_, key)| *key == field.key).expect("a message for each silence");
    world.mutes.retain(|muted| muted != id);
    if world.vcu.edition().rules.thresholds.missed_ms.is_some_and(|limit_ms| raw >= limit_ms.into()) {
        world.mutes.push(*id);
    }
}

fn wait(world: &mut World, ms: u32, dark: &mut bool, changes: &mut Vec<Change>) {
    let end = world.t + i64::from(ms) * MS;
    while world.t < end {
        let (t, from) = (world.t, world.control.state);
        world.cycle();
        if !std::mem::take(dark) && world.control.state != from {
            changes.push((t, from, world.control.state));
        }
    }
}

fn printed(report: &Report) -> String {
    let Report { frames, duration_ns, transitions, findings, responses, margins, exercised, .. } = report;
    let responses = (responses.count(), responses.min_ms(), responses.max_ms());
    let Report { stays, go_presses, .. } = report;
    format!(
        "{frames} {duration_ns} {transitions:?} {findings:?} {responses:?} {margins:?} {exercised:?} {stays:?} {go_presses:?}"
    )
}

/// Tries what is to be said of a recording, on runs that have one.
fn recordings(says: impl Fn(&Run, &World, &[Change]) -> Result<(), String>) {
    holds(
        CASES,
        regressions!("log"),
        &runs(),
        |run| {
            let (world, changes) = recorded(run);
            says(run, &world, &changes)
        },
        |run| timeline(&machine(run), run, &mut Silent),
    );
}

/// Whatever the readings are, none is known to the judge.
fn does_not_blame_the_vcu(run: &Run, world: &World) -> Result<(), String> {
    let report = world.judge(JudgeOptions::of(run.edition));
    let blamed = |severity, party| severity == Severity::Violation && party == Party::Vcu;
    match report.findings.iter().find(|finding| blamed(finding.severity, finding.party)) {
        None => Ok(()),
        Some(finding) => Err(format!("{finding:?}")),
    }
}

#[test]
fn the_judge_does_not_blame_the_vcu() {
    recordings(|run, world, _| does_not_blame_the_vcu(run, world));
}

/// The run of which `regressions/log.txt` has the seed: the VCU was blamed when the dwell ended with a step.
#[test]
fn a_handshake_that_was_lost_long_ago_is_no_reason_to_blame_the_vcu() {
    let set = Operation::set;
    let run = Run {
        edition: Edition::DEFAULT,
        readings: Readings::DEFAULT,
        cycle_ms: 10,
        operations: vec![
            set("tsms", 1),
            set("ebs", i32::from(EbsState::Triggered as u8)),
            Operation::Answers(false),
            Operation::Wait(5001),
            set("ami", i32::from(AmiState::TrackDrive as u8)),
            set("ebs", i32::from(EbsState::Armed as u8)),
            set("mission_status", i32::from(MissionStatus::Selected as u8)),
            set("asms", 1),
            Operation::Wait(20),
            Operation::Wait(4999),
        ],
    };
    let (world, changes) = recorded(&run);
    assert!(!changes.is_empty(), "AS_READY is entered");
    assert_eq!(does_not_blame_the_vcu(&run, &world), Ok(()));
}

#[test]
fn the_timeline_is_that_of_the_run() {
    recordings(|run, world, changes| {
        let report = world.judge(JudgeOptions::of(run.edition));
        let seen: Vec<Change> =
            report.transitions.iter().map(|change| (change.t_ns, change.from, change.to)).collect();
        // The first frame is that of the first step.
        let origin = world.log.first().map_or(0, |first| first.t);
        let done: Vec<Change> = changes.iter().map(|&(t, from, to)| (t - origin, from, to)).collect();
        if seen == done { Ok(()) } else { Err(format!("seen {seen:?}, done {done:?}")) }
    });
}

#[test]
fn a_log_that_is_written_is_judged_alike() {
    recordings(|run, world, _| {
        let judge_by = JudgeOptions::of(run.edition);
        let mut text = Vec::new();
        for Recorded { t, frame } in &world.log {
            write_frame(&mut text, *t, "vcan0", frame.id.into(), frame.data())
                .expect("a vector can be written");
        }
        let options = LogOptions { judge: judge_by, ..LogOptions::default() };
        let read = judge_log(text.as_slice(), &options, |_| {}).map_err(|error| error.to_string())?;
        let (read, seen) = (printed(&read), printed(&judge(&world.log, judge_by)));
        if read == seen { Ok(()) } else { Err(format!("read: {read}\nseen: {seen}")) }
    });
}

#[test]
fn what_is_news_comes_once() {
    recordings(|run, world, _| {
        let mut judge = Judge::new(JudgeOptions::of(run.edition));
        let origin = world.log.first().map_or(0, |first| first.t);
        let (mut transitions, mut findings) = (Vec::new(), Vec::new());
        let mut ask = |judge: &mut Judge| {
            let (more_transitions, more_findings) = judge.news();
            assert!(more_transitions.is_sorted_by_key(|transition| transition.t_ns));
            assert!(more_findings.is_sorted_by_key(|finding| finding.t_ns));
            transitions.extend(more_transitions);
            findings.extend(more_findings);
        };
        for (place, recorded) in (0_u32..).zip(&world.log) {
            judge.frame(recorded.t - origin, recorded.frame.id.into(), recorded.frame.data());
            if place % run.cycle_ms == 0 {
                ask(&mut judge);
            }
        }
        judge.time_passes(world.t - origin + POWERLESS);
        ask(&mut judge);
        let report = judge.finish();
        // One that waits to be settled comes later than another that does not.
        transitions.sort_by_key(|transition| transition.t_ns);
        if transitions != report.transitions {
            return Err(format!("news: {transitions:#?}\nreport: {:#?}", report.transitions));
        }
        // Some findings come at the end alone.
        let mut listed = report.findings.iter();
        findings.sort_by_key(|finding| finding.t_ns);
        match findings.iter().find(|news| !listed.any(|finding| finding == *news)) {
            None => Ok(()),
            Some(news) => Err(format!("{news:#?} is not, or twice, in {:#?}", report.findings)),
        }
    });
}
