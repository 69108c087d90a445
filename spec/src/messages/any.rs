//! All messages at once: the whole table, and a frame of any of them.

use super::{
    Ai2LogDynamics2, Ai2VcuBrake, Ai2VcuDriveF, Ai2VcuDriveR, Ai2VcuStatus, Ai2VcuSteer, DecodeError, Frame,
    Message, MessageDef, Vcu2AiBrake, Vcu2AiDriveF, Vcu2AiDriveR, Vcu2AiStatus, Vcu2AiSteer,
    Vcu2AiWheelCounts, Vcu2AiWheelSpeeds, Vcu2LogDynamics1, Vcu2LogStatus, ai, log, vcu,
};

macro_rules! any_message {
    ($($message:ident),+ $(,)?) => {
        /// Every message of section 2, by ascending identifier.
        pub static MESSAGES: [&MessageDef; ai::COUNT + vcu::COUNT + log::COUNT] = [$($message::DEF),+];

        /// The message with this identifier.
        ///
        /// ```
        /// use adsdv_spec::messages::message_by_id;
        ///
        /// assert_eq!(message_by_id(0x520).map(|message| message.name), Some("VCU2AI_Status"));
        /// assert_eq!(message_by_id(0x527), None);
        /// ```
        pub const fn message_by_id(id: u16) -> Option<&'static MessageDef> {
            match id {
                $($message::ID => Some($message::DEF),)+
                _ => None,
            }
        }

        /// A message of section 2, whichever it is.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        #[cfg_attr(kani, derive(kani::Arbitrary))]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        pub enum AnyMessage {
            $(
                #[doc = concat!("A [`", stringify!($message), "`].")]
                $message($message),
            )+
        }

        impl AnyMessage {
            /// Reads the data of a frame with this identifier; see [`Message::decode`].
            #[inline]
            pub fn decode(id: u16, data: &[u8]) -> Result<Self, DecodeError> {
                $(
                    if id == $message::ID {
                        return $message::decode(data).map(Self::$message);
                    }
                )+
                Err(DecodeError::UnknownId { id })
            }

            /// The frame of this message; see [`Message::encode`].
            #[inline]
            pub fn encode(&self) -> Frame {
                match self {
                    $(Self::$message(message) => message.encode(),)+
                }
            }

            /// The message's row.
            pub const fn def(&self) -> &'static MessageDef {
                match self {
                    $(Self::$message(_) => $message::DEF,)+
                }
            }
        }

        $(
            impl From<$message> for AnyMessage {
                fn from(message: $message) -> Self {
                    Self::$message(message)
                }
            }
        )+

        #[cfg(feature = "arbitrary")]
        impl<'a> arbitrary::Arbitrary<'a> for AnyMessage {
            fn arbitrary(u: &mut arbitrary::Unstructured<'a>) -> arbitrary::Result<Self> {
                type Make<'a> = fn(&mut arbitrary::Unstructured<'a>) -> arbitrary::Result<AnyMessage>;
                let all: &[Make<'a>] = &[$(|u| u.arbitrary().map(Self::$message)),+];
                u.choose(all)?(u)
            }
        }

        #[cfg(feature = "proptest")]
        impl proptest::arbitrary::Arbitrary for AnyMessage {
            type Parameters = ();
            type Strategy = proptest::strategy::BoxedStrategy<Self>;

            fn arbitrary_with((): ()) -> Self::Strategy {
                use proptest::prelude::{Strategy, any};
                proptest::strategy::Union::new([$(any::<$message>().prop_map(Self::from).boxed()),+]).boxed()
            }
        }
    };
}

any_message! {
    Vcu2LogDynamics1,
    Ai2LogDynamics2,
    Vcu2LogStatus,
    Ai2VcuStatus,
    Ai2VcuDriveF,
    Ai2VcuDriveR,
    Ai2VcuSteer,
    Ai2VcuBrake,
    Vcu2AiStatus,
    Vcu2AiDriveF,
    Vcu2AiDriveR,
    Vcu2AiSteer,
    Vcu2AiBrake,
    Vcu2AiWheelSpeeds,
    Vcu2AiWheelCounts,
}

#[cfg(test)]
mod tests {
    use super::AnyMessage;
    use crate::messages::DecodeError;

    #[test]
    fn what_is_no_message_is_refused() {
        assert_eq!(AnyMessage::decode(0x7FF, &[0; 8]), Err(DecodeError::UnknownId { id: 0x7FF }));
    }
}
