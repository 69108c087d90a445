//! The identifiers that the AI Computer must not use (section 2.3).

use core::ops::RangeInclusive;

/// The reserved identifiers, as ranges, ascending.
pub const RESERVED: [RangeInclusive<u16>; 17] = [
    0x000..=0x000,
    0x080..=0x084,
    0x100..=0x100,
    0x120..=0x124,
    0x181..=0x184,
    0x201..=0x201,
    0x284..=0x284,
    0x301..=0x301,
    0x410..=0x41F,
    0x450..=0x470,
    0x4E2..=0x4E2,
    0x4FD..=0x4FF,
    0x550..=0x550,
    0x581..=0x584,
    0x601..=0x601,
    0x604..=0x604,
    0x700..=0x705,
];

/// Whether the AI Computer must not send this identifier.
///
/// ```
/// use adsdv_spec::is_reserved;
/// assert!(is_reserved(0x470) && !is_reserved(0x471) && !is_reserved(0x510));
/// ```
pub const fn is_reserved(id: u16) -> bool {
    let mut i = 0;
    while i < RESERVED.len() {
        if id >= *RESERVED[i].start() && id <= *RESERVED[i].end() {
            return true;
        }
        i += 1;
    }
    false
}
