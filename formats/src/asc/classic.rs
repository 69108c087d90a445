//! Lines of a channel: `1  520  Rx  d 8 00 ...`, error frames, and what else a channel has to tell.

use adsdv_oracle::candump::FrameKind;

use crate::text::{Cursor, Flaw, Frame, MAX_CLASSIC, Meaning, Word, decimal, standard_or_extended};

use super::{Asc, CHANNEL, ID, direction};

const SORT: &str = "d (data) or r (remote), and a length";
const LEN: &str = "a length code of 0 to 15, of which 8 and more mean 8 bytes of data";
const NO_MORE: &str = "the end of the data: there are more bytes than the length before them says";

/// Whether the words behind a channel that is no number are those of a frame.
pub(super) fn is_frame(mut cursor: Cursor<'_>) -> bool {
    cursor.word();
    let (direction, sort) = (cursor.word(), cursor.word());
    super::direction(direction).is_ok() && (sort.is("d") || sort.is("r"))
}

impl Asc {
    /// Reads what stands behind a channel.
    #[inline]
    pub(super) fn classic(
        &self,
        channel: Word<'_>,
        mut cursor: Cursor<'_>,
        frame: &mut Frame,
    ) -> Result<Meaning, Flaw> {
        frame.set_interface(channel, CHANNEL)?;
        let name = cursor.word();
        let id = self.identifier(name);
        if id.is_none() {
            if name.text.is_empty() {
                return Err(name.flaw(CHANNEL));
            }
            if name.is("ErrorFrame") {
                frame.set_error(None);
                return Ok(Meaning::Frame);
            }
            if name.is("OverloadFrame") || name.is("J1939TP") || name.text.ends_with(b":") {
                return Ok(Meaning::Other);
            }
        }
        let Some(direction) = direction(cursor.word())? else { return Ok(Meaning::Other) };
        frame.direction = Some(direction);
        let sort = cursor.word();
        let remote = match sort.text {
            b"d" => false,
            b"r" => true,
            _ if sort.is("d") => false,
            _ if sort.is("r") => true,
            _ => return Err(sort.flaw(SORT)),
        };
        let code = self.len(&mut cursor, remote)?;
        self.data(&mut cursor, if remote { 0 } else { code.into() }, frame)?;
        let (extended, id) = match id {
            Some(id) => {
                self.check_end(cursor)?;
                id
            }
            None => id_field(cursor).ok_or_else(|| name.flaw(ID))?,
        };
        frame.id = id;
        frame.kind = match extended {
            _ if remote => FrameKind::Remote { extended, len: code },
            false => FrameKind::Standard,
            true => FrameKind::Extended,
        };
        Ok(Meaning::Frame)
    }

    /// Takes the number of bytes of data; the oldest files have none for a remote frame.
    #[inline]
    fn len(&self, cursor: &mut Cursor<'_>, remote: bool) -> Result<u8, Flaw> {
        let before = *cursor;
        let code = cursor.word();
        match self.number(code.text) {
            Some(code @ 0..=8) => Ok(u8::try_from(code).unwrap_or(8)),
            Some(9..=15) => Ok(8),
            None if remote => {
                *cursor = before;
                Ok(0)
            }
            _ => Err(code.flaw(LEN)),
        }
    }

    /// What stands behind the data is not more of it.
    #[inline]
    fn check_end(&self, mut cursor: Cursor<'_>) -> Result<(), Flaw> {
        cursor.skip_blanks();
        if let Some(b'0'..=b'9' | b'a'..=b'f' | b'A'..=b'F') = cursor.peek() {
            let word = cursor.word();
            if self.number(word.text).is_some_and(|number| number <= 0xFF) {
                return Err(word.flaw(NO_MORE));
            }
        }
        Ok(())
    }
}

/// The identifier behind the data, always in decimal: `ID = 1312`, or `ID = 418119424x`.
fn id_field(mut cursor: Cursor<'_>) -> Option<(bool, u32)> {
    while !cursor.is_at_end() {
        if cursor.word().text == b"ID" && cursor.word().text == b"=" {
            let (extended, digits) = match cursor.word().text {
                [digits @ .., b'x'] => (true, digits),
                digits => (false, digits),
            };
            let id = decimal(digits)?.try_into().ok()?;
            return standard_or_extended(extended, id).map(|_| (extended, id));
        }
    }
    None
}

const _: () = assert!(MAX_CLASSIC == 8, "LEN names it");
