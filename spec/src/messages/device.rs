//! What else is on the vehicle's bus: messages between the VCU and its devices, in which the AI Computer has no part.
//!
//! No document describes them; the CAN database gives their names, their bits and their cycles. So they stand as rows of a
//! table alone, without a struct for each: the state machine goes by none of them, and a program that shows or judges a recording
//! reads them signal by signal.

use core::fmt;

use super::bits::{self, FRAME_BYTES};

/// Who sends a message of this kind, by the names of the CAN database.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum Device {
    /// The Vehicle Control Unit, to its devices.
    #[cfg_attr(feature = "serde", serde(rename = "VCU"))]
    Vcu,
    /// The receiver of the remote control: "Go" and the remote E-stop.
    #[cfg_attr(feature = "serde", serde(rename = "RES"))]
    Res,
    /// The joystick with which a person moves the vehicle.
    #[cfg_attr(feature = "serde", serde(rename = "JOYSTICK"))]
    Joystick,
    /// The touchscreen, at which the mission is selected.
    #[cfg_attr(feature = "serde", serde(rename = "OPUS"))]
    Opus,
    /// The unit that measures position, acceleration and rotation.
    #[cfg_attr(feature = "serde", serde(rename = "PCAN_GPS"))]
    PcanGps,
}

impl Device {
    /// Every sender.
    pub const ALL: [Self; 5] = [Self::Vcu, Self::Res, Self::Joystick, Self::Opus, Self::PcanGps];

    /// The name of the node in the CAN database.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Vcu => "VCU",
            Self::Res => "RES",
            Self::Joystick => "JOYSTICK",
            Self::Opus => "OPUS",
            Self::PcanGps => "PCAN_GPS",
        }
    }

    /// What it is, in a few words.
    pub const fn what(self) -> &'static str {
        match self {
            Self::Vcu => "Vehicle Control Unit",
            Self::Res => "Remote control",
            Self::Joystick => "Joystick",
            Self::Opus => "Touchscreen",
            Self::PcanGps => "GPS and inertial unit",
        }
    }
}

impl fmt::Display for Device {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// How the bits of a signal are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum Coding {
    /// As a number without a sign.
    Unsigned,
    /// As two's complement.
    Signed,
    /// As an IEEE 754 number of single precision; 32 bits.
    Float,
}

/// One message of a device, with its signals.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct DeviceMessage {
    /// The name, as in the CAN database.
    pub name: &'static str,
    /// The CAN identifier.
    pub id: u16,
    /// Who sends it.
    pub sender: Device,
    /// The number of data bytes.
    pub len: u8,
    /// How often it is sent, in milliseconds; `None` where the database sets nothing.
    pub cycle_ms: Option<u16>,
    /// The signals, by ascending start bit.
    pub signals: &'static [DeviceSignal],
}

/// One signal of such a message. It is little endian, and its value is `raw * scale + offset`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct DeviceSignal {
    /// The name, as in the CAN database.
    pub name: &'static str,
    /// The lowest bit; bit 0 is the lowest bit of the first byte.
    pub start: u8,
    /// The number of bits, 1 to 32.
    pub width: u8,
    /// How they are read.
    pub coding: Coding,
    /// The physical size of one raw step.
    pub scale: f64,
    /// The physical value of raw 0.
    pub offset: f64,
    /// The unit, empty where there is none.
    pub unit: &'static str,
    /// The lowest physical value that the database gives.
    pub min: f64,
    /// The highest physical value that the database gives.
    pub max: f64,
    /// The raw values that have names, ascending. Others may come as well.
    pub values: &'static [(i32, &'static str)],
}

impl DeviceMessage {
    /// The same message, if it is well formed. Only tables call this, when they are compiled.
    pub(crate) const fn checked(self) -> Self {
        assert!(self.len as usize <= FRAME_BYTES, "longer than a frame");
        let (mut end, mut i) = (0, 0);
        while i < self.signals.len() {
            let DeviceSignal { start, width, coding, .. } = self.signals[i];
            assert!(start >= end, "signals overlap, or are not in the order of their bits");
            assert!(width >= 1 && width <= 32, "a signal has 1 to 32 bits");
            assert!(!matches!(coding, Coding::Float) || width == 32, "a float has 32 bits");
            end = start + width;
            i += 1;
        }
        assert!(end <= 8 * self.len, "a signal ends after the message does");
        self
    }

    /// The signal with this name.
    ///
    /// ```
    /// use adsdv_spec::Edition;
    ///
    /// let remote = Edition::V2026.bus.device(0x181).expect("RES_TPDO");
    /// let go = remote.signal("K2_SWITCH_GO_STATUS").expect("a signal of 181h");
    /// assert_eq!(go.raw(&[0b010]), Some(1));
    /// assert_eq!(go.value_name(1), Some("ON"));
    /// ```
    pub fn signal(&self, name: &str) -> Option<&'static DeviceSignal> {
        self.signals.iter().find(|signal| signal.name == name)
    }
}

impl DeviceSignal {
    /// The raw value in `data`, sign extended; of a float its bits. `None` if the data ends before the signal does.
    pub const fn raw(&self, data: &[u8]) -> Option<i32> {
        let end = self.start as usize + self.width as usize;
        if data.len() < end.div_ceil(8) || self.width < 1 || self.width > 32 || end > 8 * FRAME_BYTES {
            return None;
        }
        let signed = matches!(self.coding, Coding::Signed);
        Some(bits::extract(bits::load_slice(data), self.start, self.width, signed))
    }

    /// The value in `data`, in the signal's unit; `None` if the data ends before the signal does.
    ///
    /// ```
    /// use adsdv_spec::Edition;
    ///
    /// let gps = Edition::V2026.bus.device(0x621).expect("GPS_CourseSpeed");
    /// let speed = gps.signal("GPS_Speed").expect("a signal of 621h");
    /// assert_eq!(speed.physical(&[0, 0, 0, 0, 0, 0, 0xC0, 0x3F]), Some(1.5));
    /// assert_eq!(speed.physical(&[0, 0, 0, 0]), None);
    /// ```
    pub fn physical(&self, data: &[u8]) -> Option<f64> {
        let raw = self.raw(data)?;
        let number = match self.coding {
            Coding::Float => f64::from(f32::from_bits(bits_of(raw))),
            Coding::Unsigned => f64::from(bits_of(raw)),
            Coding::Signed => f64::from(raw),
        };
        Some(number * self.scale + self.offset)
    }

    /// The data of a frame with this signal set to a raw value; all other bits stay.
    #[must_use]
    pub const fn put(&self, data: [u8; FRAME_BYTES], raw: i32) -> [u8; FRAME_BYTES] {
        if self.width < 1 || self.width > 32 || self.start as usize + self.width as usize > 8 * FRAME_BYTES {
            return data;
        }
        let word = bits::load_slice(&data) & !bits::place(-1, self.start, self.width);
        (word | bits::place(raw, self.start, self.width)).to_le_bytes()
    }

    /// The name of a raw value, where it has one.
    pub fn value_name(&self, raw: i32) -> Option<&'static str> {
        self.values.iter().find(|(value, _)| *value == raw).map(|(_, name)| *name)
    }
}

/// The same 32 bits without a sign.
#[expect(clippy::cast_sign_loss, reason = "the bits are what is meant")]
const fn bits_of(raw: i32) -> u32 {
    raw as u32
}

/// Reads a table of such messages. A message is
///
/// ```text
/// "NAME" identifier from Sender, length bytes, every cycle ms {
///     "SIGNAL" start|width Coding, scale, offset, lowest to highest, "unit", of NAMES;
/// }
/// ```
///
/// with `no cycle` where the database sets none; the unit and the names may be left out.
macro_rules! devices {
    ($($name:literal $id:literal from $sender:ident, $len:literal bytes, $(every $cycle:literal ms)? $(no $none:ident)? {
        $($signal:literal $start:literal|$width:literal $coding:ident, $scale:literal, $offset:literal, $min:literal to $max:literal
            $(, $unit:literal)? $(, of $values:ident)?;)*
    })+) => {
        &[$($crate::messages::DeviceMessage {
            name: $name,
            id: $id,
            sender: $crate::messages::Device::$sender,
            len: $len,
            cycle_ms: $crate::messages::device::optional(&[$($cycle)?]),
            signals: &[$($crate::messages::DeviceSignal {
                name: $signal,
                start: $start,
                width: $width,
                coding: $crate::messages::Coding::$coding,
                scale: $scale,
                offset: $offset,
                unit: concat!($($unit)?),
                min: $min,
                max: $max,
                values: $crate::messages::device::listed(&[$($values)?]),
            }),*],
        }.checked()),+]
    };
}

/// What there is one of, or none.
pub(crate) const fn optional(given: &[u16]) -> Option<u16> {
    match given {
        [one, ..] => Some(*one),
        [] => None,
    }
}

/// The names given, or none.
pub(crate) const fn listed(given: &[&'static [(i32, &'static str)]]) -> &'static [(i32, &'static str)] {
    match given {
        [names, ..] => names,
        [] => &[],
    }
}

pub(crate) use devices;

#[cfg(test)]
mod tests {
    extern crate std;

    use std::string::ToString;

    use super::{Coding, Device, DeviceMessage, DeviceSignal, listed, optional};

    const SIGNAL: DeviceSignal = DeviceSignal {
        name: "signal",
        start: 4,
        width: 8,
        coding: Coding::Signed,
        scale: 0.5,
        offset: 24.0,
        unit: "V",
        min: -40.0,
        max: 87.5,
        values: &[(-1, "unknown")],
    };

    const MESSAGE: DeviceMessage = DeviceMessage {
        name: "message",
        id: 0x600,
        sender: Device::PcanGps,
        len: 2,
        cycle_ms: None,
        signals: &[SIGNAL],
    };

    #[test]
    fn a_signal_is_read_from_its_bits() {
        assert_eq!(
            [&[0xF0, 0x0F][..], &[0x10, 0x00], &[0xFF]].map(|data| SIGNAL.raw(data)),
            [Some(-1), Some(1), None]
        );
        assert_eq!(SIGNAL.physical(&[0xF0, 0x0F]), Some(23.5));
        let unsigned = DeviceSignal { coding: Coding::Unsigned, ..SIGNAL };
        assert_eq!((unsigned.raw(&[0xF0, 0x0F]), unsigned.physical(&[0xF0, 0x0F])), (Some(255), Some(151.5)));
        let wide =
            DeviceSignal { coding: Coding::Unsigned, start: 0, width: 32, scale: 1.0, offset: 0.0, ..SIGNAL };
        assert_eq!(wide.physical(&[0xFF; 4]), Some(f64::from(u32::MAX)));
        assert_eq!((SIGNAL.value_name(-1), SIGNAL.value_name(0)), (Some("unknown"), None));
    }

    #[test]
    fn a_signal_is_put_where_it_is_read() {
        let data = SIGNAL.put([0xFF; 8], -2);
        assert_eq!((data[..3].to_vec(), SIGNAL.raw(&data)), ([0xEF, 0xFF, 0xFF].to_vec(), Some(-2)));
    }

    #[test]
    fn a_signal_beyond_a_frame_is_neither_read_nor_put() {
        for (start, width) in [(60, 5), (0, 0), (0, 33)] {
            let signal = DeviceSignal { start, width, ..SIGNAL };
            assert_eq!((signal.raw(&[0xFF; 9]), signal.put([1; 8], 0)), (None, [1; 8]), "{start} {width}");
        }
    }

    #[test]
    fn a_message_is_as_it_was_where_it_is_well_formed() {
        assert_eq!(MESSAGE.checked(), MESSAGE);
        assert_eq!(MESSAGE.signal("signal"), Some(&SIGNAL));
        assert_eq!(MESSAGE.signal("other"), None);
    }

    #[test]
    #[should_panic(expected = "longer than a frame")]
    fn a_message_longer_than_a_frame_does_not_compile() {
        let _ = DeviceMessage { len: 9, ..MESSAGE }.checked();
    }

    #[test]
    #[should_panic(expected = "ends after the message")]
    fn a_signal_behind_its_message_does_not_compile() {
        let _ = DeviceMessage { len: 1, ..MESSAGE }.checked();
    }

    #[test]
    #[should_panic(expected = "overlap")]
    fn signals_that_overlap_do_not_compile() {
        let _ = DeviceMessage { signals: &[SIGNAL, SIGNAL], ..MESSAGE }.checked();
    }

    #[test]
    #[should_panic(expected = "1 to 32 bits")]
    fn a_signal_without_bits_does_not_compile() {
        let _ = DeviceMessage { signals: &[DeviceSignal { width: 0, ..SIGNAL }], ..MESSAGE }.checked();
    }

    #[test]
    #[should_panic(expected = "a float has 32 bits")]
    fn a_short_float_does_not_compile() {
        let _ = DeviceMessage { signals: &[DeviceSignal { coding: Coding::Float, ..SIGNAL }], ..MESSAGE }
            .checked();
    }

    #[test]
    fn what_a_table_leaves_out_is_none() {
        assert_eq!((optional(&[]), optional(&[10])), (None, Some(10)));
        assert_eq!((listed(&[]), listed(&[&[(1, "on")]])), (&[][..], &[(1, "on")][..]));
    }

    #[test]
    fn a_device_has_the_name_of_the_database() {
        let names = Device::ALL.map(|device| (device.to_string(), device.what()));
        assert_eq!(names[4], ("PCAN_GPS".to_string(), "GPS and inertial unit"));
        assert!(names.iter().all(|(name, what)| !name.is_empty() && !what.is_empty()));
    }
}
