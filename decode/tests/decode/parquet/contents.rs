//! Each table, cell by cell.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use adsdv_decode::Table;
use parquet::record::Field;

use super::{cell, field, logs, messages, number, rows, table, text, time};
use crate::frames::{Format, decode};

#[test]
fn a_row_of_signals_is_a_row_of_csv() {
    for (name, log, catalog) in logs() {
        let (csv, ..) = decode(&log, &catalog, Format::Csv);
        let rows = rows(&format!("signals-{name}"), &table(&log, &catalog, Table::Signals));
        assert_eq!(rows.len(), csv.lines().count() - 1, "{name}");
        for (row, line) in rows.iter().zip(csv.lines().skip(1)) {
            let ours = |column| cell(row, column);
            let theirs: Vec<_> = line.split(',').collect();
            let [at, interface, id, message, signal, value, unit, named] = theirs[..] else {
                panic!("{line}")
            };
            let head = [time(row), ours("interface"), ours("id"), ours("signal"), ours("unit")];
            assert_eq!(head, [at, interface, id, signal, unit], "{name}: {line}");
            let special = ["remote frame", "error frame", "CAN XL frame"].contains(&message);
            assert_eq!(if special { ours("kind") } else { ours("message") }, message, "{name}: {line}");
            if signal.is_empty() {
                assert_eq!((ours("data").as_str(), ours("value").as_str()), (named, ""), "{name}: {line}");
                continue;
            }
            assert_eq!((ours("name").as_str(), field(row, "data")), (named, &Field::Null), "{name}: {line}");
            assert_eq!(number(&ours("value")), number(value), "{name}: {line}");
            // An integer that is not that of its double is there as a decimal, digit by digit.
            let exact = value.parse::<i128>().ok().filter(|exact| {
                #[expect(clippy::cast_possible_truncation, reason = "that is what is looked for")]
                let double = number(value).expect("a number") as i128;
                double != *exact
            });
            assert_eq!(
                ours("exact"),
                exact.map(|exact| exact.to_string()).unwrap_or_default(),
                "{name}: {line}"
            );
        }
    }
}

#[test]
fn what_no_double_is_has_a_decimal_and_floats_that_are_no_numbers_stay() {
    let (_, log, catalog) = logs().pop().expect("the nasty one");
    let rows = rows("nasty", &table(&log, &catalog, Table::Signals));
    let exact: Vec<_> = rows.iter().map(|row| cell(row, "exact")).filter(|text| !text.is_empty()).collect();
    assert_eq!(exact, ["55340232221128654844", "-4611686018427387903", "-4611686018427387903"]);
    let of_double = rows.iter().filter(|row| cell(row, "signal") == "Double");
    let values: Vec<_> = of_double.map(|row| cell(row, "value")).collect();
    assert_eq!(values, ["inf", "NaN", "0.1"]);
}

#[test]
fn a_row_of_frames_is_the_frame() {
    for (name, log, catalog) in logs() {
        let (text, ..) = decode(&log, &catalog, Format::SingleLine);
        let rows = rows(&format!("frames-{name}"), &table(&log, &catalog, Table::Frames));
        let frames = || text.lines().filter(|line| !line.starts_with("DROPCOUNT"));
        assert_eq!(rows.len(), frames().count(), "{name}");
        for (row, line) in rows.iter().zip(frames()) {
            let ours = |column| cell(row, column);
            let (frame, decoded) = line.split_once(" :: ").expect("a decoded line");
            let (seconds, micros) =
                time(row).split_once('.').map(|(a, b)| (a.to_owned(), b.to_owned())).expect("a point");
            let (sign, seconds) =
                seconds.strip_prefix('-').map_or(("", seconds.as_str()), |seconds| ("-", seconds));
            let mut line = format!("({sign}{seconds:0>10}.{micros}) {} ", ours("interface"));
            let extended = *field(row, "extended") == Field::Bool(true);
            assert_eq!(extended, ours("id").len() == 8, "{frame}");
            let (id, data) = (ours("id"), ours("data"));
            let _ = match ours("kind").as_str() {
                "CAN" => write!(line, "{id}#{data}"),
                "CAN FD" => write!(line, "{id}##{:X}{data}", ours("flags").parse::<u8>().expect("flags")),
                "remote frame" => write!(line, "{id}#R{}", ours("length")),
                // As candump has them: with the bit that says so.
                "error frame" => write!(line, "2{}#{data}", &id[1..]),
                other => panic!("{other}"),
            };
            let _ = match ours("direction").as_str() {
                "" => Ok(()),
                "rx" => write!(line, " R"),
                "tx" => write!(line, " T"),
                other => panic!("{other}"),
            };
            assert_eq!(line, frame, "{name}");
            if ours("kind") != "remote frame" {
                assert_eq!(ours("length"), (data.len() / 2).to_string(), "{frame}");
            }
            let message = decoded.split_once('(').map_or("", |(message, _)| message);
            assert_eq!(ours("message"), if message.contains(' ') { "" } else { message }, "{frame}");
        }
    }
}

/// The rows of a message's table, a row for each cell that is no null, as those of CSV.
fn long(name: &str, file: &[u8], signals: &[String]) -> Vec<String> {
    let mut long = Vec::new();
    for row in rows(name, file) {
        for (column, cell) in row.get_column_iter() {
            let Some(signal) =
                signals.iter().find(|signal| *signal == column || format!("{signal}_2") == *column)
            else {
                continue;
            };
            if *cell == Field::Null {
                continue;
            }
            let named = row.get_column_iter().find(|(other, _)| **other == format!("{column}_name"));
            let named = named.map(|(_, name)| text(name)).unwrap_or_default();
            let value = number(&text(cell));
            if column != "time" {
                long.push(format!(
                    "{},{},{signal},{value:?},{named}",
                    time(&row),
                    text(field(&row, "interface"))
                ));
            }
        }
    }
    long
}

#[test]
fn the_tables_of_messages_have_every_signal() {
    for (name, log, catalog) in logs() {
        let (csv, ..) = decode(&log, &catalog, Format::Csv);
        let mut expected: BTreeMap<&str, Vec<String>> = BTreeMap::new();
        for line in csv.lines().skip(1) {
            let cells: Vec<_> = line.split(',').collect();
            let [at, interface, _, message, signal, value, _, named] = cells[..] else { panic!("{line}") };
            let rows = expected.entry(message).or_default();
            if !signal.is_empty() {
                rows.push(format!("{at},{interface},{signal},{:?},{named}", number(value)));
            }
        }
        let mut files = messages(&log, &catalog);
        let unknown = files.remove("unknown_frames.parquet");
        assert_eq!(unknown.is_some(), expected.remove("").is_some(), "{name}");
        expected.retain(|message, _| !message.ends_with(" frame"));
        assert_eq!(files.len(), expected.len(), "{name}");
        for (message, lines) in expected {
            let file = if message == "nasty" { "nasty_002".to_owned() } else { message.to_owned() };
            let of_message = catalog.named(message).expect("a message");
            let signals: Vec<_> = of_message.signals.iter().map(|signal| signal.name.to_string()).collect();
            let bytes = &files[&format!("{file}.parquet")];
            assert!(long(&format!("{name}-{file}"), bytes, &signals) == lines, "{name}: {message}");
        }
    }
}
