//! The type of a line.

use adsdv_oracle::candump::Direction;

use crate::text::{BRS_FLAG, ESI_FLAG, Flaw, Word};

const TYPE: &str = "Rx, Tx, Error or Warng, or from version 2.0 on DT, FD, FB, FE, BI, RR, ER, ST, EC or EV";

/// What sort of line it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Sort {
    /// A classic data frame; in versions 1 it may turn out to be a remote frame.
    Data,
    /// A CAN FD frame with these flags.
    Fd(u8),
    /// A remote frame.
    Remote,
    /// An error frame.
    Error,
    /// No frame.
    Event,
}

impl Sort {
    /// What the word for it says; versions 1 have the direction in it.
    #[inline]
    pub(super) fn of(word: Word<'_>) -> Result<(Self, Option<Direction>), Flaw> {
        let sort = match word.text {
            b"Rx" => return Ok((Self::Data, Some(Direction::Rx))),
            b"Tx" => return Ok((Self::Data, Some(Direction::Tx))),
            b"DT" => Self::Data,
            b"FD" => Self::Fd(0),
            b"FB" => Self::Fd(BRS_FLAG),
            b"BI" => Self::Fd(ESI_FLAG),
            b"FE" => Self::Fd(BRS_FLAG | ESI_FLAG),
            b"RR" => Self::Remote,
            b"ER" | b"Error" => Self::Error,
            b"ST" | b"EC" | b"EV" | b"Warng" => Self::Event,
            _ => return Err(word.flaw(TYPE)),
        };
        Ok((sort, None))
    }

    /// Whether its length is one of CAN FD.
    #[inline]
    pub(super) const fn is_fd(self) -> bool {
        matches!(self, Self::Fd(_))
    }
}
