//! Where a signal's bits are in the data of a frame, and how they are read as a number.

/// In which order the bits of a signal go on from byte to byte.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Order {
    /// The lowest byte comes first: `@1` in a DBC, called Intel. All signals of the ADS-DV are so.
    Little,
    /// The highest byte comes first: `@0` in a DBC, called Motorola.
    Big,
}

/// What the bits are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coding {
    /// A number without a sign.
    Unsigned,
    /// Two's complement.
    Signed,
    /// An IEEE 754 number; 32 or 64 bits.
    Float,
}

/// The most bits of a signal.
pub(crate) const MAX_WIDTH: u32 = 64;

/// The most bits of a frame: those of CAN FD.
pub(crate) const MAX_BITS: u32 = 512;

/// The bits of a signal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place {
    /// The first bit in the order in which they go on; of [`Order::Big`] counted from the highest bit of the first byte.
    first: u32,
    width: u32,
    order: Order,
    coding: Coding,
}

impl Place {
    /// Bits from a start bit on, as a DBC numbers them: the lowest bit of [`Order::Little`], the highest of [`Order::Big`], where bit 0 is
    /// the lowest of the first byte. `None` for bits that no frame has, and for a float of another width than 32 or 64.
    pub fn new(start: u32, width: u32, order: Order, coding: Coding) -> Option<Self> {
        let first = match order {
            Order::Little => start,
            Order::Big => (start - start % 8) + (7 - start % 8),
        };
        let fits = (1..=MAX_WIDTH).contains(&width) && first < MAX_BITS && first + width <= MAX_BITS;
        let is_number = coding != Coding::Float || matches!(width, 32 | 64);
        (fits && is_number).then_some(Self { first, width, order, coding })
    }

    /// How many bits.
    pub const fn width(&self) -> u32 {
        self.width
    }

    /// What they are.
    pub const fn coding(&self) -> Coding {
        self.coding
    }

    /// The length that data must have to hold them.
    pub const fn bytes_needed(&self) -> usize {
        (self.first + self.width).div_ceil(8) as usize
    }

    /// The bits, the lowest first; `None` if the data ends before they do.
    ///
    /// ```
    /// use adsdv_decode::{Coding, Order, Place};
    ///
    /// let place = |start, order| Place::new(start, 12, order, Coding::Unsigned).expect("twelve bits");
    /// assert_eq!(place(4, Order::Little).bits(&[0x3F, 0x12]), Some(0x123));
    /// assert_eq!(place(7, Order::Big).bits(&[0x12, 0x3F]), Some(0x123));
    /// assert_eq!(place(7, Order::Big).bits(&[0x12]), None);
    /// ```
    #[inline]
    pub fn bits(&self, data: &[u8]) -> Option<u64> {
        let end = self.first + self.width;
        if let (Order::Little, Some(word)) = (self.order, data.first_chunk())
            && end <= 64
        {
            return Some((u64::from_le_bytes(*word) >> self.first) & self.mask());
        }
        self.gather(data)
    }

    /// The same from any data.
    fn gather(&self, data: &[u8]) -> Option<u64> {
        let (from, end) = ((self.first / 8) as usize, self.first + self.width);
        let bytes = data.get(from..end.div_ceil(8) as usize)?;
        // At most nine bytes.
        let join = |word: u128, byte: &u8| word << 8 | u128::from(*byte);
        let word = match self.order {
            Order::Little => bytes.iter().rev().fold(0, join) >> (self.first % 8),
            Order::Big => bytes.iter().fold(0, join) >> (end.next_multiple_of(8) - end),
        };
        #[expect(clippy::cast_possible_truncation, reason = "the mask has no more bits than that")]
        Some(word as u64 & self.mask())
    }

    const fn mask(&self) -> u64 {
        u64::MAX >> (MAX_WIDTH - self.width)
    }

    /// The raw number that these bits are; of a float, the bits themselves.
    #[inline]
    pub fn raw(&self, bits: u64) -> i128 {
        match self.coding {
            Coding::Unsigned | Coding::Float => i128::from(bits),
            Coding::Signed => i128::from(self.extended(bits)),
        }
    }

    /// The bits with the highest one repeated.
    #[inline]
    pub(crate) const fn extended(&self, bits: u64) -> i64 {
        let shift = MAX_WIDTH - self.width;
        bits.wrapping_shl(shift).cast_signed() >> shift
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn place(start: u32, width: u32, order: Order, coding: Coding) -> Place {
        Place::new(start, width, order, coding).expect("bits of a frame")
    }

    #[test]
    fn both_orders_cross_bytes() {
        let data = [0x01, 0x23, 0x45, 0x67, 0x89, 0xAB, 0xCD, 0xEF, 0xFE];
        let little = |start, width| place(start, width, Order::Little, Coding::Unsigned).bits(&data);
        assert_eq!(little(0, 64), Some(0xEFCD_AB89_6745_2301));
        assert_eq!(little(4, 64), Some(0xEEFC_DAB8_9674_5230));
        assert_eq!(little(68, 4), Some(0xF));
        let big = |start, width| place(start, width, Order::Big, Coding::Unsigned).bits(&data);
        assert_eq!(big(7, 64), Some(0x0123_4567_89AB_CDEF));
        assert_eq!(big(3, 64), Some(0x1234_5678_9ABC_DEFF));
        assert_eq!((big(7, 1), big(0, 1), big(8, 3)), (Some(0), Some(1), Some(0b101)));
    }

    #[test]
    fn bits_behind_the_data_are_none() {
        for order in [Order::Little, Order::Big] {
            let place = place(8 + 7 * u32::from(order == Order::Big), 9, order, Coding::Unsigned);
            assert_eq!((place.bits(&[0; 2]), place.bits(&[0; 3])), (None, Some(0)), "{order:?}");
            assert_eq!(place.bytes_needed(), 3);
        }
    }

    #[test]
    fn the_highest_bit_is_the_sign() {
        let signed = place(0, 4, Order::Little, Coding::Signed);
        assert_eq!((signed.raw(0b1000), signed.raw(0b0111), signed.raw(0b1111)), (-8, 7, -1));
        assert_eq!(place(0, 64, Order::Little, Coding::Signed).raw(u64::MAX), -1);
        assert_eq!(place(0, 64, Order::Little, Coding::Unsigned).raw(u64::MAX), u64::MAX.into());
    }

    #[test]
    fn no_frame_has_other_bits() {
        let new = |start, width, order| Place::new(start, width, order, Coding::Unsigned);
        for order in [Order::Little, Order::Big] {
            assert_eq!((new(0, 0, order), new(0, 65, order)), (None, None));
            assert_eq!((new(u32::MAX, 64, order), new(u32::MAX - 7, 1, order)), (None, None));
        }
        assert_eq!((new(511, 1, Order::Little).is_some(), new(512, 1, Order::Little)), (true, None));
        assert_eq!((new(504, 1, Order::Big).is_some(), new(504, 2, Order::Big)), (true, None));
        assert_eq!(Place::new(0, 16, Order::Little, Coding::Float), None);
    }
}
