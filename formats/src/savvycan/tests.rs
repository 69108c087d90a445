use super::*;
use crate::text::tests::{read, read_line};

const DIRECTED: &str = "Time Stamp,ID,Extended,Dir,Bus,LEN,D1,D2,D3,D4,D5,D6,D7,D8\n";
const OLDER: &str = "Time Stamp,ID,Extended,Bus,LEN,D1,D2,D3,D4,D5,D6,D7,D8\n";

#[test]
fn lines_are_read_as_savvycan_writes_them() {
    for (line, frame) in [
        (
            "166064000,0000021A,false,Rx,0,8,36,E5,00,00,00,00,00,00,",
            "(0000000166.064000) 0 21A#36E5000000000000 R",
        ),
        (
            "166064000,0000021A,false,Tx,1,8,36,E5,00,00,00,00,00,01\r",
            "(0000000166.064000) 1 21A#36E5000000000001 T",
        ),
        ("1795209995234358,520,false,Rx,0,3,0,1,Ff,", "(1795209995.234358) 0 520#0001FF R"),
        (" 1 , 18ff50e5 , TRUE , rx , 2 , 2 , 0a , 0B , ", "(0000000000.000001) 2 18FF50E5#0A0B R"),
        ("0,00000000,false,Rx,0,0,", "(0000000000.000000) 0 000# R"),
        ("0,00000000,true,Rx,0,0", "(0000000000.000000) 0 00000000# R"),
        ("1,00000520,false,Rx,0,2,01,02,00,00,00,00,00,00,", "(0000000000.000001) 0 520#0102 R"),
        ("1,00000520,false,Rx,0,2,01,02,,,,,,,,", "(0000000000.000001) 0 520#0102 R"),
        (
            "1,00000520,false,Rx,0,12,00,01,02,03,04,05,06,07,08,09,0A,0B,",
            "(0000000000.000001) 0 520##0000102030405060708090A0B R",
        ),
    ] {
        assert_eq!(read_line(DIRECTED, line, SavvyCan::new(), "0"), [frame], "{line}");
    }
}

#[test]
fn a_header_says_whether_lines_have_a_direction() {
    let line = "166064000,0000021A,false,0,2,36,E5,";
    let frame = "(0000000166.064000) 0 21A#36E5";
    assert_eq!(read_line(OLDER, line, SavvyCan::new(), "0"), [frame]);
    let tolerant = OLDER.to_uppercase().replace(',', " , ");
    assert_eq!(read_line(&tolerant, line, SavvyCan::new(), "0"), [frame]);
    let both = format!("{OLDER}{line}\n{DIRECTED}166065000,0000021A,false,Tx,0,0,\n");
    let frames = [frame, "(0000000166.065000) 0 21A# T"];
    assert_eq!(read(both.as_bytes(), SavvyCan::new(), "0"), frames);
}

#[test]
fn a_recording_is_known_by_its_columns() {
    for (head, known) in [
        (DIRECTED, true),
        (OLDER, true),
        ("time stamp , id , EXTENDED , dir , bus , Len\r\n", true),
        ("Time Stamp,ID,Extended,Bus,LEN", true),
        ("Time Stamp,ID,Extended,Dir,LEN,D1\n", false),
        ("Time Stamp,ID,Extended,Dir,Bus\n,LEN", false),
        ("Time Stamp,ID,Extended,Bus,Dir,LEN\n", false),
        ("timestamp,arbitration_id,extended,remote,error,dlc,data\n", false),
        ("Time Stamp\n", false),
        ("", false),
    ] {
        assert_eq!(is(head.as_bytes()), known, "{head}");
    }
}

#[test]
fn other_lines_are_refused_where_they_go_wrong() {
    for (line, column, expected) in [
        ("rubbish", 1, TIME),
        ("1.5,00000520,false,Rx,0,0,", 1, TIME),
        ("-1,00000520,false,Rx,0,0,", 1, TIME),
        (" x,00000520,false,Rx,0,0,", 2, TIME),
        ("9223372036854776,00000520,false,Rx,0,0,", 1, TIME),
        ("99999999999999999999,00000520,false,Rx,0,0,", 1, TIME),
        ("\"1\",00000520,false,Rx,0,0,", 1, TIME),
        ("1", 2, LINE),
        ("1;00000520;false;Rx;0;0;", 1, TIME),
        ("1,00000520", 11, LINE),
        ("1,0x520,false,Rx,0,0,", 3, ID),
        ("1,00000800,false,Rx,0,0,", 3, ID),
        ("1,20000000,true,Rx,0,0,", 3, ID),
        ("1,00000520,no,Rx,0,0,", 12, EXTENDED),
        ("1,00000520,false,0,0,", 18, DIRECTION),
        ("1,00000520,false,Rx", 20, LINE),
        ("1,00000520,false,Rx,can0,0,", 21, BUS),
        ("1,00000520,false,Rx,,0,", 21, BUS),
        ("1,00000520,false,Rx,0,65,", 23, LEN),
        ("1,00000520,false,Rx,0,x,", 23, LEN),
        ("1,00000520,false,Rx,0,2,00", 27, DATA),
        ("1,00000520,false,Rx,0,2,00,", 28, DATA),
        ("1,00000520,false,Rx,0,2,00, 0g", 29, DATA),
        ("1,00000520,false,Rx,0,2,00,100,", 28, DATA),
        ("1,00000520,false,Rx,0,1,00,01,", 28, END),
        ("1,00000520,false,Rx,0,8,00,00,00,00,00,00,00,00,00,", 49, END),
    ] {
        let read = read_line("", line, SavvyCan::new(), "0");
        let [error] = read.as_slice() else { panic!("{line}: {read:?}") };
        assert!(error.starts_with(&format!("line 1, column {column}: found ")), "{line}: {error}");
        assert!(error.ends_with(&format!(", expected {expected}")), "{line}: {error}");
    }
}
