//! The frames that a writer was given, and what it keeps of them.

use adsdv_oracle::candump::{Direction, FrameKind, Record};
use serde_json::Value;

/// A frame that a writer was given.
#[derive(Debug)]
pub(crate) struct Reference {
    pub(crate) time_ns: i64,
    kind: String,
    extended: bool,
    id: u32,
    channel: u64,
    rx: bool,
    len: u8,
    data: Vec<u8>,
    flags: u8,
}

impl Reference {
    /// Reads a line of the reference.
    pub(crate) fn read(line: &str) -> Self {
        let value: Value = serde_json::from_str(line).expect("it is JSON");
        let number = |name: &str| value[name].as_u64().unwrap_or_else(|| panic!("{name} of {line}"));
        let is = |name: &str| value[name].as_bool().unwrap_or_else(|| panic!("{name} of {line}"));
        let text = |name: &str| value[name].as_str().unwrap_or_else(|| panic!("{name} of {line}"));
        let data = text("data").as_bytes().chunks(2).map(|pair| {
            let pair = str::from_utf8(pair).expect("digits");
            u8::from_str_radix(pair, 16).expect("two digits")
        });
        Self {
            time_ns: value["time_ns"].as_i64().expect("a time"),
            kind: text("kind").to_owned(),
            extended: is("extended"),
            id: u32::try_from(number("id")).expect("an identifier"),
            channel: number("channel"),
            rx: is("rx"),
            len: u8::try_from(number("len")).expect("a length"),
            data: data.collect(),
            flags: u8::from(is("brs")) | u8::from(is("esi")) << 1,
        }
    }
}

/// What a writer keeps of frames.
#[derive(Clone, Copy)]
#[allow(clippy::struct_excessive_bools)]
pub(crate) struct Keeps {
    /// How far off the time of the first frame may be.
    pub(crate) start_ns: i64,
    /// How far off the time from it to another may be.
    pub(crate) step_ns: i64,
    pub(crate) remote: bool,
    pub(crate) error: bool,
    /// Identifier and data of error frames.
    pub(crate) error_data: bool,
    pub(crate) error_direction: bool,
    pub(crate) fd: bool,
    /// Which frames are of CAN FD even if they are short, and their flags.
    pub(crate) fd_is_marked: bool,
    pub(crate) direction: bool,
    /// The interface of every frame; `None` if it is the channel, counted from 1.
    pub(crate) channel: Option<&'static str>,
}

impl Keeps {
    /// Everything, to the microsecond.
    pub(crate) const ALL: Self = Self {
        start_ns: 1_000,
        step_ns: 1_000,
        remote: true,
        error: true,
        error_data: true,
        error_direction: true,
        fd: true,
        fd_is_marked: true,
        direction: true,
        channel: None,
    };

    /// Classic data frames alone.
    pub(crate) const CLASSIC_DATA: Self = Self { remote: false, error: false, fd: false, ..Self::ALL };

    /// Whether a frame is written at all.
    pub(crate) fn has(&self, frame: &Reference) -> bool {
        match frame.kind.as_str() {
            "remote" => self.remote,
            "error" => self.error,
            "fd" => self.fd,
            _ => true,
        }
    }

    /// Fails if a record is not what is kept of a frame, but for its time.
    pub(crate) fn compare(&self, name: &str, frame: &Reference, record: &Record<'_>) {
        let extended = frame.extended;
        let data_kind = if extended { FrameKind::Extended } else { FrameKind::Standard };
        let kind = match frame.kind.as_str() {
            "remote" => FrameKind::Remote { extended, len: frame.len },
            "error" => FrameKind::Error,
            "fd" if self.fd_is_marked => FrameKind::Fd { extended, flags: frame.flags },
            "fd" if frame.len > 8 => FrameKind::Fd { extended, flags: 0 },
            _ => data_kind,
        };
        assert_eq!(record.kind, kind, "{name}: {record:?} of {frame:?}");
        let known = kind != FrameKind::Error || self.error_data;
        let (id, data) = if known { (frame.id, frame.data.as_slice()) } else { (0, &[][..]) };
        assert_eq!((record.id, record.data), (id, data), "{name}: {record:?} of {frame:?}");
        let direction = if frame.rx { Direction::Rx } else { Direction::Tx };
        let known = self.direction && (kind != FrameKind::Error || self.error_direction);
        assert_eq!(record.direction, known.then_some(direction), "{name}: {record:?} of {frame:?}");
        let channel = (frame.channel + 1).to_string();
        assert_eq!(record.interface, self.channel.unwrap_or(&channel), "{name}: {record:?} of {frame:?}");
        assert!(record.terminated, "{name}: {record:?}");
    }
}
