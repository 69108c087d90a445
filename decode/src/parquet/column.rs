//! The cells of a column, until there are enough of them for a row group.

use ::parquet::basic::{LogicalType, Repetition, TimeUnit};
use ::parquet::data_type::{
    BoolType, ByteArray, ByteArrayType, DataType, DoubleType, FixedLenByteArray, FixedLenByteArrayType,
    Int32Type, Int64Type,
};
use ::parquet::errors::Result;
use ::parquet::file::writer::SerializedColumnWriter;
use ::parquet::schema::types::{Type, TypePtr};

/// The digits of a decimal: as many as readers take, and more than any whole number of a signal has.
const DIGITS: i32 = 38;
/// The bytes of a decimal of so many digits.
const DECIMAL_BYTES: i32 = 16;

/// A column of one type.
pub(super) struct Column<T: DataType> {
    field: TypePtr,
    values: Vec<T::T>,
    /// 1 for each cell that has a value, 0 for each null: what Parquet calls definition levels.
    defined: Vec<i16>,
}

pub(super) type Bools = Column<BoolType>;
pub(super) type Smalls = Column<Int32Type>;
pub(super) type Integers = Column<Int64Type>;
pub(super) type Doubles = Column<DoubleType>;
pub(super) type Decimals = Column<FixedLenByteArrayType>;
pub(super) type Texts = Column<ByteArrayType>;

/// A column of any type.
pub(super) trait Cells {
    /// What it is called, and of which type it is.
    fn field(&self) -> TypePtr;

    /// Writes the cells, and forgets them.
    fn write(&mut self, writer: SerializedColumnWriter<'_>) -> Result<()>;
}

impl<T: DataType> Column<T> {
    fn new(name: &str, logical: Option<LogicalType>) -> Result<Self> {
        let field = Type::primitive_type_builder(name, T::get_physical_type())
            .with_repetition(Repetition::OPTIONAL)
            .with_length(if matches!(logical, Some(LogicalType::Decimal(_))) { DECIMAL_BYTES } else { -1 })
            .with_precision(if matches!(logical, Some(LogicalType::Decimal(_))) { DIGITS } else { -1 })
            .with_scale(if matches!(logical, Some(LogicalType::Decimal(_))) { 0 } else { -1 })
            .with_logical_type(logical)
            .build()?;
        Ok(Self { field: field.into(), values: Vec::new(), defined: Vec::new() })
    }

    /// A value, or a null.
    #[inline]
    pub(super) fn push(&mut self, value: impl Into<Option<T::T>>) {
        let value = value.into();
        self.defined.push(i16::from(value.is_some()));
        self.values.extend(value);
    }
}

impl<T: DataType> Cells for Column<T> {
    fn field(&self) -> TypePtr {
        self.field.clone()
    }

    fn write(&mut self, mut writer: SerializedColumnWriter<'_>) -> Result<()> {
        writer.typed::<T>().write_batch(&self.values, Some(&self.defined), None)?;
        self.values.clear();
        self.defined.clear();
        writer.close()
    }
}

/// A column of texts.
pub(super) fn texts(name: &str) -> Result<Texts> {
    Column::new(name, Some(LogicalType::String))
}

/// A column of bytes.
pub(super) fn bytes(name: &str) -> Result<Texts> {
    Column::new(name, None)
}

/// A column of times in nanoseconds.
pub(super) fn times(name: &str) -> Result<Integers> {
    Column::new(name, Some(LogicalType::timestamp(false, TimeUnit::NANOS)))
}

/// A column of truth values.
pub(super) fn bools(name: &str) -> Result<Bools> {
    Column::new(name, None)
}

/// A column of integers of 32 bits.
pub(super) fn smalls(name: &str) -> Result<Smalls> {
    Column::new(name, None)
}

/// A column of integers of 64 bits, with a sign or without.
pub(super) fn integers(name: &str, is_signed: bool) -> Result<Integers> {
    Column::new(name, Some(LogicalType::integer(64, is_signed)))
}

/// A column of floats.
pub(super) fn doubles(name: &str) -> Result<Doubles> {
    Column::new(name, None)
}

/// A column of whole numbers of up to 38 digits.
pub(super) fn decimals(name: &str) -> Result<Decimals> {
    Column::new(name, Some(LogicalType::decimal(0, DIGITS)))
}

/// Text for a cell.
pub(super) fn text(text: &str) -> ByteArray {
    text.as_bytes().to_vec().into()
}

/// A whole number for a cell of a decimal.
pub(super) fn decimal(number: i128) -> FixedLenByteArray {
    number.to_be_bytes().to_vec().into()
}
