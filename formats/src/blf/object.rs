//! What every object begins with.

use memchr::memmem;

use crate::bytes::{u16_at, u32_at, u64_at};

/// How an object begins.
pub(super) const SIGNATURE: &[u8] = b"LOBJ";
/// The part of its header that every object has: signature, sizes, version, type.
pub(super) const BASE: usize = 16;
/// No object is larger than this; a size beyond it is damage, and is not believed.
const LARGEST: u32 = 1 << 26;
/// No header is longer than this.
const LONGEST_HEADER: usize = 4096;

/// The type of an object that holds others.
pub(super) const LOG_CONTAINER: u32 = 10;

const TEN_MICROSECONDS: u32 = 1;

/// The header of an object.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Header {
    /// Bytes before the object's own.
    pub(super) len: usize,
    /// Bytes of the object, its header included.
    pub(super) size: usize,
    /// What it is.
    pub(super) kind: u32,
}

/// The header that stands at the beginning of these bytes, if it makes sense: a signature alone can be data.
pub(super) fn header(bytes: &[u8]) -> Option<Header> {
    if !bytes.starts_with(SIGNATURE) {
        return None;
    }
    let (len, version) = (u16_at(bytes, 4)?, u16_at(bytes, 6)?);
    let (size, kind) = (u32_at(bytes, 8)?, u32_at(bytes, 12)?);
    let least = match (kind, version) {
        (LOG_CONTAINER, _) => BASE,
        (_, 1) => 32,
        (_, 2) => 40,
        _ => return None,
    };
    let header = Header { len: usize::from(len), size: usize::try_from(size).ok()?, kind };
    let lengths = least..=header.size.min(LONGEST_HEADER);
    (lengths.contains(&header.len) && size <= LARGEST).then_some(header)
}

/// Where the first header stands that makes sense; else, how many bytes at the beginning are certain to hold none.
pub(super) fn find(bytes: &[u8]) -> Result<usize, usize> {
    for at in memmem::find_iter(bytes, SIGNATURE) {
        let here = bytes.get(at..).unwrap_or_default();
        if here.len() < BASE {
            return Err(at);
        }
        if header(here).is_some() {
            return Ok(at);
        }
    }
    Err(bytes.len().saturating_sub(SIGNATURE.len() - 1))
}

/// The time of an object in nanoseconds since the measurement began, of a header of either version.
pub(super) fn time(object: &[u8]) -> Option<i64> {
    let (flags, stamp) = (u32_at(object, 16)?, u64_at(object, 24)?);
    let unit = if flags == TEN_MICROSECONDS { 10_000 } else { 1 };
    i64::try_from(stamp.checked_mul(unit)?).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bytes(len: u16, version: u16, size: u32, kind: u32) -> Vec<u8> {
        let mut bytes = SIGNATURE.to_vec();
        bytes.extend([len.to_le_bytes(), version.to_le_bytes()].concat());
        bytes.extend([size.to_le_bytes(), kind.to_le_bytes()].concat());
        bytes
    }

    #[test]
    fn a_header_that_makes_no_sense_is_none() {
        assert_eq!(header(&bytes(32, 1, 48, 1)), Some(Header { len: 32, size: 48, kind: 1 }));
        assert_eq!(header(&bytes(40, 2, 56, 86)), Some(Header { len: 40, size: 56, kind: 86 }));
        assert_eq!(header(&bytes(16, 1, 32, 10)), Some(Header { len: 16, size: 32, kind: 10 }));
        for damaged in [
            bytes(31, 1, 48, 1),
            bytes(39, 2, 48, 1),
            bytes(32, 1, 31, 1),
            bytes(32, 3, 48, 1),
            bytes(32, 1, LARGEST + 1, 1),
            bytes(15, 1, 48, 10),
            bytes(4097, 1, 5000, 10),
        ] {
            assert_eq!(header(&damaged), None, "{damaged:?}");
        }
        let whole = bytes(32, 1, 48, 1);
        for len in 0..BASE {
            assert_eq!(header(whole.get(..len).unwrap_or_default()), None);
        }
    }

    #[test]
    fn the_next_header_is_the_first_that_makes_sense() {
        let mut text = b"..LOBJ LOBJ".to_vec();
        text.extend(bytes(32, 1, 48, 1));
        assert_eq!(find(&text), Ok(11));
        assert_eq!(find(b"..LOBJ"), Err(2), "more has to come before anything can be said");
        assert_eq!(find(b"......LOB"), Err(6));
        assert_eq!(find(b"x"), Err(0));
    }

    #[test]
    fn time_is_in_nanoseconds_or_tens_of_microseconds() {
        let at = |flags: u32, stamp: u64| {
            let mut object = bytes(32, 1, 48, 1);
            object.extend(flags.to_le_bytes());
            object.extend([0; 4]);
            object.extend(stamp.to_le_bytes());
            time(&object)
        };
        assert_eq!(at(2, 1_234), Some(1_234));
        assert_eq!(at(1, 1_234), Some(12_340_000));
        assert_eq!((at(1, u64::MAX / 2), at(2, u64::MAX)), (None, None), "no time is that late");
    }
}
