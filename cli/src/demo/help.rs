//! What may stand in a scenario, for those who have the program and nothing else.

use std::fmt::Write as _;

use adsdv_can::car::{Action, Switch};
use adsdv_can::demo::DemoOptions;
use adsdv_can::scenario::Scenario;
use adsdv_spec::messages::AsState;

use crate::layout::wrapped;

/// No line is longer.
const WIDTH: usize = 88;
/// The column of what a switch is.
const ABOUT: usize = 31;

const EXAMPLES: &str = r"EXAMPLES
  adsdv demo

  Keep the log, and have it judged again:
      adsdv demo --log demo.log
      adsdv check demo.log

  The remote E-stop in the middle of the mission:
      adsdv demo --scenario remote-estop

  A scenario of one's own:
      printf '0 ebs ARMED, ami SKIDPAD\n0.5 tsms on, asms on\nAS_READY +1 end\n' |
          adsdv demo --scenario -
";

const REST: &str = "OUTPUT
  OPERATOR  what the operator did, and when
  Then comes the report of the log: see adsdv check --help.

ENVIRONMENT
  ADSDV_EDITION  the edition where --edition names none
  NO_COLOR       if set and not empty, --color auto means never

EXIT STATUS
  0  the run conforms: no violation was found; with --screen, it was left
  1  the run violates the document
  2  no verdict: the scenario could not be read or does not come to its end, the log or
     the report could not be written, there is no terminal for the screen, or the
     arguments are wrong";

/// What comes behind the options: examples, what a scenario is, and what comes out.
pub(crate) fn after() -> String {
    format!("{EXAMPLES}\n{}\n{REST}", scenario())
}

/// What may stand in a scenario.
fn scenario() -> String {
    let states = AsState::ALL.map(AsState::name).join(", ");
    let samples = Scenario::SAMPLES.map(|(name, _)| name).join(", ");
    let DemoOptions { patience_ms, tail_ms, .. } = DemoOptions::default();
    let paragraph = |text: &str| {
        let mut lines = String::new();
        wrapped(&mut lines, text.split(' '), 2, WIDTH);
        lines
    };
    let mut text = "SCENARIOS\n".to_owned();
    text.push_str(&paragraph(
        "A line of a scenario says when it takes place, and then what is done, separated by commas. # begins a comment. \
         Lines take place in their order.",
    ));
    text.push_str(
        "
    12.5             12.5 seconds after the start
    +0.5             half a second after the line before took place
    AS_READY         when the car is in this AS state
    AS_READY +5.5    when it has been in this AS state for 5.5 seconds

",
    );
    text.push_str(&paragraph(&format!(
        "The states are {states}. What is done is a switch with its position, or `{}`. The last may be `end`: the run \
         stops there. Without it, demo stops {} s after the last line, and vcu goes on. demo gives up after {} s in \
         which a scenario has waited for a state in vain.",
        Action::POWER_CYCLE,
        tail_ms / 1000,
        patience_ms / 1000,
    )));
    text.push('\n');
    for switch in Switch::all() {
        let positions: Vec<String> = switch.positions().into_iter().map(|raw| switch.position(raw)).collect();
        let (name, about) = (switch.key(), switch.about());
        // Writing to a string does not fail.
        if positions.len() == 2 {
            let _ = writeln!(text, "    {:<ABOUT$}{about}", format!("{name} {}", positions.join("|")));
        } else {
            // So many names are longer than the column.
            let _ = writeln!(text, "    {name:<ABOUT$}{about}:");
            wrapped(&mut text, positions, 6, WIDTH);
        }
    }
    let _ = writeln!(text, "    {:<ABOUT$}{}\n", Action::POWER_CYCLE, Action::ABOUT_POWER_CYCLE);
    text.push_str(&paragraph(&format!(
        "These come with adsdv, and --scenario takes their names: {samples}. A file of such a name is given as \
         ./{}.",
        Scenario::SAMPLES.first().map_or("", |(name, _)| name),
    )));
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_names_every_switch_and_every_position() {
        let text = after();
        for switch in Switch::all() {
            let line = text.lines().find(|line| line.trim_start().starts_with(switch.key()));
            let line = line.unwrap_or_else(|| panic!("{} is missing:\n{text}", switch.key()));
            assert!(line.contains(switch.about()), "{line}");
            let (_, behind) = text.split_once(line).expect("the line is there");
            for raw in switch.positions() {
                let position = switch.position(raw);
                let (next, _) = behind.split_once("\n    tsms").unwrap_or((behind, ""));
                assert!(line.contains(&position) || next.contains(&position), "{position} of {line}");
            }
        }
        for (name, _) in Scenario::SAMPLES {
            assert!(text.contains(name), "{name} is missing");
        }
    }

    #[test]
    fn its_times_are_scenarios_and_its_lines_are_short() {
        let text = after();
        for line in text.lines() {
            assert!(line.chars().count() <= WIDTH, "{line}");
        }
        let (_, times) = text.split_once("in their order.\n\n").expect("the times");
        let times = times.lines().take_while(|line| !line.is_empty());
        let mut scenario = String::new();
        for line in times {
            let (when, _) = line.trim().split_once("  ").expect("two columns");
            writeln!(scenario, "{when} asms on").expect("a string");
        }
        assert_eq!(scenario.lines().count(), 4);
        assert!(scenario.parse::<Scenario>().is_ok(), "{scenario}");
    }
}
