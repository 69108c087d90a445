use super::*;
use crate::text::tests::{read, read_line};

const V1_1: &str = ";$FILEVERSION=1.1\n";
const V1_3: &str = ";$FILEVERSION=1.3\n";
const V2_0: &str = ";$FILEVERSION=2.0\n;$COLUMNS=N,O,T,I,d,l,D\n";
const V2_1: &str = ";$FILEVERSION=2.1\n;$COLUMNS=N,O,T,B,I,d,R,L,D\n";

#[test]
fn frames_of_every_version_are_read() {
    for (header, line, frame) in [
        ("", "     1)      1841      520 3 00 00 01 ", "(0000000001.841000) 1 520#000001"),
        ("", "     1)      1841     0520  3  00 00 01 ", "(0000000001.841000) 1 520#000001"),
        (";\n; a comment\n", "     2)   1841 18FF50E5 2 RTR", "(0000000001.841000) 1 18FF50E5#R2"),
        (";$FILEVERSION=1.0\n", "     2)   1841 0000520 0 ", "(0000000001.841000) 1 00000520#"),
        (V1_1, "     1)      1841.7  Rx         0520  3  00 00 01 ", "(0000000001.841700) 1 520#000001 R"),
        (V1_1, "     2)      1842.2  Tx     18FF50E5  8  RTR ", "(0000000001.842200) 1 18FF50E5#R8 T"),
        (V1_1, "     3)      1842.8  Error      0008  4  00 19 08 08 ", "(0000000001.842800) 1 20000000#"),
        (
            ";$FILEVERSION=1.2\n",
            "     1)      1059.900 3  Rx         0300  7  00 00 00 00 04 00 00 ",
            "(0000000001.059900) 3 300#00000000040000 R",
        ),
        (V1_3, "     1)      1059.900 2  Tx         0300 -  2    00 04 ", "(0000000001.059900) 2 300#0004 T"),
        (V1_3, "     1)      1059.900 1  Rx         0300 -  4    RTR", "(0000000001.059900) 1 300#R4 R"),
        (
            V1_3,
            "     1)      1059.900 2  Error      0008 -  4    00 19 08 08",
            "(0000000001.059900) 2 20000000#",
        ),
        (
            V2_0,
            "      1      1059.900 DT     0300 Rx 7  00 00 00 00 04 00 00 ",
            "(0000000001.059900) 1 300#00000000040000 R",
        ),
        (
            V2_0,
            "      2      1059.900 FB 18FF50E5 Tx 9  00 01 02 03 04 05 06 07 08",
            "(0000000001.059900) 1 18FF50E5##1000102030405060708 T",
        ),
        (V2_0, "      3      1059.900 RR     0100 Rx 3  ", "(0000000001.059900) 1 100#R3 R"),
        (V2_0, "      4      1059.900 ER          Rx 5  04 00 02 00 00", "(0000000001.059900) 1 20000000# R"),
        (
            V2_1,
            "      1         0.000 DT  1     0520 Rx -  3    00 00 01",
            "(0000000000.000000) 1 520#000001 R",
        ),
        (
            V2_1,
            "      2    123456.789 FD 12     0520 Tx -  9    00 01 02 03 04 05 06 07 08 09 0A 0B",
            "(0000000123.456789) 12 520##0000102030405060708090A0B T",
        ),
        (V2_1, "      3         0.001 FE  2     0520 Rx -  0", "(0000000000.000001) 2 520##3 R"),
        (V2_1, "      4         0.001 BI  2     0520 Rx -  1 AA", "(0000000000.000001) 2 520##2AA R"),
        (
            V2_1,
            "      5         0.001 DT  2     0520 Rx - 12 00 01 02 03 04 05 06 07",
            "(0000000000.000001) 2 520#0001020304050607 R",
        ),
        (V2_1, "      6         0.001 RR  2 18FF50E5 Tx -  8", "(0000000000.000001) 2 18FF50E5#R8 T"),
        (
            V2_1,
            "      7         0.001 ER  2        - Rx -  5    04 00 02 00 00",
            "(0000000000.000001) 2 20000000# R",
        ),
        (
            ";$FILEVERSION=2.1\n;$COLUMNS=N,O,S,T,I,d,L,D\n",
            "1 0.001 any DT 0520 Rx 1 AA",
            "(0000000000.000001) 1 520#AA R",
        ),
        (";$FILEVERSION = 2.0 \r\n", "1 0.001 DT 0520 Rx 1 AA\r", "(0000000000.000001) 1 520#AA R"),
        // Where such files are cut, they are joined as well.
        (&format!("{V2_1}{V1_1}"), "1) 1 Rx 0520 1 AA", "(0000000000.001000) 1 520#AA R"),
    ] {
        let read = read_line(header, line, Trc::new(), "1");
        assert_eq!(read, [frame], "{header}{line}");
    }
}

#[test]
fn the_start_is_that_of_the_header() {
    for (header, time) in [
        (";$STARTTIME=25569.5\n", "(0000043200.001000)"),
        (";$FILEVERSION=1.1\n;$STARTTIME=42209.4075997106\n", "(1437731216.615995840)"),
        (";$STARTTIME=25569.5\n;$FILEVERSION=1.1\n", "(0000000000.001000)"),
    ] {
        let line = if header.contains("1.1") { "1) 1 Rx 0520 0" } else { "1) 1 0520 0" };
        let read = read_line(header, line, Trc::new(), "1");
        assert!(read[0].starts_with(time), "{header}: {read:?}");
    }
}

#[test]
fn what_is_no_frame_but_belongs_there_is_passed_over() {
    for (header, line) in [
        ("", ";##########"),
        ("", "  ;---+--   ----+----"),
        ("", "     5)   1841 FFFFFFFF 4  00 00 00 08 -- BUSHEAVY"),
        (V1_1, "     7)      1843.0  Warng  FFFFFFFF  4  00 00 00 08  BUSHEAVY"),
        (V1_3, "     7)      1843.0 1  Warng  FFFFFFFF -  4  00 00 00 08  BUSHEAVY"),
        (V2_0, "      7      1323.201 ST          Rx    00 00 00 08"),
        (V2_0, "      8      1352.000 EV User-defined event for Testing"),
        (V2_1, "      9      1334.416 EC  1        - Rx -  2    02 02"),
    ] {
        assert_eq!(read_line(header, line, Trc::new(), "1"), [""; 0], "{header}{line}");
    }
}

#[test]
fn other_lines_are_refused_where_they_go_wrong() {
    const TYPE: &str =
        "Rx, Tx, Error or Warng, or from version 2.0 on DT, FD, FB, FE, BI, RR, ER, ST, EC or EV";
    for (header, line, column, expected) in [
        ("", ";$FILEVERSION=3.0", 15, VERSION),
        ("", ";$FILEVERSION", 14, VERSION),
        ("", ";$STARTTIME=today", 13, START),
        ("", ";$COLUMNS=N,O,T", 11, COLUMNS),
        ("", ";$COLUMNS=N,O,T,I,d,D,l", 11, COLUMNS),
        ("", ";$COLUMNS=N,O,I,L,T,D", 11, COLUMNS),
        ("", ";$COLUMNS=N,O,T,I,?,l,D", 11, COLUMNS),
        ("", "rubbish", 1, NUMBER),
        ("", "1)", 3, OFFSET),
        ("", "1) 18x 0520 0", 4, OFFSET),
        ("", "1) 9223372036855 0520 0", 4, OFFSET),
        (V1_1, "1) 1.0 0520 0", 8, TYPE),
        (V1_1, "1) 1.0 DR 0520 0", 8, TYPE),
        (V1_1, "1) 1.0 Rx", 10, ID),
        (V1_1, "1) 1.0 Rx 0800 0", 11, ID),
        (V1_1, "1) 1.0 Rx 20000000 0", 11, ID),
        (V1_1, "1) 1.0 Rx 05g0 0", 11, ID),
        (V1_1, "1) 1.0 Rx 0520", 15, CODE),
        (V1_1, "1) 1.0 Rx 0520 16", 16, CODE),
        (V1_1, "1) 1.0 Rx 0520 2 00", 20, DATA),
        (V1_1, "1) 1.0 Rx 0520 2 00 0x", 21, DATA),
        (V1_1, "1) 1.0 Rx 0520 1 00 00", 21, END),
        (V1_1, "1) 1.0 Rx 0520 1 RTR 00", 22, END),
        (V1_3, "1) 1.0 can0 Rx 0520 - 1 00", 8, BUS),
        (V1_3, "1) 1.0 1 Rx 0520 1 00", 18, RESERVED),
        (V2_0, "1 1.0 DT 0520 XX 1 00", 15, DIRECTION),
        (V2_0, "1 1.0 DT 0520 Rx 9 00", 18, LEN),
        (V2_0, "1 1.0 FD 0520 Rx 65 00", 18, LEN),
        (V2_1, "1 1.0 ER - - Rx - 5", 10, BUS),
    ] {
        let text = format!("{header}{line}");
        let read = read(text.as_bytes(), Trc::new(), "1");
        let [error] = read.as_slice() else { panic!("{text}: {read:?}") };
        let number = text.lines().count();
        assert!(error.starts_with(&format!("line {number}, column {column}: found ")), "{text}: {error}");
        assert!(error.ends_with(&format!(", expected {expected}")), "{text}: {error}");
    }
}
