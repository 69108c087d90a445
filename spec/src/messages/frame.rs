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
/// assert_eq!(Frame::new(0x800, &[]), None);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "FrameParts"))]
pub struct Frame {
    /// The identifier.
    pub id: u16,
    /// How many bytes of `data` are sent: 0 to 8; a larger number counts as 8.
    pub len: u8,
    /// The data; bytes from `len` on are not sent, and are zero in every frame this crate makes.
    pub data: [u8; FRAME_BYTES],
}

impl Frame {
    /// The highest identifier of 11 bits.
    pub const MAX_ID: u16 = 0x7FF;

    /// A frame that carries `data`, or `None` if that is more than eight bytes or the identifier is more than
    /// [`MAX_ID`](Self::MAX_ID).
    pub fn new(id: u16, data: &[u8]) -> Option<Self> {
        if id > Self::MAX_ID {
            return None;
        }
        let mut bytes = [0; FRAME_BYTES];
        bytes.get_mut(..data.len())?.copy_from_slice(data);
        Some(Self { id, len: u8::try_from(data.len()).ok()?, data: bytes })
    }

    /// Whether this is a frame that can be on the bus, written in the one way this crate writes it: an identifier
    /// and a length that there are, and zeros where nothing is sent.
    pub fn is_valid(&self) -> bool {
        Self::new(self.id, self.data()) == Some(*self)
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

/// A frame as it is read, before it is looked at.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
#[serde(rename = "Frame", deny_unknown_fields)]
struct FrameParts {
    id: u16,
    len: u8,
    data: [u8; FRAME_BYTES],
}

#[cfg(feature = "serde")]
impl TryFrom<FrameParts> for Frame {
    type Error = &'static str;

    fn try_from(FrameParts { id, len, data }: FrameParts) -> Result<Self, Self::Error> {
        let frame = Self { id, len, data };
        if frame.is_valid() {
            return Ok(frame);
        }
        Err(if id > Self::MAX_ID {
            "the identifier of a frame has 11 bits: 0 to 2047"
        } else if usize::from(len) <= FRAME_BYTES {
            "the data of a frame is zero from len on"
        } else {
            "the len of a frame is 0 to 8"
        })
    }
}

/// A valid frame from any numbers: what is too much is cut off.
#[cfg(any(kani, feature = "arbitrary", feature = "proptest"))]
fn valid(id: u16, len: u8, mut data: [u8; FRAME_BYTES]) -> Frame {
    let len = len.min(FRAME_BYTES as u8);
    let mut i = usize::from(len);
    while i < FRAME_BYTES {
        data[i] = 0;
        i += 1;
    }
    Frame { id: id & Frame::MAX_ID, len, data }
}

#[cfg(kani)]
impl kani::Arbitrary for Frame {
    fn any() -> Self {
        valid(kani::any(), kani::any(), kani::any())
    }
}

#[cfg(feature = "arbitrary")]
impl arbitrary::Arbitrary<'_> for Frame {
    fn arbitrary(u: &mut arbitrary::Unstructured<'_>) -> arbitrary::Result<Self> {
        Ok(valid(u.arbitrary()?, u.int_in_range(0..=FRAME_BYTES as u8)?, u.arbitrary()?))
    }
}

#[cfg(feature = "proptest")]
impl proptest::arbitrary::Arbitrary for Frame {
    type Parameters = ();
    type Strategy = proptest::strategy::BoxedStrategy<Self>;

    fn arbitrary_with((): ()) -> Self::Strategy {
        use proptest::prelude::{Strategy, any};
        (0..=Self::MAX_ID, 0..=FRAME_BYTES as u8, any::<[u8; FRAME_BYTES]>())
            .prop_map(|(id, len, data)| valid(id, len, data))
            .boxed()
    }
}
