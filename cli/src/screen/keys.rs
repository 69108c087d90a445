//! What the keys do.

use adsdv_can::car::{Action, Switch};
use ratatui::crossterm::event::{KeyCode, KeyEvent, KeyEventKind, KeyModifiers};

/// A key that the operator has, and what it does.
#[derive(Clone, Copy, Debug)]
pub(super) struct Key {
    /// The key. The capital letter, if it is a letter, turns the switch the other way.
    pub(super) stroke: char,
    /// The name of the switch, or [`Action::POWER_CYCLE`].
    pub(super) name: &'static str,
}

/// Every switch with its key, in the order in which the screen has them.
pub(super) const KEYS: [Key; 20] = [
    key('a', "asms"),
    key('t', "tsms"),
    key('m', "ami"),
    key('e', "ebs"),
    key('g', "go"),
    key('p', Action::POWER_CYCLE),
    key('1', "remote_estop"),
    key('2', "res_link_lost"),
    key('3', "vehicle_estop"),
    key('4', "crash_sensor"),
    key('5', "critical_fault"),
    key('6', "bms_fault"),
    key('7', "mpp_dongle_removed"),
    key('o', "hvil_open"),
    key('s', "hvil_short"),
    key('b', "ebs_fault"),
    key('f', "offboard_charger_fault"),
    key('c', "charging"),
    key('w', "batt_temp_high"),
    key('l', "batt_soc_low"),
];

const fn key(stroke: char, name: &'static str) -> Key {
    Key { stroke, name }
}

impl Key {
    /// The switch; `None` is the power cycle.
    pub(super) fn switch(&self) -> Option<Switch> {
        Switch::named(self.name)
    }

    /// What the switch says.
    pub(super) fn meaning(&self) -> &'static str {
        self.switch().map_or(Action::ABOUT_POWER_CYCLE, Switch::about)
    }

    /// The key for what the operator can do.
    pub(super) fn of(action: Action) -> Option<Self> {
        let name = match action {
            Action::Set(switch, _) => switch.key(),
            Action::PowerCycle => Action::POWER_CYCLE,
        };
        KEYS.into_iter().find(|key| key.name == name)
    }
}

/// What the operator wants.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum KeyCommand {
    /// Leave the screen.
    Quit,
    /// Explain the keys, or stop explaining them.
    Help,
    /// Show Figure 2, or no longer.
    Figure,
    /// Stop explaining the keys, and show Figure 2 no longer.
    Close,
    /// Put the program into the background.
    Suspend,
    /// Draw everything anew.
    Redraw,
    /// Scroll what happened.
    Scroll(Scroll),
    /// Turn a switch.
    Turn(Switch, Turn),
    /// Turn the power of the VCU off and on again.
    PowerCycle,
}

/// Where to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scroll {
    /// One line back in time.
    Up,
    /// One line on.
    Down,
    /// A page back in time.
    PageUp,
    /// A page on.
    PageDown,
    /// To the first that is known.
    First,
    /// To the latest, and on with it.
    Latest,
}

/// Which way a switch is turned. The ends meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Turn {
    /// To the next position.
    Next,
    /// To the one before.
    Previous,
}

impl Turn {
    /// Where this leads to; `None` without any position.
    pub(super) fn from(self, positions: &[i32], raw: i32) -> Option<i32> {
        let last = positions.len().checked_sub(1)?;
        let at = positions.iter().position(|&position| position == raw);
        let to = match (self, at) {
            (Self::Next, Some(at)) if at < last => at + 1,
            (Self::Next, _) => 0,
            (Self::Previous, Some(at)) if at > 0 => at - 1,
            (Self::Previous, _) => last,
        };
        positions.get(to).copied()
    }
}

/// What a key means; `None` if nothing.
pub(super) fn command(event: KeyEvent) -> Option<KeyCommand> {
    if event.kind == KeyEventKind::Release {
        return None;
    }
    let held = |key| event.modifiers.contains(key);
    match event.code {
        KeyCode::Char(key) if held(KeyModifiers::CONTROL) => match key.to_ascii_lowercase() {
            'c' => Some(KeyCommand::Quit),
            'z' => Some(KeyCommand::Suspend),
            'l' => Some(KeyCommand::Redraw),
            _ => None,
        },
        KeyCode::Char(_) if held(KeyModifiers::ALT) => None,
        KeyCode::Char('q' | 'Q') => Some(KeyCommand::Quit),
        KeyCode::Char('?') => Some(KeyCommand::Help),
        KeyCode::Char(key) => operator(key),
        KeyCode::Tab => Some(KeyCommand::Figure),
        KeyCode::Esc => Some(KeyCommand::Close),
        KeyCode::Up => Some(KeyCommand::Scroll(Scroll::Up)),
        KeyCode::Down => Some(KeyCommand::Scroll(Scroll::Down)),
        KeyCode::PageUp => Some(KeyCommand::Scroll(Scroll::PageUp)),
        KeyCode::PageDown => Some(KeyCommand::Scroll(Scroll::PageDown)),
        KeyCode::Home => Some(KeyCommand::Scroll(Scroll::First)),
        KeyCode::End => Some(KeyCommand::Scroll(Scroll::Latest)),
        _ => None,
    }
}

fn operator(key: char) -> Option<KeyCommand> {
    let found = KEYS.iter().find(|entry| entry.stroke == key.to_ascii_lowercase())?;
    let turn = if key.is_ascii_uppercase() { Turn::Previous } else { Turn::Next };
    Some(found.switch().map_or(KeyCommand::PowerCycle, |switch| KeyCommand::Turn(switch, turn)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn press(code: KeyCode, modifiers: KeyModifiers) -> Option<KeyCommand> {
        command(KeyEvent::new(code, modifiers))
    }

    fn char(key: char) -> Option<KeyCommand> {
        press(KeyCode::Char(key), KeyModifiers::NONE)
    }

    #[test]
    fn every_switch_has_one_key() {
        let mut names: Vec<&str> = KEYS.iter().map(|key| key.name).collect();
        let mut expected: Vec<&str> = Switch::all().map(Switch::key).chain([Action::POWER_CYCLE]).collect();
        names.sort_unstable();
        expected.sort_unstable();
        assert_eq!(names, expected);
        assert_eq!(Action::POWER_CYCLE.parse(), Ok(Action::PowerCycle));
        for key in KEYS {
            let action = key.switch().map_or(Action::PowerCycle, |switch| Action::Set(switch, 0));
            assert_eq!(Key::of(action).map(|found| found.stroke), Some(key.stroke), "{}", key.name);
        }
    }

    #[test]
    fn no_key_does_two_things() {
        let mut keys: Vec<char> = KEYS.iter().map(|key| key.stroke).collect();
        keys.sort_unstable();
        keys.dedup();
        assert_eq!(keys.len(), KEYS.len());
        for key in KEYS {
            assert!(key.stroke.is_ascii_lowercase() || key.stroke.is_ascii_digit(), "{key:?}");
            let expected =
                key.switch().map_or(KeyCommand::PowerCycle, |switch| KeyCommand::Turn(switch, Turn::Next));
            assert_eq!(char(key.stroke), Some(expected), "the key of {} does something else", key.name);
        }
    }

    #[test]
    fn a_capital_letter_turns_the_other_way() {
        let ami = Switch::named("ami").expect("a switch");
        assert_eq!(
            press(KeyCode::Char('M'), KeyModifiers::SHIFT),
            Some(KeyCommand::Turn(ami, Turn::Previous))
        );
        assert_eq!(char('P'), Some(KeyCommand::PowerCycle));
    }

    #[test]
    fn keys_of_the_screen() {
        assert_eq!(char('q'), Some(KeyCommand::Quit));
        assert_eq!(char('?'), Some(KeyCommand::Help));
        assert_eq!(press(KeyCode::Tab, KeyModifiers::NONE), Some(KeyCommand::Figure));
        assert_eq!(press(KeyCode::Esc, KeyModifiers::NONE), Some(KeyCommand::Close));
        for (key, scroll) in [
            (KeyCode::Up, Scroll::Up),
            (KeyCode::Down, Scroll::Down),
            (KeyCode::PageUp, Scroll::PageUp),
            (KeyCode::PageDown, Scroll::PageDown),
            (KeyCode::Home, Scroll::First),
            (KeyCode::End, Scroll::Latest),
        ] {
            assert_eq!(press(key, KeyModifiers::NONE), Some(KeyCommand::Scroll(scroll)), "{key:?}");
        }
        for (key, expected) in [
            ('c', Some(KeyCommand::Quit)),
            ('C', Some(KeyCommand::Quit)),
            ('z', Some(KeyCommand::Suspend)),
            ('l', Some(KeyCommand::Redraw)),
            ('a', None),
            ('q', None),
        ] {
            assert_eq!(press(KeyCode::Char(key), KeyModifiers::CONTROL), expected, "Ctrl-{key}");
        }
        assert_eq!(press(KeyCode::Char('a'), KeyModifiers::ALT), None);
        assert_eq!(char('ä'), None);
        assert_eq!(press(KeyCode::F(1), KeyModifiers::NONE), None);
    }

    #[test]
    fn letting_a_key_go_does_nothing() {
        let event = KeyEvent::new_with_kind(KeyCode::Char('a'), KeyModifiers::NONE, KeyEventKind::Release);
        assert_eq!(command(event), None);
    }

    #[test]
    fn the_ends_of_a_switch_meet() {
        let positions = [1, 2, 3];
        assert_eq!([1, 2, 3].map(|raw| Turn::Next.from(&positions, raw)), [Some(2), Some(3), Some(1)]);
        assert_eq!([1, 2, 3].map(|raw| Turn::Previous.from(&positions, raw)), [Some(3), Some(1), Some(2)]);
        assert_eq!(Turn::Next.from(&positions, 9), Some(1));
        assert_eq!(Turn::Next.from(&[], 0), None);
    }
}
