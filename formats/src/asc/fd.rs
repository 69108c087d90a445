//! Lines of a CAN FD channel: `CANFD  1 Rx  520  Name  1 0 8  8 00 ...  102000 130 303000 ...`.

use adsdv_oracle::candump::FrameKind;

use crate::text::{
    BRS_FLAG, Cursor, ESI_FLAG, Flaw, Frame, MAX_CLASSIC, MAX_FD, Meaning, Word, decimal, hex,
};

use super::{Asc, CHANNEL, direction};

const ID: &str = "an identifier, such as 520: up to 7FF, or up to 1FFFFFFF with an x behind it";
const BRS: &str = "0 or 1, whether the bit rate was switched, perhaps behind a name";
const ESI: &str = "0 or 1, the error state of the sender";
const CODE: &str = "a length code of 0 to f";
const LEN: &str = "the number of data bytes, up to 64";

/// Of the flags of a line: it is a remote frame.
const REMOTE: u32 = 1 << 4;
/// Of the flags of a line: it is a CAN FD frame, not a classic one.
const EDL: u32 = 1 << 12;

impl Asc {
    /// Reads what stands behind `CANFD`.
    pub(super) fn fd(&self, mut cursor: Cursor<'_>, frame: &mut Frame) -> Result<Meaning, Flaw> {
        let channel = cursor.word();
        decimal(channel.text).ok_or_else(|| channel.flaw(CHANNEL))?;
        frame.set_interface(channel, CHANNEL)?;
        let Some(direction) = direction(cursor.word())? else { return Ok(Meaning::Other) };
        let name = cursor.word();
        if name.is("ErrorFrame") {
            frame.set_error(Some(direction));
            return Ok(Meaning::Frame);
        }
        let (extended, id) = self.identifier(name).ok_or_else(|| name.flaw(ID))?;
        let mut word = cursor.word();
        if !is_bit(word) && word.text.first().is_some_and(|byte| !byte.is_ascii_digit()) {
            word = cursor.word();
        }
        let switched = bit(word, BRS_FLAG, BRS)?;
        let passive = bit(cursor.word(), ESI_FLAG, ESI)?;
        let code = cursor.word();
        // A digit whatever the base: vector_asc and python-can write it so. In decimal it may have two.
        let number = if self.decimal { decimal(code.text) } else { hex(code.text).map(u64::from) };
        let number = number.or_else(|| hex(code.text).map(u64::from));
        let number = number.filter(|code| *code <= 15).ok_or_else(|| code.flaw(CODE))?;
        let len = cursor.word();
        let count = decimal(len.text).and_then(|count| usize::try_from(count).ok());
        let count = count.filter(|count| *count <= MAX_FD).ok_or_else(|| len.flaw(LEN))?;
        self.data(&mut cursor, count, frame)?;
        let flags = flags(cursor);
        let asked = u8::try_from(number.min(8)).unwrap_or(8);
        let fd = FrameKind::Fd { extended, flags: switched | passive };
        frame.kind = match flags {
            // Without data though there is a length, as Vector writes it.
            _ if count == 0 && number > 0 => FrameKind::Remote { extended, len: asked },
            Some(flags) if flags & REMOTE != 0 && flags & EDL == 0 && count <= MAX_CLASSIC => {
                frame.set_len(0);
                FrameKind::Remote { extended, len: asked }
            }
            Some(flags) if flags & EDL == 0 && count <= MAX_CLASSIC => {
                if extended {
                    FrameKind::Extended
                } else {
                    FrameKind::Standard
                }
            }
            _ => fd,
        };
        (frame.id, frame.direction) = (id, Some(direction));
        Ok(Meaning::Frame)
    }
}

fn is_bit(word: Word<'_>) -> bool {
    matches!(word.text, b"0" | b"1")
}

/// The flag, if the word says so.
fn bit(word: Word<'_>, flag: u8, expected: &'static str) -> Result<u8, Flaw> {
    match word.text {
        b"0" => Ok(0),
        b"1" => Ok(flag),
        _ => Err(word.flaw(expected)),
    }
}

/// The flags of the frame: the third word behind the data, always in hexadecimal.
fn flags(mut cursor: Cursor<'_>) -> Option<u32> {
    // How long it took, and how many bits it had.
    cursor.word();
    cursor.word();
    hex(cursor.word().text)
}
