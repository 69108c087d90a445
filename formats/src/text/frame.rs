//! The frame that a line is read to.

use adsdv_oracle::candump::{Direction, FrameKind, Record};

use super::{Flaw, Word};

/// The most data that a classic frame holds, in bytes.
pub(crate) const MAX_CLASSIC: usize = 8;
/// The most data that a CAN FD frame holds, in bytes.
pub(crate) const MAX_FD: usize = 64;
/// Of the flags of a CAN FD frame: its data went with the faster bit rate.
pub(crate) const BRS_FLAG: u8 = 1;
/// Of the flags of a CAN FD frame: its sender was error passive.
pub(crate) const ESI_FLAG: u8 = 2;

/// The number of data bytes that each code of CAN FD stands for.
const FD_LEN: [u8; 16] = [0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 16, 20, 24, 32, 48, 64];

/// The number of data bytes that a length code of CAN FD stands for.
pub(crate) fn fd_len(code: u64) -> Option<usize> {
    FD_LEN.get(usize::try_from(code).ok()?).map(|len| usize::from(*len))
}

/// The kind of a data frame that has such an identifier, if there is one.
#[inline]
pub(crate) fn standard_or_extended(extended: bool, id: u32) -> Option<FrameKind> {
    let kind = if extended { FrameKind::Extended } else { FrameKind::Standard };
    (id <= kind.max_id()).then_some(kind)
}

/// What was read last; the reader hands out [`Record`]s of it.
#[derive(Debug)]
pub(crate) struct Frame {
    pub(crate) time_ns: i64,
    pub(crate) kind: FrameKind,
    pub(crate) id: u32,
    pub(crate) direction: Option<Direction>,
    data: [u8; MAX_FD],
    len: usize,
    interface: String,
}

impl Frame {
    /// No frame yet, on this interface.
    pub(crate) fn on(interface: &str) -> Self {
        Self {
            time_ns: 0,
            kind: FrameKind::Standard,
            id: 0,
            direction: None,
            data: [0; MAX_FD],
            len: 0,
            interface: interface.to_owned(),
        }
    }

    /// The data, to be written: `len` bytes.
    #[inline]
    pub(crate) fn room(&mut self, len: usize) -> &mut [u8] {
        self.len = len.min(MAX_FD);
        self.data.get_mut(..self.len).unwrap_or_default()
    }

    /// Room for the most data, of which [`set_len`](Self::set_len) tells how much is used.
    pub(crate) fn whole_room(&mut self) -> &mut [u8; MAX_FD] {
        &mut self.data
    }

    pub(crate) fn set_len(&mut self, len: usize) {
        self.len = len.min(MAX_FD);
    }

    /// Names the interface, which is that of the line before most of the time.
    #[inline]
    pub(crate) fn set_interface(&mut self, name: Word<'_>, expected: &'static str) -> Result<(), Flaw> {
        if self.interface.as_bytes() == name.text { Ok(()) } else { self.rename(name, expected) }
    }

    fn rename(&mut self, name: Word<'_>, expected: &'static str) -> Result<(), Flaw> {
        let text = str::from_utf8(name.text).ok();
        let text = text.filter(|text| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_graphic()));
        self.interface.clear();
        // Something has to be its name even if this one is not.
        self.interface.push_str(text.unwrap_or("?"));
        text.map(|_| ()).ok_or_else(|| name.flaw(expected))
    }

    /// An error frame, of which text tells no more than that it was there.
    pub(crate) fn set_error(&mut self, direction: Option<Direction>) {
        (self.kind, self.id, self.direction, self.len) = (FrameKind::Error, 0, direction, 0);
    }

    /// The frame as a record of a line.
    #[inline]
    pub(crate) fn record(&self, line: u64, terminated: bool) -> Record<'_> {
        let Self { time_ns, kind, id, direction, .. } = *self;
        let data = self.data.get(..self.len).unwrap_or_default();
        Record { line, time_ns, interface: &self.interface, kind, id, data, direction, terminated }
    }
}
