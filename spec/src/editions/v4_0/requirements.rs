//! What version 4.0 asks for besides what 3.0 does, and instead of it: the numbers of `REQUIREMENTS.md`.

use crate::edition::Edition;
use crate::requirements::{Numbers, Replaced, Requirements};

pub(super) const REQUIREMENTS: &Requirements = &Requirements {
    before: Some(Edition::V3_0.requirements),
    added: &[
        Numbers::new("MSG", 84, 103),
        Numbers::new("ID", 18, 19),
        Numbers::new("HS", 17, 19),
        Numbers::new("DTE", 6, 13),
        Numbers::new("IMP", 5, 9),
        Numbers::new("D", 51, 66),
    ],
    replaced: &[
        Replaced::new("MSG-24", &["MSG-99"]),
        Replaced::new("MSG-74", &["MSG-100"]),
        Replaced::new("MSG-80", &["MSG-101"]),
        Replaced::new("ID-3", &[]),
        Replaced::new("ID-6", &[]),
        Replaced::new("ID-15", &["ID-18"]),
        Replaced::new("ID-16", &["ID-18"]),
        Replaced::new("HS-9", &["HS-17"]),
        Replaced::new("HS-13", &[]),
        Replaced::new("HS-14", &[]),
        Replaced::new("HS-16", &["HS-19"]),
        Replaced::new("DTE-4", &["DTE-7"]),
        Replaced::new("DTE-5", &["DTE-8"]),
        Replaced::new("IMP-1", &["DTE-6"]),
        Replaced::new("IMP-2", &["IMP-6"]),
        Replaced::new("IMP-3", &["IMP-5"]),
        Replaced::new("D-2", &["D-65"]),
        Replaced::new("D-9", &["D-62"]),
        Replaced::new("D-10", &["D-63"]),
        Replaced::new("D-27", &["D-27", "IMP-9"]),
        Replaced::new("D-33", &[]),
    ],
};
