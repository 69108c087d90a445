//! VCD, for GTKWave and Surfer: each signal as a wave.
//!
//! Written by the crate `vcd`. The scopes are
//!
//! - one of each message's name, with its signals: wires of their width where a step is one unit, reals in units elsewhere;
//! - `state`, with the AS state by its name, as the judge follows it;
//! - `blocked`, with a scope for each arrow of Figure 2, such as `AS_OFF_to_AS_READY`. Its `blocked` is 1 while the VCU is in the state
//!   where the arrow begins and its guard fails, and 0 while the guard holds. Each condition of the guard is 1 if it is as the arrow
//!   needs it, 0 if not, and x if the bus does not tell, or another alternative of the guard is nearer. The judge knows a condition when
//!   its messages have come: up to its window of 30 ms after the wave that shows it.
//!
//! What has not been seen yet is x. Time 0 is the first frame, and a comment says when that was. The frames are those of one interface:
//! the first that carries a message of the edition. What a wave cannot show, frames of other interfaces and those that nothing knows, is
//! counted in the notes.

mod arrows;

use std::io::{BufWriter, Write};

use ::vcd::{IdCode, TimescaleUnit, Value as Level, VarType, Writer};
use adsdv_oracle::candump::Dropped;

use crate::bus::Bus;
use crate::line::put_time;
use crate::signal::Scaling;
use crate::watch::Watch;
use crate::{Catalog, Coding, Frame, Signal, Sink, SinkError};
use arrows::Arrows;

/// Writes a VCD file.
pub struct VcdFile<'a> {
    catalog: &'a Catalog,
    writer: Writer<BufWriter<crate::out::Writer<'a>>>,
    bus: Bus,
    watch: Option<Watch>,
    waves: Option<Waves>,
    other_interfaces: u64,
    unknown: u64,
    backwards: u64,
}

/// Every wave, once the header is written.
struct Waves {
    /// The time of the first frame.
    origin: i64,
    /// The time that was written last.
    now: u64,
    /// The waves of each message's signals, with the bits that were written last.
    messages: Vec<Vec<(IdCode, Option<u64>)>>,
    state: IdCode,
    arrows: Arrows,
}

/// Whether a signal is a wire, and not a real.
fn is_wire(signal: &Signal) -> bool {
    let plain = match signal.scaling {
        Scaling::Steps(scale) => (scale.num(), scale.den()) == (1, 1),
        Scaling::Whole { factor, offset } => (factor, offset) == (1, 0),
        Scaling::Linear { .. } => false,
    };
    plain && signal.place.coding() != Coding::Float
}

impl<'a> VcdFile<'a> {
    /// Waves of these messages.
    pub fn new(catalog: &'a Catalog, writer: impl Write + Send + 'a) -> Self {
        Self {
            catalog,
            writer: Writer::new(BufWriter::new(Box::new(writer))),
            bus: Bus::default(),
            watch: None,
            waves: None,
            other_interfaces: 0,
            unknown: 0,
            backwards: 0,
        }
    }
}

impl Waves {
    fn begin<W: Write>(writer: &mut Writer<W>, catalog: &Catalog, origin: i64) -> Result<Self, SinkError> {
        let mut began = Vec::new();
        put_time(&mut began, origin, 1);
        let began = String::from_utf8_lossy(&began).into_owned();
        let edition = catalog.edition();
        writer.version(&format!("adsdv {}", env!("CARGO_PKG_VERSION")))?;
        writer.comment(&format!("ADS-DV interface, edition {}; time 0 is {began} s", edition.version))?;
        writer.timescale(1, TimescaleUnit::NS)?;
        let mut messages = Vec::new();
        for message in catalog.messages() {
            writer.add_module(&message.name)?;
            let mut waves = Vec::new();
            for signal in &message.signals {
                let id = if is_wire(signal) {
                    writer.add_wire(signal.place.width(), &signal.name)?
                } else {
                    writer.add_var(VarType::Real, 64, &signal.name, None)?
                };
                waves.push((id, None));
            }
            messages.push(waves);
            writer.upscope()?;
        }
        writer.add_module("state")?;
        let state = writer.add_var(VarType::String, 1, "AS_STATE", None)?;
        writer.upscope()?;
        let arrows = Arrows::begin(writer, edition)?;
        writer.enddefinitions()?;
        writer.timestamp(0)?;
        writer.begin(::vcd::SimulationCommand::Dumpvars)?;
        for (message, waves) in catalog.messages().iter().zip(&messages) {
            for (signal, (id, _)) in message.signals.iter().zip(waves) {
                match signal.place.width() {
                    _ if !is_wire(signal) => writer.change_real(*id, f64::NAN)?,
                    1 => writer.change_scalar(*id, Level::X)?,
                    width => writer.change_vector(*id, (0..width).map(|_| Level::X))?,
                }
            }
        }
        writer.change_string(state, "unknown")?;
        arrows.dump(writer)?;
        writer.end()?;
        Ok(Self { origin, now: 0, messages, state, arrows })
    }

    /// The time of a frame; tells whether it goes backwards, which a VCD cannot.
    fn tick<W: Write>(&mut self, writer: &mut Writer<W>, time_ns: i64) -> Result<bool, SinkError> {
        let Ok(now) = u64::try_from(time_ns.saturating_sub(self.origin)) else { return Ok(true) };
        if now > self.now {
            self.now = now;
            writer.timestamp(now)?;
        }
        Ok(now < self.now)
    }
}

impl Sink for VcdFile<'_> {
    fn frame(&mut self, frame: &Frame<'_>) -> Result<(), SinkError> {
        let record = frame.record;
        let waves = match &mut self.waves {
            Some(waves) => waves,
            none => none.insert(Waves::begin(&mut self.writer, self.catalog, record.time_ns)?),
        };
        if !self.bus.has(frame) {
            self.other_interfaces += 1;
            return Ok(());
        }
        self.backwards += u64::from(waves.tick(&mut self.writer, record.time_ns)?);
        let Some((place, message)) = frame.message else {
            self.unknown += 1;
            return Ok(());
        };
        let of_message = waves.messages.get_mut(place).map(Vec::as_mut_slice).unwrap_or_default();
        for (signal, (id, last)) in message.signals.iter().zip(of_message) {
            let Some(bits) = signal.place.bits(record.data).filter(|_| message.has(signal, record.data))
            else {
                continue;
            };
            if *last == Some(bits) {
                continue;
            }
            *last = Some(bits);
            match signal.place.width() {
                _ if !is_wire(signal) => self.writer.change_real(*id, signal.value(bits).to_f64())?,
                1 => self.writer.change_scalar(*id, bits == 1)?,
                width => {
                    let levels = (0..width).rev().map(|bit| Level::from(bits >> bit & 1 == 1));
                    self.writer.change_vector(*id, levels)?;
                }
            }
        }
        let Some(interface) = self.bus.name() else { return Ok(()) };
        let watch = self.watch.get_or_insert_with(|| Watch::new(self.catalog.edition(), interface));
        if watch.frame(record) {
            let stay = watch.stay();
            let name = stay.map_or("unknown", |stay| stay.state.name());
            self.writer.change_string(waves.state, name)?;
            waves.arrows.show(&mut self.writer, stay)?;
        }
        Ok(())
    }

    fn dropped(&mut self, dropped: &Dropped<'_>) -> Result<(), SinkError> {
        if let Some(watch) = &mut self.watch {
            watch.dropped(dropped);
        }
        Ok(())
    }

    fn finish(&mut self, _lines: u64) -> Result<(), SinkError> {
        Ok(self.writer.flush()?)
    }

    fn notes(&self) -> Vec<String> {
        let mut notes = Vec::new();
        let mut note = |count: u64, what: &str| {
            if count > 0 {
                notes.push(format!("{count} {what}"));
            }
        };
        note(self.unknown, "frames that nothing knows are not in the file: no wave shows bytes");
        note(
            self.other_interfaces,
            "frames of other interfaces are not in the file; --interface names another",
        );
        note(
            self.backwards,
            "frames came with an earlier time than one before them; they stand at that one's",
        );
        notes
    }
}
