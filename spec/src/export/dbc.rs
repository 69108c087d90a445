//! The signal table as a CAN database.

use core::fmt;

use super::escape::Escaped;
use crate::Edition;
use crate::messages::{Decimal, MessageDef, Node, SignalDef};

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

/// The nodes of the bus, and what each is.
const NODES: [(Node, &str); 2] = [(Node::Ai, "AI Computer"), (Node::Vcu, "Vehicle Control Unit")];

/// The attribute that tools read as the cycle time of a message, in milliseconds.
const CYCLE_TIME: &str = "GenMsgCycleTime";

/// Displays all messages of an edition as a CAN database (DBC), for the tools of a CAN bus.
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
        self.comments(f)?;
        self.cycle_times(f)?;
        for message in self.0.bus.messages {
            for signal in message.signals.iter().filter(|signal| !signal.values.is_empty()) {
                value_names(f, message, signal)?;
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
        for (node, _) in NODES {
            write!(f, " {node}")?;
        }
        f.write_str("\n\n")
    }

    fn comments(self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let version = Escaped(self.0.version, in_quotes);
        writeln!(f, "CM_ \"ADS-DV Software Interface Specification {version}\";")?;
        for (node, what) in NODES {
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

fn value_names(f: &mut fmt::Formatter<'_>, message: &MessageDef, signal: &SignalDef) -> fmt::Result {
    write!(f, "VAL_ {} {}", message.id, signal.name)?;
    for &(value, name) in signal.values {
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
