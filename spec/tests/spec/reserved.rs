//! The identifiers that the AI Computer must not use, against the list of section 2.3.

use adsdv_spec::Edition;
use adsdv_spec::messages::Node;

/// A list of identifiers: first and last, in hexadecimal.
type List = &'static [(u16, u16)];

/// Each edition with section 2.3 as it lists them.
static EDITIONS: [(Edition, List); 3] = [
    (Edition::V3_0, LISTED_3_0),
    (Edition::V4_0, LISTED_4_0),
    (Edition::V2026, LISTED_4_0), // the database has no list, and 4.0 stays valid
];

const LISTED_3_0: List = &[
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

const LISTED_4_0: List = &[
    (0x000, 0x000), //= ID-1
    (0x080, 0x084), //= ID-2
    (0x120, 0x124), //= ID-4
    (0x181, 0x184), //= ID-5
    (0x284, 0x284), //= ID-7
    (0x301, 0x301), //= ID-8
    (0x410, 0x41F), //= ID-9
    (0x450, 0x470), //= ID-10
    (0x4E2, 0x4E2), //= ID-11
    (0x4FD, 0x4FF), //= ID-12
    (0x550, 0x550), //= ID-13
    (0x581, 0x584), //= ID-14
    (0x600, 0x640), //= ID-18
    (0x650, 0x660), //= ID-19
    (0x700, 0x705), //= ID-17
];

#[test]
fn each_edition_has_its_list() {
    let versions: Vec<_> = Edition::ALL.iter().map(|edition| edition.version).collect();
    let listed = EDITIONS.each_ref().map(|(edition, _)| edition.version);
    assert_eq!(listed.as_slice(), versions, "`EDITIONS` of this file needs a line for each, in this order");
}

#[test]
fn exactly_the_identifiers_of_the_list_are_reserved() {
    for (Edition { bus, .. }, list) in &EDITIONS {
        for id in 0..=u16::MAX {
            let listed = list.iter().any(|&(first, last)| first <= id && id <= last);
            assert_eq!(bus.is_reserved(id), listed, "{id:03X}h of {bus:?}");
            assert!(!listed || !bus.may_send(Node::Ai, id), "{id:03X}h is not for the AI Computer");
        }
    }
}

#[test]
fn version_4_0_reserves_more_identifiers_in_fewer_ranges() {
    let count = |list: List| list.iter().map(|(first, last)| last - first + 1).sum::<u16>();
    assert_eq!((LISTED_3_0.len(), count(LISTED_3_0)), (17, 85));
    assert_eq!((LISTED_4_0.len(), count(LISTED_4_0)), (15, 163));
}

/// What is reserved is so for the AI Computer: 120h is the VCU's.
#[test]
fn no_message_of_the_document_has_an_identifier_that_is_reserved_from_its_sender() {
    for (Edition { bus, .. }, _) in &EDITIONS {
        for message in bus.messages {
            assert_eq!(bus.is_reserved(message.id), message.id == 0x120, "{}", message.name);
            assert!(bus.may_send(message.sender, message.id), "{}", message.name);
        }
    }
}
