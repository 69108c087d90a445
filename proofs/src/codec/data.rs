//! Data of a frame: drawn, cut by hand, read, and written again.

use adsdv_spec::messages::Frame;
#[cfg(not(kani))]
use adsdv_spec::{editions::V2026, messages::AnyMessage};

use crate::prelude::*;

/// What came with a frame: up to nine bytes, one more than there can be. More would change nothing: no decoder looks
/// beyond the eighth.
#[derive(Clone, Copy, Debug)]
pub(super) struct Data {
    bytes: [u8; 9],
    len: u8,
}

/// What the CAN database says of a message as a whole.
#[derive(Clone, Copy, Debug)]
pub(super) struct Layout {
    /// Its identifier.
    pub(super) id: u16,
    /// How many bytes it has when it is sent.
    pub(super) len: u8,
    /// The bits that belong to a signal, byte by byte.
    pub(super) used: [u8; 8],
}

impl Layout {
    /// The same as a word; byte 0 has the lowest bits.
    const fn used(&self) -> u64 {
        u64::from_le_bytes(self.used)
    }

    /// How many bytes hold every signal.
    const fn needed(&self) -> u32 {
        8 - self.used().leading_zeros() / 8
    }
}

impl Data {
    /// Any data.
    pub(super) fn any<M: Coded + kani::Arbitrary>() -> Self {
        Self::any_in::<Layouts, M>()
    }

    /// Any data, for a message of an edition.
    pub(super) fn any_in<E, M: Coded<E> + kani::Arbitrary>() -> Self {
        let data = Self { bytes: kani::any(), len: kani::any_where(|len| *len <= 9) };
        #[cfg(not(kani))]
        if kani::any() {
            return data.nearly(&kani::any::<M>().encode());
        }
        data
    }

    /// Any identifier, and any data.
    pub(super) fn any_with_id() -> (u16, Self) {
        let data = Self { bytes: kani::any(), len: kani::any_where(|len| *len <= 9) };
        #[cfg(not(kani))]
        if kani::any() {
            let message = kani::any::<AnyMessage>();
            let frame = if kani::any() { Layouts::write(&message) } else { V2026::write(&message) };
            let frame = frame.unwrap_or_default();
            return (frame.id, data.nearly(&frame));
        }
        (kani::any(), data)
    }

    /// The data of a frame, perhaps with a byte or a bit of it changed, or of another length. Random bytes hardly ever are
    /// a message, and what is nearly one is what to look at; a proof looks at everything anyhow.
    #[cfg(not(kani))]
    fn nearly(self, frame: &Frame) -> Self {
        let mut data = Self::of(frame);
        let place = usize::from(kani::any_where(|place: &u8| *place < 9));
        match kani::any_where(|change: &u8| *change < 4) {
            0 => data.bytes[place] = self.bytes[place],
            1 => data.bytes[place] ^= 1 << kani::any_where(|bit: &u8| *bit < 8),
            2 => data.len = self.len,
            _ => {}
        }
        data
    }

    /// The data of a frame.
    pub(super) fn of(frame: &Frame) -> Self {
        let mut bytes = [0; 9];
        bytes[..8].copy_from_slice(&frame.data);
        Self { bytes, len: frame.len }
    }

    /// The bytes that there are.
    pub(super) fn given(&self) -> &[u8] {
        &self.bytes[..usize::from(self.len)]
    }

    /// The same as its decoder gets it.
    pub(super) fn received(&self, id: u16) -> Self {
        Self { bytes: subject().received(id, self.bytes), len: self.len }
    }

    /// The first eight bytes as a word; byte 0 has the lowest bits.
    pub(super) const fn word(&self) -> u64 {
        // Not as a part of the array: Kani has no such pattern.
        let [b0, b1, b2, b3, b4, b5, b6, b7, _] = self.bytes;
        u64::from_le_bytes([b0, b1, b2, b3, b4, b5, b6, b7])
    }

    /// A byte.
    pub(super) fn u8_at(&self, byte: usize) -> i32 {
        self.bytes[byte].into()
    }

    /// A byte with a sign.
    pub(super) fn i8_at(&self, byte: usize) -> i32 {
        i8::from_le_bytes([self.bytes[byte]]).into()
    }

    /// Two bytes, the low one first.
    pub(super) fn u16_at(&self, byte: usize) -> i32 {
        u16::from_le_bytes([self.bytes[byte], self.bytes[byte + 1]]).into()
    }

    /// Two bytes with a sign, the low one first.
    pub(super) fn i16_at(&self, byte: usize) -> i32 {
        i16::from_le_bytes([self.bytes[byte], self.bytes[byte + 1]]).into()
    }

    /// A bit of a byte; bit 0 is the lowest.
    pub(super) fn bit(&self, byte: usize, bit: u32) -> bool {
        self.bytes[byte] >> bit & 1 == 1
    }

    /// So many bits of a byte, from this one upwards.
    pub(super) fn bits(&self, byte: usize, first: u32, count: u32) -> i32 {
        (self.bytes[byte] >> first & (0xFF >> (8 - count))).into()
    }

    /// The message in this data, of which it is known whether its values are allowed.
    ///
    /// Asserts that there is one if and only if every signal is there and every value allowed; and that it is written
    /// again as the bits of these signals and no others.
    pub(super) fn read<M: Coded>(&self, layout: &Layout, allowed: bool) -> Option<M> {
        self.read_in::<Layouts, M>(layout, allowed)
    }

    /// The same of a message of an edition.
    pub(super) fn read_in<E, M: Coded<E>>(&self, layout: &Layout, allowed: bool) -> Option<M> {
        self.read_as_in::<E, M>(layout, allowed, self.word())
    }

    /// The same where a number stands for another one: what is written again are the signals' bits of `meant`.
    pub(super) fn read_as_in<E, M: Coded<E>>(&self, layout: &Layout, allowed: bool, meant: u64) -> Option<M> {
        let complete = u32::from(self.len) >= layout.needed();
        kani::cover!(!complete && allowed, "the end is missing");
        kani::cover!(complete && allowed && u32::from(self.len) == layout.needed(), "all is just there");

        let read = M::decode(self.received(layout.id).given()).ok();
        assert!(read.is_some() == (complete && allowed), "read if and only if all is there and allowed");
        if let Some(message) = read {
            let written = written::<E, M>(message, layout);
            assert!(written.word() == meant & layout.used(), "written as the bits of the signals alone");
        }
        read
    }
}

/// The data that a message is written as. Asserts that its frame has this identifier, this length and nothing outside of
/// the signals, and that it is read as the same message.
fn written<E, M: Coded<E>>(message: M, layout: &Layout) -> Data {
    let frame = subject().sent(message.encode());
    assert!(frame.id == layout.id, "the identifier");
    assert!(frame.len == layout.len, "the length");
    let data = Data::of(&frame);
    assert!(data.word() & !layout.used() == 0, "bits of no signal are 0");
    assert!(M::decode(data.received(layout.id).given()).ok() == Some(message), "read as the same message");
    data
}

/// Any message that the edition can say is written as one that is read as the same.
pub(super) fn any_is_written<M: Coded + kani::Arbitrary>(layout: &Layout) {
    any_is_written_in::<Layouts, M>(layout);
}

/// The same of a message of an edition.
pub(super) fn any_is_written_in<E, M: Coded<E> + kani::Arbitrary>(layout: &Layout) {
    let message = kani::any::<M>();
    kani::assume(message.is_held());
    let data = written::<E, M>(message, layout);
    kani::cover!(data.word() != 0, "something is in it");
}
