//! What all messages of an edition have in common: one row for each, whether the document describes it or only the CAN database.
//!
//! Who shows or decodes a recording needs no more: who sends a message, how long it is, and how its bits are read.

use super::definition::{MessageDef, SignalDef};
use super::device::{Coding, DeviceMessage, DeviceSignal};
use super::scale::Scale;

/// A message of an edition.
#[derive(Clone, Copy, Debug)]
pub struct MessageRow {
    /// The name, as in the CAN database.
    pub name: &'static str,
    /// The CAN identifier.
    pub id: u16,
    /// Who sends it: `AI`, `VCU`, or the name of a device.
    pub from: &'static str,
    /// The number of data bytes.
    pub len: u8,
    /// How often it is sent, in milliseconds; `None` where nothing is set.
    pub cycle_ms: Option<u16>,
    /// What it is for, or what sends it.
    pub doc: &'static str,
    signals: Signals,
}

#[derive(Clone, Copy, Debug)]
enum Signals {
    Documented(&'static [SignalDef]),
    OfDevice(&'static [DeviceSignal]),
}

/// A signal of such a message. It is little endian.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SignalRow {
    /// The name, as in the CAN database.
    pub name: &'static str,
    /// The lowest bit; bit 0 is the lowest bit of the first byte.
    pub start: u8,
    /// The number of bits.
    pub width: u8,
    /// How they are read.
    pub coding: Coding,
    /// What one raw step is.
    pub steps: Steps,
    /// The unit, empty where there is none.
    pub unit: &'static str,
    /// The raw values that have names, ascending.
    pub values: &'static [(i32, &'static str)],
    /// What it means; empty where nothing says so.
    pub doc: &'static str,
}

/// What a raw number of a signal is in its unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Steps {
    /// So many steps of a fraction, from 0.
    Exact(Scale),
    /// Times a number, and plus another.
    Linear {
        /// Times this.
        factor: f64,
        /// And plus this.
        offset: f64,
    },
}

impl MessageRow {
    pub(crate) const fn documented(message: &MessageDef) -> Self {
        let MessageDef { name, id, sender, len, cycle_ms, signals, doc, .. } = *message;
        let signals = Signals::Documented(signals);
        Self { name, id, from: sender.name(), len, cycle_ms: Some(cycle_ms), doc, signals }
    }

    pub(crate) const fn of_device(message: &DeviceMessage) -> Self {
        let DeviceMessage { name, id, sender, len, cycle_ms, signals } = *message;
        let signals = Signals::OfDevice(signals);
        Self { name, id, from: sender.name(), len, cycle_ms, doc: sender.what(), signals }
    }

    /// Its signals, by ascending start bit.
    pub fn signals(&self) -> impl Iterator<Item = SignalRow> + Clone + 'static {
        let (documented, of_device) = match self.signals {
            Signals::Documented(signals) => (signals, &[][..]),
            Signals::OfDevice(signals) => (&[][..], signals),
        };
        documented.iter().map(SignalRow::documented).chain(of_device.iter().map(SignalRow::of_device))
    }
}

impl SignalRow {
    fn documented(signal: &SignalDef) -> Self {
        let SignalDef { name, start, width, signed, scale, unit, values, doc, .. } = *signal;
        let coding = if signed { Coding::Signed } else { Coding::Unsigned };
        Self { name, start, width, coding, steps: Steps::Exact(scale), unit, values, doc }
    }

    fn of_device(signal: &DeviceSignal) -> Self {
        let DeviceSignal { name, start, width, coding, scale, offset, unit, values, .. } = *signal;
        let steps = Steps::Linear { factor: scale, offset };
        Self { name, start, width, coding, steps, unit, values, doc: "" }
    }
}
