//! Frames as they were, in the messages of ROS 2 that other programs record them in.

use adsdv_oracle::candump::{Direction, FrameKind, Record};

use super::record::put_u32;

/// How messages are encoded, and how types are defined.
pub(super) const ENCODING: &str = "cdr";
pub(super) const DEFINED_IN: &str = "ros2msg";

/// A type of message for frames.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum FrameType {
    /// `can_msgs/msg/Frame`.
    Classic,
    /// `ros2_socketcan_msgs/msg/FdFrame`.
    Fd,
}

impl FrameType {
    pub(super) const ALL: [Self; 2] = [Self::Classic, Self::Fd];

    /// That of a frame; `None` for one of CAN XL.
    pub(super) const fn of(kind: FrameKind) -> Option<Self> {
        match kind {
            FrameKind::Standard | FrameKind::Extended | FrameKind::Remote { .. } | FrameKind::Error => {
                Some(Self::Classic)
            }
            FrameKind::Fd { .. } => Some(Self::Fd),
            FrameKind::Xl => None,
        }
    }

    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Classic => "can_msgs/msg/Frame",
            Self::Fd => "ros2_socketcan_msgs/msg/FdFrame",
        }
    }

    /// Its definition, and those of the types in it.
    pub(super) fn definition(self) -> String {
        let fields = match self {
            Self::Classic => "bool is_rtr\nbool is_extended\nbool is_error\nuint8 dlc\nuint8[8] data\n",
            Self::Fd => "bool is_extended\nbool is_error\nuint8 len\nuint8[<=64] data\n",
        };
        let between = "=".repeat(80);
        format!(
            "std_msgs/Header header\nuint32 id\n{fields}\
             {between}\nMSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n\
             {between}\nMSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n"
        )
    }

    /// The last part of the topic, as ros2_socketcan names it.
    pub(super) const fn topic(self, direction: Option<Direction>) -> &'static str {
        match (self, direction) {
            (Self::Classic, Some(Direction::Tx)) => "to_can_bus",
            (Self::Classic, _) => "from_can_bus",
            (Self::Fd, Some(Direction::Tx)) => "to_can_bus_fd",
            (Self::Fd, _) => "from_can_bus_fd",
        }
    }

    /// Appends a frame as a message of it: CDR in little endian, where a number stands at a multiple of its size behind the first four
    /// bytes.
    pub(super) fn put(self, out: &mut Vec<u8>, record: &Record<'_>) {
        out.extend_from_slice(&[0, 1, 0, 0]);
        // A time that does not fit is left out: then that of the log counts.
        let time = u64::try_from(record.time_ns).unwrap_or(0);
        let seconds = u32::try_from(time / 1_000_000_000).ok().filter(|seconds| seconds >> 31 == 0);
        put_u32(out, seconds.unwrap_or(0));
        let nanos = seconds.and_then(|_| u32::try_from(time % 1_000_000_000).ok());
        put_u32(out, nanos.unwrap_or(0));
        // The header's text is empty: its end, and what is missing to a multiple of four.
        put_u32(out, 1);
        out.extend_from_slice(&[0; 4]);
        put_u32(out, record.id);
        let (extended, remote, error) = match record.kind {
            FrameKind::Extended => (true, None, false),
            FrameKind::Remote { extended, len } => (extended, Some(len), false),
            FrameKind::Fd { extended, .. } => (extended, None, false),
            FrameKind::Error => (false, None, true),
            FrameKind::Standard | FrameKind::Xl => (false, None, false),
        };
        let data = record.data.get(..64).unwrap_or(record.data);
        let len = remote.unwrap_or(u8::try_from(data.len()).unwrap_or(64));
        match self {
            Self::Classic => {
                out.extend_from_slice(&[remote.is_some().into(), extended.into(), error.into(), len]);
                let mut eight = [0; 8];
                eight.iter_mut().zip(data).for_each(|(place, byte)| *place = *byte);
                out.extend_from_slice(&eight);
            }
            Self::Fd => {
                out.extend_from_slice(&[extended.into(), error.into(), len, 0]);
                put_u32(out, len.into());
                out.extend_from_slice(data);
            }
        }
    }
}
