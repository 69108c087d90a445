//! What the tests of the readers have in common: a text read, each entry as a line.

use std::io::Cursor;

use adsdv_oracle::candump::{Entries, Entry, write_record};

use super::{Dialect, TextReader};

/// What a text is read to: frames as candump prints them, and what is broken as it is reported.
pub(crate) fn read<D: Dialect>(text: &[u8], dialect: D, interface: &str) -> Vec<String> {
    let mut reader = TextReader::new(Box::new(Cursor::new(text.to_vec())), dialect, interface);
    let mut all = Vec::new();
    while let Some(entry) = reader.next_entry().expect("memory can be read") {
        all.push(match entry {
            Entry::Frame(record) => {
                let mut line = Vec::new();
                write_record(&mut line, &record).expect("it is a frame as any");
                String::from_utf8_lossy(&line).trim_end().to_owned()
            }
            Entry::Dropped(dropped) => panic!("{dropped:?}"),
            Entry::Broken(error) => error.to_string(),
        });
    }
    all
}

/// The same for one line behind a header.
pub(crate) fn read_line<D: Dialect>(header: &str, line: &str, dialect: D, interface: &str) -> Vec<String> {
    read(format!("{header}{line}\n").as_bytes(), dialect, interface)
}

#[test]
fn a_last_line_without_its_end_says_so_and_blank_lines_are_none() {
    let text = "timestamp,arbitration_id,extended,remote,error,dlc,data\n\n \t\r\n1.0,0x520,0,0,0,1,AA==\n2.0,0x520,0,0,0,1,AA==";
    let dialect = crate::csv::Csv;
    let mut reader = TextReader::new(Box::new(Cursor::new(text)), dialect, "can");
    let mut seen = Vec::new();
    while let Some(Entry::Frame(record)) = reader.next_entry().expect("memory can be read") {
        seen.push((record.line, record.terminated));
    }
    assert_eq!((seen, reader.count()), (vec![(4, true), (5, false)], 5));
}

#[test]
fn a_line_that_is_too_long_is_broken_and_costs_itself() {
    let text = format!("{}\n1.0,0x520,0,0,0,1,AA==\n", "1".repeat(1 << 20));
    let read = read(text.as_bytes(), crate::csv::Csv, "can");
    assert_eq!(read.len(), 2);
    assert!(read[0].starts_with("line 1, column 1: found") && read[0].contains("8192"), "{}", read[0]);
    assert_eq!(read[1], "(0000000001.000000) can 520#00");
}
