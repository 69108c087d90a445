//! MCAP, the container that ROS 2 records into and Foxglove shows, with frames of CAN as messages of ROS.
//!
//! ```text
//! \x89MCAP0\r\n
//! 01 length ...        the header
//! 06 length chunk      what follows is compressed by Zstandard or LZ4, or not
//!   03 length schema     a type of message, and how it is defined: can_msgs/msg/Frame
//!   04 length channel    a topic, with messages of such a type: /can0/from_can_bus
//!   05 length message    channel 2, sequence 4, log time 8, publish time 8, and the message
//! 05 length message    without chunks, they stand so
//! 0F length            the end of the data; behind it are indexes, which are not used and may be missing
//! ```
//!
//! The format is described at <https://mcap.dev/spec>. Those messages are read whose type speaks of CAN and is defined, in the file and in the
//! language of ROS (`ros2msg`, `ros1msg`), as an `id` of 32 bits and `data` of bytes, beside fields that are numbers, texts, or a header:
//! `can_msgs/msg/Frame` and `ros2_socketcan_msgs/msg/FdFrame`, which are known without a definition too, and what teams define like them.
//! Messages are in CDR of either byte order (`cdr`), or as ROS 1 has them (`ros1`). Not read are frames in JSON, Protobuf or FlatBuffers, for
//! which there is no type that is agreed on; of a channel whose type or, without a type, topic speaks of CAN an [`Entry::Broken`] says so.
//!
//! Topics that ros2_socketcan and socketcan_bridge name are one interface with the others in their namespace: `/can0/from_can_bus` and
//! `/can0/to_can_bus` are `/can0`, received and sent; a frame that is on both, because the kernel loops back what is sent, is read once. Of any
//! other topic the interface is all of it. The time is that of the message's header, or when it was logged where the header has none. A file that was
//! cut off gives all that is in it. Damage within a chunk costs the rest of that chunk; a record outside of chunks whose length is damaged costs
//! what follows, since nothing in the format marks where a record begins. Records are read one after the other as they are unpacked; the
//! largest window of Zstandard, 128 MiB, half as much again while it grows, is the most that a file can ask for.

mod channels;
mod content;
mod echo;
mod layout;
mod message;
mod step;
#[cfg(test)]
mod tests;
mod words;

use adsdv_oracle::candump::{Entries, Entry, LineError, ReadError, Record, Unit};

use self::channels::Channels;
use self::content::Content;
use self::echo::Echoes;
use self::message::McapFrame;
use self::step::McapStep;
use crate::Source;

/// Reads the records of a file.
pub(crate) struct McapReader {
    content: Content,
    channels: Channels,
    body: Vec<u8>,
    begun: bool,
    ended: bool,
    /// The checksum that the chunk claims; 0 if none.
    checksum: u32,
    count: u64,
    frame: McapFrame,
    echoes: Echoes,
}

impl McapReader {
    pub(crate) fn new(source: Source) -> Self {
        Self {
            content: Content::new(source),
            channels: Channels::default(),
            body: Vec::new(),
            begun: false,
            ended: false,
            checksum: 0,
            count: 0,
            frame: McapFrame::NONE,
            echoes: Echoes::default(),
        }
    }
}

impl Entries for McapReader {
    fn next_entry(&mut self) -> Result<Option<Entry<'_>>, ReadError> {
        let (channel, time_ns) = loop {
            match self.sure_step()? {
                McapStep::Frame { channel, time } => break (channel, time),
                McapStep::Broken(error) => {
                    return Ok(Some(Entry::Broken(LineError { line: self.count, ..error })));
                }
                McapStep::Passed => {}
                McapStep::End => return Ok(None),
            }
        };
        let McapFrame { kind, id, len, .. } = self.frame;
        let channel = self.channels.get(channel);
        Ok(channel.map(|channel| {
            Entry::Frame(Record {
                line: self.count,
                time_ns,
                interface: &channel.interface,
                kind,
                id,
                data: self.frame.data.get(..len).unwrap_or_default(),
                direction: channel.direction,
                terminated: true,
            })
        }))
    }

    fn count(&self) -> u64 {
        self.count
    }

    fn unit(&self) -> Unit {
        Unit::Record
    }
}
