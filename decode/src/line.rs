//! A frame as `candump -L` prints it, and its parts: for what is written once for each frame, and has to be fast.

use std::io::Write as _;

use adsdv_oracle::candump::{Direction, FrameKind, Record, write_record};

const HEX: &[u8; 16] = b"0123456789ABCDEF";
const NS_PER_SECOND: u64 = 1_000_000_000;
const NS_PER_MICROSECOND: u64 = 1000;

/// Appends bytes as pairs of hexadecimal digits.
#[inline]
pub(crate) fn put_hex(out: &mut Vec<u8>, data: &[u8]) {
    for byte in data {
        let digit = |nibble: u8| HEX.get(usize::from(nibble)).copied().unwrap_or_default();
        out.extend_from_slice(&[digit(byte >> 4), digit(byte & 0xF)]);
    }
}

/// Appends the lowest digits of a number, so many, with zeros before them.
#[inline]
fn put_digits(out: &mut Vec<u8>, number: u64, digits: usize) {
    let mut buffer = itoa::Buffer::new();
    let text = buffer.format(number).as_bytes();
    for _ in text.len()..digits {
        out.push(b'0');
    }
    out.extend_from_slice(text);
}

/// Whether an identifier has 29 bits, or is the class of an error.
#[inline]
pub(crate) const fn is_extended(kind: FrameKind) -> bool {
    match kind {
        FrameKind::Extended | FrameKind::Error => true,
        FrameKind::Remote { extended, .. } | FrameKind::Fd { extended, .. } => extended,
        FrameKind::Standard | FrameKind::Xl => false,
    }
}

/// Appends an identifier as candump has it: three digits, or eight.
#[inline]
pub(crate) fn put_id(out: &mut Vec<u8>, record: &Record<'_>) {
    let bytes = record.id.to_be_bytes();
    if is_extended(record.kind) {
        return put_hex(out, &bytes);
    }
    let [.., high, low] = bytes;
    out.push(HEX.get(usize::from(high & 0xF)).copied().unwrap_or_default());
    put_hex(out, &[low]);
}

/// Appends a time in seconds: with six digits behind the point, or with nine where it is no whole number of microseconds. The seconds
/// have so many digits at least.
#[inline]
pub(crate) fn put_time(out: &mut Vec<u8>, time_ns: i64, digits: usize) {
    if time_ns < 0 {
        out.push(b'-');
    }
    let time_ns = time_ns.unsigned_abs();
    let (seconds, rest) = (time_ns / NS_PER_SECOND, time_ns % NS_PER_SECOND);
    put_digits(out, seconds, digits);
    out.push(b'.');
    if rest.is_multiple_of(NS_PER_MICROSECOND) {
        put_digits(out, rest / NS_PER_MICROSECOND, 6);
    } else {
        put_digits(out, rest, 9);
    }
}

/// Appends a frame as a line of `candump -L`, without its end.
#[inline]
pub(crate) fn put_line(out: &mut Vec<u8>, record: &Record<'_>) {
    if !matches!(record.kind, FrameKind::Standard | FrameKind::Extended) || record.time_ns < 0 {
        return put_unusual(out, record);
    }
    out.push(b'(');
    put_time(out, record.time_ns, 10);
    out.extend_from_slice(b") ");
    out.extend_from_slice(record.interface.as_bytes());
    out.push(b' ');
    put_id(out, record);
    out.push(b'#');
    put_hex(out, record.data);
    out.extend_from_slice(match record.direction {
        Some(Direction::Rx) => b" R",
        Some(Direction::Tx) => b" T",
        None => b"",
    });
}

#[cold]
fn put_unusual(out: &mut Vec<u8>, record: &Record<'_>) {
    let before = out.len();
    if write_record(out, record).is_ok() {
        out.pop();
        return;
    }
    // Of a CAN XL frame the record has not all that candump prints.
    out.truncate(before);
    out.push(b'(');
    put_time(out, record.time_ns, 10);
    // A vector takes everything.
    let _ = write!(out, ") {} {:03X}#", record.interface, record.id);
    if record.kind == FrameKind::Xl {
        out.push(b'#');
    }
    put_hex(out, record.data);
}

/// What a frame is, if it is no data frame of CAN or CAN FD; empty otherwise.
pub(crate) const fn kind_name(kind: FrameKind) -> &'static str {
    match kind {
        FrameKind::Standard | FrameKind::Extended | FrameKind::Fd { .. } => "",
        FrameKind::Remote { .. } => "remote frame",
        FrameKind::Error => "error frame",
        FrameKind::Xl => "CAN XL frame",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn record(kind: FrameKind, time_ns: i64, id: u32, data: &[u8]) -> Record<'_> {
        Record { line: 1, time_ns, interface: "can0", kind, id, data, direction: None, terminated: true }
    }

    /// The fast way comes to what `write_record` writes.
    #[test]
    fn a_line_is_that_of_candump() {
        let kinds = [FrameKind::Standard, FrameKind::Extended, FrameKind::Error];
        for kind in kinds.into_iter().chain([FrameKind::Fd { extended: true, flags: 1 }]) {
            for time_ns in [0, 1, 1000, 999_999_999, 1_795_209_995_234_358_000, i64::MAX] {
                for (id, data) in [(0, &[][..]), (0x7FF, &[0x0F, 0xF0]), (0x123, &[1, 2, 3, 4, 5, 6, 7, 8])] {
                    for direction in [None, Some(Direction::Rx), Some(Direction::Tx)] {
                        let record = Record { direction, ..record(kind, time_ns, id, data) };
                        let (mut fast, mut slow) = (Vec::new(), Vec::new());
                        put_line(&mut fast, &record);
                        fast.push(b'\n');
                        write_record(&mut slow, &record).expect("it can be written");
                        assert_eq!(String::from_utf8_lossy(&fast), String::from_utf8_lossy(&slow));
                    }
                }
            }
        }
    }

    #[test]
    fn what_candump_would_print_more_of_is_printed_in_part() {
        let line = |record: &Record<'_>| {
            let mut out = Vec::new();
            put_line(&mut out, record);
            String::from_utf8(out).expect("text")
        };
        assert_eq!(
            line(&record(FrameKind::Xl, 5, 0x12, &[0xAB; 9])),
            "(0000000000.000000005) can0 012##ABABABABABABABABAB"
        );
        assert_eq!(
            line(&record(FrameKind::Standard, -1_500_000_000, 0x12, &[1])),
            "(-0000000001.500000) can0 012#01"
        );
    }
}
