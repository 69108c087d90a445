//! The messages of section 2: what is on the bus, bit by bit.
//!
//! Every message stands once as what it says, in one of three lists: what the AI Computer sends (`ai.rs`, section 2.1), what
//! the VCU sends (`vcu.rs`, section 2.2), and what both send for the data logger alone (`log.rs`). This is the same in all
//! editions: the struct of a message has what any of them knows.
//!
//! How an edition lays a message out stands in the edition's folder (`editions`), in a table for each: names, bits, ranges,
//! lengths and cycles. From these tables come
//!
//! - the edition's [`Layout`] of each message, which reads it from a frame, strictly, and writes it;
//! - a [`MessageDef`] for each message and a [`SignalDef`] for each signal, which say the same as data:
//!   [`Bus::messages`](crate::Bus::messages) is the whole table, for exports, documentation, and the lenient reading of a
//!   frame that the strict codec refuses.
//!
//! What a signal's numbers mean follows from the type of its field, and stands there once: an
//! enumeration (`enums.rs`) names its values, a quantity (`quantity.rs`) has a unit, a step and a range. Where an edition
//! spells the names of an enumeration in its own way, its row has them.
//!
//! Where an edition's database has messages that only the VCU and its devices exchange, they stand in rows of their own
//! (`device.rs`), without a struct. What they have in common with the others is a [`MessageRow`], for who decodes all of a bus.
//!
//! The bit layout, the lengths and the names are those of the CAN database; where the document's text
//! says otherwise about a range, a sign or a value's name, the text is followed and the row says so.
//!
//! ```
//! use adsdv_spec::Edition;
//! use adsdv_spec::messages::{Ai2VcuSteer, SteerAngle};
//!
//! let bus = Edition::V3_0.bus;
//! let request = Ai2VcuSteer { steer_request: SteerAngle::from_deg(-10.0)? };
//! let frame = bus.encode(request).expect("every edition has 513h");
//! assert_eq!(frame.to_string(), "513#9CFF000000000000");
//! assert_eq!(bus.decode(frame.id, frame.data()), Ok(request.into()));
//!
//! // The shortest frame that holds every signal is enough; a value out of range is an error.
//! assert_eq!(bus.decode_as(&[0x9C, 0xFF]), Ok(request));
//! assert_eq!(
//!     bus.decode(0x513, &[0xF1, 0x00]).unwrap_err().to_string(),
//!     "AI2VCU_Steer (513h): STEER_REQUEST_deg is 24.1 deg (raw 241), allowed: -24 to 24 deg (raw -240 to 240)",
//! );
//! # Ok::<(), adsdv_spec::messages::QuantityError>(())
//! ```

mod ai;
mod any;
pub(crate) mod bits;
pub(crate) mod content;
mod definition;
pub(crate) mod device;
mod enums;
mod error;
mod frame;
pub(crate) mod layout;
mod log;
mod node;
mod quantity;
mod row;
mod scale;
mod value;
mod vcu;

pub use ai::*;
pub use any::AnyMessage;
pub use content::{FieldDef, Message};
pub use definition::{DisplayRaw, MessageDef, ReadAs, SignalDef};
pub use device::{Coding, Device, DeviceMessage, DeviceSignal};
pub use enums::*;
pub use error::{DecodeError, OutOfRange, ValueError};
pub use frame::Frame;
pub use layout::Layout;
pub use log::*;
pub use node::Node;
pub use quantity::*;
pub use row::{MessageRow, SignalRow, Steps};
pub use scale::{Decimal, Scale};
pub use value::SignalValue;
pub use vcu::*;
