//! An atom in the words of Figure 2, with the numbers of an edition's rules in them.

use core::fmt;

use crate::atoms::Atom;
use crate::edition::Rules;
use crate::limits::Timing;
use crate::messages::{Decimal, Scale};

impl Rules {
    /// A condition in the words of Figure 2, as it reads when it is true or false, with the numbers of these rules.
    ///
    /// ```
    /// use adsdv_spec::{Atom, Edition};
    /// let rules = Edition::V3_0.rules;
    /// assert_eq!(rules.text(Atom::Asms, false).to_string(), "AS master switch OFF");
    /// assert_eq!(rules.text(Atom::SteerStraight, true).to_string(), "abs(steer angle) < 5 deg");
    /// ```
    pub const fn text(&self, atom: Atom, value: bool) -> AtomText<'_> {
        AtomText { rules: self, atom, value }
    }

    /// Writes the number that stands for this in the words of an atom.
    fn number(&self, f: &mut fmt::Formatter<'_>, name: &str) -> fmt::Result {
        match name {
            "straight" => write!(f, "{}", self.thresholds.straight),
            "wheel_speed" => write!(f, "{}", self.thresholds.wheel_speed),
            "missed" => match self.thresholds.missed_ms {
                Some(ms) => write!(f, "{ms} ms"),
                None => f.write_str("ever so long"),
            },
            _ => {
                let Timing { ready_dwell_ms: ms, .. } = self.timing;
                let seconds = Decimal { raw: i32::from(ms), scale: Scale::new(1, 1000) };
                write!(f, "{seconds} second")
            }
        }
    }
}

/// Displays a condition in the words of Figure 2; see [`Rules::text`].
#[derive(Clone, Copy, Debug)]
pub struct AtomText<'a> {
    rules: &'a Rules,
    atom: Atom,
    value: bool,
}

impl fmt::Display for AtomText<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let words = self.atom.words(self.value);
        match words.split_once('{').and_then(|(before, rest)| Some((before, rest.split_once('}')?))) {
            Some((before, (name, after))) => {
                f.write_str(before)?;
                self.rules.number(f, name)?;
                f.write_str(after)
            }
            None => f.pad(words),
        }
    }
}

#[cfg(test)]
mod tests {
    extern crate std;

    use std::string::{String, ToString};

    use super::Atom;
    use crate::messages::{SteerAngle, WheelSpeed};
    use crate::{Edition, Rules, Thresholds, Timing};

    #[test]
    fn every_number_in_a_text_is_that_of_the_rules() {
        let odd = Rules {
            timing: Timing { ready_dwell_ms: 7250, ..Edition::V3_0.rules.timing },
            thresholds: Thresholds {
                wheel_speed: WheelSpeed::clamped(77),
                straight: SteerAngle::clamped(77),
                missed_ms: Some(7700),
            },
            ..Edition::V3_0.rules
        };
        for &atom in Atom::ALL {
            for value in [false, true] {
                let mut text = odd.text(atom, value).to_string();
                assert!(!text.contains(['{', '}']), "{text}");
                for number in ["7.25 second", "7700 ms", "7.7 deg", "77 rpm"] {
                    text = text.replacen(number, "", 1);
                }
                // A flag is set or not, and a request is zero or not: these are no limits.
                for comparison in ["== 0", "!= 0", "== 1", "!= 1"] {
                    if let Some(rest) = text.strip_suffix(comparison) {
                        text = String::from(rest);
                    }
                }
                assert!(!text.contains(|c: char| c.is_ascii_digit()), "{atom}: where is {text:?} from?");
            }
        }
    }

    #[test]
    fn the_words_are_those_of_the_figure() {
        let text = |atom| Edition::V3_0.rules.text(atom, true).to_string();
        assert_eq!(text(Atom::DwellElapsed), "5 second timer elapsed");
        assert_eq!(text(Atom::AtRest), "all wheel speeds < 10 rpm");
        let missed = text(Atom::AiMessagesMissed);
        assert!(missed.contains("ever so long"), "3.0 has no limit: {missed}");
    }
}
