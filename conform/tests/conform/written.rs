//! What is said of programs that err, to the letter: the files of `written/` have the whole report of each.
//! A change of what is found, of what is blamed, or of the shortest scenario shows as a change of them.
//!
//! `UPDATE_EXPECT=1 cargo test -p adsdv-oracle --test conform written` writes it anew.

use std::fmt::Write as _;
use std::io;
use std::time::Duration;

use adsdv_conform::protocol::{Answer, SHOWN, Value};
use adsdv_conform::{
    ConformOptions, ConformProgress, ConformReport, Failure, Outcome, Phase, ProgramError, ProgramErrorKind,
    SentLine, Work, conform,
};
use adsdv_spec::{Choice, Choices, Edition, Inputs, Machine, Mutation, Readings};
use expect_test::expect_file;
use serde_json::json;

use crate::erring::{Erring, Outputs};
use crate::programs::tests;

/// So many failures of a program are written in full: what somebody can read.
const IN_FULL: usize = 2;

/// As many random scenarios as show most, and all the time that it takes.
fn usual() -> ConformOptions {
    ConformOptions { runs: 20, shrinking: Duration::from_secs(1 << 20), ..ConformOptions::default() }
}

/// Judged by the default readings, which is much faster.
fn by_default() -> ConformOptions {
    ConformOptions { possible: Readings::DEFAULT.choices(), ..usual() }
}

fn name(name: &str, mut program: Erring, options: &ConformOptions) -> String {
    // For each phase how often progress was reported, and all that was done together.
    let mut phases = [(0_usize, 0_usize); 3];
    let mut progress = |now: ConformProgress| {
        assert!(now.done <= now.all, "{now:?}");
        let (count, done) = &mut phases[now.phase as usize];
        *count += 1;
        *done += now.done;
    };
    let report = conform(&mut program, tests(), options, &mut progress).expect("it answers");
    format!("================ {name}\n{}progress reports: {phases:?}\n\n", printed(&report))
}

fn printed(report: &ConformReport) -> String {
    let ConformReport { tests, failed_tests, runs, failed_runs, steps, late, readings, .. } = report;
    let mut text = format!(
        "{failed_tests} of {tests} tests and {failed_runs} of {runs} runs failed, {steps} steps, {late} late, readings \
         [{readings}], about the VCU {}, conforms: {}\n",
        report.about_the_vcu,
        report.conforms()
    );
    for follows in report.follows.iter().filter(|one| one.possible.len() != 1 || !one.mixes.is_empty()) {
        let possible: Vec<String> = follows.possible.iter().map(ToString::to_string).collect();
        let _ = write!(text, "{}: [{}]", follows.reading, possible.join(" "));
        for side in &follows.mixes {
            let _ = write!(text, ", {} by {}", side.choice, few(&side.tests));
        }
        text.push('\n');
    }
    // Each on a line, so that a change of one is a change of that line.
    for outcome in [Outcome::Pass, Outcome::Fail, Outcome::Differs, Outcome::NotChecked] {
        let those: Vec<_> = report.requirements.iter().filter(|one| one.outcome == outcome).collect();
        let _ = writeln!(text, "{}: {}", outcome.name(), those.len());
        for one in those.iter().filter(|_| outcome != Outcome::Pass) {
            let _ = writeln!(text, "  {} {}/{}{}", one.id, one.checked, one.tests, names(&one.failed));
        }
    }
    for (what, failures) in [("", &report.failures), ("observed ", &report.observations)] {
        for (place, failure) in failures.iter().enumerate() {
            let _ = write!(text, "- {what}");
            text.push_str(&if place < IN_FULL { in_full(failure) } else { in_short(failure) });
        }
    }
    let _ = writeln!(
        text,
        "{} more; not shown [{}]; not run {}; notes {:?}",
        report.more_failures,
        report.not_shown.join(" "),
        few(&report.not_run),
        report.notes
    );
    text
}

fn names(failed: &[String]) -> String {
    if failed.is_empty() { String::new() } else { format!(" ({})", few(failed)) }
}

/// The first of several, and how many there are.
fn few(names: &[String]) -> String {
    match names {
        [first, .., last] => format!("{first} .. {last}: {}", names.len()),
        _ => names.join(""),
    }
}

/// What failed, on one line.
fn in_short(Failure { name, found, .. }: &Failure) -> String {
    let why = found.as_ref().map_or("not found again".to_owned(), |found| found.why.to_string());
    format!("{name}: {why}\n")
}

fn in_full(failure: &Failure) -> String {
    let Failure { name, about, requirements, also, explained_by, scenario, replies, expected, found, .. } =
        failure;
    let explained_by: Vec<String> = explained_by.iter().map(ToString::to_string).collect();
    let mut text = format!(
        "{name}: {about} [{}], also {}, explained by [{}]; {} steps, {} replies, {} expected\n",
        requirements.join(" "),
        few(also),
        explained_by.join(" "),
        scenario.steps.len(),
        replies.len(),
        expected.len()
    );
    for moment in failure.timeline() {
        let changes: Vec<String> =
            moment.changes.iter().map(|(key, value)| format!("{key}={value}")).collect();
        let state = |state: Option<Value>| state.map_or("nothing".to_owned(), |state| state.to_string());
        let _ = writeln!(
            text,
            "  {}-{} at {} ms: {} -> {}, expected {}{}",
            moment.first,
            moment.last,
            moment.time_ms,
            changes.join(" "),
            state(moment.actual),
            state(moment.expected),
            if moment.wrong { ", wrong" } else { "" }
        );
    }
    if let Some(found) = found {
        let differences: Vec<String> = found.differences.iter().map(ToString::to_string).collect();
        let _ = writeln!(
            text,
            "  step {} about {}: {}; {}",
            found.step,
            found.about,
            differences.join(", "),
            found.why
        );
    }
    text
}

/// Mutants of the table, and what a fixed cycle, late outputs and other readings change.
fn mutants() -> String {
    let mut text = String::new();
    for (place, mutation) in Mutation::all(Edition::DEFAULT).enumerate().step_by(15) {
        let cycle_ms = (place % 60 == 30).then_some(50);
        let late = if place % 45 == 15 { 2 } else { 0 };
        let machine = Machine::new(mutation.apply(Edition::DEFAULT), Readings::DEFAULT);
        let program = Erring { late, nothing: place % 90 == 15, ..Erring::new(&machine) };
        let options = ConformOptions { cycle_ms, latency: late, ..by_default() };
        text += &name(&format!("{mutation}, cycle {cycle_ms:?}, {late} late"), program, &options);
    }
    text
}

/// All readings are possible, and the program follows others than usual, or mixes them.
fn readings() -> String {
    let mut text = String::new();
    for reading in Edition::DEFAULT.questions() {
        let choice = Edition::DEFAULT.choices.of_reading(reading).last().expect("each has several");
        let machine = Machine::new(*Edition::DEFAULT, Readings::DEFAULT.with(choice));
        text += &name(&format!("follows {choice}"), Erring::new(&machine), &usual());
    }
    for (place, mutation) in Mutation::all(Edition::DEFAULT).enumerate().skip(2).step_by(61) {
        let choice = if place % 2 == 0 { Choice::FaultEdge } else { Choice::GoEdgeEnough };
        let machine = Machine::new(mutation.apply(Edition::DEFAULT), Readings::DEFAULT.with(choice));
        text += &name(&format!("{mutation}, all readings"), Erring::new(&machine), &usual());
    }
    let mute = |_, _: &Inputs, outputs: &mut Outputs| {
        outputs.remove("go_signal");
    };
    let mute = Erring { tampers: mute, ..Erring::new(&Machine::REFERENCE) };
    text += &name("shows no GO_SIGNAL, so that one question stays open", mute, &usual());
    let pinned = ConformOptions { possible: Choices::ALL.pin(Choice::FaultLevel), ..usual() };
    let edge = Machine::new(*Edition::DEFAULT, Readings::DEFAULT.with(Choice::FaultEdge));
    text += &name("another reading than the one that is pinned", Erring::new(&edge), &pinned);
    let (_, tampers) = TAMPERINGS[6];
    let wrong = Erring { tampers, ..Erring::new(&Machine::REFERENCE) };
    text + &name("nothing is right, and a reading is pinned", wrong, &pinned)
}

/// The keys of what is shown in the default edition.
fn shown() -> impl Iterator<Item = &'static str> {
    SHOWN.iter().filter(|field| field.is_in(Edition::DEFAULT)).map(|field| field.key)
}

/// How outputs can be wrong.
type Tampering = (&'static str, fn(usize, &Inputs, &mut Outputs));

const TAMPERINGS: [Tampering; 11] = [
    ("shows no cause", |_, _, outputs| {
        outputs.remove("shutdown_cause");
    }),
    ("shows the cause in EMERGENCY_BRAKE only", |_, _, outputs| {
        if outputs["as_state"] != "EMERGENCY_BRAKE" {
            outputs.remove("shutdown_cause");
        }
    }),
    ("torque in AS_DRIVING", |_, _, outputs| {
        if outputs["as_state"] == "AS_DRIVING" {
            outputs.insert("front_axle_trq".to_owned(), json!(7));
        }
    }),
    ("another cause", |_, _, outputs| {
        if outputs["as_state"] == "EMERGENCY_BRAKE" {
            outputs.insert("shutdown_cause".to_owned(), json!("BMS FAULT"));
        }
    }),
    ("no brakes in EMERGENCY_BRAKE, and AS_OFF from the sixth step on", |place, _, outputs| {
        if outputs["as_state"] == "EMERGENCY_BRAKE" {
            outputs.insert("hyd_press_f".to_owned(), json!(0));
        }
        if place > 4 {
            outputs.insert("as_state".to_owned(), json!("AS_OFF"));
        }
    }),
    ("AS_FINISHED from the fourth step on", |place, _, outputs| {
        if place > 2 {
            outputs.insert("as_state".to_owned(), json!("AS_FINISHED"));
        }
    }),
    ("never in AS_OFF", |_, _, outputs| {
        if outputs["as_state"] == "AS_OFF" {
            outputs.insert("as_state".to_owned(), json!("AS_READY"));
        }
    }),
    ("every flag is false, and every number 0", |_, _, outputs| {
        for value in outputs.values_mut() {
            match value {
                serde_json::Value::Bool(flag) => *flag = false,
                serde_json::Value::Number(_) => *value = json!(0),
                _ => {}
            }
        }
    }),
    ("leaves out one output after the other", |place, _, outputs| {
        let shown: Vec<&str> = shown().collect();
        outputs.remove(shown[1 + place % (shown.len() - 1)]);
    }),
    ("some flag or other is wrong now and then", |place, inputs, outputs| {
        let flags: Vec<&str> = shown().filter(|&key| outputs[key].is_boolean()).collect();
        // What the edition does not have has no part in it.
        let (inputs, none) =
            (format!("{place} {inputs:?}"), format!("ai_silence: {:?}, ", inputs.ai_silence));
        let chance: usize = inputs.replace(&none, "").bytes().map(usize::from).sum();
        // Not in the first step, which most scenarios have in common.
        for one in
            [chance, chance / 7].map(|chance| flags[chance % flags.len()]).into_iter().filter(|_| place > 0)
        {
            let is = outputs[one].as_bool().expect("a flag");
            outputs.insert(one.to_owned(), json!(!is));
        }
    }),
    ("torque where it is asked for in AS_READY", |_, inputs, outputs| {
        if inputs.ai.drive_f != Inputs::default().ai.drive_f && outputs["as_state"] == "AS_READY" {
            outputs.insert("front_axle_trq".to_owned(), json!(7));
        }
    }),
];

fn steers(outputs: &mut Outputs) {
    outputs.insert("steer".to_owned(), json!(3));
}

fn tampered() -> String {
    let mut text = String::new();
    for (what, tampers) in TAMPERINGS {
        let program = Erring { tampers, ..Erring::new(&Machine::REFERENCE) };
        text += &name(what, program, &by_default());
    }
    let (_, tampers) = TAMPERINGS[9];
    let program = Erring { tampers, ..Erring::new(&Machine::REFERENCE) };
    text += &name(
        "so much is wrong that not all is listed",
        program,
        &ConformOptions { runs: 200, ..by_default() },
    );
    let (_, tampers) = TAMPERINGS[2];
    let no_time = ConformOptions { shrinking: Duration::ZERO, ..by_default() };
    text += &name(
        "no time to shorten anything",
        Erring { tampers, ..Erring::new(&Machine::REFERENCE) },
        &no_time,
    );
    // What is asked for again is those that failed; of five of them it is found again.
    for (what, asked_again) in [("wrong once", 0), ("wrong twice in five scenarios", 5)] {
        let (_, tampers) = TAMPERINGS[3];
        let for_scenarios = tests().len() + asked_again;
        text +=
            &name(what, Erring { tampers, for_scenarios, ..Erring::new(&Machine::REFERENCE) }, &by_default());
    }
    let late = |late, nothing| Erring { late, nothing, ..Erring::new(&Machine::REFERENCE) };
    text += &name("late, and nobody said so", late(1, false), &by_default());
    let (_, tampers) = TAMPERINGS[3];
    let wrong_too = Erring { tampers, ..late(1, false) };
    text += &name("late, and half of it wrong as well", wrong_too, &by_default());
    text += &name(
        "late by one step more than is allowed",
        late(2, false),
        &ConformOptions { latency: 1, ..by_default() },
    );
    text += &name("late by less", late(1, true), &ConformOptions { latency: 3, ..by_default() });
    let steers = Erring { tampers: |_, _, outputs| steers(outputs), ..late(1, false) };
    text += &name("late and wrong", steers, &ConformOptions { latency: 1, ..by_default() });
    text
}

#[test]
fn the_report_on_mutants_is_as_written() {
    expect_file!["written/mutants.txt"].assert_eq(&mutants());
}

#[test]
fn the_report_on_readings_is_as_written() {
    expect_file!["written/readings.txt"].assert_eq(&readings());
}

#[test]
fn the_report_on_wrong_outputs_is_as_written() {
    expect_file!["written/outputs.txt"].assert_eq(&tampered());
}

/// Everything that can be wrong with a program, before the first line and at a step.
fn troubles() -> Vec<ProgramError> {
    let line = || "{\"as_state\":[]}".to_owned();
    let bad = || line().parse::<Answer>().expect_err("a list is no state");
    let limit = Duration::from_millis(2500);
    let work = |phase| {
        let at = ConformProgress { phase, done: 3, all: 10 };
        Some(Work { at, steps: 1234, suite_steps: 5678, runs: 300 })
    };
    let start = |kind: io::ErrorKind| ProgramErrorKind::NoStart(kind.into());
    let whats = [
        start(io::ErrorKind::NotFound),
        start(io::ErrorKind::PermissionDenied),
        start(io::ErrorKind::OutOfMemory),
        ProgramErrorKind::Ended("exit status: 3".to_owned()),
        ProgramErrorKind::Closed,
        ProgramErrorKind::Late(limit, String::new()),
        ProgramErrorKind::Late(limit, "{\"as_st".to_owned()),
        ProgramErrorKind::OutOfTime(limit, None),
        ProgramErrorKind::OutOfTime(limit, work(Phase::Suite)),
        ProgramErrorKind::OutOfTime(limit, work(Phase::Random)),
        ProgramErrorKind::OutOfTime(limit, work(Phase::Shrinking)),
        ProgramErrorKind::TooLong(65_536, "xxxx".to_owned()),
        ProgramErrorKind::NotText("\u{fffd}".to_owned()),
        ProgramErrorKind::NoAnswer(line(), bad()),
        ProgramErrorKind::NoAnswer(" {} ".to_owned(), bad()),
        ProgramErrorKind::NoReset("ready".to_owned(), Some(bad())),
        ProgramErrorKind::NoReset(line(), None),
        ProgramErrorKind::TooMany(line()),
    ];
    let place = |step| SentLine { scenario: "3.1".to_owned(), step, sent: "{\"op\":\"reset\"}".to_owned() };
    let mut step = 0;
    let troubles = whats.into_iter().map(|what| {
        step += 1;
        let stderr = (0..step % 3).map(|line| format!("last words {line}")).collect();
        ProgramError { place: (step % 4 > 0).then(|| Box::new(place(step % 4 - 1))), what, stderr }
    });
    troubles.collect()
}

#[test]
fn the_report_on_program_errors_is_as_written() {
    let text = troubles().iter().fold(String::new(), |mut text, trouble| {
        let _ = writeln!(text, "{trouble}\n= {}\n", trouble.hint());
        text
    });
    expect_file!["written/program_errors.txt"].assert_eq(&text);
}
