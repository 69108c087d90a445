//! The table of all signals, and the lenient reading that goes by it.
//!
//! The bounds of the loops: there are 15 messages, 520h has 23 signals and `SHUTDOWN_CAUSE` 11 names, no other message has
//! more than 9 and no other signal more than 8; 8 bytes are put together to a word, and section 2.3 lists 17 identifiers.

use adsdv_spec::messages::{
    Ai2LogDynamics2, Ai2VcuBrake, Ai2VcuDriveF, Ai2VcuDriveR, Ai2VcuStatus, Ai2VcuSteer, Frame, MessageDef,
    Node, SignalDef, Vcu2AiBrake, Vcu2AiDriveF, Vcu2AiDriveR, Vcu2AiStatus, Vcu2AiSteer, Vcu2AiWheelCounts,
    Vcu2AiWheelSpeeds, Vcu2LogDynamics1, Vcu2LogStatus,
};

use super::data::Data;
use crate::prelude::*;

/// Any number below this, to count with.
fn any_below(end: u8) -> usize {
    usize::from(kani::any_where(|place: &u8| *place < end))
}

/// A frame of a message with a signal set, as it is sent: a word, in which all other bits are those of `data`.
fn sent(message: &MessageDef, signal: &SignalDef, data: [u8; 8], raw: i32) -> u64 {
    let data = signal.put(data, raw);
    u64::from_le_bytes(subject().sent(Frame { id: message.id, len: message.len, data }).data)
}

/// **No two signals of a message share a bit.** Of each signal the frame with all of its bits set has as many set as the
/// signal has, and none that a signal before it has.
///
/// Requirements: D-30, D-34.
#[cfg_attr(kani, kani::proof, kani::unwind(24))]
pub fn no_two_signals_of_a_message_share_a_bit() {
    for message in Layouts::MESSAGES {
        let mut before = 0;
        for signal in message.signals {
            let bits = sent(message, signal, [0; 8], -1);
            kani::cover!(before != 0, "one more signal of the same message");
            assert!(bits & before == 0, "no bit in common");
            assert!(bits.count_ones() == signal.width.into(), "as many as the signal has");
            before |= bits;
        }
    }
}

/// **What is put into a signal is what it holds, and no other bit changes.** Whatever the other bits are, and whether the
/// value is allowed or not: it is read back, with its sign.
///
/// Requirements: D-30, D-34.
#[cfg_attr(kani, kani::proof, kani::unwind(24))]
pub fn what_is_put_into_a_signal_is_what_it_holds() {
    let data: [u8; 8] = kani::any();
    let any: i32 = kani::any();
    kani::cover!(any < 0 && u64::from_le_bytes(data) != 0, "a negative number, and something beside it");
    for message in Layouts::MESSAGES {
        for signal in message.signals {
            let raw = cut(any, signal.width, signal.signed);
            let word = sent(message, signal, data, raw);
            assert!(signal.raw(&word.to_le_bytes()) == Some(raw), "it is read back");
            let others = !((u64::MAX >> (64 - signal.width)) << signal.start);
            assert!(word & others == u64::from_le_bytes(data) & others, "every other bit is as it was");
        }
    }
}

/// As much of a number as so many bits hold; so any number makes any of a signal.
pub(super) const fn cut(any: i32, width: u8, signed: bool) -> i32 {
    let unused = 32 - width;
    if signed {
        any << unused >> unused
    } else if unused == 0 {
        any
    } else {
        any & !(-1 << width)
    }
}

/// The rows of a message say of any data what its decoder says. Of 520h, which has by far the most, that is two harnesses.
fn agrees<M: Coded + kani::Arbitrary>() {
    let data = Data::any::<M>();
    reads_what_is_allowed::<M>(&data);
    writes_what_is_read::<M>(&data);
}

fn reads_what_is_allowed<M: Coded>(data: &Data) {
    let read = M::decode(data.received(M::DEF.id).given()).is_ok();
    let mut allowed = true;
    for signal in M::DEF.signals {
        allowed &= signal.raw(data.given()).is_some_and(|raw| signal.allows(raw));
    }
    kani::cover!(allowed, "it is read");
    kani::cover!(!allowed, "it is refused");
    assert!(read == allowed, "read if and only if each row allows it");
}

fn writes_what_is_read<M: Coded>(data: &Data) {
    let Ok(message) = M::decode(data.received(M::DEF.id).given()) else { return };
    let frame = subject().sent(message.encode());
    kani::cover!(u64::from_le_bytes(frame.data) != 0, "something is in it");
    for signal in M::DEF.signals {
        assert!(signal.raw(frame.data()) == signal.raw(data.given()), "written with the same value");
    }
}

harnesses! {
    /// **The table allows what the decoder reads.** Data is read if and only if each signal's row finds it there and allows its value,
    /// and then it is written with these values.
    ///
    /// Requirements: D-19, D-30, D-31, D-33.
    unwind 24;
    the_table_agrees_with_the_decoder_on_500h = agrees::<Vcu2LogDynamics1>();
    the_table_agrees_with_the_decoder_on_501h = agrees::<Ai2LogDynamics2>();
    the_table_agrees_with_the_decoder_on_502h = agrees::<Vcu2LogStatus>();
    the_table_agrees_with_the_decoder_on_510h = agrees::<Ai2VcuStatus>();
    the_table_agrees_with_the_decoder_on_511h = agrees::<Ai2VcuDriveF>();
    the_table_agrees_with_the_decoder_on_512h = agrees::<Ai2VcuDriveR>();
    the_table_agrees_with_the_decoder_on_513h = agrees::<Ai2VcuSteer>();
    the_table_agrees_with_the_decoder_on_514h = agrees::<Ai2VcuBrake>();
    the_table_agrees_with_the_decoder_on_521h = agrees::<Vcu2AiDriveF>();
    the_table_agrees_with_the_decoder_on_522h = agrees::<Vcu2AiDriveR>();
    the_table_agrees_with_the_decoder_on_523h = agrees::<Vcu2AiSteer>();
    the_table_agrees_with_the_decoder_on_524h = agrees::<Vcu2AiBrake>();
    the_table_agrees_with_the_decoder_on_525h = agrees::<Vcu2AiWheelSpeeds>();
    the_table_agrees_with_the_decoder_on_526h = agrees::<Vcu2AiWheelCounts>();
    the_table_allows_what_is_read_of_520h = reads_what_is_allowed::<Vcu2AiStatus>(&Data::any::<Vcu2AiStatus>());
    what_is_read_of_520h_is_written_with_its_values = writes_what_is_read::<Vcu2AiStatus>(&Data::any::<Vcu2AiStatus>());
}

/// **An identifier is one message's, and its sender's alone.** No two messages have the same, none is reserved or longer
/// than 11 bits, and the node that sends it is the one that may.
///
/// Requirements: MSG-1, MSG-5, MSG-16, MSG-20, MSG-23, MSG-26, MSG-29, MSG-34, MSG-41, MSG-65, MSG-69, MSG-73, MSG-77,
/// MSG-80, MSG-82, ID-1 to ID-17.
#[cfg_attr(kani, kani::proof, kani::unwind(18))]
pub fn each_identifier_is_of_one_message() {
    let (one, other) = (any_below(15), any_below(15));
    kani::cover!(one == 14 && other == 0, "the last and the first");
    let id =
        |message: &MessageDef| subject().sent(Frame { id: message.id, len: message.len, data: [0; 8] }).id;
    assert!(
        (id(Layouts::MESSAGES[one]) == id(Layouts::MESSAGES[other])) == (one == other),
        "an identifier for each"
    );
    let (sender, receiver) = match Layouts::MESSAGES[one].sender {
        Node::Ai => (Node::Ai, Node::Vcu),
        Node::Vcu => (Node::Vcu, Node::Ai),
    };
    let id = id(Layouts::MESSAGES[one]);
    assert!(id <= 0x7FF, "11 bits");
    assert!(!subject().is_reserved(id), "not reserved");
    assert!(subject().may_send(sender, id) && !subject().may_send(receiver, id), "the sender's alone");
}

theorems![
    what_is_put_into_a_signal_is_what_it_holds,
    the_table_agrees_with_the_decoder_on_500h,
    the_table_agrees_with_the_decoder_on_501h,
    the_table_agrees_with_the_decoder_on_502h,
    the_table_agrees_with_the_decoder_on_510h,
    the_table_agrees_with_the_decoder_on_511h,
    the_table_agrees_with_the_decoder_on_512h,
    the_table_agrees_with_the_decoder_on_513h,
    the_table_agrees_with_the_decoder_on_514h,
    the_table_agrees_with_the_decoder_on_521h,
    the_table_agrees_with_the_decoder_on_522h,
    the_table_agrees_with_the_decoder_on_523h,
    the_table_agrees_with_the_decoder_on_524h,
    the_table_agrees_with_the_decoder_on_525h,
    the_table_agrees_with_the_decoder_on_526h,
    the_table_allows_what_is_read_of_520h,
    what_is_read_of_520h_is_written_with_its_values;
    every no_two_signals_of_a_message_share_a_bit, each_identifier_is_of_one_message,
];
