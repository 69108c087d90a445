//! A message: an identifier, a length and signals; and the signals that a frame of it has.

use adsdv_oracle::candump::FrameKind;

use crate::{Signal, Value};

/// Where a message is described.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// In the edition of the interface: between the VCU and the AI Computer, or with the devices.
    Edition,
    /// In a database of the user's own, by its place among these.
    Database(usize),
}

/// A message, of the document or of a database of the user's own.
#[derive(Clone, Debug, PartialEq)]
pub struct Message {
    /// The name, as in the CAN database.
    pub name: Box<str>,
    /// The CAN identifier.
    pub id: u32,
    /// Whether it has 29 bits.
    pub extended: bool,
    /// The number of data bytes.
    pub len: usize,
    /// Where it is described.
    pub origin: Origin,
    /// The signals, in the order of its database.
    pub signals: Box<[Signal]>,
    /// What it is for; empty where nobody has written that down.
    pub doc: Box<str>,
}

/// A signal that a frame has.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reading<'a> {
    /// Which one.
    pub signal: &'a Signal,
    /// Its bits.
    pub bits: u64,
}

impl<'a> Reading<'a> {
    /// The value in the signal's unit.
    pub fn value(&self) -> Value {
        self.signal.value(self.bits)
    }

    /// The name of the value, where it has one.
    pub fn name(&self) -> Option<&'a str> {
        self.signal.value_name(self.bits)
    }
}

impl Message {
    /// The signals that are in the data of a frame, in the order of the database: all that the data is long enough for, but for those
    /// that their multiplexer leaves out.
    ///
    /// ```
    /// use adsdv_decode::Catalog;
    /// use adsdv_spec::Edition;
    ///
    /// let catalog = Catalog::of(&Edition::V3_0);
    /// let steer = catalog.named("VCU2AI_Steer").expect("a message of the VCU");
    /// let readings: Vec<_> = steer.readings(&[0xF6, 0xFF, 0x00]).collect();
    /// assert_eq!(readings.len(), 1, "the others need more data");
    /// assert_eq!(&*readings[0].signal.name, "STEER_ANGLE_deg");
    /// assert_eq!(readings[0].value().to_f64(), -1.0);
    /// ```
    #[inline]
    pub fn readings<'a>(&'a self, data: &'a [u8]) -> impl Iterator<Item = Reading<'a>> {
        self.signals.iter().filter_map(move |signal| {
            let bits = signal.place.bits(data)?;
            self.has(signal, data).then_some(Reading { signal, bits })
        })
    }

    /// Whether a signal is in this frame, as far as multiplexers say.
    #[inline]
    pub(crate) fn has(&self, signal: &Signal, data: &[u8]) -> bool {
        signal.multiplexed.is_none() || self.is_chosen(signal, data)
    }

    fn is_chosen(&self, signal: &Signal, data: &[u8]) -> bool {
        let mut signal = signal;
        // A multiplexer may have one itself, and a database in which that goes round in circles is not believed.
        for _ in 0..=self.signals.len() {
            let Some(multiplexed) = &signal.multiplexed else { return true };
            let Some(by) = self.signals.get(multiplexed.by) else { return false };
            let chosen = by.place.bits(data);
            if !chosen.is_some_and(|bits| multiplexed.values.iter().any(|values| values.contains(&bits))) {
                return false;
            }
            signal = by;
        }
        false
    }

    /// Whether a frame of this kind and identifier is one of it. Those of the document are classic frames.
    pub(crate) fn is_of(&self, kind: FrameKind, id: u32) -> bool {
        self.id == id
            && match kind {
                FrameKind::Standard => !self.extended,
                FrameKind::Extended => self.extended,
                FrameKind::Fd { extended, .. } => self.extended == extended && self.origin != Origin::Edition,
                FrameKind::Remote { .. } | FrameKind::Error | FrameKind::Xl => false,
            }
    }

    /// The identifier as candump has it: three digits, or eight of an extended one.
    pub fn id_text(&self) -> String {
        if self.extended { format!("{:08X}", self.id) } else { format!("{:03X}", self.id) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::signal::{Multiplexed, Scaling};
    use crate::{Coding, Order, Place};

    fn signal(start: u32, multiplexed: Option<(usize, u64)>) -> Signal {
        Signal {
            name: format!("S{start}").into(),
            unit: "".into(),
            place: Place::new(start, 8, Order::Little, Coding::Unsigned).expect("bits of a frame"),
            scaling: Scaling::of(1.0, 0.0),
            names: [].into(),
            multiplexed: multiplexed.map(|(by, value)| Multiplexed { by, values: [value..=value].into() }),
            doc: "".into(),
        }
    }

    fn message(signals: &[Signal]) -> Message {
        Message {
            name: "M".into(),
            id: 1,
            extended: false,
            len: 8,
            origin: Origin::Database(0),
            signals: signals.into(),
            doc: "".into(),
        }
    }

    #[test]
    fn a_multiplexer_chooses_and_may_be_chosen_itself() {
        let message = message(&[
            signal(0, None),
            signal(8, Some((0, 1))),
            signal(16, Some((1, 2))),
            signal(16, Some((1, 3))),
        ]);
        let has = |data: &[u8]| {
            message
                .readings(data)
                .map(|reading| reading.signal.name.to_string())
                .collect::<Vec<_>>()
                .join(" ")
        };
        assert_eq!(has(&[0, 2, 9]), "S0");
        assert_eq!(has(&[1, 2, 9]), "S0 S8 S16");
        assert_eq!(has(&[1, 9, 9]), "S0 S8");
        assert_eq!(has(&[1]), "S0");
        assert_eq!(has(&[]), "");
    }

    #[test]
    fn multiplexers_in_a_circle_choose_nothing() {
        let message = message(&[signal(0, Some((1, 0))), signal(8, Some((0, 0))), signal(16, Some((2, 0)))]);
        assert_eq!(message.readings(&[0; 8]).count(), 0);
        let nowhere = Message { signals: [signal(0, Some((7, 0)))].into(), ..message };
        assert_eq!(nowhere.readings(&[0; 8]).count(), 0);
    }

    #[test]
    fn a_frame_is_of_a_message_by_its_kind_too() {
        let kinds = [
            FrameKind::Standard,
            FrameKind::Extended,
            FrameKind::Fd { extended: false, flags: 0 },
            FrameKind::Remote { extended: false, len: 0 },
            FrameKind::Error,
            FrameKind::Xl,
        ];
        let of = |message: &Message| kinds.map(|kind| message.is_of(kind, 1));
        let team = message(&[]);
        assert_eq!(of(&team), [true, false, true, false, false, false]);
        let document = Message { origin: Origin::Edition, ..team.clone() };
        assert_eq!(of(&document), [true, false, false, false, false, false]);
        assert_eq!(of(&Message { extended: true, ..team }), [false, true, false, false, false, false]);
    }
}
