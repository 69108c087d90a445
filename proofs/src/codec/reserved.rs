//! The identifiers that are not the AI Computer's (section 2.3).
//!
//! The bound of the loops: the list has 17 entries.

use adsdv_spec::messages::Node;

use crate::prelude::*;

/// The list of section 2.3.
const fn section_2_3(id: u16) -> bool {
    matches!(
        id,
        0x000
            | 0x080..=0x084
            | 0x100
            | 0x120..=0x124
            | 0x181..=0x184
            | 0x201
            | 0x284
            | 0x301
            | 0x410..=0x41F
            | 0x450..=0x470
            | 0x4E2
            | 0x4FD..=0x4FF
            | 0x550
            | 0x581..=0x584
            | 0x601
            | 0x604
            | 0x700..=0x705
    )
}

/// **Reserved is what section 2.3 lists.** Of all identifiers these, and no others.
///
/// Requirements: ID-1 to ID-17.
#[cfg_attr(kani, kani::proof, kani::unwind(18))]
pub fn reserved_is_what_section_2_3_lists() {
    let id: u16 = kani::any();
    kani::cover!(section_2_3(id), "it is reserved");
    kani::cover!(!section_2_3(id) && id <= 0x7FF, "it is not");
    assert!(subject().is_reserved(id) == section_2_3(id), "as the list says");
}

/// **Who may send what.** The AI Computer its own messages, and what is neither the VCU's nor reserved; the VCU all but
/// the messages of the AI Computer.
///
/// Requirements: ID-1 to ID-17.
#[cfg_attr(kani, kani::proof, kani::unwind(18))]
pub fn who_may_send_what() {
    let (node, id): (Node, u16) = (kani::any(), kani::any());
    let may = match node {
        Node::Ai => !matches!(id, 0x500 | 0x502 | 0x520..=0x526) && !section_2_3(id),
        Node::Vcu => !matches!(id, 0x501 | 0x510..=0x514),
    };
    kani::cover!(may && id == 0x510, "a message of the AI Computer");
    kani::cover!(!may && section_2_3(id), "it is reserved");
    assert!(subject().may_send(node, id) == may, "as the document says");
}

theorems![; every reserved_is_what_section_2_3_lists, who_may_send_what];
