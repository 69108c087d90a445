//! The terminal screen of the virtual VCU: the operator's switches as keys, and everything that a [`Status`] tells.
//!
//! ```text
//! Source --status--> render (panel, theme) --> terminal
//!   ^                                             |
//!   +----action---- Screen <--command-- keys <----+
//! ```
//!
//! How the car runs is the business of the [`Source`]; the screen asks how it stands, about twenty times a second, and tells
//! it what the operator does. Drawing is a function of a status and of the few things that a [`Screen`] remembers, so that
//! what people see is compared with the files in `golden/`.

mod figure;
mod help;
mod keyboard;
mod keys;
mod panel;
mod render;
mod terminal;
mod theme;

#[cfg(test)]
mod golden;
#[cfg(test)]
mod sample;
#[cfg(test)]
mod simulated;
#[cfg(test)]
mod svg;

use adsdv_can::car::{Action, Switch};
use adsdv_can::status::Status;
use adsdv_spec::Inputs;

use keys::{KeyCommand, Scroll, Turn};

pub(crate) use panel::happened;
pub(crate) use terminal::run;

/// A car that runs somewhere else.
pub(crate) trait Source {
    /// How it stands.
    fn status(&self) -> Status;

    /// Does what the operator does.
    fn act(&self, action: Action);

    /// It has come to its end, and so does the screen.
    fn is_over(&self) -> bool;
}

/// For so long a flashing light is lit, and then dark, in milliseconds: two flashes a second.
const FLASH_MS: u128 = 250;

/// What the screen itself remembers.
#[derive(Clone, Debug)]
pub(crate) struct Screen {
    /// Colors are wanted.
    color: bool,
    /// How the edition was chosen, as the line says it with which an answer begins; empty where nobody asks.
    edition: String,
    /// The keys are explained.
    help: bool,
    /// Figure 2 is shown.
    figure: bool,
    /// A light that flashes is lit.
    lit: bool,
    /// By how many lines what happened is scrolled back.
    back: usize,
    /// How many lines it can be scrolled by, and how many are seen at once: as it was last drawn.
    log: panel::Room,
    /// Where switches were turned to since the last look at the car, which need not have followed yet.
    turned: Vec<(Switch, i32)>,
}

/// What a command comes to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Effect {
    /// The screen is left.
    Quit,
    /// The program is put into the background.
    Suspend,
    /// Everything is drawn anew.
    Redraw,
    /// The operator does this.
    Act(Action),
    /// Nothing but what the screen remembers has changed.
    Nothing,
}

impl Screen {
    /// A screen as it begins.
    fn new(color: bool) -> Self {
        let (edition, log, turned) = (String::new(), panel::Room::default(), Vec::new());
        Self { color, edition, help: false, figure: false, lit: true, back: 0, log, turned }
    }

    /// The same, of a VCU whose edition was chosen like this.
    fn of(self, edition: &impl ToString) -> Self {
        Self { edition: edition.to_string(), ..self }
    }

    /// So many milliseconds have passed since the screen began, and the car was looked at anew.
    fn tick(&mut self, ms: u128) {
        self.lit = (ms / FLASH_MS).is_multiple_of(2);
        self.turned.clear();
    }

    /// Follows a command while the inputs of the car are these.
    fn follow(&mut self, command: KeyCommand, inputs: &Inputs) -> Effect {
        match command {
            KeyCommand::Quit => return Effect::Quit,
            KeyCommand::Suspend => return Effect::Suspend,
            KeyCommand::Redraw => return Effect::Redraw,
            KeyCommand::PowerCycle => return Effect::Act(Action::PowerCycle),
            KeyCommand::Turn(switch, turn) => {
                if let Some(raw) = self.turn(switch, turn, inputs) {
                    return Effect::Act(Action::Set(switch, raw));
                }
            }
            KeyCommand::Help => self.help = !self.help,
            KeyCommand::Figure => self.figure = !self.figure,
            KeyCommand::Close => (self.help, self.figure) = (false, false),
            KeyCommand::Scroll(scroll) => self.scroll(scroll),
        }
        Effect::Nothing
    }

    /// The position that comes next. Keys that are struck faster than the car is looked at count all the same.
    fn turn(&mut self, switch: Switch, turn: Turn, inputs: &Inputs) -> Option<i32> {
        let turned = self.turned.iter().rev().find(|(other, _)| *other == switch);
        let raw = turned.map_or_else(|| switch.get(inputs), |&(_, raw)| raw);
        let next = turn.from(&switch.positions(), raw)?;
        self.turned.push((switch, next));
        Some(next)
    }

    fn scroll(&mut self, scroll: Scroll) {
        let page = self.log.seen.saturating_sub(1).max(1);
        // What was drawn last may have been shorter than where one had scrolled to.
        let back = self.back.min(self.log.most_back);
        self.back = match scroll {
            Scroll::Up => back + 1,
            Scroll::Down => back.saturating_sub(1),
            Scroll::PageUp => back + page,
            Scroll::PageDown => back.saturating_sub(page),
            Scroll::First => self.log.most_back,
            Scroll::Latest => 0,
        }
        .min(self.log.most_back);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn switch(name: &str) -> Switch {
        Switch::named(name).expect("a switch")
    }

    #[test]
    fn keys_that_are_struck_faster_than_the_car_answers_count_all() {
        let (mut screen, inputs) = (Screen::new(true), Inputs::default());
        let ami = KeyCommand::Turn(switch("ami"), Turn::Next);
        let act = |screen: &mut Screen| screen.follow(ami, &inputs);
        assert_eq!(act(&mut screen), Effect::Act(Action::Set(switch("ami"), 1)));
        assert_eq!(act(&mut screen), Effect::Act(Action::Set(switch("ami"), 2)));
        screen.tick(0); // the car was looked at, and has not moved: somebody else turned the switch back
        assert_eq!(act(&mut screen), Effect::Act(Action::Set(switch("ami"), 1)));
    }

    #[test]
    fn a_light_flashes_twice_a_second() {
        let mut screen = Screen::new(true);
        let lit = [0, 249, 250, 499, 500, 1000].map(|ms| {
            screen.tick(ms);
            screen.lit
        });
        assert_eq!(lit, [true, true, false, false, true, true]);
    }

    #[test]
    fn help_opens_and_closes() {
        let (mut screen, inputs) = (Screen::new(true), Inputs::default());
        for (command, help) in [
            (KeyCommand::Help, true),
            (KeyCommand::Help, false),
            (KeyCommand::Close, false),
            (KeyCommand::Help, true),
            (KeyCommand::Close, false),
        ] {
            assert_eq!(screen.follow(command, &inputs), Effect::Nothing);
            assert_eq!(screen.help, help, "{command:?}");
        }
    }

    #[test]
    fn figure_2_opens_and_closes_and_the_keys_are_explained_over_it() {
        let (mut screen, inputs) = (Screen::new(true), Inputs::default());
        for (command, figure) in [
            (KeyCommand::Figure, true),
            (KeyCommand::Figure, false),
            (KeyCommand::Figure, true),
            (KeyCommand::Help, true),
        ] {
            assert_eq!(screen.follow(command, &inputs), Effect::Nothing);
            assert_eq!(screen.figure, figure, "{command:?}");
        }
        screen.follow(KeyCommand::Close, &inputs);
        assert!(!screen.figure && !screen.help);
    }

    #[test]
    fn scrolling_stays_within_what_there_is() {
        let (mut screen, inputs) = (Screen::new(true), Inputs::default());
        screen.log = panel::Room { seen: 5, most_back: 12 };
        let steps = [
            (Scroll::Down, 0),
            (Scroll::Up, 1),
            (Scroll::PageUp, 5),
            (Scroll::PageUp, 9),
            (Scroll::PageUp, 12),
            (Scroll::Up, 12),
            (Scroll::PageDown, 8),
            (Scroll::Latest, 0),
            (Scroll::First, 12),
        ];
        for (scroll, back) in steps {
            screen.follow(KeyCommand::Scroll(scroll), &inputs);
            assert_eq!(screen.back, back, "{scroll:?}");
        }
        screen.log.most_back = 3; // the terminal has grown
        screen.follow(KeyCommand::Scroll(Scroll::Down), &inputs);
        assert_eq!(screen.back, 2);
    }
}
