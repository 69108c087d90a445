//! The bus of the edition that tests are about where they say nothing else.

use adsdv_spec::messages::{AnyMessage, Frame, Message, MessageDef};
use adsdv_spec::{Bus, Edition};

/// The bus of [`Edition::DEFAULT`].
pub const BUS: &Bus = &Edition::DEFAULT.bus;

/// The frame of a message.
///
/// # Panics
///
/// If the edition has no such message.
pub fn encoded(message: impl Into<AnyMessage>) -> Frame {
    BUS.encode(message).expect("the edition has it")
}

/// The row of a message.
///
/// # Panics
///
/// If the edition has no such message.
pub const fn def_of<M: Message>() -> &'static MessageDef {
    BUS.message(M::ID).expect("the edition has it")
}
