//! The reader of the test suite, by every edition.

use adsdv_conform::suite;
use adsdv_spec::{Edition, Machine};

/// The body.
pub fn body(bytes: &[u8]) {
    for &edition in Edition::ALL {
        read_by(&Machine::new(*edition, edition.readings), bytes);
    }
}

fn read_by(machine: &Machine, bytes: &[u8]) {
    let read = suite::read(bytes, machine).expect("memory can be read");
    let lines: Vec<&[u8]> = bytes.split_inclusive(|&byte| byte == b'\n').collect();
    let blank = |line: &&&[u8]| std::str::from_utf8(line).is_ok_and(|line| line.trim().is_empty());
    let bad = read.bad.len() as u64 + read.more_bad;
    let counted = read.tests.len() as u64 + bad + lines.iter().filter(blank).count() as u64;
    assert_eq!(counted, lines.len() as u64, "each line is a test, wrong, or blank");
    assert!(read.bad.is_sorted_by_key(|bad| bad.line));
    for bad in &read.bad {
        let text = bad.to_string();
        assert!(!text.contains(|c: char| c.is_control()), "{text:?}");
    }
    if read.tests.is_empty() {
        return;
    }
    let written: Vec<String> = read.tests.iter().map(|test| test.to_line(machine)).collect();
    let again = suite::read(written.join("\n").as_bytes(), machine).expect("memory can be read");
    assert!(again.bad.is_empty(), "{:?}", again.bad);
    assert_eq!(again.tests, read.tests);
}
