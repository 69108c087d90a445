//! What version 3.0 asks for: the numbers of `REQUIREMENTS.md`.

use crate::requirements::{Numbers, Requirements};

pub(super) const REQUIREMENTS: &Requirements = &Requirements {
    before: None,
    added: &[
        Numbers::new("MSG", 1, 83),
        Numbers::new("ID", 1, 17),
        Numbers::new("HS", 1, 16),
        Numbers::new("SM", 1, 18),
        Numbers::new("RDY", 1, 8),
        Numbers::new("DRV", 1, 15),
        Numbers::new("FIN", 1, 6),
        Numbers::new("FTO", 1, 1),
        Numbers::new("RTE", 1, 8),
        Numbers::new("RTO", 1, 1),
        Numbers::new("DTE", 1, 5),
        Numbers::new("FTE", 1, 1),
        Numbers::new("ETO", 1, 4),
        Numbers::new("IMP", 1, 4),
        Numbers::new("D", 1, 50),
    ],
    replaced: &[],
};
