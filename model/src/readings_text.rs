//! What the readings cost, as the Markdown of `model/READINGS.md`: its head, and a section for each edition.

use std::fmt::{self, Display, Formatter};

use adsdv_spec::{Choice, Choices, Edition};

use crate::document::{have_the_same_state_machine, is_default};
use crate::goals::goals;
use crate::listed::properties;
use crate::property::Property;
use crate::ranking::Ranked;
use crate::story::{StoryLine, story, story_of};
use crate::sweep::{ClosedCost, Cost, Sweep};

/// What stands at the head of `model/READINGS.md`, before the sections of the editions.
pub const READINGS_HEAD: &str = "\
# What each reading costs

The document leaves questions open, and `adsdv readings` lists them with their answers. Here is what the answers cost:
the open model, in which the AI Computer, the driver and every fault do what they can, was explored under every
combination of answers that can matter to each other, and each property of `adsdv verify` was checked under each. Each state
machine has its own questions and a section here, of the first edition that has it. The default edition was explored in
full; of the others, combinations of at most two answers that are not the default.

The properties say what the text asks for at its strictest, and hold under the default answers. Another answer that fails
one is not wrong: the document allows it. But two teams, or a team and its simulator, that answer differently differ in
just this, and the shortest run below shows where.

This file is what `adsdv verify --readings` prints, and with `--edition` one section of it; tests keep it so.
";

const CLOSED: &str = "
### With an AI Computer that follows the document

In the closed models the AI Computer follows the document; the operator follows the procedure, or moves any switch at any
time. They were explored with short timers under each other answer alone";

/// Of an edition that is not the default.
const CLOSED_OTHERWISE: &str = ",
an operator who moves any switch under those that the default edition does not have";

impl Display for Sweep {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        writeln!(f, "## Edition {}\n", self.edition.version)?;
        let same = |other: &&&Edition| {
            other.version != self.edition.version && have_the_same_state_machine(other, self.edition)
        };
        for other in Edition::ALL.iter().filter(same) {
            writeln!(f, "Edition {} has the same state machine and the same questions.\n", other.version)?;
        }
        writeln!(
            f,
            "{} combinations, {} steps, every exploration {}.{}",
            self.combinations,
            self.transitions,
            if self.complete { "complete" } else { "INCOMPLETE: nothing below is certain" },
            if self.costs.iter().any(|cost| cost.choices.is_empty()) {
                " SOME PROPERTIES FAIL UNDER THE DEFAULT ANSWERS."
            } else if self.costs.iter().all(|cost| cost.choices.len() == 1) {
                " No two answers together fail what neither fails alone."
            } else {
                ""
            }
        )?;
        writeln!(f, "\n### The answers, ranked by what they can cost\n")?;
        self.ranking(f)?;
        writeln!(f, "\n### The properties that fail, and the shortest runs that show it")?;
        for property in properties(self.edition) {
            let costs: Vec<&Cost> = self.costs.iter().filter(|cost| cost.name == property.name).collect();
            if !costs.is_empty() {
                let (statement, requirements) =
                    (property.statement_in(self.edition), property.requirements_in(self.edition));
                heading(f, property.name, &statement, &requirements)?;
                details(f, property, &costs)?;
            }
        }
        self.with_a_conforming_ai(f)?;
        self.goals(f)?;
        self.holding(f)
    }
}

impl Sweep {
    fn ranking(&self, f: &mut Formatter<'_>) -> fmt::Result {
        writeln!(f, "| rank | answer | instead of | what it can cost | properties that fail |")?;
        writeln!(f, "|---|---|---|---|---|")?;
        for (rank, Ranked { choices, harm, fails }) in self.ranked().iter().enumerate() {
            let names: Vec<String> = fails.iter().map(|name| format!("`{name}`")).collect();
            writeln!(
                f,
                "| {} | {} | {} | {} | {} |",
                rank + 1,
                listed(*choices, |choice| format!("`{choice}`: {}", choice.text())),
                listed(*choices, |choice| self.edition.readings.choice(choice.reading()).text().to_owned()),
                harm.text(),
                names.join(", ")
            )?;
        }
        for choice in self.free().iter() {
            writeln!(f, "| - | `{choice}`: {} | | fails nothing | |", choice.text())?;
        }
        Ok(())
    }

    /// What fails although the AI Computer follows the document.
    fn with_a_conforming_ai(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let otherwise = if is_default(self.edition) { "" } else { CLOSED_OTHERWISE };
        writeln!(f, "{CLOSED}{otherwise}.\nOf the properties that say what a team may rely on, these fail.")?;
        if self.closed.is_empty() {
            return writeln!(f, "\nNone fails any.");
        }
        for ClosedCost { property, choice, run } in &self.closed {
            heading(
                f,
                property.name,
                &property.statement_in(self.edition),
                &property.requirements_in(self.edition),
            )?;
            writeln!(f, "\nFails under `{choice}` ({}):\n", choice.text())?;
            lines(f, &story_of(run))?;
        }
        Ok(())
    }

    /// What cannot be reached any more.
    fn goals(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let lost: Vec<_> = self
            .costs
            .iter()
            .filter_map(|cost| Some((cost, goals(self.edition).iter().find(|goal| goal.name == cost.name)?)))
            .collect();
        if lost.is_empty() {
            return Ok(());
        }
        writeln!(f, "\n### What cannot happen any more\n")?;
        for (cost, goal) in lost {
            writeln!(f, "- {} (`{}`): not under {}", goal.statement, goal.name, under(cost))?;
        }
        Ok(())
    }

    fn holding(&self, f: &mut Formatter<'_>) -> fmt::Result {
        writeln!(f, "\n### The properties that hold under every combination\n")?;
        let holds = |property: &&Property| self.costs.iter().all(|cost| cost.name != property.name);
        for property in properties(self.edition).filter(holds) {
            writeln!(
                f,
                "- `{}`: {} ({})",
                property.name,
                property.statement_in(self.edition),
                property.requirements_in(self.edition).join(", ")
            )?;
        }
        Ok(())
    }
}

fn heading(f: &mut Formatter<'_>, name: &str, statement: &str, covered: &[&str]) -> fmt::Result {
    writeln!(f, "\n#### `{name}`\n\n{statement} ({}).", covered.join(", "))
}

fn details(f: &mut Formatter<'_>, property: &Property, costs: &[&Cost]) -> fmt::Result {
    for cost in costs {
        writeln!(f, "\nFails under {}: {}.", under(cost), cost.harm(property).text())?;
        if let Some(run) = &cost.run {
            writeln!(f)?;
            lines(f, &story(&cost.machine(), run, Some(property)))?;
        }
    }
    Ok(())
}

fn lines(f: &mut Formatter<'_>, story: &[StoryLine]) -> fmt::Result {
    writeln!(f, "```text")?;
    for StoryLine { ms, text } in story {
        writeln!(f, "{:>6}.{:03} s  {text}", ms / 1000, ms % 1000)?;
    }
    writeln!(f, "```")
}

/// The choices, and what undoes the failure.
fn under(cost: &Cost) -> String {
    if cost.choices.is_empty() {
        return "the default answers".to_owned();
    }
    let mut text = listed(cost.choices, |choice| format!("`{choice}` ({})", choice.text()));
    if !cost.undone_by.is_empty() {
        text.push_str(", but not with ");
        text.push_str(&listed(cost.undone_by, |choice| format!("`{choice}`")));
    }
    text
}

fn listed(choices: Choices, text: impl Fn(Choice) -> String) -> String {
    choices.iter().map(text).collect::<Vec<_>>().join(" and ")
}
