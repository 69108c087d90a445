//! Programs that misbehave: each gets its error in time, and leaves no process behind.

use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use adsdv_conform::{ConformOptions, ConformReport, Program, ProgramError, Vcu as _, conform};

use crate::programs::{TIMEOUT, example, path, tests};

/// How long a program that hangs is waited for in these tests: on a busy machine it still starts, and answers
/// what comes before.
const SHORT: Duration = Duration::from_secs(2);

fn misbehave(args: &[&str], timeout: Duration) -> Result<ConformReport, ProgramError> {
    example("mutant", args, &ConformOptions { runs: 0, ..ConformOptions::default() }, timeout)
}

/// The text of the error and its hint.
fn trouble(args: &[&str], timeout: Duration) -> String {
    let trouble = misbehave(args, timeout).expect_err("it misbehaves");
    format!("{trouble}\nhint: {}", trouble.hint())
}

fn reports(args: &[&str], expected: &[&str]) {
    let start = Instant::now();
    let said = trouble(args, SHORT);
    for part in expected {
        assert!(said.contains(part), "{args:?}: {part:?} is missing: {said}");
    }
    assert!(said.chars().all(|c| c == '\n' || !c.is_control()), "{said:?}");
    assert!(said.lines().last().is_some_and(|line| line.starts_with("hint: ") && line.len() > 20), "{said}");
    assert!(start.elapsed() < SHORT + Duration::from_secs(20), "{args:?}: {:?}", start.elapsed());
}

const FIRST_STEP: &str = r#"sent      {"op":"step","dt_ms":10,"asms":true,"tsms":true"#;

#[test]
fn programs_that_cannot_be_started() {
    let start = |program: &Path| {
        let program = program.as_os_str().to_owned();
        let started = adsdv_conform::Program::start(&program, &[], SHORT, false);
        let trouble = started.expect_err("it cannot be started");
        format!("{trouble}\nhint: {}", trouble.hint())
    };
    let missing = start(Path::new("no/such/vcu"));
    assert!(
        missing.contains("cannot start the program: ") && missing.contains("hint: check the path"),
        "{missing}"
    );
    let text = temporary("not-a-program");
    fs::write(&text, "hello").expect("it can be written");
    let no_program = start(&text);
    assert!(no_program.contains("cannot start the program: "), "{no_program}");
    #[cfg(unix)]
    assert!(no_program.contains("make it executable"), "{no_program}");
}

#[test]
fn programs_that_end_early() {
    reports(
        &["--exit-at", "2"],
        &[
            "the program ended early (exit status 3); expected an answer",
            "\n  in        3.1, step 1\n",
            FIRST_STEP,
            "\n  stderr    first words\n  stderr    the battery is empty\\u{1b}[2J\n",
        ],
    );
    reports(&["--crash-at", "2"], &["the program ended early (signal 6)", "3.1, step 1", FIRST_STEP]);
    reports(&["--leave"], &["the program ended early (exit status 0)", "the beginning, the reset"]);
    reports(&["--no-such-option"], &["ended early (exit status 1)", "what is --no-such-option?"]);
}

#[test]
fn programs_that_do_not_answer() {
    let hangs = ["no answer within 2 s", "3.1, step 1", FIRST_STEP, "hint: answer every line"];
    let never_reads = ["no answer within 2 s", "the beginning, the reset"];
    let stalls = ["no end of the line within 2 s", "received  {\"as_state\":"];
    // All are waited for at once.
    std::thread::scope(|scope| {
        scope.spawn(|| reports(&["--hang-at", "2"], &hangs));
        scope.spawn(|| reports(&["--no-read"], &never_reads));
        scope.spawn(|| reports(&["--stall-at", "2"], &stalls));
    });
}

/// One that answers, and takes its time for each answer, ends as well.
#[test]
fn programs_that_are_slow() {
    let slow = |options: &ConformOptions, ms: &str, limit: Duration| {
        let args: Vec<OsString> = ["--slow", ms].map(OsString::from).into();
        let start = Instant::now();
        let program = Program::start(&path("mutant").into_os_string(), &args, TIMEOUT, false);
        let mut program = program.expect("it starts").within(limit);
        let judged = conform(&mut program, tests(), options, &mut |_| {});
        assert!(start.elapsed() < limit + Duration::from_secs(20), "{:?}", start.elapsed());
        judged.map_err(|trouble| format!("{trouble}\nhint: {}", trouble.hint()))
    };
    let steps: usize = tests().iter().map(|test| test.scenario.steps.len()).sum();
    let said = slow(&ConformOptions::default(), "150", Duration::from_secs(1)).expect_err("it is slow");
    let reported = |part: &str| assert!(said.contains(part), "{part:?} is missing: {said}");
    reported("not done within the time limit of 1 s: ");
    reported(&format!(" of {} tests (", tests().len()));
    reported(&format!(" of {steps} steps) were done, and 0 of 300 random scenarios"));
    reported("\n  sent      {\"op\":");
    reported("\nhint: raise --time-limit");

    // It is fast, and asked for very much.
    let endless = ConformOptions { runs: u32::MAX, ..ConformOptions::default() };
    let said = slow(&endless, "0", Duration::from_secs(4)).expect_err("that is too much");
    assert!(said.contains("all tests and ") && said.contains(" of 4294967295 random scenarios ("), "{said}");
}

#[test]
fn programs_that_answer_something_else() {
    reports(
        &["--garbage-at", "2"],
        &[
            "not the answer to a step: \"engine started\"",
            "expected a JSON object on one line",
            "3.1, step 1",
            FIRST_STEP,
            "\n  received  engine started\n",
            "standard error",
        ],
    );
    reports(
        &["--garbage-at", "1"],
        &["not the answer to a reset: ", "the beginning, the reset", "received  engine started"],
    );
    reports(&["--list-at", "2"], &["not the answer to a step: ", "received  [1, 2]"]);
    reports(
        &["--unknown-at", "2"],
        &["there is no key \"speed\"; expected one of as_state", "received  {\"as_state\""],
    );
    reports(&["--value-at", "2"], &["\"handshake\" is \"maybe\"; expected true or false"]);
    reports(&["--no-state-at", "2"], &["there is no \"as_state\"; expected at least that"]);
    reports(&["--binary-at", "2"], &["a line that is not UTF-8", "3.1, step 1", "write answers in UTF-8"]);
    reports(&["--long-at", "2"], &["a line of more than 65536 bytes", "received  xxxx", "end every answer"]);
    reports(&["--latency", "1"], &["there is no \"as_state\"", "received  {}", "--latency"]);
    reports(&["--reset", "ok"], &["not the answer to a reset: ", "received  ok", "answer a reset with {}"]);
    reports(&["--reset", r#"{"as_state":1}"#], &["not the answer to a reset: outputs; expected {}"]);
}

#[test]
fn programs_that_answer_too_much_or_too_little() {
    reports(&["--chatty-at", "2"], &["not the answer to a reset: outputs", "answered twice"]);
    let lines: usize = crate::programs::tests().iter().map(|test| test.scenario.steps.len() + 1).sum();
    reports(
        &["--chatty-at", &lines.to_string()],
        &["an answer too many; expected nothing after the last", "received  {"],
    );
    reports(&["--skip-at", &lines.to_string()], &["no answer within 2 s"]);
    reports(
        &["--skip-at", "2"],
        &["not the answer to a step: ", "received  {}", "a line before it was not answered"],
    );
    reports(&["--skip-at", "3"], &["not the answer to a reset: outputs", "received  {\"as_state\""]);
}

#[test]
fn what_does_no_harm_is_no_trouble() {
    let fine =
        |args: &[&str]| misbehave(args, TIMEOUT).unwrap_or_else(|trouble| panic!("{args:?}: {trouble}"));
    // More on standard error than a pipe holds.
    assert!(fine(&["--flood-at", "3"]).conforms());
    assert!(fine(&["--reset", r#"{"ready":true}"#]).conforms());
    let report = fine(&["--no-eof"]);
    assert!(report.conforms());
    assert_eq!(report.notes, ["the program did not end at the end of its input, and was killed"]);
    let report = fine(&["--no-success"]);
    assert!(report.conforms());
    assert_eq!(report.notes, ["at the end of its input the program ended with exit status 3; expected 0"]);
}

/// More than is sent ahead, so that answers make room for what is asked next.
#[test]
fn as_much_can_be_asked_as_there_is_time_for() {
    let shortest = tests().iter().min_by_key(|test| test.scenario.steps.len()).expect("there are tests");
    let asked = vec![(shortest.name.as_str(), &shortest.scenario); 10_000];
    let mut program =
        Program::start(&path("mutant").into_os_string(), &[], TIMEOUT, false).expect("it starts");
    let mut answered = 0;
    let all = program.ask(&asked, &mut |place, replies| {
        assert_eq!((place, replies.len()), (answered, shortest.scenario.steps.len()));
        answered += 1;
    });
    all.expect("it answers");
    assert_eq!(answered, asked.len());
    assert_eq!(program.end().expect("it ends"), [""; 0]);
}

#[test]
fn steps_asked_at_once_are_answered_as_one_by_one_and_trouble_names_its_step() {
    let longest = tests().iter().max_by_key(|test| test.scenario.steps.len()).expect("there are tests");
    let steps = &longest.scenario.steps;
    let start = |args: &[&str]| {
        let args: Vec<OsString> = args.iter().map(OsString::from).collect();
        Program::start(&path("mutant").into_os_string(), &args, TIMEOUT, false).expect("it starts")
    };
    let mut program = start(&[]);
    program.reset().expect("it answers");
    let one_by_one: Result<Vec<_>, _> =
        steps.iter().map(|step| program.step(step.dt_ms, &step.inputs)).collect();
    assert_eq!(program.steps(steps).expect("it answers"), one_by_one.expect("it answers"));
    let trouble = start(&["--garbage-at", "3"]).steps(steps).expect_err("it answers nonsense").to_string();
    assert!(trouble.contains("the diagnosis, step 2"), "{trouble}");
}

#[test]
fn no_process_is_left() {
    let leaves_none = |name: &str, args: &[&str]| {
        let pid = temporary(&format!("pid-{name}"));
        let args = [&["--pid", pid.to_str().expect("text")], args].concat();
        let _ = misbehave(&args, SHORT);
        gone(&pid);
    };
    std::thread::scope(|scope| {
        scope.spawn(|| leaves_none("hang", &["--hang-at", "3"]));
        scope.spawn(|| leaves_none("no-read", &["--no-read"]));
        scope.spawn(|| leaves_none("no-eof", &["--no-eof"]));
        scope.spawn(|| leaves_none("garbage", &["--garbage-at", "2", "--no-eof"]));
        scope.spawn(|| leaves_none("long", &["--long-at", "2"]));
        scope.spawn(|| leaves_none("well", &[]));
    });
}

#[test]
fn what_a_program_has_started_is_killed_with_it() {
    // Each leaves a process that keeps the pipes open: one that ends at once, one that goes on, one that hangs.
    for (name, args) in [("leave", &["--leave"][..]), ("go-on", &[]), ("hang", &["--hang-at", "3"])] {
        let pid = temporary(&format!("grandchild-{name}"));
        let args = [&["--grandchild", pid.to_str().expect("text")], args].concat();
        let start = Instant::now();
        let judged = misbehave(&args, SHORT);
        assert_eq!(judged.is_ok(), name == "go-on", "{name}: {judged:?}");
        assert!(start.elapsed() < Duration::from_secs(20), "{name}: {:?}", start.elapsed());
        gone(&pid);
    }
}

/// Asserts that the process of which a file has the number is no more: at once, or as soon as it has been seen off.
fn gone(file: &Path) {
    let pid = fs::read_to_string(file).expect("the program has written its number");
    let status = PathBuf::from(format!("/proc/{pid}/stat"));
    let start = Instant::now();
    // An orphan that has been killed is a zombie until its new parent looks after it.
    let runs = || fs::read_to_string(&status).is_ok_and(|status| !status.contains(") Z"));
    while runs() {
        assert!(start.elapsed() < Duration::from_secs(5), "{} is still there", file.display());
        std::thread::sleep(Duration::from_millis(10));
    }
}

/// A file for one test. The name has to be the test's own.
fn temporary(name: &str) -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("conform-{name}"))
}
