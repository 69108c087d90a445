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
    /// The fields, each with what it says in one sentence.
    const FIELDS: &'static [(&'static str, &'static str)];

    /// The message itself, if it is one of this kind.
    fn of(message: AnyMessage) -> Option<Self>;
}

/// What a field of a message says: the second of the pair of that name. A field that is not there does not compile.
pub(crate) const fn doc_of(
    fields: &'static [(&'static str, &'static str)],
    name: &'static str,
) -> &'static str {
    let mut i = 0;
    while !same(fields[i].0.as_bytes(), name.as_bytes()) {
        i += 1;
    }
    fields[i].1
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
/// StructName identifier from sender {
///     /// What it says.
///     field: Type;
/// }
/// ```
///
/// and becomes the struct. The first line of each doc comment is what CAN databases say of it.
macro_rules! contents {
    ($(
        #[doc = $doc:literal]
        $(#[doc = $more:literal])*
        $message:ident $id:literal from $sender:ident {
            $(
                #[doc = $field_doc:literal]
                $(#[doc = $field_more:literal])*
                $field:ident: $ty:ty;
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
            /// What it is for, in one sentence.
            pub(crate) const DOC: &'static str = $doc.trim_ascii();
        }

        impl $crate::messages::Message for $message {
            const ID: u16 = $id;
            const SENDER: $crate::messages::Node = $crate::messages::Node::$sender;
            const FIELDS: &'static [(&'static str, &'static str)] = &[$((stringify!($field), $field_doc.trim_ascii())),+];

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
    use super::{doc_of, same};

    #[test]
    fn a_field_has_its_own_words() {
        let fields = &[("one", "The first."), ("two", "The second."), ("twofold", "The third.")];
        assert_eq!(["one", "two", "twofold"].map(|name| doc_of(fields, name)), fields.map(|(_, doc)| doc));
    }

    #[test]
    #[should_panic(expected = "out of bounds")]
    fn a_field_that_is_not_there_does_not_compile() {
        let _ = doc_of(&[("one", "The first.")], "two");
    }

    #[test]
    fn names_are_the_same_to_the_last_letter() {
        for (one, other) in [("", "a"), ("a", ""), ("a", "b"), ("ab", "a"), ("a", "ab")] {
            assert!(!same(one.as_bytes(), other.as_bytes()), "{one} {other}");
        }
        assert!(same(b"", b"") && same(b"ab", b"ab"));
    }
}
