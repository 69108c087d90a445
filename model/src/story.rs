//! A run in words: a line for each change of state, and for each step that breaks the property it is about.

use adsdv_spec::{Atom, Atoms, Control, Machine};

use crate::action::Action;
use crate::property::Property;
use crate::run::Run;
use crate::step::Step;

/// A line of a story.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StoryLine {
    /// When it happens, in milliseconds after the VCU was switched on.
    pub ms: u64,
    /// What happens.
    pub text: String,
}

/// Tells the run of a machine along a path. A step that breaks the property tells what the property looks
/// at, too.
pub fn story(machine: &Machine, path: &[Action], property: Option<&Property>) -> Vec<StoryLine> {
    let timing = &machine.edition().rules.timing;
    let (mut control, mut ms, mut lines) = (Control::INITIAL, 0, Vec::new());
    for (place, action) in path.iter().enumerate() {
        ms += u64::from(timing.cycle_ms);
        match *action {
            Action::PowerCycle => {
                control = Control::INITIAL;
                lines.push(StoryLine { ms, text: "the power is cycled".to_owned() });
            }
            Action::Step(seen) => {
                let step = Step::of(machine, timing, control, seen);
                let last = place + 1 == path.len();
                let broken = property.filter(|property| !property.holds(machine, &step));
                let looked_at =
                    broken.map_or(Atoms::NONE, |property| property.reads(&control, timing, |_| true));
                if last || broken.is_some() || step.before.state != step.after().state {
                    lines.push(StoryLine { ms, text: add_line(machine, &step, looked_at) });
                }
                control = *step.after();
            }
        }
    }
    lines
}

/// Tells the changes of state of a run.
pub fn story_of(run: &Run) -> Vec<StoryLine> {
    let steps = run.steps().zip(1..);
    let changes = steps.filter(|(cycle, _)| cycle.before.state != cycle.after.state);
    let rules = &run.machine().edition().rules;
    changes
        .map(|(cycle, step)| {
            let (before, after) = (cycle.before.state, cycle.after.state);
            let section = cycle.outputs.row(run.machine()).map_or("", |row| row.section);
            let deciding =
                cycle.outputs.term(run.machine()).map_or(Atoms::NONE, |term| term.on.union(term.off));
            let text = |atom| rules.text(atom, cycle.outputs.atoms.has(atom)).to_string();
            let conditions: Vec<_> = deciding.iter().map(text).collect();
            let text = format!("{before} -> {after} ({section}): {}", conditions.join(", "));
            StoryLine { ms: step * u64::from(rules.timing.cycle_ms), text }
        })
        .collect()
}

/// Such as `AS_READY -> AS_OFF (3.6): AS master switch OFF`.
fn add_line(machine: &Machine, step: &Step, looked_at: Atoms) -> String {
    let (before, after) = (step.before.state, step.after().state);
    let rules = &machine.edition().rules;
    let table = &rules.table;
    let taken = step.taken();
    let (row, term) = (taken.and_then(|taken| taken.row(table)), taken.and_then(|taken| taken.term(table)));
    let arrow = match row {
        Some(row) => format!("{before} -> {after} ({})", row.section),
        None => format!("stays in {after}"),
    };
    let deciding = term.map_or(Atoms::NONE, |term| term.on.union(term.off));
    let text = |atom, value| rules.text(atom, value).to_string();
    let conditions = deciding.union(looked_at).iter().map(|atom| text(atom, step.guarded().has(atom)));
    let mut conditions: Vec<_> = conditions.collect();
    if step.comms_lost() && !deciding.has(Atom::AiCommsLost) {
        conditions.push(text(Atom::AiCommsLost, true));
    }
    if conditions.is_empty() { arrow } else { format!("{arrow}: {}", conditions.join(", ")) }
}

#[cfg(test)]
mod tests {
    use adsdv_spec::{Faults, Observation};

    use super::*;

    #[test]
    fn behind_a_power_cycle_it_begins_anew() {
        let ready = [Atom::Asms, Atom::Tsms, Atom::AmiSelected, Atom::MissionSelected, Atom::EbsArmed];
        let step = Action::Step(Observation::new(Atoms::of(&ready), Faults::NONE));
        let lines = story(&Machine::REFERENCE, &[step, Action::PowerCycle, step], None);
        let lines: Vec<(u64, &str)> =
            lines.iter().map(|line| (line.ms, line.text.split(" (").next().unwrap_or_default())).collect();
        let ready = "AS_OFF -> AS_READY";
        assert_eq!(lines, [(10, ready), (20, "the power is cycled"), (30, ready)]);
    }

    /// A run that ends where nothing changes ends with a step all the same.
    #[test]
    fn the_story_has_the_last_step_whatever_it_does() {
        let lines = story(&Machine::REFERENCE, &[Action::Step(Observation::default()); 3], None);
        assert_eq!(lines, [StoryLine { ms: 30, text: "stays in AS_OFF".to_owned() }]);
    }
}
