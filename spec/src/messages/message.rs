//! From a row of the table to a type: the macro that reads the tables of `ai.rs`, `vcu.rs` and `log.rs`.

use super::{DecodeError, Frame, MessageDef};

/// A message of section 2 as a type of its own.
///
/// Its fields can only hold what the document allows, so whatever can be written down can be sent:
/// `decode(encode(m)) == m`.
pub trait Message: Copy + Default {
    /// The message's row in the table, with its signals.
    const DEF: &'static MessageDef;

    /// Reads the data of a frame.
    ///
    /// Data may be longer or shorter than the CAN database says, as long as every signal is there; bits
    /// that no signal uses are ignored.
    ///
    /// Errors: [`DecodeError::TooShort`] if a signal is not there, [`DecodeError::Value`] if one has a
    /// value outside its range or its enumeration.
    fn decode(data: &[u8]) -> Result<Self, DecodeError>;

    /// The frame that carries this message, as long as the CAN database says; bits that no signal uses
    /// are zero.
    fn encode(&self) -> Frame;
}

/// Reads a table of messages. A message is
///
/// ```text
/// /// What it is for.
/// StructName = "NAME" identifier, sender, length bytes, section "2.x" {
///     /// What it says.
///     field: Type = "SIGNAL" start|width;
///     /// What it says.
///     flag: bool = "SIGNAL" start|width ["NAME OF 0", "NAME OF 1"];
/// }
/// ```
///
/// and becomes the struct, its [`MessageDef`] and its codec. The first line of each doc comment is the
/// `doc` of its row.
macro_rules! messages {
    ($(
        #[doc = $doc:literal]
        $(#[doc = $more:literal])*
        $message:ident = $name:literal $id:literal, $sender:ident, $len:literal bytes, section $section:literal {
            $(
                #[doc = $signal_doc:literal]
                $(#[doc = $signal_more:literal])*
                $field:ident: $ty:ty = $signal:literal $start:literal|$width:literal
                    $([$off:literal, $on:literal])?;
            )+
        }
    )+) => {
        /// How many messages this table has.
        pub(super) const COUNT: usize = [$($name),+].len();

        $(
            #[doc = $doc]
            $(#[doc = $more])*
            #[doc = ""]
            #[doc = concat!("Message `", $name, "`, identifier `", stringify!($id), "`, section ", $section, ".")]
            #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
            #[cfg_attr(kani, derive(kani::Arbitrary))]
            #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
            #[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
            pub struct $message {
                $(
                    #[doc = $signal_doc]
                    $(#[doc = $signal_more])*
                    #[doc = ""]
                    #[doc = concat!("Signal `", $signal, "`, `", $start, "|", $width, "`.")]
                    pub $field: $ty,
                )+
            }

            impl $message {
                /// The CAN identifier.
                pub const ID: u16 = $id;
            }

            impl $crate::messages::Message for $message {
                const DEF: &'static $crate::messages::MessageDef = &$crate::messages::MessageDef {
                    name: $name,
                    id: $id,
                    sender: $crate::messages::Node::$sender,
                    len: $len,
                    section: $section,
                    signals: &[$(
                        $crate::messages::SignalDef::of::<$ty>($signal, $start, $width, $signal_doc)
                            $(.with_flag_names(&[(0, $off), (1, $on)]))?
                    ),+],
                    doc: $doc,
                }
                .checked();

                #[inline]
                fn decode(data: &[u8]) -> Result<Self, $crate::messages::DecodeError> {
                    use $crate::messages::{DecodeError, SignalValue, bits};

                    const NEEDED: usize = $message::DEF.bytes_needed();

                    /// The place of each field's signal in the row.
                    #[expect(non_camel_case_types, reason = "they are the fields' names")]
                    enum Place {
                        $($field),+
                    }

                    //= D-33
                    let Some(word) = bits::load::<NEEDED>(data) else {
                        return Err(DecodeError::too_short(Self::DEF, data.len()));
                    };
                    Ok(Self {
                        $($field: {
                            //= D-30
                            let raw = bits::extract(word, $start, $width, <$ty as SignalValue>::SIGNED);
                            let Some(value) = <$ty as SignalValue>::from_raw(raw) else {
                                let signal = const { &$message::DEF.signals[Place::$field as usize] };
                                //= D-19
                                return Err(DecodeError::refused(Self::DEF, signal, raw));
                            };
                            value
                        },)+
                    })
                }

                #[inline]
                fn encode(&self) -> $crate::messages::Frame {
                    use $crate::messages::{Frame, SignalValue, bits};

                    //= D-30, D-34
                    let word = 0 $(| bits::place(SignalValue::to_raw(self.$field), $start, $width))+;
                    Frame { id: $id, len: $len, data: word.to_le_bytes() }
                }
            }

            #[cfg(feature = "arbitrary")]
            impl<'a> arbitrary::Arbitrary<'a> for $message {
                fn arbitrary(u: &mut arbitrary::Unstructured<'a>) -> arbitrary::Result<Self> {
                    Ok(Self { $($field: u.arbitrary()?),+ })
                }
            }

            #[cfg(feature = "proptest")]
            impl proptest::arbitrary::Arbitrary for $message {
                type Parameters = ();
                type Strategy = proptest::strategy::BoxedStrategy<Self>;

                fn arbitrary_with((): ()) -> Self::Strategy {
                    use proptest::prelude::{Just, Strategy, any};
                    // One field after the other, because tuples of strategies end at twelve.
                    let message = Just(Self::default()).boxed();
                    $(
                        let message = (message, any::<$ty>())
                            .prop_map(|(mut message, $field)| {
                                message.$field = $field;
                                message
                            })
                            .boxed();
                    )+
                    message
                }
            }
        )+
    };
}

pub(super) use messages;
