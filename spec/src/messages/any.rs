//! Any of the messages, as one type.

use super::{
    Ai2LogDynamics2, Ai2VcuBrake, Ai2VcuDriveF, Ai2VcuDriveR, Ai2VcuStatus, Ai2VcuSteer, Node, Vcu2AiBrake,
    Vcu2AiDriveF, Vcu2AiDriveR, Vcu2AiStatus, Vcu2AiSteer, Vcu2AiWheelCounts, Vcu2AiWheelSpeeds,
    Vcu2LogDynamics1, Vcu2LogStatus, VcuStatus,
};

macro_rules! any_message {
    ($($message:ident),+ $(,)?) => {
        /// A message of any edition, whichever it is.
        ///
        /// [`Bus::decode`](crate::Bus::decode) makes one of a frame, and [`Bus::encode`](crate::Bus::encode)
        /// a frame of one.
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
            /// The identifiers of all messages, ascending.
            pub const IDS: [u16; [$($message::ID),+].len()] = [$($message::ID),+];

            /// The CAN identifier.
            pub const fn id(&self) -> u16 {
                match self {
                    $(Self::$message(_) => $message::ID,)+
                }
            }

            /// Who sends it.
            pub const fn sender(&self) -> Node {
                match self {
                    $(Self::$message(_) => $message::SENDER,)+
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
    VcuStatus,
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
