//! What a program speaks of where nobody says it.

use adsdv_spec::Edition;

/// The edition that a program speaks of until somebody says which, as all did before there was another.
pub const UNSAID: &Edition = &Edition::V3_0;
