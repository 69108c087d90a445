//! What of a message's text does not depend on the frame, made once.

use std::io::Write as _;

use super::{TextLayout, put_wrong_size};
use crate::signal::Scaling;
use crate::value::{Steps, put_integer};
use crate::{Coding, Message, Signal, Value};

/// Names of values up to this are found by their place.
const DENSE: i64 = 256;

/// The text of a message.
#[derive(Debug)]
pub(super) struct Template {
    /// Behind the line of the frame: the message's name.
    begin: Box<[u8]>,
    /// Between two signals.
    between: &'static [u8],
    /// Before the closing bracket.
    end: &'static [u8],
    signals: Box<[SignalTemplate]>,
    /// Whether any signal is left out of some frames.
    multiplexed: bool,
}

/// The text of a signal.
#[derive(Debug)]
struct SignalTemplate {
    /// The name, and what is before it.
    label: Box<[u8]>,
    /// A space and the unit.
    unit: Box<[u8]>,
    numbers: Numbers,
    /// The text of each low raw value that has a name; empty where it has none.
    dense: Box<[Box<[u8]>]>,
    /// Whether other values have names as well.
    sparse: bool,
}

/// How numbers are written.
#[derive(Debug)]
enum Numbers {
    Steps(Steps),
    Other,
}

impl Template {
    pub(super) fn new(message: &Message, layout: TextLayout) -> Self {
        let (begin, label, between, end): (_, _, &[u8], &[u8]) = match layout {
            TextLayout::Lines => ("\n", "    ", b",\n", b"\n"),
            TextLayout::SingleLine => (" ", "", b", ", b""),
        };
        let indent = if layout == TextLayout::Lines { "\n" } else { "" };
        Self {
            begin: format!("{begin}{}({indent}", message.name).into_bytes().into(),
            between,
            end,
            signals: message.signals.iter().map(|signal| SignalTemplate::new(signal, label)).collect(),
            multiplexed: message.signals.iter().any(|signal| signal.multiplexed.is_some()),
        }
    }

    #[inline]
    pub(super) fn put(&self, out: &mut Vec<u8>, message: &Message, data: &[u8]) {
        out.extend_from_slice(&self.begin);
        let mut first = true;
        for (template, signal) in self.signals.iter().zip(&message.signals) {
            let Some(bits) = signal.place.bits(data) else { continue };
            if self.multiplexed && !message.has(signal, data) {
                continue;
            }
            if !first {
                out.extend_from_slice(self.between);
            }
            first = false;
            template.put(out, signal, bits);
        }
        if !first {
            out.extend_from_slice(self.end);
        }
        out.push(b')');
        if data.len() != message.len {
            put_wrong_size(out, data.len(), message.len);
        }
    }
}

impl SignalTemplate {
    fn new(signal: &Signal, indent: &str) -> Self {
        let unit = if signal.unit.is_empty() { String::new() } else { format!(" {}", signal.unit) };
        let is_dense = |raw: i64| (0..DENSE).contains(&raw);
        let last = signal.names.iter().map(|(raw, _)| *raw).rfind(|raw| is_dense(*raw));
        let mut dense: Vec<Box<[u8]>> =
            vec![[].into(); last.map_or(0, |last| usize::try_from(last + 1).unwrap_or(0))];
        for (raw, name) in &signal.names {
            if let Some(place) = usize::try_from(*raw).ok().and_then(|raw| dense.get_mut(raw)) {
                *place = name.as_bytes().into();
            }
        }
        if signal.place.coding() == Coding::Float {
            dense.clear();
        }
        let numbers = match signal.scaling {
            Scaling::Steps(scale) if signal.place.coding() != Coding::Float && signal.place.width() <= 32 => {
                Numbers::Steps(Steps::new(scale))
            }
            _ => Numbers::Other,
        };
        Self {
            label: format!("{indent}{}: ", signal.name).into_bytes().into(),
            unit: unit.into_bytes().into(),
            numbers,
            dense: dense.into(),
            sparse: signal.names.iter().any(|(raw, _)| !is_dense(*raw)),
        }
    }

    #[inline]
    fn put(&self, out: &mut Vec<u8>, signal: &Signal, bits: u64) {
        out.extend_from_slice(&self.label);
        let dense = usize::try_from(bits).ok().and_then(|bits| self.dense.get(bits));
        if let Some(name) =
            dense.filter(|name| !name.is_empty() && signal.place.raw(bits) == i128::from(bits))
        {
            out.extend_from_slice(name);
        } else if let Some(name) = signal.value_name(bits).filter(|_| self.sparse) {
            out.extend_from_slice(name.as_bytes());
        } else {
            self.put_number(out, signal, bits);
        }
        out.extend_from_slice(&self.unit);
    }

    #[inline]
    fn put_number(&self, out: &mut Vec<u8>, signal: &Signal, bits: u64) {
        if let Numbers::Steps(steps) = &self.numbers {
            let raw = match signal.place.coding() {
                Coding::Signed => i32::try_from(signal.place.extended(bits)),
                Coding::Unsigned | Coding::Float => i32::try_from(bits),
            };
            if let Ok(raw) = raw {
                return steps.put(out, raw);
            }
        }
        match signal.value(bits) {
            Value::Whole(number) => match i64::try_from(number) {
                Ok(number) => put_integer(out, number),
                // A vector takes everything.
                Err(_) => drop(write!(out, "{number}")),
            },
            value => drop(write!(out, "{:?}", value.to_f64())),
        }
    }
}
