//! Recordings of more than one car, and of computers that start again on the way.

use super::{check, judged};
use crate::run::{MISSION, file};
use crate::why::{as_is, played};

/// When a line was recorded, in microseconds.
fn time(line: &str) -> u64 {
    let (seconds, rest) = line.trim_start_matches('(').split_once('.').expect("a time");
    let micros = rest.get(..6).expect("six digits");
    seconds.parse::<u64>().expect("seconds") * 1_000_000 + micros.parse::<u64>().expect("microseconds")
}

/// The same line, recorded later.
fn later(line: &str, by: u64) -> String {
    let t = time(line) + by;
    let (_, frame) = line.split_once(' ').expect("a time and a frame");
    format!("({}.{:06}) {frame}", t / 1_000_000, t % 1_000_000)
}

#[test]
pub(super) fn a_recording_of_two_cars() {
    let mission = String::from_utf8(file(MISSION)).expect("text");
    let mut both: Vec<String> =
        mission.lines().flat_map(|line| [line.to_owned(), later(line, 3_001_234)]).collect();
    both.sort_by_key(|line| time(line));
    let outcome = check((both.join("\n") + "\n").as_bytes());
    assert_eq!(outcome.status, Some(1), "{}", outcome.stdout);
    let says = ["violation LOG 2.2 two-senders 520h shows", "record each car by itself"];
    judged(&outcome, 2 * mission.lines().count(), &says);
    assert!(
        !outcome.stdout.contains(" VCU 3."),
        "nobody is blamed for the other's states: {}",
        outcome.stdout
    );
}

/// Two recordings of the same, the one a few milliseconds behind: nothing that 520h shows is of two cars.
#[test]
pub(super) fn a_recording_of_two_cars_that_show_the_same() {
    let mission = String::from_utf8(file(MISSION)).expect("text");
    let mut both: Vec<String> =
        mission.lines().flat_map(|line| [line.to_owned(), later(line, 3_700)]).collect();
    both.sort_by_key(|line| time(line));
    let outcome = check((both.join("\n") + "\n").as_bytes());
    assert_eq!(outcome.status, Some(0), "{}", outcome.stdout);
    let says = [
        "warning LOG 2.2 two-senders 520h came",
        "2.0 times as often as from one VCU",
        "record each car by itself",
    ];
    judged(&outcome, 2 * mission.lines().count(), &says);
}

#[test]
pub(super) fn an_ai_computer_that_restarts() {
    let scenario = "0 ebs ARMED, ami SKIDPAD\n6 tsms on, asms on\nAS_READY +6 go on\nAS_DRIVING +1 end\n";
    let mut first = None;
    let log = played("restarts", scenario, "3.0", |line| {
        let since = time(line) - *first.get_or_insert(time(line));
        let is_ai = line.split(' ').nth(2).is_some_and(|frame| frame.starts_with("51"));
        (!is_ai || !(2_000_000..5_000_000).contains(&since)).then(|| line.to_owned())
    });
    let outcome = check(&log);
    assert_eq!(outcome.status, Some(0), "{}", outcome.stdout);
    assert!(outcome.stdout.contains("AS_READY        -> AS_DRIVING"), "{}", outcome.stdout);
}

#[test]
pub(super) fn a_vcu_that_is_switched_off_and_on() {
    let scenario = "0 ebs ARMED, ami AUTOCROSS\n0.5 tsms on, asms on\nAS_READY +1 asms off, power cycle\nAS_OFF +1 asms on\n\
                    AS_READY +1 end\n";
    let log = played("power-cycle", scenario, "3.0", as_is);
    let outcome = check(&log);
    assert_eq!(outcome.status, Some(0), "{}", outcome.stdout);
    assert!(outcome.stdout.contains("gap"), "{}", outcome.stdout);
}
