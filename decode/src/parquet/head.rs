//! The columns that every frame fills, and how many rows a group has.

use ::parquet::data_type::ByteArray;
use ::parquet::errors::Result;
use adsdv_oracle::candump::{FrameKind, Record};

use super::column::{self, Integers, Texts};
use crate::line::{kind_name, put_id};

/// The column of times, in every table.
pub(super) const TIME: &str = "time";
/// The most rows of a group: about as many as DuckDB and others write, so that a core has work with one.
pub(super) const GROUP_ROWS: usize = 1 << 17;
/// A group is written as well when cells have copied so many bytes, however few its rows are: a frame of CAN XL has 2048.
const GROUP_BYTES: usize = 1 << 23;
/// What a copy costs beside its bytes.
const COPY_BYTES: usize = 64;

/// The columns that tables of frames and of signals begin with.
pub(super) struct HeadColumns {
    pub(super) time: Integers,
    pub(super) interface: Texts,
    pub(super) id: Texts,
    pub(super) kind: Texts,
    time_ns: i64,
    last: [Recent; 3],
    digits: Vec<u8>,
    rows: usize,
    bytes: usize,
}

impl HeadColumns {
    pub(super) fn new() -> Result<Self> {
        Ok(Self {
            time: column::times(TIME)?,
            interface: column::texts("interface")?,
            id: column::texts("id")?,
            kind: column::texts("kind")?,
            time_ns: 0,
            last: [Recent::new(), Recent::new(), Recent::new()],
            digits: Vec::new(),
            rows: 0,
            bytes: 0,
        })
    }

    /// The frame of the rows to come.
    pub(super) fn frame(&mut self, record: &Record<'_>) {
        let [interface, id, kind] = &mut self.last;
        self.time_ns = record.time_ns;
        self.digits.clear();
        put_id(&mut self.digits, record);
        self.bytes += interface.set(record.interface.as_bytes()) + id.set(&self.digits);
        kind.set(kind_text(record.kind).as_bytes());
    }

    /// A row of that frame.
    #[inline]
    pub(super) fn push(&mut self) {
        let [interface, id, kind] = &self.last;
        self.time.push(self.time_ns);
        self.interface.push(interface.cell());
        self.id.push(id.cell());
        self.kind.push(kind.cell());
        self.rows += 1;
    }

    /// Bytes for a cell of that row.
    pub(super) fn copy(&mut self, bytes: &[u8]) -> ByteArray {
        self.bytes += bytes.len() + COPY_BYTES;
        bytes.to_vec().into()
    }

    /// Whether the rows are enough for a group.
    #[inline]
    pub(super) const fn is_enough(&self) -> bool {
        self.rows >= GROUP_ROWS || self.bytes >= GROUP_BYTES
    }

    /// Begins a group. Tells whether the one before it has rows.
    pub(super) fn next_group(&mut self) -> bool {
        self.bytes = 0;
        std::mem::take(&mut self.rows) > 0
    }
}

/// A text that mostly is the one before it: many cells share one copy.
pub(super) struct Recent(ByteArray);

impl Recent {
    pub(super) fn new() -> Self {
        Self(column::text(""))
    }

    /// The text is this one. Tells how many bytes that took.
    pub(super) fn set(&mut self, text: &[u8]) -> usize {
        if self.0.data() == text {
            return 0;
        }
        self.0 = text.to_vec().into();
        text.len() + COPY_BYTES
    }

    /// A cell of that text.
    #[inline]
    pub(super) fn cell(&self) -> ByteArray {
        self.0.clone()
    }
}

/// What a frame is.
const fn kind_text(kind: FrameKind) -> &'static str {
    match kind {
        FrameKind::Standard | FrameKind::Extended => "CAN",
        FrameKind::Fd { .. } => "CAN FD",
        FrameKind::Remote { .. } | FrameKind::Error | FrameKind::Xl => kind_name(kind),
    }
}
