//! The signal table as a CAN database.

use core::fmt;

use super::escape::Escaped;
use crate::Edition;
use crate::messages::{Coding, Decimal, Device, DeviceMessage, DeviceSignal, MessageDef, Node, SignalDef};

/// The keywords that a database may use; readers expect the list, whether they are used or not.
const NEW_SYMBOLS: [&str; 22] = [
    "NS_DESC_",
    "CM_",
    "BA_DEF_",
    "BA_",
    "VAL_",
    "CAT_DEF_",
    "CAT_",
    "FILTER",
    "BA_DEF_DEF_",
    "EV_DATA_",
    "ENVVAR_DATA_",
    "SGTYPE_",
    "SGTYPE_VAL_",
    "BA_DEF_SGTYPE_",
    "BA_SGTYPE_",
    "SIG_TYPE_REF_",
    "VAL_TABLE_",
    "SIG_GROUP_",
    "SIG_VALTYPE_",
    "SIGTYPE_VALTYPE_",
    "BO_TX_BU_",
    "SG_MUL_VAL_",
];

/// The nodes of the interface, and what each is.
const NODES: [(Node, &str); 2] = [(Node::Ai, "AI Computer"), (Node::Vcu, "Vehicle Control Unit")];

/// The attribute that tools read as the cycle time of a message, in milliseconds.
const CYCLE_TIME: &str = "GenMsgCycleTime";

/// Displays all messages of an edition as a CAN database (DBC), for the tools of a CAN bus: those of the interface, then those
/// of the devices. It is in UTF-8.
///
/// Scales and ranges are exact decimals, in physical units. A range is what the codec allows, so a tool that checks
/// ranges refuses what [`Bus::decode`](crate::Bus::decode) refuses, but for the numbers between the values of an enumeration.
///
/// ```
/// use adsdv_spec::{Edition, export::Dbc};
///
/// let dbc = Dbc(&Edition::V3_0).to_string();
/// assert!(dbc.contains(" SG_ STEER_REQUEST_deg : 0|16@1- (0.1,0) [-24|24] \"deg\" Vector__XXX\n"));
/// assert!(dbc.contains("BA_ \"GenMsgCycleTime\" BO_ 1282 100;\n"));
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Dbc<'a>(pub &'a Edition);

impl fmt::Display for Dbc<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.head(f)?;
        for message in self.0.bus.messages {
            layout(f, message)?;
        }
        for message in self.0.bus.devices {
            device_layout(f, message)?;
        }
        self.comments(f)?;
        self.cycle_times(f)?;
        for message in self.0.bus.messages {
            for signal in message.signals.iter().filter(|signal| !signal.values.is_empty()) {
                value_names(f, message.id, signal.name, signal.values)?;
            }
        }
        for message in self.0.bus.devices {
            for signal in message.signals.iter().filter(|signal| !signal.values.is_empty()) {
                value_names(f, message.id, signal.name, signal.values)?;
            }
        }
        self.floats(f)
    }
}

impl Dbc<'_> {
    /// The nodes of the bus, and what each is.
    fn nodes(self) -> impl Iterator<Item = (&'static str, &'static str)> {
        let devices = self.0.bus.devices;
        let sends = move |device| devices.iter().any(|message| message.sender == device);
        let beyond = Device::ALL.into_iter().filter(move |&device| device != Device::Vcu && sends(device));
        NODES
            .map(|(node, what)| (node.name(), what))
            .into_iter()
            .chain(beyond.map(|device| (device.name(), device.what())))
    }

    /// Which signals are floats: the type is not part of a signal's row.
    fn floats(self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for message in self.0.bus.devices {
            for signal in message.signals.iter().filter(|signal| signal.coding == Coding::Float) {
                writeln!(f, "SIG_VALTYPE_ {} {} : 1;", message.id, signal.name)?;
            }
        }
        Ok(())
    }
}

impl Dbc<'_> {
    fn head(self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "VERSION {}\n", Quoted(self.0.version))?;
        f.write_str("NS_ :\n")?;
        for symbol in NEW_SYMBOLS {
            writeln!(f, "\t{symbol}")?;
        }
        f.write_str("\nBS_:\n\nBU_:")?;
        for (node, _) in self.nodes() {
            write!(f, " {node}")?;
        }
        f.write_str("\n\n")
    }

    fn comments(self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "CM_ {};", Quoted(self.0.document))?;
        for (node, what) in self.nodes() {
            writeln!(f, "CM_ BU_ {node} {};", Quoted(what))?;
        }
        for message in self.0.bus.messages {
            writeln!(f, "CM_ BO_ {} {};", message.id, Quoted(message.doc))?;
            for signal in message.signals {
                writeln!(f, "CM_ SG_ {} {} {};", message.id, signal.name, Quoted(signal.doc))?;
            }
        }
        Ok(())
    }

    fn cycle_times(self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "BA_DEF_ BO_ \"{CYCLE_TIME}\" INT 0 {};", u16::MAX)?;
        writeln!(f, "BA_DEF_DEF_ \"{CYCLE_TIME}\" 0;")?;
        for message in self.0.bus.messages {
            writeln!(f, "BA_ \"{CYCLE_TIME}\" BO_ {} {};", message.id, message.cycle_ms)?;
        }
        for DeviceMessage { id, cycle_ms, .. } in self.0.bus.devices {
            if let Some(cycle_ms) = cycle_ms {
                writeln!(f, "BA_ \"{CYCLE_TIME}\" BO_ {id} {cycle_ms};")?;
            }
        }
        Ok(())
    }
}

/// A message and the layout of its signals. `@1` is little endian, and `Vector__XXX` stands for any receiver.
fn layout(f: &mut fmt::Formatter<'_>, message: &MessageDef) -> fmt::Result {
    let MessageDef { id, name, len, sender, .. } = message;
    writeln!(f, "BO_ {id} {name}: {len} {sender}")?;
    for signal in message.signals {
        let SignalDef { name, start, width, scale, .. } = *signal;
        let sign = if signal.signed { '-' } else { '+' };
        let min = Decimal { raw: signal.min, scale };
        let max = Decimal { raw: signal.max, scale };
        let unit = Quoted(signal.unit);
        writeln!(f, " SG_ {name} : {start}|{width}@1{sign} ({scale},0) [{min}|{max}] {unit} Vector__XXX")?;
    }
    f.write_str("\n")
}

/// A message of a device. The VCU has its own there as well.
fn device_layout(f: &mut fmt::Formatter<'_>, message: &DeviceMessage) -> fmt::Result {
    let DeviceMessage { id, name, len, sender, .. } = message;
    writeln!(f, "BO_ {id} {name}: {len} {sender}")?;
    for signal in message.signals {
        let DeviceSignal { name, start, width, scale, offset, min, max, .. } = signal;
        let sign = if signal.coding == Coding::Unsigned { '+' } else { '-' };
        let unit = Quoted(signal.unit);
        writeln!(
            f,
            " SG_ {name} : {start}|{width}@1{sign} ({scale},{offset}) [{}|{}] {unit} Vector__XXX",
            Number(*min),
            Number(*max),
        )?;
    }
    f.write_str("\n")
}

/// Displays a number, with an exponent where it would be mostly zeros.
struct Number(f64);

impl fmt::Display for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.0.abs() < 1e15 { write!(f, "{}", self.0) } else { write!(f, "{:E}", self.0) }
    }
}

fn value_names(
    f: &mut fmt::Formatter<'_>,
    message: u16,
    signal: &str,
    values: &[(i32, &str)],
) -> fmt::Result {
    write!(f, "VAL_ {message} {signal}")?;
    for &(value, name) in values {
        write!(f, " {value} {}", Quoted(name))?;
    }
    f.write_str(" ;\n")
}

/// Displays a string of the database.
struct Quoted<'a>(&'a str);

impl fmt::Display for Quoted<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "\"{}\"", Escaped(self.0, in_quotes))
    }
}

fn in_quotes(character: char) -> Option<&'static str> {
    match character {
        '"' => Some("\\\""),
        '\\' => Some("\\\\"),
        _ => None,
    }
}
