use super::*;
use crate::text::tests::{read, read_line};

const START: &str = "base hex  timestamps absolute\n";

#[test]
fn frames_are_read_as_tools_write_them() {
    for (line, frame) in [
        // python-can
        (
            " 0.000000 1  520             Rx   d 8 00 00 01 00 00 00 00 00",
            "(0000000000.000000) 1 520#0000010000000000 R",
        ),
        (" 0.012345 1  18FF50E5x       Tx   d 2 AA BB", "(0000000000.012345) 1 18FF50E5#AABB T"),
        (" 0.012345 2  7FF             Rx   d 0 ", "(0000000000.012345) 2 7FF# R"),
        (" 0.012345 1  123             Rx   r 8 ", "(0000000000.012345) 1 123#R8 R"),
        (" 0.012345 1  00000123x       Tx   r 0 ", "(0000000000.012345) 1 00000123#R T"),
        (" 0.012345 1  ErrorFrame", "(0000000000.012345) 1 20000000#"),
        // Vector
        (
            "   3.098426 1  18EBFF00x       Rx   d 8 01 A0 0F A6 60 3B D1 40   Length = 273910 BitCount = 141 ID = 418119424x",
            "(0000000003.098426) 1 18EBFF00#01A00FA6603BD140 R",
        ),
        ("   2.501010 1  ErrorFrame\tECC: 10100010                  ", "(0000000002.501010) 1 20000000#"),
        (
            "   2.501020 2  ErrorFrame\tFlags = 0xe CodeExt = 0x20a2 Code = 0x82 ID = 0 DLC = 0 Position = 5 Length = 11300",
            "(0000000002.501020) 2 20000000#",
        ),
        ("   2.510001 2  100             Tx   r", "(0000000002.510001) 2 100#R T"),
        (
            "   2.520002 3  200             Tx   r Length = 1704000 BitCount = 145 ID = 88888888x",
            "(0000000002.520002) 3 200#R T",
        ),
        (
            "   2.584921 4  300             tx   R 8 Length = 1704000 BitCount = 145 ID = 768",
            "(0000000002.584921) 4 300#R8 T",
        ),
        (
            "1.0 1 EngineData Rx d 2 01 02 Length = 230000 BitCount = 120 ID = 1312",
            "(0000000001.000000) 1 520#0102 R",
        ),
        (
            "1.0 1 Diagnosis Rx d 1 01 Length = 230000 BitCount = 120 ID = 418119424x",
            "(0000000001.000000) 1 18EBFF00#01 R",
        ),
        ("1.0 1 EngineData Rx r ID = 1312", "(0000000001.000000) 1 520#R R"),
        (
            "1.123456789 1 520 Rx d c 1 2 03 04 05 06 07 fF TE",
            "(0000000001.123456789) 1 520#01020304050607FF R",
        ),
        ("1.0\t1\t520\tRx\td\t1\tAA\r", "(0000000001.000000) 1 520#AA R"),
        ("1.0 can0 520 Rx d 1 AA", "(0000000001.000000) can0 520#AA R"),
        // CAN FD: as CANoe writes it, and as python-can does.
        (
            "  30.005021 CANFD   1 Rx        300                                   1 0 8  8 01 02 03 04 05 06 07 08   102203  133   303000 e0006659 46500250 4b140250 20011736 20010205",
            "(0000000030.005021) 1 300##10102030405060708 R",
        ),
        (
            "  30.506898 CANFD   4 Tx   4EE                     A_Name   0 1 f 64 AA 01 02 03 04 05 06 07 08 09 0A 0B 0C 0D 0E 0F AA 01 02 03 04 05 06 07 08 09 0A 0B 0C 0D 0E 0F AA 01 02 03 04 05 06 07 08 09 0A 0B 0C 0D 0E 0F AA 01 02 03 04 05 06 07 08 09 0A 0B 0C 0D 0E 0F   1331984   11  5000 46500250",
            "(0000000030.506898) 4 4EE##2AA0102030405060708090A0B0C0D0E0FAA0102030405060708090A0B0C0D0E0FAA0102030405060708090A0B0C0D0E0FAA0102030405060708090A0B0C0D0E0F T",
        ),
        ("1.0 CANFD 1 Rx 18FF50E5x 0 0 0 0 0 0 1000 0 0 0 0 0", "(0000000001.000000) 1 18FF50E5##0 R"),
        (
            "1.0 CANFD 1 Rx 520 1 0 9 12 00 01 02 03 04 05 06 07 08 09 0A 0B",
            "(0000000001.000000) 1 520##1000102030405060708090A0B R",
        ),
        (
            "1.0 CANFD 3 Tx 520 0 0 2 2 AA BB 130000 130 200000 0 46500250 0 0",
            "(0000000001.000000) 3 520#AABB T",
        ),
        ("1.0 CANFD 3 Tx 520x 0 0 2 2 AA BB 130000 130 0 0", "(0000000001.000000) 3 00000520#AABB T"),
        ("1.0 CANFD 3 Tx 520 0 0 8 0 130000 130 200010 0", "(0000000001.000000) 3 520#R8 T"),
        (
            "1.0 CANFD 3 Rx ErrorFrame Not Acknowledge error, dominant error flag fffe",
            "(0000000001.000000) 3 20000000# R",
        ),
    ] {
        assert_eq!(read_line(START, line, Asc::new(), "1"), [frame], "{line}");
    }
}

#[test]
fn what_is_no_frame_but_belongs_there_is_passed_over() {
    for line in [
        "date Wed Nov 25 13:14:22.123 2026",
        "date Mit Nov 25 13:14:22,123 2026",
        "base hex",
        "base dec  timestamps relative",
        "no internal events logged",
        "internal events logged",
        "// version 9.0.0",
        "//0.5 1 520 Rx d 1 0",
        "previous log file: run_1.asc",
        "Begin TriggerBlock Wed Nov 25 13:14:22.123 2026",
        "End TriggerBlock",
        "end triggerblock",
        "   0.000000 Start of measurement",
        "   0.015991 CAN 1 Status:chip status error passive - TxErr: 132 RxErr: 0",
        "   1.0 1  Statistic: D 1 R 1 XD 0 XR 0 E 0 O 0 B 4.13%",
        "   1.0 1  J1939TP FEE3p 6 0 0 - Rx d 23 A0 0F A6 60 3B D1 40 1F DE 80 25 DF C0 2B E1 00 4B FF FF 3C 0F",
        "   1.0 1  OverloadFrame",
        "   1.0 1  520  TxRq d 1 00",
        "   1.0 CANFD 1 TxRq 520 0 0 1 1 00",
        "   1.0 log trigger event",
        "   1.0 Li 3c Rx 8 00 01 02 03 04 05 06 07 checksum = 12",
        "   1.0 EnvLight := 1",
        "   1.0 SV: 2 0 1 ::Speed = 1",
    ] {
        assert_eq!(read_line(START, line, Asc::new(), "1"), [""; 0], "{line}");
    }
}

#[test]
fn other_lines_are_refused_where_they_go_wrong() {
    const HEX: &str = "a byte of data, such as 0A, as many as the length before them says";
    for (line, column, expected) in [
        ("rubbish", 1, LINE),
        ("base oct", 6, BASE),
        ("(1.000000) can0 520#00", 1, LINE),
        ("1,5 1 520 Rx d 0", 1, TIME),
        ("9223372037.0 1 520 Rx d 0", 1, TIME),
        ("  1.0", 6, CHANNEL),
        ("1.0 1", 6, CHANNEL),
        ("1.0 1a 520 Rx d 0", 5, CHANNEL),
        ("1.0 -1 520 Rx d 0", 5, CHANNEL),
        ("1.0 1 520", 10, DIRECTION),
        ("1.0 1 520 Rxx d 0", 11, DIRECTION),
        ("1.0 1 520 d 8 00", 11, DIRECTION),
        ("1.0 1 520 Rx 8 00", 14, "d (data) or r (remote), and a length"),
        ("1.0 1 520 Rx d", 15, "a length code of 0 to 15, of which 8 and more mean 8 bytes of data"),
        ("1.0 1 520 Rx d 10 00", 16, "a length code of 0 to 15, of which 8 and more mean 8 bytes of data"),
        ("1.0 1 800 Rx d 1 00", 7, ID),
        ("1.0 1 20000000x Rx d 1 00", 7, ID),
        ("1.0 1 52g Rx d 1 00", 7, ID),
        ("1.0 1 Name Rx d 1 00", 7, ID),
        ("1.0 1 Name Rx d 1 00 ID = 2048", 7, ID),
        ("1.0 1 Name Rx d 1 00 ID = ", 7, ID),
        ("1.0 1 520 Rx d 2 00", 20, HEX),
        ("1.0 1 520 Rx d 2 00 0g", 21, HEX),
        ("1.0 1 520 Rx d 2 00 123", 21, HEX),
        (
            "1.0 1 520 Rx d 2 00 01 02",
            24,
            "the end of the data: there are more bytes than the length before them says",
        ),
        ("1.0 CANFD x Rx 520", 11, CHANNEL),
        ("1.0 CANFD 1 520", 13, DIRECTION),
        (
            "1.0 CANFD 1 Rx Name 0 0 0 0",
            16,
            "an identifier, such as 520: up to 7FF, or up to 1FFFFFFF with an x behind it",
        ),
        ("1.0 CANFD 1 Rx 520 Name 2", 25, "0 or 1, whether the bit rate was switched, perhaps behind a name"),
        ("1.0 CANFD 1 Rx 520 0 x", 22, "0 or 1, the error state of the sender"),
        ("1.0 CANFD 1 Rx 520 0 0 10 16", 24, "a length code of 0 to f"),
        ("1.0 CANFD 1 Rx 520 0 0 f 65", 26, "the number of data bytes, up to 64"),
        ("1.0 CANFD 1 Rx 520 0 0 2 2 00", 30, HEX),
    ] {
        let read = read_line(START, line, Asc::new(), "1");
        let [error] = read.as_slice() else { panic!("{line}: {read:?}") };
        assert!(error.starts_with(&format!("line 2, column {column}: found ")), "{line}: {error}");
        assert!(error.ends_with(&format!(", expected {expected}")), "{line}: {error}");
    }
}

#[test]
fn numbers_are_decimal_where_the_header_says_so() {
    for (line, frame) in [
        ("1.0 1 1312 Rx d 2 10 255", "(0000000001.000000) 1 520#0AFF R"),
        ("1.0 1 419385573x Rx d 10 1 2 3 4 5 6 7 8", "(0000000001.000000) 1 18FF50E5#0102030405060708 R"),
        (
            "1.0 CANFD 1 Rx 1312 1 0 9 12 0 1 2 3 4 5 6 7 8 9 10 255",
            "(0000000001.000000) 1 520##1000102030405060708090AFF R",
        ),
        (
            "1.0 CANFD 1 Rx 1312 1 0 a 16 0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15",
            "(0000000001.000000) 1 520##1000102030405060708090A0B0C0D0E0F R",
        ),
        (
            "1.0 1 1312 Rx d 1 256",
            "line 2, column 19: found \"256\", expected a byte of data in decimal, up to 255, as many as the length before them says",
        ),
    ] {
        assert_eq!(read_line("base dec timestamps absolute\n", line, Asc::new(), "1"), [frame], "{line}");
    }
}

#[test]
fn relative_times_are_differences_from_the_line_before_whatever_it_is() {
    let text = b"base hex timestamps relative\n0.5 Start of measurement\n0.5 1 520 Rx d 0\n0.25 1 rubbish\n0.25 1 520 Rx d 0\n0 1 520 Rx d 0\n9223372036 1 520 Rx d 0\n1 1 520 Rx d 0\n";
    let read = read(text, Asc::new(), "1");
    let times: Vec<&str> = read.iter().filter_map(|line| line.split(' ').next()).collect();
    assert_eq!(
        times,
        [
            "(0000000001.000000)",
            "line",
            "(0000000001.500000)",
            "(0000000001.500000)",
            "line",
            "(0000000002.500000)"
        ]
    );
}

#[test]
fn the_start_is_that_of_the_first_block_or_else_of_the_header() {
    const FRAME: &str = "0.5 1 520 Rx d 0\n";
    const DATE: &str = "date Thu Jan 1 00:00:10.000 1970\n";
    const BEGIN: &str = "Begin Triggerblock Thu Jan 1 00:00:20.000 1970\n";
    const LATER: &str = "Begin Triggerblock Thu Jan 1 00:00:30.000 1970\n";
    const UNKNOWN: &str = "Begin Triggerblock Thu Foo 1 00:00:30.000 1970\n";
    for (lines, times) in [
        ([FRAME, FRAME].concat(), vec!["(0000000000.500000)"; 2]),
        ([DATE, FRAME].concat(), vec!["(0000000010.500000)"]),
        ([DATE, BEGIN, FRAME, LATER, FRAME].concat(), vec!["(0000000020.500000)"; 2]),
        ([DATE, UNKNOWN, FRAME].concat(), vec!["(0000000010.500000)"]),
        ([DATE, FRAME, BEGIN, FRAME].concat(), vec!["(0000000010.500000)"; 2]),
        ([BEGIN, FRAME, DATE, FRAME].concat(), vec!["(0000000020.500000)", "(0000000010.500000)"]),
    ] {
        let read = read(lines.as_bytes(), Asc::new(), "1");
        let read: Vec<&str> = read.iter().filter_map(|line| line.split(' ').next()).collect();
        assert_eq!(read, times, "{lines}");
    }
}
