//! The columns of a signal: its values in the type that they have, and their names.

use ::parquet::data_type::ByteArray;
use ::parquet::errors::Result;

use super::named::Names;
use crate::parquet::column::{self, Bools, Cells, Decimals, Doubles, Integers, Texts};
use crate::parquet::signals;
use crate::signal::Scaling;
use crate::{Coding, Signal, Value};

/// The columns of a signal.
pub(super) struct SignalColumn {
    values: TypedColumn,
    /// Those of the names of values, with these, if there are any.
    names: Option<(Texts, Vec<ByteArray>)>,
}

/// The values of a signal, as what they are.
enum TypedColumn {
    /// A bit that is no more than that.
    Bit(Bools),
    /// Whole numbers of 64 bits, with a sign.
    Signed(Integers),
    /// Whole numbers of 64 bits, without a sign.
    Unsigned(Integers),
    /// Larger whole numbers.
    Large(Decimals),
    /// All others.
    Real(Doubles),
}

impl SignalColumn {
    /// The columns of a signal that has this name here.
    pub(super) fn new(signal: &Signal, name: &str, names: &mut Names) -> Result<Self> {
        let values = TypedColumn::new(signal, name)?;
        if signal.names.is_empty() {
            return Ok(Self { values, names: None });
        }
        let name_column = column::texts(&names.column(&format!("{name}_name")))?;
        Ok(Self { values, names: Some((name_column, signals::names(signal))) })
    }

    /// The value of these bits; none if the frame has no such signal.
    pub(super) fn push(&mut self, signal: &Signal, bits: Option<u64>) {
        self.values.push(signal, bits);
        if let Some((column, names)) = &mut self.names {
            column.push(
                bits.and_then(|bits| signal.name_place(bits)).and_then(|place| names.get(place).cloned()),
            );
        }
    }

    pub(super) fn all(&mut self) -> impl Iterator<Item = &mut dyn Cells> {
        let names = self.names.as_mut().map(|(column, _)| -> &mut dyn Cells { column });
        std::iter::once(self.values.cells()).chain(names)
    }
}

impl TypedColumn {
    fn new(signal: &Signal, name: &str) -> Result<Self> {
        Ok(match range(signal) {
            None => Self::Real(column::doubles(name)?),
            Some((0, 1)) if signal.place.width() == 1 => Self::Bit(column::bools(name)?),
            Some((low, high)) if fits::<i64>(low, high) => Self::Signed(column::integers(name, true)?),
            Some((low, high)) if fits::<u64>(low, high) => Self::Unsigned(column::integers(name, false)?),
            Some(_) => Self::Large(column::decimals(name)?),
        })
    }

    fn push(&mut self, signal: &Signal, bits: Option<u64>) {
        let whole = || bits.and_then(|bits| whole(signal.value(bits)));
        match self {
            Self::Bit(column) => column.push(bits.map(|bits| bits == 1)),
            Self::Signed(column) => column.push(whole().and_then(|number| i64::try_from(number).ok())),
            Self::Unsigned(column) => {
                column.push(whole().and_then(|number| u64::try_from(number).ok()).map(u64::cast_signed));
            }
            Self::Large(column) => column.push(whole().map(column::decimal)),
            Self::Real(column) => column.push(bits.map(|bits| signal.value(bits).to_f64())),
        }
    }

    fn cells(&mut self) -> &mut dyn Cells {
        match self {
            Self::Bit(column) => column,
            Self::Signed(column) | Self::Unsigned(column) => column,
            Self::Large(column) => column,
            Self::Real(column) => column,
        }
    }
}

/// The number that a value of a signal with a [`range`] is.
fn whole(value: Value) -> Option<i128> {
    match value {
        Value::Whole(number) => Some(number),
        Value::Steps { raw, scale } => Some(i128::from(raw) * i128::from(scale.num())),
        Value::Real(_) => None,
    }
}

/// The smallest value and the largest one of a signal of which all are whole numbers.
fn range(signal: &Signal) -> Option<(i128, i128)> {
    let width = signal.place.width();
    let (low, high) = match signal.place.coding() {
        Coding::Unsigned => (0, (1_i128 << width) - 1),
        Coding::Signed => (-(1_i128 << (width - 1)), (1_i128 << (width - 1)) - 1),
        Coding::Float => return None,
    };
    let (factor, offset) = match signal.scaling {
        // Such a value is of 32 bits.
        Scaling::Steps(scale) if scale.den() == 1 && i32::try_from(high).is_ok() => {
            (i64::from(scale.num()), 0)
        }
        Scaling::Whole { factor, offset } => (factor, offset),
        Scaling::Steps(_) | Scaling::Linear { .. } => return None,
    };
    let [one, other] = [low, high].map(|raw| raw * i128::from(factor) + i128::from(offset));
    Some((one.min(other), one.max(other)))
}

fn fits<T: TryFrom<i128>>(low: i128, high: i128) -> bool {
    T::try_from(low).is_ok() && T::try_from(high).is_ok()
}
