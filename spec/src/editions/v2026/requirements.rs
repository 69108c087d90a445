//! What the database of 2026 asks for besides what 4.0 does, and instead of it: the numbers of `REQUIREMENTS.md`.

use crate::edition::Edition;
use crate::requirements::{Numbers, Replaced, Requirements};

pub(super) const REQUIREMENTS: &Requirements = &Requirements {
    before: Some(Edition::V4_0.requirements),
    added: &[Numbers::new("MSG", 105, 116), Numbers::new("ID", 20, 20), Numbers::new("D", 67, 73)],
    replaced: &[
        Replaced::new("MSG-88", &["MSG-116"]),
        Replaced::new("MSG-89", &[]),
        Replaced::new("MSG-90", &[]),
        Replaced::new("MSG-91", &[]),
        Replaced::new("MSG-92", &[]),
        Replaced::new("MSG-93", &[]),
        Replaced::new("MSG-94", &[]),
        Replaced::new("MSG-95", &["MSG-111", "MSG-112"]),
        Replaced::new("MSG-97", &["MSG-113"]),
        Replaced::new("MSG-99", &["MSG-105"]),
        Replaced::new("MSG-100", &["MSG-110"]),
        Replaced::new("MSG-102", &[]),
        Replaced::new("MSG-103", &["MSG-114"]),
        Replaced::new("D-53", &["D-67"]),
        Replaced::new("D-56", &[]),
        Replaced::new("D-57", &[]),
        Replaced::new("D-58", &[]),
        Replaced::new("D-59", &[]),
    ],
};
