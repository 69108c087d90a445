//! The messages of section 2: what is on the bus, bit by bit.
//!
//! Every message stands once, with every signal in it, in one of three tables: what the AI Computer
//! sends (`ai.rs`, section 2.1), what the VCU sends (`vcu.rs`, section 2.2), and what both send for the
//! data logger alone (`log.rs`). From these tables come
//!
//! - a struct for each message, whose fields cannot hold a value the document does not allow, with
//!   [`Message::decode`] and [`Message::encode`];
//! - a [`MessageDef`] for each message and a [`SignalDef`] for each signal, which say the same as data:
//!   [`MESSAGES`] is the whole table, for exports, documentation, and the lenient reading of a frame
//!   that the strict codec refuses.
//!
//! What a signal's numbers mean follows from the type of its field, and stands there once: an
//! enumeration (`enums.rs`) names its values, a quantity (`quantity.rs`) has a unit, a step and a range.
//!
//! The bit layout, the lengths and the names are those of the CAN database; where the document's text
//! says otherwise about a range, a sign or a value's name, the text is followed and the row says so.
//!
//! ```
//! use adsdv_spec::messages::{AnyMessage, Ai2VcuSteer, Message, SteerAngle};
//!
//! let request = Ai2VcuSteer { steer_request: SteerAngle::from_deg(-10.0)? };
//! let frame = request.encode();
//! assert_eq!(frame.to_string(), "513#9CFF000000000000");
//! assert_eq!(Ai2VcuSteer::decode(frame.data()), Ok(request));
//! assert_eq!(AnyMessage::decode(frame.id, frame.data()), Ok(request.into()));
//!
//! // The shortest frame that holds every signal is enough; a value out of range is an error.
//! assert_eq!(Ai2VcuSteer::decode(&[0x9C, 0xFF]), Ok(request));
//! assert_eq!(
//!     Ai2VcuSteer::decode(&[0xF1, 0x00]).unwrap_err().to_string(),
//!     "AI2VCU_Steer (513h): STEER_REQUEST_deg is 24.1 deg (raw 241), allowed: -24 to 24 deg (raw -240 to 240)",
//! );
//! # Ok::<(), adsdv_spec::messages::QuantityError>(())
//! ```

mod ai;
mod any;
mod bits;
mod definition;
mod enums;
mod error;
mod frame;
mod log;
mod message;
mod quantity;
mod scale;
mod value;
mod vcu;

pub use ai::*;
pub use any::{AnyMessage, MESSAGES, message_by_id};
pub use definition::{DisplayRaw, MessageDef, Node, SignalDef};
pub use enums::*;
pub use error::{DecodeError, OutOfRange, ValueError};
pub use frame::Frame;
pub use log::*;
pub use message::Message;
pub use quantity::*;
pub use scale::{Decimal, Scale};
pub use value::SignalValue;
pub use vcu::*;
