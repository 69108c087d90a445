//! How the light of a state looks wherever it is drawn: the pages, the terminal, the diagrams. Its colour fills the box, and what flashes
//! has a dashed edge or stripes besides.

use crate::Assi;

/// What a picture stands on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Background {
    /// Paper, or a light page.
    Light,
    /// A dark page.
    Dark,
}

/// The colours of a box, as `#rrggbb`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Paint {
    /// What fills it.
    pub fill: &'static str,
    /// What is written in it: a contrast of 4.5 to 1 at least.
    pub ink: &'static str,
}

impl Paint {
    /// The colours of a light on a background.
    ///
    /// ```
    /// use adsdv_spec::Assi;
    /// use adsdv_spec::export::{Background, Paint};
    ///
    /// let ready = Paint::of(Assi::YellowContinuous, Background::Dark);
    /// assert_eq!(ready, Paint::of(Assi::YellowFlashing, Background::Light), "yellow is yellow");
    /// ```
    pub const fn of(light: Assi, on: Background) -> Self {
        let (fill, ink) = match (light, on) {
            (Assi::Off, Background::Light) => ("#d3d8de", "#1b1f24"),
            (Assi::Off, Background::Dark) => ("#3a424b", "#e6e9ed"),
            (Assi::YellowContinuous | Assi::YellowFlashing, _) => ("#ffd400", "#1b1f24"),
            (Assi::BlueContinuous | Assi::BlueFlashing, Background::Light) => ("#2355d4", "#ffffff"),
            (Assi::BlueContinuous | Assi::BlueFlashing, Background::Dark) => ("#3f6ee8", "#ffffff"),
        };
        Self { fill, ink }
    }
}
