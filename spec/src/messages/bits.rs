//! Where a signal's bits are in the eight bytes of a frame. All signals are little endian, so the data
//! is one 64-bit word and a signal is a run of its bits.
//!
//! A run is `width` bits from bit `start`, with `1 <= width <= 32` and `start + width <= 64`:
//! [`SignalDef`](super::SignalDef) cannot be built otherwise.

/// The number of data bytes of a classic CAN frame.
pub(super) const FRAME_BYTES: usize = 8;

/// The first `N` bytes as a word, or `None` if there are fewer. `N` is at most [`FRAME_BYTES`].
#[inline]
pub(crate) fn load<const N: usize>(data: &[u8]) -> Option<u64> {
    data.first_chunk::<N>().map(|head| load_slice(head))
}

/// Up to [`FRAME_BYTES`] bytes as a word; what is missing reads as zero.
#[inline]
pub(super) const fn load_slice(data: &[u8]) -> u64 {
    let mut word = 0;
    let mut index = 0;
    while index < data.len() && index < FRAME_BYTES {
        word |= (data[index] as u64) << (8 * index);
        index += 1;
    }
    word
}

/// The value of a run of bits.
#[inline]
#[expect(clippy::cast_possible_truncation, clippy::cast_possible_wrap, reason = "width is at most 32")]
pub(crate) const fn extract(word: u64, start: u8, width: u8, signed: bool) -> i32 {
    let left = word << (64 - start - width);
    if signed { (left as i64 >> (64 - width)) as i32 } else { (left >> (64 - width)) as i32 }
}

/// A word in which a run of bits holds `raw`, and every other bit is zero.
#[inline]
#[expect(clippy::cast_sign_loss, reason = "two's complement is what goes on the bus")]
pub(crate) const fn place(raw: i32, start: u8, width: u8) -> u64 {
    (raw as i64 as u64 & (u64::MAX >> (64 - width))) << start
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_at_both_ends_of_the_word() {
        assert_eq!(extract(1, 0, 1, false), 1);
        assert_eq!(extract(1, 0, 1, true), -1);
        assert_eq!(extract(0x80 << 56, 56, 8, false), 0x80);
        assert_eq!(extract(0x80 << 56, 56, 8, true), -128);
        assert_eq!(extract(u64::MAX, 32, 32, true), -1);
        assert_eq!(place(-1, 56, 8), 0xFF << 56);
        assert_eq!(place(-1, 0, 1), 1);
        assert_eq!(place(i32::MIN, 32, 32), 1 << 63);
    }

    #[test]
    fn what_is_placed_is_extracted() {
        for start in 0..=47 {
            for raw in [-65536, -32769, -1, 0, 1, 32768, 65535] {
                assert_eq!(extract(place(raw, start, 17), start, 17, true), raw, "start {start}");
            }
        }
    }

    #[test]
    fn bytes_are_little_endian_and_missing_ones_zero() {
        assert_eq!(load_slice(&[0x34, 0x12]), 0x1234);
        assert_eq!(load_slice(&[0, 0, 0, 0, 0, 0, 0, 1, 9, 9]), 1 << 56);
        assert_eq!(load::<2>(&[0x34, 0x12, 0xFF]), Some(0x1234));
        assert_eq!(load::<3>(&[0x34, 0x12]), None);
    }
}
