//! What a program says of itself: its inputs, its outputs, its cycle, its clock.

use std::time::{Duration, Instant};

use adsdv_conform::{ConformOptions, ConformReport, ProgramError};
use adsdv_spec::Edition;

use crate::programs::{TIMEOUT, example, tests};

fn judged(args: &[&str], options: &ConformOptions) -> Result<ConformReport, ProgramError> {
    example("mutant", args, options, TIMEOUT)
}

fn some() -> ConformOptions {
    ConformOptions { runs: 20, ..ConformOptions::default() }
}

#[test]
fn a_cycle_that_a_program_tells_is_the_one_at_which_it_is_asked() {
    let report = judged(&["--about", r#"{"cycle_ms":50}"#], &some()).expect("it answers");
    assert!(report.conforms() && report.cycle_ms == Some(50) && !report.not_run.is_empty());
    let asked = ConformOptions { cycle_ms: Some(20), runs: 0, ..some() };
    let report = judged(&["--about", r#"{"cycle_ms":50}"#], &asked).expect("it answers");
    assert_eq!(report.cycle_ms, Some(20), "what is asked for comes first");
}

#[test]
fn an_input_that_a_program_does_not_have_is_never_given() {
    let keys = r#"["asms","tsms","go","ami","ebs","handshake","estop_request","mission_status","direction_request"]"#;
    let about = format!("{{\"inputs\":{keys},\"outputs\":[\"as_state\",\"go_signal\"]}}");
    let args = ["--about", about.as_str(), "--only", "as_state"];
    let report = judged(&args, &some()).expect("it answers");
    assert!(report.conforms(), "{:?}", report.failures);
    let needs = |name: &str| report.not_run.iter().any(|left_out| left_out == name);
    assert!(needs("3.5-sdc-open") && !needs("3.6"), "{:?}", report.not_run);
    assert_eq!(report.tests + report.not_run.len(), tests().len());
    assert!(
        report.notes.iter().any(|note| note.contains("never shows them: go_signal")),
        "{:?}",
        report.notes
    );
}

#[test]
fn what_a_program_says_of_itself_may_stand_before_or_in_the_answer_to_a_hello() {
    let edition = Edition::find("4.0").expect("an edition");
    let options = ConformOptions { runs: 0, ..ConformOptions::of(edition) };
    for args in [
        ["--edition", "4.0", "--about", r#"{"cycle_ms":50}"#],
        ["--edition", "4.0", "--hello", r#"{"edition":"4.0","cycle_ms":50}"#],
    ] {
        let report = judged(&args, &options).expect("it answers");
        assert!(report.conforms() && report.cycle_ms == Some(50), "{args:?}");
    }
}

#[test]
fn what_cannot_be_so_is_an_error_that_says_what_is_expected() {
    let error = judged(&["--about", r#"{"cycle_ms":-1}"#], &some()).expect_err("no such cycle").to_string();
    assert!(error.contains("\"cycle_ms\" is -1; expected a whole number from 1 to 1000"), "{error}");
}

/// Each step takes the time that it says: as many tests as there is time for, those first that tell most.
#[test]
fn a_program_on_a_wall_clock_is_judged_in_the_time_that_there_is() {
    let options = ConformOptions { wall_time: Duration::from_secs(6), ..some() };
    let args = ["--about", r#"{"clock":"wall"}"#, "--clock"];
    let report = judged(&args, &options).expect("it answers");
    assert!(report.tests > 20 && report.runs == 0, "{} tests", report.tests);
    assert!(report.conforms(), "{:?}", report.failures.iter().map(|one| &one.name).collect::<Vec<_>>());
    // A busy computer lets it wait now and then.
    let waits: Vec<String> =
        (1..60).flat_map(|n| ["--pause-at".to_owned(), (n * 17 + 8).to_string()]).collect();
    let waiting: Vec<&str> = args.iter().copied().chain(waits.iter().map(String::as_str)).collect();
    let report = judged(&waiting, &options).expect("it answers");
    assert!(report.conforms(), "{:?}", report.failures.iter().map(|one| &one.name).collect::<Vec<_>>());
    let wrong = judged(&[&args[..], &["--mutation", "3.6: dropped"]].concat(), &options).expect("it answers");
    assert!(!wrong.conforms());
}

/// Those that failed are asked again only as far as there is time.
#[test]
fn a_program_on_a_wall_clock_that_fails_many_tests_is_judged_in_the_same_time() {
    let options = ConformOptions { wall_time: Duration::from_secs(4), ..some() };
    let args = ["--about", r#"{"clock":"wall"}"#, "--clock", "--mutation", "3.1: dropped"];
    let start = Instant::now();
    let report = judged(&args, &options).expect("it answers");
    let (failed, tests_run) = (report.failed_tests, report.tests);
    assert!(failed > 20, "{failed} of {tests_run}: too few to tell whether they are asked again");
    assert_eq!(report.tests + report.not_run.len(), tests().len());
    assert!(start.elapsed() < options.wall_time + Duration::from_millis(1500), "{:?}", start.elapsed());
}
