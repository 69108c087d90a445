//! The identifiers that the AI Computer must not use (section 2.3).

use core::ops::RangeInclusive;

/// The reserved identifiers, as ranges, ascending.
pub const RESERVED: [RangeInclusive<u16>; 17] = [
    0x000..=0x000, //= ID-1
    0x080..=0x084, //= ID-2
    0x100..=0x100, //= ID-3
    0x120..=0x124, //= ID-4
    0x181..=0x184, //= ID-5
    0x201..=0x201, //= ID-6
    0x284..=0x284, //= ID-7
    0x301..=0x301, //= ID-8
    0x410..=0x41F, //= ID-9
    0x450..=0x470, //= ID-10
    0x4E2..=0x4E2, //= ID-11
    0x4FD..=0x4FF, //= ID-12
    0x550..=0x550, //= ID-13
    0x581..=0x584, //= ID-14
    0x601..=0x601, //= ID-15
    0x604..=0x604, //= ID-16
    0x700..=0x705, //= ID-17
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
