//! The table itself: every message once, every signal in its place.

use super::*;

#[test]
fn every_message_stands_once_by_ascending_identifier() {
    let ids: Vec<u16> = BUS.messages.iter().map(|message| message.id).collect();
    let expected: Vec<u16> = (0x500..=0x502).chain(0x510..=0x514).chain(0x520..=0x526).collect();
    assert_eq!(ids, expected);
    for bus in buses() {
        let messages = bus.messages;
        assert!(messages.windows(2).all(|two| two[0].id < two[1].id), "{bus:?}");
        for (index, message) in messages.iter().enumerate() {
            assert!(
                messages[..index].iter().all(|other| other.name != message.name),
                "{} twice",
                message.name
            );
            assert_eq!(bus.named(message.name), Some(*message));
        }
        assert_eq!(bus.named("NO_SUCH_MESSAGE"), None);
    }
}

#[test]
fn an_identifier_finds_its_message_and_no_other() {
    for bus in buses() {
        for id in 0..=u16::MAX {
            let found = bus.message(id);
            assert_eq!(found, bus.messages.iter().copied().find(|message| message.id == id), "{id:03X}h");
            if found.is_none() {
                assert_eq!(bus.decode(id, &[0; 8]), Err(DecodeError::UnknownId { id }));
            }
        }
    }
}

#[test]
fn the_sender_is_in_the_name() {
    for (_, message) in messages() {
        let sender = if message.name.starts_with("AI2") { Node::Ai } else { Node::Vcu };
        let section = if sender == Node::Ai { "2.1" } else { "2.2" };
        assert_eq!((message.sender, message.section), (sender, section), "{}", message.name);
        assert!(message.name.starts_with(&sender.to_string()), "{}", message.name);
        assert!(!message.doc.is_empty() && message.doc.trim() == message.doc, "{}", message.name);
    }
}

#[test]
fn no_two_signals_of_a_message_share_a_bit_or_a_name() {
    for (_, message) in messages() {
        let mut bits = used_bits(message);
        assert!(bits.iter().all(|&bit| bit < message.len * 8), "{}: a signal ends after it", message.name);
        let count = bits.len();
        bits.sort_unstable();
        bits.dedup();
        assert_eq!(bits.len(), count, "{}", message.name);
        for (index, signal) in message.signals.iter().enumerate() {
            assert!(
                message.signals[..index].iter().all(|other| other.name != signal.name),
                "{}",
                signal.name
            );
            assert_eq!(message.signal(signal.name), Some(signal));
        }
        assert_eq!(message.signal("NO_SUCH_SIGNAL"), None);
    }
}

#[test]
fn every_row_is_well_formed() {
    for signal in messages().flat_map(|(_, message)| message.signals) {
        let name = signal.name;
        assert!(signal.min < signal.max, "{name}");
        assert_eq!(signal.signed, signal.min < 0, "{name}");
        assert!(signal.values.windows(2).all(|pair| pair[0].0 < pair[1].0), "{name}: names out of order");
        assert!(signal.values.iter().all(|(_, text)| !text.is_empty()), "{name}");
        if let (Some(first), Some(last)) = (signal.values.first(), signal.values.last()) {
            assert_eq!((first.0, last.0), (signal.min, signal.max), "{name}: the range of an enumeration");
        }
        assert!(!signal.doc.is_empty() && signal.doc.trim() == signal.doc, "{name}");
        for raw in [signal.min, signal.max] {
            assert_eq!(signal.check(raw), Ok(()), "{name}");
        }
        for given in [signal.min - 1, signal.max + 1, i32::MIN, i32::MAX] {
            let refused = signal.check(given).expect_err(name);
            assert_eq!((refused.given, refused.def), (given, signal));
        }
    }
}

//= D-30
#[test]
fn lengths_are_those_of_the_database() {
    for message in BUS.messages {
        let len = match message.id {
            0x501 => 6,
            0x502 => 5,
            _ => 8,
        };
        assert_eq!(message.len, len, "{}", message.name);
    }
}

#[test]
fn the_bytes_needed_end_with_the_last_signal() {
    for (_, message) in messages() {
        let last = used_bits(message).into_iter().max().expect("every message has signals");
        assert_eq!(message.bytes_needed(), usize::from(last / 8) + 1, "{}", message.name);
        for signal in message.signals {
            let needed = signal.bytes_needed();
            assert_eq!(needed, usize::from((signal.start + signal.width - 1) / 8) + 1, "{}", signal.name);
            assert_eq!(signal.raw(&[0; 64][..needed - 1]), None, "{}", signal.name);
            assert_eq!(signal.raw(&[0; 64][..needed]), Some(0), "{}", signal.name);
        }
    }
}

#[test]
fn between_two_values_that_have_names_none_is_allowed() {
    let mut gap = *<V3_0 as Layout<Vcu2AiSteer>>::DEF.signals.first().expect("a signal of 523h");
    (gap.min, gap.max, gap.values) = (0, 2, &[(0, "ZERO"), (2, "TWO")]);
    assert_eq!([-1, 0, 1, 2, 3].map(|raw| gap.allows(raw)), [false, true, false, true, false]);
    assert_eq!([0, 1, 2].map(|raw| gap.display(raw).to_string()), ["ZERO", "0.1 deg", "TWO"]);
}

/// Fields are public, so that a row can be changed; what is changed for nonsense reads nothing and writes nothing.
#[test]
fn a_signal_that_lies_in_no_frame_is_not_there() {
    let mut changed = *<V3_0 as Layout<Vcu2AiSteer>>::DEF.signals.first().expect("a signal of 523h");
    let ones = [0xFF; 8];
    for (start, width, there) in [
        (56, 8, true),
        (57, 8, false),
        (32, 32, true),
        (33, 32, false),
        (0, 33, false),
        (0, 0, false),
        (63, 1, true),
        (64, 1, false),
        (255, 255, false),
    ] {
        (changed.start, changed.width, changed.signed) = (start, width, true);
        assert_eq!(changed.raw(&[0xFF; 64]), there.then_some(-1), "bit {start}, {width} bits");
        assert_eq!(changed.put(ones, 0) != ones, there, "bit {start}, {width} bits");
    }
}
