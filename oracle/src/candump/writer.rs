//! The way back: a frame as `candump -L` prints it.

use std::io::{self, Write};

use super::frame::{EXTENDED_MASK, MAX_CLASSIC, STANDARD_MASK};
use super::line;
use super::time::{NS_PER_MICROSECOND, NS_PER_SECOND};

/// Room for a line: 50 bytes without the interface, whose name Linux limits to 15.
const LINE: usize = 128;

/// Writes one classic data frame as a line of a log: `(1795209995.234358) vcan0 520#0000010000000000`.
///
/// `time_ns` is printed in microseconds, as candump does, or in nanoseconds if it is no whole number of them.
/// An identifier above 7FF is printed as an extended one. What is written is read by
/// [`Reader`](super::Reader) to the same values. The line reaches `out` in one piece.
///
/// ```
/// let mut log = Vec::new();
/// adsdv_oracle::candump::write_frame(&mut log, 1_795_209_995_234_358_000, "vcan0", 0x520, &[0, 0, 1])?;
/// assert_eq!(log, b"(1795209995.234358) vcan0 520#000001\n");
/// # Ok::<(), std::io::Error>(())
/// ```
///
/// # Errors
///
/// Fails when `out` does, and with [`io::ErrorKind::InvalidInput`], nothing written, when the frame could not
/// be read back: a negative time, an `interface` that is empty, very long, or holds white space or control
/// characters, an identifier of more than 29 bits, more than 8 bytes of `data`.
pub fn write_frame(
    out: &mut impl Write,
    time_ns: i64,
    interface: &str,
    id: u32,
    data: &[u8],
) -> io::Result<()> {
    if time_ns < 0 {
        return Err(invalid(format!("the time is {time_ns} ns, and a log needs one of at least 0")));
    }
    if !line::is_interface(interface) {
        return Err(invalid(format!(
            "{interface:?} is no interface; a name has no spaces or control characters, such as vcan0"
        )));
    }
    if id > EXTENDED_MASK {
        return Err(invalid(format!("the identifier is {id:X}, and CAN has them up to {EXTENDED_MASK:X}")));
    }
    if data.len() > MAX_CLASSIC {
        return Err(invalid(format!(
            "the frame has {} bytes of data, and CAN has at most {MAX_CLASSIC}",
            data.len()
        )));
    }
    let mut line = [0; LINE];
    let mut room = line.as_mut_slice();
    print(&mut room, time_ns, interface, id, data)
        .map_err(|_| invalid(format!("{interface:?} is too long for an interface; Linux has 15 bytes")))?;
    let len = LINE - room.len();
    out.write_all(line.get(..len).unwrap_or_default())
}

fn print(room: &mut impl Write, time_ns: i64, interface: &str, id: u32, data: &[u8]) -> io::Result<()> {
    let (seconds, fraction) = (time_ns / NS_PER_SECOND, time_ns % NS_PER_SECOND);
    if fraction % NS_PER_MICROSECOND == 0 {
        write!(room, "({seconds:010}.{:06}) {interface} ", fraction / NS_PER_MICROSECOND)?;
    } else {
        write!(room, "({seconds:010}.{fraction:09}) {interface} ")?;
    }
    if id > STANDARD_MASK {
        write!(room, "{id:08X}#")?;
    } else {
        write!(room, "{id:03X}#")?;
    }
    for byte in data {
        write!(room, "{byte:02X}")?;
    }
    writeln!(room)
}

#[cold]
fn invalid(message: String) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidInput, message)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn written(time_ns: i64, interface: &str, id: u32, data: &[u8]) -> io::Result<String> {
        let mut out = Vec::new();
        let result = write_frame(&mut out, time_ns, interface, id, data);
        assert!(result.is_ok() || out.is_empty());
        result.map(|()| String::from_utf8_lossy(&out).into_owned())
    }

    #[test]
    fn frames_are_printed_as_candump_does() -> io::Result<()> {
        assert_eq!(written(0, "can0", 0, &[])?, "(0000000000.000000) can0 000#\n");
        assert_eq!(
            written(1_795_209_995_000_001_000, "vcan0", 0x7FF, &[0xAB, 1])?,
            "(1795209995.000001) vcan0 7FF#AB01\n"
        );
        assert_eq!(
            written(1, "can0", 0x800, &[1; 8])?,
            "(0000000000.000000001) can0 00000800#0101010101010101\n"
        );
        let longest = written(i64::MAX, "fifteen-bytes-x", EXTENDED_MASK, &[0xFF; 8])?;
        assert_eq!(longest, "(9223372036.854775807) fifteen-bytes-x 1FFFFFFF#FFFFFFFFFFFFFFFF\n");
        Ok(())
    }

    #[test]
    fn what_could_not_be_read_back_is_refused() {
        let long = "x".repeat(LINE);
        let cases: [(i64, &str, u32, &[u8], &str); 7] = [
            (-1, "can0", 1, &[], "-1 ns"),
            (0, "", 1, &[], r#""""#),
            (0, "can 0", 1, &[], r#""can 0""#),
            (0, "can\n0", 1, &[], r#""can\n0""#),
            (0, &long, 1, &[], "too long"),
            (0, "can0", 0x2000_0000, &[], "20000000"),
            (0, "can0", 1, &[0; 9], "9 bytes"),
        ];
        for (time_ns, interface, id, data, message) in cases {
            let error = written(time_ns, interface, id, data).expect_err(message);
            assert_eq!(error.kind(), io::ErrorKind::InvalidInput);
            assert!(error.to_string().contains(message), "{error}");
        }
    }
}
