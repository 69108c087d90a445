//! Numbers, dates and marks as the text of recordings has them, for the readers of every format.

mod date;
mod number;

pub use date::days;
pub(crate) use number::{NONE, VALUE};
pub use number::{decimal, hex, hex_byte, hex_digit, time_ns};

/// What some editors put before the first character of a text in UTF-8.
pub const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";
