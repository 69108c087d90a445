//! The summary at the end of a file: its schemas and channels once more, how many messages there are, and where each chunk is.

use std::io::{self, Read as _, Seek as _, SeekFrom, Write};

use flate2::Crc;

use super::record::{HEAD, MAGIC, kind, put_len, put_map, put_record, put_u16, put_u32, put_u64};
use super::writer::{McapWriter, Span};

impl<W: Write> McapWriter<W> {
    /// What the file has, and where; with its own checksum.
    pub(super) fn summary(&mut self) -> io::Result<()> {
        let begin = self.at;
        self.crc = Crc::new();
        let mut groups = Vec::new();
        for (kind, records) in [
            (kind::SCHEMA, std::mem::take(&mut self.schemas)),
            (kind::CHANNEL, std::mem::take(&mut self.channels)),
            (kind::STATISTICS, self.statistics()),
        ] {
            groups.push((kind, self.at, records.len() as u64));
            self.room = records;
            self.write()?;
        }
        groups.push((kind::CHUNK_INDEX, self.at, self.index_len));
        self.index.seek(SeekFrom::Start(0))?;
        loop {
            (&mut self.index).take(1 << 16).read_to_end(&mut self.room)?;
            if self.room.is_empty() {
                break;
            }
            self.write()?;
        }
        let offsets = self.at;
        for (group, at, len) in groups.into_iter().filter(|(_, _, len)| *len > 0) {
            put_record(&mut self.room, kind::SUMMARY_OFFSET, |out| {
                out.push(group);
                put_u64(out, at);
                put_u64(out, len);
            });
        }
        self.write()?;
        // The checksum is of the footer, too, up to itself.
        let footer = |crc: u32| {
            let mut footer = Vec::new();
            put_record(&mut footer, kind::FOOTER, |out| {
                put_u64(out, begin);
                put_u64(out, offsets);
                put_u32(out, crc);
            });
            footer
        };
        self.crc.update(footer(0).get(..HEAD + 16).unwrap_or_default());
        self.room = footer(self.crc.sum());
        self.room.extend_from_slice(MAGIC);
        self.write()
    }

    fn statistics(&self) -> Vec<u8> {
        let counts: Vec<(u16, u64)> = (0..).zip(self.tallies.iter().map(|tally| tally.messages)).collect();
        let Span { from, to } = self.span.unwrap_or(Span { from: 0, to: 0 });
        let mut record = Vec::new();
        put_record(&mut record, kind::STATISTICS, |out| {
            put_u64(out, counts.iter().map(|(_, count)| count).sum());
            put_u16(out, self.schema_count);
            put_len(out, counts.len());
            put_u32(out, 0);
            put_u32(out, 0);
            put_u32(out, self.chunk_count);
            put_u64(out, from);
            put_u64(out, to);
            put_map(out, &counts);
        });
        record
    }
}
