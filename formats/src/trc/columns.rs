//! What stands in a line, one behind the other.

/// A column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Column {
    /// N: the number of the line.
    Number,
    /// O: its time.
    Offset,
    /// T: what it is.
    Type,
    /// B: its bus.
    Bus,
    /// I: its identifier.
    Id,
    /// d: whether it was received or sent.
    Direction,
    /// R: nothing yet.
    Reserved,
    /// l: how many bytes of data it has.
    Len,
    /// L: the code for that.
    Code,
    /// D: the data.
    Data,
    /// One that is not known.
    Other,
}

use Column::{Bus, Code, Data, Direction, Id, Len, Number, Offset, Other, Reserved, Type};

/// The columns of a file; no more than [`MOST`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Columns {
    all: [Column; MOST],
    len: usize,
    /// Whether the bus and the type are among them: that is asked for each frame.
    pub(super) bus: bool,
    pub(super) typed: bool,
}

const MOST: usize = 12;

impl Columns {
    pub(super) const V1_0: Self = Self::new(&[Number, Offset, Id, Code, Data]);
    const V1_1: Self = Self::new(&[Number, Offset, Type, Id, Code, Data]);
    const V1_2: Self = Self::new(&[Number, Offset, Bus, Type, Id, Code, Data]);
    const V1_3: Self = Self::new(&[Number, Offset, Bus, Type, Id, Reserved, Code, Data]);
    /// These two have a header with their columns, which is what counts.
    const V2_0: Self = Self::new(&[Number, Offset, Type, Id, Direction, Len, Data]);
    const V2_1: Self = Self::new(&[Number, Offset, Type, Bus, Id, Direction, Reserved, Code, Data]);

    const fn new(columns: &[Column]) -> Self {
        let mut new = Self { all: [Other; MOST], len: 0, bus: false, typed: false };
        while new.len < columns.len() {
            let column = columns[new.len];
            new.all[new.len] = column;
            new.len += 1;
            new.bus |= matches!(column, Bus);
            new.typed |= matches!(column, Type);
        }
        new
    }

    /// Those of a version.
    pub(super) fn of_version(version: &[u8]) -> Option<Self> {
        match version {
            b"1.0" => Some(Self::V1_0),
            b"1.1" => Some(Self::V1_1),
            b"1.2" => Some(Self::V1_2),
            b"1.3" => Some(Self::V1_3),
            b"2.0" => Some(Self::V2_0),
            b"2.1" => Some(Self::V2_1),
            _ => None,
        }
    }

    /// Those of a header, such as `N,O,T,B,I,d,R,L,D`; `None` if one is missing that a frame needs.
    pub(super) fn named(letters: &[u8]) -> Option<Self> {
        let mut columns = Self::new(&[]);
        for letter in letters.split(|byte| *byte == b',') {
            let column = match letter.trim_ascii() {
                b"N" => Number,
                b"O" => Offset,
                b"T" => Type,
                b"B" => Bus,
                b"I" => Id,
                b"d" => Direction,
                b"R" => Reserved,
                b"l" => Len,
                b"L" => Code,
                b"D" => Data,
                [byte] if byte.is_ascii_alphabetic() => Other,
                _ => return None,
            };
            *columns.all.get_mut(columns.len)? = column;
            columns.len += 1;
            columns.bus |= column == Bus;
            columns.typed |= column == Type;
        }
        // What follows depends on the type, and the data on the length.
        let has = |column| columns.iter().any(|other| other == column);
        let before = |first, second| {
            let place = |column| columns.iter().position(|other| other == column);
            place(first) < place(second)
        };
        let fits = [Offset, Type, Id, Data].into_iter().all(has) && has(Len) != has(Code);
        let length = if has(Len) { Len } else { Code };
        let ordered = before(Type, length) && before(length, Data) && before(Offset, Type);
        (fits && ordered).then_some(columns)
    }

    #[inline]
    pub(super) fn iter(&self) -> impl Iterator<Item = Column> + '_ {
        self.all.iter().copied().take(self.len)
    }

    /// Whether one stands right behind another.
    pub(super) fn follows(&self, first: Column, second: Column) -> bool {
        self.iter().zip(self.iter().skip(1)).any(|pair| pair == (first, second))
    }
}
