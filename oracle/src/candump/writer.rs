//! The way back: a frame as `candump -L` prints it.

use std::io::{self, Write};

use super::dropped::Dropped;
use super::line;
use super::record::{Direction, FrameKind, Record};
use super::record::{ERROR_FLAG, MAX_CLASSIC, MAX_FD, STANDARD_MASK};
use super::time::{NS_PER_MICROSECOND, NS_PER_SECOND};

/// Room for a line: 50 bytes without the interface, whose name Linux limits to 15; 112 more with the data of CAN FD.
const LINE: usize = 256;

/// Writes one classic data frame as a line of a log: `(1795209995.234358) vcan0 520#0000010000000000`.
///
/// An identifier above 7FF is printed as an extended one; [`write_record`] writes frames of every kind, and says the rest.
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
/// As [`write_record`].
pub fn write_frame(
    out: &mut impl Write,
    time_ns: i64,
    interface: &str,
    id: u32,
    data: &[u8],
) -> io::Result<()> {
    let kind = if id > STANDARD_MASK { FrameKind::Extended } else { FrameKind::Standard };
    let (line, direction, terminated) = (0, None, true);
    write_record(out, &Record { line, time_ns, interface, kind, id, data, direction, terminated })
}

/// Writes a frame of any kind as a line of a log: an error frame as `(1.000000) can0 20000004#000C000000000000`.
///
/// The time is printed in microseconds, as candump does, or in nanoseconds if it is no whole number of them. What is written
/// is read by [`Reader`](super::Reader) to the same values, but for the number of the line. The line reaches `out` in one
/// piece.
///
/// ```
/// use adsdv_oracle::candump::{FrameKind, Record, write_record};
///
/// let frame = Record {
///     line: 0,
///     time_ns: 1_795_209_995_234_358_000,
///     interface: "vcan0",
///     kind: FrameKind::Remote { extended: true, len: 3 },
///     id: 0x18FF_50E5,
///     data: &[],
///     direction: None,
///     terminated: true,
/// };
/// let mut log = Vec::new();
/// write_record(&mut log, &frame)?;
/// assert_eq!(log, b"(1795209995.234358) vcan0 18FF50E5#R3\n");
/// # Ok::<(), std::io::Error>(())
/// ```
///
/// # Errors
///
/// Fails when `out` does, and with [`io::ErrorKind::InvalidInput`], nothing written, when the frame could not
/// be read back: a negative time, an interface that is empty, very long, or holds white space or control
/// characters, an identifier of more bits or more data than its kind has, and a frame of CAN XL, of whose header a
/// [`Record`] does not keep all.
pub fn write_record(out: &mut impl Write, record: &Record<'_>) -> io::Result<()> {
    let Record { time_ns, interface, .. } = *record;
    if time_ns < 0 {
        return Err(invalid(format!("the time is {time_ns} ns, and a log needs one of at least 0")));
    }
    check_interface(interface)?;
    check_limits(record)?;
    put(out, interface, |room| print(room, record))
}

/// Writes that frames were lost before the next one, in the words of `candump -d`.
///
/// ```
/// use adsdv_oracle::candump::{Dropped, write_dropped};
///
/// let mut log = Vec::new();
/// write_dropped(&mut log, &Dropped { line: 0, interface: "vcan0", count: 3, total: 7 })?;
/// assert_eq!(log, b"DROPCOUNT: dropped 3 CAN frames on 'vcan0' socket (total drops 7)\n");
/// # Ok::<(), std::io::Error>(())
/// ```
///
/// # Errors
///
/// Fails when `out` does, and with [`io::ErrorKind::InvalidInput`], nothing written, for an interface that
/// [`write_record`] refuses.
pub fn write_dropped(out: &mut impl Write, dropped: &Dropped<'_>) -> io::Result<()> {
    let Dropped { interface, count, total, .. } = *dropped;
    check_interface(interface)?;
    let s = if count > 1 { "s" } else { "" };
    put(out, interface, |room| {
        writeln!(
            room,
            "DROPCOUNT: dropped {count} CAN frame{s} on '{interface}' socket (total drops {total})"
        )
    })
}

fn check_interface(interface: &str) -> io::Result<()> {
    if line::is_interface(interface) {
        return Ok(());
    }
    Err(invalid(format!(
        "{interface:?} is no interface; a name has no spaces or control characters, such as vcan0"
    )))
}

/// Writes a line in one piece.
fn put(
    out: &mut impl Write,
    interface: &str,
    print: impl FnOnce(&mut io::Cursor<&mut [u8]>) -> io::Result<()>,
) -> io::Result<()> {
    let mut line = [0; LINE];
    let mut room = io::Cursor::new(line.as_mut_slice());
    print(&mut room)
        .map_err(|_| invalid(format!("{interface:?} is too long for an interface; Linux has 15 bytes")))?;
    let len = usize::try_from(room.position()).unwrap_or_default();
    out.write_all(line.get(..len).unwrap_or_default())
}

/// Fails if the kind has no such identifier, or not so much data.
fn check_limits(record: &Record<'_>) -> io::Result<()> {
    let most = match record.kind {
        FrameKind::Standard | FrameKind::Extended | FrameKind::Error => MAX_CLASSIC,
        FrameKind::Remote { len, .. } => {
            if usize::from(len) > MAX_CLASSIC {
                return Err(invalid(format!(
                    "the remote frame asks for {len} bytes of data, and CAN has at most {MAX_CLASSIC}"
                )));
            }
            0
        }
        FrameKind::Fd { flags, .. } => {
            if flags > 0xF {
                return Err(invalid(format!(
                    "the flags of the CAN FD frame are {flags:X}, and a log has one digit"
                )));
            }
            MAX_FD
        }
        FrameKind::Xl => {
            return Err(invalid("a frame of CAN XL has more than a record keeps of it".to_owned()));
        }
    };
    let max_id = record.kind.max_id();
    if record.id > max_id {
        return Err(invalid(format!(
            "the identifier is {:X}, and such a frame has them up to {max_id:X}",
            record.id
        )));
    }
    if record.data.len() > most {
        let len = record.data.len();
        return Err(invalid(format!(
            "the frame has {len} bytes of data, and such a frame has at most {most}"
        )));
    }
    Ok(())
}

fn print(room: &mut impl Write, record: &Record<'_>) -> io::Result<()> {
    let Record { time_ns, interface, kind, id, data, direction, .. } = *record;
    let (seconds, fraction) = (time_ns / NS_PER_SECOND, time_ns % NS_PER_SECOND);
    if fraction % NS_PER_MICROSECOND == 0 {
        write!(room, "({seconds:010}.{:06}) {interface} ", fraction / NS_PER_MICROSECOND)?;
    } else {
        write!(room, "({seconds:010}.{fraction:09}) {interface} ")?;
    }
    match kind {
        FrameKind::Extended
        | FrameKind::Remote { extended: true, .. }
        | FrameKind::Fd { extended: true, .. } => write!(room, "{id:08X}#")?,
        FrameKind::Error => write!(room, "{:08X}#", id | ERROR_FLAG)?,
        _ => write!(room, "{id:03X}#")?,
    }
    match kind {
        FrameKind::Remote { len: 0, .. } => room.write_all(b"R")?,
        FrameKind::Remote { len, .. } => write!(room, "R{len}")?,
        FrameKind::Fd { flags, .. } => write!(room, "#{flags:X}")?,
        _ => {}
    }
    for byte in data {
        write!(room, "{byte:02X}")?;
    }
    match direction {
        Some(Direction::Rx) => room.write_all(b" R")?,
        Some(Direction::Tx) => room.write_all(b" T")?,
        None => {}
    }
    writeln!(room)
}

#[cold]
fn invalid(message: String) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidInput, message)
}

#[cfg(test)]
mod tests {
    use super::super::{Entry, Reader};
    use super::*;
    use crate::candump::record::EXTENDED_MASK;

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
    fn remote_frames_are_printed_as_candump_does() -> io::Result<()> {
        for (len, extended, printed) in [(0, false, "123#R"), (3, false, "123#R3"), (8, true, "00000123#R8")]
        {
            let kind = FrameKind::Remote { extended, len };
            let record = Record {
                line: 0,
                time_ns: 0,
                interface: "can0",
                kind,
                id: 0x123,
                data: &[],
                direction: None,
                terminated: true,
            };
            let mut out = Vec::new();
            write_record(&mut out, &record)?;
            assert_eq!(String::from_utf8_lossy(&out), format!("(0000000000.000000) can0 {printed}\n"));
        }
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

    fn record(kind: FrameKind, id: u32, data: &[u8]) -> Record<'_> {
        let (line, time_ns, direction, terminated) = (1, 1_795_209_995_234_358_001, None, true);
        Record { line, time_ns, interface: "vcan0", kind, id, data, direction, terminated }
    }

    #[test]
    fn a_frame_of_every_kind_is_read_back() -> Result<(), Box<dyn std::error::Error>> {
        use FrameKind::{Error, Extended, Fd, Remote, Standard};
        let bytes: Vec<u8> = (0..64).collect();
        let mut records = Vec::new();
        for id in [0, 0x520, STANDARD_MASK] {
            records.extend((0..=8).map(|len| record(Standard, id, &bytes[..len])));
            records.extend((0..=8).map(|len| record(Remote { extended: false, len }, id, &[])));
            records.extend((0..=15).map(|flags| record(Fd { extended: false, flags }, id, &bytes)));
        }
        for id in [0, 0x520, 0x800, EXTENDED_MASK] {
            records.extend((0..=8).map(|len| record(Extended, id, &bytes[..len])));
            records.extend((0..=8).map(|len| record(Error, id, &bytes[..len])));
            records.extend((0..=8).map(|len| record(Remote { extended: true, len }, id, &[])));
            records.extend((0..=64).map(|len| record(Fd { extended: true, flags: 5 }, id, &bytes[..len])));
        }
        for direction in [Direction::Rx, Direction::Tx] {
            records.push(Record { direction: Some(direction), ..record(Standard, 0x520, &bytes[..3]) });
        }
        let mut log = Vec::new();
        for record in &records {
            write_record(&mut log, record)?;
        }
        let mut reader = Reader::new(log.as_slice());
        for (line, record) in (1..).zip(&records) {
            assert_eq!(reader.next_record()?, Some(Entry::Frame(Record { line, ..*record })));
        }
        assert_eq!(reader.next_record()?, None);
        Ok(())
    }

    #[test]
    fn a_record_that_no_line_can_hold_is_refused() {
        let cases = [
            (record(FrameKind::Standard, 0x800, &[]), "up to 7FF"),
            (record(FrameKind::Error, 0x2000_0000, &[]), "up to 1FFFFFFF"),
            (record(FrameKind::Remote { extended: false, len: 9 }, 1, &[]), "asks for 9 bytes"),
            (record(FrameKind::Remote { extended: false, len: 1 }, 1, &[0]), "at most 0"),
            (record(FrameKind::Remote { extended: false, len: 1 }, 0x800, &[]), "up to 7FF"),
            (record(FrameKind::Fd { extended: false, flags: 16 }, 1, &[]), "one digit"),
            (record(FrameKind::Fd { extended: true, flags: 0 }, 1, &[0; 65]), "at most 64"),
            (record(FrameKind::Xl, 1, &[]), "CAN XL"),
        ];
        for (record, message) in cases {
            let mut out = Vec::new();
            let error = write_record(&mut out, &record).expect_err(message);
            assert_eq!((error.kind(), out.as_slice()), (io::ErrorKind::InvalidInput, &[][..]));
            assert!(error.to_string().contains(message), "{error}");
        }
    }
}
