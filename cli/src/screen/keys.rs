//! What the keys do.

use adsdv_can::car::Switch;
use ratatui::crossterm::event::{KeyCode, KeyEvent, KeyEventKind, KeyModifiers};

/// A key that the operator has, and what it does.
#[derive(Clone, Copy, Debug)]
pub(super) struct Key {
    /// The key. The capital letter, if it is a letter, turns the switch the other way.
    pub(super) stroke: char,
    /// The name of the switch, or [`POWER_CYCLE`].
    pub(super) name: &'static str,
    /// What the switch says.
    pub(super) meaning: &'static str,
}

/// What is not a switch, by the name of its action.
pub(super) const POWER_CYCLE: &str = "power cycle";

/// Every switch with its key, in the order in which the screen has them.
pub(super) const KEYS: [Key; 20] = [
    key('a', "asms", "the Autonomous System Master Switch"),
    key('t', "tsms", "the Tractive System Master Switch"),
    key('m', "ami", "the mission selected at the AMI"),
    key('e', "ebs", "the state of the Emergency Braking System"),
    key('g', "go", "the remote \"Go\" switch"),
    key('p', POWER_CYCLE, "turns the power of the VCU off and on again"),
    key('1', "remote_estop", "the remote E-stop button is pressed"),
    key('2', "res_link_lost", "the remote E-stop has lost its transmitter"),
    key('3', "vehicle_estop", "an E-stop button on the vehicle is pressed"),
    key('4', "crash_sensor", "the crash sensor is activated"),
    key('5', "critical_fault", "a critical fault without a flag of its own"),
    key('6', "bms_fault", "a critical fault in the traction battery"),
    key('7', "mpp_dongle_removed", "the autonomous driving dongle is not plugged in"),
    key('o', "hvil_open", "HVIL or shutdown circuit: an open circuit"),
    key('s', "hvil_short", "HVIL or shutdown circuit: a short circuit"),
    key('b', "ebs_fault", "the Emergency Braking System is faulty"),
    key('f', "offboard_charger_fault", "the off-board charger is faulty"),
    key('c', "charging", "a fault as soon as ASMS or TSMS is on"),
    key('w', "batt_temp_high", "the battery is hot (a warning)"),
    key('l', "batt_soc_low", "the battery's charge is low (a warning)"),
];

const fn key(stroke: char, name: &'static str, meaning: &'static str) -> Key {
    Key { stroke, name, meaning }
}

impl Key {
    /// The switch; `None` is the power cycle.
    pub(super) fn switch(&self) -> Option<Switch> {
        Switch::named(self.name)
    }
}

/// What the operator wants.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Command {
    /// Leave the screen.
    Quit,
    /// Explain the keys, or stop explaining them.
    Help,
    /// Stop explaining the keys.
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
pub(super) fn command(event: KeyEvent) -> Option<Command> {
    if event.kind == KeyEventKind::Release {
        return None;
    }
    let held = |key| event.modifiers.contains(key);
    match event.code {
        KeyCode::Char(key) if held(KeyModifiers::CONTROL) => match key.to_ascii_lowercase() {
            'c' => Some(Command::Quit),
            'z' => Some(Command::Suspend),
            'l' => Some(Command::Redraw),
            _ => None,
        },
        KeyCode::Char(_) if held(KeyModifiers::ALT) => None,
        KeyCode::Char('q' | 'Q') => Some(Command::Quit),
        KeyCode::Char('?') => Some(Command::Help),
        KeyCode::Char(key) => operator(key),
        KeyCode::Esc => Some(Command::Close),
        KeyCode::Up => Some(Command::Scroll(Scroll::Up)),
        KeyCode::Down => Some(Command::Scroll(Scroll::Down)),
        KeyCode::PageUp => Some(Command::Scroll(Scroll::PageUp)),
        KeyCode::PageDown => Some(Command::Scroll(Scroll::PageDown)),
        KeyCode::Home => Some(Command::Scroll(Scroll::First)),
        KeyCode::End => Some(Command::Scroll(Scroll::Latest)),
        _ => None,
    }
}

fn operator(key: char) -> Option<Command> {
    let found = KEYS.iter().find(|entry| entry.stroke == key.to_ascii_lowercase())?;
    let turn = if key.is_ascii_uppercase() { Turn::Previous } else { Turn::Next };
    Some(found.switch().map_or(Command::PowerCycle, |switch| Command::Turn(switch, turn)))
}

#[cfg(test)]
mod tests {
    use adsdv_can::car::Action;

    use super::*;

    fn press(code: KeyCode, modifiers: KeyModifiers) -> Option<Command> {
        command(KeyEvent::new(code, modifiers))
    }

    fn char(key: char) -> Option<Command> {
        press(KeyCode::Char(key), KeyModifiers::NONE)
    }

    #[test]
    fn every_switch_has_one_key() {
        let mut names: Vec<&str> = KEYS.iter().map(|key| key.name).collect();
        let mut expected: Vec<&str> = Switch::all().map(Switch::key).chain([POWER_CYCLE]).collect();
        names.sort_unstable();
        expected.sort_unstable();
        assert_eq!(names, expected);
        assert_eq!(POWER_CYCLE.parse(), Ok(Action::PowerCycle));
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
                key.switch().map_or(Command::PowerCycle, |switch| Command::Turn(switch, Turn::Next));
            assert_eq!(char(key.stroke), Some(expected), "the key of {} does something else", key.name);
        }
    }

    #[test]
    fn a_capital_letter_turns_the_other_way() {
        let ami = Switch::named("ami").expect("a switch");
        assert_eq!(press(KeyCode::Char('M'), KeyModifiers::SHIFT), Some(Command::Turn(ami, Turn::Previous)));
        assert_eq!(char('P'), Some(Command::PowerCycle));
    }

    #[test]
    fn keys_of_the_screen() {
        assert_eq!(char('q'), Some(Command::Quit));
        assert_eq!(char('?'), Some(Command::Help));
        assert_eq!(press(KeyCode::Esc, KeyModifiers::NONE), Some(Command::Close));
        assert_eq!(press(KeyCode::PageUp, KeyModifiers::NONE), Some(Command::Scroll(Scroll::PageUp)));
        for (key, expected) in [
            ('c', Some(Command::Quit)),
            ('C', Some(Command::Quit)),
            ('z', Some(Command::Suspend)),
            ('l', Some(Command::Redraw)),
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
