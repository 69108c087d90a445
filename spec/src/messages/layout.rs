//! How an edition lays a message out on the bus: the macro that reads the tables in `editions`.

use super::{DecodeError, FieldDef, Frame, MessageDef, SignalDef, SignalValue};

/// An edition's layout of the message `M`: where its signals are, and what each may be.
///
/// The type that implements it stands for the edition, such as [`V3_0`](crate::editions::V3_0). A program that knows the edition
/// only when it runs asks the [`Edition`](crate::Edition) itself.
///
/// ```
/// use adsdv_spec::editions::V3_0;
/// use adsdv_spec::messages::{Ai2VcuSteer, Layout, SteerAngle};
///
/// let request = Ai2VcuSteer { steer_request: SteerAngle::from_deg(-10.0)? };
/// let frame = V3_0::encode(&request);
/// assert_eq!(frame.to_string(), "513#9CFF000000000000");
/// assert_eq!(V3_0::decode(frame.data()), Ok(request));
/// # Ok::<(), adsdv_spec::messages::QuantityError>(())
/// ```
pub trait Layout<M> {
    /// The message's row in the edition's table, with its signals.
    const DEF: &'static MessageDef;

    /// Reads the data of a frame.
    ///
    /// Data may be longer or shorter than the edition says, as long as every signal is there; bits that no signal uses
    /// are ignored. What the edition does not have is the default.
    ///
    /// # Errors
    ///
    /// [`DecodeError::TooShort`] if a signal is not there, [`DecodeError::Value`] if one has a value outside its range or its
    /// enumeration.
    fn decode(data: &[u8]) -> Result<M, DecodeError>;

    /// The frame that carries this message, as long as the edition says; bits that no signal uses are zero.
    ///
    /// A value outside the edition's range goes out as the nearest inside; see [`holds`](Layout::holds).
    fn encode(message: &M) -> Frame;

    /// Whether the edition can say all of this message: what is [encoded](Layout::encode) is read back as the same.
    fn holds(message: &M) -> bool;
}

/// The row of a signal that carries what `_field` gets.
pub(crate) const fn row_of<M, T: SignalValue>(
    _field: fn(&M) -> T,
    name: &'static str,
    start: u8,
    width: u8,
    field: &'static FieldDef,
) -> SignalDef {
    SignalDef::of::<T>(name, start, width, field.doc).carrying(field)
}

/// The value of a raw number, if its type and its row have it.
#[inline]
pub(crate) fn value_of<T: SignalValue>(row: &SignalDef, raw: i32) -> Option<T> {
    match T::from_raw(row.meaning(raw)) {
        Some(value) if row.min <= raw && raw <= row.max => Some(value),
        _ => None,
    }
}

/// The raw number of a value, or the nearest that its row has.
#[inline]
pub(crate) fn raw_of<T: SignalValue>(row: &SignalDef, value: T) -> i32 {
    let raw = value.to_raw();
    // What a type cannot exceed is no question: then these are constants.
    if T::MIN < row.min && raw < row.min {
        row.min
    } else if T::MAX > row.max && raw > row.max {
        row.max
    } else {
        raw
    }
}

/// Reads an edition's table of messages. A message is
///
/// ```text
/// StructName = "NAME", length bytes, every cycle ms, section "2.x" {
///     field = "SIGNAL" start|width;
///     flag = "SIGNAL" start|width ["NAME OF 0", "NAME OF 1"];
///     quantity = "SIGNAL" start|width in lowest to highest;
///     enumeration = "SIGNAL" start|width of NAMES;
///     enumeration = "SIGNAL" start|width of NAMES with number as another;
/// }
/// ```
///
/// and becomes the edition's [`Layout`] of the message. Ranges are raw numbers; where there is none, that of the field's type
/// holds. `NAMES` are the edition's own names of the numbers that the field's type has; where there are none, its own hold. A
/// number that the type does not have may be read as one that it has; it is the first of the names.
macro_rules! layouts {
    ($edition:ident: $(
        $message:ident = $name:literal, $len:literal bytes, every $cycle:literal ms, section $section:literal {
            $(
                $field:ident = $signal:literal $start:literal|$width:literal
                    $([$off:literal, $on:literal])?
                    $(of $names:ident)?
                    $(with $raw:literal as $meaning:literal)?
                    $(in $min:literal to $max:literal)?;
            )+
        }
    )+) => {$(
        impl $crate::messages::Layout<$message> for $edition {
            const DEF: &'static $crate::messages::MessageDef = {
                use $crate::messages::{Message, MessageDef, content::field_of, layout::row_of};
                &MessageDef {
                    name: $name,
                    id: $message::ID,
                    sender: <$message as Message>::SENDER,
                    len: $len,
                    cycle_ms: $cycle,
                    section: $section,
                    requirements: <$message as Message>::REQUIREMENTS,
                    signals: &[$(
                        row_of(
                            |message: &$message| message.$field,
                            $signal,
                            $start,
                            $width,
                            field_of(<$message as Message>::FIELDS, stringify!($field)),
                        )
                        $(.with_flag_names(&[(0, $off), (1, $on)]))?
                        $(.reading($raw, $meaning))?
                        $(.with_values($names))?
                        $(.within($min, $max))?
                    ),+],
                    doc: $message::DOC,
                }
                .checked()
            };

            #[inline]
            fn decode(data: &[u8]) -> Result<$message, $crate::messages::DecodeError> {
                use $crate::messages::{DecodeError, Layout, MessageDef, bits, layout::value_of};

                const DEF: &MessageDef = <$edition as Layout<$message>>::DEF;
                const NEEDED: usize = DEF.bytes_needed();

                /// The place of each field's signal in the row.
                #[expect(non_camel_case_types, reason = "they are the fields' names")]
                enum Place {
                    $($field),+
                }

                //= D-33, D-66
                let Some(word) = bits::load::<NEEDED>(data) else {
                    return Err(DecodeError::too_short(DEF, data.len()));
                };
                let mut message = $message::default();
                $({
                    let signal = const { &DEF.signals[Place::$field as usize] };
                    //= D-30
                    let raw = bits::extract(word, $start, $width, signal.signed);
                    match value_of(signal, raw) {
                        Some(value) => message.$field = value,
                        //= D-19
                        None => return Err(DecodeError::refused(DEF, signal, raw)),
                    }
                })+
                Ok(message)
            }

            #[inline]
            fn encode(message: &$message) -> $crate::messages::Frame {
                use $crate::messages::{Frame, Layout, MessageDef, bits, layout::raw_of};

                const DEF: &MessageDef = <$edition as Layout<$message>>::DEF;

                #[expect(non_camel_case_types, reason = "they are the fields' names")]
                enum Place {
                    $($field),+
                }

                //= D-30, D-34
                let word = 0 $(| bits::place(
                    raw_of(const { &DEF.signals[Place::$field as usize] }, message.$field),
                    $start,
                    $width,
                ))+;
                Frame { id: $message::ID, len: $len, data: word.to_le_bytes() }
            }

            fn holds(message: &$message) -> bool {
                use $crate::messages::{Layout, SignalValue};

                let rows = <$edition as Layout<$message>>::DEF.signals;
                let raw = [$(SignalValue::to_raw(message.$field)),+];
                #[allow(clippy::needless_update, reason = "a table may leave fields out")]
                let carried = $message { $($field: message.$field,)+ ..$message::default() };
                // By index: for a proof that is less than iterators over both.
                let mut place = 0;
                while place < raw.len() && rows[place].allows(raw[place]) {
                    place += 1;
                }
                place == raw.len() && carried == *message
            }
        }
    )+};
}

pub(crate) use layouts;

#[cfg(test)]
mod tests {
    use super::{raw_of, row_of, value_of};
    use crate::messages::{Ai2VcuSteer, FieldDef, SteerAngle};

    /// What carries a row.
    const STEER: &FieldDef = &FieldDef::new("steer", "What it says.", &["MSG-24"]);

    #[test]
    fn a_row_is_of_the_type_of_its_field() {
        let row = row_of(|message: &Ai2VcuSteer| message.steer_request, "ANGLE", 0, 16, STEER);
        assert_eq!((row.min, row.max, row.signed), (SteerAngle::MIN.raw(), SteerAngle::MAX.raw(), true));
        assert_eq!((row.field, row.doc, row.requirements), ("steer", "What it says.", STEER.requirements));
    }

    #[test]
    fn a_value_stays_in_the_range_of_its_row() {
        let row =
            row_of(|message: &Ai2VcuSteer| message.steer_request, "ANGLE", 0, 16, STEER).within(-20, 10);
        let read = |raw| value_of::<SteerAngle>(&row, raw).map(SteerAngle::raw);
        assert_eq!([-21, -20, 10, 11].map(read), [None, Some(-20), Some(10), None]);
        let written = |raw| raw_of(&row, SteerAngle::clamped(raw));
        assert_eq!([-300, -21, -20, 10, 11, 300].map(written), [-20, -20, -20, 10, 10, 10]);
    }
}
