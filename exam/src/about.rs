//! What a requirement asks for, in a few words, with the names and the numbers that its edition has.

use adsdv_spec::Edition;
use adsdv_spec::messages::SignalDef;

/// What a requirement asks for.
#[derive(Clone, Copy, Debug)]
pub(crate) enum About {
    /// Something without a number.
    Words(&'static str),
    /// That a message is sent.
    Sends(u16),
    /// That the messages from the one to the other come in their cycle.
    Cycle(u16, u16),
    /// That a field of a message says something, whatever that is.
    Field(u16, &'static str),
    /// That it has no value but those that it may have.
    Values(u16, &'static str),
    /// That it stands in its byte.
    Byte(u16, &'static str),
    /// That nothing is sent under the reserved identifiers from the one to the other.
    Reserved(u16, u16),
    /// That no message is missed.
    Missed,
    /// That an answer may take so many cycles.
    Cycles(u16),
}

impl About {
    /// The message that it is about, the last one of several.
    pub(crate) const fn message(self) -> Option<u16> {
        match self {
            Self::Sends(id) | Self::Cycle(_, id) | Self::Field(id, _) | Self::Values(id, _) => Some(id),
            _ => None,
        }
    }

    /// The words, with the names and the numbers of an edition.
    pub(crate) fn text(self, edition: &Edition) -> String {
        let message = |id| edition.bus.message(id);
        let signal = |id, field: &str| message(id)?.signal_of(field);
        let named = |id, field| signal(id, field).map_or(field, |signal| signal.name);
        match self {
            Self::Words(words) => words.to_owned(),
            Self::Sends(id) => {
                format!("sends {} ({id:03X}h)", message(id).map_or("a message", |def| def.name))
            }
            Self::Cycle(first, last) => {
                let cycle_ms = message(first).map_or(edition.rules.timing.cycle_ms, |def| def.cycle_ms);
                format!("sends {} every {cycle_ms} ms", range(first, last))
            }
            Self::Field(id, field) => format!("{id:03X}h: {}", named(id, field)),
            Self::Values(id, field) => {
                let values = signal(id, field).map_or_else(String::new, values);
                format!("{id:03X}h: {} {values}", named(id, field))
            }
            Self::Byte(id, field) => {
                const NAMES: [&str; 8] =
                    ["first", "second", "third", "fourth", "fifth", "sixth", "seventh", "eighth"];
                let byte = signal(id, field).and_then(|signal| NAMES.get(usize::from(signal.start / 8)));
                format!("{} is in the {} byte of {id:03X}h", named(id, field), byte.unwrap_or(&"right"))
            }
            Self::Reserved(first, last) => format!("does not send {}", range(first, last)),
            Self::Missed => match edition.rules.thresholds.missed_ms {
                Some(ms) => format!("lets no message be missed for {ms} ms"),
                None => "lets no message be missed".to_owned(),
            },
            Self::Cycles(cycles) => {
                format!("may take {} ms for an answer", cycles.saturating_mul(edition.rules.timing.cycle_ms))
            }
        }
    }
}

fn range(first: u16, last: u16) -> String {
    if first == last { format!("{first:03X}h") } else { format!("{first:03X}h to {last:03X}h") }
}

/// The values that a signal may have.
fn values(signal: &'static SignalDef) -> String {
    let names: Vec<&str> =
        signal.values.iter().filter(|(raw, _)| signal.allows(*raw)).map(|(_, name)| *name).collect();
    match names.split_last() {
        Some((last, [])) => format!("is {last}"),
        Some((last, others)) => format!("is {} or {last}", others.join(", ")),
        None if signal.width == 1 => "is one bit".to_owned(),
        None => {
            let least = signal.scale.physical(signal.min);
            format!("from {least} to {}", signal.display(signal.max))
        }
    }
}
