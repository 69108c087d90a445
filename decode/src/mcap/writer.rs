//! The container: chunks of messages, each with an index, and a summary at the end, so that a reader finds what it wants at once.

use std::io::{self, Write};

use flate2::Crc;
use lz4_flex::frame::{BlockMode, BlockSize, FrameEncoder, FrameInfo};
use tempfile::SpooledTempFile;

use super::record::{
    MAGIC, kind, put_counted, put_len, put_map, put_record, put_text, put_u16, put_u32, put_u64,
};

/// So many bytes of records are one chunk: as many as other writers take.
const CHUNK: usize = 1 << 20;
/// So much of the index of chunks is kept in memory: that of some hundred MB of recording.
const IN_MEMORY: usize = 4 << 20;
const COMPRESSION: &[u8] = b"lz4";

/// From when to when there are messages.
#[derive(Clone, Copy, Debug)]
pub(super) struct Span {
    pub(super) from: u64,
    pub(super) to: u64,
}

impl Span {
    /// With another time in it.
    fn and(span: Option<Self>, time: u64) -> Self {
        let Self { from, to } = span.unwrap_or(Self { from: time, to: time });
        Self { from: from.min(time), to: to.max(time) }
    }
}

/// What is known of a channel beside its record.
#[derive(Debug, Default)]
pub(super) struct Tally {
    pub(super) messages: u64,
    /// When each message of the chunk at hand was, and where in the chunk it is.
    in_chunk: Vec<(u64, u64)>,
}

/// Writes a file from its begin to its end.
pub(super) struct McapWriter<W: Write> {
    out: W,
    /// How much was written.
    pub(super) at: u64,
    /// The checksum of the data: all that was written so far.
    pub(super) crc: Crc,
    /// The records of the chunk at hand, and how many bytes of them are one.
    chunk: Vec<u8>,
    chunk_len: usize,
    chunk_span: Option<Span>,
    pub(super) span: Option<Span>,
    /// The records of all schemas and channels, which the summary repeats.
    pub(super) schemas: Vec<u8>,
    pub(super) channels: Vec<u8>,
    pub(super) schema_count: u16,
    pub(super) tallies: Vec<Tally>,
    /// The records of the index of chunks.
    pub(super) index: SpooledTempFile,
    pub(super) index_len: u64,
    pub(super) chunk_count: u32,
    /// Room for what is written next.
    pub(super) room: Vec<u8>,
}

impl<W: Write> McapWriter<W> {
    /// Nothing is written yet.
    pub(super) fn new(out: W) -> Self {
        Self::with(out, CHUNK, IN_MEMORY)
    }

    fn with(out: W, chunk_len: usize, in_memory: usize) -> Self {
        let mut room = MAGIC.to_vec();
        put_record(&mut room, kind::HEADER, |out| {
            put_text(out, b"");
            put_text(out, concat!("adsdv ", env!("CARGO_PKG_VERSION")).as_bytes());
        });
        Self {
            out,
            at: 0,
            crc: Crc::new(),
            chunk: Vec::with_capacity(chunk_len + chunk_len / 8),
            chunk_len,
            chunk_span: None,
            span: None,
            schemas: Vec::new(),
            channels: Vec::new(),
            schema_count: 0,
            tallies: Vec::new(),
            index: SpooledTempFile::new(in_memory),
            index_len: 0,
            chunk_count: 0,
            room,
        }
    }

    /// Adds a schema. `None` if there are as many as a file can have.
    pub(super) fn schema(&mut self, name: &str, encoding: &str, definition: &[u8]) -> Option<u16> {
        let id = self.schema_count.checked_add(1)?;
        self.schema_count = id;
        let begin = self.chunk.len();
        put_record(&mut self.chunk, kind::SCHEMA, |out| {
            put_u16(out, id);
            put_text(out, name.as_bytes());
            put_text(out, encoding.as_bytes());
            put_text(out, definition);
        });
        self.schemas.extend_from_slice(self.chunk.get(begin..).unwrap_or_default());
        Some(id)
    }

    /// Adds a channel. `None` if there are as many as a file can have.
    pub(super) fn channel(
        &mut self,
        schema: u16,
        topic: &str,
        encoding: &str,
        metadata: &[(&str, &str)],
    ) -> Option<u16> {
        let id = u16::try_from(self.tallies.len()).ok().filter(|id| *id < u16::MAX)?;
        self.tallies.push(Tally::default());
        let begin = self.chunk.len();
        put_record(&mut self.chunk, kind::CHANNEL, |out| {
            put_u16(out, id);
            put_u16(out, schema);
            put_text(out, topic.as_bytes());
            put_text(out, encoding.as_bytes());
            put_len(out, metadata.iter().map(|(key, value)| 8 + key.len() + value.len()).sum());
            for (key, value) in metadata {
                put_text(out, key.as_bytes());
                put_text(out, value.as_bytes());
            }
        });
        self.channels.extend_from_slice(self.chunk.get(begin..).unwrap_or_default());
        Some(id)
    }

    /// Adds a message of a channel, whose content is appended.
    pub(super) fn message(
        &mut self,
        channel: u16,
        time_ns: i64,
        content: impl FnOnce(&mut Vec<u8>),
    ) -> io::Result<()> {
        let Some(tally) = self.tallies.get_mut(usize::from(channel)) else { return Ok(()) };
        // There is nothing before 1970.
        let time = u64::try_from(time_ns).unwrap_or(0);
        tally.in_chunk.push((time, self.chunk.len() as u64));
        #[expect(clippy::cast_possible_truncation, reason = "it begins anew where it is too large")]
        let sequence = tally.messages as u32;
        tally.messages += 1;
        self.chunk_span = Some(Span::and(self.chunk_span, time));
        self.span = Some(Span::and(self.span, time));
        put_record(&mut self.chunk, kind::MESSAGE, |out| {
            put_u16(out, channel);
            put_u32(out, sequence);
            put_u64(out, time);
            put_u64(out, time);
            content(out);
        });
        if self.chunk.len() >= self.chunk_len { self.end_chunk() } else { Ok(()) }
    }

    /// Writes what is in the room.
    pub(super) fn write(&mut self) -> io::Result<()> {
        self.out.write_all(&self.room)?;
        self.crc.update(&self.room);
        self.at += self.room.len() as u64;
        self.room.clear();
        Ok(())
    }

    /// Writes the chunk at hand, and what is in it.
    fn end_chunk(&mut self) -> io::Result<()> {
        // The beginning of the file, before the first.
        self.write()?;
        let Span { from, to } = self.chunk_span.take().unwrap_or(Span { from: 0, to: 0 });
        let (begin, unpacked) = (self.at, self.chunk.len() as u64);
        let mut crc = Crc::new();
        crc.update(&self.chunk);
        let packed = packed(&self.chunk)?;
        self.chunk.clear();
        put_record(&mut self.room, kind::CHUNK, |out| {
            put_u64(out, from);
            put_u64(out, to);
            put_u64(out, unpacked);
            put_u32(out, crc.sum());
            put_text(out, COMPRESSION);
            put_counted(out, |out| out.extend_from_slice(&packed));
        });
        self.write()?;
        let len = self.at - begin;
        let mut places = Vec::new();
        for (id, tally) in (0..).zip(&mut self.tallies) {
            if tally.in_chunk.is_empty() {
                continue;
            }
            places.push((id, self.at + self.room.len() as u64));
            put_record(&mut self.room, kind::MESSAGE_INDEX, |out| {
                put_u16(out, id);
                put_len(out, tally.in_chunk.len() * 16);
                for (time, place) in &tally.in_chunk {
                    put_u64(out, *time);
                    put_u64(out, *place);
                }
            });
            tally.in_chunk.clear();
        }
        let index_len = self.room.len() as u64;
        self.write()?;
        let mut record = Vec::new();
        put_record(&mut record, kind::CHUNK_INDEX, |out| {
            put_u64(out, from);
            put_u64(out, to);
            put_u64(out, begin);
            put_u64(out, len);
            put_map(out, &places);
            put_u64(out, index_len);
            put_text(out, COMPRESSION);
            put_u64(out, packed.len() as u64);
            put_u64(out, unpacked);
        });
        self.index.write_all(&record)?;
        self.index_len += record.len() as u64;
        self.chunk_count = self.chunk_count.saturating_add(1);
        Ok(())
    }

    /// There is no more.
    pub(super) fn finish(&mut self) -> io::Result<()> {
        if self.chunk.is_empty() {
            self.write()?;
        } else {
            self.end_chunk()?;
        }
        let crc = self.crc.sum();
        put_record(&mut self.room, kind::DATA_END, |out| put_u32(out, crc));
        self.write()?;
        self.summary()?;
        self.out.flush()
    }
}

/// Compressed as a frame of LZ4.
fn packed(records: &[u8]) -> io::Result<Vec<u8>> {
    let info = FrameInfo::new().block_size(BlockSize::Max1MB).block_mode(BlockMode::Independent);
    let mut encoder = FrameEncoder::with_frame_info(info, Vec::with_capacity(records.len() / 4));
    encoder.write_all(records)?;
    Ok(encoder.finish()?)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The index of a long recording: what does not fit into memory is in the file all the same, byte for byte.
    #[test]
    fn an_index_that_is_long_goes_through_a_file() {
        let written = |in_memory| {
            let mut out = Vec::new();
            let mut writer = McapWriter::with(&mut out, 200, in_memory);
            let schema = writer.schema("S", "jsonschema", b"{}").expect("the first");
            let channel = writer.channel(schema, "/s", "json", &[]).expect("the first");
            for time in 0..1000 {
                writer
                    .message(channel, time, |out| out.extend_from_slice(b"{}"))
                    .expect("a vector takes everything");
            }
            let is_in_a_file = writer.index.is_rolled();
            writer.finish().expect("a vector takes everything");
            assert!(writer.tallies.iter().all(|tally| tally.in_chunk.capacity() < 64));
            (out, is_in_a_file)
        };
        let ((small, in_a_file), (large, in_memory)) = (written(1000), written(IN_MEMORY));
        assert!(in_a_file && !in_memory);
        assert!(small == large && small.len() > 50_000, "{}", small.len());
    }

    #[test]
    fn a_file_has_no_more_channels_and_schemas_than_their_numbers() {
        let mut writer = McapWriter::new(Vec::new());
        let channels = (0..=u32::from(u16::MAX)).filter_map(|_| writer.channel(1, "", "", &[])).count();
        let schemas = (0..=u32::from(u16::MAX)).filter_map(|_| writer.schema("", "", b"")).count();
        assert_eq!((channels, schemas), (usize::from(u16::MAX), usize::from(u16::MAX)));
    }
}
