//! The fields of a row: their types and places, made of the lists that single steps have.

use adsdv_conform::protocol::{Domain, SHOWN, Showing};
use adsdv_spec::{Control, Edition, Inputs, Outputs};
use pyo3::prelude::*;

use crate::control;
use crate::edition;
use crate::error::InputError;
use crate::value;

/// What a row is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Of {
    Inputs,
    Outputs,
    Control,
}

impl Of {
    const ALL: [Self; 3] = [Self::Inputs, Self::Outputs, Self::Control];

    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Inputs => "inputs",
            Self::Outputs => "outputs",
            Self::Control => "control",
        }
    }

    pub(super) fn named(given: &Bound<'_, PyAny>) -> PyResult<Self> {
        let name = value::text(given);
        Self::ALL.into_iter().find(|of| name.as_deref() == Some(of.name())).ok_or_else(|| {
            let [one, two, three] = Self::ALL.map(Self::name);
            value::refused("of", given, format_args!("{one:?}, {two:?} or {three:?}"))
        })
    }

    /// The fields of its rows, with their types.
    fn fields(self, edition: &Edition) -> Vec<(String, Type)> {
        let protocol = edition::protocol(edition);
        match self {
            Self::Inputs => {
                protocol.inputs().map(|(field, domain)| (field.key.to_owned(), Type::of(domain))).collect()
            }
            Self::Control => {
                let fields = control::FIELDS.iter();
                fields.map(|field| (field.key.to_owned(), Type::of(field.domain))).collect()
            }
            Self::Outputs => {
                let mut fields = Vec::new();
                for (field, domain) in protocol.shown() {
                    fields.push((field.key.to_owned(), Type::of(domain)));
                    if field.nullable {
                        fields.push((format!("{}_active", field.key), Type::Flag));
                    }
                }
                fields.push(("row".to_owned(), Type::I16));
                fields
            }
        }
    }

    /// The fields whose values have names, with these and their numbers.
    pub(super) fn names(self, edition: &Edition) -> Vec<(&'static str, Vec<(i32, &'static str)>)> {
        let protocol = edition::protocol(edition);
        // A Control is of no edition: its names are its own, but it cannot have what the edition has not.
        let fields: Vec<(&str, Domain, Domain)> = match self {
            Self::Inputs => protocol.inputs().map(|(field, domain)| (field.key, domain, domain)).collect(),
            Self::Outputs => protocol.shown().map(|(field, domain)| (field.key, domain, domain)).collect(),
            Self::Control => {
                control_fields(edition).map(|(field, domain)| (field.key, field.domain, domain)).collect()
            }
        };
        let named = fields.into_iter().filter_map(|(key, names, has)| match names {
            Domain::Names(names) => {
                Some((key, names.iter().copied().filter(|&(raw, _)| has.has(raw)).collect()))
            }
            _ => None,
        });
        named.collect()
    }

    /// What `numpy.dtype` takes.
    pub(super) fn dtype(self, edition: &Edition) -> Vec<(String, &'static str)> {
        self.fields(edition).into_iter().map(|(key, r#type)| (key, r#type.name())).collect()
    }

    /// How many bytes a row has.
    pub(super) fn size(self, edition: &Edition) -> usize {
        self.fields(edition).into_iter().map(|(_, r#type)| r#type.size()).sum()
    }

    /// A row with each field at its default.
    pub(super) fn usual(self, edition: &Edition) -> Vec<u8> {
        let mut row = vec![0; self.size(edition)];
        match self {
            Self::Inputs => {
                let mut begin = 0;
                for (field, domain) in edition::protocol(edition).inputs() {
                    begin = Type::of(domain).write(&mut row, begin, (field.get)(&Inputs::default()));
                }
            }
            Self::Control => Remembered::new().write(&mut row, &Control::INITIAL),
            Self::Outputs => {}
        }
        row
    }
}

/// The type of a field: the smallest that has its values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Type {
    Flag,
    U8,
    U16,
    I16,
    I32,
}

impl Type {
    fn of(domain: Domain) -> Self {
        let (min, max) = match domain {
            Domain::Flag => return Self::Flag,
            Domain::Names(names) => {
                let raw = || names.iter().map(|&(raw, _)| raw);
                (raw().min().unwrap_or(0), raw().max().unwrap_or(0))
            }
            Domain::Number { min, max } => (min, max),
        };
        let fits = |least: i32, most: i32| least <= min && max <= most;
        if fits(0, u8::MAX.into()) {
            Self::U8
        } else if fits(0, u16::MAX.into()) {
            Self::U16
        } else if fits(i16::MIN.into(), i16::MAX.into()) {
            Self::I16
        } else {
            Self::I32
        }
    }

    /// As the array interface of NumPy calls it.
    const fn name(self) -> &'static str {
        match self {
            Self::Flag => "|b1",
            Self::U8 => "|u1",
            Self::U16 => "<u2",
            Self::I16 => "<i2",
            Self::I32 => "<i4",
        }
    }

    const fn size(self) -> usize {
        match self {
            Self::Flag | Self::U8 => 1,
            Self::U16 | Self::I16 => 2,
            Self::I32 => 4,
        }
    }

    /// The number at the beginning of these bytes; 0 where there are too few.
    fn read(self, bytes: &[u8]) -> i32 {
        let two = || bytes.first_chunk().copied().unwrap_or_default();
        match self {
            Self::Flag | Self::U8 => bytes.first().copied().unwrap_or_default().into(),
            Self::U16 => u16::from_le_bytes(two()).into(),
            Self::I16 => i16::from_le_bytes(two()).into(),
            Self::I32 => i32::from_le_bytes(bytes.first_chunk().copied().unwrap_or_default()),
        }
    }

    /// Writes a number, as much of it as the type has, and tells where the next one begins.
    fn write(self, row: &mut [u8], begin: usize, raw: i32) -> usize {
        let bytes @ [one, two, ..] = raw.to_le_bytes();
        let end = begin + self.size();
        if let Some(place) = row.get_mut(begin..end) {
            match place {
                [place] => *place = one,
                [first, second] => (*first, *second) = (one, two),
                all => all.copy_from_slice(&bytes),
            }
        }
        end
    }
}

/// Reads rows, one after the other.
pub(super) struct Reader<T> {
    name: &'static str,
    /// What the last row said.
    read: T,
    fields: Vec<Column<T>>,
}

struct Column<T> {
    key: &'static str,
    domain: Domain,
    r#type: Type,
    /// Where it begins in a row.
    begin: usize,
    set: fn(&mut T, i32) -> bool,
    /// What it was in the last row.
    last: i32,
}

impl Reader<Inputs> {
    pub(super) fn of_inputs(name: &'static str, edition: &Edition) -> Self {
        let usual = Inputs::default();
        let fields = edition::protocol(edition).inputs();
        let fields = fields.map(|(field, domain)| (field.key, domain, field.set, (field.get)(&usual)));
        Self::new(name, usual, fields)
    }
}

impl Reader<Control> {
    pub(super) fn of_control(name: &'static str, edition: &Edition) -> Self {
        let usual = Control::INITIAL;
        let fields = control_fields(edition);
        let fields = fields.map(|(field, domain)| (field.key, domain, field.set, (field.get)(&usual)));
        Self::new(name, usual, fields)
    }
}

/// What a VCU remembers, with the values that the edition has.
fn control_fields(edition: &Edition) -> impl Iterator<Item = (&'static control::Field, Domain)> {
    control::FIELDS.iter().map(|field| match (field.domain, edition.bus.signal_of(field.key)) {
        (Domain::Names(_), Some(signal)) if !signal.values.is_empty() => {
            (field, Domain::Names(signal.values))
        }
        (domain, _) => (field, domain),
    })
}

impl<T> Reader<T> {
    fn new(
        name: &'static str,
        usual: T,
        given: impl Iterator<Item = (&'static str, Domain, fn(&mut T, i32) -> bool, i32)>,
    ) -> Self {
        let (mut fields, mut begin) = (Vec::new(), 0);
        for (key, domain, set, last) in given {
            let r#type = Type::of(domain);
            fields.push(Column { key, domain, r#type, begin, set, last });
            begin += r#type.size();
        }
        Self { name, read: usual, fields }
    }

    /// What a row says; `number` is its own, for the error.
    pub(super) fn read(&mut self, number: usize, row: &[u8]) -> PyResult<&T> {
        for field in &mut self.fields {
            let raw = field.r#type.read(row.get(field.begin..).unwrap_or_default());
            // Most of a row is what the row before it said.
            if raw == field.last {
                continue;
            }
            if !(field.domain.has(raw) && (field.set)(&mut self.read, raw)) {
                let Column { key, domain, .. } = field;
                return Err(InputError::new_err(format!(
                    "{}[{number}]: {key:?} is {raw}; expected {}",
                    self.name,
                    Expected(*domain)
                )));
            }
            field.last = raw;
        }
        Ok(&self.read)
    }
}

/// The values of a field, where a number stands for each.
struct Expected(Domain);

impl std::fmt::Display for Expected {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.0 {
            Domain::Flag => f.write_str("0 or 1"),
            Domain::Names(names) => {
                for (place, (raw, name)) in names.iter().enumerate() {
                    write!(f, "{}{raw} = {name}", if place == 0 { "" } else { ", " })?;
                }
                Ok(())
            }
            domain @ Domain::Number { .. } => domain.fmt(f),
        }
    }
}

/// Writes what VCUs remember.
pub(super) struct Remembered(Vec<(Type, &'static control::Field)>);

impl Remembered {
    pub(super) fn new() -> Self {
        Self(control::FIELDS.iter().map(|field| (Type::of(field.domain), field)).collect())
    }

    /// Fills a row.
    pub(super) fn write(&self, row: &mut [u8], control: &Control) {
        let mut begin = 0;
        for (r#type, field) in &self.0 {
            begin = r#type.write(row, begin, (field.get)(control));
        }
    }
}

/// Writes what steps show.
pub(super) struct Showed {
    showing: Showing,
    /// What an edition has: where it stands in [`SHOWN`], its type, and whether it may be missing.
    fields: Vec<(usize, Type, bool)>,
}

impl Showed {
    pub(super) fn of(edition: &Edition) -> Self {
        let fields = edition::protocol(edition).shown().filter_map(|(field, domain)| {
            let place = SHOWN.iter().position(|shown| shown.key == field.key)?;
            Some((place, Type::of(domain), field.nullable))
        });
        Self { showing: Showing::of(edition), fields: fields.collect() }
    }

    /// Fills a row.
    pub(super) fn write(&self, row: &mut [u8], outputs: &Outputs, inputs: &Inputs) {
        let (shown, mut begin) = (self.showing.shown(outputs, inputs), 0);
        for &(place, r#type, nullable) in &self.fields {
            let raw = shown.raw_at(place);
            begin = r#type.write(row, begin, raw.unwrap_or_default());
            if nullable {
                begin = Type::Flag.write(row, begin, raw.is_some().into());
            }
        }
        Type::I16.write(row, begin, outputs.taken.map_or(-1, |taken| taken.row.into()));
    }
}
