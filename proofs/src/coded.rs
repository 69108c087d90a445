//! The messages as an edition lays them out, which is what the theorems on the codec speak of: version 3.0 where they name
//! no other.

use adsdv_spec::messages::{DecodeError, Frame, Layout, Message, MessageDef};

use crate::document::Layouts;

/// A message that an edition has. These are the functions of its [`Layout`], without a pointer to them.
pub(crate) trait Coded<E = Layouts>: Message + PartialEq {
    /// [`Layout::DEF`].
    const DEF: &'static MessageDef;

    /// [`Layout::decode`].
    fn decode(data: &[u8]) -> Result<Self, DecodeError>;

    /// [`Layout::encode`].
    fn encode(&self) -> Frame;

    /// [`Layout::holds`].
    fn is_held(&self) -> bool;
}

impl<E: Layout<M>, M: Message + PartialEq> Coded<E> for M {
    const DEF: &'static MessageDef = <E as Layout<M>>::DEF;

    fn decode(data: &[u8]) -> Result<M, DecodeError> {
        E::decode(data)
    }

    fn encode(&self) -> Frame {
        E::encode(self)
    }

    fn is_held(&self) -> bool {
        <E as Layout<M>>::holds(self)
    }
}
