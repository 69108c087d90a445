//! Which format a recording has, by how it begins.

use std::fmt;

use adsdv_oracle::text::BYTE_ORDER_MARK;

use crate::{asc, blf, csv, savvycan, trc};

/// How a file of MCAP begins, and ends.
const MCAP: &[u8] = b"\x89MCAP0\r\n";

/// A format that is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Format {
    /// The text of candump (can-utils): of `candump -L`, or as it prints for a person.
    Candump,
    /// The binary log of Vector's tools.
    Blf,
    /// The container that ROS 2 records into.
    Mcap,
    /// The text of Vector's CANalyzer and CANoe, and of programs that write for them.
    Asc,
    /// The text of PEAK's PCAN-View and PCAN-Explorer.
    Trc,
    /// The CSV of python-can.
    Csv,
    /// The CSV of SavvyCAN.
    SavvyCan,
}

impl Format {
    /// Every format.
    pub const ALL: [Self; 7] =
        [Self::Candump, Self::Blf, Self::Mcap, Self::Asc, Self::Trc, Self::Csv, Self::SavvyCan];

    /// Its name, as people know it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Candump => "candump",
            Self::Blf => "Vector BLF",
            Self::Mcap => "MCAP",
            Self::Asc => "Vector ASC",
            Self::Trc => "PEAK TRC",
            Self::Csv => "python-can CSV",
            Self::SavvyCan => "SavvyCAN CSV",
        }
    }

    /// The format of a recording that begins so; that of candump where nothing else fits, since it can say of any text what it is not.
    pub(crate) fn of(head: &[u8]) -> Self {
        let text = head.strip_prefix(BYTE_ORDER_MARK).unwrap_or(head).trim_ascii_start();
        if head.starts_with(blf::MAGIC) {
            Self::Blf
        } else if head.starts_with(MCAP) {
            Self::Mcap
        } else if csv::is(text) {
            Self::Csv
        } else if savvycan::is(text) {
            Self::SavvyCan
        } else if trc::is(text) {
            Self::Trc
        } else if asc::is(text) {
            Self::Asc
        } else {
            Self::Candump
        }
    }
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_recording_is_known_by_how_it_begins() {
        let cases: [(&str, Format); 27] = [
            ("", Format::Candump),
            ("(1795209995.234358) vcan0 520#00\n", Format::Candump),
            (" (000.000000)  vcan0  520   [8]  00 00 01 00 00 00 00 00\n", Format::Candump),
            ("  vcan0  520   [1]  00\n", Format::Candump),
            ("rubbish\n", Format::Candump),
            ("2026-11-25 a day\n", Format::Candump),
            ("1.5\n", Format::Candump),
            ("date of the run\n", Format::Candump),
            ("date Wed Nov 25 13:14:22.123 2026\nbase hex", Format::Asc),
            ("\u{feff}\r\ndate Wed Nov 25 01:14:22.123 pm 2026\n", Format::Asc),
            ("date Mer Nov 25 13:14:22 2026\n", Format::Asc),
            ("Date Wed Foo 25 01:14:22.123 pm 2026\n", Format::Asc),
            ("base hex  timestamps absolute\n", Format::Asc),
            ("no internal events logged\n", Format::Asc),
            ("internal events logged\n", Format::Asc),
            ("// version 9.0.0\n", Format::Asc),
            ("Begin TriggerBlock Wed\n", Format::Asc),
            ("   0.012345 1  520             Rx   d 1 00\n", Format::Asc),
            (";$FILEVERSION=1.1\r\n", Format::Trc),
            ("\n ;####\n", Format::Trc),
            ("timestamp,arbitration_id,extended,remote,error,dlc,data\n", Format::Csv),
            ("timestamp,arbitration_id,extended,remote,error,dlc,data", Format::Csv),
            ("timestamp,id,data\n", Format::Candump),
            ("Time Stamp,ID,Extended,Dir,Bus,LEN,D1,D2,D3,D4,D5,D6,D7,D8\n1,", Format::SavvyCan),
            ("\u{feff}time stamp, id, extended, bus, len\r\n", Format::SavvyCan),
            ("Time Stamp,ID,Data\n", Format::Candump),
            ("// a comment\n", Format::Candump),
        ];
        for (head, format) in cases {
            assert_eq!(Format::of(head.as_bytes()), format, "{head}");
            assert!(Format::ALL.contains(&format), "Format::ALL lacks {format}");
        }
        for format in Format::ALL.into_iter().filter(|format| !matches!(format, Format::Blf | Format::Mcap)) {
            let has_example = cases.iter().any(|(_, known)| *known == format);
            assert!(has_example, "the cases above have no beginning of {format}");
        }
    }

    #[test]
    fn every_format_has_a_name_of_its_own() {
        let mut names = Format::ALL.map(|format| format.to_string());
        names.sort();
        assert!(names.iter().zip(names.iter().skip(1)).all(|(one, next)| one != next));
    }

    #[test]
    fn every_format_has_a_row_in_the_documents() {
        let page = include_str!("../../docs/formats.md");
        for format in Format::ALL {
            let rows = page.lines().filter(|line| line.starts_with(&format!("| {format} |")));
            assert_eq!(
                rows.count(),
                1,
                "docs/formats.md has one row of {format}: who writes it, what is read, what not"
            );
        }
    }

    #[test]
    fn every_format_is_named_in_each_sentence_that_names_them() {
        let texts = [
            ("cli/src/args.rs", include_str!("../../cli/src/args.rs")),
            ("web/src/error.rs", include_str!("../../web/src/error.rs")),
            ("python/src/check.rs", include_str!("../../python/src/check.rs")),
            ("docs/first-log.md", include_str!("../../docs/first-log.md")),
        ];
        for format in Format::ALL {
            // There are several of CSV, each known by the program; of the others the last word is enough.
            let word = match format.name().split_once(' ') {
                Some((program, "CSV")) => program,
                Some((_, last)) => last,
                None => format.name(),
            };
            for (file, text) in texts {
                assert!(text.contains(word), "{file} names the formats that are read, and not {format}");
            }
        }
    }
}
