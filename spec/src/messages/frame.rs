//! A frame on the bus.

use core::fmt;

use super::bits::FRAME_BYTES;

/// A classic CAN data frame with an 11-bit identifier.
///
/// It displays as `candump` writes it.
///
/// ```
/// use adsdv_spec::messages::Frame;
///
/// let frame = Frame::new(0x513, &[0x64, 0x00]).expect("two bytes fit");
/// assert_eq!(frame.to_string(), "513#6400");
/// assert_eq!(Frame::new(0x513, &[0; 9]), None);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(kani, derive(kani::Arbitrary))]
pub struct Frame {
    /// The identifier.
    pub id: u16,
    /// How many bytes of `data` are sent: 0 to 8; a larger number counts as 8.
    pub len: u8,
    /// The data; bytes from `len` on are not sent, and are zero in every frame this crate makes.
    pub data: [u8; FRAME_BYTES],
}

impl Frame {
    /// A frame that carries `data`, or `None` if that is more than eight bytes.
    pub fn new(id: u16, data: &[u8]) -> Option<Self> {
        let mut bytes = [0; FRAME_BYTES];
        bytes.get_mut(..data.len())?.copy_from_slice(data);
        Some(Self { id, len: u8::try_from(data.len()).ok()?, data: bytes })
    }

    /// The bytes that are sent.
    #[inline]
    pub fn data(&self) -> &[u8] {
        self.data.get(..usize::from(self.len)).unwrap_or(&self.data)
    }
}

impl fmt::Display for Frame {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:03X}#", self.id)?;
        self.data().iter().try_for_each(|byte| write!(f, "{byte:02X}"))
    }
}
