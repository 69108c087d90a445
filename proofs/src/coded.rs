//! The messages as version 3.0 lays them out, which is what the theorems on the codec speak of.

use adsdv_spec::editions::V3_0;
use adsdv_spec::messages::{DecodeError, Frame, Layout, Message, MessageDef};

/// A message that version 3.0 has. These are the functions of its [`Layout`], without a pointer to them.
pub(crate) trait Coded: Message + PartialEq {
    /// [`Layout::DEF`].
    const DEF: &'static MessageDef;

    /// [`Layout::decode`].
    fn decode(data: &[u8]) -> Result<Self, DecodeError>;

    /// [`Layout::encode`].
    fn encode(&self) -> Frame;

    /// [`Layout::holds`].
    fn is_held(&self) -> bool;
}

impl<M: Message + PartialEq> Coded for M
where
    V3_0: Layout<M>,
{
    const DEF: &'static MessageDef = <V3_0 as Layout<M>>::DEF;

    fn decode(data: &[u8]) -> Result<M, DecodeError> {
        V3_0::decode(data)
    }

    fn encode(&self) -> Frame {
        V3_0::encode(self)
    }

    fn is_held(&self) -> bool {
        <V3_0 as Layout<M>>::holds(self)
    }
}
