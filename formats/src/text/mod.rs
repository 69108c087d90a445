//! What the readers of text formats have in common: a line is read by a [`Dialect`], and everything around that is the same for all.

mod base64;
mod cursor;
mod date;
mod frame;
mod reader;
#[cfg(test)]
pub(crate) mod tests;

pub(crate) use adsdv_oracle::text::{days, decimal, hex, hex_byte, time_ns};
pub(crate) use base64::decode as decode_base64;
pub(crate) use cursor::{Cursor, Flaw, Word};
pub(crate) use date::{date_ns, days_ns};
pub(crate) use frame::{BRS_FLAG, ESI_FLAG, Frame, MAX_CLASSIC, MAX_FD, fd_len, standard_or_extended};
pub(crate) use reader::{Dialect, Meaning, TextReader};
