//! What a message says, apart from how it is laid out on the bus: the macro that reads the lists of `ai.rs`, `vcu.rs` and
//! `log.rs`.

use super::{AnyMessage, Node};

/// The content of a message, the same in all editions.
///
/// Where the bits are is the business of an edition's [`Layout`](super::Layout) of it. What an edition's layout does not
/// have is left at its default when it is read, and does not go on the bus.
pub trait Message: Copy + Default + Into<AnyMessage> {
    /// The CAN identifier, by which a message is the same message in all editions.
    const ID: u16;
    /// Who sends it.
    const SENDER: Node;
    /// What asks for the message itself: the numbers of `REQUIREMENTS.md`, those of all editions; see
    /// [`MessageDef::requirements`](super::MessageDef::requirements).
    const REQUIREMENTS: &'static [&'static str];
    /// The fields.
    const FIELDS: &'static [FieldDef];

    /// The message itself, if it is one of this kind.
    fn of(message: AnyMessage) -> Option<Self>;
}

/// A field of a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct FieldDef {
    /// The name.
    pub name: &'static str,
    /// What it says, in one sentence.
    pub doc: &'static str,
    /// What asks for its values: the numbers of `REQUIREMENTS.md`, those of all editions; see
    /// [`SignalDef::requirements`](super::SignalDef::requirements).
    pub requirements: &'static [&'static str],
}

impl FieldDef {
    /// A field of this name, with what it says, and what asks for its values.
    pub(crate) const fn new(
        name: &'static str,
        doc: &'static str,
        requirements: &'static [&'static str],
    ) -> Self {
        Self { name, doc, requirements }
    }
}

/// The field of that name. One that is not there does not compile.
pub(crate) const fn field_of(fields: &'static [FieldDef], name: &'static str) -> &'static FieldDef {
    let mut i = 0;
    while !same(fields[i].name.as_bytes(), name.as_bytes()) {
        i += 1;
    }
    &fields[i]
}

/// Whether two names are the same.
pub(crate) const fn same(one: &[u8], other: &[u8]) -> bool {
    let mut i = 0;
    while i < one.len() && i < other.len() && one[i] == other[i] {
        i += 1;
    }
    i == one.len() && i == other.len()
}

/// Reads a list of messages. A message is
///
/// ```text
/// /// What it is for.
/// StructName identifier from sender, cites ["MSG-1"] {
///     /// What it says.
///     field: Type, cites ["MSG-2"];
/// }
/// ```
///
/// and becomes the struct. What is cited asks for the message, and for the values of the field, in any edition. The first line of each doc comment is what CAN databases say of it.
macro_rules! contents {
    ($(
        #[doc = $doc:literal]
        $(#[doc = $more:literal])*
        $message:ident $id:literal from $sender:ident, cites [$($cited:literal),+] {
            $(
                #[doc = $field_doc:literal]
                $(#[doc = $field_more:literal])*
                $field:ident: $ty:ty, cites [$($field_cited:literal),+];
            )+
        }
    )+) => {$(
        #[doc = $doc]
        $(#[doc = $more])*
        #[doc = ""]
        #[doc = concat!("The message with the identifier `", stringify!($id), "`.")]
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
        #[cfg_attr(kani, derive(kani::Arbitrary))]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        #[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
        pub struct $message {
            $(
                #[doc = $field_doc]
                $(#[doc = $field_more])*
                pub $field: $ty,
            )+
        }

        impl $message {
            /// The CAN identifier.
            pub const ID: u16 = $id;
            /// Who sends it.
            pub(crate) const SENDER: $crate::messages::Node = $crate::messages::Node::$sender;
            /// What it is for, in one sentence.
            pub(crate) const DOC: &'static str = $doc.trim_ascii();
        }

        impl $crate::messages::Message for $message {
            const ID: u16 = Self::ID;
            const SENDER: $crate::messages::Node = Self::SENDER;
            const REQUIREMENTS: &'static [&'static str] = &[$($cited),+];
            const FIELDS: &'static [$crate::messages::FieldDef] = &[$(
                $crate::messages::FieldDef::new(
                    stringify!($field),
                    $field_doc.trim_ascii(),
                    &[$($field_cited),+],
                )
            ),+];

            fn of(message: $crate::messages::AnyMessage) -> Option<Self> {
                match message {
                    $crate::messages::AnyMessage::$message(message) => Some(message),
                    _ => None,
                }
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
    )+};
}

pub(super) use contents;

#[cfg(test)]
mod tests {
    use super::{FieldDef, field_of, same};

    const fn field(name: &'static str) -> FieldDef {
        FieldDef::new(name, "What it says.", &[])
    }

    #[test]
    fn a_field_is_found_by_its_whole_name() {
        const FIELDS: &[FieldDef] = &[field("one"), field("two"), field("twofold")];
        assert!(FIELDS.iter().all(|field| field_of(FIELDS, field.name) == field));
        assert_eq!(field_of(FIELDS, "two"), &FieldDef::new("two", "What it says.", &[]));
    }

    #[test]
    #[should_panic(expected = "out of bounds")]
    fn a_field_that_is_not_there_does_not_compile() {
        const FIELDS: &[FieldDef] = &[field("one")];
        let _ = field_of(FIELDS, "two");
    }

    #[test]
    fn names_are_the_same_to_the_last_letter() {
        for (one, other) in [("", "a"), ("a", ""), ("a", "b"), ("ab", "a"), ("a", "ab")] {
            assert!(!same(one.as_bytes(), other.as_bytes()), "{one} {other}");
        }
        assert!(same(b"", b"") && same(b"ab", b"ab"));
    }
}
