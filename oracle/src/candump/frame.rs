//! The frame itself: identifier, `#`, and data or what stands in their place.
//!
//! The forms are those that `parse_canframe` of can-utils reads:
//!
//! ```text
//! 520#0011          data, identifier of 11 bits            520#00.11     dots between bytes
//! 18FF50E5#0011     data, identifier of 29 bits            520#0011223344556677_B   raw length code 9 to F
//! 520#R  520#R8     remote frame                           20000004#...  error frame
//! 520##10011        CAN FD, one digit of flags
//! 45123#81:00:12345678#0011   CAN XL: network and priority, flags, type, acceptance
//! ```

use super::cursor::Cursor;
use super::error::Flaw;
use super::hex;
use super::record::{ERROR_FLAG, EXTENDED_MASK, FrameKind, MAX_CLASSIC, MAX_DATA, MAX_FD, STANDARD_MASK};
use crate::text::hex_digit;

const IDENTIFIER: &str = "an identifier of 3 or 8 hexadecimal digits and '#'";
const ID_DIGIT: &str = "a hexadecimal digit of the identifier";
const STANDARD_ID: &str = "an identifier up to 7FF, or 8 digits for an extended one";
const EXTENDED_ID: &str =
    "an identifier up to 1FFFFFFF, or an error frame, 20000000 and above, up to 3FFFFFFF";
const FD_FLAGS: &str = "the flags of a CAN FD frame, one hexadecimal digit";
const XL_HEADER: &str = "the header of a CAN XL frame, such as 45123#81:00:12345678#";
const LOW_DIGIT: &str = "the second hexadecimal digit of a data byte";
const AT_MOST_8: &str = "at most 8 bytes of data, the most that a CAN frame holds";
const AT_MOST_64: &str = "at most 64 bytes of data, the most that a CAN FD frame holds";
const AT_MOST_2048: &str = "at most 2048 bytes of data, the most that a CAN XL frame holds";
const REMOTE_LEN: &str = "a length of 0 to 8 for the remote frame";
const RAW_LEN: &str = "a raw length code of 9 to F";

/// What was read, apart from the data bytes themselves.
pub(super) struct Frame {
    pub(super) kind: FrameKind,
    pub(super) id: u32,
    /// Number of data bytes.
    pub(super) len: usize,
}

/// Takes a frame and puts its data into `data`.
#[inline]
pub(super) fn take(cursor: &mut Cursor<'_>, data: &mut [u8; MAX_DATA]) -> Result<Frame, Flaw> {
    let rest = cursor.rest();
    if let Some(&[ref digits @ .., b'#']) = rest.first_chunk::<4>() {
        let id = take_id(cursor, *digits)?;
        if id > STANDARD_MASK {
            return Err(cursor.flaw(STANDARD_ID));
        }
        cursor.skip(4);
        take_body(cursor, data, FrameKind::Standard, id)
    } else if let Some(&[ref digits @ .., b'#']) = rest.first_chunk::<9>() {
        let id = take_id(cursor, *digits)?;
        let kind = match id & !EXTENDED_MASK {
            0 => FrameKind::Extended,
            ERROR_FLAG => FrameKind::Error,
            _ => return Err(cursor.flaw(EXTENDED_ID)),
        };
        cursor.skip(9);
        take_body(cursor, data, kind, id & EXTENDED_MASK)
    } else if let Some(&[ref digits @ .., b'#']) = rest.first_chunk::<6>() {
        let id = take_id(cursor, *digits)? & 0xFFF;
        if id > STANDARD_MASK {
            return Err(cursor.flaw_after(2, STANDARD_ID));
        }
        cursor.skip(6);
        take_xl(cursor, data, id)
    } else {
        Err(cursor.flaw(IDENTIFIER))
    }
}

#[inline]
fn take_id<const N: usize>(cursor: &Cursor<'_>, digits: [u8; N]) -> Result<u32, Flaw> {
    hex::number(digits).map_err(|offset| cursor.flaw_after(offset, ID_DIGIT))
}

/// Takes what follows the `#` of a frame whose identifier made it a `kind`.
#[inline]
fn take_body(
    cursor: &mut Cursor<'_>,
    data: &mut [u8; MAX_DATA],
    kind: FrameKind,
    id: u32,
) -> Result<Frame, Flaw> {
    let extended = kind == FrameKind::Extended;
    match cursor.rest() {
        [b'#', ..] if kind != FrameKind::Error => {
            cursor.skip(1);
            let flags = cursor.peek().and_then(hex_digit).ok_or_else(|| cursor.flaw(FD_FLAGS))?;
            cursor.skip(1);
            let len = take_data(cursor, data, MAX_FD, AT_MOST_64)?;
            Ok(Frame { kind: FrameKind::Fd { extended, flags }, id, len })
        }
        [b'R', ..] if kind != FrameKind::Error => {
            cursor.skip(1);
            let len = take_remote_len(cursor)?;
            Ok(Frame { kind: FrameKind::Remote { extended, len }, id, len: 0 })
        }
        [_, _, b':', ..] if kind == FrameKind::Standard => take_xl(cursor, data, id),
        _ => {
            let len = take_data(cursor, data, MAX_CLASSIC, AT_MOST_8)?;
            if len == MAX_CLASSIC {
                take_raw_len(cursor)?;
            }
            Ok(Frame { kind, id, len })
        }
    }
}

fn take_remote_len(cursor: &mut Cursor<'_>) -> Result<u8, Flaw> {
    let Some(len) = cursor.peek().and_then(hex_digit) else { return Ok(0) };
    if usize::from(len) > MAX_CLASSIC {
        return Err(cursor.flaw(REMOTE_LEN));
    }
    cursor.skip(1);
    if usize::from(len) == MAX_CLASSIC {
        take_raw_len(cursor)?;
    }
    Ok(len)
}

/// A length code on the wire may be 9 to 15, which all mean 8 bytes; candump shows it as `_9` to `_F`.
#[inline]
fn take_raw_len(cursor: &mut Cursor<'_>) -> Result<(), Flaw> {
    if cursor.skip_if(b'_') {
        cursor
            .peek()
            .and_then(hex_digit)
            .filter(|code| usize::from(*code) > MAX_CLASSIC)
            .ok_or_else(|| cursor.flaw(RAW_LEN))?;
        cursor.skip(1);
    }
    Ok(())
}

/// Takes a CAN XL frame after its priority: flags, type of the payload, acceptance field and data.
#[cold]
fn take_xl(cursor: &mut Cursor<'_>, data: &mut [u8; MAX_DATA], id: u32) -> Result<Frame, Flaw> {
    const HEADER: &[u8; 15] = b"81:00:12345678#";
    for shape in HEADER {
        let fits = cursor.peek().is_some_and(|byte| {
            if shape.is_ascii_digit() { hex_digit(byte).is_some() } else { byte == *shape }
        });
        if !fits {
            return Err(cursor.flaw(XL_HEADER));
        }
        cursor.skip(1);
    }
    let len = take_data(cursor, data, MAX_DATA, AT_MOST_2048)?;
    Ok(Frame { kind: FrameKind::Xl, id, len })
}

/// Takes bytes of two digits each, with or without a dot before each, up to `max` of them.
#[inline]
fn take_data(
    cursor: &mut Cursor<'_>,
    data: &mut [u8; MAX_DATA],
    max: usize,
    at_most: &'static str,
) -> Result<usize, Flaw> {
    let mut len = 0;
    // Eight bytes, the usual length, are taken at one go unless there are dots. No frame holds fewer at most.
    if let Some(bytes) = cursor.rest().first_chunk().and_then(|digits| hex::bytes::<16, 8>(*digits))
        && let Some(place) = data.first_chunk_mut()
    {
        *place = bytes;
        cursor.skip(16);
        len = 8;
    }
    loop {
        cursor.skip_if(b'.');
        let Some(high) = cursor.peek().and_then(hex_digit) else { return Ok(len) };
        let Some(low) = cursor.rest().get(1).copied().and_then(hex_digit) else {
            return Err(cursor.flaw_after(1, LOW_DIGIT));
        };
        match data.get_mut(len) {
            Some(place) if len < max => *place = high << 4 | low,
            _ => return Err(cursor.flaw(at_most)),
        }
        cursor.skip(2);
        len += 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<(FrameKind, u32, Vec<u8>), Flaw> {
        let mut data = [0; MAX_DATA];
        let mut cursor = Cursor::new(text.as_bytes());
        let Frame { kind, id, len } = take(&mut cursor, &mut data)?;
        assert!(cursor.rest().is_empty(), "{text}");
        Ok((kind, id, data[..len].to_vec()))
    }

    fn counting(len: u8) -> Vec<u8> {
        (0..len).collect()
    }

    fn digits(bytes: &[u8]) -> String {
        let halves = bytes.iter().flat_map(|byte| [byte >> 4, byte & 0xF]);
        halves.filter_map(|half| char::from_digit(half.into(), 16)).collect()
    }

    #[test]
    fn frames_of_every_sort_are_read() {
        use FrameKind::{Error, Extended, Fd, Remote, Standard, Xl};
        let remote = |extended, len| Remote { extended, len };
        let fd = |extended, flags| Fd { extended, flags };
        let cases: [(&str, FrameKind, u32, &[u8]); 29] = [
            ("520#", Standard, 0x520, &[]),
            ("520#aB", Standard, 0x520, &[0xAB]),
            ("7ff#0001", Standard, 0x7FF, &[0, 1]),
            ("000#000102030405", Standard, 0, &[0, 1, 2, 3, 4, 5]),
            ("520#0001020304050607", Standard, 0x520, &[0, 1, 2, 3, 4, 5, 6, 7]),
            ("520#00.01.02", Standard, 0x520, &[0, 1, 2]),
            ("520#.00.01.", Standard, 0x520, &[0, 1]),
            ("520#00.01.02.03.04.05.06.07", Standard, 0x520, &[0, 1, 2, 3, 4, 5, 6, 7]),
            ("520#00010203.04050607", Standard, 0x520, &[0, 1, 2, 3, 4, 5, 6, 7]),
            ("520#0001020304050607.", Standard, 0x520, &[0, 1, 2, 3, 4, 5, 6, 7]),
            ("123#1122334455667788_B", Standard, 0x123, &[0x11, 0x22, 0x33, 0x44, 0x55, 0x66, 0x77, 0x88]),
            ("123#1122334455667788_9", Standard, 0x123, &[0x11, 0x22, 0x33, 0x44, 0x55, 0x66, 0x77, 0x88]),
            ("00000520#01", Extended, 0x520, &[1]),
            ("1FFFFFFF#01", Extended, 0x1FFF_FFFF, &[1]),
            ("20000004#000C000000000000", Error, 4, &[0, 0xC, 0, 0, 0, 0, 0, 0]),
            ("20000000#", Error, 0, &[]),
            ("123#R", remote(false, 0), 0x123, &[]),
            ("123#R0", remote(false, 0), 0x123, &[]),
            ("123#R8", remote(false, 8), 0x123, &[]),
            ("123#R8_F", remote(false, 8), 0x123, &[]),
            ("18FF50E5#R3", remote(true, 3), 0x18FF_50E5, &[]),
            ("123##0", fd(false, 0), 0x123, &[]),
            ("123##1AABB", fd(false, 1), 0x123, &[0xAA, 0xBB]),
            ("123##5.AA.BB", fd(false, 5), 0x123, &[0xAA, 0xBB]),
            ("18ff50e5##f00", fd(true, 15), 0x18FF_50E5, &[0]),
            ("45123#81:00:12345678#11223344.556677", Xl, 0x123, &[0x11, 0x22, 0x33, 0x44, 0x55, 0x66, 0x77]),
            ("457FF#80:01:00000000#00", Xl, 0x7FF, &[0]),
            ("123#81:00:12345678#11", Xl, 0x123, &[0x11]),
            ("00000123#0011", Extended, 0x123, &[0, 0x11]),
        ];
        for (text, kind, id, data) in cases {
            assert_eq!(read(text), Ok((kind, id, data.to_vec())), "{text}");
        }
    }

    #[test]
    fn every_length_is_read_up_to_the_most() {
        for len in 0..=64 {
            let data = counting(len);
            if len <= 8 {
                let text = format!("520#{}", digits(&data));
                assert_eq!(read(&text), Ok((FrameKind::Standard, 0x520, data.clone())), "{text}");
            }
            let text = format!("520##0{}", digits(&data));
            let kind = FrameKind::Fd { extended: false, flags: 0 };
            assert_eq!(read(&text), Ok((kind, 0x520, data)), "{text}");
        }
        let longest = [0xA5; MAX_DATA];
        let text = format!("00123#81:00:12345678#{}", digits(&longest));
        assert_eq!(read(&text), Ok((FrameKind::Xl, 0x123, longest.to_vec())));
        assert_eq!(read(&format!("{text}00")).map_err(|flaw| flaw.expected), Err(AT_MOST_2048));
        let text = format!("123##0{}", digits(&counting(65)));
        assert_eq!(read(&text), Err(Flaw { at: text.len() - 2, expected: AT_MOST_64 }));
    }

    #[test]
    fn other_frames_are_refused_where_they_go_wrong() {
        let cases = [
            ("", 0, IDENTIFIER),
            ("520", 0, IDENTIFIER),
            ("52#00", 0, IDENTIFIER),
            ("0520#00", 0, IDENTIFIER),
            ("520  [8]  00 00", 0, IDENTIFIER),
            ("5x0#00", 1, ID_DIGIT),
            ("1234567g#00", 7, ID_DIGIT),
            ("800#00", 0, STANDARD_ID),
            ("FFF#00", 0, STANDARD_ID),
            ("40000000#00", 0, EXTENDED_ID),
            ("FFFFFFFF#00", 0, EXTENDED_ID),
            ("520#0", 5, LOW_DIGIT),
            ("520#00000100000", 15, LOW_DIGIT),
            ("520#00.0", 8, LOW_DIGIT),
            ("520#0.0", 5, LOW_DIGIT),
            ("520#000102030405060708", 20, AT_MOST_8),
            ("520#00.01.02.03.04.05.06.07.08", 28, AT_MOST_8),
            ("520#000102030405060708090A0B", 20, AT_MOST_8),
            ("520#000102030405060708090A0B0C0D0E0F", 20, AT_MOST_8),
            ("123#1122334455667788_8", 21, RAW_LEN),
            ("123#1122334455667788_", 21, RAW_LEN),
            ("123#R8_", 7, RAW_LEN),
            ("123#R9", 5, REMOTE_LEN),
            ("123##", 5, FD_FLAGS),
            ("123##x", 5, FD_FLAGS),
            ("45123#00", 8, XL_HEADER),
            ("45FFF#81:00:12345678#11", 2, STANDARD_ID),
            ("123#81:0x:12345678#11", 8, XL_HEADER),
        ];
        for (text, at, expected) in cases {
            assert_eq!(read(text), Err(Flaw { at, expected }), "{text}");
        }
    }
}
