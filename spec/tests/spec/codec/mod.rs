//! The codec against a second reading of the table, bit by bit, and against recorded frames.

mod errors;
#[cfg(any(feature = "serde", feature = "arbitrary", feature = "proptest"))]
mod features;
mod lengths;
mod quantities;
mod ranges;
mod recorded;
mod round_trips;
mod table;
mod v2026;
mod v4_0;

use adsdv_spec::editions::V3_0;
use adsdv_spec::messages::{
    Acceleration, Ai2LogDynamics2, Ai2VcuBrake, Ai2VcuDriveF, Ai2VcuDriveR, Ai2VcuStatus, Ai2VcuSteer,
    AmiState, AnyMessage, AsState, AxleTorque, AxleTorqueRequest, BrakePressure, ConesCountAll, DecodeError,
    DirectionRequest, EbsState, Frame, LapCounter, Layout, LogBrake, LogDriveTorque, LogSteerAngle,
    MessageDef, MissionStatus, MotorSpeedMax, Node, QuantityError, ServiceBrake, ShutdownCause, SignalDef,
    SmAs, SmSys, SpeedKmh, StatusBrk, SteerAngle, SteerAngleMax, SysActionState, Vcu2AiBrake, Vcu2AiDriveF,
    Vcu2AiDriveR, Vcu2AiStatus, Vcu2AiSteer, Vcu2AiWheelCounts, Vcu2AiWheelSpeeds, Vcu2LogDynamics1,
    Vcu2LogStatus, VcuStatus, WheelSpeed, YawRate,
};

use adsdv_spec::{Bus, Edition};

use crate::random::Random;

/// The bus of version 3.0.
const BUS: Bus = Edition::V3_0.bus;

/// The buses of all editions.
fn buses() -> impl Iterator<Item = &'static Bus> {
    Edition::ALL.iter().map(|edition| &edition.bus)
}

/// Every message of every edition, with its bus.
fn messages() -> impl Iterator<Item = (&'static Bus, &'static MessageDef)> {
    buses().flat_map(|bus| bus.messages.iter().map(move |&message| (bus, message)))
}

/// Bit `index` of a frame's data, bit 0 being the lowest of the first byte.
fn bit(data: &[u8], index: u8) -> bool {
    data[usize::from(index / 8)] >> (index % 8) & 1 == 1
}

fn set_bit(data: &mut [u8], index: u8, on: bool) {
    let mask = 1 << (index % 8);
    let byte = &mut data[usize::from(index / 8)];
    *byte = if on { *byte | mask } else { *byte & !mask };
}

/// Reads a signal bit by bit: the codec's reading must agree.
fn read(signal: &SignalDef, data: &[u8]) -> i32 {
    (0..signal.width).map(|place| value_of_bit(signal, place, bit(data, signal.start + place))).sum()
}

fn value_of_bit(signal: &SignalDef, place: u8, on: bool) -> i32 {
    let weight = if signal.signed && place + 1 == signal.width { -(1 << place) } else { 1 << place };
    if on { weight } else { 0 }
}

/// Writes a signal bit by bit.
fn write(signal: &SignalDef, data: &mut [u8], raw: i32) {
    for place in 0..signal.width {
        set_bit(data, signal.start + place, raw >> place & 1 == 1);
    }
}

/// The data as it is written where it is read like this: a number that is read as another is written as that.
fn as_written(message: &MessageDef, mut data: [u8; 8]) -> [u8; 8] {
    for signal in message.signals {
        let raw = read(signal, &data);
        let meaning = signal.read_as.filter(|other| other.raw == raw).map_or(raw, |other| other.meaning);
        write(signal, &mut data, meaning);
    }
    data
}

fn used_bits(message: &MessageDef) -> Vec<u8> {
    message.signals.iter().flat_map(|signal| signal.start..signal.start + signal.width).collect()
}

/// Whether the row allows a raw value, said a second time.
fn allowed(signal: &SignalDef, raw: i32) -> bool {
    let named = signal.values.iter().any(|(value, _)| *value == raw);
    (signal.min..=signal.max).contains(&raw) && (signal.values.is_empty() || named)
}

fn decode(bus: &Bus, message: &MessageDef, data: &[u8]) -> Result<AnyMessage, DecodeError> {
    bus.decode(message.id, data)
}

fn encode(bus: &Bus, message: impl Into<AnyMessage>) -> Frame {
    bus.encode(message).expect("the edition has the message")
}

/// Data in which every signal has the lowest value it may have.
fn lowest(message: &MessageDef) -> [u8; 8] {
    let mut data = [0; 8];
    for signal in message.signals {
        write(signal, &mut data, signal.min);
    }
    data
}

impl Random {
    /// A value that the signal allows, often one of the outermost.
    fn value(&mut self, signal: &SignalDef) -> i32 {
        let count = u64::from(signal.max.abs_diff(signal.min)) + 1;
        let raw = match self.next() % 4 {
            0 => signal.min,
            1 => signal.max,
            _ => signal.min + i32::try_from(self.next() % count).expect("a range of at most 32 bits"),
        };
        if allowed(signal, raw) { raw } else { signal.min }
    }
}

/// A frame as candump writes it.
fn frame(text: &str) -> Frame {
    let (id, digits) = text.split_once('#').expect("an identifier and data");
    let data: Vec<u8> = (0..digits.len())
        .step_by(2)
        .map(|at| u8::from_str_radix(&digits[at..at + 2], 16).expect("hexadecimal digits"))
        .collect();
    let frame = Frame::new(u16::from_str_radix(id, 16).expect("hexadecimal digits"), &data);
    let frame = frame.expect("at most eight bytes");
    assert_eq!(frame.to_string(), text);
    frame
}
