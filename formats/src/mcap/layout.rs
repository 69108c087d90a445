//! How the messages of a type are laid out, by the definition of ROS that the file has of it.

/// That of ros2_socketcan, ros_canopen and others: a file need not have the definition.
const FRAME: &[u8] = b"std_msgs/Header header\nuint32 id\nbool is_rtr\nbool is_extended\nbool is_error\nuint8 dlc\nuint8[8] data";
/// That of ros2_socketcan for CAN FD.
const FD_FRAME: &[u8] =
    b"std_msgs/Header header\nuint32 id\nbool is_extended\nbool is_error\nuint8 len\nuint8[<=64] data";

/// So many fields has no definition of a frame.
const MOST: usize = 64;

/// What a field says of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Role {
    Id,
    Remote,
    Extended,
    Error,
    Fd,
    RateSwitch,
    ErrorState,
    Len,
    Data,
    Other,
}

/// How many elements a field has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Many {
    One,
    Fixed(usize),
    /// Their number stands before them.
    Counted,
}

/// A field of a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Field {
    /// `std_msgs/Header`.
    Header,
    /// A time, in seconds and nanoseconds.
    Time,
    Text,
    /// Numbers of so many bytes each.
    Number {
        size: usize,
        many: Many,
        role: Role,
    },
}

/// The fields of a message, which has an identifier and data.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Layout {
    pub(super) fields: Vec<Field>,
    /// Whether frames are of CAN FD where no field says.
    pub(super) fd: bool,
}

impl Layout {
    /// That of a type of this name whose definition is this, or which is known without.
    pub(super) fn of(name: &str, encoding: &str, definition: &[u8]) -> Option<Self> {
        let short = name.replace("/msg/", "/");
        let definition = match short.as_str() {
            _ if matches!(encoding, "ros1msg" | "ros2msg") && !definition.is_empty() => definition,
            "can_msgs/Frame" => FRAME,
            "ros2_socketcan_msgs/FdFrame" => FD_FRAME,
            _ => return None,
        };
        let fields = fields(&String::from_utf8_lossy(definition))?;
        let has = |wanted: Role| {
            let is = |field: &Field| matches!(field, Field::Number { role, .. } if *role == wanted);
            fields.iter().filter(|field| is(field)).count() == 1
        };
        let last = short.rsplit('/').next().unwrap_or_default().to_ascii_lowercase();
        let fd = last.contains("fd");
        (has(Role::Id) && has(Role::Data)).then_some(Self { fields, fd })
    }
}

/// The fields of the first message of a definition; `None` if there is one that is not known how to pass over.
fn fields(definition: &str) -> Option<Vec<Field>> {
    let mut fields = Vec::new();
    for line in definition.lines().take_while(|line| !line.starts_with("===")) {
        let line = line.split('#').next().unwrap_or_default();
        let mut words = line.split_whitespace();
        let Some(kind) = words.next() else { continue };
        let name = words.next()?;
        // A constant is no field.
        if !line.contains('=') || kind.contains("<=") && !name.contains('=') {
            fields.push(field(kind, name)?);
        }
        if fields.len() > MOST {
            return None;
        }
    }
    Some(fields)
}

fn field(kind: &str, name: &str) -> Option<Field> {
    let (kind, many) = match kind.split_once('[') {
        None => (kind, Many::One),
        Some((kind, many)) => match many.strip_suffix(']')? {
            "" => (kind, Many::Counted),
            bounded if bounded.starts_with("<=") => (kind, Many::Counted),
            number => (kind, Many::Fixed(number.parse().ok()?)),
        },
    };
    let size = match kind {
        "bool" | "byte" | "char" | "uint8" | "int8" => 1,
        "uint16" | "int16" => 2,
        "uint32" | "int32" | "float32" => 4,
        "uint64" | "int64" | "float64" => 8,
        "Header" | "std_msgs/Header" | "std_msgs/msg/Header" if many == Many::One => {
            return Some(Field::Header);
        }
        "time" | "builtin_interfaces/Time" | "builtin_interfaces/msg/Time" if many == Many::One => {
            return Some(Field::Time);
        }
        text if text.split("<=").next() == Some("string") && many == Many::One => return Some(Field::Text),
        _ => return None,
    };
    let role = match name {
        "id" | "can_id" | "arbitration_id" => Role::Id,
        "is_rtr" | "rtr" | "is_remote" | "is_remote_frame" => Role::Remote,
        "is_extended" | "extended" | "is_extended_id" => Role::Extended,
        "is_error" | "error" | "is_error_frame" => Role::Error,
        "is_fd" | "fd" => Role::Fd,
        "brs" | "is_brs" | "bitrate_switch" => Role::RateSwitch,
        "esi" | "is_esi" | "error_state_indicator" => Role::ErrorState,
        "dlc" | "len" | "length" => Role::Len,
        "data" => Role::Data,
        _ => Role::Other,
    };
    let fits = match role {
        Role::Id => size == 4 && many == Many::One && kind == "uint32",
        Role::Data => size == 1 && many != Many::One,
        Role::Other => true,
        _ => size == 1 && many == Many::One,
    };
    fits.then_some(Field::Number { size, many, role })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_definition_is_read_field_by_field() {
        let text = "# a frame\nuint8 MAX=8\nstd_msgs/Header header\nuint32 id # as on the bus\nuint8[<=64] data\nfloat64 x 1.5\nstring<=9 note\n\n===\nMSG: std_msgs/Header\nuint32 id\n";
        let number = |size, many, role| Field::Number { size, many, role };
        let fields = vec![
            Field::Header,
            number(4, Many::One, Role::Id),
            number(1, Many::Counted, Role::Data),
            number(8, Many::One, Role::Other),
            Field::Text,
        ];
        assert_eq!(Layout::of("a/msg/Can", "ros2msg", text.as_bytes()), Some(Layout { fields, fd: false }));
    }

    #[test]
    fn two_types_are_known_without_a_definition() {
        let frame = Layout::of("can_msgs/msg/Frame", "", b"").expect("it is known");
        assert_eq!((frame.fields.len(), frame.fd), (7, false));
        assert_eq!(Layout::of("can_msgs/Frame", "ros1msg", FRAME), Some(frame));
        let fd = Layout::of("ros2_socketcan_msgs/msg/FdFrame", "ros2idl", b"module").expect("it is known");
        assert_eq!((fd.fields.len(), fd.fd), (6, true));
        assert_eq!(Layout::of("my_can/msg/Frame", "ros2msg", b""), None);
    }

    #[test]
    fn a_definition_that_is_no_frame_is_none() {
        for text in [
            "uint32 id",
            "uint8[8] data",
            "uint64 id\nuint8[8] data",
            "uint32 id\nuint32 id\nuint8[8] data",
            "uint32 id\nuint8 data",
            "uint32 id\nuint8[8] data\nmy/Type x",
            "uint32 id\nuint8[8 data",
            "uint32",
        ] {
            assert_eq!(Layout::of("can/msg/F", "ros2msg", text.as_bytes()), None, "{text}");
        }
    }
}
