//! The identifiers that the AI Computer must not use, against the list of section 2.3.

use adsdv_spec::messages::Node;
use adsdv_spec::{Bus, Edition};

const BUS: Bus = Edition::V3_0.bus;

/// Section 2.3, as it lists them: first and last, in hexadecimal.
const LISTED: [(u16, u16); 17] = [
    (0x000, 0x000), //= ID-1
    (0x080, 0x084), //= ID-2
    (0x100, 0x100), //= ID-3
    (0x120, 0x124), //= ID-4
    (0x181, 0x184), //= ID-5
    (0x201, 0x201), //= ID-6
    (0x284, 0x284), //= ID-7
    (0x301, 0x301), //= ID-8
    (0x410, 0x41F), //= ID-9
    (0x450, 0x470), //= ID-10
    (0x4E2, 0x4E2), //= ID-11
    (0x4FD, 0x4FF), //= ID-12
    (0x550, 0x550), //= ID-13
    (0x581, 0x584), //= ID-14
    (0x601, 0x601), //= ID-15
    (0x604, 0x604), //= ID-16
    (0x700, 0x705), //= ID-17
];

#[test]
fn exactly_the_identifiers_of_the_list_are_reserved() {
    for id in 0..=u16::MAX {
        let listed = LISTED.iter().any(|&(first, last)| first <= id && id <= last);
        assert_eq!(BUS.is_reserved(id), listed, "{id:03X}h");
        assert!(!listed || !BUS.may_send(Node::Ai, id), "{id:03X}h is not for the AI Computer");
    }
}

#[test]
fn no_message_of_the_document_has_a_reserved_identifier() {
    for message in BUS.messages {
        assert!(!BUS.is_reserved(message.id), "{}", message.name);
        assert!(BUS.may_send(message.sender, message.id), "{}", message.name);
    }
}
