//! How a diagram shows the light of a state: its colour fills the box, and a box that flashes has a dashed edge.

use crate::Assi;

/// The colour of the box, light enough for black text.
pub(super) const fn fill(light: Assi) -> &'static str {
    match light {
        Assi::Off => "#f2f2f2",
        Assi::YellowContinuous | Assi::YellowFlashing => "#ffe680",
        Assi::BlueContinuous | Assi::BlueFlashing => "#b3d1ff",
    }
}

/// Whether the light flashes.
pub(super) const fn flashes(light: Assi) -> bool {
    matches!(light, Assi::YellowFlashing | Assi::BlueFlashing)
}
