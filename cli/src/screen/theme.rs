//! The few styles of the screen. The words tell everything as well: color only helps the eye.

use adsdv_spec::Assi;
use ratatui::style::{Color, Modifier, Style};

/// Not important.
pub(super) const QUIET: Style = Style::new().add_modifier(Modifier::DIM);
/// Important.
pub(super) const STRONG: Style = Style::new().add_modifier(Modifier::BOLD);

/// The styles that have colors, or would have.
#[derive(Clone, Copy, Debug)]
pub(super) struct Theme {
    color: bool,
}

impl Theme {
    pub(super) const fn new(color: bool) -> Self {
        Self { color }
    }

    const fn foreground(self, color: Color) -> Style {
        if self.color { Style::new().fg(color) } else { Style::new() }
    }

    /// As it should be, or switched on.
    pub(super) const fn good(self) -> Style {
        self.foreground(Color::Green).add_modifier(Modifier::BOLD)
    }

    /// A fault.
    pub(super) const fn bad(self) -> Style {
        self.foreground(Color::LightRed).add_modifier(Modifier::BOLD)
    }

    /// A warning, or what is still missing.
    pub(super) const fn care(self) -> Style {
        self.foreground(Color::Yellow)
    }

    /// A key to press.
    pub(super) const fn key(self) -> Style {
        self.foreground(Color::Cyan).add_modifier(Modifier::BOLD)
    }

    /// Whether something is as it should be.
    pub(super) const fn well(self, well: bool) -> Style {
        if well { Style::new() } else { self.bad() }
    }

    /// The ASSI, when a flashing one is `lit` and when it is not.
    pub(super) const fn light(self, assi: Assi, lit: bool) -> Style {
        let (color, text, when_dark) = match assi {
            Assi::Off => return STRONG,
            Assi::YellowContinuous | Assi::YellowFlashing => {
                (Color::LightYellow, Color::Black, Color::LightYellow)
            }
            Assi::BlueContinuous | Assi::BlueFlashing => (Color::Blue, Color::White, Color::LightBlue),
        };
        let shines = lit || matches!(assi, Assi::YellowContinuous | Assi::BlueContinuous);
        match (self.color, shines) {
            (true, true) => STRONG.bg(color).fg(text),
            (true, false) => STRONG.fg(when_dark),
            (false, true) => STRONG.add_modifier(Modifier::REVERSED),
            (false, false) => STRONG.add_modifier(Modifier::DIM),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [Assi; 5] =
        [Assi::Off, Assi::YellowContinuous, Assi::YellowFlashing, Assi::BlueFlashing, Assi::BlueContinuous];

    #[test]
    fn only_the_flashing_lights_flash() {
        for color in [true, false] {
            let theme = Theme::new(color);
            for assi in ALL {
                let flashes = theme.light(assi, true) != theme.light(assi, false);
                assert_eq!(flashes, assi.to_string().contains("flashing"), "{assi}, color {color}");
            }
        }
    }

    #[test]
    fn without_color_there_is_none() {
        let theme = Theme::new(false);
        let lights = ALL.iter().flat_map(|&assi| [theme.light(assi, true), theme.light(assi, false)]);
        let others = [theme.good(), theme.bad(), theme.care(), theme.key()];
        for style in lights.chain(others) {
            assert_eq!((style.fg, style.bg), (None, None));
        }
    }
}
