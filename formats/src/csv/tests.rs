use super::*;
use crate::text::tests::read_line;

#[test]
fn lines_are_read_as_python_can_writes_them() {
    for (line, frame) in [
        ("1795209995.234358,0x520,0,0,0,8,AAABAAAAAAA=", "(1795209995.234358) can 520#0000010000000000"),
        ("1795209995.234358,0x520,0,0,0,0,\r", "(1795209995.234358) can 520#"),
        ("0.0,0x18ff50e5,1,0,0,1,/w==", "(0000000000.000000) can 18FF50E5#FF"),
        ("5e-05,0x1,0,0,0,1,AA==", "(0000000000.000050) can 001#00"),
        ("1.5e-07,0x1,1,0,0,1,AA==", "(0000000000.000000150) can 00000001#00"),
        ("1,520,0,1,0,8,", "(0000000001.000000) can 520#R8"),
        ("1,0x520,1,1,0,0,", "(0000000001.000000) can 00000520#R"),
        ("1.0,0x4,1,0,1,8,AAwAAAAAAAA=", "(0000000001.000000) can 20000004#000C000000000000"),
        ("1.0,0x520,0,0,0,12,AAECAwQFBgcICQoL", "(0000000001.000000) can 520##0000102030405060708090A0B"),
    ] {
        assert_eq!(read_line("", line, Csv, "can"), [frame], "{line}");
    }
    assert_eq!(read_line("", "timestamp,arbitration_id,extended,remote,error,dlc,data", Csv, "can"), [""; 0]);
}

#[test]
fn other_lines_are_refused_where_they_go_wrong() {
    for (line, column, expected) in [
        ("rubbish", 1, TIME),
        ("-1.0,0x520,0,0,0,0,", 1, TIME),
        ("nan,0x520,0,0,0,0,", 1, TIME),
        ("9223372036.9,0x520,0,0,0,0,", 1, TIME),
        ("1e300,0x520,0,0,0,0,", 1, TIME),
        ("1.0", 4, LINE),
        ("1.0,0x520", 10, LINE),
        ("1.0,0x52g,0,0,0,0,", 5, ID),
        ("1.0,0x800,0,0,0,0,", 5, ID),
        ("1.0,0x20000000,1,0,0,0,", 5, ID),
        ("1.0,0x800,0,1,0,0,", 5, ID),
        ("1.0,0x520,no,0,0,0,", 11, FLAG),
        ("1.0,0x520,0,,0,0,", 13, FLAG),
        ("1.0,0x520,0,1,1,0,", 15, REMOTE_OR_ERROR),
        ("1.0,0x520,0,0,0,65,", 17, LEN),
        ("1.0,0x520,0,0,0,x,", 17, LEN),
        ("1.0,0x520,0,1,0,9,", 17, REMOTE_LEN),
        ("1.0,0x520,0,0,1,9,", 17, ERROR_LEN),
        ("1.0,0x520,0,0,0,2", 18, LINE),
        ("1.0,0x520,0,0,0,2,AA==", 19, DATA),
        ("1.0,0x520,0,0,0,1,A", 19, DATA),
        ("1.0,0x520,0,0,0,1,AA==,", 19, DATA),
        ("1.0,0x520,0,1,0,1,AA==", 19, NO_DATA),
    ] {
        let read = read_line("", line, Csv, "can");
        let [error] = read.as_slice() else { panic!("{line}: {read:?}") };
        assert!(error.starts_with(&format!("line 1, column {column}: found ")), "{line}: {error}");
        assert!(error.ends_with(&format!(", expected {expected}")), "{line}: {error}");
    }
}
