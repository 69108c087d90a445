//! The table of docs/bad-input.md and these tests: each row has tests, and each condition has a row.

use std::thread;

use super::{bus, cars, exam, given, kept, log, long_line, output, required, rules};
use crate::run::file;

/// A row: the condition, the commands, the tests here with their names, and the names of those on SocketCAN, which are in
/// `can/tests/socket/command.rs`.
type Row = (&'static str, &'static str, &'static [(&'static str, fn())], &'static [&'static str]);

/// Tests with their names.
macro_rules! tests {
    ($($file:ident::$test:ident),* $(,)?) => {
        &[$((concat!(stringify!($file), "::", stringify!($test)), $file::$test)),*]
    };
}

/// The conditions, in the order of the table.
const CONDITIONS: [&str; 19] = [
    "a missing file",
    "a directory",
    "an empty file",
    "standard input twice",
    "binary rubbish",
    "a truncated log",
    "a 1 GB line",
    "timestamps that go backwards or are absent",
    "a recording of two cars",
    "an AI Computer that restarts",
    "a VCU that is switched off and on",
    "an interface that vanishes",
    "a closed pipe",
    "a full disk",
    "a log without what is required",
    "a requirement that no log can show",
    "rules that are none",
    "a program that cannot be examined",
    "an answer in the place of what is read",
];

/// The rows, and what shows that each is as the table has it.
const ROWS: &[Row] = &[
    ("a missing file", "`check`, `compare`, `conform`, `demo`, `vcu`", tests![given::a_missing_file], &[]),
    (
        "a missing file",
        "the folder of `demo --log`, `verify --logs`, `watch --log`",
        tests![given::a_missing_folder_for_what_is_written],
        &["a_log_that_cannot_be_made_is_reported"],
    ),
    (
        "a directory",
        "`compare`, `conform`, `demo`, `vcu`, `watch --log`",
        tests![given::a_directory],
        &["a_log_that_cannot_be_made_is_reported"],
    ),
    ("a directory", "`check`", tests![given::a_directory], &[]),
    ("a directory", "`check --html`", tests![output::a_page_that_has_no_place], &[]),
    (
        "an empty file",
        "`check`, `compare`, `conform`, `demo`, `vcu`",
        tests![given::an_empty_file, output::a_standard_input_that_is_closed_is_empty],
        &[],
    ),
    ("standard input twice", "`compare`", tests![given::standard_input_for_both_logs], &[]),
    (
        "binary rubbish",
        "`check`, `compare`",
        tests![
            log::rubbish_in_the_middle,
            log::a_comparison_with_a_broken_log,
            given::binary_rubbish,
            given::logs_in_another_wrapping
        ],
        &[],
    ),
    (
        "binary rubbish",
        "`conform`, `demo`, `vcu`",
        tests![
            given::binary_rubbish,
            given::a_program_that_answers_rubbish,
            given::rubbish_between_good_lines
        ],
        &[],
    ),
    (
        "a truncated log",
        "`check`, `compare`",
        tests![
            log::a_truncated_log,
            log::a_log_that_fails_while_it_is_read,
            log::a_comparison_with_a_broken_log
        ],
        &[],
    ),
    (
        "a truncated log",
        "`check`, of any format, compressed or not",
        tests![given::a_recording_of_any_format_that_was_cut_off],
        &[],
    ),
    (
        "a 1 GB line",
        "`check`, `compare`",
        tests![long_line::in_a_log, long_line::in_a_log_that_is_compared],
        &[],
    ),
    (
        "a 1 GB line",
        "`conform`, `demo`, `vcu`",
        tests![
            long_line::in_a_scenario,
            long_line::in_a_suite,
            long_line::a_suite_of_bad_lines,
            long_line::of_a_program,
        ],
        &[],
    ),
    (
        "timestamps that go backwards or are absent",
        "`check`, `compare`",
        tests![log::a_comparison_with_a_broken_log, log::times_that_go_backwards, log::times_that_are_absent],
        &[],
    ),
    (
        "a recording of two cars",
        "`check`, `watch`",
        tests![cars::a_recording_of_two_cars, cars::a_recording_of_two_cars_that_show_the_same],
        &[],
    ),
    ("an AI Computer that restarts", "`check`, `watch`", tests![cars::an_ai_computer_that_restarts], &[]),
    (
        "a VCU that is switched off and on",
        "`check`, `watch`",
        tests![cars::a_vcu_that_is_switched_off_and_on],
        &[],
    ),
    (
        "an interface that vanishes",
        "`ai`, `vcu`",
        &[],
        &["an_interface_that_vanishes_is_reported_and_waited_for"],
    ),
    (
        "an interface that vanishes",
        "`watch`",
        &[],
        &["an_interface_that_vanishes_is_reported_and_waited_for"],
    ),
    (
        "an interface that vanishes",
        "`ai`, `vcu`, `watch`, which find none",
        tests![bus::an_interface_that_is_not_there],
        &["what_cannot_be_opened_is_reported"],
    ),
    (
        "a closed pipe",
        "all that end by themselves",
        tests![
            output::no_command_is_left_out,
            output::a_closed_pipe,
            output::a_pipe_that_is_closed_after_a_line,
            output::a_standard_output_that_is_closed,
        ],
        &[],
    ),
    (
        "a closed pipe",
        "the screen of `demo` and `vcu`, when its terminal is closed",
        tests![output::a_terminal_that_is_closed],
        &[],
    ),
    ("a closed pipe", "`ai`, `vcu --plain`, `watch`", &[], &["a_closed_pipe_ends_each_in_order"]),
    (
        "a full disk",
        "all but `explore` and `web`, for what they print",
        tests![output::no_command_is_left_out, output::a_full_disk, output::a_full_disk_for_errors],
        &["a_full_disk_for_what_is_printed_is_reported"],
    ),
    ("a full disk", "`demo --log`", tests![output::a_full_disk_for_the_log_of_a_demo], &[]),
    ("a full disk", "`decode --format parquet`", tests![output::a_full_disk_for_a_table], &[]),
    ("a full disk", "`check --excerpt`", tests![output::excerpts_that_cannot_be_written], &[]),
    ("a full disk", "`check --html`", tests![output::a_full_disk_for_a_page], &[]),
    ("a full disk", "`verify --logs`", tests![output::a_full_disk_for_counterexamples], &[]),
    ("a full disk", "`watch --log`", &[], &["a_full_disk_is_reported_and_watching_goes_on"]),
    (
        "a full disk",
        "`explore`, `web`",
        tests![
            output::an_explorer_that_cannot_print_its_address,
            output::a_page_that_cannot_print_its_address
        ],
        &[],
    ),
    (
        "a log without what is required",
        "`check --require`",
        tests![
            required::a_log_that_does_not_show_what_is_required,
            required::what_is_required_stands_in_the_json
        ],
        &[],
    ),
    ("a requirement that no log can show", "`check --require`", tests![required::what_no_log_can_show], &[]),
    (
        "rules that are none",
        "`check --rules`, `watch --rules`",
        tests![
            rules::rules_that_are_wrong,
            rules::rules_that_are_not_there,
            rules::rules_of_another_edition_than_the_log_speaks
        ],
        &[],
    ),
    (
        "a program that cannot be examined",
        "`exam`",
        tests![exam::a_program_that_cannot_be_examined, exam::logs_of_an_exam_that_cannot_be_written],
        &[],
    ),
    (
        "an answer in the place of what is read",
        "`check --html`, `--junit` and `--summary`; `decode --output` and `--layout`",
        tests![kept::an_answer_in_the_place_of_the_recording, kept::an_answer_in_the_place_of_a_database],
        &[],
    ),
    (
        "an answer in the place of what is read",
        "`--html` of `check`, `conform`, `exam` and `verify`",
        tests![kept::a_page_in_the_place_of_something_else],
        &[],
    ),
    (
        "a closed pipe",
        "`explore`, `web`",
        tests![
            output::an_explorer_that_cannot_print_its_address,
            output::a_page_that_cannot_print_its_address
        ],
        &[],
    ),
];

/// The rows of the table: the condition, the commands, what happens and the exit status.
fn table(page: &str) -> Vec<Vec<&str>> {
    let rows = page.lines().filter_map(|line| line.strip_prefix("| ")?.strip_suffix(" |"));
    rows.skip(1).map(|row| row.split(" | ").map(str::trim).collect()).collect()
}

/// Asserts that a command may end so in the test that runs at present: that the table says so in a row that has this test.
#[track_caller]
pub(super) fn may_end_with(status: i32) {
    let thread = thread::current();
    let name = thread.name().unwrap_or_default();
    // With one thread for all of them, the tests have no names.
    if name == "main" {
        return;
    }
    let (_, test) =
        name.split_once("bad_input::").unwrap_or_else(|| panic!("{name} is a test of this folder"));
    let page = String::from_utf8(file("docs/bad-input.md")).expect("text");
    let rows = ROWS.iter().filter(|(.., tests, _)| tests.iter().any(|(name, _)| *name == test));
    let rows: Vec<_> = rows.map(|&(condition, commands, ..)| (condition, commands)).collect();
    let table = table(&page);
    let said: Vec<&str> =
        table.iter().filter(|row| rows.contains(&(row[0], row[1]))).map(|row| row[3]).collect();
    assert!(
        said.iter().any(|said| said.contains(&status.to_string())),
        "{test}: exit status {status}, and the table says {said:?}"
    );
}

#[test]
fn each_row_of_the_table_has_its_tests() {
    let page = String::from_utf8(file("docs/bad-input.md")).expect("text");
    let rows = table(&page);
    let mut shown: Vec<_> = rows.iter().map(|row| (row[0], row[1])).collect();
    let mut tested: Vec<_> = ROWS.iter().map(|&(condition, commands, ..)| (condition, commands)).collect();
    shown.sort_unstable();
    tested.sort_unstable();
    assert_eq!(shown, tested);
    let mut conditions: Vec<_> = rows.iter().map(|row| row[0]).collect();
    conditions.dedup();
    assert_eq!(conditions, CONDITIONS);
    for row in &rows {
        let [_, _, happens, status] = row[..] else { panic!("{row:?} has not four cells") };
        assert!(!happens.is_empty() && status.chars().any(|c| c.is_ascii_digit() || c == '-'), "{row:?}");
    }
}

#[test]
fn each_row_has_a_test_that_is_there() {
    let socket = String::from_utf8(file("can/tests/socket/command.rs")).expect("text");
    for (condition, commands, tests, on_socketcan) in ROWS {
        assert!(tests.len() + on_socketcan.len() > 0, "{condition}, {commands}: no test");
        for test in *on_socketcan {
            assert!(
                socket.contains(&format!("(\"command::{test}\", ")),
                "{test} is not in can/tests/socket/command.rs"
            );
        }
    }
}
