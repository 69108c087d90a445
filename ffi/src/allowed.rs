//! What a field may be, in words: the end of every error about a value.

use core::fmt;

use adsdv_spec::messages::{Decimal, Scale, SignalDef, SignalValue};

/// What a field may be; it displays as in `0 = NEUTRAL, 1 = FORWARD`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Allowed {
    pub(crate) min: i32,
    pub(crate) max: i32,
    pub(crate) values: &'static [(i32, &'static str)],
    scale: Scale,
    unit: &'static str,
}

impl Allowed {
    pub(crate) const fn of<T: SignalValue>() -> Self {
        Self { min: T::MIN, max: T::MAX, values: T::VALUES, scale: T::SCALE, unit: T::UNIT }
    }

    /// What an edition allows of it, where that has a signal for it.
    pub(crate) fn on_bus(self, signal: Option<&SignalDef>) -> Self {
        match signal {
            Some(signal) if self.values.is_empty() => Self { min: signal.min, max: signal.max, ..self },
            Some(signal) if !signal.values.is_empty() => Self { values: signal.values, ..self },
            _ => self,
        }
    }
}

impl fmt::Display for Allowed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (place, (value, name)) in self.values.iter().enumerate() {
            write!(f, "{}{value} = {name}", if place == 0 { "" } else { ", " })?;
        }
        match (self.values, self.min, self.max) {
            ([], 0, 1) => f.write_str("0 or 1"),
            ([], min, max) if self.unit.is_empty() => write!(f, "{min} to {max}"),
            ([], min, max) => {
                let (lowest, highest) =
                    (Decimal { raw: min, scale: self.scale }, Decimal { raw: max, scale: self.scale });
                write!(f, "{min} to {max} ({lowest} to {highest} {})", self.unit)
            }
            _ => Ok(()),
        }
    }
}
